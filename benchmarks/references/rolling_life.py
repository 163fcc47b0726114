"""Arrangements of main bearings over the wind speeds, and what binning the loads costs.

``python -m benchmarks.references.rolling_life [--json]``. Loads: NREL 5 MW, DLC 1.1, class I B,
five wind speeds weighted by Rayleigh, one seed of 200 s each, samples of 0.1 s. Also errors of the
approximate contact formulas, and the edge pressure that independent slices leave out.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from benchmarks.common import arguments, show, timed
from loadflow.rolling import (
    ARRANGEMENTS,
    arrangement_lives,
    bin_loads,
    edge_contact,
    main_bearings,
    system_life,
)
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.rotor import simulate
from loadflow.shaft import MomentBearing, TwoPoint, bearing_loads
from loadflow.stages.frames import to_rolling
from loadflow.tribology.contact_ellipse import RUNGS
from loadflow.tribology.hertz import hertz_point

WIND_SPEEDS = (6.0, 10.0, 14.0, 18.0, 22.0)
EVERY = 4  # steps of 0.025 s
TILT = math.radians(5)


def series() -> dict[str, tuple[np.ndarray, ...]]:
    """Force, moment, speed and weight of each place on the shaft, over all wind speeds."""
    parts: dict[str, list[tuple[np.ndarray, ...]]] = {}
    for v in WIND_SPEEDS:
        hub = simulate("nrel-5mw", dlc="1.1", wind_speed=v, seed=1, duration=200, category="B")
        share = v * math.exp(-math.pi / 4 * (v / 10) ** 2)
        force, moment = (
            hub[n].transpose("axis", "time").values for n in ("hub_force", "hub_moment")
        )
        for concept in (TwoPoint(), MomentBearing()):
            loads = bearing_loads(concept, force, moment, tilt=TILT)
            for place in loads["bearing"].values:
                one = loads.sel(bearing=place).transpose("time", "axis")
                parts.setdefault(str(place), []).append(
                    (
                        to_rolling(one["force"].values)[::EVERY],
                        to_rolling(one["moment"].values)[::EVERY, :2],
                        hub["speed"].values[::EVERY],
                        np.full(len(hub["time"][::EVERY]), share),
                    )
                )
    return {place: tuple(map(np.concatenate, zip(*rows))) for place, rows in parts.items()}


def arrangements(loads: dict[str, tuple[np.ndarray, ...]]) -> list[dict[str, Any]]:
    """Life in years and static safety of each arrangement."""
    rows = []
    for name in ARRANGEMENTS:
        bearings = main_bearings(name)
        force, moment = ({place: loads[place][i] for place in bearings} for i in (0, 1))
        speed, weight = next(loads[place][2:] for place in bearings)
        found = arrangement_lives(bearings, force, moment, speed, weight)
        years = {place: part.life_hours / 8766 for place, part in found.items()}
        rows.append(
            {"what": f"arrangement {name}"}
            | {f"years_{place}": value for place, value in years.items()}
            | {
                "years_system": float(system_life(list(years.values()))),
                "static_safety": min(part.static_safety for part in found.values()),
            }
        )
    return rows


def life(bearing: dict[str, Any], *loads: np.ndarray) -> float:
    """Life of the bearing M under force, moment, speed and weight of some loads."""
    force, moment, speed, weight = loads
    return arrangement_lives(bearing, {"M": force}, {"M": moment}, speed, weight)["M"].life


def binning(loads: dict[str, tuple[np.ndarray, ...]]) -> list[dict[str, Any]]:
    """Error of the life from revolution-weighted bins against the full series."""
    rows = []
    for name in ("moment", "tapered-pair"):
        bearing = {"M": main_bearings(name)["M"]}
        force, moment, speed, weight = loads["M"]
        arrangement_lives(bearing, {"M": force[:2]}, {"M": moment[:2]}, speed[:2], weight[:2])
        full, seconds = timed(partial(life, bearing, force, moment, speed, weight))
        for bins in (4, 8, 12, 16, 24):
            f, m, turns = bin_loads(force, moment, speed * weight, bins)
            found, spent = timed(partial(life, bearing, f, m, np.ones_like(turns), turns))
            rows.append(
                {
                    "what": f"{name}, {bins} bins of each component",
                    "loads": len(turns),
                    "of": len(force),
                    "error_of_life": found / full - 1,
                    "times_faster": seconds / spent,
                }
            )
    return rows


def contact_rungs() -> list[dict[str, Any]]:
    """Largest errors of the approximate contact formulas over ratios of curvature, and cost."""
    rows = []
    for rung in list(RUNGS)[1:]:
        row: dict[str, Any] = {"what": f"point contact, {rung}"}
        for low, high in ((1, 5), (5, 60), (1, 200)):
            ratio = np.geomspace(low, high, 1000)
            ours, exact = (
                hertz_point(ratio, 1.0, 0.0, 0.0, force=1e3, rung=r) for r in (rung, "exact")
            )
            for name in ("stiffness", "pressure"):
                error = np.abs(getattr(ours, name) / getattr(exact, name) - 1).max()
                row[f"{name}_{low}_{high}"] = float(error)
        ratio = np.geomspace(1, 200, 20_000)
        _, seconds = timed(partial(hertz_point, ratio, 1.0, 0.0, 0.0, force=1.0, rung=rung))
        row["ns_per_contact"] = seconds / len(ratio) * 1e9
        rows.append(row)
    return rows


def edges() -> list[dict[str, Any]]:
    """Largest pressure of a tapered main-bearing roller: influence coefficients against slices."""
    bearing = main_bearings("tapered-pair")["M"]
    assert isinstance(bearing, RollerRaceways)
    rows = []
    for profile in ("straight", "iso"):
        for tilt in (0.0, 0.5e-3):
            shaped = replace(bearing, profile=profile)
            contact, seconds = timed(partial(edge_contact, shaped, 1e5, tilt))
            rows.append(
                {
                    "what": f"roller under 100 kN, {profile}, tilt {tilt * 1e3:g} mrad",
                    "MPa": contact.maximum_pressure / 1e6,
                    "MPa_hertz_line": float(
                        shaped.slice_contact("inner", 1e5 / shaped.slices).pressure / 1e6
                    ),
                    "edge_over_middle": contact.edge_factor(),
                    "seconds": seconds,
                }
            )
    return rows


def main() -> None:
    """Print the figures."""
    parser = arguments(__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    as_json = parser.parse_args().json
    loads = series()
    show(arrangements(loads) + binning(loads) + contact_rungs() + edges(), as_json)


if __name__ == "__main__":
    main()
