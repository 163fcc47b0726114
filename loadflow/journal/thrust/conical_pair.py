"""Two conical bearings against each other: one locating bearing for forces and moments."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import chain
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film_model import Control, Film, Keywords
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState
from loadflow.journal.solvers.assembly.search import PairChart, at_once, between, search
from loadflow.journal.solvers.assembly.solve import Assembly
from loadflow.journal.thrust.cone import ATTITUDE, RATIOS, ConicalBearing
from loadflow.journal.thrust.pad_bearing import (
    AT_REST,
    SHIFTS,
    ConicalFilms,
    Rows,
    answered,
    asked,
    limits_of,
    loading,
)
from loadflow.journal.thrust.pad_results import ConicalResult, PairResult
from loadflow.journal.thrust.pads import finite
from loadflow.journal.validity import warn_if_beyond_pressure
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_REACH = 0.9  # share of the clearance that a first eccentricity may take
_FIRST, _ALL = (80,), (80, 200)  # Newton steps of a search from the first start, from all


@dataclass(frozen=True)
class ConicalPair(ConicalFilms[PairResult]):
    """Two cones against each other: one locating bearing for forces and moments.

    Frame: the third axis along the shaft from `left` to `right`, origin half-way between the
    middles of both; speed > 0 from the first axis toward the second. The narrow ends of the cones
    face each other ("O", wide support) or the wide ones ("X").

    Attributes
    ----------
    left, right : ConicalBearing
        The cones; each described in a frame of its own, whose third axis runs to its wide end. The
        frame of a cone whose wide end is on the left is turned by half a turn about the first axis.
        Inlet and pivot of segments are those of the sense in which the shaft turns at speed > 0.
    distance : float
        Between the middles of both, m.
    clearance : float, optional
        Gap of both, normal to the surface, around the centred shaft, m; their own by default.
    arrangement : {"O", "X"}
        Which ends face each other.

    Examples
    --------
    >>> from loadflow.journal import ConicalBearing, ConicalPair, Film, Guembel, Lubricant
    >>> cone = ConicalBearing(half_angle=0.5, slant=(1.0, 1.3), clearance=2e-4)
    >>> pair = ConicalPair(cone, cone, distance=1.0, clearance=2e-4)
    >>> film = Film(Lubricant(0.1), Guembel(), inlet=None, grid=(40, 10))
    >>> state = pair.equilibrium((1e5, 0.0, 5e4), moment=(0.0, 1e4), speed=1.0, film=film)
    >>> bool(state.right.force[2] < 0)
    True
    """

    left: ConicalBearing
    right: ConicalBearing
    distance: float
    clearance: float | None = None
    arrangement: str = "O"

    def __post_init__(self) -> None:
        require(0 < self.distance < math.inf, "distance", self.distance, "must be > 0 m and finite")
        c = self.clearance
        if c is not None:
            require(0 < c < math.inf, "clearance", c, "must be > 0 m and finite")
        require(self.arrangement in ("O", "X"), "arrangement", self.arrangement, '"O" or "X"')

    @property
    def cones(self) -> tuple[ConicalBearing, ConicalBearing]:
        """Both cones, left and right, as the shaft turns in the frame of each."""
        left, right = self.left, self.right
        return (left.reversed, right) if self.arrangement == "O" else (left, right.reversed)

    def views(self) -> tuple[Array, Array]:
        """Position of the shaft in the frame of each cone by that in the pair's, (5, 5) each."""
        found = []
        for side in (-1.0, 1.0):
            z = 0.5 * side * self.distance
            shift = np.eye(BODY)
            shift[0, 4], shift[1, 3] = z, -z
            outward = side if self.arrangement == "O" else -side
            turn = np.eye(BODY) if outward > 0 else np.diag([1.0, -1.0, -1.0, 1.0, -1.0])
            found.append(turn @ shift)
        return found[0], found[1]

    def equilibrium(
        self,
        force: ArrayLike,
        moment: ArrayLike | None = None,
        speed: float | None = None,
        film: Film | Lubricant | None = None,
        *more: Any,
        tilt: ArrayLike | None = None,
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> PairResult:
        """Position at which both films carry `force` and `moment`.

        Parameters
        ----------
        force : array_like (3,)
            What the shaft applies to the bearing, N.
        moment : array_like (2,), optional
            N m about the origin; the shaft then tilts freely. Without it it stays at `tilt`.
        speed : float
            rad/s.
        film, tilt, control, **keywords
            As of `ConicalBearing.equilibrium`.

        Returns
        -------
        PairResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or misshapen; moment and tilt together.
        loadflow.errors.SolverError
            No films carry the load, with the reason.

        Warns
        -----
        loadflow.errors.ValidityWarning
            A pressure that oil and shell do not bear.
        """
        film, control = asked(film, more, control, keywords)
        if speed is None:
            raise InputError("speed: not given; the speed of the shaft, rad/s")
        load, speed = finite("force", force, 3), finite("speed", speed)
        wanted, turned, free = loading(load, moment, tilt)
        limits = limits_of(control)
        head = (
            f"F = ({load[0]:.6g}, {load[1]:.6g}, {load[2]:.6g}) N, M = ({wanted[3]:.6g}, "
            f"{wanted[4]:.6g}) N m at ω = {speed:.6g} rad/s"
        )
        if speed == 0.0:
            raise SolverError(f"{head}: {AT_REST}")
        assembly = self._assembly(film, speed, 0.0)
        starts = []
        for place in self._first_places(wanted, turned, speed):
            start = self._started(assembly, place, speed)
            if assembly.narrowest(start) > 0.0:
                starts.append(start)
        if not starts:
            raise SolverError(f"{head}: the shaft touches a cone at this tilt")
        state = self._balanced(assembly, starts, wanted, free, limits, speed)
        found = self._result(assembly, answered(head, assembly, state, limits), speed)
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
        """Equilibrium from one of `starts`, or from all between the cones."""
        quick = at_once(assembly, starts, wanted, free, limits)
        if quick is not None:
            return quick
        chart = self._chart(starts[0].position[3:], free.size > SHIFTS.size)
        found = search(assembly, chart, starts[:1], wanted, free, limits, _FIRST)
        if found.converged:
            return found
        more = between(assembly, chart, lambda x: self._started(assembly, x, speed), wanted)
        others = chain(more, starts[1:] or [found])  # there may be none between the cones
        found = search(assembly, chart, others, wanted, free, limits, _ALL)
        if found.converged:
            return found
        stepped = assembly.equilibrium(starts, wanted, free, limits)
        return stepped if stepped.converged else found

    def _chart(self, tilt: Array, free: bool) -> PairChart:
        """Where the shaft may be between the cones."""
        ends, aside = [math.inf, -math.inf], math.inf
        for cone, view in zip(self.cones, self.views()):
            c = cone.clearance if self.clearance is None else self.clearance
            reach = -math.copysign(c / math.sin(cone.half_angle), view[2, 2])
            ends = [min(ends[0], reach), max(ends[1], reach)]
            aside = min(aside, c / math.cos(cone.half_angle))
        length = 0.5 * self.distance + max(cone.row.surface.radius for cone in self.cones)
        return PairChart(ends[0], ends[1], aside, length, tilt, free)

    def _assembly(self, film: Film, speed: float, moving: float) -> Assembly:
        members = []
        for cone, view in zip(self.cones, self.views()):
            c = cone.clearance if self.clearance is None else self.clearance
            own = math.copysign(1.0, view[2, 2]) * speed
            for member in cone.members(film, own, 2.0 * moving / c, c):
                turns = tuple(turn @ view for turn in member.turns)
                members.append(member.seen(turns, math.copysign(1.0, view[2, 2])))
        return Assembly(members, max(cone.row.surface.radius for cone in self.cones))

    def _started(self, assembly: Assembly, position: Array, speed: float) -> AssemblyState:
        pads: list[Array] = []
        for cone, view, part in zip(self.cones, self.views(), self._parts()):
            own = math.copysign(1.0, view[2, 2]) * speed
            pads += cone.row.lifted_at(assembly.members[part], position, own)
        return assembly.start(position, pads)

    def _parts(self) -> tuple[slice, slice]:
        """Members of the left and of the right cone."""
        count = len(self.left.row.centres)
        return slice(0, count), slice(count, None)

    def _first_places(self, wanted: Array, tilt: Array, speed: float) -> list[Array]:
        """Positions across the clearance toward the load (n, 5)."""
        gaps = [cone.clearance if self.clearance is None else self.clearance for cone in self.cones]
        c = min(gaps)
        toward = math.atan2(wanted[1], wanted[0]) + math.copysign(ATTITUDE, speed)
        total = float(np.linalg.norm(wanted[:3]))
        axial = wanted[2] / total if total else 0.0
        places = []
        for ratio in RATIOS:
            aside = ratio * c * _REACH * np.array([math.cos(toward), math.sin(toward)])
            lift = axial * (1.0 - ratio) * c
            places.append(np.concatenate([aside, [lift], tilt]))
        return places

    def _result(self, assembly: Assembly, state: AssemblyState, speed: float) -> PairResult:
        results, total = [], np.zeros(BODY)
        for cone, view, part in zip(self.cones, self.views(), self._parts()):
            own = view @ state.position
            turned = math.copysign(1.0, view[2, 2]) * speed
            fields = cone.described(assembly, part, state, own, turned)
            results.append(_in_frame(fields, view))
            total += np.append(fields["force"], fields["moment"])
        stiffness, damping = assembly.coefficients(state)
        normal = np.array([r.normal_force.sum() for r in results])
        return PairResult(
            left=results[0],
            right=results[1],
            force=total[:3],
            moment=total[3:],
            eccentricity=state.position[:3],
            tilt=state.position[3:],
            load_share=normal / normal.sum() if normal.sum() else np.full(2, math.nan),
            minimum_film=min(r.minimum_film for r in results),
            maximum_pressure=max(r.maximum_pressure for r in results),
            friction_torque=results[1].friction_torque
            * math.copysign(1.0, results[1].speed * speed)
            + results[0].friction_torque * math.copysign(1.0, results[0].speed * speed),
            friction_power=sum(r.friction_power for r in results),
            stiffness=stiffness,
            damping=damping,
            speed=speed,
            converged=state.converged,
            residual=state.residual,
            iterations=state.iterations,
        )


def _in_frame(fields: dict[str, Any], view: Array) -> ConicalResult:
    """A result of one cone, whose loads are given in the frame of the pair, in its own frame."""
    back = np.linalg.inv(view).T
    own = back @ np.append(fields["force"], fields["moment"])
    pads = fields["pad_forces"] @ back[:3, :3].T
    inverse = np.linalg.inv(view)
    return ConicalResult(
        **fields
        | {
            "force": own[:3],
            "moment": own[3:],
            "pad_forces": pads,
            "stiffness_matrix": inverse.T @ fields["stiffness_matrix"] @ inverse,
            "damping_matrix": inverse.T @ fields["damping_matrix"] @ inverse,
        }
    )
