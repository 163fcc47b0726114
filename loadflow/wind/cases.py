"""Design load cases of IEC 61400-1 as data, and the wind conditions that each stands for.

The table is that of edition 3 (table 2). Where the standard leaves numbers open (yaw errors,
realisations of some cases) the row follows common design load bases and can be overridden.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, radians
from typing import Literal

from loadflow.errors import InputError
from loadflow.wind import iec
from loadflow.wind.gusts import PERIOD
from loadflow.wind.options import Machine, WindOptions

Wind = Literal["NWP", "NTM", "ETM", "EOG", "EDC", "ECD", "EWS", "EWM50", "EWM1"]
Speeds = Literal[
    "operating", "rated", "rated, out", "in, rated, out", "50-year", "1-year", "parked"
]
Event = Literal[
    "none", "control fault", "protection fault", "grid loss", "start", "stop", "emergency stop",
    "parked", "parked, grid loss", "parked, fault",
]  # fmt: skip
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
    event : str
        What the control does or suffers.
    seeds : int
        Realisations per mean speed and yaw error (1 where the wind is deterministic).
    yaw_errors : tuple of float
        Mean yaw errors, degrees.
    duration : float
        Length of a series, s.
    event_delays : tuple of float
        Times of the event after the start of the gust, as shares of the gust's period.
    """

    dlc: str
    situation: str
    wind: Wind
    speeds: Speeds
    kind: Literal["U", "F"]
    safety: str
    event: Event = "none"
    seeds: int = 1
    yaw_errors: tuple[float, ...] = (0.0,)
    duration: float = 600.0
    event_delays: tuple[float, ...] = (0.0,)

    @property
    def safety_factor(self) -> float:
        """Partial safety factor for loads γ_f."""
        return SAFETY[self.safety]


_OPERATION, _FAULT = "power production", "power production with fault"
_START, _STOP, _PARKED = "start", "normal stop", "parked or idling"
_ALL_ROUND = tuple(15.0 * k for k in range(-11, 13))
LOAD_CASES = {
    row.dlc: row
    for row in (
        LoadCase("1.1", _OPERATION, "NTM", "operating", "U", "extrapolated", seeds=6),
        LoadCase("1.2", _OPERATION, "NTM", "operating", "F", "F", seeds=6),
        LoadCase("1.3", _OPERATION, "ETM", "operating", "U", "N", seeds=6),
        LoadCase("1.4", _OPERATION, "ECD", "rated", "U", "N", duration=100.0),
        LoadCase("1.5", _OPERATION, "EWS", "operating", "U", "N", duration=100.0),
        LoadCase("2.1", _FAULT, "NTM", "operating", "U", "N", "control fault", 12),
        LoadCase("2.2", _FAULT, "NTM", "operating", "U", "A", "protection fault", 12),
        # grid loss at the start of the gust, its dip, its steepest rise, its peak
        LoadCase("2.3", _FAULT, "EOG", "rated, out", "U", "A", "grid loss", duration=100.0,
                 event_delays=(0.0, 0.23, 0.37, 0.5)),
        LoadCase("2.4", _FAULT, "NTM", "operating", "F", "F", "control fault", 3, (-20.0, 20.0)),
        LoadCase("3.1", _START, "NWP", "operating", "F", "F", "start", duration=300.0),
        LoadCase("3.2", _START, "EOG", "in, rated, out", "U", "N", "start", duration=300.0),
        LoadCase("3.3", _START, "EDC", "in, rated, out", "U", "N", "start", duration=300.0),
        LoadCase("4.1", _STOP, "NWP", "operating", "F", "F", "stop", duration=300.0),
        LoadCase("4.2", _STOP, "EOG", "rated, out", "U", "N", "stop", duration=300.0),
        LoadCase("5.1", "emergency stop", "NTM", "rated, out", "U", "N", "emergency stop", 12),
        LoadCase("6.1", _PARKED, "EWM50", "50-year", "U", "N", "parked", 6, (-8.0, 8.0)),
        LoadCase("6.2", _PARKED, "EWM50", "50-year", "U", "A", "parked, grid loss", 1, _ALL_ROUND),
        LoadCase("6.3", _PARKED, "EWM1", "1-year", "U", "N", "parked", 6, (-20.0, 20.0)),
        LoadCase("6.4", _PARKED, "NTM", "parked", "F", "F", "parked", 6),
        LoadCase("7.1", "parked with fault", "EWM1", "1-year", "U", "A", "parked, fault", 6),
    )
}  # fmt: skip


@dataclass(frozen=True)
class Condition:
    """One wind to simulate: everything but the grid and the scene's seed.

    Attributes
    ----------
    dlc, wind, event, kind, safety_factor, duration
        As in `LoadCase`.
    wind_speed : float
        Mean speed at the hub, m/s.
    index : int
        Index of the realisation, from 1; also numbers the variants of a deterministic wind.
    sigma : float
        Standard deviation σ1, m/s; 0 without turbulence.
    gust : float
        V_gust (m/s), direction change (rad) or wind-shear bracket (m/s), with its sign.
    horizontal : bool
        Whether an extreme wind shear is horizontal.
    gust_time, event_time : float
        Start of the gust and of the event, s.
    yaw_error : float
        Mean angle of the wind to the rotor axis, rad; > 0 blows toward +y.
    shear_exponent : float
        Exponent of the mean profile.
    weight : float
        Share of the lifetime, from the wind-speed distribution; 0 for cases that the standard
        counts as events.
    """

    dlc: str
    wind: Wind
    wind_speed: float
    index: int
    sigma: float = 0.0
    gust: float = 0.0
    horizontal: bool = False
    event: Event = "none"
    gust_time: float = 50.0
    event_time: float = 50.0
    yaw_error: float = 0.0
    shear_exponent: float = 0.2
    duration: float = 600.0
    weight: float = 0.0
    kind: Literal["U", "F"] = "U"
    safety_factor: float = 1.0


def load_case(dlc: str) -> LoadCase:
    """Row of the table; raises `InputError` if there is none of that number."""
    if dlc not in LOAD_CASES:
        raise InputError(f"load case {dlc!r} is unknown; known: {', '.join(LOAD_CASES)}")
    return LOAD_CASES[dlc]


def speeds(rule: Speeds, machine: Machine, options: WindOptions) -> list[float]:
    """Mean speeds of a rule, m/s.

    "operating" are the multiples of the step from cut-in to cut-out (4, 6, … 24 m/s for 3 … 25),
    "parked" those up to 0.7 V_ref; "rated" is rated speed and 2 m/s to either side; "50-year" and
    "1-year" are V_ref and 0.8 V_ref (10-min means).
    """
    v_ref = wind_class(options).v_ref
    around = [machine.rated - 2, machine.rated, machine.rated + 2]
    if rule == "operating":
        return _multiples(options.speed_step, machine.cut_in, machine.cut_out)
    if rule == "parked":
        return _multiples(options.speed_step, options.speed_step, 0.7 * v_ref)
    return {
        "rated": around,
        "rated, out": [*around, machine.cut_out],
        "in, rated, out": [machine.cut_in, *around, machine.cut_out],
        "50-year": [v_ref],
        "1-year": [0.8 * v_ref],
    }[rule]


def _multiples(step: float, low: float, high: float) -> list[float]:
    # the tolerance keeps a bound that is itself a multiple
    return [k * step for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def wind_class(options: WindOptions) -> iec.WindClass:
    """Speeds of the class that the options name."""
    if options.v_ref is not None and options.v_ave is not None:
        return iec.WindClass("S", options.v_ref, options.v_ave)
    return iec.class_speeds(options.wind_class)


def conditions(
    dlc: str,
    machine: Machine,
    options: WindOptions | None = None,
    *,
    wind_speeds: Sequence[float] | None = None,
    yaw_errors: Sequence[float] | None = None,
    duration: float | None = None,
) -> list[Condition]:
    """Expand a load case into the winds to simulate.

    Parameters
    ----------
    dlc : str
        Number of the load case.
    machine : Machine
        Speeds and size of the turbine.
    options : WindOptions, optional
        Wind class, turbulence, speed step, number of seeds.
    wind_speeds : sequence of float, optional
        Mean speeds instead of those of the load case, m/s.
    yaw_errors : sequence of float, optional
        Mean yaw errors instead of those of the load case, rad.
    duration : float, optional
        Length instead of that of the load case, s.

    Returns
    -------
    list of Condition
        Ordered by speed; the index runs from 1 within a speed, so `case_seed` never repeats.

    Examples
    --------
    >>> from loadflow.wind import Machine, conditions
    >>> nrel_5mw = Machine(cut_in=3, rated=11.4, cut_out=25, rotor_diameter=126, hub_height=90)
    >>> len(conditions("1.1", nrel_5mw)), len(conditions("1.5", nrel_5mw))
    (66, 44)
    """
    row = load_case(dlc)
    options = options or WindOptions()
    yaws = [radians(y) for y in row.yaw_errors] if yaw_errors is None else list(yaw_errors)
    if row.wind in TURBULENT:
        variants: Sequence[str | int] = range(options.seeds or row.seeds)
    else:
        variants = VARIANTS.get(row.wind, ("",))
    choices = [(y, v, d) for y in yaws for v in variants for d in row.event_delays]
    length = row.duration if duration is None else duration
    exponent = 0.11 if row.wind.startswith("EWM") else options.shear_exponent
    result = []
    for speed in speeds(row.speeds, machine, options) if wind_speeds is None else wind_speeds:
        sigma = _sigma(row.wind, speed, options)
        gust = _gust(row.wind, speed, machine, options)
        start = min(Condition.gust_time, length / 2)
        for index, (yaw, variant, delay) in enumerate(choices, start=1):
            name = str(variant)
            result.append(
                Condition(
                    dlc=dlc,
                    wind=row.wind,
                    wind_speed=float(speed),
                    index=index,
                    sigma=sigma,
                    gust=-gust if name.endswith("-") else gust,
                    horizontal=name.startswith("horizontal"),
                    event=row.event,
                    gust_time=start,
                    event_time=start + delay * PERIOD.get(row.wind, 0.0),
                    yaw_error=yaw,
                    shear_exponent=exponent,
                    duration=length,
                    weight=_share(row, speed, machine, options) / len(choices),
                    kind=row.kind,
                    safety_factor=row.safety_factor,
                )
            )
    return result


def _intensity(options: WindOptions) -> str | float:
    return options.reference_intensity or options.category


def _sigma(wind: Wind, speed: float, options: WindOptions) -> float:
    if wind == "NTM":
        return float(iec.ntm_sigma(speed, _intensity(options)))
    if wind == "ETM":
        return float(iec.etm_sigma(speed, wind_class(options), _intensity(options)))
    return float(iec.ewm_sigma(speed)) if wind in TURBULENT else 0.0


def _gust(wind: Wind, speed: float, machine: Machine, options: WindOptions) -> float:
    size = (machine.rotor_diameter, machine.hub_height)
    if wind == "EOG":
        return float(iec.eog_amplitude(speed, wind_class(options), _intensity(options), *size))
    if wind == "EDC":
        return float(iec.edc_angle(speed, _intensity(options), *size))
    if wind == "ECD":
        return float(iec.ecd_angle(speed, wind_class(options)))
    return float(iec.ews_amplitude(speed, _intensity(options), *size)) if wind == "EWS" else 0.0


def _share(row: LoadCase, speed: float, machine: Machine, options: WindOptions) -> float:
    """Share of the lifetime in the bin of a speed: operation in 1.1 and 1.2, standstill in 6.4."""
    operates = machine.cut_in <= speed <= machine.cut_out
    if row.dlc not in ("1.1", "1.2", "6.4") or operates == (row.dlc == "6.4"):
        return 0.0
    return float(iec.bin_probability(speed, wind_class(options).v_ave, options.speed_step))
