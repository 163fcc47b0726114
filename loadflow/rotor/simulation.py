"""A load case over time: turbulence at every section, speed and pitch control, loads at the hub."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from loadflow.errors import InputError
from loadflow.turbines import Turbine, load_turbine
from loadflow.wind.field import Field
from loadflow.wind.options import WindOptions

from .options import RotorOptions

if TYPE_CHECKING:
    import xarray as xr

SUPPORTED = ("1.1", "1.2", "1.3")
"""Load cases that `simulate` knows: power production in normal or extreme turbulence."""
_MARGIN = 10.0  # s of wind before and after, because the sections meet it early and late


def simulate(
    turbine: str | Path | Turbine = "nrel-5mw",
    *,
    dlc: str = "1.1",
    wind_speed: float,
    seed: int = 1,
    duration: float = 600.0,
    category: str = "B",
    wind_class: str = "I",
    shear: float = 0.2,
    yaw_error: float = 0.0,
    dt: float = 0.025,
    run_in: float = 60.0,
    base_seed: int = 0,
    rung: str = "flap",
    options: RotorOptions | None = None,
    wind_options: WindOptions | None = None,
    field: Field | None = None,
) -> xr.Dataset:
    """Loads of the rotor on the shaft over time.

    Parameters
    ----------
    turbine : str, Path or Turbine
    dlc : str
        Design load case: 1.1 and 1.2 (normal turbulence) or 1.3 (extreme turbulence).
    wind_speed : float
        Mean at the hub, m/s.
    seed : int
        Index of the realisation; the same arguments give the same result, bit for bit.
    duration, dt : float
        Length and step of the result, s.
    category, wind_class : str
        Turbulence category and wind class of IEC 61400-1.
    shear : float
        Exponent of the wind profile.
    yaw_error : float
        Direction of the mean wind against the shaft, rad, positive blowing to the left.
    run_in : float
        Simulated before t = 0 and thrown away, s.
    base_seed : int
        Seed of the whole study; see `loadflow.wind.case_seed`.
    rung : {"tables", "bem", "flap"}
        Rigid blades with the induction from a table; rigid blades with the induction solved at
        every section and step; blades with two flap and one edge mode, induction from the table.
    options : RotorOptions, optional
        Effects and imbalance.
    wind_options : WindOptions, optional
        Grid and scaling of the turbulence.
    field : Field, optional
        Wind of the user's own instead of ``dlc``, `category` and `seed`; from −run_in on.

    Returns
    -------
    xarray.Dataset
        Over ``time``: ``speed`` (rad/s), ``pitch``, ``azimuth`` (rad, blade 1, 0 up, clockwise seen
        from upwind), ``hub_force`` (axis, time; N) and ``hub_moment`` (axis, time; N m): what the
        rotor applies to the shaft at its apex, weight included, in the shaft frame that does not
        rotate (x along the shaft downwind, z up, y left looking downwind); ``wind`` (axis, time;
        m/s, ground frame) at the hub, ``generator_torque`` (N m), ``tip_deflection`` (m).

    Raises
    ------
    InputError
        Unknown turbine, load case or rung; a wind speed outside cut-in … cut-out; bad times.
    SolverError
        If the model breaks down.
    """
    from .inflow import steady_inflow
    from .loop import run
    from .rungs import prepare
    from .steady import operating_point

    machine = load_turbine(turbine)
    if not machine.cut_in <= wind_speed <= machine.cut_out:
        raise InputError(
            f"wind_speed = {wind_speed} m/s is not allowed; {machine.name} runs from "
            f"{machine.cut_in} to {machine.cut_out} m/s"
        )
    if not 0.005 <= dt <= 0.1:
        raise InputError(f"dt = {dt} s is not allowed; it must be within 0.005 … 0.1 s")
    if not (duration >= dt and run_in >= 0):
        raise InputError(f"duration = {duration} s, run_in = {run_in} s: > 0 and >= 0 are needed")
    m, c = prepare(machine, rung, options or RotorOptions())
    lead = run_in + _MARGIN
    if field is None:
        length = lead + duration + _MARGIN
        field = _turbulence(
            machine, dlc, wind_speed, seed, category, wind_class, shear, length, base_seed,
            wind_options or WindOptions(shear_exponent=shear),
        )  # fmt: skip
        start = _MARGIN
    else:
        start = 0.0
    state = operating_point(m, c, wind_speed, shear)[1].copy()
    lost, kept = round(run_in / dt), round(duration / dt)
    inflow = steady_inflow(wind_speed, lost + kept, shear, yaw_error, field)
    out = run(m, c, inflow, state, dt, steps=lost + kept, start=start)[lost:]
    data = _dataset(out, dt)
    data.attrs = {
        "turbine": machine.name,
        "dlc": dlc,
        "wind_speed": wind_speed,
        "seed": seed,
        "category": category,
        "rung": rung,
        "shear": shear,
    }
    return data


def _turbulence(
    turbine: Turbine,
    dlc: str,
    wind_speed: float,
    seed: int,
    category: str,
    wind_class: str,
    shear: float,
    length: float,
    base_seed: int,
    options: WindOptions,
) -> Field:
    from loadflow.wind import case_seed, iec, kaimal, polar_angles

    if dlc not in SUPPORTED:
        raise InputError(f"dlc = {dlc!r} is not supported; supported are {', '.join(SUPPORTED)}")
    sigma = (
        iec.etm_sigma(wind_speed, wind_class, category)
        if dlc == "1.3"
        else iec.ntm_sigma(wind_speed, category)
    )
    return kaimal(
        wind_speed,
        float(sigma),
        radius=np.linspace(0.0, turbine.rotor.radius, options.radii),
        angles=polar_angles(options.angles),
        duration=length,
        dt=options.step,
        seed=case_seed(dlc, wind_speed, seed, base_seed),
        hub_height=turbine.rotor.hub_height,
        shear_exponent=shear,
        scaling=options.scaling,
        lateral=options.lateral,
    )


def _dataset(out: np.ndarray, dt: float) -> xr.Dataset:
    import xarray as xr

    from . import _kernels as k

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
            "wind": vector([k.WIND_X, k.WIND_Y, k.WIND_Z], "m/s", "wind at the hub"),
            "generator_torque": scalar(k.TORQUE, "N m", "generator torque"),
            "tip_deflection": scalar(k.TIP, "m", "deflection of the outermost section of blade 1"),
        },
        coords={
            "time": ("time", time, {"units": "s", "long_name": "time"}),
            "axis": ["x", "y", "z"],
        },
    )
