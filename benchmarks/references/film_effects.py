"""What effects cost and how far they are right on the rung "reduced", alone and all together.

    python -m benchmarks.references.film_effects [STEPS] [--costs]

The reference bearing of [Jonuschies 2015] under a load of two periods, 40 steps a second: processor
time of a step over that without effects, and the largest difference from the rung "grid" with the
same effects and cells, over the path. "rubbing" is three times the load at a
tenth of the speed on rougher surfaces, of which asperities carry the share that is told. With
``--costs`` it is the time alone, on both rungs, at rest and in motion. Heat in motion finds one
temperature of a series before its first step: it is told in steps that take as long.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import arguments, head, row, timed
from loadflow.errors import ValidityWarning
from loadflow.journal import (
    Contact,
    Feet,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    Growth,
    Heat,
    HousedShell,
    JournalBearing,
    LocalShell,
    Lubricant,
    Supply,
    ThickShell,
    Turbulence,
)
from loadflow.quantities import percent
from loadflow.tribology import AsperityContact

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FILM = Film(
    Lubricant(0.05), GasMixture(0.05e6), edge_pressure=0.5e6, grid=(60, 20), rung="reduced",
    inlet=None, grading="uniform",
)  # fmt: skip
SPEED, RATE = 1.267, 40.0
UNIT = BEARING.clearance / BEARING.radius  # tilt by a clearance at one radius from the middle
ROUGH = AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3)
ROUGHER = replace(ROUGH, roughness=1e-5)
SHELL = LocalShell(3e-12)
HEAT: dict[str, Any] = {
    "lubricant": None,
    "heat": Heat("iso-vg-68", inlet_temperature=318.15, capacity=5e6, start_temperature=320.15),
}
ANSWERS = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")
COMBINED: dict[str, tuple[dict[str, Any], bool, float]] = {
    "nothing": ({}, False, 1.0),
    "tilt": ({}, True, 1.0),
    "contact": ({"contact": Contact(ROUGH)}, False, 1.0),
    "shell": ({"shell": SHELL}, False, 1.0),
    "turbulence everywhere": ({"turbulence": Turbulence(0.0, 0.0)}, False, 1.0),
    "shell, contact": ({"shell": SHELL, "contact": Contact(ROUGH)}, False, 1.0),
    "shell, contact, tilt": ({"shell": SHELL, "contact": Contact(ROUGH)}, True, 1.0),
    "shell, contact, tilt, stored heat": (
        {"shell": SHELL, "contact": Contact(ROUGH), **HEAT},
        True,
        1.0,
    ),
    "rubbing: shell, contact": ({"shell": SHELL, "contact": Contact(ROUGHER)}, False, 3.0),
    "rubbing: shell, contact, tilt, stored heat": (
        {"shell": SHELL, "contact": Contact(ROUGHER), **HEAT},
        True,
        3.0,
    ),
}
"""By name: fields of the film, whether the shaft tilts, and the factor on the load."""

WARM = Heat("iso-vg-68", inlet_temperature=318.15)
OVER_AREA = FilmHeat("iso-vg-68", inlet_temperature=318.15)
ALL_OVER = {
    "thick shell": ThickShell(outer_diameter=3.6, modulus=2.1e11),
    "housing": HousedShell(outer_diameter=3.4, support=Feet(height=2.0, width=1.0)),
}
GROOVES = tuple(Groove(angle, length=1.575, pressure=0.6e6) for angle in (np.pi / 2, -np.pi / 2))
ALONE: dict[str, tuple[str, ...]] = {
    "nothing": ("tilt", "contact", "shell", *ALL_OVER, "turbulence everywhere", "supply"),
    "heat": ("heat, growth",),
}
"""Effects whose cost is told, by that without which their time is told."""

WARMED = ("heat", "heat over the area")
"""What costs at rest as `ALONE`, and in motion before the first step."""

COSTED: dict[str, tuple[dict[str, Any], bool, float]] = COMBINED | {
    **{name: ({"shell": shell}, False, 1.0) for name, shell in ALL_OVER.items()},
    "supply": ({"supply": Supply(GROOVES)}, False, 1.0),
    "heat": ({"lubricant": None, "heat": WARM}, False, 1.0),
    "heat over the area": ({"lubricant": None, "heat": OVER_AREA}, False, 1.0),
    "heat, growth": (
        {"lubricant": None, "heat": replace(WARM, growth=Growth(shell_share=0.9))},
        False,
        1.0,
    ),
}


def path(film: Film, tilts: bool, factor: float, steps: int) -> xr.Dataset:
    """Path of the shaft with the effects."""
    time = np.arange(steps + 1) / RATE
    load = np.stack([2e6 + 5e5 * np.sin(1.5 * time), 4e5 * np.cos(4.0 * time)], axis=-1)
    tilt = UNIT * np.stack([0.2 * np.sin(1.2 * time), 0.1 * np.cos(2.0 * time)], axis=-1)
    line = {"tilt": tilt} if tilts else {}
    return BEARING.orbit(time, factor * load, SPEED * (0.1 if factor > 1.0 else 1.0), film, **line)


def measure(steps: int) -> None:
    """Print a row for each combination."""
    names = ("on", "time", *(name.replace("_", " ") for name in ANSWERS), "asperities carry")
    print(head(*names))
    plain = 0.0
    for name, (fields, tilts, factor) in COMBINED.items():
        film = replace(FILM, **fields)
        few, seconds = timed(partial(path, film, tilts, factor, steps), 3, warm=True)
        plain = plain or seconds
        grid = path(replace(film, rung="grid"), tilts, factor, steps)
        off = [float(np.abs(few[one] / grid[one] - 1.0).max()) for one in ANSWERS]
        share = float(few["contact_share"].max()) if "contact_share" in few else 0.0
        time = (
            f"{seconds / plain:.2g}" if name != "nothing" else f"1 ({1e3 * plain / steps:.2g} ms)"
        )
        print(row(name, time, *(percent(one) for one in off), percent(share)),
              flush=True)  # fmt: skip


def costs() -> None:
    """Print processor times over those without effects: a row for each effect and rung."""
    rng = np.random.default_rng(0)
    force = np.column_stack([rng.uniform(1e6, 3e6, RESTS), rng.uniform(-5e5, 5e5, RESTS)])
    speed = rng.uniform(0.7, 1.3, RESTS)
    tilt = UNIT * np.column_stack([rng.uniform(-0.2, 0.2, RESTS), rng.uniform(-0.1, 0.1, RESTS)])
    print(head("on", "rung", "at rest", "in motion"))
    for rung, steps in (("reduced", 200), ("grid", 40)):

        def times(name: str, rung: str = rung, steps: int = steps) -> list[float]:
            fields, tilts, factor = COSTED[name]
            film = replace(FILM, rung=rung, **fields)
            line = {"tilt": tilt} if tilts else {}
            still = partial(BEARING.equilibrium, force, speed, film, strict=False, **line)
            moving = partial(path, film, tilts, factor, steps)
            return [timed(run, 3, warm=True)[1] for run in (still, moving)]

        for without, effects in ALONE.items():
            plain = times(without)
            for name in effects:
                told = (f"{a / b:.2g}" for a, b in zip(times(name), plain))
                print(row(f"{name} / {without}", rung, *told), flush=True)
        for name, told in _heat_costs(rung, force, speed).items():
            print(row(name, rung, *told), flush=True)


def _heat_costs(rung: str, force: np.ndarray, speed: np.ndarray) -> dict[str, tuple[str, str]]:
    """Time at rest, of a step, and before the first one in steps without heat, by kind of heat.

    Of paths of two lengths, both beyond the samples that tell their temperature.
    """
    found: dict[str, tuple[str, str]] = {}
    plain: list[float] = []
    lengths = (400, 1200) if rung == "reduced" else (80, 160)
    for name in ("nothing", *WARMED):
        film = replace(FILM, rung=rung, **COSTED[name][0])
        still = partial(BEARING.equilibrium, force, speed, film, strict=False)
        moving = [partial(path, film, False, 1.0, steps) for steps in lengths]
        at_rest, short, long = (timed(run, 3, warm=True)[1] for run in (still, *moving))
        step = (long - short) / (lengths[1] - lengths[0])
        plain = plain or [at_rest, step]
        before = (short - lengths[0] * step) / plain[1]
        told = f"{step / plain[1]:.2g}, {before:.2g} steps before"
        found[name] = f"{at_rest / plain[0]:.2g}", told
    return found


RESTS = 16
"""Films at rest that are timed."""


def main() -> None:
    """Measure."""
    parser = arguments(__doc__)
    parser.add_argument("steps", type=int, nargs="?", default=200, help="Steps of a path.")
    parser.add_argument("--costs", action="store_true", help="Times alone, on both rungs.")
    warnings.simplefilter("ignore", ValidityWarning)
    asked = parser.parse_args()
    if asked.costs:
        costs()
    else:
        measure(asked.steps)


if __name__ == "__main__":
    main()
