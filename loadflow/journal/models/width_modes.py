"""Few unknowns across the width: collocation on the nodes of Gauss and Lobatto."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Axial(NamedTuple):
    """Pressure over the half width from its values at m points, given that at the bearing end.

    With q = p − p_edge at the points, lengths in shaft radii:

    Attributes
    ----------
    points : array (m,)
        From mid-plane to the bearing end.
    weights : array (m,)
        ∫ q dz = weights · q.
    stiffness : array (m, m)
        ∫ (∂q)² dz = q · stiffness · q; also the axial outflow of each point in the balance.
    middle : array (m,)
        q at mid-plane is middle · q.
    end_weight : float
        Width that belongs to the bearing end itself.
    width, widest : float
        Sum of the weights, and largest one.
    """

    points: Array
    weights: Array
    stiffness: Array
    middle: Array
    end_weight: float
    width: float
    widest: float


@lru_cache(maxsize=8)
def lobatto(half_width: float, nodes: int) -> Axial:
    """Even polynomials q = (1 − ζ²)(a_0 + a_1 ζ² + …), ζ = z/half_width, at `nodes` points.

    The points are those of the Gauss–Lobatto rule over the full width, so that collocation there
    is the Galerkin method with that rule: the axial operator is exact and symmetric, the fill is
    taken at the points.
    """
    degree = 2 * nodes + 1
    series = np.zeros(degree + 1)
    series[degree] = 1.0
    inner = np.sort(legendre.legroots(legendre.legder(series)).real)
    zeta = inner[inner > 0][:nodes]
    end = 2.0 / (degree * (degree + 1))
    weights = np.asarray(end / legendre.legval(zeta, series) ** 2, dtype=float)
    power = 2 * np.arange(nodes)
    column = zeta[:, None]
    from_values = np.linalg.inv((1 - column**2) * column**power)
    curvature = power * (power - 1) * column ** np.maximum(power - 2, 0)
    curvature = curvature - (power + 2) * (power + 1) * column**power
    stiffness = -weights[:, None] * (curvature @ from_values)
    return Axial(
        points=half_width * zeta,
        weights=half_width * weights,
        stiffness=0.5 * (stiffness + stiffness.T) / half_width,
        middle=from_values[0].copy(),
        end_weight=half_width * end,
        width=half_width * float(weights.sum()),
        widest=half_width * float(weights.max()),
    )


class Nodes(NamedTuple):
    """Points across the width at which the gap is taken, and polynomials of the pressure on them.

    The pressure above that of the ends is q at m inner points, which come first, and 0 at the
    bearing ends, which are the last ones: l points in all, those of a rule of Gauss and Lobatto.
    Lengths are in shaft radii.

    Attributes
    ----------
    z : array (l,)
        From mid-plane.
    weights : array (l,)
        ∫ f dz = weights · f.
    slopes : array (l, m)
        ∂q at all points from its values.
    end_slopes : array (l, e)
        The same of a polynomial that is 1 at one end, which no pressure is.
    ends : array (e,)
        Sense of the outward direction at each end: −1 or 1.
    fine : array (f, m)
        Values at places close by each other, from those at the points.
    highest : array (g, m)
        Share of the highest polynomials L_{n+1} − L_{n−1} of Legendre's, an even and an odd one.
    beyond : array (b, m)
        The same of all from those on that are the highest of fewer points; where there are none,
        of the upper half: the highest two may be small by chance where a steep end is missed.
    below : array (m,)
        Share of the width of an inner point that lies on its side of smaller z.
    joints : array of int (j,)
        Inner points at which stretches meet: those of the points of no width, which follow the
        inner ones, of `stretched_width`.
    width, widest : float
        Sum of the weights, and largest one.
    """

    z: Array
    weights: Array
    slopes: Array
    end_slopes: Array
    ends: Array
    fine: Array
    highest: Array
    beyond: Array
    below: Array
    joints: NDArray[np.int64]
    width: float
    widest: float


_FINE = 41  # places across the width at which the largest pressure is sought


@lru_cache(maxsize=8)
def whole_width(half_width: float, points: int, few: int | None = None) -> Nodes:
    """Polynomials over the whole width, 0 at both ends, from their values at inner `points`.

    They are the more ones in place of a `few`, where there are such, or those themselves.
    """
    zeta, weights = _lobatto_rule(points + 1)
    slopes = _derivative(zeta)
    inner, ends = np.arange(1, points + 1), np.array([0, points + 1])
    order = np.append(inner, ends)
    fine = _interpolation(zeta, np.linspace(-1.0, 1.0, _FINE))
    shares = _shares(zeta[inner], np.arange(1, points + 1))
    return Nodes(
        z=half_width * zeta[order],
        weights=half_width * weights[order],
        slopes=np.ascontiguousarray(slopes[np.ix_(order, inner)] / half_width),
        end_slopes=np.ascontiguousarray(slopes[np.ix_(order, ends)] / half_width),
        ends=np.array([-1.0, 1.0]),
        fine=np.ascontiguousarray(fine[:, inner]),
        highest=shares[-2:],
        beyond=shares[few - 2 if few else points // 4 * 2 :],
        below=np.full(points, 0.5),
        joints=np.zeros(0, dtype=np.int64),
        width=half_width * float(weights.sum()),
        widest=half_width * float(weights.max()),
    )


@lru_cache(maxsize=8)
def half_width_nodes(half_width: float, points: int, few: int | None = None) -> Nodes:
    """Even polynomials over the half width, 0 at its end: those of `lobatto`; `few` as above."""
    zeta, weights = _lobatto_rule(2 * points + 1)
    slopes = _derivative(zeta)
    inner = np.arange(points + 1, 2 * points + 1)
    mirror = 2 * points + 1 - inner
    order = np.append(inner, 2 * points + 1)
    fine = _interpolation(zeta, np.linspace(0.0, 1.0, _FINE))
    even = slopes[:, inner] + slopes[:, mirror]
    shares = _shares(zeta[inner], 2 * np.arange(points) + 1)
    return Nodes(
        z=half_width * zeta[order],
        weights=half_width * weights[order],
        slopes=np.ascontiguousarray(even[order] / half_width),
        end_slopes=(slopes[order, -1:] + slopes[order, :1]) / half_width,
        ends=np.array([1.0]),
        fine=np.ascontiguousarray(fine[:, inner] + fine[:, mirror]),
        highest=shares[-1:],
        beyond=shares[few - 1 if few else points // 2 :],
        below=np.full(points, 0.5),
        joints=np.zeros(0, dtype=np.int64),
        width=half_width * float(weights[order].sum()),
        widest=half_width * float(weights[order].max()),
    )


_NO_WIDTH = 1e-6  # root of the width of a point that stands for the bend between two stretches
_ON = 1e-9  # distance, over the half width, at which a point is on the end of a stretch


@lru_cache(maxsize=8)
def stretched_width(
    half_width: float,
    marks: tuple[float, ...],
    points: tuple[int, int],
    whole: bool,
    few: tuple[int, int] | None = None,
) -> Nodes:
    """Polynomials over stretches of the width, between which the slope may bend.

    Where two stretches meet the flow has a slope on either side. What both make is that of their
    mean, at the point itself, and of their difference, at a second point of next to no width.

    Parameters
    ----------
    half_width : float
        Shaft radii.
    marks : tuple of float
        Where stretches meet: shares of the half width, increasing, on both sides of mid-plane.
    points : tuple of int
        Inside half of the stretch about mid-plane, and inside each of the others.
    whole : bool
        The whole width, or even polynomials over the half of it.
    few : tuple of int, optional
        As `points`, those in place of which these are the more ones.
    """
    edges = np.array([-1.0, *(-mark for mark in reversed(marks)), *marks, 1.0])

    def degrees_of(points: tuple[int, int]) -> list[int]:
        inside = [points[1] + 1] * (edges.size - 1)
        inside[len(marks)] = 2 * points[0] + 1
        return inside

    degrees, lesser = degrees_of(points), degrees_of(few or points)
    count, places = sum(degrees) + 1, np.linspace(-1.0 if whole else 0.0, 1.0, _FINE)
    z, own, mean = np.zeros(count), np.zeros(count), np.zeros((count, count))
    fine, highest, begins = np.zeros((_FINE, count)), [], [0]
    beyond: list[Array] = []
    pairs: list[tuple[float, Array]] = []  # weight and slopes on either side of each mark
    for low, high, degree, least in zip(edges[:-1], edges[1:], degrees, lesser):
        zeta, weights = _lobatto_rule(degree)
        half, here = 0.5 * (high - low), slice(begins[-1], begins[-1] + degree + 1)
        slopes = np.zeros((degree + 1, count))
        slopes[:, here] = _derivative(zeta) / half
        z[here], weights = low + half * (1.0 + zeta), weights * half
        own[here] += weights
        mean[here] += weights[:, None] * slopes
        pairs += [(weights[0], slopes[0]), (weights[-1], slopes[-1])]
        within = (places >= low) & (places <= high)
        fine[within] = 0.0
        fine[np.ix_(within, np.arange(count)[here])] = _interpolation(
            zeta, (places[within] - low) / half - 1.0
        )
        shares = np.zeros((degree + 1, count))
        shares[:, here] = np.linalg.inv(legendre.legvander(zeta, degree))
        # about mid-plane an even polynomial has no share of an odd degree
        highest.append(shares[-2 if not whole and low == -high else -1])
        beyond += [*shares[least - 1 if low == -high else least :]]
        begins.append(begins[-1] + degree)
    mean /= own[:, None]
    bends, below = np.array(begins[1:-1], dtype=int), np.full(count, 0.5)
    weight: list[float] = []
    jump = np.zeros((bends.size, count))
    for (left, behind), (right, ahead) in zip(pairs[1:-1:2], pairs[2:-1:2]):
        below[bends[len(weight)]] = left / (left + right)
        jump[len(weight)] = (behind - ahead) / _NO_WIDTH
        weight.append(_NO_WIDTH**2 * left * right / (left + right))
    shown = np.ones(bends.size, dtype=bool) if whole else z[bends] > 0.0
    unknown = np.arange(1, count - 1) if whole else np.flatnonzero(z > 0.0)[:-1]
    ends = np.array([0, count - 1] if whole else [count - 1])

    def at_points(rows: Array, points: NDArray[np.int64]) -> Array:
        even = rows[:, points] if whole else rows[:, points] + rows[:, count - 1 - points]
        return np.ascontiguousarray(even)

    def of_unknown(rows: Array) -> Array:
        return at_points(rows, unknown)

    order = np.concatenate([unknown, bends[shown], ends])
    all_weights = np.concatenate([own[unknown], np.array(weight)[shown], own[ends]])
    rows = np.concatenate([mean[unknown], jump[shown], mean[ends]])
    real = np.concatenate([own[unknown], own[ends]])
    return Nodes(
        z=half_width * z[order],
        weights=half_width * all_weights,
        slopes=of_unknown(rows) / half_width,
        end_slopes=at_points(rows, ends) / half_width,
        ends=np.array([-1.0, 1.0] if whole else [1.0]),
        fine=of_unknown(fine),
        highest=of_unknown(np.array(highest if whole else highest[len(marks) :])),
        beyond=of_unknown(np.array(beyond)) if few else np.zeros((0, unknown.size)),
        below=below[unknown],
        joints=np.searchsorted(unknown, bends[shown]),
        width=half_width * float(real.sum()),
        widest=half_width * float(own[unknown].max()),
    )


def at_places(points: int, whole: bool, places: Array) -> Array:
    """Values at `places`, −1 … 1 (0 … 1 of a half), from those at the points, (places, m).

    Of `whole_width`, or of the even polynomials of `half_width_nodes`.
    """
    if whole:
        zeta, _ = _lobatto_rule(points + 1)
        return np.ascontiguousarray(_interpolation(zeta, places)[:, 1 : points + 1])
    zeta, _ = _lobatto_rule(2 * points + 1)
    inner = np.arange(points + 1, 2 * points + 1)
    values = _interpolation(zeta, places)
    return np.ascontiguousarray(values[:, inner] + values[:, 2 * points + 1 - inner])


def on_places(nodes: Nodes, marks: tuple[float, ...], whole: bool, places: Array) -> Array:
    """Values at `places`, −1 … 1 (0 … 1 of a half), from those at all points, (places, l).

    Between `marks`, as of `stretched_width`, they are polynomials of their own; the points of no
    width give nothing.
    """
    half, inner, ends = nodes.z[-1], nodes.slopes.shape[1], nodes.ends.size
    own = nodes.z[:inner] / half
    sides = own if whole else np.append(-own[::-1], own)
    zeta, values = np.concatenate([[-1.0], sides, [1.0]]), np.zeros((places.size, sides.size + 2))
    edges = np.array([-1.0, *(-mark for mark in reversed(marks)), *marks, 1.0])
    for low, high in zip(edges[:-1] - _ON, edges[1:] + _ON):
        within = np.flatnonzero((zeta >= low) & (zeta <= high))
        to = np.flatnonzero((places >= low) & (places <= high))
        values[np.ix_(to, within)] = _interpolation(zeta[within], places[to])
    told = np.zeros((places.size, nodes.z.size))
    if whole:
        told[:, :inner], told[:, -ends:] = values[:, 1:-1], values[:, [0, -1]]
    else:
        told[:, :inner] = values[:, inner + 1 : -1] + values[:, inner:0:-1]
        told[:, -1] = values[:, -1] + values[:, 0]
    return told


def between_stretches(marks: tuple[float, ...], here: Nodes, there: Nodes, whole: bool) -> Array:
    """Values at the inner points `there` from those `here`, both of `stretched_width`."""
    places = there.z[: there.slopes.shape[1]] / there.z[-1]
    told = on_places(here, marks, whole, places)
    return np.ascontiguousarray(told[:, : here.slopes.shape[1]])


@lru_cache(maxsize=8)
def between_points(points: int, others: int, whole: bool) -> Array:
    """Values at other points from those at `points`, (others, points), of what is 0 at the ends."""
    zeta, _ = _lobatto_rule(others + 1 if whole else 2 * others + 1)
    places = zeta[1:-1] if whole else zeta[others + 1 : -1]
    return at_places(points, whole, places)


def _shares(zeta: Array, degrees: NDArray[np.int64]) -> Array:
    """Shares of L_{n+1} − L_{n−1} of the `degrees` n in what has given values at the points."""
    unit = np.eye(int(degrees[-1]) + 2)
    inverse = np.linalg.inv(legendre.legval(zeta, (unit[degrees + 1] - unit[degrees - 1]).T).T)
    return np.asarray(inverse, dtype=float)


def _lobatto_rule(degree: int) -> tuple[Array, Array]:
    """Points and weights of Gauss and Lobatto on −1 … 1, both ends among them."""
    series = np.zeros(degree + 1)
    series[degree] = 1.0
    inner = np.sort(legendre.legroots(legendre.legder(series)).real)
    zeta = np.concatenate([[-1.0], 0.5 * (inner - inner[::-1]), [1.0]])
    return zeta, 2.0 / (degree * (degree + 1)) / legendre.legval(zeta, series) ** 2


def _barycentric(zeta: Array) -> Array:
    apart = zeta[:, None] - zeta + np.eye(zeta.size)
    return np.asarray(1.0 / apart.prod(axis=1))


def _derivative(zeta: Array) -> Array:
    """Derivatives at the points of the polynomial through values there."""
    weights = _barycentric(zeta)
    apart = zeta[:, None] - zeta + np.eye(zeta.size)
    matrix = weights / weights[:, None] / apart
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return np.asarray(matrix)


def _interpolation(zeta: Array, places: Array) -> Array:
    """Values at `places` of the polynomial through values at the points."""
    apart = places[:, None] - zeta
    exact = np.abs(apart) < 1e-14
    terms = _barycentric(zeta) / np.where(exact, 1.0, apart)
    values = terms / terms.sum(axis=1, keepdims=True)
    return np.where(exact.any(axis=1, keepdims=True), exact.astype(float), values)
