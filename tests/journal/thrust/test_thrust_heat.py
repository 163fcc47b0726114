"""Thrust bearings as warm as their own friction makes them, and around a tilted collar."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConicalBearing,
    DoubleThrustBearing,
    Film,
    FilmHeat,
    GasMixture,
    Guembel,
    Heat,
    JournalBearing,
    PadHeat,
    Pivot,
    ThrustBearing,
)
from loadflow.tribology import ExponentialOil

LANDS = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
COLLAR = DoubleThrustBearing(LANDS, LANDS, play=4e-4)


def film_of(heat, law=None):
    return Film(None, law or Guembel(), edge_pressure=1e5, grid=(16, 8), heat=heat)


WARM = film_of(PadHeat("iso-vg-68"))


def heat_out(found, heat):
    """What leaves a row of pads with its oil, W: what is not carried over, and comes fresh."""
    side = found.side_flow.sum()
    gone = found.flow - heat.carry_over * (found.flow - side)
    return heat.volume_heat * gone * (found.outlet_temperature - heat.inlet_temperature)


@pytest.mark.parametrize("law", [None, GasMixture(5e4)], ids=["guembel", "gas mixture"])
@pytest.mark.parametrize("share", [0.0, 0.8])
def test_all_friction_leaves_with_the_oil(share, law):
    heat = PadHeat("iso-vg-68", carry_over=share)
    found = LANDS.equilibrium(1e6, 10.0, film_of(heat, law))
    assert found.converged
    assert found.heat_residual < 1e-8
    assert heat_out(found, heat) == pytest.approx(found.friction_power, rel=1e-8)
    mean = 0.5 * (found.inlet_temperature + found.outlet_temperature)
    assert found.temperature == pytest.approx(mean, abs=1e-8)
    assert found.viscosity == pytest.approx(float(heat.liquid.viscosity(found.temperature)))


def test_a_warm_film_is_the_isothermal_one_of_its_viscosity():
    found = LANDS.equilibrium(1e6, 10.0, WARM)
    cool = Film(WARM.heat.lubricant(found.temperature), Guembel(), 1e5, grid=(16, 8))
    alone = LANDS.equilibrium(1e6, 10.0, cool)
    assert found.minimum_film == pytest.approx(alone.minimum_film, rel=1e-9)
    assert found.friction_power == pytest.approx(alone.friction_power, rel=1e-9)


def test_oil_that_takes_any_heat_stays_as_it_enters():
    found = LANDS.equilibrium(1e6, 10.0, film_of(PadHeat("iso-vg-68", heat_capacity=1e12)))
    cool = LANDS.equilibrium(1e6, 10.0, WARM.isothermal())
    assert found.temperature == pytest.approx(313.15, abs=1e-6)
    assert found.minimum_film == pytest.approx(cool.minimum_film, rel=1e-6)


def test_with_constant_viscosity_the_closed_form_is_exact():
    heat = PadHeat(ExponentialOil(reference_viscosity=0.05), carry_over=0.5)
    found = LANDS.pressure(1e-4, 10.0, film_of(heat))
    kept = 0.5 * (1.0 - found.side_flow.sum() / found.flow)
    rise = found.friction_power / (heat.volume_heat * found.flow)
    assert found.temperature - 313.15 == pytest.approx(rise * (kept / (1 - kept) + 0.5), rel=1e-9)


def test_each_side_of_a_collar_has_its_own_temperature():
    found = COLLAR.equilibrium(1e6, 10.0, WARM)
    assert found.converged
    assert found.front.temperature > found.back.temperature + 1.0
    for row in (found.front, found.back):
        assert heat_out(row, WARM.heat) == pytest.approx(row.friction_power, rel=1e-8)
    assert found.force == pytest.approx(1e6, rel=1e-8)


def test_a_pad_of_a_hydro_turbine_is_as_warm_as_elsewhere_computed():
    """Spec 6 B6 [S], a golden value of code, good for 15 % and 5 K; it mixes no hot oil in.

    Its film over the pivot, 131 µm, is not met: ours is 105 µm, on tilts that are in balance.
    """
    oil = ExponentialOil(
        reference_viscosity=0.05707, constant_steepness=math.log(57.07 / 7.665) / 60,
        reference_density=867.0,
    )  # fmt: skip
    pads = ThrustBearing(
        12, 1.15, 1.725, math.radians(26), pivot=Pivot(15 / 26, (1.4425 - 1.15) / 0.575)
    )
    film = Film(None, Guembel(), grid=(20, 10), heat=PadHeat(oil, 313.15, 1951.0, 0.0))
    found = pads.equilibrium(13.32e6, 90 * math.pi / 30, film)
    assert found.minimum_film == pytest.approx(82e-6, rel=0.15)
    assert found.maximum_pressure == pytest.approx(6.957e6, rel=0.15)
    assert found.outlet_temperature - 273.15 == pytest.approx(70.4, abs=5.0)
    assert found.gap == pytest.approx(105e-6, rel=0.01)


def test_a_film_without_a_balance_says_so():
    with pytest.raises(SolverError, match="no heat balance below"):
        LANDS.pressure(5e-6, 300.0, film_of(PadHeat("iso-vg-68", carry_over=0.99)))


@pytest.mark.parametrize("heat", [Heat(), FilmHeat()], ids=["balance", "film"])
def test_heat_of_journal_bearings_is_refused_by_name(heat):
    with pytest.raises(InputError, match=r"heat = .*PadHeat"):
        LANDS.pressure(1e-4, 10.0, film_of(heat))


def test_heat_of_pads_is_refused_where_it_is_not_known():
    with pytest.raises(InputError, match="heat = PadHeat"):
        JournalBearing(0.2, 0.1, 1e-3).equilibrium((5e3, 0.0), 50.0, film_of(PadHeat()))
    with pytest.raises(InputError, match="heat = PadHeat"):
        ConicalBearing(0.5, (1.0, 1.5), 1e-4).equilibrium((5e3, 0.0, -1e5), 50.0, WARM)
    with pytest.raises(InputError, match="heat = PadHeat"):
        LANDS.orbit([0.0, 0.1], [1e6, 1e6], 10.0, WARM)


# --- a collar that is held tilted ---------------------------------------------------------------


def test_the_films_of_a_tilted_collar_are_those_of_its_rows():
    film, tilt = WARM.isothermal(), np.array([3e-5, -2e-5])
    found = COLLAR.equilibrium(1e6, 10.0, film, tilt=tilt)
    front = LANDS.pressure(found.gap, 10.0, film, tilt=tilt)
    back = LANDS.pressure(4e-4 - found.gap, 10.0, film, tilt=-tilt)
    assert front.force - back.force == pytest.approx(1e6, rel=1e-8)
    assert found.minimum_film == pytest.approx(front.minimum_film, rel=1e-12)
    aligned = COLLAR.equilibrium(1e6, 10.0, film)
    assert found.minimum_film < aligned.minimum_film
    assert found.maximum_pressure > aligned.maximum_pressure


def test_the_sense_of_a_tilt_turns_with_the_pads():
    film = WARM.isothermal()
    turned = [(3e-5 * math.cos(a), 3e-5 * math.sin(a)) for a in np.arange(3) * math.pi / 3]
    films = [COLLAR.equilibrium(1e6, 10.0, film, tilt=tilt).minimum_film for tilt in turned]
    np.testing.assert_allclose(films, films[0], rtol=1e-8)  # six pads


def test_a_collar_whose_play_leaves_no_room_for_the_tilt_is_told():
    with pytest.raises(SolverError, match="no room for the tilt"):
        COLLAR.equilibrium(1e6, 10.0, WARM, tilt=(2.5e-4, 0.0))
