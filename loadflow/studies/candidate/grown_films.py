"""Films of a design as its loads grow, to where they reach a limit."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from loadflow.journal.line import Line
from loadflow.journal.models.model import why_not
from loadflow.scene.journal import Journal
from loadflow.stages.films.of_bearing import equilibria, shaft_line

FACTORS = np.geomspace(1 / 8, 8, 25)
"""Factors on the loads among which that is sought with which a film reaches its limit."""


COARSE = (48, 12)
"""Cells at most of a film that is solved on the grid."""


def fast_journal(options: Journal) -> Journal:
    """A journal bearing at rest by the cheapest model of cells that knows all of it."""
    still = options.model_copy(update={"motion": "quasi-static"})
    line = Line(moment=np.zeros((1, 2))) if options.tilt else Line()
    reduced = still.model_copy(update={"rung": "reduced", "grading": "auto"})
    if why_not("at_rest", reduced.film_model, options.geometry, line) is None:
        return reduced
    around, across = (min(cells) for cells in zip(options.grid, COARSE))
    return still.model_copy(update={"rung": "grid", "grid": (around, across)})


def pressed(options: Journal, samples: xr.Dataset, answer: Any) -> np.ndarray:
    """Largest film pressure of samples of a spectrum, Pa; 0 where it is none to judge.

    Where the shaft starts, stops or stands, a film without asperities has one up to E_krit, as in
    the summary of a run.
    """
    counts = answer.converged
    if options.contact is None:
        floats = options.critical.left(answer.eccentricity_ratio, answer.minimum_film) >= 1
        counts = counts & (samples["running"].values.astype(bool) | floats)
    return np.where(counts, answer.maximum_pressure, 0.0)


class GrownFilms:
    """Films at rest of a bearing under the samples of a spectrum, and under more load and less.

    Parameters
    ----------
    options : Journal
        The bearing and its film.
    samples : xarray.Dataset
        Of `loadflow.studies.lifetime.load_spectrum.load_spectrum`, of its place.
    """

    def __init__(self, options: Journal, samples: xr.Dataset) -> None:
        self.options, self.samples = options, samples
        self._grown: dict[tuple[int, int], Any] = {}

    def at(self, index: np.ndarray, factor: float = 1.0) -> Any:
        """Equilibria of some samples with a factor on their loads."""
        some = self.samples.isel(sample=index)
        force = factor * some["force"].transpose("sample", "axis").values
        return equilibria(
            self.options, force, some["speed"].values, **shaft_line(self.options, some)
        )

    def grown(self, sample: int, k: int) -> Any:
        """Equilibrium of one sample with the factor `k` of `FACTORS` on its load."""
        if (sample, k) not in self._grown:
            self._grown[sample, k] = self.at(np.array([sample]), FACTORS[k])
        return self._grown[sample, k]

    def crossing(self, sample: int, name: str, limit: float, falls: bool) -> float:
        """Factor on the load of a sample at which a value reaches its limit.

        Halved among `FACTORS`, as more load brings the limit nearer, and between two of them in
        straight lines.
        """

        def distance(k: int) -> float:
            value = float(getattr(self.grown(sample, k), name)[0])
            told = math.log(max(value, 1e-300) / limit)
            return (told if falls else -told) if math.isfinite(told) else -math.inf

        good, bad, k = -1, FACTORS.size, FACTORS.size // 2
        while bad - good > 1:
            good, bad = (k, bad) if distance(k) >= 0 else (good, k)
            k = (good + bad) // 2
        if bad == FACTORS.size or good < 0:
            return float(FACTORS[max(good, 0)])
        low, high = distance(good), distance(bad)
        if not math.isfinite(high):
            return float(FACTORS[good])
        return float(FACTORS[good] * (FACTORS[bad] / FACTORS[good]) ** (low / (low - high)))
