"""What the verdicts on all kinds of bearing share: extremes, samples without answer, sources."""

from __future__ import annotations

from typing import Literal

import numpy as np
import xarray as xr

from loadflow.scene.limits import FilmLimits
from loadflow.verdict import Verdict

STATED = "as the scene states"
"""Where a limit is from that the scene has."""


def answered(subject: str, table: xr.Dataset) -> Verdict:
    """No sample may lack an answer, as it would be missing in the extremes."""
    count = table["not_converged"]
    worst = table["case"].values[int(np.argmax(count.values))]
    total = float(count.sum())
    return Verdict(
        subject,
        "samples not answered",
        total,
        0.0,
        "at most",
        "samples",
        "extremes need every sample",
        str(worst) if total else "",
        note=f"not answered: {total:.0f} samples; the extremes lack them" if total else "",
    )


def worst_of(
    table: xr.Dataset, name: str, which: Literal["most", "least"]
) -> tuple[float, str, float]:
    """Extreme over the cases, its case, and its time there; NaN where none has a value."""
    values = table[name].values.astype(float)
    if np.isnan(values).all():
        return np.nan, "", np.nan
    k = int(np.nanargmax(values) if which == "most" else np.nanargmin(values))
    times = {"bearing_design_safety": "bearing_design_time"}.get(name, f"{name}_time")
    time = float(table[times].values[k]) if times in table else np.nan
    return float(values[k]), str(table["case"].values[k]), time


def source_of(limits: FilmLimits, key: str, default: str) -> str:
    """Where a limit comes from: its default's source, or the scene."""
    return STATED if key in limits.changed else default
