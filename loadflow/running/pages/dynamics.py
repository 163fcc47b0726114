"""Stiffness and damping of the bearings, and the shaft line on them, on a report page."""

from __future__ import annotations

import numpy as np
import xarray as xr

from loadflow.report import Section, Table
from loadflow.stages.frames import FILM_AXES


def dynamics_section(data: xr.Dataset) -> Section:
    """Tabulate stiffness and damping of the bearings, and the modes of each shaft line."""
    cases = [str(name) for name in data["case"].values]
    axes = [(dof, *axis) for dof, axis in zip(data["dof"].values, FILM_AXES)]
    names = [(a, b, one * other) for a, _, one in axes for b, _, other in axes]
    rows = [
        [f"{case} {bearing}"]
        + [
            f"{sign * data[part].sel(bearing=bearing, dof=a, along=b).values[k] / 1e9 + 0.0:.4g}"
            for part in ("stiffness", "damping")
            for a, b, sign in names
        ]
        for k, case in enumerate(cases)
        for bearing in data["bearing"].values
    ]
    entry = [f"{a}{b}" for _, a, _ in axes for _, b, _ in axes]
    heads = [f"K {e}, GN/m" for e in entry] + [f"C {e}, GN s/m" for e in entry]
    tables = [Table("Bearings at mean load and speed", ["load case", *heads], rows)]
    text = (
        "Axes of the shaft: z up, y to the left looking downwind. K and C belong to a vibration at "
        f"{_of_speed(float(np.max(data['whirl'])))}. Over speed: the tables in the folder "
        "coefficients, as ROSS reads them, with x down and y left."
    )
    if "natural_frequency" in data:
        tables.append(_modes(data, cases))
        text += (
            f" Modes have K and C of {_vibration(data)}. Marked: a shaft line whose whirl grows."
        )
    return Section("Rotor dynamics", text, tables=tables)


def _of_speed(whirl: float) -> str:
    return "the speed of the shaft" if whirl == 1.0 else f"{whirl:g} of the speed of the shaft"


def _vibration(data: xr.Dataset) -> str:
    """Of which vibration K and C of the modes are."""
    taken, swing = data["vibration_frequency"], data["natural_frequency"]
    if bool(((taken == swing) | np.isnan(swing)).all()):
        return "their own frequencies"
    return f"a vibration at {_of_speed(float(np.max(data['whirl'])))}"


def _modes(data: xr.Dataset, cases: list[str]) -> Table:
    rows: list[list[str]] = []
    bad: set[int] = set()
    for k, case in enumerate(cases):
        for suspension in data["suspension"].values:
            one = data.sel(suspension=suspension).isel(case=k)
            bad |= {len(rows)} if float(one["largest_growth"]) > 0 else set()
            both = zip(one["natural_frequency"].values, one["damping_ratio"].values)
            cells = [
                f"{omega / (2 * np.pi):.3g} ({ratio:.2g})" if np.isfinite(omega) else "-"
                for omega, ratio in both
            ]
            rows.append([f"{case} {suspension}", *cells])
    heads = ["load case", *(f"mode {m}, Hz (damping ratio)" for m in data["mode"].values)]
    return Table("Shaft line on its bearings", heads, rows, frozenset(bad))
