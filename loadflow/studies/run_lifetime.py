"""Results of a run, case by case → what they make together over a lifetime and a year."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.quantities import HOURS_PER_YEAR
from loadflow.scene.cases import wind_class
from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label
from loadflow.stages.rolling import hours_together, system_hours
from loadflow.studies.lifetime_shares import IDLING, PRODUCTION, lifetime_shares, of_load_cases
from loadflow.wind import iec
from loadflow.wind.cases import by_load_case

Tables = Mapping[str, xr.Dataset]


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
    if scene.loads.weights == "given" and scene.loads.source == "files":
        given = table["weight"].values.astype(float)
        return given / given.sum() if given.sum() > 0 else None
    per_year = by_load_case(scene.lifetime.per_year, table["dlc"].values.tolist())
    lengths = table["length"].values if per_year else np.ones(table.sizes["case"])
    try:
        return lifetime_shares(
            table["dlc"].values.tolist(),
            table["wind_speed"].values.tolist(),
            lengths.tolist(),
            wind_class=wind_class(scene),
            operating=_operating(scene),
            per_year=per_year,
        )
    except InputError:
        if per_year:
            raise
        return None


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


def _operating(scene: Scene) -> tuple[float, float]:
    from loadflow.turbines import load_turbine

    machine = load_turbine(scene.turbine.name)
    return machine.cut_in, machine.cut_out


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
    seconds = np.full(table.sizes["case"], HOURS_PER_YEAR * 3600)
    dlcs = set(table["dlc"].values.tolist())
    by_wind = scene.loads.weights == "rayleigh" or scene.loads.source == "simulate"
    if by_wind and of_load_cases(dlcs, PRODUCTION) and not of_load_cases(dlcs, IDLING):
        below = iec.weibull_cdf(_operating(scene), iec.class_speeds(wind_class(scene)).v_ave, 2.0)
        produces = ~np.isin(table["dlc"].values, [*by_load_case(scene.lifetime.per_year, dlcs)])
        seconds[produces] *= float(below[1] - below[0])
    return np.asarray((power * xr.DataArray(share * seconds, dims="case")).sum("case").values)
