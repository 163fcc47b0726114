"""Turbines and suspensions of another size follow the laws of similarity."""

from dataclasses import fields

import numpy as np
import pytest

import loadflow.turbines as room
from loadflow.errors import InputError
from loadflow.scene.scene import make_scene, read_scene
from loadflow.scene.unused import scaling_note, unused_warnings
from loadflow.shaft import (
    Beam,
    BearingSupport,
    ShaftSection,
    TwoPoint,
    bearing_loads,
    scaled_suspension,
)
from loadflow.turbines import load_turbine, scaled
from loadflow.turbines.similarity import EXPONENTS

OF_TEXT = {"name", "source", "airfoils", "frequencies", "airfoil", "modes", "bending", "assumed"}


@pytest.mark.parametrize("name", sorted(EXPONENTS))
def test_each_number_of_a_turbine_has_its_law(name):
    parts = {"rotor", "tower", "drivetrain", "control", "blade", "supervision"}
    known = {field.name for field in fields(getattr(room, name))}
    assert known - OF_TEXT - parts == set(EXPONENTS[name])


def test_there_and_back_is_the_same_turbine():
    known = load_turbine("iea-15mw")
    again = scaled(scaled(known, 1.7), 1 / 1.7)
    for part, powers in EXPONENTS.items():
        if part in ("Turbine", "TowerBending"):
            continue
        here = next(p for p in vars(known) if type(getattr(known, p)).__name__ == part)
        for name in powers:
            one, other = (getattr(getattr(t, here), name) for t in (known, again))
            if one is None:
                assert other is None
                continue
            np.testing.assert_allclose(other, one, rtol=1e-12)


def test_a_tower_bends_slower_as_it_grows():
    known = load_turbine("nrel-5mw")
    larger = scaled(known, 2.0)
    assert known.tower.bending is not None
    assert larger.tower.bending is not None
    ratio = larger.tower.bending.fore_aft_stiffness / known.tower.bending.fore_aft_stiffness
    mass = larger.tower.bending.mass_density / known.tower.bending.mass_density
    np.testing.assert_allclose(np.sqrt(ratio / mass / 2.0**4), 0.5)
    assert larger.frequencies == {k: v / 2 for k, v in known.frequencies.items()}


@pytest.mark.parametrize("name", ["nrel-5mw@", "nrel-5mw@zero", "nrel-5mw@-1", "@5e6", "none@5e6"])
def test_a_size_that_is_none_is_refused(name):
    with pytest.raises(InputError):
        load_turbine(name)


@pytest.mark.parametrize("power", ["7", "8", "5000", "1e9"])
def test_a_power_that_no_wind_turbine_has_is_refused_with_those_that_are_scaled(power):
    with pytest.raises(InputError, match=r" W, must be 5e\+04 … 5e\+07 W, such as nrel"):
        load_turbine(f"nrel-5mw@{power}")
    with pytest.raises(InputError, match="must be 5e"):
        make_scene({"name": "megawatts", "turbine": {"name": f"nrel-5mw@{power}"}})


@pytest.mark.parametrize("factor", [0.0, -1.0, np.nan, np.inf])
def test_a_factor_that_is_none_is_refused(factor):
    for work in (lambda: scaled(load_turbine("nrel-5mw"), factor),
                 lambda: scaled_suspension(TwoPoint(), factor)):  # fmt: skip
        with pytest.raises(InputError, match="factor"):
            work()


def test_loads_of_a_larger_suspension_grow_with_forces_and_masses():
    supports = (BearingSupport(radial=2e9, housing_vertical=5e9),
             BearingSupport(takes_moment=True, radial=3e9, tilt=4e8))  # fmt: skip
    beam = Beam((ShaftSection(1.0, 0.4, 3.0), ShaftSection(0.9, 0.3)), supports)
    known = TwoPoint(gearbox_mass=0.0, beam=beam)
    force, moment = np.array([5e5, 1e5, -1e6]), np.array([4e6, 1e6, 3e5])
    one = bearing_loads(known, force, moment)
    # stiffness grows like E L: forces with φ² and moments with φ³ move the shaft by φ, tilt it by 1
    other = bearing_loads(scaled_suspension(known, 2.0), 4 * force, 8 * moment)
    np.testing.assert_allclose(other["force"], 4 * one["force"], rtol=1e-9, atol=1e-3)
    np.testing.assert_allclose(other["tilt"], one["tilt"], rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("name", ["nrel-5mw@20e6", "nrel-5mw@5.5e6"])
def test_a_scene_file_names_a_turbine_of_another_power_with_or_without_a_point(tmp_path, name):
    file = tmp_path / "large.toml"
    file.write_text(f'turbine = {{ name = "{name}" }}', encoding="utf-8")
    assert read_scene(file).turbine.name == name


def test_a_scene_scales_the_suspension_it_does_not_state_and_warns(tmp_path):
    scene = make_scene({"name": "large", "turbine": {"name": "nrel-5mw@20e6"}})
    usual = make_scene({"name": "usual"})
    assert scene.shaft.two_point is not None
    assert usual.shaft.two_point is not None
    assert scene.shaft.two_point.span == pytest.approx(2 * usual.shaft.two_point.span)
    assert scene.shaft.two_point.gearbox_mass == pytest.approx(8 * 60e3)
    stated = make_scene(
        {"name": "own", "turbine": {"name": "nrel-5mw@20e6"}, "shaft": {"two_point": {}}}
    )
    # what it leaves out of a suspension is as large as the turbine, too
    assert stated.shaft.two_point.span == pytest.approx(scene.shaft.two_point.span)
    assert stated.shaft.two_point.gearbox_mass == pytest.approx(8 * 60e3)
    assert "similarity" in scaling_note(scene)[0]
    assert "similarity" in unused_warnings(scene)[0]
    assert scaling_note(usual) == ()
    files = scene.model_copy(
        update={"loads": scene.loads.model_copy(update={"source": "files", "files": ["a.outb"]})}
    )
    assert "series of the files are taken as they are" in scaling_note(files)[0]
    file = tmp_path / "large.toml"
    file.write_text(scene.to_toml(), encoding="utf-8")
    assert read_scene(file).digest() == scene.digest()
