"""Temperatures across a film: those of its surfaces beside its mean, on a parabola or a cubic.

Where heat passes into shell and shaft the film is cooler there. With the mean T, gap h and
conductivity k a parabola through the surfaces has the fluxes ``k (6 T − 4 T_shell − 2 T_shaft)/h``
into the shell and ``k (6 T − 2 T_shell − 4 T_shaft)/h`` into the shaft, which pass on to what cools
them. Exact for even dissipation, once the heat of the surfaces has reached the middle.

A cubic also has the first moment of the temperature, A, which the flow carries on as it does the
mean (Elrod, NASA CR-185136): with s = ±1 at shaft and shell and Legendre's polynomials
``T + A P₁(s) + b P₂(s) + d P₃(s)``, where b and d follow from what both surfaces pass on. Oil that
the shaft drags has the velocity 1 + s, oil that pressure drives 3 (1 − s²)/2 over their means, so
that they carry T + A/3 and T − b/5.

The viscosity is taken at Lobatto's points: both surfaces and one or two between.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.warm import AcrossFilm
from loadflow.journal.heat import FilmHeat

Array = NDArray[np.float64]

_MIDDLE = (0.0, 0.5, 1.0), (1 / 6, 4 / 6, 1 / 6)  # Lobatto's points from the shell, their weights
_INNER = 1 / math.sqrt(5)
_PAIR = (0.0, 0.5 - 0.5 * _INNER, 0.5 + 0.5 * _INNER, 1.0), (1 / 12, 5 / 12, 5 / 12, 1 / 12)


class Surface(NamedTuple):
    """A temperature ``given + mean T + shaft T_J + skew A``: T, A of the film, T_J of the shaft."""

    given: Array
    mean: Array
    shaft: Array
    skew: Array

    def at(self, mean: Array, shaft: float, skew: Array | float = 0.0) -> Array:
        """Temperature where the film has `mean` and `skew`, and the shaft, K."""
        return np.asarray(self.given + self.mean * mean + self.shaft * shaft + self.skew * skew)


def _sum(*parts: tuple[float | Array, Surface]) -> Surface:
    """Sum of surfaces, each with a factor."""
    columns = zip(*(surface for _, surface in parts))
    factors = [factor for factor, _ in parts]
    return Surface(*(np.asarray(sum(f * x for f, x in zip(factors, column))) for column in columns))


class Moments(NamedTuple):
    """First moments of what is carried: by drag, by pressure, and by what crosses the film."""

    dragged: Surface
    pressed: Surface
    crossing: Surface


class Across(NamedTuple):
    """Viscosity across a film: its means, the changes of that under shear by T and by A, 1/K, and
    the first moment of the dissipation, over its mean.
    """

    film: AcrossFilm
    by_mean: Array
    by_skew: Array
    moment: Array


@dataclass(frozen=True)
class Surfaces:
    """Surfaces of the shell and of the shaft at the cells of a film, and what lies between.

    Attributes
    ----------
    shell, shaft : Surface
        Temperatures of both surfaces.
    between : tuple of Surface
        Those at Lobatto's points between them.
    dragged, pressed : Surface
        Means of what the shaft drags along, and of what pressure drives.
    conducts : array
        2 k/h, W/(m² K).
    moments : Moments, optional
        First moments; without them A is none of the unknowns.
    """

    shell: Surface
    shaft: Surface
    between: tuple[Surface, ...]
    dragged: Surface
    pressed: Surface
    conducts: Array
    moments: Moments | None = None

    @classmethod
    def of(cls, heat: FilmHeat, gap: Array) -> Surfaces:
        """Surfaces of a film whose cells have a `gap`, m; as warm as the film with one point."""
        none, all_ = np.zeros_like(gap), np.ones_like(gap)
        mean = Surface(none, all_, none, none)
        if heat.points == 1:
            return cls(mean, mean, (mean,), mean, mean, none)
        conducts = float(heat.liquid.conductivity(heat.inlet_temperature)) / gap
        return _cubic(heat, conducts) if heat.points == 4 else _parabola(heat, conducts, mean)

    def viscosity(
        self,
        heat: FilmHeat,
        reference: float,
        mean: Array,
        shaft: float,
        skew: Array | float = 0.0,
    ) -> Across:
        """Viscosity over `reference` of cells at `mean` and `skew`, K."""
        nodes = (self.shell, *self.between, self.shaft)
        places, weights = _MIDDLE if len(nodes) == 3 else _PAIR
        oil, fluid, slopes = heat.liquid, [], []
        for node in nodes:
            temperature = node.at(mean, shaft, skew)
            viscosity = oil.viscosity(temperature)
            fluid.append(reference / viscosity)
            slope = np.asarray(oil.viscosity_slopes(temperature)[0])
            slopes.append(-fluid[-1] * slope / viscosity)
        total = sum(w * f for w, f in zip(weights, fluid))
        centre = np.asarray(sum(w * z * f for w, z, f in zip(weights, places, fluid)) / total)
        flows = 12 * sum(w * (centre - z) ** 2 * f for w, z, f in zip(weights, places, fluid))
        by_mean, by_skew = (
            np.asarray(
                -sum(w * s * change for w, s, change in zip(weights, slopes, changes)) / total**2
            )
            for changes in ([n.mean for n in nodes], [n.skew for n in nodes])
        )
        film = AcrossFilm(np.asarray(1 / total), np.asarray(1 / flows), 2 * (1 - centre))
        return Across(film, by_mean, by_skew, 2 * centre - 1)


def _parabola(heat: FilmHeat, conducts: Array, mean: Surface) -> Surfaces:
    """Surfaces of a film of conductance k/h whose temperature is a parabola."""
    out, into = heat.shell_transfer, heat.shaft_transfer
    first, second = 4 * conducts + out, 4 * conducts + into
    det = first * second - 4 * conducts**2
    warm, none = out * heat.shell_temperature, np.zeros_like(conducts)
    own, other = 6 * conducts * (second - 2 * conducts), 6 * conducts * (first - 2 * conducts)
    shell = Surface(second * warm / det, own / det, -2 * conducts * into / det, none)
    shaft = Surface(-2 * conducts * warm / det, other / det, first * into / det, none)
    middle = _sum((1.5, mean), (-0.25, shell), (-0.25, shaft))
    carried = _sum((1.0, mean), (1 / 6, shaft), (-1 / 6, shell))
    return Surfaces(shell, shaft, (middle,), carried, carried, 2 * conducts)


def _cubic(heat: FilmHeat, conducts: Array) -> Surfaces:
    """Surfaces of a film of conductance k/h whose temperature is a cubic with the moment A."""
    none, all_, k = np.zeros_like(conducts), np.ones_like(conducts), 2 * conducts
    mean, skew = Surface(none, all_, none, none), Surface(none, none, none, all_)
    out, into = heat.shell_transfer, heat.shaft_transfer
    # b (−3 k − α) ± d (6 k + α) is, at shell (+) and shaft (−), what T and A ask there
    low = Surface(-out * heat.shell_temperature * all_, out * all_, none, -(out + k))
    high = Surface(none, into * all_, -into * all_, into + k)
    det = (3 * k + out) * (6 * k + into) + (6 * k + out) * (3 * k + into)
    b = _sum((-(6 * k + into) / det, low), (-(6 * k + out) / det, high))
    d = _sum((-(3 * k + out) / det, high), ((3 * k + into) / det, low))
    inner = [_sum((1.0, mean), (way, skew), (-0.2, b), (-way, d)) for way in (-_INNER, _INNER)]
    return Surfaces(
        shell=_sum((1.0, mean), (-1.0, skew), (1.0, b), (-1.0, d)),
        shaft=_sum((1.0, mean), (1.0, skew), (1.0, b), (1.0, d)),
        between=tuple(inner),
        dragged=_sum((1.0, mean), (1 / 3, skew)),
        pressed=_sum((1.0, mean), (-1 / 5, b)),
        conducts=k,
        moments=Moments(
            dragged=_sum((1 / 3, mean), (1 / 3, skew), (2 / 15, b)),
            pressed=_sum((1 / 5, skew), (-3 / 35, d)),
            crossing=_sum((1 / 3, mean), (1 / 15, skew), (-1 / 15, b), (-1 / 35, d)),
        ),
    )
