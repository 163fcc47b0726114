"""One load on one rolling bearing → forces, pressures, life and verdicts, labelled."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.rolling import (
    FlexibleRings,
    FrictionOptions,
    Lubrication,
    RollerRaceways,
    RollingBearing,
    SlewingBearing,
    coefficients_over_speed,
    edge_contact,
    verdicts,
)
from loadflow.rolling.rating.life import life_hours
from loadflow.rolling.rating.static import HOURS_20_YEARS
from loadflow.scene.bearings import FurtherBearing, around, standing_ring
from loadflow.scene.scene import read_scene
from loadflow.stages.labelling import quantities
from loadflow.stages.rolling import KEPT
from loadflow.stages.rolling_at_work import as_stated
from loadflow.studies.one_bearing.journal import Load, written_coefficients
from loadflow.tribology import lubricant

Rings = Literal["rigid"] | FlexibleRings
Measures = tuple[float, float, float]

NEEDED = ("balls", "ball_diameter", "pitch_diameter", "groove_radius")

EXAMPLE = (
    "loadflow rolling --balls 60 --ball-diameter 0.06 --pitch-diameter 2.4 "
    "--groove-radius 0.0315 --force-z 1e6 --moment-y 1e6"
)
"""A call with all that one bearing needs."""


def slewing_bearing(
    *,
    contact_angle_deg: float = 45.0,
    inner_ring: Measures | None = None,
    outer_ring: Measures | None = None,
    wall: tuple[float, float] | None = None,
    **measures: Any,
) -> tuple[SlewingBearing, Rings]:
    """Return a slewing bearing and its rings from the measures that a command states.

    Parameters
    ----------
    contact_angle_deg : float
        Nominal contact angle, °.
    inner_ring, outer_ring : tuple of float, optional
        Width, height and radius of `standing_ring`, m; rigid if not given.
    wall : tuple of float, optional
        Thickness and length of the walls, m: the outer ring stands on its bottom, the inner ring
        on its top face.
    **measures
        Fields of `SlewingBearing`.

    Raises
    ------
    loadflow.errors.InputError
        A measure is missing or out of its range.
    """
    if missing := [name for name in NEEDED if name not in measures]:
        options = ", ".join(f"--{name.replace('_', '-')}" for name in missing)
        raise InputError(f"give {options}, or a scene with --scene; for example: {EXAMPLE}")
    bearing = SlewingBearing(contact_angle=math.radians(contact_angle_deg), **measures)
    if inner_ring is None and outer_ring is None:
        if wall is not None:
            raise InputError("--wall holds flexible rings: give --inner-ring or --outer-ring")
        return bearing, "rigid"
    inner = inner_ring and standing_ring(*inner_ring, wall=wall, face="top")
    outer = outer_ring and standing_ring(*outer_ring, wall=wall)
    return bearing, around(bearing, inner, outer)


def bearing_of_scene(path: Path, name: str | None) -> FurtherBearing:
    """Return a rolling bearing of a scene, its first if no `name` is given.

    Those of a candidate are called by it and their place, ``two-spherical.N``, and come after those
    of ``[bearings]``. A scene that states no bearing at all has its default one. With a mounting a
    bearing has its clearance at the temperature of the section ``[friction]``.

    Raises
    ------
    loadflow.errors.InputError
        No such scene or bearing; journal bearings alone.
    """
    scene = read_scene(path)
    own = {
        f"{candidate}.{place}": part
        for candidate, one in scene.candidates.items()
        for place, part in one.bearings["rolling"].items()
    }
    stated = scene.rolling.bearings if "rolling" in scene.model_fields_set else {}
    bearings = stated | own
    if not bearings and (scene.candidates or "journal" in scene.model_fields_set):
        raise InputError(f"{path}: this scene states no rolling bearing")
    bearings = bearings or scene.rolling.bearings
    name = name or next(iter(bearings))
    if name not in bearings:
        raise InputError(f"{path}: no rolling bearing {name!r}; there are {', '.join(bearings)}")
    return as_stated(bearings[name], scene.friction)


def rolling_point(
    bearing: RollingBearing,
    rings: Rings,
    force: Load,
    moment: Load,
    *,
    speed: float | None = None,
    lubrication: Lubrication | None = None,
    inertia: bool = False,
) -> xr.Dataset:
    """Return what a bearing does under one `force` (N), `moment` (N m), turning at `speed` (rad/s).

    With a `lubrication`, the modified life of ISO 281 at that speed too; with `inertia`, under the
    inertia of its balls at that speed.

    Raises
    ------
    loadflow.errors.InputError
        A load that is not finite or that the bearing cannot take; a speed of 0; a lubrication
        without a speed, or with a film too thin for ISO 281.
    loadflow.errors.SolverError
        No equilibrium.
    """
    if speed is not None and not (math.isfinite(speed) and speed):
        raise InputError(f"speed: must be finite and not 0 for a life in hours, got {speed:g}")
    if inertia and speed is None:
        raise InputError("the inertia of the balls needs a speed: give --speed-rpm")
    r = bearing.equilibrium(force, moment, rings=rings, speed=speed if inertia else None)
    rows = {name: (getattr(r, name), units, meaning) for name, (units, meaning) in KEPT.items()}
    solver = {name: rows.pop(name) for name in ("converged", "residual", "iterations")}
    stiffness = np.diag(r.stiffness)
    rows |= _life(r, speed) | _modified(r, speed, lubrication)
    rows |= {
        "displacement": (r.displacement[:3], "m", "of the inner ring: x, y, z"),
        "tilt": (r.displacement[3:], "rad", "of the inner ring: about x, about y"),
        "radial_stiffness": (stiffness[:2], "N/m", "tangent: x, y"),
        "axial_stiffness": (stiffness[2], "N/m", "tangent: z"),
        "tilting_stiffness": (stiffness[3:], "N m/rad", "tangent: about x, about y"),
    }
    if isinstance(rings, FlexibleRings):
        for ring in ("inner", "outer"):
            if getattr(rings, ring) is not None:
                largest = np.linalg.norm(r.ring_displacement(ring), axis=-1).max()
                about = f"largest displacement of the {ring} ring's raceways"
                rows[f"{ring}_ring_displacement"] = (largest, "m", about)
    return quantities(rows | _edges(r) | _elements(r) | solver, model=_model(bearing, r, rings))


def rolling_coefficients(
    file: Path,
    bearing: RollingBearing,
    force: Load,
    moment: Load,
    speeds: tuple[float, float, int],
    oil: tuple[str, float] | None = None,
    loss: float = 0.01,
    whirl: float = 1.0,
) -> list[dict[str, float]]:
    """Write stiffness and damping over speed as a table for rotor dynamics; return its rows.

    Parameters
    ----------
    file : Path
        To write, ``.csv``; see `loadflow.journal.coefficient_table`. x and y are the radial axes of
        the bearing.
    force, moment : sequence of float
        N and N m.
    speeds : tuple
        First and last (rad/s), and how many.
    oil : tuple, optional
        Lubricant by name and temperature, K, of contacts with films; without it they are dry.
    loss : float
        Share of its stiffness that the steel loses.
    whirl : float
        Frequency of the vibration over the speed.

    Raises
    ------
    loadflow.errors.InputError
        As `loadflow.rolling.coefficients_over_speed`; the folder of the file is not there.
    loadflow.errors.SolverError
        No equilibrium.
    """
    if not 0 <= loss <= 1:
        raise InputError(f"--loss {loss:g}: must be within 0 … 1")
    options = oil and FrictionOptions(oil=lubricant(oil[0]), temperature=oil[1])
    result: Any = bearing.equilibrium(force, moment)
    told: dict[str, Any] = {"model": "film", "options": options} if options else {"model": "dry"}
    told |= {"loss": loss, "whirl": whirl}
    return written_coefficients(
        file, lambda: coefficients_over_speed(result, np.linspace(*speeds), **told)
    )


def _life(r: Any, speed: float | None) -> dict[str, tuple[Any, str, str]]:
    """Life, and what IEC 61400-1 asks of a main bearing; the life in hours only with a speed."""
    hours = math.nan if speed is None else float(life_hours(r.rating_life, speed))
    life, static = verdicts(hours, float(r.static_safety))
    rows: dict[str, tuple[Any, str, str]] = {
        "rating_life": (r.rating_life, "megarevolution", "basic rating life L10"),
        "static_rating_holds": (
            static.holds,
            "1",
            f"whether the static safety reaches {static.limit:g}, if these are design loads",
        ),
    }
    if speed is not None:
        rows["life_hours"] = (hours, "h", "basic rating life L10h at this load and speed")
        rows["life_holds"] = (life.holds, "1", "whether it reaches 20 years")
    if r.bearing.torque_models:
        rule = {"forces": "ball forces", "loads": "loads", "equivalent": "equivalent load"}
        about = f"friction torque, from the {rule[next(iter(r.bearing.torque_models))]}"
        rows["friction_torque"] = (r.friction_torque(), "N m", about)
    return rows


def _modified(
    r: Any, speed: float | None, lubrication: Lubrication | None
) -> dict[str, tuple[Any, str, str]]:
    """Modified life with what leads to it, and which limits act."""
    if lubrication is None:
        return {}
    if speed is None:
        raise InputError("the modified life needs a speed: give --speed-rpm")
    found = r.bearing.life_modification(r.equivalent_load, speed, lubrication)
    hours = found.factor * life_hours(r.rating_life, speed)
    return {
        "viscosity_ratio": (found.viscosity_ratio, "1", "viscosity ratio κ"),
        "contamination_factor": (found.contamination, "1", "contamination factor e_C"),
        "fatigue_limit": (found.fatigue_limit, "N", "fatigue load limit C_u"),
        "life_factor": (found.factor, "1", "life modification factor a_ISO"),
        "modified_life_hours": (hours, "h", "modified rating life, 90 % reliability"),
        "modified_life_holds": (hours >= HOURS_20_YEARS, "1", "whether it reaches 20 years"),
        "limits_of_life_factor": (
            [found.thick, found.capped],
            "1",
            "whether κ > 4 counts as 4, whether a_ISO stops at 50",
        ),
    }


def _edges(r: Any) -> dict[str, tuple[Any, str, str]]:
    """Pressure along the hardest pressed roller, where its slices do not stand by themselves.

    A roller tilts half as much as its rings: so much is its tilt in each raceway.
    """
    rows = r.bearing
    if not (isinstance(rows, RollerRaceways) and rows.slices > 1 and r.maximum_force > 0):
        return {}
    forces = np.moveaxis(r.slice_forces, -2, -1).reshape(-1, rows.slices)
    hardest = forces[np.argmax(forces.sum(axis=1))]
    pressed = hardest > 0
    approach = (hardest / rows.slice_stiffness) ** 0.9 + 2 * rows.profile_drop
    tilt = 0.0
    if pressed.sum() > 1:
        tilt = -0.5 * np.polyfit(rows.slice_positions[pressed], approach[pressed], 1)[0]
    found = edge_contact(rows, float(hardest.sum()), float(tilt))
    what = "of the hardest pressed roller on the inner ring"
    return {
        "edge_pressure": (found.maximum_pressure, "Pa", f"largest pressure {what}, with its edges"),
        "edge_factor": (
            found.edge_factor(),
            "1",
            f"of it at the ends over that between them, {what}",
        ),
    }


def _elements(r: Any) -> dict[str, tuple[Any, str, str]]:
    """Forces on all rolling elements."""
    order = ", ".join((*r.bearing.group_dims, r.bearing.element))
    if r.bearing.element == "ball":
        return {
            "ball_forces": (r.ball_forces, "N", f"contact forces ({order})"),
            "contact_angles": (r.contact_angles, "rad", f"contact angles ({order})"),
        }
    return {"roller_forces": (r.roller_forces, "N", f"forces on the rollers ({order})")}


def _model(bearing: RollingBearing, r: Any, rings: Rings) -> str:
    """What was solved, in words."""
    stiff = "rigid rings"
    if isinstance(rings, FlexibleRings):
        soft = [ring for ring in ("inner", "outer") if getattr(rings, ring) is not None]
        stiff = f"flexible {' and '.join(soft)} ring, {r.elements.modes.size - 5} modes"
    groups = " × ".join(str(size) for size in r.element_forces.shape)
    return f"{stiff}, {type(bearing).__name__}, {groups} {bearing.element} contacts"
