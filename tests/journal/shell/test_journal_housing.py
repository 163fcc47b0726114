"""Shells in a housing of finite elements or from the file of another program."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from loadflow.cli import main
from loadflow.errors import InputError
from loadflow.journal import (
    Feet,
    Flange,
    GasMixture,
    HousedShell,
    InfluenceShell,
    JournalBearing,
    Lubricant,
    ThickShell,
    housing_influence,
)
from loadflow.journal.film.gap.shaped_mesh import shaped_mesh
from loadflow.journal.film.shell.compliance import compliance_of
from loadflow.scene import read_scene

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
SIZE = (BEARING.diameter, BEARING.width)
FILM = {
    "lubricant": Lubricant(0.05),
    "cavitation": GasMixture(0.05e6),
    "edge_pressure": 0.5e6,
    "grid": (36, 8),
}
LOAD, SPEED = (2.6e6, -0.46e6), 1.267
COARSE = (16, 1, 2)
ON_FEET = HousedShell(3.4, Feet(height=2.0, width=3.2), elements=COARSE)
ON_FLANGE = HousedShell(3.4, Flange(bolt_circle=4.4, thickness=0.15, axial=1.0), elements=COARSE)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Influence matrix of the housing on its flange in a file."""
    file = tmp_path_factory.mktemp("housing") / "influence.nc"
    housing_influence(ON_FLANGE, *SIZE).to_netcdf(file)
    return file


def test_a_housing_held_all_over_its_outside_is_the_thick_cylinder():
    """Beside the cylinder of three-dimensional elasticity, harmonic by harmonic."""
    modulus = 2e10
    held = Flange(bolt_circle=4.0, thickness=BEARING.width)
    housed = HousedShell(3.6, held, modulus, elements=(24, 2, 4))
    mesh = shaped_mesh(0.75, (48, 12), True, False, (), (), ())
    pressure = np.maximum(np.cos(mesh.angle), 0.0)[:, None] ** 3 * (1 - (mesh.z / 0.75) ** 2)
    thick = compliance_of(ThickShell(4.0, modulus), mesh, 1.5).growth(pressure)
    np.testing.assert_allclose(
        compliance_of(housed, mesh, 1.5).growth(pressure),
        thick,
        rtol=0.01,
        atol=0.002 * thick.max(),
    )


def test_a_shell_of_another_material_in_the_housing_softens_it():
    pressure = np.ones((36, 8))
    mesh = shaped_mesh(0.75, (36, 8), False, False, (), (), ())
    parts = [
        ON_FEET,
        replace(ON_FEET, shell_thickness=0.05, shell_modulus=2.1e11),
        replace(ON_FEET, shell_thickness=0.05, shell_modulus=1e11),
    ]
    steel, same, bronze = (compliance_of(one, mesh, 1.5).growth(pressure).max() for one in parts)
    assert same == pytest.approx(steel, rel=0.02)
    assert bronze > 1.1 * steel


@pytest.mark.parametrize("shell", [ON_FEET, ON_FLANGE])
def test_stiffness_is_the_derivative_of_the_force(shell):
    place, step = np.array([3e-4, 3e-4]), 1e-5 * BEARING.clearance
    state = BEARING.pressure(place, SPEED, shell=shell, **FILM)
    for axis, shift in enumerate(step * np.eye(2)):
        ahead, behind = (
            BEARING.pressure(place + s, SPEED, shell=shell, **FILM) for s in (shift, -shift)
        )
        slope = (ahead.force - behind.force) / (2 * step)
        atol = 1e-6 * np.abs(state.stiffness[:2, :2]).max()
        np.testing.assert_allclose(slope, state.stiffness[:2, axis], atol=atol)


def test_few_modes_are_within_a_hundredth_of_all():
    few, every = (
        BEARING.equilibrium(LOAD, SPEED, shell=replace(ON_FEET, accuracy=share), **FILM)
        for share in (0.002, 1e-7)
    )
    for name in ("minimum_film", "maximum_pressure", "friction_power", "eccentricity_ratio"):
        assert getattr(few, name) == pytest.approx(getattr(every, name), rel=0.01)


def test_the_matrix_of_a_file_is_the_housing_that_wrote_it(written, tmp_path):
    """On two grids of the film, at rest and in motion, of NetCDF and of numpy."""
    with xr.open_dataset(written) as data:
        names = ("angle", "axial", "influence")
        np.savez(tmp_path / "influence.npz", **{name: data[name].to_numpy() for name in names})
    times = np.linspace(0.0, 4.0, 9)
    loads = np.array(LOAD) * (1 + 0.3 * np.sin(times))[:, None]
    for shell in (InfluenceShell(written), InfluenceShell(tmp_path / "influence.npz")):
        for grid in ((36, 8), (48, 12)):
            words = FILM | {"grid": grid}
            file, own = (
                BEARING.equilibrium(LOAD, SPEED, shell=s, **words) for s in (shell, ON_FLANGE)
            )
            assert file.minimum_film == pytest.approx(own.minimum_film, rel=1e-6)
        file, own = (
            BEARING.orbit(times, loads, SPEED, shell=s, **FILM) for s in (shell, ON_FLANGE)
        )
        np.testing.assert_allclose(file.minimum_film, own.minimum_film, rtol=1e-6)
    rigid = BEARING.orbit(times, loads, SPEED, **FILM)
    assert np.abs(own.minimum_film / rigid.minimum_film - 1).max() > 0.05


def test_a_flange_at_one_end_holds_that_end():
    """The bore gives way more at the end that hangs free; a moment comes of it."""
    field = BEARING.pressure((4e-4, 2e-4), SPEED, shell=ON_FLANGE, **FILM)
    free, held = field.deformation[:, 0].max(), field.deformation[:, -1].max()
    assert free > 2 * held


def test_a_scene_reads_the_file_beside_it_and_states_a_housing(written, tmp_path, capsys):
    geometry = "geometry = {diameter = 3.0, width = 2.25, relative_clearance = 0.5e-3}\n"
    (tmp_path / "bore.nc").write_bytes(written.read_bytes())
    lines = {
        "file": "{kind = 'influence', file = 'bore.nc'}",
        "own": "{kind = 'housed', outer_diameter = 3.4, elements = [16, 1, 2], support = "
        "{kind = 'flange', bolt_circle = 4.4, thickness = 0.15, axial = 1.0}}",
    }
    found = []
    for name, shell in lines.items():
        scene = tmp_path / f"{name}.toml"
        scene.write_text(f"[journal]\n{geometry}grid = [36, 8]\nshell = {shell}\n")
        film = read_scene(scene).journal.film_model
        state = BEARING.equilibrium(LOAD, SPEED, film)
        point = ["--force-x", "2.6e6", "--force-y", "-0.46e6", "--speed-rpm", "12.1"]
        with pytest.raises(SystemExit) as end:
            main(["journal", "--scene", str(scene), *point])
        assert end.value.code in (0, None)
        assert f"{film.shell.kind} shell" in capsys.readouterr().out
        found.append(state.minimum_film)
    assert film.shell == ON_FLANGE
    assert found[0] == pytest.approx(found[1], rel=1e-6)


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda: HousedShell(3.4, Feet(height=1.5, width=3.0)), "height"),
        (lambda: HousedShell(3.4, Flange(bolt_circle=3.3, thickness=0.1)), "bolt_circle"),
        (lambda: HousedShell(3.4, Feet(2.0, 3.0), shell_modulus=1e11), "shell_thickness"),
        (lambda: HousedShell(3.4, Feet(2.0, 3.0), elements=(8, 1, 2)), "elements"),
        (lambda: HousedShell(2.9, Feet(2.0, 3.0)).check_bore(*SIZE), "outer_diameter"),
        (lambda: replace(ON_FEET, length=2.0).check_bore(*SIZE), "length"),
        (lambda: HousedShell(3.4, Flange(4.0, 0.2, axial=1.1)).check_bore(*SIZE), "axial"),
        (lambda: replace(ON_FEET, accuracy=0.5), "accuracy"),
    ],
)
def test_housings_that_cannot_be_are_refused(make, word):
    with pytest.raises(InputError, match=word):
        make()


def test_files_that_do_not_fit_are_refused(written, tmp_path):
    def ask(**changes):
        with xr.open_dataset(written) as data:
            names = ("angle", "axial", "influence")
            parts = {name: data[name].to_numpy() for name in names} | changes
        file = tmp_path / "changed.npz"
        np.savez(file, **{name: part for name, part in parts.items() if part is not None})
        BEARING.equilibrium(LOAD, SPEED, shell=InfluenceShell(file), **FILM)

    with xr.open_dataset(written) as data:
        matrix, axial = data.influence.to_numpy().copy(), data.axial.to_numpy()
    skew = matrix.copy()
    skew[0, 0, 1, 1] *= 3
    for words, changes in (
        ("has no axial", {"axial": None}),
        ("axial .* from -1.125 to 1.125", {"axial": 0.5 * axial}),
        ("reciprocal", {"influence": skew}),
        ("rising", {"angle": np.linspace(0, 7, len(matrix))}),
        (r"influence .*\(", {"influence": matrix[:4]}),
    ):
        with pytest.raises(InputError, match=words):
            ask(**changes)
    with pytest.raises(InputError, match="cannot be read"):
        BEARING.equilibrium(LOAD, SPEED, shell=InfluenceShell("nothing.nc"), **FILM)
