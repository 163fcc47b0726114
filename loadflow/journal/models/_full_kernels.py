"""Compiled: grooves whose pressure is unknown stay full, whatever the law of cavitation."""

from __future__ import annotations

from loadflow.journal.cavitation import DP, SLACK, P
from loadflow.journal.models._compile import inner


@inner
def keep_full(film, work):
    """Keep such grooves full after the law: a complementarity has no row for their pressure."""
    if film.feeding.keeps_full:
        for n in range(film.feeding.points.shape[0]):
            i, k = film.feeding.points[n, 0], film.feeding.points[n, 1]
            work.state[P, i, k], work.state[DP, i, k] = work.u[i, k], 1.0
            work.state[SLACK, i, k] = 0.0
