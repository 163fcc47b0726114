"""A shaft on bearings with models of their own, beside closed forms.

A rigid shaft on two bearings a span L apart: the first yields by F/k, the second takes a moment and
turns by (M/K)^(2/3), as Hertzian contacts do. With a force P at a distance a before the first,
F = (P (a + L) − M)/L, and both agree where F/k = L (M/K)^(2/3). So to each M belongs one P.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from loadflow.shaft import (
    Beam,
    BearingSupport,
    DirectDrive,
    ShaftSection,
    TwoPoint,
    bearing_loads,
)
from loadflow.shaft.elastic import BearingModel, Floats
from loadflow.shaft.reactions import GRAVITY

from .check import Check, evidence


class Drive(NamedTuple):
    """Masses (kg), tilt (°), distances (m) of [Jamal and Clark 2020]; F_r2 in kN by `_MOMENTS`.

    Arms from the first bearing: of rotor and generator upwind, of the shaft downwind.
    """

    name: str
    rotor: float
    shaft: float
    generator: float
    tilt: float
    span: float
    generator_arm: float
    shaft_arm: float
    rotor_arm: float
    reactions: tuple[float, ...]


_MOMENTS = ((0.0, 0.0), (8e6, 0.0), (-5e6, 4e6))  # nodding and yaw moment at the hub, N m
DRIVES = (
    Drive("IEA 10 MW", 224.807e3, 78.894e3, 357.3e3, 5.0, 4.62, -0.78, 1.25, 3.618,
          (922.0394, 809.5623, 2183.298)),
    Drive("IEA 15 MW", 385e3, 15.734e3, 371.592e3, 6.0, 1.2, 0.9, 0.25, 3.638,
          (14069.65, 7402.983, 18538.46)),
)  # fmt: skip
_OVERHANG, _SPAN = 2.0, 3.0
_SOFT, _TOUGH = 2e9, 1e10
_STIFF = 1e20


@evidence("closed form")
def checks() -> Iterator[Check]:
    """Yield moments that a hardening bearing takes, and loads of one of constant stiffness."""
    for moment in (1e4, 1e5, 1e6):
        turned = (moment / _TOUGH) ** (2 / 3)
        push = (_SPAN**2 * _SOFT * turned + moment) / (_OVERHANG + _SPAN)
        found = _taken(push, 1e20, BearingSupport(_SOFT), BearingSupport(takes_moment=True), _hertz)
        name = f"moment on a bearing that hardens, P = {push:.4g} N"
        yield Check(name, "closed form", moment, found, 1e-8, unit="N m")
    support = BearingSupport(radial=3e9, takes_moment=True, tilt=2e8, housing_vertical=4e9)
    yield from _two_supports()
    numbers = _taken(1e6, 2.1e11, BearingSupport(_SOFT), support, None)
    own = _taken(1e6, 2.1e11, BearingSupport(_SOFT), support, _constant)
    name = "moment on a bearing of constant stiffness, iterated"
    source = "the same numbers as a support"
    yield Check(name, source, numbers, own, 1e-10, unit="N m", evidence="consistency")


@evidence("closed form")
def _two_supports() -> Iterator[Check]:
    """Reactions of direct drives with the distances and masses of [Jamal and Clark 2020].

    Its F_r2 = √(M1² + M2²)/L12 with M1 = M_y − (m_r L_r + m_g L_g − m_s L_s) g cos ρ, M2 = M_z,
    evaluated by hand; its lives and F_r1 contradict themselves (sums of sizes for vectors).
    """
    for drive in DRIVES:
        concept = DirectDrive(
            hub_to_first=drive.rotor_arm,
            span=drive.span,
            generator_mass=drive.generator,
            hub_to_generator=drive.rotor_arm - drive.generator_arm,
            shaft_mass=drive.shaft,
            hub_to_shaft_centre=drive.rotor_arm + drive.shaft_arm,
        )
        tilt = np.radians(drive.tilt)
        weight = drive.rotor * GRAVITY
        force = weight * np.array([np.sin(tilt), 0.0, -np.cos(tilt)])
        for (nod, yaw), expected in zip(_MOMENTS, drive.reactions, strict=True):
            loads = bearing_loads(concept, force, [0.0, nod, yaw], tilt=tilt)
            found = loads["force"].sel(bearing="N2").isel(time=0).values
            name = f"F_r2, {drive.name}, M = ({nod / 1e6:g}, {yaw / 1e6:g}) MN m"
            got = float(np.hypot(*found[1:])) / 1e3
            yield Check(name, "Jamal & Clark 2020", expected, got, 1e-6, unit="kN")


def _taken(
    push: float,
    youngs_modulus: float,
    first: BearingSupport,
    second: BearingSupport,
    model: BearingModel | None,
) -> float:
    """Moment on the second bearing."""
    beam = Beam((ShaftSection(1.0, 0.4),), (first, second), youngs_modulus)
    concept = TwoPoint(hub_to_first=_OVERHANG, span=_SPAN, gearbox_mass=0.0, beam=beam)
    models = {} if model is None else {"N2": model}
    found = bearing_loads(concept, [0.0, push, 0.0], [0.0, 0.0, 0.0], models=models)
    return abs(float(found["moment"].sel(bearing="N2", axis="z").item()))


def _hertz(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
    size = np.maximum(np.hypot(*moment[:, 1:].T), 1e-6)
    along = moment[:, 1:] / size[:, None]
    turned = (size / _TOUGH) ** (2 / 3)
    line = along[:, :, None] * along[:, None, :]
    stiffness = np.zeros((len(force), 4, 4))
    stiffness[:, :2, :2] = _STIFF * np.eye(2)
    stiffness[:, 2:, 2:] = (size / turned)[:, None, None] * (np.eye(2) + 0.5 * line)
    return np.concatenate([force[:, 1:] / _STIFF, turned[:, None] * along], axis=1), stiffness


def _constant(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
    stiffness = np.diag([3e9, 3e9, 2e8, 2e8])
    motion = np.concatenate([force[:, 1:] / 3e9, moment[:, 1:] / 2e8], axis=1)
    return motion, np.broadcast_to(stiffness, (len(force), 4, 4))
