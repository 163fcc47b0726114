"""Reactions of an elastic shaft on elastic bearings, and how it leans in them.

Reactions that fulfil equilibrium leave as many free as the suspension is statically indeterminate;
among these the bearings and the shaft take those that they deform alike under (Menabrea). So
equilibrium holds exactly, whatever the stiffness, and rigid bearings are no special case.

Each seat has up to four components: forces along y and z with the displacements (v, w), and
moments with the slopes (v′, w′) = (θz, −θy): that is (Fy, Fz, Mz, −My).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import Convergence
from loadflow.shaft.beam import Beam, BearingSeat
from loadflow.shaft.flexibility import Stations, curvature, flexibility

Floats = NDArray[np.float64]

BearingModel = Callable[[Floats, Floats], tuple[Floats, Floats]]
"""What a bearing does under `force` and `moment`, (n, 3), N and N m, of the shaft on it: the
displacement of the shaft (y, z, θy, θz), (n, 4), m and rad, and the stiffness at it in the same
order, (n, 4, 4). A bearing that takes no moment may give (n, 2) and (n, 2, 2)."""

_TURN = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1], [0, 0, -1, 0]], dtype=float)
"""From (y, z, θy, θz) to (v, w, v′, w′)."""
_TOLERANCE, _ITERATIONS = 1e-10, 50


@dataclass(frozen=True)
class Leaning:
    """Reactions of the seats and motion of the shaft in them, all (bearing, axis, n).

    Attributes
    ----------
    force, moment : ndarray
        What the shaft applies to each bearing, N and N m; zero along x.
    displacement, tilt : ndarray
        Of the shaft, m and rad.
    curvature : ndarray
        Second derivative of the displacement along the shaft, 1/m.
    convergence : Convergence
        Of the iteration with the bearings' own models; the residual is the largest change of a
        reaction, relative to the largest reaction.
    """

    force: Floats
    moment: Floats
    displacement: Floats
    tilt: Floats
    curvature: Floats
    convergence: Convergence


def lean(
    beam: Beam,
    positions: tuple[float, ...],
    places: Floats,
    forces: Floats,
    hub_moment: Floats,
    models: Mapping[int, BearingModel],
) -> Leaning:
    """Solve the shaft under loads across it.

    Parameters
    ----------
    beam : Beam
        Shaft and seats.
    positions : tuple of float
        Of the bearings, m from the hub centre.
    places : ndarray, shape (p,)
        Where forces act, m from the hub centre.
    forces : ndarray, shape (p, 3, n)
        What acts on the shaft there, N.
    hub_moment : ndarray, shape (3, n)
        At the hub centre, N m.
    models : mapping of int
        Models of bearings by number; they replace `radial` and `tilt` of their seats.

    Raises
    ------
    loadflow.errors.InputError
        Seats or sections do not fit the shaft; a model gives arrays of another shape.
    loadflow.errors.SolverError
        A bearing without stiffness; the iteration with the models does not converge.
    """
    count, bearings = len(places), len(positions)
    seats = beam.seats_of(bearings)
    end = max(*positions, *places)
    kinds = np.repeat([False, True, False, True], [count, 1, bearings, bearings])
    line = Stations(np.concatenate([places, [0.0], positions, positions]), kinds)
    flexible, rigid = flexibility(beam, line, end), line.rigid(end)
    # the two planes (v, v′) and (w, w′) in turn: (plane, station, n)
    loads = np.zeros((2, line.place.size, forces.shape[2]))
    loads[0, :count], loads[0, count] = forces[:, 1], hub_moment[2]
    loads[1, :count], loads[1, count] = forces[:, 2], -hub_moment[1]

    parts = [(k, c) for k, seat in enumerate(seats) for c in range(4 if seat.takes_moment else 2)]
    seat, component = np.array(parts).T
    station, plane = count + 1 + seat + bearings * (component // 2), component % 2
    arms = np.where(np.repeat([[0, 1]], 2, axis=1) == plane[:, None], np.tile(rigid[station], 2), 0)
    redundant = _Redundant(
        seat=seat,
        component=component,
        unit=np.where(component < 2, 1.0, end),
        arms=arms,
        due=np.concatenate([rigid.T @ side for side in loads]),
        bent=np.where(plane[:, None] == plane, flexible[np.ix_(station, station)], 0.0),
        free=np.einsum("rk,rkn->rn", flexible[station], loads[plane]),
    )
    reaction, base, convergence = redundant.solve(seats, models)

    loads[plane, station] -= reaction
    moved = flexible @ loads + rigid @ base.reshape(2, 2, -1)
    at = np.arange(count + 1, count + 1 + bearings)
    reactions = np.zeros((bearings, 4, forces.shape[2]))
    reactions[seat, component] = reaction
    motion = np.concatenate([moved[:, at], moved[:, at + bearings]]).swapaxes(0, 1)
    bow = curvature(beam, line, loads, np.array(positions), end).swapaxes(0, 1)
    bow = np.concatenate([bow, np.zeros_like(bow)], axis=1)
    return Leaning(*_across(reactions), *_across(motion), _across(bow)[0], convergence)


def _across(full: Floats) -> tuple[Floats, Floats]:
    """(b, 4, n) in the order of the seats' components as vectors across and about, (b, axis, n)."""
    along, about = np.zeros((2, full.shape[0], 3, full.shape[2]))
    along[:, 1:] = full[:, :2]
    about[:, 1], about[:, 2] = -full[:, 3], full[:, 2]
    return along, about


@dataclass(frozen=True)
class _Redundant:
    """Equations of the reactions, one row for each component of each seat.

    Attributes
    ----------
    seat, component : ndarray of int, shape (r,)
        What the rows are.
    unit : ndarray, shape (r,)
        That makes forces of moments: their length, m, else 1.
    arms : ndarray, shape (r, 4)
        Motion of the seats by a unit motion of the rigid shaft.
    due : ndarray, shape (4, n)
        What the reactions must balance.
    bent : ndarray, shape (r, r)
        Motion by bending under unit reactions of the shaft on the seats, turned around.
    free : ndarray, shape (r, n)
        Motion by bending under the loads alone.
    """

    seat: NDArray[np.int64]
    component: NDArray[np.int64]
    unit: Floats
    arms: Floats
    due: Floats
    bent: Floats
    free: Floats

    def solve(
        self, seats: tuple[BearingSeat, ...], models: Mapping[int, BearingModel]
    ) -> tuple[Floats, Floats, Convergence]:
        """Reactions (r, n), motion of the shaft's end (4, n), and how the iteration went."""
        housings = np.diag(self._compliance(seats, _HOUSING))[None]
        springs = np.diag(self._compliance(seats, _BEARING))[None]
        compliance, offset = housings + springs, np.zeros_like(self.free)
        reaction = self._balance(compliance, offset)
        change, iterations = 0.0, 0
        while models:
            tangent, offset = self._tangent(models, springs[0], reaction)
            compliance = housings + tangent
            last, reaction = reaction, self._balance(compliance, offset)
            change = float((abs(reaction - last) / self.unit[:, None]).max())
            change /= float((abs(reaction) / self.unit[:, None]).max()) or 1.0
            iterations += 1
            if change < _TOLERANCE:
                break
            if iterations == _ITERATIONS or not np.isfinite(change):
                raise SolverError(
                    f"shaft and bearings do not settle: after {iterations} iterations the "
                    f"reactions still change by {change:.1e}"
                )
        seated = np.einsum("nrs,sn->rn", compliance, reaction) + offset
        rest = seated - self.free + self.bent @ reaction
        base = np.linalg.lstsq(self.arms, rest, rcond=None)[0]
        return reaction, base, Convergence(True, change, iterations)

    def _balance(self, compliance: Floats, offset: Floats) -> Floats:
        """Reactions in equilibrium under which shaft and seats deform alike."""
        turn, corner = np.linalg.qr(self.unit[:, None] * self.arms, mode="complete")
        needed = self.unit[:, None] * (turn[:, :4] @ np.linalg.solve(corner[:4].T, self.due))
        own = self.unit[:, None] * turn[:, 4:]  # sets of reactions in equilibrium by themselves
        if not own.size:
            return needed
        total = self.bent + compliance
        gap = self.free - offset - np.einsum("nrs,sn->rn", total, needed)
        share = np.linalg.solve(own.T @ total @ own, (own.T @ gap).T[..., None])
        return needed + own @ share[..., 0].T

    def _compliance(self, seats: tuple[BearingSeat, ...], names: tuple[str, ...]) -> Floats:
        stiffness = [getattr(seats[k], names[c]) for k, c in zip(self.seat, self.component)]
        return np.array([0.0 if k is None else 1 / k for k in stiffness])

    def _tangent(
        self, models: Mapping[int, BearingModel], springs: Floats, reaction: Floats
    ) -> tuple[Floats, Floats]:
        """Compliance (n, r, r) of the bearings and their motion at zero load, linearised."""
        compliance = np.repeat(springs[None], reaction.shape[1], axis=0)
        offset = np.zeros_like(reaction)
        for number, model in models.items():
            rows = np.flatnonzero(self.seat == number)
            full = np.zeros((1, 4, reaction.shape[1]))
            full[0, self.component[rows]] = reaction[rows]
            force, moment = (part[0].T for part in _across(full))
            motion, soft = _ask(model, force, moment, number, rows.size)
            compliance[:, rows[:, None], rows] = soft
            offset[rows] = (motion - np.einsum("nrs,sn->nr", soft, reaction[rows])).T
        return compliance, offset


_BEARING = ("radial", "radial", "tilt", "tilt")
_HOUSING = ("housing_lateral", "housing_vertical", "housing_tilt", "housing_tilt")


def _ask(
    model: BearingModel, force: Floats, moment: Floats, number: int, size: int
) -> tuple[Floats, Floats]:
    """Motion (n, size) and compliance (n, size, size) of a bearing, in the seats' components."""
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
