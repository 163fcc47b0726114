"""A shaft on bearings with models of their own, beside closed forms.

A rigid shaft on two bearings a span L apart: the first yields by F/k, the second takes a moment and
turns by (M/K)^(2/3), as Hertzian contacts do. With a force P at a distance a before the first,
F = (P (a + L) − M)/L, and both agree where F/k = L (M/K)^(2/3). So to each M belongs one P.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from loadflow.shaft import Beam, BearingSupport, ShaftSection, TwoPoint, bearing_loads
from loadflow.shaft.elastic import BearingModel, Floats

from .check import Check, evidence

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
    seat = BearingSupport(radial=3e9, takes_moment=True, tilt=2e8, housing_vertical=4e9)
    numbers = _taken(1e6, 2.1e11, BearingSupport(_SOFT), seat, None)
    own = _taken(1e6, 2.1e11, BearingSupport(_SOFT), seat, _constant)
    name = "moment on a bearing of constant stiffness, iterated"
    source = "the same numbers as a support"
    yield Check(name, source, numbers, own, 1e-10, unit="N m", evidence="consistency")


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
