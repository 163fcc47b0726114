"""Results of a run → its verdicts: each number, its limit, where that is from, and what governs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

import numpy as np
import xarray as xr

from loadflow.quantities import CELSIUS, load_cases
from loadflow.scene.journal import Journal
from loadflow.scene.limits import FilmLimits, JournalLimits
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.films.turning import runs_throughout
from loadflow.studies.verdicts.parts import STATED, answered, source_of, worst_of
from loadflow.studies.verdicts.rolling import of_rolling
from loadflow.studies.verdicts.uncarried import SLIGHT, has_collar, uncarried
from loadflow.verdict import Verdict

Tables = Mapping[str, xr.Dataset]

_ISOTHERMAL = "temperature not computed: the film has one viscosity"
_AT_RATIO = "(1 − E_krit) c, the film at E_krit [Jonuschies 2015, (5.1), (5.2)]"
_NO_WHIRL = "tilting pads do not whirl, however little they carry [Lund 1987]"

AT_NO_RATIO = "its gap closes at no certain ε; the film at E_krit limits the smallest film"
"""Why bores of arcs, lobes and pads have no largest ε."""


def verdicts(
    scene: Scene,
    tables: Tables,
    lifetime: xr.Dataset | None,
    missing: Mapping[str, Sequence[str]] | None = None,
) -> list[Verdict]:
    """Verdicts on the bearings of a run.

    Parameters
    ----------
    scene : Scene
        What was run, with its limits.
    tables : mapping
        Results by stage, each over ``bearing`` and ``case``: shaft, journal, thrust, rolling.
    lifetime : xarray.Dataset or None
        Of `loadflow.studies.lifetime.finished_run.run_lifetime`.
    missing : mapping, optional
        By stage, the load cases that it could not answer at all.
    """
    carriers = [*scene.thrust.bearings] if "thrust" in tables else []
    found = [
        Verdict(
            stage, "load cases not answered", len(missing[stage]), 0.0, "at most", "cases",
            "extremes need every case", missing[stage][0],
            note=f"not answered: {len(missing[stage])} cases; the extremes lack them",
        )
        for stage in ("journal", "thrust", "rolling", "friction")
        if missing and missing.get(stage)
    ]  # fmt: skip
    if "journal" in tables:
        table = tables["journal"].load()
        for name in table["bearing"].values.tolist():
            found += _of_journal(scene, name, table.sel(bearing=name))
    if "thrust" in tables:
        for name in carriers:
            found += _of_pads(scene.thrust.bearings[name], name, tables["thrust"].load())
    if "rolling" in tables:
        found += of_rolling(scene, tables["rolling"].load(), lifetime)
    return [*found, *uncarried(scene, tables)]


# --- journal bearings -------------------------------------------------------------------------


def _of_journal(scene: Scene, name: str, table: xr.Dataset) -> Iterator[Verdict]:
    """Verdicts on one journal bearing: production first, then what holds in every load case."""
    subject, options = f"journal {name}", scene.journal.at(name)
    limits = options.limits
    yield answered(subject, table)
    mixed = f"ε above {limits.eccentricity_ratio:g}"
    if options.critical.film:
        mixed = f"film below {1e6 * options.critical.film:.3g} µm"
    yield from _in_contact(subject, table, limits, mixed, "journal")
    production = _production(table)
    if production.sizes["case"]:
        yield from _film(options, subject, production)
    yield from _pressure(limits, subject, table, "journal")
    area = options.geometry.width * options.geometry.diameter
    if "standing_load" in table:
        yield from _of_standing(limits, subject, table, area)
    if limits.specific_load is not None:
        value, case, _ = worst_of(table, "largest_load", "most")
        yield Verdict(
            subject, "specific load F/(B D)", value / area, limits.specific_load, "at most", "Pa",
            STATED, case, key="journal.limits.specific_load",
        )  # fmt: skip
    if options.heat is not None:
        yield _warmth(subject, table, limits)
    if not has_collar(scene, name) and (thrust := _thrust_on_journal(subject, table)):
        yield thrust


def _in_contact(
    subject: str, table: xr.Dataset, limits: FilmLimits, mixed: str, section: str
) -> Iterator[Verdict]:
    """How long the surfaces touch while the shaft turns: in power production, and in starts."""
    for cases, situation, limit in (
        (_production(table), "power production", limits.contact_time),
        (_production(table, False), "starts, stops and faults", limits.start_time),
    ):
        if cases.sizes["case"]:
            yield _contact(subject, cases, situation, limit, mixed, section)


def _production(table: xr.Dataset, produces: bool = True) -> xr.Dataset:
    """The load cases of power production, or those in which the shaft stands, starts or stops."""
    return table.isel(case=runs_throughout(table) == produces)


def _contact(
    subject: str, table: xr.Dataset, situation: str, limit: float | None, mixed: str, section: str
) -> Verdict:
    """How long the surfaces touch while the shaft turns, and what that means in mixed friction."""
    value, case, _ = worst_of(table, "contact_time", "most")
    row = table.sel(case=case)
    turns, energy, seconds = (
        float(row[f"mixed_friction_{what}"]) for what in ("revolutions", "energy", "time")
    )
    note = f"{mixed} for {seconds:.3g} s, {turns:.3g} revolutions, {energy / 1e3:.3g} kJ"
    if np.isfinite(float(row["transition_speed"])):
        rpm = float(row["transition_speed"]) * 30 / np.pi
        note += f"; transition at {rpm:.3g} 1/min, {float(row['transition_time']):.4g} s"
    own = "contact_time" if situation == "power production" else "start_time"
    return Verdict(
        subject,
        f"time in contact while turning, {situation}",
        value,
        np.nan if limit is None else limit,
        "at most",
        "s",
        "no limit is stated" if limit is None else "the film must part the surfaces, (3.1)",
        case if value else "",
        note=note,
        key=f"{section}.limits.{own}",
    )


def _film(options: Journal, subject: str, table: xr.Dataset) -> Iterator[Verdict]:
    """ε, smallest film and So in power production; a contact breaks all of them."""
    limits, contact = options.limits, table["in_contact"] > 0
    touching = f"in contact in {load_cases(int(contact.sum()))}" if contact.any() else ""
    ratio = table.assign(largest_eccentricity_ratio=_where(table, "largest_eccentricity_ratio", 1))
    value, case, time = worst_of(ratio, "largest_eccentricity_ratio", "most")
    critical = options.critical
    yield Verdict(
        subject, "eccentricity ratio ε", value, np.nan if critical.film else critical.ratio,
        "at most",
        source=AT_NO_RATIO
        if critical.film
        else source_of(limits, "eccentricity_ratio", "E_krit [Jonuschies 2015, (5.2)]"),
        case=case, time=time, note=touching, key="journal.limits.eccentricity_ratio",
    )  # fmt: skip
    yield _thinnest(options, subject, table, touching, "journal")
    rule = "[Jonuschies 2015, ch. 3.4]"
    low, high = options.sommerfeld_range
    stated = "sommerfeld_range" in limits.changed
    senses: tuple[
        tuple[float, Literal["at least", "at most"], Literal["least", "most"], str], ...
    ] = (
        (low, "at least", "least", "smallest"),
        (high, "at most", "most", "largest"),
    )
    for limit, sense, which, told in senses:
        value, case, _ = worst_of(table, "mean_sommerfeld_number", which)
        source = source_of(limits, "sommerfeld_range", f"normal operation, {rule}")
        yield Verdict(
            subject, f"{told} mean Sommerfeld number", value, limit or np.nan, sense,
            source=source if limit or stated else _NO_WHIRL, case=case,
            key="journal.limits.sommerfeld_range",
        )  # fmt: skip
    peak = table.assign(
        largest_sommerfeld_number=_where(table, "largest_sommerfeld_number", np.inf)
    )
    value, case, time = worst_of(peak, "largest_sommerfeld_number", "most")
    yield Verdict(
        subject, "largest Sommerfeld number", value, limits.sommerfeld_peak, "at most",
        source=source_of(limits, "sommerfeld_peak", f"brief peaks, {rule}"), case=case, time=time,
        note=touching, key="journal.limits.sommerfeld_peak",
    )  # fmt: skip


def _thinnest(
    options: Journal | AnyAxial, subject: str, table: xr.Dataset, touching: str, section: str
) -> Verdict:
    """Smallest film in power production; a contact breaks it."""
    limits, least = options.limits, options.least_film
    film = table.assign(smallest_film=_where(table, "smallest_film", 0))
    value, case, time = worst_of(film, "smallest_film", "least")
    source, key = STATED, "minimum_film"
    if least > limits.least_film(options.contact_film):  # E_krit asks for more
        source, key = _AT_RATIO, "eccentricity_ratio"
    elif limits.minimum_film is None:
        source = (
            f"R_z {1e6 * options.contact_film:.3g} + waviness {1e6 * limits.waviness:.3g} + "
            f"margin {1e6 * limits.margin:.3g} µm, [Jonuschies 2015, (3.1)]"
        )
    return Verdict(
        subject, "smallest film", value, least, "at least", "m", source, case, time, touching,
        f"{section}.limits.{key}",
    )  # fmt: skip


def _where(table: xr.Dataset, name: str, in_contact: float) -> xr.DataArray:
    """An extreme of each case; where surfaces touch, what contact stands for."""
    return table[name].where(table["in_contact"] == 0, in_contact)


def _pressure(
    limits: FilmLimits, subject: str, table: xr.Dataset, section: str
) -> Iterator[Verdict]:
    """Largest film pressure of a shaft that turns against the material at its temperature."""
    value, case, time = worst_of(table, "largest_pressure", "most")
    if case:
        note = _ISOTHERMAL if np.isnan(warm_in(table, case)) else ""
        yield _of_material(
            limits, subject, "largest film pressure", value, table, case, time, note, section
        )


def _of_standing(
    limits: JournalLimits, subject: str, table: xr.Dataset, area: float
) -> Iterator[Verdict]:
    """Specific load of a shaft that stands against the material.

    It rests on no film; the largest pressure of its contact is one of elastic bodies, and p̄_lim of
    ISO 7902-3 is one of F/(B D).
    """
    value, case, time = worst_of(table, "standing_load", "most")
    if case:
        note = "the shaft stands: no film pressure is held against the material"
        what = "specific load F/(B D) at standstill"
        yield _of_material(limits, subject, what, value / area, table, case, time, note, "journal")


def warm_in(table: xr.Dataset, case: str) -> float:
    """Largest temperature in a case, K; NaN where none is known."""
    if "largest_temperature" not in table:
        return np.nan
    return float(table["largest_temperature"].sel(case=case))  # NaN: cold beside a warm one


def _of_material(
    limits: FilmLimits, subject: str, what: str, value: float, table: xr.Dataset, case: str,
    time: float, note: str, section: str,
) -> Verdict:  # fmt: skip
    """Hold a pressure against the material of the shell."""
    points = ", ".join(f"{p / 1e6:g} MPa at {t - CELSIUS:.0f} °C" for t, p in limits.material)
    return Verdict(
        subject, what, value, limits.pressure_at(warm_in(table, case)), "at most", "Pa",
        source_of(limits, "material", f"white metal, {points} [Jonuschies 2015, ch. 3]"), case,
        time, note, f"{section}.limits.material",
    )  # fmt: skip


def _warmth(subject: str, table: xr.Dataset, limits: JournalLimits) -> Verdict:
    value, case, time = worst_of(table, "largest_temperature", "most")
    by_oil = f"oil {limits.oil}, {limits.oil_hours:g} h [Jonuschies 2015, Table 3-2]"
    stated = limits.temperature is not None
    return Verdict(
        subject, "effective temperature of the film", value, limits.oil_temperature, "at most",
        "K", STATED if stated else by_oil, case, time,
        key="journal.limits." + ("temperature" if stated else "oil"),
    )  # fmt: skip


def _thrust_on_journal(subject: str, table: xr.Dataset) -> Verdict | None:
    """Force along the shaft that its suspension puts on a bearing which cannot carry any."""
    value, case, time = worst_of(table, "largest_axial_load", "most")
    if not value > SLIGHT * float(table["largest_load"].max()):
        return None
    return Verdict(
        subject,
        "force along the shaft without a bearing",
        value,
        0.0,
        "at most",
        "N",
        "equilibrium of the shaft",
        case,
        time,
        f"{value / 1e3:.0f} kN along the shaft is carried by no bearing of this arrangement; "
        "it needs a thrust bearing",
    )


# --- thrust bearings and pairs of cones ---------------------------------------------------------


def _of_pads(part: AnyAxial, name: str, table: xr.Dataset) -> Iterator[Verdict]:
    """Verdicts on the films of one bearing that carries the force along the shaft."""
    subject, own = f"{part.kind} {name}", table.sel(bearing=name)
    yield answered(subject, own)
    yield from _in_contact(subject, own, part.limits, "in contact", "thrust")
    production = _production(own)
    if production.sizes["case"]:
        touching = production["in_contact"] > 0
        note = f"in contact in {load_cases(int(touching.sum()))}" if touching.any() else ""
        yield _thinnest(part, subject, production, note, "thrust")
    yield from _pressure(part.limits, subject, own, "thrust")
    value, case, time = worst_of(own, "largest_axial_load", "most")
    yield Verdict(
        subject, "force along the shaft without a bearing", 0.0, 0.0, "at most", "N",
        "equilibrium of the shaft", case, time,
        f"{value / 1e3:.0f} kN along the shaft is carried by {name}, a {part.words}",
    )  # fmt: skip
