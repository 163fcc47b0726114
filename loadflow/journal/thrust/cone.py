"""Conical bearings: a whole ring, or segments."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any, ClassVar, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film_model import Control, Film, Keywords
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.solvers.assembly.error import relative_errors
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState, Member
from loadflow.journal.solvers.assembly.search import Chart, around, at_once, search
from loadflow.journal.solvers.assembly.solve import Assembly
from loadflow.journal.surfaces import FLAT, Cone, Cut
from loadflow.journal.thrust.pad_bearing import (
    AT_REST,
    HELD,
    SHIFTS,
    ConicalFilms,
    PadBearing,
    Rows,
    answered,
    asked,
    check_gap,
    limits_of,
    loading,
)
from loadflow.journal.thrust.pad_results import ConicalResult, common
from loadflow.journal.thrust.pads import Pads, Pivot, even_pads, finite
from loadflow.journal.validity import warn_if_beyond_pressure
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

RATIOS = (0.5, 0.8, 0.2)  # eccentricities over the gap from which Newton starts
ATTITUDE = math.radians(50.0)  # from the load to the eccentricity there
_ROUGH = Limits(1e-3, 20)  # of the films that only estimate a load


@dataclass(frozen=True)
class ConicalBearing(PadBearing, ConicalFilms[ConicalResult]):
    """Conical journal bearing: a whole ring or segments.

    Frame: the third axis runs along the shaft, from the apex toward the wide end; φ from the first
    axis toward the second, and speed > 0 the same way. The normal gap is
    ``c − (ex cos φ + ey sin φ) cos α + ez sin α``: ez > 0 widens it. Rotations and moments are
    about the point of the axis at half the length of the cone.

    Attributes
    ----------
    half_angle : float
        α between axis and generator, rad.
    slant : tuple of float
        Distances of both ends from the apex along the generator, m.
    clearance : float
        Gap normal to the surface around the centred shaft, m.
    pads : int, optional
        Number of segments, evenly spaced; a whole ring by default.
    pad_angle : float, optional
        Of one segment, rad; pads × pad_angle ≤ 2π.
    first_pad : float
        Angle at which the first segment begins, rad.
    profile : Taper, Step or Flat
        What is cut into the segments.
    pivot : Pivot, optional
        Support of each segment, elastic or tilting; rigid by default.

    Examples
    --------
    >>> from loadflow.journal import ConicalBearing, Film, Guembel, Lubricant
    >>> bearing = ConicalBearing(half_angle=0.52, slant=(1.0, 1.5), clearance=1e-4)
    >>> film = Film(Lubricant(0.05), Guembel(), inlet=None, grid=(80, 20))
    >>> found = bearing.pressure(eccentricity=(5e-5, 0.0, 0.0), speed=10.0, film=film)
    >>> [bool(x) for x in found.force > 0]
    [True, False, False]
    """

    half_angle: float
    slant: tuple[float, float]
    clearance: float
    pads: int | None = None
    pad_angle: float | None = None
    first_pad: float = 0.0
    profile: Cut = FLAT
    pivot: Pivot | None = None

    def __post_init__(self) -> None:
        angle, c = self.half_angle, self.clearance
        require(0 < angle < 0.5 * math.pi, "half_angle", angle, "rad, 0 < … < π/2")
        object.__setattr__(self, "slant", tuple(float(s) for s in self.slant))
        require(len(self.slant) == 2, "slant", self.slant, "two distances from the apex, m")
        inner, outer = self.slant
        require(0 < inner < outer < math.inf, "slant", self.slant, "m, 0 < inner < outer, finite")
        require(0 < c < math.inf, "clearance", c, "must be > 0 m and finite")
        require(c < 0.1 * inner * math.sin(angle), "clearance", c, "m, below a tenth of the radius")
        if (self.pads is None) != (self.pad_angle is None):
            raise InputError("pads and pad_angle are given together, or none for a whole ring")
        if self.pads is None:
            require(self.profile == FLAT, "profile", self.profile, "Flat() for a whole ring")
            require(self.pivot is None, "pivot", self.pivot, "None for a whole ring")
        else:
            even_pads(self.pads, self.pad_angle or 0.0, self.first_pad)

    @property
    def row(self) -> Pads:
        """The segments, or the whole ring."""
        surface = Cone(self.half_angle, *self.slant)
        if self.pads is None or self.pad_angle is None:
            return Pads(surface, 2.0 * math.pi, (0.0,), closed=True)
        centres = even_pads(self.pads, self.pad_angle, self.first_pad)
        return Pads(surface, self.pad_angle, centres, profile=self.profile, pivot=self.pivot)

    @property
    def reversed(self) -> ConicalBearing:
        """The same cone, its segments built for a shaft that turns the other way."""
        pivot = self.pivot and replace(self.pivot, share=1.0 - self.pivot.share)
        return replace(self, profile=self.profile.reversed, pivot=pivot)

    _axes: ClassVar[int] = 3

    @property
    def _shifts(self) -> Rows:
        """All three."""
        return SHIFTS

    # --- verbs -----------------------------------------------------------------------------------
    def equilibrium(
        self,
        force: ArrayLike,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> ConicalResult:
        """Position at which the film carries `force`.

        Parameters
        ----------
        force : array_like (3,)
            What the shaft applies to the bearing, N; the third < 0 presses toward the apex.
        speed : float
            rad/s.
        moment : array_like (2,), optional
            What the shaft applies to the bearing, N m; the shaft then tilts freely.
        tilt : array_like (2,), optional
            Rotation of the shaft, rad, held; aligned by default.
        film, control, **keywords
            As in `pressure`.

        Returns
        -------
        ConicalResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or misshapen; moment and tilt together.
        loadflow.errors.SolverError
            No film carries the force, with the reason.

        Warns
        -----
        loadflow.errors.ValidityWarning
            A pressure that oil and shell do not bear.
        """
        film, control = asked(film, more, control, keywords)
        load, speed = finite("force", force, 3), finite("speed", speed)
        wanted, turned, free = loading(load, moment, tilt)
        limits = limits_of(control)
        head = f"F = ({load[0]:.6g}, {load[1]:.6g}, {load[2]:.6g}) N at ω = {speed:.6g} rad/s"
        self._check_load(head, load, speed, film)
        assembly = self._assembly(film, speed, 0.0)
        starts = [
            self._started(assembly, np.append(place, turned), speed)
            for place in self._first_places(assembly, wanted, speed, turned)
        ]
        state = self._balanced(assembly, starts, wanted, free, limits, speed)
        state = answered(head + self._hint(load), assembly, state, limits)
        found = self._result(assembly, state, speed)
        warn_if_beyond_pressure(found.maximum_pressure, contact=False)
        return found

    # --- inside ----------------------------------------------------------------------------------
    def _balanced(
        self,
        assembly: Assembly,
        starts: list[AssemblyState],
        wanted: Array,
        free: Rows,
        limits: Limits,
        speed: float,
    ) -> AssemblyState:
        """Equilibrium from one of `starts`, or from all around."""
        quick = at_once(assembly, starts, wanted, free, limits)
        if quick is not None:
            return quick
        chart = Chart(self.clearance, self.half_angle, starts[0].position[3:])
        more = around(assembly, chart, lambda x: self._started(assembly, x, speed), wanted)
        found = search(assembly, chart, chain(starts, more), wanted, SHIFTS, limits)
        if found.converged and free.size > SHIFTS.size:
            return assembly.equilibrium([found, *starts], wanted, free, limits)
        return found

    def _place_of(self, found: ConicalResult) -> Array:
        return found.eccentricity

    def _films_at(
        self, film: Film, place: Array, tilt: Array, speeds: Array, free: Rows, control: Control
    ) -> tuple[Assembly, AssemblyState]:
        assembly = self._assembly(film, float(np.abs(speeds).max()), 0.0)
        state = self._started(assembly, np.append(place, tilt), float(speeds[0]))
        check_gap(assembly, state)
        return assembly, state

    def members(
        self, film: Film, speed: float, rate: float, clearance: float | None = None
    ) -> list[Member]:
        """Films of the bearing; `rate` of squeeze, 1/s; `clearance` in place of its own, m."""
        c = self.clearance if clearance is None else clearance
        return self.row.members(film, c, c, speed, abs(speed) + rate, alike=False)

    def _assembly(self, film: Film, speed: float, moving: float) -> Assembly:
        members = self.members(film, speed, 2.0 * moving / self.clearance)
        return Assembly(members, self.row.surface.radius)

    def _started(self, assembly: Assembly, position: Array, speed: float) -> AssemblyState:
        pads = self.row.lifted_at(assembly.members, position, speed)
        return assembly.start(position, pads)

    def _check_load(self, head: str, load: Array, speed: float, film: Film) -> None:
        """Name the reason why no film can carry `load`."""
        if speed == 0.0:
            raise SolverError(f"{head}: {AT_REST}")
        least = math.hypot(load[0], load[1]) * math.tan(self.half_angle)
        pushes = film.law.floor >= film.edge_pressure  # no film is below the pressure at its edges
        if pushes and load[2] >= -least and load.any():
            raise SolverError(
                f"{head}: a cone presses the shaft away from its apex; it needs a third component "
                f"of the force below −|F_radial| tan α = {-least:.6g} N"
            )

    def _hint(self, load: Array) -> str:
        """What directions of load a whole ring carries, in words."""
        least = math.hypot(load[0], load[1]) * math.tan(self.half_angle)
        if self.pads is not None:
            return ""
        return (
            f", F_axial {-load[2]:.4g} N beside |F_radial| tan α = {least:.4g} N (the half film of "
            "an aligned whole ring carries 1 to 1.27 times that)"
        )

    def _first_places(
        self, assembly: Assembly, wanted: Array, speed: float, tilt: Array
    ) -> list[Array]:
        """Positions whose film has about the direction and size of the wanted load (n, 3).

        Without ambient pressure the load of a film goes with the inverse square of its size: one
        film tells how far the shaft must move toward the apex.
        """
        cos, sin, c = math.cos(self.half_angle), math.sin(self.half_angle), self.clearance
        toward = math.atan2(wanted[1], wanted[0]) + math.copysign(ATTITUDE, speed)
        places = []
        size = float(np.linalg.norm(wanted[:3]))
        for ratio in RATIOS:
            aside = ratio * c / cos * np.array([math.cos(toward), math.sin(toward)])
            state = self._started(assembly, np.concatenate([aside, [0.0], tilt]), speed)
            if assembly.narrowest(state) <= 0.0:
                continue
            film = assembly.solve(state, np.zeros(BODY), HELD, _ROUGH)
            found = np.sum([part for pads in assembly.loads(film) for part in pads], axis=0)[:3]
            carried = float(np.linalg.norm(found))
            if not math.isfinite(carried) or carried <= 0.0:
                continue
            smaller = math.sqrt(carried / size) if size else 1.0
            turn = math.atan2(wanted[1], wanted[0]) - math.atan2(found[1], found[0])
            x, y = math.cos(turn), math.sin(turn)
            aside = smaller * np.array([x * aside[0] - y * aside[1], y * aside[0] + x * aside[1]])
            places.append(np.append(aside, (smaller - 1.0) * c / sin))
        if not places:
            places.append(np.zeros(3))
        return places

    def _result(self, assembly: Assembly, state: AssemblyState, speed: float) -> ConicalResult:
        return ConicalResult(**self.described(assembly, slice(None), state, state.position, speed))

    def described(
        self,
        assembly: Assembly,
        members: slice,
        state: AssemblyState,
        position: Array,
        speed: float,
    ) -> dict[str, Any]:
        """Fields of a `ConicalResult` of the `members` of this cone at a `position` of its own."""
        found = self.row.describe(assembly, members, state)
        found["relative_grid_error"] = relative_errors(assembly, members, state)
        loads = found["loads"]
        total = loads.sum(axis=0)
        stiffness, damping = assembly.coefficients(state, members)
        return common(found | {"stiffness_matrix": stiffness, "damping_matrix": damping}) | {
            "force": total[:3],
            "moment": total[3:],
            "eccentricity": position[:3],
            "tilt": position[3:],
            "pad_forces": loads[:, :3],
            "centre": found["centre"],
            "speed": speed,
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
        }
