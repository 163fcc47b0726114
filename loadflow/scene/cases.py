"""Which load cases a scene has; a case is known before its series is."""

from __future__ import annotations

import glob
import hashlib
import json
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.cube import case_name, check_cube, iter_cases, open_cube
from loadflow.cube.trust import RACY
from loadflow.errors import InputError
from loadflow.readers import list_names, read_loads
from loadflow.readers.loads import find_files
from loadflow.scene.given_winds import wind_files
from loadflow.scene.lifetime import check_counts
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene
from loadflow.storage import check_name

if TYPE_CHECKING:
    from loadflow.wind import Condition, Machine, iec

CUBES = (".h5", ".nc")


@dataclass(frozen=True)
class Case:
    """One load case: what it is, and where its series comes from.

    Attributes
    ----------
    dlc : str
        Design load case.
    wind_speed : float
        Mean wind speed at hub height, m/s.
    seed : int
        Index of the turbulence seed, or of the variant of a wind without turbulence.
    weight : float
        Share of the lifetime, if its design load case takes the whole of it; how several load
        cases share it is told by `loadflow.scene.lifetime_shares.lifetime_shares`.
    file : str
        File the series is read from; empty if it is simulated.
    entry : str
        Name of the case inside a load cube; empty otherwise.
    wind : str
        File of the wind field that it is simulated in; empty if the wind is made too.
    fingerprint : str
        Hash of the content of the file; empty without one (the scene says it all).
    steps : int
        Length of the series.
    duration : float
        The same in s.
    variant : str
        End of the name where load case, wind speed and seed do not tell it apart.
    numbered : bool
        Whether the seed is only a count, as neither name nor list tells it or the wind speed.

    Examples
    --------
    >>> from loadflow.scene import list_cases, make_scene
    >>> loads = {"wind_speeds": [8.0, 12.0], "seeds": 1}
    >>> [case.name for case in list_cases(make_scene({"name": "look", "loads": loads}))]
    ['dlc1.1_v8_s1', 'dlc1.1_v12_s1']
    """

    dlc: str
    wind_speed: float
    seed: int
    weight: float = 1.0
    file: str = ""
    entry: str = ""
    wind: str = ""
    fingerprint: str = ""
    steps: int = 0
    duration: float = 0.0
    variant: str = ""
    numbered: bool = False

    @property
    def name(self) -> str:
        """Name of the case and of its files."""
        return case_name(self.dlc, self.wind_speed, self.seed) + self.variant


def list_cases(scene: Scene) -> list[Case]:
    """Return the load cases of a scene, weighted by their share of the lifetime.

    Parameters
    ----------
    scene : Scene
        The scene.

    Returns
    -------
    list of Case
        In the order of load case, wind speed and seed; of files, in that of the files.

    Raises
    ------
    loadflow.errors.InputError
        No file, a missing file, or two series that cannot be told apart.

    Examples
    --------
    >>> from loadflow.scene import list_cases, make_scene
    >>> scene = make_scene({"name": "look", "loads": {"wind_speeds": [8.0, 12.0], "seeds": 1}})
    >>> [case.name for case in list_cases(scene)]
    ['dlc1.1_v8_s1', 'dlc1.1_v12_s1']
    """
    loads = scene.loads
    if loads.winds:
        return weighted(_distinct(_in_given_winds(scene)), wind_class(scene))
    if loads.source == "simulate":
        simulated = [case for dlc in loads.dlcs for case in _simulated(scene, dlc)]
        return weighted(_distinct(simulated), wind_class(scene))
    if not loads.files:
        raise InputError(
            f'{scene.name}: loads.files: source = "files" needs load files; none is given: name '
            "them there, or on the command line with --loads 'path/to/*.outb'"
        )
    files = [path for pattern in loads.files for path in _matching(pattern)]
    cases = [case for path in files for case in _cases_of(path, loads)]
    distinct = _distinct(cases)
    dlcs = (case.dlc for case in distinct)
    check_counts(scene.lifetime, scene.wear.counts, dlcs, loads.weights)
    return distinct if loads.weights == "given" else weighted(distinct, wind_class(scene))


def design_load_cases(scene: Scene) -> frozenset[str]:
    """Design load cases of a scene, as files, their names or a list say; no series is read.

    Of files that are not there yet their names count, of cubes nothing.
    """
    loads = scene.loads
    if loads.source == "simulate":
        return frozenset(loads.dlcs)
    cubes = [pattern for pattern in loads.files if Path(pattern).suffix in CUBES]
    others = [pattern for pattern in loads.files if pattern not in cubes]
    named = list_names(others, pattern=loads.pattern, cases=loads.cases) if others else []
    found = {label.dlc for _, label in named if label.dlc is not None}
    for path in (Path(name) for pattern in cubes for name in glob.glob(pattern)):
        found |= _in_cube(path.absolute(), path.stat().st_mtime_ns)
    return frozenset(found)


@lru_cache(maxsize=100)
def _in_cube(path: Path, changed: int) -> frozenset[str]:
    cube = open_cube(path)
    return frozenset(str(case["dlc"].item()) for _, case in iter_cases(cube))


def wind_class(scene: Scene) -> iec.WindClass:
    """Speeds of the wind class of a scene."""
    from loadflow.wind.cases import wind_class as class_of

    return class_of(scene.loads.wind_options)


def simulated_length(scene: Scene) -> float | None:
    """Length of a simulated load case, s, the mean over the design load cases; None of given ones.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> from loadflow.scene.cases import simulated_length
    >>> simulated_length(make_scene({"loads": {"dlc": ["1.1", "3.1"]}}))
    450.0
    """
    from loadflow.wind.cases import load_case

    loads = scene.loads
    if loads.source != "simulate":
        return None
    if loads.duration:
        return loads.duration
    return sum(load_case(dlc).duration for dlc in loads.dlcs) / len(loads.dlcs)


def simulated_case(scene: Scene, dlc: str, wind_speed: float, index: int) -> Case:
    """Return a case to simulate, with the length that the scene or the load case gives it."""
    wind = wind_of(scene, Case(dlc, wind_speed, index))
    steps = round(wind.duration / scene.loads.step)
    return Case(dlc, wind_speed, index, steps=steps, duration=wind.duration)


def wind_of(scene: Scene, case: Case) -> Condition:
    """Wind, event and length of a simulated case."""
    from loadflow.wind import condition

    return condition(
        case.dlc,
        _machine(scene),
        scene.loads.wind_options,
        wind_speed=case.wind_speed,
        index=case.seed,
        **_choice(scene),
    )


def _simulated(scene: Scene, dlc: str) -> Iterator[Case]:
    """Yield the cases of one design load case."""
    from loadflow.wind import conditions

    loads = scene.loads
    winds = conditions(
        dlc,
        _machine(scene),
        loads.wind_options,
        wind_speeds=loads.wind_speeds,
        **_choice(scene),
    )
    for wind in winds:
        later = loads.first_seed - 1 if wind.sigma > 0 else 0
        yield simulated_case(scene, dlc, wind.wind_speed, wind.index + later)


def _in_given_winds(scene: Scene) -> Iterator[Case]:
    """Yield a case for each wind field; those whose names do not tell a seed are counted."""
    (dlc,), count = scene.loads.dlcs, Counter[float]()
    for path, wind_speed, seed in wind_files(scene):
        count[wind_speed] += 1
        yield replace(
            simulated_case(scene, dlc, wind_speed, seed or count[wind_speed]),
            wind=str(path),
            fingerprint=_hash(path),
        )


def _choice(scene: Scene) -> dict[str, Any]:
    loads = scene.loads
    return {
        "yaw_errors": loads.yaw_errors,
        "azimuths": loads.azimuths,
        "duration": loads.duration,
        "steady": loads.steady,
    }


def _machine(scene: Scene) -> Machine:
    from loadflow.rotor.inflow import wind_machine
    from loadflow.turbines import load_turbine

    return wind_machine(load_turbine(scene.turbine.name))


def _matching(pattern: str) -> list[Path]:
    """Return the files that a name or pattern stands for: cubes, or what a reader knows."""
    if Path(pattern).suffix not in CUBES:
        return find_files(pattern)
    paths = [Path(name) for name in sorted(glob.glob(pattern))]
    if not paths:
        raise InputError(f"{pattern}: no such load cube")
    return paths


def _cases_of(path: Path, loads: Loads) -> Iterable[Case]:
    """Cases of one file; one that has not changed since, and stands for itself, is read once."""
    found = path.stat()
    alone = loads.cases is None and not isinstance(loads.channels, str)
    if not alone or time.time() - found.st_mtime < RACY:
        return _read(path, loads)
    told = json.dumps(loads.reading, sort_keys=True)
    return _read_once(path, told, Path.cwd(), found.st_ino, found.st_size, found.st_mtime_ns)


@lru_cache(maxsize=10_000)
def _read_once(path: Path, reading: str, *stamp: Path | int) -> tuple[Case, ...]:
    """Keep the cases of a file; what is raised is not kept."""
    loads = Loads.model_validate({"files": [str(path)]} | json.loads(reading))
    return tuple(_read(path, loads))


def _read(path: Path, loads: Loads) -> Iterator[Case]:
    """Yield the cases of one file: a load cube, or the output of a simulator."""
    numbered = False
    if path.suffix in CUBES:
        cube = open_cube(path)
        check_cube(cube, source=str(path))
    else:
        [(_, label)] = list_names(path, pattern=loads.pattern, cases=loads.cases)
        numbered = label.seed is None and label.wind_speed is None
        cube = read_loads(path, quiet=True, **loads.reading)  # the run tells of doubts
    fingerprint = _hash(path)
    for name, series in iter_cases(cube):
        known = (str(series["dlc"].item()), float(series["wind_speed"]), int(series["seed"]))
        yield Case(
            *known,
            float(series["weight"].item()),
            numbered=numbered,
            variant=name.removeprefix(case_name(*known)) if "_wdir" in name else "",
            file=str(path),
            entry=name,
            fingerprint=fingerprint,
            steps=series.sizes["time"],
            duration=float(series["time"][-1] - series["time"][0]),
        )


def _distinct(cases: Iterable[Case]) -> list[Case]:
    """Number the cases of which nothing is known; two known ones of the same name are an error."""
    taken: dict[str, Case] = {}
    for case in cases:
        check_name(case.name, f"{_source(case)}: case")
        while case.name in taken:
            if case.dlc != "unknown" and not case.numbered:
                first = _source(taken[case.name])
                raise InputError(f"{_source(case)}: {case.name} is already in {first}")
            case = replace(case, seed=case.seed + 1)
        taken[case.name] = case
    return list(taken.values())


def _source(case: Case) -> str:
    return case.file or case.wind or "the scene"


def _hash(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def weighted(cases: list[Case], wind_class: str | iec.WindClass, shape: float = 2.0) -> list[Case]:
    """Share the lifetime over the wind speeds of each DLC, and their seeds; see `speed_shares`."""
    share = {
        dlc: speed_shares((c.wind_speed for c in cases if c.dlc == dlc), wind_class, shape)
        for dlc in {case.dlc for case in cases}
    }
    count = Counter((case.dlc, case.wind_speed) for case in cases)
    return [
        replace(c, weight=share[c.dlc][c.wind_speed] / count[c.dlc, c.wind_speed]) for c in cases
    ]


def speed_shares(
    wind_speeds: Iterable[float], wind_class: str | iec.WindClass, shape: float = 2.0
) -> dict[float, float]:
    """Return the share of the lifetime of each wind speed: its bin reaches half way to the next.

    Parameters
    ----------
    wind_speeds : iterable of float
        m/s.
    wind_class : str or loadflow.wind.iec.WindClass
        Sets the annual mean (2.3).
    shape : float
        Of the Weibull distribution; 2 is the Rayleigh distribution (2.2).

    Raises
    ------
    loadflow.errors.InputError
        Unknown class, or a shape that is not positive.
    """
    from loadflow.wind import iec

    speeds = sorted(set(wind_speeds))
    if len(speeds) == 1:
        return {speeds[0]: 1.0}
    middles = [(low + high) / 2 for low, high in pairwise(speeds)]
    first, last = 2 * speeds[0] - middles[0], 2 * speeds[-1] - middles[-1]
    edges = [max(0.0, first), *middles, last]
    below = iec.weibull_cdf(edges, iec.class_speeds(wind_class).v_ave, shape)
    return dict(zip(speeds, (np.diff(below) / (below[-1] - below[0])).tolist()))
