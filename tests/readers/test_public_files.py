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
