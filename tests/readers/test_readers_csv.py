"""CSV files with units in the heading."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.readers import read_csv, read_loads
from loadflow.readers.csv_text import is_series

HEADING = [
    "time [s]",
    "speed [rpm]",
    "wind [m/s]",
    "hub_force_x [kN]",
    "hub_force_y [N]",
    "hub_force_z [MN]",
    "hub_moment_x [kNm]",
    "hub_moment_y [N m]",
    "hub_moment_z [kN m]",
]
FACTORS = [1, np.pi / 30, 1, 1e3, 1, 1e6, 1e3, 1, 1e3]


def write(path, heading=HEADING, n=50, separator=",", change=lambda rows: rows, intro=""):
    values = np.random.default_rng(0).normal(size=(n, len(heading)))
    values[:, 0] = 0.05 * np.arange(n)
    rows = change([separator.join(f"{x:.9g}" for x in row) for row in values])
    path.write_text(intro + "\n".join([separator.join(heading), *rows]) + "\n")
    return values


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_columns_arrive_in_si_units(tmp_path, separator):
    path = tmp_path / "a.csv"
    values = write(path, separator=separator, intro="# measured\n") * FACTORS
    series = read_csv(path)
    np.testing.assert_allclose(series.speed, values[:, 1], rtol=1e-6)
    np.testing.assert_allclose(series.hub_force, values[:, 3:6].T, rtol=1e-6)
    np.testing.assert_allclose(series.hub_moment, values[:, 6:9].T, rtol=1e-6)
    assert set(series.data_vars) == {"speed", "wind", "hub_force", "hub_moment"}


@pytest.mark.parametrize("separator", [";", "\t"])
def test_a_decimal_comma_is_read_where_it_does_not_separate(tmp_path, separator):
    path = tmp_path / "a.csv"
    values = write(
        path, separator=separator, change=lambda rows: [row.replace(".", ",") for row in rows]
    )
    np.testing.assert_allclose(read_csv(path).speed, values[:, 1] * np.pi / 30, rtol=1e-6)


@pytest.mark.parametrize("mark", ["#", "##"])
def test_a_file_is_recognised_by_its_heading_wherever_its_start_ends(tmp_path, mark):
    """Were it within a character, the mark of UTF-8 before "time" would be read as Latin-1."""
    path = tmp_path / "a.csv"
    write(path, change=lambda rows: [mark + 2**16 * "ö", *rows])
    path.write_text(path.read_text(encoding="utf-8"), encoding="utf-8-sig")
    assert is_series(path)


def test_columns_of_other_names_and_signs(tmp_path):
    path = tmp_path / "a.csv"
    values = write(path, [h.replace("hub_force_y", "Fy right") for h in HEADING])
    series = read_csv(path, channels={"hub_force_y": "-Fy right"})
    np.testing.assert_allclose(series.hub_force.sel(axis="y"), -values[:, 4], rtol=1e-6)


def test_csv_series_make_a_cube(tmp_path):
    for seed in (1, 2):
        write(tmp_path / f"own_dlc11_v08_s{seed}.csv")
    cube = read_loads(f"{tmp_path}/*.csv")
    assert cube.case.values.tolist() == ["dlc1.1_v8_s1", "dlc1.1_v8_s2"]


def at(row, column, text):
    def change(rows):
        fields = rows[row].split(",")
        fields[column] = text
        return [*rows[:row], ",".join(fields), *rows[row + 1 :]]

    return change


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"heading": [h.split(" [")[0] for h in HEADING]}, "column 'time' has no unit"),
        ({"heading": [h.replace("[rpm]", "[km/h]") for h in HEADING]}, "'speed': unit 'km/h'"),
        ({"heading": [h.replace("time", "clock") for h in HEADING]}, "column 'time' is missing"),
        ({"heading": HEADING[:-1]}, "channel 'hub_moment_z' .* is missing"),
        ({"heading": [*HEADING, "speed [rpm]"]}, r"2 channels 'speed'; name one: #2, #10"),
        ({"n": 0}, "a heading but no time step"),
        ({"change": at(7, 3, "")}, r"'hub_force_x', index 7 .*value nan"),
        ({"change": at(7, 3, "inf")}, r"'hub_force_x', index 7 .*value inf"),
        ({"change": at(7, 3, "one")}, "'hub_force_x', index 7: 'one' is not a number"),
        ({"change": at(7, 0, "0.36")}, "'time', index 7: steps are not equal"),
        ({"change": at(7, 0, "0.3")}, "'time', index 7: value 0.3 does not rise"),
        ({"change": at(7, 0, "")}, "'time', index 7 .*not finite"),
        ({"change": lambda rows: [*rows[:-1], rows[-1][:30]]}, "index 49 .*not finite"),
    ],
)
def test_unsound_files_are_refused_with_the_place(tmp_path, options, message):
    write(tmp_path / "bad.csv", **options)
    with pytest.raises(InputError, match=rf"bad\.csv.*{message}"):
        read_csv(tmp_path / "bad.csv")


def test_empty_file_binary_file_and_missing_file(tmp_path):
    path = tmp_path / "bad.csv"
    with pytest.raises(InputError, match="no such file"):
        read_csv(path)
    path.write_text("")
    with pytest.raises(InputError, match="is empty"):
        read_csv(path)
    path.write_bytes(bytes(range(256)))
    with pytest.raises(InputError, match=r"bad\.csv"):
        read_csv(path)


OWN = {
    "time": "Zeit",
    "speed": "Drehzahl",
    "hub_force_x": "Fx",
    "hub_force_y": "Fy",
    "hub_force_z": "Fz",
    "hub_moment_x": "Mx",
    "hub_moment_y": "My",
    "hub_moment_z": "Mz",
}


def own_names():
    names = dict(zip(OWN, HEADING[:2] + HEADING[3:]))
    return {column: f"{OWN[key]} [{column.partition('[')[2]}" for key, column in names.items()}


def test_the_column_of_the_time_may_be_named_otherwise(tmp_path):
    path = tmp_path / "a.csv"
    values = write(path, heading=[own_names().get(one, one) for one in HEADING])
    series = read_csv(path, channels=OWN)
    assert float(series.time[-1]) == pytest.approx(values[-1, 0])
    np.testing.assert_allclose(series.hub_force.sel(axis="x"), 1e3 * values[:, 3], rtol=1e-6)
    with pytest.raises(InputError, match=r"column 'time' is missing; the file has Zeit.*time ="):
        read_csv(path, channels={key: name for key, name in OWN.items() if key != "time"})
    with pytest.raises(InputError, match="column 'Zeti' is missing"):
        read_csv(path, channels=OWN | {"time": "Zeti"})


def test_time_may_begin_with_a_capital_letter(tmp_path):
    path = tmp_path / "a.csv"
    write(path, heading=["Time [s]", *HEADING[1:]])
    assert is_series(path)
    assert read_csv(path).sizes["time"] == 50


def test_a_folder_of_files_that_none_is_known_by_names_them(tmp_path):
    write(tmp_path / "Lauf.csv", heading=[own_names().get(one, one) for one in HEADING])
    with pytest.raises(InputError, match=r"no load file that is known as such; .*: Lauf\.csv"):
        read_loads(tmp_path)
