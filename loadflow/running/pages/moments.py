"""Moments that numbers of a run are from, as pictures of its series."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import xarray as xr

from loadflow.planning.budget import Answer
from loadflow.report import Chart, Section
from loadflow.report.moments import AROUND, Moment, moment_chart
from loadflow.running.folder import answered, read_part
from loadflow.running.pages.answers import moment_of as moment_of_answer
from loadflow.running.pages.verdicts import moment_of as moment_of_verdict
from loadflow.verdict import from_dataset

_OF_FILMS = ("time", "minimum_film", "maximum_pressure")
_OF_ELEMENTS = ("time", "maximum_pressure", "bearing_pressure", "bearing_pressure_time")


def moments_section(
    folder: Path, found: Iterable[Answer], tables: Mapping[str, xr.Dataset]
) -> Section:
    """Pictures of the moments that verdicts and answers of a run are from.

    Parameters
    ----------
    folder : Path
        Of a finished run.
    found : iterable of Answer
        Of the run.
    tables : mapping
        Its results by stage.
    """
    named: list[tuple[Moment | None, str]] = [
        (moment_of_answer(one), f"{one.quantity} (answer)") for one in found
    ]
    if "verdicts" in tables:
        named += [(moment_of_verdict(v), v.quantity) for v in from_dataset(tables["verdicts"])]
    wanted: dict[Moment, list[str]] = {}
    for moment, name in named:
        if moment is not None:
            wanted.setdefault(moment, []).append(name)
    text = (
        f"What verdicts and answers are from: {AROUND:g} s before and behind each moment, which is "
        "marked, and all of a load case where it governs as a whole. Dots are samples of a reduced "
        "series."
    )
    return Section("Moments", text, pictures=[*moment_charts(folder, wanted)])


def anchors_of(section: Section) -> set[str]:
    """Names for links to the charts of a section."""
    return {chart.anchor for chart in section.pictures if isinstance(chart, Chart)}


def moment_charts(
    folder: Path, wanted: Mapping[Moment, Iterable[str]], before: str = ""
) -> Iterator[Chart]:
    """Yield a picture for each moment of which the run has the series of the bearing.

    Parameters
    ----------
    folder : Path
        Of a finished run.
    wanted : mapping of Moment to iterable of str
        Moments, and names of the numbers that are from each.
    before : str, optional
        Of the names for links to them.
    """
    cases = dict.fromkeys(moment.case for moment in wanted)
    for case in answered(folder, "shaft", answered(folder, "loads", cases)):
        (shaft,) = read_part(folder, "shaft", case, ("force", "moment")).values()
        (loads,) = read_part(folder, "loads", case, ("speed",)).values()
        of_place = _samples(folder, case)
        for moment, names in wanted.items():
            if moment.case == case and moment.place in shaft["bearing"].values:
                series = shaft.sel(bearing=moment.place).assign(speed=loads["speed"])
                caption = f"{moment.told}: {', '.join(names)}"
                samples = of_place.get(moment.place, {})
                yield moment_chart(moment, series, samples, caption, before + moment.anchor)


def _samples(folder: Path, case: str) -> dict[str, dict[str, xr.Dataset]]:
    """What the bearing at each place has of samples of a case, by its kind."""
    found: dict[str, dict[str, xr.Dataset]] = {}
    for stage in ("journal", "thrust"):
        for _ in answered(folder, stage, [case]):
            for place, films in read_part(folder, stage, case, _OF_FILMS).items():
                found.setdefault(place, {})[f"{stage} bearing"] = films
    for _ in answered(folder, "rolling", [case]):
        (data,) = read_part(folder, "rolling", case, _OF_ELEMENTS).values()
        first, *others = data["bearing"].values.tolist()  # of the first alone all are kept
        found.setdefault(first, {})["rolling bearing"] = data[["time", "maximum_pressure"]]
        for place in others:
            largest = _largest(data.sel(bearing=place), data["maximum_pressure"].attrs)
            found.setdefault(place, {})["rolling bearing, largest of the load case"] = largest
    return found


def _largest(data: xr.Dataset, attributes: Mapping[str, str]) -> xr.Dataset:
    """The largest pressure of a bearing in a case, as the only one of its samples."""
    return xr.Dataset(
        {
            "time": ("sample", [data["bearing_pressure_time"].item()]),
            "maximum_pressure": ("sample", [data["bearing_pressure"].item()], attributes),
        }
    )
