"""Wind fields of the user's own: a load case for each file, and the rotor in it."""

from __future__ import annotations

import glob
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from loadflow.errors import InputError
from loadflow.readers.names import label_from_name
from loadflow.scene.scene import Scene

if TYPE_CHECKING:
    from loadflow.wind import Box, Condition, Field, Machine, WindOptions

RUN_IN = 60.0
"""Length at the start of a field in which the rotor settles; its loads are thrown away, s."""

HUB_OFF = 0.05
"""Share of the diameter by which the hub of a field may lie off that of the rotor."""

KINDS = (".bts", ".wnd")


def wind_files(scene: Scene) -> Iterator[tuple[Path, float, int | None]]:
    """Yield file, mean wind speed (m/s) and seed of each wind field of a scene.

    The name of the file tells speed and seed as those of load series do; else the speed is the
    field's own to a tenth, and the seed is None.

    Raises
    ------
    loadflow.errors.InputError
        No such file, or one of an unknown kind; a load case without turbulence.
    """
    from loadflow.wind import load_case

    loads = scene.loads
    if not load_case(loads.dlcs[0]).turbulent:
        raise InputError(f"loads.winds: load case {loads.dlcs[0]} has a gust, not turbulence")
    for path in (path for pattern in loads.winds for path in _matching(pattern)):
        if path.suffix not in KINDS:
            raise InputError(f"{path}: a wind field ends in {' or '.join(KINDS)}")
        label = label_from_name(path, loads.pattern)
        speed = label.wind_speed
        if speed is None:
            speed = round(_read(path).wind_speed, 1)
        yield path, speed, label.seed


def given_field(
    path: Path, case: Condition, winds: WindOptions, machine: Machine, duration: float | None
) -> tuple[Condition, Field, str]:
    """Return the condition with the mean wind of a file, its field on the grid of the rotor, and
    the doubt that it is the wind of a hub at another height; "" without one.

    Raises
    ------
    loadflow.errors.InputError
        The field is narrower than the rotor, or shorter than run-in and `duration` (s).
    """
    from loadflow.wind import rotor_grid

    box, grid = _read(path), rotor_grid(machine, winds)
    there = float(box.time[-1]) - RUN_IN
    wanted = there if duration is None else duration
    if not 0 < wanted <= there:
        raise InputError(
            f"{path}: lasts {box.time[-1]:g} s; {RUN_IN:g} s of run-in and "
            f"{max(wanted, 0.0):g} s of loads do not fit"
        )
    try:
        field = box.to_polar(grid.radius, grid.angle)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    mean = replace(
        case,
        wind_speed=box.wind_speed,
        shear_exponent=box.shear_exponent,
        duration=wanted,
    )
    off, hub = box.hub_height - machine.hub_height, f"{machine.hub_height:g} m"
    doubt = f"wind: hub of the field at {box.hub_height:g} m, that of the turbine at {hub}"
    return mean, field, doubt if abs(off) > HUB_OFF * machine.rotor_diameter else ""


def _matching(pattern: str) -> list[Path]:
    paths = [Path(name) for name in sorted(glob.glob(pattern))]
    if not paths:
        raise InputError(f"{pattern}: no such wind field")
    return paths


def _read(path: Path) -> Box:
    from loadflow.wind import read_bladed_box, read_bts

    return read_bts(path) if path.suffix == ".bts" else read_bladed_box(path)
