"""What lies behind the rows that `loadflow validate` calls missed: the cause, switched on or off.

python -m benchmarks.references.missed [--folder CLONES] [PART …]

Parts: grooves, slip, models, stages, blade, crank, rig, momentum, rupture. Each prints the rows of
a source and ours with the cause that the row names, or without it. `--folder` (clones as
OWNER/NAME) adds the IEA 10 and 22 MW to the part momentum.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from benchmarks.common import arguments
from loadflow.journal import Contact, Film, Lubricant, ThickShell
from loadflow.journal.cavitation import LOAD
from loadflow.journal.film.heat.equation import EnergyEquation
from loadflow.journal.line import Line
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits
from loadflow.rolling import FlexibleRings, RingBeam, RingSection, Support
from loadflow.rolling.friction import drag_constants
from loadflow.tribology import AsperityContact, combined_roughness
from loadflow.validation import _friction_motion as motion
from loadflow.validation import film_heat, friction_rig, stribeck, supply
from loadflow.validation._slewing_cases import BLADE, SPECTRUM
from loadflow.validation.friction import MAIN
from loadflow.validation.turbines import TURBINES, completed, published_states

if TYPE_CHECKING:
    from loadflow.journal import FilmHeat
    from loadflow.journal.film.gap.warm import WarmGap

Floats = np.ndarray


def grooves() -> None:
    """Flow of Table 5-23 with two grooves of 0.7 B at ± some angle from the first axis."""
    printed = [row[-1] for row in supply.ENERGY.values()]
    print("Q, l/min, at V =", [*supply.ENERGY], "printed", printed)
    for degrees, share in ((90.0, 0.7), (94.0, 0.695), (96.0, 0.695), (98.0, 0.695)):
        flows = supply.flows(degrees, share)
        off = [100 * (flows[wind] / row[-1] - 1) for wind, row in supply.ENERGY.items()]
        print(f"±{degrees:g}°, {share:g} B: {_told(off, '+.1f')} %")


def slip() -> None:
    """Slip of Table 8.6, stage 1, by the frequency of the load and the viscosity of the oil."""
    speeds = [row[0] for row in motion.REVERSING]
    print("slip, %, at", speeds, "1/min, printed", [row[2] for row in motion.REVERSING])
    for viscosity in (26.3e-3, 29e-3, 33e-3):
        model = motion.coulomb_model(MAIN, viscosity)
        for turns in (0.5, 1.0, 2.0):
            found = [100 * model(motion.reversing_load(rpm, turns)).maximum_slip for rpm in speeds]
            print(f"{1e3 * viscosity:g} mPa s, {turns:g} reversals a turn: {_told(found, '.1f')}")
    print("the same beside measured", [row[1] for row in motion.REVERSING])
    for turns in (1.0, 2.0):
        loads = (motion.reversing_load(rpm, turns) for rpm in speeds)
        found = [100 * motion.drained_model()(load).maximum_slip for load in loads]
        print(f"films, drained pockets, {turns:g} reversals a turn: {_told(found, '.1f')}")


def models() -> None:
    """Mean error of the slip against the measured one, Tables 8.5 and 8.6 (±2 kN), by the model."""
    flooded = drag_constants(MAIN, motion.AT_60, 9 / 22)
    for name, model in (
        ("stage 1, pockets as drawn", motion.coulomb_model(MAIN, motion.AT_60, "geometric")),
        ("films, pockets as drawn", motion.film_model(motion.AT_60, flooded, "moes")),
        ("films, drained pockets", motion.drained_model()),
    ):
        rest = [100 * model(motion.static_load(n, f)).maximum_slip for n, f, *_ in motion.STATIC]
        moved = [100 * model(motion.reversing_load(n)).maximum_slip for n, *_ in motion.REVERSING]
        off = (
            np.abs(np.array(found) - [row[-3] for row in rows]).mean()
            for found, rows in ((rest, motion.STATIC), (moved, motion.REVERSING))
        )
        print(f"{name}: {_told(off, '.1f')} points")


def stages() -> None:
    """Torque of stage 2 over that of stage 1, with and without what slip loses."""
    rig = friction_rig.CrankRig(seal_force=0.0)
    for rpm in (1000.0, 3000.0):
        coulomb, films = (rig.friction_torque(rpm, stage) for stage in ("coulomb", "film"))
        slip = sum(value for name, value in films.torques.items() if name.endswith("slip"))
        shares = films.torque / coulomb.torque, (films.torque - slip) / coulomb.torque
        print(f"{rpm:g} 1/min: {_told(shares, '.3f')}")


def blade() -> None:
    """Largest ball force and P_ea of the blade bearing over the print, by clearance and rings."""
    bearing, loads = replace(BLADE, row_spacing=0.06), SPECTRUM[:, :3].T
    section, half = RingSection.rectangle(0.1, 0.15), 0.5 * BLADE.pitch_diameter
    springs = {"radial": 1e11, "tangential": 1e11, "axial": 1e11, "tilt": 1e7}

    def ring(radius: float, foot: float) -> RingBeam:
        support = Support(radius=radius, height=foot, **springs)
        return RingBeam(section=section, radius=radius, harmonics=16, supports=(support,))

    even = FlexibleRings(outer=ring(half + 0.07, -0.075), inner=ring(half - 0.07, 0.075))
    zero = np.zeros(len(SPECTRUM))
    force, moment = np.stack([loads[0], zero, loads[1]], -1), np.stack([zero, -loads[2]], -1)
    for name, found in (
        ("rigid rings", bearing.equilibrium(force, moment)),
        ("0.05 mm", replace(bearing, clearance=5e-5).equilibrium(force, moment)),
        ("even rings on springs", bearing.equilibrium(force, moment, rings=even)),
    ):
        print(f"F_k,max, {name}: {_told(found.maximum_force / SPECTRUM[:, 3], '.3f')}")
        print(f"P_ea, {name}: {_told(found.equivalent_load / SPECTRUM[:, 4], '.3f')}")


def crank() -> None:
    """Torque of the pin bearing at 1000/min, stage 2, by its clearance: printed +18 … 53 % at 0."""
    rig = friction_rig.CrankRig(seal_force=0.0)
    usual: dict[str, float] = {}
    for clearance in (25e-6, 13e-6, 5e-6, 2e-6, 1e-6, 0.0):
        pin = replace(friction_rig.PIN, clearance=clearance)
        torques = replace(rig, pin=pin).friction_torque(1000.0, "film").torques
        parts = {key: value for key, value in torques.items() if key.startswith("pin")}
        usual = usual or parts
        rise = 100 * (sum(parts.values()) / sum(usual.values()) - 1)
        each = ", ".join(
            f"{key[4:]} {100 * (v / usual[key] - 1):+.0f} %" for key, v in parts.items()
        )
        print(f"{1e6 * clearance:g} µm: {rise:+.0f} %: {each}")


_SUMMITS = Contact(
    AsperityContact(
        roughness=float(combined_roughness(0.13e-6, 0.28e-6)),
        contact_modulus=53.3e9,
        factor=1e-3,
        summit_height=0.60e-6,
    ),
    friction=0.02,
    surface_roughness=stribeck.ROUGH.roughness,
)
"""The surfaces as the source states them: summits 0.21 and 0.39 µm above the mean planes."""
_RINGS = ThickShell(0.14, 52.5e9), ThickShell(0.13, 105e9)
"""Rod of aluminium on a steel shaft, and steel on steel, as rings of about their size that are held
outside: 1/E is that of shell and shaft together."""


def _elastic_moments(
    load: float, speeds: np.ndarray, cells: tuple[int, int] = (60, 8)
) -> np.ndarray:
    """As `stribeck.moments`, with the surfaces, the elasticity and the oil that the source states.

    `speeds` fall, as each film is found from the last.
    """
    omega = speeds * np.pi / 30
    found = []
    for bearing, ring, force in zip((stribeck.TEST, stribeck.SUPPORT), _RINGS, (load, 0.5 * load)):
        oil = Lubricant(6.8e-3, pressure_coefficient=9.5e-9)
        film = Film(oil, contact=_SUMMITS, shell=ring, inlet=None, grid=cells)
        forces = np.tile([force, 0.0], (speeds.size, 1))
        found.append(bearing.equilibrium(forces, omega, film).friction_power / omega)
    return np.asarray(found[0] + 2 * found[1])


def rig() -> None:
    """Moments of [Sander et al. 2015] with what rigid, aligned bearings of even viscosity lack."""
    for load, measured in stribeck.MEASURED.items():
        speeds, values = np.array([*measured], float), np.array([*measured.values()])
        print(f"{load:g} N, 1/min {speeds.astype(int).tolist()}, measured {values.tolist()} N m")
        for share in (0.0, 0.05, 0.1, 0.15):
            found = stribeck.moments(load, speeds, share)
            print(f"tilted by {share:g} of the clearance at the ends: {_told(found, '.3f')} N m")
        slow = np.array([1000, 800, 650, 500, 450, 400, 350, 300, 275, 250, 225, 200, 175, 150.0])
        found = _elastic_moments(load, slow)
        print(f"summits, elastic rings, oil that thickens, {slow.astype(int).tolist()}:")
        print(f"    {_told(found, '.3f')} N m")


def momentum(folder: Path | None) -> None:
    """Power and thrust of rigid blades at the printed states: Buhl's relation, and HAWC2's."""
    from loadflow.rotor import RotorOptions
    from loadflow.rotor.rungs import prepare
    from loadflow.turbines import load_turbine

    options = RotorOptions(tower_dam=False, shed_wake=False, skew_factor=0.0)
    for public in TURBINES:
        if folder is None and not public.shipped:
            continue
        shipped = load_turbine(public.shipped) if public.shipped else None
        if folder is not None and not (folder / public.repository).exists():
            continue
        turbine = shipped or completed(public, folder)  # type: ignore[arg-type]
        m, _ = prepare(turbine, "bem", options)
        for wind, speed, pitch, power, thrust in published_states(public.name):
            if wind > 10.5:
                continue
            said = [f"{public.name}, {wind:g} m/s"]
            for law, relation in (("Buhl", buhl), ("HAWC2", hawc2)):
                got = rotor(m, wind, speed * np.pi / 30, np.radians(pitch), relation)
                off = [100 * (a / b - 1) for a, b in zip(got, (power, thrust))]
                said.append(f"{law} {_told(off, '+.1f')} %")
            print("; ".join(said))


def buhl(thrust: float, loss: float) -> float:
    """Axial induction of a thrust coefficient, momentum theory and Buhl's parabola beyond it."""
    if thrust <= 0.96 * loss:
        return float(0.5 * (1 - np.sqrt(1 - thrust / loss)))
    root = np.sqrt(thrust * (50 - 36 * loss) + 12 * loss * (3 * loss - 4))
    return float((18 * loss - 20 - 3 * root) / (36 * loss - 50))


def hawc2(thrust: float, loss: float) -> float:
    """Axial induction of a thrust coefficient, polynomial of [Madsen et al. 2020]."""
    x = thrust / loss
    return 0.0883 * x**3 + 0.0586 * x**2 + 0.246 * x


def rotor(
    m: Any, wind: float, speed: float, pitch: float, relation: Callable[[float, float], float]
) -> tuple[float, float]:
    """Power, W, and thrust, N, of a rigid rotor without tilt in even wind."""
    from loadflow.rotor.aero._airfoil_kernels import polar
    from loadflow.rotor.aero._kernels import loss

    across, along = [], []
    for i, radius in enumerate(m.radius):
        solidity = m.blades * m.chord[i] / (2 * np.pi * radius)
        a, swirl = 0.3, 0.0
        for _ in range(400):
            normal, turning = wind * (1 - a), speed * radius * (1 + swirl)
            angle = np.arctan2(normal, turning)
            lift, drag = (polar(table, i, angle - m.twist[i] - pitch) for table in (m.lift, m.drag))
            sine, cosine, square = np.sin(angle), np.cos(angle), normal**2 + turning**2
            tip = loss(m, i, abs(sine))
            push, pull = lift * cosine + drag * sine, lift * sine - drag * cosine
            new = relation(solidity * square * push / wind**2, tip)
            twist = solidity * lift / (4 * tip * cosine)
            if abs(new - a) < 1e-9:
                break
            a += 0.2 * (new - a)
            swirl += 0.2 * (twist / (1 - twist) - swirl)
        dynamic = 0.5 * 1.225 * square * m.chord[i]
        across.append(dynamic * push)
        along.append(dynamic * pull)
    place = np.append(m.radius, m.tip_radius)
    thrust = m.blades * np.trapezoid([*across, 0.0], place)
    torque = m.blades * np.trapezoid(np.array([*along, 0.0]) * place, place)
    return float(speed * torque), float(thrust)


def rupture() -> None:
    """K and C of the warm bearing of 400 mm, changes of its pressure held at 0 before the rupture.

    The source holds them at 0 at the nodes that its pressure leaves at 0, which begin anywhere from
    none to one of its elements before the rupture: 8.8° of the adiabatic, 4.4° of the full film.
    """
    bearing = film_heat.ladder_bearing()
    for rung in ("adiabatic", "full"):
        rows = [row for row in film_heat.LADDER if row.rung == rung and row.name[0] in "KC"]
        print(f"{rung}: % off in", ", ".join(row.name for row in rows))
        options = film_heat.ladder_film(rung)
        options = replace(options, grid=(160, 20))  # cells of 2.2°
        statics = Statics(bearing, options, Line(), film_heat.LADDER_SPEED)
        film = statics.film
        equation = EnergyEquation(
            film, cast("WarmGap", statics.gap), cast("FilmHeat", options.heat)
        )
        state = equation.state(None)
        for _ in range(_ROUNDS):
            equation.thicken(state)
            load, limits = np.array(film_heat.LADDER_LOAD), Limits(1e-10, 60)
            found = statics.solve(0, load, film_heat.LADDER_SPEED, None, limits)
            warmth = equation.alone(found, equation.cells_of(state))
            state = equation.state(warmth)
        full = film.state[LOAD] > _EMPTY
        angle = film.mesh.angle[:, None]
        last = np.where(full, angle, -np.inf).max(axis=0)
        fixed = film.fixed
        for degrees in (0.0, 2.2, 4.4):
            film.fixed = fixed | ~full | (angle > last - np.radians(degrees))
            linear = film.linearise(found.u, found.position, np.zeros(2))
            there = SimpleNamespace(
                stiffness=linear.stiffness / bearing.clearance,
                damping=linear.damping / bearing.clearance,
            )
            off = [100 * row.check(there).deviation for row in rows]  # type: ignore[arg-type]
            print(f"held at 0 from {degrees:g}° before the rupture: {_told(off, '+.1f')}")
        film.fixed = fixed


_ROUNDS = 40  # of film and temperatures in turn
_EMPTY = 100.0  # Pa, up to which there is no film


def _told(values: Any, form: str) -> str:
    return ", ".join(f"{float(value):{form}}" for value in values)


PARTS = {
    "grooves": grooves,
    "slip": slip,
    "models": models,
    "stages": stages,
    "blade": blade,
    "crank": crank,
    "rig": rig,
    "momentum": momentum,
    "rupture": rupture,
}


def main() -> None:
    """Print the parts that are asked for."""
    parser = arguments(__doc__)
    parser.add_argument("parts", nargs="*", default=[*PARTS], metavar="PART")
    parser.add_argument("--folder", type=Path, help="clones as OWNER/NAME")
    asked = parser.parse_args()
    if unknown := set(asked.parts) - set(PARTS):
        sys.exit(f"unknown parts: {', '.join(sorted(unknown))}; known: {', '.join(PARTS)}")
    for name in asked.parts:
        print(f"--- {name}")
        if name == "momentum":
            momentum(asked.folder)
        else:
            PARTS[name]()  # type: ignore[operator]


if __name__ == "__main__":
    main()
