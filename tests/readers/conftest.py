import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def openfast_folder():
    """Folder with real OpenFAST series, or skip."""
    folder = os.environ.get("LOADFLOW_OPENFAST_DATA")
    if not folder or not list(Path(folder).glob("*.outb")):
        pytest.skip("LOADFLOW_OPENFAST_DATA names no folder with .outb files")
    return Path(folder)
