"""A newcomer's walk: from a clone to the compare page on own OpenFAST files, minutes per step.

python -m benchmarks.robustness.newcomer '/path/to/*.outb' [--candidate NAME …] [--keep FOLDER]

Clones this repository into a fresh folder, makes an environment in it, installs the package from
where pip is configured to look, and does what README.md says. Kernels are compiled on the way, as
on any machine that has never seen the package. What each step took, in processor time and on the
clock, goes into docs/newcomer.md: other programs that work meanwhile lengthen the clock alone.
"""

from __future__ import annotations

import glob
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from benchmarks.common import ROOT, arguments, head, put, row

PAGE = ROOT / "docs" / "newcomer.md"
BEGIN, END = "<!-- walk -->", "<!-- end of walk -->"
FROM_INDEX = (
    "PIP_", "UV_", "SSL_", "REQUESTS_", "HTTP", "http", "NO_PROXY", "no_proxy",
)  # fmt: skip
"""What else of the environment a step keeps: where packages come from."""


@dataclass(frozen=True)
class Step:
    """What a newcomer does, and what it took."""

    what: str
    command: str
    processor: float
    """Seconds of all its processes."""
    clock: float
    """Seconds."""
    load: float
    """Programs that asked for the processor meanwhile, mean over the last minute at its end."""


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("files", nargs="+", help="load files, or a quoted pattern")
    parser.add_argument("--candidate", action="append", default=[], help="only these candidates")
    parser.add_argument("--keep", type=Path, help="where the clone and its pages stay")
    asked = parser.parse_args()
    files = sorted({str(Path(f).resolve()) for given in asked.files for f in glob.glob(given)})
    if not files:
        sys.exit("none of the load files is there")
    with tempfile.TemporaryDirectory() as temporary:
        place = (asked.keep or Path(temporary)).resolve()
        place.mkdir(parents=True, exist_ok=True)
        steps = walk(place, files, asked.candidate)
        put(PAGE, BEGIN, END, told(steps, place / "loadflow", len(files)))


def walk(place: Path, files: list[str], candidates: list[str]) -> list[Step]:
    """All steps, in the order of the README; ends with what a step that fails has said."""
    clone = place / "loadflow"
    own = clone / "own"
    only = "".join(f" --candidate {name}" for name in candidates)
    steps = [
        step(place, "clone (local)", f"git clone -q {ROOT} loadflow", "git clone … loadflow"),
        step(clone, "install", "python3 -m venv .venv && .venv/bin/pip install -q ."),
    ]
    own.mkdir()
    for file in files:
        (own / Path(file).name).symlink_to(file)
    for what, command in (
        ("a scene to begin with", "loadflow init openfast -o scene.toml"),
        ("which case each file is", "loadflow convert --list 'own/*.outb'"),
        ("what it will take", "loadflow plan scene.toml --loads 'own/*.outb'"),
        ("the page", f"loadflow compare scene.toml --loads 'own/*.outb'{only}"),
        ("the page, asked for again", f"loadflow compare scene.toml --loads 'own/*.outb'{only}"),
    ):
        steps.append(step(clone, what, f".venv/bin/{command}", command))
    return steps


def step(folder: Path, what: str, command: str, told: str | None = None) -> Step:
    """One command, as a shell of a user carries it out, with nothing of this environment."""
    kept = {"PATH", "HOME", "LANG", "TMPDIR", "USER"}
    environment = {k: v for k, v in os.environ.items() if k in kept or k.startswith(FROM_INDEX)}
    before, begin = _used(), time.monotonic()
    with (folder / "walk.log").open("a", encoding="utf-8") as log:
        log.write(f"$ {command}\n")
        log.flush()
        done = subprocess.run(
            command, shell=True, cwd=folder, env=environment, stdout=log, stderr=log, check=False
        )
    if done.returncode:
        sys.exit(f"{command}: {(folder / 'walk.log').read_text(encoding='utf-8')[-2000:]}")
    clock = time.monotonic() - begin
    return Step(what, told or command, _used() - before, clock, os.getloadavg()[0])


def told(steps: list[Step], clone: Path, files: int) -> str:
    """Table of the steps, and what the page of the comparison is."""
    page = next(clone.glob("runs/**/compare.html"))
    answer = json.loads(page.with_suffix(".json").read_text(encoding="utf-8"))
    rows = [
        row(s.what, f"`{s.command}`", _span(s.processor), _span(s.clock), f"{s.load:.0f}")
        for s in steps
    ]
    total = row("together", "", *(_span(sum(getattr(s, k) for s in steps)) for k in _BOTH), "")
    kept = f"{page.stat().st_size / 1e6:.1f} MB"
    return "\n".join([
        head("step", "command", "processor", "clock", "load"), *rows, total, "",
        f"{files} files, {len(answer['candidates'])} candidates; the page is one file of {kept}.",
    ])  # fmt: skip


_BOTH = ("processor", "clock")


def _used() -> float:
    """Processor seconds of all processes that were started here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _span(seconds: float) -> str:
    """Seconds, or minutes where they are many."""
    return f"{seconds:.1f} s" if seconds < 60 else f"{seconds / 60:.1f} min"


if __name__ == "__main__":
    main()
