"""Films under stationary and periodic design loads, from scene and command line."""

import json

import numpy as np
import pytest
from synthetic import case, cube_file
from typer.testing import CliRunner

from loadflow.cli import app
from loadflow.errors import InputError
from loadflow.reduction import periodic, stationary
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages import journal, reduction, rolling, shaft
from loadflow.stages.frames import to_film

HUB = case(8.0, 1, steps=400)


class One:
    dlc, wind_speed, seed, weight, name = "1.1", 8.0, 1, 1.0, "dlc1.1_v8_s1"
    duration = 600.0


def scene_of(**keys):
    film = {"grid": [24, 8], "bearings": ["N"]} | keys.pop("journal", {})
    return make_scene({"name": "designed", "journal": film} | keys)


def inputs_of(scene):
    found = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    return found | {"reduction": reduction.reduced_loads(scene, One(), found)}


def radial(inputs, bearing="N"):
    force = inputs["shaft"]["force"].sel(bearing=bearing).transpose("time", "axis").values
    return to_film(force.astype(float))


def test_stationary_loads_are_those_of_the_source_and_the_mean_has_all_the_time():
    scene = scene_of(reduction={"method": "stationary"})
    inputs = inputs_of(scene)
    samples = inputs["reduction"]["N"].to_dataset()
    loads = stationary(HUB["speed"].values, radial(inputs))
    np.testing.assert_allclose(to_film(samples["force"].values)[0], loads.mean.force, rtol=1e-5)
    np.testing.assert_allclose(to_film(samples["force"].values)[1], loads.maximum.force, rtol=1e-5)
    assert samples["speed"][1] == pytest.approx(loads.maximum.speed)
    assert samples["weight"].values.tolist() == [400.0] + [0.0] * 10
    film = journal.film(scene, One(), inputs)["N"].to_dataset()
    at = scene.journal.geometry.equilibrium(
        loads.mean.force, loads.mean.speed, scene.journal.film_model
    )
    assert film["eccentricity_ratio"][0] == pytest.approx(float(at.eccentricity_ratio), rel=1e-5)
    table = journal.summary({One(): journal.film(scene, One(), inputs)})
    assert float(table["mean_eccentricity_ratio"].sel(bearing="N")[0]) == pytest.approx(
        float(at.eccentricity_ratio), rel=1e-5
    )


def test_a_periodic_load_drives_the_film_round_the_orbit_that_closes():
    scene = scene_of(reduction={"method": "periodic", "bounds": [0.05, 0.3], "orders": [1.0]})
    inputs = inputs_of(scene)
    samples = inputs["reduction"]["N"].to_dataset()
    force, time = to_film(samples["force"].values), samples["time"].values
    np.testing.assert_allclose(force[0], force[-1], rtol=1e-9)
    load = periodic(
        HUB["speed"].values, radial(inputs), HUB["time"].values, bounds=(0.05, 0.3), orders=[1.0]
    ).closed(0.01)
    np.testing.assert_allclose(force, load(time), rtol=1e-5)
    assert float(samples["weight"].sum()) == pytest.approx(400.0)
    film = journal.film(scene, One(), inputs)["N"].to_dataset()
    path = scene.journal.geometry.orbit(
        time, force, float(samples["speed"][0]), scene.journal.film_model, periodic=True
    )
    np.testing.assert_allclose(film["eccentricity_ratio"], path["eccentricity_ratio"], rtol=1e-6)
    assert film.attrs["closure"] < 1e-6
    assert film["converged"].values.all()
    # a film that squeezes is not where it rests under the same load
    still = scene.journal.geometry.equilibrium(
        force, samples["speed"].values, scene.journal.film_model
    )
    gap = np.abs(still.eccentricity_ratio - film["eccentricity_ratio"].values)
    assert gap.max() > 0.005


def test_a_scene_on_the_rung_reduced_closes_its_orbits_there():
    keys = {"reduction": {"method": "periodic", "bounds": [0.05, 0.3], "orders": [1.0]}}
    law = {"cavitation": {"kind": "gas-mixture", "mixing_constant": 5e4}, "edge_pressure": 5e5}
    few, fine = (
        scene_of(journal=law | {"rung": rung, "grid": [36, 24]}, **keys)
        for rung in ("reduced", "grid")
    )
    inputs = inputs_of(few)
    one, other = (journal.film(scene, One(), inputs)["N"].to_dataset() for scene in (few, fine))
    assert "minimum_film_grid_error" in other.attrs
    assert "minimum_film_grid_error" not in one.attrs  # of the grid alone
    least = [float(film["minimum_film"].min()) for film in (one, other)]
    assert least[0] == pytest.approx(least[1], rel=0.01)
    assert least[0] != least[1]


@pytest.mark.slow
def test_the_film_of_each_place_says_its_own_bounds():
    stiff = {"diameter": 1.4, "width": 1.3, "relative_clearance": 1e-3}
    scene = make_scene(
        {
            "name": "two",
            "reduction": {"method": "periodic"},
            "bearings": {
                "N": {"kind": "journal", "grid": [24, 8]},
                "N2": {"kind": "journal", "grid": [24, 8], "geometry": stiff,
                       "lubricant": {"viscosity": 0.3}},
            },
        }
    )  # fmt: skip
    inputs = inputs_of(scene)
    for place in ("N", "N2"):
        about = inputs["reduction"][place].attrs
        assert 0 < about["slow_bound"] <= about["fast_bound"]
    films = journal.film(scene, One(), inputs)
    first, second = (films[place].to_dataset() for place in ("N", "N2"))
    assert first.attrs["radial_clearance"] != second.attrs["radial_clearance"]
    assert second.attrs["radial_clearance"] == pytest.approx(0.7e-3)


TURNS, STEPS = 24, 48  # of a series, and in each of its turns
BEAM = {"two_point": {"beam": {"sections": [{"outer_diameter": 1.6, "inner_diameter": 1.2}]}}}


def turning():
    """Loads of the hub that turn with the rotor, whole times."""
    loads = HUB.isel(time=np.zeros(TURNS * STEPS + 1, int))
    turn = 2 * np.pi * np.arange(TURNS * STEPS + 1) / STEPS
    time = turn / float(HUB["speed"].mean())
    swing = np.stack([0 * turn, 1.5e6 * np.sin(turn), 1e6 * np.sin(turn + 0.7)])
    mean = HUB["hub_moment"].mean("time").transpose("axis").values
    loads = loads.assign_coords(time=("time", time, HUB["time"].attrs))
    loads["speed"] = "time", np.full(time.size, float(HUB["speed"].mean())), HUB["speed"].attrs
    loads["hub_moment"] = ("axis", "time"), mean[:, None] + swing, HUB["hub_moment"].attrs
    force = HUB["hub_force"].mean("time").transpose("axis").values
    loads["hub_force"] = ("axis", "time"), np.tile(force[:, None], time.size), {"units": "N"}
    return loads


def films_of(scene, hub):
    found = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    if scene.journal.in_motion:
        return journal.orbit(scene, One(), found)["N"].to_dataset()
    found["reduction"] = reduction.reduced_loads(scene, One(), found)
    return journal.film(scene, One(), found)["N"].to_dataset()


LAW = {"cavitation": {"kind": "gas-mixture", "mixing_constant": 5e4}, "edge_pressure": 5e5}


@pytest.mark.parametrize("rung", ["reduced", "grid"])
def test_a_periodic_load_bends_the_shaft_as_the_series_does_that_it_was_made_of(rung):
    hub = turning()
    order = {"method": "periodic", "bounds": [1e-3, 1.0], "orders": [1.0]}  # no base load
    film = LAW | {"rung": rung, "grid": [36, 24] if rung == "reduced" else [24, 8], "tilt": True}
    period = films_of(scene_of(shaft=BEAM, journal=film, reduction=order), hub)
    motion = film | {"motion": "transient"}
    series = films_of(scene_of(shaft=BEAM, journal=motion, accuracy="given"), hub)
    last = series.isel(sample=slice(-STEPS - 1, None))
    size = np.ptp(last["tilt"].values, axis=0).max()
    assert size > 1e-5
    when = (last["time"].values - last["time"].values[0])[:, None]
    assert period.sizes["sample"] == STEPS + 1
    # the series ends where it began, so that a period of it begins as the closed one does
    np.testing.assert_allclose(period["time"].values[:, None], when, rtol=2e-3, atol=1e-3)
    np.testing.assert_allclose(period["tilt"], last["tilt"], atol=0.01 * size)
    clearance = period.attrs["radial_clearance"]
    np.testing.assert_allclose(period["eccentricity"], last["eccentricity"], atol=2e-3 * clearance)
    least = float(period["minimum_film"].min())
    assert least == pytest.approx(float(last["minimum_film"].min()), rel=5e-3)
    # aligned the film is thicker and its pressure lower
    aligned = films_of(scene_of(shaft=BEAM, journal=film | {"tilt": False}, reduction=order), hub)
    assert float(aligned["minimum_film"].min()) > 1.03 * least
    assert float(aligned["maximum_pressure"].max()) < float(period["maximum_pressure"].max())
    assert "tilt" not in aligned


def test_the_tilt_over_a_period_goes_with_the_load_and_says_what_it_leaves_out():
    scene = scene_of(
        shaft=BEAM, journal={"tilt": True}, reduction={"method": "periodic", "bounds": [0.05, 0.3]}
    )
    hub = turning()
    found = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    samples = reduction.reduced_loads(scene, One(), found)["N"].to_dataset()
    assert samples.attrs["tilt_left_out"] < 1e-3  # moments alone change: two loads, two tilts
    for name in ("force", "moment", "tilt", "curvature"):
        np.testing.assert_allclose(samples[name][0], samples[name][-1], rtol=1e-9, atol=1e-12)
    mean = found["shaft"]["tilt"].sel(bearing="N").mean("time")
    # over whole turns; the series has its first sample twice
    np.testing.assert_allclose(samples["tilt"][:-1].mean("sample"), mean, rtol=0.02)
    assert np.ptp(samples["tilt"].sel(axis="y").values) > 1e-5
    hub["hub_force"][2] += 4e5 * np.sin(hub["time"].values)  # not with the moments
    found = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    other = reduction.reduced_loads(scene, One(), found)["N"].to_dataset()
    assert 0.05 < other.attrs["tilt_left_out"] < 1.0


def test_rolling_bearings_take_both_kinds():
    for method in ("stationary", "periodic"):
        scene = scene_of(reduction={"method": method, "bounds": [0.05, 0.3]}
                         if method == "periodic" else {"method": method})  # fmt: skip
        found = rolling.load_distribution(scene, One(), inputs_of(scene))
        assert np.isfinite(found["bearing_life"].values).all()


def test_design_loads_that_are_chosen_by_hand_ask_for_no_accuracy():
    assert scene_of(reduction={"method": "periodic"}).accuracy == "given"
    with pytest.raises(InputError, match="accuracy"):
        scene_of(reduction={"method": "stationary"}, accuracy=0.05)


def test_bounds_out_of_order_are_refused_and_keys_without_effect_are_told():
    with pytest.raises(InputError, match="bounds"):
        scene_of(reduction={"method": "periodic", "bounds": [1.0, 0.5]})
    told = unused_keys(scene_of(reduction={"method": "stationary", "size": 0.2, "orders": [1.0]}))
    assert {"reduction.size", "reduction.orders"} <= told.keys()


@pytest.mark.parametrize("method", ["stationary", "periodic"])
def test_the_command_line_solves_the_film_under_design_loads(method, tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=400)
    scene = tmp_path / "scene.toml"
    scene.write_text('[journal]\nbearings = ["N"]\ngrid = [24, 8]\n', encoding="utf-8")
    line = ["reduce", str(cube), "-o", str(tmp_path / "out"), "--method", method, "--film"]
    line += ["--scene", str(scene), "--bearing", "N", "--json"]
    line += ["--bounds", "0.05", "0.3"] if method == "periodic" else []
    answer = CliRunner().invoke(app, line)
    assert answer.exit_code == 0, answer.output
    films = json.loads(answer.stdout)["films"]
    assert len(films) == (1 if method == "periodic" else 11)
    assert all(0 < film["eccentricity_ratio"] < 1 for film in films)
