"""Lifetimes of bearings → tables as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.quantities import four_digits
from loadflow.reduction import LongTermExtreme
from loadflow.report import Drawing, Picture, Section, Table, load_figures, write_page
from loadflow.report.page import ZERO, Shown
from loadflow.studies.lifetime.lifetimes import COMPONENTS, YEAR, BearingLifetime, LifetimeOptions

HEADS = ("bearing", "what", "value", "unit")
LEVELS = 200  # points of a drawn tail


def summary_rows(life: BearingLifetime, options: LifetimeOptions) -> list[list[str]]:
    """What matters of a lifetime under `HEADS`."""
    rows = [
        [life.bearing, f"DEL of {name}, m = {m:g}, range at 1 Hz", f"{loads[c] / 1e3:.5g}", "kN"]
        for m, loads in zip(options.exponents, life.lifetime_equivalent.tolist())
        for c, name in _loaded(life).items()
    ]
    turns = float(life.duration.revolutions.sum())
    said = f"revolutions in {options.years:g} years"
    rows.append([life.bearing, said, f"{turns / 1e6:.5g}", "Mrev"])
    if turns > 0:
        for p, kind in ((3.0, "balls"), (10.0 / 3.0, "rollers")):
            force = life.duration.equivalent_force(p)
            what = f"equivalent radial force, {kind}"
            rows.append([life.bearing, what, f"{force / 1e3:.5g}", "kN"])
    if life.extreme is not None:
        e: LongTermExtreme = life.extreme
        what = f"radial force exceeded once in {options.return_period:g} years (95 %)"
        value = f"{e.value / 1e3:.5g} ({e.low / 1e3:.5g} … {e.high / 1e3:.5g})"
        rows.append([life.bearing, what, value, "kN"])
    return rows


def summary_table(lives: Sequence[BearingLifetime], options: LifetimeOptions) -> Table:
    """What matters of some lifetimes; forces that a bearing never carries are said below."""
    rows = [row for life in lives for row in summary_rows(life, options)]
    none = [f"{', '.join(found)} of bearing {x.bearing}" for x in lives if (found := _unloaded(x))]
    return Table("", list(HEADS), rows, left_out={ZERO: none})


def _loaded(life: BearingLifetime) -> dict[int, str]:
    """Number and name of the components with a range in any case."""
    ranges = life.equivalent.sum(axis=(0, 2))
    return {int(c): COMPONENTS[c] for c in np.flatnonzero(ranges)}


def _unloaded(life: BearingLifetime) -> list[str]:
    return [name for name in COMPONENTS if name not in _loaded(life).values()]


def share_warnings(lives: Sequence[BearingLifetime]) -> list[str]:
    """Say which design load cases the lifetimes leave out, and if shares exceed the lifetime."""
    told = []
    if dropped := list(dict.fromkeys(dlc for life in lives for dlc in life.left_out)):
        told.append(
            f"lifetime: no share of time, and so no fatigue, for DLC {', '.join(dropped)}; tell "
            "how often a year it happens (per year), or give the shares"
        )
    if (total := max(float(life.shares.sum()) for life in lives)) > 1.001:
        told.append(f"lifetime: the shares sum to {total:.4g} lifetimes")
    return told


def as_dict(life: BearingLifetime, options: LifetimeOptions) -> dict[str, Any]:
    """A lifetime in plain values and SI units, for JSON."""
    extreme = life.extreme
    return {
        "bearing": life.bearing,
        "shares": dict(zip(life.cases, life.shares.tolist())),
        "components": COMPONENTS,
        "exponents": options.exponents,
        "damage_equivalent_load": life.lifetime_equivalent,
        "revolutions": float(life.duration.revolutions.sum()),
        "tails": {name: vars(tail) for name, tail in zip(life.tail_names, life.tails.values())},
        "extreme": None
        if extreme is None
        else {"value": extreme.value, "low": extreme.low, "high": extreme.high},
    }


def write_lifetime(
    lives: Sequence[BearingLifetime], options: LifetimeOptions, folder: Path, source: str
) -> Path:
    """Write for each bearing its tables, see `write_lifetime_tables`, and one page."""
    write_lifetime_tables(lives, folder)
    sections = [Section("Lifetime", tables=[summary_table(lives, options)])]
    sections += [
        Section(
            f"Bearing {life.bearing}",
            tables=[case_table(life, options), *tail_tables(life)],
            pictures=_pictures(life, options),
        )
        for life in lives
    ]
    shares = "as the cube states"
    if options.weights == "rayleigh":
        shares = f"Weibull, shape {options.weibull_shape:g}, class {options.wind_class}"
    facts = {"Lifetime": f"{options.years:g} years", "Shares of the cases": shares}
    if options.per_year:
        counts = (f"{dlc}: {number:g}" for dlc, number in options.per_year.items())
        facts["Times a year"] = ", ".join(counts)
    if warnings := share_warnings(lives):
        facts["Left out"] = " ".join(warnings)
    return write_page(folder / "lifetime.html", f"Lifetime of {source}", facts, sections)


def write_lifetime_tables(lives: Sequence[BearingLifetime], folder: Path) -> list[Path]:
    """Write for each bearing the revolutions and the Markov matrix as CSV.

    ``BEARING_revolutions.csv`` has a row for each class of speed and force that occurs: its edges
    (rad/s, N), mean force (N), seconds and revolutions, as a rolling-bearing life wants them.
    ``BEARING_markov.csv`` is the matrix, from (row) to (column), with the class edges (N) above.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for life in lives:
        turns, matrix = (folder / f"{life.bearing}_{n}.csv" for n in ("revolutions", "markov"))
        _write_revolutions(life, turns)
        edges = ",".join(f"{e:.9g}" for e in life.markov.edges)
        np.savetxt(
            matrix, life.markov.counts, fmt="%d", delimiter=",", header=f"edges in N: {edges}"
        )
        written += [turns, matrix]
    return written


def _write_revolutions(life: BearingLifetime, path: Path) -> None:
    import pandas as pd

    d = life.duration
    row, column = np.nonzero(d.seconds)
    speed, force = d.edges
    pd.DataFrame(
        {
            "speed_from": speed[row],
            "speed_to": speed[row + 1],
            "force_from": force[column],
            "force_to": force[column + 1],
            "force_mean": d.force[row, column],
            "seconds": d.seconds[row, column],
            "revolutions": d.revolutions[row, column],
        }
    ).to_csv(path, index=False)


def case_table(life: BearingLifetime, options: LifetimeOptions) -> Table:
    """Damage-equivalent loads of each case with its share of the lifetime."""
    heads = ["case", "share"]
    loaded = _loaded(life)
    heads += [f"{name}, m = {m:g}, kN" for m in options.exponents for name in loaded.values()]
    known = life.equivalent[:, [*loaded]]
    rows = [
        [case, f"{share:.4%}", *(four_digits(v / 1e3) for v in known[..., k].ravel())]
        for k, (case, share) in enumerate(zip(life.cases, life.shares.tolist()))
    ]
    left_out = {ZERO: _unloaded(life)}
    return Table("Damage-equivalent loads of the cases", heads, rows, left_out=left_out)


def tail_tables(life: BearingLifetime) -> list[Table]:
    """Tails behind the extreme of the return period; none without one."""
    if life.extreme is None:
        return []
    heads = [
        "load case",
        "wind, m/s",
        "threshold, kN",
        "scale, kN",
        "shape",
        "rate, 1/h",
        "from",
        "share",
    ]
    rows = [
        [
            dlc,
            f"{speed:g}",
            f"{tail.threshold / 1e3:.5g}",
            four_digits(tail.scale / 1e3),
            f"{tail.shape:.3g}",
            four_digits(tail.rate * 3600),
            str(tail.count),
            f"{share:.1%}",
        ]
        for ((dlc, speed), tail), share in zip(life.tails.items(), life.extreme.shares.tolist())
    ]
    return [Table("Tails of the radial force, and what each adds to the extreme", heads, rows)]


def duration_of(life: BearingLifetime) -> xr.Dataset:
    """Seconds and revolutions of the lifetime by speed and force, as figures take them."""
    dims = ("speed_class", "load_class")
    return xr.Dataset(
        {
            "seconds": (dims, life.duration.seconds),
            "revolutions": (dims, life.duration.revolutions),
            "speed_edges": ("speed_edge", life.duration.edges[0], {"units": "rad/s"}),
            "load_edges": ("load_edge", life.duration.edges[1], {"units": "N"}),
        }
    )


def markov_picture(life: BearingLifetime, what: str = "") -> Drawing:
    """The Markov matrix in colour, folded; `what` stands before its caption."""
    matrix = xr.Dataset(
        {
            "counts": (("from", "to"), life.markov.counts),
            "edges": ("edge", life.markov.edges, {"units": "N"}),
        }
    )
    caption = f"{what}Markov matrix of −Fz (down) over the lifetime."
    return Drawing(load_figures.markov(matrix), caption, True)


def _pictures(life: BearingLifetime, options: LifetimeOptions) -> list[Shown]:
    drawn = load_figures.duration(duration_of(life))
    pictures: list[Shown] = [
        Picture(drawn, "Load duration and revolutions of the lifetime."),
        markov_picture(life),
    ]
    if life.extreme is not None:
        caption = (
            f"Exceedances of the radial force; dashed: once in {options.return_period:g} years, "
            "shaded: 95 % confidence."
        )
        pictures.append(Picture(load_figures.tails(exceedances(life, options)), caption))
    return pictures


def exceedances(life: BearingLifetime, options: LifetimeOptions) -> xr.Dataset:
    """How often a year each tail exceeds a radial force, of a lifetime with an extreme."""
    assert life.extreme is not None
    low = min(tail.threshold for tail in life.tails.values())
    level = np.linspace(low, 1.05 * max(life.extreme.high, low), LEVELS)
    pairs = zip(life.tail_shares.tolist(), life.tails.values())
    rates = [share * tail.rate_above(level) * YEAR for share, tail in pairs]
    return xr.Dataset(
        {"rate": (("tail", "level"), rates), "total": ("level", np.sum(rates, axis=0))},
        {"tail": life.tail_names, "level": ("level", level, {"units": "N"})},
        {
            "value": life.extreme.value,
            "low": life.extreme.low,
            "high": life.extreme.high,
            "years": options.return_period,
        },
    )
