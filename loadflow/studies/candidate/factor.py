"""How far a candidate is from a limit: factors on its loads, sought where the limit is nearest."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr
from scipy.optimize import brentq

from loadflow.cube.hdf5 import read_variables
from loadflow.errors import SolverError
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.frames import slope_of
from loadflow.studies.candidate.seeds import Draw, of_extreme, power_of_load
from loadflow.studies.verdicts.verdicts import warm_in
from loadflow.tribology.film import short_bearing

SAMPLES = 40
"""Samples of each case that are looked at again, the extremes among them."""

WIDEST = 16.0
"""Factor on load or viscosity beyond which nothing is asked."""

LOADS, LINE = ("force", "moment"), ("tilt", "curvature")
"""What acts on a bearing, and how the shaft lies in it."""

CLEARANCE_TILT = "clearance_tilt"
"""Part of the tilt of a shaft that it has by its places in the films of its journal bearings."""

_RATIOS = 1.0 - np.geomspace(1.0, 1e-4, 2001)  # eccentricity ratios, from 0
_CARRIED = short_bearing(_RATIOS, 1.0)[0]  # Sommerfeld numbers there, which go with the load

NEVER = 1.05
"""Over the least factor that is asked: with less, the limit was not reached."""

_HALVINGS = 9
_CLOSE = 2e-3  # logarithm of a factor: less than films of these models are good to
_OUTWARD = 4  # steps to where a limit should be, beyond which the widest factor is asked
_STEPS = 40  # of the root finder; 16 in all are the most that curved reserves took
_NONE = 50.0  # logarithm of a reserve that is as good as none


@dataclass(frozen=True)
class Margin:
    """How far a candidate is from its first limit.

    Attributes
    ----------
    factor : float
        On all loads, with which the first limit is reached; below 1 if it is broken.
    place, case : str
        Where.
    governs, change : str
        Which limit that is; what else would reach it.
    drawn : callable, optional
        The factor that some of the cases would give, for the seeds.
    low, high : float
        Interval by the seeds, of all limits together.
    time : float
        Time of an extreme in its case, s; NaN for what is no extreme.
    models : tuple of str
        Result and quantity whose error by models the factor has.
    power : float
        Of the load that this quantity follows.
    uncounted : str
        Limits whose factor has no answer, and why.
    """

    factor: float
    place: str = ""
    case: str = ""
    governs: str = ""
    change: str = ""
    drawn: Draw | None = field(default=None, compare=False, repr=False)
    low: float = math.nan
    high: float = math.nan
    time: float = math.nan
    models: tuple[str, str] = ("", "")
    power: float = math.nan
    uncounted: str = ""


def largest_factor(holds: Callable[[float], bool]) -> float:
    """Largest factor with which something holds that holds for all smaller ones."""
    low, high = 1 / WIDEST, WIDEST
    for _ in range(_HALVINGS):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return math.sqrt(low * high)


def film_factors(value: Callable[[float, float], float], limit: float) -> tuple[float, float]:
    """Largest factor on the load, and smallest on the viscosity, with which a film is allowed."""
    load = _crossing(lambda f: math.log(value(f, 1.0) / limit))
    return load, 1.0 / _crossing(lambda f: math.log(value(1.0, 1.0 / f) / limit))


def of_load(value: Callable[[float, float], float], load: float) -> float:
    """A value of a film with a factor on the load alone."""
    return value(load, 1.0)


@dataclass(frozen=True)
class FilmExtreme:
    """Smallest film or largest pressure that a run has of a bearing, and its limit.

    Attributes
    ----------
    quantity : str
        Field of an answer: ``"minimum_film"`` or ``"maximum_pressure"``.
    what, place, case : str
        In words; where.
    time : float
        In its case, s; NaN if it is not known.
    value, limit : float
        m, or Pa at the temperature of the film in that case.
    pick : callable
        Which of several cases: `numpy.nanmin` of a film, `numpy.nanmax` of a pressure.
    seen : xarray.DataArray
        Extremes of the run, by load case.
    """

    quantity: str
    what: str
    place: str
    case: str
    time: float
    value: float
    limit: float
    pick: Callable[[np.ndarray], float]
    seen: xr.DataArray


def film_extremes(
    bearing: Journal | AnyAxial, place: str, table: xr.Dataset
) -> Iterator[FilmExtreme]:
    """Yield smallest film and largest pressure of a bearing, those that a run has.

    Limits are those of the verdicts: a material carries less the warmer the film of the case is.
    """
    for name, pick, quantity, what in (
        ("smallest_film", np.nanmin, "minimum_film", "smallest film"),
        ("largest_pressure", np.nanmax, "maximum_pressure", "largest film pressure"),
    ):
        seen = table[name]
        if not np.isfinite(seen.values).any():
            continue
        worst = int(np.nanargmax(seen.values == pick(seen.values)))
        case = str(table["case"].values[worst])
        time = float(table[f"{name}_time"].values[worst]) if f"{name}_time" in table else math.nan
        limit = bearing.least_film
        if quantity == "maximum_pressure":
            limit = bearing.limits.pressure_at(warm_in(table, case))
        value = float(seen.values[worst])
        yield FilmExtreme(quantity, what, place, case, time, value, limit, pick, seen)


def film_margin(
    one: FilmExtreme,
    value: Callable[[float, float], float],
    bearing: Journal | AnyAxial,
    room: str,
    whose: str,
    told: str,
) -> Margin:
    """Margin of a smallest film or a largest pressure, with what else would bring it to its limit.

    Parameters
    ----------
    one : FilmExtreme
        Of the run; motion and what else the models of `value` leave out is taken to change it by
        the same share under any load.
    value : callable
        Film, m, or pressure, Pa, with factors on load and viscosity.
    bearing : Journal or bearing of pads
        What carries.
    room : str
        Whose error by models it has: ``"journal"`` or ``"thrust"``.
    whose, told : str
        The bearing, and the limit, in words.
    """
    allowed, change = one.limit / one.value * value(1.0, 1.0), ""
    if one.quantity == "minimum_film":
        factor, thinner = film_factors(value, allowed)
        if thinner > NEVER / WIDEST:
            change = f"{whose}: {oil_told(bearing, thinner)}"
    else:
        factor = pressure_factor(value, allowed)
    power = power_of_load(partial(of_load, value), factor, WIDEST)
    return Margin(
        factor, one.place, one.case, told, change, of_extreme(one.seen, one.pick, factor, power),
        time=one.time, models=(f"{room}.film", one.quantity.replace("_", " ")), power=power,
    )  # fmt: skip


def pressure_factor(value: Callable[[float, float], float], limit: float) -> float:
    """Largest factor on the load with which a pressure is allowed."""
    return _crossing(lambda f: -math.log(value(f, 1.0) / limit))


def _crossing(reserve: Callable[[float], float]) -> float:
    """Factor to `_CLOSE` at which a reserve, which falls with it, is used up, within `WIDEST`.

    On the side where some is left; there is none without an answer, which is that of a factor that
    is too large. Steps by the power of the factor that the reserve follows lead to bounds around
    it, and Brent's method in its logarithm between these.

    Raises
    ------
    loadflow.errors.SolverError
        Not found in `_STEPS`.
    """
    seen: dict[float, float] = {}

    def known(x: float) -> float:
        if x not in seen:
            try:
                found = reserve(math.exp(x))
            except ValueError:  # logarithm of what is not there
                found = -math.inf
            seen[x] = found if math.isfinite(found) else -math.inf
        return seen[x]

    widest = math.log(WIDEST)
    low, high, x, power = -widest, widest, 0.0, 1.0
    for _ in range(_OUTWARD):
        left = known(x)
        low, high = (x, high) if left >= 0 else (low, x)
        if {low, high} <= seen.keys() or not math.isfinite(left):
            break
        before, step = x, 1.2 * left / power + (_CLOSE if left >= 0 else -_CLOSE)
        x = min(max(x + step, -widest), widest)
        steep = (left - known(x)) / (x - before)
        power = steep if 0 < steep < math.inf else power
    if known(high) >= 0:
        return WIDEST
    if known(low) < 0:
        return 1.0 / WIDEST
    while high - low > _CLOSE and not math.isfinite(known(high)):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if known(middle) >= 0 else (low, middle)
    if high - low <= _CLOSE:
        return math.exp(low)
    try:
        root = brentq(lambda x: max(known(x), -_NONE), low, high, xtol=_CLOSE, maxiter=_STEPS)
    except RuntimeError as error:
        raise SolverError(f"no factor on load or viscosity to a limit of films: {error}") from error
    return math.exp(max(x for x, left in seen.items() if left >= 0 and x <= root))


def life_factor(hours: Callable[[float], float], limit: float) -> float:
    """Largest factor on the load with which a life reaches its limit."""
    return _crossing(lambda f: min(math.log(hours(f) / limit), _NONE))  # no load wears nothing


def oil_told(bearing: Journal | AnyAxial, factor: float = 1.0) -> str:
    """In words, the oil of a film, or one so many times as thick."""
    where = "" if bearing.film_model.heat is None else " as it enters"
    return f"oil of {1e3 * factor * bearing.film_model.liquid.viscosity:.3g} mPa s{where}"


def reduced_samples(path: Path, place: str) -> xr.Dataset:
    """Loads, speed, time and weight of the samples that a bearing was solved for in a case."""
    return read_variables(path, ("force", "moment", "speed", "weight", "time"), place)


def series_of(scene: Scene, folder: Path, case: str, place: str) -> xr.Dataset:
    """What acts on a bearing through a case, and how the shaft lies in it.

    `time`, `speed` (sample), `force`, `moment` and, of a shaft that bends, `tilt`, `curvature`
    (sample, axis), and `alignment` (axis) of a bore that follows it, in the frame of the cube; of
    one that films hold `clearance_tilt` (sample, axis), too.
    """
    speed = read_variables(folder / "loads" / f"{case}.h5", ("speed",))["speed"]
    names = (*LOADS, *LINE, "alignment", "displacement")
    shaft = at_place(scene, read_variables(folder / "shaft" / f"{case}.h5", names), place)
    known = [
        name
        for name in (*LOADS, *LINE, "alignment", CLEARANCE_TILT)
        if name in shaft and bool(shaft[name].notnull().all())
    ]
    series = shaft[known].assign(speed=("time", speed.values)).rename(time="sample")
    time = speed["time"].values.astype(float)
    return series.drop_vars("sample", errors="ignore").assign(time=("sample", time))


def at_place(scene: Scene, shaft: xr.Dataset, place: str) -> xr.Dataset:
    """Loads and shaft of one bearing, with `clearance_tilt` where films hold the shaft.

    By `film`: how far the place of the shaft there turns the straight line through both bearings,
    and by how much it could at most, the coordinate `largest_tilt`. What housings and frame under
    a film give way counts with it.
    """
    own = shaft.sel(bearing=place)
    concept = scene.shaft.concept_at(place)
    if concept is None or len(concept.bearings) != 2 or "displacement" not in shaft:
        return own
    distance = concept.positions[1] - concept.positions[0]
    parts, largest = [], []
    for name, along in zip(concept.bearings, (-distance, distance)):
        support = scene.shaft.coupled.get(name)
        if support is not None and support.stiffness == "journal":
            moved = shaft["displacement"].sel(bearing=name, drop=True).transpose(..., "axis")
            parts.append(moved.copy(data=slope_of(moved.values / along)))
            largest.append(scene.journal.at(name).geometry.clearance / abs(distance))
    if not parts:
        return own
    lies = xr.concat(parts, "film").assign_coords(largest_tilt=("film", largest))
    return own.assign({CLEARANCE_TILT: lies})


def at_time(series: xr.Dataset, time: float) -> xr.Dataset:
    """The one sample of a series that is nearest to a time, s; the first if none is known."""
    k = int(np.argmin(np.abs(series["time"].values - time))) if math.isfinite(time) else 0
    return series.isel(sample=[k])


def grown(samples: xr.Dataset, factor: float) -> xr.Dataset:
    """Samples with a factor on their loads, which the bend of the shaft under them follows.

    How bores are turned stays. Where films hold the shaft, its place in each of them moves out as
    in the short bearing of [Ocvirk 1952] at rest, within the clearance.
    """
    names = [name for name in LOADS + LINE if name in samples]
    more = samples.assign({name: factor * samples[name] for name in names})
    if "tilt" not in samples or CLEARANCE_TILT not in samples:
        return more
    lies = samples[CLEARANCE_TILT]
    size = np.sqrt((lies**2).sum("axis"))
    ratio = np.minimum(size / lies["largest_tilt"], _RATIOS[-1])
    beyond = np.interp(factor * np.interp(ratio, _RATIOS, _CARRIED), _CARRIED, _RATIOS)
    further = ratio.copy(data=beyond / np.maximum(ratio.values, _RATIOS[1])) - factor
    tilt = more["tilt"] + (lies * further).sum("film")
    return more.assign(tilt=tilt.transpose(*samples["tilt"].dims))
