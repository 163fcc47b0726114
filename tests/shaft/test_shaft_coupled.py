"""A shaft on bearings with models of their own: over long series, in kinks, without an answer."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from loadflow import shaft
from loadflow.errors import InputError, SolverError
from loadflow.shaft import (
    Beam,
    BearingSupport,
    CoupledBearing,
    ShaftSection,
    ThreePoint,
    TwoPoint,
    bearing_loads,
    coupled_loads,
)

SOLID = ShaftSection(1.0, 0.4)
OWN, FREE = BearingSupport(stiffness="rolling", takes_moment=True), BearingSupport()
ALONG = ("force", "moment", "displacement", "tilt")


def suspended(*supports, concept=TwoPoint, section=SOLID, **beam):
    return concept(beam=Beam((section,), supports, **beam))


def wander(n, seed=1):
    """Loads of the hub that wander smoothly, (3, n) each, and a speed."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 40, n)
    waves = np.stack([np.sin(f * t + p) for f, p in rng.uniform(0.5, 6, (7, 2))])
    force = np.array([[5e5], [0.0], [-1e6]]) + 1e5 * waves[:3]
    moment = np.array([[4e6], [5e5], [2e5]]) + 1e6 * waves[3:6]
    return force, moment, 1.2 + 0.1 * waves[6]


def power(exponent, radial=1e10, tilt=1e8, stiffening=0.0):
    """Bearing whose motion is load^exponent along the load, softer with the state."""

    def curve(load, scale):
        size = np.maximum(np.hypot(*load.T), 1.0)
        along = load / size[:, None]
        line = along[:, :, None] * along[:, None, :]
        far = (size / scale) ** exponent
        soft = far / size
        return far[:, None] * along, soft[:, None, None] * (np.eye(2) + (exponent - 1) * line)

    def model(state):
        def asked(force, moment):
            softer = 1.0 + stiffening * state
            (d, cd), (t, ct) = curve(force[:, 1:], radial), curve(moment[:, 1:], tilt)
            compliance = np.zeros((len(force), 4, 4))
            compliance[:, :2, :2], compliance[:, 2:, 2:] = cd, ct
            motion = np.concatenate([d, t], axis=1) * softer[:, None]
            return motion, np.linalg.inv(compliance * softer[:, None, None])

        return asked

    return model


def coupled(model, state, idle=None, cheap=False):
    nowhere = np.zeros(state.size, dtype=bool)
    return CoupledBearing(
        lambda rows: model(state[rows]), state, nowhere if idle is None else idle, cheap
    )


def assert_balanced(found, concept, force, moment):
    """Radial forces and moments are those of the rigid shaft, in sum."""
    rigid = bearing_loads(type(concept)(), force, moment)
    x = found["position"].values[:, None, None] * np.array([1.0, 0, 0])[:, None]

    def sums(loads):
        taken = loads["force"].values
        about = np.cross(x, taken, axis=1) + loads["moment"].values
        return taken.sum(0), about.sum(0)

    for ours, theirs in zip(sums(found), sums(rigid)):
        assert abs(ours - theirs).max() < 1e-11 * abs(rigid["moment"] + rigid["force"]).values.max()


@pytest.mark.parametrize("cheap", [True, False])
def test_a_bearing_of_constant_stiffness_gives_what_its_numbers_give(cheap):
    force, moment, state = wander(600)
    numbers = BearingSupport(radial=1e10, takes_moment=True, tilt=1e8, housing_vertical=5e9)
    own = BearingSupport(stiffness="rolling", takes_moment=True, housing_vertical=5e9)
    given_ = bearing_loads(suspended(FREE, numbers), force, moment)
    bearing = {"N2": coupled(power(1.0), state, cheap=cheap)}
    found = coupled_loads(suspended(FREE, own), force, moment, bearing)
    for name in ALONG:
        size = float(abs(given_[name]).max())
        assert float(abs(found[name] - given_[name]).max()) < 1e-10 * size
    assert found["converged"].all()
    assert found.attrs["solved"] == (600 if cheap else 150)


def test_between_the_samples_solved_the_error_is_as_told_and_all_balances():
    force, moment, state = wander(2000)
    concept = suspended(FREE, OWN)
    model = power(2 / 3, stiffening=0.5)
    found = coupled_loads(concept, force, moment, {"N2": coupled(model, state)})
    exact = bearing_loads(concept, force, moment, models={"N2": model(state)})
    assert found.attrs["solved"] == 400  # the most: a bearing so soft when unloaded is hard
    assert found.attrs["interpolation_error"] < 2e-2
    for name in ALONG:
        off = float(abs(found[name] - exact[name]).max() / abs(exact[name]).max())
        # what is predicted last is the farthest from what is known: the rest is better
        assert off < found.attrs["interpolation_error"], name
    assert_balanced(found, concept, force, moment)


@settings(max_examples=20, deadline=None)
@given(st.floats(0.5, 1.2), st.floats(1e8, 1e12), st.sampled_from([TwoPoint, ThreePoint]))
def test_a_determinate_suspension_does_not_feel_its_bearings(exponent, radial, concept):
    force, moment, state = wander(20)
    own = BearingSupport(stiffness="journal")
    bearings = {"N": coupled(power(exponent, radial), state)}
    beam = suspended(own, FREE, concept=concept)
    found = coupled_loads(beam, force, moment, bearings)
    rigid = bearing_loads(concept(), force, moment)
    for name in ("force", "moment"):
        assert float(abs(found[name] - rigid[name]).max()) < 1e-12 * abs(rigid["force"]).max()
    expected = (np.hypot(*rigid["force"].values[0, 1:]) / radial) ** exponent
    moved = np.hypot(*found["displacement"].values[0, 1:])
    np.testing.assert_allclose(moved, expected, rtol=1e-9)


def test_a_hardening_support_is_where_one_unknown_says():
    """Rigid shaft, N yields linearly, N2 takes M = k θ^1.5: F_N/k_N = span · θ(M)."""
    soft, tough, push = 2e9, 1e10, 1e6
    own = BearingSupport(stiffness="rolling", takes_moment=True)
    concept = TwoPoint(
        hub_to_first=2.0,
        span=3.0,
        gearbox_mass=0.0,
        beam=Beam((SOLID,), (BearingSupport(radial=soft), own), youngs_modulus=1e20),
    )
    bearing = {"N2": coupled(power(2 / 3, radial=1e30, tilt=tough), np.zeros(1))}
    found = coupled_loads(concept, np.array([[0.0], [push], [0.0]]), np.zeros((3, 1)), bearing)

    def gap(moment):
        at_first = (push * 5.0 - moment) / 3.0
        return at_first / soft - 3.0 * (moment / tough) ** (2 / 3)

    moment = brentq(gap, 0.0, push * 5.0, xtol=1e-6, rtol=1e-14)
    taken = found["moment"].values[1, 2, 0]
    assert abs(taken) == pytest.approx(moment, rel=1e-7)
    assert found["force"].values[0, 1, 0] == pytest.approx((push * 5.0 - moment) / 3.0, rel=1e-7)


def test_a_bearing_that_stiffens_in_a_kink_settles():
    """Newton alone would jump between the two branches of a stop forever."""
    play, weak, hard = 2e-4, 1e6, 1e12

    def stop(state):
        def asked(force, moment):
            knee = weak * play
            size = np.maximum(np.hypot(*moment[:, 1:].T), 1e-3)
            beyond = size > knee
            far = np.where(beyond, play + (size - knee) / hard, size / weak)
            slope = np.where(beyond, 1 / hard, 1 / weak)
            along = moment[:, 1:] / size[:, None]
            line = along[:, :, None] * along[:, None, :]
            soft = slope[:, None, None] * line + (far / size)[:, None, None] * (np.eye(2) - line)
            compliance = np.zeros((len(force), 4, 4))
            compliance[:, :2, :2], compliance[:, 2:, 2:] = np.eye(2) / 1e10, soft
            motion = np.concatenate([force[:, 1:] / 1e10, far[:, None] * along], axis=1)
            return motion, np.linalg.inv(compliance)

        return asked

    force, moment, state = wander(100)
    found = coupled_loads(suspended(FREE, OWN), force, moment, {"N2": coupled(stop, state)})
    assert found["converged"].all()
    assert found.attrs["residual"] < 1e-7
    one = found.sel(bearing="N2")
    expected, _ = stop(state)(one["force"].values.T, one["moment"].values.T)
    np.testing.assert_allclose(one["tilt"].values[1:].T, expected[:, 2:], rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("n", [40, 800])
def test_where_a_bearing_has_no_answer_it_is_rigid_and_the_sample_is_flagged(n):
    force, moment, _ = wander(n)
    state = np.linspace(0.0, 1.3, n)
    idle = state < 0.1

    def film(some):
        assert (some >= 0.1).all(), "asked although idle"

        def asked(force, moment):
            motion, stiffness = power(2 / 3)(some)(force, moment)
            return np.where(some[:, None] < 0.3, np.nan, motion), stiffness

        return asked

    concept = suspended(FREE, OWN)
    found = coupled_loads(concept, force, moment, {"N2": coupled(film, state, idle)})
    rigid = bearing_loads(suspended(FREE, BearingSupport(takes_moment=True)), force, moment)
    # between solved samples the nearest one decides
    lost, sure = ~found["converged"].values[1].astype(bool), (state < 0.28) | (state > 0.32)
    assert (lost == (state < 0.3))[sure].all()
    for name in ALONG:
        assert np.isfinite(found[name]).all()
        np.testing.assert_array_equal(found[name][..., lost], rigid[name][..., lost])
    assert_balanced(found, concept, force, moment)
    if n > 150:
        assert found.attrs["solved"] < n


def test_a_bearing_that_never_answers_leaves_the_shaft_on_rigid_supports():
    force, moment, state = wander(30)
    idle = np.ones(30, dtype=bool)
    found = coupled_loads(
        suspended(FREE, OWN), force, moment, {"N2": coupled(power(1.0), state, idle)}
    )
    assert not found["converged"].any()
    assert found.attrs["solved"] == 0


def test_mistakes_are_named():
    force, moment, state = wander(5)
    bearing = coupled(power(1.0), state)
    with pytest.raises(InputError, match="rigid shaft"):
        coupled_loads(TwoPoint(), force, moment, {"N2": bearing})
    with pytest.raises(InputError, match="'N2' is missing"):
        bearing_loads(suspended(FREE, OWN), force, moment)
    with pytest.raises(InputError, match="leave them out"):
        BearingSupport(radial=1e9, stiffness="journal")
    with pytest.raises(InputError, match="must be one of given, journal, rolling"):
        BearingSupport(stiffness="elastic")

    def silent(force, moment):
        return np.full((len(force), 4), np.nan), np.broadcast_to(np.eye(4), (len(force), 4, 4))

    with pytest.raises(SolverError, match="do not converge"):
        bearing_loads(suspended(FREE, OWN), force, moment, models={"N2": silent})


def test_former_names_still_work_and_say_what_they_are_called_now():
    assert shaft.BearingSeat is shaft.BearingSupport
    assert shaft.Seated is CoupledBearing
    force, moment, state = wander(5)
    loads = suspended(FREE, OWN), force, moment, {"N2": coupled(power(1.0), state, cheap=True)}
    with pytest.warns(DeprecationWarning, match="coupled_loads"):
        found = shaft.seated_loads(*loads)
    assert found.identical(coupled_loads(*loads))
