"""Which case a file holds, and joining files into a cube."""

import numpy as np
import pytest
import xarray as xr
from openfast_files import channels, write_outb

from loadflow.cube import check_cube
from loadflow.errors import InputError
from loadflow.readers import read_loads
from loadflow.readers.names import label_from_name, plain_dlc, read_case_list


def put(folder, *names, n=100, **options):
    folder.mkdir(parents=True, exist_ok=True)
    for i, name in enumerate(names):
        write_outb(folder / name, channels(n=n, seed=i, **options))
    return folder


@pytest.mark.parametrize(
    ("stem", "expected"),
    [
        ("nrel5mw_dlc11_v04_s1", ("1.1", 4.0, 1)),
        ("nrel5mw_steady_v12", ("steady", 12.0, None)),
        ("nrel5mw_startup_v12", ("startup", 12.0, None)),
        ("dlc1.1_v4_s12", ("1.1", 4.0, 12)),
        ("DLC6.2a_ws11.4_seed3", ("6.2a", 11.4, 3)),
        ("steady_v11.4_s1", ("steady", 11.4, 1)),
        ("IEA-15-240_dlc13_v25_s006", ("1.3", 25.0, 6)),
        ("whatever", (None, None, None)),
    ],
)
def test_default_pattern_understands_usual_names(tmp_path, stem, expected):
    label = label_from_name(tmp_path / f"{stem}.outb")
    assert (label.dlc, label.wind_speed, label.seed) == expected


@pytest.mark.parametrize(
    ("pattern", "stem"),
    [
        ("run_{dlc}_{wind_speed}ms_{seed}", "run_DLC1.3_10.5ms_07"),
        ("*-{dlc}-U{wind_speed}-R{seed}", "any-13-U10.5-R7"),
        (r"^(?P<dlc>\d\d)x(?P<wind_speed>[\d.]+)x(?P<seed>\d)$", "13x10.5x7"),
    ],
)
def test_patterns_and_templates(tmp_path, pattern, stem):
    label = label_from_name(tmp_path / f"{stem}.out", pattern)
    assert (label.dlc, label.wind_speed, label.seed) == ("1.3", 10.5, 7)


@pytest.mark.parametrize("pattern", ["no_field", "(?P<dlc>", "(?P<speed>1)", "{dlc}_{dlc}"])
def test_malformed_patterns_are_refused(tmp_path, pattern):
    with pytest.raises(InputError, match="pattern"):
        label_from_name(tmp_path / "a.out", pattern)


def test_pattern_that_does_not_fit_is_refused(tmp_path):
    with pytest.raises(InputError, match="does not fit"):
        label_from_name(tmp_path / "a.out", "{dlc}_{seed}")


def test_load_cases_have_one_form():
    assert [plain_dlc(x) for x in ("11", "1.1", "dlc11", "DLC 1.1", "6.2A", "shutdown")] == [
        "1.1",
        "1.1",
        "1.1",
        "1.1",
        "6.2a",
        "shutdown",
    ]


def test_files_of_one_length_become_one_dataset(tmp_path):
    put(tmp_path, "a_dlc11_v04_s1.outb", "a_dlc11_v04_s2.outb", "a_dlc11_v06_s1.outb")
    cube = read_loads(tmp_path / "*.outb")
    assert isinstance(cube, xr.Dataset)
    assert cube.hub_force.dims == ("axis", "case", "time")
    assert cube.wind_speed.values.tolist() == [4.0, 4.0, 6.0]
    assert cube.seed.values.tolist() == [1, 2, 1]
    np.testing.assert_allclose(cube.weight, 1 / 3)
    assert cube.attrs["turbine"] == "nrel-5mw"
    check_cube(cube)


def test_lengths_and_steps_get_cubes_of_their_own(tmp_path):
    put(tmp_path, "a_dlc11_v04_s1.outb", n=401)
    put(tmp_path, "a_dlc11_v06_s1.outb", n=201)
    put(tmp_path, "a_dlc11_v08_s1.outb", n=201, dt=0.05)
    tree = read_loads(tmp_path)
    assert set(tree.children) == {"t10_dt0.025", "t5_dt0.025", "t10_dt0.05"}


def test_files_folders_and_patterns_may_be_mixed(tmp_path):
    put(tmp_path / "one", "a_dlc11_v04_s1.outb")
    put(tmp_path / "two", "a_dlc11_v06_s1.outb", "a_dlc11_v08_s1.outb")
    put(tmp_path / "x[1]", "a_dlc11_v10_s1.outb")
    cube = read_loads([tmp_path / "one", f"{tmp_path}/two/*.outb", *(tmp_path / "x[1]").iterdir()])
    assert cube.wind_speed.values.tolist() == [4.0, 6.0, 8.0, 10.0]


def test_unknown_names_get_mean_wind_and_running_seed(tmp_path):
    put(tmp_path, "x.outb", "y.outb")
    data = channels(n=100, seed=5)
    data["Wind1VelX"] = channels(n=100, seed=0)["Wind1VelX"]  # same mean wind as x, another seed
    write_outb(tmp_path / "z.outb", data)
    cube = read_loads(sorted(tmp_path.iterdir()))
    assert set(cube.dlc.values) == {"unknown"}
    np.testing.assert_allclose(cube.wind_speed, 12.0, atol=0.5)
    assert cube.seed.values.tolist() == [1, 1, 2]


def test_same_series_under_two_unknown_names_is_refused(tmp_path):
    for name in ("x.outb", "y.outb"):
        write_outb(tmp_path / name, channels(seed=1))
    with pytest.raises(InputError, match=r"y\.outb: the series are those of .*x\.outb"):
        read_loads(tmp_path)


def test_two_files_of_one_case_are_refused(tmp_path):
    put(tmp_path / "a", "p_dlc11_v04_s1.outb")
    put(tmp_path / "b", "q_dlc11_v04_s1.outb")
    with pytest.raises(InputError, match=r"case 'dlc1\.1_v4_s1' is already in .*p_dlc11"):
        read_loads([tmp_path / "a", tmp_path / "b"])


def test_file_given_twice_is_refused(tmp_path):
    put(tmp_path, "p_dlc11_v04_s1.outb")
    with pytest.raises(InputError, match="given twice"):
        read_loads([tmp_path, tmp_path / "p_dlc11_v04_s1.outb"])


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ("*.outb", "no file matches"),
        ("absent.outb", "no such file"),
        (".", "holds no load file"),
        ([], "no load file was given"),
    ],
)
def test_nothing_to_read_is_said(tmp_path, monkeypatch, files, message):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=message):
        read_loads(files)


def test_unknown_kind_of_file_is_refused_with_what_is_known(tmp_path):
    (tmp_path / "a.mat").write_bytes(b"1")
    with pytest.raises(InputError, match=r"a\.mat: no reader .*\*\.outb"):
        read_loads(tmp_path / "a.mat")


def test_one_bad_file_among_good_ones_is_named(tmp_path):
    put(tmp_path, "a_dlc11_v04_s1.outb", "a_dlc11_v04_s2.outb")
    bad = tmp_path / "a_dlc11_v04_s2.outb"
    bad.write_bytes(bad.read_bytes()[:-7])
    with pytest.raises(InputError, match=r"a_dlc11_v04_s2\.outb: truncated"):
        read_loads(tmp_path)


def test_list_of_cases_stands_above_names(tmp_path):
    put(tmp_path, "a_dlc11_v04_s1.outb", "b.outb")
    table = tmp_path / "cases.txt"
    table.write_text(
        "file,dlc,wind_speed,seed,weight\nb.outb,DLC1.3,25,6,0.2\na_dlc11_v04_s1.outb,11,5,2,0.8\n"
    )
    cube = read_loads(f"{tmp_path}/*.outb", cases=table)
    assert cube.case.values.tolist() == ["dlc1.1_v5_s2", "dlc1.3_v25_s6"]
    assert cube.weight.values.tolist() == [0.8, 0.2]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name,dlc\n", "'file' is needed"),
        ("file,colour\n", "known are"),
        ("file,seed\na.outb,one\n", "line 2: invalid literal"),
        ("file,seed\na.outb\n", "line 2: must have 2 fields"),
        ("file,seed\na.outb,1\na.outb,2\n", "line 3: a.outb is listed twice"),
        ("file,weight\na.outb,-1\n", "line 2: weight = -1 must be"),
        ("file,wind_speed\na.outb,nan\n", "line 2: wind_speed = nan must be"),
    ],
)
def test_bad_list_of_cases_is_refused(tmp_path, text, message):
    table = tmp_path / "cases.csv"
    table.write_text(text)
    with pytest.raises(InputError, match=message):
        read_case_list(table)


def test_file_that_the_list_does_not_name_is_refused(tmp_path):
    put(tmp_path, "a_dlc11_v04_s1.outb")
    table = tmp_path / "cases.txt"
    table.write_text("file,seed\nmisspelt.outb,1\n")
    with pytest.raises(InputError, match=r"a_dlc11_v04_s1\.outb: the list of cases .* not name"):
        read_loads(f"{tmp_path}/*.outb", cases=table)


def test_a_list_may_name_more_files_than_are_read(tmp_path):
    put(tmp_path, "a.outb")
    table = tmp_path / "cases.txt"
    table.write_text("file,dlc,wind_speed\na.outb,1.3,20\nb.outb,1.3,22\n")
    assert read_loads(tmp_path / "a.outb", cases=table).case.values.tolist() == ["dlc1.3_v20_s1"]


def test_weights_of_some_cases_only_are_refused(tmp_path):
    put(tmp_path, "a.outb", "b.outb")
    table = tmp_path / "cases.txt"
    table.write_text("file,wind_speed,weight\na.outb,4,0.5\nb.outb,6,\n")
    with pytest.raises(InputError, match=r"unknown_v6_s1' has no weight"):
        read_loads(f"{tmp_path}/*.outb", cases=table)
