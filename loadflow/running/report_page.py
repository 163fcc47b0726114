"""A finished run → its report page; reads only what the run left on disk."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import open_cube
from loadflow.errors import InputError
from loadflow.planning.verification import WARN
from loadflow.plots.journal import film_series, orbit
from loadflow.plots.style import readable
from loadflow.report import Picture, Section, Table, figures, write_page
from loadflow.running.dynamics_page import dynamics_section
from loadflow.running.folder import read_manifest
from loadflow.scene.scene import Scene, read_scene
from loadflow.scene.unused import friction_note, scaling_note, unused_keys
from loadflow.stages.loads import doubts, trips, when_tripped
from loadflow.stages.statistics import SLOPE
from loadflow.studies.extreme_loads import safety_factor
from loadflow.verdict import Verdict, from_dataset

LOAD_ROWS = (
    ("speed", "speed"),
    ("hub_force", "hub force"),
    ("hub_moment", "hub moment"),
    ("force", "bearing"),
)


def write_report(folder: Path) -> Path:
    """Write ``report.html`` into the folder of a run.

    Raises
    ------
    loadflow.errors.InputError
        The folder holds no finished run.
    """
    if not (folder / "result.h5").exists():
        raise InputError(f"{folder}: no finished run here (result.h5 is missing)")
    scene = read_scene(folder / "scene.toml")
    manifest = read_manifest(folder)
    results = open_cube(folder / "result.h5")
    groups = results.children if isinstance(results, xr.DataTree) else {}
    tables = {name: node.to_dataset() for name, node in groups.items()}
    sections = [*_sections(folder, scene, manifest, tables)]
    return write_page(
        folder / "report.html", f"loadflow: {scene.name}", _facts(scene, manifest), sections
    )


def _facts(scene: Scene, manifest: dict[str, Any]) -> dict[str, str]:
    loads = scene.loads
    source = (
        f"simulated, DLC {', '.join(loads.dlcs)}, category {loads.category}, {scene.turbine.name}"
        if loads.source == "simulate"
        else f"{len(manifest['inputs'])} files"
    )
    short = manifest.get("shortfalls", [])
    return {
        **({"Not accurate enough": "; ".join(short)} if short else {}),
        "Turbine": _turbine_fact(scene),
        "Loads": source,
        **({"Taken from elsewhere": "; ".join(scene.taken)} if scene.taken else {}),
        "Load cases": str(len(manifest["cases"])),
        "Results": ", ".join(scene.results),
        "Took": f"{manifest.get('wall_seconds', 0):.0f} s with {manifest.get('workers')} processes",
        "Software": ", ".join(f"{k} {v}" for k, v in manifest["versions"].items()),
    }


def _turbine_fact(scene: Scene) -> str:
    from loadflow.turbines import load_turbine

    turbine = load_turbine(scene.turbine.name)
    power = f"{turbine.rated_power / 1e6:.3g} MW, rotor of {2 * turbine.rotor.radius:.4g} m"
    return f"{turbine.name} ({power}; {turbine.source})"


def _sections(
    folder: Path, scene: Scene, manifest: dict[str, Any], tables: dict[str, xr.Dataset]
) -> Iterator[Section]:
    yield _overview(scene, tables, manifest)
    shown = _shown_cases(tables, manifest)
    yield Section(
        "Loads",
        tables=[*_trip_table(tables), *_doubt_table(tables), *_load_tables(tables)],
        pictures=[*_load_pictures(folder, shown)],
    )
    if "shaft" in tables:
        yield Section(
            "Shaft",
            "Shaft and the scene's own bearings, iterated until they agree. Marked: cases with "
            "samples to which a bearing has no answer; it is rigid there.",
            tables=[_case_table(tables["shaft"])],
        )
    if "seeds" in tables:
        yield _seed_section(folder, tables["seeds"], manifest)
    histogram = scene.reduction.method == "histogram"
    if histogram and (folder / "reduction").is_dir() and "reduction" in manifest["stages"]:
        yield Section(
            "Reduction",
            "Bivariate histogram of speed and load before and after the quasi-static reduction.",
            pictures=[*_per_bearing(folder, "reduction", shown, figures.histograms)],
        )
    if "journal" in tables:
        pictures = [
            *_per_bearing(folder, "journal", shown, film_series),
            *_per_bearing(folder, "journal", shown[:1], orbit),
        ]
        yield Section("Journal bearing", tables=[_case_table(tables["journal"])], pictures=pictures)
    if "dynamics" in tables:
        yield dynamics_section(tables["dynamics"])
    if "rolling" in tables:
        yield Section(
            "Rolling bearing",
            "Rings as the scene says; flexible rings share the load differently from rigid ones.",
            tables=_rolling_tables(tables["rolling"]),
            pictures=[
                Picture(figures.ball_ring(case), _caption(name), k > 0)
                for k, name in enumerate(_there(folder, "rolling", shown))
                if "ball_forces" in (case := _open(folder, "rolling", name))
            ],
        )
    if "friction" in tables:
        yield Section(
            "Friction of rolling bearings",
            f"Losses, film and slip over the series, {scene.friction.lubricant}; the friction "
            "power of journal bearings stands in their own table."
            + "".join(f" Doubtful: {note}." for note in friction_note(scene)),
            tables=[_case_table(tables["friction"])],
        )
    if "check" in tables:
        yield _check_section(tables["check"])
    yield _provenance(manifest)


def _overview(scene: Scene, tables: dict[str, xr.Dataset], manifest: dict[str, Any]) -> Section:
    failures = manifest.get("failures", {})
    drawing = figures.over_wind_speed(tables.get("journal"), tables.get("rolling"))
    pictures = [Picture(drawing, "Every load case over wind speed.")] if drawing else []
    notes = [*_verdict_table(tables), *_lifetime_table(tables)]
    if failures:
        without = [[part, why] for part, why in failures.items()]
        notes.append(Table("Without an answer", ["part", "why"], without))
    if scaled := scaling_note(scene):
        notes.append(Table("Doubtful", ["what"], [[text] for text in scaled]))
    if unused := unused_keys(scene):
        rows = [[key, why] for key, why in unused.items()]
        notes.append(Table("Keys without effect", ["key", "why"], rows))
    return Section("Overview", tables=notes, pictures=pictures)


def _verdict_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """All verdicts of the run, the broken ones marked; nothing if there are none."""
    if "verdicts" not in tables:
        return
    found = [*from_dataset(tables["verdicts"])]
    rows = [_verdict_row(verdict) for verdict in found]
    bad = frozenset(k for k, verdict in enumerate(found) if not verdict.holds)
    heads = ["bearing", "what", "value", "limit", "margin", "verdict", "governed by", "limit from"]
    yield Table("Verdicts", [*heads, "remarks"], rows, bad)


def _verdict_row(verdict: Verdict) -> list[str]:
    limit, at = "", verdict.case
    if np.isfinite(verdict.limit):
        limit = f"{'≤' if verdict.sense == 'at most' else '≥'} {verdict.limit:.4g} {verdict.unit}"
    if np.isfinite(verdict.time):
        at += f", {verdict.time:.1f} s"
    value, margin = (
        "-" if np.isnan(number) else f"{number:.4g} {verdict.unit}"
        for number in (verdict.value, verdict.margin)
    )
    said = (limit, margin, verdict.answer, at, verdict.source, verdict.note)
    return [verdict.subject, verdict.quantity, value, *said]


def _lifetime_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Life and energy a year of each bearing over all load cases."""
    if "lifetime" not in tables:
        return
    data, rows = tables["lifetime"], []
    for kind in ("journal", "rolling"):
        for name in data[kind].values.tolist() if kind in data.dims else ():
            own = {n: data[n].sel({kind: name}) for n in data.data_vars if kind in data[n].dims}
            life, modified = (
                f"{float(own[n]):.4g}" if n in own else "-"
                for n in ("life_hours", "modified_life_hours")
            )
            energy = own.get(f"{kind}_energy")
            spent = "-" if energy is None else f"{float(energy) / 3.6e6:.4g}"
            rows.append([f"{kind} {name}", life, modified, spent])
    heads = ["over all load cases", "life L10h, h", "modified life L10mh, h", "energy, kW h a year"]
    yield Table("Lifetime", heads, rows)


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


def _open(folder: Path, stage: str, case: str) -> Any:
    return open_cube(folder / stage / f"{case}.h5")


def _there(folder: Path, stage: str, cases: list[str]) -> list[str]:
    """Return the cases that the stage has answered."""
    return [case for case in cases if (folder / stage / f"{case}.h5").exists()]


def _caption(case: str, more: str = "") -> str:
    return f"{case}{', ' + more if more else ''}"


def _trip_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Cases that are no longer what their load case says; nothing if there are none."""
    if rows := [[name, when_tripped(time)] for name, time in trips(tables).items()]:
        yield Table("Tripped on overspeed, and stopped from then on", ["load case", "when"], rows)


def _doubt_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """What does not fit turbine, frame, unit or step; nothing if all does."""
    rows = [[name, doubt] for name, said in doubts(tables).items() for doubt in said]
    if rows:
        marked = frozenset(range(len(rows)))
        yield Table("Doubtful series", ["load case", "what does not fit"], rows, marked)


def _load_tables(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Mean, spread and extremes of all loads; the largest with the safety factor of its case."""
    if "statistics" not in tables:
        return
    data = tables["statistics"]
    factors = np.array([safety_factor(str(dlc)) for dlc in data["dlc"].values])
    rows, ultimate = [], []
    for name, title in LOAD_ROWS:
        if name not in data:
            continue
        for label, part in _parts(data[name], title):
            values, unit = readable(part.assign_attrs(data[name].attrs))
            table = dict(zip(part["statistic"].values, np.moveaxis(values, _axis(part), 0)))
            rows.append(
                [
                    f"{label}, {unit}",
                    *(f"{table[s].mean():.4g}" for s in ("mean", "std", "del")),
                    f"{table['min'].min():.4g}",
                    f"{table['max'].max():.4g}",
                ]
            )
            if name != "speed":
                largest = np.maximum(np.abs(table["min"]), np.abs(table["max"]))
                k = int(np.argmax(factors * largest))
                ultimate.append(
                    [
                        f"{label}, {unit}",
                        f"{largest[k]:.4g}",
                        f"{factors[k]:g}",
                        f"{factors[k] * largest[k]:.4g}",
                        str(data["case"].values[k]),
                    ]
                )
    heads = [
        "over all cases",
        "mean",
        "mean std",
        f"mean DEL (m = {SLOPE:g})",
        "smallest",
        "largest",
    ]
    yield Table("Loads", heads, rows)
    heads = ["largest magnitude", "characteristic", "γ_f", "design value", "load case"]
    yield Table("Ultimate loads", heads, ultimate)


def _axis(part: xr.DataArray) -> int:
    return part.dims.index("statistic")


def _parts(data: xr.DataArray, title: str) -> Iterator[tuple[str, xr.DataArray]]:
    dims = [dim for dim in ("bearing", "axis") if dim in data.dims]
    if not dims:
        yield title, data
        return
    for labels, part in data.stack(part=dims).groupby("part"):
        names = labels if isinstance(labels, tuple) else (labels,)
        yield f"{title} {' '.join(map(str, names))}", part.squeeze("part", drop=True)


def _load_pictures(folder: Path, shown: list[str]) -> Iterator[Picture]:
    for k, name in enumerate(_there(folder, "shaft", shown)):
        drawing = figures.load_series(
            _open(folder, "loads", name).load(), _open(folder, "shaft", name).load()
        )
        yield Picture(drawing, _caption(name, "worst case" if k == 0 else ""), fold=k > 0)


def _per_bearing(folder: Path, stage: str, shown: list[str], draw: Any) -> Iterator[Picture]:
    for k, name in enumerate(_there(folder, stage, shown)):
        for bearing, node in _open(folder, stage, name).children.items():
            yield Picture(
                draw(node.to_dataset().load()), _caption(name, f"bearing {bearing}"), k > 0
            )


def _seed_section(folder: Path, seeds: xr.Dataset, manifest: dict[str, Any]) -> Section:
    tables: list[Table] = [_merge_table(seeds)]
    pictures: list[Picture] = []
    for method in seeds["variant"].values:
        part = seeds.sel(variant=method)
        rows = [
            [
                str(group["dlc"].item()),
                f"{group['wind_speed'].item():g}",
                f"{group['seeds'].item()}",
                str(group["component"].item()),
                *(_p(group["pvalue"].sel(test=test).item()) for test in group["test"].values),
                str(group["verdict"].item()),
            ]
            for _, group in _cells(part)
        ]
        heads = ["DLC", "wind, m/s", "seeds", "component"]
        heads += [f"p {test}" for test in part["test"].values] + ["verdict"]
        tables.append(Table(f"Equality of seeds, {method}", heads, rows))
        pictures.append(Picture(figures.seed_verdicts(seeds, method), f"Tests, {method}."))
    pictures += _seed_boxes(folder, manifest)
    text = (
        "Series of one wind speed may be merged only if location, spread and spectrum agree. The "
        "printed tests take every sample as independent, which samples of a record are not: they "
        "reject nearly always. The calibrated ones hold their level."
    )
    return Section("Seeds", text, tables, pictures)


def _merge_table(seeds: xr.Dataset) -> Table:
    """Return one row for each wind speed: whether its seeds may be merged."""
    rows = [
        [
            str(seeds["dlc"].values[g]),
            f"{seeds['wind_speed'].values[g]:g}",
            str(seeds["seeds"].values[g]),
            *("yes" if merge else "no" for merge in seeds["may_merge"].isel(group=g).values),
            str(seeds["together"].values[g]),
        ]
        for g in range(seeds.sizes["group"])
    ]
    variants = [str(variant) for variant in seeds["variant"].values]
    heads = ["DLC", "wind, m/s", "seeds", *variants, "which belong together (calibrated)"]
    return Table("May the seeds be merged?", heads, rows)


def _cells(part: xr.Dataset) -> Iterator[tuple[Any, xr.Dataset]]:
    for g in range(part.sizes["group"]):
        for c in range(part.sizes["component"]):
            yield (g, c), part.isel(group=g, component=c)


def _p(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}"


def _seed_boxes(folder: Path, manifest: dict[str, Any]) -> list[Picture]:
    """Draw the spread of the seeds of every wind speed that has more than one."""
    groups: dict[str, list[str]] = {}
    for name in _there(folder, "shaft", manifest["cases"]):
        groups.setdefault(name.rsplit("_s", 1)[0], []).append(name)
    pictures: list[Picture] = []
    for group, names in groups.items():
        if len(names) < 2:
            continue
        samples: dict[str, dict[str, np.ndarray]] = {}
        units: dict[str, str] = {}
        for name in names:
            seed = name.rsplit("_s", 1)[1]
            force = _open(folder, "shaft", name)["force"]
            for bearing in force["bearing"].values[:2]:
                for axis in ("y", "z"):
                    label = f"{bearing} F{axis}"
                    values, units[label] = readable(force.sel(bearing=bearing, axis=axis))
                    samples.setdefault(label, {})[seed] = values
        pictures.append(Picture(figures.seed_boxes(samples, units), f"{group}", bool(pictures)))
    return pictures


def _rolling_tables(data: xr.Dataset) -> list[Table]:
    """Cases of the first bearing, and what is kept of each if there are several."""
    first = _case_table(data.drop_dims("bearing"))
    if data.sizes["bearing"] == 1:
        return [first]
    each = [name for name in data.data_vars if set(data[name].dims) == {"case", "bearing"}]
    return [first, _case_table(data[each])]


def _case_table(data: xr.Dataset) -> Table:
    """One row for each case (and bearing), one column for each number."""
    names = [str(n) for n in data.data_vars if set(data[n].dims) <= {"case", "bearing"}]
    names = [n for n in names if not (n.endswith("_time") and n.removesuffix("_time") in names)]
    shown = {n: readable(data[n], "µm" if "film" in n else None) for n in names}
    heads = ["case"] + [f"{data[n].attrs['long_name']}, {unit}" for n, (_, unit) in shown.items()]
    bearings = data["bearing"].values if "bearing" in data.dims else [""]
    rows: list[list[str]] = []
    bad: set[int] = set()
    for k, case in enumerate(data["case"].values):
        for b, bearing in enumerate(bearings):
            if "not_converged" in data:
                count = np.atleast_2d(data["not_converged"].values)[b, k]
                bad |= {len(rows)} if count > 0 else set()
            rows.append(
                [
                    f"{case} {bearing}",
                    *(f"{np.atleast_2d(values)[b, k]:.4g}" for values, _ in shown.values()),
                ]
            )
    return Table("", heads, rows, frozenset(bad))


def _check_section(check: xr.Dataset) -> Section:
    """Tabulate how far the answers of sampled cases move with better models."""
    doubtful = check["difference"] > check["allowed"].fillna(WARN)
    rows = [
        [
            *(str(check[name].values[k]) for name in ("stage", "quantity", "case", "against")),
            f"{100 * check['difference'].values[k]:.2g} %",
        ]
        for k in range(check.sizes["check"])
    ]
    heads = ["stage", "quantity", "case", "against", "largest change"]
    bad = frozenset(map(int, np.flatnonzero(doubtful)))
    text = (
        "A few load cases of this run, solved again by better models. Marked: more than the "
        f"accuracy asked for, or {WARN:.0%} where none is."
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
    return Section("Provenance", tables=tables)
