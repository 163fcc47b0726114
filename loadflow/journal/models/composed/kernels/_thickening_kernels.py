"""Compiled: a liquid of a reduced film with effects that pressure thickens.

What drives its flow is the integral of the viscosity without pressure over that with it
[Grubin 1949], as `composed.thickening` tabulates it.
"""

from __future__ import annotations

from loadflow.journal.cavitation import DP, P
from loadflow.journal.models._compile import inner
from loadflow.journal.models.composed.kernels._table_kernels import of_table

PRESSURE, THICK = range(2)  # of `work.thick`
_RISE = 2.0  # of the logarithm of the viscosity in a Newton step
_LEAST = 0.01  # share of a step that is always gone


@inner
def thicken(film, work):
    """Let what drives the flow know the viscosity, in the `state` that the law filled."""
    if film.thickening.on:
        for i in range(work.u.shape[0]):
            for k in range(film.nodes.slopes.shape[1]):
                p = work.state[P, i, k]
                driving, slope = of_table(film.thickening, 0, p)
                work.thick[PRESSURE, i, k], work.thick[THICK, i, k] = p, 1.0 / slope
                work.state[P, i, k] = driving
                work.state[DP, i, k] *= slope


@inner
def pressure_at(film, work, i, k):
    """Pressure of the law at a point, Pa."""
    return work.thick[PRESSURE, i, k] if film.thickening.on else work.state[P, i, k]


@inner
def thickness_at(film, work, i, k):
    """Viscosity at a point over that without pressure; also at the bearing ends."""
    if not film.thickening.on:
        return 1.0
    if k < film.nodes.slopes.shape[1]:
        return work.thick[THICK, i, k]
    return 1.0 / of_table(film.thickening, 0, film.ring.p_edge)[1]


@inner
def share_of_rise(film, work, step, size):
    """Share of a Newton step in which pressure makes the liquid e² times as thick at most.

    Beyond where it is to end the liquid has next to no flow, and no step would lead back.
    """
    share = 1.0
    if film.thickening.on:
        for i in range(work.u.shape[0]):
            for k in range(film.nodes.slopes.shape[1]):
                fall = work.columns[0, i, k]
                for a in range(size):
                    fall += work.columns[1 + a, i, k] * step[a]
                most = _RISE * film.thickening.rise + work.thick[PRESSURE, i, k] - work.u[i, k]
                if fall < 0.0 and -fall * share > most:
                    share = most / -fall
    return max(share, _LEAST)
