"""Verdicts on the seeds of a load cube → a page with tables and figures of each wind speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube import Cube
from loadflow.plots.style import readable
from loadflow.report import Picture, Section, Table, figures, load_figures, write_page
from loadflow.seeds import averaged_spectrum, probability_paper
from loadflow.seeds.probability import Distribution
from loadflow.seeds.spectra import BAND
from loadflow.studies.channels import channel
from loadflow.studies.seeds.verdicts import (
    HEADS,
    SUFFICIENCY_HEADS,
    Group,
    Verdict,
    as_row,
    count_different,
    seed_groups,
    sufficiency,
)

PANELS = 4  # components in one figure
SEGMENTS = 15  # a record for its averaged spectrum
LOGARITHMIC: tuple[Distribution, ...] = ("lognormal", "weibull")
PAPERS: tuple[Distribution, ...] = ("normal", *LOGARITHMIC, "gumbel")
TEXT = {
    "as-printed": (
        "Every sample counts as independent, which samples of a record are not: these tests reject "
        "nearly always, although nothing differs. Location and spread: H of Kruskal–Wallis and "
        "Meyer-Bahlburg; spectrum: the largest relative difference, which has no p value."
    ),
    "calibrated": (
        "The tests take the true uncertainty of correlated records; the statistics are F, the p "
        "value of all is corrected for the number of components and wind speeds (Holm)."
    ),
}


def write_seed_page(
    path: Path,
    cube: Cube,
    verdicts: Sequence[Verdict],
    groups: Mapping[tuple[str, float, float], str],
    *,
    margin: float = 0.05,
    uncertainty: float = 0.05,
    source: str = "load cube",
) -> Path:
    """Write a page: all verdicts, then for each wind speed what belongs to it.

    A wind speed has its verdict table (as Tables 5-2 … 5-12 of [Jonuschies 2015]), which seeds
    belong together, whether they are equivalent and enough, box plots, spectra with their band,
    and rotor speed and loads on probability paper.

    Parameters
    ----------
    path : Path
        HTML file to write.
    cube : Cube
        The cube.
    verdicts : sequence of Verdict
        What `seed_verdicts` found in it.
    groups : mapping
        What `groupings` found in it.
    margin, uncertainty : float
        See `loadflow.studies.seeds.verdicts.sufficiency`.
    source : str
        Name of the cube, for the title.
    """
    first = verdicts[0].equality
    facts = {
        "Method": first.method,
        "Level of significance": f"{first.alpha:g}",
        "Result": count_different(verdicts),
    }
    sections = [Section("Verdicts", TEXT[first.method], [_table("", verdicts)])]
    names = list(dict.fromkeys(verdict.component for verdict in verdicts))
    for (dlc, wind_speed, step), group in seed_groups(cube).items():
        if len(group) < 2:
            continue
        own = [
            v for v in verdicts if (v.dlc, v.wind_speed, v.seeds) == (dlc, wind_speed, len(group))
        ]
        enough = sufficiency(group, names, step, margin, uncertainty, first.alpha)
        rows = [entry.as_row() for entry in enough]
        title = f"Within {margin:.0%}, and seeds for {uncertainty:.0%} at {1 - first.alpha:.0%}"
        tables = [_table("Equality", own), Table(title, list(SUFFICIENCY_HEADS), rows)]
        sections.append(
            Section(
                f"DLC {dlc}, {wind_speed:g} m/s",
                f"Groups of seeds: {groups[dlc, wind_speed, step]}",
                tables,
                [
                    *_pictures(group, step, names, fold=len(sections) > 1),
                    *_paper_pictures(group, names),
                ],
            )
        )
    return write_page(path, f"Seeds of {source}", facts, sections)


def _table(title: str, verdicts: Sequence[Verdict]) -> Table:
    different = [k for k, verdict in enumerate(verdicts) if not verdict.equal]
    return Table(title, list(HEADS), [as_row(v) for v in verdicts], frozenset(different))


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
                values, units[name] = readable(channel(case, name))
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


def _paper_pictures(group: Group, names: list[str]) -> Iterator[Picture]:
    """Put rotor speed and the radial forces of all seeds on probability paper (annex A 2)."""
    for name, parts in _speed_and_radial(names).items():
        components = [[channel(case, part).values for part in parts] for case in group]
        sample = np.concatenate([np.sqrt(np.sum(np.square(c), axis=0)) for c in components])
        attrs = channel(group[0], parts[0]).attrs
        values, unit = readable(xr.DataArray(sample, dims="sample", attrs=attrs))
        if np.ptp(values) > 0:
            drawing = load_figures.probability_papers(_papers(values), f"{name}, {unit}")
            yield Picture(drawing, f"All seeds of {name} on probability paper.", True)


def _speed_and_radial(names: list[str]) -> dict[str, list[str]]:
    """Rotor speed, and each force across the shaft by its two components."""
    found = {"speed": ["speed"]} if "speed" in names else {}
    for name in names:
        stem, _, axis = name.rpartition(".")
        if axis == "y" and "force" in stem and f"{stem}.z" in names:
            found[f"{stem}.yz"] = [f"{stem}.y", f"{stem}.z"]
    return found


def _papers(values: np.ndarray) -> list[load_figures.Paper]:
    """Put a sample on every paper that can hold it."""
    fits = [
        probability_paper(values, name)
        for name in PAPERS
        if values.min() > 0 or name not in LOGARITHMIC
    ]
    return [
        load_figures.Paper(
            title=f"{fit.distribution}: error {fit.error:.3f}",
            value=fit.value,
            probability=fit.probability,
            variate=fit.variate,
            line=fit.quantile(fit.probability),
            logarithmic=fit.distribution in LOGARITHMIC,
        )
        for fit in fits
    ]


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
