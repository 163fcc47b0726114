"""Pictures of the ladder: error over time of every rung, and the Pareto front."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt

from benchmarks.ladder.measuring import Rungs

LEAST = 1e-6  # errors below this are drawn here


def draw(stage: str, rungs: Rungs, path: Path) -> None:
    """Draw largest error over relative time, a panel for each quantity; dominated rungs hollow."""
    measured = {name: entry for name, entry in rungs.items() if entry["errors"]}
    quantities = list(dict.fromkeys(q for entry in measured.values() for q in entry["errors"]))
    columns = min(3, len(quantities))
    rows = -(-len(quantities) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(4 * columns, 3 * rows), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(quantities) :]:
        axis.remove()
    for axis, quantity in zip(axes.flat, quantities):
        points = {
            name: (entry["relative_time"], max(entry["errors"][quantity]["max"], LEAST))
            for name, entry in measured.items()
            if quantity in entry["errors"]
        }
        for name, (time, error) in points.items():
            filled = "dominated_by" not in measured[name]
            axis.loglog(time, error, "o", color="C0", fillstyle="full" if filled else "none")
            axis.annotate(name, (time, error), xytext=(4, 4), textcoords="offset points", size=7)
        axis.loglog(*zip(*front(list(points.values()))), "-", color="C0", lw=0.8, zorder=0)
        axis.set(title=quantity, xlabel="relative time", ylabel="largest relative error")
        axis.margins(0.25)
        axis.grid(True, which="both", lw=0.3)
    figure.suptitle(f"{stage}: filled on the Pareto front of all quantities, hollow dominated")
    path.parent.mkdir(exist_ok=True)
    with plt.rc_context({"svg.hashsalt": "loadflow"}):
        figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Points that no cheaper one beats, from the cheapest to the dearest."""
    kept: list[tuple[float, float]] = []
    for time, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((time, error))
    return kept
