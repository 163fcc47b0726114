"""Mean loads of a case → stiffness and damping of its films, and the shaft line's vibration."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal import coefficient_table, rotor_coefficients
from loadflow.quantities import load_cases
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.shaft import Concept, Disc, LineSupport, ShaftLine, modes, unbalance_response
from loadflow.shaft.beam import Beam, BearingSupport
from loadflow.stages.film_of_bearing import shaft_line
from loadflow.stages.film_support import TURN
from loadflow.stages.frames import to_film
from loadflow.stages.rolling_at_work import as_stated
from loadflow.stages.rolling_support import rolling_model
from loadflow.stages.stage import Stage, always
from loadflow.stages.summary import over_cases
from loadflow.turbines import load_turbine

Floats = np.ndarray

STEEL = 7850.0
"""Density of a shaft whose mass is not given, kg/m³."""

_SLOPES = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]], dtype=float)
"""From (x, y, x′, y′) of the shaft line to the displacements and rotations of the film."""

_AT_MEAN = ("stiffness", "damping", "eccentricity_ratio", "minimum_film")


def dynamics(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Tabulate the films of a case, one group per bearing, and each elastic suspension on them.

    Raises
    ------
    loadflow.errors.SolverError
        The shaft stands in the mean, or a film has no equilibrium at one of the speeds.
    """
    mean = inputs["shaft"].load().mean("time")
    speed = float(inputs["loads"]["speed"].mean())
    if speed == 0.0:
        raise SolverError("the shaft stands: no film has stiffness or damping")
    films = {name: _film(scene, name, mean, speed) for name in scene.journal.bearings}
    found = dict(films)
    for name, concept in scene.shaft.suspensions.items():
        if concept.beam is None or not set(concept.bearings) & set(films):
            continue
        found[name] = _vibration(scene, concept, films, mean, speed)
    return xr.DataTree.from_dict(found)


def _film(scene: Scene, name: str, mean: xr.Dataset, speed: float) -> xr.Dataset:
    options, asked = scene.journal.at(name), scene.dynamics
    shares = np.union1d(np.linspace(*asked.speed_range, asked.points), 1.0)
    here = mean.sel(bearing=name)
    force = here["force"].values.astype(float)
    line: dict[str, Any] = {key: to_film(value) for key, value in _line(options, here).items()}
    try:
        table = rotor_coefficients(
            options.geometry, to_film(force), speed * shares, options.film_model, **line
        )
    except SolverError as error:
        raise SolverError(f"bearing {name}: {error}") from error
    return table.assign_attrs(mean_speed=speed)


def _line(options: Journal, here: xr.Dataset) -> dict[str, Floats]:
    return shaft_line(options, here.expand_dims("sample")) if options.tilt else {}


def _vibration(
    scene: Scene, concept: Concept, films: Mapping[str, xr.Dataset], mean: xr.Dataset, speed: float
) -> xr.Dataset:
    """Modes at the mean speed, and the response to unbalance over the range of speed."""
    line, asked = _shaft_of(scene, concept), scene.dynamics
    found = modes(line, _supports(scene, concept, films, mean, speed), speed, count=asked.modes)
    if asked.unbalance == 0.0:
        return found
    name = next(name for name in concept.bearings if name in films)
    out = unbalance_response(
        line,
        lambda w: _supports(scene, concept, films, mean, w),
        films[name]["speed"].values,
        asked.unbalance,
    )
    worst = out.attrs["residual"]
    return found.merge(out, combine_attrs="drop_conflicts").assign_attrs(
        found.attrs, unbalance_residual=worst
    )


def _shaft_of(scene: Scene, concept: Concept) -> ShaftLine:
    """Shaft, rotor and what else turns on it."""
    turbine, beam = load_turbine(scene.turbine.name), concept.beam
    assert beam is not None
    blade, rotor = turbine.blade, turbine.rotor
    radius = rotor.hub_radius + blade.span
    share = np.trapezoid(blade.mass_density * radius**2, blade.span)
    share /= np.trapezoid(blade.mass_density, blade.span)
    polar = rotor.hub_inertia + rotor.blades * blade.mass * float(share)
    (_, shaft_mass), *others = concept.masses
    discs = [Disc(0.0, turbine.rotor_mass, polar, polar / 2)]
    discs += [Disc(place, mass) for place, mass in others if mass > 0]
    end = max(*concept.positions, *(disc.position for disc in discs), 0.0)
    return ShaftLine(beam, end, tuple(discs), _density(beam, end, shaft_mass))


def _density(beam: Beam, end: float, mass: float) -> float:
    volume = sum((stop - start) * section.area for start, stop, section in beam.stretches(end))
    return mass / volume if mass > 0 else STEEL


def _supports(
    scene: Scene, concept: Concept, films: Mapping[str, xr.Dataset], mean: xr.Dataset, speed: float
) -> list[LineSupport]:
    """What carries the shaft at a speed: films, rolling bearings, given stiffness, or rigid."""
    assert concept.beam is not None
    supports = []
    for name, position, support in zip(
        concept.bearings, concept.positions, concept.beam.supports_of(len(concept.bearings))
    ):
        housing = (support.housing_vertical, support.housing_lateral)
        if name in films:
            # exact at the speeds that are tabulated, which are all that are asked for
            at = films[name].sel(speed=speed, method="nearest")
            size = at["stiffness"].shape[0]
            turn = _SLOPES[:size, :size]
            k, c = (turn.T @ at[part].values @ turn for part in ("stiffness", "damping"))
            supports.append(LineSupport(position, k, c, housing))
        elif (k := _stiffness(scene, name, support, mean)) is not None:
            supports.append(LineSupport(position, k, None, housing))
        elif support.takes_moment and support.tilt is None:
            raise SolverError(
                f"bearing {name}: rigid against tilting; a shaft line needs the numbers of its tilt"
            )
        else:
            supports.append(LineSupport(position))
    return supports


def _stiffness(scene: Scene, name: str, support: BearingSupport, mean: xr.Dataset) -> Floats | None:
    """Of a bearing without a film; None if it is rigid."""
    if support.stiffness == "rolling":
        force, moment = (
            mean[part].sel(bearing=name).values[None].astype(float) for part in ("force", "moment")
        )
        part = as_stated(scene.rolling.bearings[name], scene.friction)
        model = rolling_model(part, force[:, 0], tilting=support.takes_moment)
        stiff = model(force, moment)[1][0]
        size = len(stiff)
        turn = TURN[:size, :size]
        own = _SLOPES[:size, :size]
        return np.asarray(own.T @ turn @ stiff @ turn.T @ own)
    if support.radial is None:
        return None
    diagonal = [support.radial, support.radial]
    if support.takes_moment:
        if support.tilt is None:
            return None
        diagonal += [support.tilt, support.tilt]
    return np.diag(diagonal)


def summary(parts: Mapping[Case, xr.DataTree]) -> xr.Dataset:
    """Films at the mean speed (bearing, …, case); modes (suspension, mode, case)."""
    return over_cases({case: _of_case(tree) for case, tree in parts.items()})


def _of_case(tree: xr.DataTree) -> xr.Dataset:
    nodes = {name: node.to_dataset().load() for name, node in tree.children.items()}
    films = {name: node for name, node in nodes.items() if "stiffness" in node}
    lines = {name: node for name, node in nodes.items() if "natural_frequency" in node}
    speed = float(next(iter(films.values())).attrs["mean_speed"])
    at_mean = [
        node[list(_AT_MEAN)].sel(speed=speed, method="nearest").drop_vars("speed")
        for node in films.values()
    ]
    found = xr.concat(at_mean, "bearing", combine_attrs="drop_conflicts").assign_coords(
        bearing=list(films)
    )
    found = found.assign(mean_speed=((), speed, {"units": "rad/s", "long_name": "mean speed"}))
    if not lines:
        return found
    modal = [_modal(node) for node in lines.values()]
    joined = xr.concat(modal, "suspension", combine_attrs="drop_conflicts")
    return found.merge(joined.assign_coords(suspension=list(lines)))


def _modal(node: xr.Dataset) -> xr.Dataset:
    kept = ["natural_frequency", "damped_frequency", "damping_ratio", "forward", "residual"]
    growth = {"units": "1/s", "long_name": "largest real part of all roots; > 0: unstable"}
    found = node[kept].assign(largest_growth=((), node.attrs["largest_growth"], growth))
    if "amplitude" not in node:
        return found
    size = node["amplitude"].max(("place", "speed"))
    about = {"units": "m", "long_name": "largest half axis of the orbit under unbalance"}
    return found.assign(unbalance_amplitude=((), float(size), about))


def tables(case: Case, tree: xr.DataTree) -> dict[str, str]:
    """Stiffness and damping of each film as a table for rotor dynamics, by the name of its file."""
    return {
        f"coefficients/{case.name}_{name}.csv": coefficient_table(node.to_dataset())
        for name, node in tree.children.items()
        if "stiffness" in node
    }


def warnings(tree: xr.DataTree) -> list[str]:
    """Say which load cases have a shaft line that is unstable in its films."""
    if "dynamics" not in tree.children:
        return []
    found = tree["dynamics"].to_dataset()
    if "largest_growth" not in found:
        return []
    grows = (found["largest_growth"] > 0).any("suspension")
    names = [str(name) for name in found["case"].values[grows.values]]
    if not names:
        return []
    return [
        f"dynamics: the shaft line is unstable in its films in {load_cases(len(names))}, "
        f"{names[0]} among them: its whirl grows until the film stops it"
    ]


STAGE = Stage(
    "dynamics",
    run=dynamics,
    results={"journal.dynamics": lambda scene: {}},
    needs=always("loads", "shaft"),
    sections=lambda scene: ("journal", "shaft", "turbine", "rolling", "dynamics"),
    summarise=summary,
    exports=tables,
    warnings=warnings,
    work=lambda scene, cases, measured: None,
)
