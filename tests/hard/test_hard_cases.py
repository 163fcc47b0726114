"""Every hard case converges with its residual or is refused by name; the docs list them all."""

import json
from pathlib import Path

import composed_cases  # noqa: F401
import friction_cases  # noqa: F401
import journal_cases  # noqa: F401
import motion_cases  # noqa: F401
import pytest
import record_cases  # noqa: F401
import rolling_cases  # noqa: F401
from hard_case import CASES

HERE = Path(__file__).parent
DOC = HERE.parents[1] / "docs" / "hard-cases.md"


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


def test_what_peers_do_is_told_of_cases_that_are_there():
    peers = json.loads((HERE / "peers.json").read_text(encoding="utf-8"))
    assert set(peers) <= set(map(str, CASES))


def test_every_solver_that_is_drawn_at_random_was_drawn_at_length():
    drawn = json.loads((HERE / "draws.json").read_text(encoding="utf-8"))
    for path in HERE.glob("test_fuzz*.py"):
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("def test_"):
                row = drawn[line.removeprefix("def ").split("(")[0]]
                assert row["draws"] >= 1000
                assert row["failing"] == 0
