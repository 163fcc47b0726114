"""Turbulent flow in the film: closed forms, consistency, and what goes with it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from loadflow.errors import InputError, ValidityWarning
from loadflow.journal import (
    Contact,
    Crown,
    Film,
    FilmHeat,
    GasMixture,
    Guembel,
    Heat,
    JournalBearing,
    LocalShell,
    Lubricant,
    Sommerfeld,
    ThrustBearing,
    Turbulence,
    UnitBearing,
)
from loadflow.tribology import AsperityContact

WATER = Lubricant(viscosity=1e-3, density=1000.0)
SPEED, LOAD = 100.0, np.array([2e4, 3e3])
BEARING = JournalBearing(0.5, 0.5, 1e-3)  # Re = 6250 at 100 rad/s, 4.79 Re_cr
EVERYWHERE = Turbulence(0.0, 0.0)
PASSING = Turbulence(1.0, 8.0)  # the gap lies where laminar flow passes over
MIXTURE = Film(
    WATER, GasMixture(5e4), edge_pressure=1e5, inlet=None, grading="uniform", grid=(48, 16),
    turbulence=PASSING,
)  # fmt: skip


def reynolds(bearing=BEARING, speed=SPEED):
    return 1000.0 * speed * bearing.radius * bearing.clearance / 1e-3


def along(number):
    return 1.0 + 0.0136 / 12.0 * number**0.9


def across(number):
    return 1.0 + 0.0043 / 12.0 * number**0.96


# --- closed forms -----------------------------------------------------------------------------


def test_factors_pass_from_laminar_to_turbulent_flow_without_a_kink():
    gaps = np.linspace(0.05, 1.6, 4001)
    rows = Turbulence().factors(BEARING, SPEED, WATER, gaps)
    onset = reynolds() / (41.3 / np.sqrt(1e-3))
    laminar, full = onset * gaps**1.5 <= 1.0, onset * gaps**1.5 >= 2.0
    assert min(laminar.sum(), full.sum()) > 100
    fits = (along(reynolds() * gaps), across(reynolds() * gaps))
    for row, fit in zip(rows, (*fits, 1.0 + 0.0012 * (reynolds() * gaps) ** 0.94)):
        assert np.all(row[laminar] == 1.0)
        assert row[full] == pytest.approx(fit[full], rel=1e-13)
        slope = np.gradient(row, gaps)
        assert np.abs(np.diff(slope)).max() < 0.02 * slope.max()


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_a_film_below_the_critical_number_is_the_laminar_one(rung):
    thick = Lubricant(viscosity=1e-2, density=1000.0)
    film = Film(thick, GasMixture(5e4), edge_pressure=1e5, inlet=None, grid=(36, 12), rung=rung)
    states = [
        BEARING.equilibrium((2e5, 0.0), SPEED, replace(film, turbulence=turbulence), tilt=(0, 1e-5))
        for turbulence in (None, Turbulence())
    ]
    for name in ("eccentricity", "friction_power", "side_flow", "stiffness", "damping"):
        laminar, turbulent = (getattr(state, name) for state in states)
        size = np.abs(laminar).max()
        assert turbulent == pytest.approx(laminar, rel=1e-9, abs=1e-8 * size)


def test_a_centred_shaft_has_the_turbulent_shear_of_petroff():
    film = Film(WATER, Sommerfeld(), inlet=None, grid=(24, 8), turbulence=EVERYWHERE)
    found = BEARING.equilibrium((0.0, 0.0), SPEED, film).friction_power
    petroff = 2 * np.pi * 1e-3 * SPEED**2 * BEARING.radius**3 * BEARING.width / BEARING.clearance
    assert found == pytest.approx(petroff * (1.0 + 0.0012 * reynolds() ** 0.94), rel=1e-12)


def errors_of(bearing, exact, grids, value):
    found = []
    for grid in grids:
        film = Film(WATER, Sommerfeld(), inlet=None, grid=grid, turbulence=EVERYWHERE,
                    grading="uniform")  # fmt: skip
        found.append(value(bearing, film) / exact - 1.0)
    return np.array(found)


def order(errors):
    """Order in the cells, of three grids each twice as fine as the last."""
    first, second = -np.diff(errors)
    return np.log2(first / second)


def test_a_short_bearing_has_the_load_of_its_closed_form_in_second_order():
    bearing, ratio = JournalBearing(0.5, 0.01, 1e-3), 0.6
    radius, half, clearance = bearing.radius, 0.5 * bearing.width, bearing.clearance

    def specific(angle):  # p = 3 η ω k_z/12 h'/h³ (z² − B²/4), whole width, across the load
        h = 1.0 - ratio * np.cos(angle)
        slope = 6e-3 * SPEED / (clearance**2 * h**3) * ratio * np.sin(angle)
        return -slope * across(reynolds(bearing) * h) * 2.0 / 3.0 * half**3 * np.sin(angle)

    exact = abs(quad(specific, 0.0, 2 * np.pi)[0]) * radius

    def load(one, film):
        field = one.pressure((ratio * clearance, 0.0), SPEED, film)
        return float(np.hypot(*field.force))

    errors = errors_of(bearing, exact, [(60, 16), (120, 32), (240, 64)], load)
    assert np.abs(errors[-1]) < 1e-3
    assert order(errors) == pytest.approx(2.0, abs=0.1)
    laminar = abs(quad(lambda a: specific(a) / across(reynolds(bearing) * (1 - ratio * np.cos(a))),
                       0.0, 2 * np.pi)[0]) * radius  # fmt: skip
    assert exact > 2.0 * laminar


def test_the_middle_of_a_long_bearing_has_the_pressure_of_one_dimension():
    bearing, ratio = JournalBearing(0.5, 8.0, 1e-3), 0.6
    clearance = bearing.clearance
    scale = 6e-3 * SPEED * bearing.radius**2 / clearance**2

    def resistance(power):
        def inner(angle):
            h = 1.0 - ratio * np.cos(angle)
            return along(reynolds(bearing) * h) / h**power

        return inner

    still = quad(resistance(2), 0, 2 * np.pi)[0] / quad(resistance(3), 0, 2 * np.pi)[0]
    rise = quad(lambda a: resistance(2)(a) - still * resistance(3)(a), 0.0, 0.5 * np.pi)[0]
    fall = quad(lambda a: resistance(2)(a) - still * resistance(3)(a), -0.5 * np.pi, 0.0)[0]
    exact = scale * (rise + fall)  # p(π/2) − p(−π/2)

    def between(one, film):
        field = one.pressure((ratio * clearance, 0.0), SPEED, film)
        middle = field.pressure[:, field.z.size // 2]
        around = np.append(field.angle, field.angle[0] + 2 * np.pi)
        at = np.interp([0.5 * np.pi, 1.5 * np.pi], around, np.append(middle, middle[0]))
        return float(at[0] - at[1])

    errors = errors_of(bearing, exact, [(60, 40), (120, 40), (240, 40)], between)
    assert np.abs(errors[-1]) < 2e-5
    assert order(errors) == pytest.approx(2.0, abs=0.1)


# --- consistency ------------------------------------------------------------------------------

ROUGH = Contact(
    AsperityContact(roughness=5e-6, contact_modulus=1e11, factor=1e-3), pattern=3.0, shaft_share=0.8
)
KINDS = {
    "cylinder": ({}, {}),
    "crown": ({"relief": (Crown(5e-5, 0.1),)}, {}),
    "rough": ({}, {"contact": ROUGH}),
    "rough crown": ({"relief": (Crown(5e-5, 0.1),)}, {"contact": ROUGH}),
    "shell": ({}, {"shell": LocalShell(2e-10)}),
    "rough shell": ({}, {"shell": LocalShell(2e-10), "contact": ROUGH}),
}


@pytest.mark.parametrize("kind", KINDS)
def test_stiffness_and_damping_are_the_slopes_of_the_force(kind):
    bearing, film = replace(BEARING, **KINDS[kind][0]), replace(MIXTURE, **KINDS[kind][1])
    state = bearing.equilibrium(LOAD, SPEED, film)
    step = 1e-4 * bearing.clearance
    for column, way in enumerate(np.eye(2)):
        beside = [
            bearing.pressure(state.eccentricity + sign * step * way, SPEED, film).force
            for sign in (1.0, -1.0)
        ]
        slope = (beside[0] - beside[1]) / (2 * step)
        assert slope == pytest.approx(state.stiffness[:2, column], rel=2e-5, abs=2e2)
        if "shell" not in kind:  # whose gap follows the motion, too
            moving = [
                bearing.pressure(state.eccentricity, SPEED, film, sign * step * way).force
                for sign in (1.0, -1.0)
            ]
            slope = (moving[0] - moving[1]) / (2 * step)
            assert slope == pytest.approx(state.damping[:2, column], rel=2e-5, abs=2e1)


@pytest.mark.parametrize("kind", ["cylinder", "rough", "shell"])
@pytest.mark.parametrize("line", [{}, {"tilt": (1e-4, 2e-4)}], ids=["aligned", "tilted"])
def test_reduced_is_as_near_to_the_grid_as_in_laminar_flow(kind, line):
    film = replace(MIXTURE, **KINDS[kind][1])
    fine = BEARING.equilibrium(LOAD, SPEED, replace(film, grid=(48, 40)), **line)
    few = BEARING.equilibrium(LOAD, SPEED, replace(film, rung="reduced"), **line)
    for name, bound in (("eccentricity_ratio", 2e-3), ("minimum_film", 2e-3),
                        ("maximum_pressure", 6e-3), ("friction_power", 1e-3)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(fine, name), rel=bound)
    size = np.abs(fine.stiffness[:2, :2]).max(), np.abs(fine.damping[:2, :2]).max()
    assert few.stiffness[:2, :2] == pytest.approx(fine.stiffness[:2, :2], abs=1e-2 * size[0])
    assert few.damping[:2, :2] == pytest.approx(fine.damping[:2, :2], abs=1e-2 * size[1])


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_a_path_ends_where_its_last_load_and_speed_rest(rung):
    film = replace(MIXTURE, rung=rung)
    time = np.linspace(0.0, 2.0, 81)
    speed = np.where(time < 0.5, 60.0 + 80.0 * time, SPEED)
    path = BEARING.orbit(time, np.tile(LOAD, (time.size, 1)), speed, film)
    start, end = (BEARING.equilibrium(LOAD, omega, film) for omega in (60.0, SPEED))
    assert path.friction_power[0] == pytest.approx(float(start.friction_power), rel=1e-9)
    assert path.eccentricity_ratio[-1] == pytest.approx(float(end.eccentricity_ratio), rel=1e-6)
    assert path.friction_power[-1] == pytest.approx(float(end.friction_power), rel=1e-6)


# --- heat -------------------------------------------------------------------------------------


def test_a_warm_film_is_the_isothermal_one_at_its_temperature():
    heat = Heat("iso-vg-68", inlet_temperature=353.15, transfer=2e4, ambient_temperature=343.15)
    film = Film(None, GasMixture(5e4), edge_pressure=1e5, heat=heat, inlet=None, grid=(36, 12),
                turbulence=PASSING)  # fmt: skip
    warm = BEARING.equilibrium((2e5, 0.0), 600.0, film)
    oil = heat.lubricant(float(warm.temperature))
    own = BEARING.equilibrium((2e5, 0.0), 600.0, replace(film, heat=None, lubricant=oil))
    for name in ("eccentricity_ratio", "friction_power", "side_flow", "reynolds_number"):
        assert getattr(warm, name) == pytest.approx(getattr(own, name), rel=1e-6)
    assert own.reynolds_number > 1.5 * own.critical_reynolds_number


def test_stored_heat_follows_the_reynolds_number_of_the_warm_oil():
    heat = Heat("iso-vg-68", inlet_temperature=353.15, transfer=2e4, ambient_temperature=343.15,
                capacity=1e3, start_temperature=353.15)  # fmt: skip
    film = Film(None, GasMixture(5e4), edge_pressure=1e5, heat=heat, inlet=None, grid=(36, 12),
                rung="reduced", turbulence=PASSING)  # fmt: skip
    time = np.linspace(0.0, 1.0, 101)
    path = BEARING.orbit(time, np.tile([2e5, 0.0], (time.size, 1)), 600.0, film)
    warm = float(path.temperature[-1])
    assert warm > 356.0
    oil = heat.lubricant(warm)
    own = BEARING.equilibrium((2e5, 0.0), 600.0, replace(film, heat=None, lubricant=oil))
    assert path.eccentricity_ratio[-1] == pytest.approx(float(own.eccentricity_ratio), rel=2e-4)
    assert path.friction_power[-1] == pytest.approx(float(own.friction_power), rel=2e-4)


# --- what is asked for ------------------------------------------------------------------------


def test_the_warning_names_what_to_switch_on_and_is_silent_then():
    film = replace(MIXTURE, turbulence=None)
    with pytest.warns(ValidityWarning, match=r"turbulence = Turbulence\(\)"):
        BEARING.equilibrium(LOAD, SPEED, film)
    BEARING.equilibrium(LOAD, SPEED, MIXTURE)  # warnings are errors


def test_what_does_not_know_turbulence_refuses_it_by_name():
    with pytest.raises(InputError, match="turbulence"):
        BEARING.equilibrium(LOAD, SPEED, Film(WATER, rung="chart", turbulence=Turbulence()))
    over_area = Film(None, GasMixture(5e4), 1e5, heat=FilmHeat(), turbulence=Turbulence())
    with pytest.raises(InputError, match="turbulence"):
        BEARING.equilibrium(LOAD, SPEED, over_area)
    ring = ThrustBearing(6, 0.5, 1.0, 0.785, taper=1e-4, wedge=0.75)
    with pytest.raises(InputError, match="turbulence"):
        ring.pressure(gap=1e-4, speed=10.0, film=Film(WATER, Guembel(), turbulence=Turbulence()))
    with pytest.raises(InputError, match="turbulence"):
        UnitBearing(0.5).equilibrium((1.0, 0.0), turbulence=Turbulence())
    with pytest.raises(InputError, match="end"):
        Turbulence(begin=2.0, end=1.0)
    with pytest.raises(InputError, match="turbulence"):
        Film(WATER, turbulence=True)
