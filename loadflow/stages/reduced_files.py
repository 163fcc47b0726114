"""Load cube → reduced series as parameter files, one for each case and bearing, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases
from loadflow.errors import InputError
from loadflow.reduction import histogram, write_parameter_file
from loadflow.report import Picture, Section, Table, figures, write_page
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.stages.frames import to_film
from loadflow.stages.reduction import reduced_dataset

HEADS = (
    "case",
    "bearing",
    "samples",
    "kept",
    "largest F, kN",
    "kept, kN",
    "mean F, kN",
    "kept, weighted, kN",
    "file",
)


@dataclass(frozen=True)
class Part:
    """One case of one bearing, reduced.

    Attributes
    ----------
    case, bearing : str
        Which.
    file : Path
        Its parameter file.
    samples, kept : int
        Length of the full and of the reduced series.
    largest, mean : tuple of float
        Radial force of the full and of the reduced series (weighted), N.
    series : xarray.Dataset
        The reduced series with its histograms.
    """

    case: str
    bearing: str
    file: Path
    samples: int
    kept: int
    largest: tuple[float, float]
    mean: tuple[float, float]
    series: xr.Dataset

    def as_dict(self) -> dict[str, Any]:
        """The part in plain values and SI units, for JSON."""
        return {
            "case": self.case,
            "bearing": self.bearing,
            "file": str(self.file),
            "samples": self.samples,
            "kept": self.kept,
            "largest_force": {"full": self.largest[0], "reduced": self.largest[1], "units": "N"},
            "mean_force": {"full": self.mean[0], "reduced": self.mean[1], "units": "N"},
        }


@dataclass(frozen=True)
class ReducedCube:
    """All parts of a cube, and where the forces of its bearings come from."""

    parts: list[Part]
    suspension: str


def as_row(part: Part) -> list[str]:
    """The part under `HEADS`."""
    forces = [f"{force / 1e3:.5g}" for force in (*part.largest, *part.mean)]
    counts = [str(part.samples), str(part.kept)]
    return [part.case, part.bearing, *counts, *forces, part.file.name]


def reduce_cube(
    cube: Cube,
    folder: Path,
    *,
    size: float = 0.1,
    pick: Any = "extremes",
    seed: int = 0,
    bearings: Sequence[str] = (),
    turbine: str = "nrel-5mw",
    source: str = "load cube",
) -> ReducedCube:
    """Reduce the radial force of every bearing in every case, and write parameter files.

    Parameters
    ----------
    cube : Cube
        With `speed`, and `force` of bearings or else `hub_force` and `hub_moment`, which the
        default `TwoPoint` suspension turns into bearing forces.
    folder : Path
        Where to write; made if it is not there.
    size, pick, seed
        See `loadflow.reduction.histogram`.
    bearings : sequence of str
        Which bearings; default: all.
    turbine : str
        Name or file of the turbine; its tilt is taken for the suspension.
    source : str
        Name of the cube, for messages.

    Returns
    -------
    ReducedCube

    Raises
    ------
    loadflow.errors.InputError
        No such loads or bearing in the cube; an option out of its range.
    """
    parts = []
    suspension = "of the cube"
    for name, case in iter_cases(cube):
        try:
            loads, text = _bearing_loads(case.load(), turbine)
            suspension = text or suspension
            for bearing in _chosen(loads, bearings):
                found = loads.sel(bearing=bearing)
                parts.append(_reduce(name, str(bearing), found, folder, size, pick, seed))
        except InputError as error:
            raise InputError(f"{source}: {name}: {error}") from error
    if not parts:
        raise InputError(f"{source}: the load cube is empty, it holds no case")
    return ReducedCube(parts, suspension)


def _bearing_loads(case: xr.Dataset, turbine: str) -> tuple[xr.Dataset, str]:
    """Return `speed` with `force` and `moment` of the bearings, and the suspension if assumed."""
    if "speed" not in case:
        raise InputError("no rotor speed; the reduction needs the variable 'speed'")
    if "force" in case:
        moment = case.get("moment", xr.zeros_like(case["force"]))
        return case[["speed", "force"]].assign(moment=moment), ""
    if "hub_force" not in case or "hub_moment" not in case:
        raise InputError("neither 'force' of bearings nor 'hub_force' with 'hub_moment'")
    from loadflow.turbines import load_turbine

    tilt = load_turbine(turbine).rotor.tilt
    concept = TwoPoint()
    hub = [case[name].transpose("axis", "time").values for name in ("hub_force", "hub_moment")]
    loads = bearing_loads(concept, *hub, tilt=tilt, time=case["time"].values)
    text = (
        f"the cube has hub loads only; taken: two points, N at {concept.hub_to_first:g} m and N2 "
        f"{concept.span:g} m behind, gearbox {concept.gearbox_mass:g} kg, shaft tilted "
        f"{np.degrees(tilt):g}° ({turbine})"
    )
    return loads.assign(speed=("time", case["speed"].values)), text


def _chosen(loads: xr.Dataset, bearings: Sequence[str]) -> list[Any]:
    """Labels of the wanted bearings."""
    there = [str(label) for label in loads["bearing"].values]
    if unknown := [name for name in bearings if name not in there]:
        raise InputError(f"no bearing {unknown[0]!r}; there are {', '.join(there)}")
    return [label for label in loads["bearing"].values if not bearings or str(label) in bearings]


def _reduce(
    name: str, bearing: str, loads: xr.Dataset, folder: Path, size: float, pick: Any, seed: int
) -> Part:
    """Reduce one bearing of one case and write its file."""
    force, moment = (
        loads[load].transpose("time", "axis").values.astype(float) for load in ("force", "moment")
    )
    radial = to_film(force)
    reduced = histogram(
        loads["speed"].values.astype(float),
        radial,
        loads["time"].values,
        size=size,
        pick=pick,
        seed=seed,
        source=f"{name}, bearing {bearing}",
    )
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}_{bearing}.txt"
    write_parameter_file(file, reduced)
    full, kept = np.hypot(*radial.T), np.hypot(*reduced.force.T)
    return Part(
        name,
        bearing,
        file,
        full.size,
        kept.size,
        (float(full.max()), float(kept.max())),
        (float(full.mean()), float(reduced.mean(kept))),
        reduced_dataset(reduced, force, moment, by_moment=False),
    )


def write_reduction_page(path: Path, made: ReducedCube, source: str = "load cube") -> Path:
    """Write a page with what was kept, and the histograms before and after.

    Parameters
    ----------
    path : Path
        HTML file to write.
    made : ReducedCube
        What `reduce_cube` returned.
    source : str
        Name of the cube, for the title.
    """
    first = made.parts[0].series.attrs
    facts = {"Bearing forces": made.suspension, "Pick": f"{first['pick']}, seed {first['seed']}"}
    table = Table("", list(HEADS), [as_row(part) for part in made.parts])
    pictures = [
        Picture(figures.histograms(part.series), f"{part.case}, bearing {part.bearing}", k > 0)
        for k, part in enumerate(made.parts)
    ]
    sections = [Section("Series", tables=[table]), Section("Histograms", pictures=pictures)]
    return write_page(path, f"Reduction of {source}", facts, sections)
