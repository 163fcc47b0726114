"""One load or one reduced series on one journal bearing → its film, with units and meaning."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from loadflow.errors import InputError, SolverError
from loadflow.journal.rungs import RUNGS
from loadflow.quantities import CELSIUS, GRID_ERROR, table
from loadflow.stages.labelling import quantities

if TYPE_CHECKING:
    from loadflow.journal import Film, JournalBearing

Load = Sequence[float]


def journal_point(force: Load, speed: float, bearing: JournalBearing, film: Film) -> xr.Dataset:
    """Return the static equilibrium of a journal bearing under one `force` (N) and `speed` (rad/s).

    Raises
    ------
    loadflow.errors.InputError
        As `JournalBearing.equilibrium`.
    loadflow.errors.SolverError
        No equilibrium.
    """
    from loadflow.stages.films.kept import KEPT, WARM

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
    from loadflow.stages.films.kept import KEPT, WARM
    from loadflow.stages.films.summary import extremes
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
