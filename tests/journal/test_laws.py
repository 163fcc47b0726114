"""Every film law: slopes, limits, conservation, order of convergence."""

import numpy as np
import pytest
from toy_film import SoftGuembel

from loadflow.journal import (
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
)

OIL = Lubricant(0.05)
BEARING = JournalBearing(diameter=1.0, width=0.75, relative_clearance=1e-3)
UNIFORM = {"grading": "uniform", "inlet": None, "grid": (60, 20)}
LAWS = [
    (Reynolds(), 0.0),
    (Guembel(), 0.0),
    (Sommerfeld(), 0.0),
    (MassConserving(), 2e5),
    (GasMixture(5e4), 2e5),
    (GasMixture(50.0), 2e5),
]


@pytest.mark.parametrize("mesh", [{}, UNIFORM], ids=["default", "uniform"])
@pytest.mark.parametrize(("law", "edge"), LAWS, ids=lambda v: str(v))
def test_stiffness_and_damping_are_slopes_of_the_free_boundary_problem(law, edge, mesh):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, **mesh}
    state = BEARING.equilibrium((3e5, 1e5), 10.0, **film)
    step = 1e-6 * BEARING.clearance

    def slopes(name):
        columns = []
        for shift in step * np.eye(2):
            ends = []
            for sign in (1, -1):
                point = {"eccentricity": state.eccentricity, "velocity": np.zeros(2)}
                point[name] = point[name] + sign * shift
                ends.append(BEARING.pressure(speed=10.0, **point, **film).film_force)
            columns.append((ends[1] - ends[0]) / (2 * step))
        return np.array(columns).T

    np.testing.assert_allclose(state.stiffness, slopes("eccentricity"), rtol=1e-5)
    np.testing.assert_allclose(state.damping, slopes("velocity"), rtol=1e-5)


def test_mixture_tends_to_the_mass_conserving_film():
    film = {"lubricant": OIL, "edge_pressure": 2e5, **UNIFORM}
    place = (0.6 * BEARING.clearance, 0.0)
    sharp = BEARING.pressure(place, 10.0, cavitation=MassConserving(), **film)
    errors = []
    for mixing in (1e3, 1e2, 1e1, 1e0):
        soft = BEARING.pressure(place, 10.0, cavitation=GasMixture(mixing), **film)
        errors.append(np.abs(soft.fill - sharp.fill).max())
    assert np.all(np.diff(errors) < 0)
    assert errors[-1] < 1e-3
    np.testing.assert_allclose(soft.force, sharp.force, rtol=1e-4)


def test_mass_conserving_film_is_full_or_at_cavitation_pressure():
    film = BEARING.pressure((0.7 * BEARING.clearance, 0.0), 10.0, OIL,
                            cavitation=MassConserving(1e4), edge_pressure=1e5)  # fmt: skip
    assert film.pressure.min() >= 1e4
    assert film.fill.max() <= 1.0
    assert film.fill.min() > 0.0
    np.testing.assert_allclose((film.pressure - 1e4) * (1 - film.fill), 0.0, atol=1e-6)


def test_grooves_give_what_leaves_through_the_rims():
    supply = Supply([Groove(np.pi / 2, arc=0.2, length=0.5, pressure=2e5), Groove(-np.pi / 2)])
    film = BEARING.pressure((0.5 * BEARING.clearance, 0.0), 10.0, OIL,
                            cavitation=MassConserving(), supply=supply)  # fmt: skip
    assert film.side_flow > 0
    assert film.supply_flow == pytest.approx(film.side_flow, rel=1e-9)


def test_sommerfeld_film_is_odd_about_the_narrowest_gap():
    film = BEARING.pressure((0.5 * BEARING.clearance, 0.0), 10.0, OIL, cavitation=Sommerfeld())
    np.testing.assert_allclose(film.pressure, -film.pressure[::-1], rtol=1e-9, atol=1e-6)
    state = BEARING.equilibrium((1e5, 0.0), 10.0, OIL, cavitation=Sommerfeld())
    assert state.attitude_angle == pytest.approx(np.pi / 2, abs=1e-9)


@pytest.mark.parametrize(
    ("law", "edge", "order"),
    [
        (Sommerfeld(), 0.0, 1.8),
        (Guembel(), 0.0, 1.8),
        (Reynolds(), 0.0, 1.8),
        (GasMixture(5e4), 2e5, 0.75),  # upwind fill: order 1, seen from 240 cells on
        (MassConserving(), 2e5, 0.75),
    ],
    ids=lambda v: str(v),
)
def test_order_of_convergence_of_the_load(law, edge, order):
    place = (0.4 * BEARING.clearance, 0.0)
    loads = []
    for n in (2, 4, 8):
        film = BEARING.pressure(place, 10.0, OIL, cavitation=law, edge_pressure=edge,
                                grid=(60 * n, 8 * n), grading="uniform")  # fmt: skip
        loads.append(film.force)
    coarse, fine = np.linalg.norm(np.diff(loads, axis=0), axis=1)
    assert np.log2(coarse / fine) > order


def test_newton_finds_every_load():
    rng = np.random.default_rng(5)
    for law, edge in LAWS:
        bearing = JournalBearing(1.0, rng.uniform(0.2, 1.0), 1e-3)
        so = 10 ** rng.uniform(-2, 1.5, 12)
        turn = rng.uniform(0, 2 * np.pi, 12)
        size = so * bearing.width * bearing.diameter * 0.05 * 10.0 / 1e-6
        loads = size[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        state = bearing.equilibrium(loads, 10.0, OIL, law, edge, grid=(60, 20))
        assert state.converged.all()
        np.testing.assert_allclose(state.sommerfeld_number, so)


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=str)
def test_turning_backwards_mirrors_every_law(law, edge):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": (40, 8)}
    forward = BEARING.equilibrium((3e5, 1e5), 10.0, **film)
    backward = BEARING.equilibrium((3e5, -1e5), -10.0, **film)
    np.testing.assert_allclose(backward.eccentricity, forward.eccentricity * [1, -1], rtol=1e-8)
    mirror = np.outer([1, -1], [1, -1])
    np.testing.assert_allclose(backward.damping, forward.damping * mirror, rtol=1e-5)


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=str)
def test_turning_the_load_turns_the_answer(law, edge):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": (40, 8)}
    states = BEARING.equilibrium([(3e5, 0.0), (0.0, 3e5)], 10.0, **film)
    turn = np.array([[0, -1], [1, 0]])
    np.testing.assert_allclose(states.eccentricity[1], turn @ states.eccentricity[0], rtol=1e-7)
    turned = turn @ states.stiffness[0] @ turn.T
    np.testing.assert_allclose(states.stiffness[1], turned, rtol=1e-5, atol=1e-5 * turned.max())


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=str)
def test_extreme_loads_have_an_answer_or_are_flagged(law, edge):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": (40, 8)}
    idle = BEARING.equilibrium((0.0, 0.0), 0.0, **film)
    assert idle.eccentricity_ratio == 0.0
    feather = BEARING.equilibrium((1e-3, 0.0), 10.0, **film)
    assert 0.0 < feather.eccentricity_ratio < 1e-6
    anvil = BEARING.equilibrium((1e14, 0.0), 10.0, strict=False, max_iterations=20, **film)
    assert anvil.converged or np.isnan(anvil.eccentricity_ratio)


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_a_law_is_one_class_and_its_compiled_function(rung):
    """A law of one file lies between those of which it is made, on every rung with cells."""
    film = {"grid": (36, 8), "inlet": None, "grading": "uniform", "rung": rung}
    laws = Guembel(), SoftGuembel(0.0), SoftGuembel(0.5), SoftGuembel(1.0), Sommerfeld()
    states = [BEARING.equilibrium((1e5, 0.0), 10.0, OIL, cavitation=law, **film) for law in laws]
    ratios = [float(state.eccentricity_ratio) for state in states]
    assert ratios[0] == pytest.approx(ratios[1], rel=1e-9)
    assert ratios[3] == pytest.approx(ratios[4], rel=1e-9)
    low, high = sorted((ratios[0], ratios[4]))
    assert low < ratios[2] < high
