"""What the source states of the reduction and can be checked without a bearing.

Its periodic loads are found again in series that are synthesised from its tables, with the true
frequencies and step of 0.03 s. Transformed as the source did, with a step of 0.025 s, they give its
printed frequencies, which are 1.2 times too high.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from loadflow.validation.check import Check

# Table 5-13 of [Jonuschies 2015]: V m/s; for Fx and Fy mean and amplitude in kN and ω in °/s
TABLE_5_13 = {
    4: ((1373.06, 181.04, 1.76), (24.81, 245.38, 2.20)),
    8: ((1490.81, 322.84, 3.08), (130.04, 317.58, 1.76)),
    12: ((1670.21, 388.40, 2.64), (155.25, 287.56, 1.32)),
    16: ((1974.87, 489.14, 3.76), (-15.07, 507.18, 7.03)),
    20: ((2275.48, 659.54, 6.15), (-212.01, 446.52, 7.91)),
    24: ((2584.26, 615.76, 6.59), (-459.68, 608.10, 4.83)),
}
# Table 5-14, V = 24 m/s, per seed and axis: amplitude and ω of base, first and second additional
TABLE_5_14 = {
    1: (
        ((615.76, 6.59), (336.02, 87.01), (204.15, 261.04)),
        ((608.10, 4.83), (329.20, 87.01), (183.02, 265.87)),
    ),
    2: (
        ((625.83, 13.18), (340.64, 87.01), (238.30, 256.20)),
        ((728.74, 7.47), (370.41, 87.01), (205.97, 256.20)),
    ),
    3: (
        ((489.43, 5.27), (339.83, 87.01), (266.35, 259.72)),
        ((457.54, 2.19), (331.02, 87.01), (184.46, 234.67)),
    ),
}
TRUE_STEP, WRONG_STEP, SAMPLES = 0.03, 0.025, 20_000
BOUNDS = (0.1, 1.0)  # Hz, as the film of the reference bearing gives for V = 24 m/s


def checks() -> Iterator[Check]:
    """Rules of the quasi-static reduction, and the periodic loads of Tables 5-13 and 5-14."""
    yield from _rules()
    for speed, axes in TABLE_5_13.items():
        base = [[(amplitude, omega)] for _, amplitude, omega in axes]
        yield from _found_again(f"V = {speed} m/s", "Table 5-13", base)
    for seed, tones in TABLE_5_14.items():
        yield from _found_again(f"seed {seed}", "Table 5-14", tones)


def _found_again(
    name: str, table: str, axes: Sequence[Sequence[tuple[float, float]]]
) -> Iterator[Check]:
    """Amplitude and printed frequency of every harmonic, from a series with the true ones."""
    from loadflow.reduction import periodic

    sample = np.arange(SAMPLES)
    trap = TRUE_STEP / WRONG_STEP
    force = np.stack(
        [
            sum(a * np.sin(np.radians(w / trap) * TRUE_STEP * sample) for a, w in tones)
            for tones in axes
        ],
        axis=1,
    )
    printed = periodic(
        np.full(SAMPLES, 12.1 * np.pi / 30),
        force,
        WRONG_STEP * sample,
        bounds=BOUNDS,
        additional=len(axes[0]) - 1,
    )
    for axis, tones, found in zip(("Fx", "Fy"), axes, printed.harmonics):
        for (amplitude, omega), h in zip(tones, found):
            what = f"{name}, {axis}, {h.kind}"
            yield Check(f"{what}: amplitude", table, amplitude, h.amplitude, 1e-3, unit="kN")
            # half of the last printed digit
            yield Check(
                f"{what}: ω with the wrong step", table, omega, h.frequency * 360, 0.005,
                "absolute", "°/s",
            )  # fmt: skip


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
    yield Check("weights sum to", "(4.31)", 1000, float(reduced.weight.sum()), 1e-12)
