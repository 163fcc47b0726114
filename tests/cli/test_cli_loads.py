"""Load files through the command line: what names say, channels, gauges, optional channels."""

import json

import numpy as np
import pytest
import xarray as xr

from loadflow.cli import main
from loadflow.cube import iter_cases, open_cube

HEADING = ["time [s]", "speed [rad/s]"]
HEADING += [f"hub_force_{axis} [kN]" for axis in "xyz"]
HEADING += [f"hub_moment_{axis} [kNm]" for axis in "xyz"]

SCENE = """
name = "files"
results = ["loads.statistics", "reduction.histogram", "rolling.loads"]
[shaft.moment]
[loads]
source = "files"
"""


def write(path, heading=HEADING, n=300, dt=0.1, seed=1, idle=0):
    """A rotor of 1069 kN that turns at 1.2 rad/s, and idles in the last `idle` steps."""
    rng = np.random.default_rng(seed)
    time = dt * np.arange(n)
    speed = np.where(np.arange(n) < n - idle, 1.2, -0.005)
    waves = rng.normal(size=(6, n))
    means = np.array([600.0, 5.0, -1069.0, 3000.0, 500.0, -100.0])
    sizes = np.array([20.0, 10.0, 10.0, 50.0, 300.0, 300.0])
    values = np.column_stack([time, speed, (means[:, None] + sizes[:, None] * waves).T])
    rows = [",".join(f"{x:.7g}" for x in row) for row in values]
    path.write_text("\n".join([",".join(heading), *rows]) + "\n")
    return path


def call(capsys, *arguments):
    """Run in this process; return exit code, output and errors."""
    try:
        code = main([str(a) for a in arguments]) or 0
    except SystemExit as stop:
        code = stop.code or 0
    told = capsys.readouterr()
    return code, told.out, told.err


def test_the_list_shows_what_names_say_of_files_that_need_not_be_there(capsys):
    names = ["x/dlc12_wsp08_wdir000_s1001.sel", "IEA15_DLC1.1_0_ws12.0_seed3.outb", "run_7.csv"]
    code, out, _ = call(capsys, "convert", "--list", *names, "--json")
    assert code == 0
    listed = json.loads(out)
    assert [list(entry) for entry in listed] == [["file", "dlc", "wind_speed", "seed"]] * 3
    assert [tuple(entry.values()) for entry in listed] == [
        (names[0], "1.2", 8.0, 1001),
        (names[1], "1.1", 12.0, 3),
        (names[2], None, None, None),
    ]
    code, out, _ = call(capsys, "convert", "--list", *names)
    assert code == 0
    assert "1001" in out


def test_a_pattern_shows_in_the_list_before_it_is_used(capsys, tmp_path):
    file = write(tmp_path / "run_DLC1.3_10.5ms_07.csv")
    pattern = "run_{dlc}_{wind_speed}ms_{seed}"
    _, out, _ = call(capsys, "convert", "--list", file, "--pattern", pattern, "--json")
    assert json.loads(out)[0]["wind_speed"] == 10.5
    target = tmp_path / "loads.h5"
    assert call(capsys, "convert", file, "--pattern", pattern, "-o", target)[0] == 0
    assert open_cube(target).case.values.tolist() == ["dlc1.3_v10.5_s7"]


def test_without_output_or_list_the_option_is_named(capsys, tmp_path):
    code, _, err = call(capsys, "convert", write(tmp_path / "dlc11_v8_s1.csv"))
    assert code == 2
    assert "--output is missing" in " ".join(err.split())


def test_channels_of_other_names_come_from_a_file_or_the_command_line(capsys, tmp_path):
    heading = [h.replace("hub_force_y", "Fy right").replace("speed", "Omega") for h in HEADING]
    file = write(tmp_path / "dlc11_v8_s1.csv", heading)
    table = tmp_path / "channels.toml"
    table.write_text('speed = "Omega"\nhub_force_y = "-Fy right"\n')
    for i, channels in enumerate((table, "speed=Omega, hub_force_y=-Fy right")):
        target = tmp_path / f"loads{i}.h5"
        assert call(capsys, "convert", file, "--channels", channels, "-o", target)[0] == 0
    first, second = (open_cube(tmp_path / f"loads{i}.h5").load() for i in (0, 1))
    xr.testing.assert_equal(first, second)
    assert -6 < float(first.hub_force.sel(axis="y").mean()) / 1e3 < -4
    code, _, err = call(capsys, "convert", file, "-o", tmp_path / "no.h5")
    assert code == 2
    assert "2 channels are missing" in " ".join(err.split())


def test_moments_of_a_gauge_are_moved_to_the_apex(capsys, tmp_path):
    heading = [h.replace("hub_moment_y", "gauge_moment_y") for h in HEADING]
    heading = [h.replace("hub_moment_z", "gauge_moment_z") for h in heading]
    file = write(tmp_path / "dlc11_v8_s1.csv", heading)
    options = ["--gauge-distance", 2.0, "-o", tmp_path / "loads.h5"]
    assert call(capsys, "convert", file, *options)[0] == 0
    moment = open_cube(tmp_path / "loads.h5").hub_moment.mean(("case", "time"))
    assert float(moment.sel(axis="y")) == pytest.approx((500 + 2 * 1069) * 1e3, rel=0.05)


def test_a_folder_is_converted_and_doubts_are_told(capsys, tmp_path):
    write(tmp_path / "dlc11_v8_s1.csv")
    write(tmp_path / "dlc11_v8_s2.csv", seed=2, idle=135)
    (tmp_path / "notes.csv").write_text("a,b\n1,2\n")
    code, out, _ = call(
        capsys, "convert", tmp_path, "--turbine", "iea-15mw", "-o", tmp_path / "x.h5"
    )
    assert code == 0
    text = " ".join(out.split())
    assert "2 load cases" in text
    assert "notes.csv" in text
    assert "hub_force z is -1069 kN; the rotor of IEA 15 MW" in text.replace("IEA-15", "IEA 15")
    shares = [float(case["standing_share"]) for _, case in iter_cases(open_cube(tmp_path / "x.h5"))]
    assert shares == pytest.approx([0.0, 0.45])


def test_a_run_needs_nothing_but_speed_and_loads(capsys, tmp_path):
    """Pitch, azimuth and wind are optional through to the report; doubts and pauses are told."""
    heading = [h.replace("speed", "Omega") for h in HEADING]
    for seed in (1, 2):
        write(tmp_path / f"own_{seed}.csv", heading, seed=seed, idle=100 * (seed - 1))
    (tmp_path / "cases.txt").write_text(
        "file,dlc,wind_speed,seed\nown_1.csv,1.1,8,1\nown_2.csv,DLC 2.3 EOG,8,1\n"
    )
    (tmp_path / "channels.toml").write_text('speed = "Omega"\n')
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    loads = ["--loads", f"{tmp_path}/own_*.csv", "--cases", tmp_path / "cases.txt"]
    loads += ["--channels", tmp_path / "channels.toml", "--workers", 1]
    code, out, err = call(capsys, "plan", scene, *loads[:-2], "--json")
    assert json.loads(out)["cases"] == ["dlc1.1_v8_s1", "dlc2.3_v8_s1"], err
    code, out, err = call(capsys, "run", scene, *loads, "--out", tmp_path / "runs", "--json")
    assert code == 0, err
    assert json.loads(out)["failures"] == {}
    result = open_cube(tmp_path / "runs" / "files" / "result.h5")
    shares = result["loads"]["standing_share"]
    assert shares.values == pytest.approx([0.0, 1 / 3], abs=0.01)
    assert result["loads"]["dlc"].values.tolist() == ["1.1", "2.3"]
    assert (tmp_path / "runs" / "files" / "report.html").stat().st_size > 10_000
    # the same from a scene that says it all, relative to where it lies
    scene.write_text(
        SCENE + 'files = ["own_*.csv"]\ncases = "cases.txt"\nchannels = "channels.toml"\n'
    )
    code, out, err = call(capsys, "plan", scene, "--json")
    assert json.loads(out)["cases"] == ["dlc1.1_v8_s1", "dlc2.3_v8_s1"], err


def test_doubts_of_a_run_are_warnings_and_in_the_report(capsys, tmp_path):
    write(tmp_path / "dlc11_v8_s1.csv", [h.replace("[kN]", "[N]") for h in HEADING])
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + f'files = ["{tmp_path}/*.csv"]\n')
    run = ["run", scene, "--out", tmp_path / "runs", "--workers", 1, "--json"]
    code, out, _ = call(capsys, *run)
    assert code == 0
    [doubt] = [w for w in json.loads(out)["warnings"] if w.startswith("loads")]
    assert "the mean of hub_force z is -1.07 kN" in doubt
    assert "a factor of 0.001" in doubt
    page = (tmp_path / "runs" / "files" / "report.html").read_text()
    assert "Doubtful series" in page
    assert "is the unit right" in page


@pytest.mark.parametrize(
    ("loads", "message"),
    [
        ('channels = "gone.toml"', "gone.toml: cannot read the channels"),
        ("channels = {spede = 'Omega'}", "'spede' is nothing the cube holds"),
        ('frame = "turning"', "loads.frame = 'turning': must be 'auto', 'fixed' or 'rotating'"),
        ("gauge_distance = 1e9", "loads.gauge_distance = 1000000000.0: must be less than"),
    ],
)
def test_bad_keys_of_files_are_refused_with_key_and_range(capsys, tmp_path, loads, message):
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE + loads + "\n")
    code, _, err = call(capsys, "scene", scene)
    assert code == 2
    assert message in " ".join(err.split())


def test_a_folder_of_load_files_with_a_cube_among_them_is_one_of_load_files(capsys, tmp_path):
    write(tmp_path / "dlc11_v8_s1.csv")
    for name in ("first.h5", "second.h5"):
        code, out, _ = call(capsys, "convert", tmp_path, "-o", tmp_path / name)
        assert code == 0
        assert "1 load case" in out
