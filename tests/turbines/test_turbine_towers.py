"""Towers: shapes of their modes, printed or from mass and stiffness; a foot below the ground."""

import dataclasses
import importlib.resources

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions
from loadflow.rotor.frame import frame
from loadflow.rotor.rungs import finest_rung
from loadflow.turbines import from_windio, load_turbine, turbine_names
from loadflow.turbines.modes import clamped_shapes, tower_mode

X = np.linspace(0, 1, 101)[:, None] ** np.arange(2, 7)
# ElastoDyn tower file of the NREL 5 MW onshore, nodes of its summary file: height, mass, stiffness
NREL_NODES = (
    (2.190, 5501.260, 5.945e11),
    (41.610, 3994.245, 3.037e11),
    (85.410, 2599.390, 1.223e11),
)


@pytest.mark.parametrize("name", turbine_names())
def test_every_shipped_turbine_stands_on_a_tower_that_bends(name):
    turbine = load_turbine(name)
    assert finest_rung(turbine) == "tower"
    assert frame(turbine, RotorOptions()).carries.sum() == 2


def test_the_tower_of_the_nrel_5mw_is_that_of_openfast():
    tower = load_turbine("nrel-5mw").tower.bending
    for height, mass, stiffness in NREL_NODES:
        assert np.interp(height, tower.height, tower.mass_density) == pytest.approx(mass, abs=2e-3)
        for values in (tower.fore_aft_stiffness, tower.side_side_stiffness):
            assert np.interp(height, tower.height, values) == pytest.approx(stiffness, rel=2e-4)
    # over the 20 nodes that OpenFAST takes
    nodes = (np.arange(20) + 0.5) / 20 * 87.6
    mass = np.interp(nodes, tower.height, tower.mass_density).sum() * 4.38
    assert mass == pytest.approx(347460.232, rel=1e-6)


def test_the_mode_of_the_windpact_tower_is_the_printed_one():
    # program Modes 2.22: 72 025.781 kg on top; its shape counts gravity, ours is without
    tower = load_turbine("windpact-1.5mw").tower.bending
    shape = clamped_shapes(
        tower.height, tower.mass_density, tower.fore_aft_stiffness, end_mass=72025.781
    )[0]
    assert np.abs(X @ (shape - np.array(tower.fore_aft))).max() < 1e-3


def test_the_mode_of_the_iea_15mw_tower_on_its_own_foot_is_that_of_elastodyn():
    # ElastoDyn tower file of IEA-15-240-RWT v1.1, which has no outfitting in its mass
    printed = np.array([0.97468051, -0.37782219, 0.45482471, 0.37792179, -0.42960483])
    tower = load_turbine("iea-15mw").tower.bending
    above = tower.height >= 15.0
    shape = tower_mode(
        tower.height[above], tower.mass_density[above], tower.fore_aft_stiffness[above], 1.017e6
    )
    assert np.abs(X @ (np.array(shape) - printed)).max() < 0.01


def test_shapes_left_out_of_a_file_follow_from_mass_and_stiffness(tmp_path):
    text = (importlib.resources.files("loadflow.turbines") / "windpact-1.5mw.toml").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(("fore_aft", "side_side"))]
    path = tmp_path / "own.toml"
    path.write_text("\n".join(lines))
    ours, printed = (t.tower.bending for t in (load_turbine(path), load_turbine("windpact-1.5mw")))
    # the printed shape has the blades left off the top
    assert np.abs(X @ (np.array(ours.fore_aft) - printed.fore_aft)).max() < 0.005
    assert ours.side_side == ours.fore_aft


def test_a_tower_moved_up_sways_alike():
    turbine = load_turbine("windpact-1.5mw")
    tower, rotor = turbine.tower, turbine.rotor
    raised = dataclasses.replace(
        turbine,
        rotor=dataclasses.replace(rotor, hub_height=rotor.hub_height + 20),
        tower=dataclasses.replace(
            tower,
            height=tower.height + 20,
            bending=dataclasses.replace(tower.bending, height=tower.bending.height + 20),
        ),
    )
    for name in ("mass", "stiffness", "damping", "reach"):
        ours, there = (getattr(frame(t, RotorOptions()), name) for t in (raised, turbine))
        assert ours == pytest.approx(there, rel=1e-9), name


def test_a_tower_read_from_windio_is_the_shipped_one():
    pytest.importorskip("windIO")
    folder = importlib.resources.files("windIO") / "examples" / "turbine"
    path = folder / "IEA-15-240-RWT.yaml"
    shipped, read = load_turbine("iea-15mw"), from_windio(path, seabed=-30.0)
    for name in (field.name for field in dataclasses.fields(shipped.tower.bending)):
        ours, theirs = getattr(shipped.tower.bending, name), getattr(read.tower.bending, name)
        assert ours == pytest.approx(theirs, rel=2e-5), name
    for name in ("torsional_stiffness", "torsional_damping"):
        ours, theirs = getattr(shipped.drivetrain, name), getattr(read.drivetrain, name)
        assert ours == pytest.approx(theirs, rel=1e-5), name
    assert from_windio(path).tower.bending.height[0] == 15.0
    with pytest.raises(InputError, match=r"seabed = 20\.0 is not allowed"):
        from_windio(path, seabed=20.0)
    with pytest.raises(InputError, match="'monopile' is absent"):
        from_windio(folder / "IEA-22-280-RWT_Floater.yaml", seabed=-30.0)
