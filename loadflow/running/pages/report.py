"""A finished run → its report page; reads only what the run left on disk."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.journal.critical import Critical
from loadflow.planning.budget import Answer, answers, more_seeds
from loadflow.planning.seeds_wanted import enough_seeds, of_run
from loadflow.planning.verification import WARN
from loadflow.plots.journal import orbit
from loadflow.plots.style import readable
from loadflow.quantities import four_digits, percent
from loadflow.report import Chart, Drawing, Picture, Section, Table, figures, mark_of, write_page
from loadflow.report.charts import CLOSE, SAMPLES
from loadflow.report.page import ZERO, Shown, write_tables
from loadflow.report.run_charts import film_chart, over_wind_speed, reduction_chart, ring_chart
from loadflow.report.sketch import sketch
from loadflow.running.folder import (
    ForceOf,
    answered,
    forces_of,
    groups_of_result,
    read_manifest,
    read_part,
    results_of,
)
from loadflow.running.pages.answers import answer_tables
from loadflow.running.pages.dynamics import dynamics_section
from loadflow.running.pages.energy import energy_table
from loadflow.running.pages.lifetime import lifetime_of_loads, lifetime_section
from loadflow.running.pages.loads import loads_section
from loadflow.running.pages.moments import anchors_of, moments_section
from loadflow.running.pages.profile import profile_section
from loadflow.running.pages.seeds import seed_section
from loadflow.running.pages.start import start_tables
from loadflow.running.pages.verdicts import lifetime_table, verdict_sentence, verdict_table
from loadflow.running.pages.wear import wear_section
from loadflow.running.report_state import fingerprint
from loadflow.scene.scene import Scene, read_scene
from loadflow.scene.unused import friction_note, scaling_note, unused_keys
from loadflow.stages.bores import told_bores
from loadflow.studies.compare.words import drawn
from loadflow.studies.lifetime.page import write_lifetime_tables

TABLES = "tables"
"""Folder of a run that holds the tables of its report as CSV."""


def write_report(folder: Path, again: bool = False) -> Path:
    """Write ``report.html`` into the folder of a run, unless it is there and nothing has changed.

    Parameters
    ----------
    folder : Path
        Of a finished run.
    again : bool
        Write it in any case.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    loadflow.errors.InputError
        The folder holds no finished run.
    """
    if not (folder / "result.h5").exists():
        raise InputError(f"{folder}: no finished run here (result.h5 is missing)")
    manifest = read_manifest(folder)
    made_of = fingerprint(folder)
    if not again and mark_of(folder / "report.html") == made_of:
        return folder / "report.html"
    scene = read_scene(folder / "scene.toml")
    tables = results_of(folder) or {}
    force_of = forces_of(folder)
    lives, options = lifetime_of_loads(folder, scene, tables, force_of)
    errors, effects = manifest.get("expected_errors", {}), manifest.get("effects", [])
    found = answers(scene, tables, errors, effects)
    moments = moments_section(folder, found, tables)
    facts = _facts(scene, manifest, told_bores(tables))
    first = _overview(scene, tables, manifest, found, anchors_of(moments))
    sections = [replace(first, facts=facts), *_sections(folder, scene, manifest, tables, force_of)]
    sections[-1:-1] = [moments] if moments.pictures else []  # before what made it
    sections[2:2] = [lifetime_section(lives, options)] if lives else []  # behind overview and loads
    beside = folder / TABLES
    kept = {*write_tables(beside, sections), *write_lifetime_tables(lives, beside)}
    for old in {*beside.glob("*.csv")} - kept:
        old.unlink()
    return write_page(folder / "report.html", f"loadflow: {scene.name}", {}, sections, made_of)


def _facts(scene: Scene, manifest: dict[str, Any], found: list[str]) -> dict[str, str]:
    """What was asked for; it stands behind the answers."""
    loads = scene.loads
    source = (
        f"simulated, DLC {', '.join(loads.dlcs)}, category {loads.category}, {scene.turbine.name}"
        if loads.source == "simulate"
        else f"{len(manifest['inputs'])} files"
    )
    # by the run: a resolved scene states all of it
    taken = [*manifest.get("taken", scene.taken), *found]
    return {
        "Turbine": _turbine_fact(scene),
        "Loads": source,
        **({"Taken from elsewhere": "; ".join(taken)} if taken else {}),
        "Load cases": str(len(manifest["cases"])),
        "Results": ", ".join(scene.results),
        "Tables as CSV": f"in the folder {TABLES} beside this page",
    }


def _took(manifest: dict[str, Any]) -> str:
    seconds, workers = manifest.get("wall_seconds", 0.0), manifest.get("workers")
    time = f"{seconds:.0f} s" if seconds < _LONG else f"{seconds / 60:.0f} min"
    return f"{time} with {workers} {'process' if workers == 1 else 'processes'}"


_LONG = 600.0  # s: longer times are told in minutes


def _turbine_fact(scene: Scene) -> str:
    from loadflow.turbines import load_turbine

    turbine = load_turbine(scene.turbine.name)
    power = f"{turbine.rated_power / 1e6:.3g} MW, rotor of {2 * turbine.rotor.radius:.4g} m"
    return f"{turbine.name} ({power}; {turbine.source})"


def _sections(
    folder: Path,
    scene: Scene,
    manifest: dict[str, Any],
    tables: dict[str, xr.Dataset],
    force_of: ForceOf,
) -> Iterator[Section]:
    shown = _shown_cases(tables, manifest)
    yield loads_section(folder, tables, shown)
    if "iterations" in tables.get("shaft", ()):
        yield Section(
            "Shaft",
            "Shaft and the scene's own bearings, iterated until they agree. Marked: cases with "
            "samples to which a bearing has no answer; it is rigid there.",
            tables=[_case_table(tables["shaft"].drop_dims("bearing"))],
        )
    if "seeds" in tables:
        yield seed_section(folder, tables["seeds"], manifest, force_of)
    histogram = scene.reduction.method == "histogram"
    if histogram and (folder / "reduction").is_dir() and "reduction" in manifest["stages"]:
        yield Section(
            "Reduction",
            "Bivariate histogram of speed and load before and after the quasi-static reduction.",
            pictures=[*_reductions(folder, shown)],
        )
    if "journal" in tables:
        pictures: list[Shown] = [*_films(folder, shown), *_orbits(folder, shown[:1])]
        films = tables["journal"]
        listed = [*start_tables(films), _case_table(films)]
        yield Section("Journal bearing", tables=listed, pictures=pictures)
    if "wear" in tables:
        yield wear_section(groups_of_result(folder, "wear"))
    if "thrust" in tables:
        yield Section("Thrust bearing", tables=[_case_table(tables["thrust"])])
    if "dynamics" in tables:
        yield dynamics_section(tables["dynamics"])
    if "rolling" in tables:
        yield Section(
            "Rolling bearing",
            "Rings as the scene says; flexible rings share the load differently from rigid ones.",
            tables=_rolling_tables(tables["rolling"]),
            pictures=[*_rings(folder, shown)],
        )
    if "friction" in tables:
        yield Section(
            "Friction of rolling bearings",
            f"Losses, film and slip over the series, {scene.friction.lubricant}; the friction "
            "power of journal bearings stands in their own table. Torques after catalogues are for "
            "comparison: nothing follows from them."
            + "".join(f" Doubtful: {note}." for note in friction_note(scene)),
            tables=[_case_table(tables["friction"])],
        )
    if "check" in tables:
        yield _check_section(tables["check"])
    yield from profile_section(folder)
    yield _provenance(manifest)


def _overview(
    scene: Scene,
    tables: dict[str, xr.Dataset],
    manifest: dict[str, Any],
    found: list[Answer],
    shown: Collection[str],
) -> Section:
    failures = manifest.get("failures", {})
    caption = "Every load case over wind speed."
    pictures: list[Shown] = [_shaft_sketch(scene)]
    pictures += over_wind_speed(tables.get("journal"), tables.get("rolling"), caption)
    notes = [*answer_tables(scene, found, tables, shown), *verdict_table(tables, shown)]
    notes += lifetime_table(tables)
    notes += energy_table(tables)
    if failures:
        without = [[part, why] for part, why in failures.items()]
        notes.append(Table("Without an answer", ["part", "why"], without))
    if scaled := scaling_note(scene):
        notes.append(Table("Doubtful", ["what"], [[text] for text in scaled]))
    if unused := unused_keys(scene):
        rows = [[key, why] for key, why in unused.items()]
        notes.append(Table("Keys without effect", ["key", "why"], rows))
    said = [f"not accurate enough: {short}" for short in manifest.get("shortfalls", ())]
    said.append(more_seeds(found, lambda result: min(scene.allowed(result), WARN)))
    said.append(enough_seeds(of_run(scene, tables, manifest.get("expected_errors", {}))))
    points = [f"{one[0].upper()}{one[1:].rstrip('.')}." for one in said if one]
    return Section("Overview", verdict_sentence(tables), notes, pictures, points=points)


def _shown_cases(tables: dict[str, xr.Dataset], manifest: dict[str, Any]) -> list[str]:
    """Return the worst case first, then one case of each other wind speed."""
    order = list(manifest["cases"])
    if "journal" in tables:
        worst = tables["journal"]["largest_eccentricity_ratio"].max("bearing")
    elif "rolling" in tables:
        worst = tables["rolling"]["largest_ball_force"]
    else:
        worst = None
    first = str(worst.idxmax("case").item()) if worst is not None else order[0]
    by_speed = {name.rsplit("_s", 1)[0]: name for name in reversed(order)}
    return [first, *(n for k, n in by_speed.items() if k != first.rsplit("_s", 1)[0])][:16]


def _shaft_sketch(scene: Scene) -> Drawing:
    caption = (
        "To scale along the shaft. x points downwind along the shaft, z up, y to the left looking "
        "downwind, into the page; orange: masses on the shaft. N floats and N2 locates where there "
        "are two bearings; M takes force and tilting moment alone."
    )
    return Drawing(sketch(drawn(scene)), caption)


_FILM = ("time", "eccentricity_ratio", "minimum_film", "maximum_pressure")
_PLACE = ("eccentricity", "eccentricity_ratio", "minimum_film")
_HISTOGRAM = ("counts_full", "counts_reduced", "speed_edges", "load_edges")


def _films(folder: Path, shown: list[str]) -> Iterator[Chart]:
    for k, name in enumerate(answered(folder, "journal", shown)):
        for bearing, data in read_part(folder, "journal", name, _FILM).items():
            begins = Critical.told(data.attrs)
            level = begins.ratio if math.isfinite(begins.ratio) else None
            said, count = f"{name}, bearing {bearing}", SAMPLES if k else CLOSE
            yield film_chart(data, said, k > 0, count, level, begins.film or None)


def _orbits(folder: Path, shown: list[str]) -> Iterator[Picture]:
    for name in answered(folder, "journal", shown):
        for bearing, data in read_part(folder, "journal", name, _PLACE).items():
            yield Picture(orbit(_spread(data)), f"{name}, bearing {bearing}")


def _spread(data: xr.Dataset, count: int = 3000) -> xr.Dataset:
    """Some samples of all eccentricities, the largest among them, in order."""
    ratio = data["eccentricity_ratio"].values
    order = np.argsort(ratio)[: np.count_nonzero(~np.isnan(ratio))]  # without an answer: last
    if ratio.size <= count or order.size == 0:
        return data
    picks = np.linspace(order.size - 1, 0, min(count, order.size)).astype(int)
    return data.isel(sample=np.sort(order[picks]))


def _reductions(folder: Path, shown: list[str]) -> Iterator[Shown]:
    """Histograms of the worst case, and how the loads of the others are distributed."""
    for k, name in enumerate(answered(folder, "reduction", shown)):
        for bearing, data in read_part(folder, "reduction", name, _HISTOGRAM).items():
            said = f"{name}, bearing {bearing}"
            if k == 0:
                yield Drawing(figures.histograms(data), said)
            else:
                yield reduction_chart(data, said, True)


def _rings(folder: Path, shown: list[str]) -> Iterator[Shown]:
    """Forces of the balls: the worst case around the ring, the others unrolled."""
    for k, name in enumerate(answered(folder, "rolling", shown)):
        (data,) = read_part(folder, "rolling", name, ("ball_forces", "ball_angle")).values()
        if "ball_forces" in data:
            yield ring_chart(data, name, True) if k else Picture(figures.ball_ring(data), name)


def _rolling_tables(data: xr.Dataset) -> list[Table]:
    """Cases of the first bearing, and what is kept of each if there are several."""
    first = _case_table(data.drop_dims("bearing"))
    if data.sizes["bearing"] == 1:
        return [first]
    each = [name for name in data.data_vars if set(data[name].dims) == {"case", "bearing"}]
    return [first, _case_table(data[each])]


def _case_table(data: xr.Dataset) -> Table:
    """One row for each case (and bearing), one column for each number that is ever not zero.

    What is zero, and what no case has, as times of starts where nothing starts, is named below.
    """
    names = [str(n) for n in data.data_vars if set(data[n].dims) <= {"case", "bearing"}]
    names = [n for n in names if not (n.endswith("_time") and n.removesuffix("_time") in names)]
    numbers = {n: data[n].values.astype(float) for n in names}
    empty = [n for n in names if not np.nan_to_num(numbers[n]).any()]
    dims = [dim for dim in ("bearing", "case") if dim in data.dims]
    shown = {
        n: readable(data[n], "µm" if data[n].attrs.get("units") == "m" and "film" in n else None)
        for n in names
        if n not in empty
    }
    values = {
        n: np.broadcast_to(
            each if "bearing" in data[n].dims else each[None] if "bearing" in dims else each,
            [data.sizes[dim] for dim in dims],
        ).reshape(-1, data.sizes["case"])
        for n, (each, _) in shown.items()
    }
    heads = [f"{data[n].attrs['long_name']}, {unit}" for n, (_, unit) in shown.items()]
    bearings = data["bearing"].values if "bearing" in dims else [""]
    counts = np.zeros((len(bearings), data.sizes["case"]))
    if "not_converged" in data:
        counts = counts + data["not_converged"].transpose(*dims).values.reshape(-1, counts.shape[1])
    rows = [
        [f"{case} {bearing}".strip(), *(four_digits(values[n][b, k]) for n in values)]
        for k, case in enumerate(data["case"].values)
        for b, bearing in enumerate(bearings)
    ]
    bad = frozenset(map(int, np.flatnonzero(counts.T.ravel() > 0)))
    left_out: dict[str, list[str]] = {ZERO: [], "In no case": []}
    for n in empty:
        why = "In no case" if np.isnan(numbers[n]).all() else ZERO
        left_out[why].append(str(data[n].attrs["long_name"]))
    return Table("", ["case", *heads], rows, bad, left_out=left_out)


def _check_section(check: xr.Dataset) -> Section:
    """Tabulate how far off the answers of sampled cases are, by better models."""
    doubtful = ~(check["difference"] <= check["allowed"].fillna(WARN))
    rows = [
        [
            *(str(check[name].values[k]) for name in ("stage", "quantity", "case", "against")),
            "not solved" if np.isnan(change) else percent(change),
        ]
        for k, change in enumerate(check["difference"].values)
    ]
    heads = ["stage", "quantity", "case", "against", "largest error"]
    bad = frozenset(map(int, np.flatnonzero(doubtful)))
    text = (
        "A few load cases of this run, solved again by better models. Marked: more than the "
        f"accuracy asked for, or {percent(WARN)} where none is, and films that no better model "
        "has. A film is off by what finer cells change, and what still finer ones are expected to."
    )
    return Section("Check", text, [Table("", heads, rows, bad)])


def _provenance(manifest: dict[str, Any]) -> Section:
    rows = [
        [
            stage,
            rung["rung"],
            rung.get("reason", ""),
            rung["error"],
            f"{manifest.get('seconds', {}).get(stage, 0.0):.1f}",
        ]
        for stage, rung in manifest["rungs"].items()
    ]
    heads = ["stage", "model", "chosen", "error against the top model", "seconds, all processes"]
    inputs = [[Path(file).name, digest[:16]] for file, digest in manifest["inputs"].items()]
    tables = [Table("Models", heads, rows)]
    if inputs:
        tables.append(Table("Input files", ["file", "SHA-256, beginning"], inputs))
    facts = {
        "Took": _took(manifest),
        "Software": ", ".join(f"{k} {v}" for k, v in manifest["versions"].items()),
    }
    return Section("Provenance", tables=tables, facts=facts)
