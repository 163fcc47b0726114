"""Verdicts on rolling bearings: static rating, lives, cut-off contacts, bolts, thrust."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from loadflow.quantities import CELSIUS, load_cases
from loadflow.rolling.rating.static import (
    HOURS_20_YEARS,
    LIFE_SOURCE,
    STATIC_RATING,
    STATIC_SOURCE,
)
from loadflow.scene.lifetime_shares import PRODUCTION
from loadflow.scene.limits import RollingLimits
from loadflow.scene.scene import Scene
from loadflow.studies.lifetime.finished_run import NO_SHARE
from loadflow.studies.verdicts.parts import STATED, answered, worst_of
from loadflow.studies.verdicts.uncarried import SLIGHT
from loadflow.verdict import Verdict
from loadflow.wind.cases import row_of


def of_rolling(scene: Scene, table: xr.Dataset, lifetime: xr.Dataset | None) -> Iterator[Verdict]:
    """Verdicts on the rolling bearings of a run, each by itself and all as a system."""
    for name, bearing in scene.rolling.geometries.items():
        part, subject = table.sel(bearing=name), f"rolling {name}"
        yield _static(scene.rolling.bearings[name].limits, subject, part)
        yield from _lives(scene, subject, lifetime, name, part)
        value, case, _ = worst_of(part, "bearing_truncated", "most")
        if case:
            yield Verdict(
                subject, "time with a contact cut off at a shoulder", value, 0.0, "at most",
                source="the Hertzian contact must lie within the raceway",
                case=case if value else "",
                note="share of the time of the load case",
            )  # fmt: skip
        value, case, _ = worst_of(part, "bearing_clamping", "least")
        if case:
            yield Verdict(
                subject, "share of the preload that clamps the bolts of its rings", value, 0.0,
                "at least", source="VDI 2230: joints must not open", case=case,
            )  # fmt: skip
        value, case, _ = worst_of(part, "bearing_axial_force", "most")
        if value > SLIGHT * float(part["bearing_force"].max()):
            carried = bearing.takes_thrust
            axis = "the shaft" if scene.rolling.bearings[name].oscillation is None else "its axis"
            force = f"{value / 1e3:.0f} kN along {axis}"
            yield Verdict(
                subject, f"force along {axis} without a bearing", 0.0 if carried else value, 0.0,
                "at most", "N", "equilibrium of the shaft", case,
                note=f"{force} is carried by {name}, a {bearing.words}" if carried
                else f"{force} is carried by no bearing of this arrangement",
            )  # fmt: skip
    if table.sizes["bearing"] > 1:
        yield from _lives(scene, "rolling, all as a system", lifetime, None, table)
    if "not_converged" in table:
        yield answered(f"rolling {table['bearing'].values[0]}", table)


def _static(limits: RollingLimits, subject: str, table: xr.Dataset) -> Verdict:
    """Static rating over the design load: loads with the factor of their load case in them."""
    rows = map(row_of, table["dlc"].values.tolist())
    ultimate = np.array([row is None or row.kind == "U" for row in rows])
    judged = table.isel(case=ultimate) if ultimate.any() else table
    value, case, time = worst_of(judged, "bearing_design_safety", "least")
    row = judged.sel(case=case) if case else judged.isel(case=0)
    dlc, factor = str(row["dlc"].item()), float(row["bearing_load_factor"])
    note = f"γ_f {factor:g}; {float(row['bearing_static_safety']):.4g} under characteristic loads"
    of_table = row_of(dlc)
    if of_table is not None and of_table.safety == "extrapolated":
        note += "; the normal factor, as 1.1 is not extrapolated (1.25 if it were)"
    if not ultimate.any():
        note += "; no load case of ultimate loads in this run"
    elif of_table is None:
        note += f"; IEC 61400-1 has no load case {dlc!r}"
    limit = limits.static_safety
    return Verdict(
        subject, "static rating over the design load", value, limit, "at least",
        source=STATIC_SOURCE if limit == STATIC_RATING else STATED, case=case, time=time,
        note=note, key="rolling.limits.static_safety",
    )  # fmt: skip


def _lives(
    scene: Scene, subject: str, lifetime: xr.Dataset | None, name: str | None, table: xr.Dataset
) -> Iterator[Verdict]:
    """Basic and modified life over all load cases, of one bearing or (`name` None) of all.

    None of extreme load cases alone: they have no share of the lifetime, and ask for no life.
    """
    rows = [row_of(dlc) for dlc in table["dlc"].values.tolist()]
    extreme = [row is not None and row.kind == "U" and row.dlc not in PRODUCTION for row in rows]
    if lifetime is None and all(extreme):
        return
    rolling = scene.rolling
    limit = rolling.system_life if name is None else rolling.bearings[name].limits.life
    asked = [rolling.bearings[name]] if name else [*rolling.bearings.values()]
    swings = any(one.oscillation is not None for one in asked)
    source = LIFE_SOURCE if limit == HOURS_20_YEARS else STATED
    for kind, what in (("", "rating life L10h"), ("modified_", "modified rating life L10mh")):
        if kind and swings:  # ISO 281 has no modified life of a bearing that swings
            continue
        note, value = NO_SHARE, np.nan
        if lifetime is not None:
            note = f"over {load_cases(table.sizes['case'])} by their share of the lifetime"
            if name is None:
                value = float(lifetime[f"system_{kind}life_hours"])
            else:
                value = float(lifetime[f"{kind}life_hours"].sel(rolling=name))
        if kind:
            friction = scene.friction
            note += f"; {friction.lubricant}, {_oil(table)}, {friction.cleanliness}"
            if (thin := float(table["bearing_thin_share"].max())) > 0:
                note += f"; κ < 0.1 in up to {100 * thin:.3g} % of the revolutions, a_ISO 0.1 there"
        yield Verdict(
            subject, what, value, limit, "at least", "h", source, note=note,
            key="rolling.limits.life",
        )  # fmt: skip


def _oil(table: xr.Dataset) -> str:
    """Temperatures of rolling bearings over the load cases."""
    warm = table["bearing_temperature"].values - CELSIUS
    low, high = f"{warm.min():.0f}", f"{warm.max():.0f}"
    return f"{low} °C" if low == high else f"{low} … {high} °C by their heat balance"
