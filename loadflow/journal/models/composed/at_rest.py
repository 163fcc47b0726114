"""The rung "reduced" with effects: tilt, crowns, asperities, a local shell, turbulence, supply.

What `loadflow.journal.models.reduced` says of cells and points holds here, but that the gap changes
across the width: a shaft that tilts or bends takes polynomials over the whole of it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models.composed.model import (
    LEVELS,
    levels_at_rest,
    warn_unresolved,
)
from loadflow.journal.models.composed.rest_on_level import Known, RestingFilms, films_at_rest
from loadflow.journal.questions import AtRest
from loadflow.numerics.convergence import Limits

_MOST_AROUND = 240  # cells around a shell that is pressed at one place, where its film is thin
_MOST_RIGID = 480  # around asperities in a rigid bore: a film as thin as they are high ends sooner


def composes(bearing: JournalGeometry, film: Film, line: Line) -> bool:
    """Whether a film has more than laminar flow in an aligned, smooth, rigid bore as it is cut."""
    effects = film.contact, film.shell, film.turbulence, film.supply
    more = any(effect is not None for effect in effects) or bool(bearing.relief)
    more = more or bearing.pressure_between(film.edge_pressure) != film.edge_pressure
    return more or not line.straight or film.liquid.pressure_coefficient > 0.0


def equilibrium(asked: AtRest) -> tuple[dict[str, Any], NDArray[np.bool_], NDArray[np.bool_]]:
    """Fields of `Equilibrium`, which loads have an answer, and which surely have none.

    In a shell that gives way or on asperities a film too thin for the cells around, or not found on
    them, is one on more of them, where the mesh may be graded and more may be spent.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the load.
    """
    options = asked.film
    most = finer_around(options, asked.limits)
    films = _on_cells(asked, may_leave=most is not None and options.shell is not None)
    answer, found, left, none = films.answer, films.found, films.left, films.none
    if most is not None:
        again = np.flatnonzero(films.thin | ~(found | none))
        if again.size:
            finer = replace(options, grid=(most, options.cells[1]))
            more = _on_cells(replace(asked.at(again), film=finer))
            _take(answer, again, more)
            left[again] = np.where(more.found, more.left, left[again])
            found[again] |= more.found
    if (left & found).any():
        warn_unresolved(left & found, f"load {int((left & found).argmax())}")
    return answer, found, none


def finer_around(options: Film, control: Limits) -> int | None:
    """Cells around on which a film is tried that those asked for do not resolve; None: no others.

    Only a shell that gives way, or asperities, leave a film on them that a finer grid need not
    find. Beside grooves that costs more than the grid does.
    """
    if options.supply is not None:
        return None
    if not (control.refine and options.may_grade):
        return None
    if options.shell is None and options.contact is None:
        return None
    if options.shell is not None and not options.shell.any_grid:
        return None
    most = _MOST_RIGID if options.shell is None else _MOST_AROUND
    return most if options.cells[0] < most else None


def _on_cells(asked: AtRest, may_leave: bool = False) -> RestingFilms:
    """Films on the cells around that are asked for, on as many points across as each asks for."""
    films = films_at_rest(asked, 0, may_leave=may_leave)
    known = Known(films.films, films.model)
    levels = levels_at_rest(asked.film) if asked.limits.refine else LEVELS
    for level in levels[1:]:
        again = np.flatnonzero(films.found & films.left)
        if not again.size:
            break
        begun = Known(
            {k: known.films[n] for k, n in enumerate(again.tolist()) if n in known.films},
            known.model,
        )
        more = films_at_rest(asked.at(again), level, begun)
        _take(films.answer, again, more)
        films.left[again] = more.left | ~more.found
        known = Known({int(again[k]): film for k, film in more.films.items()}, more.model)
    return films


def _take(answer: dict[str, Any], again: NDArray[np.int64], more: RestingFilms) -> None:
    """Take the answers of `more`, which are of the loads `again`; steps of all ways add up."""
    spent = answer["iterations"][again] + more.answer["iterations"]
    for name, values in more.answer.items():
        answer[name][again[more.found]] = values[more.found]
    answer["iterations"][again] = spent
