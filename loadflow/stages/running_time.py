"""Which samples of a case count in its means: those in which the rotor runs."""

from __future__ import annotations

from typing import Any

import xarray as xr

from loadflow.cube import standing
from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label


def with_running(scene: Scene, samples: xr.Dataset) -> xr.Dataset:
    """Add ``running``: whether the rotor neither stands nor idles, by its rated speed.

    Parameters
    ----------
    scene : Scene
        With the turbine.
    samples : xarray.Dataset
        ``speed``, rad/s, over ``sample``.
    """
    runs = running(scene, samples)
    return samples.assign(running=runs.assign_attrs(label("1", "whether the rotor runs")))


def running(scene: Scene, samples: xr.Dataset) -> xr.DataArray:
    """Whether the rotor neither stands nor idles in `samples` of its speed, rad/s."""
    from loadflow.turbines import load_turbine

    return ~standing(samples, load_turbine(scene.turbine.name).rated_speed)


def counted(samples: xr.Dataset) -> xr.DataArray | bool:
    """Whether samples count in means: those that run; all where none does, or nobody knows.

    A shut-down that idles for half of its time has the mean film and friction of the half in which
    it ran; a case that stands throughout has those of its standing.
    """
    if "running" not in samples:
        return True
    running = samples["running"].astype(bool)
    return running | ~running.any("sample")


def in_contact(samples: xr.Dataset) -> xr.DataArray:
    """Whether shaft and shell touch, by sample; nowhere in films that do not tell."""
    if "in_contact" in samples:
        return samples["in_contact"] > 0
    return xr.zeros_like(samples["converged"], dtype=bool)


def time_shares(samples: xr.Dataset, power: xr.DataArray) -> dict[str, tuple[Any, str, str]]:
    """Share of the time that runs, and the mean power with the time of standing in it, W.

    A shaft at rest has no film and loses no power. Films that touch while it turns have a power
    that nobody knows: their time counts as the rest of the case.

    Parameters
    ----------
    samples : xarray.Dataset
        With ``running`` and ``speed``, and ``weight`` where samples stand for several steps.
    power : xarray.DataArray
        Friction power over ``sample``, W.
    """
    weight = samples.get("weight", xr.ones_like(samples["sample"], dtype=float))
    running = samples.get("running", xr.ones_like(weight)).astype(float).broadcast_like(power)
    if "speed" in samples:
        power = power.where(power.notnull() | (samples["speed"] != 0) | (running > 0), 0.0)
    return {
        "running_share": (running.weighted(weight).mean("sample"), "1", "share of time running"),
        "lost_power": (
            power.weighted(weight).mean("sample"), "W", "mean friction power, standing included",
        ),
    }  # fmt: skip
