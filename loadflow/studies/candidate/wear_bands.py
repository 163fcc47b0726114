"""What rubs off a bore: the hardest start with other data, for band and error; production."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.cube.hdf5 import read_variables
from loadflow.errors import SolverError
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.wear.cycle import Cycle, followed, offset_of
from loadflow.scene.journal import Journal
from loadflow.stages.frames import to_film
from loadflow.stages.wear import cycles_of
from loadflow.studies.candidate.numbers import Finished, error_of
from loadflow.studies.candidate.result import Number

BATCHES = 5.0
"""Factor by which published coefficients of wear of one pair of materials differ from batch to
batch, at most of 2 … 5 (docs/mixed-friction.md)."""

_FILM = ("time", "speed", "contact_share", "contact_power", "temperature", "tilt",
         "eccentricity", "clearance")  # fmt: skip
_SHAFT = ("force", "tilt", "curvature")


@dataclass(frozen=True)
class Rubbing:
    """What touches in the load case that wears the bores of a candidate most.

    Attributes
    ----------
    place : str
        The bearing.
    cycle : Cycle
        The shaft in it meanwhile.
    warmth : float
        Film over the oil that enters, K; 0 without heat.
    offset : array (2,), optional
        How far the shaft first is from where it would lie at rest, m. Left out, it begins there.
    """

    place: str
    cycle: Cycle
    warmth: float = 0.0
    offset: NDArray[np.float64] | None = None

    def begun_in(self, options: Journal) -> Rubbing:
        """The same with the `offset` of its cycle in the bore that the run had.

        Raises
        ------
        loadflow.errors.SolverError
            No answer at rest.
        """
        film = self._warm(options).film_model
        with unresolved_counted():
            return replace(self, offset=offset_of(options.geometry, self.cycle, film))

    def energy(self, options: Journal) -> float:
        """Friction of touching asperities in the bore as new, J; NaN without an answer.

        The depth of wear goes with it by both laws: Archard's and Fleischer's.
        """
        film = self._warm(options).film_model
        try:
            with unresolved_counted():  # the run has told of them
                cycle, found = followed(options.geometry, self.cycle, film, offset=self.offset)
        except SolverError:
            return math.nan
        return float(cycle.seconds @ found["contact_power"])

    def _warm(self, options: Journal) -> Journal:
        if options.heat is None:
            return options
        return options.at_temperature(options.heat.inlet_temperature + self.warmth)

    def askew(self, way: tuple[float, float]) -> Rubbing:
        """The same with the shaft turned by an angle (y, z), rad, more than it lies."""
        more = to_film(np.array([[0.0, *way]]))
        lies = np.zeros_like(self.cycle.force) if self.cycle.tilt is None else self.cycle.tilt
        return replace(self, cycle=replace(self.cycle, tilt=lies + more))


def rubbing_of(run: Finished, wear: Number) -> Rubbing | None:
    """What rubs in the load case of a run that a wear names; None without wear, or an answer."""
    if not wear.case or not wear.value > 0:
        return None
    scene, folder = run.scene, run.folder
    dlc = str(run.tables["journal"]["dlc"].sel(case=wear.case).item())
    options = scene.journal.at(wear.place)
    film = read_variables(folder / "journal" / f"{wear.case}.h5", _FILM, wear.place)
    loads = read_variables(folder / "loads" / f"{wear.case}.h5", ("time", "speed"))
    shaft = read_variables(folder / "shaft" / f"{wear.case}.h5", _SHAFT).sel(bearing=wear.place)
    cycles = cycles_of(dlc, scene, options, film, loads, shaft)
    if not cycles:
        return None
    warmth = 0.0
    if options.heat is not None and "temperature" in film:
        warmth = float(film["temperature"].median()) - options.heat.inlet_temperature
    try:
        return Rubbing(wear.place, cycles[0], warmth).begun_in(options)
    except SolverError:
        return None


def with_error(run: Finished, wear: Number) -> Number:
    """Wear with its error by models: that of its coefficient, and of the films that it begins in.

    The load case that wears most is followed again with surfaces rougher by the error of the
    smallest film, which is what thinner films are to asperities. Where that film may be off by 100
    % or has no error, or the case no answer, that of the coefficient stands alone, which is said.
    """
    if not wear.value > 0:
        return wear
    film, rubs = error_of(run, "journal.film", "minimum film"), None
    if film < 1:
        rubs = rubbing_of(run, wear)
    more = math.nan
    if rubs is not None:
        options = run.scene.journal.at(rubs.place)
        contact = options.contact and options.contact.as_rough(1.0 + film)
        rougher = options.model_copy(update={"contact": contact})
        rubbed = rubs.energy(options)
        if rubbed > 0:
            more = max(rubs.energy(rougher) / rubbed, 1.0)
    told = f"× {more:.3g} by the error of the films" if more >= 1 else "error of films not counted"
    said = f"coefficients differ by up to {BATCHES:g} from batch to batch, {told}"
    error = BATCHES * (more if more >= 1 else 1.0) - 1.0
    return replace(wear, error=error, note="; ".join(filter(None, (wear.note, said))))
