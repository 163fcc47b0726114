"""The elastic shaft: equilibrium, closed forms, limits, and bearings with models of their own."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.shaft import (
    Beam,
    BearingSupport,
    CoupledBearing,
    DirectDrive,
    Integrated,
    MomentBearing,
    ShaftSection,
    ThreePoint,
    TwoPoint,
    bearing_loads,
)

SOLID = ShaftSection(1.0, 0.4)
SLIM = Beam((SOLID,), shear=False)
EI = 2.1e11 * SOLID.inertia
STIFF = BearingSupport(
    radial=3e9, takes_moment=True, tilt=2e8, housing_lateral=2e9, housing_vertical=4e9
)
FREE = BearingSupport(radial=3e9)
LOAD = st.floats(-1e7, 1e7)
VECTOR = st.tuples(LOAD, LOAD, LOAD).map(lambda v: np.array(v)[:, None])


def plain(beam, **changes):
    """Two bearings at 2 m and 5 m, no weights."""
    return TwoPoint(2.0, 3.0, 1.0, gearbox_mass=0.0, beam=beam, **changes)


@pytest.mark.parametrize(
    "concept",
    [
        TwoPoint(beam=SLIM),
        TwoPoint(beam=Beam(supports=(FREE, BearingSupport())), torque_arm=1.5, shaft_mass=2e4),
        ThreePoint(beam=Beam(supports=(FREE, BearingSupport(radial=1e8)))),
        Integrated(beam=Beam(), shaft_mass=1e4),
        DirectDrive(beam=Beam(), generator_mass=1e5),
        MomentBearing(beam=Beam(supports=(STIFF,)), shaft_mass=1e4),
    ],
    ids=lambda c: type(c).__name__,
)
def test_a_determinate_suspension_does_not_feel_stiffness(concept):
    rng = np.random.default_rng(1)
    force, moment = 1e6 * rng.standard_normal((2, 3, 50))
    bent = bearing_loads(concept, force, moment, tilt=0.09)
    rigid = bearing_loads(replace(concept, beam=None), force, moment, tilt=0.09)
    for name in ("force", "moment"):
        scale = abs(rigid["moment"]).max() + abs(rigid["force"]).max()
        assert float(abs(bent[name] - rigid[name]).max() / scale) < 1e-12
    assert set(bent) - set(rigid) == {"displacement", "tilt", "curvature", "bore_tilt"}


@settings(max_examples=40, deadline=None)
@given(VECTOR, VECTOR, st.floats(1e6, 1e12), st.floats(1e4, 1e11))
def test_forces_and_moments_balance_whatever_the_stiffness(force, moment, radial, tilt):
    supports = (
        BearingSupport(radial, takes_moment=True, tilt=tilt),
        BearingSupport(None, None, 1e8, True),
    )
    concept = TwoPoint(beam=Beam(supports=supports), shaft_mass=2e4, torque_arm=1.2)
    found = bearing_loads(concept, force, moment, tilt=0.1)
    rigid = bearing_loads(replace(concept, beam=None), force, moment, tilt=0.1)

    def sums(loads):
        taken = loads["force"].values[..., 0]
        x = loads["position"].values[:, None] * [1.0, 0.0, 0.0]
        return taken.sum(0), (np.cross(x, taken) + loads["moment"].values[..., 0]).sum(0)

    scale = 1 + max(abs(found[name]).max().item() for name in ("force", "moment"))
    for ours, theirs in zip(sums(found), sums(rigid)):
        assert abs(ours - theirs).max() < 1e-12 * scale


def test_overhang_bends_as_the_textbook_says():
    """Force at the free end of an overhanging beam: slopes at the supports, Euler–Bernoulli."""
    push, a, span = 1e6, 2.0, 3.0
    found = bearing_loads(plain(SLIM), [0.0, push, 0.0], [0.0, 0.0, 0.0])
    moment = push * a  # over the first support
    slope = found["tilt"].sel(axis="z").values[:, 0]
    # the end goes to +y, so the shaft turns about z by a negative angle, and back behind
    assert slope == pytest.approx([-moment * span / (3 * EI), moment * span / (6 * EI)], rel=1e-12)
    assert found["curvature"].sel(axis="y").values[:, 0] == pytest.approx([moment / EI, 0.0])
    down = bearing_loads(plain(SLIM), [0.0, 0.0, push], [0.0, 0.0, 0.0])
    assert down["tilt"].sel(axis="y").values[:, 0] == pytest.approx(-slope, rel=1e-12)
    assert float(abs(found["displacement"]).max()) < 1e-18


def test_clamped_supports_share_the_moment_as_a_fixed_beam():
    """Both supports clamp: a moment on the overhang is taken by the first support alone."""
    clamp = BearingSupport(takes_moment=True)
    beam = Beam((SOLID,), (clamp, clamp))
    found = bearing_loads(plain(beam), [0.0, 4e5, 1e6], [0.0, 7e5, -3e5])
    alone = bearing_loads(MomentBearing(2.0), [0.0, 4e5, 1e6], [0.0, 7e5, -3e5])
    for name in ("force", "moment"):
        assert found[name].values[0] == pytest.approx(alone[name].values[0], rel=1e-12)
        assert found[name].values[1] == pytest.approx(0.0, abs=1e-4)


def test_soft_bearings_tilt_a_rigid_shaft():
    """Young's modulus → ∞: displacements are reactions over stiffness, the shaft is straight."""
    rigid = Beam((SOLID,), (BearingSupport(radial=1e9), BearingSupport(radial=2e9)), 1e20)
    found = bearing_loads(plain(rigid), [0.0, 3e5, -1e6], [0.0, 2e6, 1e6])
    expected = found["force"].values[:, 1:, 0] / np.array([[1e9], [2e9]])
    assert found["displacement"].values[:, 1:, 0] == pytest.approx(expected)
    (y1, z1), (y2, z2) = expected
    turned = np.array([0.0, -(z2 - z1) / 3.0, (y2 - y1) / 3.0])
    assert found["tilt"].values[..., 0] == pytest.approx(np.stack([turned, turned]))


def test_loads_superpose_and_shear_only_adds():
    beam = Beam((SOLID,), (STIFF, STIFF))
    rng = np.random.default_rng(2)
    (f1, f2), (m1, m2) = 1e6 * rng.standard_normal((2, 2, 3, 1))
    both = bearing_loads(plain(beam), f1 + f2, m1 + m2)
    parts = bearing_loads(plain(beam), f1, m1), bearing_loads(plain(beam), f2, m2)
    for name in both:
        scale = float(abs(both[name]).max())
        assert float(abs(both[name] - parts[0][name] - parts[1][name]).max()) <= 1e-11 * scale
    slender = replace(beam, sections=(ShaftSection(0.05),))
    with_shear, without = (
        bearing_loads(plain(replace(slender, shear=s)), f1, m1)["moment"] for s in (True, False)
    )
    assert float(abs(with_shear - without).max()) < 2e-3 * float(abs(without).max())


def test_stiffness_tends_to_the_rigid_limit():
    errors = []
    clamped = Beam(supports=(BearingSupport(takes_moment=True),) * 2)
    limit = bearing_loads(plain(clamped), [0, 0, 1e6], [0, 1e6, 0])
    for stiffness in (1e12, 1e13, 1e14):
        support = BearingSupport(stiffness, takes_moment=True, tilt=stiffness)
        found = bearing_loads(plain(Beam(supports=(support, support))), [0, 0, 1e6], [0, 1e6, 0])
        errors.append(float(abs(found["moment"] - limit["moment"]).max()))
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(10, rel=0.1)


def test_sections_cut_in_two_bend_alike():
    halves = Beam((replace(SOLID, length=1.3), replace(SOLID, length=2.1), SOLID), (STIFF, STIFF))
    loads = np.array([[0.0], [4e5], [1e6]]), np.array([[0.0], [7e5], [-3e5]])
    one, cut = (bearing_loads(plain(b), *loads) for b in (Beam((SOLID,), (STIFF, STIFF)), halves))
    for name in one:
        assert cut[name].values == pytest.approx(one[name].values, rel=1e-10, abs=1e-15)


def test_models_of_constant_stiffness_give_what_the_supports_give():
    def spring(force, moment):
        n = len(force)
        stiffness = np.broadcast_to(np.diag([3e9, 3e9, 2e8, 2e8]), (n, 4, 4))
        return np.concatenate([force[:, 1:] / 3e9, moment[:, 1:] / 2e8], axis=1), stiffness

    rng = np.random.default_rng(3)
    force, moment = 1e6 * rng.standard_normal((2, 3, 20))
    own = bearing_loads(plain(Beam(supports=(STIFF, FREE))), force, moment)
    asked = bearing_loads(plain(Beam(supports=(STIFF, FREE))), force, moment, models={"N": spring})
    for name in own:
        assert asked[name].values == pytest.approx(own[name].values, rel=1e-9, abs=1e-12)
    assert asked.attrs["converged"] == 1
    assert asked.attrs["iterations"] <= 2


def test_hardening_bearings_settle_on_their_curve():
    """Contacts that harden as F ∝ δ^1.5, M ∝ θ^1.5: what comes out lies on the curves."""

    def hardening(force, moment):
        def curve(load, scale):
            size = np.maximum(np.hypot(*load.T), 1.0)[:, None]
            motion = load / size * (size / scale) ** (2 / 3)
            unit = load / size
            along = unit[:, :, None] * unit[:, None, :]
            soft = (size / scale) ** (2 / 3) / size
            across = np.eye(2) - along
            return motion, (along / (2 / 3) + across) / soft[:, :, None]

        (d, kd), (t, kt) = curve(force[:, 1:], 1e11), curve(moment[:, 1:], 1e9)
        stiffness = np.zeros((len(force), 4, 4))
        stiffness[:, :2, :2], stiffness[:, 2:, 2:] = kd, kt
        return np.concatenate([d, t], axis=1), stiffness

    rng = np.random.default_rng(4)
    force, moment = 1e6 * rng.standard_normal((2, 3, 30))
    concept = plain(Beam(supports=(BearingSupport(takes_moment=True, tilt=1e8),) * 2))
    found = bearing_loads(concept, force, moment, models={"N": hardening, "N2": hardening})
    for bearing in ("N", "N2"):
        one = found.sel(bearing=bearing)
        motion, _ = hardening(one["force"].values.T, one["moment"].values.T)
        for name, expected in (("displacement", motion[:, :2]), ("tilt", motion[:, 2:])):
            np.testing.assert_allclose(one[name].values[1:].T, expected, rtol=1e-7)
    assert found.attrs["residual"] < 1e-10
    assert found.attrs["iterations"] < 12


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: TwoPoint(beam=Beam(supports=(STIFF,))), "1 are given, the shaft has 2"),
        (lambda: MomentBearing(beam=Beam(supports=(FREE,))), "must take the moment"),
        (lambda: Beam(()), "at least one"),
        (lambda: Beam((SOLID, SOLID)), r"sections\[0\].length"),
        (lambda: ShaftSection(0.5, 0.5), "inner < outer"),
        (lambda: BearingSupport(radial=0.0), "radial: must be > 0, got 0"),
        (lambda: BearingSupport(takes_moment=True, tilt=-1.0), "tilt: must be > 0, got -1"),
        (lambda: BearingSupport(tilt=1e8), "takes_moment = False"),
        (lambda: bearing_loads(TwoPoint(), [1, 2, 3], [0, 0, 0], models={"N": None}), "rigid"),
        (lambda: bearing_loads(plain(SLIM), [1, 2, 3], [0, 0, 0], models={"M": None}), "'M'"),
        (
            lambda: bearing_loads(plain(Beam((replace(SOLID, length=3.0),))), [1, 2, 3], [0, 0, 0]),
            "sections reach to 3 m",
        ),
        (
            lambda: bearing_loads(
                plain(SLIM), [1, 2, 3], [0, 0, 0], models={"N": lambda f, m: (f, m)}
            ),
            "displacement of shape",
        ),
    ],
)
def test_nonsense_is_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_a_bearing_without_stiffness_is_refused():
    def loose(force, moment):
        return np.zeros((len(force), 2)), np.zeros((len(force), 2, 2))

    with pytest.raises(SolverError, match="singular"):
        bearing_loads(plain(SLIM), [0, 1, 2], [0, 0, 0], models={"N": loose})


def test_the_former_names_still_work_and_say_so():
    with pytest.warns(DeprecationWarning, match="Beam: seats is now supports") as told:
        beam = Beam(seats=(STIFF, FREE))
    assert told[0].filename == __file__
    assert beam == Beam(supports=(STIFF, FREE))
    with pytest.warns(DeprecationWarning, match="Beam: seats is now supports") as told:
        assert beam.seats == (STIFF, FREE)
    assert told[0].filename == __file__
    state = np.zeros(1)
    with pytest.warns(DeprecationWarning, match="CoupledBearing: quick is now cheap"):
        bearing = CoupledBearing(lambda rows: None, state, state.astype(bool), quick=True)
    assert bearing.cheap


@pytest.mark.parametrize("share", [-1e-11, 0.0, 1e-11])
def test_sections_that_add_up_but_for_rounding_end_with_the_shaft(share):
    lengths = 4.1, 2.1 * (1 + share)
    beam = Beam(tuple(replace(SOLID, length=length) for length in lengths))
    assert [stop for _, stop, _ in beam.stretches(6.2)] == [4.1, 6.2]
