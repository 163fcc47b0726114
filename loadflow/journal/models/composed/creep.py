"""Reduced films in a shell that gives way, where Newton's method does not find them at once.

A creeping film is as thick all over the place where it is pressed, and ends there within a few
cells: no closed form is near it, and Newton's method does not find it at once. A faster film is
found at once, and a standing shaft rests on its asperities alone; from either the speed goes to the
one that is wanted in steps as long as Newton's method follows. Where the law of the
ruptured film has a kink, first pressures go too far, and open the gap by as much: there a bore that
is rigid at first gives way in such steps.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.model import ComposedFilm
from loadflow.journal.models.slow_heat import Warmth
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_FASTER = 3.0  # speeds over one another at which a film is sought; first step of the speed, too
_THICK = 0.5  # eccentricity ratio of the closed form, below which no faster film is tried
_SLOWEST = 1e-4  # of a speed, at which the first film after standstill is sought at last
_EASY = 10  # Newton steps below which the next step of the speed is longer
_LONGER, _SHORTER = 1.5, 0.5  # powers of it that are tried next
_STEPS = 25  # Newton steps of each
_LEAST = 1.01  # ratio of two speeds below which a step is given up
_TRIES = 3  # films of a rigid bore, each where the last one has left the shaft
_FIRMER, _FIRMEST = 0.25, 1e-3  # next step of the compliance, and share of it that is given up
_BUDGET = 10  # Newton steps of a way, in multiples of those of a solution
_WORK = 1e4  # points times solutions of all ways, each of as many Newton steps as may be asked
_OVERLAP = 1e-3  # first overlap of a standing shaft, clearances; the next ones are twice as large
_DEEPEST = 20  # of these
_PRESSED = 0.02  # of its load, to which a standing shaft is pressed by its place alone
_HALVES = 30  # places that are tried for it


_AT_REST = np.zeros(1)  # one time
_NO_SLOPES = np.zeros((2, 0, 0))


class Creep:
    """One load on a film, in whose work arrays it is solved.

    Parameters
    ----------
    model : ComposedFilm
        The film.
    loads, line : ndarray (1, 4)
        Force, N, and moment over the shaft radius; how the shaft lies.
    control : Limits
        Tolerance, and the Newton steps of a solution.
    warmth : Warmth
        Slow heat of the film.
    states : ndarray (1, …)
        Where it begins.

    Attributes
    ----------
    spent, last : int
        Newton steps so far, and of the last solution.
    """

    def __init__(
        self,
        model: ComposedFilm,
        loads: Array,
        line: Array,
        control: Limits,
        warmth: Warmth,
        states: Array,
    ) -> None:
        self.model, self.loads, self.line, self.warmth = model, loads, line, warmth
        self.load, self.states = loads[0, :2], states
        self.tolerance, self.most = control.tolerance, control.max_iterations
        self.spent = self.last = 0

    def places(self, speed: float) -> Iterator[Array]:
        """Places (4,) at a `speed`, rad/s, that the ways there have come to; fill the unknowns."""
        if speed != 0.0 and not self.model.units.law.smooth:
            found = self.from_rigid(speed)
            if found is not None:
                yield found
        found = self.from_faster(speed) if speed != 0.0 else None
        if found is not None:
            yield found
        if self.model.film.rough.size > 0.0 and self.load.any():
            found = self.from_standing(speed)
            if found is not None:
                yield found

    def from_faster(self, speed: float) -> Array | None:
        """Place (4,) at a `speed`, rad/s, from faster films on; fills the unknowns."""
        fast = speed
        while True:
            fast *= _FASTER
            place = self._estimate(fast)
            if float(np.hypot(*place[:2])) < _THICK:
                return None
            self.model.work.u[:] = self.model.cold()
            if self._solved(place, fast, self.most):
                return self._go(place, fast, speed)

    def from_rigid(self, speed: float) -> Array | None:
        """Place (4,) from a bore that does not give way on; fills the unknowns.

        None of a film with asperities, whose table knows one compliance.
        """
        model, work, given = self.model, self.model.work, self.spent
        if model.film.rough.size > 0.0:
            return None
        place, share, softer = self._estimate(speed), 0.0, 1.0
        try:
            self._gives(model, 0.0)
            for _ in range(_TRIES):  # a film that has run away may leave its shaft near the answer
                work.u[:] = model.cold()
                self._row(place, speed, self.most, size=0)  # the film first
                if self._solved(place, speed, self.most):
                    break
            else:
                return None
            unknowns, held = work.u.copy(), place.copy()
            while True:
                self._gives(model, softer)
                if self._solved(place, speed, self.most):
                    if softer == 1.0:
                        return place
                    step = 2.0 * (softer - share)
                    unknowns, held, share = work.u.copy(), place.copy(), softer
                else:
                    work.u[:], place[:] = unknowns, held
                    step = _FIRMER * (softer - share)
                if step < _FIRMEST or self.spent - given > _BUDGET * self.most:
                    return None
                softer = min(share + step, 1.0)
        finally:
            self.model = model

    def _gives(self, model: ComposedFilm, share: float) -> None:
        """Solve films in a shell that gives way by a share of what it does."""
        film, modes = model.film, model.film.modes
        softer = modes._replace(pressed=share * modes.pressed) if modes.on else modes
        self.model = replace(model, film=film._replace(give=share * film.give, modes=softer))

    def from_standing(self, speed: float) -> Array | None:
        """The same from the shaft that stands on its asperities."""
        place = self.standing()
        if place is None or not self._solved(place, 0.0, self.most):
            return None
        if speed == 0.0:
            return place
        unknowns, held, slow = self.model.work.u.copy(), place.copy(), speed
        while abs(slow) > _SLOWEST * abs(speed):
            if self._solved(place, slow, _STEPS):
                return self._go(place, slow, speed)
            self.model.work.u[:], place[:] = unknowns, held
            slow /= _FASTER
        return None

    def standing(self) -> Array | None:
        """Place (4,) where asperities about carry the load along it; fills the unknowns.

        The shell gives way under them: the shaft lies farther out than in a rigid bore.
        """
        size = float(np.hypot(*self.load))
        place, way = self._estimate(0.0), self.load / size
        self.model.work.u[:] = self.model.cold()

        def carried(ratio: float) -> float:
            place[:2] = ratio * way
            row = self._row(place, 0.0, 1, size=0)
            held = float(row[[at.CONTACT_X, at.CONTACT_Y]] @ way)
            return held / size if row[at.CONVERGED] > 0.0 else np.inf

        low = high = float(np.hypot(*place[:2]))
        step = _OVERLAP
        for _ in range(_DEEPEST):
            if carried(low) < 1.0:
                break
            low, step = low - step, 2.0 * step
        step = _OVERLAP
        for _ in range(_DEEPEST):
            share = carried(high)
            if share >= 1.0:
                break
            low, high, step = high, high + step, 2.0 * step
        for _ in range(_HALVES):
            middle = 0.5 * (low + high)
            share = carried(middle)
            if abs(share - 1.0) < _PRESSED:
                return place
            low, high = (middle, high) if share < 1.0 else (low, middle)
        return None

    def _solved(self, place: Array, speed: float, most: int) -> bool:
        """Whether the film is found from the unknowns and `place`, which it moves."""
        row = self._row(place, speed, most, self.model.size)
        self.last = int(row[at.ITERATIONS])
        return bool(row[at.CONVERGED] > 0.0)

    def _estimate(self, speed: float) -> Array:
        """Place (4,) by closed forms."""
        return self.model.estimates(self.loads[:, :2], np.array([speed]), self.line)[0]

    def _row(self, place: Array, speed: float, most: int, size: int) -> Array:
        """Results after at most `most` Newton steps; of the `place`, `size` moves.

        Not converged where nothing is left of what all ways may take.
        """
        row = np.zeros((1, self.model.columns))
        left = int(_WORK * self.most / self.model.work.u.size) - self.spent
        if left <= 0:
            return row[0]
        most = min(most, left)
        solve(
            self.model.film, self.model.work, place, size, 0, _AT_REST, self.loads, self.line,
            np.array([speed]), self.tolerance, most, np.inf, row, _NO_SLOPES, self.warmth,
            self.states,
        )  # fmt: skip
        self.spent += int(row[0, at.ITERATIONS])
        return row[0]

    def _go(self, place: Array, begin: float, end: float) -> Array | None:
        """Place at the speed `end` from that at `begin`, whose film the unknowns are."""
        work, given = self.model.work, self.spent
        unknowns, held, speed, step = work.u.copy(), place.copy(), begin, _FASTER
        while speed != end:
            if self.spent - given > _BUDGET * self.most or step < _LEAST:
                return None
            way = np.log(end / speed)
            nearer = end if abs(way) <= np.log(step) else speed * step ** np.sign(way)
            if self._solved(place, nearer, _STEPS):
                unknowns, held, speed = work.u.copy(), place.copy(), nearer
                step = step**_LONGER if self.last < _EASY else step
            else:
                work.u[:], place[:] = unknowns, held
                step = step**_SHORTER
        return place
