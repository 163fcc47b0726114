"""What thrust bearings of sector and of straight pads share: films at a gap and under a force."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film_model import Control, Film, Keywords
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.solvers.assembly.error import relative_errors
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState
from loadflow.journal.solvers.assembly.solve import Assembly
from loadflow.journal.thrust.pad_bearing import (
    AT_REST,
    HELD,
    PadBearing,
    Rows,
    answered,
    asked,
    limits_of,
    loading,
)
from loadflow.journal.thrust.pad_results import ThrustResult, common
from loadflow.journal.thrust.pads import LIFTS, finite
from loadflow.journal.thrust.warm_pads import balanced
from loadflow.journal.validity import warn_if_beyond_pressure
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_AXIAL = np.array([2])
_ROUNDS = 12  # gaps tried for a first one
_NEAR = 1.5  # ratio of load and force up to which a gap is near enough for Newton
_FAINT = 1e-9  # of the load of ordinary pads, that is none
_LOAD_NUMBER = 0.05  # W h²/(η U L² B) of an ordinary pad, for the first gap of all


class PadThrust(PadBearing):
    """What thrust bearings on a ring and those of straight pads share."""

    _axes: ClassVar[int] = 1
    _signs: ClassVar[float] = -1.0

    @property
    def _shifts(self) -> Rows:
        """The one along the axis."""
        return _AXIAL

    # --- verbs -----------------------------------------------------------------------------------
    def pressure(
        self,
        gap: float,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        velocity: float = 0.0,
        tilt: ArrayLike = (0.0, 0.0),
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> ThrustResult:
        """Film at a given gap.

        Parameters
        ----------
        gap : float
            Film over the flat lands, m, > 0: the least film of an aligned runner, that on the axis
            of a tilted one. Of pads that tilt, the film over their pivots. Pads on elastic supports
            give way from there, so that it may be 0 and less of these.
        speed : float
            Of the runner, rad/s; < 0 turns it against the order of the profile.
        film : Film or Lubricant
            The film, or its liquid and its other fields as keywords; `grid` counts cells along the
            motion and across, per pad, default (40, 20).
        velocity : float
            Growth of the gap, m/s.
        tilt : array_like (2,)
            Rotation of the runner about the first and the second axis, rad: the gap grows by
            tilt[0] y − tilt[1] x.
        control : Control, optional
            How hard to solve; by default to 1e-10 in 60 Newton steps.
        **keywords
            Fields of `Film` and of `Control`.

        Returns
        -------
        ThrustResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or out of range; a runner that touches a pad.
        loadflow.errors.SolverError
            Pads that find no tilt without moment.
        """
        film, control = asked(film, more, control, keywords, knows_heat=True)
        if film.heat is not None:
            held: dict[str, Any] = {"velocity": velocity, "tilt": tilt, "control": control}
            return balanced(lambda own: self.pressure(gap, speed, own, **held), film, control)
        gap, speed, velocity = (
            finite("gap", gap),
            finite("speed", speed),
            finite("velocity", velocity),
        )
        turned = finite("tilt", tilt, 2)
        thick = self._thick_at("gap", gap, film, speed)
        assembly = self._assembly(film, gap, thick, speed, velocity, alike=not turned.any())
        limits = limits_of(control)
        place = np.array([0.0, 0.0, 0.0, *turned])
        state = self._held(assembly, place, velocity, gap, thick, speed, limits)
        state = answered(f"gap {gap:.6g} m, ω = {speed:.6g} rad/s", assembly, state, limits)
        return self._result(assembly, state, gap, speed)

    def equilibrium(
        self,
        force: float,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> ThrustResult:
        """Gap at which the film carries `force`.

        Parameters
        ----------
        force : float
            Axial, N, > 0 presses the runner on the pads.
        speed : float
            rad/s.
        film, control, **keywords
            As in `pressure`.
        moment : array_like (2,), optional
            What the runner applies to the pads about both axes, N m; the runner then tilts freely.
        tilt : array_like (2,), optional
            Rotation of the runner, rad, held; aligned by default.

        Returns
        -------
        ThrustResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or out of range; moment and tilt together.
        loadflow.errors.SolverError
            No film carries the force, with the reason.

        Warns
        -----
        loadflow.errors.ValidityWarning
            A pressure that oil and shell do not bear.
        """
        film, control = asked(film, more, control, keywords, knows_heat=True)
        if film.heat is not None:
            held: dict[str, Any] = {"moment": moment, "tilt": tilt, "control": control}
            return balanced(lambda own: self.equilibrium(force, speed, own, **held), film, control)
        force, speed = finite("force", force), finite("speed", speed)
        require(force > 0, "force", force, "must be > 0 N: it presses the runner on the pads")
        load = np.array([0.0, 0.0, -force])
        wanted, turned, free = loading(load, moment, tilt, self._shifts)
        head = f"F = {force:.6g} N at ω = {speed:.6g} rad/s"
        limits = limits_of(control)
        self._check_load(head, speed)
        thick, carried = self._on_rigid_supports()._first_gap(
            head, force, speed, film, turned, limits
        )
        first = thick - carried * self._softness
        alike = moment is None and not turned.any()
        assembly = self._assembly(film, first, thick, speed, 0.0, alike)
        place = np.array([0.0, 0.0, 0.0, *turned])
        start = self._held(assembly, place, 0.0, first, thick, speed, limits)
        state = assembly.equilibrium([start], wanted, free, limits)
        found = self._result(assembly, answered(head, assembly, state, limits), first, speed)
        warn_if_beyond_pressure(found.maximum_pressure, contact=False)
        return found

    # --- inside ----------------------------------------------------------------------------------
    def _place_of(self, found: ThrustResult) -> float:
        return found.gap

    def _films_at(
        self, film: Film, place: float, tilt: Array, speeds: Array, free: Rows, control: Control
    ) -> tuple[Assembly, AssemblyState]:
        alike, first = free.size == self._shifts.size and not tilt.any(), float(speeds[0])
        thick = self._thick_at("start", place, film, first)
        assembly = self._assembly(film, place, thick, float(np.abs(speeds).max()), 0.0, alike)
        for member in assembly.members:
            member.film.set_speed(first)
        position = np.array([0.0, 0.0, 0.0, *tilt])
        return assembly, self._held(
            assembly, position, 0.0, place, thick, first, limits_of(control)
        )

    def _named(self, path: xr.Dataset, place: float) -> xr.Dataset:
        about = {"units": "m", "long_name": "film over the lands on the axis"}
        shift = path.eccentricity.isel(space=2)
        return path.drop_vars("eccentricity").assign(gap=(shift + place).assign_attrs(about))

    def _check_load(self, head: str, speed: float) -> None:
        """Name the reason why no film can carry anything."""
        if speed == 0.0:
            raise SolverError(f"{head}: {AT_REST}")
        row = self.row
        share = np.linspace(0.0, 1.0, 9)
        if not row.tilting and not row.profile.depth(share).any():
            raise SolverError(f"{head}: flat pads that do not tilt have no wedge and carry no load")

    def _reason(self) -> str:
        """Why a film carries nothing."""
        pivot = self.row.pivot
        if self.row.tilting and pivot is not None:
            return (
                "the pads find no tilt at which the centre of pressure meets the pivot at "
                f"{pivot.share:g} of their length and {pivot.across:g} of their width"
            )
        return "the film diverges in this sense of rotation and carries no load"

    def _first_gap(
        self, head: str, force: float, speed: float, film: Film, tilt: Array, limits: Limits
    ) -> tuple[float, float]:
        """Gap near which an aligned runner has the wanted force, m, and its force there, N."""
        nodes = self.row.surface.place(self.row.surface.nodes(4))
        gap = math.sqrt(self._ordinary(film.liquid.viscosity * abs(speed)) / force)
        reach = float(np.hypot(*tilt)) * float(nodes[-1])
        gap = max(gap, 2.0 * reach)
        tried: list[tuple[float, float]] = []
        for _ in range(_ROUNDS):
            assembly = self._assembly(film, gap, gap, speed, 0.0, alike=True)
            state = self._held(assembly, np.zeros(BODY), 0.0, gap, gap, speed, limits)
            load = _axial(assembly, state)
            if not state.converged or self._idle(assembly, state, gap):
                raise SolverError(f"{head}: {self._reason()}; {load:.4g} N at a gap of {gap:.4g} m")
            if 1.0 / _NEAR < load / force < _NEAR:
                break
            tried.append((math.log(gap), math.log(load / force)))
            slope = -2.0
            if len(tried) > 1:
                (x0, y0), (x1, y1) = tried[-2:]
                slope = min((y1 - y0) / (x1 - x0), -0.2) if x1 != x0 else -2.0
            gap *= math.exp(min(2.0, max(-2.0, -tried[-1][1] / slope)))
        return max(gap, 1.2 * reach), load

    def _ordinary(self, drag: float) -> float:
        """Load of ordinary pads times the square of their gap, N m², for a `drag` η ω, Pa."""
        row = self.row
        radius, count = row.surface.radius, len(row.centres)
        nodes = row.surface.place(row.surface.nodes(4))
        across, length = float(nodes[-1] - nodes[0]), row.angle * row.surface.radius
        narrow = min(1.0, across / length)
        return _LOAD_NUMBER * drag * radius * length**2 * across * count * narrow**2

    @property
    def _softness(self) -> float:
        """How far the supports of the pads give way for each N of all pads, m/N; 0 if rigid."""
        pivot, pads = self.row.pivot, len(self.row.centres)
        return 0.0 if pivot is None else 1.0 / (pivot.stiffness * pads)

    def _on_rigid_supports(self) -> Any:
        """The same on pivots that do not give way along the normal."""
        pivot = self.row.pivot
        if pivot is None or not self._softness:
            return self
        own: Any = self
        return replace(own, pivot=replace(pivot, stiffness=math.inf))

    def _given_way(self, film: Film, speed: float) -> float:
        """How far their supports give way to a film of ordinary pads, times its square, m³."""
        return self._softness * self._ordinary(film.liquid.viscosity * abs(speed))

    def _thick_at(self, name: str, gap: float, film: Film, speed: float) -> float:
        """Film of ordinary pads that their supports let give way from a `gap`, m: where both
        carry the same, (thick − gap)/softness = ordinary load number/thick².

        Raises
        ------
        loadflow.errors.InputError
            A gap that no film keeps open.
        """
        thick, lifting = gap, self._given_way(film, speed)
        if self._softness:
            thick = float(np.roots([1.0, -gap, 0.0, -lifting]).real.max())
        require(thick > 0, name, gap, "must be > 0 m")
        return thick

    def _idle(self, assembly: Assembly, state: AssemblyState, gap: float) -> bool:
        """Whether one of the films carries nothing but rounding, as that of a flat pad."""
        film = assembly.members[0].film
        ordinary = self._ordinary(film.viscosity * abs(film.speed)) / gap**2
        least = min(-float(part[2]) for pads in assembly.loads(state) for part in pads)
        return least <= _FAINT * ordinary / len(self.row.centres)

    def _assembly(
        self, film: Film, gap: float, thick: float, speed: float, velocity: float, alike: bool
    ) -> Assembly:
        """Films around a runner with a `gap`, about as `thick`, m."""
        rate = abs(speed) + 2.0 * abs(velocity) / thick
        members = self.row.members(film, thick, gap, speed, rate, alike)
        return Assembly(members, self.row.surface.radius)

    def _held(
        self,
        assembly: Assembly,
        position: Array,
        velocity: float,
        gap: float,
        thick: float,
        speed: float,
        limits: Limits,
    ) -> AssemblyState:
        """Films about as `thick`, m, at a given position; pads that tilt carry, as many as can."""
        states: list[AssemblyState] = []
        moving = np.zeros(BODY)
        moving[2] = velocity
        for lift in LIFTS if self.row.tilting else LIFTS[:1]:
            pad = self.row.lifted(thick, speed, lift)
            if self._softness:
                pad[0] = thick - gap
            pads = [pad] * len(assembly.members)
            start = assembly.start(position, pads)
            narrowest = assembly.narrowest(start)
            if narrowest <= 0.0:
                if self.row.tilting and lift != LIFTS[0]:
                    continue
                raise InputError(f"the runner touches the pads: narrowest gap {narrowest:.6g} m")
            start = AssemblyState(position, moving, start.members)
            state = assembly.solve(start, np.zeros(BODY), HELD, limits)
            if state.converged and not self._idle(assembly, state, thick):
                return state
            states.append(state)
        return max(states, key=lambda one: (one.converged, _axial(assembly, one)))

    def _result(
        self, assembly: Assembly, state: AssemblyState, base: float, speed: float
    ) -> ThrustResult:
        found = self.row.describe(assembly, slice(None), state)
        found["relative_grid_error"] = relative_errors(assembly, slice(None), state)
        axes = slice(2, BODY)
        stiffness, damping = (m[axes, axes] for m in assembly.coefficients(state))
        loads = found["loads"]
        total = loads.sum(axis=0)
        share = (found["centre"][:, 1] - np.array(self.row.centres)) / self.row.angle + 0.5
        centre = np.column_stack([found["centre"][:, 0], share])
        alike = len(assembly.members) == 1
        return ThrustResult(
            **common(found | {"stiffness_matrix": stiffness, "damping_matrix": damping}),
            force=float(-total[2]) + 0.0,
            moment=total[3:],
            gap=base + float(state.position[2]),
            tilt=state.position[3:],
            pad_force=float(-loads[0, 2]) + 0.0 if alike else -loads[:, 2] + 0.0,
            centre=(float(centre[0, 0]), float(centre[0, 1])) if alike else centre,
            stiffness=float(stiffness[0, 0]),
            damping=float(damping[0, 0]),
            speed=speed,
            converged=state.converged,
            residual=state.residual,
            iterations=state.iterations,
        )


def _axial(assembly: Assembly, state: AssemblyState) -> float:
    """Axial force of all pads, N."""
    return -float(sum(part[2] for pads in assembly.loads(state) for part in pads))
