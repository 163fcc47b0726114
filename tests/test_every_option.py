"""Every option of every command does something, or is refused by name.

The walk takes each option that a command has, states another value beside the arguments of a few
ordinary calls, and compares what is printed, written or handed to the runner.
"""

import hashlib
import re
from contextlib import nullcontext

import pytest
import typer.main
from synthetic import cube_file

from loadflow.cli import main
from loadflow.cli.base import app
from loadflow.cube import iter_cases, make_cube, open_cube, save_cube
from loadflow.journal import Film
from loadflow.scene.scene import Scene
from loadflow.shaft import TwoPoint, bearing_loads

COMMAND = typer.main.get_command(app)

JOURNAL = ["--diameter=3", "--width=2.25", "--relative-clearance=5e-4", "--force-x=1e6",
           "--speed-rpm=12", "--grid", "24", "8"]  # fmt: skip
BALLS = ["--balls=30", "--ball-diameter=0.06", "--pitch-diameter=2", "--groove-radius=0.0315",
         "--force-z=1e6", "--moment-y=1e6"]  # fmt: skip
PADS = 'geometry.shape={kind="tilting pads", count=2, arc=2.8}'
COLLAR = ["--pads=8", "--inner-radius=0.8", "--outer-radius=1.2", "--pad-angle-deg=40",
          "--viscosity=0.1", "--force=5e5", "--speed-rpm=12", "--grid", "12", "6"]  # fmt: skip
CONES = ["--half-angle-deg=28.6", "--slant", "1.59", "2.59", "--clearance=2e-4", "--distance=3.2",
         "--viscosity=0.2", "--force-x=1e5", "--speed-rpm=12", "--grid", "16", "6"]  # fmt: skip

FEW = ["--classes", "3", "2"]
"""So few that a class has more samples than it keeps, even in the shortest series."""

CALLS = {
    "wind": {"one": ["12"]},
    "journal": {
        "plain": [*JOURNAL, "--viscosity=0.05"],
        "warm": [*JOURNAL, "--oil=mineral-vg-320", "--edge-pressure=5e5"],
        "grooves": [*JOURNAL, "--viscosity=0.05", "--groove-angle-deg=90", "--groove-length=1.5",
                    "--edge-pressure=1e5", "--mixing-constant=5e4", "--groove-arc-deg=12"],
        "table of pads": [*JOURNAL, "--viscosity=0.05", "--set", PADS, "--coefficients=OUT/p.csv"],
    },
    "rolling": {
        "plain": BALLS,
        "rings": [*BALLS, "--outer-ring", "0.1", "0.15", "1.1", "--speed-rpm=10"],
        "life": [*BALLS, "--speed-rpm=10", "--oil=lgep-2"],
        "scene": ["--scene=SCENE", "--force-x=1e5"],
        "table": [*BALLS, "--speed-rpm=10", "--coefficients=OUT/k.csv", "--oil=lgep-2"],
    },
    "thrust": {"taper": [*COLLAR, "--taper=1e-4"], "step": [*COLLAR, "--step=1e-4"]},
    "cone": {"rings": CONES, "segments": [*CONES, "--pads=6", "--taper=8e-5"]},
    "friction-rig": {
        "rollers": ["--speed-rpm=1000"],
        "journal": ["--speed-rpm=1000", "--arrangement=journal"],
        "straight": ["--speed-rpm=1000", "--arrangement=straight"],
    },
    "seeds": {
        "printed": ["HUB"],
        "page": ["TWO", "-o", "OUT/seeds.html", "--variable=hub_force.y"],
    },
    "statistics": {"hub": ["HUB"], "bearings": ["HUB", "--bearings"]},
    "reduce": {
        "histogram": ["ONE", "-o", "OUT/x", "--pick=random", "--bearing=N", *FEW],
        "stationary": ["ONE", "-o", "OUT/x", "--method=stationary"],
        "periodic": ["ONE", "-o", "OUT/x", "--method=periodic", "--bounds", "0.05", "0.3",
                     "--bearing=N"],
        "of bearings": ["FORCE", "-o", "OUT/x", "--bearing=N", *FEW],
    },
    "lifetime": {
        "hub": ["HUB", "-o", "OUT/x"],
        "given": ["FORCES", "-o", "OUT/x", "--weights=given"],
    },
    "convert": {"cube": ["HUB", "-o", "OUT/x.h5"], "list": ["HUB", "--list"]},
    "loads": {"short": ["-o", "OUT/x.h5", "--wind-speed=12", "--wind-speed=14", "--duration=3",
                        "--step=0.1", "--rung=tables"]},
    "plan": {"files": ["SCENE", "--out=OUT"]},
    "run": {"files": ["SCENE", "--out=OUT"], "cluster": ["SCENE", "--scheduler=tcp://none:1"]},
    "compare": {"files": ["SCENE", "--out=OUT"]},
    "design": {"keys": ["SCENE", "--candidate=own-journal"], "crown": ["SCENE", "--crown"]},
}  # fmt: skip
"""Ordinary calls of each command."""

READING = {
    "cases": ["LIST"], "pattern": ["{dlc}"], "channels": ["speed=Omega"],
    "gauge_distance": ["1.5"], "frame": ["rotating"],
}  # fmt: skip
RUNS = READING | {
    "loads": ["FORCES"], "out_folder": ["OTHER"], "name": ["other"], "workers": ["1"],
    "scheduler": ["tcp://none:2"],
}  # fmt: skip
VALUES = {
    "wind": {"category": ["A"], "wind_class": ["II"], "diameter": ["100"], "hub_height": ["50"]},
    "journal": {
        "diameter": ["2.9"], "width": ["2"], "relative_clearance": ["6e-4"], "viscosity": ["0.06"],
        "oil": ["iso-vg-220"], "inlet_temperature_c": ["50"], "transfer": ["500"],
        "force_x": ["1.1e6"], "force_y": ["2e5"], "speed_rpm": ["13"], "series": ["SERIES"],
        "edge_pressure": ["2e5"], "law": ["guembel"], "mixing_constant": ["1e5"],
        "cavitation_pressure": ["1e4"], "rung": ["reduced"], "inlet": ["none", "widest gap"],
        "scene": ["SCENE"], "sets": ["geometry.width = 2.0"], "grid": ["36", "12"],
        "groove_angle_deg": ["80"], "groove_arc_deg": ["20"], "groove_length": ["1"],
        "supply_pressure": ["3e5"], "coefficients": ["OUT/k.csv"], "over_rpm": ["6", "12", "2"],
        "whirl": ["2"],
    },
    "rolling": {
        "balls": ["50"], "ball_diameter": ["0.059"], "pitch_diameter": ["2.1"],
        "groove_radius": ["0.032"], "contact_angle_deg": ["40"], "rows": ["2"],
        "row_spacing": ["0.1"], "clearance": ["1e-5"], "hardness": ["600"],
        "life_hardness_factor": ["0.85"],
        "inner_ring": ["0.1", "0.15", "0.9"], "outer_ring": ["0.1", "0.16", "1.1"],
        "wall": ["0.05", "0.5"], "scene": ["SCENE"], "bearing": ["N2"], "force_x": ["2e5"],
        "force_y": ["1e5"], "force_z": ["1.1e6"], "moment_x": ["1e5"], "moment_y": ["9e5"],
        "speed_rpm": ["11"], "oil": ["lgwm-2"], "temperature_c": ["60"],
        "cleanliness": ["grease, severe contamination"],
        "coefficients": ["OUT/other.csv"], "over_rpm": ["6", "12", "2"], "loss": ["0.02"],
        "whirl": ["2"],
    },
    "thrust": {
        "force": ["6e5"], "speed_rpm": ["13"], "pads": ["7"], "inner_radius": ["0.82"],
        "outer_radius": ["1.25"], "pad_angle_deg": ["38"], "taper": ["1.1e-4"], "wedge": ["0.6"],
        "step": ["1.2e-4"], "pivot": ["0.6"], "play": ["5e-4"], "viscosity": ["0.12"],
        "edge_pressure": ["2e5"], "grid": ["16", "8"], "scene": ["SCENE"], "bearing": ["N"],
    },
    "cone": {
        "speed_rpm": ["13"], "force_x": ["1.2e5"], "force_y": ["1e4"], "force_z": ["1e4"],
        "moment_x": ["1e4"], "moment_y": ["1e4"], "half_angle_deg": ["30"], "slant": ["1.6", "2.6"],
        "clearance": ["2.2e-4"], "distance": ["3"], "arrangement": ["X"], "pads": ["5"],
        "pad_angle_deg": ["50"], "taper": ["1e-4"], "wedge": ["0.6"], "viscosity": ["0.25"],
        "edge_pressure": ["2e5"], "grid": ["20", "8"], "scene": ["SCENE"], "bearing": ["N"],
    },
    "friction-rig": {
        "speed_rpm": ["1500"], "arrangement": ["straight"], "stage": ["film"],
        "oil": ["iso-vg-220"], "temperature_c": ["80"], "load": ["3e3"],
        "pin": ["50e-3", "18e-3", "1e-3"], "seal_force": ["5"], "thrust_share": ["0.04"],
        "measured": ["RIG"],
    },
    "seeds": {
        "variable": ["hub_moment.y"], "alpha": ["0.99"], "method": ["as-printed"],
        "margin": ["0.2"], "uncertainty": ["0.2"], "output": ["OUT/other.html"],
        "turbine": ["iea-15mw"],
    },
    "statistics": {
        "variable": ["hub_moment.y"], "output": ["OUT/other"], "turbine": ["iea-15mw"],
    },
    "reduce": {
        "output": ["OUT/other"], "method": ["stationary", "histogram"], "size": ["0.2"],
        "pick": ["envelope", "random"], "rounding": ["total", "nearest"], "classes": ["4", "4"],
        "phase": ["operation"],
        "between": ["0", "20"], "grid": ["cube"], "seed": ["5"], "bounds": ["0.02", "0.2"],
        "additional": ["1"], "order": ["1"], "scene": ["SCENE"], "bearing": ["N2"],
        "turbine": ["iea-15mw"],
    },
    "lifetime": {
        "output": ["OUT/other"], "bearing": ["N2"], "years": ["25"], "return_period": ["20"],
        "exponent": ["6"], "weights": ["given", "rayleigh"], "wind_class": ["II"],
        "per_year": ["3.1=10"], "weibull_shape": ["1.8"], "tail": ["peaks"], "block": ["20"],
        "turbine": ["iea-15mw"],
    },
    "convert": READING | {"output": ["OUT/y.h5"], "turbine": ["iea-15mw"], "step": ["0.5"]},
    "loads": {
        "output": ["OUT/y.h5"], "wind_speed": ["14"], "turbine": ["iea-15mw"], "dlc": ["1.3"],
        "seed": ["2"], "duration": ["4"], "step": ["0.05"], "category": ["A"],
        "wind_class": ["II"], "rung": ["bem"],
    },
    "plan": {name: RUNS[name] for name in RUNS if name not in ("name", "workers", "scheduler")},
    "run": RUNS,
    "compare": RUNS | {"candidate": ["own-journal"], "starts": ["500"]},
    "design": RUNS | {
        "candidate": ["own-rolling"], "key": ["geometry.diameter=2:3"], "margin": ["1.2"],
    },
}  # fmt: skip
"""Another value of each option that is no switch; several: the first that differs."""

HEAD = (
    "time [s], speed [rpm], hub_force_x [kN], hub_force_y [kN], hub_force_z [kN], "
    "hub_moment_x [kN m], hub_moment_y [kN m], hub_moment_z [kN m]"
)
SCENE = """
name = "walk"
accuracy = "given"
loads = { source = "files", files = ["FORCES"] }
shaft = { two_point = {}, moment = {} }
[bearings.N]
kind = "roller"
geometry = { rollers = 20, roller_diameter = 0.05, roller_length = 0.05, pitch_diameter = 1.0, \
slices = 6 }
[bearings.N2]
kind = "journal"
grid = [24, 8]
geometry = { diameter = 3.0, width = 2.25, relative_clearance = 5e-4 }
shell = { kind = "local", compliance = 1e-12 }
"""


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    """Files of the calls by the words that stand for them."""
    folder = tmp_path_factory.mktemp("options")
    hub = cube_file(folder / "hub.h5", wind_speeds=(8.0, 9.0), seeds=(1, 2), steps=200)
    parts = []
    for _, series in iter_cases(open_cube(hub)):
        loads = [
            series[name].transpose("axis", "time").values for name in ("hub_force", "hub_moment")
        ]
        found = bearing_loads(TwoPoint(), *loads).drop_vars("time", errors="ignore")
        parts.append(series.drop_vars(["hub_force", "hub_moment"]).assign(force=found["force"]))
    forces = save_cube(make_cube(parts), folder / "forces.h5")
    one = cube_file(folder / "one.h5", wind_speeds=(8.0,), seeds=(1,), steps=200)
    two = cube_file(folder / "two.h5", wind_speeds=(8.0,), seeds=(1, 2), steps=200)
    force = save_cube(make_cube(parts[:1]), folder / "force.h5")
    (folder / "scene.toml").write_text(SCENE.replace("FORCES", str(hub)), encoding="utf-8")
    (folder / "list.csv").write_text("file,dlc,wind_speed,seed\nhub.h5,1.2,8,1\n", encoding="utf-8")
    table = folder / "dlc1.1_v8_s1.csv"
    rows = [f"{0.1 * k:g}, 9, 350, 0, -1070, 2000, 500, 300" for k in range(20)]
    table.write_text("\n".join([HEAD, *rows]), encoding="utf-8")
    rig = folder / "rig.csv"
    rig.write_text("rpm,force,velocity\n1000,4,2\n1000,-4,-2\n", encoding="utf-8")
    return {"HUB": hub, "RIG": rig, "ONE": one, "TWO": two, "FORCES": forces, "FORCE": force,
            "TABLE": table, "SCENE": folder / "scene.toml", "LIST": folder / "list.csv",
            "SERIES": folder / "none.txt"}  # fmt: skip


@pytest.fixture
def undrawn(monkeypatch):
    """No figures: to draw takes most of the time, and what they show stands in tables beside."""
    for draw in ("to_svg", "to_png"):
        monkeypatch.setattr(f"loadflow.report.page.{draw}", lambda figure: "drawn")


@pytest.fixture
def coarse(monkeypatch):
    """Films of the rig, which has no option for their cells, on few of them."""
    monkeypatch.setattr(
        "loadflow.studies.one_bearing.crank_rig.Film",
        lambda *told, grid, **more: Film(*told, grid=(24, 8), **more),
    )


@pytest.fixture
def call(words, tmp_path, capsys, monkeypatch, undrawn, coarse):
    """Arguments of a command → exit code, what it says, and a fingerprint of all that it did."""
    handed = []

    def taken(*arguments, **keywords):
        rest = [one.enter_result if isinstance(one, nullcontext) else one for one in arguments]
        (scene,) = (one for one in rest if isinstance(one, Scene))
        rest.remove(scene)
        told = {k: v for k, v in keywords.items() if k not in ("progress", "say")}
        handed.append((scene.model_dump_json(), rest, sorted(told.items(), key=str)))
        raise SystemExit(0)

    monkeypatch.setattr("loadflow.running.executor.executor", lambda *told: nullcontext(told))
    for place in ("runner.run_on", "comparison.compare", "designing.design", "crowning.crown"):
        monkeypatch.setattr(f"loadflow.running.{place}", taken)
    number = 0

    def run(command, arguments):
        nonlocal number
        number += 1
        out = tmp_path / str(number)
        out.mkdir()
        said = [_filled(one, words | {"OUT": out}) for one in arguments]
        handed.clear()
        capsys.readouterr()
        with pytest.raises(SystemExit) as stop:
            main([command, *said])
        printed = capsys.readouterr()
        told = hashlib.sha256()
        for text in (printed.out, printed.err, repr(handed)):
            told.update(CLOCK.sub("", text.replace(str(out), "OUT")).encode())
        for file in sorted(out.rglob("*")):
            told.update(str(file.relative_to(out)).encode())
        for file in [
            f for f in sorted(out.rglob("*")) if f.suffix in (".html", ".txt", ".h5", ".csv")
        ]:
            told.update(file.read_bytes())
        return stop.value.code or 0, printed.err, told.hexdigest()

    return run


CLOCK = re.compile(r"(, about )?\d+:\d\d( left)?")
"""How long it took and will take."""


def _filled(text, words):
    for word, file in words.items():
        text = text.replace(word, str(file))
    return text


def without(arguments, option):
    """The arguments without an option and its values."""
    kept, skip = [], 0
    for one in arguments:
        if one.split("=")[0] in (*option.opts, *option.secondary_opts):
            skip = 0 if "=" in one or option.is_flag else option.nargs
        elif skip:
            skip -= 1
        else:
            kept.append(one)
    return kept


def stated(option, values):
    """Ways of stating an option with another value."""
    if option.is_flag:
        yield [option.opts[0]]
    elif option.nargs > 1:
        yield [option.opts[0], *values]
    else:
        yield from ([option.opts[0], value] for value in values)


def options(command):
    return [one for one in COMMAND.commands[command].params
            if one.param_type_name == "option" and one.name != "help"]  # fmt: skip


FOLDER = {("plan", "out_folder"), *(("lifetime", n) for n in ("return_period", "tail", "block"))}
"""Where finished parts are looked for, of which there are none here; and what only tails of series
much longer than these have (`tests/reduction/test_tails.py`)."""

ELSEWHERE = {"as_json", "overwrite", "verbose", "profile", "measure", "crown", "names"}
"""Switches of how a command prints, works on or looks; tests of the commands have them."""


KEYS = {"law": "cavitation"}
"""Options whose key has another name than they have, units apart."""


@pytest.mark.parametrize("command", CALLS)
def test_every_option_has_a_walk(command):
    known = {one.name for one in options(command) if not one.is_flag}
    assert known == set(VALUES[command])


@pytest.mark.parametrize(
    ("command", "kind"), [(command, kind) for command, kinds in CALLS.items() for kind in kinds]
)
def test_every_option_does_something_or_is_refused(command, kind, call):
    arguments = CALLS[command][kind]
    code, said, usual = call(command, arguments)
    assert code == 0 or kind == "cluster", said
    assert call(command, arguments)[2] == usual  # the same again
    silent = []
    for option in options(command):
        if option.name in ELSEWHERE or (command, option.name) in FOLDER:
            continue
        for more in stated(option, VALUES[command].get(option.name, ())):
            if "=".join(more) in arguments:
                break  # the value that is there, of an option that has no other here
            code, said, found = call(command, [*without(arguments, option), *more])
            if found != usual:
                key = KEYS.get(option.name, option.name.removesuffix("_deg").removesuffix("_c"))
                named = code != 2 or any(name in said for name in (*option.opts, key))
                assert named or re.search("--|=|no variable", said), (option.name, said)
                break
        else:
            silent.append(option.name)
    assert silent == []


@pytest.mark.parametrize(
    "command",
    ["run", "compare", "design", "plan", "loads", "convert", "statistics", "seeds", "reduce",
     "lifetime"],
)  # fmt: skip
def test_what_works_long_tells_how_it_goes(command):
    assert "verbose" in {one.name for one in options(command)}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["convert", "TABLE", "--overwrite", "-o", "OUT/x.h5"], "dlc1.1_v8_s1.csv: 20 samples"),
        (["statistics", "HUB"], "dlc1.1_v8_s1: 200 samples"),
        (["seeds", "HUB", "--variable=speed"], "DLC 1.1, 9 m/s, speed: 2 seeds tested"),
        (["reduce", "HUB", "-o", "OUT"], "dlc1.1_v9_s2, bearing N2: 200 samples"),
        (["lifetime", "HUB", "-o", "OUT"], "dlc1.1_v9_s2, bearing N2: 200 samples"),
    ],
)
def test_verbose_names_each_part_of_the_work(arguments, told, words, tmp_path, capsys, undrawn):
    said = [_filled(one, words | {"OUT": tmp_path}) for one in arguments]
    for more, found in (([], False), (["-v"], True)):
        with pytest.raises(SystemExit):
            main([*said, *more])
        assert (told in capsys.readouterr().err) == found
