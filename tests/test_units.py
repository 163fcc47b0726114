"""Units are those that pint reads, so that results can be taken further with units."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case

from loadflow.cube.schema import VARIABLES
from loadflow.journal import JournalBearing, Lubricant
from loadflow.journal.thrust.pad_results import ThrustResult
from loadflow.quantities import FILM, ROLLING, percent
from loadflow.stages import friction, rolling
from loadflow.stages.films import summary as film_summary
from loadflow.studies.design.point import NUMBERS

pint = pytest.importorskip("pint", reason="pint is not installed (extra test)")
READS = pint.UnitRegistry()

TABLES = {
    "film": {name: quantity.units for name, quantity in FILM.items()},
    "rolling": {name: quantity.units for name, quantity in ROLLING.items()},
    "cube": {name: variable.units for name, variable in VARIABLES.items()},
    "journal stage": {name: units for name, (_, units, _) in film_summary.MEANS.items()},
    "rolling stage": {name: units for name, (units, _) in (rolling.KEPT | rolling.EACH).items()},
    "friction stage": {name: units for name, (units, _) in friction.KEPT.items()},
    "design": {name: units for name, (units, _) in NUMBERS.items()},
    "thrust": {name: units for name, (_, units, _) in ThrustResult._table.items()},
}


@pytest.mark.parametrize("table", TABLES)
def test_pint_reads_every_unit_of_the_tables(table):
    """A quantity of several components states the unit of each, parted by commas."""
    assert TABLES[table]
    for name, units in TABLES[table].items():
        for unit in units.split(", "):
            assert READS.parse_units(unit) is not None, name


def test_a_life_in_turns_is_one_in_turns():
    life = READS.Quantity(2.0, ROLLING["rating_life"].units)
    assert life.to("revolution").magnitude == pytest.approx(2e6)


def test_a_unit_of_flow_is_a_flow():
    assert READS.Quantity(1.0, FILM["side_flow"].units).to("l/min").magnitude == pytest.approx(6e4)
    assert READS.Quantity(1.0, friction.KEPT["slip_power_density"][0]).check("[power]/[length]**2")


def test_a_wrong_unit_is_found():
    with pytest.raises(pint.errors.UndefinedUnitError):
        READS.parse_expression("m3/s")


def test_results_and_cubes_carry_units_that_pint_reads():
    bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    state = bearing.equilibrium((5e3, 0.0), 50.0, Lubricant(0.05), grid=(36, 8))
    for data in (state.to_dataset(), case(8.0, 1, steps=10)):
        assert isinstance(data, xr.Dataset)
        for name, variable in data.data_vars.items():
            for unit in variable.attrs["units"].split(", "):
                READS.parse_units(unit)
            assert variable.attrs["long_name"], name
    power = READS.Quantity(float(state.friction_power), FILM["friction_power"].units)
    assert np.isclose(power.to("kW").magnitude, state.friction_power / 1e3)


@pytest.mark.parametrize(
    ("share", "said"),
    [(0.0123, "1.2 %"), (0.9961, "100 %"), (12.34, "1200 %"), (2e-6, "0.0002 %"), (0.0, "0 %")],
)
def test_percentages_are_written_out(share, said):
    assert percent(share) == said
