"""Every printed number that `loadflow validate` shows is within its stated tolerance."""

from dataclasses import replace

import pytest

from loadflow import validation
from loadflow.validation import _slewing_refused, rings


@pytest.mark.parametrize("name", validation.names())
def test_every_printed_number_is_within_its_tolerance(name):
    rows = list(validation.all_checks(name))
    bad = [row for row in rows if row.outcome == "out"]
    assert rows, f"the table {name} is empty"
    assert {row.evidence for row in rows} <= set(validation.EVIDENCE)
    assert not bad, "\n".join(f"{row} deviates by {row.deviation:+.3g}" for row in bad)


def test_a_number_that_is_not_a_number_is_never_ok():
    for kind in ("relative", "absolute", "below"):
        assert not validation.Check("x", "none", 1.0, float("nan"), 10.0, kind).ok


def test_a_refused_number_is_in_order_only_while_it_contradicts_its_source():
    def refused(got):
        return validation.Check("x", "none", 1.0, got, 0.1, refused="two values")

    assert refused(1.2).ok
    assert refused(1.2).verdict == "refused: two values"
    assert not refused(1.05).ok
    assert not refused(float("nan")).ok
    assert [validation.Check("x", "none", 1.0, got, 0.1).verdict for got in (1.0, 2.0)] == [
        "ok", "out",
    ]  # fmt: skip


def test_a_number_that_ours_misses_is_in_order_only_while_it_does():
    row = validation.Check("x", "none", 1.0, 1.2, 0.1, missed="rigid rings")
    assert (row.outcome, row.verdict) == ("missed", "missed: rigid rings")
    assert replace(row, got=1.05).outcome == "out"
    assert replace(row, got=float("nan")).outcome == "out"


def test_a_number_that_needs_what_is_not_installed_is_told_apart(monkeypatch):
    monkeypatch.setattr(rings, "ABSENT", "needs scikit-fem")
    rows = [*rings.checks(), *rings.printed()]
    found = [row for row in rows if row.outcome == "not computed"]
    assert len(found) == 41
    assert {row.outcome for row in rows} == {"ok", "not computed"}
    assert all(row.verdict == "not computed: needs scikit-fem" for row in found)


def test_rows_keep_what_they_say_themselves():
    @validation.evidence("closed form")
    def rows():
        yield validation.Check("x", "none", 1.0, 1.0, 0.1)
        yield validation.Check("y", "none", 1.0, 2.0, 0.1, evidence="consistency")

    assert [row.evidence for row in rows()] == ["closed form", "consistency"]
    counted = validation.counts(rows())
    assert list(counted) == ["closed form", "consistency"]
    assert counted["consistency"]["out"] == 1


def test_what_the_slewing_bearing_s_source_contradicts_is_refused():
    sources = " ".join(row.source for row in _slewing_refused.checks() if row.refused)
    for place in ("Bild 2.9", "App. B", "Tab. 3.5", "Tab. 3.8", "3.14", "Tab. 2.5", "Tab. 4.12"):
        assert place in sources
