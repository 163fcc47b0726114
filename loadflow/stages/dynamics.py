"""Mean loads of a case → stiffness and damping of its bearings, and the shaft line's vibration."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from loadflow.errors import SolverError
from loadflow.journal import coefficient_table, rotor_coefficients
from loadflow.quantities import load_cases
from loadflow.rolling import coefficients_over_speed
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cases import Case
from loadflow.scene.dynamics import OF_FILMS, OF_ROLLING, turning
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.shaft import Concept, Disc, LineSupport, ShaftLine, modes, unbalance_response
from loadflow.shaft.beam import Beam, BearingSupport
from loadflow.stages.films.of_bearing import shaft_line
from loadflow.stages.films.support import TURN
from loadflow.stages.frames import to_film
from loadflow.stages.rolling_at_work import as_stated, friction_options, rest
from loadflow.stages.rolling_support import rolling_model
from loadflow.stages.stage import Rungs, Stage, always
from loadflow.stages.summary import over_cases
from loadflow.turbines import load_turbine

Floats = np.ndarray

_LOADS = ("force", "moment")

STEEL = 7850.0
"""Density of a shaft whose mass is not given, kg/m³."""

_SLOPES = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]], dtype=float)
"""From (x, y, x′, y′) of the shaft line to the displacements and rotations of the film."""

_AT_MEAN = ("stiffness", "damping", "eccentricity_ratio", "minimum_film")

At = Callable[[float, float], xr.Dataset]
"""Speed of the shaft and frequency of the vibration, rad/s → stiffness and damping of a bearing."""


def dynamics(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Tabulate the bearings of a case, one group each, and each elastic suspension on them.

    Raises
    ------
    loadflow.errors.SolverError
        The shaft stands in the mean, or a bearing has no equilibrium at one of the speeds.
    """
    mean = inputs["shaft"].load().mean("time")
    speed = float(inputs["loads"]["speed"].mean())
    if speed == 0.0:
        raise SolverError("the shaft stands: no bearing has stiffness or damping")
    speeds = speed * np.union1d(
        np.linspace(*scene.dynamics.speed_range, scene.dynamics.points), 1.0
    )
    whirl = scene.dynamics.whirl_of_tables
    tables: dict[str, xr.Dataset] = {}
    follow: dict[str, At] = {}
    for name in _films_of(scene):
        film = _film(scene, name, mean)
        tables[name] = film(speeds, whirl)
        if scene.journal.at(name).geometry.has_pads:
            follow[name] = partial(_at_frequency, film)
    for name, part in _rolling_of(scene).items():
        at = _rolling(scene, part, mean)
        tables[name] = _over(at, speeds, whirl).assign(_loads(mean, name))
        if scene.dynamics.rolling_follows:
            follow[name] = at
    bearings = _Bearings(tables, follow, whirl)
    found = {name: table.assign_attrs(mean_speed=speed) for name, table in tables.items()}
    for name, concept in scene.shaft.suspensions.items():
        if concept.beam is None or not set(concept.bearings) & set(found):
            continue
        found[name] = _vibration(scene, concept, bearings, mean, speed)
    return xr.DataTree.from_dict(found)


@dataclass(frozen=True)
class _Bearings:
    """Tables of all bearings over speed, of vibration at `whirl` of it; those that depend on the
    frequency by themselves.
    """

    tables: Mapping[str, xr.Dataset]
    follow: Mapping[str, At]
    whirl: float

    def at(self, name: str, speed: float, frequency: float) -> tuple[Floats, Floats]:
        """Stiffness and damping in the coordinates of the shaft line."""
        if name in self.follow and frequency != self.whirl * abs(speed):
            table = self.follow[name](speed, frequency)
        else:
            # exact at the speeds that are tabulated, which are all that are asked for
            table = self.tables[name].sel(speed=speed, method="nearest")
        size = table["stiffness"].shape[0]
        turn = _SLOPES[:size, :size]
        k, c = (turn.T @ table[part].values @ turn for part in ("stiffness", "damping"))
        return k, c


def _films_of(scene: Scene) -> list[str]:
    """Journal bearings that are tabulated: all, or those that the shaft feels beside rollers."""
    if OF_FILMS in scene.results:
        return scene.journal.bearings
    return [name for name, one in scene.shaft.coupled.items() if one.stiffness == "journal"]


def _rolling_of(scene: Scene) -> dict[str, FurtherBearing]:
    """Rolling bearings that are tabulated."""
    return turning(scene.rolling, scene.shaft) if OF_ROLLING in scene.results else {}


def _film(scene: Scene, name: str, mean: xr.Dataset) -> Callable[[ArrayLike, float], xr.Dataset]:
    """Speeds and share of the vibration in them → stiffness and damping of a film."""
    options = scene.journal.at(name)
    here = mean.sel(bearing=name)
    force = here["force"].values.astype(float)
    line: dict[str, Any] = {key: to_film(value) for key, value in _line(options, here).items()}

    def over(speeds: ArrayLike, whirl: float) -> xr.Dataset:
        try:
            return rotor_coefficients(
                options.geometry, to_film(force), speeds, options.film_model, whirl=whirl, **line
            )
        except SolverError as error:
            raise SolverError(f"bearing {name}: {error}") from error

    return over


def _at_frequency(
    film: Callable[[ArrayLike, float], xr.Dataset], speed: float, frequency: float
) -> xr.Dataset:
    return film([speed], abs(frequency / speed)).isel(speed=0)


def _rolling(scene: Scene, part: FurtherBearing, mean: xr.Dataset) -> At:
    """Stiffness and damping of a rolling bearing under its mean load, in the axes of a film.

    Where its support takes the moment its rotations count, too; else it tilts freely.
    """
    name, asked = part.bearing, scene.dynamics
    load, moment = (mean[what].sel(bearing=name).values.astype(float) for what in _LOADS)
    tilting = _takes_moment(scene, name) and part.geometry.takes_moment
    warm = as_stated(part, scene.friction).model_copy(update={"rings": "rigid"})
    try:
        result = rest(warm, load, moment * tilting)
    except SolverError as error:
        raise SolverError(f"bearing {name}: {error}") from error
    options = friction_options(scene.friction.of(part), warm.modelled)

    def at(speed: float, frequency: float) -> xr.Dataset:
        table = coefficients_over_speed(
            result, speed, whirl=abs(frequency / speed), tilt="kept" if tilting else "free",
            options=options, model=asked.contact_model, loss=asked.loss,
            time_constant=asked.time_constant,
        ).isel(speed=0)  # fmt: skip
        size = table["stiffness"].shape[0]
        turn = TURN[:size, :size]
        turned = {
            what: table[what].copy(data=turn @ table[what].values @ turn.T)
            for what in ("stiffness", "damping")
        }
        return table.assign(turned)

    return at


def _over(at: At, speeds: Floats, whirl: float) -> xr.Dataset:
    """Over the speed, of a vibration at a share of it."""
    rows = [at(float(speed), whirl * abs(float(speed))) for speed in speeds]
    return xr.concat(rows, "speed", combine_attrs="override")


def _loads(mean: xr.Dataset, name: str) -> dict[str, Any]:
    """The mean force across the shaft, in the axes of a film."""
    force = to_film(mean["force"].sel(bearing=name).values.astype(float))
    return {"force": ("axis", force, {"units": "N", "long_name": "mean force on the bearing"})}


def _takes_moment(scene: Scene, name: str) -> bool:
    """Whether the support of a bearing takes the moment of the shaft."""
    concept = scene.shaft.concept_at(name)
    assert concept is not None
    if concept.beam is None:
        return len(concept.bearings) == 1
    supports = concept.beam.supports_of(len(concept.bearings))
    return supports[concept.bearings.index(name)].takes_moment


def _line(options: Journal, here: xr.Dataset) -> dict[str, Floats]:
    return shaft_line(options, here.expand_dims("sample")) if options.tilt else {}


def _vibration(
    scene: Scene, concept: Concept, bearings: _Bearings, mean: xr.Dataset, speed: float
) -> xr.Dataset:
    """Modes at the mean speed, and the response to unbalance over the range of speed."""
    line, asked = _shaft_of(scene, concept), scene.dynamics

    def supports(speed: float, frequency: float) -> list[LineSupport]:
        return _supports(scene, concept, bearings, mean, speed, frequency)

    vibration = bearings.whirl * abs(speed)
    carried: Sequence[LineSupport] | Callable[[float], Sequence[LineSupport]]
    carried = supports(speed, vibration)
    if asked.whirl == "own" and set(concept.bearings) & bearings.follow.keys():
        carried = partial(supports, speed)
    found = modes(line, carried, speed, count=asked.modes)
    swing = found["natural_frequency"]
    taken = swing if asked.whirl == "own" else xr.full_like(swing, vibration)
    found["vibration_frequency"] = taken.assign_attrs(
        long_name="frequency of vibration to which stiffness and damping of the bearings belong"
    )
    if asked.unbalance == 0.0:
        return found
    name = next(name for name in concept.bearings if name in bearings.tables)
    speeds = bearings.tables[name]["speed"].values
    out = unbalance_response(
        line, lambda speed: supports(speed, abs(speed)), speeds, asked.unbalance
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
    scene: Scene,
    concept: Concept,
    bearings: _Bearings,
    mean: xr.Dataset,
    speed: float,
    frequency: float,
) -> list[LineSupport]:
    """What carries a shaft that vibrates: films, rolling bearings, given stiffness, or rigid."""
    assert concept.beam is not None
    supports = []
    for name, position, support in zip(
        concept.bearings, concept.positions, concept.beam.supports_of(len(concept.bearings))
    ):
        housing = (support.housing_vertical, support.housing_lateral)
        if name in bearings.tables:
            k, c = bearings.at(name, speed, frequency)
            supports.append(LineSupport(position, k, c, housing))
        elif (own := _stiffness(scene, name, support, mean)) is not None:
            supports.append(LineSupport(position, own, None, housing))
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
    """Bearings at the mean speed (bearing, …, case); modes (suspension, mode, case)."""
    return over_cases({case: _of_case(tree) for case, tree in parts.items()})


def _of_case(tree: xr.DataTree) -> xr.Dataset:
    nodes = {name: node.to_dataset().load() for name, node in tree.children.items()}
    films = {name: node for name, node in nodes.items() if "stiffness" in node}
    lines = {name: node for name, node in nodes.items() if "natural_frequency" in node}
    speed = float(next(iter(films.values())).attrs["mean_speed"])
    at_mean = [
        node[[name for name in _AT_MEAN if name in node]]
        .sel(speed=speed, method="nearest")
        .drop_vars("speed")
        for node in films.values()
    ]
    found = xr.concat(
        at_mean, "bearing", data_vars="all", join="outer", combine_attrs="drop_conflicts"
    ).assign_coords(bearing=list(films))
    whirl = next(iter(films.values())).attrs["whirl"]
    about = "frequency of vibration over speed to which stiffness and damping belong"
    found = found.assign(
        mean_speed=((), speed, {"units": "rad/s", "long_name": "mean speed"}),
        whirl=((), whirl, {"units": "1", "long_name": about}),
    )
    if not lines:
        return found
    modal = [_modal(node) for node in lines.values()]
    joined = xr.concat(modal, "suspension", combine_attrs="drop_conflicts")
    return found.merge(joined.assign_coords(suspension=list(lines)))


def _modal(node: xr.Dataset) -> xr.Dataset:
    kept = ["natural_frequency", "damped_frequency", "damping_ratio", "forward", "residual"]
    kept += ["vibration_frequency"]
    growth = {"units": "1/s", "long_name": "largest real part of all roots; > 0: unstable"}
    found = node[kept].assign(largest_growth=((), node.attrs["largest_growth"], growth))
    if "amplitude" not in node:
        return found
    size = node["amplitude"].max(("place", "speed"))
    about = {"units": "m", "long_name": "largest half axis of the orbit under unbalance"}
    return found.assign(unbalance_amplitude=((), float(size), about))


def tables(case: Case, tree: xr.DataTree) -> dict[str, str]:
    """Stiffness and damping of each bearing as a table for rotor dynamics, by its file's name.

    The columns are those of ROSS, so that the name says of which vibration they are where it is not
    that of the speed.
    """
    bearings = {name: node for name, node in tree.children.items() if "stiffness" in node}
    return {
        f"coefficients/{case.name}_{name}{_share(node.attrs['whirl'])}.csv": coefficient_table(
            node.to_dataset()
        )
        for name, node in bearings.items()
    }


def _share(whirl: float) -> str:
    return "" if whirl == 1.0 else f"_whirl_{whirl:g}"


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
        f"dynamics: the shaft line is unstable on its bearings in {load_cases(len(names))}, "
        f"{names[0]} among them: its whirl grows until the films stop it"
    ]


def _model(scene: Scene) -> str:
    """Of which vibration stiffness and damping are, in words."""
    if scene.dynamics.whirl == "own":
        return "K, C of each mode at its own frequency"
    return f"K, C of vibration at {scene.dynamics.whirl:g} of the speed"


STAGE = Stage(
    "dynamics",
    run=dynamics,
    models=(
        Rungs("dynamics", section="dynamics", key=lambda s: "-", text=_model, exact=lambda s: True),
    ),
    results={OF_FILMS: lambda scene: {}, OF_ROLLING: lambda scene: {}},
    needs=always("loads", "shaft"),
    sections=lambda scene: (
        *("journal", "shaft", "turbine", "rolling", "friction", "dynamics", "results"),
    ),
    summarise=summary,
    exports=tables,
    warnings=warnings,
    work=lambda scene, cases, measured: None,
)
