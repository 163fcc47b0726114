"""Airfoils between two of known thickness."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from loadflow.errors import InputError

from .blade import Airfoil
from .checks import Array


def blended(airfoils: Mapping[str, Airfoil], thickness: float) -> Airfoil:
    """Airfoil of a relative thickness: polars linear between the two neighbours that state theirs.

    Parameters
    ----------
    airfoils : mapping of Airfoil by name
        Those without a thickness take no part; the result states none.
    thickness : float
        Over the chord.

    Raises
    ------
    InputError
        If the thickness lies outside those of the airfoils, or two of them have the same.
    """
    known = sorted(
        (foil for foil in airfoils.values() if foil.thickness is not None), key=_thickness
    )
    limits = np.array([_thickness(foil) for foil in known])
    distinct = limits.size > 1 and bool(np.all(np.diff(limits) > 0))
    if not distinct or not limits[0] <= thickness <= limits[-1]:
        raise InputError(
            f"thickness = {thickness} is not allowed; airfoils are known for {limits.tolist()}"
        )
    upper = max(int(np.searchsorted(limits, thickness)), 1)
    thin, thick = known[upper - 1], known[upper]
    share = (thickness - limits[upper - 1]) / (limits[upper] - limits[upper - 1])
    angle = np.union1d(thin.angle, thick.angle)

    def between(name: str) -> np.ndarray:
        low, high = (_over(angle, foil, name) for foil in (thin, thick))
        return (1 - share) * low + share * high

    known_moment = any(foil.moment.size for foil in (thin, thick))
    moment = between("moment") if known_moment else np.zeros(0)
    return Airfoil(
        f"thickness {thickness:g}", angle, between("lift"), between("drag"), moment=moment
    )


def _over(angle: Array, airfoil: Airfoil, name: str) -> Array:
    """A coefficient at other angles; 0 of one that is not known, as the moment of a cylinder is."""
    values = getattr(airfoil, name)
    return np.interp(angle, airfoil.angle, values) if values.size else np.zeros(angle.size)


def _thickness(airfoil: Airfoil) -> float:
    return -1.0 if airfoil.thickness is None else airfoil.thickness
