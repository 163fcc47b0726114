"""Grooves, pockets, restrictors and pumps against the film."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Capillary,
    ConstantFlow,
    GasMixture,
    Groove,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Orifice,
    Pump,
    Reynolds,
    Sommerfeld,
    Supply,
)

BEARING = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
OIL = Lubricant(0.03)
GRID = (48, 12)
QUARTERS = (0.0, np.pi / 2, np.pi, -np.pi / 2)
RESTRICTORS = [Capillary(1e-3, 0.1), Orifice(0.6e-3), ConstantFlow(2e-5)]
LAWS = [Sommerfeld(), Reynolds(), MassConserving(), GasMixture(1e4)]


def pockets(restrictor, pressure=5e6, angles=QUARTERS):
    if isinstance(restrictor, ConstantFlow):
        pressure = 0.0
    return Supply(
        [
            Groove(angle, arc=0.6, length=0.12, pressure=pressure, restrictor=restrictor)
            for angle in angles
        ]
    )


def options(supply, law=None, **more):
    film = {"lubricant": OIL, "cavitation": law, "supply": supply, "grid": GRID}
    return film | {"edge_pressure": 1e5} | more


@pytest.mark.parametrize("restrictor", RESTRICTORS, ids=lambda r: type(r).__name__)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("speed", [0.0, 0.5, 60.0])
def test_pockets_lift_at_rest_and_turn_into_a_hybrid_bearing(restrictor, law, speed):
    film = options(pockets(restrictor), law)
    state = BEARING.equilibrium((8e3, 1e3), speed, **film)
    assert 0.02 < state.eccentricity_ratio < 0.3
    field = BEARING.pressure(state.eccentricity, speed, **film)
    np.testing.assert_allclose(field.force, (8e3, 1e3), rtol=1e-7)
    np.testing.assert_allclose(field.groove_pressure, state.groove_pressure, rtol=1e-7)


@pytest.mark.parametrize(
    ("restrictor", "pressure", "load"), [(None, 3e5, 5e4), (RESTRICTORS[0], 5e6, 8e4)]
)
def test_a_shaft_waits_for_the_rupture_of_oil_that_is_conserved(restrictor, pressure, load):
    """A shaft that follows each wrong rupture takes up to 39 Newton steps, and 27 on average."""
    around = np.linspace(0.0, 2 * np.pi, 12, endpoint=False)
    force = load * np.stack([np.cos(around), np.sin(around)], axis=1)
    film = options(pockets(restrictor, pressure), MassConserving(), grading="uniform")
    state = BEARING.equilibrium(force, 60.0, **film)
    assert state.converged.all()
    assert state.iterations.max() < 20


@pytest.mark.parametrize("restrictor", RESTRICTORS, ids=lambda r: type(r).__name__)
def test_flow_and_pressure_of_a_pocket_fit_its_restrictor(restrictor):
    state = BEARING.equilibrium((8e3, 1e3), 20.0, **options(pockets(restrictor)))
    drop, flow = 5e6 - state.groove_pressure, state.groove_flow
    if isinstance(restrictor, Capillary):
        wanted = np.pi * 1e-12 * drop / (128 * 0.03 * 0.1)
    elif isinstance(restrictor, Orifice):
        wanted = 0.62 * np.pi / 4 * 0.36e-6 * np.sqrt(2 * drop / OIL.density)
    else:
        wanted = np.full(4, 2e-5)
    np.testing.assert_allclose(flow, wanted, rtol=1e-8)
    assert state.supply_flow == pytest.approx(flow.sum())


@pytest.mark.parametrize("restrictor", RESTRICTORS, ids=lambda r: type(r).__name__)
@pytest.mark.parametrize("speed", [0.0, 60.0])
def test_stiffness_and_damping_hold_the_pressure_of_the_pockets(restrictor, speed):
    film = options(pockets(restrictor), GasMixture(1e4))
    state = BEARING.equilibrium((8e3, 1e3), speed, **film)
    step = 1e-5 * BEARING.clearance
    for matrix, name in ((state.stiffness, "eccentricity"), (state.damping, "velocity")):
        slopes = np.empty((2, 2))
        for j in range(2):
            forces = []
            for sign in (1, -1):
                point = {"eccentricity": state.eccentricity, "velocity": np.zeros(2)}
                point[name] = point[name] + sign * step * np.eye(2)[j]
                forces.append(BEARING.pressure(speed=speed, **point, **film).film_force)
            slopes[:, j] = -(forces[0] - forces[1]) / (2 * step)
        np.testing.assert_allclose(matrix, slopes, rtol=1e-5, atol=1e-5 * np.abs(slopes).max())


def test_pocket_at_rest_carries_what_the_resistances_of_its_lands_allow():
    # a ring-shaped groove in a concentric gap: flow and pressure in closed form
    ring = Supply([Groove(0.0, arc=2 * np.pi, length=0.05, restrictor=ConstantFlow(1e-5))])
    field = BEARING.pressure((0.0, 0.0), 0.0, **options(ring, Sommerfeld()))
    land = 0.5 * (0.2 - 0.05)
    conductance = 2 * 2 * np.pi * 0.1 * BEARING.clearance**3 / (12 * 0.03 * land)
    assert field.groove_pressure[0] - 1e5 == pytest.approx(1e-5 / conductance, rel=2e-3)
    assert field.side_flow == pytest.approx(1e-5, rel=1e-8)


def test_a_load_beyond_the_lift_of_the_supply_is_named():
    with pytest.raises(SolverError, match=r"ω = 0 rad/s: the supply carries no more than [\d.]+ N"):
        BEARING.equilibrium((1e6, 0.0), 0.0, **options(pockets(RESTRICTORS[0])))


def test_pump_and_line_settle_with_the_film():
    pump = Pump(flow=(0.0, 1e-4, 2e-4), pressure=(2e6, 1.5e6, 0.0), line=Capillary(3e-3, 1.0))
    grooves = [Groove(angle, arc=0.3, length=0.15) for angle in (np.pi / 2, -np.pi / 2)]
    state = BEARING.equilibrium((8e3, 0.0), 60.0, **options(Supply(grooves, pump), GasMixture(1e4)))
    flow = state.groove_flow.sum()
    curve = np.interp(flow, pump.flow, pump.pressure)
    line = 128 * 0.03 * flow / (np.pi * 81e-12)
    np.testing.assert_allclose(state.groove_pressure, curve - line, rtol=1e-8)
    assert state.supply_power == pytest.approx(flow * curve)


def test_a_strong_pump_without_resistance_is_a_given_pressure():
    grooves = [Groove(angle, arc=0.3, length=0.15, pressure=8e5) for angle in (1.5, -1.5)]
    given = BEARING.equilibrium((8e3, 0.0), 60.0, **options(Supply(grooves), GasMixture(1e4)))
    free = [Groove(angle, arc=0.3, length=0.15) for angle in (1.5, -1.5)]
    pumped = Supply(free, Pump(flow=(0.0,), pressure=(8e5,)))
    state = BEARING.equilibrium((8e3, 0.0), 60.0, **options(pumped, GasMixture(1e4)))
    for name in ("eccentricity", "groove_flow", "supply_power", "stiffness"):
        np.testing.assert_allclose(getattr(state, name), getattr(given, name), rtol=1e-6)


@pytest.mark.parametrize("law", [MassConserving(), GasMixture(1e4)], ids=lambda w: type(w).__name__)
def test_a_starved_bearing_is_named_and_runs_nearer_to_its_shell(law):
    edge = 0.0 if isinstance(law, MassConserving) else 1e5
    ratios = []
    for flow in (4e-5, 1e-6):
        supply = Supply([Groove(np.pi, arc=0.3, length=0.15, restrictor=ConstantFlow(flow))])
        state = BEARING.equilibrium((3e4, 0.0), 60.0, **options(supply, law, edge_pressure=edge))
        assert state.supply_flow == pytest.approx(flow, rel=1e-8)
        ratios.append((state.starved, state.eccentricity_ratio))
    (full, much), (starved, little) = ratios
    assert not full
    assert starved
    assert little > much


def test_oil_of_a_mass_conserving_film_without_flooded_rims_comes_from_its_groove():
    supply = Supply([Groove(np.pi, arc=0.3, length=0.15, restrictor=ConstantFlow(5e-6))])
    state = BEARING.equilibrium(
        (8e3, 0.0), 60.0, **options(supply, MassConserving(), edge_pressure=0.0)
    )
    assert state.side_flow == pytest.approx(5e-6, rel=1e-6)
    assert state.groove_pressure[0] == 0.0


def test_a_law_without_fill_refuses_a_starved_supply():
    supply = Supply([Groove(np.pi, arc=0.3, length=0.15, restrictor=ConstantFlow(1e-9))])
    film = options(supply, Reynolds(), edge_pressure=0.0)
    with pytest.raises(SolverError, match="the supply is starved"):
        BEARING.equilibrium((8e3, 0.0), 60.0, **film)
    assert not BEARING.equilibrium((8e3, 0.0), 60.0, **film, strict=False).converged


def test_a_round_pocket_acts_like_a_square_one_of_its_area():
    side, diameter = 0.05, 0.05 * np.sqrt(4 / np.pi)
    square = Groove(0.0, arc=side / 0.1, length=side, pressure=1e6)
    round_ = Groove(0.0, length=diameter, pressure=1e6, shape="circle")
    forces = []
    for groove in (square, round_):
        field = BEARING.pressure((0.0, 0.0), 0.0, **options(Supply([groove]), grid=(96, 24)))
        forces.append((field.force[0], field.supply_flow))
    # in the plane a square has 4.6 % more logarithmic capacity than the circle of its area
    np.testing.assert_allclose(forces[1], forces[0], rtol=0.08)


def test_a_groove_that_reaches_the_rim_is_closed_there():
    flows = []
    for cells in (12, 24, 48):
        supply = Supply([Groove(np.pi, arc=0.3, pressure=3e5)])
        film = options(supply, MassConserving(), grid=(48, cells))
        field = BEARING.pressure((3e-5, 0.0), 60.0, **film)
        flows.append(field.supply_flow)
        inflow = field.side_flow - field.supply_flow  # over the flooded rims
        assert inflow > 0
    assert abs(flows[2] / flows[1] - 1) < 0.12  # an open end would double with every refinement


@pytest.mark.parametrize("tilt", [(0.0, 0.0), (1e-4, 1.5e-4)], ids=["aligned", "tilted"])
def test_cells_crowd_at_the_ends_of_a_bearing_fed_over_its_whole_width(tilt):
    """A film of sharp law is then three times nearer to one of many cells; aligned as tilted."""
    groove = Supply([Groove(np.pi, arc=0.4, pressure=1.5e5)])

    def least(grid, grading="auto"):
        film = options(groove, Reynolds(), grid=grid, grading=grading)
        return BEARING.equilibrium((9e4, 2e4), 30.0, tilt=tilt, **film).minimum_film

    fine = least((240, 60))
    even, own = (abs(least((120, 24), cells) / fine - 1.0) for cells in ("uniform", "auto"))
    assert own < even / 3.0
    assert even > 1e-3


def test_two_pockets_off_mid_plane_are_one_fed_pair():
    pair = Supply([Groove(0.0, arc=0.5, length=0.04, axial=0.05, pressure=1e6)])
    field = BEARING.pressure((0.0, 0.0), 0.0, **options(pair, grid=(48, 20)))
    at_groove = np.abs(field.angle[:, None] % (2 * np.pi)) < 0.2
    inside = np.abs(np.abs(field.z) - 0.05) < 0.019
    assert np.all(field.pressure[at_groove[:, 0]][:, inside] == 1e6)
    assert np.all(field.pressure[at_groove[:, 0]][:, np.abs(field.z) < 0.02] < 1e6)


def test_pockets_carry_a_moment_at_rest():
    film = options(pockets(Capillary(1e-3, 0.1)), GasMixture(1e4))
    upright = BEARING.equilibrium((8e3, 0.0), 0.0, moment=(0.0, 0.0), **film)
    tilted = BEARING.equilibrium((8e3, 0.0), 0.0, moment=(5.0, 0.0), **film)
    np.testing.assert_allclose(upright.tilt, 0.0, atol=1e-10)
    # as the four degrees of freedom of the stiffness say
    moved = np.linalg.solve(upright.stiffness, [0.0, 0.0, 5.0, 0.0])
    np.testing.assert_allclose(tilted.tilt, moved[2:], rtol=1e-3, atol=1e-10)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Groove(0.0, shape="circle"), "length = None"),
        (lambda: Groove(0.0, arc=7.0), "arc = 7.0"),
        (lambda: Pump(flow=(1.0, 0.0), pressure=(1.0, 2.0)), r"flow = \(1.0, 0.0\)"),
        (lambda: Pump(flow=(0.0, 1.0), pressure=(1.0, 2.0)), r"pressure = \(1.0, 2.0\)"),
        (lambda: Supply((), Pump((0.0,), (1e5,))), "grooves"),
        (lambda: Supply([Groove(0.0, pressure=1.0)], Pump((0.0,), (1e5,))), "not given with a"),
        (lambda: ConstantFlow(0.0), "flow = 0.0"),
        (lambda: Capillary(0.0, 1.0), "diameter = 0.0"),
        (lambda: Orifice(1e-3, 0.0), "discharge_coefficient = 0.0"),
    ],
)
def test_bad_supplies_are_named(make, message):
    with pytest.raises(InputError, match=message):
        make()


@pytest.mark.parametrize(
    ("grooves", "message"),
    [
        ([Groove(0.0, length=0.1, axial=0.06)], r"grooves\[0\] of length 0.1 m at 0.06 m"),
        ([Groove(0.0, arc=0.3), Groove(0.1, arc=0.3)], r"grooves\[1\] overlaps grooves\[0\]"),
    ],
)
def test_grooves_that_do_not_fit_are_named(grooves, message):
    with pytest.raises(InputError, match=message):
        BEARING.pressure((0.0, 0.0), 1.0, **options(Supply(grooves)))


def test_a_groove_beside_the_shell_is_named():
    """An arc leaves a part of the circle without shell."""
    half = replace(BEARING, shape=Arc(0.0, np.pi))
    with pytest.raises(InputError, match=r"grooves\[0\].angle = 3.0 .* an angle, rad, at which"):
        half.pressure((0.0, 0.0), 1.0, **options(Supply([Groove(3.0, arc=0.1)])))


@pytest.mark.parametrize("between", [0.0, np.pi])
def test_a_groove_in_the_groove_between_two_lobes_is_refused_wherever_that_is(between):
    """Of two gaps between lobes the mesh has cells in one alone."""
    shape = Lobes(2, preload=0.3, groove=0.35, angle=np.pi / 2)
    bearing = JournalBearing(0.2, 0.2, 1e-3, shape=shape)
    supply = Supply([Groove(between, arc=0.2, length=0.12, pressure=5e5)])
    with pytest.raises(InputError, match=r"grooves\[0\].angle = .* an angle, rad, at which"):
        bearing.equilibrium((8e3, 1e3), 20.0, **options(supply))
