"""Draws that add up over several nights: no number twice, each with an outcome, the page true."""

import re
from pathlib import Path

import pytest

from benchmarks.robustness import kept
from benchmarks.robustness.families import FAMILIES, SEEDS, run
from benchmarks.robustness.hard_fuzz import joined

PAGE = Path(__file__).parents[2] / "docs" / "hard-cases.md"


def counted(numbers):
    """Each third draw has no answer."""
    refused = sum(number % 3 == 0 for number in numbers)
    rest = dict.fromkeys(kept.OUTCOMES, 0)
    both = {"answered": len(numbers) - refused, "reason": refused}
    return {"draws": len(numbers), "cap": 2.0} | rest | both


def test_a_family_goes_on_where_it_ended(tmp_path):
    file = tmp_path / "families.json"
    kept.keep("cylinder", 40, counted, file)
    kept.keep("line", 10, counted, file)
    sums = kept.keep("cylinder", 35, counted, file)
    (whole,) = kept.read(file)["cylinder"]
    assert (whole["first"], whole["draws"], whole["reason"]) == (0, 75, 25)
    assert sums == {name: counted(range(75))[name] for name in ("draws", *kept.OUTCOMES)}
    assert kept.next_number(kept.read(file)["line"]) == 10


def test_what_ends_early_keeps_its_whole_blocks(tmp_path):
    file = tmp_path / "families.json"

    def broken(numbers):
        if numbers.start >= 50:
            raise KeyboardInterrupt
        return counted(numbers)

    with pytest.raises(KeyboardInterrupt):
        kept.keep("cylinder", 200, broken, file)
    assert kept.next_number(kept.read(file)["cylinder"]) == 50


def test_what_must_not_be_raised_is_kept_with_its_number(monkeypatch, tmp_path):
    def broken(point):
        def work():
            raise ZeroDivisionError("float division by zero")

        return work

    monkeypatch.setitem(FAMILIES, "cylinder", broken)
    file = tmp_path / "families.json"
    for _ in range(2):
        kept.keep("cylinder", 1, lambda numbers: run("cylinder", numbers, show=False), file)
    (whole,) = kept.read(file)["cylinder"]
    error = "ZeroDivisionError: float division by zero"
    assert whole["raised"] == [[0, error], [1, error]]
    assert whole["raw"] == 2


def test_another_state_of_the_package_is_a_range_of_its_own():
    ranges = kept.added([], 0, "old", counted(range(30)))
    ranges = kept.added(ranges, 30, "new", counted(range(30, 60)))
    assert [part["state"] for part in ranges] == ["old", "new"]
    assert kept.totals(ranges)["draws"] == 60
    lines = list(kept.table({"cylinder": ranges}, {"cylinder": "rings"}))
    assert lines[2].startswith("| rings | 0 … 29 | 30 |")
    assert lines[-1].startswith("| rings, all | 2 ranges | 60 |")


def test_numbers_drawn_before_or_without_an_outcome_are_refused():
    ranges = kept.added([], 0, "a", counted(range(30)))
    with pytest.raises(ValueError, match="drawn before"):
        kept.added(ranges, 29, "a", counted(range(29, 40)))
    with pytest.raises(ValueError, match="1 without an outcome"):
        kept.added(ranges, 30, "a", counted(range(10)) | {"draws": 11})


def test_a_draw_of_a_family_is_the_same_in_every_block():
    whole = run("cylinder", range(6), show=False)
    parts = [run("cylinder", range(3 * k, 3 * k + 3), False) for k in (0, 1)]
    for name in kept.OUTCOMES:
        assert whole[name] == sum(part[name] for part in parts)


def test_seeds_of_a_fuzzed_test_add_up_and_none_counts_twice():
    row = {"seeds": [8], "draws": 100, "failing": 0, "refused": 0.1, "seconds": 3}
    more = row | {"seeds": [9], "draws": 300, "refused": 0.3}
    both = joined(row, more)
    assert (both["seeds"], both["draws"]) == ([8, 9], 400)
    assert both["refused"] == pytest.approx(0.25)
    with pytest.raises(ValueError, match=r"seeds \[8\] were drawn before"):
        joined(both, row)


def test_every_family_has_a_seed_and_kept_counts_which_the_page_shows():
    counts, page = kept.read(), PAGE.read_text(encoding="utf-8")
    assert set(counts) == set(FAMILIES) == set(SEEDS)
    assert len(set(SEEDS.values())) == len(SEEDS)
    shown = re.search(r"<!-- families: begin -->\n(.*)<!-- families: end -->", page, re.DOTALL)[1]
    for ranges in counts.values():
        sums = kept.totals(ranges)
        assert sums["draws"] == sum(sums[name] for name in kept.OUTCOMES)
        for part in ranges:
            numbers = f"| {part['first']} … {part['first'] + part['draws'] - 1} |"
            cells = " | ".join(str(part[name]) for name in ("draws", *kept.OUTCOMES))
            assert f"{numbers} {cells} |" in shown
