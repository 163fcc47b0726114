"""The parameter file: exact round trip, and errors that name the line."""

import numpy as np
import pandas as pd
import pytest
from load_record import record

from loadflow.errors import InputError
from loadflow.reduction import histogram, read_parameter_file, write_parameter_file


@pytest.mark.parametrize("pick", ["random", "extremes"])
def test_round_trip_is_exact(tmp_path, pick):
    reduced = histogram(*record(3000), pick=pick, seed=9, source="V = 12 m/s, seed 1 = first ")
    write_parameter_file(tmp_path / "p.csv", reduced)
    back = read_parameter_file(tmp_path / "p.csv")
    for name in ("index", "time", "speed", "force", "weight", "counts_full", "counts_reduced"):
        ours, theirs = getattr(reduced, name), getattr(back, name)
        assert ours.dtype == theirs.dtype
        np.testing.assert_array_equal(ours, theirs, err_msg=name)
    for ours, theirs in zip(reduced.edges, back.edges):
        np.testing.assert_array_equal(ours, theirs)
    assert (back.pick, back.seed, back.source, back.total) == (pick, 9, reduced.source, 3000)


@pytest.mark.parametrize(
    ("line", "text", "message"),
    [
        (1, "something else", "line 1: is not"),
        (2, "# sauce = x", 'line 2: "# source'),
        (4, "# seed = x", "line 4: seed = 'x' is no integer"),
        (5, "# speed_edges = 1 x", "line 5: could not convert"),
        (6, "# force_edges = 2 1", "line 6: force_edges must ascend"),
        (7, "# units = - s rpm N N -", "line 7: units are"),
        (8, "time,speed", "line 8: columns are"),
        (9, "1,2,3", "line 9: 3 numbers; 6 are needed"),
        (10, "1,2,3,4,5,six", "line 10: could not convert"),
        (10, "1,2,3,4,nan,6", "line 10: a number is not finite"),
        (11, "1,2,999,4,5,6", "line 11: 999 lies outside the class edges"),
        (9, None, "line 9: the table is empty"),
        (3, None, 'line 3: "# pick'),
    ],
)
def test_bad_files_name_the_line(tmp_path, line, text, message):
    path = tmp_path / "p.csv"
    write_parameter_file(path, histogram(*record(200)))
    lines = path.read_text().splitlines()
    lines = lines[: line - 1] if text is None else [*lines[: line - 1], text, *lines[line:]]
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match=message):
        read_parameter_file(path)


def test_missing_and_binary_files_and_broken_source(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_parameter_file(tmp_path / "none.txt")
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(InputError, match="cannot be read"):
        read_parameter_file(tmp_path / "binary")
    with pytest.raises(InputError, match="one line"):
        write_parameter_file(tmp_path / "p", histogram(*record(50), source="a\nb"))


def test_pandas_reads_the_table_with_names(tmp_path):
    reduced = histogram(*record(500))
    write_parameter_file(tmp_path / "p.csv", reduced)
    table = pd.read_csv(tmp_path / "p.csv", comment="#", float_precision="round_trip")
    assert list(table) == ["index", "time", "speed", "force_x", "force_y", "weight"]
    np.testing.assert_array_equal(table["force_y"], reduced.force[:, 1])
    np.testing.assert_array_equal(table["index"], reduced.index)


def test_the_first_form_is_still_read(tmp_path):
    """As the package wrote it before: the names among the attributes, blanks between numbers."""
    reduced = histogram(*record(500), source="V = 12 m/s, first")
    path = tmp_path / "p.csv"
    write_parameter_file(path, reduced)
    lines = path.read_text().splitlines()
    lines[0] = "# loadflow parameter file 1"
    lines[6:8] = ["# columns = index time speed force_x force_y weight", lines[6]]
    lines[8:] = [line.replace(",", " ") for line in lines[8:]]
    path.write_text("\n".join(lines))
    back = read_parameter_file(path)
    np.testing.assert_array_equal(back.force, reduced.force)
    np.testing.assert_array_equal(back.counts_full, reduced.counts_full)
    assert back.source == reduced.source
    path.write_text("\n".join([*lines[:9], "1 2 3"]))
    with pytest.raises(InputError, match="line 10: 3 numbers"):
        read_parameter_file(path)
