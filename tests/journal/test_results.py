"""Results say what they are: units, meaning and dimensions, and a short line."""

import numpy as np
import pytest

from loadflow.journal import (
    Film,
    Groove,
    Heat,
    JournalBearing,
    Lubricant,
    Reynolds,
    Supply,
    TiltingPads,
)
from loadflow.quantities import FILM

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING = JournalBearing(**SIZE)
OIL = Lubricant(0.03)
LOADS = [[(8e3, 0.0), (9e3, 0.0)], [(8e3, 1e3), (9e3, 1e3)], [(8e3, 2e3), (9e3, 2e3)]]
COARSE = Film(OIL, grid=(36, 8))
FED = Film(OIL, supply=Supply((Groove(3.0, arc=0.3, pressure=1e5),)), grid=(36, 8))
PADS = JournalBearing(**SIZE, shape=TiltingPads(4, 1.2, preload=0.3))


def states():
    yield BEARING.equilibrium(LOADS, 100.0, COARSE)
    yield BEARING.equilibrium(LOADS[0][0], 100.0, FED)
    yield BEARING.equilibrium(LOADS[0], 100.0, Film(heat=Heat(), grid=(24, 8)))
    yield BEARING.equilibrium(LOADS[0][0], 100.0, Film(OIL, rung="chart"))
    yield BEARING.equilibrium(LOADS[0], 100.0, COARSE, tilt=(1e-5, 0.0))
    yield PADS.equilibrium(LOADS[0][0], 100.0, Film(OIL, grid=(72, 8)))
    yield BEARING.pressure([(3e-5, 0.0), (4e-5, 0.0)], 100.0, COARSE)
    yield BEARING.pressure((3e-5, 0.0), 100.0, COARSE)


@pytest.mark.parametrize("number", range(8))
def test_a_dataset_holds_every_field_with_units_and_meaning(number):
    state = list(states())[number]
    data = state.to_dataset()
    known = {n: v for n, v in vars(state).items() if v is not None}
    if known.pop("relative_grid_error", None) is not None:
        bounds = vars(state.grid_error).items()
        known |= {"resolved": state.resolved} | {f"{n}_grid_error": v for n, v in bounds}
    assert set(data.data_vars) == set(known)
    for name, variable in data.data_vars.items():
        assert variable.attrs == FILM[name].attributes
        np.testing.assert_array_equal(variable.values.ravel(), np.ravel(known[name]))
    assert ("case" in data.dims) == (np.ndim(state.converged) > 0)


def test_dimensions_say_what_a_number_belongs_to():
    data = BEARING.equilibrium(LOADS, 100.0, COARSE).to_dataset()
    assert data.force.dims == ("case", "axis")
    assert data.stiffness.dims == ("case", "dof", "along")
    assert float(data.force.sel(case=3, axis="y")) == 1e3
    field = BEARING.pressure((3e-5, 0.0), 100.0, COARSE).to_dataset()
    assert field.pressure.dims == ("around", "across")
    assert field.z.dims == ("across",)
    tilted = BEARING.equilibrium(LOADS[0][0], 100.0, COARSE, tilt=(1e-5, 0.0)).to_dataset()
    assert list(tilted.dof.values) == ["e_x", "e_y", "tilt_x", "tilt_y"]


def test_an_orbit_has_the_units_of_the_table():
    time = np.linspace(0.0, 0.01, 3)
    orbit = BEARING.orbit(time, np.tile((8e3, 0.0), (3, 1)), 100.0, COARSE)
    for name, variable in orbit.data_vars.items():
        assert variable.attrs == FILM[name].attributes


def test_a_result_is_one_readable_line():
    one = BEARING.equilibrium((8e3, 0.0), 100.0, COARSE)
    assert repr(one).startswith(f"<Equilibrium: ε = {one.eccentricity_ratio:.4g}, h_min = ")
    many = BEARING.equilibrium([(8e3, 0.0), (8e3, 0.0)], [100.0, 0.0], COARSE, strict=False)
    assert "2 loads, 1 converged; extremes ε = " in repr(many)
    none = BEARING.equilibrium((8e3, 0.0), 0.0, COARSE, strict=False)
    assert repr(none) == "<Equilibrium: 1 loads, none converged>"
    assert len(repr(BEARING.pressure((3e-5, 0.0), 100.0, COARSE))) < 100


def test_the_law_by_default_is_that_of_reynolds():
    assert Film(OIL).law == Reynolds()
