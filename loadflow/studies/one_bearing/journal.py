"""One point, or one reduced series → the numbers of a room, labelled with unit and meaning."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError, SolverError
from loadflow.journal.rungs import RUNGS
from loadflow.quantities import CELSIUS, GRID_ERROR, table

if TYPE_CHECKING:
    from loadflow.journal import Film, JournalBearing

Load = Sequence[float]


def quantities(rows: Mapping[str, tuple[Any, str, str]], **attrs: str) -> xr.Dataset:
    """Label values of any shape: name → value, units, meaning."""
    variables = {
        name: (
            [f"{name}_{axis}" for axis in range(np.ndim(value))],
            np.asarray(value),
            {"units": units, "long_name": meaning},
        )
        for name, (value, units, meaning) in rows.items()
    }
    return xr.Dataset(variables, attrs=attrs)


def iec_conditions(
    wind_speed: float, *, wind_class: str, category: str, rotor_diameter: float, hub_height: float
) -> xr.Dataset:
    """Return the wind conditions of IEC 61400-1 at a wind speed (m/s) for a rotor (m) and height.

    Raises
    ------
    loadflow.errors.InputError
        Unknown class or category, or a wind speed that has no gust.
    """
    from loadflow.wind import iec

    v, size = wind_speed, (rotor_diameter, hub_height)
    rows = {
        "ntm_sigma": (iec.ntm_sigma(v, category), "m/s", "σ1, normal turbulence"),
        "etm_sigma": (iec.etm_sigma(v, wind_class, category), "m/s", "σ1, extreme turbulence"),
        "eog_amplitude": (
            iec.eog_amplitude(v, wind_class, category, *size),
            "m/s",
            "extreme operating gust",
        ),
        "edc_angle": (iec.edc_angle(v, category, *size), "rad", "extreme direction change, ±"),
        "ecd_angle": (iec.ecd_angle(v, wind_class), "rad", "coherent gust with direction change"),
        "ews_amplitude": (
            iec.ews_amplitude(v, category, *size),
            "m/s",
            "extreme wind shear, bracket before (1 − cos)",
        ),
        "length_scale": (iec.length_scale(hub_height), "m", "turbulence scale Λ1"),
    }
    conditions = (
        f"v = {v:g} m/s, class {wind_class}, category {category}, "
        f"D = {rotor_diameter:g} m, hub at {hub_height:g} m"
    )
    return quantities(rows, conditions=conditions)


def journal_point(force: Load, speed: float, bearing: JournalBearing, film: Film) -> xr.Dataset:
    """Return the static equilibrium of a journal bearing under one `force` (N) and `speed` (rad/s).

    Raises
    ------
    loadflow.errors.InputError
        As `JournalBearing.equilibrium`.
    loadflow.errors.SolverError
        No equilibrium.
    """
    from loadflow.stages.film_kept import KEPT, WARM

    s = bearing.equilibrium(force, speed, film)
    kept = KEPT | WARM if film.heat is not None else KEPT
    more = ["eccentricity", "stiffness", "damping"]
    more += ["reynolds_number", "critical_reynolds_number", "laminar"]
    if film.supply is not None:
        more.append("groove_flow")
    if film.shell is not None:
        more.append("shell_deformation")
    solver = {name: kept[name] for name in ("converged", "residual", "iterations")}
    first = {name: what for name, what in kept.items() if name not in solver}
    names = first | table(*more) | solver
    rows = {
        name: (getattr(s, name), units, meaning)
        for name, (units, meaning) in names.items()
        if getattr(s, name) is not None
    }
    if s.grid_error is not None:
        bounds = {name + GRID_ERROR: bound for name, bound in vars(s.grid_error).items()}
        about = table("resolved", *bounds)
        rows |= {
            name: (value, *about[name])
            for name, value in ({"resolved": s.resolved} | bounds).items()
        }
    return quantities(rows, model=_model(film))


def journal_series(path: Path, bearing: JournalBearing, film: Film) -> xr.Dataset:
    """Return extremes and weighted means of the film over the series of a parameter file.

    Samples that no film carries, such as a load at standstill, are counted in ``not_converged``.

    Raises
    ------
    loadflow.errors.InputError
        The file is no parameter file; as `JournalBearing.equilibrium`.
    loadflow.errors.SolverError
        No load at all has an equilibrium.
    """
    from loadflow.reduction import read_parameter_file
    from loadflow.stages.film_kept import KEPT, WARM
    from loadflow.stages.film_summary import extremes
    from loadflow.stages.labelling import of_samples

    reduced = read_parameter_file(path)
    answer = bearing.equilibrium(reduced.force, reduced.speed, film, strict=False)
    if not np.any(answer.converged):
        raise SolverError(f"{path}: no film carries any of the {reduced.weight.size} samples")
    kept = KEPT | WARM if film.heat is not None else KEPT
    said = vars(answer)
    if answer.resolved is not None:
        said, kept = said | {"resolved": answer.resolved}, kept | table("resolved")
    samples = xr.Dataset({**of_samples(said, kept), "weight": ("sample", reduced.weight)})
    return extremes(samples).assign_attrs(
        series=f"{path}: {reduced.source}, {reduced.weight.size} of {reduced.total} samples",
        model=_model(film),
    )


def journal_coefficients(
    file: Path,
    force: Load,
    speeds: tuple[float, float, int],
    bearing: JournalBearing,
    film: Film,
    whirl: float = 1.0,
) -> list[dict[str, float]]:
    """Write stiffness and damping over speed as a table for rotor dynamics; return its rows.

    Parameters
    ----------
    file : Path
        To write, ``.csv``; see `loadflow.journal.coefficient_table`.
    force : sequence of float
        N.
    speeds : tuple
        First and last (rad/s), and how many.
    whirl : float
        Frequency of the vibration over the speed, at which tilting pads follow the shaft.

    Raises
    ------
    loadflow.errors.InputError
        As `loadflow.journal.rotor_coefficients`; the folder of the file is not there.
    loadflow.errors.SolverError
        No equilibrium at one of the speeds.
    """
    from loadflow.journal import rotor_coefficients

    return written_coefficients(
        file, lambda: rotor_coefficients(bearing, force, np.linspace(*speeds), film, whirl=whirl)
    )


def written_coefficients(file: Path, made: Callable[[], xr.Dataset]) -> list[dict[str, float]]:
    """Write what is `made` as a table for rotor dynamics, and return its rows.

    Raises
    ------
    loadflow.errors.InputError
        The folder of the file is not there.
    """
    from loadflow.journal import coefficient_table
    from loadflow.storage import write_text

    if not file.parent.is_dir():
        raise InputError(f"{file}: its folder is not there")
    text = coefficient_table(made())
    write_text(file, text)
    return [
        {name: float(value) for name, value in row.items()}
        for row in csv.DictReader(text.splitlines())
    ]


def _model(film: Film) -> str:
    """The film in words."""
    rung = RUNGS[film.rung]
    words = [f'rung "{film.rung}"']
    if rung.law is None:
        words.append(f"{film.cells[0]} × {film.cells[1]} cells" if film.grid else "default grid")
        law = ", ".join(f"{name} {value:g}" for name, value in asdict(film.law).items())
        words.append(f"{film.law.kind} ({law})" if law else film.law.kind)
    words.append(f"edge pressure {film.edge_pressure:g} Pa")
    if film.supply is not None:
        words.append(f"{len(film.supply.grooves)} grooves")
    if film.shell is not None:
        words.append(f"{film.shell.kind} shell")
    if film.heat is not None:
        oil, inlet = film.heat.oil, film.heat.inlet_temperature - CELSIUS
        words.append(f"{oil} enters at {inlet:g} °C, heat balance")
    return "; ".join(words)
