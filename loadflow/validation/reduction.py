"""What the source states of the quasi-static reduction and can be checked without a bearing."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from loadflow.validation.check import Check


def checks() -> Iterator[Check]:
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
