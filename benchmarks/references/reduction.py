"""Reduced against full series, measured with the film solver: the table of docs/reduction.md.

python -m benchmarks.references.reduction [CUBE] [--bearing N] [--seed 1] [--rung grid] [--write]

CUBE is a load cube or a folder of cases of design load case 1.1; without one, eleven wind speeds
are simulated with one seed. The film of every sample of every series is solved, and its orbit
followed: about 6 s a series with the reduced film, 70 s with finite volumes (``--rung grid``).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from benchmarks.common import ROOT, arguments, head, put, row
from loadflow.cube import open_cube, select
from loadflow.reduction import histogram
from loadflow.scene.journal import Journal
from loadflow.stages.reduction import reduced_dataset
from loadflow.studies.bearing_series import BearingSeries, iter_bearings
from loadflow.studies.design_loads.reduction_error import (
    HEADS,
    MEASURES,
    FilmError,
    Films,
    solve_films,
    summary_rows,
)
from loadflow.studies.simulated_cube import simulate_cube

DOC = ROOT / "docs" / "reduction.md"
BEGIN, END = "<!-- reduction: begin -->", "<!-- reduction: end -->"
SPEEDS = tuple(range(4, 25, 2))
VARIANTS = {
    "random, a tenth rounded up (the source's)": {"pick": "random", "rounding": "up"},
    "random, a tenth in all": {"pick": "random", "rounding": "total"},
    "extremes, a tenth in all": {"pick": "extremes", "rounding": "total"},
    "envelope, a tenth in all": {"pick": "envelope", "rounding": "total"},
}
Solved = list[tuple[BearingSeries, Films]]


def compare(solved: Solved, size: float, options: dict[str, str]) -> tuple[list[str], list[str]]:
    """Summary of one variant, and its rows series by series."""
    errors, plain, rows, kept = [], [], [], []
    for series, films in solved:
        got = histogram(series.speed, series.radial, series.time, size=size, **options)
        reduced = reduced_dataset(got, series.force, series.moment, by_moment=False)
        errors.append(FilmError.of(films, reduced))
        kept.append(got.index.size / got.total)
        plain.append(films.measures(got.index) / films.measures() - 1.0)
        rows.append(row(*errors[-1].as_row(series.case, series.bearing, kept[-1])))
    rows += [row(*cells) for cells in summary_rows(errors)]
    deviation = 100 * np.array([error.deviation for error in errors])
    unweighted = 100 * np.abs(plain).mean(axis=0)
    cells = [f"{100 * np.mean(kept):.1f}", *(f"{x:.3f}" for x in np.abs(deviation).mean(axis=0))]
    cells += [f"{deviation[:, 0].std():.3f}", f"{unweighted[1]:.2f}, {unweighted[3]:.2f}"]
    return cells, rows


def report(solved: Solved, size: float) -> str:
    """Markdown: mean deviations of every variant, then the last one series by series."""
    heads = ["pick and size", "kept, %", *(f"Δ{name}, %" for name in MEASURES)]
    heads += ["std of ΔE_max", "without weights: E_mean, So_mean"]
    lines = [head(*heads)]
    rows: list[str] = []
    for name, options in VARIANTS.items():
        cells, rows = compare(solved, size, options)
        lines.append(row(name, *cells))
    lines += ["", "Series by series, the last pick:", ""]
    return "\n".join([*lines, head(*HEADS), *rows])


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("cube", nargs="?", type=Path)
    parser.add_argument("--bearing", default="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=float, default=0.1)
    parser.add_argument("--rung", choices=["reduced", "grid"], default="reduced")
    parser.add_argument("--write", action="store_true", help="put the table into the docs")
    given = parser.parse_args()
    cube = (
        select(open_cube(given.cube), seed=given.seed)
        if given.cube
        else simulate_cube("nrel-5mw", SPEEDS, [given.seed], {"dlc": "1.1"})
    )
    solved = []
    for series in iter_bearings(cube, [given.bearing]):
        solved.append((series, solve_films(series, Journal(rung=given.rung))))
        print(series.source, flush=True)
    text = report(solved, given.size)
    print(text)
    if given.write:
        put(DOC, BEGIN, END, f"\n{text}\n")


if __name__ == "__main__":
    main()
