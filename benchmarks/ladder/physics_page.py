"""Tables and figures of what `benchmarks.ladder.physics` measured."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt

from benchmarks.common import ROOT, head, row
from benchmarks.ladder.physics_sizes import NO_ANSWER, SPEEDS, TURBINES
from benchmarks.ladder.whole_runs import ALL_SPEEDS, BEST, DEFAULT
from benchmarks.ladder.whole_runs import SPEEDS as RUN_AT
from loadflow.quantities import percent

FIGURE = ROOT / "docs" / "figures" / "physics.svg"
FRONT = ROOT / "docs" / "figures" / "speed-vs-error-runs.svg"
TINY = 1e-3
"""Share below which an effect is not worth a word."""

ROUNDING = 1e-9
"""Share below which nothing has changed but the last digits."""

READ = {
    "loads": ("bearing force DEL", "bearing load max"),
    "film": ("minimum film", "friction power"),
    "rolling": ("maximum force", "life"),
}
"""Quantities of the page, by what they belong to."""


def largest(found: dict[str, float]) -> str:
    """The quantity that moves most, and by how much."""
    if not found:
        return "-"
    name = max(found, key=lambda one: found[one])
    if found[name] < ROUNDING:
        return "nothing"
    return f"{percent(found[name])} of {name}"


def effects_of(measured: list[dict[str, Any]]) -> list[str]:
    """Names of all effects that were measured anywhere."""
    return list(dict.fromkeys(name for one in measured for name in one["sizes"]))


def size_table(measured: list[dict[str, Any]]) -> str:
    """The figure, and a row for each effect and turbine, a column for each wind speed."""
    picture = "Size of each effect over wind speed; the grey line is 5 %"
    lines = [f"![{picture}](figures/{FIGURE.name})\n"]
    lines += ["The answer that moves most, and by how much:\n"]
    lines += [head("effect", "turbine", *(f"{speed:g} m/s" for speed in SPEEDS))]
    for effect in effects_of(measured):
        for turbine in TURBINES:
            at = {one["speed"]: one for one in measured if one["turbine"] == turbine}
            cells = [
                (NO_ANSWER if at[speed]["refused"][effect] == NO_ANSWER else "refused")
                if effect in at[speed]["refused"]
                else largest(at[speed]["sizes"].get(effect, {}))
                if speed in at
                else "-"
                for speed in SPEEDS
            ]
            lines.append(row(effect, turbine, *cells))
    return "\n".join(lines)


def draw_sizes(measured: list[dict[str, Any]]) -> None:
    """Size over wind speed: a panel for each effect, a line for each turbine and answer."""
    effects = effects_of(measured)
    rows = -(-len(effects) // 3)
    figure, axes = plt.subplots(
        rows, 3, figsize=(12, 3 * rows), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(effects) :]:
        axis.remove()
    read = [name for names in READ.values() for name in names]
    for axis, effect in zip(axes.flat, effects):
        for colour, turbine in enumerate(TURBINES):
            ours = [
                (one["speed"], one["sizes"][effect])
                for one in measured
                if one["turbine"] == turbine and effect in one["sizes"]
            ]
            for name, style in zip(read, ("-", "--") * 3):
                points = [(speed, 100 * found[name]) for speed, found in ours if name in found]
                if points:
                    axis.plot(*zip(*points), style, color=f"C{colour}", label=f"{turbine}, {name}")
        axis.axhline(5.0, color="0.6", lw=0.8)
        axis.set(title=effect, xlabel="wind speed, m/s", ylabel="change, %", yscale="symlog")
        axis.legend(fontsize=5)
    with plt.rc_context({"svg.hashsalt": "loadflow"}):
        figure.savefig(FIGURE, metadata={"Date": None})
    plt.close(figure)


def scene_table(found: list[dict[str, Any]]) -> str:
    """A row for each scene: what was kept, what was left out and why, what is expected then."""
    lines = [head("scene", "kept, as it moves", "left out", "largest expected error")]
    for one in found:
        split: dict[bool, list[str]] = {True: [], False: []}
        for effect in one["effects"]:
            size = max((effect["size"] or {}).values(), default=0.0)
            if size > TINY:
                split[effect["kept"]].append(f"{effect['name']}: {largest(effect['size'])}")
            elif not effect["kept"] and effect["why"].startswith(("load ", "orbit ")):
                split[False].append(f"{effect['name']}: {NO_ANSWER} with it")
        errors = {
            f"{result}: {name}": error
            for result, quantities in one["errors"].items()
            for name, error in quantities.items()
            if error is not None
        }
        cells = ["; ".join(split[kept]) or "-" for kept in (True, False)]
        lines.append(row(one["scene"], *cells, largest(errors)))
    return "\n".join(lines)


def best_of(found: list[dict[str, Any]]) -> dict[str, Any]:
    """The run that the others are held against."""
    return next(one for one in found if one["run"] == BEST)


def errors_of(found: list[dict[str, Any]]) -> list[dict[str, float]]:
    """Errors of the answers of each run against the best."""
    best = best_of(found)["answers"]
    return [{name: abs(one["answers"][name] / best[name] - 1) for name in best} for one in found]


def whole_seconds(one: dict[str, Any], seeds: int = 6) -> float:
    """Processor time of the main job by these models: what is done once, and its load cases."""
    cases = ALL_SPEEDS * seeds / len(RUN_AT)
    return float(one["seconds"] + (cases - 1.0) * one["of_cases"])


def run_table(found: list[dict[str, Any]]) -> str:
    """Times, measured and of the whole job; errors against the best run."""
    found = sorted(found, key=whole_seconds)
    best = best_of(found)
    names = list(best["answers"])
    lines = [
        f"![Largest error of an answer over the time of the whole run](figures/{FRONT.name})\n"
    ]
    times = ("measured, s", "main job, s", "one seed, s", "relative time")
    lines += [head("run", *times, *names, "largest", numbers=True)]
    for one, errors in zip(found, errors_of(found)):
        cells = [percent(error) for error in (*errors.values(), max(errors.values()))]
        whole = whole_seconds(one)
        took = [f"{t:.0f}" for t in (one["seconds"], whole, whole_seconds(one, seeds=1))]
        lines.append(row(one["run"], *took, f"{whole / whole_seconds(best):.2g}", *cells))
    return "\n".join(lines)


def draw_front(found: list[dict[str, Any]]) -> None:
    """Largest error of an answer over the time, and the front that no run beats in both."""
    times = [whole_seconds(one) / whole_seconds(best_of(found)) for one in found]
    errors = [100 * max(one.values()) for one in errors_of(found)]
    figure, axis = plt.subplots(figsize=(7.5, 4.5), layout="constrained")
    front: list[tuple[float, float]] = []
    for k, (when, error) in sorted(enumerate(zip(times, errors)), key=lambda one: one[1]):
        if not front or error < front[-1][1]:
            front.append((when, error))
        own = found[k]["run"] == DEFAULT
        axis.plot(when, error, "o", ms=9 if own else 5, color="C3" if own else "C0")
        axis.annotate(found[k]["run"], (when, error), (5, 4), textcoords="offset points", size=7)
    axis.step(*zip(*front), where="post", color="0.6", lw=1, zorder=0)
    axis.set(xscale="log", xlabel="processor time of the main job over that by the best models")
    axis.set(ylabel="largest error of an answer, %", ylim=(0, None))
    with plt.rc_context({"svg.hashsalt": "loadflow"}):
        figure.savefig(FRONT, metadata={"Date": None})
    plt.close(figure)
