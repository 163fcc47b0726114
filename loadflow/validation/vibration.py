"""A shaft line on bearings with stiffness and damping, beside ROSS and closed forms.

ROSS 2.3 (Timbó et al. 2020) with 20 of its elements with two nodes: 1 m of 200/50 mm and 1 m of
160 mm, steel, overhung discs of 400 kg and 200 kg, the same full matrices at 0.4 and 1.8 m.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from loadflow.shaft import (
    Beam,
    Disc,
    LineSupport,
    ShaftLine,
    ShaftSection,
    modes,
    unbalance_response,
)

from .check import Check, evidence

_SPEED = 150.0
_STIFFNESS = ((1.2e8, 3.3e8), (-2.1e8, 1.7e8))
_DAMPING = ((6.3e6, 2.2e6), (1.6e6, 4.6e6))
_ROSS = (
    (59.478807, 0.513433227),
    (59.7572453, 0.507844704),
    (368.812496, 0.0177602881),
    (453.971494, 0.0238644943),
    (1042.70086, 0.0212884536),
    (1087.24782, 0.0330888366),
)
"""Natural frequency, rad/s, and damping ratio; without its torsion at 801.5 rad/s."""
_DIGITS = 6e-9
"""Share: the numbers have nine digits, half of the last is worth 5e-9 at most."""
_ROUNDING = 1e-10
"""Share: what is exact for the elements, too, is off by the rounding of an eigenvalue problem."""
_UNBALANCE = ((0.0, 2.44688628e-6), (0.4, 7.89748602e-7), (1.5, 7.38977018e-7))
"""Place, m, and half axis of the orbit, m, under 0.01 kg m at the first disc."""


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield frequencies, damping and unbalance of ROSS, and closed forms."""
    line = ShaftLine(
        Beam((ShaftSection(0.2, 0.05, 1.0), ShaftSection(0.16))),
        2.0,
        (Disc(0.0, 400.0, 60.0, 35.0), Disc(1.5, 200.0, 10.0, 6.0)),
        elements=20,
    )
    held = [LineSupport(place, _STIFFNESS, _DAMPING) for place in (0.4, 1.8)]
    found = modes(line, held, _SPEED, count=len(_ROSS))
    for k, (frequency, ratio) in enumerate(_ROSS):
        got = float(found["natural_frequency"][k]), float(found["damping_ratio"][k])
        yield Check(
            f"natural frequency {k + 1}", "ROSS 2.3", frequency, got[0], _DIGITS, unit="rad/s"
        )
        yield Check(f"damping ratio {k + 1}", "ROSS 2.3", ratio, got[1], _DIGITS)
    places = [place for place, _ in _UNBALANCE]
    orbit = unbalance_response(line, lambda _: held, [_SPEED], 0.01, places=places)
    for k, (place, size) in enumerate(_UNBALANCE):
        got_there = float(orbit["amplitude"][k, 0])
        yield Check(f"unbalance, {place} m", "ROSS 2.3", size, got_there, _DIGITS, unit="m")
    yield from _closed()


@evidence("closed form")
def _closed() -> Iterator[Check]:
    """Slender beam on two pins; one disc between them, its whirl against the rotation and with."""
    modulus, density, length, diameter = 2.1e11, 7850.0, 10.0, 0.05
    beam = Beam((ShaftSection(diameter),), shear=False)
    area, inertia = math.pi / 4 * diameter**2, math.pi / 64 * diameter**4
    stiff, heavy = modulus * inertia, density * area
    pins = [LineSupport(0.0), LineSupport(length)]
    line = ShaftLine(beam, length)
    found = modes(line, pins, 0.0, count=6)
    for k in (1, 2, 3):
        wave = k * math.pi / length
        turning = 1 + wave**2 * inertia / area
        exact = wave**2 * math.sqrt(stiff / heavy / turning)
        got = float(found["natural_frequency"][2 * k - 2])
        name = f"beam on two pins, mode {k}"
        # elements of cubic deflection raise it by the share (k π/n)⁴/1440
        within = (k * math.pi / line.elements) ** 4 / 1000
        yield Check(name, "Rayleigh's beam, sections rotate", exact, got, within, unit="rad/s")
    # Jeffcott's rotor: stiffness 48 E I / L³ of the middle, unbalance response U ω²/(k − m ω²)
    mass, unbalance = 100.0, 0.01
    spring = 48 * stiff / length**3
    line = ShaftLine(beam, length, (Disc(length / 2, mass),), density=0.0)
    critical = math.sqrt(spring / mass)
    got = float(modes(line, pins, 0.0, count=1)["natural_frequency"][0])
    yield Check("critical speed", "Jeffcott 1919", critical, got, _ROUNDING, unit="rad/s")
    for share in (0.5, 2.0):
        speed = share * critical
        exact = unbalance * speed**2 / abs(spring - mass * speed**2)
        out = unbalance_response(line, lambda _: pins, [speed], unbalance, length / 2, [length / 2])
        name = f"unbalance at {share:g} of the critical speed"
        yield Check(
            name, "Jeffcott 1919", exact, float(out["amplitude"][0, 0]), _ROUNDING, unit="m"
        )
    # a disc in the middle tilts without moving: I ω² − Ip Ω ω = 12 E I/L
    polar, across, speed = 8.0, 4.0, 30.0
    line = ShaftLine(beam, length, (Disc(length / 2, mass, polar, across),), density=0.0)
    turns = modes(line, pins, speed, count=4)
    twist = 12 * stiff / length
    for sign, word in ((1, "with"), (-1, "against")):
        half = sign * polar * speed / 2
        exact = (half + math.sqrt(half**2 + across * twist)) / across
        gap = abs(turns["natural_frequency"].values - exact)
        got = float(turns["natural_frequency"][int(gap.argmin())])
        name = f"gyroscopic disc, {word} the rotation"
        yield Check(name, "closed form", exact, got, _ROUNDING, unit="rad/s")
