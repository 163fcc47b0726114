"""Loads of one case → film of each journal bearing, at static equilibrium or in motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal import Equilibrium, Heat, JournalBearing, Lubricant, warm_equilibrium
from loadflow.journal.shapes import CYLINDER
from loadflow.journal.validity import critical_reynolds_number, reynolds_number
from loadflow.scene.cases import Case
from loadflow.scene.scene import Journal, Scene
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import label, labelled, of_samples
from loadflow.stages.reduction import kept_share
from loadflow.stages.stage import Link, Links, Measured, Rungs, Stage, load_links, steps_of
from loadflow.stages.summary import over_cases

# what is kept of every sample: units and meaning
KEPT = {
    "eccentricity_ratio": ("1", "eccentricity ratio"),
    "attitude_angle": ("rad", "attitude angle"),
    "minimum_film": ("m", "smallest film thickness"),
    "maximum_pressure": ("Pa", "largest film pressure, absolute"),
    "sommerfeld_number": ("1", "Sommerfeld number"),
    "friction_power": ("W", "friction power"),
    "side_flow": ("m3/s", "side flow"),
    "supply_flow": ("m3/s", "flow of the grooves into the film"),
    "supply_power": ("W", "power that lifts the oil to supply pressure"),
    "converged": ("1", "whether the equilibrium was found"),
    "residual": ("1", "scaled residual of film and load"),
    "iterations": ("1", "iterations"),
}
WARM = {"temperature": ("K", "effective temperature of the film")}
"""What is kept too where there is a heat balance."""

TEMPERED = 64
"""Samples of a series whose mean friction and flow give the temperature of a film in motion."""
GIVING = {"shell_deformation": ("m", "largest growth of the gap by the give of the shell")}
"""What is kept too of an elastic shell."""


def film(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Solve the film for every sample of the reduced series; one group per bearing.

    A sample that no film carries, such as a load at standstill, has ``converged`` 0 and no values:
    a start-up passes through such samples, and the rest of it still has an answer.

    Raises
    ------
    loadflow.errors.SolverError
        No sample at all has an equilibrium.
    """
    return xr.DataTree.from_dict(
        {
            bearing: _resting(scene.journal, bearing, inputs["reduction"][bearing].to_dataset())
            for bearing in scene.journal.bearings
        }
    )


def orbit(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Follow the shaft through every step of the series; one group per bearing.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, or a step without an answer.
    """
    loads, shaft = inputs["loads"].load(), inputs["shaft"].load()
    return xr.DataTree.from_dict(
        {
            bearing: _moving(scene.journal, bearing, loads, shaft.sel(bearing=bearing))
            for bearing in scene.journal.bearings
        }
    )


def _resting(options: Journal, bearing: str, reduced: xr.Dataset) -> xr.Dataset:
    speed = reduced["speed"].values
    answer = equilibria(options, reduced["force"].values, speed, **shaft_line(options, reduced))
    if not np.any(answer.converged):
        raise SolverError(
            f"bearing {bearing}: no film carries any of the {speed.size} samples; speed "
            f"{np.abs(speed).min():.4g} … {np.abs(speed).max():.4g} rad/s"
        )
    samples = of_samples(vars(answer), _kept(options))
    if options.tilt:
        meaning = label("rad", "rotation of the shaft: about down, about left")
        samples["tilt"] = ("sample", "component"), answer.tilt, meaning
    given = reduced[["time", "speed", "weight"]]
    return _placed(options, given.assign(samples), answer.eccentricity)


def _moving(options: Journal, bearing: str, loads: xr.Dataset, reactions: xr.Dataset) -> xr.Dataset:
    force = to_film(reactions["force"].transpose("time", "axis").values.astype(float))
    time, speed = (loads[name].values.astype(float) for name in ("time", "speed"))
    try:
        path = follow(options, loads, reactions)
    except SolverError as error:
        raise SolverError(f"bearing {bearing}: {error}") from error
    held = options
    if options.heat is not None:
        held = options.at_temperature(float(path["temperature"][0]))
    numbers = [
        options.geometry.sommerfeld_number(*point, held.lubricant.viscosity)
        for point in zip(np.hypot(*force.T).tolist(), speed.tolist())
    ]
    kept = _kept(options)
    found: dict[str, Any] = {name: path[name].values for name in kept if name in path}
    found |= {"sommerfeld_number": numbers, "converged": np.ones(time.size, dtype=bool)}
    samples = xr.Dataset(
        {
            "time": ("sample", time, label("s", "time")),
            "speed": ("sample", speed, label("rad/s", "rotor speed")),
            "weight": ("sample", np.ones(time.size), label("1", "samples")),
        }
    )
    labels = of_samples(found, kept)
    return _placed(held, samples.assign(labels), path["eccentricity"].values)


def mean_temperature(options: Journal, force: np.ndarray, speed: np.ndarray) -> float | None:
    """Temperature (K) of a film in motion under `force` (n, 2) in its frame; None without heat.

    It is that of the mean friction and flow of `TEMPERED` equilibria spread over the series.

    Raises
    ------
    loadflow.errors.SolverError
        No heat balance below the largest temperature.
    """
    if options.heat is None:
        return None
    some = np.unique(np.linspace(0, speed.size - 1, TEMPERED).round().astype(int))
    film = {name: value for name, value in options.film.items() if name != "lubricant"}
    warm = warm_equilibrium(
        options.geometry,
        force[some],
        speed[some],
        options.heat,
        weights=np.ones(some.size),
        strict=False,
        **film,
    )
    if not np.any(warm.film.converged):
        raise SolverError("orbit cannot start: no heat balance of its mean friction and flow")
    return float(warm.temperature[0])


def _kept(options: Journal) -> dict[str, tuple[str, str]]:
    """What is kept of every sample of a scene's bearing."""
    giving = GIVING if options.shell is not None else {}
    return KEPT | giving | (WARM if options.heat is not None else {})


def follow(
    options: Journal, loads: xr.Dataset, bearing: xr.Dataset, start: np.ndarray | None = None
) -> xr.Dataset:
    """Follow the shaft through a series, from equilibrium or from the place `start` (2,), m.

    A heat balance gives the whole series one `temperature`, which the result has then.
    """
    force, moment = (
        to_film(bearing[name].transpose("time", "axis").values.astype(float))
        for name in ("force", "moment")
    )
    time, speed = (loads[name].values.astype(float) for name in ("time", "speed"))
    freeing = moment if options.tilt else None
    temperature = mean_temperature(options, force, speed)
    film = (options if temperature is None else options.at_temperature(temperature)).film
    path = options.geometry.orbit(time, force, speed, moment=freeing, start=start, **film)
    if temperature is None:
        return path
    return path.assign(temperature=("time", np.full(time.size, temperature)))


def shaft_line(options: Journal, bearing: xr.Dataset) -> dict[str, np.ndarray]:
    """How the shaft lies in the bearing: as its beam says, or free under a moment, or aligned.

    Keywords of `equilibria`, each (n, 3), from a series of loads with a last dimension ``axis``.
    """
    if not options.tilt:
        return {}
    names = {"moment": "moment"}
    if "tilt" in bearing and bool(bearing["tilt"].notnull().all()):
        names = {"tilt": "tilt", "bend": "curvature"}
    return {
        key: bearing[name].transpose(..., "axis").values.astype(float)
        for key, name in names.items()
    }


def equilibria(
    options: Journal, force: np.ndarray, speed: np.ndarray, **line: np.ndarray
) -> Equilibrium:
    """Solve the film of a scene's bearing for `force` (n, 3) in the cube's frame, N.

    With a `moment` (n, 3), N m, the shaft tilts under it; with a `tilt` (n, 3), rad, and a `bend`,
    1/m, it lies as they say; without, it stays aligned.
    """
    film = options.film | {name: to_film(vectors) for name, vectors in line.items()}
    oil = film.pop("lubricant")
    return rest(options.geometry, to_film(force), speed, options.heat or oil, strict=False, **film)


def rest(
    bearing: JournalBearing,
    force: np.ndarray,
    speed: np.ndarray | float,
    oil: Lubricant | Heat,
    **film: Any,
) -> Equilibrium:
    """Equilibrium with oil of one viscosity, or with that which its heat balance leaves."""
    if isinstance(oil, Heat):
        return warm_equilibrium(bearing, force, speed, oil, **film).film
    return bearing.equilibrium(force, speed, oil, **film)


def _placed(options: Journal, samples: xr.Dataset, eccentricity: np.ndarray) -> xr.Dataset:
    meaning = label("m", "shaft centre: down, then left")
    bearing = options.geometry
    fastest, oil = float(np.abs(samples["speed"]).max()), options.lubricant
    if options.heat is not None:
        oil = options.heat.lubricant(float(samples["temperature"].max()))
    reynolds = float(reynolds_number(bearing, fastest, oil))
    return samples.assign(
        eccentricity=(("sample", "component"), eccentricity, meaning)
    ).assign_attrs(
        motion=options.motion,
        radial_clearance=bearing.clearance,
        laminar=int(reynolds < critical_reynolds_number(bearing.relative_clearance)),
        largest_reynolds_number=reynolds,
    )


def summary(parts: Mapping[Case, xr.DataTree]) -> xr.Dataset:
    """Reduce each case to extremes and weighted means; dimensions ``bearing`` and ``case``."""
    return over_cases({case: _summary_of(tree) for case, tree in parts.items()})


def _summary_of(tree: xr.DataTree) -> xr.Dataset:
    parts = [extremes(node.to_dataset()) for node in tree.children.values()]
    return xr.concat(parts, "bearing", combine_attrs="override").assign_coords(
        bearing=list(tree.children)
    )


def extremes(samples: xr.Dataset) -> xr.Dataset:
    """Reduce the film of a series of weighted loads to extremes and means."""
    weight = samples["weight"]

    def mean(name: str) -> xr.DataArray:
        return samples[name].weighted(weight).mean()

    found = {
        "largest_eccentricity_ratio": (samples["eccentricity_ratio"].max(), "1", "largest ε"),
        "mean_eccentricity_ratio": (mean("eccentricity_ratio"), "1", "mean ε"),
        "smallest_film": (samples["minimum_film"].min(), "m", "smallest film"),
        "largest_pressure": (samples["maximum_pressure"].max(), "Pa", "largest pressure"),
        "largest_sommerfeld_number": (samples["sommerfeld_number"].max(), "1", "largest So"),
        "mean_sommerfeld_number": (mean("sommerfeld_number"), "1", "mean So"),
        "mean_friction_power": (mean("friction_power"), "W", "mean friction power"),
        "mean_side_flow": (mean("side_flow"), "m3/s", "mean side flow"),
        "mean_supply_flow": (mean("supply_flow"), "m3/s", "mean flow of the grooves"),
        "mean_supply_power": (mean("supply_power"), "W", "mean supply power"),
        "largest_residual": (samples["residual"].max(), "1", "largest residual"),
        "not_converged": (
            (~samples["converged"].astype(bool)).sum(),
            "1",
            "samples without a film",
        ),
    }
    if "temperature" in samples:
        largest = samples["temperature"].max()
        found["largest_temperature"] = (largest, "K", "largest effective temperature")
    return labelled(found)


FINEST_GRID = 480
"""Cells around that a run goes up to by itself."""


def film_key(scene: Scene) -> str:
    """Name of the film in the ladder."""
    journal = scene.journal
    around, across = journal.grid
    graded = ", graded" if journal.grading == "graded" else ""
    elastic = ", elastic" if journal.shell is not None else ""
    names = {"grid": f"grid, {around}x{across}{graded}{elastic}", "reduced": f"reduced, {around}"}
    return names.get(journal.rung, journal.rung)


def warm_films(options: Journal) -> float:
    """Time of a film with its heat balance over that of an isothermal one; see docs/journal.md."""
    return 7.0 if options.heat is not None and not options.in_motion else 1.0


def fast_film(journal: Journal) -> Journal | None:
    """The bearing with the film that is fast over a long series; None where it does not fit."""
    bearing = journal.geometry
    cylinder = bearing.shape == CYLINDER and not bearing.relief
    rigid = cylinder and journal.shell is None
    if rigid and journal.supply is None and journal.grading != "graded":
        return journal.model_copy(update={"rung": "reduced"})
    return None


def _finer_grid(scene: Scene) -> dict[str, Any]:
    """A film has no top: its grid is doubled, up to what a scene may ask for.

    One in motion stays on the rung "reduced", which is nearest to the truth for its time.
    """
    journal = scene.journal
    around, across = journal.grid
    if 2 * around > FINEST_GRID:
        return {}
    if journal.in_motion and journal.rung == "reduced":
        return {"grid": (2 * around, across)}
    return {"rung": "grid", "grid": (2 * around, 2 * across)}


def _links(scene: Scene) -> Links:
    """A film in motion reads the whole series, the others the reduced one."""
    ends = {
        "eccentricity ratio": "E_max",
        "minimum film": "h_min",
        "maximum pressure": "p_max",
        "friction power": "friction power",
    }
    return {
        quantity: (
            *load_links("bearing load max"),
            *(() if scene.journal.in_motion else (Link("reduction", end),)),
            Link("journal", quantity),
        )
        for quantity, end in ends.items()
    }


def _work(scene: Scene, cases: tuple[Case, ...], measured: Measured) -> float:
    share = 1.0 if scene.journal.in_motion else kept_share(scene, measured)
    films = share * len(scene.journal.bearings) * steps_of(cases)
    return films * warm_films(scene.journal)


FILM = Rungs(
    "journal",
    section="journal",
    key=film_key,
    table=lambda scene: "journal, transient" if scene.journal.in_motion else "journal",
    better=_finer_grid,
)

STAGE = Stage(
    "journal",
    run=lambda scene, case, inputs: (orbit if scene.journal.in_motion else film)(
        scene, case, inputs
    ),
    results={"journal.film": _links},
    needs=lambda scene: ("loads", "shaft") if scene.journal.in_motion else ("reduction",),
    sections=lambda scene: ("journal",),
    models=(FILM,),
    summarise=summary,
    work=_work,
)
