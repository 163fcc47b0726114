"""Shaped bores, tilted and bent shafts, tilting pads: slopes, limits, symmetry, errors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Contour,
    Crown,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Recess,
    Reynolds,
    Sommerfeld,
    Supply,
    TiltingPads,
)

OIL = Lubricant(0.05)
SIZE = {"diameter": 1.0, "width": 0.75, "relative_clearance": 1e-3}
PLAIN = JournalBearing(**SIZE)
CLEARANCE, RADIUS = PLAIN.clearance, PLAIN.radius
LOAD = np.array([3e5, 1e5])
LAWS = [
    (Sommerfeld(), 0.0),
    (Guembel(), 0.0),
    (Reynolds(), 0.0),
    (MassConserving(), 2e5),
    (GasMixture(5e4), 2e5),
]
RUPTURING = LAWS[2:]
SHAPES = [
    Lobes(2, preload=0.5),
    Lobes(3, preload=0.3, offset=0.7, angle=1.0),
    Arc(0.3, np.radians(150)),
    Arc(0.3, np.radians(90)),
    TiltingPads(4, np.radians(80), preload=0.3, angle=np.pi / 4),
    TiltingPads(5, np.radians(60), preload=0.5, offset=0.6),
]


def film(law, edge, grid=(48, 8)):
    return {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": grid}


def slopes(bearing, state, options, speed=10.0):
    """Central differences of force and moment of the whole problem by position and velocity."""
    size = state.stiffness.shape[0]
    at = np.concatenate([state.eccentricity, state.tilt])
    tilted = size == 4

    def load(place, velocity):
        tilt = {"tilt": place[2:]} if tilted else {}
        field = bearing.pressure(place[:2], speed, velocity=velocity[:2], **tilt, **options)
        return np.concatenate([field.force, field.moment])[:size]

    def column(j, moving):
        step = np.zeros(4)
        step[j] = 1e-6 * CLEARANCE / (RADIUS if j > 1 else 1.0)
        ends = [
            load(at, sign * step) if moving else load(at + sign * step, 0 * step)
            for sign in (1, -1)
        ]
        return (ends[0] - ends[1]) / (2 * step[j])

    stiffness = np.array([column(j, False) for j in range(size)]).T
    damping = np.array([column(j, True) for j in range(2)]).T
    return stiffness, damping


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=lambda v: str(v))
def test_a_shaped_bore_without_shape_is_the_plain_bearing(law, edge):
    options = film(law, edge) | {"grading": "uniform", "inlet": None}
    plain = PLAIN.equilibrium(LOAD, 10.0, **options)
    flat = JournalBearing(**SIZE, relief=(Contour([0.0, 3.0], [0.0, 0.0]),))
    aligned = PLAIN.equilibrium(LOAD, 10.0, moment=(0.0, 0.0), **options)
    for other in (flat.equilibrium(LOAD, 10.0, **options), aligned):
        np.testing.assert_allclose(other.eccentricity, plain.eccentricity, rtol=1e-9)
        np.testing.assert_allclose(other.stiffness[:2, :2], plain.stiffness, rtol=1e-6)
        np.testing.assert_allclose(other.damping[:2, :2], plain.damping, rtol=1e-6)
        assert other.side_flow == pytest.approx(plain.side_flow, rel=1e-9)
        assert other.friction_power == pytest.approx(plain.friction_power, rel=1e-9)
        assert other.minimum_film == pytest.approx(plain.minimum_film, rel=1e-4)  # sampled
    np.testing.assert_allclose(aligned.tilt, 0.0, atol=1e-12)


@pytest.mark.parametrize(("law", "edge"), RUPTURING, ids=lambda v: str(v))
@pytest.mark.parametrize("shape", SHAPES, ids=lambda s: f"{s.kind}")
def test_stiffness_and_damping_of_shapes_are_slopes_of_the_whole_problem(shape, law, edge):
    bearing = JournalBearing(**SIZE, shape=shape)
    options = film(law, edge)
    state = bearing.equilibrium(LOAD, 10.0, **options)
    stiffness, damping = slopes(bearing, state, options)
    np.testing.assert_allclose(state.stiffness, stiffness, atol=1e-6 * np.abs(stiffness).max())
    np.testing.assert_allclose(state.damping, damping, atol=1e-6 * np.abs(damping).max())


@pytest.mark.parametrize(("law", "edge"), RUPTURING, ids=lambda v: str(v))
def test_force_and_moment_give_position_and_tilt_and_the_other_way_round(law, edge):
    options = film(law, edge, (40, 12))
    moment = np.array([4e3, -8e3])
    state = PLAIN.equilibrium(LOAD, 10.0, moment=moment, **options)
    assert state.stiffness.shape == (4, 4)
    np.testing.assert_allclose(state.moment, moment, rtol=1e-6)
    back = PLAIN.pressure(state.eccentricity, 10.0, tilt=state.tilt, **options)
    np.testing.assert_allclose(back.force, LOAD, rtol=1e-6)
    np.testing.assert_allclose(back.moment, moment, rtol=1e-6)
    held = PLAIN.equilibrium(LOAD, 10.0, tilt=state.tilt, **options)
    np.testing.assert_allclose(held.eccentricity, state.eccentricity, rtol=1e-7)
    np.testing.assert_allclose(held.moment, moment, rtol=1e-6)
    stiffness, damping = slopes(PLAIN, state, options)
    np.testing.assert_allclose(state.stiffness, stiffness, rtol=1e-5, atol=1e-7 * stiffness.max())
    np.testing.assert_allclose(state.damping[:, :2], damping, rtol=1e-5)


def test_tilt_damping_is_that_of_a_displaced_slice():
    """A narrow bearing far from nothing: its tilt moves each slice as a displacement would."""
    options = film(Sommerfeld(), 0.0, (40, 24))
    state = PLAIN.pressure((0.2 * CLEARANCE, 0.0), 10.0, tilt=(0.0, 0.0), **options)
    # without load on the tilt, moments and tilts decouple from forces by symmetry
    np.testing.assert_allclose(state.stiffness[:2, 2:], 0.0, atol=1e-9 * state.stiffness.max())
    np.testing.assert_allclose(state.damping[2:, :2], 0.0, atol=1e-9 * state.damping.max())
    assert state.damping[2, 2] > 0
    assert state.damping[3, 3] > 0
    # a full film is symmetric in its damping
    np.testing.assert_allclose(state.damping, state.damping.T, atol=1e-6 * state.damping.max())


def test_the_shaft_tilts_in_the_sense_of_the_moment():
    """At z > 0 the shaft sinks under a moment that a force at z > 0 would make."""
    arm, force = 0.1, np.array([3e5, 0.0])
    options = film(Reynolds(), 0.0, (60, 12))
    # force along the first axis at z = arm: moment about the second axis
    state = PLAIN.equilibrium(force, 10.0, moment=(0.0, arm * force[0]), **options)
    at_rims = state.eccentricity[:, None] + np.outer([state.tilt[1], -state.tilt[0]], [-0.3, 0.3])
    assert np.hypot(*at_rims[:, 1]) > np.hypot(*at_rims[:, 0])
    straight = PLAIN.equilibrium(force, 10.0, moment=(0.0, 0.0), **options)
    assert state.minimum_film < straight.minimum_film
    assert state.maximum_pressure > straight.maximum_pressure


@given(
    turn=st.floats(0.0, 2 * np.pi),
    share=st.floats(0.05, 0.4),
    law=st.sampled_from(RUPTURING),
)
@settings(max_examples=12, deadline=None, derandomize=True)
def test_turning_shape_load_and_moment_turns_the_answer(turn, share, law):
    """On a mesh that turns with the shape everything turns with it."""
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    options = film(*law, (36, 8))
    moment = share * LOAD[0] * 0.1 * np.array([0.3, 1.0])
    states = [
        JournalBearing(**SIZE, shape=Lobes(3, preload=0.2, angle=angle)).equilibrium(
            r @ LOAD, 10.0, moment=r @ moment, **options
        )
        for angle, r in ((0.4, np.eye(2)), (0.4 + turn, rotation))
    ]
    np.testing.assert_allclose(
        states[1].eccentricity, rotation @ states[0].eccentricity, atol=1e-7 * CLEARANCE
    )
    np.testing.assert_allclose(states[1].tilt, rotation @ states[0].tilt, atol=1e-10)
    four = np.kron(np.eye(2), rotation)
    turned = four @ states[0].stiffness @ four.T
    np.testing.assert_allclose(states[1].stiffness, turned, atol=1e-5 * np.abs(turned).max())


@pytest.mark.parametrize("shape", SHAPES[:2] + SHAPES[4:], ids=lambda s: s.kind)
def test_turning_backwards_mirrors_shapes(shape):
    """Mirrored about the first axis: angles and offsets change sides."""
    mirrored = type(shape)(
        **{
            **{f: getattr(shape, f) for f in shape.__dataclass_fields__},
            "angle": -shape.angle,
            "offset": 1 - shape.offset,
        }
    )
    options = film(MassConserving(), 2e5)
    one = JournalBearing(**SIZE, shape=shape).equilibrium(LOAD, 10.0, **options)
    two = JournalBearing(**SIZE, shape=mirrored).equilibrium(LOAD * [1, -1], -10.0, **options)
    np.testing.assert_allclose(two.eccentricity, one.eccentricity * [1, -1], atol=1e-7 * CLEARANCE)
    assert two.attitude_angle == pytest.approx(one.attitude_angle, abs=1e-6)
    assert two.friction_power == pytest.approx(one.friction_power, rel=1e-6)


def test_narrower_arcs_carry_less():
    """ISO 7902: of 360, 180, 150, 120 and 90° the wider arc carries more at the same place."""
    loads = []
    for span in (180, 150, 120, 90):
        bearing = JournalBearing(**SIZE, shape=Arc(0.0, np.radians(span)))
        state = bearing.equilibrium((3e5, 0.0), 10.0, OIL, grid=(60, 12))
        loads.append(state.eccentricity_ratio)
    assert np.all(np.diff(loads) > 0)


def test_lobes_without_preload_are_a_cylinder_with_grooves():
    """The same bearing stated as lobes and as grooves of a supply."""
    grooves = tuple(Groove(angle, arc=0.35) for angle in (np.pi / 2, -np.pi / 2))
    options = film(Reynolds(), 0.0, (240, 16)) | {"grading": "uniform"}
    supplied = PLAIN.equilibrium(LOAD, 10.0, supply=Supply(grooves), **options)
    lobes = JournalBearing(**SIZE, shape=Lobes(2, groove=0.35)).equilibrium(LOAD, 10.0, **options)
    np.testing.assert_allclose(
        lobes.eccentricity, supplied.eccentricity, atol=1e-3 * CLEARANCE
    )  # other cells
    scale = supplied.stiffness.max()
    np.testing.assert_allclose(lobes.stiffness, supplied.stiffness, atol=2e-3 * scale)


def test_preload_stiffens_a_lightly_loaded_bearing():
    stiffness = []
    for preload in (0.0, 0.3, 0.6):
        bearing = JournalBearing(**SIZE, shape=Lobes(3, preload=preload))
        state = bearing.equilibrium((3e3, 0.0), 10.0, OIL, grid=(60, 8))
        stiffness.append(np.linalg.eigvalsh(0.5 * (state.stiffness + state.stiffness.T)).min())
    assert np.all(np.diff(stiffness) > 0)


def test_pads_have_no_moment_about_their_pivots_and_no_cross_stiffness():
    """Load between pads, symmetric: the shaft goes straight into the load."""
    bearing = JournalBearing(**SIZE, shape=SHAPES[4])
    state = bearing.equilibrium((3e5, 0.0), 10.0, OIL, grid=(60, 12))
    assert abs(state.attitude_angle) < 1e-4
    cross = np.abs(state.stiffness[[0, 1], [1, 0]])
    assert cross.max() < 1e-6 * state.stiffness.max()
    assert state.pad_tilt.shape == (4,)
    field = bearing.pressure(state.eccentricity, 10.0, OIL, grid=(60, 12))
    dz = np.diff(np.append(0.0, np.cumsum(np.gradient(field.z))))
    for pivot in (np.pi / 4, -np.pi / 4):
        away = (field.angle - pivot + np.pi) % (2 * np.pi) - np.pi
        on_pad = np.abs(away) < np.radians(40)
        width = np.gradient(field.angle)[on_pad][:, None] * dz
        torque = (field.pressure[on_pad] * np.sin(away[on_pad])[:, None] * width).sum()
        force = (field.pressure[on_pad] * np.cos(away[on_pad])[:, None] * width).sum()
        assert force > 0
        assert abs(torque) < 0.01 * force  # cells at the ends are halved here


def test_pads_are_condensed_at_the_frequency_of_the_whirl():
    bearing = JournalBearing(**SIZE, shape=SHAPES[5])
    options = film(Reynolds(), 0.0)
    slow, slower, fast = (
        bearing.equilibrium(LOAD, 10.0, whirl=whirl, **options) for whirl in (0.0, 1e-3, 10.0)
    )
    np.testing.assert_allclose(slower.stiffness, slow.stiffness, atol=1e-6 * slow.stiffness.max())
    np.testing.assert_allclose(slower.damping, slow.damping, atol=1e-6 * slow.damping.max())
    # a pad that cannot follow a fast whirl in phase takes stiffness away and damps instead
    assert abs(np.trace(fast.stiffness) / np.trace(slow.stiffness) - 1) > 0.02
    rigid = JournalBearing(**SIZE, shape=Lobes(3)).equilibrium(LOAD, 10.0, whirl=10.0, **options)
    same = JournalBearing(**SIZE, shape=Lobes(3)).equilibrium(LOAD, 10.0, **options)
    np.testing.assert_array_equal(rigid.stiffness, same.stiffness)


def test_supply_gives_what_leaves_through_the_rims():
    """Mass balance of an open film: at rims at cavitation pressure nothing is sucked in."""
    bearing = JournalBearing(**SIZE, shape=Lobes(3, preload=0.3, groove_pressure=3e5))
    state = bearing.equilibrium(LOAD, 10.0, **film(MassConserving(), 0.0))
    assert state.side_flow > 0
    assert state.supply_flow == pytest.approx(state.side_flow, rel=1e-8)


def test_crowning_relieves_the_rims_of_a_bent_shaft():
    """Fig. 1-8 of the source: where the shaft bends, crowning lowers the peak pressure."""
    options = film(Reynolds(), 0.0, (60, 16))
    bend = np.array([1.0e-3, 0.0])  # the rims sink by bend B²/8 = 70 µm
    load = (4e6, 0.0)
    straight = PLAIN.equilibrium(load, 10.0, bend=(0.0, 0.0), **options)
    bent = PLAIN.equilibrium(load, 10.0, bend=bend, **options)
    crowned = JournalBearing(**SIZE, relief=(Crown(70e-6),))
    relieved = crowned.equilibrium(load, 10.0, bend=bend, **options)
    assert bent.minimum_film < straight.minimum_film
    assert relieved.minimum_film > bent.minimum_film
    assert relieved.maximum_pressure < bent.maximum_pressure
    np.testing.assert_allclose(bent.moment, 0.0, atol=1e-6 * load[0] * RADIUS)


def test_a_crown_as_a_contour_is_the_same_gap():
    z = np.linspace(-0.375, 0.375, 201)
    crown = JournalBearing(**SIZE, relief=(Crown(1e-4, exponent=2),))
    table = np.tile(1e-4 * (z / 0.375) ** 2, (3, 1))
    contour = JournalBearing(**SIZE, relief=(Contour([0.0, 2.0, 4.0], table, z),))
    one, two = (b.equilibrium(LOAD, 10.0, OIL, grid=(40, 12)) for b in (crown, contour))
    np.testing.assert_allclose(one.eccentricity, two.eccentricity, rtol=1e-4)
    assert one.stiffness.shape == (2, 2)  # symmetric: half of the width


def test_a_displaced_bore_as_a_contour_displaces_the_shaft():
    """A bore shifted by d has the contour d · (cos θ, sin θ): the shaft follows it."""
    angle = np.linspace(0.0, 2 * np.pi, 721)
    shift = 0.2 * CLEARANCE
    moved = JournalBearing(**SIZE, relief=(Contour(angle, shift * np.cos(angle)),))
    options = film(Reynolds(), 0.0, (60, 12)) | {"grading": "uniform", "inlet": None}
    one = PLAIN.equilibrium(LOAD, 10.0, **options)
    two = moved.equilibrium(LOAD, 10.0, **options)
    np.testing.assert_allclose(
        two.eccentricity - one.eccentricity, [shift, 0.0], atol=1e-4 * CLEARANCE
    )


def test_a_recess_off_the_middle_makes_a_moment():
    pocket = Recess(0.0, 0.5, 2e-4, length=0.2, z=0.2)
    bearing = JournalBearing(**SIZE, relief=(pocket,))
    state = bearing.equilibrium(LOAD, 10.0, tilt=(0.0, 0.0), **film(Reynolds(), 0.0, (60, 16)))
    assert np.abs(state.moment).max() > 1.0
    other = JournalBearing(**SIZE, relief=(Recess(0.0, 0.5, 2e-4, length=0.2, z=-0.2),))
    mirrored = other.equilibrium(LOAD, 10.0, tilt=(0.0, 0.0), **film(Reynolds(), 0.0, (60, 16)))
    np.testing.assert_allclose(mirrored.moment, -state.moment, rtol=1e-6)


TIME = np.linspace(0.0, 0.4, 17)
PATH = np.stack([3e5 + 1e5 * np.sin(8 * TIME), 5e4 * np.cos(8 * TIME)], axis=-1)


@pytest.mark.parametrize(("law", "edge"), RUPTURING, ids=lambda v: str(v))
def test_orbits_without_moment_do_not_tilt(law, edge):
    options = film(law, edge, (36, 8)) | {"grading": "uniform", "inlet": None}
    aligned = PLAIN.orbit(TIME, PATH, 10.0, **options)
    free = PLAIN.orbit(TIME, PATH, 10.0, moment=np.zeros_like(PATH), **options)
    np.testing.assert_allclose(free.eccentricity, aligned.eccentricity, atol=1e-7 * CLEARANCE)
    np.testing.assert_allclose(free.tilt, 0.0, atol=1e-12)


def test_slow_moments_tilt_the_orbit_as_if_it_stood_still():
    options = film(GasMixture(5e4), 2e5, (36, 8))
    moment = np.stack([3e3 * np.cos(8 * TIME), 6e3 * np.sin(8 * TIME)], axis=-1)
    orbit = PLAIN.orbit(1e4 * TIME, PATH, 10.0, moment=moment, **options)
    static = PLAIN.equilibrium(PATH, 10.0, moment=moment, **options)
    np.testing.assert_allclose(orbit.tilt, static.tilt, atol=1e-3 * np.abs(static.tilt).max())
    np.testing.assert_allclose(orbit.eccentricity, static.eccentricity, atol=2e-3 * CLEARANCE)


@pytest.mark.parametrize("shape", SHAPES[1:3], ids=lambda s: s.kind)
def test_orbits_of_shaped_bores_follow_slow_loads(shape):
    bearing = JournalBearing(**SIZE, shape=shape)
    options = film(MassConserving(), 2e5, (36, 8))
    orbit = bearing.orbit(1000 * TIME, PATH, 10.0, **options)
    static = bearing.equilibrium(PATH, 10.0, **options)
    np.testing.assert_allclose(orbit.eccentricity, static.eccentricity, atol=2e-3 * CLEARANCE)
    fast = bearing.orbit(TIME, PATH, 10.0, **options)
    assert np.abs(fast.eccentricity - static.eccentricity).max() > 0.02 * CLEARANCE


def test_what_is_not_modelled_is_refused():
    lobes = JournalBearing(**SIZE, shape=Lobes(2))
    for call in (
        lambda: lobes.equilibrium(LOAD, 10.0, OIL, rung="map"),
        lambda: lobes.orbit(TIME, PATH, 10.0, OIL, rung="map"),
        lambda: PLAIN.equilibrium(LOAD, 10.0, OIL, moment=(0.0, 0.0), rung="map"),
    ):
        with pytest.raises(InputError, match=r'rung = .* "grid" for a shaped bore'):
            call()


@pytest.mark.parametrize("share", [0.02, 0.3, 1.0, 5.0, 20.0])
@pytest.mark.parametrize("shape", [None, *SHAPES], ids=lambda s: "tilted" if s is None else s.kind)
def test_newton_finds_light_and_heavy_loads(shape, share):
    load = share * np.array([3e5, 5e4])
    given = {"moment": 0.04 * load[::-1]} if shape is None else {}
    bearing = PLAIN if shape is None else JournalBearing(**SIZE, shape=shape)
    for law, edge in RUPTURING:
        state = bearing.equilibrium(load, 10.0, **film(law, edge), **given)
        assert state.converged
        assert state.minimum_film > 0


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (
            lambda: PLAIN.pressure((0.0, 0.0), 10.0, OIL, tilt=(0.0, 2e-3)),
            InputError,
            r"touches the bore, narrowest gap -0.00025 m at .*z = .*0.375 m",
        ),
        (
            lambda: PLAIN.equilibrium(LOAD, 10.0, OIL, tilt=(0.0, 2e-3)),
            SolverError,
            r"touches the bore in any position: narrowest gap -0.00025",
        ),
        (
            lambda: PLAIN.equilibrium(LOAD, 10.0, OIL, tilt=(0, 0), moment=(0, 0)),
            InputError,
            "moment and tilt are both given",
        ),
        (
            lambda: PLAIN.equilibrium(LOAD, 10.0, OIL, moment=(0.0, np.nan)),
            InputError,
            r"moment\[1\] = nan",
        ),
        (
            lambda: PLAIN.equilibrium(LOAD, 10.0, OIL, moment=(0.0, 0.0), inlet="widest gap"),
            InputError,
            "inlet = 'widest gap'",
        ),
        (
            lambda: PLAIN.equilibrium(LOAD, 0.0, OIL, moment=(0.0, 0.0)),
            SolverError,
            "without rotation and squeeze",
        ),
        (lambda: Lobes(3, preload=1.0), InputError, r"preload = 1.0"),
        (lambda: Lobes(4, groove=1.6), InputError, r"groove = 1.6"),
        (lambda: TiltingPads(5, arc=1.3), InputError, r"arc = 1.3"),
        (lambda: Arc(0.0, 7.0), InputError, r"span = 7.0"),
        (lambda: Contour([0.0, 1.0], [1e-5]), InputError, "height"),
        (lambda: Contour([0.0, 1.0, 0.5], [0.0, 0.0, 0.0]), InputError, "increasing"),
        (lambda: Recess(0.0, 0.1, -1e-6), InputError, r"depth = -1e-06"),
        (
            lambda: JournalBearing(0.2, 0.1, 1e-3, relief=(Crown(1e-5), Crown(1e-5, 0.06))),
            InputError,
            r"relief.1.length = 0.06 is not allowed: m, at most half of the width, 0.05",
        ),
        (
            lambda: JournalBearing(0.2, 0.1, 1e-3, relief=(Recess(0, 1, 1e-5, 0.02, z=0.07),)),
            InputError,
            r"relief.0.z = 0.07 is not allowed: m, so that the recess reaches into ±0.05",
        ),
    ],
)
def test_what_cannot_be_is_named(call, error, message):
    with pytest.raises(error, match=message):
        call()


@pytest.mark.parametrize("grading", ["uniform", "graded"])
@pytest.mark.parametrize("tilt", [None, (0.0, 0.0)], ids=["cylindrical", "fixed to the shell"])
def test_the_gap_of_a_cell_is_its_mean(grading, tilt):
    """Of the cell's arc, not of its chord, which is by 1 % shorter where twelve go around."""
    options = film(Guembel(), 0.0, grid=(12, 4)) | {"grading": grading, "inlet": None}
    line = {} if tilt is None else {"tilt": tilt}
    centred = PLAIN.pressure((0.0, 0.0), 10.0, **options, **line)
    np.testing.assert_allclose(centred.gap, CLEARANCE, rtol=1e-12)
