"""Turbine files: the shipped figures agree with each other, bad files are named."""

import dataclasses
import importlib.resources
import re

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.turbines import load_turbine, turbine_names

SHIPPED = (importlib.resources.files("loadflow.turbines") / "nrel-5mw.toml").read_text()


@pytest.mark.parametrize("name", turbine_names())
def test_every_shipped_turbine_loads_and_names_its_source(name):
    turbine = load_turbine(name)
    assert turbine.source
    assert turbine.blade.radius.size == len(turbine.blade.airfoil)


def test_blade_of_the_nrel_5mw_has_the_published_centre_and_inertia():
    # NREL/TP-500-38060, table 2-2: centre 20.475 m, second moment 11.776e6 kg m² at 17 740 kg
    blade = load_turbine("nrel-5mw").blade
    x = np.linspace(0, 61.5, 4001)
    density = np.interp(x, blade.span, blade.mass_density)
    mass = np.trapezoid(density, x)
    assert np.trapezoid(density * x, x) / mass == pytest.approx(20.475, rel=0.005)
    assert np.trapezoid(density * x**2, x) / mass == pytest.approx(11.776e6 / 17740, rel=0.005)


def test_a_turbine_passes_through():
    turbine = load_turbine("nrel-5mw")
    assert load_turbine(turbine) is turbine


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("radius = 63.0", "radius = -63.0", "radius = -63.0"),
        ("radius = 63.0", 'radius = "63"', "rotor.radius: expected a finite number"),
        ("gear_ratio = 97.0", "gear_ratoi = 97.0", "missing key gear_ratio"),
        ("cut_in = 3.0 ", "cut_in = 30.0 ", "cut_in, rated, cut_out"),
        ('"DU40"]', '"DU41"]', "airfoil = 'DU41'"),
        ("DU40_A17", "DU40_A18", "no column 'DU40_A18_cl'"),
        ("flap1 = [0.0622,", "flap1 = [0.5,", "sum of coefficients"),
        ("[rotor]", "[rotor", "not a TOML file"),
    ],
)
def test_bad_files_name_what_is_wrong(tmp_path, old, new, message):
    assert old in SHIPPED
    path = tmp_path / "own.toml"
    path.write_text(SHIPPED.replace(old, new))
    with pytest.raises(InputError, match=r".*" + message.replace("(", r"\(")):
        load_turbine(path)


@pytest.mark.parametrize("name", ["nrel-6mw", "nowhere.toml"])
def test_unknown_turbines_are_refused(name):
    with pytest.raises(InputError, match=name):
        load_turbine(name)


def test_a_turbine_cannot_be_changed_into_nonsense():
    turbine = load_turbine("nrel-5mw")
    with pytest.raises(InputError, match="hub_height"):
        dataclasses.replace(turbine.rotor, hub_height=50.0)


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ("rotor", "hub_mass"),
        ("rotor", "hub_inertia"),
        ("drivetrain", "generator_inertia"),
        ("control", "proportional_gain"),
    ],
)
def test_a_number_that_cannot_be_negative_is_named_with_file_table_and_key(tmp_path, table, key):
    path = tmp_path / "own.toml"
    path.write_text(re.sub(rf"(?m)^{key} = ", f"{key} = -", SHIPPED))
    with pytest.raises(InputError, match=rf"own\.toml: \[{table}\] .*{key} = -.* >= 0"):
        load_turbine(path)
