"""Conical bearings: a whole ring, or segments."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film_model import Control, Film, Keywords, film_and_control
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.pad_results import ConicalResult, common
from loadflow.journal.pads import Pads, Pivot, check_film, even_pads, finite
from loadflow.journal.solvers.assembly import (
    BODY,
    Assembly,
    AssemblyState,
    Member,
    raise_not_converged,
)
from loadflow.journal.solvers.assembly_orbit import series
from loadflow.journal.surfaces import FLAT, Cone, Profile
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_SHIFTS = np.arange(3)
_ALL = np.arange(BODY)
HELD = np.array([], dtype=np.int64)
RATIOS = (0.5, 0.8, 0.2)  # eccentricities over the gap from which Newton starts
ATTITUDE = math.radians(50.0)  # from the load to the eccentricity there
_ROUGH = Limits(1e-3, 20)  # of the films that only estimate a load


@dataclass(frozen=True)
class ConicalBearing:
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
    profile: Profile = FLAT
    pivot: Pivot | None = None

    def __post_init__(self) -> None:
        angle, c = self.half_angle, self.clearance
        require(0 < angle < 0.5 * math.pi, "half_angle", angle, "rad, 0 < … < π/2")
        object.__setattr__(self, "slant", tuple(float(s) for s in self.slant))
        require(len(self.slant) == 2, "slant", self.slant, "two distances from the apex, m")
        inner, outer = self.slant
        require(0 < inner < outer < math.inf, "slant", self.slant, "m, 0 < inner < outer, finite")
        require(0 < c < math.inf, "clearance", c, "m, > 0, finite")
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

    # --- verbs -----------------------------------------------------------------------------------
    def pressure(
        self,
        eccentricity: ArrayLike,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        velocity: ArrayLike = (0.0, 0.0, 0.0),
        tilt: ArrayLike = (0.0, 0.0),
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> ConicalResult:
        """Film at a given position of the shaft.

        Parameters
        ----------
        eccentricity : array_like (3,)
            Shaft relative to the bearing, m.
        speed : float
            rad/s.
        film : Film or Lubricant
            The film, or its liquid and its other fields as keywords; `grid` counts cells around and
            across, default (80, 20) for a whole ring, (40, 20) for each segment. There is no line
            of fresh oil: `inlet` is "auto" or None.
        velocity : array_like (3,)
            Of the shaft, m/s; segments on supports stay at rest.
        tilt : array_like (2,)
            Rotation of the shaft about the first and the second axis, rad.
        control : Control, optional
            How hard to solve; by default to 1e-10 in 60 Newton steps.
        **keywords
            Fields of `Film` and of `Control`.

        Returns
        -------
        ConicalResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or misshapen; a shaft that touches the bearing.
        loadflow.errors.SolverError
            No convergence.
        """
        film, control = film_and_control(film, more, control, keywords)
        check_film(film)
        place, speed = finite("eccentricity", eccentricity, 3), finite("speed", speed)
        moving, turned = finite("velocity", velocity, 3), finite("tilt", tilt, 2)
        rate = 2.0 * float(np.linalg.norm(moving)) / self.clearance
        assembly = self._assembly(film, speed, rate)
        state = self._started(assembly, np.append(place, turned), speed)
        state = AssemblyState(state.position, np.append(moving, np.zeros(2)), state.members)
        check_gap(assembly, state)
        limits = control.limits(1e-10, 60)
        state = assembly.solve(state, np.zeros(BODY), HELD, limits)
        if not state.converged and limits.strict:
            head = f"e = {place.tolist()} m, ω = {speed:.6g} rad/s"
            raise_not_converged(head, state, assembly.narrowest(state))
        return self._result(assembly, state, speed)

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
        """
        film, control = film_and_control(film, more, control, keywords)
        check_film(film)
        load, speed = finite("force", force, 3), finite("speed", speed)
        wanted, turned, free = loading(load, moment, tilt)
        limits = control.limits(1e-10, 60)
        head = f"F = ({load[0]:.6g}, {load[1]:.6g}, {load[2]:.6g}) N at ω = {speed:.6g} rad/s"
        self._refuse_hopeless(head, load, speed, film)
        assembly = self._assembly(film, speed, 0.0)
        starts = [
            self._started(assembly, np.append(place, turned), speed)
            for place in self._first_places(assembly, wanted, speed, turned)
        ]
        state = assembly.equilibrium(starts, wanted, free, limits)
        if not state.converged and limits.strict:
            head += self._hint(load)
            raise_not_converged(head, state, assembly.narrowest(state))
        return self._result(assembly, state, speed)

    def orbit(
        self,
        time: ArrayLike,
        force: ArrayLike,
        speed: ArrayLike,
        film: Film | Lubricant | None = None,
        *more: Any,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        start: ArrayLike | None = None,
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> xr.Dataset:
        """Path of the shaft under a load that changes with time.

        Implicit steps of second order from one time to the next, the oil in every cell conserved;
        a step at which Newton fails is cut, load and speed being straight lines between the times.
        Pads on their supports follow without inertia.

        Parameters
        ----------
        time : array_like (n,)
            s, increasing.
        force : array_like (n, 3) or (3,)
            What the shaft applies to the bearing, N.
        speed : array_like (n,) or float
            rad/s.
        moment : array_like (n, 2) or (2,), optional
            N m; the shaft then tilts freely.
        tilt : array_like (2,), optional
            Rotation of the shaft, rad, held (where it starts, with a moment); aligned by default.
        start : array_like (3,), optional
            First eccentricity, m; default the equilibrium of the first load.
        film, control, **keywords
            As in `pressure`; each step is solved to 1e-8 in 30 Newton steps by default.

        Returns
        -------
        xarray.Dataset
            Over ``time``: eccentricity, tilt, minimum_film, maximum_pressure, friction_power,
            load_share, residual, iterations.

        Raises
        ------
        loadflow.errors.InputError
            Misshapen, not finite or not increasing input.
        loadflow.errors.SolverError
            No equilibrium to start from, or a step that fails even when cut.
        """
        film, control = film_and_control(film, more, control, keywords)
        check_film(film)
        times, forces, speeds, moments = series(time, force, speed, moment, 3)
        turned = finite("tilt", (0.0, 0.0) if tilt is None else tilt, 2)
        first = float(speeds[0])
        assembly = self._assembly(film, float(np.abs(speeds).max()), 0.0)
        if start is None:
            words: dict[str, Any] = {"tilt": turned} if moment is None else {"moment": moments[0]}
            found = self.equilibrium(forces[0], first, film, **words)
            place, turned = found.eccentricity, found.tilt
        else:
            place = finite("start", start, 3)
        state = self._started(assembly, np.append(place, turned), first)
        check_gap(assembly, state)
        loads = np.column_stack([forces, moments])
        free = _SHIFTS if moment is None else _ALL
        return self.row.orbit(assembly, state, times, loads, speeds, free, control)

    # --- inside ----------------------------------------------------------------------------------
    def members(
        self, film: Film, speed: float, rate: float, clearance: float | None = None
    ) -> list[Member]:
        """Films of the bearing; `rate` of squeeze, 1/s; `clearance` in place of its own, m."""
        c = self.clearance if clearance is None else clearance
        return self.row.members(film, c, c, speed, abs(speed) + rate, alike=False)

    def _assembly(self, film: Film, speed: float, rate: float) -> Assembly:
        return Assembly(self.members(film, speed, rate), self.row.surface.radius)

    def _started(self, assembly: Assembly, position: Array, speed: float) -> AssemblyState:
        pads = self.row.lifted_at(assembly.members, position, speed)
        return assembly.start(position, pads)

    def _refuse_hopeless(self, head: str, load: Array, speed: float, film: Film) -> None:
        """Name the reason why no film can carry `load`."""
        if speed == 0.0:
            raise SolverError(f"{head}: without rotation and squeeze the film carries no load")
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


def loading(
    load: Array, moment: ArrayLike | None, tilt: ArrayLike | None
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Load (5,), held tilt (2,) and what moves."""
    if moment is not None and tilt is not None:
        raise InputError("moment and tilt are both given: one follows from the other")
    turned = finite("tilt", (0.0, 0.0) if tilt is None else tilt, 2)
    wanted = np.append(load, np.zeros(2))
    if moment is None:
        return wanted, turned, _SHIFTS
    wanted[3:] = finite("moment", moment, 2)
    return wanted, turned, _ALL


def check_gap(assembly: Assembly, state: AssemblyState) -> None:
    """Refuse a position at which the shaft touches the bearing."""
    narrowest = assembly.narrowest(state)
    if narrowest <= 0.0:
        raise InputError(f"the shaft touches the bearing: narrowest gap {narrowest:.6g} m")
