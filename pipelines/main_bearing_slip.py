"""Friction and slip of a spherical roller bearing beside a journal bearing, in turbulent wind.

Both stand at the locating place N2 of the two-point suspension of the NREL 5 MW turbine.
Run with ``python pipelines/main_bearing_slip.py``.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal import GasMixture, JournalBearing, Lubricant
from loadflow.rolling import FrictionOptions, SphericalRollerBearing, roller_slip
from loadflow.rotor import simulate
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.stages.frames import to_film, to_rolling
from loadflow.tribology import lubricant
from loadflow.turbines import load_turbine

TURBINE = "nrel-5mw"
BEARING = SphericalRollerBearing(
    rollers=28,
    roller_diameter=0.09,
    roller_length=0.14,
    pitch_diameter=1.06,
    contact_angle=0.17,
    clearance=150e-6,
    slices=10,
    profile="crowned",
    crown_radius=16.0,
)
GREASE = FrictionOptions(
    oil=lubricant("lgep-2"), temperature=313.15, roughness=0.6e-6, starvation=0.7, roller_drag=1e-3
)
JOURNAL = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(viscosity=0.050)


def main(wind_speed: float = 12.0, duration: float = 600.0, step: float = 0.05) -> dict[str, float]:
    """Print and return what both bearings do in one wind."""
    hub = simulate(TURBINE, wind_speed=wind_speed, duration=duration, dt=step, rung="tables")
    force, moment = (
        hub[name].transpose("axis", "time").values for name in ("hub_force", "hub_moment")
    )
    tilt = load_turbine(TURBINE).rotor.tilt
    loads = bearing_loads(TwoPoint(), force, moment, tilt=tilt)
    load = loads["force"].sel(bearing="N2").transpose("time", "axis").values
    time, speed = hub["time"].values, hub["speed"].values

    rolling = BEARING.equilibrium(force=to_rolling(load))
    slip = roller_slip(rolling, time, speed, GREASE)
    entries = slip.entries()
    some = slice(None, None, max(1, round(1.0 / step)))  # one film a second stands for all
    film = JOURNAL.equilibrium(
        force=to_film(load[some]),
        speed=speed[some],
        lubricant=OIL,
        cavitation=GasMixture(0.05e6),
        edge_pressure=0.5e6,
        grid=(60, 20),
        rung="grid",
    )
    friction, pressed = slip.friction, rolling.roller_forces > 0
    found = {
        "roller bearing: mean friction power, W": friction.power.mean(),
        "roller bearing: mean friction torque, N m": friction.torque.mean(),
        "roller bearing: share of it lost in slip": friction.losses["slip"].mean()
        / friction.power.mean(),
        "roller bearing: share of it lost in differential slip": friction.losses[
            "differential slip"
        ].mean()
        / friction.power.mean(),
        "roller bearing: median Λ of loaded contacts": np.median(friction.film_parameter[pressed]),
        "roller bearing: mean slip, row upwind": slip.slip[:, 0].mean(),
        "roller bearing: mean slip, row downwind": slip.slip[:, 1].mean(),
        "roller bearing: entries into the load zone": entries.time.size,
        "roller bearing: largest slip power density, W/mm²": slip.slip_power_density.max() / 1e6,
        "journal bearing: mean friction power, W": film.friction_power.mean(),
        "journal bearing: smallest film, μm": film.minimum_film.min() * 1e6,
    }
    for name, value in found.items():
        print(f"{name:55s} {value:10.4g}")
    return {name: float(value) for name, value in found.items()}


if __name__ == "__main__":
    main()
