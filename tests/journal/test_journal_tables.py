"""Every printed number of the journal bearing."""

import pytest

from loadflow.validation.journal import checks


@pytest.mark.parametrize("check", list(checks()), ids=lambda c: f"{c.source}: {c.name}")
def test_printed_number(check):
    assert check.ok, f"{check.got} beside {check.expected} (deviation {check.deviation:.4f})"
