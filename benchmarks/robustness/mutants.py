"""What users give, damaged at random: each mutant is an answer or an `InputError`.

    python -m benchmarks.robustness.mutants [scenes|turbines|load-files|cubes] [count] [first]

Mutants are numbered, and each number is the same mutant on every machine. A scene is read and
planned, a turbine read and made ready for the wind; load files (``.hdf5``) and cubes (``.h5``) are
read to their last value, and refused by name. Memory is limited, where the system can, so that what
is not checked before it is allocated shows up; the most that was taken is printed.
"""

from __future__ import annotations

import copy
import random
import sys
import tempfile
import time
import tomllib
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import tomli_w

from benchmarks.common import ROOT, arguments
from benchmarks.robustness import hdf5_mutants
from loadflow.errors import LoadflowError
from loadflow.planning.plan import make_plan
from loadflow.rotor.inflow import wind_machine
from loadflow.scene.scene import make_scene, read_scene
from loadflow.turbines import load_turbine

MEMORY = 6 * 2**30
"""Address space of the process, bytes."""

SLOW = 20.0
"""Seconds of processor time after which a mutant counts as one that hangs."""

VALUES: tuple[Any, ...] = (
    *(0, -1, 1, 2, 3, 2**31, 2**63, 2**64, -(2**63) - 1, 10**30, 10**400),
    *(0.0, -0.0, 1e-320, 1e-12, 0.5, 1.5, -2.5, 1e6, 1e18, 1e154, 1e300, 1e308, -1e308),
    *(float("nan"), float("inf"), float("-inf"), True, False),
    *("", " ", "..", "/", "a" * 300, "\0", "é", "1", "nan", "1.1", "journal", "rolling", "{}"),
    *("../../x", "con", "-1", "auto", "simulate", "nrel-5mw", "two-spherical"),
    *([], [[]], [1], [1.0, 2.0], ["a"], [None], [0] * 50, [1e308] * 3, [[1, 2], [3]], ["1.1", 3]),
    *({}, {"a": 1}, {"kind": "ball"}, {"kind": 3}, {"kind": []}),
)

KEYS = (
    *("accuracy", "results", "turbine.name", "reduction.size", "seeds.alpha"),
    *("loads.duration", "loads.wind_speeds", "loads.seeds", "loads.yaw_errors", "loads.azimuths"),
    *("loads.first_seed", "loads.v_ref", "loads.wind_class", "loads.files", "loads.winds"),
    *("loads.step", "loads.wind_grid", "loads.steady", "rolling.arrangement", "rolling.rings"),
    *("rolling.geometry", "rolling.inner_ring", "journal.heat", "journal.shell", "journal.supply"),
    *("journal.geometry", "journal.motion", "journal.tilt", "shaft.integrated"),
    *("shaft.three_point", "shaft.direct_drive", "friction.lubricant", "friction.step"),
)
"""Keys of a scene that few scenes have."""

SCENES = ROOT / "pipelines"


def places(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the way to everything in nested tables and lists."""
    items: Any = ()
    if isinstance(data, dict):
        items = data.items()
    elif isinstance(data, list):
        items = enumerate(data[:40])
    for key, value in items:
        yield (*path, key)
        yield from places(value, (*path, key))


def mutated(data: dict[str, Any], draw: random.Random) -> dict[str, Any]:
    """Change one to three places: another value, another size, a key away or one too many."""
    data = copy.deepcopy(data)
    for _ in range(draw.randint(1, 3)):
        known = list(places(data))
        if not known:
            break
        *way, last = draw.choice(known)
        owner = data
        for key in way:
            owner = owner[key]
        match draw.randrange(6):
            case 0:
                del owner[last]
            case 1 if isinstance(owner, dict):
                owner[draw.choice(["x", "", "name", "kind", str(last) + "s"])] = draw.choice(VALUES)
            case 2 if isinstance(owner[last], int | float):
                factor = draw.choice([-1, 0, 1e-9, 0.5, 10, 1e9, 1e40, 1e200])
                with suppress(OverflowError):  # an integer of 400 digits of an earlier change
                    owner[last] = owner[last] * factor
            case 3 if isinstance(owner[last], list) and owner[last]:
                owner[last] = owner[last][: draw.randrange(len(owner[last]))]
            case _:
                owner[last] = copy.deepcopy(draw.choice(VALUES))
    return data


def of_text(text: str, draw: random.Random) -> bytes:
    """Change, cut or double some bytes of a file."""
    raw = bytearray(text.encode())
    for _ in range(draw.randint(1, 4)):
        at = draw.randrange(len(raw))
        match draw.randrange(4):
            case 0:
                raw[at] = draw.randrange(256)
            case 1:
                del raw[at : at + draw.randint(1, 30)]
            case 2:
                raw[at:at] = raw[at : at + draw.randint(1, 30)]
            case _:
                raw[at:at] = draw.choice([b"9" * 25, b"e999", b"-", b"]", b'"', b"\xff", b"[["])
        if not raw:
            raw = bytearray(b"#")
    return bytes(raw)


def scene_mutant(number: int, folder: Path) -> Callable[[], Any]:
    """Return what reads and plans a mutant of one of the pipelines' scenes."""
    draw = random.Random(f"scene {number}")
    file = draw.choice(sorted(p for p in SCENES.glob("*.toml") if p.stem != "openfast"))
    whole = draw.random() < 0.5
    if number % 5 == 0:
        path = folder / "scene.toml"
        path.write_bytes(of_text(file.read_text(encoding="utf-8"), draw))
        return lambda: make_plan(read_scene(path))
    data = tomllib.loads(read_scene(file).to_toml() if whole else file.read_text(encoding="utf-8"))
    if draw.random() < 0.4:
        table, _, key = draw.choice(KEYS).rpartition(".")
        owner = data.setdefault(table, {}) if table else data
        owner[key] = copy.deepcopy(draw.choice(VALUES))
    else:
        data = mutated(data, draw)
    return lambda: make_plan(make_scene(data))


def turbine_mutant(number: int, folder: Path) -> Callable[[], Any]:
    """Return what reads a mutant of a turbine of the package."""
    import loadflow.turbines

    draw = random.Random(f"turbine {number}")
    files = sorted(Path(loadflow.turbines.__file__).parent.glob("*.toml"))
    text, path = draw.choice(files).read_text(encoding="utf-8"), folder / "turbine.toml"
    if number % 5 == 0:
        path.write_bytes(of_text(text, draw))
    else:
        data = mutated(tomllib.loads(text), draw)
        try:
            path.write_text(tomli_w.dumps(data), encoding="utf-8")
        except (TypeError, ValueError, UnicodeEncodeError):  # TOML has no such value
            path.write_bytes(of_text(text, draw))
    return lambda: wind_machine(load_turbine(path))


KINDS: dict[str, Callable[[int, Path], Callable[[], Any]]] = {
    "scenes": scene_mutant,
    "turbines": turbine_mutant,
    "load-files": partial(hdf5_mutants.mutant, "hdf5"),
    "cubes": partial(hdf5_mutants.mutant, "h5"),
}
NAMED = {"load-files": "dlc11_v8_s1.hdf5", "cubes": "dlc11_v8_s1.h5"}
"""Files that a message must name."""


def survey(kind: str, numbers: range) -> tuple[Counter[str], list[str]]:
    """Offer mutants; return how they were met, and those that escaped with the reason."""
    met: Counter[str] = Counter()
    escaped: list[str] = []
    with tempfile.TemporaryDirectory() as place, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for number in numbers:
            work = KINDS[kind](number, Path(place))
            begun = time.process_time()
            try:
                work()
            except LoadflowError as error:
                how = "refused"
                if NAMED.get(kind, "") not in str(error):
                    how = "refused without its name"
                    escaped.append(f"{kind} {number}: {error!s:.120}")
            except Exception as error:
                how = "escaped"
                frame = traceback.extract_tb(error.__traceback__)[-1]
                where = f"{Path(frame.filename).name}:{frame.lineno}"
                escaped.append(f"{kind} {number}: {type(error).__name__} {where} {error!s:.120}")
            else:
                how = "answered"
            if (took := time.process_time() - begun) > SLOW:
                how = "too slow"
                escaped.append(f"{kind} {number}: {took:.0f} s")
            met[how] += 1
    return met, escaped


def limit_memory() -> None:
    """Bound the address space of this process, where the system can."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def most_memory() -> float:
    """Most memory that this process has had, MB; nan where the system does not tell."""
    try:
        import resource
    except ImportError:
        return float("nan")
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("kind", nargs="?", choices=KINDS)
    parser.add_argument("count", type=int, nargs="?", default=10_000)
    parser.add_argument("first", type=int, nargs="?", default=0)
    asked = parser.parse_args()
    kinds, count, first = [asked.kind] if asked.kind else list(KINDS), asked.count, asked.first
    limit_memory()
    failed = False
    for kind in kinds:
        met, escaped = survey(kind, range(first, first + count))
        said = ", ".join(f"{n} {how}" for how, n in met.items())
        print(f"{kind}: {count} mutants from {first}, {said}; at most {most_memory():.0f} MB")
        for line in escaped:
            print(line)
        failed = failed or bool(escaped)
    sys.exit(failed)


if __name__ == "__main__":
    main()
