"""Reduced loads of one case → film of each journal bearing, at static equilibrium."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal import Equilibrium
from loadflow.scene import Journal, Scene
from loadflow.stages.cases import Case
from loadflow.stages.frames import to_film
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
            bearing: _bearing(scene, case, bearing, inputs["reduction"][bearing].to_dataset())
            for bearing in scene.journal.bearings
        }
    )


def _bearing(scene: Scene, case: Case, bearing: str, reduced: xr.Dataset) -> xr.Dataset:
    moment = reduced["moment"].values if scene.journal.tilt else None
    answer = equilibria(scene.journal, reduced["force"].values, reduced["speed"].values, moment)
    if not np.any(answer.converged):
        speed = np.abs(reduced["speed"].values)
        raise SolverError(
            f"bearing {bearing}: no film carries any of the {speed.size} samples; speed "
            f"{speed.min():.4g} … {speed.max():.4g} rad/s"
        )
    samples = film_samples(answer)
    samples["eccentricity"] = (
        ("sample", "component"),
        answer.eccentricity,
        {"units": "m", "long_name": "shaft centre: down, then left"},
    )
    if scene.journal.tilt:
        meaning = {"units": "rad", "long_name": "rotation of the shaft: about down, about left"}
        samples["tilt"] = ("sample", "component"), answer.tilt, meaning
    return (
        reduced[["time", "speed", "weight"]]
        .assign(samples)
        .assign_attrs(
            radial_clearance=scene.journal.geometry.clearance,
            laminar=int(np.all(answer.laminar)),
            largest_reynolds_number=float(np.max(answer.reynolds_number)),
        )
    )


def equilibria(
    options: Journal, force: np.ndarray, speed: np.ndarray, moment: np.ndarray | None = None
) -> Equilibrium:
    """Solve the film of a scene's bearing for `force` (n, 3) in the cube's frame, N.

    With a `moment` (n, 3), N m, the shaft tilts under it; without, it stays aligned.
    """
    return options.geometry.equilibrium(
        force=to_film(force),
        speed=speed,
        lubricant=options.lubricant,
        cavitation=options.cavitation,
        edge_pressure=options.edge_pressure,
        supply=options.supply,
        grid=options.grid,
        grading=options.grading,
        rung=options.rung,
        strict=False,
        moment=None if moment is None else to_film(moment),
    )


def film_samples(answer: Equilibrium) -> dict[str, Any]:
    """Label what is kept of a series of equilibria; dimension ``sample``."""
    return {
        name: ("sample", np.asarray(getattr(answer, name)), {"units": units, "long_name": meaning})
        for name, (units, meaning) in KEPT.items()
    }


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
        "largest_eccentricity_ratio": (samples["eccentricity_ratio"].max(), "largest ε"),
        "mean_eccentricity_ratio": (mean("eccentricity_ratio"), "mean ε"),
        "smallest_film": (samples["minimum_film"].min(), "smallest film"),
        "largest_pressure": (samples["maximum_pressure"].max(), "largest pressure"),
        "largest_sommerfeld_number": (samples["sommerfeld_number"].max(), "largest So"),
        "mean_sommerfeld_number": (mean("sommerfeld_number"), "mean So"),
        "mean_friction_power": (mean("friction_power"), "mean friction power"),
        "mean_side_flow": (mean("side_flow"), "mean side flow"),
        "mean_supply_flow": (mean("supply_flow"), "mean flow of the grooves"),
        "mean_supply_power": (mean("supply_power"), "mean supply power"),
        "largest_residual": (samples["residual"].max(), "largest residual"),
        "not_converged": ((~samples["converged"].astype(bool)).sum(), "samples without a film"),
    }
    units = {
        "smallest_film": "m",
        "largest_pressure": "Pa",
        "mean_friction_power": "W",
        "mean_side_flow": "m3/s",
        "mean_supply_flow": "m3/s",
        "mean_supply_power": "W",
    }
    return xr.Dataset(
        {
            name: value.assign_attrs(units=units.get(name, "1"), long_name=meaning)
            for name, (value, meaning) in found.items()
        }
    )
