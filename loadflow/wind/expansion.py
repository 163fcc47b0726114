"""From a row of the table of load cases to the winds that it stands for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import inf, isfinite, pi, radians
from numbers import Integral
from typing import Literal

from loadflow.errors import InputError
from loadflow.wind import iec
from loadflow.wind.cases import (
    TURBULENT,
    VARIANTS,
    Event,
    LoadCase,
    Wind,
    load_case,
    speeds,
    wind_class,
)
from loadflow.wind.options import Machine, WindOptions

_RANGES = (
    ("yaw_error", -pi, pi, "rad"),
    ("azimuth", -2 * pi, 2 * pi, "rad"),
    ("wind_speed", 0.0, inf, "m/s"),
    ("gust_time", 0.0, inf, "s"),
    ("event_time", 0.0, inf, "s"),
)
"""Lowest and highest value of what a condition states, and its units."""


@dataclass(frozen=True)
class Condition:
    """One wind to simulate: everything but the grid and the scene's seed.

    Attributes
    ----------
    dlc, wind, kind, safety_factor, duration
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
    event : str
        What the control does or suffers.
    gust_time, event_time : float
        Start of the gust and of the event, s.
    azimuth : float
        Azimuth of blade 1 at the start of a gust, or of a rotor that stands, rad.
    yaw_error : float
        Mean angle of the wind to the rotor axis, rad; > 0 blows toward +y.
    shear_exponent : float
        Exponent of the mean profile.
    weight : float
        Share of the lifetime, from the wind-speed distribution; 0 for cases that the standard
        counts as events.

    Examples
    --------
    >>> from loadflow.wind import Machine, conditions
    >>> gusts = conditions("3.2", Machine(3.0, 11.4, 25.0, 126.0, 90.0))
    >>> gusts[0].dlc, gusts[0].wind, gusts[0].safety_factor
    ('3.2', 'EOG', 1.35)
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
    azimuth: float = 0.0
    yaw_error: float = 0.0
    shear_exponent: float = 0.2
    duration: float = 600.0
    weight: float = 0.0
    kind: Literal["U", "F"] = "U"
    safety_factor: float = 1.0

    def __post_init__(self) -> None:
        if not (0 < self.duration < inf and isfinite(self.shear_exponent)):
            raise InputError(
                f"duration = {self.duration} s, shear_exponent = {self.shear_exponent}: the "
                "duration must be > 0, and both finite"
            )
        for name, low, high, units in _RANGES:
            value = getattr(self, name)
            if not (low <= value <= high and isfinite(value)):
                raise InputError(
                    f"{name} = {value} {units} is not allowed; it must be finite and within "
                    f"{low:.5g} … {high:.5g} {units}"
                )


def conditions(
    dlc: str,
    machine: Machine,
    options: WindOptions | None = None,
    *,
    wind_speeds: Sequence[float] | None = None,
    yaw_errors: Sequence[float] | None = None,
    azimuths: Sequence[float] = (0.0,),
    duration: float | None = None,
    steady: bool = False,
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
    azimuths : sequence of float
        Azimuths of blade 1 at the start of a gust or at standstill, rad; turbulent winds meet the
        rotor at any azimuth and take the first.
    duration : float, optional
        Length instead of that of the load case, s.
    steady : bool
        The steady extreme wind (2.6) with its yaw errors instead of the turbulent one.

    Returns
    -------
    list of Condition
        Ordered by speed; the index runs from 1 within a speed, so `case_seed` never repeats.

    Raises
    ------
    InputError
        An unknown load case; `steady` for a wind that is not the extreme one.

    Examples
    --------
    >>> from loadflow.wind import Machine, conditions
    >>> nrel_5mw = Machine(cut_in=3, rated=11.4, cut_out=25, rotor_diameter=126, hub_height=90)
    >>> len(conditions("1.1", nrel_5mw)), len(conditions("1.5", nrel_5mw))
    (66, 44)
    """
    row, options = load_case(dlc), options or WindOptions()
    if wind_speeds is None:
        wind_speeds = speeds(row.speeds, machine, options, steady)
    choices = _choices(row, yaw_errors, azimuths, steady)
    count = len(choices) * ((options.seeds or row.seeds) if row.turbulent and not steady else 1)
    cases = [
        condition(
            dlc,
            machine,
            options,
            wind_speed=speed,
            index=index,
            yaw_errors=yaw_errors,
            azimuths=azimuths,
            duration=duration,
            steady=steady,
        )
        for speed in wind_speeds
        for index in range(1, count + 1)
    ]
    share = {speed: _share(row, speed, machine, options) for speed in wind_speeds}
    return [replace(case, weight=share[case.wind_speed] / count) for case in cases]


def condition(
    dlc: str,
    machine: Machine,
    options: WindOptions | None = None,
    *,
    wind_speed: float,
    index: int = 1,
    yaw_errors: Sequence[float] | None = None,
    azimuths: Sequence[float] = (0.0,),
    duration: float | None = None,
    steady: bool = False,
) -> Condition:
    """One wind of a load case: number `index` at one mean speed; the rest as in `conditions`.

    The index counts realisations of a turbulent wind, from 0 without end, or the variants (sign,
    time of the event, azimuth, yaw error) of a deterministic one, from 1. What it stands for does
    not depend on the number of seeds.

    Parameters
    ----------
    dlc, machine, options, yaw_errors, azimuths, duration, steady
        As `conditions`.
    wind_speed : float
        Mean at the hub, m/s.
    index : int
        Which wind of that speed.

    Returns
    -------
    Condition
        Its turbulence or gust, the event and its time, and the length of the series.

    Raises
    ------
    InputError
        Also if a deterministic wind has no variant of that number, or the index is none.

    Examples
    --------
    >>> from loadflow.wind import Machine, condition
    >>> machine = Machine(
    ...     cut_in=3.0, rated=11.4, cut_out=25.0, rotor_diameter=126.0, hub_height=90.0
    ... )
    >>> round(condition("1.1", machine, wind_speed=12.0).sigma, 3)  # m/s
    2.044
    """
    row, options = load_case(dlc), options or WindOptions()
    if not isinstance(index, Integral) or index < 0:
        raise InputError(f"index (seed) = {index} is not allowed; it must be a whole number >= 0")
    if steady and not row.wind.startswith("EWM"):
        raise InputError(f"load case {dlc} has no steady extreme wind, its wind is {row.wind}")
    choices = _choices(row, yaw_errors, azimuths, steady)
    turbulent = row.turbulent and not steady
    if not turbulent and not 1 <= index <= len(choices):
        raise InputError(
            f"index = {index}: load case {dlc} has no turbulence and {len(choices)} variants"
        )
    round_, place = divmod(index - 1, len(choices))
    variant, delay, azimuth, yaw = choices[place]
    length = row.duration if duration is None else duration
    start = min(row.gust_time, length / 2)
    gust = _gust(row.wind, wind_speed, machine, options)
    return Condition(
        dlc=dlc,
        wind=row.wind,
        wind_speed=float(wind_speed),
        index=index,
        sigma=_sigma(row.wind, wind_speed, options) if turbulent else 0.0,
        gust=-gust if variant.endswith("-") else gust,
        horizontal=variant.startswith("horizontal"),
        event=row.events[round_ % len(row.events)],
        gust_time=start,
        event_time=max(start + delay, 0.0),
        azimuth=azimuth,
        yaw_error=yaw,
        shear_exponent=0.11 if row.wind.startswith("EWM") else options.shear_exponent,
        duration=length,
        kind=row.kind,
        safety_factor=row.safety_factor,
    )


def _choices(
    row: LoadCase, yaw_errors: Sequence[float] | None, azimuths: Sequence[float], steady: bool
) -> list[tuple[str, float, float, float]]:
    """Variant, delay of the event, azimuth and yaw error that an index stands for."""
    degrees = row.steady_yaw_errors if steady else row.yaw_errors
    yaws = [radians(y) for y in degrees] if yaw_errors is None else list(yaw_errors)
    around = azimuths[:1] if row.turbulent and not steady else azimuths
    return list(product(VARIANTS.get(row.wind, ("",)), row.event_delays, around, yaws))


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
