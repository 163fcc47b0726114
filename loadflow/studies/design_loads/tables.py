"""Load cube → stationary and periodic design loads of each bearing, as tables, files and a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.reduction import (
    ClosingPeriod,
    FrequencyBounds,
    PeriodicLoad,
    amplitude_spectrum,
    closing_period,
    frequency_bounds,
    periodic,
    stationary,
)
from loadflow.report import Picture, Section, Table, load_figures, write_page
from loadflow.scene.journal import Journal
from loadflow.stages.films.response import film_response
from loadflow.studies.bearing_series import BearingSeries

AXES = ("−Fz (down)", "Fy (left)")
"""Forces across the shaft, in the order of the film's frame, in words of the shaft's frame."""

CLOSING = 0.01  # allowed relative change of a frequency so that the orbit closes
STATIONARY_HEADS = (
    "case",
    "bearing",
    "load",
    "speed, 1/min",
    *(f"{axis}, kN" for axis in AXES),
    "F, kN",
    "time, s",
)
PERIODIC_HEADS = (
    "case",
    "bearing",
    "axis",
    "mean, kN",
    "kind",
    "name",
    "amplitude, kN",
    "frequency, Hz",
    "°/s",
    "phase, °",
)

Row = list[str]
Bounds = tuple[float, float] | FrequencyBounds


def stationary_rows(series: BearingSeries) -> list[dict[str, Any]]:
    """Stationary loads of one bearing in one case (4.3.1 of [Jonuschies 2015]), in SI units."""
    loads = stationary(series.speed, series.radial, series.time)
    return [
        {
            "case": series.case,
            "bearing": series.bearing,
            "load": load.name,
            "speed": load.speed,
            "force_x": float(load.force[0]),
            "force_y": float(load.force[1]),
            "force": load.resultant,
            "time": None if load.index is None else float(series.time[load.index]),
        }
        for load in (loads.maximum, loads.mean, *loads.envelope)
    ]


def stationary_row(row: dict[str, Any]) -> Row:
    """The load under `STATIONARY_HEADS`."""
    time = "-" if row["time"] is None else f"{row['time']:.6g}"
    forces = [f"{row[key] / 1e3:.5g}" for key in ("force_x", "force_y", "force")]
    speed = f"{row['speed'] * 30 / np.pi:.4g}"
    return [row["case"], row["bearing"], row["load"], speed, *forces, time]


def write_stationary(rows: list[dict[str, Any]], folder: Path) -> Path:
    """Write stationary loads as ``stationary.csv``, in SI units."""
    import pandas as pd

    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "stationary.csv"
    pd.DataFrame(rows).to_csv(file, index=False)
    return file


@dataclass(frozen=True)
class PeriodicPart:
    """The periodic load of one bearing in one case.

    Attributes
    ----------
    series : BearingSeries
        What it was made from.
    load : PeriodicLoad
        As found.
    closing : ClosingPeriod or None
        Period in which the orbit closes, with its error; None without harmonics.
    bounds : FrequencyBounds or (float, float)
        What told base and additional loads apart.
    """

    series: BearingSeries
    load: PeriodicLoad
    closing: ClosingPeriod | None
    bounds: Bounds

    @property
    def limits(self) -> tuple[float, float]:
        """Lower and upper bound, Hz."""
        b = self.bounds
        return (b.low, b.high) if isinstance(b, FrequencyBounds) else b

    def rows(self) -> list[Row]:
        """Mean and harmonics under `PERIODIC_HEADS`."""
        head = [self.series.case, self.series.bearing]
        found = []
        for axis, mean, harmonics in zip(AXES, self.load.mean.tolist(), self.load.harmonics):
            for h in harmonics:
                numbers = [f"{h.amplitude / 1e3:.5g}", f"{h.frequency:.5g}"]
                numbers += [f"{h.frequency * 360:.5g}", f"{np.degrees(h.phase):.4g}"]
                found.append([*head, axis, f"{mean / 1e3:.6g}", h.kind, h.label or "-", *numbers])
        return found

    def as_dict(self) -> dict[str, Any]:
        """The load in plain values and SI units, for JSON."""
        return {
            "case": self.series.case,
            "bearing": self.series.bearing,
            "speed": self.load.speed,
            "mean": self.load.mean,
            "harmonics": [[vars(h) for h in axis] for axis in self.load.harmonics],
            "bounds": self.limits,
            "bracketed": getattr(self.bounds, "bracketed", None),
            "closing_period": None if self.closing is None else self.closing.period,
            "closing_error": None if self.closing is None else self.closing.error,
        }


def periodic_parts(
    series: Iterable[BearingSeries],
    *,
    bounds: tuple[float, float] | None = None,
    journal: Journal | None = None,
    named: dict[str, float] | None = None,
    additional: int = 2,
    orders: Sequence[float] | None = None,
) -> Iterator[PeriodicPart]:
    """Yield the periodic load of every bearing and case (4.3.2 of [Jonuschies 2015]).

    Parameters
    ----------
    series : iterable of BearingSeries
        Bearings and cases.
    bounds : (float, float), optional
        Lower and upper bound, Hz. Without them the film of the bearing says which frequencies
        matter (4.23–4.27), once for each bearing and wind speed, by its first seed.
    journal : Journal, optional
        The bearing; default: the reference bearing of [Jonuschies 2015].
    named : dict of str to float, optional
        Natural frequencies of the turbine, Hz.
    additional, orders
        See `loadflow.reduction.periodic`.
    """
    known: dict[tuple[Any, ...], Bounds] = {}
    for part in series:
        key = part.bearing, part.labels.get("dlc"), part.labels.get("wind_speed")
        if key not in known:
            known[key] = bounds or _ask_film(part, journal or Journal())
        load = periodic(
            part.speed,
            part.radial,
            part.time,
            bounds=known[key],
            named=named,
            additional=additional,
            orders=orders,
        )
        closing = closing_period(load.frequencies, CLOSING) if load.frequencies else None
        yield PeriodicPart(part, load, closing, known[key])


def _ask_film(part: BearingSeries, journal: Journal) -> FrequencyBounds:
    """Bounds by the film, for the mean load and an amplitude of √2 standard deviations."""
    force = part.radial
    response = film_response(journal, float(part.speed.mean()))
    return frequency_bounds(response, force.mean(axis=0), np.sqrt(2.0) * force.std(axis=0))


def write_periodic(parts: Sequence[PeriodicPart], folder: Path, source: str) -> Path:
    """Write the closed series of every load as CSV, and a page with harmonics and bounds.

    A series has the columns time (s), speed (rad/s), force_x, force_y (N), over one closing period.
    """
    if not parts:
        raise InputError(f"{source}: no bearing to reduce")
    folder.mkdir(parents=True, exist_ok=True)
    for part in parts:
        step = float(part.series.time[1] - part.series.time[0])
        time, force = part.load.closed(CLOSING).series(step, _duration(part))
        table = np.column_stack([time, np.full(time.size, part.load.speed), force])
        np.savetxt(
            folder / f"{part.series.case}_{part.series.bearing}_periodic.csv",
            table,
            delimiter=",",
            header="time,speed,force_x,force_y",
            comments="",
            fmt="%.9g",
        )
    rows = [row for part in parts for row in part.rows()]
    closing = [
        [part.series.case, part.series.bearing, *(f"{b:.4g}" for b in part.limits), *_closing(part)]
        for part in parts
    ]
    tables = [
        Table("Harmonics", list(PERIODIC_HEADS), rows),
        Table("Bounds and closing period", list(CLOSING_HEADS), closing),
    ]
    pictures = [
        Picture(draw(part), f"{part.series.source}{text}", k > 0)
        for k, part in enumerate(parts)
        for draw, text in ((_spectrum, ""), (_closed, ", closed"))
    ]
    asked = [part for part in parts if isinstance(part.bounds, FrequencyBounds)]
    if asked:
        caption = "Largest eccentricity ratio in a period under the mean load and a sine (4.23)."
        pictures.insert(0, Picture(load_figures.bounds(_trials(asked)), caption))
    sections = [Section("Periodic loads", TEXT, tables), Section("Spectra", pictures=pictures)]
    facts = {"Window": "Hann; sines fitted between the lines", "Closing": f"within {CLOSING:.0%}"}
    return write_page(folder / "periodic.html", f"Periodic loads of {source}", facts, sections)


TEXT = (
    "Base load: the largest harmonic below the lower bound; additional loads: the largest between "
    "the bounds. Phases from the start of the series. A base load carries the power of all slow "
    "turbulence only in part: its amplitude is that of one line."
)
CLOSING_HEADS = ("case", "bearing", "low, Hz", "high, Hz", "found", "closes in, s", "error")


def _duration(part: PeriodicPart) -> float:
    return part.closing.period if part.closing else float(part.series.time[-1])


def _closing(part: PeriodicPart) -> Row:
    found = "given"
    if isinstance(part.bounds, FrequencyBounds):
        found = "by the film" if part.bounds.bracketed else "beyond the trial frequencies"
    if part.closing is None:
        return [found, "-", "-"]
    return [found, f"{part.closing.period:.5g}", f"{part.closing.error:.2%}"]


def _spectrum(part: PeriodicPart) -> Any:
    step = float(part.series.time[1] - part.series.time[0])
    found = [amplitude_spectrum(x, step) for x in part.series.radial.T]
    wide = part.load.harmonics
    low, high = part.limits
    return load_figures.harmonics(
        xr.Dataset(
            {
                "amplitude": (
                    ("axis", "frequency"),
                    np.abs([amplitude for _, amplitude in found]),
                    {"units": "N"},
                ),
                "kept": (
                    "harmonic",
                    [h.amplitude for axis in wide for h in axis],
                    {"units": "N"},
                ),
            },
            {
                "axis": list(AXES),
                "frequency": found[0][0],
                "at": ("harmonic", [h.frequency for axis in wide for h in axis]),
                "label": ("harmonic", [h.label for axis in wide for h in axis]),
                "of": ("harmonic", [name for name, axis in zip(AXES, wide) for _ in axis]),
            },
            {"low": low, "high": high},
        )
    )


def _closed(part: PeriodicPart) -> Any:
    time = part.series.time
    shown = time <= min(float(time[-1]), max(2 * _duration(part), 60.0))
    closed = part.load.closed(CLOSING)
    units = {"units": "N"}
    return load_figures.periodic_series(
        xr.Dataset(
            {
                "series": (
                    ("time", "axis"),
                    part.series.radial[shown],
                    units | {"long_name": "series"},
                ),
                "force": (("time", "axis"), closed(time[shown]), units | {"long_name": "periodic"}),
            },
            {"time": time[shown], "axis": list(AXES)},
        )
    )


def _trials(parts: Sequence[PeriodicPart]) -> xr.Dataset:
    """Eccentricity over trial frequency, once for each bearing and wind speed."""
    found: dict[str, FrequencyBounds] = {}
    for part in parts:
        name = f"{part.series.bearing}, {part.series.labels.get('wind_speed', 0):g} m/s"
        found.setdefault(name, part.bounds)  # type: ignore[arg-type]
    first = next(iter(found.values()))
    return xr.Dataset(
        {
            "eccentricity_ratio": (
                ("bearing", "frequency"),
                [b.eccentricity for b in found.values()],
            )
        },
        {"bearing": list(found), "frequency": first.frequency},
    )
