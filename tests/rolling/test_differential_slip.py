"""Sliding of barrels in raceways curved along them: against closed forms and the local law."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from loadflow.rolling import FrictionOptions, RollerBearing, SphericalRollerBearing
from loadflow.rolling.friction import ball_losses, line_film, raceway_radius, torques_beside
from loadflow.rolling.friction.catalogued import CatalogueEntry
from loadflow.rolling.friction.differential_slip import curved_lines, mean_deviation
from loadflow.tribology import asperities, lubricant, traction
from loadflow.tribology.hertz import effective_modulus

GREASE = FrictionOptions(oil=lubricant("lgep-2"), temperature=313.15)
DRY = dataclasses.replace(GREASE, roughness=1e-3)  # asperities carry all: constant coefficient
# of the boundary dimensions of 231/750
LARGE = SphericalRollerBearing(
    rollers=24, roller_diameter=0.112, roller_length=0.145, pitch_diameter=0.995,
    contact_angle=0.185, clearance=3e-4, profile="crowned", crown_radius=18.0,
    dynamic_capacity=16518e3,
)  # fmt: skip
ONE_ROW = SphericalRollerBearing(
    rollers=28, roller_diameter=0.08, roller_length=0.12, pitch_diameter=0.95, rows=1,
    profile="straight",
)  # fmt: skip


def test_one_row_of_barrels_takes_no_thrust():
    assert LARGE.takes_thrust
    assert not ONE_ROW.takes_thrust


def stations(n=2000):
    return (np.arange(n) + 0.5) * 2 / n - 1


def test_the_load_of_an_ellipse_gives_the_constant_of_balls():
    y = stations()
    assert mean_deviation(y**2, 1 - y**2) == pytest.approx(ball_losses._HEATHCOTE, rel=1e-5)


@pytest.mark.parametrize(("lean", "mean"), [(0.0, 1 / 4), (2.0, 1.0), (5.0, 2.5)])
def test_a_parabola_that_leans_slides_after_its_closed_form(lean, mean):
    """Even load on y² + k y: 1/4 of the rise without lean; k/2 where it rises all the way."""
    y = stations()
    assert mean_deviation(y**2 + lean * y, np.ones_like(y)) == pytest.approx(mean, rel=1e-5)


def test_straight_profiles_without_contact_angle_have_the_closed_form():
    """Contact as curved as the sphere, load even: the mean slides with a quarter of the rise."""
    sphere = 0.95 / 2 + 0.04
    found = curved_lines(ONE_ROW, np.array([1.0, 1e3, 1e5]))
    np.testing.assert_allclose(found.lever, 0.06**2 / (2 * sphere) / 4, rtol=1e-4)
    np.testing.assert_allclose(found.area, 1.0, rtol=1e-6)


def test_short_contacts_of_crowned_barrels_slide_as_their_load_lies():
    """Load (1 - t²)^(10/9) within the ends: lever and area by quadrature, whatever the force."""
    one = dataclasses.replace(ONE_ROW, profile="crowned", crown_radius=10.0)
    y, sphere = stations(), 0.95 / 2 + 0.04
    load = (1 - y**2) ** (10 / 9)
    rise = mean_deviation(y**2, load) * (1 / sphere + 1 / 20) / 2
    for force in (100.0, 3000.0):
        found = curved_lines(one, np.array([force]))
        law = one.slices * one.slice_stiffness
        # half the length a of Q = law δ^(10/9) 2a/L mean(load), δ = a²/R
        a = (force / (law * load.mean()) * 0.06 * 10.0 ** (10 / 9)) ** (9 / 29)
        assert a < 0.06
        assert found.lever == pytest.approx(rise * a**2, rel=1e-3)
        area = math.sqrt(a / 0.06 / load.mean()) * np.sqrt(load).mean()
        assert found.area == pytest.approx(area, rel=1e-3)


def test_a_constant_coefficient_loses_it_times_load_and_mean_sliding():
    result = ONE_ROW.equilibrium((5e5, 0.0, 0.0))
    found = result.friction(1.5, DRY)
    u = 1.5 * 0.95 / 4 * (1 - (0.08 / 0.95) ** 2)
    lever = 0.06**2 / (8 * (0.95 / 2 + 0.04))
    turning = sum(u / raceway_radius(0.08, 0.08 / 0.95, ring) for ring in ("inner", "outer"))
    lost = DRY.boundary_friction * result.force_sum * lever * turning
    assert found.losses["differential slip"] == pytest.approx(float(lost), rel=1e-3)


def by_places(bearing, force, ring, speed, options):
    """Loss of one barrel: film and asperities at each place, slip such that forces balance."""
    y = np.linspace(-0.5, 0.5, 4001) * bearing.roller_length
    step = y[1] - y[0]
    radius = raceway_radius(bearing.roller_diameter, bearing.gamma, ring)
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))

    def line_load(approach):
        law = bearing.slice_stiffness * bearing.slices / bearing.roller_length
        return law * np.maximum(approach - 2 * bearing.drop_at(y), 0.0) ** (10 / 9)

    approach = brentq(lambda d: line_load(d).sum() * step - force, 1e-8, 5e-3)
    load = line_load(approach)
    wide = 2 * np.sqrt(8 * load * radius / (np.pi * modulus))
    pressure = load / np.maximum(wide, 1e-30)
    u = speed * bearing.pitch_diameter / 4 * (1 - bearing.gamma**2)
    film = line_film(
        np.array([force]), bearing.roller_length, radius, modulus, np.array([u]), options
    ).film[0]
    touching = asperities.asperity_share(asperities.film_parameter(film, options.roughness))
    oil = options.oil
    limit = traction.limiting_stress(
        pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    thick = oil.viscosity(options.temperature, pressure)
    # speeds of both surfaces as seen from the cage: barrel about its axis, ring about the bearing's
    sphere = bearing.pitch_diameter / 2 / np.cos(bearing.contact_angle)
    sphere += bearing.roller_diameter / 2
    height = y**2 / 2 * (1 / sphere + 1 / (2 * bearing.crown_radius))
    seen = speed / 2 * (1 + bearing.gamma if ring == "inner" else 1 - bearing.gamma)
    apart = u / radius * height + seen * np.sin(bearing.contact_angle) * y

    def stress(sliding):
        newton = traction.newtonian_stress(thick, sliding, film)
        dry = options.boundary_friction * np.tanh(sliding / 1e-6) * pressure
        return (1 - touching) * traction.smooth_stress(newton, limit) + touching * dry

    pure = brentq(lambda v: (stress(apart - v) * wide).sum(), -0.1, 0.1)
    return float((stress(apart - pure) * (apart - pure) * wide).sum() * step)


@pytest.mark.parametrize("roughness", [0.5e-6, 2e-6])
@pytest.mark.parametrize("radial", [5e5, 2e6])
def test_one_coefficient_loses_what_the_law_at_each_place_does(radial, roughness):
    options = dataclasses.replace(GREASE, roughness=roughness)
    result = LARGE.equilibrium((radial, 0.0, 0.0))
    loads = result.roller_forces.ravel()
    places = sum(
        by_places(LARGE, force, ring, 1.2, options)
        for force in loads[loads > 0]
        for ring in ("inner", "outer")
    )
    found = float(result.friction(1.2, options).losses["differential slip"])
    assert found == pytest.approx(places, rel=0.2)


def test_a_spherical_bearing_is_nearly_as_rough_as_its_catalogue_says():
    """0.16 … 0.36 of it without the sliding of barrels."""
    entry = CatalogueEntry(bore=0.75, outside_diameter=1.22, series="231")
    loaded = LARGE.equilibrium(np.outer([0.05, 0.1, 0.2], (16518e3, 0.0, 0.0)))
    found = loaded.friction(1.2, GREASE)
    ratio = found.torque / torques_beside(loaded, 1.2, GREASE, entry)["skf"]
    assert ((ratio > 0.4) & (ratio < 1.0)).all()
    share = found.losses["differential slip"] / found.power
    assert (np.diff(share) > 0).all()  # the wider the contact the more it slides


def test_slip_vanishes_without_load_and_at_standstill_and_turns_either_way():
    result = LARGE.equilibrium((1e6, 0.0, 3e5))
    found = result.friction(np.array([-1.2, 0.0, 1.2]), GREASE)
    back, still, forth = found.losses["differential slip"]
    assert back == forth > 0
    assert still == 0
    assert (found.sliding[1] == 0).all()
    idle = result.roller_forces == 0
    assert idle.any()
    assert (found.sliding[2][idle] == 0).all()
    assert (found.slip_power_density[2][idle] == 0).all()
    assert (found.slip_power_density[2][~idle] > 0).all()


@pytest.mark.parametrize("profile", ["iso", "straight"])
def test_any_profile_slides(profile):
    one = dataclasses.replace(LARGE, profile=profile, crown_radius=None)
    assert one.equilibrium((1e6, 0.0, 0.0)).friction(1.2, GREASE).losses["differential slip"] > 0


def test_rollers_in_straight_raceways_do_not_slide():
    pair = RollerBearing(
        rollers=48, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8,
        contact_angle=0.35, rows=2, row_spacing=0.12,
    )  # fmt: skip
    found = pair.equilibrium((0.0, -4e5, 1e5)).friction(1.5, GREASE)
    assert "differential slip" not in found.losses
    assert found.sliding is None
