"""Results of a run → what its bearings lose of the power of the rotor, case by case."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label

ROOMS = {"journal": "journal", "thrust": "thrust", "friction": "rolling"}
"""Result with the losses of bearings, and what its dimension is called."""


def run_energy(scene: Scene, tables: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Energy balance of each load case, as Table 5-23 of [Jonuschies 2015] draws it up.

    None where no bearing has a loss, or the power of the rotor is not known.

    Parameters
    ----------
    scene : Scene
        What was run.
    tables : mapping
        Results by stage: loads, journal, thrust, friction.

    Returns
    -------
    xarray.Dataset or None
        `rotor_power` (case), W; of journal, thrust and rolling bearings, each over its name and
        case, `journal_loss` … (W; of journal bearings with the supply, as the table) and
        `journal_efficiency` … (what the bearing leaves of the rotor's power; NaN without power);
        of films `journal_flow` … (m³/s, out of them) and of journal bearings `journal_oil_rise`: by
        how much, K, this flow warms where it carries the whole loss.
    """
    rooms = {stage: name for stage, name in ROOMS.items() if stage in tables}
    if not rooms or "rotor_power" not in tables.get("loads", ()):
        return None
    power = tables["loads"]["rotor_power"]
    found = {"rotor_power": power}
    for stage, name in rooms.items():
        table = tables[stage]
        loss = table["lost_power"]
        if "mean_supply_power" in table:
            loss = loss + table["mean_supply_power"].fillna(0.0)
        left = (1.0 - loss / power).where(power > 0)
        found[f"{name}_loss"] = _of(loss, name, "W", "loss of the bearing")
        found[f"{name}_efficiency"] = _of(
            left, name, "1", "share of the rotor's power that is left"
        )
        if "mean_side_flow" in table:
            found[f"{name}_flow"] = _of(
                table["mean_side_flow"], name, "m^3/s", "flow out of the film"
            )
        if stage == "journal":
            flow = table["mean_side_flow"]
            warmed = [scene.journal.at(str(place)).volume_heat for place in table["bearing"].values]
            carried = flow * xr.DataArray(warmed, dims="bearing")
            rise = (loss / carried).where(carried > 0)
            told = "rise of the oil that carries the loss"
            found[f"{name}_oil_rise"] = _of(rise, name, "K", told)
    return xr.Dataset(found).drop_vars("bearing", errors="ignore")


def _of(values: xr.DataArray, name: str, units: str, meaning: str) -> xr.DataArray:
    cases = values.coords["case"].values
    kept = values.transpose("bearing", "case")
    names = kept["bearing"].values
    return xr.DataArray(
        np.asarray(kept.values), {name: names, "case": cases}, (name, "case"),
        attrs=label(units, meaning),
    )  # fmt: skip
