"""Modified life, system life, static capacity and verdicts."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling import (
    BallBearing,
    CrossedRollerBearing,
    Lubrication,
    RollerBearing,
    SlewingBearing,
    life_modification,
    modified_life,
    static_capacity,
    system_life,
    verdicts,
)
from loadflow.rolling.rating import modified_life as lubricated_life
from loadflow.rolling.rating import static as static_rating
from loadflow.rolling.rating.modified_life import CLEANLINESS, contamination_factor, life_factor
from loadflow.tribology import lubricant

KINDS = ("radial-ball", "radial-roller", "thrust-ball", "thrust-roller")
SLOW = 12 * math.pi / 30  # a main shaft, rad/s
GREASE = Lubrication(oil=lubricant("mineral-vg-320"), temperature=323.15)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seam", [0.4, 1.0])
def test_life_factor_meets_itself_where_its_branches_join(kind, seam):
    below, above = life_factor([seam * (1 - 1e-9), seam], 0.2, kind)
    assert below == pytest.approx(above, rel=1e-3)  # the constants have five digits


@given(st.sampled_from(KINDS), st.floats(0.1, 5), st.floats(0, 5))
def test_life_factor_is_bounded_and_grows_with_film_and_limit(kind, kappa, ratio):
    factor = float(life_factor(kappa, ratio, kind))
    assert 0.1 <= factor <= 50 * (1 + 1e-12)
    assert life_factor(kappa, ratio + 0.1, kind) >= factor
    assert life_factor(min(kappa * 1.2, 4.0), ratio, kind) >= factor * 0.98 or kappa > 4


def test_life_factor_refuses_dry_contacts_and_unknown_kinds():
    with pytest.raises(InputError, match="kappa"):
        life_factor(0.05, 1.0, "radial-ball")
    with pytest.raises(InputError, match="kind"):
        life_factor(1.0, 1.0, "ball")


@pytest.mark.parametrize("kind", KINDS)
def test_life_factor_stops_at_its_limits(kind):
    assert life_factor(4.0, 5.0, kind) == pytest.approx(50)
    assert life_factor(9.0, 0.1, kind) == life_factor(4.0, 0.1, kind)
    assert life_factor(2.0, 5.0, kind, limit=3.8) == pytest.approx(3.8)
    small = 0.01
    assert life_factor(2.0, small, kind, limit=3.8) == life_factor(2.0, small, kind)
    for wrong in (60.0, 0.05, math.nan):
        with pytest.raises(InputError, match="limit"):
            life_factor(1.0, 0.5, kind, limit=wrong)


def test_which_limits_of_the_life_factor_act_is_told():
    keys = {"kind": "radial-ball", "pitch_diameter": 0.95, "static_capacity": 2e6}
    oil = dataclasses.replace(GREASE, cleanliness="oil, filtered, -/13/10")
    found = life_modification([1e3, 1e5, 1e3], [SLOW, SLOW, 50 * SLOW], lubrication=oil, **keys)
    assert found.thick.tolist() == [False, False, True]
    assert found.capped.tolist() == [True, False, True]
    assert found.factor[found.capped] == pytest.approx(50)
    assert found.load_ratio == pytest.approx(
        found.contamination * found.fatigue_limit / np.array([1e3, 1e5, 1e3])
    )
    low = life_modification(1e5, SLOW, lubrication=oil, limit=0.2, **keys)
    assert low.capped
    assert low.factor == pytest.approx(0.2)
    with pytest.raises(InputError, match=r"κ ≥ 0\.1"):
        life_modification(1e5, 1e-3 * SLOW, lubrication=oil, **keys)


def test_reference_viscosity_of_both_ranges_of_speed():
    slow, fast = lubricated_life.reference_viscosity(
        np.array([10, 2000]) * math.pi / 30, pitch_diameter=0.1
    )
    assert slow == pytest.approx(45e-3 * 10**-0.83 / 10)
    assert fast == pytest.approx(4.5e-3 / math.sqrt(2000) / 10)


def test_cleaner_lubricant_gives_a_larger_factor():
    factors = [float(contamination_factor(name, 1.0, 0.3)) for name in CLEANLINESS]
    for first, last in ((0, 4), (4, 9), (9, 14)):
        assert np.diff(factors[first:last]).max() < 0
    assert 0 <= min(factors) < max(factors) < 1
    with pytest.raises(InputError, match="cleanliness"):
        contamination_factor("dirty", 1.0, 0.3)


def test_modified_life_of_a_main_bearing():
    keys = {"lubrication": GREASE, "kind": "radial-roller", "pitch_diameter": 0.95}
    life = modified_life(1000.0, 1e6, SLOW, static_capacity=21e6, **keys)
    kappa = float(lubricated_life.viscosity_ratio(GREASE, SLOW, 0.95))
    clean = float(contamination_factor(GREASE.cleanliness, kappa, 0.95))
    limit = 21e6 / 8.2 * (0.1 / 0.95) ** 0.3
    assert life == pytest.approx(1000 * float(life_factor(kappa, clean * limit / 1e6, KINDS[1])))
    sure = modified_life(1000.0, 1e6, SLOW, static_capacity=21e6, reliability=0.99, **keys)
    assert sure == pytest.approx(0.25 * life)
    with pytest.raises(InputError, match="reliability"):
        lubricated_life.reliability_factor(0.5)


@pytest.mark.parametrize("reliability", [0.95, 0.97, 0.99, 0.994, 0.998, 0.999, 0.9995])
def test_reliabilities_follow_weibull_with_a_life_that_none_falls_short_of(reliability):
    # ISO/TR 1281-2: slope 1.5, nothing fails within a twentieth of L10
    weibull = 0.05 + 0.95 * (np.log(1 / reliability) / np.log(1 / 0.9)) ** (1 / 1.5)
    a1 = lubricated_life.reliability_factor(reliability)
    assert a1 == pytest.approx(weibull, rel=0.03)


def test_system_life_of_alike_parts_and_of_one_weak_part():
    assert system_life([8.0, 8.0], 1.5) == pytest.approx(8 / 2 ** (1 / 1.5))
    assert system_life([1.0, 1e9]) == pytest.approx(1.0, rel=1e-6)
    assert system_life([[1.0, 1.0], [2.0, 2.0]], axis=-1).shape == (2,)
    with pytest.raises(InputError, match="lives"):
        system_life([0.0, 1.0])


def test_static_capacity_beside_a_catalogue():
    ball = BallBearing(
        balls=7,
        ball_diameter=11.5e-3,
        pitch_diameter=43.5e-3,
        groove_radius=0.52 * 11.5e-3,
    )
    assert ball.static_capacity == pytest.approx(11.6e3, rel=0.05)  # 6305
    roller = RollerBearing(
        rollers=13, roller_diameter=9e-3, roller_length=8.2e-3, pitch_diameter=38.5e-3
    )
    assert roller.static_capacity == pytest.approx(44 * (1 - 9 / 38.5) * 13 * 8.2 * 9, rel=1e-12)
    crossed = CrossedRollerBearing(
        rollers=180, roller_diameter=0.04, roller_length=0.038, pitch_diameter=2.6
    )
    turned = dataclasses.replace(crossed, contact_angle=math.pi / 3)
    assert turned.static_capacity > crossed.static_capacity
    with pytest.raises(InputError, match="bearing"):
        static_capacity("6305")


def test_static_capacity_of_a_slewing_bearing_is_reached_at_its_allowed_pressure():
    bearing = SlewingBearing(
        balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9, groove_radius=0.0205,
        contact_angle=math.pi / 4,
    )  # fmt: skip
    # the contact angle opens under load, so that the real distribution carries a little more
    safety = bearing.equilibrium((0, 0, bearing.static_capacity)).static_safety
    assert 1.0 < safety < 1.35
    p0 = static_rating.static_load_slewing(
        1e5, 2e5, 1e6, contact_angle=bearing.contact_angle, pitch_diameter=bearing.pitch_diameter
    )
    assert p0 == pytest.approx(2e5 + 2.3e5 + 4e6 / 1.9)
    assert static_rating.static_load(10.0, 1.0, 0.6, 0.5) == 10.0


def test_verdicts_after_the_standard():
    life, static = verdicts(life_hours=20 * 8766.0, static_safety=1.2)
    assert life.holds
    assert static.holds
    assert (static.limit, round(static.margin, 9)) == (1.0, 0.2)
    stricter = list(verdicts(20 * 8766.0, 1.2, static_limit=1.5))[1]
    assert not stricter.holds
    assert "must be at least 1.5" in stricter.sentence
