"""Asperities in the film: derivatives, limits, standstill, Stribeck curve, what is refused."""

import numpy as np
import pytest
from scipy.integrate import quad

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Contact,
    Crown,
    Film,
    GasMixture,
    Groove,
    Guembel,
    Heat,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    TiltingPads,
    stribeck,
)
from loadflow.tribology import AsperityContact, greenwood_tripp

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING, C = JournalBearing(**SIZE), 1e-4
OIL = Lubricant(0.03)
ROUGH = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
CONTACT = Contact(ROUGH, friction=0.1)
LOAD = np.array([80e3, 10e3])
LAWS = [
    (Reynolds(), 0.0),
    (Guembel(), 0.0),
    (Sommerfeld(), 0.0),
    (GasMixture(5e4), 1.5e5),
    (MassConserving(), 1e5),
]
SHAPES = {
    "cylinder": ({}, {}),
    "lobes": ({"shape": Lobes(3)}, {}),
    "crown": ({"relief": (Crown(0.02, 1e-5),)}, {}),
    "tilted": ({}, {"tilt": (2e-5, 1e-5)}),
    "bent": ({}, {"bend": (1e-4, 0.0)}),
}


def film(contact=CONTACT, law=None, edge=0.0, **words):
    return Film(OIL, law, edge_pressure=edge, contact=contact, **words)


@pytest.mark.parametrize("pattern", [None, 1 / 3])
@pytest.mark.parametrize("ratio", [0.982, 0.9962, 1.0011])
@pytest.mark.parametrize("shape", SHAPES)
def test_stiffness_is_the_derivative_of_the_load(shape, ratio, pattern):
    size, more = SHAPES[shape]
    bearing = JournalBearing(**SIZE | size)
    rough = film(Contact(ROUGH, pattern=pattern, shaft_share=0.8), grid=(48, 8))
    place = ratio * C * np.array([np.cos(0.3), np.sin(0.3)])
    here = bearing.pressure(place, 2.0, rough, **more)
    step = 1e-7 * C
    for axis in np.eye(2):
        ahead, behind = (
            bearing.pressure(place + s * step * axis, 2.0, rough, **more).force for s in (1, -1)
        )
        slope = (ahead - behind) / (2 * step)
        wrong = here.stiffness[:2, :2] @ axis - slope
        assert np.abs(wrong).max() < 3e-5 * np.abs(here.stiffness[:2, :2]).max()


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=lambda v: getattr(v, "kind", None))
def test_at_standstill_the_asperities_carry_all_of_the_load(law, edge):
    state = BEARING.equilibrium(LOAD, 0.0, film(law=law, edge=edge))
    assert state.contact_share == pytest.approx(1.0, rel=1e-10)
    assert state.contact_force == pytest.approx(LOAD, rel=1e-10)
    assert state.maximum_pressure == pytest.approx(edge, abs=1e-6)
    assert state.friction_power == 0.0
    assert 0 < state.minimum_film < ROUGH.roughness


@pytest.mark.parametrize("shape", ["cylinder", "tilted"])
def test_contact_alone_is_the_integral_of_greenwood_and_tripp(shape):
    more = SHAPES[shape][1]
    state = BEARING.equilibrium((80e3, 0.0), 0.0, film(), **more)
    ex, ey = state.eccentricity
    tx, ty = more.get("tilt", (0.0, 0.0))

    def along(z, weight):
        # the zone of contact is narrower than 0.3 rad
        def pressure(angle):
            shift = (ex + ty * z) * np.cos(angle) + (ey - tx * z) * np.sin(angle)
            value = greenwood_tripp(2.5, (C - shift) / ROUGH.roughness)
            return ROUGH.scale * float(value) * weight(angle)

        return 0.1 * quad(pressure, -0.3, 0.3, epsrel=1e-10, limit=200)[0]

    if shape == "cylinder":
        carried = 0.1 * along(0.0, np.cos)
        normal = 0.1 * along(0.0, lambda angle: 1.0)
        turning = BEARING.equilibrium((80e3, 0.0), 1e-6, film())
        power = 0.1 * normal * 0.1 * 1e-6
        assert turning.contact_power == pytest.approx(power, rel=1e-3)
        rel = 1e-8
    else:
        x, w = np.polynomial.legendre.leggauss(40)
        carried = 0.05 * sum(wi * along(0.05 * xi, np.cos) for xi, wi in zip(x, w))
        rel = 1e-3  # nodes on the cells of the film
        narrowest = C - float(np.hypot(ex + 0.05 * ty, ey - 0.05 * tx))
        assert state.contact_pressure == pytest.approx(float(ROUGH.pressure(narrowest)), rel=0.1)
        assert state.contact_area == pytest.approx(float(ROUGH.area(narrowest)), rel=0.1)
    assert carried == pytest.approx(80e3, rel=rel)


def test_stiffer_oil_or_smoother_surfaces_lead_to_the_smooth_film():
    smooth = BEARING.equilibrium(LOAD, 10.0, film(None))
    for pattern, wrong in ((None, 1e-8), (3.0, 2e-3)):
        for share in (1.0, 0.1):
            fine = AsperityContact(roughness=5e-7 * share, contact_modulus=115e9, factor=1e-3)
            rough = BEARING.equilibrium(LOAD, 10.0, film(Contact(fine, pattern=pattern)))
            assert rough.contact_share < 1e-12
            for name in ("eccentricity_ratio", "friction_power", "maximum_pressure"):
                allowed = max(wrong * share, 1e-10)
                value = float(getattr(smooth, name))
                assert float(getattr(rough, name)) == pytest.approx(value, rel=10 * allowed)


def test_a_film_without_contact_says_nothing_of_it():
    state = BEARING.equilibrium(LOAD, 10.0, film(None))
    assert state.contact_share is None
    assert "contact_share" not in state.to_dataset()
    data = BEARING.equilibrium([LOAD, LOAD], 1.0, film()).to_dataset()
    assert data.contact_force.dims == ("case", "axis")
    assert data.contact_pressure.units == "Pa"


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=lambda v: getattr(v, "kind", None))
def test_load_through_zero_speed_both_ways(law, edge):
    speeds = np.array([-3.0, -0.1, -1e-3, 0.0, 1e-3, 0.1, 3.0])
    states = BEARING.equilibrium(np.array([80e3, 0.0]), speeds, film(law=law, edge=edge))
    assert states.converged.all()
    mirrored = states.eccentricity[::-1] * [1.0, -1.0]
    assert states.eccentricity == pytest.approx(mirrored, abs=1e-6 * C)
    share = states.contact_share
    assert np.all(np.diff(share[3:]) < 1e-9)
    assert share[3] == pytest.approx(1.0)
    assert states.minimum_film[3] <= states.minimum_film.min() * (1 + 1e-9)


@pytest.mark.parametrize(("law", "edge"), LAWS[:1] + LAWS[3:4], ids=lambda v: getattr(v, "kind", 0))
def test_an_orbit_passes_through_zero_speed_under_load(law, edge):
    time = np.linspace(0.0, 2.0, 41)
    speed = 3.0 * np.cos(0.5 * np.pi * time)
    path = BEARING.orbit(time, np.tile(LOAD, (41, 1)), speed, film(law=law, edge=edge))
    assert float(path.residual.max()) < 1e-8
    still = BEARING.equilibrium(LOAD, 0.0, film(law=law, edge=edge))
    # squeeze keeps the surfaces apart longer than at rest
    assert 0.05 < float(path.contact_share.max()) < 1.0
    assert float(path.minimum_film.min()) > float(still.minimum_film)
    assert path.contact_force.dims == ("time", "axis")


def test_a_film_that_keeps_its_oil_keeps_it_in_contact():
    time = np.linspace(0.0, 1.0, 41)
    turn = 2 * np.pi * time
    force = np.stack([80e3 * (1 + 0.2 * np.cos(turn)), 20e3 * np.sin(turn)], axis=-1)
    path = BEARING.orbit(time, force, 1.0, film(law=MassConserving(), edge=1e5, grid=(60, 12)))
    assert float(path.contact_share.max()) > 0.3
    assert abs(path.attrs["mass_balance"]) < 1e-3


def test_at_rest_for_long_the_film_is_squeezed_out():
    time = np.concatenate([[0.0], np.geomspace(1e-3, 1e5, 120)])
    path = BEARING.orbit(time, np.tile(LOAD, (time.size, 1)), 0.0, film(), start=(0.9 * C, 0.0))
    still = BEARING.equilibrium(LOAD, 0.0, film())
    assert path.contact_share[0] < 1e-3
    assert float(path.contact_share[-1]) == pytest.approx(1.0, abs=0.02)
    assert float(path.minimum_film[-1]) == pytest.approx(float(still.minimum_film), rel=0.02)


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_from_standstill_to_a_full_film(shape):
    size, more = SHAPES[shape]
    speeds = np.array([0.0, 0.1, 1.0, 30.0])
    states = JournalBearing(**SIZE | size).equilibrium(LOAD, speeds, film(), **more)
    assert np.all(np.diff(states.contact_share) < 0)
    assert states.contact_share[0] == pytest.approx(1.0)
    assert states.contact_share[-1] < 1e-6
    assert np.all(np.diff(states.minimum_film) > 0)


def test_a_moment_lets_the_shaft_rest_on_its_edge():
    states = BEARING.equilibrium(LOAD, [0.0, 1.0, 30.0], film(), moment=(300.0, 0.0))
    level = BEARING.equilibrium(LOAD, [0.0, 1.0, 30.0], film())
    assert np.all(states.contact_pressure[:2] > 2 * level.contact_pressure[:2])
    assert states.moment == pytest.approx(np.tile([300.0, 0.0], (3, 1)), abs=1e-3)


def test_loads_far_beyond_the_smooth_bore_converge_with_overlapping_mean_planes():
    states = BEARING.equilibrium([[2e5, 0.0], [1e6, 0.0], [5e6, 0.0]], 0.0, film())
    assert np.all(np.diff(states.eccentricity_ratio) > 0)
    assert states.eccentricity_ratio[0] > 1
    assert np.all(states.minimum_film > 0)


def test_a_load_beyond_the_law_of_contact_is_refused_with_the_overlap():
    with pytest.raises(SolverError, match="σ beyond touching"):
        BEARING.equilibrium((1e9, 0.0), 0.0, film())
    with pytest.raises(InputError, match="law of contact"):
        BEARING.pressure((1.1 * C, 0.0), 0.0, film())


def test_grooves_do_not_touch():
    groove = Supply((Groove(0.0, arc=0.1, length=0.1, pressure=1e5),))
    at = ((1.0 + 1e-4) * C, 0.0)
    with_groove = BEARING.pressure(at, 0.0, film(supply=groove, edge=1e5))
    without = BEARING.pressure(at, 0.0, film(edge=1e5))
    assert 0 < with_groove.contact_force[0] < 0.8 * without.contact_force[0]


def test_an_arc_stands_on_what_it_has():
    arc = JournalBearing(**SIZE, shape=Arc(0.0, 1.0))
    state = arc.equilibrium((80e3, 0.0), [0.0, 1.0], film(inlet=None))
    whole = BEARING.equilibrium((80e3, 0.0), 0.0, film())
    assert state.eccentricity[0, 0] == pytest.approx(float(whole.eccentricity[0]), abs=1e-3 * C)


def test_friction_of_the_asperities_warms_the_oil():
    heat = Heat(transfer=200.0)
    loads = (np.array([80e3, 0.0]), [0.0, 1.0])
    warm = BEARING.equilibrium(*loads, Film(heat=heat, contact=CONTACT))
    smooth = BEARING.equilibrium((80e3, 0.0), 1.0, Film(heat=heat))
    assert warm.temperature[0] == pytest.approx(heat.ambient_temperature, abs=1e-3)
    rough = Contact(ROUGH, friction=0.5)
    warmer = BEARING.equilibrium(*loads, Film(heat=heat, contact=rough))
    assert warmer.temperature[1] >= warm.temperature[1] >= float(smooth.temperature) - 1e-6
    again = BEARING.equilibrium(
        (80e3, 0.0), 1.0, Film(heat.lubricant(float(warm.temperature[1])), contact=CONTACT)
    )
    assert warm.contact_power[1] == pytest.approx(float(again.contact_power), rel=1e-6)


def test_stribeck_minimum_moves_as_viscosity_and_load_say():
    def curve(viscosity=0.03, load=80e3, friction=0.1):
        rough = Film(Lubricant(viscosity), contact=Contact(ROUGH, friction=friction))
        return stribeck(BEARING, (load, 0.0), (0.1, 30.0), rough, points=9)

    base = curve()
    # the isothermal film knows only η ω
    thick = curve(viscosity=0.06)
    assert float(thick.minimum_speed) == pytest.approx(float(base.minimum_speed) / 2, rel=2e-3)
    assert float(thick.transition_speed) == pytest.approx(
        float(base.transition_speed) / 2, rel=1e-3
    )
    assert float(thick.minimum_friction) == pytest.approx(float(base.minimum_friction), rel=1e-5)
    heavy = curve(load=160e3)
    assert float(heavy.minimum_speed) > 1.5 * float(base.minimum_speed)
    slippery = curve(friction=0.01)
    assert float(slippery.minimum_speed) < float(base.minimum_speed)
    assert float(slippery.transition_speed) == pytest.approx(float(base.transition_speed), rel=1e-6)
    assert 0.01 < float(curve().friction_coefficient[0]) < 0.1
    assert float(base.minimum_friction) <= float(base.friction_coefficient.min())
    at = BEARING.equilibrium((80e3, 0.0), float(base.transition_speed), film())
    assert at.contact_share == pytest.approx(0.05, abs=1e-4)


def test_flow_factors_of_patterns_along_and_across():
    def gap(pattern, share=0.5):
        rough = film(Contact(ROUGH, pattern=pattern, shaft_share=share))
        return float(BEARING.equilibrium(LOAD, 3.0, rough).minimum_film)

    # ridges across the motion hold the oil back, so that the film carries more
    assert gap(1 / 6) > gap(1.0) > gap(6.0)
    # a rough shaft carries oil along, a rough shell holds it
    assert gap(1.0, 1.0) != pytest.approx(gap(1.0, 0.0), rel=1e-4)


@pytest.mark.parametrize(
    ("words", "size", "named"),
    [
        ({}, {"shape": TiltingPads(4, np.radians(60.0))}, "contact = .* pads that tilt"),
        ({"rung": "map"}, {}, "rung = 'map' .* contact of asperities"),
    ],
)
def test_what_does_not_know_contact_refuses_it_by_name(words, size, named):
    with pytest.raises(InputError, match=named):
        JournalBearing(**SIZE | size).equilibrium(LOAD, 1.0, film(**words))


def test_bad_surfaces_are_named():
    with pytest.raises(InputError, match=r"friction = 3\.0"):
        Contact(ROUGH, friction=3.0)
    with pytest.raises(InputError, match="friction_pair"):
        Contact(ROUGH, friction="wood")
    assert Contact(ROUGH, friction="bronze").coefficient == 0.3
    coarse = AsperityContact(roughness=2e-5, contact_modulus=1e11, factor=1e-3)
    with pytest.raises(InputError, match=r"roughness = 2e-05 .* radial clearance"):
        BEARING.equilibrium(LOAD, 1.0, film(Contact(coarse)))
    with pytest.raises(InputError, match="contact: not given"):
        stribeck(BEARING, LOAD, (1.0, 2.0), film(None))
    with pytest.raises(InputError, match="speeds"):
        stribeck(BEARING, LOAD, (0.0, 2.0), film())


HIGH = Contact(
    AsperityContact(roughness=0.4e-6, contact_modulus=115e9, factor=1e-3, summit_height=0.8e-6),
    friction=0.1,
    surface_roughness=0.5e-6,
)


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_summits_above_the_mean_plane_lift_a_standing_shaft_by_their_height(rung):
    """The same tips, their mean plane higher: the shaft lies higher by just that."""
    tips = HIGH.asperities
    low = AsperityContact(
        roughness=tips.roughness, contact_modulus=tips.contact_modulus, factor=tips.factor
    )
    films = [film(Contact(one), GasMixture(5e4), 1.5e5, rung=rung) for one in (low, tips)]
    lies = [float(BEARING.equilibrium((8e4, 0.0), 0.0, one).eccentricity[0]) for one in films]
    assert lies[0] - lies[1] == pytest.approx(0.8e-6, rel=0.02)


def test_rungs_agree_on_summits_and_their_stiffness_is_exact():
    rough = film(HIGH, GasMixture(5e4), 1.5e5, grid=(240, 20), grading="uniform")
    fast = film(HIGH, GasMixture(5e4), 1.5e5, grid=(240, 20), rung="reduced")
    fine, few = (BEARING.equilibrium(LOAD, 0.8, one) for one in (rough, fast))
    assert 0.05 < fine.contact_share < 0.95
    assert few.contact_share == pytest.approx(fine.contact_share, rel=0.03)
    assert few.minimum_film == pytest.approx(fine.minimum_film, rel=0.03)
    place = np.array([0.99 * C, 0.0])
    crowned = JournalBearing(**SIZE, relief=(Crown(0.02, 1e-5),))
    here = crowned.pressure(place, 2.0, film(HIGH, grid=(48, 8)))
    step = np.array([1e-7 * C, 0.0])
    ahead, behind = (
        crowned.pressure(place + s * step, 2.0, film(HIGH, grid=(48, 8))).force for s in (1, -1)
    )
    slope = (ahead - behind) / (2 * step[0])
    assert here.contact_pressure > 0
    assert here.stiffness[:, 0] == pytest.approx(slope, rel=1e-4, abs=1e-4 * abs(slope[0]))
