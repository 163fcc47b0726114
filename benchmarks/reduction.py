"""Reduced against full series, measured with the film solver: the table of docs/reduction.md.

python benchmarks/reduction.py [CUBE] [--bearing N] [--seed 1] [--keep FOLDER] [--transient]

CUBE is a load cube or a folder of cases of design load case 1.1; without one, eleven wind speeds
are simulated with one seed. Every sample of every series is solved (about 40 s a series; 30 s more
for the transient orbit); `--keep` stores these films, so that a second call only compares.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from loadflow.cube import open_cube, select
from loadflow.journal import GasMixture, JournalBearing, Lubricant
from loadflow.reduction import Reduced, histogram, phases
from loadflow.stages.simulated import simulate_cube
from loadflow.stages.suspended import BearingSeries, iter_bearings

DOC = Path(__file__).parents[1] / "docs" / "reduction.md"
BEGIN, END = "<!-- reduction: begin -->", "<!-- reduction: end -->"
SPEEDS = tuple(range(4, 25, 2))
REFERENCE = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(viscosity=0.050)
FILM = {"cavitation": GasMixture(0.05e6), "edge_pressure": 0.5e6, "grid": (60, 20)}
VARIANTS = {
    "random, a tenth rounded up (the source's)": {"pick": "random", "rounding": "up"},
    "random, a tenth in all": {"pick": "random", "rounding": "total"},
    "extremes, a tenth in all": {"pick": "extremes", "rounding": "total"},
}
MEASURES = ("E_max", "E_mean", "So_max", "So_mean", "energy")


@dataclass(frozen=True)
class Films:
    """Eccentricity ratio, So of the largest pressure and friction power (W) of a full series, and
    the eccentricity ratio of its orbit (empty if not asked for).
    """

    ratio: np.ndarray
    number: np.ndarray
    power: np.ndarray
    orbit: np.ndarray

    def measures(self, reduced: Reduced | None = None, weighted: bool = True) -> np.ndarray:
        """`MEASURES` of the full series, or of what the reduction kept of it."""
        rows = slice(None) if reduced is None else reduced.index
        weight = reduced.weight if reduced is not None and weighted else None
        ratio, number, power = self.ratio[rows], self.number[rows], self.power[rows]
        means = (np.average(x, weights=weight) for x in (ratio, number, power))
        e, so, p = means
        return np.array([ratio.max(), e, number.max(), so, p])


def solve(series: BearingSeries, transient: bool, keep: Path | None) -> Films:
    """Film of every sample, read back if it was solved before."""
    file = keep / f"{series.case}_{series.bearing}.npz" if keep else None
    stored = dict(np.load(file)) if file and file.exists() else {}
    force, speed = series.radial, series.speed
    if not stored:
        film = REFERENCE.equilibrium(force, speed, OIL, **FILM)
        scale = REFERENCE.relative_clearance**2 / (OIL.viscosity * np.abs(speed))
        stored = {
            "ratio": film.eccentricity_ratio,
            "number": film.maximum_pressure * scale,
            "power": film.friction_power,
            "orbit": np.empty(0),
        }
    if transient and not stored["orbit"].size:
        orbit = REFERENCE.orbit(series.time, force, speed, OIL, **FILM)
        stored["orbit"] = orbit["eccentricity_ratio"].values
    if file:
        file.parent.mkdir(parents=True, exist_ok=True)
        np.savez(file, **stored)
    return Films(**stored)


def turning(series: BearingSeries) -> BearingSeries:
    """Cut off standstill, in which no film carries the load."""
    parts = [p for p in phases(series.speed) if p.name != "standstill"]
    rows = np.concatenate([np.arange(p.start, p.stop) for p in parts])
    cut = {name: getattr(series, name)[rows] for name in ("time", "speed", "force", "moment")}
    return replace(series, **cut)


def report(solved: list[tuple[BearingSeries, Films]], size: float) -> str:
    """Markdown: deviations of every variant, then the best one speed by speed."""
    lines = [
        "| pick and size | kept % | "
        + " | ".join(MEASURES)
        + " | std of ΔE_max | without weights: "
        "E_mean, So_mean |",
        "|---" * (len(MEASURES) + 4) + "|",
    ]
    detail: list[str] = []
    for name, options in VARIANTS.items():
        rows, plain, kept = [], [], []
        detail = []
        for series, films in solved:
            reduced = histogram(series.speed, series.radial, series.time, size=size, **options)
            full = films.measures()
            rows.append(100 * (films.measures(reduced) / full - 1))
            plain.append(100 * (films.measures(reduced, weighted=False) / full - 1))
            kept.append(100 * reduced.index.size / reduced.total)
            detail.append(_detail(series, films, rows[-1], full, kept[-1]))
        mean, unweighted = np.abs(rows).mean(axis=0), np.abs(plain).mean(axis=0)
        cells = " | ".join(f"{x:.3f}" for x in mean)
        lines.append(
            f"| {name} | {np.mean(kept):.1f} | {cells} | {np.std(np.array(rows)[:, 0]):.3f} | "
            f"{unweighted[1]:.2f}, {unweighted[3]:.2f} |"
        )
    heads = ["V m/s", "kept %", "E_max", *(f"Δ{m} %" for m in MEASURES), "orbit E_max", "over it %"]
    lines += ["", "Speed by speed, the last pick; the orbit is that of the whole series:", ""]
    lines += ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|", *detail]
    return "\n".join(lines)


def _detail(
    series: BearingSeries, films: Films, deviation: np.ndarray, full: np.ndarray, kept: float
) -> str:
    cells = [f"{series.labels['wind_speed']:g}", f"{kept:.1f}", f"{full[0]:.4f}"]
    cells += [f"{x:+.3f}" for x in deviation]
    if films.orbit.size:
        largest = float(films.orbit.max())
        reduced = full[0] * (1 + deviation[0] / 100)
        cells += [f"{largest:.4f}", f"{100 * (reduced / largest - 1):+.2f}"]
    else:
        cells += ["-", "-"]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cube", nargs="?", type=Path)
    parser.add_argument("--bearing", default="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=float, default=0.1)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--transient", action="store_true")
    parser.add_argument("--write", action="store_true", help="put the table into the docs")
    given = parser.parse_args()
    cube = (
        select(open_cube(given.cube), seed=given.seed)
        if given.cube
        else simulate_cube("nrel-5mw", SPEEDS, [given.seed], {"dlc": "1.1"})
    )
    solved = []
    for series in map(turning, iter_bearings(cube, [given.bearing])):
        solved.append((series, solve(series, given.transient, given.keep)))
        print(series.source, flush=True)
    text = report(solved, given.size)
    print(text)
    if given.write:
        before, _, rest = DOC.read_text(encoding="utf-8").partition(BEGIN)
        after = rest.partition(END)[2]
        DOC.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
