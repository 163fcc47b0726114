"""Bladed files, text and binary."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.readers import read_bladed, read_loads

HUB = [f"Stationary hub {k}{a}" for k in "MF" for a in "xyz"]


def write_group(stem, number, names, units, values, access="D", start=5.0, step=0.04):
    n, count = values.shape
    header = {
        "FILE": f"{stem.name}.${number}",
        "ACCESS": access,
        "FORM": "U" if access == "D" else "F",
        "RECL": 4,
        "FORMAT": "R*4",
        "CONTENT": "POWPROD",
        "CONFIG": "STATIONARY",
        "NDIMENS": 2,
        "DIMENS": f"{count} {n}",
        "GENLAB": "'A group'",
        "VARIAB": " ".join(f"'{name}'" for name in names),
        "VARUNIT": " ".join(units),
        "AXISLAB": "'Time'",
        "AXIUNIT": "T",
        "AXIMETH": 2,
        "MIN": f"{start:.6E}",
        "STEP": f"{step:.6E}",
    }
    text = "\n".join(f"{k}\t{v}" for k, v in header.items()) + "\n"
    stem.with_suffix(f".%{number}").write_text(text)
    data = stem.with_suffix(f".${number}")
    if access == "D":
        data.write_bytes(values.astype("<f4").tobytes())
    else:
        np.savetxt(data, values)


def write_run(stem, access="D", n=200):
    values = 1e5 * np.random.default_rng(2).normal(size=(n, 6))
    write_group(stem, "23", HUB, ["FL"] * 3 + ["F"] * 3, values, access)
    drive = np.column_stack([np.full(n, 1.2), np.linspace(0, 6, n)])
    write_group(stem, "05", ["Rotor speed", "Rotor azimuth angle"], ["A/T", "A"], drive, access)
    return values


@pytest.mark.parametrize("access", ["D", "S"])
@pytest.mark.parametrize("suffix", [".%23", ".$05", ".$PJ"])
def test_groups_of_a_run_are_joined(tmp_path, access, suffix):
    values = write_run(tmp_path / "run", access)
    series = read_bladed(tmp_path / f"run{suffix}")
    assert float(series.file_start) == 5.0
    np.testing.assert_allclose(series.time, 0.04 * np.arange(200))
    np.testing.assert_allclose(series.hub_moment, values[:, :3].T, rtol=1e-6)
    np.testing.assert_allclose(series.hub_force, values[:, 3:].T, rtol=1e-6)
    np.testing.assert_allclose(series.speed, 1.2, rtol=1e-6)


def test_files_of_a_run_are_one_case_and_other_groups_are_left_alone(tmp_path):
    write_run(tmp_path / "a_dlc12_v10_s1")
    write_run(tmp_path / "a_dlc12_v10_s2")
    stations = tmp_path / "a_dlc12_v10_s1.%41"
    stations.write_text("NDIMENS\t3\nAXISLAB\t'Distance along blade'\n")
    cube = read_loads(tmp_path)
    assert cube.case.values.tolist() == ["dlc1.2_v10_s1", "dlc1.2_v10_s2"]


def test_unsound_runs_are_refused(tmp_path):
    stem = tmp_path / "run"
    with pytest.raises(InputError, match="no header"):
        read_bladed(tmp_path / "run.%23")
    values = write_run(stem)
    data = tmp_path / "run.$23"
    data.write_bytes(data.read_bytes()[:-3])
    with pytest.raises(InputError, match=r"run\.\$23: 1199 values where its header says 6 × 200"):
        read_bladed(data)
    write_group(stem, "23", HUB, ["FL"] * 6, values)
    with pytest.raises(InputError, match="'Stationary hub Fx': unit 'N m' cannot be read as 'N'"):
        read_bladed(data)
    write_group(stem, "23", HUB, ["FL"] * 3 + ["F"] * 3, values, step=0.05)
    with pytest.raises(InputError, match="times differ"):
        read_bladed(data)
    data.unlink()
    with pytest.raises(InputError, match="no such file"):
        read_bladed(data)
    (tmp_path / "run.%23").write_text("NDIMENS\t2\n")
    with pytest.raises(InputError, match="no Bladed header, or truncated"):
        read_bladed(data)
