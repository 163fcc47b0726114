"""The package is light until it is used."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize("module", ["loadflow", "loadflow.running.executor"])
def test_importing_the_package_loads_no_heavy_library(module):
    """Nor does that of the processes of a run, which begin before all else."""
    code = (
        f"import sys, {module};"
        "heavy = ('numba', 'scipy', 'matplotlib', 'pandas', 'xarray');"
        "print([name for name in heavy if name in sys.modules])"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == "[]"


def test_importing_the_package_takes_less_than_0_3_s_of_processor_time():
    code = "from time import process_time as t; a = t(); import loadflow; print(t() - a)"
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert float(result.stdout) < 0.3
