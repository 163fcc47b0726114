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
        yield Check(f"natural frequency {k + 1}", "ROSS 2.3", frequency, got[0], 1e-5, unit="rad/s")
        yield Check(f"damping ratio {k + 1}", "ROSS 2.3", ratio, got[1], 1e-5)
    places = [place for place, _ in _UNBALANCE]
    orbit = unbalance_response(line, lambda _: held, [_SPEED], 0.01, places=places)
    for k, (place, size) in enumerate(_UNBALANCE):
        got_there = float(orbit["amplitude"][k, 0])
        yield Check(f"unbalance, {place} m", "ROSS 2.3", size, got_there, 1e-5, unit="m")
    yield from _closed()


@evidence("closed form")
def _closed() -> Iterator[Check]:
    """Slender beam on two pins; one disc between them, its whirl against the rotation and with."""
    modulus, density, length, diameter = 2.1e11, 7850.0, 10.0, 0.05
    section = ShaftSection(diameter)
    beam = Beam((section,), shear=False)
    stiff, heavy = modulus * section.inertia, density * section.area
    pins = [LineSupport(0.0), LineSupport(length)]
    found = modes(ShaftLine(beam, length), pins, 0.0, count=6)
    for k in (1, 2, 3):
        exact = (k * math.pi / length) ** 2 * math.sqrt(stiff / heavy)
        got = float(found["natural_frequency"][2 * k - 2])
        name = f"beam on two pins, mode {k}"
        # rotation of the sections, which the closed form leaves out: (k π d / 8 L)² in share
        yield Check(name, "Euler, Bernoulli", exact, got, 1e-3, unit="rad/s")
    # Jeffcott's rotor: stiffness 48 E I / L³ of the middle, unbalance response U ω²/(k − m ω²)
    mass, unbalance = 100.0, 0.01
    spring = 48 * stiff / length**3
    line = ShaftLine(beam, length, (Disc(length / 2, mass),), density=0.0)
    critical = math.sqrt(spring / mass)
    got = float(modes(line, pins, 0.0, count=1)["natural_frequency"][0])
    yield Check("critical speed", "Jeffcott 1919", critical, got, 1e-9, unit="rad/s")
    for share in (0.5, 2.0):
        speed = share * critical
        exact = unbalance * speed**2 / abs(spring - mass * speed**2)
        out = unbalance_response(line, lambda _: pins, [speed], unbalance, length / 2, [length / 2])
        name = f"unbalance at {share:g} of the critical speed"
        yield Check(name, "Jeffcott 1919", exact, float(out["amplitude"][0, 0]), 1e-8, unit="m")
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
        yield Check(name, "closed form", exact, got, 1e-7, unit="rad/s")
