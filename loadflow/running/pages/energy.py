"""What bearings lose of the power of the rotor, on a report page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from loadflow.quantities import four_digits
from loadflow.report import Table

ROOMS = ("journal", "thrust", "rolling")
HEADS = (
    "bearing", "load case", "wind, m/s", "rotor, kW", "loss, kW", "left, %", "flow, l/min",
    "rise of the oil, K",
)  # fmt: skip


def energy_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Energy balance of each bearing over the wind speed, means of the cases of each."""
    if "energy" not in tables:
        return
    data = tables["energy"]
    speeds = data["wind_speed"].values
    kinds = sorted({*zip(data["dlc"].values.tolist(), speeds.tolist())})
    rows = []
    for room in ROOMS:
        for name in data[room].values.tolist() if room in data.dims else ():
            for dlc, wind in kinds:
                some = np.flatnonzero((data["dlc"].values == dlc) & (speeds == wind))
                here = data.isel(case=some).sel({room: name}).mean("case")
                rows.append([f"{room} {name}", dlc, f"{wind:g}", *_cells(here, room)])
    yield Table("Energy balance", list(HEADS), rows)


def _cells(here: xr.Dataset, room: str) -> list[str]:
    power, loss = float(here["rotor_power"]), float(here[f"{room}_loss"])
    left = 100 * (1 - loss / power) if power > 0 else np.nan
    flow, rise = (here.get(f"{room}_{what}", np.nan) for what in ("flow", "oil_rise"))
    values: list[Any] = [four_digits(power / 1e3), four_digits(loss / 1e3), f"{left:.5g}"]
    return ["-" if "nan" in text else text for text in values] + [
        four_digits(factor * float(value)) if np.isfinite(float(value)) else "-"
        for factor, value in ((6e4, flow), (1.0, rise))
    ]
