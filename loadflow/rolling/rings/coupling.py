"""How contacts feel flexible rings: balls in grooves, and rollers on raceways."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from loadflow.errors import InputError
from loadflow.rolling.contacts import (
    GAP,
    HEIGHT,
    NORMAL_R,
    NORMAL_Z,
    RADIUS,
    STIFFNESS,
    Array,
    Contacts,
    Raceway,
)
from loadflow.rolling.rings.condensed import ContactLaw, RingModes
from loadflow.rolling.rings.flexible import FlexibleRings
from loadflow.rolling.rings.local_compliance import half_space
from loadflow.rolling.rings.patches import PatchPoints, patch_points

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways
    from loadflow.rolling.roller_raceways import RollerRaceways

# expected share of a contact force across its nominal line (of points), or of its moment over half
# the roller (of lines); and along the ring
_ACROSS, _ALONG = 0.2, 0.02


@dataclass(frozen=True)
class PointCoupling:
    """Balls: contacts feel the shift of their groove centres, one patch for each.

    Attributes
    ----------
    bearing : BallRaceways
        The bearing.
    element_angle : float
        Azimuth of the first ball of each row, rad.
    """

    left_out: ClassVar[float] = 1e-5
    sprung: ClassVar[bool] = True

    bearing: BallRaceways
    element_angle: float = 0.0

    @cached_property
    def contacts(self) -> Contacts:
        """The contacts of the bearing."""
        return self.bearing.contacts(self.element_angle)

    @property
    def elements(self) -> int:
        """Balls of a row."""
        return self.bearing.balls

    @property
    def places(self) -> list[tuple[float, float]]:
        """Groove centres of the inner ring."""
        return [(line[RADIUS], line[HEIGHT]) for line in self.contacts.table]

    def points(self, ring: Raceway, rings: FlexibleRings) -> PatchPoints:
        """Patches that shift with their master points, or turn with the section."""
        azimuth = self.contacts.azimuth - rings.turn(ring)
        return patch_points(self.bearing, ring, azimuth, rings.shell, rings.turning_patches)

    def fields(self, moved: Array) -> Array:
        """Shift (r, θ, z); θ counts where distances are spatial."""
        shift = moved.reshape(-1, *moved.shape[2:])
        return shift * np.array([1.0, float(self.contacts.spatial), 1.0])[:, None]

    def smooth_loads(self) -> list[tuple[float, Array]]:
        """Along the nominal contact line, across it, and along the ring."""
        normal = self.contacts.table[:, [NORMAL_R, NORMAL_Z]]
        nr, nz = (normal / np.linalg.norm(normal, axis=1)[:, None]).T
        zero, one = np.zeros_like(nr), np.ones_like(nr)
        return [
            (1.0, np.stack([nr, zero, nz], axis=1)),
            (_ACROSS, np.stack([-nz, zero, nr], axis=1)),
            (_ALONG, np.stack([zero, one, zero], axis=1)),
        ]

    def law(self, spring: float, rings: FlexibleRings) -> ContactLaw:
        """F = K δ^1.5 with a spring behind it, and what master nodes yield on top of Hertz."""
        if rings.master_width is not None:
            side = rings.master_width
            flexible = (rings.inner is not None) + (rings.outer is not None)
            material = self.bearing.elastic_modulus, self.bearing.poisson_ratio
            spring += flexible * half_space(side, side, *material)[0]
        return ContactLaw(self.contacts.law, self.contacts.table, spring)

    def state(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Forces, and angles that move with the groove centres."""
        from loadflow.rolling.rings import _ring_kernels

        force, angle = _ring_kernels.contact_state(unknowns, modes.waves, modes.law)
        return force, angle

    def statistics(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Largest forces, and sums of F, F³, F^(10/3)."""
        force, _ = self.state(unknowns, modes)
        sums = np.stack([(force**p).sum(axis=-1) for p in (1, 3, 10 / 3)], axis=-1)
        return force.max(axis=-1), sums

    def grouped(self, unknowns: Array, modes: RingModes, groups: int) -> Array:
        """Sums over the kinds of each group."""
        force, _ = self.state(unknowns, modes)
        return np.asarray(force.reshape(len(force), groups, -1, self.elements).sum(axis=-2))

    def pushes(self, force: Array, angle: Array) -> Array:
        """Along the lines of contact."""
        along = [force * np.cos(angle), np.zeros_like(force), force * np.sin(angle)]
        return np.stack(along, axis=-1)

    def raceways(self, moved: Array) -> Array:
        """Each patch is a raceway's."""
        return moved.reshape(*moved.shape[:-3], *self.bearing.groups, self.elements, 3)


@dataclass(frozen=True)
class LineCoupling:
    """Rollers: rows feel approach and relative turn of the raceways, from patches at both ends.

    Forces act along the nominal normal; sections of the rings turn with their raceways.

    Attributes
    ----------
    bearing : RollerRaceways
        The bearing; its contacts in the order row 0 slice 0, row 0 slice 1, ….
    element_angle : float
        Azimuth of the first roller of each row, rad.
    """

    left_out: ClassVar[float] = 1e-5
    sprung: ClassVar[bool] = False

    bearing: RollerRaceways
    element_angle: float = 0.0

    @cached_property
    def contacts(self) -> Contacts:
        """The contacts of the bearing."""
        return self.bearing.contacts(self.element_angle)

    @property
    def elements(self) -> int:
        """Rollers of a row."""
        return self.bearing.rollers

    @property
    def _rows(self) -> Array:
        """Lines of the slices of each row, (row, slice, column)."""
        table = self.contacts.table
        return table.reshape(self.bearing.tracks, self.bearing.slices, table.shape[1])

    @property
    def _arms(self) -> Array:
        """Places of the slices along their roller over half its length, (row, slice).

        All 0 where rollers follow the tilt of the inner ring.
        """
        rows = self._rows
        moved = rows - rows.mean(axis=1, keepdims=True)
        along = moved[..., HEIGHT] * rows[..., NORMAL_R] - moved[..., RADIUS] * rows[..., NORMAL_Z]
        return np.asarray(along / self._half)

    @property
    def _half(self) -> float:
        """Half the length of a roller, m."""
        return self.bearing.roller_length / 2

    def _ends(self, side: float) -> list[tuple[float, float]]:
        """Both ends of the rollers of each row, `side` roller radii along the normal."""
        out = side * self.bearing.roller_diameter / 2
        return [
            (
                line[RADIUS] + out * line[NORMAL_R] - along * line[NORMAL_Z],
                line[HEIGHT] + out * line[NORMAL_Z] + along * line[NORMAL_R],
            )
            for line in self._rows.mean(axis=1)
            for along in (-self._half, self._half)  # the roller lies along (-n_z, n_r)
        ]

    @property
    def places(self) -> list[tuple[float, float]]:
        """Ends of the rollers' axes."""
        return self._ends(0.0)

    def points(self, ring: Raceway, rings: FlexibleRings) -> PatchPoints:
        """Raceways at both ends of the rollers."""
        radius, height = np.array(self._ends(1.0 if ring == "outer" else -1.0)).T
        return PatchPoints(radius, height, self.contacts.azimuth - rings.turn(ring))

    def fields(self, moved: Array) -> Array:
        """Approach at the middle along the normal, and half the difference of the ends."""
        normal = self._rows[:, 0][:, [NORMAL_R, NORMAL_Z]]
        ends = moved.reshape(len(normal), 2, *moved.shape[1:])
        along = np.einsum("tc,tejcn->tejn", normal, ends[:, :, :, [0, 2]])
        first, last = along[:, 0], along[:, 1]
        halves = np.stack([(first + last) / 2, (last - first) / 2], axis=2)
        return halves.reshape(-1, 2, moved.shape[-1])

    def smooth_loads(self) -> list[tuple[float, Array]]:
        """Forces, and moments on the rollers."""
        one, zero = np.ones(self.bearing.tracks), np.zeros(self.bearing.tracks)
        return [(1.0, np.stack([one, zero], axis=1)), (_ACROSS, np.stack([zero, one], axis=1))]

    def law(self, spring: float, rings: FlexibleRings) -> ContactLaw:
        """F = K δ^(10/9) of each slice, without a spring.

        Raises
        ------
        InputError
            A `master_width`, which is of balls.
        """
        if rings.master_width is not None:
            raise InputError("master_width: of balls only; rollers have no master nodes")
        columns = [self._arms, self._rows[..., GAP], self._rows[..., STIFFNESS]]
        table = np.stack([column.ravel() for column in columns], axis=1)
        return ContactLaw(self.contacts.law, np.ascontiguousarray(table), spring)

    def _shift(self, unknowns: Array, modes: RingModes) -> Array:
        """Fields of all rollers, (n, row, 2, roller)."""
        from loadflow.rolling.rings import _ring_kernels

        fields = _ring_kernels.fields_of(unknowns, modes.waves)
        return np.asarray(fields.reshape(len(unknowns), self.bearing.tracks, 2, self.elements))

    def state(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Forces of the slices, and their nominal angles."""
        from loadflow.rolling.rings import _line_kernels

        force = _line_kernels.slice_forces(self._shift(unknowns, modes), modes.law.table)
        table = self.contacts.table
        angle = np.arctan2(table[:, NORMAL_Z], table[:, NORMAL_R])
        return force, np.broadcast_to(angle[:, None], force.shape)

    def statistics(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Largest forces, and sums of F, F⁴, F^4.5."""
        from loadflow.rolling.rings import _line_kernels

        largest, sums = _line_kernels.slice_sums(self._shift(unknowns, modes), modes.law.table)
        return largest, sums

    def grouped(self, unknowns: Array, modes: RingModes, groups: int) -> Array:
        """Forces of whole rollers."""
        from loadflow.rolling.rings import _line_kernels

        shift = self._shift(unknowns, modes)
        return np.asarray(_line_kernels.roller_forces(shift, modes.law.table))

    def pushes(self, force: Array, angle: Array) -> Array:
        """Shares of both ends, by the force of a roller and its moment."""
        lead, rows = force.shape[:-2], self._rows
        slices = force.reshape(*lead, len(rows), -1, force.shape[-1])
        total, moment = slices.sum(axis=-2), np.einsum("ts,...tsj->...tj", self._arms, slices)
        ends = np.stack([(total - moment) / 2, (total + moment) / 2], axis=-2)
        normal = np.stack([rows[:, 0, NORMAL_R], 0 * rows[:, 0, GAP], rows[:, 0, NORMAL_Z]], axis=1)
        found = ends[..., None] * normal[:, None, None, :]
        return found.reshape(*lead, -1, self.elements, 3)

    def raceways(self, moved: Array) -> Array:
        """Middle of each roller."""
        lead = moved.shape[:-3]
        both = moved.reshape(*lead, self.bearing.tracks, 2, self.elements, 3)
        return np.asarray(both.mean(axis=-3))
