"""Wear of journal bearings over their life on a report page."""

from __future__ import annotations

import numpy as np
import xarray as xr

from loadflow.quantities import four_digits
from loadflow.report import Section, Table

_EACH = (
    ("minimum_film", "smallest film, µm", 1e6),
    ("contact_speed", "in contact up to, 1/min", 30 / np.pi),
    ("contact_time", "in contact, s", 1.0),
    ("contact_pressure", "asperity pressure, MPa", 1e-6),
    ("contact_energy", "friction of asperities, kJ", 1e-3),
    ("friction_energy", "friction, kJ", 1e-3),
)


def wear_section(bearings: dict[str, xr.Dataset]) -> Section:
    """Tabulate the worn bores, and each start and stop in the new bore and in the worn one."""
    worn, before_after = [], []
    for name, data in bearings.items():
        if not data.attrs["cycles"]:
            worn.append([name, "0", "0", "0", "-", "-"])
            continue
        depth, angle = data["depth_of_bore"].values, np.degrees(data["angle"].values)
        some = angle[depth.max(axis=1) > 0.01 * depth.max()]
        spread = np.sort((some + 180) % 360 - 180)
        worn.append(
            [
                name,
                f"{np.unique(data['case']).size}",
                four_digits(1e6 * depth.max()),
                four_digits(1e9 * data.attrs["volume"]),
                f"{spread[0]:.3g} … {spread[-1]:.3g}" if spread.size else "-",
                f"{1e6 * float(data['roughness'][-1]):.3g}",
            ]
        )
        for k, cycle in enumerate(data["cycle"].values):
            for words, which in (("new", 0), ("worn", -1)):
                cells = [
                    four_digits(unit * float(data[key].isel(renewal=which, cycle=k)))
                    for key, _, unit in _EACH
                ]
                count = four_digits(float(data["count"][k]))
                before_after.append([f"{cycle} {name}, {words}", count, *cells])
    heads = ["bearing", "load cases that touch", "depth, µm", "volume, mm³",
             "worn from … to, ° from straight down", "roughness left, µm"]  # fmt: skip
    tables = [Table("Worn bores after the life", heads, worn)]
    if before_after:
        heads = ["case", "times in the life", *(words for _, words, _ in _EACH)]
        tables.append(Table("Each of them in the new and in the worn bore", heads, before_after))
    text = (
        "The contour is carried from cycle to cycle, and the film solved anew in the worn bore. "
        "Coefficients of wear differ by 2 … 5 from batch to batch: shapes can be trusted more than "
        "depths."
    )
    return Section("Wear", text, tables=tables)
