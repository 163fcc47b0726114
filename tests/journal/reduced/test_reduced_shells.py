"""Shells that give way all over on the rung "reduced" against the grid, and against themselves."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import (
    Control,
    Feet,
    Film,
    Flange,
    GasMixture,
    Groove,
    HousedShell,
    InfluenceShell,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MatrixShell,
    Reynolds,
    Supply,
    ThickShell,
    Turbulence,
    housing_influence,
)
from loadflow.journal.film.discretise import mesh_in_bore
from loadflow.journal.film.gap.shaped_mesh import shaped_mesh
from loadflow.journal.film.shell.compliance import compliance_of
from loadflow.journal.models.composed.shared_path import follow_shared
from loadflow.journal.models.composed.shared_sides import Lying
from loadflow.journal.models.composed.shell import _split

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING, SPEED, LOAD = JournalBearing(**SIZE), 60.0, np.array([6e3, -2.5e4])
SOFT = ThickShell(outer_diameter=0.3, modulus=1.2e10)  # gives way by a third of the narrowest gap
ELEMENTS = {"elements": (24, 1, 2), "modulus": 2.1e11}
FEET = HousedShell(outer_diameter=0.25, support=Feet(height=0.13, width=0.22), **ELEMENTS)
FLANGE = HousedShell(
    outer_diameter=0.25, support=Flange(bolt_circle=0.3, thickness=0.02, axial=0.04), **ELEMENTS
)
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1.5e5, shell=SOFT, grid=(144, 40), inlet=None)
REDUCED = replace(FILM, rung="reduced", grid=(144, 20))
NAMES = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")


def pair(bearing=BEARING, **words):
    """Film on few points across, and on the grid."""
    return replace(REDUCED, **words), replace(FILM, **words)


def check(few, fine, most=(0.006, 0.01, 0.01, 0.005), slopes=0.03):
    for name, part in zip(NAMES, most):
        assert float(getattr(few, name)) == pytest.approx(float(getattr(fine, name)), rel=part)
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(fine, name)).max()
        np.testing.assert_allclose(getattr(few, name), getattr(fine, name), atol=slopes * scale)


@pytest.mark.parametrize("shell", [SOFT, FEET, FLANGE], ids=["thick", "feet", "flange"])
def test_a_film_in_a_shell_that_gives_way_all_over_is_that_of_the_grid(shell, alone):
    few, fine = (BEARING.equilibrium(LOAD, SPEED, film) for film in pair(shell=shell))
    check(few, fine)
    rigid = BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, shell=None))
    assert abs(few.minimum_film / rigid.minimum_film - 1.0) > 0.02  # it matters
    assert few.shell_deformation == pytest.approx(fine.shell_deformation, rel=0.03)


def test_modes_of_a_housing_are_all_that_it_gives():
    mesh = shaped_mesh(0.5, (72, 16), False, False, (), (), ())
    peak = np.maximum(np.cos(mesh.angle), 0.0)[:, None] ** 6  # where it stands on its feet
    pressure = 1e7 * peak * (1.0 - (mesh.z / mesh.z_edges[-1]) ** 2)
    for shell in (FEET, FLANGE):
        compliance = compliance_of(shell, mesh, 0.1)
        split = _split(compliance, mesh)
        grown = np.einsum("kxz,k->xz", split.shapes, (split.pressed * pressure).sum(axis=(1, 2)))
        wanted = compliance.growth(pressure)
        np.testing.assert_allclose(
            grown + split.local * pressure, wanted, atol=2e-3 * np.abs(wanted).max()
        )


def test_a_housing_from_its_file_is_the_housing(tmp_path, alone):
    housing_influence(FLANGE, SIZE["diameter"], SIZE["width"]).to_netcdf(tmp_path / "housing.nc")
    states = [
        BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, shell=shell))
        for shell in (FLANGE, InfluenceShell(tmp_path / "housing.nc"))
    ]
    for name in NAMES:
        one, other = (float(getattr(state, name)) for state in states)
        assert one == pytest.approx(other, rel=1e-4)


def test_a_matrix_of_the_diagonal_alone_is_a_local_shell(alone):
    matrix = MatrixShell(4e-12 * np.eye(36 * 8))
    given = BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, grid=(36, 8), shell=matrix))
    local = BEARING.equilibrium(
        LOAD, SPEED, replace(REDUCED, grid=(36, 8), shell=LocalShell(4e-12))
    )
    for name in (*NAMES, "shell_deformation"):
        assert getattr(given, name) == pytest.approx(getattr(local, name), rel=1e-9)


def test_the_influence_matrix_of_a_thick_cylinder_is_the_cylinder(alone):
    nx, nz = 48, 16
    mesh = shaped_mesh(0.5, (nx, nz), False, False, (), (), ())
    unit = np.eye(nx * nz).reshape(nx * nz, nx, nz)
    numbers = compliance_of(SOFT, mesh, 0.1).growth(unit).reshape(nx * nz, -1).T
    states = [
        BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, grid=(nx, nz), shell=shell))
        for shell in (SOFT, MatrixShell(numbers))
    ]
    for name, most in zip((*NAMES, "shell_deformation"), (3e-3, 0.01, 5e-3, 2e-3, 0.02)):
        one, other = (float(getattr(state, name)) for state in states)
        assert one == pytest.approx(other, rel=most)


def test_the_influence_matrix_of_a_flange_at_one_end_gives_way_at_that_end(alone):
    mesh = shaped_mesh(0.5, (36, 8), False, False, (), (), ())
    unit = np.eye(36 * 8).reshape(36 * 8, 36, 8)
    numbers = compliance_of(FLANGE, mesh, 0.1).growth(unit).reshape(36 * 8, -1).T
    for film, most in ((FILM, 1e-8), (REDUCED, 0.02)):
        states = [
            BEARING.equilibrium(LOAD, SPEED, replace(film, grid=(36, 8), shell=shell))
            for shell in (FLANGE, MatrixShell(numbers))
        ]
        for name in NAMES:
            one, other = (float(getattr(state, name)) for state in states)
            assert one == pytest.approx(other, rel=most)


@pytest.mark.parametrize("shell", [SOFT, FLANGE], ids=["thick", "flange"])
def test_at_its_place_a_film_carries_its_load_and_slopes_are_those_of_the_force(shell, alone):
    film = replace(REDUCED, shell=shell)
    state = BEARING.equilibrium(LOAD, SPEED, film, tolerance=1e-12)
    here = np.asarray(state.eccentricity)
    field = BEARING.pressure(here, SPEED, film, tolerance=1e-12)
    np.testing.assert_allclose(field.force, LOAD, rtol=1e-6)
    # a position is shown on more points, that of mid-plane nearer to it
    assert np.asarray(field.deformation).max() == pytest.approx(state.shell_deformation, rel=0.04)
    step = 1e-4 * state.minimum_film
    for axis in range(2):
        moved = np.zeros((2, 2))
        moved[:, axis] = step, -step
        ahead, behind = (BEARING.pressure(here + by, SPEED, film, tolerance=1e-12) for by in moved)
        slope = (ahead.force - behind.force) / (2.0 * step)
        scale = np.abs(state.stiffness[:2, :2]).max()
        np.testing.assert_allclose(slope, state.stiffness[:2, axis], atol=1e-4 * scale)


PATH = 5e-3 * np.arange(60) / 5.0
SWING = LOAD + 1.2e4 * np.stack([np.sin(200.0 * PATH), np.cos(200.0 * PATH)], axis=1)


@pytest.mark.parametrize(
    ("shell", "tilts"),
    [
        (FEET, False),
        pytest.param(SOFT, False, marks=pytest.mark.slow),
        pytest.param(SOFT, True, marks=pytest.mark.slow),
        pytest.param(FLANGE, True, marks=pytest.mark.slow),
    ],
    ids=["feet", "thick", "thick, tilted", "flange, tilted"],
)
def test_a_path_in_a_shell_is_that_of_the_grid(shell, tilts):
    line = {"tilt": np.tile((5e-5, 1e-4), (PATH.size, 1))} if tilts else {}
    few, fine = (
        BEARING.orbit(PATH, SWING, SPEED, replace(film, grid=(72, 20)), **line)
        for film in pair(shell=shell)
    )
    for name, most in zip(NAMES, (0.006, 0.015, 0.015, 0.005)):
        scale = np.abs(fine[name]).max()
        assert float(np.abs(few[name] - fine[name]).max()) <= most * scale


@pytest.mark.slow
@pytest.mark.parametrize("own", [0, 1])
def test_a_shaft_moves_in_a_shell_at_one_bearing_and_a_rigid_one_at_the_other(own):
    none, both = np.zeros((PATH.size, 2, 2)), np.zeros((2, 2, 2, 2))
    apart = np.zeros(2, dtype=bool)  # neither film feels the other
    lying = Lying(np.stack([SWING, SWING], axis=1), none, none, both, both, apart, np.full(2, 1e-8))
    films = [replace(REDUCED, shell=SOFT if k == own else None) for k in range(2)]
    limits = Control().limits(tolerance=1e-6, max_iterations=30)
    speed = np.full(PATH.size, SPEED)
    shared = follow_shared([BEARING, BEARING], films, PATH, speed, lying, limits, rests=True)
    for film, found in zip(films, shared.paths):
        alone = BEARING.orbit(PATH, SWING, SPEED, film)
        for name in NAMES:
            scale = np.abs(alone[name]).max()
            assert float(np.abs(found[name] - alone[name]).max()) <= 0.01 * scale


@pytest.mark.slow
def test_a_closed_path_in_a_shell_is_that_of_the_grid():
    turn = 2.0 * np.pi / 200.0
    time = np.linspace(0.0, turn, 49)
    force = LOAD + 1.2e4 * np.stack([np.sin(200.0 * time), np.cos(200.0 * time)], axis=1)
    few, fine = (
        BEARING.orbit(time, force, SPEED, replace(film, grid=(72, 20)), periodic=True)
        for film in pair()
    )
    assert few.attrs["closure"] < 1e-6
    for name, most in zip(NAMES, (0.006, 0.015, 0.015, 0.005)):
        scale = np.abs(fine[name]).max()
        assert float(np.abs(few[name] - fine[name]).max()) <= most * scale


def test_steps_of_its_own_meet_the_given_ones():
    given, adaptive = (BEARING.orbit(PATH, SWING, SPEED, REDUCED, step=step)
                       for step in ("given", "adaptive"))  # fmt: skip
    scale = float(given.minimum_film.max())
    np.testing.assert_allclose(adaptive.minimum_film, given.minimum_film, atol=0.01 * scale)


FED = Supply((Groove(1.57, arc=0.3, length=0.05, pressure=3e5),))


@pytest.mark.parametrize(
    "words",
    [
        pytest.param({"cavitation": Reynolds()}, marks=pytest.mark.slow),
        pytest.param({"supply": FED}, marks=pytest.mark.slow),
        {"turbulence": Turbulence(0.0, 0.0)},
    ],
    ids=["reynolds", "fed", "turbulent"],
)
def test_other_effects_in_a_shell_are_those_of_the_grid(words, alone):
    few, fine = (BEARING.equilibrium(LOAD, SPEED, film) for film in pair(**words))
    check(few, fine, slopes=0.04)


@pytest.mark.slow
@pytest.mark.parametrize("line", [{"tilt": (5e-5, 1e-4)}, {"moment": (60.0, -100.0)}])
def test_a_tilted_shaft_in_a_shell_is_that_of_the_grid(line, alone):
    few, fine = (BEARING.equilibrium(LOAD, SPEED, film, **line) for film in pair())
    check(few, fine)
    np.testing.assert_allclose(few.moment, fine.moment, atol=0.01 * np.abs(fine.moment).max())
    np.testing.assert_allclose(few.tilt, fine.tilt, atol=0.02 * np.abs(fine.tilt).max())


@pytest.mark.slow
def test_lobes_in_a_shell_are_those_of_the_grid(alone):
    bearing = JournalBearing(**SIZE, shape=Lobes(3, preload=0.3))
    check(*(bearing.equilibrium(0.5 * LOAD, SPEED, film) for film in pair()))


@pytest.mark.parametrize("supply", [None, Supply((Groove(0.9, 0.2, 0.05, 3e5),))])
def test_an_influence_matrix_in_a_shaped_bore_is_that_of_the_grid(supply, alone):
    """Of the cells of the grid, which has several in a groove between two lobes."""
    bearing = JournalBearing(**SIZE, shape=Lobes(2, preload=0.3))
    films = [replace(film, grid=(72, 16), supply=supply) for film in (REDUCED, FILM)]
    mesh = mesh_in_bore(bearing, films[1], False)
    count = mesh.angle.size * mesh.z.size
    unit = np.eye(count).reshape(count, *mesh.shape)
    matrix = MatrixShell(
        compliance_of(SOFT, mesh, bearing.radius).growth(unit).reshape(count, -1).T
    )
    few, fine, cylinder = (
        bearing.equilibrium(0.5 * LOAD, SPEED, film)
        for film in (*(replace(film, shell=matrix) for film in films), films[0])
    )
    for name, most in zip(NAMES, (5e-3, 5e-3, 0.015, 6e-3)):
        assert float(getattr(few, name)) == pytest.approx(float(getattr(fine, name)), rel=most)
        assert float(getattr(few, name)) == pytest.approx(float(getattr(cylinder, name)), rel=1e-2)
    assert few.shell_deformation == pytest.approx(fine.shell_deformation, rel=0.03)
