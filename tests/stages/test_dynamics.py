"""Stiffness and damping of films, and the shaft line on them, from scene and command line."""

import io
import json

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from synthetic import case, cube_file
from typer.testing import CliRunner

import loadflow as lf
from loadflow.cli import app
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Film,
    Guembel,
    JournalBearing,
    Lubricant,
    TiltingPads,
    coefficient_table,
    rotor_coefficients,
)
from loadflow.planning.plan import make_plan
from loadflow.running.pages.dynamics import dynamics_section
from loadflow.scene.scene import make_scene
from loadflow.shaft import Beam, Disc, LineSupport, ShaftLine, ShaftSection, modes
from loadflow.stages import dynamics, shaft

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
FILM = Film(Lubricant(0.03), Guembel(), grid=(48, 12))
LOAD = (8e3, 0.0)


def test_the_coefficients_are_the_derivatives_of_the_film_force():
    found = rotor_coefficients(BEARING, LOAD, [100.0], FILM)
    place = BEARING.equilibrium(LOAD, 100.0, FILM).eccentricity
    step = 1e-9
    for k in range(2):
        for name, move in (("stiffness", {}), ("damping", {"velocity": step * np.eye(2)[k]})):
            there = place + (0 if move else step * np.eye(2)[k])
            before = BEARING.pressure(place, 100.0, FILM).force
            after = BEARING.pressure(there, 100.0, FILM, **move).force
            np.testing.assert_allclose(
                found[name].values[0, :, k], (after - before) / step, rtol=2e-3, atol=2e4
            )


def test_the_table_reads_as_a_bearing_of_rotor_dynamics():
    found = rotor_coefficients(BEARING, LOAD, [150.0, 50.0], FILM)
    table = pd.read_csv(io.StringIO(coefficient_table(found)))
    assert list(table) == ["frequency", *(f"{m}{a}{b}" for m in "kc" for a in "xy" for b in "xy")]
    assert table["frequency"].tolist() == [50.0, 150.0]
    assert table["kxy"][0] == pytest.approx(float(found.stiffness[1, 0, 1]))
    assert table["cyy"][1] == pytest.approx(float(found.damping[0, 1, 1]))


def test_tilting_pads_are_stiffer_against_the_grain_of_fast_vibration():
    pads = JournalBearing(
        diameter=0.2, width=0.1, relative_clearance=1e-3, shape=TiltingPads(count=4, arc=1.2)
    )
    film = Film(Lubricant(0.03), Guembel(), grid=(48, 8))
    slow, same = (rotor_coefficients(pads, LOAD, [100.0], film, whirl=w) for w in (1e-3, 1.0))
    assert not np.allclose(slow.stiffness, same.stiffness, rtol=1e-3)
    for one in (slow, same):  # pads do not couple the axes of a symmetric load
        assert abs(one.stiffness[0, 0, 1]) < 0.05 * one.stiffness[0, 0, 0]


@pytest.mark.parametrize("speed", [[0.0], [[1.0]], [np.inf]])
def test_speeds_without_a_film_are_refused(speed):
    with pytest.raises(InputError):
        rotor_coefficients(BEARING, LOAD, speed, FILM)


def scene_of(file, **more):
    data = {
        "name": "line",
        "accuracy": "given",
        "loads": {"source": "files", "files": [str(file)]},
        "results": ["journal.dynamics"],
        "shaft": {"two_point": {"beam": {}}},
        "bearings": {
            "N": {"kind": "journal", "grid": [24, 8]},
            "N2": {"kind": "journal", "grid": [24, 8],
                   "geometry": {"diameter": 2.0, "width": 1.2, "relative_clearance": 8e-4}},
        },
    }  # fmt: skip
    return make_scene(data | more)


def test_a_run_tabulates_each_bearing_and_the_line_on_them(tmp_path):
    scene = scene_of(
        cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,)),
        dynamics={"unbalance": 100.0, "points": 3},
    )
    result = lf.run(scene, out=tmp_path)
    found = result.tree["dynamics"].to_dataset()
    name = str(found["case"].values[0])
    assert result.failures == {}
    assert float(found["residual"].max()) < 1e-8
    assert float(found["unbalance_amplitude"].max()) > 0
    assert all(found[name].attrs["units"] and found[name].attrs["long_name"] for name in found)
    # each bearing has its own film
    for bearing in ("N", "N2"):
        table = pd.read_csv(result.path / f"coefficients/{name}_{bearing}.csv")
        assert len(table) == 3
        there = found.sel(bearing=bearing, case=name)
        middle = table.iloc[1]  # 0.5, 1.0, 1.5 of the mean speed
        assert middle["frequency"] == pytest.approx(float(there["mean_speed"]), rel=1e-6)
        assert middle["kxy"] == pytest.approx(float(there["stiffness"][0, 1]), rel=1e-6)
    assert not np.allclose(found["stiffness"][0], found["stiffness"][1], rtol=0.1)
    assert "Rotor dynamics" in result.report.read_text(encoding="utf-8")


def test_the_result_is_computed_only_where_it_is_asked_for():
    assert "journal.dynamics" not in make_scene({"name": "x"}).results
    assert "dynamics" not in [step.name for step in make_plan(make_scene({"name": "x"})).steps]


HUB = case(8.0, 1, steps=60)


def test_rolling_bearings_and_given_stiffness_stand_beside_films():
    balls = {"kind": "ball", "balls": 30, "ball_diameter": 0.15, "pitch_diameter": 2.0,
             "groove_radius": 0.078}  # fmt: skip
    supports = {"given": {"radial": 4e9}, "rolling": {"stiffness": "rolling"}, "rigid": {}}
    lowest = {}
    for name, support in supports.items():
        scene = make_scene(
            {
                "name": "mixed",
                "results": ["journal.dynamics"],
                "shaft": {"two_point": {"beam": {"supports": [{}, support]}}},
                "journal": {"bearings": ["N"], "grid": [24, 8]},
                "rolling": {"bearing": "N2", "geometry": balls},
            }
        )
        inputs = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
        tree = dynamics.dynamics(scene, None, inputs)
        lowest[name] = float(tree["two_point"]["natural_frequency"][2])
    assert lowest["given"] < lowest["rigid"]
    assert lowest["rolling"] < lowest["rigid"]


def test_a_shaft_that_stands_is_told():
    scene = scene_of("none.h5", loads={})
    standing = HUB.assign(speed=0 * HUB["speed"])
    inputs = {"loads": standing, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    with pytest.raises(SolverError, match="stands"):
        dynamics.dynamics(scene, None, inputs)


def test_the_command_line_writes_the_table(tmp_path):
    file = tmp_path / "film.csv"
    line = ["journal", "--diameter", "0.2", "--width", "0.1", "--relative-clearance", "1e-3"]
    line += ["--viscosity", "0.03", "--force-x", "8000", "--grid", "24", "8"]
    line += ["--coefficients", str(file), "--json"]
    answer = CliRunner().invoke(app, [*line, "--over-rpm", "500", "1500", "3"])
    assert answer.exit_code == 0, answer.output
    assert len(json.loads(answer.stdout)["rows"]) == len(pd.read_csv(file)) == 3
    for wrong in (
        ["--over-rpm", "5", "1", "3"],
        [],
        ["--over-rpm", "1", "2", "3", "--speed-rpm", "3"],
    ):
        assert isinstance(CliRunner().invoke(app, [*line, *wrong]).exception, InputError)


# --- rolling bearings --------------------------------------------------------------------------

BARRELS = {"rollers": 20, "slices": 6, "roller_diameter": 0.07, "roller_length": 0.12,
           "pitch_diameter": 1.2, "contact_angle": 0.2}  # fmt: skip
ROWS = {"rollers": 60, "roller_diameter": 0.05, "roller_length": 0.05, "pitch_diameter": 2.0}
CONES = BARRELS | {"rows": 2, "row_spacing": 0.25, "contact_angle": 0.35, "clearance": -5e-5}
ON_ROLLERS = {
    "name": "rollers",
    "accuracy": "given",
    "results": ["rolling.dynamics"],
    "shaft": {"two_point": {"beam": {"supports": [{}, {"takes_moment": True}]}}},
    "bearings": {
        "N": {"kind": "spherical", "geometry": BARRELS},
        "N2": {"kind": "roller", "geometry": CONES},
    },
}


def vibration(**keys):
    scene = make_scene(ON_ROLLERS | keys)
    inputs = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    return dynamics.dynamics(scene, None, inputs)


def test_a_run_tabulates_rolling_bearings_as_it_does_journal_bearings(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,))
    loads = {"source": "files", "files": [str(cube)]}
    asked = {"unbalance": 100.0, "points": 3}
    result = lf.run(make_scene(ON_ROLLERS | {"loads": loads, "dynamics": asked}), out=tmp_path)
    assert result.failures == {}
    found = result.tree["dynamics"].to_dataset()
    name = str(found["case"].values[0])
    assert list(found["bearing"].values) == ["N", "N2"]
    assert float(found["residual"].max()) < 1e-8
    assert float(found["unbalance_amplitude"].max()) > 0
    assert (found["damping_ratio"] > 0).all()
    assert (found["damping_ratio"] < 0.5 * 0.012).all()  # at most half of what the contacts lose
    for bearing in ("N", "N2"):
        table = pd.read_csv(result.path / f"coefficients/{name}_{bearing}.csv")
        assert list(table)[:5] == ["frequency", "kxx", "kxy", "kyx", "kyy"]
        there = found.sel(bearing=bearing, case=name)
        assert table["kxy"][1] == pytest.approx(float(there["stiffness"][0, 1]), rel=1e-6)
        # the steel loses the same in every cycle
        assert table["cxx"][0] / table["cxx"][2] == pytest.approx(3.0, rel=0.05)
    assert "Rotor dynamics" in result.report.read_text(encoding="utf-8")


def test_dry_rollers_without_loss_are_the_springs_that_a_shaft_on_films_has_of_them():
    geometry = {"bearings": {
        "N": {"kind": "journal", "grid": [24, 8]}, "N2": {"kind": "roller", "geometry": CONES},
    }}  # fmt: skip
    line = {"two_point": {"beam": {"supports": [
        {"radial": 4e9}, {"stiffness": "rolling", "takes_moment": True}]}}}  # fmt: skip
    films, rollers = (
        vibration(**geometry, shaft=line, results=[result], **more)
        for result, more in (
            ("journal.dynamics", {}),
            ("rolling.dynamics", {"dynamics": {"contact_model": "dry", "loss": 0.0}}),
        )
    )
    assert "N" not in rollers.children
    both = vibration(
        **geometry, shaft=line, results=["journal.dynamics", "rolling.dynamics"],
        dynamics={"contact_model": "dry", "loss": 0.0},
    )  # fmt: skip
    for name in ("natural_frequency", "damping_ratio"):
        np.testing.assert_allclose(
            both["two_point"][name], films["two_point"][name], rtol=1e-6, atol=1e-9
        )


def test_films_and_the_support_change_what_rollers_hold():
    wet, dry = (vibration(dynamics={"contact_model": model}) for model in ("film", "dry"))
    k = [tree["N"]["stiffness"].values[0, 0, 0] for tree in (wet, dry)]
    assert 0.9 * k[1] < k[0] < k[1]
    assert dict(wet["N2"].sizes)["dof"] == 4
    free = vibration(shaft={"two_point": {"beam": {}}})
    assert dict(free["N2"].sizes)["dof"] == 2


def test_a_mode_has_the_loss_of_the_steel_at_its_own_frequency():
    """A rigid disc on springs that lose ψ in each cycle: ζ = ψ/2 however slow the shaft turns."""
    psi, k, mass = 0.01, 2e9 * np.diag([1.0, 4.0]), 1e5
    line = ShaftLine(Beam((ShaftSection(2.0),)), 0.2, (Disc(0.1, mass),), density=0.0)

    def supports(frequency):
        return [LineSupport(0.1, k, psi * k / frequency),
                LineSupport(0.0, 1e-3 * np.eye(2)), LineSupport(0.2, 1e-3 * np.eye(2))]  # fmt: skip

    found = modes(line, supports, speed=1.2, count=2)
    natural = np.sqrt(np.diag(k) / mass)
    np.testing.assert_allclose(found["natural_frequency"], natural, rtol=1e-4)
    np.testing.assert_allclose(found["damping_ratio"], psi / 2, rtol=1e-4)
    assert found.attrs["largest_growth"] == pytest.approx(-psi / 2 * natural[0], rel=1e-4)
    # a damper of the shaft's own frequency would not let it swing at all
    assert not (modes(line, supports(1.2), 1.2, count=2)["damping_ratio"] < 0.5).any()


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"results": ["rolling.dynamics", "journal.dynamics"],
          "bearings": {"N": [{"kind": "journal"}, {"kind": "spherical", "geometry": BARRELS}]}},
         "N has a journal and a rolling bearing"),
        ({"shaft": {"moment": {}}, "bearings": {"M": {"kind": "three-row", "geometry": {
            "support": ROWS, "retaining": ROWS, "radial": ROWS}}}}, 'contact_model = "film"'),
        ({"shaft": {"two_point": {}, "yaw": {}}, "bearings": {"Y": {"kind": "ball", "geometry": {
            "balls": 60, "ball_diameter": 0.06, "pitch_diameter": 2.0, "groove_radius": 0.0312},
            "oscillation": {"amplitude": 0.5, "frequency": 0.01}}}}, "Y swings"),
    ],
)  # fmt: skip
def test_rolling_bearings_that_cannot_be_tabulated_are_named(keys, words):
    with pytest.raises(InputError, match=words):
        make_scene(ON_ROLLERS | keys)


def test_the_command_line_writes_the_table_of_a_rolling_bearing(tmp_path):
    file = tmp_path / "balls.csv"
    line = ["rolling", "--balls=60", "--ball-diameter=0.06", "--pitch-diameter=2"]
    line += ["--groove-radius=0.0315", "--force-z=1e6", f"--coefficients={file}", "--json"]
    rows = []
    for more in ([], ["--loss=0.02"], ["--oil=lgep-2"]):
        answer = CliRunner().invoke(app, [*line, "--over-rpm", "6", "12", "3", *more])
        assert answer.exit_code == 0, answer.output
        rows.append(json.loads(answer.stdout)["rows"])
        assert len(rows[-1]) == len(pd.read_csv(file)) == 3
    dry, lossy, wet = (one[0] for one in rows)
    assert lossy["cxx"] == pytest.approx(2 * dry["cxx"])
    assert wet["kxx"] < dry["kxx"] == lossy["kxx"]
    for wrong in ([], ["--speed-rpm=6", "--hardness=600"], ["--speed-rpm=6", "--loss=2"]):
        assert isinstance(CliRunner().invoke(app, [*line, *wrong]).exception, InputError)


def test_the_page_tells_stiffness_in_the_frame_of_the_shaft_whose_z_points_up():
    dims, entries = ("case", "bearing", "dof", "along"), [[[[1e9, 2e9], [3e9, 4e9]]]]
    coords = {"case": ["one"], "bearing": ["N"], "dof": ["x", "y"], "along": ["x", "y"]}
    values = {"stiffness": (dims, entries), "damping": (dims, entries), "whirl": 1.0}
    data = xr.Dataset(values, coords)
    [table] = dynamics_section(data).tables
    assert table.heads[1:5] == ["K zz, GN/m", "K zy, GN/m", "K yz, GN/m", "K yy, GN/m"]
    assert table.rows[0][1:5] == ["1", "-2", "-3", "4"]
