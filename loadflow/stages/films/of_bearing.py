"""The film of a scene's bearing under loads in the frame of the cube: at rest, and in time."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.journal import Control, Equilibrium, Film
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.transition import load_capacity
from loadflow.scene.journal import Journal
from loadflow.stages.films.past import AT_REST, Past, after_past
from loadflow.stages.frames import from_film, to_film

_CERTAIN = 1.2  # times the load that a film as thin as the roughness carries: no film is asked
_LIGHT = 10.0  # Sommerfeld number below which the film is asked in any case
_NEARLY_WARM = 0.01  # K: moves a film by less than 0.1 %, beside another bearing's that is asked
_IN_MOTION = Control(tolerance=1e-6)  # 1e-8 moves films by 4e-5 at most, for an eighth more time


def follow(
    options: Journal,
    loads: xr.Dataset,
    bearing: xr.Dataset,
    start: np.ndarray | None = None,
    past: Past = AT_REST,
) -> xr.Dataset:
    """Follow the shaft through a series, from equilibrium or from the place `start` (2,), m.

    With a `past` it goes through that before; where a film cannot be followed there, or for as long
    after it as that is remembered, it begins at rest under the first load, with a warning.

    With heat the result has the `temperature` of the film: that of the whole series, or one that
    follows where heat is stored. A shaft with `tilt` lies as its beam says, or tilts freely.
    """
    series = {name: loads[name].values.astype(float) for name in ("time", "speed")}
    force = bearing["force"].transpose("time", "axis").values.astype(float)
    vectors = {"force": force, **shaft_line(options, bearing)}
    series |= {name: to_film(rows) for name, rows in vectors.items()}

    def path(past: Past) -> xr.Dataset:
        given: dict[str, Any] = past.before(series)
        film = options.film_model
        with unresolved_counted():  # `films.summary` tells of them
            found = options.geometry.orbit(**given, film=film, start=start, control=_IN_MOTION)
        return found.isel(time=slice(past.steps, None))

    return after_past(path, past, series["time"])


def shaft_line(options: Journal, bearing: xr.Dataset) -> dict[str, np.ndarray]:
    """How the shaft lies in the bearing: as its beam says, or free under a moment, or aligned.

    Keywords of `equilibria`, each (n, 3), from a series of loads with a last dimension ``axis``.
    """
    if not options.tilt:
        return {}
    names = {"moment": "moment"}
    if "tilt" in bearing and bool(bearing["tilt"].notnull().all()):
        names = {"tilt": "tilt", "bend": "curvature"}
    lying = {
        key: bearing[name].transpose(..., "axis").values.astype(float)
        for key, name in names.items()
    }
    if "tilt" in lying:
        lying["tilt"] = lying["tilt"] - _bore(options, bearing)
    return lying


def _bore(options: Journal, bearing: xr.Dataset) -> np.ndarray:
    """Turn of the bore (3,), rad, as stated, or as it follows the shaft that `bearing` tells of."""
    if options.alignment == "mean":
        return np.asarray(bearing["alignment"].values, dtype=float)
    return from_film(options.alignment)


def aligned(options: Journal, bearing: xr.Dataset) -> xr.Dataset:
    """Series of loads in which a shaft with `tilt` lies straight along its bore."""
    held = _bore(options, bearing)
    series = bearing.assign(moment=0.0 * bearing["moment"])
    if "tilt" in bearing:
        still = xr.zeros_like(bearing["tilt"]) + xr.DataArray(held, dims="axis")
        series = series.assign(tilt=still, curvature=xr.zeros_like(bearing["curvature"]))
    return series


def equilibria(
    options: Journal,
    force: np.ndarray,
    speed: np.ndarray,
    near: Equilibrium | None = None,
    /,
    **line: np.ndarray,
) -> Equilibrium:
    """Solve the film of a scene's bearing for `force` (n, 3) in the cube's frame, N.

    With a `moment` (n, 3), N m, the shaft tilts under it; with a `tilt` (n, 3), rad, and a `bend`,
    1/m, it lies as they say; without, it stays aligned. From films `near` of a bearing
    that differs little, heat balances are solved to `_NEARLY_WARM`.
    """
    lying: dict[str, Any] = {name: to_film(vectors) for name, vectors in line.items()}
    if near is not None:
        lying |= {"near": near, "heat_tolerance": _NEARLY_WARM}
    with unresolved_counted():  # `films.summary` counts them
        return options.geometry.equilibrium(
            to_film(force), speed, options.film_model, strict=False, **lying
        )


def surely_touching(options: Journal, force: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Whether shaft and shell touch under each load (n, 3), N, in the cube's frame, for certain.

    At standstill, and where the load is far above what the film of the coldest oil carries when it
    is as thin as both surfaces are rough. The others have to be solved, and so have those of an
    elastic shell, which carries more the more it gives way.
    """
    film = _coldest(options)
    load, turning = np.hypot(*to_film(force).T), np.abs(speed) > 0
    if options.contact is not None:  # the film knows what asperities carry
        return np.zeros_like(turning)
    touching, doubtful = np.asarray(~turning), np.zeros_like(turning)
    if options.shell is None:
        number = options.geometry.sommerfeld_number(load, speed, film.liquid.viscosity)
        doubtful = turning & (number > _LIGHT)
    if doubtful.any():
        capacity = load_capacity(options.geometry, options.contact_film, speed[doubtful], film)
        touching[doubtful] = load[doubtful] > _CERTAIN * capacity
    return touching


def surely_carried(options: Journal, force: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Whether a film carries each load (n, 3), N, well before the surfaces touch: it is light."""
    load, viscosity = np.hypot(*to_film(force).T), _coldest(options).liquid.viscosity
    turning = np.abs(speed) > 0
    number = options.geometry.sommerfeld_number(load, np.where(turning, speed, 1.0), viscosity)
    return np.asarray(turning & (number <= _LIGHT))


def _coldest(options: Journal) -> Film:
    """The film with its oil as cold as it can be."""
    film = options.film_model.isothermal()
    if options.heat is None:
        return film
    return replace(film, lubricant=options.heat.lubricant(options.heat.coldest))
