"""A load case over time: turbulence at every section, speed and pitch control, loads at the hub."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.numerics.watch import part_of_work
from loadflow.turbines import Turbine, load_turbine
from loadflow.wind import Condition, Field, WindOptions, condition, inflow
from loadflow.wind.cases import STANDING, Event, wind_range

from .options import STEPS, RotorOptions

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from .control.constants import Schedule
    from .loop import State
    from .rungs import Same

_MARGIN = 10.0  # s of wind before and after, because the sections meet it early and late
_CALMING, _CALM_STEP = 40.0, 0.04  # s, until a tower rests


def simulate(
    turbine: str | Path | Turbine = "nrel-5mw",
    *,
    dlc: str = "1.1",
    wind_speed: float,
    seed: int = 1,
    duration: float | None = None,
    category: str | None = None,
    wind_class: str | None = None,
    shear: float | None = None,
    yaw_error: float | None = None,
    azimuth: float | None = None,
    event: Event | None = None,
    event_time: float | None = None,
    steady: bool = False,
    dt: float = 0.025,
    run_in: float = 60.0,
    base_seed: int = 0,
    rung: str | None = None,
    options: RotorOptions | None = None,
    wind_options: WindOptions | None = None,
    field: Field | None = None,
) -> xr.Dataset:
    """Loads of the rotor on the shaft over time.

    Parameters
    ----------
    turbine : str, Path or Turbine
    dlc : str
        Design load case of IEC 61400-1, 1.1 … 7.1; see `loadflow.wind.LOAD_CASES`.
    wind_speed : float
        Mean at the hub, m/s.
    seed : int
        Index of the realisation of a turbulent wind, or of the variant (sign, time of the event,
        yaw error) of another; the same arguments give the same result, bit for bit.
    duration : float, optional
        Length of the result, s; that of the load case by default (600 s for 1.1).
    category, wind_class : str, optional
        Turbulence category ("B") and wind class ("I") of IEC 61400-1.
    shear : float, optional
        Exponent of the wind profile; by default 0.2, and 0.11 in the extreme wind.
    yaw_error : float, optional
        Direction of the mean wind against the shaft, rad, positive blowing to the left.
    azimuth : float, optional
        Of blade 1 when a gust begins, or of a rotor that stands, rad.
    event : str, optional
        What the control does or suffers instead of what the load case says: "none", "start",
        "stop", "emergency stop", "grid loss", "blade stuck", "pitch runaway", "parked", "idling"
        or "parked, blade stuck".
    event_time : float, optional
        When, s from the start of the result.
    steady : bool
        The steady extreme wind instead of the turbulent one (6.1 … 6.3, 7.1).
    dt : float
        Step of the result, s.
    run_in : float
        Simulated before t = 0 and thrown away, s.
    base_seed : int
        Seed of the whole study; see `loadflow.wind.case_seed`.
    rung : {"tables", "bem", "flap", "tower"}, optional
        Rigid blades with the induction from a table; rigid blades with the induction solved at
        every section and step; blades with two flap and one edge mode, induction from the table;
        these on a tower that bends fore-aft and side-side, with a drivetrain that twists. By
        default "tower" ("flap" where the file of the turbine does not say how its tower bends).
    options : RotorOptions, optional
        Effects and imbalance, individual pitch control.
    wind_options : WindOptions, optional
        Wind class, category, shear, grid and scaling of the turbulence; the arguments above go
        before it.
    field : Field, optional
        Wind of the user's own instead of that of the load case; from −run_in on.

    Returns
    -------
    xarray.Dataset
        Over ``time``: ``speed`` (rad/s), ``pitch``, ``azimuth`` (rad, blade 1, 0 up, clockwise seen
        from upwind), ``hub_force`` (axis, time; N) and ``hub_moment`` (axis, time; N m): what the
        rotor applies to the shaft at its apex, weight included, in the shaft frame that does not
        rotate (x along the shaft downwind, z up, y left looking downwind); ``root_force`` and
        ``root_moment`` (axis, time; N, N m): what blade 1 applies to the hub at its root, in axes
        that turn with the rotor but not with the pitch (x outward along the axis of pitch, y
        downwind, z against the rotation); ``wind`` (axis, time;
        m/s, ground frame) at the hub, ``generator_torque`` (N m), ``generator_speed`` (rad/s),
        ``tower_fore_aft`` (downwind), ``tower_side_side`` (left) and ``tip_deflection`` (m),
        ``blade_pitch`` (blade, time; rad), ``state`` (number of the supervisory state). The
        attribute ``tripped`` is the time (s) at which the overspeed protection stopped the turbine
        though the load case has no fault, or not yet: 0 in the run-in (it then stops or stands from
        the beginning), NaN if it did not trip.

    Raises
    ------
    InputError
        Unknown turbine, load case, event or rung; a wind speed outside cut-in … cut-out where the
        turbine runs; bad times; a variant that the load case does not have.
    SolverError
        If the model breaks down.

    Examples
    --------
    A stop that begins after 20 s and ends at rest:

    >>> from loadflow.rotor import simulate
    >>> stop = simulate(dlc="4.1", wind_speed=8, duration=80, event_time=20, rung="tables")
    >>> float(stop["speed"][-1])
    0.0
    """
    from .inflow import wind_machine

    plant = load_turbine(turbine)
    own = _given(category=category, wind_class=wind_class, shear_exponent=shear)
    winds = replace(wind_options or WindOptions(), **own)
    case = condition(
        dlc,
        wind_machine(plant),
        winds,
        wind_speed=wind_speed,
        index=seed,
        duration=duration,
        steady=steady,
    )
    changes = _given(
        shear_exponent=shear,
        yaw_error=yaw_error,
        azimuth=azimuth,
        event=event,
        event_time=event_time,
    )
    return simulate_condition(
        plant,
        replace(case, **changes),
        winds,
        dt=dt,
        run_in=run_in,
        base_seed=base_seed,
        rung=rung,
        options=options,
        field=field,
    )


def simulate_condition(
    turbine: str | Path | Turbine,
    case: Condition,
    winds: WindOptions,
    *,
    dt: float = 0.025,
    run_in: float = 60.0,
    base_seed: int = 0,
    rung: str | None = None,
    options: RotorOptions | None = None,
    field: Field | None = None,
) -> xr.Dataset:
    """Loads over time in one wind of a load case, as `loadflow.wind.conditions` lists them.

    Parameters
    ----------
    turbine, dt, run_in, base_seed, rung, options, field
        As `simulate`.
    case : Condition
        The wind, one of `loadflow.wind.conditions`.
    winds : WindOptions
        Options that made the condition.

    Returns
    -------
    xarray.Dataset
        The case, as `simulate` gives it.

    Examples
    --------
    >>> from loadflow.rotor import simulate_condition
    >>> from loadflow.wind import Machine, WindOptions, conditions
    >>> winds = WindOptions(radii=3, angles=8)
    >>> machine = Machine(3.0, 11.4, 25.0, 126.0, 90.0)
    >>> case = conditions("1.1", machine, winds, wind_speeds=[8.0], duration=5.0)[0]
    >>> loads = simulate_condition("nrel-5mw", case, winds, run_in=1.0, rung="tables")
    >>> loads["hub_force"].units, round(float(loads["speed"].mean()), 1)
    ('N', 1.0)
    """
    from . import slots as k
    from .inflow import case_inflow, wind_machine
    from .loop import run
    from .rungs import Same, finest_rung, prepare

    plant = load_turbine(turbine)
    _check(plant, case, dt, run_in)
    rung = rung or finest_rung(plant)
    options = options or RotorOptions()
    if options.dynamic_stall is None:
        options = replace(options, dynamic_stall=case.event in STANDING)
    prepared = prepare(plant, rung, options)
    m, c = prepared
    state = _first_state(Same(prepared), case)
    run_in += _wait(Same(prepared), state, case, run_in, dt)
    start = 0.0
    if field is None and case.sigma > 0:
        start = _MARGIN
        length = run_in + case.duration + 2 * _MARGIN
        whole = replace(case, duration=length)
        with part_of_work("wind"):
            field = inflow(whole, wind_machine(plant), winds, seed=base_seed)
    lost, kept = round(run_in / dt), round(case.duration / dt)
    time = dt * np.arange(-lost, kept, dtype=np.float64)
    out = run(
        m,
        c,
        case_inflow(case, wind_machine(plant), time, field),
        state,
        dt,
        steps=time.size,
        start=start,
        schedule=_schedule(case, start + lost * dt, dt),
    )
    data = _dataset(out[lost:], dt)
    data.attrs = {
        "turbine": plant.name,
        "dlc": case.dlc,
        "wind_speed": case.wind_speed,
        "seed": case.index,
        "category": winds.category,
        "rung": rung,
        "shear": case.shear_exponent,
        "event": case.event,
        "event_time": case.event_time,
        "safety_factor": case.safety_factor,
        "tripped": _trip(time, out[:, k.STATE], case),
    }
    return data


def _given(**arguments: Any) -> dict[str, Any]:
    return {name: value for name, value in arguments.items() if value is not None}


def _check(turbine: Turbine, case: Condition, dt: float, run_in: float) -> None:
    from .control.constants import EVENTS

    check_one_of("event", case.event, EVENTS)
    low, high = wind_range(case.event, turbine.cut_in, turbine.cut_out)
    if not low <= case.wind_speed <= high:
        raise InputError(
            f"wind_speed = {case.wind_speed} m/s is not allowed; {turbine.name} "
            f"{'stands' if case.event in STANDING else 'runs'} from {low} to {high} m/s"
        )
    if not STEPS[0] <= dt <= STEPS[1]:
        allowed = f"{STEPS[0]} … {STEPS[1]} s"
        raise InputError(f"dt = {dt} s is not allowed; it must be within {allowed}")
    if not (case.duration >= dt and run_in >= 0):
        raise InputError(
            f"duration = {case.duration} s, run_in = {run_in} s: > 0 and >= 0 are needed"
        )


def _first_state(prepared: Same, case: Condition) -> State:
    """State before the run-in: at rest, idling, or running in a wind without its changes."""
    from .loop import standing_state

    if case.event in STANDING or case.event == "start":
        m, c = prepared.thing
        state = standing_state(
            m,
            c,
            case.wind_speed,
            case.azimuth,
            idle=case.event == "idling",
            stuck=case.event == "parked, blade stuck",
        )
        deflection = _tower_at_rest(prepared, case.wind_speed, case.shear_exponent)
        state.frame[m.frame.carries > 0] = deflection[m.frame.carries > 0]
        return state
    return _running_state(prepared, case.wind_speed, case.shear_exponent).copy()


@lru_cache(maxsize=64)
def _tower_at_rest(prepared: Same, wind_speed: float, shear: float) -> NDArray[np.float64]:
    """Where weight and a steady wind hold the tower of a parked rotor, which sways for minutes."""
    from .frame import calmed
    from .inflow import steady_inflow
    from .loop import run, standing_state

    m, c = prepared.thing
    state = standing_state(m, c, wind_speed, 0.0, idle=False, stuck=False)
    if np.any(m.frame.carries > 0):
        steps = round(_CALMING / _CALM_STEP)
        inflow = steady_inflow(wind_speed, steps, shear)
        run(m._replace(frame=calmed(m.frame)), c, inflow, state, _CALM_STEP, steps=steps)
    return state.frame


@lru_cache(maxsize=64)
def _running_state(prepared: Same, wind_speed: float, shear: float) -> State:
    """State at the operating point, found once for all realisations of a wind speed."""
    from .steady import operating_point

    m, c = prepared.thing
    return operating_point(m, c, wind_speed, shear)[1]


def _wait(prepared: Same, state: State, case: Condition, run_in: float, dt: float) -> float:
    """Time to add to the run-in so that blade 1 is where it shall be when the gust begins, s.

    Turbulence meets the rotor anywhere, and a rotor that stands is there already.
    """
    from . import slots as k
    from .inflow import steady_inflow
    from .loop import run

    if case.sigma > 0 or state.speed == 0:
        return 0.0
    m, c = prepared.thing
    begin = run_in + case.gust_time
    steps = round((begin + 4 * np.pi / state.speed) / dt)
    wind = steady_inflow(case.wind_speed, steps, case.shear_exponent, case.yaw_error)
    out = run(m, c, wind, state.copy(), dt, steps=steps)
    turned, time = np.unwrap(out[:, k.AZIMUTH]), dt * np.arange(steps)
    now = np.interp(begin, time, turned)
    there = now + (case.azimuth - now) % (2 * np.pi)
    return float(np.interp(there, turned, time) - begin)


def _schedule(case: Condition, zero: float, dt: float) -> Schedule:
    """What happens when; `zero`: the loop's time at the start of the series."""
    from .control.constants import EVENTS, Schedule

    # half a step early: sums of steps miss the time by a rounding error
    return Schedule(EVENTS.index(case.event), zero + case.event_time - 0.5 * dt)


def _trip(time: np.ndarray, state: np.ndarray, case: Condition) -> float:
    """When the overspeed protection stopped the turbine unasked, s; 0 in the run-in, NaN never."""
    from .control.constants import FAULT, FAULTS

    tripped = time[state == FAULT]
    if not tripped.size or (case.event in FAULTS and tripped[0] >= case.event_time):
        return np.nan
    return max(float(tripped[0]), 0.0)


def _dataset(out: np.ndarray, dt: float) -> xr.Dataset:
    import xarray as xr

    from . import slots as k
    from .control.constants import STATES

    def scalar(column: int, units: str, name: str) -> tuple:
        return "time", out[:, column].copy(), {"units": units, "long_name": name}

    def vector(columns: list[int], units: str, name: str) -> tuple:
        return ("axis", "time"), out[:, columns].T.copy(), {"units": units, "long_name": name}

    time = np.arange(out.shape[0]) * dt
    return xr.Dataset(
        {
            "speed": scalar(k.SPEED, "rad/s", "rotor speed"),
            "pitch": scalar(k.PITCH, "rad", "blade pitch"),
            "azimuth": scalar(k.AZIMUTH, "rad", "azimuth of blade 1"),
            "hub_force": vector([k.FX, k.FY, k.FZ], "N", "force of the rotor on the shaft"),
            "hub_moment": vector(
                [k.MX, k.MY, k.MZ], "N m", "moment of the rotor on the shaft at the apex"
            ),
            "root_force": vector(
                [k.ROOT, k.ROOT + 1, k.ROOT + 2], "N", "force of blade 1 on the hub at its root"
            ),
            "root_moment": vector(
                [k.ROOT + 3, k.ROOT + 4, k.ROOT + 5],
                "N m",
                "moment of blade 1 on the hub at its root",
            ),
            "wind": vector([k.WIND_X, k.WIND_Y, k.WIND_Z], "m/s", "wind at the hub"),
            "generator_torque": scalar(k.TORQUE, "N m", "generator torque"),
            "generator_speed": scalar(k.GENERATOR, "rad/s", "generator speed"),
            "tower_fore_aft": scalar(k.FORE_AFT, "m", "tower top, downwind"),
            "tower_side_side": scalar(k.SIDE_SIDE, "m", "tower top, to the left"),
            "tip_deflection": scalar(k.TIP, "m", "deflection of the outermost section of blade 1"),
            "blade_pitch": (
                ("blade", "time"),
                out[:, k.COLUMNS :].T.copy(),
                {"units": "rad", "long_name": "pitch of each blade"},
            ),
            "state": (
                "time",
                out[:, k.STATE].astype(np.int8),
                {
                    "units": "1",
                    "long_name": "supervisory state",
                    "flag_values": np.arange(len(STATES), dtype=np.int8),
                    "flag_meanings": " ".join(state.replace(" ", "_") for state in STATES),
                },
            ),
        },
        coords={
            "blade": np.arange(1, out.shape[1] - k.COLUMNS + 1),
            "time": ("time", time, {"units": "s", "long_name": "time"}),
            "axis": ["x", "y", "z"],
        },
    )
