"""Every printed number that `loadflow validate` shows is within its stated tolerance."""

import pytest

from loadflow import validation


@pytest.mark.parametrize("name", validation.names())
def test_every_printed_number_is_within_its_tolerance(name):
    rows = list(validation.all_checks(name))
    bad = [row for row in rows if not row.ok]
    assert rows, f"the table {name} is empty"
    assert not bad, "\n".join(f"{row} deviates by {row.deviation:+.3g}" for row in bad)


def test_a_number_that_is_not_a_number_is_never_ok():
    for kind in ("relative", "absolute", "below"):
        assert not validation.Check("x", "none", 1.0, float("nan"), 10.0, kind).ok
