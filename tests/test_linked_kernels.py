"""Kernels without machine code of their own do in their callers what all others do."""

import os
import subprocess
import sys

import pytest

MODULE = """
import numpy as np
from numba import njit
from loadflow.numerics.linked import LINKED

@njit(**LINKED)
def leaf(x):
    if x < 0.0:
        raise ValueError("negative")
    return np.sqrt(x) + 1.0

@njit(**LINKED)
def mean(values):
    kept = np.empty(values.size)
    for k in range(values.size):
        kept[k] = leaf(values[k])
    return kept.sum() / kept.size

@njit(cache=True)
def one(values):
    return mean(values)

@njit(cache=True)
def other(values):
    return mean(values) + leaf(values[0])
"""

LOOK = """
import sys
sys.path.insert(0, ".")
import numpy as np
from numba.core import event
import kernels

compiled = []

class Listener(event.Listener):
    def on_start(self, event):
        function = event.data["dispatcher"].py_func
        if function.__module__ == "kernels":
            compiled.append(function.__name__)

    def on_end(self, event):
        pass

event.register("numba:compile", Listener())
found = [float(getattr(kernels, name)(np.array([4.0, 9.0, 16.0]))) for name in sys.argv[1:]]
try:
    kernels.other(np.array([-1.0]))
except ValueError as error:
    found.append(str(error))
print(found, sorted(compiled))
"""


@pytest.fixture
def look(tmp_path):
    (tmp_path / "kernels.py").write_text(MODULE)

    def in_a_new_process(*names):
        told = subprocess.run(
            [sys.executable, "-c", LOOK, *names],
            capture_output=True,
            text=True,
            check=True,
            cwd=tmp_path,
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache")},
        )
        return told.stdout.strip()

    return in_a_new_process


def test_other_processes_and_callers_take_them_from_the_cache(look, tmp_path):
    """Each is compiled once; a caller that is compiled later links what stands on the disk."""
    assert look("one") == "[4.0, 'negative'] ['leaf', 'mean', 'one', 'other']"
    assert look("one", "other") == "[4.0, 7.0, 'negative'] []"
    for file in (tmp_path / "cache").rglob("kernels.other*"):
        file.unlink()
    assert look("other") == "[7.0, 'negative'] ['other']"
