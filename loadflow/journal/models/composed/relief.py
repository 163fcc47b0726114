"""Relief of the bore of a reduced film with effects: what widens it toward its ends, contours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.layout import Bore, angles_between
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.composed.film import Places
from loadflow.journal.models.composed.uneven import Uneven
from loadflow.journal.models.ring import Ring
from loadflow.numerics.lanes import aligned, lanes_for

Array = NDArray[np.float64]

_ON_A_CROWN = 3  # points that either end of a relief asks for: two leave its side flow 8 % off
_WIDENED = 0.01  # of the largest depth
_BETWEEN = 129  # places across at which the narrowest gap of a relief is sought


def depth_at(bearing: JournalGeometry, z: Array) -> Array:
    """What relief that is alike all around widens the bore at `z`, shaft radii, in clearances."""
    return _added(bearing, np.zeros(1), z, even=True)[0]


def contoured(bearing: JournalGeometry) -> bool:
    """Whether relief of the bore changes around."""
    return not all(part.even_around for part in bearing.relief)


def places_of(bearing: JournalGeometry, points: Array, half: float, whole: bool) -> Places:
    """Points across a width of twice `half`, and those between at which a relief is narrowest."""
    if not bearing.relief:
        return Places(points, np.zeros(points.size))
    z = np.append(points, np.linspace(-half if whole else 0.0, half, _BETWEEN))
    return Places(z, depth_at(bearing, z))


def resolves_relief(bearing: JournalGeometry, points: Array) -> bool:
    """Whether enough of the points across lie where a relief widens the bore."""
    depth = np.abs(depth_at(bearing, points))
    widened = (points > 0.0) & (depth > _WIDENED * depth.max())
    return not depth.any() or int(widened.sum()) > _ON_A_CROWN


def with_contours(
    uneven: Uneven, bearing: JournalGeometry, ring: Ring, points: Array, beside: Array
) -> Uneven:
    """Let the gap be wider by what changes around, at `points` and places `beside` them."""
    angle, face = np.arctan2(ring.sin, ring.cos), np.arctan2(ring.sin_face, ring.cos_face)
    wider = aligned(np.zeros((2, angle.size, lanes_for(points.size))))
    wider[0, :, : points.size] = _added(bearing, angle, points, even=False)
    wider[1, :, : points.size] = _added(bearing, face, points, even=False)
    there = np.ascontiguousarray(_added(bearing, angle, beside, even=False))
    if uneven.grows:
        wider[0] += uneven.wider
        wider[1] += uneven.wider_faces
        there += uneven.beside
    return uneven._replace(grows=True, wider=wider[0], wider_faces=wider[1], beside=there)


def least_gap(bearing: JournalGeometry, centres: Array, places: Places) -> Array:
    """Narrowest gap (n,) of a contoured bore around shafts of `centres` (n, f, 2) at `places`."""
    bore, parts = Bore.of(bearing), bearing.shape.segments
    around = tuple(part for part in bearing.relief if not part.even_around)
    bore = replace(bore, relief=around)  # the places know the rest, and growth by heat
    spans = [(part.start, part.end) for part in parts] or [(0.0, 2.0 * np.pi)]
    least = np.full(len(centres), np.inf)
    for number, (start, end) in enumerate(spans):
        angle = angles_between(start, end)
        gap = bore.gap(angle, np.full(angle.size, number), places.z) + places.depth
        facing = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        closer = np.einsum("ac,nfc->naf", facing, centres)
        least = np.minimum(least, (gap - closer).min(axis=(1, 2)))
    return least


def _added(bearing: JournalGeometry, angle: Array, z: Array, *, even: bool) -> Array:
    """Growth of the gap (n, l), clearances, by relief that is alike all around, or by the other."""
    total = np.zeros((angle.size, z.size))
    for part in bearing.relief:
        if part.even_around == even:
            total += part.added(angle, z * bearing.radius, bearing.width) / bearing.clearance
    return total
