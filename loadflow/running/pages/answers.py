"""Tables of a run's answers: value, interval by seeds, band by tolerances, error by models."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

import numpy as np
import xarray as xr

from loadflow.planning.budget import Answer
from loadflow.quantities import fitting_unit, four_digits, load_cases, percent
from loadflow.report import Table
from loadflow.report.moments import Moment, links_to
from loadflow.scene.scene import Scene
from loadflow.studies.tolerances import Band


def answer_tables(
    scene: Scene, found: list[Answer], tables: dict[str, xr.Dataset], shown: Collection[str] = ()
) -> Iterator[Table]:
    """Each answer with its interval, band and error, then what tolerances do to each.

    Parameters
    ----------
    scene : Scene
        As it ran.
    found : list of Answer
        Of the run.
    tables : dict
        Its results by stage.
    shown : collection of str, optional
        Anchors of the moments that the page shows, to lead to.
    """
    if found:
        yield replace(_answers(found, shown), note=without_film(scene, tables))
    yield from _tolerances(tables)


def without_film(scene: Scene, tables: dict[str, xr.Dataset]) -> str:
    """Say which films end where surfaces touch, so that answers leave that out; empty if none.

    Asperities that a scene describes carry there, and their samples are answered.
    """
    told = []
    for stage in ("journal", "thrust"):
        if "in_contact" not in tables.get(stage, ()):
            continue
        for name in tables[stage]["bearing"].values.tolist():
            own = tables[stage]["in_contact"].sel(bearing=name)
            films = stage == "thrust" or scene.journal.at(name).contact is None
            if films and (own > 0).any():
                cases = load_cases(int((own > 0).sum()))
                told.append(f"{stage} {name}, {int(own.sum())} samples in {cases}")
    if not told:
        return ""
    return (
        f"Where surfaces touch there is no film ({'; '.join(told)}): the answers are those of the "
        "other samples. The verdicts count it."
    )


def moment_of(one: Answer) -> Moment | None:
    """Where an answer is from; None where it is of all load cases."""
    return Moment(one.case, one.time, one.bearing) if one.case else None


def _answers(found: list[Answer], shown: Collection[str]) -> Table:
    banded = any(one.band is not None for one in found)
    heads = ["answer", "bearing", "value", "95 % interval by seeds"]
    heads += ["band by tolerances"] if banded else []
    heads += ["error by models", "governed by", "left out", "load case"]
    rows = [answer_row(one, banded) for one in found]
    links = links_to(map(moment_of, found), len(heads) - 1, shown)
    return Table("Answers", heads, rows, links=links)


def answer_row(one: Answer, banded: bool = False) -> list[str]:
    """Row of an answer: value and interval in the unit that fits; `banded`: with its band."""
    ends = (np.nan, np.nan) if one.band is None else one.band.of(one.value)
    size = largest(one.low, one.value, one.high, *ends)
    factor, unit = (1e6, "µm") if one.unit == "m" else fitting_unit(one.unit, size)
    low, value, high = (four_digits(factor * number) for number in (one.low, one.value, one.high))
    unit = "" if unit == "–" else f" {unit}"
    missing = ", ".join(f"{name} {percent(share)}" for name, share in (one.left_out or {}).items())
    return [
        one.quantity,
        f"{one.result.partition('.')[0]} {one.bearing}",  # as verdicts name it
        value + unit,
        "one seed" if np.isnan(one.low) else f"{low} … {high}{unit}",
        *([_band(one.band, factor, ends, unit)] if banded else []),
        "not measured" if one.error is None else f"≤ {percent(one.error)}",
        one.governed_by,
        missing or "-",
        "-" if (moment := moment_of(one)) is None else moment.within,
    ]


def _band(band: Band | None, factor: float, ends: tuple[float, float], unit: str) -> str:
    if band is None:
        return "none stated"
    if np.isnan(ends[0]):
        return "no answer at an end"
    return f"{four_digits(factor * ends[0])} … {four_digits(factor * ends[1])}{unit}"


def _tolerances(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """How each answer moves with each value at the ends of its band."""
    if "tolerances" not in tables:
        return
    data = tables["tolerances"]
    text = [data[name].values.tolist() for name in ("bearing", "key", "quantity", "case")]
    ends = [[percent(x, signed=True) for x in data[end].values] for end in ("low", "high")]
    heads = ["bearing", "value", "answer", "load case", "at the lower end", "at the upper end"]
    yield Table("Tolerances", heads, [list(row) for row in zip(*text, *ends)])


def largest(*numbers: float) -> float:
    """Largest size of those numbers that are finite; 0 if none is."""
    return max((abs(number) for number in numbers if np.isfinite(number)), default=0.0)
