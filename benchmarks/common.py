"""What all benchmarks share: one thread, arguments, processor time, tables, pages.

Each is started from the root of the repository, as ``python -m benchmarks.peers.journal``, and says
with ``--help`` what it does.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import tempfile
import time
import venv
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before NumPy is imported: one thread counts

ROOT = Path(__file__).parents[1]


def arguments(description: str | None) -> argparse.ArgumentParser:
    """Parser of a benchmark; `description` is its docstring."""
    return argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )


def timed(work: Callable[[], Any], repeat: int = 1, warm: bool = False) -> tuple[Any, float]:
    """Last result and least processor seconds of `repeat` calls, after one to compile if `warm`.

    Processor time, not wall clock: all is one thread, and other programs do not count.
    """
    result, least = work() if warm else None, float("inf")
    for _ in range(repeat):
        begin = time.process_time()
        result = work()
        least = min(least, time.process_time() - begin)
    return result, least


def seconds_of(work: Callable[[], Any], repeat: int = 1) -> float:
    """Least processor seconds of `repeat` calls, after one to compile."""
    return timed(work, repeat, warm=True)[1]


def row(*cells: Any) -> str:
    """A row of a Markdown table."""
    return f"| {' | '.join(map(str, cells))} |"


def head(*names: str, numbers: bool = False) -> str:
    """Head of a Markdown table; columns of `numbers`, but the first, are flush right."""
    others = "---:" if numbers else "---"
    return row(*names) + "\n|---|" + "|".join([others] * (len(names) - 1)) + "|"


def show(rows: Iterable[dict[str, Any]], as_json: bool) -> None:
    """Print what was measured: of each thing ``what`` it is and its numbers."""
    if as_json:
        print(json.dumps([*rows], indent=1))
        return
    for one in rows:
        print(one["what"])
        for name, value in one.items():
            if name != "what":
                print(f"  {name:32s} {value:.6g}")


def taken_from(page: Path, begin: str, end: str) -> str:
    """What stands between two marks of a page, with the marks."""
    text = page.read_text(encoding="utf-8")
    return begin + text.partition(begin)[2].partition(end)[0] + end


def put(page: Path, begin: str, end: str, text: str) -> None:
    """Put `text` between two marks of a page."""
    before, _, rest = page.read_text(encoding="utf-8").partition(begin)
    after = rest.partition(end)[2]
    page.write_text(f"{before}{begin}\n{text}\n{end}{after}", encoding="utf-8")


def ask(python: str, module: str, *asked: str, seconds: float | None = None) -> Any:
    """JSON of the last line that a benchmark prints in another interpreter.

    Raises
    ------
    subprocess.SubprocessError
        It fails, or takes longer than `seconds`.
    """
    found = str(Path(shutil.which(python) or python).absolute())  # as it is started elsewhere
    done = subprocess.run(
        [found, "-m", module, *asked],
        cwd=ROOT, check=True, capture_output=True, text=True, timeout=seconds,
    )  # fmt: skip
    return json.loads(done.stdout.splitlines()[-1])


@contextmanager
def environment(*packages: str, seconds: float = 600.0) -> Iterator[str]:
    """Interpreter of an environment of its own with some packages, for as long as it is used.

    Raises
    ------
    OSError, subprocess.SubprocessError
        It cannot be made.
    """
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = str(Path(folder) / "bin" / "python")
        install = [python, "-m", "pip", "install", "-q", *packages]
        subprocess.run(install, check=True, capture_output=True, timeout=seconds)
        yield python
