"""Worked examples of the rank tests."""

from __future__ import annotations

from collections.abc import Iterator

from loadflow.validation.check import Check, evidence

# Table 4-3 of [Jonuschies 2015]
TABLE_4_3 = (
    (1.90, 2.25, 3.12, 4.25),
    (0.55, 2.91, 2.93, 3.23, 3.95),
    (1.66, 2.56, 3.31, 3.69),
    (0.79, 1.11, 2.09),
)
# Siegel and Tukey's example with 7 and 6 values
SIEGEL_TUKEY = ((33, 62, 84, 85, 88, 93, 97), (4, 16, 48, 51, 66, 98))


@evidence("print of the source")
def checks() -> Iterator[Check]:
    """Rank sums, statistics and p values as printed."""
    from loadflow.seeds import kruskal_wallis, meyer_bahlburg

    for test, name, sums, h in (
        (kruskal_wallis, "Kruskal-Wallis", (39, 47, 39, 11), 3.82),
        (meyer_bahlburg, "Meyer-Bahlburg", (35, 43, 37, 21), 0.41),
    ):
        got = test(TABLE_4_3)
        for i, (expected, ours) in enumerate(zip(sums, got.rank_sums), start=1):
            yield Check(f"{name}, R_{i}", "Table 4-3", expected, float(ours), 0.0, "absolute")
        yield Check(f"{name}, H", "Table 4-3", h, got.statistic, 0.005, "absolute")
    two = meyer_bahlburg(SIEGEL_TUKEY)
    source = "Siegel-Tukey 1960, by R PMCMRplus"
    for i, (expected, ours) in enumerate(zip((54, 37), two.rank_sums), start=1):
        name = f"Siegel-Tukey, R_{i}"
        yield Check(name, source, expected, float(ours), 0.0, "absolute", evidence="another code")
    for name, expected, got in (("H", 0.51020, two.statistic), ("p", 0.47505, two.pvalue)):
        yield Check(
            f"Siegel-Tukey, {name}", source, expected, got, 5e-6, "absolute",
            evidence="another code",
        )  # fmt: skip
