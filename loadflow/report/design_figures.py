"""Figures of a search for the best design: the front, and maps over two keys."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from loadflow.plots.style import figure

MAPPED = (("energy", "energy lost a year, MWh"), ("load_factor", "capacity margin, ×"))
"""What is mapped, and how it is called."""

_GOOD, _BAD = "#1f5a94", "#b9c2cc"


def front_figure(data: Mapping[str, Any]) -> Figure:
    """Draw friction energy over margin: all designs, the front, the best one, that as given.

    Parameters
    ----------
    data : mapping
        `loadflow.studies.design.result.Designs.as_dict`.
    """
    drawing, axis = figure(height=3.6)
    rows = [(one["numbers"], one["why"]) for one in data["designs"]]
    x, y, condition = (
        np.array([_number(numbers, name) for numbers, _ in rows])
        for name in ("load_factor", "energy", "condition")
    )
    keep = np.isfinite(y) & ~_breaks(condition)
    axis.scatter(x[~keep], y[~keep], s=9, c=_BAD, marker="x", lw=0.7, label="breaks a condition")
    axis.scatter(x[keep], y[keep], s=10, c=_GOOD, alpha=0.35, lw=0, label="designs")
    front = data["front"]["index"]
    axis.plot(x[front], y[front], "-o", color="#d1612b", ms=3.5, lw=1.3, label="front")
    given = data["given"]
    axis.plot(
        _number(given, "load_factor"), _number(given, "energy"), "s", color="#333333", ms=7,
        label="as given",
    )  # fmt: skip
    if data["best"] is not None:
        k = data["best"]
        axis.plot(x[k], y[k], "*", color="#3d8b5f", ms=14, label="best, checked")
    axis.axvline(data["margin"], color="#333333", lw=0.8, ls="--")
    axis.set(xlabel="capacity margin, ×", ylabel="energy lost a year, MWh")
    shown = y[np.isfinite(y) & (x >= 0.5 * data["margin"])]
    if shown.size:
        axis.set_ylim(0.9 * shown.min(), min(1.05 * shown.max(), 4 * np.median(shown)))
    axis.legend(loc="best")
    return drawing


def map_figure(data: Mapping[str, Any], number: int) -> Figure:
    """Draw a map: energy and margin over two keys; hatched where a limit is broken."""
    one = data["maps"][number]
    axes = {axis["key"]: axis for axis in data["axes"]}
    drawing, panels = figure(1, 2, height=3.4)
    broken = broken_in(one["values"], data["margin"])
    for panel, (name, title) in zip(panels, MAPPED):
        values = np.ma.masked_invalid(_table(one["values"][name]))
        if values.count():
            shown = panel.contourf(one["across"], one["up"], values, 12, cmap="viridis")
            drawing.colorbar(shown, ax=panel)
        panel.contourf(
            one["across"], one["up"], broken.astype(float), [0.5, 1.5], colors="none",
            hatches=["///"],
        )  # fmt: skip
        if data["best"] is not None:
            best = data["designs"][data["best"]]["point"]
            where = [list(axes).index(key) for key in one["keys"]]
            panel.plot(best[where[0]], best[where[1]], "*", color="white", mec="black", ms=13)
        panel.set_title(title)
        panel.grid(False)
        _label(panel, axes[one["keys"][0]], "x")
        _label(panel, axes[one["keys"][1]], "y")
    return drawing


def broken_in(values: Mapping[str, Any], asked: float) -> np.ndarray:
    """Where in a map a condition is broken, or less margin than was asked for, or no answer."""
    margin, condition = (_table(values[name]) for name in ("load_factor", "condition"))
    return ~(margin >= asked) | _breaks(condition)


def _label(panel: Axes, axis: Mapping[str, Any], side: str) -> None:
    unit = f", {axis['unit']}" if axis["unit"] else ""
    panel.set(**{f"{side}label": f"{axis['key']}{unit}"})
    if axis["values"]:
        places = range(len(axis["values"]))
        panel.set(**{f"{side}ticks": places, f"{side}ticklabels": axis["values"]})


def _breaks(condition: np.ndarray) -> np.ndarray:
    """Whether a condition is broken; a bearing that has none, such as a rolling one, has NaN."""
    return condition < 1


def _table(rows: Any) -> np.ndarray:
    return np.array([[math.nan if v is None else v for v in row] for row in rows], float)


def _number(numbers: Mapping[str, Any], name: str) -> float:
    value = numbers.get(name)
    return math.nan if value is None else float(value)
