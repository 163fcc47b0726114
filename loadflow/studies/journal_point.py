"""One point, or one reduced series → the numbers of a room, labelled with unit and meaning."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal import Heat

if TYPE_CHECKING:
    from loadflow.journal import GasMixture, JournalBearing, Lubricant, Supply

Load = Sequence[float]
Grid = tuple[int, int] | None


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


def journal_point(
    force: Load,
    speed: float,
    bearing: JournalBearing,
    oil: Lubricant | Heat,
    film: dict[str, Any],
) -> xr.Dataset:
    """Return the static equilibrium of a journal bearing under one `force` (N) and `speed` (rad/s).

    Raises
    ------
    loadflow.errors.InputError
        As `JournalBearing.equilibrium`.
    loadflow.errors.SolverError
        No equilibrium.
    """
    from loadflow.stages.journal import KEPT, WARM, rest

    s = rest(bearing, np.array(force), speed, oil, **film)
    kept = KEPT | WARM if isinstance(oil, Heat) else KEPT
    rows = {name: (getattr(s, name), units, meaning) for name, (units, meaning) in kept.items()}
    more = {
        "eccentricity": (s.eccentricity, "m", "shaft centre: first axis, second axis"),
        "stiffness": (s.stiffness, "N/m", "−∂F/∂e: 11, 12, 21, 22"),
        "damping": (s.damping, "N s/m", "−∂F/∂ė: 11, 12, 21, 22"),
        "reynolds_number": (s.reynolds_number, "1", "Reynolds number of the gap"),
        "critical_reynolds_number": (
            s.critical_reynolds_number,
            "1",
            "Re at which the flow turns turbulent",
        ),
        "laminar": (s.laminar, "1", "whether the flow is laminar"),
    }
    if film["supply"]:
        more["groove_flow"] = (s.groove_flow, "m3/s", "flow of each groove into the film")
    solver = ("converged", "residual", "iterations")
    last = {name: rows.pop(name) for name in solver}
    return quantities(rows | more | last, model=_model(oil, **film))


def journal_series(
    path: Path,
    bearing: JournalBearing,
    oil: Lubricant | Heat,
    film: dict[str, Any],
) -> xr.Dataset:
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
    from loadflow.stages.journal import KEPT, WARM, extremes, rest
    from loadflow.stages.labelling import of_samples

    reduced = read_parameter_file(path)
    answer = rest(bearing, reduced.force, reduced.speed, oil, strict=False, **film)
    if not np.any(answer.converged):
        raise SolverError(f"{path}: no film carries any of the {reduced.weight.size} samples")
    kept = KEPT | WARM if isinstance(oil, Heat) else KEPT
    samples = xr.Dataset({**of_samples(vars(answer), kept), "weight": ("sample", reduced.weight)})
    return extremes(samples).assign_attrs(
        series=f"{path}: {reduced.source}, {reduced.weight.size} of {reduced.total} samples",
        model=_model(oil, **film),
    )


def _model(
    oil: Lubricant | Heat,
    *,
    cavitation: GasMixture | None,
    edge_pressure: float,
    grid: Grid,
    supply: Supply | None,
) -> str:
    law = "Reynolds' condition"
    if cavitation is not None:
        law = f"gas mixture, constant {cavitation.mixing_constant:g} Pa"
    cells = f"{grid[0]} × {grid[1]} cells" if grid else "default grid of the law"
    grooves = f"; {len(supply.grooves)} grooves" if supply else ""
    heat = ""
    if isinstance(oil, Heat):
        heat = f"; {oil.oil} enters at {oil.inlet_temperature - 273.15:g} °C, heat balance"
    return f"finite volumes, {cells}; {law}; edge pressure {edge_pressure:g} Pa{grooves}{heat}"
