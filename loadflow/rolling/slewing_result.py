"""From ball forces of a slewing bearing to static safety, life and friction."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.rolling import friction, life, safety
from loadflow.rolling.contact import Array
from loadflow.rolling.result import ContactResult

if TYPE_CHECKING:
    from loadflow.rolling.slewing import SlewingBearing


@dataclass(frozen=True)
class SlewingResult(ContactResult):
    """Equilibrium of a slewing bearing; all quantities over the shape (...) of the load cases.

    Quantities other than the fields are formed when asked for. `maximum_force`, `force_sum`,
    `equivalent_load` and what follows from them need no array of all ball forces, so a series of
    any length fits in memory.

    Attributes
    ----------
    bearing : SlewingBearing
        The bearing.
    """

    bearing: SlewingBearing

    def _per_row(self, values: Array) -> Array:
        """Split the axis of kinds into row and diagonal."""
        return values.reshape(*self.displacement.shape[:-1], self.bearing.rows, 2, -1)

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

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        """Largest force of each kind, and sums of F, F³ and F^(10/3)."""
        return self._sums(1.0, 3.0, 10 / 3)

    @property
    def maximum_force(self) -> Array:
        """Largest contact force, N."""
        return self._statistics[0].max(axis=-1)

    @property
    def force_sum(self) -> Array:
        """Sum ΣF_k of all contact forces, N."""
        return self._statistics[1][..., 0].sum(axis=-1)

    @property
    def maximum_pressure(self) -> Array:
        """Largest Hertzian pressure, Pa (at the inner ring), (2.1)."""
        return np.maximum(*(self.raceway_pressure))

    @property
    def raceway_pressure(self) -> tuple[Array, Array]:
        """Largest Hertzian pressure at the inner and at the outer raceway, Pa."""
        inner, outer = (
            self.bearing.raceway_contact(raceway, self.maximum_force).pressure
            for raceway in ("inner", "outer")
        )
        return inner, outer

    @property
    def allowed_pressure(self) -> float:
        """Allowable pressure after the hardness factor, Pa, (2.8)."""
        bearing = self.bearing
        return bearing.allowable_pressure * safety.hardness_factor(bearing.hardness)

    @property
    def pressure_safety(self) -> Array:
        """Allowable over largest pressure, (4.2) put right; infinite without load."""
        return safety.ratio(self.allowed_pressure, self.maximum_pressure)

    @property
    def static_safety(self) -> Array:
        """Allowable over largest ball force, (4.1) put right: the cube of `pressure_safety`."""
        return self.pressure_safety**3

    @property
    def truncated(self) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the raceway's shoulder.

        Raises
        ------
        InputError
            If the bearing has no `shoulder_angle`.
        """
        bearing = self.bearing
        if bearing.shoulder_angle is None:
            raise InputError("shoulder_angle: needed to tell whether a contact is cut off")
        force = self.ball_forces
        half = np.maximum(
            bearing.raceway_contact("inner", force).semi_axes[0],
            bearing.raceway_contact("outer", force).semi_axes[0],
        )
        edge = self.contact_angles + np.arcsin(np.minimum(half / bearing.groove_radius, 1.0))
        cut = (edge > bearing.shoulder_angle) & (force > 0)
        return np.asarray(cut.any(axis=(-3, -2, -1)))

    @property
    def equivalent_load(self) -> Array:
        """Equivalent axial load P_ea, N, over all balls and both diagonals, (4.4)."""
        bearing = self.bearing
        return life.equivalent_axial_load(
            self._statistics[1][..., 1].sum(axis=-1),
            bearing.balls * bearing.rows,
            bearing.contact_angle,
        )

    @property
    def rating_life(self) -> Array:
        """Basic rating life L10, millions of revolutions, (2.19), with f_H C_a of (4.8)–(4.11)."""
        return life.rating_life(self.bearing.rated_capacity, self.equivalent_load)

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281 in millions of revolutions.

        Each row and diagonal has an inner and an outer raceway; all combine with exponents 10/3 and
        9/10. The inner ring turns relative to the load.
        """
        bearing = self.bearing
        _, sums = self._statistics
        rotating = np.cbrt(sums[..., 1] / bearing.balls)
        stationary = (sums[..., 2] / bearing.balls) ** 0.3
        inner, outer = bearing.raceway_capacity
        damage = (rotating / inner) ** (10 / 3) + (stationary / outer) ** (10 / 3)
        return safety.ratio(1.0, damage.sum(axis=-1)) ** 0.9

    def friction_torque(self, model: str = "forces", idle: float = 0.0) -> Array:
        """Friction torque, N m, by the ball forces (2.37) or the loads (2.25); see `friction`.

        Parameters
        ----------
        model : {"forces", "loads"}
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
            radial = np.hypot(self.force[..., 0], self.force[..., 1])
            tilt = np.hypot(self.moment[..., 0], self.moment[..., 1])
            axial = np.abs(self.force[..., 2])
            return friction.friction_torque_loads(axial, radial, tilt, pitch, idle=idle)
        raise InputError(f"model: must be 'forces' or 'loads', got {model!r}")
