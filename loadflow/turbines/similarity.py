"""Turbines of another size by the laws of similarity ([Jonuschies 2015], (1.6)–(1.9)).

With lengths times φ, the same wind, the same tip-speed ratio and the same materials: areas and
power grow with φ² (1.6), masses and weight with φ³ (1.7) (printed with ¾ π R³ for 4/3 π R³; the
ratio is right), so that weight goes with P^(3/2); speeds fall and times grow with φ. Real turbines
are built lighter than that, and gravity, whose moments grow with φ⁴, does not follow: what comes
out is a first guess of size.
"""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np

from loadflow.errors import InputError
from loadflow.turbines.schema import Turbine

Part = TypeVar("Part")

EXPONENTS: dict[str, dict[str, int]] = {
    "Turbine": {"rated_power": 2, "rated_wind_speed": 0, "cut_in": 0, "cut_out": 0},
    "RotorGeometry": {
        "radius": 1, "hub_radius": 1, "blades": 0, "hub_height": 1, "overhang": 1, "tilt": 0,
        "cone": 0, "hub_mass": 3, "hub_inertia": 5,
    },
    "Drivetrain": {
        "gear_ratio": 0, "generator_inertia": 5, "brake_torque": 3, "brake_time": 1,
        "torsional_stiffness": 3, "torsional_damping": 4, "efficiency": 0, "hub_to_bearing": 1,
        "bearing_span": 1,
    },
    "Control": {
        "region_2_gain": 5, "region_15_start": -1, "region_2_start": -1, "rated_speed": -1,
        "slip": 0, "rated_mechanical_power": 2, "maximum_torque": 3, "maximum_torque_rate": 2,
        "speed_filter": -1, "proportional_gain": 1, "integral_gain": 0, "gain_halving_pitch": 0,
        "reference_speed": -1, "pitch_rate": -1, "minimum_pitch": 0, "maximum_pitch": 0,
        "scheduled_wind": 0, "scheduled_pitch": 0, "schedule_filter": -1, "constant_power": 0,
        "individual_gain": -4, "individual_limit": 0, "optimal_tip_speed_ratio": 0,
        "pitch_frequency": -1, "pitch_damping": 0, "thrust_limit": 0,
    },
    "Supervision": {
        "idling_pitch": 0, "stopped_pitch": 0, "start_rate": -1, "stop_rate": -1, "overspeed": 0,
        "fault_delay": 1, "brake_speed": -1,
    },
    "Blade": {
        "radius": 1, "twist": 0, "chord": 1, "mass": 3, "damping": 0, "span": 1,
        "structural_twist": 0, "mass_density": 2, "flap_stiffness": 4, "edge_stiffness": 4,
        "prebend": 1, "torsion_span": 1, "torsion_stiffness": 4, "centre_ahead": 1,
    },
    "Tower": {"base_diameter": 1, "top_diameter": 1, "height": 1},
    "TowerBending": {
        "nacelle_mass": 3, "nacelle_downwind": 1, "nacelle_above": 1, "damping": 0, "height": 1,
        "mass_density": 2, "fore_aft_stiffness": 4, "side_side_stiffness": 4, "fore_aft": 0,
        "side_side": 0,
    },
}  # fmt: skip
"""Power of φ with which each number of a turbine grows, by its class."""


def scaled(turbine: Turbine, factor: float) -> Turbine:
    """The turbine with all lengths times a factor, by similarity.

    Parameters
    ----------
    turbine : Turbine
        Of known size.
    factor : float
        φ = R/R₀, > 0.

    Returns
    -------
    Turbine
        Its control is scaled like everything else that lasts a time; the gear ratio stays.

    Raises
    ------
    InputError
        A factor that is not positive and finite.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine, scaled
    >>> larger = scaled(load_turbine("nrel-5mw"), 2.0**0.5)
    >>> round(larger.rated_power / 1e6), round(larger.rotor.radius, 1)
    (10, 89.1)
    """
    check_positive("factor", factor)
    parts = {
        name: _part(getattr(turbine, name), factor)
        for name in ("rotor", "tower", "drivetrain", "control", "blade", "supervision")
    }
    numbers = {
        name: getattr(turbine, name) * factor**power for name, power in EXPONENTS["Turbine"].items()
    }
    frequencies = {name: value / factor for name, value in turbine.frequencies.items()}
    size = f"{numbers['rated_power'] / 1e6:.4g} MW"
    return replace(
        turbine,
        **parts,
        **numbers,
        frequencies=frequencies,
        name=f"{turbine.name}, scaled to {size}",
        source=f"{turbine.source}; all lengths × {factor:.4g} by similarity",
    )


def factor_of_power(power: float, known: float) -> float:
    """φ of a turbine of another power, √(P/P₀), (1.6).

    Raises
    ------
    InputError
        A power that is not positive and finite.

    Examples
    --------
    >>> from loadflow.turbines.similarity import factor_of_power
    >>> factor_of_power(20e6, 5e6)
    2.0
    """
    check_positive("power", power, " W")
    return math.sqrt(power / known)


def check_positive(name: str, value: float, unit: str = "") -> None:
    """Raise unless a number is positive and finite."""
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{name} = {value}{unit}: must be > 0")


def _part(part: Part, factor: float) -> Part:
    """A part with its numbers and parts scaled."""
    if part is None or not is_dataclass(part):
        return part
    powers = EXPONENTS[type(part).__name__]
    changed: dict[str, Any] = {}
    for field in fields(part):
        value = getattr(part, field.name)
        if field.name in powers:
            grown = factor ** powers[field.name]
            changed[field.name] = _times(value, grown)
        elif is_dataclass(value):
            changed[field.name] = _part(value, factor)
    return replace(part, **changed)  # type: ignore[type-var]


def _times(value: Any, grown: float) -> Any:
    if isinstance(value, tuple):
        return tuple(grown * x for x in value)
    if isinstance(value, np.ndarray):
        return grown * value
    return value if value is None or grown == 1.0 else grown * value
