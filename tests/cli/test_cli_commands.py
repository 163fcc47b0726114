"""Commands of the command line on small input: what they print and write, and what they refuse."""

import json
import math
import re
import subprocess
import sys

import numpy as np
import pytest
from synthetic import case, cube_file

from loadflow.cube import make_cube, open_cube, save_cube
from loadflow.journal import GasMixture, JournalBearing, Lubricant
from loadflow.reduction import read_parameter_file
from loadflow.rolling import SlewingBearing, SphericalRollerBearing
from loadflow.seeds import equality, holm
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.tribology import lubricant
from loadflow.wind import iec

JOURNAL = [
    *("--diameter", "3", "--width", "2.25", "--relative-clearance", "0.5e-3"),
    *("--viscosity", "0.05", "--edge-pressure", "0.5e6", "--mixing-constant", "0.05e6"),
]
ROLLING = ["--balls", "129", "--rows", "2", "--ball-diameter", "0.04", "--pitch-diameter", "1.9"]


@pytest.fixture(scope="module")
def hub_cube(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hub")
    return cube_file(folder / "hub.h5", wind_speeds=(8.0, 12.0), seeds=(1, 2))


@pytest.fixture(scope="module")
def bearing_cube(tmp_path_factory):
    """Two seeds with the forces of both bearings, and a third seed at another step."""
    cases = []
    for seed, step in ((1, 0.25), (2, 0.25), (3, 0.5)):
        series = case(8.0, seed, steps=240, dt=step)
        loads = bearing_loads(TwoPoint(), series["hub_force"], series["hub_moment"])
        cases.append(
            series[["speed"]]
            .assign(force=loads["force"].drop_vars("time", errors="ignore"))
            .assign_coords(position=loads["position"])
        )
    return save_cube(make_cube(cases), tmp_path_factory.mktemp("bearings") / "bearings.h5")


# -- seeds ------------------------------------------------------------------------------------


def test_seeds_prints_the_verdicts_of_the_room(loadflow, hub_cube):
    code, out, _ = loadflow(
        "seeds", hub_cube, "--variable", "speed", "--variable", "hub_moment.y", "--json"
    )
    found = json.loads(out)
    assert code == 0
    assert [(f["wind_speed"], f["component"]) for f in found] == [
        (8.0, "speed"),
        (8.0, "hub_moment.y"),
        (12.0, "speed"),
        (12.0, "hub_moment.y"),
    ]
    cube = open_cube(hub_cube)
    tests = [
        equality(part.values.astype(float), 0.25)
        for at in (cube["wind_speed"] == 8, cube["wind_speed"] == 12)
        for part in (cube["speed"][at], cube["hub_moment"].sel(axis="y")[at])
    ]
    for row, test in zip(found, tests):
        assert row["spread"] == {"pvalue": test.spread.pvalue, "equal": test.spread.equal}
    corrected = holm([test.pvalue for test in tests])
    np.testing.assert_allclose([f["pvalue"] for f in found], corrected, rtol=1e-12)
    assert [f["equal"] for f in found] == (corrected >= 0.05).tolist()


def test_seeds_as_printed_has_no_p_value_of_the_spectrum(loadflow, hub_cube):
    _, out, _ = loadflow("seeds", hub_cube, "--method", "as-printed", "--json")
    found = json.loads(out)
    assert {f["component"] for f in found} == {
        "speed",
        *(f"hub_{load}.{axis}" for load in ("force", "moment") for axis in "xyz"),
    }
    assert all(f["spectrum"]["pvalue"] is None for f in found)


def test_seeds_writes_a_page_that_needs_no_other_file(loadflow, hub_cube, tmp_path):
    page = tmp_path / "seeds.html"
    code, out, _ = loadflow("seeds", hub_cube, "--variable", "hub_moment.y", "-o", page)
    text = page.read_text(encoding="utf-8")
    assert code == 0
    assert "hub_moment.y" in out
    assert text.count("<figure") == 4  # boxes and spectra of two wind speeds
    assert not re.search(r"""(src|href)=["']https?:""", text)


def test_seeds_takes_bearing_forces_and_leaves_out_what_is_zero(loadflow, bearing_cube):
    _, out, _ = loadflow("seeds", bearing_cube, "--json")
    found = json.loads(out)
    components = {f["component"] for f in found}
    assert "force.N.x" not in components  # N floats
    assert components == {"speed", "force.N.y", "force.N.z", *(f"force.N2.{a}" for a in "xyz")}


def test_seeds_at_another_step_are_not_compared(loadflow, bearing_cube):
    _, out, _ = loadflow("seeds", bearing_cube, "--variable", "speed", "--json")
    assert sorted(f["seeds"] for f in json.loads(out)) == [1, 2]
    _, out, _ = loadflow("seeds", bearing_cube, "--variable", "speed")
    assert "one seed, nothing to test" in out
    assert "1 have one seed" in out


# -- reduce -----------------------------------------------------------------------------------


def test_reduce_writes_a_parameter_file_for_each_case_and_bearing(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow("reduce", hub_cube, "-o", tmp_path / "reduced", "--json")
    answer = json.loads(out)
    assert code == 0
    assert "hub loads only" in answer["suspension"]
    assert len(answer["series"]) == 8
    cube = open_cube(hub_cube)
    for part in answer["series"]:
        reduced = read_parameter_file(part["file"])
        full = cube.sel(case=part["case"])
        assert part["kept"] == reduced.time.size < part["samples"] == reduced.total == 400
        np.testing.assert_array_equal(reduced.speed, full["speed"].values[reduced.index])
        largest = np.hypot(*reduced.force.T).max()
        assert part["largest_force"]["reduced"] == pytest.approx(largest, rel=1e-12)
        assert largest == part["largest_force"]["full"]  # the default pick keeps the extremes
    page = (tmp_path / "reduced" / "reduction.html").read_text(encoding="utf-8")
    assert page.count("<figure") == 8


def test_reduce_takes_the_forces_of_the_cube_in_the_frame_of_the_film(
    loadflow, bearing_cube, tmp_path
):
    _, out, _ = loadflow(
        "reduce", bearing_cube, "-o", tmp_path, "--bearing", "N2", "--size", 0.3, "--json"
    )
    answer = json.loads(out)
    assert answer["suspension"] == "of the cube"
    assert {part["bearing"] for part in answer["series"]} == {"N2"}
    assert len(answer["series"]) == 3
    reduced = read_parameter_file(tmp_path / "dlc1.1_v8_s3_N2.csv")
    leaf = next(n for n in open_cube(bearing_cube).leaves if "dlc1.1_v8_s3" in n["case"])
    force = leaf.to_dataset()["force"].sel(case="dlc1.1_v8_s3", bearing="N2")
    kept = force.isel(time=reduced.index)
    np.testing.assert_array_equal(reduced.force[:, 0], -kept.sel(axis="z"))
    np.testing.assert_array_equal(reduced.force[:, 1], kept.sel(axis="y"))


def test_a_reduced_file_goes_into_the_film_solver(loadflow, hub_cube, tmp_path):
    loadflow("reduce", hub_cube, "-o", tmp_path, "--bearing", "N", "--size", 0.02)
    file = tmp_path / "dlc1.1_v8_s1_N.csv"
    code, out, _ = loadflow("journal", *JOURNAL, "--grid", 36, 8, "--series", file, "--json")
    answer = json.loads(out)
    reduced = read_parameter_file(file)
    film = JournalBearing(3.0, 2.25, 0.5e-3).equilibrium(
        reduced.force,
        reduced.speed,
        Lubricant(0.05),
        cavitation=GasMixture(0.05e6),
        edge_pressure=0.5e6,
        grid=(36, 8),
    )
    assert code == 0
    assert answer["largest_eccentricity_ratio"]["value"] == film.eccentricity_ratio.max()
    assert answer["mean_friction_power"]["value"] == pytest.approx(
        float(reduced.mean(film.friction_power)), rel=1e-12
    )
    assert answer["not_converged"]["value"] == 0


# -- loads ------------------------------------------------------------------------------------


def test_loads_simulates_a_cube_that_seeds_can_read(loadflow, tmp_path):
    file = tmp_path / "loads.h5"
    code, _, err = loadflow(
        *("loads", "--wind-speed", 8, "--seed", 1, "--seed", 4, "--seed", 4, "-o", file),
        *("--duration", 4, "--step", 0.025, "--rung", "tables", "--json"),
    )
    assert code == 0, err
    cube = open_cube(file)
    assert cube["case"].values.tolist() == ["dlc1.1_v8_s1", "dlc1.1_v8_s4"]
    assert cube.sizes["time"] == 160
    np.testing.assert_allclose(cube["weight"], 0.5)
    assert cube["hub_force"].attrs["units"] == "N"
    assert loadflow("seeds", file, "--variable", "hub_force.x")[0] == 0


# -- wind, journal, rolling -------------------------------------------------------------------


def test_wind_prints_the_numbers_of_the_standard(loadflow):
    answer = json.loads(loadflow("wind", 12, "--category", "A", "--class", "II", "--json")[1])
    assert answer["ntm_sigma"]["value"] == float(iec.ntm_sigma(12, "A"))
    assert answer["etm_sigma"]["value"] == float(iec.etm_sigma(12, "II", "A"))
    assert answer["eog_amplitude"]["value"] == float(iec.eog_amplitude(12, "II", "A", 126, 90))
    assert answer["length_scale"] == {
        "value": 42.0,
        "units": "m",
        "long_name": "turbulence scale Λ1",
    }
    _, out, _ = loadflow("wind", 12)
    row = next(line for line in out.splitlines() if "ecd_angle" in line)
    assert row.split()[1:3] == ["60", "°"]


def test_journal_prints_one_operating_point_with_units_and_convergence(loadflow):
    point = ["--force-x", 2.0586e6, "--force-y", -0.4428e6, "--speed-rpm", 12, "--grid", 36, 8]
    state = JournalBearing(3.0, 2.25, 0.5e-3).equilibrium(
        (2.0586e6, -0.4428e6),
        12 * math.pi / 30,
        Lubricant(0.05),
        cavitation=GasMixture(0.05e6),
        edge_pressure=0.5e6,
        grid=(36, 8),
    )
    answer = json.loads(loadflow("journal", *JOURNAL, *point, "--json")[1])
    assert answer["eccentricity_ratio"]["value"] == state.eccentricity_ratio
    assert answer["stiffness"] == {
        "value": state.stiffness.tolist(),
        "units": "N/m",
        "long_name": answer["stiffness"]["long_name"],
    }
    assert answer["converged"]["value"] is True
    _, out, _ = loadflow("journal", *JOURNAL, *point)
    lines = {line.split()[0]: line.split() for line in out.splitlines() if line.split()}
    assert lines["minimum_film"][1:3] == [f"{state.minimum_film * 1e6:.6g}", "µm"]
    assert lines["iterations"][1] == str(state.iterations)
    assert {"converged", "residual"} <= lines.keys()


def test_journal_warms_a_named_oil(loadflow):
    point = ["--force-x", 2.0586e6, "--speed-rpm", 12, "--grid", 36, 8]
    warm = [*JOURNAL[:6], *JOURNAL[8:], "--oil", "mineral-vg-320", "--inlet-temperature-c", 45]
    answer = json.loads(loadflow("journal", *warm, *point, "--json")[1])
    temperature = answer["temperature"]["value"]
    assert answer["temperature"]["units"] == "K"
    assert 318.15 < temperature < 350
    oil = lubricant("mineral-vg-320")
    held = [*JOURNAL[:6], *JOURNAL[8:], "--viscosity", float(oil.viscosity(temperature))]
    alone = json.loads(loadflow("journal", *held, *point, "--json")[1])
    for name in ("eccentricity_ratio", "friction_power"):
        assert answer[name]["value"] == pytest.approx(alone[name]["value"], rel=1e-8)


def test_rolling_prints_the_load_of_the_hardest_loaded_ball(loadflow):
    arguments = [*ROLLING, "--groove-radius", 0.0205, "--force-z", 2e6, "--moment-y", 1e5]
    bearing = SlewingBearing(
        balls=129,
        rows=2,
        ball_diameter=0.04,
        pitch_diameter=1.9,
        groove_radius=0.0205,
        contact_angle=math.radians(45),
    )
    result = bearing.equilibrium(force=(0, 0, 2e6), moment=(0, 1e5))
    answer = json.loads(loadflow("rolling", *arguments, "--json")[1])
    assert answer["maximum_force"]["value"] == float(result.maximum_force)
    assert np.shape(answer["ball_forces"]["value"]) == (2, 2, 129)
    _, out, _ = loadflow("rolling", *arguments)
    row = next(line for line in out.splitlines() if "maximum_force" in line)
    assert row.split()[1:3] == [f"{result.maximum_force / 1e3:.6g}", "kN"]
    assert "ball_forces" not in out  # 516 numbers are for --json
    assert "converged" in out


FLEXIBLE = [
    *("--outer-ring", 0.1, 0.12, 1.0005, "--inner-ring", 0.094, 0.12, 0.897),
    *("--wall", 0.06, 1.0),
]


def test_rolling_takes_flexible_rings_by_their_measures(loadflow):
    load = ["--groove-radius", 0.0205, "--force-x", 9e4, "--force-z", 4e4, "--moment-y", -4e5]
    answer, rigid = (
        json.loads(loadflow("rolling", *ROLLING, *load, *rings, "--json")[1])
        for rings in (FLEXIBLE, [])
    )
    assert answer["model"].startswith("flexible inner and outer ring")
    assert rigid["model"].startswith("rigid rings")
    tilt = [case["tilt"]["value"][1] for case in (answer, rigid)]
    assert tilt[0] < 1.2 * tilt[1] < 0
    assert answer["outer_ring_displacement"]["value"] > 1e-6
    assert answer["residual"]["value"] <= 1e-10


def test_rolling_takes_a_bearing_and_its_rings_from_a_scene(loadflow, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(
        """
        [[rolling]]
        bearing = "N"
        geometry = {kind = "spherical", rollers = 30, roller_diameter = 0.09, roller_length = 0.14,
                    pitch_diameter = 1.0, contact_angle = 0.21}
        [[rolling]]
        bearing = "N2"
        rings = "flexible"
        geometry = {balls = 100, ball_diameter = 0.04, pitch_diameter = 2.5, groove_radius = 0.021,
                    contact_angle = 0.7854}
        outer_ring = {section = {width = 0.1, height = 0.12}, radius = 1.33}
        """.replace("\n                    ", " ")
    )
    load = ["--force-y", 1e5, "--force-z", 1e5, "--speed-rpm", 12, "--json"]
    first = json.loads(loadflow("rolling", "--scene", scene, *load)[1])
    assert np.shape(first["roller_forces"]["value"]) == (2, 30)
    assert first["life_hours"]["value"] > 20 * 8766
    assert first["life_holds"]["value"] is True
    assert first["static_rating_holds"]["value"] is True
    second = json.loads(loadflow("rolling", "--scene", scene, "--bearing", "N2", *load)[1])
    assert second["model"].startswith("flexible outer ring")
    assert second["life_holds"]["value"] is False
    oil = ["--oil", "mineral-vg-320", "--cleanliness", "oil, filtered, -/13/10"]
    lubricated = json.loads(loadflow("rolling", "--scene", scene, *load, *oil)[1])
    factor = lubricated["life_factor"]["value"]
    hours = lubricated["modified_life_hours"]["value"]
    assert hours == pytest.approx(factor * first["life_hours"]["value"])
    assert lubricated["limits_of_life_factor"]["value"] == [False, factor >= 50]
    code, _, err = loadflow("rolling", "--scene", scene, *load[:4], *oil)
    assert (code, "--speed-rpm" in err) == (2, True)
    code, _, err = loadflow("rolling", "--scene", scene, "--bearing", "M", *load)
    assert (code, "no rolling bearing 'M'; there are N, N2" in err) == (2, True)
    code, _, err = loadflow("rolling", "--scene", scene, *ROLLING)
    assert (code, "leave out --balls" in " ".join(err.split())) == (2, True)


def test_one_bearing_of_a_candidate_is_solved_and_not_the_one_that_a_scene_has_by_default(
    loadflow, tmp_path
):
    scene = tmp_path / "own.toml"
    bearing = {"rollers": 28, "roller_diameter": 0.09, "roller_length": 0.13, "pitch_diameter": 1.0,
               "contact_angle": 0.18}  # fmt: skip
    keys = "".join(f"{name} = {value}\n" for name, value in bearing.items())
    place = '[candidates.own.N]\nkind = "spherical"\n[candidates.own.N.geometry]\n'
    scene.write_text(f"[shaft.two_point]\n{place}{keys}")
    load = "--force-x", 1e6, "--json"
    found = json.loads(loadflow("rolling", "--scene", scene, *load)[1])
    assert found == json.loads(
        loadflow("rolling", "--scene", scene, "--bearing", "own.N", *load)[1]
    )
    solved = SphericalRollerBearing(**bearing).equilibrium((1e6, 0.0, 0.0))
    assert found["maximum_pressure"]["value"] == pytest.approx(
        float(solved.maximum_pressure), rel=1e-6
    )
    code, _, err = loadflow("rolling", "--scene", scene, "--bearing", "N", *load)
    assert code == 2
    assert "there are own.N" in err


def test_a_scene_of_journal_bearings_alone_has_no_rolling_bearing_to_solve(loadflow, tmp_path):
    scene = tmp_path / "own.toml"
    scene.write_text('bearings = "journal-lemon"\n')
    code, _, err = loadflow("rolling", "--scene", scene, "--force-x", 1e6)
    assert (code, "this scene states no rolling bearing" in err) == (2, True)


# -- what is refused --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            ["seeds", "CUBE", "--variable", "hub_moment.q"],
            "no variable 'hub_moment.q'; did you mean hub_moment.z? There are",
        ),
        (["seeds", "CUBE", "--alpha", 2], "alpha = 2.0; allowed: 0 < alpha < 1"),
        (["seeds", "CUBE", "--method", "best"], "as-printed"),
        (["seeds", "gone.h5"], "gone.h5: no such load cube"),
        (
            ["reduce", "CUBE", "-o", "OUT", "--bearing", "N7"],
            "no bearing 'N7'; did you mean N? There are N, N2",
        ),
        (["reduce", "CUBE", "-o", "OUT", "--size", 3], "size = 3.0"),
        (["reduce", "CUBE", "-o", "OUT", "--pick", "best"], "extremes"),
        (["reduce", "CUBE"], "Missing option"),
        (["loads", "--wind-speed", 40, "-o", "OUT"], "wind_speeds = 40.0 m/s is not allowed"),
        (["loads", "--wind-speed", 8, "--category", "Q", "-o", "OUT"], "category = 'Q'"),
        (["loads", "--wind-speed", 8, "--duration", -1, "-o", "OUT"], "duration = -1"),
        (["loads", "--wind-speed", 8, "--turbine", "none", "-o", "OUT"], "unknown turbine 'none'"),
        (["loads", "--wind-speed", "fast", "-o", "OUT"], "Invalid value for '--wind-speed'"),
        (["wind", 90], "no gust"),
        (["wind", 12, "--category", "Q"], "turbulence category 'Q' is unknown"),
        (
            ["journal"],
            "give --diameter, --width, --relative-clearance and either --viscosity or --oil, or a "
            "scene with --scene; for example: loadflow journal --diameter 1.2",
        ),
        (["journal", *JOURNAL[:6]], "give either --viscosity or --oil, or a scene with --scene;"),
        (["journal", *JOURNAL], "give --force-x and --speed-rpm"),
        (["journal", *JOURNAL, "--oil", "mineral-vg-320"], "give either --viscosity or --oil"),
        (["journal", *JOURNAL[:6], "--oil", "olive"], "lubricant: must be one of"),
        (["journal", *JOURNAL, "--series", "gone.txt"], "gone.txt"),
        (
            ["journal", *JOURNAL, "--series", "gone.txt", "--speed-rpm", 12],
            "--speed-rpm: no effect here: --series brings its own loads",
        ),
        (
            ["journal", *JOURNAL, "--diameter", -3, "--force-x", 1, "--speed-rpm", 1],
            "diameter = -3.0 is not allowed: 0 … 100, in m",
        ),
        (["rolling", *ROLLING, "--groove-radius", 0.01], "groove_radius"),
        (["rolling", *ROLLING, "--groove-radius", 0.0205, "--force-z", "nan"], "nan"),
        (["rolling", *ROLLING], "give --groove-radius, or a scene with --scene"),
        (["rolling", "--bearing", "N"], "give --scene"),
        (["friction-rig"], "give --speed-rpm, or --measured; for example"),
        (["plan", "."], ".: a folder, not a scene"),
        (["rolling", *ROLLING, "--groove-radius", 0.0205, "--speed-rpm", 0], "not 0"),
        (["rolling", *ROLLING, "--groove-radius", 0.0205, "--wall", 0.1, 1], "give --inner-ring"),
        (
            ["rolling", *ROLLING, "--groove-radius", 0.0205, "--outer-ring", 0.1, 0.1, 0.9],
            "outer_ring: radius must be > 0.95 m, got 0.9",
        ),
        (
            ["rolling", *ROLLING, "--groove-radius", 0.0205, *FLEXIBLE, "--wall", 0, 1],
            "thickness of the wall: must be > 0 m, got 0",
        ),
    ],
)
def test_bad_input_gives_one_message_and_code_2(loadflow, hub_cube, tmp_path, arguments, says):
    places = {"CUBE": hub_cube, "OUT": tmp_path / "out"}
    code, out, err = loadflow(*(places.get(argument, argument) for argument in arguments))
    assert code == 2
    assert says in " ".join(err.replace("│", " ").split())
    assert out == ""
    assert not (tmp_path / "out").exists()


def test_a_film_without_an_answer_fails_with_code_1(loadflow):
    code, _, err = loadflow("journal", *JOURNAL, "--force-x", 1e6, "--speed-rpm", 0)
    assert code == 1
    assert "without rotation and squeeze the film carries no load" in err


def test_a_folder_that_cannot_be_written_fails_with_code_1(loadflow, hub_cube, tmp_path):
    (tmp_path / "file").touch()
    code, _, err = loadflow("reduce", hub_cube, "-o", tmp_path / "file" / "inside")
    assert code == 1
    assert "inside" in err


def test_a_cube_without_loads_cannot_be_reduced(loadflow, tmp_path):
    plain = save_cube(make_cube([case(8.0, 1)[["speed", "pitch"]]]), tmp_path / "plain.h5")
    code, _, err = loadflow("reduce", plain, "-o", tmp_path / "out")
    assert code == 2
    assert "plain.h5: dlc1.1_v8_s1: neither 'force' of bearings nor 'hub_force'" in err


@pytest.mark.parametrize("command", [["seeds", "CUBE"], ["reduce", "CUBE", "-o", "OUT"]])
def test_a_bad_cube_is_named_with_case_variable_and_index(loadflow, tmp_path, command):
    whole = make_cube([case(8.0, 1), case(8.0, 2)])
    holed = whole.copy(deep=True)
    holed["hub_force"][1, 0, 7] = np.nan
    for cube, says in (
        (holed, "case 'dlc1.1_v8_s1', variable 'hub_force', index (axis y, time 7)"),
        (whole.drop_vars("dlc"), "coordinate 'dlc' is missing"),
    ):
        places = {"CUBE": save_cube(cube, tmp_path / "bad.h5"), "OUT": tmp_path / "out"}
        code, _, err = loadflow(*(places.get(argument, argument) for argument in command))
        assert code == 2
        assert "bad.h5" in err
        assert says in err


# -- start-up ---------------------------------------------------------------------------------


def test_help_imports_nothing_heavy():
    code = (
        "import sys, loadflow.cli\n"
        "heavy = {'numba', 'scipy', 'xarray', 'pandas', 'matplotlib', 'pydantic'}\n"
        "sys.exit(' '.join(sorted(heavy & set(sys.modules))) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("command", ["seeds", "reduce", "wind", "loads", "journal", "rolling"])
def test_every_command_has_help_and_json(loadflow, command):
    code, out, _ = loadflow(command, "--help")
    assert code == 0
    assert "--json" in out


def test_a_plan_of_a_scene_with_candidates_says_which_command_runs_them(loadflow, tmp_path):
    scene = tmp_path / "scene.toml"
    text = 'results = ["loads.statistics"]\n[loads]\nwind_speeds = [12]\nseeds = 1\n'
    scene.write_text(text + "[candidates.two-spherical]\n")
    assert "two-spherical; loadflow compare runs them" in loadflow("plan", scene)[1]
    scene.write_text(text)
    assert "loadflow compare" not in loadflow("plan", scene)[1]


def test_a_turbine_known_by_its_power_alone_is_told_the_form_it_has(loadflow, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text("[turbine]\nrated_power = 3e6\nrotor_mass = 1e5\n")
    code, _, said = loadflow("plan", scene)
    assert code == 2
    assert "turbine: rated_power, rotor_mass: a turbine is named" in said
    assert 'name = "nrel-5mw@3e6"' in said
