"""The public interface is what `tests/contract/` says; a change of it is a change there."""

import difflib

import pytest
from interface import FOLDER, descriptions

NAMES = sorted(path.stem for path in FOLDER.glob("*.txt"))


@pytest.fixture(scope="module")
def found():
    return descriptions()


def test_each_description_is_kept(found):
    assert sorted(found) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_the_public_interface_is_what_the_contract_says(found, name):
    kept = (FOLDER / f"{name}.txt").read_text(encoding="utf-8").splitlines()
    difference = [*difflib.unified_diff(kept, found[name], "contract", "package", n=0)]
    told = "\n".join(difference)
    assert not difference, f"{told}\nIf it is meant: python tests/interface.py, and CHANGELOG.md"


def test_a_change_of_a_signature_is_seen(monkeypatch):
    """The description must be able to differ: another default, another name of an argument."""
    from interface import names

    import loadflow.cube

    def standing(case, rated=1.0):
        """Other names and defaults than the real one."""

    before = names()
    standing.__module__ = "loadflow.cube.states"
    monkeypatch.setattr(loadflow.cube, "standing", standing)
    assert {*names()} - {*before} == {"loadflow.cube.standing(case, rated = 1.0)"}


def test_every_number_of_a_result_has_a_unit(found):
    assert [line for line in found["results"] if line.endswith("[-]")] == []
