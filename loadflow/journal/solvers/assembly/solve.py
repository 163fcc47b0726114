"""One shaft on several films: pads of a thrust bearing, segments of a cone, two cones.

The shaft is a rigid body of five degrees of freedom (x, y, z, rotations about x and y). Every film
sees them through a matrix of its own, and may lie on an elastic or tilting pad. Films, pads and
shaft are solved by one Newton iteration; pads are condensed out of each film's linearisation.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film import _kernels as kernel
from loadflow.journal.film.linearised import SingularFilm
from loadflow.journal.film.surface.film import SurfaceFilm
from loadflow.journal.solvers._newton_kernels import QUADRATIC, STEP_LIMIT
from loadflow.journal.solvers.assembly.balance import imbalance
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState, Member, MemberState
from loadflow.numerics.convergence import COARSEST, Limits, is_small
from loadflow.numerics.one_thread import on_one_thread

Array = NDArray[np.float64]

_SHIFTS = np.arange(3)
_LARGEST = 3.0  # factor of a pad's Newton step toward the pivot
_CYCLE = 10  # Newton steps after which half of them are halved, so that ruptures do not alternate
_ALONE = 4  # first steps in which a film that changes more is corrected with the shaft held
_FINEST = 1.0 / 64  # smallest load step
_STEPS = 40  # load steps at most
_SHORT = 15  # Newton steps of one load step
_SPENT = 150  # Newton steps after which an equilibrium is given up
_NOTHING = 1e-6  # share of the scale of pressure that is none
_NO_RESISTANCE = 1e-12  # share of the largest stiffness that is none
_PRESSED = 1e-12  # narrowest gap, in clearances, that is none


@dataclass(frozen=True)
class _Condensed:
    """Load and derivatives of a film whose pad has followed, in N, m, rad."""

    load: Array
    stiffness: Array
    damping: Array
    first: Array  # step of the pad with the shaft held
    follow: Array  # step of the pad by that of the shaft


@dataclass(frozen=True)
class Assembly:
    """Films around one shaft.

    Attributes
    ----------
    members : sequence of Member
        The films.
    length : float
        Length that makes a force of a moment, m.
    """

    members: Sequence[Member]
    length: float
    scale: Array = field(init=False)

    def __post_init__(self) -> None:
        arms = np.array([1.0, 1.0, 1.0, self.length, self.length])
        object.__setattr__(self, "scale", min(member.unit for member in self.members) / arms)

    def start(self, position: Array, pads: Sequence[Array] | None = None) -> AssemblyState:
        """Films at edge pressure around a shaft at `position`."""
        rest = [np.zeros(m.support.shape[0]) for m in self.members]
        members = tuple(
            MemberState(m.film.start(), pad) for m, pad in zip(self.members, pads or rest)
        )
        return AssemblyState(position, np.zeros(BODY), members)

    def wetted(self, state: AssemblyState) -> AssemblyState:
        """The same with films at edge pressure lifted a little: at the floor of a law they are
        full and ruptured at once, and have no stiffness.
        """
        members = []
        for member, own in zip(self.members, state.members):
            film = member.film
            empty = float(np.abs(own.u - film.start()).max()) < _NOTHING * film.scale
            members.append(replace(own, u=own.u + _NOTHING * film.scale) if empty else own)
        return replace(state, members=tuple(members))

    def narrowest(self, state: AssemblyState) -> float:
        """Narrowest gap, m."""
        return min(
            m.unit * m.film.gap.narrowest(m.place(s, state.position))
            for m, s in zip(self.members, state.members)
        )

    # --- derivatives -----------------------------------------------------------------------------
    def _condensed(self, member: Member, state: MemberState) -> _Condensed:
        """What the shaft feels of a film, once the pad has followed."""
        assert state.linear is not None
        load = member.unit * state.linear.load
        stiffness, damping = (
            member.unit * x for x in (state.linear.stiffness, state.linear.damping)
        )
        attached, by_pad = member.attached, member.by_pad
        if not by_pad.shape[1]:
            nothing = np.zeros((0, BODY))
            return _Condensed(
                attached.T @ load, attached.T @ stiffness @ attached,
                attached.T @ damping @ attached, np.zeros(0), nothing,
            )  # fmt: skip
        matrix = by_pad.T @ stiffness @ by_pad + member.support
        sizes = np.abs(by_pad).max(axis=0)

        def follow(rhs: Array) -> Array:
            scaled = matrix / np.outer(sizes, sizes)
            return np.asarray((_solve(scaled, (rhs.T / sizes).T).T / sizes).T)

        missing = by_pad.T @ load - member.support @ state.pad
        pressed = float(member.normal @ load)
        first = follow(missing)
        if pressed > 0.0 and not member.support.any():
            # the centre of pressure shall meet the pivot: a pad without film has no moment, either
            lost = member.normal @ stiffness @ by_pad
            share = float(lost @ first) / pressed
            first /= max(1.0 - share, 1.0 / _LARGEST)
        by_place = follow(by_pad.T @ stiffness @ attached)
        left = attached - by_pad @ by_place
        by_speed = follow(by_pad.T @ damping @ left)
        return _Condensed(
            attached.T @ (load - stiffness @ by_pad @ first),
            attached.T @ stiffness @ left,
            attached.T @ (damping @ left - stiffness @ by_pad @ by_speed),
            first,
            by_place,
        )

    def coefficients(
        self, state: AssemblyState, members: slice = slice(None)
    ) -> tuple[Array, Array]:
        """Stiffness and damping −∂F_film/∂q, −∂F_film/∂q̇ of the shaft, pads following (5, 5).

        Of all films, or of those `members` alone.
        """
        parts = [self._condensed(m, s) for m, s in zip(self.members, state.members)][members]
        return _sums(self.members[members], parts)[1:]

    def loads(self, state: AssemblyState) -> list[list[Array]]:
        """What the shaft applies to every pad of every film at a solved state, N, N m."""
        found = []
        for member, own in zip(self.members, state.members):
            place = member.place(own, state.position)
            load = member.unit * member.film.field(own.u, place)[3]
            found.append([turn.T @ member.attached.T @ load for turn in member.turns])
        return found

    # --- Newton ----------------------------------------------------------------------------------
    @on_one_thread
    def solve(
        self,
        state: AssemblyState,
        force: Array,
        free: NDArray[np.int64],
        limits: Limits,
    ) -> AssemblyState:
        """Films, pads and the degrees of freedom `free` of the shaft in balance with `force`.

        Parameters
        ----------
        state : AssemblyState
            Where to start; its velocity is kept.
        force : array (5,)
            What the shaft applies, N and N m.
        free : array of int
            Degrees of freedom that move; none: the films at a given position.
        limits : Limits
            Tolerance on the scaled residual, Newton steps.
        """
        most = max(m.film.newton_steps(limits.max_iterations) for m in self.members)
        residual, state = math.inf, replace(state, free=free)
        for iteration in range(1, most + 1):
            try:
                state = self._linearised(state)
                damped = iteration > _CYCLE and iteration % _CYCLE < _CYCLE // 2
                share = 0.5 if damped else 1.0
                state, change = self._step(state, force, free, iteration <= _ALONE, share)
            except (SingularFilm, np.linalg.LinAlgError, FloatingPointError):
                break
            if not math.isfinite(change):
                break
            if change < QUADRATIC and not damped:
                residual, level = imbalance(self.members, self.length, state, force, free)
                if is_small(residual, limits.tolerance, min(level, COARSEST)):
                    return replace(state, converged=True, iterations=iteration, residual=residual)
        return replace(state, converged=False, iterations=iteration, residual=residual)

    def _linearised(self, state: AssemblyState) -> AssemblyState:
        """The same with the films linearised."""
        members = []
        for member, own in zip(self.members, state.members):
            place = member.place(own, state.position)
            moving = member.sees @ state.velocity
            members.append(
                replace(
                    own, linear=member.film.linearise(own.u, place, moving, state.rate, own.old)
                )
            )
        return replace(state, members=tuple(members))

    def _step(
        self, state: AssemblyState, force: Array, free: NDArray[np.int64], alone: bool, share: float
    ) -> tuple[AssemblyState, float]:
        """One Newton step, as far as a film is left everywhere, and its size.

        The stiffness of a film that has no pressure yet is none: `alone` it is corrected first.
        """
        parts = [self._condensed(m, s) for m, s in zip(self.members, state.members)]
        load, stiffness, _ = _sums(self.members, parts)
        for member, own in zip(self.members, state.members):
            if member.film.gap.gaps(member.place(own, state.position)).min() < _PRESSED:
                return state, math.nan
        change = max(_change(m.film, s) for m, s in zip(self.members, state.members))
        limited, whole = min(1.0, STEP_LIMIT / max(change, 1e-300)), share
        if limited < 1.0 and alone:
            limited = 0.0
        step = np.zeros(BODY)
        if free.size:
            scale = self.scale[free]
            matrix = stiffness[np.ix_(free, free)] * np.outer(scale, scale)
            step[free] = limited * scale * _solve(matrix, scale * (force - load)[free])
        moves = []
        for member, own, part in zip(self.members, state.members, parts):
            pad = limited * part.first + part.follow @ (member.turns[0] @ step)
            move = member.sees @ step - member.by_pad @ pad
            share = min(share, member.film.gap.share(member.place(own, state.position), move))
            moves.append((pad, move))
        members, change = [], 1.0 if limited == 0.0 else 0.0
        for member, own, (pad, move) in zip(self.members, state.members, moves):
            gap = member.film.gap
            assert own.linear is not None
            weights = np.concatenate([[whole], share * move, np.zeros(gap.size)])
            u = own.u.copy()
            change = max(change, member.film.correct(u, own.linear.columns, weights))
            members.append(replace(own, u=u, pad=own.pad + share * pad))
            place = member.place(own, state.position)
            change = max(change, float(np.abs(share * move).max()) / gap.narrowest(place))
        position = state.position + share * step
        return replace(state, position=position, members=tuple(members)), change

    def equilibrium(
        self,
        starts: Sequence[AssemblyState],
        force: Array,
        free: NDArray[np.int64],
        limits: Limits,
    ) -> AssemblyState:
        """Equilibrium by Newton from each of `starts`, then by load steps from each."""
        spent = 0
        found = starts[0]
        tilts = free.size > _SHIFTS.size
        for start in starts:  # without the moment first, at the given tilt
            found = self.solve(start, force, _SHIFTS if tilts else free, limits)
            spent += found.iterations
            if found.converged and tilts:
                found = self._in_load_steps(found, force, free, limits, spent, 1.0)
                spent = found.iterations
            if found.converged or spent > _SPENT:
                return replace(found, iterations=spent)
        for start in starts:
            held = self.solve(start, force, np.array([], dtype=np.int64), limits)
            spent += held.iterations
            if held.converged:
                found = self._in_load_steps(held, force, free, limits, spent, 0.25)
                spent = found.iterations
                if found.converged or spent > _SPENT:
                    break
        return replace(found, iterations=spent)

    def _in_load_steps(
        self,
        state: AssemblyState,
        force: Array,
        free: NDArray[np.int64],
        limits: Limits,
        spent: int,
        step: float,
    ) -> AssemblyState:
        """From the load that `state` carries to `force` in steps that Newton can follow."""
        first = np.sum([load for pads in self.loads(state) for load in pads], axis=0)
        done, residual = 0.0, state.residual
        short = replace(limits, max_iterations=_SHORT)
        for _ in range(_STEPS):
            at = min(1.0, done + step)
            trial = self.solve(state, first + at * (force - first), free, short)
            residual = trial.residual
            spent += trial.iterations
            if trial.converged:
                state, done, step = trial, at, 2.0 * step
                if done >= 1.0:
                    return replace(state, iterations=spent)
            else:
                step *= 0.5
            if step < _FINEST or spent > _SPENT:
                break
        return replace(state, converged=False, iterations=spent, residual=residual)


def _sums(members: Sequence[Member], parts: Sequence[_Condensed]) -> tuple[Array, Array, Array]:
    """Load, stiffness and damping of `members`; pads that share a film are turned copies."""
    load, stiffness, damping = np.zeros(BODY), np.zeros((BODY, BODY)), np.zeros((BODY, BODY))
    for member, part in zip(members, parts):
        for turn in member.turns:
            load += turn.T @ part.load
            stiffness += turn.T @ part.stiffness @ turn
            damping += turn.T @ part.damping @ turn
    return load, stiffness, damping


def _change(film: SurfaceFilm, state: MemberState) -> float:
    """Size of the Newton step of a film over the pressure to which it leads."""
    assert state.linear is not None
    step = state.linear.columns[0]
    flat = np.empty_like(step)
    kernel.gather(state.u, film.mesh.order, flat)
    peak = float(np.abs(flat - step - film.p_edge).max())
    return float(np.abs(step).max()) / max(peak, 1e-12 * film.scale)


def _solve(matrix: Array, rhs: Array) -> Array:
    """Solve a small system; a motion that meets no resistance but that of rounding is none."""
    return np.asarray(np.linalg.lstsq(matrix, rhs, rcond=_NO_RESISTANCE)[0])


def raise_not_converged(head: str, state: AssemblyState, narrowest: float) -> None:
    """Say with numbers why there is no answer."""
    loose = any(m.pad.size for m in state.members)
    hint = "; a pad that carries nothing stays in place only with tilt_stiffness" if loose else ""
    raise SolverError(
        f"{head}: no equilibrium found; residual {state.residual:.3g} after {state.iterations} "
        f"Newton steps, narrowest film {narrowest:.3g} m{hint}"
    )
