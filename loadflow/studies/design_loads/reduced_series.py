"""Load cube → reduced series as parameter files, one for each case and bearing, and a page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube
from loadflow.errors import InputError
from loadflow.reduction import histogram, phases, write_parameter_file
from loadflow.report import Drawing, Section, Table, figures, write_page
from loadflow.scene.journal import Journal
from loadflow.stages.kept_samples import stretch
from loadflow.stages.reduction import reduced_dataset
from loadflow.studies.bearing_series import BearingSeries, iter_bearings, suspension
from loadflow.studies.design_loads.reduction_error import HEADS as FILM_HEADS
from loadflow.studies.design_loads.reduction_error import (
    FilmError,
    for_long_series,
    solve_films,
    summary_rows,
)
from loadflow.studies.design_loads.whole_cube import common_edges, whole_histograms

HEADS = (
    "case",
    "bearing",
    "phase",
    "samples",
    "kept",
    "largest F, kN",
    "kept, kN",
    "mean F, kN",
    "kept, weighted, kN",
    "file",
)

PHASES = ("standstill", "run-up", "operation", "run-down", "part speed")


@dataclass(frozen=True)
class Part:
    """One case of one bearing, or a phase of it, reduced.

    Attributes
    ----------
    case, bearing : str
        Which.
    phase : str
        Name of the phase of the series; empty for the whole series.
    start : float
        Time at which the series or phase begins, s.
    peak_time : float
        Time of the largest radial force, s.
    file : Path
        Its parameter file.
    samples, kept : int
        Length of the full and of the reduced series.
    largest, mean : tuple of float
        Radial force of the full and of the reduced series (weighted), N.
    series : xarray.Dataset
        The reduced series with its histograms.
    film : FilmError or None
        What the reduction does to the film, if a bearing was asked.
    """

    case: str
    bearing: str
    phase: str
    start: float
    peak_time: float
    file: Path
    samples: int
    kept: int
    largest: tuple[float, float]
    mean: tuple[float, float]
    series: xr.Dataset
    film: FilmError | None = None

    def as_dict(self) -> dict[str, Any]:
        """The part in plain values and SI units, for JSON."""
        return {
            "case": self.case,
            "bearing": self.bearing,
            "phase": self.phase,
            "start": self.start,
            "peak_time": self.peak_time,
            "file": str(self.file),
            "samples": self.samples,
            "kept": self.kept,
            "largest_force": {"full": self.largest[0], "reduced": self.largest[1], "units": "N"},
            "mean_force": {"full": self.mean[0], "reduced": self.mean[1], "units": "N"},
            "film": None if self.film is None else self.film.as_dict(),
        }


@dataclass(frozen=True)
class ReducedCube:
    """All parts of a cube, and where the forces of its bearings come from.

    With classes of the whole cube, `whole` has the histograms of all cases together, by bearing.
    """

    parts: list[Part]
    suspension: str
    whole: dict[str, xr.Dataset] = field(default_factory=dict)

    @property
    def warnings(self) -> list[str]:
        """Series whose classes keep one sample each, so that the wanted size does not count."""
        return [
            f"{part.case}, bearing {part.bearing}: each class keeps one sample, {part.kept} of "
            f"{part.samples}; size and rounding count with fewer classes"
            for part in self.parts
            if part.series["counts_reduced"].max() == 1 and part.kept < part.samples
        ]


def as_row(part: Part) -> list[str]:
    """The part under `HEADS`."""
    forces = [f"{force / 1e3:.5g}" for force in (*part.largest, *part.mean)]
    counts = [str(part.samples), str(part.kept)]
    phase = f"{part.phase} from {part.start:.4g} s" if part.phase else "all"
    return [part.case, part.bearing, phase, *counts, *forces, part.file.name]


def film_rows(parts: Sequence[Part]) -> list[list[str]]:
    """Film of the parts under `FILM_HEADS`, with mean and standard deviation below."""
    asked = [(part, part.film) for part in parts if part.film is not None]
    if not asked:
        return []
    rows = [
        film.as_row(f"{part.case} {part.phase}", part.bearing, part.kept / part.samples)
        for part, film in asked
    ]
    return rows + summary_rows(film for _, film in asked)


def reduce_cube(
    cube: Cube,
    folder: Path,
    *,
    options: Mapping[str, Any] = MappingProxyType({}),
    phase: str = "",
    between: tuple[float, float] | None = None,
    grid: str = "each",
    journal: Journal | None = None,
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
    options : mapping
        `size`, `classes`, `pick`, `rounding`, `seed` of `loadflow.reduction.histogram`.
    phase : str
        Reduce only phases of this name (`loadflow.reduction.phases`), or ``"each"`` phase by
        itself; empty: the series as a whole.
    between : (float, float), optional
        Reduce only the samples of these times, s, of each series.
    grid : {"each", "cube"}
        Classes of each series by itself, or the same for all series of a bearing, so that they make
        one histogram of the whole cube.
    journal : Journal, optional
        Solve the film of this bearing for every sample, and say what the reduction does to it.
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
        No such loads, bearing, phase or times in the cube; an option out of its range.
    """
    parts = []
    journal = journal and for_long_series(journal)
    if grid not in ("each", "cube"):
        raise InputError(f'grid = {grid!r}; allowed: "each", "cube"')
    shared = {}
    if grid == "cube":
        every = iter_bearings(cube, bearings, turbine, source)
        shared = common_edges(every, options.get("classes"))
    for series in iter_bearings(cube, bearings, turbine, source):
        try:
            films = solve_films(series, journal) if journal else None
            own = {"classes": shared[series.bearing]} if shared else {}
            for name, places in _stretches(series, phase, between):
                part = _reduce(series, name, places, folder, {**options, **own})
                film = FilmError.of(films.part(places), part.series) if films else None
                parts.append(replace(part, film=film))
        except InputError as error:
            raise InputError(f"{source}: {series.case}: {error}") from error
    if not parts:
        raise InputError(f"{source}: no case has a phase {phase!r}")
    whole = whole_histograms((part.bearing, part.series) for part in parts) if shared else {}
    return ReducedCube(parts, suspension(cube, turbine), whole)


def _stretches(
    series: BearingSeries, phase: str, between: tuple[float, float] | None
) -> Iterator[tuple[str, slice]]:
    """Names and places of what is to be reduced by itself."""
    if between is not None:
        yield _between(series, phase, between)
        return
    if phase not in ("", "each", *PHASES):
        raise InputError(f"phase = {phase!r}; allowed: each, {', '.join(PHASES)}")
    if not phase:
        yield "", slice(0, series.time.size)
        return
    for found in phases(series.speed):
        if phase in ("each", found.name):
            yield found.name, found.places


def _between(series: BearingSeries, phase: str, times: tuple[float, float]) -> tuple[str, slice]:
    """Name and place of the samples of some time."""
    if phase:
        raise InputError("give either a phase or the times between which to reduce")
    return "stretch", stretch(series.time, times, f"bearing {series.bearing}")


def _reduce(
    series: BearingSeries, phase: str, places: slice, folder: Path, options: Mapping[str, Any]
) -> Part:
    """Reduce one stretch of one bearing of one case and write its file."""
    force, time = series.force[places], series.time[places]
    radial = series.radial[places]
    of_phase = f"{phase} from {time[0]:.10g} s" if phase else ""
    reduced = histogram(
        series.speed[places],
        radial,
        time,
        source=", ".join(filter(None, [series.source, of_phase])),
        **options,
    )
    folder.mkdir(parents=True, exist_ok=True)
    stem = f"{series.case}_{series.bearing}"
    file = folder / (
        f"{stem}_{phase.replace(' ', '-')}-{places.start}.csv" if phase else f"{stem}.csv"
    )
    write_parameter_file(file, reduced)
    full, kept = np.hypot(*radial.T), np.hypot(*reduced.force.T)
    return Part(
        series.case,
        series.bearing,
        phase,
        float(time[0]),
        float(time[np.argmax(full)]),
        file,
        full.size,
        kept.size,
        (float(full.max()), float(kept.max())),
        (float(full.mean()), float(reduced.mean(kept))),
        reduced_dataset(reduced, force, series.moment[places], by_moment=False),
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
        Drawing(figures.histograms(part.series), part.series.attrs["source"], k > 0)
        for k, part in enumerate(made.parts)
    ]
    whole = [Drawing(figures.histograms(d), d.attrs["source"], False) for d in made.whole.values()]
    sections = [
        Section("Series", tables=[table]),
        Section("Histograms", pictures=[*whole, *pictures]),
    ]
    if rows := film_rows(made.parts):
        sections.insert(1, Section("Film", FILM_TEXT, [Table("", list(FILM_HEADS), rows)]))
    return write_page(path, f"Reduction of {source}", facts, sections)


FILM_TEXT = (
    "Deviation of the reduced series from the full one, films at static equilibrium, as in Tables "
    "5-17 and 5-18 of [Jonuschies 2015] (So of the largest pressure); and the reduced, "
    "quasi-static E_max against that of the orbit under the full series, which is the true error."
)
