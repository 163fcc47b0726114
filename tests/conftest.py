"""What all tests share."""

import gc
import os
from functools import cache
from pathlib import Path

import pytest
import typer.main
from hypothesis import settings

# the processes of the tests share the cores: threads of linear algebra would wait for one another
# (before NumPy is imported; what the processes start has it, too)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# the first draw may compile a kernel, so no deadline; derandomised, so that CI is repeatable
settings.register_profile("loadflow", deadline=None, derandomize=True)
settings.register_profile("long", deadline=None, max_examples=10_000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "loadflow"))

# numba, pydantic and xarray make millions of small objects that stay: they are looked through less
# often than Python does by default
gc.set_threshold(50_000, 20, 20)

# all commands are made anew for each call of the command line: half of the time of a small one
typer.main.get_command = cache(typer.main.get_command)

ROOMS = (
    "journal", "hard", "compare", "", "stages", "planning", "cli", "running", "wind", "shaft",
    "rolling", "rotor",
)  # fmt: skip
"""Folders of tests in the order in which they are taken; the others stand in the middle."""

MIDDLE = ROOMS.index("running")


def pytest_collection_modifyitems(items):
    """Order files so that films stand at one end, rotor and contacts at the other.

    Two processes take files from the two ends: neither compiles kernels that the other compiles at
    the same time, and what they end with, in the middle, needs none.
    """
    here = Path(__file__).parent

    def place(item):
        room, *_ = item.path.parent.relative_to(here).parts or ("",)
        return ROOMS.index(room) if room in ROOMS else MIDDLE

    items.sort(key=place)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Hand files out from both ends of their order, to one process each."""
    from xdist.scheduler import LoadFileScheduling

    class FromBothEnds(LoadFileScheduling):
        def _assign_work_unit(self, node):
            if self.nodes.index(node) % 2:  # the next one to be handed out is the first
                self.workqueue.move_to_end(next(reversed(self.workqueue)), last=False)
            super()._assign_work_unit(node)

    if config.getoption("dist") != "loadfile":
        return None
    config.option.loadscopereorder = False  # by number of tests, which is not their time
    return FromBothEnds(config, log)


@pytest.fixture(scope="session")
def openfast_data() -> Path:
    """Folder of real OpenFAST series of the NREL 5 MW turbine; the test skips without one."""
    folder = os.environ.get("LOADFLOW_OPENFAST_DATA", "")
    if not folder or not any(Path(folder).glob("*.outb")):
        pytest.skip("set LOADFLOW_OPENFAST_DATA to a folder with OpenFAST series to run this")
    return Path(folder)


@pytest.fixture
def loadflow(capsys):
    """The command line in this process: arguments → exit code, standard output, errors."""
    from loadflow.cli import main

    def call(*arguments):
        capsys.readouterr()
        with pytest.raises(SystemExit) as stop:
            main([str(argument) for argument in arguments])
        printed = capsys.readouterr()
        return stop.value.code or 0, printed.out, printed.err

    return call
