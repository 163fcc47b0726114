"""What a reduction costs: film of the reduced series against the full one, and the orbit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import standing
from loadflow.errors import SolverError
from loadflow.scene.journal import Journal
from loadflow.stages.films.past import Past, after_past, past_of_speed
from loadflow.stages.films.temperature import mean_temperature
from loadflow.stages.journal import fast_film
from loadflow.studies.bearing_series import BearingSeries

Floats = np.ndarray

MEASURES = ("E_max", "E_mean", "So_max", "So_mean", "energy")
HEADS = (
    "case",
    "bearing",
    "kept, %",
    "E_max",
    *(f"Δ{name}, %" for name in MEASURES),
    "E_max of the orbit",
    "over it, %",
)


@dataclass(frozen=True)
class Films:
    """Film of every sample of a series.

    Attributes
    ----------
    ratio : ndarray, shape (n,)
        Eccentricity ratio at static equilibrium; NaN where no film carries the load.
    number : ndarray, shape (n,)
        p_max ψ²/(η ω), the "So" of the tables of [Jonuschies 2015].
    power : ndarray, shape (n,)
        Friction power, W.
    orbit : ndarray, shape (n,) or (0,)
        Eccentricity ratio of the orbit under the whole series; empty if it was not followed.
    """

    ratio: Floats
    number: Floats
    power: Floats
    orbit: Floats

    def part(self, places: slice) -> Films:
        """Films of a stretch of the series."""
        return Films(*(getattr(self, n)[places] for n in ("ratio", "number", "power", "orbit")))

    def measures(self, index: Any = slice(None), weight: Floats | None = None) -> Floats:
        """`MEASURES` of the samples `index`, the means weighted; where there is a film."""
        ratio, number, power = self.ratio[index], self.number[index], self.power[index]
        there = np.isfinite(ratio)
        share = there.astype(float) if weight is None else weight * there
        if not share.any():
            return np.full(len(MEASURES), np.nan)
        kept = (np.where(there, x, 0.0) for x in (ratio, number, power))
        e, so, p = (float(np.average(x, weights=share)) for x in kept)
        return np.array([ratio[there].max(), e, number[there].max(), so, p])


def solve_films(series: BearingSeries, journal: Journal, transient: bool = True) -> Films:
    """Solve the film of every sample of a series, and follow its orbit.

    Parameters
    ----------
    series : BearingSeries
        Bearing in a case.
    journal : Journal
        Bearing, oil and model of the film: the section of a scene.
        A heat balance gives all films of the series one temperature.
    transient : bool
        Whether to follow the orbit. A series in which the shaft stands has none.
    """
    bearing, force, speed = journal.geometry, series.radial, series.speed
    temperature = mean_temperature(journal, force, speed)
    journal = journal if temperature is None else journal.at_temperature(temperature)
    film = bearing.equilibrium(force, speed, journal.film_model, strict=False)
    found = np.asarray(film.converged, dtype=bool)
    drag = journal.lubricant.viscosity * np.where(found, np.abs(speed), np.nan)
    orbit = _orbit(series, journal) if transient and found.all() else np.empty(0)
    return Films(
        np.where(found, film.eccentricity_ratio, np.nan),
        film.maximum_pressure * bearing.relative_clearance**2 / drag,
        np.where(found, film.friction_power, np.nan),
        orbit,
    )


def _orbit(series: BearingSeries, journal: Journal) -> Floats:
    """Eccentricity ratio along a series, (n,); (0,) if no film is found, as the table then says.

    It begins with the past of the films of a run, and at rest where that has none.
    """
    given = {"time": series.time, "speed": series.speed, "force": series.radial}
    step = float(np.ptp(series.time)) / (series.time.size - 1)
    runs = ~standing(xr.Dataset({"speed": ("time", series.speed)})).values

    def path(past: Past) -> Floats:
        loads: dict[str, Any] = past.before(given)
        found = journal.geometry.orbit(**loads, film=journal.film_model)
        return np.asarray(found["eccentricity_ratio"].values[past.steps :])

    try:
        return after_past(path, past_of_speed(series.speed, step, runs), series.time)
    except SolverError:  # the static films stand for themselves
        return np.empty(0)


def for_long_series(journal: Journal) -> Journal:
    """Take the film that is cheap over a long series, where none is named and it knows the film."""
    return journal if "rung" in journal.model_fields_set else fast_film(journal) or journal


@dataclass(frozen=True)
class FilmError:
    """Film of a reduced series beside that of the full one.

    Attributes
    ----------
    full, reduced : ndarray, shape (5,)
        `MEASURES` of both; energy as mean friction power in W.
    orbit : float
        Largest eccentricity ratio of the orbit under the full series; NaN if not followed.
    """

    full: Floats
    reduced: Floats
    orbit: float

    @classmethod
    def of(cls, films: Films, reduced: xr.Dataset) -> FilmError:
        """Compare; `reduced` has the places and weights that were kept."""
        kept = films.measures(reduced["index"].values, reduced["weight"].values)
        largest = float(films.orbit.max()) if films.orbit.size else np.nan
        return cls(films.measures(), kept, largest)

    @property
    def deviation(self) -> Floats:
        """Relative deviation of the reduced series (5,)."""
        return self.reduced / self.full - 1.0

    @property
    def true_error(self) -> float:
        """Of the largest eccentricity ratio: reduced, quasi-static against full, transient."""
        return float(self.reduced[0] / self.orbit - 1.0)

    def as_dict(self) -> dict[str, Any]:
        """The comparison in plain values, for JSON."""
        return {
            "full": dict(zip(MEASURES, self.full.tolist())),
            "reduced": dict(zip(MEASURES, self.reduced.tolist())),
            "orbit_E_max": self.orbit,
            "true_error": self.true_error,
        }

    def as_row(self, case: str, bearing: str, kept: float) -> list[str]:
        """The comparison under `HEADS`; `kept` is a share."""
        changes = [f"{100 * x:+.3f}" for x in self.deviation.tolist()]
        orbit = [f"{self.orbit:.4f}", f"{100 * self.true_error:+.2f}"]
        if np.isnan(self.orbit):
            orbit = ["-", "-"]
        return [case, bearing, f"{100 * kept:.1f}", f"{self.full[0]:.4f}", *changes, *orbit]


def summary_rows(errors: Iterable[FilmError]) -> list[list[str]]:
    """Mean of the absolute deviations and standard deviation, under `HEADS`."""
    found: Sequence[FilmError] = list(errors)
    deviation = 100 * np.array([error.deviation for error in found])
    true = 100 * np.array([error.true_error for error in found if np.isfinite(error.orbit)])

    def row(name: str, values: Floats, last: float) -> list[str]:
        errors_of = f"{last:.2f}" if true.size else "-"
        return [name, "", "", "", *(f"{v:.3f}" for v in values.tolist()), "", errors_of]

    return [
        row(
            "mean of absolute values",
            np.abs(deviation).mean(axis=0),
            np.abs(true).mean() if true.size else 0,
        ),
        row("standard deviation", deviation.std(axis=0), true.std() if true.size else 0),
    ]
