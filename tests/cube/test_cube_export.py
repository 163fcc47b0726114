"""A cube as CSV, Parquet and MATLAB file holds the numbers of the cube."""

import numpy as np
import pandas as pd
import pytest
from scipy.io import loadmat
from synthetic import case

from loadflow.cube import export_cube, make_cube
from loadflow.errors import InputError


@pytest.fixture
def cube():
    """Two lengths, so that the cube is a tree."""
    return make_cube([case(8.0, 1, steps=40), case(12.0, 2, steps=30)])


def read_table(path):
    if path.suffix == ".csv":
        return pd.read_csv(path, comment="#", dtype={"dlc": str})
    pytest.importorskip("pyarrow")
    return pd.read_parquet(path)


@pytest.mark.parametrize("ending", [".csv", ".parquet"])
def test_a_table_has_a_row_for_each_time_and_a_column_for_each_component(cube, tmp_path, ending):
    if ending == ".parquet":
        pytest.importorskip("pyarrow")
    path = export_cube(cube, tmp_path / f"loads{ending}")
    table = read_table(path)
    assert len(table) == 70
    for wind, seed, steps in ((8.0, 1, 40), (12.0, 2, 30)):
        whole = case(wind, seed, steps=steps)
        part = table[table["seed"] == seed]
        assert set(part["case"]) == {f"dlc1.1_v{wind:g}_s{seed}"}
        assert set(part["dlc"]) == {"1.1"}
        np.testing.assert_allclose(part["time"], whole["time"])
        np.testing.assert_allclose(part["speed"], whole["speed"], rtol=1e-15)
        expected = whole["hub_moment"].sel(axis="z")
        np.testing.assert_allclose(part["hub_moment.z"], expected, rtol=1e-15)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]  # nothing temporary is left


def test_units_are_stated(cube, tmp_path):
    first = export_cube(cube, tmp_path / "a.csv").read_text().splitlines()[0]
    assert first.startswith("# units: time s, ")
    assert "hub_moment.y N m" in first
    pq = pytest.importorskip("pyarrow.parquet")
    metadata = pq.read_schema(export_cube(cube, tmp_path / "a.parquet")).metadata
    assert b"hub_moment.y N m" in metadata[b"units"]


def test_a_matlab_file_has_a_structure_for_each_case(cube, tmp_path):
    content = loadmat(export_cube(cube, tmp_path / "a.mat"), simplify_cells=True)
    found = content["dlc1_1_v12_s2"]
    expected = case(12.0, 2, steps=30)
    np.testing.assert_array_equal(found["hub_force"], expected["hub_force"].values)
    np.testing.assert_array_equal(found["time"], expected["time"].values)
    assert (found["wind_speed"], found["seed"], found["dlc"]) == (12.0, 2, "1.1")
    assert content["units"]["hub_force"] == "N"


def test_another_ending_is_refused(cube, tmp_path):
    with pytest.raises(InputError, match=r"ending '.xls'; allowed: .csv, .parquet, .mat"):
        export_cube(cube, tmp_path / "a.xls")
