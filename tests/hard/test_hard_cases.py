"""Every hard case converges with its residual or is refused by name; the docs list them all."""

from pathlib import Path

import friction_cases  # noqa: F401
import journal_cases  # noqa: F401
import motion_cases  # noqa: F401
import pytest
import record_cases  # noqa: F401
import rolling_cases  # noqa: F401
from hard_case import CASES

DOC = Path(__file__).parents[2] / "docs" / "hard-cases.md"


@pytest.mark.parametrize("case", CASES, ids=str)
def test_hard_case(case):
    outcome = case.solve()
    assert outcome.result
    if outcome.residual is not None:
        assert outcome.residual <= case.tolerance


def test_the_docs_list_every_case():
    text = DOC.read_text(encoding="utf-8")
    missing = [str(case) for case in CASES if f"| {case.name} |" not in text]
    assert not missing
