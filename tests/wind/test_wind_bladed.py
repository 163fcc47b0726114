"""Wind files of Bladed, as TurbSim and Bladed write them: read back, and bad ones named."""

import struct

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.wind import read_bladed_box

NT, NY, NZ, V, HUB, DX, STEP = 6, 4, 3, 10.0, 80.0, 2.5, 10.0
INTENSITY = (0.16, 0.12, 0.08)


def winds():
    """Fluctuations (time, y, z) that the integers hold exactly."""
    rng = np.random.default_rng(1)
    counts = rng.integers(-3000, 3000, (3, NT, NY, NZ))
    return counts, [c * 1e-3 * V * i for c, i in zip(counts, INTENSITY)]


def body(counts, clockwise):
    rows = counts[:, :, ::-1] if clockwise else counts
    return rows.transpose(1, 3, 2, 0).astype("<i2").tobytes()


def grid():
    return struct.pack("<3fif3f4i", STEP, STEP, DX, NT // 2, V, 0, 0, 0, 0, 7, NZ, NY)


def improved(counts, clockwise=True):
    percent = [100 * i for i in INTENSITY]
    head = struct.pack("<2hi6f", -99, 4, 3, 0.0, 0.03, HUB, *percent)
    return head + grid() + bytes(24) + body(counts, clockwise)


def kaimal(counts):
    extra = bytes(24) + struct.pack("<2f", 12.0, 340.2)
    return struct.pack("<2h2i", -99, 7, 92 + len(extra), 3) + grid() + extra + body(counts, True)


@pytest.mark.parametrize("clockwise", [True, False])
def test_a_file_of_turbsim_is_read(tmp_path, clockwise):
    counts, (u, v, w) = winds()
    path = tmp_path / "wind.wnd"
    path.write_bytes(improved(counts, clockwise))
    box = read_bladed_box(path, clockwise=clockwise, shear_exponent=0.2)
    for ours, theirs in ((box.u, u), (box.v, v), (box.w, w)):
        np.testing.assert_allclose(ours, theirs, atol=1e-5)
    np.testing.assert_allclose(box.time, DX / V * np.arange(NT))
    np.testing.assert_allclose(box.y, [-15, -5, 5, 15])
    np.testing.assert_allclose(box.z, [70, 80, 90])
    # with the profile in it, mean and fluctuation add up to the same wind
    fitted = read_bladed_box(path, clockwise=clockwise)
    total = fitted.u + V * (fitted.z / HUB) ** fitted.shear_exponent
    np.testing.assert_allclose(total, V + u, atol=1e-4)


def test_a_profile_is_found(tmp_path):
    _, calm = winds()
    profile = V * ((np.array([70.0, 80.0, 90.0]) / HUB) ** 0.25 - 1)
    calm = np.zeros((3, NT, NY, NZ))
    calm[0] = np.rint(profile / (1e-3 * V * INTENSITY[0]))
    (tmp_path / "wind.wnd").write_bytes(improved(calm))
    box = read_bladed_box(tmp_path / "wind.wnd")
    assert box.shear_exponent == pytest.approx(0.25, abs=2e-3)
    assert abs(box.u).max() < 2e-3


def test_a_file_of_bladed_needs_what_it_does_not_state(tmp_path):
    counts, (u, _, w) = winds()
    path = tmp_path / "wind.wnd"
    path.write_bytes(kaimal(counts))
    keys = {"hub_height": HUB, "intensity": INTENSITY, "shear_exponent": 0.2}
    box = read_bladed_box(path, **keys)
    np.testing.assert_allclose(box.u, u, atol=1e-5)
    np.testing.assert_allclose(box.w, w, atol=1e-5)
    with pytest.raises(InputError, match="no hub_height and intensity"):
        read_bladed_box(path)


def test_bad_files_are_named(tmp_path):
    counts, _ = winds()
    path, whole = tmp_path / "wind.wnd", improved(counts)
    for content, message in (
        (b"", "0 bytes"),
        (whole[:-2], "need"),
        (b"\x07\x00" + whole[2:], "not a .wnd file"),
    ):
        path.write_bytes(content)
        with pytest.raises(InputError, match=message) as error:
            read_bladed_box(path)
        assert str(path) in str(error.value)


@pytest.mark.parametrize(
    ("place", "kind", "value"),
    [
        (16, "f", np.nan),  # height
        (16, "f", 0.0),
        (20, "f", np.inf),  # intensity of u
        (20, "f", -1.0),
        (24, "f", 3e38),  # of v, which makes it infinite
        (32, "f", np.nan),  # dz
        (48, "f", np.nan),  # mean speed
        (72, "i", 1),  # one height: no profile can be fitted
    ],
)
def test_a_header_of_numbers_that_cannot_be_is_refused(tmp_path, place, kind, value):
    path = tmp_path / "wind.wnd"
    whole = bytearray(improved(winds()[0]))
    struct.pack_into(f"<{kind}", whole, place, value)
    path.write_bytes(whole)
    with pytest.raises(InputError, match=r"wind\.wnd: "):
        read_bladed_box(path)


def test_a_grid_that_begins_at_the_ground_has_finite_wind(tmp_path):
    """The mean profile of the ground: with less wind above, its power would be infinite."""
    counts, _ = winds()
    counts[0] = np.array([300, 0, -300])  # slower with height: the exponent is negative
    head = struct.pack("<2hi6f", -99, 4, 3, 0.0, 0.03, STEP, *[100 * i for i in INTENSITY])
    path = tmp_path / "wind.wnd"
    path.write_bytes(head + grid() + bytes(24) + body(counts, True))
    box = read_bladed_box(path)
    assert box.z[0] == 0.0
    assert box.shear_exponent < 0
    for component in (box.u, box.v, box.w):
        assert np.isfinite(component).all()
