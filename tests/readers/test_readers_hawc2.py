"""HAWC2 files, text and binary."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.readers import read_hawc2, read_loads

NAMES = [
    ("Time", "s"),
    ("Omega", "rad/s"),
    ("WSP gl. coo.,Vy", "m/s"),
    ("Fx coo: shaft", "kN"),
    ("Fy coo: shaft", "kN"),
    ("Fz coo: shaft", "kN"),
    ("Mx coo: shaft", "kNm"),
    ("My coo: shaft", "kNm"),
    ("Mz coo: shaft", "kNm"),
]
CHANNELS = {
    "wind": "WSP gl. coo.,Vy",
    "hub_force_x": "-Fz coo: shaft",
    "hub_force_y": "#4",
    "hub_force_z": "-#5",
    "hub_moment_x": "-Mz coo: shaft",
    "hub_moment_y": "Mx coo: shaft",
    "hub_moment_z": "-My coo: shaft",
}


def made_up(n=600, dt=0.05, start=100.0):
    values = 100 * np.random.default_rng(1).normal(size=(n, len(NAMES)))
    values[:, 0] = start + dt * np.arange(1, n + 1)
    values[:, 1] = 1.2 + 0.001 * values[:, 1]
    return values


def write(stem, binary, values=None):
    values = made_up() if values is None else values
    n, dt = len(values), values[1, 0] - values[0, 0]
    scales = np.abs(values).max(axis=0) / 32000
    line = "_" * 120
    text = [line, "  Version ID : HAWC2MB 12.8", " " * 60 + "Time : 10:00:00"]
    text += [" " * 60 + "Date : 01:01.2024", line, f"  Result file : {stem.name}.dat", line]
    text += ["   Scans    Channels    Time [sec]      Format"]
    text += [f"   {n:8d}    {len(NAMES):3d}       {n * dt:8.3f}       "]
    text[-1] += "BINARY" if binary else "ASCII"
    text += ["", "  Channel   Variable Description               ", ""]
    for i, (name, unit) in enumerate(NAMES, 1):
        text.append(f"  {i:4d}      {name:30s} {unit:10s} some words")
    text.append(line)
    if binary:
        text += ["Scale factors:", *(f"  {s:.5E}" for s in scales)]
        scales = np.array([float(f"{s:.5E}") for s in scales])
        stem.with_suffix(".dat").write_bytes(np.round(values / scales).astype("<i2").T.tobytes())
    else:
        np.savetxt(stem.with_suffix(".dat"), values, fmt="%14.6E")
    stem.with_suffix(".sel").write_text("\n".join(text) + "\n")
    return values


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("suffix", [".sel", ".dat"])
def test_both_kinds_are_read_in_si_units_and_the_frame_of_the_cube(tmp_path, binary, suffix):
    stem = tmp_path / "run"
    values = write(stem, binary)
    series = read_hawc2(stem.with_suffix(suffix), channels=CHANNELS)
    assert float(series.file_start) == pytest.approx(100.05, abs=1e-9)
    np.testing.assert_allclose(series.time, 0.05 * np.arange(600), atol=1e-9)
    np.testing.assert_allclose(series.speed, values[:, 1], rtol=5e-5)
    force = 1e3 * np.array([-values[:, 5], values[:, 3], -values[:, 4]])
    moment = 1e3 * np.array([-values[:, 8], values[:, 6], -values[:, 7]])
    np.testing.assert_allclose(series.hub_force, force, atol=15)
    np.testing.assert_allclose(series.hub_moment, moment, atol=15)


def test_a_run_of_two_files_is_one_case(tmp_path):
    write(tmp_path / "a_dlc12_v10_s1", binary=True)
    write(tmp_path / "a_dlc12_v10_s2", binary=True)
    cube = read_loads(tmp_path, channels=CHANNELS)
    assert cube.case.values.tolist() == ["dlc1.2_v10_s1", "dlc1.2_v10_s2"]


def test_list_of_cases_may_name_either_file_of_a_run(tmp_path):
    write(tmp_path / "run", binary=True)
    for suffix in ("sel", "dat"):
        table = tmp_path / "cases.txt"
        table.write_text(f"file,dlc,wind_speed,seed\nrun.{suffix},1.2,10,3\n")
        cube = read_loads(tmp_path / "run.sel", cases=table, channels=CHANNELS)
        assert cube.case.values.tolist() == ["dlc1.2_v10_s3"]


def test_a_name_may_hold_further_dots(tmp_path):
    write(tmp_path / "run", binary=True)
    expected = read_hawc2(tmp_path / "run.sel", channels=CHANNELS)
    for suffix in (".sel", ".dat"):
        (tmp_path / f"run{suffix}").rename(tmp_path / f"turb_wsp08.0_s15536{suffix}")
    for suffix in (".sel", ".dat"):
        cube = read_loads(tmp_path / f"turb_wsp08.0_s15536{suffix}", channels=CHANNELS)
        np.testing.assert_array_equal(cube.hub_force.isel(case=0), expected.hub_force)
    assert cube.case.values.tolist() == ["unknown_v8_s15536"]


def test_loads_must_be_named(tmp_path):
    write(tmp_path / "run", binary=True)
    with pytest.raises(
        InputError,
        match=r"6 channels are missing: one for 'hub_force_x' .* has #1 Time, #2 .*Name the loads",
    ):
        read_hawc2(tmp_path / "run.sel")


def test_truncated_and_missing_files_are_named(tmp_path):
    for binary in (True, False):
        write(tmp_path / "run", binary)
        data = tmp_path / "run.dat"
        data.write_bytes(data.read_bytes()[: 100 * 14 * 9 + 100 * 9 if not binary else -100])
        with pytest.raises(InputError, match=r"run\.dat"):
            read_hawc2(tmp_path / "run.sel", channels=CHANNELS)
    listing = tmp_path / "run.sel"
    for share in (0, 0.3, 0.6, 0.8):
        write(tmp_path / "run", binary=True)
        listing.write_text(listing.read_text()[: int(share * listing.stat().st_size)])
        with pytest.raises(InputError, match=r"run\.sel: no list of HAWC2 channels, or truncated"):
            read_hawc2(listing, channels=CHANNELS)
    (tmp_path / "run.dat").unlink()
    with pytest.raises(InputError, match=r"run\.dat: no such file"):
        read_hawc2(listing, channels=CHANNELS)
