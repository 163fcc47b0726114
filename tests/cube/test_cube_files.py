"""What is saved is what is opened, lazily, whole or not at all."""

import numpy as np
import pytest
import xarray as xr

import loadflow as lf
from loadflow.cube import check_cube, iter_cases, make_case, make_cube, open_cube, save_cube
from loadflow.cube.schema import CUBE
from loadflow.errors import FormerVersionWarning, InputError, NewerVersionError


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


# --- versions of the form ----------------------------------------------------------------------


@pytest.mark.parametrize("lengths", [(200, 200), (200, 300)])
def test_a_file_says_its_version_and_a_cube_in_memory_does_not(tmp_path, lengths):
    cube = make_cube([case(seed, n=n) for seed, n in enumerate(lengths, 1)])
    path = save_cube(cube, tmp_path / "loads.h5")
    with xr.open_datatree(path, engine="h5netcdf") as raw:
        assert raw.attrs[CUBE.key] == CUBE.version
    assert CUBE.key not in cube.attrs
    assert CUBE.key not in open_cube(path).attrs


def written_by_an_older_version(cube, path):
    """A cube as it was before files said their version, and without the labels of `speed`."""
    cube = cube.copy(deep=True)
    for part in [cube] if isinstance(cube, xr.Dataset) else [leaf.dataset for leaf in cube.leaves]:
        part["speed"].attrs.pop("long_name")
    cube.to_netcdf(path, engine="h5netcdf")
    return path


@pytest.mark.parametrize("lengths", [(200, 200), (200, 300)])
def test_an_older_cube_is_read_and_what_it_lacked_is_told(tmp_path, lengths):
    cube = make_cube([case(seed, n=n) for seed, n in enumerate(lengths, 1)])
    old = written_by_an_older_version(cube, tmp_path / "old.h5")
    with pytest.warns(FormerVersionWarning, match=r"old\.h5: load cube .*speed is labelled"):
        opened = open_cube(old)
    assert_same(opened, cube)
    check_cube(opened)


def test_units_that_an_older_cube_lacks_are_not_guessed(tmp_path):
    cube = make_cube([case(1)])
    del cube["speed"].attrs["units"]
    cube.to_netcdf(tmp_path / "old.h5", engine="h5netcdf")
    with pytest.raises(InputError, match="'units' is missing"):
        check_cube(open_cube(tmp_path / "old.h5"))


@pytest.mark.parametrize("version", [CUBE.version + 1, 99])
def test_a_cube_of_a_newer_version_is_refused(tmp_path, version):
    cube = make_cube([case(1)]).assign_attrs({CUBE.key: version})
    cube.to_netcdf(tmp_path / "new.h5", engine="h5netcdf")
    with pytest.raises(NewerVersionError, match=rf"new\.h5: {CUBE.key} = {version}: .*a newer"):
        open_cube(tmp_path / "new.h5")


@pytest.mark.parametrize("version", [0, -3, 1.5, "two"])
def test_a_version_that_is_none_is_refused(tmp_path, version):
    cube = make_cube([case(1)]).assign_attrs({CUBE.key: version})
    cube.to_netcdf(tmp_path / "odd.h5", engine="h5netcdf")
    with pytest.raises(InputError, match=rf"odd\.h5: {CUBE.key} = .*must be 1 … {CUBE.version}$"):
        open_cube(tmp_path / "odd.h5")
