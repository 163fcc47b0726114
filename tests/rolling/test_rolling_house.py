"""A kind of rolling bearing says what it is; everything else it inherits."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from toy_bearing import HalfFilled

from loadflow.errors import InputError, SolverError
from loadflow.rolling import (
    KINDS,
    FlexibleRings,
    RollerBearing,
    RollerRaceways,
    RollingEquilibrium,
    SphericalRollerBearing,
    main_bearings,
)

ROLLERS = {"rollers": 30, "roller_diameter": 0.05, "roller_length": 0.07, "pitch_diameter": 0.9}


def test_a_toy_kind_has_every_verb():
    toy = HalfFilled(**ROLLERS)
    result = toy.equilibrium(force=(1e5, 0, 0))
    assert isinstance(result, RollingEquilibrium)
    assert result.element_forces.shape == (1, 15)
    full = RollerBearing(**ROLLERS).equilibrium(force=(1e5, 0, 0))
    assert result.maximum_force > 1.8 * full.maximum_force
    path = toy.orbit([0.0, 1.0, 2.0], [(1e5, 0, 0), (2e5, 0, 0), (0, 1e5, 0)], speed=1.2)
    assert path["element_forces"].dims == ("time", "row", "element")
    assert result.life() == result.rating_life


ONE_ROW = """
import sys
from toy_bearing import HalfFilled
from loadflow.rolling.bearings.kinds import KINDS
KINDS[HalfFilled.kind] = HalfFilled
from loadflow.cli import main
main(["rolling", "--scene", sys.argv[1], "--force-x", "1e5", "--json"])
"""
"""In a process of its own: scenes read the rows when they are imported."""


def test_a_toy_kind_is_reached_by_its_row(tmp_path):
    """One class and one row: the kind is read from a scene and solved by the command line."""
    scene = tmp_path / "toy.toml"
    numbers = "\n".join(f"{name} = {value}" for name, value in ROLLERS.items())
    scene.write_text(f'[bearings.N]\nkind = "half-filled"\n[bearings.N.geometry]\n{numbers}\n')
    run = subprocess.run(
        [sys.executable, "-c", ONE_ROW, str(scene)],
        cwd=Path(__file__).parents[1], capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    direct = HalfFilled(**ROLLERS).equilibrium(force=(1e5, 0, 0))
    assert json.loads(run.stdout)["maximum_force"]["value"] == float(direct.maximum_force)


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_every_kind_answers_in_one_form(kind):
    known = {b.kind: b for name in ("two-spherical", "cylindrical-tapered", "moment")
             for b in main_bearings(name).values()}  # fmt: skip
    bearing = known.get(kind) or _small(kind)
    force = [(1e5, 2e4, 0.0), (3e5, 0.0, 0.0)]
    result = bearing.equilibrium(force)
    assert result.element_forces.shape == (2, *bearing.groups, result.element_forces.shape[-1])
    data = result.to_dataset()
    assert set(data["element_forces"].dims) == {"case", *bearing.group_dims, "element"}
    for name, values in data.data_vars.items():
        assert {"units", "long_name"} <= set(values.attrs), name
    assert type(bearing).__name__ in repr(result)
    assert "maximum" in repr(result) or "largest" in repr(result)


def _small(kind):
    balls = {"ball_diameter": 0.04, "groove_radius": 0.0208, "pitch_diameter": 0.6}
    rows = {"rollers": 40, "roller_diameter": 0.04, "roller_length": 0.038, "pitch_diameter": 0.9}
    made = {
        "ball": lambda: KINDS["ball"](balls=30, **balls),
        "crossed": lambda: KINDS["crossed"](**rows),
        "toroidal": lambda: KINDS["toroidal"](raceway_radius=1.2, **rows),
        "three-row": lambda: KINDS["three-row"](
            **{name: RollerRaceways(**rows) for name in ("support", "retaining", "radial")}
        ),
    }
    return made[kind]()


def test_what_a_kind_does_not_know_is_refused_by_name():
    spherical = SphericalRollerBearing(**ROLLERS, contact_angle=0.2)
    with pytest.raises(InputError, match="takes none"):
        spherical.equilibrium((1e5, 0, 0), (1.0, 0))
    with pytest.raises(InputError, match="rigid rings only"):
        _small("crossed").equilibrium((1e5, 0, 1e5), rings=FlexibleRings())
    with pytest.raises(InputError, match="inertia"):
        spherical.equilibrium((1e5, 0, 0), speed=10.0)
    with pytest.raises(InputError, match="none; see friction"):
        spherical.equilibrium((1e5, 0, 0)).friction_torque()
    crossed = _small("crossed").equilibrium((1e5, 0, 1e5))
    with pytest.raises(SolverError, match="no model of friction"):
        crossed.friction(1.0, None)
    with pytest.raises(AttributeError, match="rolls on rollers"):
        _ = crossed.ball_forces


def test_an_orbit_is_the_equilibrium_of_each_time():
    bearing = RollerBearing(**ROLLERS, contact_angle=0.3, rows=2, row_spacing=0.2)
    force = np.array([(1e5, 0, 1e4), (2e5, 1e4, 2e4), (1e5, 5e4, 0)])
    path = bearing.orbit([0.0, 0.1, 0.2], force)
    rest = bearing.equilibrium(force)
    np.testing.assert_array_equal(path["displacement"], rest.displacement)
    with pytest.raises(InputError, match="increase"):
        bearing.orbit([0.0, 0.0, 0.1], force)
