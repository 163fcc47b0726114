"""The parameter file: exact round trip, and errors that name the line."""

import numpy as np
import pytest
from load_record import record

from loadflow.errors import InputError
from loadflow.reduction import histogram, read_parameter_file, write_parameter_file


@pytest.mark.parametrize("pick", ["random", "extremes"])
def test_round_trip_is_exact(tmp_path, pick):
    reduced = histogram(*record(3000), pick=pick, seed=9, source="V = 12 m/s, seed 1 = first ")
    write_parameter_file(tmp_path / "p.txt", reduced)
    back = read_parameter_file(tmp_path / "p.txt")
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
        (7, "# columns = time", "line 7: columns are"),
        (8, "# units = - s rpm N N -", "line 8: units are"),
        (9, "1 2 3", "line 9: 3 numbers; 6 are needed"),
        (10, "1 2 3 4 5 six", "line 10: could not convert"),
        (10, "1 2 3 4 nan 6", "line 10: a number is not finite"),
        (11, "1 2 999 4 5 6", "line 11: 999 lies outside the class edges"),
        (9, None, "line 9: the table is empty"),
        (3, None, 'line 3: "# pick'),
    ],
)
def test_bad_files_name_the_line(tmp_path, line, text, message):
    path = tmp_path / "p.txt"
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
