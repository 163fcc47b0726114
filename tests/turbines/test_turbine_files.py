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
        ("radius = 63.0", 'radius = "63"', "rotor.radius = '63': must be a valid number"),
        ("gear_ratio = 97.0", "gear_ratoi = 97.0", "drivetrain.gear_ratio: missing key"),
        ("cut_in = 3.0 ", "cut_in = 30.0 ", "cut_in, rated, cut_out"),
        ("tilt_deg = 5.0", "tilt_deg = 500.0", "rotor.tilt_deg = 500: must be less than 20.05"),
        ("tilt_deg = 5.0", "tilt = -5.0", "rotor.tilt = -5.0: must be greater than -0.35"),
        (
            "cone_deg = 2.5",
            "cone_deg = 2.5\ncone = 0.04",
            "rotor.cone and rotor.cone_deg: state one",
        ),
        (
            "rated_power = 5.0e6",
            "rated_power = 5.0",
            "must be 2.5e.05 … 2.5e.07 W for a rotor of 63 m",
        ),
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


def test_all_errors_of_a_file_are_told_at_once(tmp_path):
    text = SHIPPED.replace("radius = 63.0", "radius = -63.0")
    text = text.replace("gear_ratio = 97.0", "gear_ratoi = 97.0").replace("chord", "chord")
    text = text.replace("cut_out = 25.0", 'cut_out = "25"').replace(
        "tilt_deg = 5.0", "tilt_deg = true"
    )
    path = tmp_path / "own.toml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_turbine(path)
    lines = str(caught.value).splitlines()
    assert len(lines) == 5
    assert all(line.startswith(f"{path}: ") for line in lines)
    told = "\n".join(lines)
    for said in (
        "rotor.radius = -63.0: must be greater than 0",
        "rotor.tilt_deg = True: must be a valid number",
        "drivetrain.gear_ratio: missing key",
        "drivetrain.gear_ratoi: unknown key; did you mean gear_ratio?",
        "cut_out = '25': must be a valid number",
    ):
        assert said in told


def test_a_file_that_changes_is_read_again(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(SHIPPED)
    first = load_turbine(path)
    assert load_turbine(path) is first
    path.write_text(SHIPPED.replace("cut_out = 25.0", "cut_out = 26.00"))
    assert load_turbine(path).cut_out == 26.0


def test_polars_may_stand_in_the_file_itself(tmp_path):
    import tomllib

    import tomli_w

    document = tomllib.loads(SHIPPED)
    foil = load_turbine("nrel-5mw").airfoils["NACA64"]
    document["airfoils"]["NACA64"] = {
        "angle_deg": np.degrees(foil.angle).tolist(),
        "lift": foil.lift.tolist(),
        "drag": foil.drag.tolist(),
        "moment": (0 * foil.lift - 0.1).tolist(),
    }
    path = tmp_path / "own.toml"
    path.write_text(tomli_w.dumps(document))
    own = load_turbine(path).airfoils["NACA64"]
    assert own.angle == pytest.approx(foil.angle)
    assert own.lift == pytest.approx(foil.lift)
    assert set(own.moment) == {-0.1}
    document["airfoils"]["NACA64"].pop("drag")
    path.write_text(tomli_w.dumps(document))
    with pytest.raises(InputError, match=r"airfoils\.NACA64.* needs polars and column"):
        load_turbine(path)


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
    with pytest.raises(
        InputError, match=rf"own\.toml: {table}\.{key} = -.*greater than or equal to 0"
    ):
        load_turbine(path)
