"""Growth of a gap by the temperatures of its surfaces: a ring around a shaft, order by order.

The lowest orders, which move the bore most, are those of a ring as wide as the bearing, by finite
elements (`warm_cylinder`): what is warm at one place along the axis moves the bore over about the
thickness of the wall. Of the others, which reach no farther than a wave, each slice is by itself.

A slice of radii a and b has the temperature cos nφ at its bore and gives off heat outside. In its
wall the temperature is harmonic, A r^n + B r^−n. The displacement is that of plane stress: the
gradient of a potential Φ, ∇²Φ = (1 + ν) α T, and of each order what makes the bore free of traction
and the outside free or fixed, from the functions of Muskhelishvili,
2 μ (u + i v) = κ φ − z φ̄' − ψ̄ with φ, ψ ∝ z^m [Boley and Weiner 1960; Timoshenko and Goodier 1970].
A free ring bends without stress by its orders from 2 on:
u/(α a T_n) = (A a^n/(n + 1) − B a^−n/(n − 1))/(A a^n + B a^−n), −1/(n² − 1) of a thin one.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.heat.warm_cylinder import bore_growth
from loadflow.journal.heat import FilmHeat, RingGrowth
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

OPEN = math.pi / 4
"""Largest part of the ring, rad, along which there may be no film."""

_NO_ARC = 1e-9  # rad
_TOGETHER = 8  # highest order of which the slices move each other

RUNS_ROUND = "None but where a film runs round, which warms the ring"
"""Growth that is allowed elsewhere."""


class _Motion(NamedTuple):
    """Displacement of an order at one radius, radial and around, and its slopes there."""

    u: float
    v: float
    du: float
    dv: float


def _power(s: float, u: float, v: float, x: float, unit: float) -> _Motion:
    """Of (u, v) (x/unit)^s."""
    size, slope = (x / unit) ** s, s / x
    return _Motion(u * size, v * size, slope * u * size, slope * v * size)


def _free_motions(n: int, kappa: float, x: float, outer: float) -> list[_Motion]:
    """Motions of an order that need no heat, at the radius `x`, that of the bore being 1."""
    if n == 0:
        return [_power(1, 1, 0, x, outer), _power(-1, 1, 0, x, 1)]
    motions = [
        _power(n - 1, 1, -1, x, outer),
        _power(-n - 1, 1, 1, x, 1),
        _power(n + 1, kappa - n - 1, kappa + n + 1, x, outer),
    ]
    if n > 1:
        return [*motions, _power(1 - n, kappa + n - 1, n - 1 - kappa, x, 1)]
    log = 2 * kappa * math.log(x)
    return [*motions, _Motion(log - 1, -log - 1, 2 * kappa / x, -2 * kappa / x)]


def _heated(n: int, rising: float, falling: float, x: float, outer: float) -> tuple[float, _Motion]:
    """Temperature rising (x/outer)^n + falling x^−n (n = 0: falling ln x) and ∇Φ of ∇²Φ = T."""
    log = math.log(x)
    if n == 0:
        warm = rising + falling * log
        u = rising * x / 2 + falling * x * (2 * log - 1) / 4
        return warm, _Motion(u, 0.0, rising / 2 + falling * (2 * log + 1) / 4, 0.0)
    unit = rising * outer / (4 * (n + 1))  # (x/outer)^n, its motion (x/outer)^(n + 1)
    first = _power(n + 1, (n + 2) * unit, -n * unit, x, outer)
    warm = rising * (x / outer) ** n + falling * x**-n
    if n > 1:
        unit = falling / (4 * (1 - n))
        second = _power(1 - n, (2 - n) * unit, -n * unit, x, 1.0)
    else:
        half = 0.5 * falling
        second = _Motion(half * (log + 1), -half * log, half / x, -half / x)
    return warm, _Motion(*(a + b for a, b in zip(first, second)))


def _traction(n: int, motion: _Motion, x: float, nu: float, warm: float) -> tuple[float, float]:
    """Stress across a radius and along it, over Young's modulus; `warm` is α T."""
    radial, hoop = motion.du, (motion.u + n * motion.v) / x
    turned = motion.dv - (n * motion.u + motion.v) / x
    lam, mu = nu / (1 - nu**2), 0.5 / (1 + nu)
    return lam * (radial + hoop) + 2 * mu * radial - warm / (1 - nu), mu * turned


def wall(n: int, outer: float, biot: float) -> tuple[float, float]:
    """Shares of the temperature 1 at the bore: rising (x/outer)^n, falling x^−n, of order 0 ln x.

    Outside −dT/dx = biot T; radii over that of the bore.
    """
    if n == 0:
        return 1.0, -biot / (1 / outer + biot * math.log(outer))
    # rising part over falling part at the outside, where both have the size (x/outer)^±n
    there = outer**-n * (n - biot * outer) / (n + biot * outer)
    falling = 1.0 / (1.0 + there * outer**-n)
    return there * falling, falling


def ring_factor(n: int, outer: float, biot: float, held: bool, nu: float) -> float:
    """Growth of the bore of a ring over α a T, T the temperature cos nφ of its bore.

    Parameters
    ----------
    n : int
        Order around; 0 is the mean.
    outer : float
        Radius of its outside over that of its bore, a.
    biot : float
        Transfer at its outside times a over its conductivity.
    held : bool
        Whether the outside stays in place; of a free ring the first order only moves it, told as 0.
    nu : float
        Poisson's ratio.

    Examples
    --------
    >>> from loadflow.journal.film.heat.ring_growth import ring_factor
    >>> round(ring_factor(0, 2.0, 0.0, held=False, nu=0.3), 12)  # as warm all through
    1.0
    >>> round(ring_factor(3, 1.0001, 0.0, held=False, nu=0.3), 3)  # −1/(n² − 1)
    -0.125
    """
    if held:
        return ring_motion(n, outer, biot, held, nu)
    rising, falling = wall(n, outer, biot)
    if n == 0:  # the mean temperature of the wall
        square = outer**2
        return 1.0 + falling * (square * math.log(outer) / (square - 1.0) - 0.5)
    return 0.0 if n == 1 else rising * outer**-n / (n + 1) - falling / (n - 1)


def ring_motion(n: int, outer: float, biot: float, held: bool, nu: float) -> float:
    """The same, of any order but the first of a free ring, by what stress leaves both surfaces."""
    kappa = (3 - nu) / (1 + nu)
    rising, falling = wall(n, outer, biot)
    size = 1 if n == 0 else 2
    rows, rhs = np.zeros((2 * size, 2 * size)), np.zeros(2 * size)
    for place, x in enumerate((1.0, outer)):
        at = slice(place * size, (place + 1) * size)
        warm, motion = _heated(n, rising, falling, x, outer)
        own = _Motion(*((1 + nu) * part for part in motion))
        motions = _free_motions(n, kappa, x, outer)
        if held and place:
            rows[at] = np.array([m[:size] for m in motions]).T
            rhs[at] = [-part for part in own[:size]]
        else:
            rows[at] = np.array([_traction(n, m, x, nu, 0.0)[:size] for m in motions]).T
            rhs[at] = [-part for part in _traction(n, own, x, nu, warm)[:size]]
    sizes = np.abs(rows).max(axis=1)  # of displacements and of stresses, which grow with n
    parts = np.linalg.solve(rows / sizes[:, None], rhs / sizes)
    bore = (1 + nu) * _heated(n, rising, falling, 1.0, outer)[1].u
    return float(bore + sum(m.u * p for m, p in zip(_free_motions(n, kappa, 1.0, outer), parts)))


class CellsAround(Protocol):
    """Cells of a film: edges (nx + 1,), middles and widths (nx,) around, rad; edges across."""

    @property
    def edges(self) -> Array:
        """Edges."""

    @property
    def angle(self) -> Array:
        """Middles."""

    @property
    def dx(self) -> Array:
        """Widths."""

    @property
    def z_edges(self) -> Array:
        """Edges (nz + 1,) across, shaft radii; from 0 on one half of the width."""


class RingExpansion:
    """Growth of the gap of the cells of a film by the temperatures of shell and shaft.

    Parameters
    ----------
    heat : FilmHeat
        With `growth`.
    mesh : CellsAround
        Cells, whose edges across are those of the ring, too. Where they do not go all round, the
        ring is as warm between the last and the first as the film that its oil flows into.
    radius : float
        m.

    Raises
    ------
    loadflow.errors.InputError
        A film along less than 7/8 of the ring, an outside within the bore, a transfer that the wall
        does not conduct.
    """

    def __init__(self, heat: FilmHeat, mesh: CellsAround, radius: float) -> None:
        growth = heat.growth
        assert growth is not None
        self.heat, self.growth, self.radius = heat, growth, radius
        diameter, bore = growth.outer_diameter, 2 * radius
        require(diameter > bore, "growth.outer_diameter", diameter, f"m, above the bore's {bore:g}")
        without = 2 * math.pi - float(mesh.dx.sum())
        self.covered = without < _NO_ARC
        require(without < OPEN, "growth", growth, RUNS_ROUND)
        outer, biot = diameter / bore, _biot(heat, growth, radius)
        shape = growth.held, growth.poisson_ratio
        along = np.asarray(mesh.z_edges)
        self._even = np.ones(along.size - 1)
        if growth.held:
            self._even = bore_growth((0,), along, outer, 0.0, *shape)[0].sum(axis=1)
        orders = np.arange(1, mesh.angle.size + 1)
        own = orders > min(_TOGETHER, int(orders[-1]))
        # behind the cells what lies between the last and the first: a groove, or nothing
        angle = np.append(mesh.angle, mesh.edges[0] - 0.5 * without)
        wide = np.append(mesh.dx, max(without, 0.0))
        facing = orders[:, None] * angle
        waves = np.stack([np.cos(facing), np.sin(facing)], axis=1)
        weights = 2.0 * np.sin(0.5 * orders[:, None] * wide) / (np.pi * orders[:, None])
        parts, waves = waves * weights[:, None], waves[:, :, :-1]
        factors = np.array([ring_factor(int(n), outer, biot, *shape) for n in orders[own]])
        self._slices = np.einsum("h,hwi,hwj->ij", factors, waves[own], parts[own])
        together = ~own
        if not growth.held:  # free, the first order only moves the bore
            together[0] = False
        told = (0, *orders[together].tolist())
        self._moves = bore_growth(told, along, outer, biot, *shape)
        mean = np.zeros((1, 2, wide.size))
        mean[:, 0] = 1.0
        self._waves = np.concatenate([mean[:, :, :-1], waves[together]])
        self._parts = np.concatenate([mean * wide / (2 * np.pi), parts[together]])

    def of(self, shell: Array, shaft: float, way: float | None) -> Array:
        """Growth of the gap (nx, nz), m, of surfaces at `shell` (nx, nz) and `shaft`, K.

        The shaft turns one `way`, rad/s, in which oil flows on from the groove behind the cells;
        None where these go all round.
        """
        assert self.covered or way is not None, "the ring ends: which way does its oil flow on?"
        growth, heat = self.growth, self.heat
        cold = growth.reference_temperature
        back = heat.shell_temperature if heat.shell_transfer > 0.0 else cold
        behind = shell[:1] if (way or 0.0) > 0.0 else shell[-1:]
        above = np.concatenate([shell, behind]) - back
        bore = self._even * (back - cold) + self._slices @ above
        parts = (self._parts @ above) @ self._moves.swapaxes(-1, -2)
        bore += np.tensordot(self._waves, parts, axes=((0, 1), (0, 1)))
        turning = growth.shaft_expansion * (shaft - cold)
        return np.asarray(self.radius * (growth.shell_expansion * bore - turning))


def _biot(heat: FilmHeat, growth: RingGrowth, radius: float) -> float:
    """Transfer at the outside of the ring times its bore's radius over its conductivity."""
    if heat.shell_transfer == 0.0:
        return 0.0
    ratio = 0.5 * growth.outer_diameter / radius
    conducts = growth.conductivity / (radius * math.log(ratio))
    allowed = f"W/(m² K), below the {conducts:.4g} of the wall of the ring alone"
    require(heat.shell_transfer < conducts, "shell_transfer", heat.shell_transfer, allowed)
    left = 1.0 / heat.shell_transfer - 1.0 / conducts
    return radius / (ratio * left * growth.conductivity)
