"""Components of friction: areas by quadrature, variants, Coulomb balance, churning, catalogues."""

import itertools

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from roller_energy import rib_shear
from scipy.integrate import quad

from loadflow.errors import InputError, SolverError
from loadflow.rolling import friction, kinematics
from loadflow.rolling.friction import catalogue, coulomb, guides, roller_drag, rolling_resistance
from loadflow.rolling.motion import radial_load
from loadflow.tribology import asperities, contact_film, traction
from loadflow.validation.friction import MAIN, MAIN_RACES, MODULUS


@pytest.mark.parametrize(("radius", "height"), [(5.5, 1.6), (3.75, 0.4), (20.0, 6.0)])
def test_areas_of_the_roller_end_by_quadrature(radius, height):
    def chord(y):
        return 2 * np.sqrt(radius**2 - y**2)

    def across(y):
        return 2 * (radius**2 - y**2) ** 1.5 / 3

    left = radius - height
    segment = {
        "area": quad(lambda y: y * chord(y), left, radius)[0],
        "square": quad(lambda y: y * y * chord(y), left, radius)[0],
    }
    assert roller_drag.segment_area_moment(radius, height) == pytest.approx(
        segment["area"], rel=1e-7
    )
    assert roller_drag.segment_square(radius, height) == pytest.approx(segment["square"], rel=1e-7)
    polar = segment["square"] + quad(across, left, radius)[0]
    assert roller_drag.segment_polar(radius, height) == pytest.approx(2 * polar, rel=1e-7)
    strip = 2 * quad(lambda y: y * y * chord(y) + across(y), 0, height)[0]
    assert roller_drag.strip_moment(radius, height) == pytest.approx(strip, rel=1e-7)


def test_pocket_is_the_flat_bar_of_the_drawing():
    r, s, delta, angle = 5.5e-3, 0.39e-3, 3.84e-6, np.radians(30)

    def side(gap):  # 2 ∫ dθ ρ/(gap at θ) over the half angle, without the constant η ρ² l
        return 2 * quad(lambda a: r / ((r + gap) / np.cos(a) - r), 0, angle, epsabs=0)[0]

    exact = side(2 * s) + side(delta)
    ours = 2 * roller_drag.pocket_integral(s, r, angle, delta) - 4 * angle
    assert ours == pytest.approx(exact, rel=1e-6)
    thesis = roller_drag.pocket_integral(s, r, angle, delta, "thesis")
    assert thesis > 2.5 * roller_drag.pocket_integral(s, r, angle, delta)


def test_variants_change_what_they_name():
    args = (MAIN, 0.037, 9 / 22)
    found = {v: friction.drag_constants(*args, variant=v) for v in roller_drag.VARIANTS}
    assert found["geometric"].spin < found["thesis"].spin
    assert found["thesis"].orbit < 0 < found["printed"].orbit
    with pytest.raises(InputError, match="geometric"):
        friction.drag_constants(*args, variant="guess")


@pytest.mark.parametrize("rib", ["outer", "inner"])
@pytest.mark.parametrize(("spin", "ring"), [(278.0, -43.0), (100.0, 60.0), (0.0, -43.0)])
def test_rib_shear_by_integration_over_the_segment(rib, spin, ring):
    found = rib_shear(MAIN, 0.037, spin, ring, rib)
    r, h, pitch, side = MAIN.radius, MAIN.rib_height, MAIN.pitch_diameter / 2, 1.0
    if rib == "inner":
        side = -1.0
    nodes, weights = np.polynomial.legendre.leggauss(60)
    angle = np.arccos((r - h) / r) * nodes  # across the segment by angle, out by radius
    inside = (r - h) / np.cos(angle)
    rho = (r + inside + (r - inside) * nodes[:, None]) / 2
    area = rho * (r - inside) / 2 * np.arccos((r - h) / r) * weights[:, None] * weights
    x, y = rho * np.sin(angle), side * rho * np.cos(angle)
    slip_x, slip_y = -ring * (pitch + y) - spin * y, (ring + spin) * x  # rib less roller
    film = 2 * 0.037 / 0.06e-3
    assert found.moment == pytest.approx(film * (area * (x * slip_y - y * slip_x)).sum(), rel=1e-6)
    assert found.force == pytest.approx(film * -(area * slip_x).sum(), rel=1e-6)
    assert found.loss == pytest.approx(film * (area * (slip_x**2 + slip_y**2)).sum(), rel=1e-6)


def test_drag_constants_hold_the_moment_of_the_rib():
    """C₁ and C₃₂ of ideal rolling against the shear over the rib."""
    cage, spin = kinematics.ideal_speeds(100.0, 0.0, *MAIN_RACES)
    viscous = friction.drag_constants(MAIN, 0.037, 9 / 22)
    without = roller_drag.rib_constant(MAIN, 0.037)
    shear = rib_shear(MAIN, 0.037, spin, -cage)
    assert shear.moment == pytest.approx(without * spin + viscous.orbit * 100.0, rel=1e-9)


def test_driving_moment_is_the_balance_of_the_roller():
    mu, sliding, rho = 0.12, 0.04, 5.5e-3
    for driving, rib, r, n, u, b in itertools.product(
        ("inner", "outer"), ("outer", "inner"), (0.0, 300.0), (0.6, 5.0), (0.0, 0.3), (0.0, 0.02)
    ):
        k = coulomb.cage_force(n, u, b, mu, sliding, driving, rib)
        exact = 2 * mu * r + mu * (n + sliding * k) - sliding * k
        if driving == "outer":  # N < 0 presses the roller outward; K counts the other way
            exact = 2 * mu * r + mu * (n - sliding * k) - sliding * k
        ours = coulomb.driving_moment(r, n, u, b, rho, mu, sliding, driving, rib)
        assert ours == pytest.approx(rho * exact, rel=1e-12)


def test_printed_losses_differ_as_stated():
    assert coulomb.pocket_loss(1.0, 300.0, 5.5e-3, 0.04) == pytest.approx(
        25 * coulomb.pocket_loss(1.0, 300.0, 5.5e-3, 0.04, "printed")
    )
    args = (100.0, 0.6, 0.1, 20.0, 5.5e-3, 0.04, 0.09)
    assert coulomb.sliding_loss(*args, variant="printed") < coulomb.sliding_loss(*args)


def test_pocket_always_loses():
    loss = coulomb.pocket_loss(np.array([3.0, -3.0]), np.array([200.0, -200.0]), 5e-3, 0.04)
    assert (loss > 0).all()


@given(st.floats(0.05, 0.9), st.floats(-50, 50), st.floats(-50, 50))
def test_ideal_rolling_has_no_sliding(ratio, inner, outer):
    d, big = 0.4 * ratio, 0.4
    cage, spin = kinematics.ideal_speeds(inner, outer, d, big)
    v = kinematics.contact_speeds(inner, outer, cage, spin, d, big)
    scale = 1e-12 * (1 + abs(inner) + abs(outer))
    assert abs(v.sliding_inner) < scale
    assert abs(v.sliding_outer) < scale
    gamma = (big - d) / (big + d)
    mean = kinematics.entrainment_speed(inner, outer, (d + big) / 2, gamma)
    assert abs(v.mean_inner) == pytest.approx(mean, rel=1e-9, abs=1e-12)


def test_rigid_rolling_force_is_martins_by_quadrature():
    h = 1.0  # film over x = √(2 R h) tan γ; rupture where p = p' = 0

    def slope(g, at):
        return (1 - at * np.cos(g) ** 2) * np.cos(g) ** 2

    from scipy.optimize import brentq

    def end(at):
        return quad(slope, -np.pi / 2, np.arctan(np.sqrt(at - 1)), args=(at,))[0]

    at = brentq(end, 1.05, 1.5)
    stop = np.arctan(np.sqrt(at - 1))

    def pressure(g):
        return quad(slope, -np.pi / 2, g, args=(at,))[0]

    load = 24 * quad(lambda g: pressure(g) / np.cos(g) ** 2, -np.pi / 2, stop)[0] / h
    shear = 6 * np.sqrt(2) * quad(lambda g: 1 - at * np.cos(g) ** 2, -np.pi / 2, stop)[0]
    ours = rolling_resistance.rigid_force(load, 1.0, 1.0, 1.0)
    assert shear == pytest.approx(ours, rel=1e-5)


def test_hydrodynamic_force_takes_the_smaller_regime():
    common = (11e-3, 4.5e-3, 1.53, 10.6e-3, 2e-8, MODULUS)
    loaded = rolling_resistance.hydrodynamic_force(718.29, *common)
    assert loaded == pytest.approx(rolling_resistance.elastic_force(718.29, *common), rel=1e-2)
    light = rolling_resistance.hydrodynamic_force(1e-3, *common)
    assert light == pytest.approx(
        rolling_resistance.rigid_force(1e-3, 11e-3, 1.53, 10.6e-3), rel=1e-2
    )
    still = rolling_resistance.hydrodynamic_force(np.zeros(2), *common)
    assert (still == 0).all()
    assert numba.njit(rolling_resistance.hydrodynamic_force)(718.29, *common) == pytest.approx(
        float(loaded), rel=1e-13
    )


@pytest.mark.parametrize(
    ("function", "args"),
    [
        (kinematics.ideal_speeds, (100.0, 0.0, 49.5e-3, 71.5e-3)),
        (kinematics.contact_speeds, (100.0, 0.0, 40.9, 260.0, 49.5e-3, 71.5e-3)),
        (rolling_resistance.hysteresis_moment, (700.0, 57e-6, 0.01)),
        (traction.limiting_stress, (1e9, 4e6, 502e6, 0.07)),
        (traction.newtonian_stress, (30.0, 0.1, 1e-7)),
        (traction.smooth_stress, (5e6, 4e6)),
        (traction.boundary_coefficient, (0.01, 0.12)),
        (asperities.asperity_share, (0.8,)),
        (contact_film.thermal_factor, (0.1,)),
    ],
)
def test_components_compile_as_they_stand(function, args):
    assert numba.njit(function)(*args) == pytest.approx(function(*args), rel=1e-14)


def test_the_rolling_force_grows_with_speed_as_in_zhou_and_hoeprichs_table():
    # their Table 1: 2 F R_e per length at G = 3745, W = 2e-4 (R_e not stated); shape only
    speeds = np.array([1, 3, 10, 60, 100]) * 1e-11
    printed = np.array([0.0623, 0.1455, 0.3172, 0.8781, 1.1290])
    modulus, radius = 2.3e11, 0.01
    load, thickens = 2e-4 * modulus * radius, 3745 / modulus
    found = [
        friction.elastic_force(load, 1.0, radius, u * modulus * radius, 1.0, thickens, modulus)
        for u in speeds
    ]
    power, theirs = (np.polyfit(np.log(speeds), np.log(x), 1)[0] for x in (found, printed))
    assert power == pytest.approx(theirs, abs=0.03)
    np.testing.assert_allclose(np.divide(found, found[2]), printed / printed[2], rtol=0.3)


def test_rolling_moment_of_a_loss_worked_out_by_hand():
    moment = rolling_resistance.hysteresis_moment(700.0, 57e-6, 0.01)
    assert moment == pytest.approx(8.467043e-5, rel=1e-6)  # 0.01 · 2/(3π) · 700 N · 57 μm


def test_churning_fitted_with_one_oil_holds_for_another():
    speed = np.array([5.0, 20.0, 80.0, 200.0])
    # 2e-3 m³ · η ω + 3e-6 m⁵ · ρ ω², worked out for 0.02 Pa s and 850 kg/m³
    torque = [0.06395, 1.0208, 16.3232, 102.008]
    found = friction.fit_churning(speed, torque, 0.02, 850.0)
    assert found.torque(100.0, 0.2, 900.0) == pytest.approx(27.04, rel=1e-6)
    # between measurements that contradict the law, the sum of squares is least
    bent = torque * np.array([1.1, 0.9, 1.05, 1.0])
    terms = np.stack([0.02 * speed, 850.0 * speed**2], axis=1)
    least = np.linalg.lstsq(terms, bent, rcond=None)[0]
    fitted = friction.fit_churning(speed, bent, 0.02, 850.0)
    assert (fitted.viscous, fitted.inertial) == pytest.approx(tuple(least), rel=1e-9)
    assert friction.fit_churning(speed, -np.array(torque), 0.02, 850.0) == friction.Churning(0, 0)
    with pytest.raises(InputError, match="two or more"):
        friction.fit_churning([1.0], [1.0], 0.02, 850.0)


def test_inertia_force_of_a_cage_worked_out_by_hand():
    force = guides.cage_inertia_force(0.03, 18, 6.67e-3, 42.5e-3, 100.0)
    assert force == pytest.approx(38.26275, rel=1e-9)  # (30 g + 9 rollers) · 42.5 mm · (100/s)²


def test_palmgren_is_continuous_and_loads_follow_their_exponents():
    edge = 2000 / 30 * np.pi / 30  # ν n = 2000 at 30 mm²/s
    slow, fast = catalogue.palmgren_idle_torque(edge * np.array([0.99, 1.01]), 30e-6, 0.06, 2.5)
    assert slow == pytest.approx(float(fast), rel=0.02)
    lawful = catalogue.palmgren_load_torque([1e3, 2e3], 0.06, 3e-4, 5e4, 0.5)
    assert lawful[1] / lawful[0] == pytest.approx(2**1.5)
    with pytest.raises(InputError, match="static_capacity"):
        catalogue.palmgren_load_torque(1e3, 0.06, 3e-4, exponent=0.3)


def test_radial_distribution_of_the_main_bearing():
    angles = 2 * np.pi * np.arange(14) / 14
    law = radial_load.behw_law(11e-3)
    shift, loads = radial_load.radial_distribution([2000.0, 13800.0], angles, 8e-6, law)
    assert shift * 1e6 == pytest.approx([8.6408, 27.8536], rel=1e-5)
    assert loads[1, :4] == pytest.approx([4208.63, 3685.55, 2251.54, 320.46], rel=1e-5)
    assert (loads * np.cos(angles)).sum(axis=-1) == pytest.approx([2000.0, 13800.0], rel=1e-12)
    straddling = radial_load.radial_distribution(2000.0, angles + np.pi / 14, 8e-6, law)
    assert straddling.loads.max() == pytest.approx(691.72, rel=1e-5)


def test_radial_distribution_without_load_or_support():
    law = radial_load.iso_law(11e-3)
    found = radial_load.radial_distribution(0.0, [0.0, 2.0, 4.0], 8e-6, law)
    assert (found.loads == 0).all()
    with pytest.raises(SolverError, match="side"):
        radial_load.radial_distribution(1.0, [2.0, 3.0], 8e-6, law)
    with pytest.raises(InputError, match="clearance"):
        radial_load.radial_distribution(1.0, [0.0], -1e-6, law)


def test_raceways_of_the_main_bearing_leave_room_for_the_rollers():
    assert MAIN_RACES[1] - MAIN_RACES[0] == pytest.approx(4 * MAIN.radius)
