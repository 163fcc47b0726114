"""How far the searches for one film may go: Newton steps times cells, counted and never timed.

A search that leads nowhere has no end of its own: it goes on with other starts, smaller steps and
more cells. What it may take follows from the film alone, so that the same question has the same
answer on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.shell.elastic_film import ElasticFilm

_STEPS_OF_CELLS = 4e4  # Newton steps times cells, for each step that one solution may take
_SINKING = 0.5  # of that, on top, for a shaft that sinks where no other way has found its film
_LEAST = 3  # steps on any cells, in multiples of those that one solution may take
# time of a step over that in a rigid bore: of a shell that gives way locally, of one that gives way
# all over, for each column of its linear system, and of asperities on either; what such a shell
# takes where asperities press it, or where it is much softer than its film, counts beside
_GIVES, _SPREADS, _TOUCHES = 1.5, 2.0, 4.0


@dataclass
class Effort:
    """What is left of it, and the Newton steps that were taken.

    Attributes
    ----------
    left : float
        Newton steps times cells of a film in a rigid bore, of about a microsecond each.
    spent : int
        Newton steps on all cells.
    before : int
        Of these, that earlier films of a `Search` have taken.
    kept : float
        Of what is left, that is kept for other cells.
    sinking : float
        What a shaft may take that sinks where all else has failed, in the unit of `left`.
    found, vain : int
        Films of loads that share it, found and sought in vain.

    Examples
    --------
    >>> from loadflow.journal.solvers.effort import Effort
    >>> Effort(left=0.0).over
    True
    """

    left: float
    spent: int = 0
    before: int = 0
    kept: float = 0.0
    found: int = 0
    vain: int = 0
    sinking: float = 0.0

    @classmethod
    def of(cls, film: DiscreteFilm, max_iterations: int) -> Effort:
        """That of a film of which one solution may take as many steps, or more by its law."""
        most = film.newton_steps(max_iterations)
        left = most * max(_STEPS_OF_CELLS, _LEAST * _cost(film))
        return cls(left, sinking=_SINKING * left)

    @property
    def taken(self) -> int:
        """Newton steps of the film at hand."""
        return self.spent - self.before

    @property
    def over(self) -> bool:
        """Whether nothing is left of it."""
        return self.left <= self.kept

    def take(self, film: DiscreteFilm, steps: int) -> None:
        """Note Newton steps of a film."""
        self.left -= steps * _cost(film)
        if isinstance(film, ElasticFilm):
            self.left -= film.further_work()
        self.spent += steps

    def steps(self, film: DiscreteFilm) -> int:
        """Newton steps of a film that are left."""
        return max(int((self.left - self.kept) / _cost(film)), 0)


def _cost(film: DiscreteFilm) -> float:
    """What a Newton step takes, in cells of a film in a rigid bore."""
    cells = film.mesh.shape[0] * film.mesh.shape[1]
    if not isinstance(film, ElasticFilm):
        return float(cells)
    gives = _SPREADS * (1 + film.moves) if film.compliance.spreads else _GIVES
    return cells * gives * (1.0 if film.contact is None else _TOUCHES)
