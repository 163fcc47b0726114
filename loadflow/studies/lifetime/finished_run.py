"""Results of a run, case by case → what they make together over a lifetime and a year."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from loadflow.scene.lifetime_shares import seconds_per_year, shares_in
from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label
from loadflow.stages.rolling import hours_together, system_hours

Tables = Mapping[str, xr.Dataset]

NO_SHARE = "no load case has a share of the lifetime"
"""Why a run, as one on extreme load cases alone, tells nothing of a life or a year."""


def run_lifetime(scene: Scene, tables: Tables) -> xr.Dataset | None:
    """Life of the rolling bearings and energy per year of all bearings, over all load cases.

    Each load case counts with its share of the lifetime (`lifetime_shares`, or the shares that its
    files give); events to which ``lifetime.per_year`` gives no number have none. None where no load
    case has a share.

    Parameters
    ----------
    scene : Scene
        What was run.
    tables : mapping
        Results by stage: journal, thrust, rolling, friction.

    Returns
    -------
    xarray.Dataset or None
        `share` (case); of rolling bearings `life_hours` and `modified_life_hours` (rolling) with
        `system_life_hours` and `system_modified_life_hours`, h; of journal, thrust and rolling
        bearings `journal_energy` (journal), `thrust_energy` (thrust) and `rolling_energy`
        (rolling), and `rotor_energy`, J a year, while the wind is between cut-in and cut-out.
    """
    found: dict[str, xr.DataArray] = {}
    for name, work in (
        ("rolling", _lives),
        ("journal", _film_energy),
        ("thrust", _pad_energy),
        ("friction", _energy),
    ):
        if name in tables:
            share = case_shares(scene, tables[name])
            if share is None:
                return None
            found |= work(scene, tables[name], share)
    if found and "rotor_power" in tables.get("loads", ()):
        found |= _rotor_energy(scene, tables["loads"], found["share"])
    return xr.Dataset(found) if found else None


def _rotor_energy(scene: Scene, table: xr.Dataset, share: xr.DataArray) -> dict[str, xr.DataArray]:
    power = table["rotor_power"].sel(case=share["case"].values)
    energy = energy_per_year(scene, table.sel(case=share["case"].values), power, share.values)
    about = label("J", "energy that the rotor gives to the shaft, a year")
    return {"rotor_energy": xr.DataArray(float(energy), attrs=about)}


def case_shares(scene: Scene, table: xr.Dataset) -> np.ndarray | None:
    """Share of the lifetime of each case, of 1 in all; None where none has one."""
    given = (table[name].values.tolist() for name in ("dlc", "wind_speed", "length", "weight"))
    return shares_in(scene, *given)


def known_shares(tables: Tables, table: xr.Dataset) -> np.ndarray | None:
    """Share of the lifetime of the cases of a table, of 1 in all, as the run found it.

    Parameters
    ----------
    tables : mapping
        Results by stage, ``lifetime`` among them.
    table : xarray.Dataset
        One of them, over ``case``.

    Returns
    -------
    ndarray or None
        None where the run could not tell.
    """
    lifetime = tables.get("lifetime")
    if lifetime is not None and "share" in lifetime:
        share = lifetime["share"].reindex(case=table["case"].values).fillna(0.0).values
        if share.sum() > 0:
            return np.asarray(share / share.sum())
    return None


def _lives(scene: Scene, table: xr.Dataset, share: np.ndarray) -> dict[str, xr.DataArray]:
    found: dict[str, xr.DataArray] = {"share": _share_of(table, share)}
    names = table["bearing"].values
    for kind, meaning in (("", "rating life L10h"), ("modified_", "modified rating life L10mh")):
        hours = hours_together(table, f"bearing_{kind}life", share)
        about = label("h", f"{meaning} over all load cases")
        found[f"{kind}life_hours"] = xr.DataArray(hours, {"rolling": names}, "rolling", attrs=about)
        system = float(system_hours(hours, table.attrs["weibull_slope"]))
        about = label("h", f"{meaning} of all rolling bearings as a system")
        found[f"system_{kind}life_hours"] = xr.DataArray(system, attrs=about)
    return found


def _share_of(table: xr.Dataset, share: np.ndarray) -> xr.DataArray:
    about = label("1", "share of the lifetime")
    return xr.DataArray(share, {"case": table["case"].values}, "case", attrs=about)


def _film_energy(scene: Scene, table: xr.Dataset, share: np.ndarray) -> dict[str, xr.DataArray]:
    power = table["lost_power"] + table["mean_supply_power"]
    energy = energy_per_year(scene, table, power.fillna(0.0), share)
    about = label("J", "friction and supply of the journal bearing, a year")
    bearings = {"journal": table["bearing"].values}
    return {
        "share": _share_of(table, share),
        "journal_energy": xr.DataArray(energy, bearings, "journal", attrs=about),
    }


def _pad_energy(scene: Scene, table: xr.Dataset, share: np.ndarray) -> dict[str, xr.DataArray]:
    energy = energy_per_year(scene, table, table["lost_power"].fillna(0.0), share)
    about = label("J", "friction of the thrust bearing or pair of cones, a year")
    bearings = {"thrust": table["bearing"].values}
    return {
        "share": _share_of(table, share),
        "thrust_energy": xr.DataArray(energy, bearings, "thrust", attrs=about),
    }


def _energy(scene: Scene, table: xr.Dataset, share: np.ndarray) -> dict[str, xr.DataArray]:
    energy = energy_per_year(scene, table, table["lost_power"], share)
    about = label("J", "friction of the rolling bearing, a year")
    bearings = {"rolling": table["bearing"].values}
    return {
        "share": _share_of(table, share),
        "rolling_energy": xr.DataArray(energy, bearings, "rolling", attrs=about),
    }


def energy_per_year(
    scene: Scene, table: xr.Dataset, power: xr.DataArray, share: np.ndarray
) -> np.ndarray:
    """Energy (bearing,) a year, J; outside the operating winds only that of idling and of events.

    Parameters
    ----------
    scene : Scene
        Loads.
    table : xarray.Dataset
        Any result over ``case``, with `dlc`.
    power : xarray.DataArray
        Mean power of each case, W.
    share : ndarray, shape (case,)
        Share of the lifetime of each case.
    """
    seconds = seconds_per_year(scene, table["dlc"].values.tolist())
    return np.asarray((power * xr.DataArray(share * seconds, dims="case")).sum("case").values)
