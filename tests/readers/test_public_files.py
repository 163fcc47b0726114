"""Public files of pCrunch, openfast_toolbox, welib and wetb, from clones that are not part of this.

Set LOADFLOW_CLONES to a folder for the clones, OWNER/NAME; absent ones are made.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPT = "benchmarks.robustness.public_files"


@pytest.mark.slow
def test_public_files_are_read_mapped_or_refused_as_the_table_says():
    clones = os.environ.get("LOADFLOW_CLONES", "")
    if not clones:
        pytest.skip("set LOADFLOW_CLONES to a folder for clones of public repositories")
    command = [sys.executable, "-m", SCRIPT, str(Path(clones).absolute())]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("| read |") + done.stdout.count("| mapped |") == 15


@pytest.mark.slow
def test_public_turbines_hold_their_published_steady_states():
    clones = os.environ.get("LOADFLOW_CLONES", "")
    if not clones:
        pytest.skip("set LOADFLOW_CLONES to a folder for clones of public repositories")
    from benchmarks.robustness import public_turbines as public
    from benchmarks.robustness.public_files import clone
    from loadflow.validation import all_checks

    folder = Path(clones).absolute()
    for one in public.TURBINES:
        clone(one.repository, folder)
        assert len(public.missing(one, folder)) >= 3
    rows = list(all_checks("turbines", folder))
    assert len(rows) == 216
    assert [row for row in rows if row.outcome == "out"] == []
    assert sum(row.outcome == "missed" for row in rows) == 54
