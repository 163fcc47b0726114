"""What can be checked of the reduction without a bearing: its rules, harmonics and cycles.

Tables 5-13 and 5-14 print the frequencies of loads whose series are not printed. Of two of them the
true value is known, the rotor's speed and three times it: through the source's transform, with its
step of 0.025 s in place of 0.03 s, they must come out as printed, 1.2 times too high.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from loadflow.validation.check import Check, evidence

TRUE_STEP, WRONG_STEP, SAMPLES, POINTS = 0.03, 0.025, 20_000, 2**15
ROTOR = 12.1 / 60  # Hz, speed at V = 24 m/s
# Table 5-14 of [Jonuschies 2015], V = 24 m/s, seeds 1 and 2, of Fx; multiple of the rotor's speed
PRINTED = ((1, 87.01), (3, 261.04))  # °/s
# ASTM E1049-85, 5.4.4: range, cycles of its example
ASTM_SERIES = (-2, 1, -3, 5, -1, 3, -4, 4, -2)
ASTM_CYCLES = ((3.0, 0.5), (4.0, 1.5), (6.0, 0.5), (8.0, 1.0), (9.0, 0.5))


def checks() -> Iterator[Check]:
    """Rules of the quasi-static reduction, harmonics, rainflow cycles, damage-equivalent loads."""
    yield from _rules()
    yield from _orders()
    yield from _harmonics()
    yield from _cycles()


@evidence("print of the source")
def _orders() -> Iterator[Check]:
    """Orders of the rotor by the source's transform: rectangular window, padded, wrong step.

    Its lines are 0.44 °/s apart, and the rotor's speed is a mean: one line is allowed.
    """
    from loadflow.reduction import find_harmonics

    line = 360 / (POINTS * WRONG_STEP)
    for order, printed in PRINTED:
        x = np.sin(2 * np.pi * order * ROTOR * TRUE_STEP * np.arange(SAMPLES))
        (found,) = find_harmonics(
            x, WRONG_STEP, 1, window="rectangular", points=POINTS, refine=False
        )
        got = found.frequency * 360
        name = f"ω of {order}p with the wrong step"
        yield Check(name, "Table 5-14", printed, got, line, "absolute", "°/s")


@evidence("closed form")
def _harmonics() -> Iterator[Check]:
    """Two sines whose frequencies lie between the lines of the transform."""
    from loadflow.reduction import find_harmonics

    time = 0.03 * np.arange(SAMPLES)
    tones = ((600.0, 0.05123), (200.0, 0.60417))
    x = 2500.0 + sum(a * np.sin(2 * np.pi * f * time + 0.3) for a, f in tones)
    for (amplitude, frequency), h in zip(tones, find_harmonics(x, 0.03, 2)):
        name = f"sine of {frequency} Hz"
        yield Check(f"{name}: frequency", "two sines", frequency, h.frequency, 1e-7, unit="Hz")
        yield Check(f"{name}: amplitude", "two sines", amplitude, h.amplitude, 1e-6, unit="kN")


@evidence("print of the source")
def _cycles() -> Iterator[Check]:
    """The example of ASTM E1049-85, and the range that damages as much as a sine of 0.5 Hz."""
    from loadflow.reduction import damage_equivalent_load, rainflow

    cycles = rainflow(ASTM_SERIES)
    for size, printed in ASTM_CYCLES:
        got = float(cycles.count[cycles.range == size].sum())
        yield Check(f"cycles of range {size:g}", "ASTM E1049-85", printed, got, 0.0, "absolute")
    time = np.linspace(0.0, 600.0, 60_001)
    sine = np.cos(np.pi * time)
    for exponent in (4.0, 10.0):
        exact = 2.0 * 0.5 ** (1 / exponent)
        got = float(damage_equivalent_load(sine, exponent, 600.0))
        name = f"damage-equivalent range of a sine of 0.5 Hz, m = {exponent:g}"
        yield Check(name, "2 A (f T/N)^(1/m)", exact, got, 1e-9, evidence="closed form")


@evidence("closed form")
def _rules() -> Iterator[Check]:
    """Rule for the number of classes (4.30) and rounding up of the class shares (4.32–4.36)."""
    from loadflow.reduction import histogram, number_of_classes

    for n, classes in ((100, 10), (1000, 32), (20_000, 43), (24_000, 44)):
        got = number_of_classes(n)
        yield Check(f"classes for {n} values", "(4.30)", classes, got, 0.0, "absolute")

    # classes of 1, 9, 10, 11, 969 pairs, to be reduced to a tenth: 0.1, 0.9, 1, 1.1, 96.9
    counts, kept = (1, 9, 10, 11, 969), (1, 1, 1, 2, 97)
    force = np.repeat(np.arange(5) + 0.5, counts)
    reduced = histogram(
        np.ones(force.size),
        np.stack([force, np.zeros_like(force)], axis=1),
        size=0.1,
        classes=([0.5, 1.5], np.arange(6)),
    )
    for pairs, expected, got in zip(counts, kept, reduced.counts_reduced[0]):
        name = f"kept of {pairs} of 1000 pairs at a tenth"
        yield Check(name, "(4.32-4.36)", expected, int(got), 0.0, "absolute")
    total = float(reduced.weight.sum())
    yield Check("weights sum to", "(4.31)", 1000, total, 1e-12, evidence="consistency")
