"""Thrust bearings and pairs of cones in scenes and on the command line."""

import json
import math
import tomllib

import numpy as np
import pytest
import xarray as xr
from pydantic import ValidationError
from synthetic import cube_file

from loadflow.cli import main
from loadflow.cube import open_cube
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConicalBearing,
    ConicalPair,
    DoubleThrustBearing,
    Film,
    Guembel,
    Lubricant,
    Taper,
    ThrustBearing,
)
from loadflow.planning.choice import choose, finer
from loadflow.running.runner import run
from loadflow.scene.candidates import candidates_of
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.scene.thrust import Thrust
from loadflow.scene.unused import unused_keys
from loadflow.stages import journal as journal_stage
from loadflow.stages import thrust as thrust_stage

FILM = Film(Lubricant(0.2), Guembel(), inlet=None, grid=(20, 10), edge_pressure=1e5)
LANDS = {"pads": 10, "inner_radius": 0.75, "outer_radius": 1.05, "pad_angle": 0.56, "taper": 6e-5}
SOFT = {
    "pads": 10, "inner_radius": 0.75, "outer_radius": 1.05, "pad_angle": 0.56,
    "pivot": {"stiffness": 1e9},
}  # fmt: skip
CONE = {
    "half_angle": 0.5, "slant": [1.59, 2.59], "clearance": 2e-4, "pads": 10, "pad_angle": 0.58,
    "profile": {"kind": "taper", "taper": 8e-5},
}  # fmt: skip
JOURNAL = {
    "kind": "journal", "lubricant": {"viscosity": 0.2}, "edge_pressure": 1e5,
    "geometry": {"diameter": 1.4, "width": 1.3, "relative_clearance": 1e-3},
}  # fmt: skip
COLLAR = {"kind": "thrust", "lubricant": {"viscosity": 0.2}, "geometry": LANDS}
PAIR = {
    "kind": "conical-pair", "lubricant": {"viscosity": 0.2},
    "geometry": {"distance": 3.2, "left": CONE},
}  # fmt: skip
SHAFT = {"two_point": {}, "moment": {}}
PLACES = {"N": JOURNAL, "N2": [JOURNAL, COLLAR], "M": PAIR}


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    place = tmp_path_factory.mktemp("thrust")
    cube = cube_file(place / "loads.h5", steps=200)
    scene = make_scene(
        {
            "name": "thrust", "accuracy": "given", "loads": {"files": [str(cube)]}, "shaft": SHAFT,
            "bearings": {"N2": COLLAR, "M": PAIR}, "results": ["thrust.film"],
            "reduction": {"size": 0.02, "classes": 3},
        }
    )  # fmt: skip
    return run(scene, out=place / "runs", report=False)


def test_a_small_scene_runs_through_and_says_what_carries_the_thrust(done):
    table = done.tree["thrust"].to_dataset()
    assert table["bearing"].values.tolist() == ["N2", "M"]
    assert (table["smallest_film"] > 1e-5).all()
    assert (table["mean_friction_power"] > 0).all()
    said = [v for v in done.verdicts if v.quantity == "force along the shaft without a bearing"]
    assert {v.subject for v in said} == {"thrust N2", "conical-pair M"}
    assert all(v.holds and "carried by" in v.note for v in said)
    energy = done.tree["lifetime"]["thrust_energy"].values
    assert energy.shape == (2,)
    assert (energy > 0).all()


def test_the_curve_of_a_collar_gives_a_scene_the_films_of_its_grid(done, tmp_path):
    cube = cube_file(tmp_path / "loads.h5", steps=200)
    scene = make_scene(
        {
            "name": "curve", "accuracy": "given", "loads": {"files": [str(cube)]}, "shaft": SHAFT,
            "bearings": {"N2": COLLAR | {"rung": "curve"}}, "results": ["thrust.film"],
            "reduction": {"size": 0.02, "classes": 3},
        }
    )  # fmt: skip
    assert make_scene(tomllib.loads(scene.to_toml())) == scene
    table = run(scene, out=tmp_path / "runs", report=False).tree["thrust"].to_dataset()
    solved = done.tree["thrust"].to_dataset().sel(bearing=["N2"])
    for name in ("smallest_film", "largest_pressure", "mean_friction_power"):
        np.testing.assert_allclose(table[name].values, solved[name].values, rtol=3e-3)


def test_a_plan_takes_the_curve_and_counts_its_error(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", steps=200)
    scene = make_scene(
        {
            "name": "planned", "loads": {"files": [str(cube)]}, "shaft": SHAFT,
            "bearings": {"N2": COLLAR}, "results": ["thrust.film"],
        }
    )  # fmt: skip
    chosen = choose(scene, ["loads", "shaft", "thrust"], tuple(list_cases(scene)))
    assert chosen.scene.thrust.rung == "curve"
    assert 0 < chosen.errors["thrust.film"]["minimum film"] < 0.2
    better = finer(chosen.scene, "thrust").thrust
    assert (better.rung, better.motion) == ("curve", "transient")
    assert better.grid > chosen.scene.thrust.grid
    still = chosen.scene.thrust.model_copy(update={"motion": "quasi-static"})
    resting = chosen.scene.model_copy(update={"thrust": still})
    assert finer(resting, "thrust").thrust.rung == "grid"


BENT = {"two_point": {"beam": {"sections": [{"outer_diameter": 1.4, "inner_diameter": 0.7}]}}}
HOT = {"kind": "thrust", "geometry": LANDS, "heat": {"oil": "iso-vg-220"}, "grid": [8, 4]}


def of_bent_shaft(cube, name, **collar):
    return make_scene(
        {
            "name": name, "accuracy": "given", "loads": {"files": [str(cube)]}, "shaft": BENT,
            "bearings": {"N2": HOT | collar}, "results": ["thrust.film"],
            "reduction": {"size": 0.02, "classes": 3},
        }
    )  # fmt: skip


def samples_of_run(done):
    part = next((done.path / "thrust").glob("*.h5"))
    return open_cube(part)["N2"].to_dataset().load()


def shaft_tilt(done):
    """Rotation of the shaft about both axes across it, (2, n), rad."""
    part = open_cube(next((done.path / "shaft").glob("*.h5"))).load()
    return part["tilt"].sel(bearing="N2", axis=["y", "z"]).transpose("axis", "time").values


def test_a_collar_that_tilts_warms_and_moves_follows_the_whole_series(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", steps=200)
    scene = of_bent_shaft(cube, "moving", motion="transient", tilt=True)
    assert scene.thrust.rung == "curve"
    assert make_scene(tomllib.loads(scene.to_toml())) == scene
    done = run(scene, out=tmp_path / "runs", report=False)
    samples = samples_of_run(done)
    assert samples.sizes["sample"] == 200
    assert samples.attrs["motion"] == "transient"
    assert samples["converged"].all()
    assert samples["residual"].max() < 1e-8
    assert np.ptp(samples["temperature"].values) == 0.0
    assert samples["temperature"][0] > 313.15 + 1.0
    table = done.tree["thrust"].to_dataset()
    assert samples["temperature"].values[0] in table["largest_temperature"].values
    aligned = run(of_bent_shaft(cube, "still", rung="curve"), out=tmp_path / "runs", report=False)
    assert (table["smallest_film"] < aligned.tree["thrust"]["smallest_film"]).all()
    largest = float(samples["restoring_moment"].max())
    assert largest > 0.0
    assert np.isclose(table["largest_restoring_moment"].values, largest, rtol=1e-6).any()
    slope = np.hypot(*shaft_tilt(done)) @ samples["restoring_moment"].values
    slope /= (np.hypot(*shaft_tilt(done)) ** 2).sum()
    assert samples.attrs["tilting_stiffness"] == pytest.approx(slope, rel=1e-3)
    assert 0.0 < samples.attrs["moment_error"] < 0.1


@pytest.mark.slow
def test_the_table_of_tilts_gives_a_scene_the_films_of_its_grid(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", steps=200)
    cool = {"heat": None, "lubricant": {"viscosity": 0.2}, "tilt": True}
    one, other = (
        run(of_bent_shaft(cube, rung, rung=rung, **cool), out=tmp_path / "runs", report=False)
        for rung in ("curve", "grid")
    )
    ours, theirs = (samples_of_run(done) for done in (one, other))
    for name, near in (
        ("minimum_film", 5e-3), ("maximum_pressure", 0.03), ("friction_power", 5e-3),
    ):  # fmt: skip
        np.testing.assert_allclose(ours[name].values, theirs[name].values, rtol=near)


def test_every_sample_is_one_equilibrium(done):
    part = next((done.path / "thrust").glob("*.h5"))
    tree = open_cube(part)
    for place in ("N2", "M"):
        samples = tree[place].to_dataset().load()
        answered = samples["converged"].values.astype(bool)
        assert answered.all()
        power = samples["friction_torque"] * samples["speed"]
        np.testing.assert_allclose(power, samples["friction_power"], rtol=1e-9)


def test_the_collar_carries_both_ways_and_its_two_films_are_the_force():
    row = ThrustBearing(**LANDS)
    collar = DoubleThrustBearing(row, row, play=4e-4)
    one, other = (collar.equilibrium(force, 1.2, FILM) for force in (8e5, -8e5))
    assert one.front.force - one.back.force == pytest.approx(8e5, rel=1e-8)
    assert one.front.gap == pytest.approx(other.back.gap, rel=1e-8)
    assert one.stiffness == pytest.approx(other.stiffness, rel=1e-6)
    step = 1e-8
    more, less = (collar.pressure(one.gap + d, 1.2, FILM).force for d in (step, -step))
    assert (less - more) / (2 * step) == pytest.approx(one.stiffness, rel=1e-5)


def test_a_collar_without_load_stands_in_the_middle():
    row = ThrustBearing(**LANDS)
    found = DoubleThrustBearing(row, row, play=4e-4).equilibrium(0.0, 1.2, FILM)
    assert found.gap == pytest.approx(2e-4, rel=1e-6)


def test_a_collar_with_much_play_is_the_single_row():
    row = ThrustBearing(**LANDS)
    alone = row.equilibrium(8e5, 1.2, FILM)
    beside = DoubleThrustBearing(row, row, play=0.1).equilibrium(8e5, 1.2, FILM)
    assert beside.minimum_film == pytest.approx(alone.minimum_film, rel=1e-4)


def test_a_collar_that_stands_or_turns_backward_carries_nothing():
    collar = DoubleThrustBearing(ThrustBearing(**LANDS), ThrustBearing(**LANDS), play=4e-4)
    with pytest.raises(SolverError, match="without rotation"):
        collar.equilibrium(1e5, 0.0, FILM)
    with pytest.raises(SolverError, match="no film carries it"):
        collar.equilibrium(1e6, -1.2, FILM)


def test_a_part_goes_on_where_a_load_is_neither_carried_nor_in_contact_for_certain():
    # flat pads that find no tilt as thin as the surfaces are rough
    scene = make_scene({"shaft": SHAFT, "bearings": PLACES | {"N2": [JOURNAL, COLLAR | {
        "geometry": {**SOFT, "pivot": {"share": 0.3}}}]}})  # fmt: skip
    collar = scene.thrust.bearings["N2"]
    with pytest.raises(SolverError):
        collar.solve(np.array([0.0, 0.0, 1e5]), np.zeros(3), 1.0)
    assert not collar.touches(np.array([0.0, 0.0, 1e5]), 1.0)
    assert collar.touches(np.array([0.0, 0.0, 1e5]), 0.0)


def test_a_pair_of_tapered_segments_is_symmetric_and_in_balance():
    """Inlets of both cones are those of the shaft's rotation: no load leaves it in the middle."""
    cone = ConicalBearing(0.5, (1.59, 2.59), 2e-4, pads=10, pad_angle=0.58, profile=Taper(8e-5))
    pair = ConicalPair(cone, cone, distance=3.2)
    rest = pair.equilibrium((0.0, 0.0, 0.0), (0.0, 0.0), 1.25, FILM)
    assert np.abs(rest.eccentricity).max() < 1e-12
    assert rest.left.normal_force.sum() == pytest.approx(rest.right.normal_force.sum(), rel=1e-9)
    force, moment = np.array([-2e4, -1e6, 8e5]), np.array([4e5, 4e6])
    found = pair.equilibrium(force, moment, 1.25, FILM)
    assert np.abs(found.force - force).max() < 1.0
    assert np.abs(found.moment - moment).max() < 1.0
    mirrored = pair.equilibrium(force * (1, 1, -1), -moment, 1.25, FILM)
    assert mirrored.load_share[::-1] == pytest.approx(found.load_share, rel=1e-6)


def test_scenes_are_written_and_read_alike():
    scene = make_scene({"name": "x", "shaft": SHAFT, "bearings": PLACES})
    assert {"journal.film", "thrust.film"} <= set(scene.results)
    assert not any(name.startswith("rolling") for name in scene.results)
    again = make_scene(tomllib.loads(scene.to_toml()))
    assert again == scene


@pytest.mark.parametrize(
    ("places", "words"),
    [
        ({"M": PAIR | {"motion": "transient"}}, r"bearings\.M: motion: films of pads"),
        ({"M": PAIR | {"heat": {}}}, "heat: films of pads"),
        ({"N2": COLLAR | {"shell": {}}}, "shell: films of pads"),
        ({"N2": COLLAR | {"heat": {}}}, "lubricant: follows from heat.oil"),
        (
            {"N2": COLLAR | {"motion": "transient", "rung": "grid"}},
            "needs a table of films; set rung",
        ),
        (
            {"N2": COLLAR | {"motion": "transient", "geometry": SOFT}},
            "no curve over the gap; set motion quasi-static",
        ),
        ({"M": COLLAR}, "neither radial forces nor moments"),
        ({"N2": COLLAR | {"play": 1e-6}}, "twice the roughness"),
        ({"N2": [COLLAR, COLLAR]}, "a second bearing of its kind"),
        ({"N": COLLAR | {"rung": "grid"}, "N2": COLLAR | {"rung": "curve"}}, "share one rung"),
        ({"M": PAIR | {"rung": "curve"}}, "rung: films of pads"),
        (
            {"N2": COLLAR | {"rung": "curve", "geometry": SOFT}},
            r"bearings\.N2.*pads on springs have no curve",
        ),
        ({"N2": COLLAR | {"geometry": LANDS | {"pad_angle": 1.0}}}, "pad_angle"),
        ({"G": COLLAR}, "the shaft has the bearings"),
    ],
)
def test_what_films_of_pads_do_not_know_is_refused_by_name(places, words):
    with pytest.raises(InputError, match=words):
        make_scene({"name": "x", "shaft": SHAFT, "bearings": places})


def test_periodic_loads_and_a_result_without_bearings_are_refused():
    with pytest.raises(InputError, match="no closed orbit"):
        make_scene(
            {"name": "x", "shaft": SHAFT, "bearings": {"N2": COLLAR},
             "reduction": {"method": "periodic"}}
        )  # fmt: skip
    with pytest.raises(InputError, match=r"thrust\.film needs a bearing"):
        make_scene({"name": "x", "results": ["thrust.film"]})


def test_a_pad_that_comes_first_changes_nothing_and_it_is_told():
    turned = COLLAR | {"geometry": LANDS | {"first_pad": 0.2}}
    scene = make_scene({"name": "x", "shaft": SHAFT, "bearings": {"N2": turned}})
    assert "thrust.bearings.N2.geometry.first_pad" in unused_keys(scene)


def test_pads_that_align_themselves_are_not_told_as_unused_beside_their_seat():
    aligning = COLLAR | {"self_aligning": True}
    seat = {"kind": "spherical", "radius": 1.5, "friction": 0.1}
    told = [
        unused_keys(make_scene({"name": "x", "shaft": SHAFT, "bearings": {"N2": one}}))
        for one in (aligning, aligning | {"seat": seat})
    ]
    where = "thrust.bearings.N2.self_aligning"
    assert where in told[0]
    assert where not in told[1]


def answer(arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        main([*arguments, "--json"])
    assert stopped.value.code == 0
    return json.loads(capsys.readouterr().out)


def test_rows_cut_against_the_simulated_rotation_are_told():
    lands = {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7}
    carries = lands | {"profile": {"kind": "taper", "taper": 1e-4}}
    cut = lands | {"profile": {"kind": "reversed", "profile": carries["profile"]}}

    def told(front, back):
        one = {"kind": "thrust", "geometry": front, "back": back}
        data = {"shaft": {"two_point": {}}, "thrust": {"bearings": {"N2": one}}}
        found = unused_keys(make_scene(data | {"results": ["thrust.film"]}))
        return {key: why for key, why in found.items() if key.startswith("thrust")}

    assert told(carries, carries) == {}
    assert [*told(carries, cut)] == ["thrust.bearings.N2.back.profile"]
    whole = told(cut, carries)  # whatever the rows are: nothing parts the collar from the front one
    assert [*whole] == ["thrust.bearings.N2.geometry", "thrust.bearings.N2.back"]
    assert all("touch under all thrust downwind" in why for why in whole.values())
    assert told(cut | {"pivot": {"share": 0.6}}, carries) == {}


def test_the_commands_answer_for_one_load(capsys):
    found = answer(
        ["thrust", "--pads", "10", "--inner-radius", "0.75", "--outer-radius", "1.05",
         "--pad-angle-deg", "32", "--taper", "6e-5", "--viscosity", "0.2", "--force", "9e5",
         "--speed-rpm", "12", "--grid", "20", "10"], capsys,
    )  # fmt: skip
    assert found["force"]["value"] == pytest.approx(9e5, rel=1e-6)
    found = answer(
        ["cone", "--half-angle-deg", "28.6", "--slant", "1.59", "2.59", "--clearance", "2e-4",
         "--distance", "3.2", "--pads", "10", "--pad-angle-deg", "33", "--taper", "8e-5",
         "--viscosity", "0.2", "--force-x", "1e6", "--force-z", "8e5", "--moment-y", "4e6",
         "--speed-rpm", "12", "--grid", "20", "10"], capsys,
    )  # fmt: skip
    np.testing.assert_allclose(found["force"]["value"], [1e6, 0, 8e5], atol=1.0)
    assert found["film_holds"]["value"]


def test_a_command_without_a_measure_names_it():
    with pytest.raises(SystemExit) as stopped:
        main(["thrust", "--viscosity", "0.2", "--force", "1e5", "--speed-rpm", "12"])
    assert stopped.value.code == 2


def test_sized_candidates_carry_the_thrust():
    sized = candidates_of("nrel-5mw")
    assert sized["conical-pair"]["M"]["kind"] == "conical-pair"
    kinds = [one["kind"] for one in sized["journal-thrust"]["N2"]]
    assert kinds == ["journal", "thrust"]
    assert math.isfinite(sized["journal-thrust"]["N2"][1]["play"])


def test_a_collar_that_says_its_cells_says_them_for_all_of_its_section():
    def scene(**collar):
        bearings = PLACES | {"N2": [JOURNAL, COLLAR | collar]}
        return make_scene({"name": "x", "shaft": SHAFT, "bearings": bearings})

    fine = scene(grid=[40, 20])
    assert fine.thrust.grid == fine.thrust.bearings["N2"].grid == (40, 20)
    assert fine.thrust.bearings["M"].grid == scene().thrust.grid == (20, 10)
    assert make_scene(tomllib.loads(fine.to_toml())) == fine
    two = {"N": COLLAR | {"grid": [16, 8]}, "N2": COLLAR | {"grid": [40, 20]}}
    with pytest.raises(InputError, match=r"bearings\.N2\.grid = .*collars share one grid"):
        make_scene({"name": "x", "shaft": SHAFT, "bearings": two})
    with pytest.raises(InputError, match=r"bearings\.N2\.1\.grid"):
        scene(grid=40)
    stated = {"bearings": {"N2": COLLAR | {"grid": [16, 8]}}}
    assert Thrust.model_validate(stated).collars["N2"].grid == (16, 8)
    with pytest.raises(ValidationError, match="collars share one grid"):
        Thrust.model_validate(stated | {"grid": [40, 20]})


def test_a_plan_refines_the_cells_of_a_curve_where_the_accuracy_asks_for_it(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", steps=200)

    def chosen(accuracy, **collar):
        data = {
            "name": "fine", "loads": {"files": [str(cube)]}, "shaft": SHAFT, "accuracy": accuracy,
            "bearings": {"N2": COLLAR | collar}, "results": ["thrust.film"],
            "reduction": {"size": 1.0},
        }  # fmt: skip
        scene = make_scene(data)
        found = choose(scene, ["loads", "shaft", "thrust"], tuple(list_cases(scene)))
        return found.scene.thrust

    assert chosen(0.05).grid == (20, 10)
    assert (chosen(0.002).rung, chosen(0.002).grid) == ("curve", (80, 40))
    held = chosen(0.002, grid=[40, 20])
    assert (held.rung, held.grid) == ("curve", (40, 20))


@pytest.mark.parametrize(
    "stage", [journal_stage.STAGE, thrust_stage.STAGE], ids=lambda stage: stage.name
)
def test_a_run_tells_where_the_pressure_is_beyond_what_oil_and_shell_bear(stage):
    places = {"bearing": ["N"], "case": ["a", "b"]}
    peaks = xr.DataArray([[0.2e9, 0.7e9]], dims=("bearing", "case"), coords=places)
    tree = xr.DataTree.from_dict({stage.name: xr.Dataset({"largest_pressure": peaks})})
    (told,) = stage.warnings(tree)
    assert told.startswith(f"{stage.name}, bearing N: the pressure is beyond")
    assert "in 1 of 2 load cases, 700 MPa in b" in told
    assert ("contact" in told) == (stage.name == "journal")  # films of pads know none
    assert not stage.warnings(xr.DataTree.from_dict({stage.name: xr.Dataset()}))
