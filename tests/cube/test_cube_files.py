"""What is saved is what is opened, lazily, whole or not at all."""

import numpy as np
import pytest
import xarray as xr

import loadflow as lf
from loadflow.cube import check_cube, iter_cases, make_case, make_cube, open_cube, save_cube
from loadflow.errors import InputError


def case(seed=1, wind_speed=4.0, n=200, **varied):
    rng = np.random.default_rng(seed)
    data = {
        "speed": rng.normal(size=n).astype("f4"),
        "pitch": rng.normal(size=n),
        "hub_force": rng.normal(size=(3, n)).astype("f4"),
    }
    time = 0.025 * np.arange(n)
    return make_case(time, data, dlc="1.1", wind_speed=wind_speed, seed=seed, **varied)


def assert_same(a, b):
    xr.testing.assert_identical(a, b)
    for (_, x), (_, y) in zip(iter_cases(a), iter_cases(b)):
        assert {n: v.dtype for n, v in x.variables.items()} == {
            n: v.dtype for n, v in y.variables.items()
        }


@pytest.mark.parametrize("lengths", [(200, 200), (200, 300)])
def test_cube_and_tree_come_back_as_they_were(tmp_path, lengths):
    cube = make_cube([case(seed, n=n, file=f"ü{seed}.outb") for seed, n in enumerate(lengths, 1)])
    path = lf.save_cube(cube, tmp_path / "new" / "loads.h5")
    opened = lf.open_cube(path)
    assert type(opened) is type(cube)
    assert_same(opened, cube)
    check_cube(opened, str(path))


def test_what_was_opened_can_be_saved_again(tmp_path):
    cube = make_cube([case(1), case(2)])
    opened = open_cube(save_cube(cube, tmp_path / "a.h5"))
    save_cube(opened, tmp_path / "b.h5")
    save_cube(opened, tmp_path / "a.h5")  # onto the file it is read from
    for name in "ab":
        assert_same(open_cube(tmp_path / f"{name}.h5"), cube)


def test_saving_twice_gives_the_same_bytes(tmp_path):
    cube = make_cube([case(1), case(2)])
    first, second = (save_cube(cube, tmp_path / name).read_bytes() for name in ("a.h5", "b.h5"))
    assert first == second


def test_opening_does_not_load_the_series(tmp_path):
    path = save_cube(make_cube([case(1), case(2)]), tmp_path / "loads.h5")
    opened = open_cube(path)
    assert not any(v.variable._in_memory for v in opened.data_vars.values())
    name, first = next(iter_cases(opened))
    assert not first.speed.variable._in_memory
    assert name == "dlc1.1_v4_s1"
    assert first.speed.dims == ("time",)


def test_folder_of_single_cases_is_a_cube(tmp_path):
    cases = [case(wind_speed=v) for v in (4.0, 6.0, 10.0, 12.0)]
    for one in cases:
        save_cube(one, tmp_path / f"dlc1.1_v{float(one.wind_speed):g}_s1.h5")
    (tmp_path / "manifest.json").write_text("{}")
    (tmp_path / ".half.h5.123.loadflow-tmp").write_bytes(b"half a file")
    assert_same(open_cube(tmp_path), make_cube(cases))


def test_nothing_is_left_of_a_write_that_fails(tmp_path):
    good = make_cube([case(1), case(2)])
    path = save_cube(good, tmp_path / "loads.h5")
    with pytest.raises(TypeError):
        save_cube(good.assign_attrs(unfit=object()), path)
    assert [p.name for p in tmp_path.iterdir()] == ["loads.h5"]
    assert_same(open_cube(path), good)


@pytest.mark.parametrize("size", [0, 10, 3000, -100])
def test_cut_file_is_refused_by_name(tmp_path, size):
    path = save_cube(make_cube([case(1), case(2)]), tmp_path / "loads.h5")
    path.write_bytes(path.read_bytes()[:size])
    with pytest.raises(InputError, match=r"loads\.h5: cannot be read as HDF5"):
        open_cube(path)


def test_absent_files_and_empty_folders_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"absent\.h5: no such load cube"):
        open_cube(tmp_path / "absent.h5")
    with pytest.raises(InputError, match="the folder holds no case"):
        open_cube(tmp_path)
    save_cube(make_cube([case(1), case(2)]), tmp_path / "loads.h5")
    with pytest.raises(InputError, match="a whole cube among the files of single cases"):
        open_cube(tmp_path)


def test_chunks_open_as_dask_arrays(tmp_path):
    dask = pytest.importorskip("dask")
    path = save_cube(make_cube([case(1), case(2)]), tmp_path / "loads.h5")
    opened = open_cube(path, chunks={"case": 1})
    assert dask.is_dask_collection(opened.speed.data)
    assert opened.speed.chunks == ((1, 1), (200,))


def test_chunks_without_dask_say_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "dask", None)
    path = save_cube(make_cube([case(1), case(2)]), tmp_path / "loads.h5")
    with pytest.raises(InputError, match=r"chunks= needs .*loadflow\[dask\]"):
        open_cube(path, chunks={})
