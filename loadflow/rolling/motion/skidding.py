"""Skidding of the rollers of a main bearing over a load series, and the friction it adds.

In a row that an axial load unloads, only the weight of the rollers presses them on a raceway:
they turn slower than in ideal rolling, and are accelerated abruptly where they enter the load zone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.numerics.fields import check_one_of, require
from loadflow.rolling.friction.bearing import BearingFriction
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.friction.roller_drag import DragConstants
from loadflow.rolling.friction.roller_losses import roller_friction
from loadflow.rolling.motion.history import GRAVITY, bearing_histories
from loadflow.rolling.motion.rollers import RollerMotion, coulomb_motion, film_motion
from loadflow.rolling.results import ContactResult
from loadflow.rolling.roller_raceways import RollerRaceways

Array = NDArray[np.float64]


class ZoneEntries(NamedTuple):
    """Entries of rollers into the load zone: arrays over the entries.

    `row` and `roller`; `time` (s); `slip_speed` just before (m/s); `energy` lost in slip until it
    is loaded (J); `power_density` of slip, the largest in that time (W/m²).
    """

    row: NDArray[np.intp]
    roller: NDArray[np.intp]
    time: Array
    slip_speed: Array
    energy: Array
    power_density: Array


@dataclass(frozen=True)
class BearingSlip:
    """Motion of all rollers of a bearing over a series, and its friction.

    Attributes
    ----------
    motions : tuple of RollerMotion
        Of each row, the rollers that were followed.
    friction : BearingFriction
        Losses in ideal rolling, and ``"slip"`` beside them.
    """

    motions: tuple[RollerMotion, ...]
    friction: BearingFriction

    @property
    def slip(self) -> Array:
        """Share of the ideal spin that is missing, (n, row, followed roller)."""
        return np.stack([m.slip for m in self.motions], axis=1)

    @property
    def slip_power_density(self) -> Array:
        """Largest power of slip over the area of a contact since the last sample, W/m²."""
        return np.stack([m.slip_power_density for m in self.motions], axis=1)

    def entries(self, least: float = 1.0) -> ZoneEntries:
        """Entries into the load zone: the load of a roller rises through `least` (N).

        The first turn of the cage is left out.
        """
        found = [_entries(i, motion, least) for i, motion in enumerate(self.motions)]
        return ZoneEntries(*(np.concatenate(parts) for parts in zip(*found)))


def roller_slip(
    result: ContactResult[RollerRaceways],
    time: ArrayLike,
    speed: ArrayLike,
    options: FrictionOptions,
    *,
    model: Literal["film", "coulomb"] = "film",
    sliding: float = 0.04,
    tolerance: float = 3e-4,
    every: int = 1,
    down: float = -math.pi / 2,
    gravity: float = GRAVITY,
) -> BearingSlip:
    """Slip of every roller of a bearing over a load series.

    Rollers start in ideal rolling; look at what follows the first turn of the cage.

    Parameters
    ----------
    result : ContactResult
        Load distribution over the series, cases (n,).
    time : array_like, shape (n,)
        s.
    speed : array_like, shape (n,) or ()
        Of the inner ring, rad/s; the outer ring is at rest.
    options : FrictionOptions
        Lubricant, surfaces, drag.
    model : {"film", "coulomb"}
        `film_motion`, or `coulomb_motion` with the boundary friction and a braking cage.
    sliding : float
        μ' of the cage's pockets.
    tolerance : float
        See `film_motion`.
    every : int
        1 follows every roller, 4 every fourth one, which stands for its neighbours as well: means
        over a series hardly change, as all rollers go through the same places (docs/friction.md).
    down, gravity : float
        Direction of gravity, angle from x toward y, rad, and its size, m/s².

    Returns
    -------
    BearingSlip
        Motion of the rollers, and friction with what slip adds.

    Raises
    ------
    InputError
        If the times do not fit, the model is unknown, or there are fewer than `every` rollers.
    SolverError
        If a step does not converge.

    Examples
    --------
    A tapered pair under thrust, of which the second row carries nothing:

    >>> import numpy as np
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.tribology import lubricant
    >>> pair = RollerBearing(rollers=48, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.8, contact_angle=0.35, rows=2, row_spacing=0.12, clearance=50e-6)
    >>> time = np.linspace(0, 10, 201)
    >>> loaded = pair.equilibrium(force=np.tile([0, -5e4, 3e5], (201, 1)))
    >>> grease = FrictionOptions(oil=lubricant("lgwm-2"), temperature=313.15)
    >>> found = roller_slip(loaded, time, 1.5, grease)
    >>> found.slip.shape, bool(found.slip[:, 0].max() < 0.01)
    ((201, 2, 48), True)
    """
    check_one_of("model", model, ("film", "coulomb"))
    rollers = result.bearing.rollers
    require(1 <= every <= rollers, "every", every, f"1 … {rollers}, as many as there are rollers")
    motions = []
    for whole in bearing_histories(result, time, speed, down=down, gravity=gravity):
        history = whole.followed(every)
        if model == "film":
            motion = film_motion(history, options, sliding=sliding, tolerance=tolerance)
        else:
            motion = coulomb_motion(
                history,
                DragConstants(options.roller_drag, 0.0),
                adhesion=options.boundary_friction,
                sliding=sliding,
                pocket="braking",
            )
        motions.append(motion)
    ideal = roller_friction(result, speed, options)
    steps = np.diff(np.asarray(time, float))
    lost = rollers * sum(m.slip_energy.mean(axis=1) for m in motions)
    power = np.concatenate([[0.0], np.asarray(lost)[1:] / steps])
    friction = BearingFriction(**{**vars(ideal), "losses": {**ideal.losses, "slip": power}})
    return BearingSlip(tuple(motions), friction)


def _entries(row: int, motion: RollerMotion, least: float) -> ZoneEntries:
    """`ZoneEntries` of one row."""
    history = motion.history
    rises = (history.load[1:] > least) & (history.load[:-1] <= least)
    rises &= motion.settled[:-1, None]
    roller, sample = np.nonzero(rises.T)
    sample = sample + 1
    # until the same roller's next entry, or the end of the series
    n = history.time.size
    after = np.append(sample[1:], n)
    after[np.append(roller[1:] != roller[:-1], True)] = n
    spans = [(r, slice(a, b)) for r, a, b in zip(roller, sample, after)]
    energy = np.array([motion.slip_energy[span, r].sum() for r, span in spans])
    density = np.array([motion.slip_power_density[span, r].max() for r, span in spans])
    before = motion.slip_speed[sample - 1, roller]
    places = np.full(roller.size, row)
    return ZoneEntries(places, roller, history.time[sample], before, energy, density)
