"""Load processing of a full cube, against scipy and pandas one-liners that do the same.

python -m benchmarks.peers.processing [--speeds 11] [--seeds 6] [--steps 24000]

Prints seconds of both, their ratio and the largest relative deviation of the numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import permutations

import numpy as np
import pandas as pd
import scipy.signal
import scipy.stats

from benchmarks.common import arguments, head, row, timed
from loadflow.reduction import damage_equivalent_load, histogram, rainflow
from loadflow.reduction.quasistatic import number_of_classes
from loadflow.seeds import averaged_spectrum, equality, siegel_tukey_ranks

DT = 0.025
Numbers = list[np.ndarray]


def cube(speeds: int, seeds: int, steps: int) -> np.ndarray:
    """Speed (rad/s) and two forces (N), shape (wind speed, seed, component, time)."""
    rng = np.random.default_rng(0)
    a = np.exp(-DT / 3.0)
    shape = (speeds, seeds, 3, steps)
    noise = scipy.signal.lfilter([np.sqrt(1 - a * a)], [1, -a], rng.standard_normal(shape), axis=-1)
    tone = np.sin(3 * 1.267 * DT * np.arange(steps))
    scale = np.array([0.03, 3e5, 3e5])[:, None]
    return np.array([1.267, 2.5e6, -4e5])[:, None] + scale * (noise + 0.5 * tone)


def series(x: np.ndarray) -> Iterator[np.ndarray]:
    """Every single record."""
    yield from x.reshape(-1, x.shape[-1])


def sets(x: np.ndarray) -> Iterator[np.ndarray]:
    """Seeds (seed, time) of each wind speed and component."""
    for speed in x:
        yield from speed.swapaxes(0, 1)


def printed_tests(x: np.ndarray) -> Numbers:
    verdicts = (equality(s, DT, method="as-printed") for s in sets(x))
    return [
        np.array([stage.statistic for stage in (v.location, v.spread, v.spectrum)])
        for v in verdicts
    ]


def printed_tests_scipy(x: np.ndarray) -> Numbers:
    result = []
    for s in sets(x):
        place = scipy.stats.rankdata(s, axis=None).astype(int) - 1
        ranks = siegel_tukey_ranks(s.size)[place].reshape(s.shape)
        density = scipy.signal.periodogram(s, 1 / DT)[1][:, 1:]
        largest = max(np.max(np.abs(a - b) / a) for a, b in permutations(density, 2))
        tests = scipy.stats.kruskal(*s), scipy.stats.kruskal(*ranks)
        result.append(np.array([*(t.statistic for t in tests), largest]))
    return result


def spectra(x: np.ndarray) -> Numbers:
    return [averaged_spectrum(s, dt=DT, segment=40.0).density[1:] for s in series(x)]


def spectra_scipy(x: np.ndarray) -> Numbers:
    length = round(40.0 / DT)
    return [
        scipy.signal.welch(s - s.mean(), 1 / DT, nperseg=length, detrend=False)[1][1:]
        for s in series(x)
    ]


def fatigue(x: np.ndarray) -> Numbers:
    duration = x.shape[-1] * DT
    return [damage_equivalent_load(rainflow(s), [4, 10], duration) for s in series(x)]


def fatigue_python(x: np.ndarray) -> Numbers:
    """The algorithm of ASTM E1049, 5.4.4, on the turning points."""
    result = []
    for s in series(x):
        turning = np.flatnonzero(np.diff(np.sign(np.diff(s)))) + 1
        stack: list[float] = []
        sums = np.zeros(2)
        for value in s[np.concatenate(([0], turning, [s.size - 1]))].tolist():
            stack.append(value)
            while len(stack) > 2 and abs(stack[-1] - stack[-2]) >= abs(stack[-2] - stack[-3]):
                whole = len(stack) > 3
                span = abs(stack[-2] - stack[-3])
                sums += np.array([span**4, span**10]) * (1.0 if whole else 0.5)
                del stack[-3 if whole else 0 : -1 if whole else 1]
        spans = np.abs(np.diff(stack))
        sums += 0.5 * np.array([np.sum(spans**4), np.sum(spans**10)])
        result.append((sums / (s.size * DT)) ** (1 / np.array([4, 10])))
    return result


def reduction(x: np.ndarray) -> Numbers:
    cases = x.reshape(-1, *x.shape[2:])
    kept = [histogram(c[0], c[1:].T).counts_reduced for c in cases]
    return [k[k > 0].astype(float) for k in kept]


def reduction_pandas(x: np.ndarray) -> Numbers:
    result = []
    for c in x.reshape(-1, *x.shape[2:]):
        frame = pd.DataFrame({"n": c[0], "F": np.hypot(c[1], c[2])})
        bins = number_of_classes(len(frame))
        groups = frame.groupby(
            [pd.cut(frame[k], bins, labels=False, right=False) for k in ("n", "F")]
        )
        size = groups.size()
        q = np.ceil(np.round(size * 0.1, 9)).astype(int)
        picked = [g.sample(q[key], random_state=0) for key, g in groups]
        result.append(np.array([len(p) for p in picked], dtype=float))
    return result


TASKS: dict[str, tuple[Callable[[np.ndarray], Numbers], Callable[[np.ndarray], Numbers]]] = {
    "three printed tests": (printed_tests, printed_tests_scipy),
    "averaged spectra": (spectra, spectra_scipy),
    "rainflow, DEL m = 4, 10": (fatigue, fatigue_python),
    "reduction to a tenth": (reduction, reduction_pandas),
}


def deviation(ours: Numbers, theirs: Numbers) -> float:
    """Largest relative deviation."""
    return max(float(np.max(np.abs(a - b) / np.abs(b))) for a, b in zip(ours, theirs, strict=True))


def main() -> None:
    parser = arguments(__doc__)
    for name, default in (("speeds", 11), ("seeds", 6), ("steps", 24_000)):
        parser.add_argument(f"--{name}", type=int, default=default)
    options = parser.parse_args()
    x = cube(options.speeds, options.seeds, options.steps)
    small = x[:1, :2, :, :2000]
    print(head("task", "loadflow s", "one-liners s", "ratio", "largest deviation"))
    total = np.zeros(2)
    for name, (ours, theirs) in TASKS.items():
        ours(small), theirs(small)  # imports and caches
        (a, mine), (b, other) = timed(partial(ours, x)), timed(partial(theirs, x))
        total += mine, other
        print(of_times(name, mine, other, f"{deviation(a, b):.1e}"))
    print(of_times("all of it", float(total[0]), float(total[1]), ""))
    _, calibrated = timed(lambda: [np.array(equality(s, DT).pvalue) for s in sets(x)])
    print(row("calibrated equality (no counterpart)", f"{calibrated:.2f}", "", "", ""))


def of_times(name: str, mine: float, other: float, off: str) -> str:
    return row(name, f"{mine:.2f}", f"{other:.2f}", f"{other / mine:.1f}", off)


if __name__ == "__main__":
    main()
