"""Finished runs of several candidates on the same loads → one like-for-like comparison."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_whole
from loadflow.quantities import HOURS_PER_YEAR, three_digits
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial
from loadflow.scene.unused import uncounted_friction
from loadflow.stages.films.summary import WHIRLS
from loadflow.stages.films.turning import runs_throughout
from loadflow.storage import plain
from loadflow.studies.candidate.factor import Margin
from loadflow.studies.candidate.friction import OWN_TORQUE, error_together, rolling_losses
from loadflow.studies.candidate.margins import (
    damage_per_hour,
    margin_of,
    row_shares,
)
from loadflow.studies.candidate.mixed import mixed_time
from loadflow.studies.candidate.numbers import (
    Finished,
    against,
    error_of,
    extreme,
    lifetime_mean,
    of_one_seed,
    seeds_of,
    shares_of,
    without_shares,
)
from loadflow.studies.candidate.pads import clearance_used
from loadflow.studies.candidate.quantities import QUANTITIES
from loadflow.studies.candidate.result import (
    STARTS_ALONE,
    Comparison,
    Judged,
    Number,
    without,
)
from loadflow.studies.candidate.risks import rolling_risks, wear
from loadflow.studies.candidate.rolling_warmth import warmest
from loadflow.studies.candidate.supply import leaving, supply_power
from loadflow.studies.candidate.tilt import carries_thrust, shaft_tilt
from loadflow.studies.candidate.wear_bands import with_error
from loadflow.studies.compare.words import (
    bearings,
    conclusion,
    drawn,
    facts,
    kind_of,
    references,
    reservations,
)
from loadflow.studies.lifetime.finished_run import energy_per_year
from loadflow.studies.seeds.intervals import Groups, interval, joint_life
from loadflow.studies.verdicts.verdicts import AT_NO_RATIO
from loadflow.verdict import Verdict, from_dataset

_OF_CONES = "at rest and at one temperature, which the error by models does not count"

_OIL = ("oil_flow", "pump")

_POWER_OF = {"journal": "journal.film", "thrust": "thrust.film"}
"""Result that knows the friction of a room."""


def compared(
    scene: Scene,
    finished: Sequence[Finished],
    answers: Sequence[Judged],
    failures: dict[str, str],
    without_place: list[str],
) -> Comparison:
    """Put candidates that were run on the same loads beside each other.

    Parameters
    ----------
    scene : Scene
        Their loads and shaft.
    finished : sequence of Finished
        The runs.
    answers : sequence of Judged
        What `judged` says of each.
    failures, without_place
        Of `Comparison`.
    """
    order = sorted(answers, key=lambda one: one.rank)
    rolls = [run.scene.rolling.bearings for run in finished if "rolling" in run.tables]
    parts = [part for bearings in rolls for part in bearings.values()]
    return Comparison(
        name=scene.name,
        conclusion=conclusion(order, failures),
        reservations=reservations(order),
        candidates=tuple(order),
        facts=facts(scene, [run.tables for run in finished], parts),
        shaft=drawn(scene, {part["place"] for one in order for part in one.bearings}),
        failures=failures,
        without_place=without_place,
    )


def judged(run: Finished, folder: Path) -> Judged:
    """All numbers of a finished candidate.

    Parameters
    ----------
    run : Finished
        Its run.
    folder : Path
        Of the comparison.
    """
    verdicts = tuple(from_dataset(run.tables["verdicts"])) if "verdicts" in run.tables else ()
    margin = margin_of(run.scene, run.folder, run.tables, verdicts)
    numbers = without(run.rooms) | dict(_numbers(run, verdicts, margin))
    numbers = without_shares(run, numbers)
    numbers = {key: of_one_seed(run, number) for key, number in numbers.items()}
    return Judged(
        name=run.name,
        title=run.title or run.name,
        source=run.source,
        kind=kind_of(run.rooms),
        numbers={key: numbers[key] for key in QUANTITIES},
        verdicts=verdicts,
        thrust=carries_thrust(run.scene, run.tables),
        governs=_governed(margin),
        change=margin.change,
        models={stage: told["rung"] for stage, told in run.manifest.get("rungs", {}).items()},
        checks=_checks(run.tables),
        bearings=bearings(run.scene, run.rooms),
        folder=run.folder.relative_to(folder).as_posix(),
        unanswered=dict(run.manifest.get("failures", {})),
        references=references(run.rooms),
    )


def _governed(margin: Margin) -> str:
    """Which limit is reached first, and which ones have no answer."""
    none = f"not counted, without an answer: {margin.uncounted}" if margin.uncounted else ""
    return "; ".join(filter(None, (margin.governs, none)))


def _numbers(
    run: Finished, verdicts: Sequence[Verdict], margin: Margin
) -> Iterator[tuple[str, Number]]:
    """Yield the numbers of a candidate by quantity."""
    error = error_of(run, *margin.models) / abs(margin.power) if margin.power else math.nan
    yield "load_factor", Number(
        margin.factor, "×", margin.low, margin.high, error=error, limit=1.0,
        holds=None if math.isnan(margin.factor) else margin.factor >= 1,
        case=margin.case, time=margin.time, place=margin.place,
        note=f"governed by {_governed(margin)}" if margin.governs else _governed(margin),
    )  # fmt: skip
    if "journal" in run.tables:
        yield from _of_journal(run, verdicts)
    if "thrust" in run.tables:
        yield from _of_pads(run, verdicts)
    if "rolling" in run.tables:
        yield from _of_rolling(run, verdicts)
    tilt = shaft_tilt(run.scene, run.folder, run.tables)
    if math.isnan(tilt.share):
        yield "tilt", Number(math.nan, "%", note=tilt.note)
        return
    low, high = seeds_of(run, tilt.by_case, lambda seen: 100 * max(seen))
    error = error_of(run, "shaft.tilt", "tilt")
    if "journal" in run.tables:  # which allows what closes its smallest film
        error += error_of(run, "journal.film", "minimum film")
    yield "tilt", Number(
        100 * tilt.share, "%", low, high, error, limit=100.0, holds=tilt.share <= 1, case=tilt.case,
        time=tilt.time, place=tilt.place, note=tilt.note,
    )  # fmt: skip


def in_wide_bore(ratio: Number, scene: Scene) -> Number:
    """An eccentricity ratio; in lobes or pads it says why there is a film above 1, and no limit."""
    if not ratio.place or not scene.journal.at(ratio.place).critical.film:
        return ratio
    said = "over the least gap of the centred shaft: beside it, preloaded lobes and pads leave more"
    notes = ratio.note, said if ratio.value > 1 else "", f"no limit: {AT_NO_RATIO}"
    return replace(ratio, note=_together(*notes))


def _together(*notes: str) -> str:
    return "; ".join(filter(None, notes))


def _of_journal(run: Finished, verdicts: Sequence[Verdict]) -> Iterator[tuple[str, Number]]:
    table = run.tables["journal"]
    groups = Groups.of(table)
    film = _film(run, table, groups)
    yield "minimum_film", against(film, verdicts, "smallest film", 1e6)
    yield "film_to_roughness", _over_roughness(film, run.scene.journal.at)
    name, model = "largest_eccentricity_ratio", "eccentricity ratio"
    ratio = extreme(run, table, groups, name, "most", 1.0, "–", model, running=True)
    ratio = against(ratio, verdicts, "eccentricity ratio ε", 1.0)
    yield "eccentricity_ratio", in_wide_bore(ratio, run.scene)
    name, model = "largest_pressure", "maximum pressure"
    pressure = extreme(run, table, groups, name, "most", 1e-6, "MPa", model)
    yield "film_pressure", against(pressure, verdicts, "largest film pressure", 1e-6)
    share = shares_of(run, table)
    yield from _oil(run, table, run.tables.get("thrust"))
    yield "whirl", whirl(run, table, groups)
    yield "mixed_time", mixed_time(run, table, share, groups)
    yield "wear", with_error(run, wear(run.scene, _bores(run), table, groups))
    yield from _lost(run, table, table["lost_power"], "")


def _of_pads(run: Finished, verdicts: Sequence[Verdict]) -> Iterator[tuple[str, Number]]:
    """Films of a thrust bearing beside journal bearings, or of a pair of cones in their place."""
    table = run.tables["thrust"]
    groups, share = Groups.of(table), shares_of(run, table)
    own = [v for v in verdicts if v.subject.startswith(("thrust ", "conical-pair "))]
    beside = "journal" in run.tables
    film = against(_film(run, table, groups), own, "smallest film", 1e6)
    name, model = "largest_pressure", "maximum pressure"
    pressure = extreme(run, table, groups, name, "most", 1e-6, "MPa", model)
    pressure = against(pressure, own, "largest film pressure", 1e-6)
    if not beside:
        film, pressure = (
            replace(number, note=_together(number.note, _OF_CONES)) for number in (film, pressure)
        )
    yield ("thrust_film" if beside else "minimum_film"), film
    yield ("thrust_pressure" if beside else "film_pressure"), pressure
    if beside:
        return
    yield "film_to_roughness", _over_roughness(film, run.scene.thrust.bearings.__getitem__)
    if film.place:
        yield "eccentricity_ratio", clearance_used(film, run.scene.thrust.bearings[film.place])
    yield from _oil(run, table)
    yield "mixed_time", mixed_time(run, table, share, groups)
    yield from _lost(run, table, table["lost_power"], _OF_CONES)


def _oil(
    run: Finished, table: xr.Dataset, beside: xr.Dataset | None = None
) -> Iterator[tuple[str, Number]]:
    """Oil that leaves films and a collar beside them, and the power to bring it back."""
    if any("mean_side_flow" not in one for one in (table, beside) if one is not None):
        why = "n/a: its run is of a version that kept no oil of pads; --overwrite makes it anew"
        yield from ((name, Number(math.nan, QUANTITIES[name].unit, note=why)) for name in _OIL)
        return
    groups, share, cases = Groups.of(table), shares_of(run, table), table["case"].values
    own, collar = leaving(table, cases), leaving(beside, cases)
    flows = {"journal.film" if "journal" in run.tables else "thrust.film": own}
    flows |= {"thrust.film": collar} if collar.any() else {}
    lost = {name: float((share * flow).sum()) for name, flow in flows.items()}
    error = error_together(lost, {name: error_of(run, name, "side flow") for name in flows})
    told = "" if own.any() else "no oil leaves the film"
    if collar.any():
        told = f"{three_digits(6e4 * lost['thrust.film'])} of it out of the collar"
    flow = lifetime_mean(run, 6e4 * (own + collar), share, groups, "l/min", told)
    yield "oil_flow", replace(flow, error=error)
    power, note = supply_power(table, collar)
    yield "pump", replace(lifetime_mean(run, power / 1e3, share, groups, "kW", note), error=error)


def _bores(run: Finished) -> dict[str, xr.Dataset]:
    """Worn bores by bearing; none where the run followed no wear."""
    if "wear" not in run.tables:
        return {}
    found = read_whole(run.folder / "result.h5")["wear"]
    return {name: node.to_dataset() for name, node in found.children.items()}


def _film(run: Finished, table: xr.Dataset, groups: Groups) -> Number:
    """Smallest film while the shaft runs, µm."""
    name, model = "smallest_film", "minimum film"
    return extreme(run, table, groups, name, "least", 1e6, "µm", model, running=True)


def whirl(run: Finished, table: xr.Dataset, groups: Groups) -> Number:
    """Longest half-speed whirl of a load case, % of its time, held against what a run warns of.

    Parameters
    ----------
    run : Finished
        The candidate.
    table : xarray.Dataset
        Films of the run over ``case`` and ``bearing``.
    groups : Groups
        Cases that differ by their seed alone.
    """
    if "whirl_share" not in table:
        return Number(math.nan, "%", note="n/a: films at rest, which do not whirl")
    longest = extreme(run, table, groups, "whirl_share", "most", 100.0, "%", "half-speed whirl")
    if math.isnan(longest.value):
        return longest
    longest = replace(longest, limit=100 * WHIRLS, holds=longest.value < 100 * WHIRLS)
    return longest if longest.value else replace(longest, case="", place="")  # none whirls


def _over_roughness(film: Number, at: Callable[[str], Journal | AnyAxial]) -> Number:
    """A film over the roughness R_z of both surfaces of the bearing at its place."""
    if not film.place:
        return replace(film, unit="–")
    rough = at(film.place).contact_film * 1e6
    value, low, high = (getattr(film, name) / rough for name in ("value", "low", "high"))
    return replace(film, value=value, low=low, high=high, unit="–", limit=1.0, holds=value >= 1)


def _of_rolling(run: Finished, verdicts: Sequence[Verdict]) -> Iterator[tuple[str, Number]]:
    table = run.tables["rolling"]
    groups = Groups.of(table)
    name, model = "bearing_design_safety", "maximum force"
    safety = extreme(run, table, groups, name, "least", 1.0, "–", model)
    yield "static_safety", against(safety, verdicts, "static rating over the design load", 1.0)
    name, model = "bearing_pressure", "maximum pressure"
    yield (
        "contact_pressure",
        extreme(run, table, groups, name, "most", 1e-6, "MPa", model),
    )
    share = shares_of(run, table)
    slope = float(table.attrs["weibull_slope"])
    design = run.scene.rolling.system_life
    for key, kind in (("modified_life", "modified_"), ("rating_life", "")):
        per_hour = damage_per_hour(table, kind).transpose("case", "bearing").values
        life = _years(per_hour, share, slope, np.arange(share.size))
        low, high = interval(groups, partial(_years, per_hour, share, slope))
        limit, model = design / HOURS_PER_YEAR, f"{kind}life".replace("_", " ")
        worst = int(np.argmax((per_hour * share[:, None]).sum(0)))
        yield key, Number(
            life, "years", low, high, error_of(run, "rolling.life", model),
            limit, life >= limit,
            place=str(table["bearing"].values[worst]),
            note="as a system" if table.sizes["bearing"] > 1 else "",
        )  # fmt: skip
    yield from _rows(run)
    for name, number in rolling_risks(run.scene, run.folder, table, share):
        few = {"minimum_load": "smallest load", "viscosity_ratio": "viscosity ratio"}.get(name)
        if few is not None:
            number = replace(number, error=error_of(run, "rolling.friction", few))
        yield name, number
    losses = rolling_losses(run.scene, run.folder, table)
    lost = None if losses is None else losses.power
    yield (
        "bearing_temperature",
        warmest(run.scene.friction, run.scene.rolling.bearings, table, lost, share),
    )
    if losses is not None and losses.place:
        speed = losses.speed * 30 / np.pi
        low, high = seeds_of(
            run, losses.by_case, lambda seen: float(np.median(np.concatenate(seen)))
        )
        yield "film_parameter", Number(
            losses.film_parameter, "–", low, high,
            error_of(run, "rolling.friction", "film parameter"), case=losses.case, time=losses.time,
            place=losses.place, note=f"median below {speed:.3g} 1/min",
        )  # fmt: skip
    elif losses is not None:
        why = "no loaded contact has a film" if runs_throughout(table).any() else STARTS_ALONE
        yield "film_parameter", Number(math.nan, "–", note=f"n/a: {why}")
    if losses is not None:
        for name, each in losses.torques.items():
            own = each.sel(case=table["case"].values).sum("bearing").values
            torque = lifetime_mean(run, own, share, groups, "N m")
            told = "friction torque" if name == OWN_TORQUE else "catalogue torque"
            error = error_of(run, "rolling.friction", told)
            yield name, replace(torque, error=error)
    *some, last = "slip of rollers", *uncounted_friction(run.scene)
    left_out = f"{', '.join(some)} and {last}" if some else last
    yield from _lost(run, table, lost, f"without {left_out}")


def _years(damage: np.ndarray, share: np.ndarray, slope: float, some: np.ndarray) -> float:
    """Life of all bearings under some cases, years."""
    return joint_life(damage[some], share[some], slope) / HOURS_PER_YEAR


def _rows(run: Finished) -> Iterator[tuple[str, Number]]:
    """Load share of the row that takes the thrust, where a bearing has several rows."""
    found = row_shares(run.scene, run.folder, run.tables)
    if found is None:
        return
    about: dict[str, Any] = {"case": found.case, "time": found.time, "place": found.place}
    about["error"] = error_of(run, "rolling.friction", "row share")
    low, high = seeds_of(run, found.by_case, lambda seen: max(seen)[1])
    note = f"{100 * found.mean:.0f} % in the mean, with {found.thrust / 1e3:.0f} kN of thrust"
    yield "row_share", Number(100 * found.share, "%", 100 * low, 100 * high, note=note, **about)
    rows = found.rows
    yield "row_overload", Number(found.share * rows, "×", low * rows, high * rows, **about)


def _lost(
    run: Finished, table: xr.Dataset, power: xr.DataArray | None, note: str
) -> Iterator[tuple[str, Number]]:
    """Friction of all bearings, and the energy that it takes a year, that of the pump with it."""
    if power is None:
        yield "energy", Number(math.nan, "MWh", note="no model of friction")
        return
    share, groups = shares_of(run, table), Groups.of(table)
    result = next(
        (name for room, name in _POWER_OF.items() if room in run.tables), "rolling.friction"
    )
    parts = {result: power}
    if "thrust" in run.tables and table is not run.tables["thrust"]:
        beside = run.tables["thrust"]["lost_power"].drop_vars(("dlc",), errors="ignore")
        parts["thrust.film"] = beside
        # a collar beside a journal bearing has its name
        names = [f"{name}, thrust" for name in beside["bearing"].values.tolist()]
        power = xr.concat(
            [power, beside.assign_coords(bearing=names)],
            "bearing",
            coords="minimal",
            compat="override",
        )
    own = power.sel(case=table["case"].values).fillna(0.0)
    loss = lifetime_mean(run, own.sum("bearing").values / 1e3, share, groups, "kW", note)
    often = xr.DataArray(share, {"case": table["case"].values}, ["case"])
    lost = {name: float((part.fillna(0.0) * often).sum()) for name, part in parts.items()}
    error = error_together(lost, {name: error_of(run, name, "friction power") for name in parts})
    yield "friction", replace(loss, error=error)
    if "mean_supply_power" in table:
        supply = table["mean_supply_power"].fillna(0.0)
        own = own + supply.reindex(bearing=own["bearing"].values, fill_value=0.0)
    energy = float(energy_per_year(run.scene, table, own, share).sum()) / 3.6e9
    scale = energy / loss.value if loss.value else math.nan
    yield "energy", Number(energy, "MWh", loss.low * scale, loss.high * scale, error, note=note)


def _checks(tables: Mapping[str, xr.Dataset]) -> list[dict[str, Any]]:
    """Largest change of each quantity with a better model, in cases that were solved again."""
    if "check" not in tables:
        return []
    check, worst = tables["check"], dict[tuple[str, str, str], float]()
    for k in range(check.sizes["check"]):
        key = (
            str(check["stage"].values[k]),
            str(check["quantity"].values[k]),
            str(check["against"].values[k]),
        )
        value = float(check["difference"].values[k])
        worst[key] = max(worst.get(key, 0.0), value if math.isfinite(value) else math.inf)
    return [
        {"stage": stage, "quantity": quantity, "against": against, "change": plain(value)}
        for (stage, quantity, against), value in worst.items()
    ]
