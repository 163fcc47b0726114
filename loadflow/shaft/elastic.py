"""Reactions of an elastic shaft on elastic bearings, and its tilt in them.

Reactions that fulfil equilibrium leave as many free as the suspension is statically indeterminate;
among these the bearings and the shaft take those that they deform alike under (Menabrea). So
equilibrium holds exactly, whatever the stiffness, and rigid bearings are no special case.

Each support has up to four components: forces along y and z with the displacements (v, w), and
moments with the slopes (v′, w′) = (θz, −θy): that is (Fy, Fz, Mz, −My).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import Convergence, rounding_level
from loadflow.shaft.beam import Beam, BearingSupport
from loadflow.shaft.flexibility import Stations, curvature, flexibility

Floats = NDArray[np.float64]

BearingModel = Callable[[Floats, Floats], tuple[Floats, Floats]]
"""What a bearing does under `force` and `moment`, (n, 3), N and N m, of the shaft on it: the
displacement of the shaft (y, z, θy, θz), (n, 4), m and rad, and the stiffness at it in the same
order, (n, 4, 4). A bearing that takes no moment may give (n, 2) and (n, 2, 2). A load without an
answer has NaN."""

_TURN = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1], [0, 0, -1, 0]], dtype=float)
"""From (y, z, θy, θz) to (v, w, v′, w′)."""
_OF_BORE = np.zeros((4, 6))
_OF_BORE[:, [1, 2, 4, 5]] = _TURN
"""From (x, y, z, θx, θy, θz) to (v, w, v′, w′)."""
_ITERATIONS = 50
_STUCK = 2.0**-7  # share of a step that is none
_FREE = 1e6  # over the flexibility of the shaft: a support that hardly takes a moment


@dataclass(frozen=True)
class ShaftMotion:
    """Reactions of the supports and motion of the shaft in them, all (bearing, axis, n).

    Attributes
    ----------
    force, moment : ndarray
        What the shaft applies to each bearing, N and N m; zero along x.
    displacement, tilt : ndarray
        Of the shaft, m and rad.
    curvature : ndarray
        Second derivative of the displacement along the shaft, 1/m.
    bore_tilt : ndarray
        Of the bearings' bores, as housings and frame turn under all loads, rad.
    convergence : Convergence
        Of the iteration with the bearings' own models; the residual is the largest change of a
        reaction, relative to the largest reaction.
    converged : ndarray of bool, shape (n,)
        Of which loads shaft and bearings agree.
    """

    force: Floats
    moment: Floats
    displacement: Floats
    tilt: Floats
    curvature: Floats
    bore_tilt: Floats
    convergence: Convergence
    converged: NDArray[np.bool_]


@dataclass(frozen=True)
class Iteration:
    """How far shaft and bearing models are iterated.

    Attributes
    ----------
    tolerance : float
        Largest change of a reaction, relative to the largest one.
    strict : bool
        Raise for the first load that does not converge; else flag it.
    """

    tolerance: float = 1e-10
    strict: bool = True


def elastic_reactions(
    beam: Beam,
    positions: tuple[float, ...],
    locating: int,
    places: Floats,
    forces: Floats,
    hub_moment: Floats,
    models: Mapping[int, BearingModel],
    iteration: Iteration,
) -> ShaftMotion:
    """Solve the shaft under all loads; thrust moves what carries the bearings.

    Parameters
    ----------
    beam : Beam
        Shaft and supports.
    positions : tuple of float
        Of the bearings, m from the hub centre.
    locating : int
        Number of the bearing that takes the force along the shaft.
    places : ndarray, shape (p,)
        Where forces act, m from the hub centre.
    forces : ndarray, shape (p, 3, n)
        What acts on the shaft there, N.
    hub_moment : ndarray, shape (3, n)
        At the hub centre, N m.
    models : mapping of int
        Models of bearings by number; they replace `radial` and `tilt` of their supports.
    iteration : Iteration
        How far shaft and models are iterated.

    Raises
    ------
    loadflow.errors.InputError
        Supports or sections do not fit the shaft; a model gives arrays of another shape.
    loadflow.errors.SolverError
        A bearing without stiffness; the iteration with the models does not converge.
    """
    line = EquationsOf(beam, positions, locating, places, forces, hub_moment)
    return line.motion(*line.equations.solve(line.supports, models, iteration))


class EquationsOf:
    """The equations of a shaft under all loads, and its motion by what solves them.

    Parameters
    ----------
    beam, positions, locating, places, forces, hub_moment
        As of `elastic_reactions`.
    whole : bool
        Whether every support has four components, also where it takes no moment.
    """

    def __init__(
        self,
        beam: Beam,
        positions: tuple[float, ...],
        locating: int,
        places: Floats,
        forces: Floats,
        hub_moment: Floats,
        whole: bool = False,
    ) -> None:
        count, bearings = len(places), len(positions)
        self.beam, self.positions, self.supports = beam, positions, beam.supports_of(bearings)
        end = self.end = max(*positions, *places)
        kinds = np.repeat([False, True, False, True], [count, 1, bearings, bearings])
        line = self.line = Stations(np.concatenate([places, [0.0], positions, positions]), kinds)
        flexible, rigid = flexibility(beam, line, end), line.rigid(end)
        self.flexible, self.rigid = flexible, rigid
        # the two planes (v, v′) and (w, w′) in turn: (plane, station, n)
        loads = self.loads = np.zeros((2, line.place.size, forces.shape[2]))
        loads[0, :count], loads[0, count] = forces[:, 1], hub_moment[2]
        loads[1, :count], loads[1, count] = forces[:, 2], -hub_moment[1]

        parts = [
            (k, c)
            for k, support in enumerate(self.supports)
            for c in range(4 if whole or support.takes_moment else 2)
        ]
        support, component = np.array(parts).T
        station, plane = count + 1 + support + bearings * (component // 2), component % 2
        self.station, self.plane, self.first = station, plane, count + 1
        turn = np.repeat([[0, 1]], 2, axis=1) == plane[:, None]
        arms = np.where(turn, np.tile(rigid[station], 2), 0)
        # the force along the shaft moves housings and frame as well, and no reaction moves it
        soft, thrust = beam.compliance_of_bores(bearings), forces[:, 0].sum(axis=0)
        bore = np.zeros((support.size, 6 * bearings))
        bore.reshape(-1, bearings, 6)[np.arange(support.size), support] = _OF_BORE[component]
        self.soft, self.bore, self.pushed = soft, bore, np.outer(soft[:, 6 * locating], thrust)
        self.equations = Redundant(
            support=support,
            component=component,
            unit=np.where(component < 2, 1.0, end),
            arms=arms,
            due=np.concatenate([rigid.T @ side for side in loads]),
            bent=np.where(plane[:, None] == plane, flexible[np.ix_(station, station)], 0.0),
            free=np.einsum("rk,rkn->rn", flexible[station], loads[plane]),
            housing=bore @ soft @ bore.T,
            pushed=bore @ self.pushed,
        )

    def motion(
        self,
        reaction: Floats,
        base: Floats,
        convergence: Convergence,
        converged: NDArray[np.bool_],
    ) -> ShaftMotion:
        """Motion by reactions (r, n) and that of the shaft's end, (4, n)."""
        bearings, rows, loads = len(self.positions), self.equations, self.loads.copy()
        loads[self.plane, self.station] -= reaction
        moved = self.flexible @ loads + self.rigid @ base.reshape(2, 2, -1)
        at = np.arange(self.first, self.first + bearings)
        reactions = np.zeros((bearings, 4, loads.shape[2]))
        reactions[rows.support, rows.component] = reaction
        motion = np.concatenate([moved[:, at], moved[:, at + bearings]]).swapaxes(0, 1)
        places = np.array(self.positions)
        bow = curvature(self.beam, self.line, loads, places, self.end).swapaxes(0, 1)
        bow = np.concatenate([bow, np.zeros_like(bow)], axis=1)
        turned = (self.soft @ self.bore.T @ reaction + self.pushed).reshape(bearings, 6, -1)[:, 3:]
        return ShaftMotion(
            *_across(reactions), *_across(motion), _across(bow)[0], turned, convergence, converged
        )


def _across(full: Floats) -> tuple[Floats, Floats]:
    """(b, 4, n) by components of the supports as vectors across and about, (b, axis, n)."""
    along, about = np.zeros((2, full.shape[0], 3, full.shape[2]))
    along[:, 1:] = full[:, :2]
    about[:, 1], about[:, 2] = -full[:, 3], full[:, 2]
    return along, about


@dataclass(frozen=True)
class Redundant:
    """Equations of the reactions, one row for each component of each support.

    Attributes
    ----------
    support, component : ndarray of int, shape (r,)
        What the rows are.
    unit : ndarray, shape (r,)
        That makes forces of moments: their length, m, else 1.
    arms : ndarray, shape (r, 4)
        Motion of the supports by a unit motion of the rigid shaft.
    due : ndarray, shape (4, n)
        What the reactions must balance.
    bent : ndarray, shape (r, r)
        Motion by bending under unit reactions of the shaft on the supports, turned around.
    free : ndarray, shape (r, n)
        Motion by bending under the loads alone.
    housing : ndarray, shape (r, r)
        Compliance of housings and frame.
    pushed : ndarray, shape (r, n)
        Motion of housings and frame by the force along the shaft.
    """

    support: NDArray[np.int64]
    component: NDArray[np.int64]
    unit: Floats
    arms: Floats
    due: Floats
    bent: Floats
    free: Floats
    housing: Floats
    pushed: Floats

    def solve(
        self,
        supports: tuple[BearingSupport, ...],
        models: Mapping[int, BearingModel],
        iteration: Iteration,
    ) -> tuple[Floats, Floats, Convergence, NDArray[np.bool_]]:
        """Reactions (r, n), motion of the shaft's end (4, n), how the iteration went, and where."""
        own = self._compliance(supports)
        bearings = _Bearings(self, models, own)
        # a model that takes a moment starts nearly without: bearings harden, and a step from the
        # soft side never goes too far
        asked = np.isin(self.support, list(models)) & (self.component > 1) & (own == 0)
        first = own + np.where(asked, _FREE * np.diag(self.bent), 0.0)
        compliance, offset = (self.housing + np.diag(first))[None], self.pushed
        reaction = self._balance(compliance, offset)
        converged, convergence = np.ones(self.free.shape[1], dtype=bool), Convergence(True, 0.0, 0)
        if models:
            reaction, compliance, offset, converged, convergence = self._iterated(
                bearings, reaction, iteration
            )
        deflected = np.einsum("nrs,sn->rn", compliance, reaction) + offset
        rest = deflected - self.free + self.bent @ reaction
        base = np.linalg.lstsq(self.arms, rest, rcond=None)[0]
        return reaction, base, convergence, converged

    def _iterated(
        self, bearings: _Bearings, reaction: Floats, iteration: Iteration
    ) -> tuple[Floats, Floats, Floats, NDArray[np.bool_], Convergence]:
        """Newton's method from `reaction` on; a load's step is halved until its gap narrows."""
        compliance, offset = bearings.tangent(reaction)
        gape, step = self._open(compliance, offset, reaction), np.ones(reaction.shape[1])
        for iterations in range(1, _ITERATIONS + 1):  # noqa: B007  told at the end
            target = self._balance(compliance, offset)
            size = float((abs(reaction) / self.unit[:, None]).max()) or 1.0
            change = (abs(target - reaction) / self.unit[:, None]).max(axis=0) / size
            answered = np.isfinite(offset).all(axis=0)
            level = self._rounding(compliance, offset, reaction)
            converged = answered & ((change < iteration.tolerance) | (gape <= level))
            moving = answered & ~converged & (step > _STUCK)
            if not moving.any():
                break
            trial = np.where(moving, reaction + step * (target - reaction), reaction)
            softer, moved = bearings.tangent(trial)
            left = self._open(softer, moved, trial)
            nearer = moving & (left < gape)
            reaction = np.where(nearer, trial, reaction)
            compliance = np.where(nearer[:, None, None], softer, compliance)
            offset, gape = np.where(nearer, moved, offset), np.where(nearer, left, gape)
            step = np.where(moving, np.where(nearer, np.minimum(2 * step, 1.0), step / 2), step)
        worst = float(np.nan_to_num(change, nan=np.inf).max())
        if iteration.strict and not converged.all():
            first = int(np.argmin(converged))
            raise SolverError(
                f"shaft and bearings do not converge: after {iterations} iterations the reactions "
                f"still change by {worst:.1e}; load {first} is the first, where they gape by "
                f"{gape[first]:.3g} m and rounding allows {level[first]:.3g} m"
            )
        convergence = Convergence(bool(converged.all()), worst, iterations)
        return np.where(converged, target, reaction), compliance, offset, converged, convergence

    def _open(self, compliance: Floats, offset: Floats, reaction: Floats) -> Floats:
        """How far shaft and supports gape (n,), m."""
        own = self._own()
        apart = np.einsum("nrs,sn->rn", self.bent + compliance, reaction) + offset - self.free
        return np.asarray(np.hypot.reduce(own.T @ apart, axis=0, initial=0.0))

    def _rounding(self, compliance: Floats, offset: Floats, reaction: Floats) -> Floats:
        """Level of rounding of `_open` (n,), m: that of the terms that it adds."""
        moved = np.einsum("nrs,sn->rn", np.abs(self.bent + compliance), np.abs(reaction))
        terms = np.abs(self._own()).T @ (moved + np.abs(offset) + np.abs(self.free))
        return np.asarray(rounding_level(np.hypot.reduce(terms, axis=0, initial=0.0)))

    def _own(self) -> Floats:
        """Sets of reactions in equilibrium by themselves, (r, sets)."""
        turn = np.linalg.qr(self.unit[:, None] * self.arms, mode="complete")[0]
        return self.unit[:, None] * turn[:, 4:]

    def _balance(self, compliance: Floats, offset: Floats) -> Floats:
        """Reactions in equilibrium under which shaft and supports deform alike."""
        turn, corner = np.linalg.qr(self.unit[:, None] * self.arms, mode="complete")
        needed = self.unit[:, None] * (turn[:, :4] @ np.linalg.solve(corner[:4].T, self.due))
        own = self._own()
        if not own.size:
            return needed
        total = self.bent + compliance
        gap = self.free - offset - np.einsum("nrs,sn->rn", total, needed)
        share = np.linalg.solve(own.T @ total @ own, (own.T @ gap).T[..., None])
        return needed + own @ share[..., 0].T

    def _compliance(self, supports: tuple[BearingSupport, ...]) -> Floats:
        """Of the bearings without a model (r,)."""
        stiffness = [
            getattr(supports[k], _BEARING[c]) for k, c in zip(self.support, self.component)
        ]
        return np.array([0.0 if k is None else 1 / k for k in stiffness])


@dataclass(frozen=True)
class _Bearings:
    """Supports, some of them with models.

    Attributes
    ----------
    rows : Redundant
        What the components of the supports are.
    models : mapping of int
        Models of bearings by number.
    own : ndarray, shape (r,)
        Compliance of bearings without a model.
    """

    rows: Redundant
    models: Mapping[int, BearingModel]
    own: Floats

    def tangent(self, reaction: Floats) -> tuple[Floats, Floats]:
        """Compliance (n, r, r) of the supports and their motion (r, n) at zero load, linearised."""
        compliance = np.repeat(np.diag(self.own)[None], reaction.shape[1], axis=0)
        offset = np.zeros_like(reaction)
        for number, model in self.models.items():
            rows = np.flatnonzero(self.rows.support == number)
            full = np.zeros((1, 4, reaction.shape[1]))
            full[0, self.rows.component[rows]] = reaction[rows]
            force, moment = (part[0].T for part in _across(full))
            motion, soft = _ask(model, force, moment, number, rows.size)
            compliance[:, rows[:, None], rows] = soft
            offset[rows] = (motion - np.einsum("nrs,sn->nr", soft, reaction[rows])).T
        return self.rows.housing + compliance, self.rows.pushed + offset


_BEARING = ("radial", "radial", "tilt", "tilt")


def _ask(
    model: BearingModel, force: Floats, moment: Floats, number: int, size: int
) -> tuple[Floats, Floats]:
    """Motion (n, size) and compliance (n, size, size) of a bearing, in the supports' components."""
    motion, stiffness = (np.asarray(part, dtype=float) for part in model(force, moment))
    n, given = force.shape[0], motion.shape[-1]
    if given not in (2, 4) or given < size or motion.shape != (n, given):
        raise InputError(
            f"model of bearing {number}: a displacement of shape ({n}, {size}) is needed, "
            f"got {motion.shape}"
        )
    if stiffness.shape != (n, given, given):
        raise InputError(
            f"model of bearing {number}: a stiffness of shape ({n}, {given}, {given}) is needed, "
            f"got {stiffness.shape}"
        )
    turn = _TURN[:given, :given]
    try:
        soft = np.linalg.inv(turn @ stiffness @ turn.T)
    except np.linalg.LinAlgError as error:
        raise SolverError(f"model of bearing {number}: a stiffness that is singular") from error
    return (motion @ turn.T)[:, :size], soft[:, :size, :size]
