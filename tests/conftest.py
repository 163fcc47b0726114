"""What all tests share."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

# the first draw may compile a kernel, so no deadline; derandomised, so that CI is repeatable
settings.register_profile("loadflow", deadline=None, derandomize=True)
settings.register_profile("long", deadline=None, max_examples=10_000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "loadflow"))


@pytest.fixture(scope="session")
def openfast_data() -> Path:
    """Folder of real OpenFAST series of the NREL 5 MW turbine; the test skips without one."""
    folder = os.environ.get("LOADFLOW_OPENFAST_DATA", "")
    if not folder or not any(Path(folder).glob("*.outb")):
        pytest.skip("set LOADFLOW_OPENFAST_DATA to a folder with OpenFAST series to run this")
    return Path(folder)
