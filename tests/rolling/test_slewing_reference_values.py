"""Values of an independent solver for the source's bearings, to all digits that it gave."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import ValidityWarning
from loadflow.rolling.rating import life
from loadflow.scene.scene import Rolling
from loadflow.validation._slewing_cases import BLADE, DRIVE, FOUR_BALL, MM15, RINGS, SPECTRUM
from loadflow.validation._slewing_cases import coacting as together

SHEET = replace(FOUR_BALL, pitch_diameter=0.2)  # the worksheet takes D_pw for a radius


def stiffness(bearing):
    """Of the inner and the outer contact, and their mean, N/mm^1.5."""
    both = [float(bearing.raceway_contact(side).stiffness) / MM15 for side in RINGS]
    return [*both, sum(both) / 2]


@pytest.mark.parametrize(
    ("bearing", "values"),
    [
        (SHEET, (2_168_389, 2_286_816, 2_227_602)),
        (FOUR_BALL, (2.092e6, 2.336e6, 2.2138e6)),
        (BLADE, (2_225_674, 2_238_034, 2_231_854)),
        (DRIVE, (1_148_013, 1_167_621, 1_157_817)),
    ],
    ids=["worksheet", "four balls", "blade", "45 balls"],
)
def test_contact_stiffness(bearing, values):
    assert stiffness(bearing) == pytest.approx(values, rel=3e-4 if bearing is FOUR_BALL else 1e-6)


def test_pressures_and_allowed_force():
    pressures = [float(BLADE.raceway_contact(side, 28_800.0).pressure) for side in RINGS]
    assert pressures == pytest.approx([2238.4e6, 2195.4e6], abs=0.05e6)
    unit = float(BLADE.raceway_contact("inner", 1.0).pressure)
    assert (3545e6 / unit) ** 3 == pytest.approx(114_402, rel=1e-5)
    extract = [3400, 3200, 3000, 2900, 2700, 2500, 2400, 2200]
    pressure = BLADE.raceway_contact("inner", extract).pressure / 1e6
    assert pressure == pytest.approx([1098, 1076, 1053, 1041, 1017, 991, 978, 950], abs=0.51)


@pytest.mark.parametrize(
    ("factor", "force", "angle", "shift"),
    [(None, 10_437.9, 47.96, 0.0771), (2.219e6, 10_436.2, 47.97, 0.0774)],
)
def test_axial_load(factor, force, angle, shift):
    bearing = replace(BLADE, contact_stiffness=factor and factor * MM15)
    result = bearing.equilibrium((0, 0, 2e6))
    assert result.maximum_force == pytest.approx(force, abs=0.06)
    assert math.degrees(result.contact_angles[0, 0, 0]) == pytest.approx(angle, abs=6e-3)
    assert result.displacement[2] * 1e3 == pytest.approx(shift, abs=6e-5)


def test_radial_load():
    bearing = replace(BLADE, contact_stiffness=2.219e6 * MM15)
    result = bearing.equilibrium((500e3, 0, 0))
    assert result.displacement[0] * 1e3 == pytest.approx(0.05146, abs=2e-5)
    force, angle = result.ball_forces[0, :, 0], result.contact_angles[0, :, 0]
    assert (force * np.cos(angle)).sum() == pytest.approx(8178, rel=2e-4)  # of both diagonals


def test_sums_of_rows_apart():
    bearing = replace(BLADE, row_spacing=0.06, contact_stiffness=2.219e6 * MM15)
    found = together(bearing, [250e3, 500e3, 250e3], [1e6, 2e6, 5e5], [1e6, 5e5, 3e6])
    assert found.force_sum == pytest.approx((2_243_216, 2_696_386, 4_973_828), rel=2e-4)


def test_moment_beside_a_radial_force_along_its_axis():
    bearing = replace(BLADE, contact_stiffness=2.219e6 * MM15)
    found = bearing.equilibrium(
        [(250e3, 0, 1e6), (500e3, 0, 2e6), (250e3, 0, 5e5)], [(1e6, 0), (5e5, 0), (3e6, 0)]
    )
    assert found.force_sum == pytest.approx((2_616_583, 3_314_762, 5_053_910), rel=2e-4)


def test_spectrum_of_the_first_two_cases():
    bearing = replace(BLADE, row_spacing=0.06, contact_stiffness=2.219e6 * MM15)
    found = together(bearing, *SPECTRUM[:2, :3].T)
    assert found.maximum_force == pytest.approx((6850, 13_322), rel=2e-4)
    assert found.equivalent_load == pytest.approx((707_915, 1_389_480), rel=2e-4)


def test_life():
    rated = replace(BLADE, life_hardness_factor=1.0).rated_capacity
    assert rated == pytest.approx(1_262_832, rel=1e-4)
    assert life.overrollings(129, BLADE.gamma) == pytest.approx(65.460, abs=5e-4)
    assert math.degrees(life.critical_amplitude(129, BLADE.gamma)) == pytest.approx(
        11.165, abs=1e-3
    )
    rate, share = SPECTRUM[:, 6] / 60, SPECTRUM[:, 5] / 100
    speed = life.oscillation_speed(rate, np.radians(SPECTRUM[:, 7]))
    mean = life.mean_speed(speed, share)
    assert mean * 30 / math.pi == pytest.approx(0.015057, abs=1e-6)
    assert mean / share.sum() * 30 / math.pi == pytest.approx(0.015209, abs=1e-6)
    years = life.rating_life(1_076_000, 2_239_000)
    assert life.life_hours(years, mean) == pytest.approx(122_852, rel=1e-5)


def test_soft_raceways_have_the_life_of_hard_ones_only_with_a_warning():
    soft = replace(BLADE, life_hardness_factor=1.0)
    with pytest.warns(ValidityWarning, match="life_hardness_factor = 1"):
        assert soft.rated_capacity == pytest.approx(1_262_832, rel=1e-4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert BLADE.rated_capacity == pytest.approx(0.85 * soft.rated_capacity)
        assert replace(soft, hardness=700.0).rated_capacity == soft.rated_capacity
        assert replace(soft, dynamic_capacity=1e6).rated_capacity == 1e6


def test_the_bearing_of_a_scene_that_names_none_is_rated_as_its_source_rates_it():
    assert Rolling().geometry.rated_capacity == pytest.approx(1_076_000, rel=5e-3)
