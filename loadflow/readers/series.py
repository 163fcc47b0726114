"""From the channels of a file to the variables of the cube."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from loadflow.cube import VARIABLES, Variable, make_series, regular_time
from loadflow.readers.aliases import COMPONENTS, GAUGE, POWER, Aliases, Channels, Frame
from loadflow.readers.choice import choose
from loadflow.readers.doubts import power_doubts
from loadflow.readers.frames import at_apex, turned
from loadflow.readers.table import Table

if TYPE_CHECKING:
    import xarray as xr


def to_series(
    table: Table,
    known: Aliases,
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    """Turn the channels of a file into the variables of the cube.

    Parameters
    ----------
    table : Table
        The file.
    known : Aliases
        Channels of the program.
    channels : Channels, optional
        Channels to use instead, by component.
    gauge_distance : float, optional
        Distance of the gauge of ``gauge_moment_y`` and ``_z`` downwind of the rotor apex, m; used
        where the moments at the apex are absent.
    frame : {"auto", "fixed", "rotating"}
        Frame of the y and z channels, see `Frame`.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0 in single precision, with scalar coordinates ``file``,
        ``file_start`` and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        Missing channels (all in one message), wrong unit, value that is not finite, irregular
        time.
    """
    chosen = choose(table, known, channels or {}, gauge_distance, frame)
    step, stamps = regular_time(table.stamps, table.source)
    units = {**{c: _variable(c).units for c in COMPONENTS}, POWER: "W"}
    units |= dict.fromkeys(GAUGE.values(), "N m")
    odd = [key for key in chosen.spare if not table.has_unit(chosen.names[key], units[key])]
    wanted = {key: name for key, name in chosen.names.items() if key not in odd}
    found = {key: table.series(name, units[key]) for key, name in wanted.items()}
    if chosen.rotating:
        found |= turned(found, found["azimuth"])
    if gauge_distance is not None:
        found |= at_apex(found, gauge_distance)
    data = {}
    for name, variable in VARIABLES.items():
        series = [found[c] for c in COMPONENTS if c in found and name in (c, c[:-2])]
        if series:
            stacked = np.stack(series) if "axis" in variable.dims else series[0]
            data[name] = stacked.astype(np.float32)
    left = [f"channel {chosen.names[key]!r} is left out: its unit is unknown" for key in odd]
    doubts = [*table.doubts, *left, *power_doubts(found)]
    coords = {
        "file": table.source,
        "file_start": ((), float(stamps[0]), {"units": "s"}),
        "doubts": "\n".join(doubts),
    }
    return make_series(step * np.arange(stamps.size), data).assign_coords(coords)


def _variable(component: str) -> Variable:
    return VARIABLES[component if component in VARIABLES else component[:-2]]
