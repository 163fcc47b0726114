"""Load spectra of journal bearings → the best crown of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError, SolverError
from loadflow.journal import BestCrown, best_crown
from loadflow.scene.design import Crowning
from loadflow.scene.journal import Journal
from loadflow.stages.films.of_bearing import shaft_line
from loadflow.stages.frames import to_film
from loadflow.studies.lifetime.load_spectrum import STANDING_SHARE

_OFF_STREAM = "no sample of its spectrum turns"
_SCALES = {"minimum_film": (1e6, "µm"), "maximum_pressure": (1e-6, "MPa")}
HEADS = ("bearing", "crown", "length", "aim", "without", "with", "loads", "crowns tried")


@dataclass(frozen=True)
class PlaceCrown:
    """The best crown of the bearing at a place.

    Attributes
    ----------
    place : str
        On the shaft.
    found : BestCrown
        The crown, and the films with it and without.
    sample : int
        Of the spectrum, the one that governs.
    """

    place: str
    found: BestCrown
    sample: int

    def as_dict(self) -> dict[str, Any]:
        """Numbers in SI units."""
        found = self.found
        return {
            "bearing": self.place,
            "height": found.crown.height if found.crown else 0.0,
            "length": found.crown.length if found.crown else 0.0,
            "exponent": found.crown.exponent if found.crown else None,
            "aim": found.aim,
            "without": found.without if np.isfinite(found.without) else None,
            "with": found.value,
            "governing_sample": self.sample,
            "loads": int(np.size(found.states.converged)),
            "converged": found.converged,
            "residual": found.residual,
            "iterations": found.iterations,
        }

    @property
    def row(self) -> tuple[str, ...]:
        """Words under `HEADS`."""
        found, (scale, unit) = self.found, _SCALES[self.found.aim]
        crown = found.crown
        height = "none" if crown is None else f"{1e6 * crown.height:.4g} µm"
        length = "" if crown is None else f"{1e3 * (crown.length or 0.0):.4g} mm"
        values = (
            f"{scale * value:.4g} {unit}" if np.isfinite(value) and value else "no film"
            for value in (found.without, found.value)
        )
        count = str(np.size(found.states.converged))
        aim = found.aim.replace("_", " ")
        return (self.place, height, length, aim, *values, count, str(found.iterations))


def crowns_of(
    journal: Journal, spectrum: Mapping[str, xr.Dataset], wanted: Crowning
) -> tuple[PlaceCrown, ...]:
    """Find the best crown of each journal bearing under its load spectrum.

    Samples that stand or start are left out: their films are none of the oil alone. The film is
    that of the scene on the rung "grid".

    Parameters
    ----------
    journal : Journal
        The bearings; its shaft tilts.
    spectrum : mapping
        By place, samples as of `loadflow.studies.lifetime.load_spectrum.load_spectrum`.
    wanted : Crowning
        The aim and its bounds.

    Raises
    ------
    loadflow.errors.InputError
        A shaft that is held aligned; a film that knows no crown; nothing that turns.
    loadflow.errors.SolverError
        Names the bearing that no crown leaves a film, or whose search does not end.
    """
    if not journal.tilt:
        raise InputError("design.crown: needs journal.tilt = true, as an aligned shaft wants none")
    found = []
    for place in journal.bearings:
        options, samples = journal.at(place), spectrum[place]
        speed = samples["speed"].values.astype(float)
        fast = np.abs(speed) > STANDING_SHARE * np.abs(speed).max(initial=0.0)
        some = np.flatnonzero(fast & samples["running"].values.astype(bool))
        if some.size == 0:
            raise InputError(f"design.crown: {place}: {_OFF_STREAM}")
        of_place = samples.isel(sample=some)
        line: dict[str, Any] = {
            name: to_film(rows) for name, rows in shaft_line(options, of_place).items()
        }
        force = to_film(of_place["force"].transpose("sample", "axis").values.astype(float))
        try:
            best = best_crown(
                options.geometry, force, speed[some], replace(options.film_model, rung="grid"),
                aim=wanted.aim, largest_height=wanted.largest_height, exponent=wanted.exponent,
                **line,
            )  # fmt: skip
        except SolverError as error:
            raise SolverError(f"{place}: {error}") from error
        found.append(PlaceCrown(place, best, int(some[best.governs])))
    return tuple(found)
