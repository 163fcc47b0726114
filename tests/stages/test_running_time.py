"""A rotor that stands or idles does not count in the mean film and friction of a case."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case

from loadflow.scene.scene import make_scene
from loadflow.stages import friction, journal, reduction, shaft
from loadflow.stages.running_time import counted, time_shares
from loadflow.turbines import load_turbine

IDLING = -0.05 * np.pi / 30  # rad/s
STEPS, RUNNING = 400, 220


class One:
    dlc, wind_speed, seed, weight, name = "4.1", 8.0, 1, 1.0, "dlc4.1_v8_s1"
    duration = STEPS * 0.25


def shut_down(share=RUNNING / STEPS, idling=IDLING):
    """A case that runs for a share of its time, and then idles."""
    hub = case(8.0, 1, steps=STEPS)
    speed = hub["speed"].where(np.arange(STEPS) < share * STEPS, idling)
    return hub.assign(speed=speed.assign_attrs(hub["speed"].attrs))


def solved(stage, hub, **keys):
    scene = make_scene({"name": "stop", **keys})
    inputs = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    inputs["reduction"] = reduction.reduced_loads(scene, One(), inputs)
    return stage(scene, One(), inputs)


def test_the_limit_is_a_tenth_of_the_rated_speed_of_the_turbine():
    assert load_turbine("nrel-5mw").rated_speed == pytest.approx(12.1 * np.pi / 30, rel=1e-3)
    samples = xr.Dataset({"running": ("sample", [True, False]), "x": ("sample", [1.0, 2.0])})
    assert counted(samples).values.tolist() == [True, False]
    never = samples.assign(running=("sample", [False, False]))
    assert counted(never).values.tolist() == [True, True]
    assert counted(samples[["x"]]) is True


def test_means_of_a_film_are_those_of_the_time_that_runs():
    hub = shut_down(idling=-1.1 * np.pi / 30)  # fast enough for a film
    tree = solved(journal.film, hub, journal={"grid": [24, 8], "bearings": ["N"]})
    samples = tree["N"].to_dataset()
    table = journal.summary({One(): tree}).isel(bearing=0, case=0)
    runs = samples["speed"].values > 0.1
    assert samples["running"].values.tolist() == runs.tolist()
    weight = samples["weight"].values
    for name, of in (
        ("mean_friction_power", "friction_power"),
        ("mean_eccentricity_ratio", "eccentricity_ratio"),
    ):
        own = samples[of].values
        known = runs & np.isfinite(own)
        expected = np.average(own[known], weights=weight[known])
        assert table[name].item() == pytest.approx(expected, rel=1e-9)
    power = samples["friction_power"].values
    known = np.isfinite(power)
    assert (known & ~runs).any()  # a film, though the rotor idles
    lost = np.average(power[known], weights=weight[known])
    assert table["lost_power"].item() == pytest.approx(lost, rel=1e-9)
    assert lost < 0.9 * table["mean_friction_power"].item()
    assert table["running_share"].item() == pytest.approx(RUNNING / STEPS, abs=0.02)


def test_means_of_rolling_friction_are_those_of_the_time_that_runs():
    part = solved(friction.losses, shut_down(), results=["rolling.friction"])
    runs = part["speed"].values > 0.1
    table = friction.summary({One(): part}).isel(bearing=0, case=0)
    power = part["friction_power"].values[0]
    assert table["mean_friction_power"].item() == pytest.approx(power[runs].mean(), rel=1e-9)
    assert table["lost_power"].item() == pytest.approx(power.mean(), rel=1e-9)
    assert table["running_share"].item() == pytest.approx(runs.mean())
    assert power.mean() < 0.8 * power[runs].mean()


def test_a_case_that_never_runs_has_the_means_of_its_standing():
    part = solved(friction.losses, shut_down(0.0), results=["rolling.friction"])
    table = friction.summary({One(): part}).isel(bearing=0, case=0)
    assert table["running_share"].item() == 0.0
    lost = table["lost_power"].item()
    assert table["mean_friction_power"].item() == pytest.approx(lost, rel=1e-12)


def test_a_shaft_at_rest_loses_no_power_though_it_has_no_film():
    hub = shut_down(idling=0.0)
    tree = solved(journal.film, hub, journal={"grid": [24, 8], "bearings": ["N"]})
    samples = tree["N"].to_dataset()
    rests = samples["speed"].values == 0
    assert np.isnan(samples["friction_power"].values[rests]).all()
    table = journal.summary({One(): tree}).isel(bearing=0, case=0)
    share = 1 - np.average(rests, weights=samples["weight"].values)
    assert 0.4 < share < 0.7
    expected = share * table["mean_friction_power"].item()
    assert table["lost_power"].item() == pytest.approx(expected, rel=1e-9)


def test_power_that_nobody_knows_is_not_taken_as_none():
    samples = xr.Dataset({
        "running": ("sample", [True, True, False, False]),
        "speed": ("sample", [1.0, 1.0, 0.01, 0.0]),
    })  # fmt: skip
    power = xr.DataArray([8.0, 4.0, np.nan, np.nan], dims="sample")
    lost, _, _ = time_shares(samples, power)["lost_power"]
    assert lost.item() == pytest.approx(4.0)
    swings = samples.assign(running=("sample", [True] * 4))  # a bearing that does not stand
    lost, _, _ = time_shares(swings, power)["lost_power"]
    assert lost.item() == pytest.approx(6.0)
