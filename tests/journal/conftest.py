"""What tests of films share."""

import pytest

from loadflow.journal.models import reduced


@pytest.fixture
def alone(monkeypatch):
    """The rung "reduced" itself: what it does not find it may not take from the grid."""

    def refused(*given):
        raise AssertionError("the grid is asked")

    monkeypatch.setattr(reduced, "solve_on_grid", refused)
