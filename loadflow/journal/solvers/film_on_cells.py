"""A film on cells that suit it, and what is given of the line of its shaft."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import Self, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.discretise import cylindrical_film, is_cylindrical, shaped_film
from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.gap.gap import BoreGap
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.solvers.estimate import first_position
from loadflow.journal.solvers.load_stepping import APART, has_touched
from loadflow.journal.solvers.messages import why_unsolved
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.pads.statics import unload_other_pads

Array = NDArray[np.float64]
Rows = NDArray[np.int64]


class FilmOnCells:
    """One film on its cells, and what is given of the shaft's line.

    Parameters
    ----------
    bearing, options, line
        The bearing, its film and what is given of the shaft.
    rate : float
        Largest speed or rate of squeeze, 1/s.
    crowd : tuple of float, optional
        Angles, rad, at which cells crowd, on a mesh that is fixed to the shell; by default the
        mesh is the one that suits the bore.
    """

    gap: BoreGap
    film: DiscreteFilm
    shaft: slice | Rows

    def __init__(
        self,
        bearing: JournalGeometry,
        options: Film,
        line: Line,
        rate: float,
        crowd: tuple[float, ...] | None = None,
    ) -> None:
        self.bearing, self.line, self.options, self.rate = bearing, line, options, rate
        self.crowd = crowd
        if crowd is None and is_cylindrical(bearing, options, line):
            lengths = bearing.diameter, bearing.width, bearing.relative_clearance
            self.gap, self.film = cylindrical_film(*lengths, options)
        else:
            self.gap, self.film = shaped_film(bearing, options, line.straight, crowd or ())
        self.film.set_scale(rate)
        count = 2 if line.moment is None else self.gap.shaft
        self.shaft = EVERY if count == self.gap.size else np.arange(count)  # what moves of it

    @property
    def can_refine(self) -> bool:
        """Whether a load that the cells do not resolve is tried on a graded mesh."""
        return self.gap.axisymmetric and self.options.may_grade

    @cached_property
    def finer(self) -> Self:
        """The same on a graded mesh."""
        return self._on(self.options.graded())

    def suited(self, position: Array) -> Self:
        """The film on cells that resolve the gap at `position`: these, or where allowed, graded."""
        return self.finer if self.can_refine and not self.film.resolves(position) else self

    def _on(self, options: Film, crowd: tuple[float, ...] | None = None) -> Self:
        """The same on another mesh, to the same scale."""
        other = type(self)(self.bearing, options, self.line, self.rate, crowd)
        other.film.raise_scale(self.film.scale)
        return other

    def raise_scale(self, loads: Array) -> Array:
        """Raise the scale of pressure to the mean of the largest of `loads`; generalised loads."""
        forces = np.array([self._force(index, load) for index, load in enumerate(loads)])
        largest = float(np.hypot.reduce(forces, axis=1).max())
        self.film.raise_scale(largest / (self.bearing.width * self.bearing.diameter))
        return forces

    def message(self, solution: Solution, load: Array | None = None) -> str:
        """Why there is no answer for `load`, or at the position given, with numbers."""
        return why_unsolved(self.bearing, self.film, self.gap, solution, load)

    # --- inside ----------------------------------------------------------------------------------
    def _force(self, index: int, load: Array) -> Array:
        """Generalised load (m,), N."""
        if self.gap.size == load.size:
            return load
        force = np.zeros(self.gap.size)
        force[:2] = load
        if self.line.moment is not None:
            force[2:4] = self.line.moment[index] / self.bearing.radius
        return force

    def _held(self, index: int) -> Array:
        """Centred position of the shaft with what is given of its line."""
        tilt, bend = self.line.tilt, self.line.bend
        return self.gap.held(
            None if tilt is None else tilt[index], None if bend is None else bend[index]
        )

    def _first_position(self, index: int, load: Array) -> Array:
        """Where a search begins at the speed that is set."""
        given = self.bearing, self.film, self.gap, load, self._held(index), self.shaft
        return first_position(*given, self.line.start(index))

    def _carries(self, force: Array) -> bool:
        """Whether anything may carry a load at the speed that is set."""
        film = self.film
        return film.speed != 0.0 or film.lifts or (film.contact is not None and bool(force.any()))

    def _checked(self, solution: Solution) -> Solution:
        """The same, not converged where the shell meets the shaft or a fed groove falls dry."""
        film = self.film
        sound = film.clearance_left(solution.position) > APART and not film.dry(solution.u)
        return replace(solution, converged=solution.converged and sound)

    @property
    def _has_path(self) -> bool:
        """Whether equilibria can be followed along the path of the load."""
        return not (self.film.pockets.free.size or self.film.speed == 0.0)

    @property
    def _shaped(self) -> ShapedGap:
        """The gap, of which only a shaped one has pads."""
        return cast("ShapedGap", self.gap)

    def _on_pads(self, pads: Rows) -> Rows:
        """Take the film off all other pads."""
        if self.gap.pads.size:
            unload_other_pads(self.film, self._shaped, pads)
        return pads

    def _free(self, pads: Rows) -> slice | Rows:
        """Degrees of freedom that move, those of `pads` among them."""
        return np.append(np.arange(self.gap.size)[self.shaft], pads) if pads.size else self.shaft

    def _told(self, solution: Solution) -> bool:
        """Whether where a search has ended says why there is no equilibrium."""
        film = self.film
        return has_touched(film, solution) or film.clearance_left(solution.position) <= APART
