"""Bands by tolerances beside the numbers of a comparison: few loads, cheap models, one by one."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from loadflow.rolling.friction import torques_beside
from loadflow.rolling.rating.modified_life import viscosity_ratio
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.candidate import Candidate
from loadflow.scene.cooling import Cooling
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial, Thrust
from loadflow.stages.bores import against_bore, in_bore, turned_bores
from loadflow.stages.frames import to_rolling
from loadflow.stages.friction import least_film_parameter
from loadflow.stages.rolling_at_work import as_stated, friction_options, rest
from loadflow.studies.candidate.deviations import Built, Tolerance, tolerances_of, with_places
from loadflow.studies.candidate.factor import grown
from loadflow.studies.candidate.friction import TORQUES
from loadflow.studies.candidate.margins import load_by_row, lubrication
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.candidate.pad_films import PadFilms, pad_films, tabulated
from loadflow.studies.candidate.quantities import QUANTITIES
from loadflow.studies.candidate.result import Judged, Number
from loadflow.studies.candidate.risks import LIGHT, mostly_exceeded
from loadflow.studies.candidate.rolling_warmth import rise_power
from loadflow.studies.candidate.supply import FEED
from loadflow.studies.candidate.wear_bands import rubbing_of
from loadflow.studies.compare.band_films import (
    HEAVIER,
    Deciding,
    Films,
    deciding_of,
    films_at,
    load_margins,
)
from loadflow.studies.design.point import allowed_pressure, judge_design
from loadflow.studies.lifetime.load_spectrum import STANDING_SHARE

CLASSES = 3
"""Classes of speed, and twice as many of load, that stand for the series, beside the hardest."""

PADS = 12
"""Samples in which films of pads without tables are solved again, beside the hardest."""

_FROM_ZERO = ("mixed_time",)  # has the unit of the number
_SLOW = 0.1  # share of the samples that counts as low speed
_SAME = 1e-9  # shares of a value below which a tolerance does not move it


def with_bands(one: Judged, run: Finished, spectrum: xr.DataTree, given: AsBuilt) -> Judged:
    """A candidate with the band by tolerances of each of its numbers that they move.

    Each tolerance is taken to both of its ends, one at a time, under few loads of the lifetime and
    the hardest ones, by the cheap models of `loadflow design`. The change of an answer there, as a
    share, is that of the answer of the run. Ends of all tolerances add up as independent ones do:
    the square root of the sum of squares, for either side.

    Parameters
    ----------
    one : Judged
        The candidate.
    run : Finished
        Its run.
    spectrum : xarray.DataTree
        Of `loadflow.studies.lifetime.load_spectrum.load_spectrum`, with its places.
    given : AsBuilt
        What to take.

    Returns
    -------
    Judged
        Its `change` names tolerances that break a limit by themselves.
    """
    rubs = rubbing_of(run, one.numbers["wear"])
    lying = _in_bores(run.scene, spectrum)
    rises = {
        place: rise_power(run.scene, place, spectrum[place].to_dataset())
        for place in (run.scene.rolling.bearings if "rolling" in run.tables else ())
    }
    built = Built(_bearings(run), _friction(run), lying, rubs, rises=rises)
    known = Known()
    around: dict[str, list[tuple[str, float, float]]] = {}
    breaking = []
    for tolerance in tolerances_of(built, given):
        moved = _moved(one, tolerance, known)
        for key, (low, high) in moved.items():
            around.setdefault(key, []).append((tolerance.name, low, high))
        factor = one.numbers["load_factor"].value
        if factor >= 1 > factor + moved.get("load_factor", (0.0, 0.0))[0] or tolerance.missing:
            breaking.append(tolerance.name)
    numbers = {
        key: _banded(number, around[key], QUANTITIES[key].top) if key in around else number
        for key, number in one.numbers.items()
    }
    numbers["row_overload"] = _as_share(numbers["row_overload"], numbers["row_share"])
    told = f"tolerance of {', '.join(breaking)} alone" if breaking else ""
    change = "; ".join(part for part in (one.change, told) if part)
    return replace(one, numbers=numbers, change=change)


def _friction(run: Finished) -> Friction:
    """The section of the scene, with the temperature of each bearing, as in its warmest case."""
    if "rolling" not in run.tables:
        return run.scene.friction
    options, table = run.scene.friction, run.tables["rolling"]["bearing_temperature"]
    parts = run.scene.rolling.bearings
    warm = {place: options.temperature_of(part) for place, part in parts.items()}
    for place in options.balances(parts.values()):
        warm[place] = float(table.sel(bearing=place).max())
    held = {place: Cooling(temperature=kelvin) for place, kelvin in warm.items()}
    return options.model_copy(update={"cooling": held, "conductance": None})


def _in_bores(scene: Scene, spectrum: xr.DataTree) -> xr.DataTree:
    """The spectrum with the `alignment` of bores that are turned, or follow the shaft."""
    places = (place for place in turned_bores(scene) if place in spectrum.children)
    journal = scene.journal
    return with_places(
        spectrum, {p: in_bore(spectrum[p].to_dataset(), journal.at(p)) for p in places}
    )


def _bearings(run: Finished) -> Candidate:
    """What stands in the scene, of the rooms that have results."""
    there = {room: getattr(run.scene, room) for room in ("journal", "thrust", "rolling")}
    return Candidate(**{room: own for room, own in there.items() if room in run.tables})


def _banded(number: Number, around: Sequence[tuple[str, float, float]], top: float) -> Number:
    """The number with ends added up, as far as it can go at all."""
    low = -math.sqrt(sum(down**2 for _, down, _ in around))
    high = math.sqrt(sum(up**2 for *_, up in around))
    most = max(around, key=lambda row: max(-row[1], row[2]))
    return replace(
        number,
        tolerance_low=max(number.value + low, min(number.value, 0.0)),
        tolerance_high=min(number.value + high, max(number.value, top)),
        tolerance=most[0],
    )


def _as_share(number: Number, share: Number) -> Number:
    """A multiple of a share with the band of that."""
    if not math.isfinite(share.tolerance_low):
        return number
    factor = number.value / share.value
    ends = {name: factor * getattr(share, name) for name in ("tolerance_low", "tolerance_high")}
    return replace(number, **ends, tolerance=share.tolerance)


class Known:
    """Bearings as stated, which most tolerances share: their numbers, and samples that decide."""

    def __init__(self) -> None:
        self._found: list[tuple[Built, dict[str, float], dict[str, Deciding]]] = []

    def of(self, built: Built) -> tuple[dict[str, float], dict[str, Deciding]]:
        """Those of one object, computed once."""
        for one, known_numbers, known_deciding in self._found:
            if one is built:
                return known_numbers, known_deciding
        journal, deciding = built.candidate.journal, dict[str, Deciding]()
        if journal is not None:
            films = films_at(journal, built.spectrum)
            deciding = {place: deciding_of(found) for place, found in films.items()}
        numbers = cheap_numbers(built, deciding)
        self._found.append((built, numbers, deciding))
        return numbers, deciding


def _moved(one: Judged, tolerance: Tolerance, known: Known) -> dict[str, tuple[float, float]]:
    """By quantity, how far a tolerance moves its value down and up, in the unit of the number."""
    stated, deciding = known.of(tolerance.stated)
    found: dict[str, tuple[float, float]] = {}
    for end in tolerance.ends:
        there = cheap_numbers(end, deciding)
        for key, number in one.numbers.items():
            before, after = (values.get(key, math.nan) for values in (stated, there))
            if not (math.isfinite(before) and math.isfinite(after) and math.isfinite(number.value)):
                continue
            if before == 0 and key not in _FROM_ZERO:  # no share of nothing
                continue
            step = after - before
            step *= number.value / before if before else 1.0
            if abs(step) > _SAME * abs(number.value):
                low, high = found.get(key, (0.0, 0.0))
                found[key] = min(low, step), max(high, step)
    return found


# --- numbers by cheap models ----------------------------------------------------------------------


def cheap_numbers(built: Built, deciding: Mapping[str, Deciding] | None = None) -> dict[str, float]:
    """Numbers of a comparison by the cheap models of a design, by quantity.

    Only their changes as shares are asked, so that units and what all share do not matter. Films of
    journal bearings are those of all samples, or of those that are `deciding`.
    """
    candidate, spectrum, found = built.candidate, built.spectrum, dict[str, float]()
    if candidate.journal is not None:
        films = films_at(candidate.journal, spectrum, deciding)
        found |= _of_films(candidate.journal, films, spectrum.attrs["seconds"])
    if candidate.rolling is not None:
        alone = Candidate(rolling=candidate.rolling)
        found |= judge_design(alone, built.friction, spectrum, rises=built.rises).numbers
        found |= _of_rolling(candidate.rolling.bearings, built.friction, spectrum)
    if candidate.thrust is not None:
        found |= _of_pads(candidate.thrust, spectrum, found, built.spans or {})
    if candidate.journal is not None and (rubs := built.rubbing) is not None:
        found["wear"] = rubs.energy(candidate.journal.at(rubs.place))
    return found


def _of_films(journal: Journal, films: Mapping[str, Films], seconds: float) -> dict[str, float]:
    """Films of journal bearings at rest; their margin by powers of the load at the hardest ones."""
    sums = dict.fromkeys(("power", "pump", "oil_flow"), 0.0)
    thinnest, rough, ratios, pressures, factors, mixed = [], [], [], [], [], []
    for place, found in films.items():
        options, answer, heavier = journal.at(place), found.answer, found.heavier
        weight = found.samples["weight"].values
        turning = answer.converged & (weight > 0)
        own = weight * turning
        scale = weight.sum() / max(own.sum(), 1e-300)  # those without a film lose as the others do
        sums["power"] += scale * _mean(answer.friction_power, own)
        sums["pump"] += scale * _mean(answer.supply_power, own)
        sums["oil_flow"] += scale * _mean(answer.side_flow, own)
        film = float(np.where(found.judged, answer.minimum_film, np.inf)[found.thin])
        pressure = float(np.where(answer.converged, answer.maximum_pressure, 0.0)[found.hard])
        thinner, higher = heavier.minimum_film[0] / film, heavier.maximum_pressure[1] / pressure
        allowed = allowed_pressure(options, answer, found.hard)
        reserves = film / options.least_film, allowed / pressure
        factors += load_margins(reserves, (thinner, higher))
        thinnest.append(film)
        rough.append(film / options.contact_film)
        pressures.append(pressure)
        ratios.append(float(answer.eccentricity_ratio[found.judged].max(initial=0.0)))
        formed = turning & (
            options.critical.left(answer.eccentricity_ratio, answer.minimum_film) >= 1
        )
        mixed.append(float(weight.sum() - (weight * formed).sum()))
    return {
        "minimum_film": min(thinnest),
        "film_to_roughness": min(rough),
        "eccentricity_ratio": max(ratios),
        "film_pressure": max(pressures),
        "load_factor": min(factors, default=math.nan),
        "friction": sums["power"],
        "energy": sums["power"] + sums["pump"],
        "oil_flow": sums["oil_flow"],
        "pump": sums["pump"] or FEED * sums["oil_flow"],
        "mixed_time": max(mixed) * seconds / 3600,
        "tilt": 1.0 / min(thinnest),
    }


def _mean(values: np.ndarray, weight: np.ndarray) -> float:
    return float((np.where(weight > 0, values, 0.0) * weight).sum())


def _of_rolling(
    parts: Mapping[str, FurtherBearing], friction: Friction, spectrum: xr.DataTree
) -> dict[str, float]:
    """Thinnest films, smallest κ and load, and the load of the row that takes the thrust."""
    films, ratios, loads, rows = [], [], [], [0.0]
    torques: dict[str, list[float]] = {}
    for place, stated in parts.items():
        part, samples = as_stated(stated, friction), spectrum[place].to_dataset()
        bearing, own = part.geometry, friction.of(stated)
        force, moment, speed = (
            samples[name].transpose("sample", ...).values for name in ("force", "moment", "speed")
        )
        turning = samples["weight"].values > 0
        answer = rest(part, force, moment, strict=False)
        lost = answer.friction(speed, friction_options(own, bearing))
        beside = torques_beside(answer, speed, friction_options(own, bearing), part.catalogue)
        for name, torque in {"": lost.torque, **beside}.items():
            mean = _mean(torque, samples["weight"].values * (speed != 0))
            torques.setdefault(TORQUES[name], []).append(mean)
        thin = least_film_parameter(lost.film_parameter, answer.element_forces)
        slow = turning & (np.abs(speed) <= np.quantile(np.abs(speed[turning]), _SLOW))
        films.append(float(np.median(thin[slow])))
        kappa = viscosity_ratio(lubrication(own), speed[turning], bearing.pitch_diameter)
        ratios.append(float(kappa.min()))
        share = answer.equivalent_load[turning] / bearing.rated_capacity
        weight = samples["weight"].values[turning]
        loads.append(mostly_exceeded(share, weight) / LIGHT[bearing.element])
        if bearing.group_dims[0] == "row" and bearing.groups[0] > 1 and bearing.takes_thrust:
            hardest = int(np.argmax(np.abs(force[:, 0])))
            rows.append(float(load_by_row(bearing, answer)[hardest].max()))
    return {
        "film_parameter": min(films),
        "viscosity_ratio": min(ratios),
        "minimum_load": min(loads),
        "row_share": max(rows),
        **{name: sum(own) for name, own in torques.items() if len(own) == len(parts)},
    }


def _of_pads(
    thrust: Thrust,
    spectrum: xr.DataTree,
    beside: Mapping[str, float],
    spans: Mapping[str, tuple[float, float] | None],
) -> dict[str, float]:
    """Films of pads at rest, each as warm as it makes itself, and tilted where the shaft is.

    What they lose, and the oil that leaves them, is added to that of the journal bearings beside.
    """
    films, pressures, rough, used, margins, power, flow = [], [], [], [], [], 0.0, 0.0
    for place, bearing in thrust.bearings.items():
        samples = _samples_of_pads(thrust, bearing, spectrum[place].to_dataset())
        span = spans.get(place)
        answer = pad_films(bearing, against_bore(samples), span=span)
        weight = samples["weight"].values * np.isfinite(answer.friction_power)
        whole = float(spectrum[place]["weight"].sum()) / max(weight.sum(), 1e-300)
        power += whole * _mean(answer.friction_power, weight)
        flow += whole * _mean(answer.side_flow, weight)
        films.append(answer.thinnest())
        rough.append(films[-1] / bearing.contact_film)
        used.append(1.0 - films[-1] / bearing.clearance)
        pressures.append(answer.highest())
        margins += _margins_of_pads(bearing, samples, answer, span)
    margin = min(margins, default=math.nan)
    if beside:
        lost = {name: beside[name] + power for name in ("friction", "energy")}
        lost |= {"oil_flow": beside["oil_flow"] + flow, "pump": beside["pump"] + FEED * flow}
        lost["load_factor"] = float(np.nanmin([beside["load_factor"], margin]))
        return {"thrust_film": min(films), "thrust_pressure": max(pressures)} | lost
    return {
        "minimum_film": min(films),
        "film_to_roughness": min(rough),
        "eccentricity_ratio": max(used),
        "film_pressure": max(pressures),
        "load_factor": margin,
        "friction": power,
        "energy": power,
        "oil_flow": flow,
        "pump": FEED * flow,
        "tilt": 1.0 / max(min(films), 1e-300),
    }


def _samples_of_pads(thrust: Thrust, bearing: AnyAxial, samples: xr.Dataset) -> xr.Dataset:
    """Those of a spectrum in which a bearing of pads turns, with tilt of shaft and bore in them.

    Of one without tables they are few: spread over the loads that last, and the hardest.
    """
    speed = np.abs(samples["speed"].values)
    running = samples["running"].values.astype(bool)
    turning = np.flatnonzero(running & (speed > STANDING_SHARE * speed.max(initial=0.0)))
    if not tabulated(bearing):
        force, moment = (
            to_rolling(samples[name].transpose("sample", "axis").values)
            for name in ("force", "moment")
        )
        pressed = bearing.normal_load(force, moment)[turning] / speed[turning]
        lasting = samples["weight"].values[turning] > 0
        order = turning[lasting][np.argsort(pressed[lasting])]
        spread = order[np.linspace(0, order.size - 1, PADS).astype(int)]
        turning = np.unique([*spread, turning[np.argmax(pressed)]])
    askew = "pad_tilt" in samples
    lines = {name: samples[f"pad_{name}" if askew else name]
             for name in ("tilt", "alignment") if askew or name in samples}  # fmt: skip
    some = samples.drop_vars(("tilt", "alignment"), errors="ignore")
    if (askew or thrust.tilt) and bearing.kind == "thrust" and not bearing.self_aligning:
        some = some.assign(lines)
    return some.isel(sample=turning)


def _margins_of_pads(
    bearing: AnyAxial, some: xr.Dataset, answer: PadFilms, span: tuple[float, float] | None
) -> list[float]:
    """Factors on the load to the limits of film and pressure; 0 where a film is missing.

    How bores are turned, and by how much they are misaligned, does not grow with the load.
    """
    if not answer.carried.all():
        return [0.0]
    film, pressure = answer.minimum_film, answer.maximum_pressure
    thin, hard = int(np.nanargmin(film)), int(np.nanargmax(pressure))
    under = against_bore(grown(some.isel(sample=[thin, hard]), HEAVIER))
    heavier = pad_films(bearing, under, span=span)
    allowed = bearing.limits.pressure_at(float(answer.temperature[hard]))
    return load_margins(
        (film[thin] / bearing.least_film, allowed / pressure[hard]),
        (heavier.minimum_film[0] / film[thin], heavier.maximum_pressure[1] / pressure[hard]),
    )
