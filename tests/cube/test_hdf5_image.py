"""Files by the shortest way hold what those of xarray's own engine hold."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case

from loadflow.cube import make_cube, open_cube
from loadflow.cube.files import ENGINE
from loadflow.cube.hdf5 import read_whole
from loadflow.cube.hdf5_image import image
from loadflow.cube.schema import CUBE


def found():
    """What stages find: kinds of values, labels over dimensions, scalars, words, nothing."""
    units = {"units": "1", "long_name": "something"}
    return xr.Dataset(
        {
            "share": (("case", "time"), np.array([[0.5, np.nan], [1, 2]], "float32"), units),
            "converged": (("case",), np.array([True, False]), units),
            "count": ((), np.int64(3), units),
            "said": (("case",), np.array(["", "μ is large"]), units),
            "empty": (("sample",), np.zeros(0), units),
        },
        {
            "case": ["one", "two"],
            "dlc": ("case", ["1.1", "6.4"]),
            "time": ("time", [0.0, 0.25], {"units": "s", "long_name": "time"}),
            "weight": 0.5,
            "tripped": np.nan,
        },
        {"residual": 1e-9, "source": "a case", "order": [3, 1, 2]},
    )


TREES = {
    "a stage": found,
    "groups": lambda: xr.DataTree.from_dict({"/": found(), "/N2": found(), "/M/inner": found()}),
    "a cube": lambda: make_cube([case(8.0, 1, steps=50), case(8.0, 2, steps=50)]),
    "cases of two lengths": lambda: make_cube([case(8.0, 1, steps=50), case(8.0, 2, steps=60)]),
}


def nodes(data):
    if isinstance(data, xr.Dataset):
        return [data]
    return [node.to_dataset(inherit=False) for node in data.subtree]


@pytest.mark.parametrize("name", TREES)
def test_what_is_written_and_read_by_the_shortest_way_is_what_xarray_has(tmp_path, name):
    cube = TREES[name]()
    ours, theirs = tmp_path / "ours.h5", tmp_path / "theirs.h5"
    ours.write_bytes(image(cube))
    marked = cube.copy()
    marked.attrs = {**cube.attrs, CUBE.key: CUBE.version}
    marked.to_netcdf(theirs, engine=ENGINE)
    for other in (*map(read_whole, (ours, theirs)), open_cube(ours).load()):
        xr.testing.assert_identical(other, cube)
        for one, two in zip(nodes(cube), nodes(other), strict=True):
            assert list(one.data_vars) == list(two.data_vars)
            kinds = [
                {k: (v.dtype.kind, v.dims) for k, v in x.variables.items()} for x in (one, two)
            ]
            assert kinds[0] == kinds[1]


def test_the_same_values_are_the_same_bytes():
    assert image(found()) == image(found())
