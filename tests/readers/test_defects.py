"""What real files have that the formats do not foresee: each in a small file of its own."""

import h5py
import numpy as np
import pytest
from openfast_files import UNITS, channels, write_out, write_outb
from test_readers_bladed import HUB, write_group, write_run
from test_readers_csv import write as write_csv
from test_readers_hawc2 import CHANNELS, NAMES
from test_readers_hawc2 import write as write_hawc2

from loadflow.cube import make_case, open_cube, save_cube
from loadflow.errors import InputError, ValidityWarning
from loadflow.readers import (
    read_bladed,
    read_csv,
    read_gtsdf,
    read_hawc2,
    read_loads,
    read_openfast,
)
from loadflow.readers.openfast import read_table

# -- OpenFAST ---------------------------------------------------------------------------------


def test_text_in_latin_1_with_a_blank_last_line_and_its_heading_elsewhere(tmp_path):
    expected = read_openfast(write_out(tmp_path / "a.out", channels()))
    text = (tmp_path / "a.out").read_text().replace("(kN-m)", "(kN·m)").replace("(m/s)", "(m/sec)")
    old = tmp_path / "old.out"
    old.write_bytes(("\n" + text + "\r\n\n").encode("latin-1"))
    found = read_openfast(old)
    np.testing.assert_array_equal(found.hub_moment, expected.hub_moment)
    np.testing.assert_array_equal(found.wind, expected.wind)


@pytest.mark.parametrize("write", [write_out, write_outb])
def test_an_invalid_channel_does_not_count(tmp_path, write):
    data = {"Spn9MLxb1": np.zeros(400), **channels()}
    data = {"Time": data.pop("Time"), **data}
    units = {**UNITS, "Spn9MLxb1": "INVALID"}
    path = write(tmp_path / f"a.{write.__name__[6:]}", data, units)
    assert "hub_force" in read_openfast(path)
    path = write(path, data, {**units, "LSShftFys": "INVALID"})
    with pytest.raises(InputError, match=r"'hub_force_y' is missing.*2 channels have the unit INV"):
        read_openfast(path)


def test_trailing_bytes_of_an_older_file_are_doubted(tmp_path):
    path = write_outb(tmp_path / "dlc11_v12_s1.outb", channels())
    expected = read_openfast(path)
    size = path.stat().st_size
    path.write_bytes(path.read_bytes() + bytes(1000))
    with pytest.warns(ValidityWarning, match=f"1000 bytes follow the {size} of the header"):
        cube = read_loads(path)
    np.testing.assert_array_equal(cube.hub_force.isel(case=0), expected.hub_force)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_binary_files_are_read_as_openfast_io_reads_them(tmp_path, kind):
    reader = pytest.importorskip("openfast_io.FAST_output_reader")
    path = write_outb(tmp_path / "a.outb", channels(), kind=kind)
    data, info, _ = reader.load_binary_output(str(path))
    table = read_table(path)
    np.testing.assert_array_equal(table.values, data)
    assert list(table.names) == info["attribute_names"]
    assert list(table.units) == info["attribute_units"]


def test_all_missing_channels_are_told_at_once_with_lines_for_the_outlist(tmp_path):
    gone = ("LSShftFys", "LSSTipMys", "RotSpeed")
    data = {k: v for k, v in channels().items() if k not in gone}
    with pytest.raises(InputError) as error:
        read_openfast(write_outb(tmp_path / "a.outb", data))
    text = str(error.value)
    assert "3 channels are missing" in text
    assert text.endswith('OutList of ElastoDyn:\n"RotSpeed"\n"LSShftFys"\n"LSSTipMys"')


def test_names_in_other_capitals_are_the_same_channels(tmp_path):
    data = {k.upper() if k != "Time" else k: v for k, v in channels().items()}
    units = {k.upper() if k != "Time" else k: v for k, v in UNITS.items()}
    assert "wind" in read_openfast(write_outb(tmp_path / "a.outb", data, units))


def test_an_optional_channel_of_unknown_unit_is_left_out_and_told(tmp_path):
    path = write_outb(tmp_path / "a.outb", channels(), {**UNITS, "Wind1VelX": "(knots)"})
    series = read_openfast(path)
    assert "wind" not in series
    assert str(series["doubts"].item()) == "channel 'Wind1VelX' is left out: its unit is unknown"
    with pytest.raises(InputError, match="unit 'knots' cannot be read"):
        read_openfast(path, channels={"wind": "Wind1VelX"})


# -- Bladed -----------------------------------------------------------------------------------


def test_groups_that_are_not_needed_do_not_matter(tmp_path):
    values = write_run(tmp_path / "run")
    header = "NDIMENS\t2\nDIMENS\t1\t50\nVARIAB\t'Step size histogram'\nVARUNIT\tN\n"
    header += "AXISLAB\t'Bin maximum time step'\nAXIUNIT\tT\nAXIMETH\t3\nAXIVAL\t1e-7 1e-6\n"
    (tmp_path / "run.%55").write_text(header)  # no series, no MIN and STEP
    (tmp_path / "run.%56").write_bytes(b"FILE\trun.$56\nVARIAB\t")  # cut
    write_group(tmp_path / "run", "57", ["Other"], ["N"], np.ones((7, 1)))  # of another length
    (tmp_path / "run.$57").unlink()
    text = (tmp_path / "run.%05").read_text()
    text = text.replace("'Rotor speed' 'Rotor azimuth angle'", "Simulation step size  Error")
    (tmp_path / "run.%58").write_text(text)  # names without quotes, no values
    series = read_bladed(tmp_path / "run.$55")
    np.testing.assert_allclose(series.hub_moment, values[:, :3].T, rtol=1e-6)


def test_names_without_quotes_are_read_where_they_are_needed(tmp_path):
    values = write_run(tmp_path / "run")
    header = tmp_path / "run.%23"
    quoted = " ".join(f"'{name}'" for name in HUB)
    header.write_text(header.read_text().replace(quoted, "\t".join(HUB)))
    series = read_bladed(header)
    np.testing.assert_allclose(series.hub_force, values[:, 3:].T, rtol=1e-6)


def test_what_is_missing_is_told_with_the_groups_that_cannot_be_read(tmp_path):
    write_run(tmp_path / "run")
    (tmp_path / "run.%23").write_text("FILE\trun.$23\nNDIMENS\t2\n")
    with pytest.raises(
        InputError, match=r"(?s)6 channels are missing.*run\.%23: no Bladed header, or"
    ):
        read_bladed(tmp_path / "run.%23")


def test_loads_of_the_rotating_hub_are_turned_back(tmp_path):
    values = write_run(tmp_path / "run")
    header = tmp_path / "run.%23"
    header.write_text(header.read_text().replace("Stationary", "Rotating"))
    psi = np.linspace(0, 6, 200)
    y, z = values[:, 4], values[:, 5]
    series = read_bladed(header)
    np.testing.assert_allclose(
        series.hub_force.sel(axis="z"), np.sin(psi) * y + np.cos(psi) * z, rtol=1e-4, atol=1.0
    )


# -- HAWC2 ------------------------------------------------------------------------------------


def write_gtsdf(path, packed=False, n=300, dt=0.05, start=100.05, **attrs):
    values = 100 * np.random.default_rng(1).normal(size=(n, len(NAMES) - 1))
    values[:, 0] = 1.2 + 0.001 * values[:, 0]
    with h5py.File(path, "w") as file:
        file.attrs.update({"type": "General time series data format", "no_blocks": 2} | attrs)
        file["attribute_names"] = np.array([name.encode() for name, _ in NAMES[1:]])
        file["attribute_units"] = np.array([unit.encode() for _, unit in NAMES[1:]])
        for i, rows in enumerate((values[:200], values[200:])):
            block = file.create_group(f"block{i:04d}")
            block.attrs.update({"time_start": start + 200 * dt * i, "time_step": dt})
            if packed:
                offsets = rows.min(axis=0)
                gains = np.ptp(rows, axis=0) / 65000
                block["data"] = np.round((rows - offsets) / gains).astype("<u2")
                block["gains"], block["offsets"] = gains, offsets
            else:
                block["data"] = rows
    return values


GTSDF = {
    **CHANNELS,
    "hub_force_y": "Fx coo: shaft",
    "hub_force_z": "-Fy coo: shaft",
}


@pytest.mark.parametrize("packed", [True, False])
def test_gtsdf_is_read_in_si_units_and_the_frame_of_the_cube(tmp_path, packed):
    path = tmp_path / "dlc12_wsp10_wdir000_s1.hdf5"
    values = write_gtsdf(path, packed)
    series = read_gtsdf(path, channels=GTSDF)
    assert float(series.file_start) == pytest.approx(100.05)
    np.testing.assert_allclose(series.time, 0.05 * np.arange(300), atol=1e-9)
    force = 1e3 * np.array([-values[:, 4], values[:, 2], -values[:, 3]])
    np.testing.assert_allclose(series.hub_force, force, atol=10 if packed else 1e-1)
    cube = read_loads(path, channels=GTSDF, quiet=True)
    assert cube.case.values.tolist() == ["dlc1.2_v10_s1"]


def test_unsound_gtsdf_is_refused(tmp_path):
    path = tmp_path / "a.hdf5"
    with pytest.raises(InputError, match="no such file"):
        read_gtsdf(path)
    write_gtsdf(path, type="something else")
    with pytest.raises(InputError, match=r"a\.hdf5: no gtsdf file; attribute 'type'"):
        read_gtsdf(path, channels=GTSDF)
    write_gtsdf(path, no_blocks=3)
    with pytest.raises(InputError, match=r"2 blocks of data where it says 3; truncated\?"):
        read_gtsdf(path, channels=GTSDF)
    write_gtsdf(path)
    whole = path.read_bytes()
    for share in (0.0, 0.3, 0.9):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(InputError, match=r"a\.hdf5"):
            read_gtsdf(path, channels=GTSDF)


def test_descriptions_tell_channels_of_one_name_apart(tmp_path):
    write_hawc2(tmp_path / "run", binary=False)
    listing = tmp_path / "run.sel"
    text = listing.read_text().replace("Fy coo: shaft", "Fx coo: shaft", 1)
    listing.write_text(text.replace("some words", "Force  Fx Mbdy:shaft nodenr:   4", 4))
    named = {**CHANNELS, "hub_force_y": "#4", "hub_force_z": "-#5"}
    expected = read_hawc2(listing, channels=named)
    rows = listing.read_text().splitlines()
    at = next(i for i, row in enumerate(rows) if row.startswith("     5 "))
    rows[at] = rows[at].replace("nodenr:   4", "nodenr:   1").replace("some words", "nodenr:   1")
    listing.write_text("\n".join(rows) + "\n")
    found = read_hawc2(listing, channels=named | {"hub_force_z": "-nodenr: 1"})
    np.testing.assert_array_equal(found.hub_force, expected.hub_force)


# -- CSV and HDF5 -----------------------------------------------------------------------------


def test_a_byte_that_is_no_utf_8_is_named_with_its_place(tmp_path):
    path = tmp_path / "a.csv"
    write_csv(path)
    rows = path.read_bytes().split(b"\n")
    rows[8] = rows[8].replace(b".", b"\xff", 3)
    path.write_bytes(b"\n".join(rows))
    with pytest.raises(InputError, match=r"a\.csv, column 'time', index 7: .* is not a number"):
        read_csv(path)


def small_cube(path):
    case = make_case([0.0, 0.1], {"speed": [1.0, 1.0]}, dlc="1.1", wind_speed=8, seed=1)
    return save_cube(case, path)


def test_a_small_file_that_asks_for_gigabytes_is_refused_before_it_is_read(tmp_path):
    path = small_cube(tmp_path / "a.h5")
    with h5py.File(path, "a") as file:
        file.create_dataset("more", shape=(400_000_000,), dtype="f8", chunks=(1000,))  # no chunk
    assert path.stat().st_size < 50_000
    with pytest.raises(
        InputError, match=r"a\.h5, more: says it holds 3200 MB, but the file of .* 0 MB"
    ):
        open_cube(path)


def test_damaged_hdf5_is_an_input_error_or_an_answer(tmp_path):
    whole = small_cube(tmp_path / "a.h5").read_bytes()
    rng = np.random.default_rng(5)
    path, refused = tmp_path / "b.h5", []
    for _ in range(150):
        data = bytearray(whole)
        for at in rng.integers(len(data), size=4):
            data[at] = rng.integers(256)
        path.write_bytes(data)
        try:
            open_cube(path).load()
        except InputError as error:
            refused.append(str(error))
    assert len(refused) > 10
    assert all(str(path) in message for message in refused)


# -- folders ----------------------------------------------------------------------------------


def test_a_folder_may_hold_other_files_which_are_told(tmp_path):
    write_outb(tmp_path / "dlc11_v12_s1.outb", channels())
    write_out(tmp_path / "dlc11_v12_s1.out", channels())  # OpenFAST writes both if asked
    (tmp_path / "deck_ElastoDyn.dat").write_text("------- ELASTODYN\n")
    (tmp_path / "polars.csv").write_text("angle,lift\n0,1\n")
    with pytest.warns(ValidityWarning) as told:
        cube = read_loads(tmp_path)
    assert cube.case.values.tolist() == ["dlc1.1_v12_s1"]
    said = " ".join(str(warning.message) for warning in told)
    assert (
        "3 files are no load series, and left out: deck_ElastoDyn.dat, dlc11_v12_s1.out, " in said
    )


POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:b15a5653\nsize 54810000\n"


@pytest.mark.parametrize(
    "kind", ["outb", "out", "csv", "dat of numbers", "dat of text", "$23", "h5"]
)
def test_a_pointer_of_git_lfs_is_called_so(tmp_path, kind):
    if kind.startswith("dat"):
        write_hawc2(tmp_path / "run", binary=kind == "dat of numbers")
    if kind == "$23":
        write_run(tmp_path / "run")
    path = tmp_path / f"run.{kind.split()[0]}"
    path.write_text(POINTER)
    with pytest.raises(InputError, match="a pointer of Git LFS, not the file itself; `git lfs"):
        open_cube(path) if kind == "h5" else read_loads(path, channels=CHANNELS)


def test_one_bladed_run_beside_another_of_a_longer_name(tmp_path):
    values = write_run(tmp_path / "run[1]")
    write_run(tmp_path / "run[1].1")
    series = read_bladed(tmp_path / "run[1].%23")
    np.testing.assert_allclose(series.hub_force, values[:, 3:].T, rtol=1e-6)
