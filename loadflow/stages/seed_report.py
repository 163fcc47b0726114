"""Load cube → which seeds of a wind speed are equal: rows of a table, and a page of figures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases
from loadflow.errors import InputError
from loadflow.report import Picture, Section, Table, figures, write_page
from loadflow.report.style import readable
from loadflow.seeds import Method, SeedEquality, averaged_spectrum, equality, holm
from loadflow.seeds.spectra import BAND

HEADS = (
    "DLC",
    "wind, m/s",
    "seeds",
    "component",
    "p location",
    "p spread",
    "p spectrum",
    "p of all",
    "equal",
    "each test by itself",
)
STAGES = ("location", "spread", "spectrum")
PANELS = 4  # components in one figure
SEGMENTS = 15  # a record for its averaged spectrum

Group = list[xr.Dataset]
"""The seeds of one wind speed of one load case."""


@dataclass(frozen=True)
class Verdict:
    """Whether the seeds of one wind speed are equal in one component.

    Attributes
    ----------
    dlc : str
        Design load case.
    wind_speed : float
        m/s.
    seeds : int
        How many.
    component : str
        Such as ``speed``, ``hub_moment.y`` or ``force.N.z``.
    equality : SeedEquality
        The tests of this component alone.
    pvalue : float
        Of all its tests; calibrated: corrected for the number of components and wind speeds.
    equal : bool
        Calibrated: whether `pvalue` reaches the level of significance; as printed: the three
        stages of this component.
    """

    dlc: str
    wind_speed: float
    seeds: int
    component: str
    equality: SeedEquality
    pvalue: float
    equal: bool

    def as_dict(self) -> dict[str, Any]:
        """The verdict in plain values, for JSON."""
        stages = {
            name: {key: getattr(getattr(self.equality, name), key) for key in ("pvalue", "equal")}
            for name in STAGES
        }
        own = {k: v for k, v in vars(self).items() if k != "equality"}
        return own | {"alpha": self.equality.alpha, "method": self.equality.method} | stages


def as_row(verdict: Verdict) -> list[str]:
    """The verdict under `HEADS`."""
    e = verdict.equality
    pvalues = [*(getattr(e, name).pvalue for name in STAGES), verdict.pvalue]
    return [
        verdict.dlc,
        f"{verdict.wind_speed:g}",
        str(verdict.seeds),
        verdict.component,
        *(_p(p) if verdict.seeds > 1 else "-" for p in pvalues),
        "yes" if verdict.equal else "no",
        e.text,
    ]


def count_different(verdicts: Sequence[Verdict]) -> str:
    """How many differ, in words."""
    tested = sum(verdict.seeds > 1 for verdict in verdicts)
    different = sum(not verdict.equal for verdict in verdicts)
    return f"{different} of {tested} differ, {len(verdicts) - tested} have one seed"


def _p(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}"


def seed_verdicts(
    cube: Cube,
    wanted: Sequence[str] = (),
    *,
    alpha: float = 0.05,
    method: Method = "calibrated",
    source: str = "load cube",
) -> list[Verdict]:
    """Test the seeds of every wind speed of every load case, component by component.

    Seeds that are sampled at different steps are not compared with each other.

    Parameters
    ----------
    cube : Cube
        Its bearing loads are tested where it has them, else its hub loads.
    wanted : sequence of str
        Components, or variables for all their components; default: rotor speed and all loads that
        are not zero.
    alpha : float
        Level of significance; calibrated: of all verdicts together (Holm's correction).
    method : {"calibrated", "as-printed"}
        See `loadflow.seeds.equality`.
    source : str
        Name of the cube, for messages.

    Returns
    -------
    list of Verdict
        By load case, wind speed and component.

    Raises
    ------
    loadflow.errors.InputError
        An unknown component, or a series that is too short.
    """
    groups = _groups(cube)
    names = _components(next(iter(groups.values()))[0], wanted, source)
    found: list[Verdict] = []
    for (dlc, wind_speed, step), group in groups.items():
        for name in names:
            series = [_pick(case, name).values.astype(float) for case in group]
            try:
                test = equality(series, step, alpha=alpha, method=method)
            except InputError as error:
                raise InputError(f"{source}: {wind_speed:g} m/s, {name}: {error}") from error
            found.append(Verdict(dlc, wind_speed, len(group), name, test, test.pvalue, test.equal))
    return _corrected(found, alpha) if method == "calibrated" else found


def _corrected(verdicts: list[Verdict], alpha: float) -> list[Verdict]:
    """Correct for the number of tests; a single seed is no test."""
    tested = [verdict for verdict in verdicts if verdict.seeds > 1]
    adjusted = dict(zip(map(id, tested), holm([v.pvalue for v in tested]).tolist()))
    p = [adjusted.get(id(verdict), 1.0) for verdict in verdicts]
    return [replace(v, pvalue=q, equal=q >= alpha) for v, q in zip(verdicts, p)]


def _groups(cube: Cube) -> dict[tuple[str, float, float], Group]:
    """Cases of one load case, wind speed (m/s) and time step (s), in order."""
    groups: dict[tuple[str, float, float], Group] = {}
    for _, case in iter_cases(cube):
        step = round(float(case["time"][1] - case["time"][0]), 9)
        key = str(case["dlc"].item()), float(case["wind_speed"]), step
        groups.setdefault(key, []).append(case)
    if not groups:
        raise InputError("the load cube is empty, it holds no case")
    return dict(sorted(groups.items()))


def _components(case: xr.Dataset, wanted: Sequence[str], source: str) -> list[str]:
    """Names of the components to test."""
    known = {
        name: [*_labelled(data.isel(time=0, drop=True), name)]
        for name, data in ((str(n), d) for n, d in case.data_vars.items())
        if "time" in data.dims
    }
    every = [component for parts in known.values() for component in parts]
    if not wanted:
        loads = ("force", "moment") if "force" in known else ("hub_force", "hub_moment")
        chosen = [c for name in ("speed", *loads) for c in known.get(name, [])]
        return [c for c in chosen if c == "speed" or np.any(_pick(case, c))]
    unknown = [name for name in wanted if name not in known and name not in every]
    if unknown:
        raise InputError(f"{source}: no variable {unknown[0]!r}; there are {', '.join(every)}")
    chosen = [c for name in wanted for c in known.get(name, [name])]
    return list(dict.fromkeys(chosen))


def _labelled(data: xr.DataArray, name: str) -> Iterator[str]:
    """Name every component of a variable: its labels along all dimensions, joined by dots."""
    if not data.dims:
        yield name
        return
    first = data.dims[0]
    for label in data[first].values:
        yield from _labelled(data.sel({first: label}, drop=True), f"{name}.{label}")


def _pick(case: xr.Dataset, component: str) -> xr.DataArray:
    """Series of a component."""
    name, *labels = component.split(".")
    data = case[name]
    dims = [dim for dim in data.dims if dim != "time"]
    return data.sel(dict(zip(dims, labels)), drop=True)


def write_seed_page(
    path: Path, cube: Cube, verdicts: Sequence[Verdict], source: str = "load cube"
) -> Path:
    """Write a page with the verdicts, and box plots and spectra of the seeds they are about.

    Parameters
    ----------
    path : Path
        HTML file to write.
    cube : Cube
        The cube.
    verdicts : sequence of Verdict
        What `seed_verdicts` found in it.
    source : str
        Name of the cube, for the title.
    """
    first = verdicts[0].equality
    different = [k for k, verdict in enumerate(verdicts) if not verdict.equal]
    table = Table("", list(HEADS), [as_row(v) for v in verdicts], frozenset(different))
    facts = {
        "Method": first.method,
        "Level of significance": f"{first.alpha:g}",
        "Result": count_different(verdicts),
    }
    sections = [Section("Verdicts", TEXT[first.method], [table])]
    names = list(dict.fromkeys(verdict.component for verdict in verdicts))
    for (dlc, wind_speed, step), group in _groups(cube).items():
        if len(group) > 1:
            pictures = [*_pictures(group, step, names, fold=len(sections) > 1)]
            sections.append(Section(f"DLC {dlc}, {wind_speed:g} m/s", pictures=pictures))
    return write_page(path, f"Seeds of {source}", facts, sections)


TEXT = {
    "as-printed": (
        "Every sample counts as independent, which samples of a record are not: these tests reject "
        "nearly always, although nothing differs. Their spectral criterion has no p value."
    ),
    "calibrated": (
        "The tests take the true uncertainty of correlated records; the p value of all is "
        "corrected for the number of components and wind speeds (Holm)."
    ),
}


def _pictures(group: Group, step: float, names: list[str], fold: bool) -> Iterator[Picture]:
    """Draw boxes and spectra of the seeds, a few components to a figure."""
    duration = min(case.sizes["time"] for case in group) * step
    for k in range(0, len(names), PANELS):
        boxes: dict[str, dict[str, np.ndarray]] = {}
        units: dict[str, str] = {}
        spectra: dict[str, xr.DataArray] = {}
        for name in names[k : k + PANELS]:
            boxes[name] = {}
            for case in group:
                values, units[name] = readable(_pick(case, name))
                boxes[name][str(case["seed"].item())] = values
            spectra[name] = _spectra(boxes[name], step, duration, units[name])
        shown = ", ".join(boxes)
        yield Picture(figures.seed_boxes(boxes, units), f"Spread of {shown}.", fold)
        yield Picture(
            figures.seed_spectra(spectra, BAND),
            f"Averaged spectra of {shown}. Below: ratio to the mean of the seeds; "
            f"dark: ±{BAND:.1%}, light: 95 % confidence of a single seed.",
            fold,
        )


def _spectra(seeds: dict[str, np.ndarray], step: float, duration: float, unit: str) -> xr.DataArray:
    """Averaged spectra over (seed, frequency), without zero frequency."""
    segment = max(round(duration / SEGMENTS / step), 8) * step
    found = [averaged_spectrum(series, step, segment=segment) for series in seeds.values()]
    first = found[0]
    return xr.DataArray(
        [spectrum.density[1:] for spectrum in found],
        {"seed": list(seeds), "frequency": first.frequency[1:]},
        ("seed", "frequency"),
        attrs={
            "units": f"({unit})²/Hz",
            "confidence": tuple(_ratio(bound, first.density) for bound in (first.low, first.high)),
        },
    )


def _ratio(bound: np.ndarray, density: np.ndarray) -> float:
    """Bound of the confidence band over the density, which is the same at all frequencies."""
    largest = int(np.argmax(density))
    return float(bound[largest] / density[largest]) if density[largest] > 0 else 1.0
