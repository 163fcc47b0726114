"""Which share of the lifetime each load case takes, where a cube holds several design load cases.

As the fatigue cases of IEC 61400-1 (table 2) have it: production (1.2, or 1.1 in the same wind)
while the wind is between cut-in and cut-out, idling (6.4) otherwise, starts, stops and faults so
many times a year. Cases of extreme loads alone have no share.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from loadflow.errors import InputError
from loadflow.quantities import HOURS_PER_YEAR
from loadflow.scene.cases import speed_shares, wind_class
from loadflow.scene.scene import Scene
from loadflow.wind import iec
from loadflow.wind.cases import by_load_case, check_counted, row_of

YEAR = 3600.0 * HOURS_PER_YEAR
PRODUCTION = ("1.1", "1.2")
IDLING = ("6.4",)


def lifetime_shares(
    dlcs: Sequence[str],
    wind_speeds: Sequence[float],
    lengths: Sequence[float],
    *,
    wind_class: str | iec.WindClass = "I",
    shape: float = 2.0,
    operating: tuple[float, float] = (3.0, 25.0),
    per_year: Mapping[str, float] | None = None,
) -> np.ndarray:
    """Share of the lifetime of each case.

    A single design load case takes the whole lifetime, by its wind speeds. Of several, those of
    `per_year` take their number times their length, and production and idling share the rest as
    the wind is within or outside `operating`; the others get 0. Cases of one wind speed share
    equally. A variant of a load case, such as 1.2a, is production or idling as its load case is.

    Parameters
    ----------
    dlcs : sequence of str, length k
        Design load case of each case.
    wind_speeds, lengths : sequence of float, length k
        Mean wind speed, m/s, and length, s, of each case.
    wind_class : str or loadflow.wind.iec.WindClass
        I, II or III, which sets the annual mean (2.3), or a class of one's own.
    shape : float
        Of the Weibull distribution of the wind speeds (2.2).
    operating : tuple of float
        Cut-in and cut-out, m/s.
    per_year : mapping of str to float
        How often a year a design load case happens, over all its wind speeds and variants
        (`loadflow.wind.cases.by_load_case`).

    Returns
    -------
    ndarray, shape (k,)
        Their sum is 1, or less if the lifetime is nothing but counted events.

    Raises
    ------
    loadflow.errors.InputError
        No case has a share, the events take more than a year, or `per_year` names a load case that
        is not there or whose variants all have their own number, or a number that is not >= 0.
    """
    told = per_year or {}
    check_counted("per_year", told, dlcs)
    for dlc, number in told.items():
        if not 0 <= number < np.inf:
            raise InputError(f"per_year: {dlc} = {number}; allowed: >= 0")
    counted = by_load_case(told, dlcs)
    names, speeds = np.array(dlcs, dtype=str), np.array(wind_speeds, dtype=float)

    def within(group: Sequence[str]) -> np.ndarray:
        """Shares of the cases of a group among themselves; 0 for the others."""
        inside = np.isin(names, group)
        share = speed_shares(speeds[inside].tolist(), wind_class, shape) if inside.any() else {}
        count = Counter(speeds[inside].tolist())
        return np.array(
            [share[v] / count[v] if i else 0.0 for v, i in zip(speeds.tolist(), inside)]
        )

    if len(set(dlcs)) == 1 and not counted:
        return within(dlcs[:1])
    events = np.zeros(names.size)
    for dlc, number in counted.items():
        events += number * within([dlc]) * np.array(lengths, dtype=float) / YEAR
    if events.sum() > 1:
        raise InputError(
            f"per_year = {counted}: these events take {events.sum():.3g} years of each year"
        )
    below = iec.weibull_cdf(operating, iec.class_speeds(wind_class).v_ave, shape)
    running = float(below[1] - below[0])
    outside = (speeds < operating[0]) | (speeds > operating[1])
    times = running * within([dlc for dlc in of_load_cases(dlcs, PRODUCTION) if dlc not in counted])
    idle = within([dlc for dlc in of_load_cases(dlcs, IDLING) if dlc not in counted]) * outside
    times += (1 - running) * idle / (idle.sum() or 1.0)
    shares = events + (1 - events.sum()) * times / (times.sum() or 1.0)
    if not shares.any():
        raise InputError(
            f"none of the load cases {', '.join(sorted(set(dlcs)))} has a share of the lifetime; "
            "say how often a year they happen (per_year), or give the shares"
        )
    return shares


def shares_in(
    scene: Scene,
    dlcs: Sequence[str],
    wind_speeds: Sequence[float],
    lengths: Sequence[float],
    weights: Sequence[float],
) -> np.ndarray | None:
    """Share of the lifetime of each case of a scene, of 1 in all; None where none has one.

    Those that the files give, else by `lifetime_shares`; events to which ``lifetime.per_year``
    gives no number have none.

    Parameters
    ----------
    scene : Scene
        Wind, turbine and numbers of events.
    dlcs : sequence of str, length k
        Design load case of each case.
    wind_speeds, lengths, weights : sequence of float, length k
        Mean wind speed, m/s, length, s, and what the scene or its files say of the weight.

    Returns
    -------
    ndarray, shape (k,), or None
        The shares.

    Raises
    ------
    loadflow.errors.InputError
        Events that take more than a year.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"loads": {"dlc": ["1.2", "3.1"]}, "lifetime": {"per_year": {"3.1": 9}}})
    >>> shares_in(scene, ["1.2", "3.1"], [8.0, 8.0], [600.0, 300.0], [1.0, 1.0]).round(5)
    array([9.9991e-01, 9.0000e-05])
    """
    if scene.loads.weights == "given" and scene.loads.source == "files":
        given = np.array(weights, dtype=float)
        return given / given.sum() if given.sum() > 0 else None
    per_year = by_load_case(scene.lifetime.per_year, dlcs)
    try:
        return lifetime_shares(
            dlcs,
            wind_speeds,
            lengths if per_year else np.ones(len(dlcs)).tolist(),
            wind_class=wind_class(scene),
            operating=_operating(scene),
            per_year=per_year,
        )
    except InputError:
        if per_year:
            raise
        return None


def seconds_per_year(scene: Scene, dlcs: Sequence[str]) -> np.ndarray:
    """Of a year that cases share, (k,), s: production without idling has its winds alone.

    Parameters
    ----------
    scene : Scene
        Wind and turbine.
    dlcs : sequence of str, length k
        Design load case of each case.
    """
    seconds, there = np.full(len(dlcs), YEAR), set(dlcs)
    by_wind = scene.loads.weights == "rayleigh" or scene.loads.source == "simulate"
    if by_wind and of_load_cases(there, PRODUCTION) and not of_load_cases(there, IDLING):
        below = iec.weibull_cdf(_operating(scene), iec.class_speeds(wind_class(scene)).v_ave, 2.0)
        produces = ~np.isin(dlcs, [*by_load_case(scene.lifetime.per_year, there)])
        seconds[produces] *= float(below[1] - below[0])
    return seconds


def _operating(scene: Scene) -> tuple[float, float]:
    from loadflow.turbines import load_turbine

    machine = load_turbine(scene.turbine.name)
    return machine.cut_in, machine.cut_out


def of_load_cases(dlcs: Iterable[str], group: Sequence[str]) -> set[str]:
    """Those of some design load cases that are of a group, or variants of one of it.

    Examples
    --------
    >>> sorted(of_load_cases(["1.1a", "1.2", "1.3", "steady"], PRODUCTION))
    ['1.1a', '1.2']
    """
    return {dlc for dlc in dlcs if (row := row_of(dlc)) is not None and row.dlc in group}


def without_share(dlcs: Sequence[str], shares: np.ndarray) -> list[str]:
    """Design load cases that the lifetime leaves out, in order."""
    total = dict.fromkeys(dlcs, 0.0)
    for dlc, share in zip(dlcs, shares.tolist()):
        total[dlc] += share
    return [dlc for dlc, share in total.items() if share == 0]
