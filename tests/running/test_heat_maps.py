"""Coloured cells of a report: what is drawn are the counts, each where its class is."""

import base64
import io
import re

import matplotlib as mpl
import numpy as np
from matplotlib.image import imread

from loadflow.report.heat import Cells, heat_maps


def _pictures(drawn):
    found = re.findall(r"data:image/png;base64,([^\"]+)", drawn)
    return [imread(io.BytesIO(base64.b64decode(one)), format="png") for one in found]


def test_each_class_has_the_colour_of_its_count_and_empty_ones_none():
    values = np.array([[1.0, 2.0, np.nan], [3.0, 4.0, 5.0]])
    drawn = heat_maps([Cells(np.arange(3.0), np.arange(4.0), values, ("x", "y", "n"))])
    picture = _pictures(drawn)[0]
    cells = picture[::-1][1::4, 1::4].transpose(1, 0, 2)  # first row on top; four points a cell
    want = mpl.colormaps["viridis"]((values - 1.0) / 4.0)
    assert np.allclose(cells[..., 3], np.isfinite(values))
    shown = np.isfinite(values)
    assert np.allclose(cells[shown], want[shown], atol=1 / 255)


def test_classes_of_different_width_lie_where_their_edges_are():
    edges = np.array([0.0, 3.0, 4.0])
    drawn = heat_maps([Cells(edges, np.arange(2.0), np.array([[1.0], [2.0]]), ("x", "y", "n"))])
    row = _pictures(drawn)[0][0]
    changes = np.flatnonzero(np.any(np.diff(row, axis=0) != 0, axis=1)) + 1
    assert changes.tolist() == [row.shape[0] * 3 // 4]


def test_cells_without_any_count_are_drawn_empty():
    nothing = np.full((2, 2), np.nan)
    drawn = heat_maps([Cells(np.arange(3.0), np.arange(3.0), nothing, ("a < b", "y", "n"))])
    assert not _pictures(drawn)[0][..., 3].any()
    assert "a &lt; b" in drawn
