"""Elastic shells: limits, closed forms, balance, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    ConstantFlow,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    LinedShell,
    LocalShell,
    Lubricant,
    MassConserving,
    MatrixShell,
    Pump,
    Reynolds,
    Sommerfeld,
    Supply,
    ThickShell,
    TiltingPads,
)
from loadflow.journal.film.shell.cylinder import bore_compliance
from loadflow.journal.line import Line
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.path import solve_beyond_fold
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits
from loadflow.scene.journal import Journal
from loadflow.stages.films.of_bearing import equilibria, follow
from loadflow.validation.shell import annular_seal, plane_ring, soft_arc

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FILM = {
    "lubricant": Lubricant(0.05),
    "cavitation": GasMixture(0.05e6),
    "edge_pressure": 0.5e6,
    "grid": (36, 12),
}
LOAD, SPEED = (2.6e6, -0.46e6), 1.267
SOFT = LocalShell(1e-10)
THICK = ThickShell(outer_diameter=3.6, modulus=2e9)


@pytest.mark.parametrize("shell", [LocalShell(0.0), LocalShell(1e-22), ThickShell(3.6, 1e22)])
def test_a_stiff_shell_is_the_rigid_one(shell):
    rigid = BEARING.equilibrium(LOAD, SPEED, **FILM)
    stiff = BEARING.equilibrium(LOAD, SPEED, shell=shell, **FILM)
    for name in ("eccentricity", "maximum_pressure", "friction_power", "side_flow"):
        np.testing.assert_allclose(getattr(stiff, name), getattr(rigid, name), rtol=1e-10)
    # the narrowest gap is sought at angles half a degree apart
    np.testing.assert_allclose(stiff.minimum_film, rigid.minimum_film, rtol=2e-5)
    # K of the rigid bearing is that of central differences of the gap, good to 1e-7
    np.testing.assert_allclose(stiff.stiffness, rigid.stiffness, rtol=1e-5)
    assert stiff.shell_deformation < 1e-14
    assert rigid.shell_deformation == 0.0


@pytest.mark.parametrize("shell", [SOFT, THICK])
@pytest.mark.parametrize(
    "film",
    [
        {},
        {"cavitation": Guembel()},
        {"supply": Supply([Groove(np.pi / 2, arc=0.3, length=1.5, restrictor=ConstantFlow(2e-4))])},
        {"tilt": (1e-5, 4e-5)},
    ],
)
def test_stiffness_is_the_derivative_of_the_force(shell, film):
    film = FILM | film | {"shell": shell}
    place = np.array([3e-4, 3e-4])
    state = BEARING.pressure(place, SPEED, **film)
    step = 1e-5 * BEARING.clearance
    for axis, shift in enumerate(step * np.eye(2)):
        ahead, behind = (BEARING.pressure(place + s, SPEED, **film) for s in (shift, -shift))
        slope = (ahead.force - behind.force) / (2 * step)
        np.testing.assert_allclose(
            slope, state.stiffness[:2, axis], atol=1e-6 * np.abs(state.stiffness[:2, :2]).max()
        )


@given(
    compliance=st.floats(1e-14, 1e-10),
    load=st.floats(1e5, 2e6),
    angle=st.floats(0, 6.28),
    speed=st.floats(0.8, 2.0),
)
@settings(max_examples=15, deadline=None)
def test_pressure_carries_the_load_and_opens_the_gap(compliance, load, angle, speed):
    force = load * np.array([np.cos(angle), np.sin(angle)])
    shell = LocalShell(compliance)
    state = BEARING.equilibrium(force, speed, shell=shell, **FILM)
    field = BEARING.pressure(state.eccentricity, speed, shell=shell, **FILM)
    np.testing.assert_allclose(field.force, force, rtol=1e-7, atol=1e-7 * load)
    np.testing.assert_allclose(field.deformation, compliance * (field.pressure - 0.5e6), rtol=1e-12)
    assert state.shell_deformation == pytest.approx(
        compliance * (state.maximum_pressure - 0.5e6), rel=1e-9
    )
    cell = BEARING.radius * 2 * np.pi / 36 * BEARING.width / 12
    along = np.stack([np.cos(field.angle), np.sin(field.angle)])
    # the cosine is integrated over the cell: 2 sin(½ dθ)/dθ
    share = np.sinc(1 / 36)
    np.testing.assert_allclose(
        share * cell * (along @ field.pressure).sum(axis=1), force, rtol=2e-3, atol=2e-3 * load
    )


def test_a_thick_shell_is_that_of_its_influence_numbers():
    unit = _influence_numbers()
    matrix = MatrixShell(unit)
    for line in ({}, {"moment": (1e4, 5e4)}):
        thick, given_numbers = (
            BEARING.equilibrium(LOAD, SPEED, shell=shell, **line, **FILM)
            for shell in (THICK, matrix)
        )
        np.testing.assert_allclose(given_numbers.eccentricity, thick.eccentricity, rtol=1e-9)
        np.testing.assert_allclose(given_numbers.stiffness, thick.stiffness, rtol=1e-5)


@pytest.mark.parametrize("law", [MassConserving(), Reynolds()])
def test_a_matrix_is_that_of_even_cells_by_laws_with_a_sharp_rupture(law):
    film = FILM | {"cavitation": law, "inlet": None}
    matrix = film | {"shell": MatrixShell(_influence_numbers())}
    numbers, thick, reduced = (
        BEARING.equilibrium(LOAD, SPEED, **words).minimum_film
        for words in (
            matrix,
            film | {"shell": THICK, "grading": "uniform"},
            matrix | {"rung": "reduced"},
        )
    )
    assert numbers == pytest.approx(thick, rel=1e-9)
    assert numbers == pytest.approx(reduced, rel=0.02)


def test_influence_numbers_are_reciprocal_and_symmetric_about_three_planes():
    numbers = _influence_numbers()
    np.testing.assert_allclose(numbers, numbers.T, rtol=1e-9, atol=1e-12 * numbers.max())
    cells = numbers.reshape(36, 12, 36, 12)
    np.testing.assert_allclose(cells[:, ::-1, :, ::-1], cells, rtol=1e-6, atol=1e-9 * cells.max())
    turned = np.roll(cells, (9, 9), axis=(0, 2))
    np.testing.assert_allclose(turned, cells, rtol=1e-9, atol=1e-9 * cells.max())
    np.testing.assert_array_equal(numbers.argmax(axis=0), np.arange(36 * 12))


def _influence_numbers():
    from loadflow.journal.film.gap.shaped_mesh import shaped_mesh
    from loadflow.journal.film.shell.compliance import compliance_of

    mesh = shaped_mesh(0.75, (36, 12), False, False, (), (), ())
    unit = np.eye(36 * 12).reshape(-1, 36, 12)
    return compliance_of(THICK, mesh, 1.5).growth(unit).reshape(36 * 12, -1).T


def test_a_long_cylinder_is_a_plane_ring():
    for order in (0, 1, 2, 5):
        exact, found = plane_ring(order)
        assert found == pytest.approx(exact, rel=1e-5)


def test_a_thin_wall_gives_way_locally():
    wall, lining = ThickShell(3.02, 5e9), LinedShell(0.01, 5e9)
    thick, lined = (
        BEARING.equilibrium(LOAD, SPEED, shell=shell, **FILM) for shell in (wall, lining)
    )
    # one hundredth of the distance over which the pressure changes
    assert thick.shell_deformation == pytest.approx(float(lined.shell_deformation), rel=0.02)
    assert lining.compliance_at(1e3) == pytest.approx(lining.compliance, rel=1e-6)
    half_space = 2 * (1 - 0.3**2) / (5e9 * 2 * np.pi / 1e-4)
    assert lining.compliance_at(1e-4) == pytest.approx(half_space, rel=1e-6)


def test_flow_through_a_soft_seal_is_that_of_the_closed_form():
    errors = [abs(np.subtract(*annular_seal(cells)) / annular_seal(cells)[0]) for cells in (8, 32)]
    assert errors[1] < 2e-3
    assert errors[1] < 0.5 * errors[0]


def test_a_soft_arc_has_the_pressure_of_the_differential_equation():
    exact, found = soft_arc()
    assert found == pytest.approx(exact, rel=2e-3)


def test_a_shaft_in_a_soft_shell_goes_farther_than_the_clearance():
    soft = ThickShell(3.6, 2e8)
    film = FILM | {"grid": (60, 20)}
    state = BEARING.equilibrium(LOAD, SPEED, shell=soft, **film)
    assert state.eccentricity_ratio > 1.1
    assert state.minimum_film > 0.05 * BEARING.clearance
    field = BEARING.pressure(state.eccentricity, SPEED, shell=soft, **film)
    np.testing.assert_allclose(field.force, LOAD, rtol=1e-6)


def test_a_shell_that_gives_way_keeps_the_order_of_the_film():
    """The share of the upstream gap vanishes faster than the cells do."""
    force = [
        BEARING.pressure(
            (1e-4, 3e-4), SPEED, **FILM | {"cavitation": Sommerfeld(), "grid": (n, 8)}, shell=SOFT
        ).force
        for n in (48, 96, 192)
    ]
    first, second = np.linalg.norm(np.diff(np.array(force), axis=0), axis=1)
    assert np.log2(first / second) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("growth", [0.3, 1.0])
def test_coarse_cells_find_what_fine_ones_find_in_soft_walls(growth):
    """The gap of a cell is the one that its pressure opens, not that of its neighbours."""
    small = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    load, wall = (4e4, 5e3), 0.02
    mean = load[0] / (small.diameter * small.width)
    soft = ThickShell(small.diameter + 2 * wall, wall * mean / (growth * small.clearance), 0.3)
    film = {"lubricant": Lubricant(0.03), "cavitation": Guembel(), "edge_pressure": 1.5e5}
    film |= {"grading": "uniform"}
    ratio = [
        float(small.equilibrium(load, 20.0, shell=soft, grid=(n, 8), **film).eccentricity_ratio)
        for n in (24, 96)
    ]
    assert ratio[0] == pytest.approx(ratio[1], rel=5e-3)


def test_rims_that_would_meet_the_shaft_are_named():
    with pytest.raises(SolverError, match=r"touches the elastic shell.*z = 1\.125 m"):
        BEARING.equilibrium(LOAD, SPEED, shell=LocalShell(8e-10), **FILM | {"grid": (60, 20)})
    states = BEARING.equilibrium(
        LOAD, [SPEED, 0.0, 20.0], shell=LocalShell(1e-9), strict=False, **FILM
    )
    assert states.converged.tolist() == [False, False, True]
    assert np.isnan(states.shell_deformation[:2]).all()


@pytest.mark.parametrize("law", [Sommerfeld(), Reynolds(), MassConserving(), GasMixture(1e3)])
def test_sharp_laws_are_solved_from_stiff_to_soft(law):
    # where Newton fails from a cold start, at 3e-11 and 1e-10, the load is raised in steps
    film = {"lubricant": Lubricant(0.05), "cavitation": law, "edge_pressure": 0.5e6}
    ratios = []
    for compliance in (1e-12, 3e-11, 1e-10, 3e-10):
        state = BEARING.equilibrium(LOAD, SPEED, shell=LocalShell(compliance), **film)
        assert state.residual < 1e-10
        ratios.append(float(state.eccentricity_ratio))
    assert ratios[0] < ratios[2] < ratios[3]


def test_a_load_beyond_a_fold_is_followed_until_the_shell_is_met():
    """Steps of the load end at 37 % of it, at a fold, on whatever cells: what is beyond?"""
    bearing = JournalBearing(diameter=1.1156749, width=0.20208713, relative_clearance=2.8520222e-4)
    places = ((2.520762, 0.8677676, 0.1091198), (4.615157, 0.8671467, 0.1583992))
    places += ((6.709552, 1.2299, 0.1317779),)
    grooves = tuple(Groove(angle, arc, length, 0.0) for angle, arc, length in places)
    pump = Pump((0.0, 8.602927e-05), (516380.6, 258190.3))
    with pytest.raises(SolverError, match="the shaft touches the elastic shell"):
        bearing.equilibrium(
            (44720.0, -75091.8),
            6.4987097,
            Lubricant(0.014516635),
            cavitation=GasMixture(284.5017),
            edge_pressure=3e5,
            grid=(60, 20),
            supply=Supply(grooves, pump),
            tilt=(7.8719e-4, 3.427e-4),
            shell=LocalShell(1.009907e-12),
        )


def test_a_path_that_leads_nowhere_leaves_the_shell_as_the_load_steps_did():
    """Whether the shaft has met it is judged by that gap, not by that of the path's last film."""
    words, load, limits = FILM | {"shell": SOFT}, np.array(LOAD), (1e-10, 50)
    statics = Statics(BEARING, Film(**words), Line.of(()), SPEED)
    reached = statics.solve(0, load, SPEED, None, Limits(*limits))
    film, place = statics.film, reached.position
    film.place(reached.u, place)
    before, effort = film.deformation.copy(), Effort(left=8e3)
    missed = replace(reached, converged=False)
    back = solve_beyond_fold(film, 40.0 * load, place, *limits, effort, missed)
    assert back is missed
    assert effort.spent > 5  # the path went on from there
    np.testing.assert_array_equal(film.deformation, before)


def test_an_orbit_under_a_slow_load_follows_the_equilibria():
    time = np.linspace(0.0, 400.0, 9)
    force = np.array(LOAD) * (1 + 0.2 * np.sin(2 * np.pi * time / 400.0))[:, None]
    path = BEARING.orbit(time, force, SPEED, shell=SOFT, **FILM)
    still = BEARING.equilibrium(force, SPEED, shell=SOFT, **FILM)
    np.testing.assert_allclose(path.eccentricity_ratio, still.eccentricity_ratio, rtol=2e-3)
    np.testing.assert_allclose(path.shell_deformation, still.shell_deformation, rtol=1e-2)
    assert path.shell_deformation.units == "m"
    assert abs(path.mass_balance) < 1e-3


@pytest.mark.parametrize("shell", [SOFT, THICK])
def test_damping_is_the_lag_behind_a_load_that_grows_slowly(shell):
    film = FILM | {"cavitation": Sommerfeld(), "shell": shell}
    growth = np.array([200.0, -50.0])  # N/s
    time = np.linspace(0.0, 40.0, 81)
    force = np.array(LOAD) + (time - time[-1])[:, None] * growth
    path = BEARING.orbit(time, force, SPEED, **film)
    still = BEARING.equilibrium(LOAD, SPEED, **film)
    moving = np.linalg.solve(still.stiffness, growth)
    behind = np.linalg.solve(still.stiffness, still.damping @ moving)
    lag = still.eccentricity - path.eccentricity.values[-1]
    np.testing.assert_allclose(lag, behind, rtol=0.01, atol=0.01 * np.abs(behind).max())


def test_samples_of_a_scene_know_what_its_shell_gives():
    section = Journal.model_validate({"shell": {"kind": "local", "compliance": 1e-10}})
    force = np.zeros((3, 3))
    force[:, 2] = -LOAD[0] * np.array([0.9, 0.95, 1.0])
    series = xr.Dataset(
        {
            "force": (("time", "axis"), force),
            "moment": (("time", "axis"), 0.0 * force),
            "speed": ("time", np.full(3, SPEED)),
        },
        coords={"time": [0.0, 0.1, 0.2]},
    )
    moved = follow(section, series, series)
    assert np.all(np.diff(moved["shell_deformation"]) > 0)
    rested = equilibria(section, force, series["speed"].values)
    assert rested.shell_deformation[0] == pytest.approx(float(moved["shell_deformation"][0]))


def test_what_is_refused():
    def ask(shell, bearing=BEARING, **more):
        return bearing.equilibrium(LOAD, SPEED, shell=shell, **FILM | more)

    with pytest.raises(InputError, match=r"rung = .*elastic shell"):
        ask(ThickShell(3.6, 2e11), rung="map")
    with pytest.raises(InputError, match="pads"):
        ask(SOFT, JournalBearing(3.0, 2.25, 0.5e-3, shape=TiltingPads(4, 1.2)))
    with pytest.raises(InputError, match="outer_diameter"):
        ask(ThickShell(2.9, 2e11))
    with pytest.raises(InputError, match="36 × 12 = 432"):
        ask(MatrixShell(np.eye(100)))
    with pytest.raises(InputError, match="locally"):
        ask(LinedShell(0.02, 1e7, 0.4999))
    for wrong in (
        lambda: LocalShell(-1e-12),
        lambda: LinedShell(0.0, 1e9),
        lambda: LinedShell(0.01, 1e9, 0.5),
        lambda: ThickShell(3.6, 0.0),
        lambda: MatrixShell(np.ones((3, 4))),
        lambda: MatrixShell([[np.nan]]),
    ):
        with pytest.raises(InputError):
            wrong()


def test_arcs_may_be_elastic():
    bearing = JournalBearing(0.2, 0.2, 1e-3, shape=Arc(0.0, 2.0))
    film = {"lubricant": Lubricant(0.02), "grid": (40, 12)}
    rigid = bearing.equilibrium((2e4, 0.0), 100.0, **film)
    for shell in (LocalShell(2e-12), ThickShell(0.3, 5e9)):
        soft = bearing.equilibrium((2e4, 0.0), 100.0, shell=shell, **film)
        assert soft.maximum_pressure < rigid.maximum_pressure


def test_a_scene_states_its_shell():
    section = Journal.model_validate(
        {"shell": {"kind": "thick", "outer_diameter": 3.6, "modulus": 2e9}}
    )
    assert section.shell == THICK
    force = np.array([[0.0, LOAD[1], -LOAD[0]]])
    found = equilibria(section, force, np.array([SPEED]))
    direct = BEARING.equilibrium(LOAD, SPEED, shell=THICK, **FILM | {"grid": (60, 20)})
    assert found.eccentricity_ratio[0] == pytest.approx(float(direct.eccentricity_ratio))
    with pytest.raises(ValueError, match="for a shell that gives way"):
        Journal.model_validate({"shell": {"kind": "local", "compliance": 1e-12}, "rung": "map"})


@pytest.mark.parametrize("wall", [0.05, 0.5])
def test_many_orders_of_a_thick_shell_are_those_that_are_computed_one_by_one(wall):
    """Of many the high ones lie on a polynomial."""
    shell = np.linspace(0.0, 0.1, 5), 1.0, 1.0 + wall, 2e11, 0.3
    every = bore_compliance(np.arange(241), *shell)
    for order in (0, 1, 7, 8, 9, 20, 57, 131, 239, 240):
        alone = bore_compliance(np.array([order]), *shell)[0]
        np.testing.assert_allclose(every[order], alone, rtol=0, atol=1e-6 * alone.max())
