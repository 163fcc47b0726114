"""From ball forces of a slewing bearing to life and friction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.rolling import friction
from loadflow.rolling.contacts import Array
from loadflow.rolling.rating import life
from loadflow.rolling.results import BallResult

if TYPE_CHECKING:
    from loadflow.rolling.bearings.four_point import SlewingBearing


@dataclass(frozen=True)
class SlewingResult(BallResult):
    """Equilibrium of a slewing bearing; all quantities over the shape (...) of the load cases.

    Attributes
    ----------
    bearing : SlewingBearing
        The bearing.
    """

    bearing: SlewingBearing

    def _per_row(self, values: Array) -> Array:
        """Split the axis of kinds into row and diagonal."""
        return values.reshape(*self.cases, self.bearing.rows, 2, values.shape[-1])

    @property
    def ball_forces(self) -> Array:
        """Contact forces, N, (..., row, diagonal, ball); diagonal 0 carries +Fz."""
        return self._per_row(self._state[0])

    @property
    def contact_angles(self) -> Array:
        """Operating contact angles, rad, (..., row, diagonal, ball), (2.44).

        Counted from the radial plane, positive toward the side of each diagonal. Where a contact is
        open, the angle of the line between the groove centres.
        """
        return self._per_row(self._state[1]) * np.array([1.0, -1.0])[:, None]

    @property
    def truncated(self) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the raceway's shoulder.

        Raises
        ------
        InputError
            If the bearing has no `shoulder_angle`.
        """
        return self._truncated(self.ball_forces, self.contact_angles, (-3, -2, -1))

    @property
    def equivalent_load(self) -> Array:
        """Equivalent axial load P_ea, N, over all balls and both diagonals, (4.4)."""
        bearing = self.bearing
        cubes = self._statistics[1][..., 1].sum(axis=-1)
        balls = bearing.balls * bearing.rows
        return life.equivalent_axial_load(cubes, balls, bearing.contact_angle)

    @property
    def rating_life(self) -> Array:
        """Basic rating life L10, millions of revolutions, (2.19), with f_H C_a of (4.8)–(4.11)."""
        return life.rating_life(self.bearing.rated_capacity, self.equivalent_load)

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281 in millions of revolutions.

        Each row and diagonal has an inner and an outer raceway of its own. The inner ring turns
        relative to the load.
        """
        _, sums = self._statistics
        return life.ball_reference_life(
            sums[..., 1], sums[..., 2], self.bearing.balls, self.bearing.raceway_capacity
        )

    def friction_torque(
        self, model: Literal["forces", "loads", "equivalent"] = "forces", idle: float = 0.0
    ) -> Array:
        """Friction torque, N m, by ball forces (2.37), loads (2.25) or equivalent load (2.23).

        Parameters
        ----------
        model : {"forces", "loads", "equivalent"}
            Which formula, each with its own friction factor.
        idle : float
            Torque without load, N m.

        Raises
        ------
        InputError
            If `model` is unknown.
        """
        pitch = self.bearing.pitch_diameter
        if model == "forces":
            return friction.friction_torque_forces(self.force_sum, pitch, idle=idle)
        if model == "loads":
            factor = friction.FRICTION_FACTORS["balls with cage"]
            return friction.friction_torque_components(
                self.force, self.moment, pitch, friction=factor, idle=idle
            )
        if model == "equivalent":
            return friction.friction_torque_equivalent(self.equivalent_load, pitch, idle=idle)
        raise InputError(f"model: must be 'forces', 'loads' or 'equivalent', got {model!r}")
