"""Rolling bearings of a comparison are as warm as their friction and cooling make them."""

import math

import numpy as np
import pytest
import xarray as xr

from loadflow.rolling import BallBearing
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.friction import Friction
from loadflow.stages.rolling import warm_bearing
from loadflow.studies.candidate.factor import grown
from loadflow.studies.candidate.friction import rolling_losses
from loadflow.studies.candidate.margins import looked_at, lubrication
from loadflow.studies.candidate.rolling_warmth import HOTTEST, Warmth, warmest, warmth_of

COOLING, AIR = 40.0, 288.15


@pytest.fixture(scope="module")
def cooled(cooled_run):
    """Folder, scene and table of a run whose bearing finds its temperature, and what is told."""
    friction = {"conductance": COOLING, "ambient_temperature": AIR}
    sections = {"shaft": {"moment": {}}, "candidates": {"double-row-tapered": {}}}
    return cooled_run(friction=friction, **sections)[:4]


def test_losses_of_a_comparison_are_what_the_cooling_carries_off(cooled):
    folder, scene, table, _ = cooled
    losses = rolling_losses(scene, folder, table).power.sel(bearing="M", case=table["case"])
    shed = COOLING * (table["bearing_temperature"].sel(bearing="M") - AIR)
    assert float(shed.min()) > 100.0
    np.testing.assert_allclose(losses.values, shed.values, rtol=0.05)  # in few samples


def test_load_cases_without_an_answer_are_left_out_of_losses_and_margin(cooled):
    folder, scene, table, _ = cooled
    answered = table.isel(case=[-1])
    losses = rolling_losses(scene, folder, answered)
    assert losses.power["case"].values.tolist() == answered["case"].values.tolist()
    missed = answered.reindex(case=table["case"].values)  # as beside a film that has all of them
    asked = [case for case, _ in looked_at(folder, "M", missed)]
    assert asked == answered["case"].values.tolist() != table["case"].values.tolist()


def test_the_page_tells_the_warmest_bearing_and_what_cools_it(cooled):
    *_, table, numbers = cooled
    warm = numbers["bearing_temperature"]
    assert warm.value == pytest.approx(float(table["bearing_temperature"].max()) - 273.15)
    assert warm.low <= warm.value <= warm.high
    assert "40 W/K to 15 °C" in warm.note
    assert "as warm as its heat balance has it" in numbers["viscosity_ratio"].note


def test_a_band_by_the_temperature_of_the_oil_is_around_that_of_the_heat_balance(cooled):
    """κ goes with the viscosity, whose slope is less the warmer the oil is."""
    _, scene, table, numbers = cooled
    warm, oil = float(table["bearing_temperature"].max()), lubrication(scene.friction).oil
    kappa = numbers["viscosity_ratio"]
    thinner, thicker = (
        float(oil.kinematic_viscosity(warm + more) / oil.kinematic_viscosity(warm))
        for more in (5.0, -5.0)
    )
    assert kappa.tolerance == "oil temperature"
    assert kappa.tolerance_low / kappa.value == pytest.approx(thinner, rel=1e-3)
    assert kappa.tolerance_high / kappa.value == pytest.approx(thicker, rel=1e-3)


@pytest.mark.parametrize(("factor", "share"), [(1.3, 0.2), (2.0, 0.2)])
def test_the_warmth_under_other_loads_is_that_of_their_heat_balance(cooled, factor, share):
    folder, scene, table, _ = cooled
    case, some = next(iter(looked_at(folder, "M", table)))
    warmth = warmth_of(scene, "M", table, [(case, some)])
    asked = warm_bearing(scene, "M", grown(some, factor))[1]
    stated = warmth.under(case, 1.0)
    assert stated == float(table["bearing_temperature"].sel(case=case, bearing="M"))
    # a power of the load; few samples begin some tenths of a kelvin off
    assert warmth.under(case, factor) == pytest.approx(asked, abs=share * abs(asked - stated) + 0.3)


def test_a_stated_temperature_stays_and_one_that_sheds_no_more_heat_ends_where_oils_do():
    stated = Warmth({"a": 313.15}, {"a": 0.0}, 293.15)
    assert stated.under("a", 3.0) == stated.under("a", 0.3) == 313.15
    runaway = Warmth({"a": 313.15}, {"a": math.inf}, 293.15)
    assert (runaway.under("a", 0.9), runaway.under("a", 1.1)) == (313.15, HOTTEST)


def test_a_stated_temperature_tells_the_cooling_with_which_losses_give_it():
    cases = {"case": ["a", "b"], "bearing": ["N", "N2"]}
    table = xr.Dataset(
        {"bearing_temperature": (("case", "bearing"), np.full((2, 2), 313.15))}, cases
    )
    power = xr.DataArray([[200.0, 800.0], [600.0, 800.0]], cases, ("case", "bearing"))
    parts = _two_parts()
    found = warmest(Friction(), parts, table, power, np.array([0.75, 0.25]))
    assert found.value == pytest.approx(40.0)
    assert "cooling of 15, 40 W/K (N, N2) to 20 °C" in found.note
    cold = warmest(Friction(temperature=283.15), parts, table, power, np.ones(2))
    assert "no warmer than the air" in cold.note


def _two_parts():
    balls = BallBearing(balls=20, ball_diameter=0.05, pitch_diameter=0.6, groove_radius=0.026)
    return {place: FurtherBearing(bearing=place, geometry=balls) for place in ("N", "N2")}
