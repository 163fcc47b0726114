"""False alarms and power of the seed tests by simulation; writes the table of docs/seeds.md.

python -m benchmarks.references.seed_tests [--cases 400]
"""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from benchmarks.common import ROOT, arguments, head, put, row
from loadflow.seeds import equality

DT, DURATION, SEEDS, MEAN, SIGMA, TONE, P3 = 0.05, 600.0, 6, 1.0, 0.1, 0.1, 0.605
DOC = ROOT / "docs" / "seeds.md"
BEGIN, END = "<!-- seed tests: begin -->", "<!-- seed tests: end -->"


def noise(rng: np.random.Generator, tau: float) -> np.ndarray:
    """Six records of first-order noise of unit variance with correlation time `tau`."""
    a = np.exp(-DT / tau)
    e = rng.standard_normal((SEEDS, round(DURATION / DT)))
    e[:, 0] /= np.sqrt(1 - a * a)
    return lfilter([np.sqrt(1 - a * a)], [1, -a], e, axis=1)


def tone(rng: np.random.Generator) -> np.ndarray:
    """Six 3p sines of unit amplitude and random phase."""
    t = DT * np.arange(round(DURATION / DT))
    return np.sin(2 * np.pi * P3 * t + rng.uniform(0, 2 * np.pi, (SEEDS, 1)))


def records(rng: np.random.Generator, tau: float, change: str) -> np.ndarray:
    """Six loads of mean 1, turbulence 10 % and a 3p of 10 %; the first one changed."""
    mean, sigma, amplitude = (np.full((SEEDS, 1), v) for v in (MEAN, SIGMA, TONE))
    if change == "mean +2 %":
        mean[0] *= 1.02
    elif change == "spread +5 %":
        sigma[0] *= 1.05
        amplitude[0] *= 1.05
    elif change == "3p +10 %":
        amplitude[0] *= 1.10
    return mean + sigma * noise(rng, tau) + amplitude * tone(rng)


def rejections(tau: float, change: str, method: str, cases: int) -> np.ndarray:
    """Share of cases in which location, spread, spectrum and all together say different."""
    rng = np.random.default_rng([2015, round(10 * tau)])
    counts = np.zeros(4)
    for _ in range(cases):
        got = equality(records(rng, tau, change), DT, method=method)
        counts += [
            not s for s in (got.location.equal, got.spread.equal, got.spectrum.equal, got.equal)
        ]
    return counts / cases


def table(cases: int) -> str:
    """Markdown table of the rejection rates in per cent."""
    names = ("correlation time", "difference", "method", "location", "spread", "spectrum", "any")
    lines = [head(*names)]
    for tau in (1.0, 3.0, 10.0):
        for change in ("none", "mean +2 %", "spread +5 %", "3p +10 %"):
            for method in ("as-printed", "calibrated"):
                rates = 100 * rejections(tau, change, method, cases)
                cells = (f"{r:.1f}" for r in rates)
                lines.append(row(f"{tau:g} s", change, method, *cells))
                print(lines[-1], flush=True)
    return "\n".join(lines)


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--cases", type=int, default=400)
    cases = parser.parse_args().cases
    rows = table(cases)
    note = f"Rejections in %, {cases} simulated sets of six seeds each, α = 5 %:"
    put(DOC, BEGIN, END, f"{note}\n\n{rows}")


if __name__ == "__main__":
    main()
