"""Design load cases of IEC 61400-1 as data.

The table is that of edition 3 (table 2). Where the standard leaves numbers open (yaw errors,
realisations of some cases) the row follows common design load bases and can be overridden.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from math import ceil, floor
from string import ascii_lowercase
from typing import Literal

from loadflow.errors import InputError
from loadflow.numerics.fields import none_such
from loadflow.wind import iec
from loadflow.wind.options import Machine, WindOptions

Wind = Literal["NWP", "NTM", "ETM", "EOG", "EDC", "ECD", "EWS", "EWM50", "EWM1"]
Speeds = Literal[
    "operating", "rated", "rated, out", "in, rated, out", "50-year", "1-year", "parked"
]
Event = Literal[
    "none", "blade stuck", "pitch runaway", "grid loss", "start", "stop", "emergency stop",
    "parked", "parked, blade stuck", "idling",
]  # fmt: skip
BRAKED = ("parked", "parked, blade stuck")
"""Events in which a brake holds the shaft."""
STANDING = (*BRAKED, "idling")
"""Events that are a state: the turbine is in it from the beginning to the end."""
_CALM, _FASTEST = 0.1, 100.0  # m/s, of the wind on a turbine that stands
TURBULENT = ("NTM", "ETM", "EWM50", "EWM1")
#: Signs and directions of the transient conditions.
VARIANTS = {
    "EDC": ("+", "-"),
    "ECD": ("+", "-"),
    "EWS": ("vertical+", "vertical-", "horizontal+", "horizontal-"),
}
#: Partial safety factors for loads: normal, abnormal, fatigue, and extrapolated extremes (DLC 1.1).
SAFETY = {"N": 1.35, "A": 1.1, "F": 1.0, "extrapolated": 1.25}


@dataclass(frozen=True)
class LoadCase:
    """One row of the table of design load cases.

    Attributes
    ----------
    dlc, situation : str
        Number and design situation.
    wind : str
        Wind model.
    speeds : str
        Rule for the mean speeds, see `speeds`.
    kind : {"U", "F"}
        Analysis of ultimate or of fatigue loads.
    safety : str
        Key of `SAFETY`.
    events : tuple of str
        What the control does or suffers; the realisations take them in turn.
    seeds : int
        Realisations per mean speed and yaw error (1 where the wind is deterministic).
    yaw_errors : tuple of float
        Mean yaw errors, degrees.
    steady_yaw_errors : tuple of float
        Those in the steady variant of the extreme wind, degrees.
    duration : float
        Length of a series, s.
    gust_time : float
        Start of the gust, s.
    event_delays : tuple of float
        Times of the event after the start of the gust, s.

    Examples
    --------
    >>> from loadflow.wind import LOAD_CASES
    >>> LOAD_CASES["1.1"].turbulent, LOAD_CASES["1.1"].seeds
    (True, 6)
    """

    dlc: str
    situation: str
    wind: Wind
    speeds: Speeds
    kind: Literal["U", "F"]
    safety: str
    events: tuple[Event, ...] = ("none",)
    seeds: int = 1
    yaw_errors: tuple[float, ...] = (0.0,)
    duration: float = 600.0
    gust_time: float = 50.0
    event_delays: tuple[float, ...] = (0.0,)
    steady_yaw_errors: tuple[float, ...] = (-15.0, 15.0)

    @property
    def turbulent(self) -> bool:
        """Whether realisations of the wind differ at random."""
        return self.wind in TURBULENT

    @property
    def extreme(self) -> bool:
        """Whether the wind is the extreme one, which has a steady variant."""
        return self.wind.startswith("EWM")

    @property
    def operating(self) -> bool:
        """Whether the turbine runs, starts or stops, so that cut-in and cut-out bound the wind."""
        return self.events[0] not in STANDING

    @property
    def parked(self) -> bool:
        """Whether a brake holds the shaft throughout; in a storm it may slip."""
        return self.events[0] in BRAKED

    @property
    def safety_factor(self) -> float:
        """Partial safety factor for loads γ_f; that of 1.1 is for extrapolated loads."""
        return SAFETY[self.safety]

    @property
    def factor_of_maximum(self) -> float:
        """γ_f of the largest load of a series: the normal one where none is extrapolated."""
        return SAFETY["N" if self.safety == "extrapolated" else self.safety]


_OPERATION, _FAULT = "power production", "power production with fault"
_START, _STOP, _PARKED = "start", "normal stop", "parked or idling"
_ALL_ROUND = tuple(15.0 * k for k in range(-11, 13))
# before the operating gust, at its dip, its steepest rise, its peak
_IN_THE_GUST = (0.0, 2.4, 3.9, 5.2)
# a start takes 25 … 55 s to rated power: the gust meets it idling, running up, at rated speed
_BEFORE_THE_GUST = (-60.0, -45.0, -30.0, -15.0)
LOAD_CASES = {
    row.dlc: row
    for row in (
        LoadCase("1.1", _OPERATION, "NTM", "operating", "U", "extrapolated", seeds=6),
        LoadCase("1.2", _OPERATION, "NTM", "operating", "F", "F", seeds=6),
        LoadCase("1.3", _OPERATION, "ETM", "operating", "U", "N", seeds=6),
        LoadCase("1.4", _OPERATION, "ECD", "rated", "U", "N", duration=100.0),
        LoadCase("1.5", _OPERATION, "EWS", "operating", "U", "N", duration=100.0),
        LoadCase("2.1", _FAULT, "NTM", "operating", "U", "N", ("blade stuck", "grid loss"), 12,
                 duration=100.0),
        LoadCase("2.2", _FAULT, "NTM", "operating", "U", "A", ("pitch runaway", "blade stuck"), 12,
                 duration=100.0),
        LoadCase("2.3", _FAULT, "EOG", "rated, out", "U", "A", ("grid loss",), duration=100.0,
                 event_delays=_IN_THE_GUST),
        LoadCase("2.4", _FAULT, "NTM", "operating", "F", "F", ("blade stuck", "grid loss"), 3,
                 (-20.0, 20.0)),
        LoadCase("3.1", _START, "NWP", "operating", "F", "F", ("start",), duration=300.0),
        LoadCase("3.2", _START, "EOG", "in, rated, out", "U", "N", ("start",), duration=300.0,
                 gust_time=110.0, event_delays=_BEFORE_THE_GUST),
        LoadCase("3.3", _START, "EDC", "in, rated, out", "U", "N", ("start",), duration=300.0,
                 gust_time=110.0, event_delays=_BEFORE_THE_GUST),
        LoadCase("4.1", _STOP, "NWP", "operating", "F", "F", ("stop",), duration=300.0),
        LoadCase("4.2", _STOP, "EOG", "rated, out", "U", "N", ("stop",), duration=300.0,
                 event_delays=_IN_THE_GUST),
        LoadCase("5.1", "emergency stop", "NTM", "rated, out", "U", "N", ("emergency stop",), 12,
                 duration=100.0),
        LoadCase("6.1", _PARKED, "EWM50", "50-year", "U", "N", ("parked",), 6, (-8.0, 8.0)),
        # without the grid the turbine cannot yaw into the wind
        LoadCase("6.2", _PARKED, "EWM50", "50-year", "U", "A", ("parked",), 1, _ALL_ROUND,
                 steady_yaw_errors=_ALL_ROUND),
        LoadCase("6.3", _PARKED, "EWM1", "1-year", "U", "N", ("parked",), 6, (-20.0, 20.0),
                 steady_yaw_errors=(-30.0, 30.0)),
        LoadCase("6.4", _PARKED, "NTM", "parked", "F", "F", ("idling",), 6),
        LoadCase("7.1", "parked with fault", "EWM1", "1-year", "U", "A", ("parked, blade stuck",),
                 6),
    )
}  # fmt: skip


EVENTS_IN_WORDS: dict[str, Event] = {
    "startup": "start", "start": "start", "shutdown": "stop", "stop": "stop",
    "emergency": "emergency stop", "gridloss": "grid loss",
    "fault": "emergency stop",  # in which every fault ends
    "idling": "idling", "idle": "idling", "parked": "parked",
}  # fmt: skip
"""What the turbine does in load cases without a number, as names of files say them."""


def row_of(dlc: str) -> LoadCase | None:
    """Row of a load case or of a variant of it, as files name them; None that the table lacks.

    Examples
    --------
    >>> row_of("6.2a").dlc, row_of("9.9"), row_of("steady")
    ('6.2', None, None)
    """
    return LOAD_CASES.get(dlc.rstrip(ascii_lowercase))


def event_of(dlc: str) -> Event:
    """What the control does or suffers in a load case of the table, of several events the first.

    Of one that the table lacks, what its word says.

    Examples
    --------
    >>> event_of("4.2"), event_of("6.2a"), event_of("idle"), event_of("steady")
    ('stop', 'parked', 'idling', 'none')
    """
    row = row_of(dlc)
    return EVENTS_IN_WORDS.get(dlc, "none") if row is None else row.events[0]


def by_load_case(told: Mapping[str, float], there: Iterable[str]) -> dict[str, float]:
    """Numbers of events by the load cases that are there, of what is told of some.

    A number is that of a load case with all its variants: those of which nothing is told share it
    evenly. Words of one event are the same load case. What is not there is left out.

    Parameters
    ----------
    told : mapping of str to float
        By load case, variant or word.
    there : iterable of str
        Load cases, variants and words that there are.

    Returns
    -------
    dict of str to float
        By those that are there.

    Examples
    --------
    >>> there = ["3.1a", "3.1b", "4.1a", "startup"]
    >>> by_load_case({"3.1": 900.0, "4.1b": 50.0, "start": 7.0}, there)
    {'3.1a': 450.0, '3.1b': 450.0, 'startup': 7.0}
    """
    names = sorted(set(there))
    found: dict[str, float] = {}
    for dlc, number in told.items():
        own = _counted(dlc, told, names)
        found |= dict.fromkeys(own, number / max(len(own), 1))
    return found


def check_counted(key: str, told: Iterable[str], there: Iterable[str]) -> None:
    """Refuse load cases, variants and words whose number `by_load_case` gives to none.

    Parameters
    ----------
    key : str
        What tells their numbers.
    told : iterable of str
        Those with a number.
    there : iterable of str
        Those that there are.

    Raises
    ------
    loadflow.errors.InputError
        Some are not there, or all their variants have a number of their own.

    Examples
    --------
    >>> check_counted("per_year", ["3.1", "3.1a"], ["3.1a", "3.1b"])
    >>> check_counted("per_year", ["3.1", "3.1a"], ["3.1a"])
    Traceback (most recent call last):
    ...
    loadflow.errors.InputError: per_year: nothing takes the number of 3.1, as all its variants or \
words have one of their own; leave it out
    """
    named, names = [*told], sorted(set(there))
    idle = [dlc for dlc in named if not _counted(dlc, named, names)]
    if missing := [dlc for dlc in idle if not _counted(dlc, (), names)]:
        raise InputError(f"{key}: {none_such('load case', missing, names)}")
    if idle:
        raise InputError(
            f"{key}: nothing takes the number of {', '.join(idle)}, as all its variants or "
            "words have one of their own; leave it out"
        )


def _counted(dlc: str, told: Collection[str], names: Iterable[str]) -> list[str]:
    """Those of `names` that the number of a load case, of all that are told, is of."""
    return [name for name in names if name == dlc or (name not in told and _same(name, dlc))]


def _same(name: str, dlc: str) -> bool:
    """Whether a name is a variant of a load case, or a word that says the same event."""
    row = row_of(name)
    if row is None:
        return dlc in EVENTS_IN_WORDS and EVENTS_IN_WORDS.get(name) == EVENTS_IN_WORDS[dlc]
    return row.dlc == dlc


def factor_of_maximum(dlc: str) -> float:
    """γ_f of the largest load of a series of a load case; 1 for one that the table lacks."""
    row = row_of(dlc)
    return 1.0 if row is None else row.factor_of_maximum


def stands_or_starts(dlc: str) -> bool:
    """Whether the shaft stands, starts or stops in a load case, one of the table or a word.

    Every fault ends in a stop.

    Examples
    --------
    >>> stands_or_starts("3.1"), stands_or_starts("startup"), stands_or_starts("steady")
    (True, True, False)
    """
    return event_of(dlc) != "none"


def starts_or_stops(dlc: str) -> bool:
    """Whether the shaft comes from standstill, or to it, in a load case of the table or a word.

    Examples
    --------
    >>> starts_or_stops("3.1"), starts_or_stops("shutdown"), starts_or_stops("idle")
    (True, True, False)
    """
    return event_of(dlc) not in ("none", *STANDING)


def parked(dlc: str) -> bool:
    """Whether a brake holds the shaft throughout a load case, one of the table or a word.

    Examples
    --------
    >>> parked("6.1"), parked("6.2a"), parked("parked"), parked("idling")
    (True, True, True, False)
    """
    return event_of(dlc) in BRAKED


def load_case(dlc: str) -> LoadCase:
    """Row of the table of design load cases.

    Parameters
    ----------
    dlc : str
        Number of the load case, such as ``"1.1"``.

    Returns
    -------
    LoadCase
        Its wind, speeds, events, safety and length.

    Raises
    ------
    InputError
        There is none of that number.

    Examples
    --------
    >>> from loadflow.wind import load_case
    >>> load_case("1.3").wind
    'ETM'
    """
    if dlc not in LOAD_CASES:
        raise InputError(f"load case {dlc!r} is unknown; known: {', '.join(LOAD_CASES)}")
    return LOAD_CASES[dlc]


def wind_range(event: Event, cut_in: float, cut_out: float) -> tuple[float, float]:
    """Lowest and highest mean speed that a turbine may meet an event in, m/s."""
    return (_CALM, _FASTEST) if event in STANDING else (cut_in, cut_out)


def speeds(
    rule: Speeds, machine: Machine, options: WindOptions, steady: bool = False
) -> list[float]:
    """Mean speeds of a rule, m/s.

    "operating" are the multiples of the step from cut-in to cut-out (4, 6, … 24 m/s for 3 … 25),
    "parked" those up to 0.7 V_ref; "rated" is rated speed and 2 m/s to either side; "50-year" and
    "1-year" are V_ref and 0.8 V_ref (10-min means), 1.4 times that in the `steady` wind.
    """
    own, height = wind_class(options), machine.hub_height
    around = [machine.rated - 2, machine.rated, machine.rated + 2]
    if rule == "operating":
        return _multiples(options.speed_step, machine.cut_in, machine.cut_out)
    if rule == "parked":
        return _multiples(options.speed_step, options.speed_step, 0.7 * own.v_ref)
    if rule in ("50-year", "1-year"):
        period = int(rule.split("-")[0])
        return [float(iec.ewm_speed(height, own, height, period, steady))]
    return {
        "rated": around,
        "rated, out": [*around, machine.cut_out],
        "in, rated, out": [machine.cut_in, *around, machine.cut_out],
    }[rule]


def _multiples(step: float, low: float, high: float) -> list[float]:
    # the tolerance keeps a bound that is itself a multiple
    return [k * step for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def wind_class(options: WindOptions) -> iec.WindClass:
    """Speeds of the class that the options name."""
    if options.v_ref is not None and options.v_ave is not None:
        return iec.WindClass("S", options.v_ref, options.v_ave)
    return iec.class_speeds(options.wind_class)
