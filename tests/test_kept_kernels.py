"""Kernels that are kept on the disk answer only for the code that they were compiled from."""

import gc
import os
import re
import tempfile
from pathlib import Path

import pytest
from numba.core import event
from numba.core.caching import FunctionCache
from numba.core.errors import TypingError

import loadflow
from loadflow.journal.solvers import _newton_kernels
from loadflow.numerics import kept_kernels
from loadflow.numerics.collections import FEW
from loadflow.numerics.linked import bare
from loadflow.wind import _kernels as wind_kernels

ROOT = Path(loadflow.__file__).parent
SOLVER = ROOT / "journal/solvers/_newton_kernels.py"


@pytest.fixture
def edit(monkeypatch):
    """Read one file of the package as if a line were added to it, or it were `changed`."""
    read = kept_kernels._text.__wrapped__

    def forget():
        for known in ("_text", "_imports", "_rests_on", "_tuples_of", "state_of"):
            getattr(kept_kernels, known).cache_clear()

    def edited(name, changed=lambda text: f"{text}\nADDED = 1\n"):
        def text(file):
            return changed(read(file)) if file == ROOT / name else read(file)

        forget()
        monkeypatch.setattr(kept_kernels, "_text", text)

    yield edited
    monkeypatch.undo()
    forget()


@pytest.mark.parametrize(
    ("kernel", "name"),
    [
        (SOLVER, "journal/solvers/_newton_kernels.py"),  # itself
        (SOLVER, "journal/film/gap/_gap_kernels.py"),  # what it calls
        (SOLVER, "tribology/_contact_integral.py"),  # constants of what that calls
        (ROOT / "rotor/control/_kernels.py", "wind/cases.py"),  # what its constants are made of
    ],
)
def test_a_change_of_what_a_kernel_is_compiled_from_makes_kept_ones_outdated(kernel, name, edit):
    before = kept_kernels.state_of(kernel)
    edit(name)
    assert kept_kernels.state_of(kernel) != before


def test_another_order_of_fields_that_a_kernel_is_given_makes_kept_ones_outdated(edit):
    """Of the same types: numba would take the old kernel, and one field for the other."""
    kernel = ROOT / "journal/models/composed/kernels/_thickening_kernels.py"

    def swapped(text):
        assert "    cos: Array\n    sin: Array\n" in text
        return text.replace("    cos: Array\n    sin: Array\n", "    sin: Array\n    cos: Array\n")

    before = kept_kernels.state_of(kernel)
    edit("journal/models/ring.py", swapped)
    assert kept_kernels.state_of(kernel) != before


@pytest.mark.parametrize("name", ["wind/_kernels.py", "journal/bearing.py", "journal/shells.py"])
def test_a_change_elsewhere_keeps_kernels(name, edit):
    before = kept_kernels.state_of(SOLVER)
    edit(name)
    assert kept_kernels.state_of(SOLVER) == before


@pytest.mark.parametrize("kernel", [_newton_kernels.solve, wind_kernels.time_first])
def test_numba_keeps_kernels_under_the_state_of_their_code(kernel):
    kept = kernel._cache._impl
    file = Path(kernel.py_func.__code__.co_filename)
    assert isinstance(kept.locator, kept_kernels.KernelPlace)
    assert f"-{kept_kernels.state_of(file)}.py" in kept.filename_base


def test_kernels_of_another_state_are_removed_and_those_of_other_files_stay(tmp_path):
    state = kept_kernels.state_of(SOLVER)
    names = {
        f"_newton_kernels.solve-40-{state}.py311.nbi",
        f"_newton_kernels.solve-40-{state}.py311.1.nbc",
        "_kernels.solve-40-0123456789ab.py311.nbi",
        "_newton_kernels.cpython-311.pyc",
    }
    outdated = {
        "_newton_kernels.solve-40-0123456789ab.py311.nbi",
        "_newton_kernels.solve-40-0123456789ab.py311.1.nbc",
        "_newton_kernels.solve-38.py311.nbi",  # of a version that kept them by their line alone
    }
    for name in names | outdated:
        (tmp_path / name).touch()
    kept_kernels._remove_outdated.__wrapped__(tmp_path, SOLVER)
    assert {path.name for path in tmp_path.iterdir()} == names


def test_functions_of_other_packages_are_kept_as_numba_does():
    assert kept_kernels.KernelPlace.from_function(edit, __file__) is None


def test_all_kernels_are_compiled_by_the_module_that_says_how_they_are_kept():
    takes = re.compile(r"^from numba import .*\bn?jit\b|^import numba$", re.MULTILINE)
    found = {
        file.relative_to(ROOT).as_posix()
        for file in ROOT.rglob("*.py")
        if takes.search(file.read_text(encoding="utf-8"))
    }
    assert found == {"numerics/linked.py"}


@pytest.mark.parametrize("fails", [False, True])
def test_python_collects_less_often_while_kernels_are_compiled_and_as_before_afterwards(fails):
    """One within another, and where the inner one cannot be compiled."""
    seen = []

    class Seen(event.Listener):
        def on_start(self, event):
            seen.append(gc.get_threshold())

        on_end = on_start

    @bare()
    def inner(x):
        return x.none if fails else x + 1.0

    @bare()
    def outer(x):
        return inner(x)

    before = gc.get_threshold()
    try:
        gc.set_threshold(700, 10, 9)
        with event.install_listener("numba:compile", Seen()):
            if fails:
                with pytest.raises(TypingError):
                    outer(1.0)
            else:
                assert outer(1.0) == 2.0
        assert seen == [(FEW, 10, 9)] * 3 + [(700, 10, 9)]
        assert gc.get_threshold() == (700, 10, 9)
    finally:
        gc.set_threshold(*before)


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="folders have no owner here")
def test_an_account_that_can_write_neither_package_nor_home_keeps_kernels_of_its_own(
    tmp_path, monkeypatch
):
    """As of a service: numba refused to compile there."""
    monkeypatch.setattr(kept_kernels, "_BY_NUMBA", ())
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    function = next(
        one.py_func for one in vars(_newton_kernels).values() if hasattr(one, "py_func")
    )
    own = tmp_path / f"loadflow-kernels-{os.getuid()}"
    room = Path(function.__code__.co_filename).parent.relative_to(ROOT)

    def kept_in():
        kept_kernels._temporary_folder.cache_clear()
        return Path(FunctionCache(function).cache_path)

    try:
        assert kept_in() == own / room
        assert own.stat().st_mode & 0o777 == 0o700
        own.chmod(0o777)  # who writes there has his code run by us
        assert own not in kept_in().parents
        own.rename(tmp_path / "another")
        own.symlink_to(tmp_path / "another")
        assert own not in kept_in().parents
    finally:
        kept_kernels._temporary_folder.cache_clear()
