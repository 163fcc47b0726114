"""Every printed number that `loadflow validate` shows is within its stated tolerance."""

import pytest

from loadflow import validation
from loadflow.validation import _slewing_refused


@pytest.mark.parametrize("name", validation.names())
def test_every_printed_number_is_within_its_tolerance(name):
    rows = list(validation.all_checks(name))
    bad = [row for row in rows if not row.ok]
    assert rows, f"the table {name} is empty"
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


def test_what_the_slewing_bearing_s_source_contradicts_is_refused():
    sources = " ".join(row.source for row in _slewing_refused.checks() if row.refused)
    for place in ("Bild 2.9", "App. B", "Tab. 3.5", "Tab. 3.8", "3.14", "Tab. 2.5", "Tab. 4.12"):
        assert place in sources
