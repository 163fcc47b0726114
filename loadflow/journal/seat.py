"""Seats on which bearings align themselves: what holds them back as the shaft tilts.

A shell that follows the shaft is turned by its own film. A spherical seat sticks until the film
brings the moment of its friction, an elastic one resists all the way; what the seat takes stays in
the film as misalignment.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from annotated_types import Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.numerics.fields import check_fields

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SphericalSeat:
    """Sphere around a shell, or under the carrier of the pads, that slides in its housing.

    It slips at the moment μ F R. That is the friction of a pressure that falls with the cosine from
    the load over half a sphere, as it spins about the load; about an axis across the load this has
    4/π of it, and one that is concentrated under the load just μ F R.

    Attributes
    ----------
    friction : float
        Coefficient of friction μ of the seat.
    radius : float
        Radius R of the sphere, m.

    Raises
    ------
    loadflow.errors.InputError
        A value out of its range.

    Examples
    --------
    >>> SphericalSeat(friction=0.1, radius=2.0).largest_moment(1e6, [1e-5, 1e-3]).tolist()
    [200000.0, 200000.0]
    """

    friction: Annotated[float, Gt(0), Le(1)]
    radius: Annotated[float, Gt(0)]
    kind: Literal["spherical"] = "spherical"

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def stiffness(self) -> float:
        """Infinite: it turns as it slides alone, N m/rad."""
        return math.inf

    def slips_at(self, load: ArrayLike) -> Array:
        """Moment, N m, at which it slides under loads, N."""
        return np.asarray(self.friction * self.radius * np.abs(np.asarray(load, dtype=float)))

    def largest_moment(self, load: ArrayLike, slope: ArrayLike) -> Array:
        """Moment, N m, that it passes at most, under a load, N, to a shaft of a slope, rad.

        Both of one shape, or one of them a number; the moment has that shape.
        """
        carried, _ = np.broadcast_arrays(self.slips_at(load), slope)
        return np.array(carried)


@dataclass(frozen=True)
class ElasticSeat:
    """Ring of elastic pieces, membrane or joint, on which a shell or carrier turns.

    Attributes
    ----------
    stiffness : float
        Moment over the angle that it is turned by, about any axis across the shaft, N m/rad.

    Raises
    ------
    loadflow.errors.InputError
        A value out of its range.

    Examples
    --------
    >>> ElasticSeat(stiffness=1e8).largest_moment(1e6, [0.0, 1e-3]).tolist()
    [0.0, 100000.0]
    """

    stiffness: Annotated[float, Gt(0)]
    kind: Literal["elastic"] = "elastic"

    def __post_init__(self) -> None:
        check_fields(self)

    def slips_at(self, load: ArrayLike) -> Array:
        """Infinite: it never slides, whatever the loads, N."""
        return np.full(np.shape(load), math.inf)

    def largest_moment(self, load: ArrayLike, slope: ArrayLike) -> Array:
        """Moment, N m, that it passes at most, to a shaft of a slope, rad, that it follows.

        Both of one shape, or one of them a number; the moment has that shape.
        """
        turned, _ = np.broadcast_arrays(np.abs(np.asarray(slope, dtype=float)), load)
        return np.asarray(self.stiffness * turned)


Seat = SphericalSeat | ElasticSeat
SEATS: dict[str, type[Seat]] = {"spherical": SphericalSeat, "elastic": ElasticSeat}
"""Seats by their ``kind``."""
