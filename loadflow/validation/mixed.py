"""Mixed friction, wear and heat of sheared films: coefficients as printed, exact values.

The flow factors are compared with the printed coefficients by formulas that are written out here
anew. Rows whose source begins with "exact" are evaluations of a classical solution.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from loadflow.tribology import (
    AsperityContact,
    ConductingCouette,
    ConformalWear,
    WornArc,
    adiabatic_rise,
    greenwood_tripp,
    patir_cheng,
)
from loadflow.validation.check import Check, evidence

PATIR_CHENG_1978 = "Patir and Cheng 1978"
PATIR_CHENG_1979 = "Patir and Cheng 1979"

# γ; C, r; A1, α1, α2, α3, A2; A3, α4, α5, α6; Φ_s at H = 5
ROWS = (
    ("1/9", 1.48, 0.42, 2.046, 1.12, 0.78, 0.03, 1.856, 14.1, 2.45, 2.30, 0.10, 0.5318),
    ("1/6", 1.38, 0.42, 1.962, 1.08, 0.77, 0.03, 1.754, 13.4, 2.42, 2.30, 0.10, 0.5027),
    ("1/3", 1.18, 0.42, 1.858, 1.01, 0.76, 0.03, 1.561, 12.3, 2.32, 2.30, 0.10, 0.4471),
    ("1", 0.900, 0.56, 1.899, 0.98, 0.92, 0.05, 1.126, 11.1, 2.31, 2.38, 0.11, 0.3226),
    ("3", 0.225, 1.5, 1.560, 0.85, 1.13, 0.08, 0.556, 9.8, 2.25, 2.80, 0.18, 0.1592),
    ("6", 0.520, 1.5, 1.290, 0.62, 1.09, 0.08, 0.388, 10.1, 2.25, 2.90, 0.18, 0.1111),
    ("9", 0.870, 1.5, 1.011, 0.54, 1.07, 0.08, 0.295, 8.7, 2.15, 2.97, 0.18, 0.0846),
)


@evidence("closed form")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _flow_factors()
    yield from _friction_factors()
    yield from _asperities()
    yield from _wear()
    yield from _sheared_films()


@evidence("print of the source")
def _flow_factors() -> Iterator[Check]:
    """Fits of the source by its printed coefficients, and their value at H = 5 to four digits."""
    for name, c, r, a1, b1, b2, b3, a2, *_, middle in ROWS:
        gamma = float(Fraction(name))
        h = 2.0
        found, far = patir_cheng(h, gamma), patir_cheng(6.0, gamma)
        pressure = 1 - c * math.exp(-r * h) if gamma <= 1 else 1 + c * h**-r
        across = float(patir_cheng(h, 1 / gamma).pressure_z)
        shear = a1 * h**b1 * math.exp(-b2 * h + b3 * h * h)
        for what, expected, got in (
            (f"φ_x(2), γ = {name}", pressure, found.pressure_x),
            (f"φ_z(2), γ = 1/({name})", pressure, across),
            (f"Φ_s(2), γ = {name}", shear, found.shear),
            (f"Φ_s(6), γ = {name}", a2 * math.exp(-1.5), far.shear),
        ):
            yield Check(what, PATIR_CHENG_1978, expected, float(got), 1e-12)
        for side, at in (("below", 5.0), ("above", 5.0 + 1e-12)):
            got = float(patir_cheng(at, gamma).shear)
            what = f"Φ_s just {side} H = 5, γ = {name}"
            yield Check(what, PATIR_CHENG_1978, middle, got, 2e-4, "absolute")


def _friction_factors() -> Iterator[Check]:
    values = {0.5: 0.907002, 1.0: 1.636589, 3.0: 1.166667, 6.0: 1.029878, 10.0: 1.010254}
    for h, expected in values.items():
        got = float(patir_cheng(h).friction)
        source = f"{PATIR_CHENG_1979}, cut-off σ/100"
        yield Check(f"φ_f({h:g})", source, expected, got, 5e-7, "absolute")
    above = float(patir_cheng(3.0 + 1e-12).friction)
    yield Check("φ_f just above 3", PATIR_CHENG_1979, 1.166667, above, 5e-7, "absolute")
    for name, *_, a3, b4, b5, b6, _middle in ROWS:
        gamma = float(Fraction(name))
        expected = a3 * 2**b4 * math.exp(-2 * b5 + 4 * b6)
        got = float(patir_cheng(2.0, gamma).friction_shear)
        what = f"Φ_fs(2), γ = {name}"
        yield Check(what, PATIR_CHENG_1979, expected, got, 1e-12, evidence="print of the source")
    expected, got = 1 - 1.40 * math.exp(-1.32), float(patir_cheng(2.0).friction_pressure)
    what = "φ_fp(2), γ = 1"
    yield Check(what, PATIR_CHENG_1979, expected, got, 1e-12, evidence="print of the source")


@evidence("consistency")
def _asperities() -> Iterator[Check]:
    contact = AsperityContact(roughness=1.0e-6, contact_modulus=1.0, factor=1.0, crowding=1.0)
    for u in (-1.0, 0.0, 1.0, 2.0, 3.0, 4.0):
        exact = float(greenwood_tripp(2.5, u))
        got = float(contact.pressure(u * 1e-6))
        source = "parabolic cylinder function, table friction"
        yield Check(f"compiled F_5/2({u:g})", source, exact, got, 1e-8)
        area = float(greenwood_tripp(2.0, u)) * math.pi**2
        got = float(contact.area(u * 1e-6))
        yield Check(f"π² F_2({u:g}), compiled", source, area, got, 1e-8)


def _wear() -> Iterator[Check]:
    case = ConformalWear(force=1e5, radius=0.2, width=0.25, coefficient=1e-16, distance=1e3)
    source = "exact, Archard's law in a bore without clearance"
    yield Check("p₀", source, 1.27324, case.largest_pressure / 1e6, 5e-6, unit="MPa")
    yield Check("δ", source, 0.127324, case.largest_depth * 1e6, 5e-6, unit="μm")
    yield Check("V", source, 12.7324, case.volume * 1e9, 5e-6, unit="mm³")
    arc = WornArc(largest_depth=0.4e-4, clearance=1e-4)
    edge = math.cos(math.pi - arc.half_angle)
    source = "Dufrane et al. 1983, Hashimoto et al. 1986"
    yield Check("cos φ_s of the worn arc, d₀/c = 0.4", source, 0.4 - 1, edge, 1e-12)


def _sheared_films() -> Iterator[Check]:
    oil = {"viscosity": 0.0277, "speed": 10.471976, "gap": 1e-4, "heat_capacity": 860 * 1951.8}
    source = "exact, adiabatic Couette film"
    for name, expected, steepness in (("ΔT", 3.267283, 0.0341), ("ΔT, constant η", 3.456246, 0.0)):
        got = float(adiabatic_rise(0.1, steepness=steepness, **oil))
        yield Check(name, source, expected, got, 5e-7, "absolute", "K")
    table = (
        (0.1, 0.012423, 0.991749, 0.048790, 0.967945),
        (1.0, 0.117783, 0.924196, 0.405465, 0.760346),
        (10.0, 0.810930, 0.573879, 1.791759, 0.281983),
    )
    source = "exact, Nahme 1940, Gavis and Laurence 1968"
    for nahme, middle, stress, wall, insulated in table:
        for where, film, rise, ratio in (
            ("", ConductingCouette(nahme), middle, stress),
            (", insulated wall", ConductingCouette(nahme, insulated=True), wall, insulated),
        ):
            name = f"Na = {nahme:g}{where}"
            yield Check(f"β ΔT, {name}", source, rise, film.largest_rise, 6e-7, "absolute")
            yield Check(f"τ h/(η₀ U), {name}", source, ratio, film.stress_ratio, 6e-7, "absolute")
