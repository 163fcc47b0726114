"""Slip of rollers and gap of the cage against Tables 8.5, 8.6 and ch. 8.3 of von Hollen 2013.

The oil's temperature in the tests is not given (45 … 60 °C): one viscosity, 37.1 mPa s, is fitted
to the first row of Table 8.5 and holds for all rows of both models; the reversing loads, run on
another day, take 29 mPa s, fitted to their first row. Of Table 8.6 only the rows under reversing
loads can be computed, for the others no loads are given. The mass of the cage is fitted to one of
its four gaps. Nothing is fitted to the measurements; that drops of oil leave the pockets drained,
and 60 °C, are chosen, and the rows say so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from loadflow.rolling import FrictionOptions
from loadflow.rolling import friction as parts
from loadflow.rolling.friction import DragConstants, RollerGaps
from loadflow.rolling.motion.cage import CageRim, cage_orbit
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.history import RollerHistory, RollerRow, radial_history
from loadflow.rolling.motion.radial_load import behw_law
from loadflow.rolling.motion.rollers import RollerMotion, coulomb_motion, film_motion
from loadflow.tribology import Oil
from loadflow.validation.check import Check, Evidence, evidence

RPM = math.pi / 30
ROW = RollerRow(
    rollers=14,
    roller_diameter=11e-3,
    roller_length=11e-3,
    pitch_diameter=60.5e-3,
    roller_mass=11e-3,
)
FITTED = 37.06e-3  # Pa s, to the first row of Table 8.5
_FREQUENCY = (
    "no frequency from half to twice a turn meets the rows with one oil; each alone is met by one "
    "of 26 … 33 mPa s, 4 K warmer or cooler than the one that meets 500 and 1000/min"
)
_OFTENER = (
    "the load is taken to reverse once a turn, its frequency is not given: twice a turn lowers the "
    "slip by a fifth to two fifths from 1000/min on and meets three of the five rows"
)
AT_60 = 26.3e-3  # Pa s, the source's oil at 60 °C, the upper end of the tests
CAGE_MASS = 30.665e-3  # kg, fitted to the least gap at 1000/min; the print has no mass
_COLDER = "the tests' oil had 45 … 60 °C: at 55 °C ours is within the bound, and so at 50 and 45 °C"

# speed (1/min), load (N), slip (%) measured (mid of ranges), stage 1, stage 2
STATIC = (
    (1000, 2e3, 40, 78, 100),
    (1000, 5.5e3, 25, 78, 100),
    (1000, 13.8e3, 29, 77, 100),
    (2000, 2e3, 30, 55, 98),
    (2000, 5.5e3, 20, 54, 95),
    (2000, 13.8e3, 25, 51, 93),
    (3000, 2e3, 20, 34, 88),
)
REVERSING = (
    (500, 24, 85, 100),
    (1000, 20, 67, 99),
    (2000, 6, 31, 86),
    (3000, 5, 20, 87),
    (4000, 7, 8, 86),
)

Model = Callable[[RollerHistory], RollerMotion]


def static_load(rpm: float, force: float) -> RollerHistory:
    """Main bearing under a constant load for two turns of the cage, in steps of 1°."""
    return radial_history(ROW, _times(rpm), rpm * RPM, force, 8e-6, behw_law(ROW.roller_length))


def reversing_load(rpm: float, turns: float = 1.0) -> RollerHistory:
    """Main bearing under ±2 kN, so many times a turn (the frequency is not given)."""
    t = _times(rpm)
    force = 2e3 * np.sin(turns * rpm * RPM * t)
    return radial_history(ROW, t, rpm * RPM, force, 8e-6, behw_law(ROW.roller_length))


def _times(rpm: float) -> np.ndarray:
    return np.linspace(0, 2 * 22 / 9 * 60 / rpm, 1761)


def oil_of(viscosity: float) -> Oil:
    """Engine oil of the source with this viscosity at 50 °C, α_p = 2e-8 1/Pa assumed."""
    nu = viscosity / (855.0 - 0.605 * 35)
    return Oil(
        viscosities=(nu, nu / 4),
        temperatures=(323.15, 373.15),
        density_15=855.0,
        pressure_coefficient=2e-8,
        limiting_slope=0.07,
    )


def coulomb_model(gaps: RollerGaps, viscosity: float, variant: str = "thesis") -> Model:
    """Stage 1 with the drag of these gaps."""
    drag = parts.coulomb_drag_constants(gaps, viscosity, 9 / 22, 0.12, 0.04, variant=variant)  # type: ignore[arg-type]
    return lambda history: coulomb_motion(history, drag)


def film_model(viscosity: float, drag: DragConstants, film: str) -> Model:
    """Stage 2; elastic films everywhere and smooth surfaces, as the source has it, or "moes"."""
    smooth = film != "moes"
    options = FrictionOptions(
        oil=oil_of(viscosity),
        temperature=323.15,
        film=film,
        roughness=1e-12 if smooth else 0.3e-6,
        hysteresis=0.0 if smooth else 0.01,
    )
    return lambda history: film_motion(history, options, drag=drag)


def checks(gaps: RollerGaps) -> Iterator[Check]:
    """Yield all rows, for the gaps of Table 8.2."""
    yield from _stage_one(gaps)
    yield from _stage_two(gaps)
    yield from _measured()
    yield from _cage()


def _fitted(row: bool) -> Evidence:
    """What a row of stage 1 is: that to which the oil's viscosity is fitted proves nothing."""
    return "consistency" if row else "print of the source"


def _percent(model: Model, history: RollerHistory) -> float:
    return 100 * model(history).maximum_slip


@evidence("print of the source")
def _stage_one(gaps: RollerGaps) -> Iterator[Check]:
    """Stage 1: Table 8.5 (B1), uneven gaps (B3), reversing loads of Table 8.6 (B5)."""
    model = coulomb_model(gaps, FITTED)
    for rpm, force, _, printed, _ in STATIC:
        got = _percent(model, static_load(rpm, force))
        name = f"slip, stage 1, {rpm}/min, {force / 1e3:g} kN"
        of = _fitted(rpm == 1000 and force == 2e3)
        yield Check(name, "Table 8.5", printed, got, 1.5, "absolute", "%", evidence=of)

    def uneven(pair: tuple[float, float]) -> tuple[float, float]:
        return pair[0] / 2, 1.5 * pair[1]

    bars = replace(gaps, pocket_gaps=uneven(gaps.pocket_gaps))
    every = replace(bars, end_gaps=uneven(gaps.end_gaps), rib_gaps=uneven(gaps.rib_gaps))
    for name, changed in (("s₃ uneven", bars), ("all gaps uneven", every)):
        got = _percent(coulomb_model(changed, FITTED), static_load(3000, 2e3))
        yield Check(f"slip, stage 1, {name}", "ch. 8.2", 40, got, 1.5, "absolute", "%")
    model = coulomb_model(gaps, 29e-3)
    for rpm, _, printed, _ in REVERSING:
        got = _percent(model, reversing_load(rpm))
        name = f"slip, stage 1, ±2 kN, {rpm}/min"
        yield Check(
            name, "Table 8.6", printed, got, 1.5, "absolute", "%",
            missed=_FREQUENCY if rpm >= 2000 else "", evidence=_fitted(rpm == 500),
        )  # fmt: skip


@evidence("print of the source")
def _stage_two(gaps: RollerGaps) -> Iterator[Check]:
    """Stage 2 of Table 8.5 (B4): elastic films and the same viscosity."""
    drag = parts.coulomb_drag_constants(gaps, FITTED, 9 / 22, 0.12, 0.04, variant="thesis")
    model = film_model(FITTED, drag, "hamrock")
    for rpm, force, _, _, printed in STATIC:
        got = _percent(model, static_load(rpm, force))
        name = f"slip, stage 2, {rpm}/min, {force / 1e3:g} kN"
        yield Check(name, "Table 8.5", printed, got, 2.0, "absolute", "%")


def drained_model() -> Model:
    """Films of all regimes with the oil at 60 °C, in pockets that the drops of the tests empty."""
    return film_model(AT_60, DragConstants(0.0, 0.0), "moes")


# half of a range that the source prints, points, but no more than 8; rows of one speed are repeats,
# as its text finds no effect of the load: their standard deviation about the mean of the speed,
# pooled over 1000 and 2000/min
_RANGES = {(2000, 2e3): 8.0, (2000, 13.8e3): 5.0}
_REPEATS = 6.5


@evidence("measured elsewhere")
def _measured() -> Iterator[Check]:
    """Slip measured, beside films of all regimes with drained pockets and oil at 60 °C.

    Both are chosen: of the tests 45 … 60 °C are printed, which move the slip by 6 to 10 points.
    """
    model = drained_model()
    source = "Table 8.5, drained pockets, 60 °C (both chosen)"
    for rpm, force, measured, *_ in STATIC:
        got = _percent(model, static_load(rpm, force))
        name = f"slip measured, {rpm}/min, {force / 1e3:g} kN"
        within = _RANGES.get((rpm, force), _REPEATS)
        low = (rpm, force) in ((1000, 2e3), (2000, 13.8e3))
        yield Check(
            name, source, measured, got, within, "absolute", "%", missed=_COLDER if low else ""
        )
    for rpm, measured, *_ in REVERSING:
        got = _percent(model, reversing_load(rpm))
        name = f"slip measured, ±2 kN, {rpm}/min"
        yield Check(
            name, "Table 8.6, drained pockets, 60 °C (both chosen)", measured, got, 8.0,
            "absolute", "%",
            missed=_OFTENER,
        )  # fmt: skip


@evidence("print of the source")
def _cage() -> Iterator[Check]:
    """Gap of the crank-pin bearing's cage in the rod (B2), within half of the last digit printed.

    Its mass is not printed: it is fitted to the first gap, and the other three are foretold.
    """
    drive = CrankDrive(radius=42.5e-3, rod_length=143.5e-3)
    rim = CageRim(width=4e-3, bore=63e-3, diameter=62.85e-3, viscosity=10.6e-3)
    for rpm, low, high in ((1000, 3.8, 5.2), (6000, 1.5, 2.1)):
        omega = rpm * RPM
        time = np.linspace(0, 2 * math.pi / omega, 181)
        ring = drive.swing(omega * time, omega).speed
        force = float(parts.cage_inertia_force(CAGE_MASS, 18, 6.67e-3, drive.radius, omega))
        orbit = cage_orbit(rim, time, (force, 0.0), 21 / 37 * ring, ring)
        for word, printed, got in (
            ("least", low, orbit.minimum_gap.min()), ("largest", high, orbit.minimum_gap.max()),
        ):  # fmt: skip
            fitted = (rpm, word) == (1000, "least")
            name = f"{word} gap of the cage, {rpm}/min"
            source = f"ch. 8.3.3, mass {'fitted to it' if fitted else 'fitted to the first gap'}"
            yield Check(
                name, source, printed, float(got) * 1e6, 0.05, "absolute", "μm",
                evidence=_fitted(fitted),
            )  # fmt: skip
