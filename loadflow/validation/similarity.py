"""Turbines of another size beside the laws of similarity, (1.6)–(1.9) of [Jonuschies 2015].

The laws are for lengths alone; the rows let the scaled turbine find its own steady state, with its
scaled control, polars and wind as they were: power must grow with φ², torque with φ³, speed fall
with φ. Weight is that of the scaled masses. [Hart et al. 2022] find for similar turbines of 5, 7.5
and 10 MW that mean and fluctuating loads of main bearings grow at least with φ³, a bound that no
row is held to. Here the weights do, and the moments of the wind; its forces grow with φ².
"""

from __future__ import annotations

from collections.abc import Iterator

from loadflow.rotor import steady_state
from loadflow.turbines import load_turbine

from .check import Check, Evidence, evidence

_BASE, _FACTOR = "nrel-5mw", 2.0


@evidence("closed form")
def checks() -> Iterator[Check]:
    """Yield ratios of a turbine of twice the size to the known one."""
    small = load_turbine(_BASE)
    name = f"{_BASE}@{small.rated_power * _FACTOR**2:g}"
    large, source = load_turbine(name), "(1.6)–(1.9), ch. 1"
    area = (large.rotor.radius / small.rotor.radius) ** 2
    # by these two the turbine is scaled
    ours: Evidence = "consistency"
    yield Check("swept area, four times the power", source, 4.0, area, 1e-12, evidence=ours)
    weight = large.rotor_mass / small.rotor_mass
    yield Check("rotor weight, P^(3/2)", source, 4.0**1.5, weight, 1e-12, evidence=ours)
    for wind in (8.0, 14.0):
        scaled, known = (steady_state(t, wind_speed=wind, rung="tables") for t in (name, _BASE))
        for quantity, power in (("speed", -1), ("power", 2), ("torque", 3)):
            ratio = float(scaled[quantity][0] / known[quantity][0])
            label = f"{quantity} in {wind:g} m/s, twice the radius"
            yield Check(label, source, _FACTOR**power, ratio, 1e-3)
        # about the vertical axis, where weight has no part
        ratio = float(scaled["hub_moment"][0, 2] / known["hub_moment"][0, 2])
        label = f"yaw moment in {wind:g} m/s with shear, twice the radius"
        yield Check(label, f"{source}, a moment of the wind as the torque", _FACTOR**3, ratio, 0.03)
