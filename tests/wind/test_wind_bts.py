"""Wind files: an independent reader sees what was written, and bad files are named."""

import struct
from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.wind import Box, kaimal_box, read_bts, write_bts


@pytest.fixture(scope="module")
def box() -> Box:
    y = np.linspace(-30.0, 30.0, 4)
    z = np.linspace(50.0, 130.0, 5)
    return kaimal_box(
        12.0, 2.0, y=y, z=z, hub_height=90.0, duration=30.0, dt=0.1, seed=1, shear_exponent=0.15
    )


def test_openfast_io_reads_the_total_wind(box, tmp_path):
    reader = pytest.importorskip("openfast_io.turbsim_file")
    write_bts(tmp_path / "wind.bts", box)
    other = reader.TurbSimFile(str(tmp_path / "wind.bts"))
    np.testing.assert_allclose(other["y"], box.y, atol=1e-5)
    np.testing.assert_allclose(other["z"], box.z, atol=1e-4)
    np.testing.assert_allclose(other["t"], box.time, atol=1e-4)
    assert other["uRef"] == pytest.approx(12.0)
    total = box.u + 12.0 * (box.z / 90.0) ** 0.15
    for k, wind in enumerate((total, box.v, box.w)):
        step = np.ptp(wind) / 65534
        np.testing.assert_allclose(other["u"][k], wind, atol=0.51 * step + 1e-5)


def test_round_trip(box, tmp_path):
    write_bts(tmp_path / "wind.bts", box)
    back = read_bts(tmp_path / "wind.bts")
    assert (back.wind_speed, back.hub_height) == pytest.approx((12.0, 90.0))
    np.testing.assert_allclose(back.time, box.time, atol=1e-5)
    np.testing.assert_allclose(back.v, box.v, atol=2e-4)
    total = [b.u + b.wind_speed * (b.z / 90.0) ** b.shear_exponent for b in (box, back)]
    np.testing.assert_allclose(*total, atol=3e-4)
    # of a wind without turbulence the exponent comes back
    calm = replace(box, u=np.zeros_like(box.u), v=None, w=None)
    write_bts(tmp_path / "calm.bts", calm)
    calm = read_bts(tmp_path / "calm.bts")
    assert calm.shear_exponent == pytest.approx(0.15, abs=1e-4)
    np.testing.assert_allclose(calm.u, 0, atol=2e-4)


def test_bad_files_are_named(box, tmp_path):
    path = tmp_path / "wind.bts"
    write_bts(path, box)
    whole = path.read_bytes()
    for content, message in (
        (b"", "0 bytes"),
        (whole[:-1], "the header asks for"),
        (b"\x01\x02" + whole[2:], "not a .bts file"),
    ):
        path.write_bytes(content)
        with pytest.raises(InputError, match=message) as error:
            read_bts(path)
        assert str(path) in str(error.value)


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (offset, value)
        for offset, values in {
            18: (np.nan, np.inf, 0.0),  # dz
            26: (np.nan, np.inf, -1.0),  # dt
            30: (np.nan, np.inf, 0.0),  # mean speed
            34: (np.nan, 0.0, -90.0),  # hub
            38: (np.nan, -100.0),  # lowest line
            42: (np.nan, np.inf, 0.0, -5.0, 1e-38),  # slope of u
            46: (np.nan, np.inf),  # its offset
            50: (1e-38,),  # slope of v, which makes it infinite
        }.items()
        for value in values
    ],
)
def test_a_header_of_numbers_that_cannot_be_is_refused(box, tmp_path, place, value):
    path = tmp_path / "wind.bts"
    write_bts(path, box)
    whole = bytearray(path.read_bytes())
    struct.pack_into("<f", whole, place, value)
    path.write_bytes(whole)
    with pytest.raises(InputError, match=r"wind\.bts: not a \.bts file"):
        read_bts(path)


def test_a_description_of_negative_length_is_refused(box, tmp_path):
    path = tmp_path / "wind.bts"
    write_bts(path, box)
    whole = bytearray(path.read_bytes())
    for length in (-1, -1_000_000):
        struct.pack_into("<i", whole, 66, length)
        path.write_bytes(whole)
        with pytest.raises(InputError, match=r"not a \.bts file"):
            read_bts(path)


def test_a_grid_that_begins_at_the_ground_has_finite_wind(box, tmp_path):
    """With less wind above the exponent is negative, and the power of the ground infinite."""
    path = tmp_path / "wind.bts"
    write_bts(path, replace(box, shear_exponent=-0.1))
    whole = bytearray(path.read_bytes())
    struct.pack_into("<f", whole, 38, 0.0)
    path.write_bytes(whole)
    found = read_bts(path)
    assert found.z[0] == 0.0
    assert found.shear_exponent < 0
    assert np.isfinite(found.u).all()


def test_a_wind_from_behind_has_no_profile(box, tmp_path):
    path = tmp_path / "wind.bts"
    write_bts(path, replace(box, u=box.u - 40.0))
    with pytest.raises(InputError, match=r"wind\.bts: no height .* from ahead"):
        read_bts(path)


def test_grids_that_the_format_cannot_hold(box, tmp_path):
    path = tmp_path / "wind.bts"
    for change, message in (
        ({"y": np.array([-30.0, -10.0, 11.0, 30.0])}, "equidistant y"),
        ({"y": box.y + 5}, "symmetric"),
        ({"hub_height": 200.0}, "contain the hub"),
    ):
        with pytest.raises(InputError, match=message):
            write_bts(path, replace(box, **change))
    with pytest.raises(InputError, match="v has shape"):
        replace(box, v=box.v[:-1])
    with pytest.raises(InputError, match="z must rise"):
        replace(box, z=box.z[::-1])
    with pytest.raises(InputError, match="time must rise"):
        replace(box, time=np.nan * box.time)
    for name, value in {"wind_speed": np.nan, "hub_height": 0.0, "shear_exponent": np.inf}.items():
        with pytest.raises(InputError, match=f"{name} = {value}"):
            replace(box, **{name: value})
