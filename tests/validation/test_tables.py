"""Every printed number that `loadflow validate` shows is within its stated tolerance."""

import json
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from loadflow import data, validation
from loadflow.data import evidence
from loadflow.errors import InputError
from loadflow.validation import _slewing_refused, rings, turbines

PAGE = Path(__file__).parents[2] / "docs" / "validation.md"
DATA = Path(data.__file__).parent / "evidence.json"
BEGIN, END = "<!-- counts: begin -->\n", "<!-- counts: end -->"


def line_of(name, rows):
    """How many rows of a table are of which kind, and how many are refused or missed."""
    kinds = Counter(row.evidence for row in rows)
    outcomes = Counter("refused" if r.refused else "missed" if r.missed else "" for r in rows)
    found = [kinds[kind] for kind in validation.EVIDENCE]
    cells = [len(rows), *found, outcomes["refused"], outcomes["missed"]]
    return f"| {name} | " + " | ".join(str(cell or "–") for cell in cells) + " |"


def counts_of(rows):
    """The same for the data of the package: what there is none of is left out."""
    found = Counter(row.evidence for row in rows)
    found.update("refused" if r.refused else "missed" if r.missed else "" for r in rows)
    return {
        kind: found[kind] for kind in (*validation.EVIDENCE, "refused", "missed") if found[kind]
    }


def write_counts():
    """Bring the counts of the page and of the package up to the rows."""
    tables = {f"`{name}`": [*validation.all_checks(name)] for name in validation.names()}
    counted = {name.strip("`"): counts_of(rows) for name, rows in tables.items()}
    DATA.write_text(json.dumps(counted, indent=1) + "\n", encoding="utf-8")
    tables["all"] = [row for rows in tables.values() for row in rows]
    heads = ["table", "numbers", *validation.EVIDENCE, "of these refused", "missed"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    lines += [line_of(name, rows) for name, rows in tables.items()]
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    text = before + BEGIN + "\n".join(lines) + "\n" + END + rest.split(END)[1]
    PAGE.write_text(text, encoding="utf-8")


LONG = {"friction_rig", "loads"}
"""Tables of some ten seconds, which `loadflow validate` holds as well."""


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[pytest.mark.slow] * (n in LONG)) for n in validation.names()],
)
def test_every_printed_number_is_within_its_tolerance(name):
    rows = list(validation.all_checks(name))
    bad = [row for row in rows if row.outcome == "out"]
    assert rows, f"the table {name} is empty"
    assert {row.evidence for row in rows} <= set(validation.EVIDENCE)
    counted = line_of(f"`{name}`", rows)
    assert counted in PAGE.read_text(encoding="utf-8"), "python tests/validation/test_tables.py"
    assert counts_of(rows) == evidence()[name], "python tests/validation/test_tables.py"
    assert not bad, "\n".join(f"{row} deviates by {row.deviation:+.3g}" for row in bad)


def test_a_number_that_is_not_a_number_is_never_ok():
    for kind in ("relative", "absolute", "below", "above"):
        assert not validation.Check("x", "none", 1.0, float("nan"), 10.0, kind).ok


def test_a_limit_to_one_side_holds_what_lies_beyond_it():
    def row(got, kind):
        return validation.Check("x", "none", 3.0, got, 0.1, kind)

    held = [row(got, "above").ok for got in (-3.0, 2.6, 2.8, 3.0, 30.0)]
    assert held == [False, False, True, True, True]
    held = [row(got, "below").ok for got in (-3.0, 3.0, 3.2, 3.4)]
    assert held == [True, True, True, False]
    assert replace(row(2.6, "above"), missed="a slope").ok


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


def test_numbers_of_files_that_are_not_shipped_ask_for_their_folder(tmp_path):
    with pytest.raises(InputError, match="no number of the table seeds needs files"):
        list(validation.all_checks("seeds", tmp_path))
    with pytest.raises(InputError, match=r"no clone of github\.com/IEAWindTask37/IEA-3\.4-130-RWT"):
        list(turbines.checks_of_files(tmp_path))


def test_the_printed_steady_states_are_those_of_four_turbines_with_rising_wind():
    for public in turbines.TURBINES:
        wind, speed, _, power, thrust = turbines.published_states(public.name).T
        assert wind.size == 9
        assert (np.diff(wind) > 0).all()
        assert (speed > 0).all()
        assert (power < thrust * wind).all()  # P = T v (1 − a)


def test_a_number_that_needs_what_is_not_installed_is_told_apart():
    missing = validation.Check("u", "source", 1.0, np.nan, 0.1, absent="needs another package")
    assert missing.outcome == "not computed"
    assert missing.verdict == "not computed: needs another package"
    assert replace(missing, absent="", got=1.05).verdict == "ok"


def test_rows_of_finite_elements_are_all_computed():
    rows = [*rings.checks(), *rings.printed()]
    assert len(rows) > 41
    assert {row.outcome for row in rows} == {"ok"}


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
    places = ("Fig. 2.9", "App. B", "Table 3.5", "ch. 3.3, 3.4", "Table 2.5", "Table 4.12")
    assert [place for place in places if place not in sources] == []


if __name__ == "__main__":
    write_counts()
