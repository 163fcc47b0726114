"""Scenes that ask for the film in motion: the whole series, step by step."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case, cube_file

import loadflow as lf
from loadflow.cube import make_cube, save_cube
from loadflow.errors import InputError
from loadflow.planning.accuracy import expected_errors
from loadflow.planning.choice import finer
from loadflow.planning.ladder import expected_seconds, ladder, measured
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene

FILM = {"grid": [24, 8], "bearings": ["N2"], "rung": "reduced"}


def scene_of(cube, **keys):
    loads = {"files": [str(cube)]}
    data = {"name": "small", "accuracy": "given", "loads": loads, "results": ["journal.film"]}
    return make_scene(data | keys)


def test_a_film_in_motion_reads_the_whole_series(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=200)
    scene = scene_of(cube, name="moving", journal=FILM | {"motion": "transient"})
    plan = make_plan(scene)
    assert [step.name for step in plan.steps] == ["loads", "shaft", "journal", "check"]
    result = lf.run(scene, out=tmp_path, report=False)
    (one,) = plan.cases
    with xr.open_datatree(result.path / "journal" / f"{one.name}.h5", engine="h5netcdf") as tree:
        samples = tree["N2"].to_dataset().load()
    assert samples.sizes["sample"] == one.steps
    assert samples.attrs["motion"] == "transient"
    assert (samples["residual"] < 1e-6).all()
    still = scene_of(cube, reduction={"size": 1.0}, journal=FILM)
    rest = lf.run(still, out=tmp_path, report=False).tree["journal"]
    # the shaft is elsewhere than at rest, but the film is the same
    power = result.tree["journal"]["mean_friction_power"]
    np.testing.assert_allclose(power, rest["mean_friction_power"], rtol=0.05)


def test_a_film_in_motion_passes_over_samples_between_its_steps(tmp_path):
    cube = save_cube(make_cube([case(8.0, 1, steps=800, dt=0.05)]), tmp_path / "loads.h5")
    motion = FILM | {"motion": "transient", "rung": "reduced"}
    found = {}
    for step in (None, 0.12, 0.01):
        keys = motion if step is None else motion | {"step": step}
        run = lf.run(scene_of(cube, name=f"step_{step}", journal=keys), out=tmp_path, report=False)
        with xr.open_datatree(next((run.path / "journal").glob("*.h5")), engine="h5netcdf") as tree:
            found[step] = tree["N2"].to_dataset().load()
    np.testing.assert_allclose(np.diff(found[0.12]["time"]), 0.1, rtol=1e-9)
    assert found[None].sizes["sample"] == 800
    assert found[0.01].sizes["sample"] == 800, "no step is shorter than that of the series"
    fine, coarse = (float(found[step]["minimum_film"].min()) for step in (None, 0.12))
    assert 0 < abs(coarse / fine - 1) < 0.01


def test_a_shaft_that_stands_is_in_contact_and_its_case_has_an_answer(tmp_path):
    standing = case(8.0, 1)
    standing["speed"][:] = 0.0
    file = save_cube(make_cube([standing, case(8.0, 2)]), tmp_path / "loads.h5")
    scene = scene_of(file, journal=FILM | {"motion": "transient"})
    result = lf.run(scene, out=tmp_path, report=False)
    assert result.failures == {}
    table = result.tree["journal"].to_dataset().sel(bearing="N2")
    assert table["in_contact"].values.tolist() == [standing.sizes["time"], 0]
    assert table["not_converged"].values.tolist() == [0, 0]
    assert np.isnan(table["largest_eccentricity_ratio"].values[0])


def test_a_film_in_motion_begins_where_the_surfaces_part(tmp_path):
    start = case(8.0, 1)
    start["speed"][:] = np.linspace(0.0, 1.2, start.sizes["time"])
    file = save_cube(make_cube([start]), tmp_path / "loads.h5")
    scene = scene_of(file, journal=FILM | {"motion": "transient"})
    table = lf.run(scene, out=tmp_path, report=False).tree["journal"].to_dataset().squeeze()
    assert table["in_contact"] > 0
    assert 0 < table["contact_time"] < table["mixed_friction_time"] < table["duration"]
    assert table["smallest_film"] >= scene.journal.contact_film


def test_a_film_in_motion_is_planned_by_its_own_rungs():
    loads = {"wind_speeds": [12.0], "seeds": 1}
    still, moving = (
        make_scene(
            {
                "name": "m",
                "accuracy": "given",
                "loads": loads,
                "journal": {"rung": "reduced", "motion": motion},
            }
        )
        for motion in ("quasi-static", "transient")
    )
    assert measured(moving, "journal") is ladder()["journal, transient"]["reduced, 60"]
    assert measured(still, "journal") is ladder()["journal"]["reduced, 60"]
    cases = make_plan(moving).cases
    rung = measured(moving, "journal")
    expected = 24_000 * 2 * rung["seconds_per_sample"]
    assert expected_seconds(moving, "journal", cases) == pytest.approx(expected)


def test_the_reduction_adds_no_error_to_a_film_in_motion():
    def error(size):
        film = {"rung": "reduced", "motion": "transient"}
        scene = {"name": "m", "journal": film, "results": ["journal.film"]}
        scene |= {"reduction": {"pick": "random", "size": size}, "loads": {"files": ["loads.h5"]}}
        return expected_errors(make_scene(scene))["journal.film"]["eccentricity ratio"]

    assert error(0.05) == error(0.2)
    stored = ladder()["journal, transient"]["reduced, 60"]["errors"]["eccentricity ratio"]["max"]
    assert error(0.1) == pytest.approx(stored)


def test_the_next_better_film_is_a_finer_grid():
    scene = make_scene({"name": "m", "journal": {"rung": "reduced"}})
    better = finer(scene, "journal").journal
    assert (better.rung, better.grid) == ("grid", (120, 40))


HEAT = {"oil": "mineral-vg-320", "inlet_temperature": 318.15}


def test_a_film_in_motion_has_one_temperature_that_of_its_mean_friction(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=200)
    scene = scene_of(cube, journal=FILM | {"motion": "transient", "heat": HEAT})
    result = lf.run(scene, out=tmp_path, report=False)
    film = result.tree["journal"]
    (one,) = make_plan(scene).cases
    with xr.open_datatree(result.path / "journal" / f"{one.name}.h5", engine="h5netcdf") as tree:
        samples = tree["N2"].to_dataset().load()
    assert np.ptp(samples["temperature"].values) == 0.0
    heat = scene.journal.heat
    power, flow = (float(samples[n].mean()) for n in ("friction_power", "side_flow"))
    warm = float(samples["temperature"][0])
    asked = float(heat.temperature(power, flow, warm))
    assert asked == pytest.approx(warm, abs=0.05 * (warm - heat.inlet_temperature))
    assert film["largest_temperature"].item() == pytest.approx(warm)
    check = result.tree["check"].to_dataset()
    assert set(check["stage"].values) == {"journal"}  # its heat is in the film already
    assert (check["difference"] < 0.2).all()


def test_a_film_at_rest_settles_at_a_temperature_for_each_load(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=200)
    scene = scene_of(cube, journal=FILM | {"heat": HEAT})
    result = lf.run(scene, out=tmp_path, report=False)
    (one,) = make_plan(scene).cases
    with xr.open_datatree(result.path / "journal" / f"{one.name}.h5", engine="h5netcdf") as tree:
        samples = tree["N2"].to_dataset().load()
    assert samples["converged"].all()
    temperature = samples["temperature"].values
    assert np.all(temperature > 318.15)
    assert np.ptp(temperature) > 0.01
    assert set(result.tree["check"]["stage"].values) == {
        "journal",
        "reduction",
        "motion of the film",
    }


def test_a_warm_film_has_no_other_lubricant(tmp_path):
    with pytest.raises(InputError, match="lubricant: follows from heat"):
        make_scene({"name": "x", "journal": {"heat": HEAT, "lubricant": {"viscosity": 0.06}}})


def test_the_plan_counts_the_films_of_a_heat_balance():
    loads = {"wind_speeds": [12.0], "seeds": 1}
    cold, warm = (
        make_scene(
            {
                "name": "m",
                "accuracy": "given",
                "loads": loads,
                "journal": {"rung": "reduced"} | heat,
            }
        )
        for heat in ({}, {"heat": HEAT})
    )
    cases = make_plan(cold).cases
    assert expected_seconds(warm, "journal", cases) > 4 * expected_seconds(cold, "journal", cases)
