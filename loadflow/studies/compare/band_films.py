"""Films of journal bearings for bands by tolerances: all samples as stated, at the ends few.

A tolerance moves an answer by a share. Which sample has the thinnest film or the largest pressure
is known from the bearings as stated, and means follow from the few that last longest, so that only
those are solved at the ends, their heat balances and pads from those as stated.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.journal import Equilibrium
from loadflow.scene.journal import Journal
from loadflow.stages.films.of_bearing import equilibria, shaft_line
from loadflow.stages.frames import to_film
from loadflow.studies.candidate.grown_films import fast_journal, pressed

HEAVIER = 1.1
"""Factor on a load, for the power of it that an answer follows."""

LASTING = 4
"""Samples of a place that stand for all in the means at the ends of tolerances."""

_DOUBTFUL = 2.9  # times its critical film a film may cross it at an end; ε from 0.855 of 0.95

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Films:
    """Films of a bearing under samples of a spectrum, and of the hardest under more load.

    Attributes
    ----------
    options : Journal
        The bearing, with the cheap model.
    samples : xarray.Dataset
        The samples, with the weights that they count with.
    answer : Equilibrium
        Of all samples.
    thin, hard : int
        Samples of the thinnest film, of those that run, and of the largest pressure.
    heavier : Equilibrium
        Of these two, under `HEAVIER` times their load.
    """

    options: Journal
    samples: xr.Dataset
    answer: Equilibrium
    thin: int
    hard: int
    heavier: Equilibrium

    @property
    def judged(self) -> NDArray[np.bool_]:
        """Samples whose film is held to the limit: the rotor runs."""
        return _judged(self.samples, self.answer)


@dataclass(frozen=True)
class Deciding:
    """Samples of a place that decide, where they are among all, and what is known of them."""

    places: NDArray[np.int64]
    films: Films

    def of(self, options: Journal, samples: xr.Dataset) -> Films:
        """Films of a bearing much like the one as stated, under its samples of these places.

        Where films do not depend on what differs, such as the roughness of a smooth model, they are
        those as stated.
        """
        known = self.films
        some = samples.isel(sample=self.places).assign(weight=known.samples["weight"])
        if options.film_model == known.options.film_model and (
            options.geometry == known.options.geometry and _alike(some, known.samples)
        ):
            return replace(known, options=options, samples=some)
        return films_of(options, some, known)


def films_of(options: Journal, samples: xr.Dataset, near: Films | None = None) -> Films:
    """Films of a bearing, from those of one that differs little if they are given.

    Afresh they take 1.8 times the processor time: tilting pads of 2 m with warm oil, clearance
    and oil a tenth off.
    """
    answer = _at(options, samples, 1.0, None if near is None else near.answer)
    judged = _judged(samples, answer)
    thin = int(np.argmin(np.where(judged, answer.minimum_film, np.inf)))
    hard = int(np.argmax(pressed(options, samples, answer)))
    two = np.array([thin, hard])
    heavier = _at(options, samples.isel(sample=two), HEAVIER, _rows(answer, two))
    return Films(options, samples, answer, thin, hard, heavier)


def films_at(
    journal: Journal, spectrum: xr.DataTree, deciding: Mapping[str, Deciding] | None = None
) -> dict[str, Films]:
    """Films of all bearings, by place: under all samples, or those that decide."""
    found = {}
    for place in journal.bearings:
        options, samples = fast_journal(journal.at(place)), spectrum[place].to_dataset()
        known = None if deciding is None else deciding.get(place)
        found[place] = films_of(options, samples) if known is None else known.of(options, samples)
    return found


def deciding_of(films: Films) -> Deciding:
    """Samples that decide at the ends of tolerances, out of all.

    The thinnest film, the largest pressure and the largest eccentricity; films that may cross the
    critical eccentricity; and those that last longest. Others count with the one of the last whose
    load and speed are nearest.
    """
    answer, samples, options = films.answer, films.samples, films.options
    weight = samples["weight"].values
    ratio = np.where(films.judged, answer.eccentricity_ratio, 0.0)
    turning = answer.converged & (weight > 0)
    left = options.critical.left(answer.eccentricity_ratio, answer.minimum_film)
    doubtful = turning & (left < _DOUBTFUL)
    lasting = np.argsort(np.where(turning, weight, 0.0))[::-1][:LASTING]
    lasting = lasting[turning[lasting]]
    some = [films.thin, films.hard, int(np.argmax(ratio)), *np.flatnonzero(doubtful), *lasting]
    places = np.unique(np.array(some, dtype=np.int64))
    shared = np.where(np.isin(np.arange(weight.size), places), weight, 0.0)
    if lasting.size:
        near = _nearest(samples, lasting)
        others = np.setdiff1d(np.flatnonzero(weight > 0), places)
        np.add.at(shared, lasting[near[others]], weight[others])
    kept = samples.isel(sample=places)
    kept = kept.assign(weight=kept["weight"].copy(data=shared[places]))
    thin, hard = (int(np.searchsorted(places, one)) for one in (films.thin, films.hard))
    own = Films(options, kept, _rows(answer, places), thin, hard, films.heavier)
    return Deciding(places, own)


def _nearest(samples: xr.Dataset, some: NDArray[np.int64]) -> NDArray[np.int64]:
    """Which of `some` samples has the nearest radial load and speed, for each sample."""
    load = np.hypot(*to_film(samples["force"].transpose("sample", "axis").values).T)
    points = np.column_stack([load, np.abs(samples["speed"].values)])
    points = points / np.maximum(points.max(axis=0), 1e-300)
    return np.argmin(np.linalg.norm(points[:, None] - points[some], axis=2), axis=1)


def _rows(answer: Equilibrium, places: NDArray[np.int64]) -> Any:
    """Some rows of an answer; what all rows share stays."""
    count = answer.converged.size
    rows = {
        name: value[places]
        for name, value in vars(answer).items()
        if isinstance(value, np.ndarray) and value.shape[:1] == (count,)
    }
    return replace(answer, **rows)


def _at(
    options: Journal, samples: xr.Dataset, factor: float, near: Equilibrium | None
) -> Equilibrium:
    """Films under samples of a spectrum with a factor on the loads."""
    force = factor * samples["force"].transpose("sample", "axis").values
    line = shaft_line(options, samples)
    return equilibria(options, force, samples["speed"].values, near, **line)


def _judged(samples: xr.Dataset, answer: Equilibrium) -> NDArray[np.bool_]:
    return np.asarray(answer.converged & samples["running"].values.astype(bool))


def _alike(one: xr.Dataset, other: xr.Dataset) -> bool:
    """Whether loads and shaft are the same."""
    names = [name for name in ("force", "speed", "moment", "tilt", "curvature") if name in other]
    return all(np.array_equal(one[name].values, other[name].values) for name in names)


def load_margins(reserves: Sequence[float], grown: Sequence[float]) -> list[float]:
    """Factors on the load to each limit, by the power of the load that answers follow.

    `reserves` are what is left to the limits, `grown` what a load `HEAVIER` makes of the answers,
    as factors both.
    """
    pairs = ((reserve, np.log(one)) for reserve, one in zip(reserves, grown))
    return [
        float(reserve ** (math.log(HEAVIER) / abs(step)))
        for reserve, step in pairs
        if math.isfinite(step) and step != 0
    ]
