"""OpenFAST files: sound ones arrive in SI units, unsound ones are named."""

import re

import numpy as np
import pytest
import xarray as xr
from openfast_files import UNITS, channels, write_out, write_outb

from loadflow.errors import InputError
from loadflow.readers import read_openfast

KILO = 1e3
FORCES = ("RotThrust", "LSShftFys", "LSShftFzs")
MOMENTS = ("RotTorq", "LSSTipMys", "LSSTipMzs")


def check_against(series, data, rtol):
    scale = {"speed": np.pi / 30, "pitch": np.pi / 180, "azimuth": np.pi / 180, "wind": 1.0}
    names = {"speed": "RotSpeed", "pitch": "BldPitch1", "azimuth": "Azimuth", "wind": "Wind1VelX"}
    for key, channel in names.items():
        expected = data[channel] * scale[key]
        np.testing.assert_allclose(series[key], expected, atol=rtol * np.ptp(expected))
    for key, group in (("hub_force", FORCES), ("hub_moment", MOMENTS)):
        for axis, channel in zip("xyz", group):
            expected = data[channel] * KILO
            np.testing.assert_allclose(
                series[key].sel(axis=axis), expected, atol=rtol * np.ptp(expected)
            )


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_every_binary_kind_is_read_in_si_units_and_the_frame_of_the_cube(tmp_path, kind):
    data = channels()
    series = read_openfast(write_outb(tmp_path / "a.outb", data, kind=kind))
    check_against(series, data, 2e-5)
    units = {k: v.attrs["units"] for k, v in series.data_vars.items()}
    assert units["speed"] == "rad/s"
    assert units["hub_force"] == "N"
    assert units["hub_moment"] == "N m"
    assert all(v.dtype == np.float32 for v in series.data_vars.values())


def test_text_file_is_read_alike(tmp_path):
    data = channels()
    check_against(read_openfast(write_out(tmp_path / "a.out", data)), data, 5e-3)


def test_binary_content_under_a_text_name_is_read(tmp_path):
    data = channels()
    check_against(read_openfast(write_outb(tmp_path / "a.out", data)), data, 2e-5)


def test_time_starts_at_zero_and_the_start_of_the_file_is_kept(tmp_path):
    series = read_openfast(write_out(tmp_path / "a.out", channels(start=60.0)))
    assert float(series.file_start) == 60.0
    assert series.time.values[0] == 0.0
    np.testing.assert_array_equal(series.time.values, 0.025 * np.arange(400))


def test_stamps_rounded_by_printing_are_made_regular(tmp_path):
    data = channels(dt=0.00625)  # printed with four decimals: 0.0063, 0.0125, 0.0188, …
    series = read_openfast(write_out(tmp_path / "a.out", data))
    np.testing.assert_allclose(np.diff(series.time), 0.00625, rtol=1e-9)


def test_moments_come_from_the_strain_gauge_where_its_distance_is_given(tmp_path):
    data = channels()
    gauge = {k: v for k, v in data.items() if not k.startswith("LSSTip")}
    gauge["LSSGagMys"] = data["LSSTipMys"] + 1.912 * data["LSShftFzs"]
    gauge["LSSGagMzs"] = data["LSSTipMzs"] - 1.912 * data["LSShftFys"]
    units = {**UNITS, "LSSGagMys": "(kN-m)", "LSSGagMzs": "(kN*m)"}
    path = write_outb(tmp_path / "a.outb", gauge, units, kind=3)
    check_against(read_openfast(path, gauge_distance=1.912), data, 1e-5)
    with pytest.raises(InputError, match="gauge_distance"):
        read_openfast(path)


def test_channels_may_be_named_and_their_sign_turned(tmp_path):
    data = channels()
    path = write_outb(tmp_path / "a.outb", data, kind=3)
    series = read_openfast(path, channels={"hub_force_y": "-LSShftFys"})
    np.testing.assert_allclose(series.hub_force.sel(axis="y"), -KILO * data["LSShftFys"], rtol=1e-6)
    with pytest.raises(InputError, match="'hub_force_q' is nothing the cube holds"):
        read_openfast(path, channels={"hub_force_q": "LSShftFys"})


def test_optional_channels_may_be_absent(tmp_path):
    data = {k: v for k, v in channels().items() if k not in ("Azimuth", "BldPitch1", "Wind1VelX")}
    series = read_openfast(write_outb(tmp_path / "a.outb", data))
    assert set(series.data_vars) == {"speed", "hub_force", "hub_moment"}


def test_missing_channel_is_named_with_what_the_file_has(tmp_path):
    data = {k: v for k, v in channels().items() if k != "LSShftFys"}
    with pytest.raises(
        InputError,
        match=r"a\.outb: channel 'LSShftFys' or 'LSSGagFys' for 'hub_force_y' is missing.*RotTorq",
    ):
        read_openfast(write_outb(tmp_path / "a.outb", data))


@pytest.mark.parametrize("write", [write_out, write_outb])
def test_unknown_unit_is_named_with_its_channel(tmp_path, write):
    path = write(tmp_path / f"a.{write.__name__[6:]}", channels(), {**UNITS, "RotTorq": "(lbf-ft)"})
    with pytest.raises(InputError, match=r"channel 'RotTorq': unit 'lbf-ft' .*'N m'"):
        read_openfast(path)


def test_force_in_the_unit_of_a_moment_is_refused(tmp_path):
    path = write_outb(tmp_path / "a.outb", channels(), {**UNITS, "RotThrust": "(kN-m)"})
    with pytest.raises(InputError, match="channel 'RotThrust': unit 'kN-m' cannot be read as 'N'"):
        read_openfast(path)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_value_that_is_not_finite_is_named_with_index_and_time(tmp_path, bad):
    data = channels(start=60.0)
    data["LSSTipMzs"][123] = bad
    with pytest.raises(
        InputError, match=r"'LSSTipMzs', index 123 \(time 63\.075 s\): value (nan|inf)"
    ):
        read_openfast(write_outb(tmp_path / "a.outb", data, kind=3))


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
@pytest.mark.parametrize("share", [0.001, 0.02, 0.05, 0.5, 0.9999])
def test_file_cut_anywhere_is_called_truncated(tmp_path, kind, share):
    whole = write_outb(tmp_path / "a.outb", channels(), kind=kind).read_bytes()
    cut = tmp_path / "cut.outb"
    cut.write_bytes(whole[: max(1, int(share * len(whole)))])
    with pytest.raises(InputError, match=r"cut\.outb.*(truncated|no OpenFAST)"):
        read_openfast(cut)


def test_truncated_file_says_how_many_steps_it_holds(tmp_path):
    path = write_outb(tmp_path / "a.outb", channels(n=400))
    path.write_bytes(path.read_bytes()[: -2 * 10 * 100])
    with pytest.raises(InputError, match="truncated, holds 300 of 400 time steps"):
        read_openfast(path)


@pytest.mark.parametrize("name", ["a.outb", "a.out"])
def test_empty_file_is_called_empty(tmp_path, name):
    (tmp_path / name).write_bytes(b"")
    with pytest.raises(InputError, match="the file is empty"):
        read_openfast(tmp_path / name)


@pytest.mark.parametrize("n", [0, 1])
def test_file_without_two_time_steps_is_refused(tmp_path, n):
    data = {k: v[:n] for k, v in channels().items()}
    full = channels(n=2)
    path = tmp_path / "a.outb"
    write_outb(path, full)
    if n == 0:
        raw = bytearray(path.read_bytes()[: -2 * 2 * 10])
        raw[8:12] = (0).to_bytes(4, "little")
        path.write_bytes(raw)
    else:
        write_outb(path, data)
    with pytest.raises(InputError, match="two time steps or more"):
        read_openfast(path)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"absent\.outb: no such file"):
        read_openfast(tmp_path / "absent.outb")


def test_a_binary_file_without_a_zero_at_its_start_is_not_taken_for_text(tmp_path):
    path = tmp_path / "run.outb"
    path.write_bytes(bytes([200]) * 100 + bytes(10))
    with pytest.raises(InputError, match="no OpenFAST binary file"):
        read_openfast(path)


@pytest.mark.parametrize(
    "garbage",
    [
        "nothing of sense\n",
        "\n" * 20,
        "Time Torque\n" * 30,
        "\n" * 6 + "Time RotSpeed\n(s) (rpm)\n",
        "\n" * 6 + "Time RotSpeed\n",
        "\n" * 6 + "Time RotSpeed\n(s) rpm\n0 1\n1 1\n",
    ],
)
def test_text_that_is_no_output_is_refused(tmp_path, garbage):
    path = tmp_path / "garbage.out"
    path.write_text(garbage)
    with pytest.raises(InputError, match=r"garbage\.out"):
        read_openfast(path)


def test_random_bytes_are_refused(tmp_path):
    rng = np.random.default_rng(3)
    for i in range(50):
        path = tmp_path / f"{i}.outb"
        path.write_bytes(rng.integers(0, 256, size=500, dtype=np.uint8).tobytes())
        with pytest.raises(InputError, match=rf"{i}\.outb"):
            read_openfast(path)


def damaged_text(tmp_path, change):
    path = write_out(tmp_path / "a.out", channels())
    lines = path.read_text().splitlines()
    path.write_text("\n".join(change(lines)) + "\n")
    return path


def test_word_among_numbers_is_named_with_its_line(tmp_path):
    path = damaged_text(tmp_path, lambda x: [*x[:50], x[50].replace("E+", "Q+", 1), *x[51:]])
    with pytest.raises(InputError, match=r"a\.out, line 51: '.*Q.*' is not a number"):
        read_openfast(path)


def test_row_with_a_value_missing_is_named_with_its_line(tmp_path):
    path = damaged_text(tmp_path, lambda x: [*x[:50], x[50][:-12], *x[51:]])
    with pytest.raises(InputError, match="line 51: 10 values where the header names 11"):
        read_openfast(path)


def test_last_line_cut_within_a_number_is_called_truncated(tmp_path):
    path = damaged_text(tmp_path, lambda x: [*x[:-1], x[-1][:-2]])
    with pytest.raises(InputError, match="truncated"):
        read_openfast(path)


def test_missing_row_is_an_irregular_step(tmp_path):
    path = damaged_text(tmp_path, lambda x: [*x[:100], *x[101:]])
    with pytest.raises(InputError, match="variable 'time', index 92: steps are not equal"):
        read_openfast(path)


def test_repeated_row_is_time_that_does_not_rise(tmp_path):
    path = damaged_text(tmp_path, lambda x: [*x[:100], x[99], *x[100:]])
    with pytest.raises(InputError, match=r"variable 'time', index 92: value 2\.275 does not rise"):
        read_openfast(path)


def test_loads_of_a_blade_root_are_read_all_or_none(tmp_path):
    roots = ("RootFzc1", "RootFxc1", "RootFyc1", "RootMzc1", "RootMxc1", "RootMyc1")
    data = channels()
    data |= {name: 50.0 * i + np.cos(data["Time"]) for i, name in enumerate(roots)}
    units = UNITS | {name: "(kN)" if "F" in name else "(kN-m)" for name in roots}
    series = read_openfast(write_outb(tmp_path / "a.outb", data, units=units, kind=3))
    for key, names in (("root_force", roots[:3]), ("root_moment", roots[3:])):
        for axis, name in zip("xyz", names):
            np.testing.assert_allclose(series[key].sel(axis=axis), KILO * data[name], rtol=1e-6)
    del data["RootFyc1"]
    series = read_openfast(write_outb(tmp_path / "b.outb", data, units=units, kind=3))
    assert not {"root_force", "root_moment"} & set(series.data_vars)
    with pytest.raises(InputError, match="root_force_z"):
        read_openfast(
            write_outb(tmp_path / "c.outb", data, units=units, kind=3),
            channels={"root_force_x": "RootFzc1"},
        )


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig", "latin-1"])
def test_text_in_any_usual_encoding_is_read(tmp_path, encoding):
    path = write_out(tmp_path / "a.out", channels())
    expected = read_openfast(path)
    path.write_bytes(("Düse\r\n" + path.read_text()).encode(encoding))
    xr.testing.assert_identical(read_openfast(path), expected)


def with_thrust(path, text):
    """A file in which the thrust of the fourth time step is that text."""
    write_out(path, channels())
    lines = path.read_text().splitlines()
    at = next(i for i, line in enumerate(lines) if line.split()[:1] == ["Time"])
    row = lines[at + 5].split()
    row[lines[at].split().index("RotThrust")] = text
    lines[at + 5] = "\t".join(row)
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize(
    ("text", "value"), [("1.5-102", 1.5e-102), ("-.25D+02", -25.0), ("2.5+003", 2500.0)]
)
def test_numbers_are_read_as_fortran_writes_them(tmp_path, text, value):
    series = read_openfast(with_thrust(tmp_path / "a.out", text))
    assert series["hub_force"][0, 3] == pytest.approx(1e3 * value, rel=1e-6)


@pytest.mark.parametrize("text", ["2020-01", "12-102", "1.5+3"])
def test_what_looks_like_an_exponent_but_fortran_does_not_write_is_no_number(tmp_path, text):
    with pytest.raises(InputError, match=rf"line 12: '{re.escape(text)}' is not a number"):
        read_openfast(with_thrust(tmp_path / "a.out", text))


def test_a_number_that_did_not_fit_matters_in_its_channel_alone(tmp_path):
    """Fortran fills the field with stars."""
    data = channels()
    units = UNITS | {"YawBrMzp": "(kN-m)"}
    path = write_out(tmp_path / "a.out", data | {"YawBrMzp": np.full(400, 123456.0)}, units)
    path.write_text(path.read_text().replace("1.2346E+05", "**********", 1))
    plain = write_out(tmp_path / "b.out", data)
    kept = read_openfast(plain).drop_vars("file")
    xr.testing.assert_identical(read_openfast(path).drop_vars("file"), kept)
    with pytest.raises(InputError, match=r"'YawBrMzp', index 0 .*nan is not finite"):
        read_openfast(path, {"hub_moment_z": "YawBrMzp"})
