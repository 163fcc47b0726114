"""A shaft over a whole series on bearings with models of their own, some expensive to solve.

Shaft and bearings are iterated at chosen loads of the series, each the farthest from those before.
Between these an expensive bearing is its tangent, that is its load, motion and compliance,
interpolated; with it and the cheap bearings as they are the whole series is iterated. So forces
and moments balance everywhere. What is chosen next is predicted before it is solved: that is the
error, and more are chosen until it is small. Where all bearings are cheap nothing is interpolated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import reduce

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.former_names import renamed
from loadflow.shaft.elastic import BearingModel
from loadflow.shaft.options import Concept
from loadflow.shaft.reactions import bearing_loads
from loadflow.shaft.scattered import Rows, evened, farthest, interpolation, nearest

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

FIRST, MORE, MOST = 100, 50, 400
"""Loads solved on expensive bearings: at first, at a time, and at most."""

ACCURACY = 5e-3
"""Error of force, moment, displacement and tilt, over their largest values, that is enough."""

_CHUNK = 500  # loads iterated together
_AGREED = 1e-7  # relative change of a reaction in the last iteration
_LOST = 0.5  # share that must converge for more to be worth solving
_KEPT = ("force", "moment", "displacement", "tilt", "curvature", "bore_tilt")


@renamed(quick="cheap")
@dataclass(frozen=True)
class CoupledBearing:
    """A bearing that the shaft rests on, over a series of n samples.

    Attributes
    ----------
    model : callable
        From numbers of samples to the bearing's model under their loads; NaN without an answer.
    state : ndarray, shape (n,)
        What the bearing depends on beside its load across the shaft, such as the speed.
    idle : ndarray of bool, shape (n,)
        Samples in which it is not asked, as it can have no answer.
    cheap : bool
        Whether the model takes microseconds, so that all loads can be solved.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.shaft import CoupledBearing
    >>> def linear(force, moment):  # motion across the shaft and tilt (n, 4), stiffness (n, 4, 4)
    ...     stiffness = np.array([1e10, 1e10, 1e8, 1e8])
    ...     load = np.concatenate([force[:, 1:], moment[:, 1:]], axis=1)
    ...     return load / stiffness, np.broadcast_to(np.diag(stiffness), (len(load), 4, 4))
    >>> bearing = CoupledBearing(lambda rows: linear, state=np.zeros(2), idle=np.zeros(2,
    ...     dtype=bool))
    >>> bearing.model(np.arange(2))(np.full((2, 3), 1e6), np.zeros((2, 3)))[0][0].tolist()
    [0.0001, 0.0001, 0.0, 0.0]
    """

    model: Callable[[Rows], BearingModel]
    state: Floats
    idle: Flags
    cheap: bool = False


def coupled_loads(
    concept: Concept,
    hub_force: Floats,
    hub_moment: Floats,
    bearings: Mapping[str, CoupledBearing],
    *,
    tilt: float = 0.0,
    accuracy: float = ACCURACY,
) -> xr.Dataset:
    """Loads of the bearings of a long series, iterated with the bearings' own models.

    A sample to which a bearing has no answer, such as a film at standstill, is that of rigid
    bearings; among those not solved, the ones whose nearest solved sample has none.

    Parameters
    ----------
    concept : Concept
        The suspension, with a beam.
    hub_force, hub_moment : ndarray, shape (3, n)
        As for `bearing_loads`.
    bearings : mapping
        Bearings with models, by name.
    tilt : float
        Tilt of the shaft, rad.
    accuracy : float
        Error of the interpolation that is enough, relative.

    Returns
    -------
    xarray.Dataset
        As of `bearing_loads` with `models`, and the attributes `solved`, the number of samples
        solved with the bearings' own models, and `interpolation_error`, of the last of these before
        they were solved: of force, moment, displacement and tilt across the shaft, over their
        largest values; 0 where all are solved.

    Raises
    ------
    loadflow.errors.InputError
        As `bearing_loads`; a shaft without a beam.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.shaft import Beam, BearingSupport, CoupledBearing, ShaftSection, TwoPoint
    >>> from loadflow.shaft import coupled_loads
    >>> stiffness = np.diag([1e10, 1e10, 1e8, 1e8])  # N/m and N m/rad, of both directions
    >>> def linear(force, moment):
    ...     load = np.concatenate([force[:, 1:], moment[:, 1:]], axis=1)
    ...     return load / np.diag(stiffness), np.broadcast_to(stiffness, (len(load), 4, 4))
    >>> bearing = CoupledBearing(lambda rows: linear, state=np.zeros(2), idle=np.zeros(2,
    ...     dtype=bool))
    >>> supports = BearingSupport(stiffness="rolling", takes_moment=True), BearingSupport()
    >>> shaft = TwoPoint(beam=Beam((ShaftSection(1.0, 0.4),), supports))
    >>> force = np.array([[5e5, 5e5], [0.0, 0.0], [-1.0e6, -1.1e6]])
    >>> found = coupled_loads(shaft, force, np.zeros((3, 2)), {"N": bearing})
    >>> bool(found["converged"].all()), found["force"].sizes["bearing"]
    (True, 2)
    """
    if concept.beam is None:
        raise InputError("bearings: a rigid shaft does not feel them; give it a beam")
    on_rigid = replace(concept, beam=concept.beam.on_rigid_bearings())
    rigid = bearing_loads(on_rigid, hub_force, hub_moment, tilt=tilt)
    series = _Series(concept, hub_force, hub_moment, tilt, bearings)
    asked = np.flatnonzero(~np.any([bearing.idle for bearing in bearings.values()], axis=0))
    values, converged = _arrays(rigid), np.zeros(hub_force.shape[1], dtype=bool)
    attrs = rigid.attrs | {"solved": 0, "interpolation_error": 0.0}
    if asked.size:
        found, solved, error = series.carried(asked, accuracy)
        attrs = found.attrs | {"solved": solved, "interpolation_error": error}
        converged[asked] = found.converged
        values[converged] = found.values[found.converged]
    flags = np.broadcast_to(converged, (rigid.sizes["bearing"], converged.size)).copy()
    meaning = {"units": "1", "long_name": "whether shaft and bearings agree"}
    columns = zip(_KEPT, np.moveaxis(values, 0, -1))
    return rigid.assign(
        {name: rigid[name].copy(data=column) for name, column in columns}
        | {"converged": (("bearing", "time"), flags, meaning)}
    ).assign_attrs(attrs)


@dataclass(frozen=True)
class _Solved:
    """What was found of k samples.

    Attributes
    ----------
    values : ndarray, shape (k, 6, bearing, axis)
        What `_KEPT` names.
    converged : ndarray of bool, shape (k,)
        Whether shaft and bearings agree.
    attrs : dict
        How the iteration went at its worst.
    tangents : dict
        Load, motion and compliance of expensive bearings, (k, m), by name; NaN where not converged.
    """

    values: Floats
    converged: Flags
    attrs: dict[str, float]
    tangents: dict[str, Floats] = field(default_factory=dict)

    def joined(self, more: _Solved) -> _Solved:
        """Both together."""
        worst = {name: max(self.attrs[name], more.attrs[name]) for name in self.attrs}
        worst["converged"] = min(self.attrs["converged"], more.attrs["converged"])
        tangents = [name for name in self.tangents if name in more.tangents]
        return _Solved(
            np.concatenate([self.values, more.values]),
            np.concatenate([self.converged, more.converged]),
            worst,
            {n: np.concatenate([self.tangents[n], more.tangents[n]]) for n in tangents},
        )

    def off(self, truth: _Solved) -> float:
        """Largest error across the shaft of what both have, over the largest true value."""
        both = self.converged & truth.converged
        if not both.any():
            return np.inf
        ours, theirs = (_judged(part.values[both]) for part in (self, truth))
        off, size = (abs(part).max(axis=(0, 2, 3)) for part in (ours - theirs, theirs))
        return float(np.divide(off, size, out=np.zeros_like(off), where=size > 0).max())


def _judged(values: Floats) -> Floats:
    """What is to be right across the shaft: loads, motion, and the tilt in the bore."""
    tilt, bore = (values[:, [_KEPT.index(name)]] for name in ("tilt", "bore_tilt"))
    return np.concatenate([values[:, :4], tilt - bore], axis=1)[..., 1:]


@dataclass(frozen=True)
class _Series:
    """Loads of the hub over a series, and the bearings under it."""

    concept: Concept
    force: Floats
    moment: Floats
    tilt: float
    bearings: Mapping[str, CoupledBearing]

    def carried(self, rows: Rows, accuracy: float) -> tuple[_Solved, int, float]:
        """Result of `rows`, number of them solved exactly, error of the others."""
        costly = any(not bearing.cheap for bearing in self.bearings.values())
        if not costly or rows.size <= FIRST + MORE:
            return self.solve(rows, self.exact), rows.size, 0.0
        places = self.places(rows)
        order = farthest(places, MOST)
        count = min(FIRST, order.size)
        known, error = self.with_tangents(rows[order[:count]]), np.inf
        while count < order.size and error > accuracy and known.converged.mean() > _LOST:
            batch = order[count : count + MORE]
            more = self.with_tangents(rows[batch])
            if known.converged.sum() > 2 * places.shape[1]:
                tangents = self.between(rows, places, order[:count], known)
                error = self.solve(rows[batch], tangents).off(more)
            known, count = known.joined(more), count + batch.size
        return self.filled(rows, places, order[:count], known), count, error

    def filled(self, rows: Rows, places: Floats, chosen: Rows, known: _Solved) -> _Solved:
        """Result of `rows`, of which the `chosen` are known."""
        converged = known.converged[nearest(places, places[chosen])]
        values = np.zeros((rows.size, *known.values.shape[1:]))
        attrs = known.attrs
        if converged.any() and known.converged.sum() > 2 * places.shape[1]:
            rest = self.solve(rows[converged], self.between(rows, places, chosen, known))
            values[converged], attrs = rest.values, known.joined(rest).attrs
            converged[converged] = rest.converged
        values[chosen], converged[chosen] = known.values, known.converged
        return _Solved(values, converged, attrs)

    def places(self, rows: Rows) -> Floats:
        """Loads of the hub and states of the bearings, as far as they vary, (k, d)."""
        torque = 0 if self.concept.torque_support else 1
        # a matrix under the bearings turns thrust into tilt
        across = 0 if self.concept.beam and self.concept.beam.matrices else 1
        loads = [*self.force[across:], *self.moment[torque:]]
        states = [bearing.state for bearing in self.bearings.values()]
        return evened(np.stack([*loads, *states], axis=1)[rows])

    def exact(self, rows: Rows) -> dict[str, BearingModel]:
        """The bearings' own models."""
        return {name: bearing.model(rows) for name, bearing in self.bearings.items()}

    def with_tangents(self, rows: Rows) -> _Solved:
        """Result with the bearings' own models, and the tangents of the expensive ones."""
        found = self.solve(rows, self.exact)
        return replace(
            found,
            tangents={
                name: self._tangents(name, rows, found)
                for name, bearing in self.bearings.items()
                if not bearing.cheap
            },
        )

    def _tangents(self, name: str, rows: Rows, found: _Solved) -> Floats:
        good, place = np.flatnonzero(found.converged), self.concept.bearings.index(name)
        force, moment = found.values[good, :2, place].swapaxes(0, 1)
        motion, stiffness = self.bearings[name].model(rows[good])(force, moment)
        soft = np.linalg.inv(stiffness).reshape(good.size, stiffness.shape[-1] ** 2)
        known = np.concatenate([force[:, 1:], moment[:, 1:], motion, soft], axis=1)
        table = np.full((rows.size, known.shape[1]), np.nan)
        table[good] = known
        return table

    def between(
        self, rows: Rows, places: Floats, chosen: Rows, known: _Solved
    ) -> Callable[[Rows], dict[str, BearingModel]]:
        """Models for samples between the `chosen` ones: tangents of the expensive bearings."""
        good = known.converged
        found = {
            name: interpolation(places[chosen[good]], table[good])
            for name, table in known.tangents.items()
        }

        def models(some: Rows) -> dict[str, BearingModel]:
            at = places[np.searchsorted(rows, some)]
            return self.exact(some) | {name: _tangent(table(at)) for name, table in found.items()}

        return models

    def solve(self, rows: Rows, models: Callable[[Rows], dict[str, BearingModel]]) -> _Solved:
        """Shaft and bearings under the loads of `rows`, a chunk at a time."""
        parts = [rows[k : k + _CHUNK] for k in range(0, rows.size, _CHUNK)]
        return reduce(_Solved.joined, (self._solve(part, models(part)) for part in parts))

    def _solve(self, rows: Rows, models: dict[str, BearingModel]) -> _Solved:
        found = bearing_loads(
            self.concept,
            self.force[:, rows],
            self.moment[:, rows],
            tilt=self.tilt,
            models=models,
            tolerance=_AGREED,
            strict=False,
        )
        converged = found["converged"].values.astype(bool).all(axis=0)
        return _Solved(_arrays(found), np.asarray(converged), found.attrs)


def _tangent(table: Floats) -> BearingModel:
    """Model of a bearing about known loads (n, 4), motions (n, m) and compliances (n, m, m)."""
    size = 4 if table.shape[1] > 10 else 2
    known, motion, soft = table[:, :4], table[:, 4 : 4 + size], table[:, 4 + size :]
    compliance = soft.reshape(-1, size, size)
    stiffness = np.asarray(np.linalg.inv(compliance), dtype=float)

    def model(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
        more = (np.concatenate([force[:, 1:], moment[:, 1:]], axis=1) - known)[:, :size]
        return np.asarray(motion + np.einsum("nij,nj->ni", compliance, more)), stiffness

    return model


def _arrays(found: xr.Dataset) -> Floats:
    """What is kept of each sample, (n, 6, bearing, axis)."""
    return np.moveaxis(np.stack([found[name].values for name in _KEPT]), -1, 0).copy()
