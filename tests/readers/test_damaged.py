"""Files damaged at random: each gives an answer, or an `InputError` that names the file.

`LOADFLOW_DAMAGED=5000 pytest -m slow tests/readers/test_damaged.py` takes that many of each kind.
"""

import os
import warnings

import numpy as np
import pytest
from openfast_files import channels, write_out, write_outb
from synthetic import cube_file
from test_defects import GTSDF, write_gtsdf
from test_readers_bladed import write_run
from test_readers_csv import write as write_csv
from test_readers_hawc2 import CHANNELS, made_up
from test_readers_hawc2 import write as write_hawc2

from loadflow.cube import check_cube, open_cube
from loadflow.errors import InputError
from loadflow.readers import read_loads

WRITERS = {
    ".outb": lambda path: write_outb(path, channels(50)),
    ".out": lambda path: write_out(path, channels(50)),
    ".csv": write_csv,
    ".sel": lambda path: write_hawc2(path.with_suffix(""), True, made_up(50)),
    ".dat": lambda path: write_hawc2(path.with_suffix(""), False, made_up(50)),
    ".%23": lambda path: write_run(path.with_suffix(""), n=50),
    ".hdf5": write_gtsdf,
    ".h5": lambda path: cube_file(path, steps=50),
}


def read(path):
    """Read a file to its last value."""
    if path.suffix == ".h5":
        check_cube(open_cube(path), source=str(path))
        return
    named = {".sel": CHANNELS, ".dat": CHANNELS, ".hdf5": GTSDF}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # huge and tiny numbers, doubts
        read_loads(path, channels=named.get(path.suffix), quiet=True)


def damaged(data, rng):
    """Return a copy with bytes replaced, the end cut off, or a bit of the header flipped."""
    copy, kind = bytearray(data), rng.integers(4)
    if kind == 0:
        for at in rng.integers(len(copy), size=rng.integers(1, 9)):
            copy[at] = rng.integers(256)
    elif kind == 1:
        del copy[rng.integers(len(copy)) :]
    elif kind == 2:
        start = rng.integers(len(copy))
        count = min(len(copy) - start, int(rng.integers(1, 200)))
        copy[start : start + count] = rng.bytes(count)
    else:
        copy[rng.integers(min(len(copy), 3000))] ^= 1 << rng.integers(8)
    return bytes(copy)


def survive(path, count):
    """Damage a file `count` times; return how often it was read, and what it was refused with."""
    sound, refused = path.read_bytes(), []
    rng = np.random.default_rng(count)
    for _ in range(count):
        path.write_bytes(damaged(sound, rng))
        try:
            read(path)
        except InputError as error:
            refused.append(str(error))
    return count - len(refused), refused


@pytest.mark.parametrize("kind", WRITERS)
def test_a_damaged_file_is_an_answer_or_a_message_with_its_name(tmp_path, kind):
    path = tmp_path / f"dlc11_v10_s1{kind}"
    WRITERS[kind](path)
    read(path)
    answers, refused = survive(path, 40)
    assert answers < 40
    assert all(str(path.with_suffix("")) in message for message in refused)


@pytest.mark.slow
@pytest.mark.parametrize("kind", WRITERS)
def test_many_damaged_files_are_answers_or_messages(tmp_path, kind):
    import resource

    path = tmp_path / f"dlc11_v10_s1{kind}"
    WRITERS[kind](path)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    count = int(os.environ.get("LOADFLOW_DAMAGED", "1000"))
    answers, refused = survive(path, count)
    assert answers + len(refused) == count
    assert all(str(path.with_suffix("")) in message for message in refused)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 500e3  # kB
