"""Turbines from windIO, blended airfoils, computed modes, and the turbines made from them."""

import copy
import importlib.resources
import json

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import steady_state
from loadflow.turbines import from_windio, load_turbine
from loadflow.turbines.airfoils import blended
from loadflow.turbines.modes import bending_modes


@pytest.fixture(scope="module")
def example():
    pytest.importorskip("windIO")
    return importlib.resources.files("windIO") / "examples" / "turbine" / "IEA-15-240-RWT.yaml"


@pytest.fixture(scope="module")
def read(example):
    return from_windio(example)


def test_the_shipped_iea_15mw_is_what_windio_says(read):
    shipped = load_turbine("iea-15mw")
    for part, names in {
        "rotor": ("radius", "hub_radius", "overhang", "tilt", "cone", "hub_mass", "hub_inertia"),
        "tower": ("base_diameter", "top_diameter", "height"),
        "drivetrain": ("gear_ratio", "generator_inertia"),
        "control": (
            "reference_speed",
            "speed_filter",
            "proportional_gain",
            "gain_halving_pitch",
            "constant_power",
        ),
        "blade": ("mass", "radius", "twist", "chord", "prebend", "mass_density", "flap_stiffness"),
    }.items():
        for name in names:
            ours = getattr(getattr(shipped, part), name)
            theirs = getattr(getattr(read, part), name)
            assert ours == pytest.approx(theirs, rel=2e-3, abs=5e-4), (part, name)
    for here, there in zip(shipped.blade.airfoil, read.blade.airfoil):
        angle = np.radians(np.linspace(-10, 18, 57))
        a, b = shipped.airfoils[here], read.airfoils[there]
        for name in ("lift", "drag"):
            difference = np.interp(angle, a.angle, getattr(a, name)) - np.interp(
                angle, b.angle, getattr(b, name)
            )
            assert np.abs(difference).max() < 0.02  # resampled to whole degrees
    assert read.frequencies == {}


@pytest.fixture
def document(example):
    yaml = pytest.importorskip("yaml")
    return yaml.load(example.read_text(), getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def written(document, path):
    path.write_text(json.dumps(document))  # JSON is YAML
    return path


@pytest.mark.parametrize("by_tip", [False, True])
@pytest.mark.parametrize("first", [1e6, 4e7])
def test_polars_of_the_nearest_reynolds_number_are_read(document, read, tmp_path, first, by_tip):
    """0.75 × 120.7 m × 0.79 rad/s × 3.3 m / 1.46e-5 m²/s is 1.6e7; polars of 1e7 are nearest."""
    if by_tip:
        del document["control"]["rated_rotor_speed"]
        document["control"]["supervisory"] = {"maxTS": 95.4}  # m/s
    foil = next(foil for foil in document["airfoils"] if foil["name"] == "FFA-W3-211")
    (right,) = foil["polars"][0]["re_sets"]
    wrong = copy.deepcopy(right)
    wrong["re"], wrong["cl"]["values"] = first, [0.5 * x for x in right["cl"]["values"]]
    foil["polars"][0]["re_sets"] = [wrong, right]
    found = from_windio(written(document, tmp_path / "two.yaml"))
    np.testing.assert_allclose(found.airfoils["FFA-W3-211"].lift, read.airfoils["FFA-W3-211"].lift)
    (said,) = [text for text in found.assumed if text.startswith("airfoils")]
    assert "FFA-W3-211: polar of Re = 1e+07, of " in said
    thin = read.airfoils["FFA-W3-211"]
    own = {"angle": list(thin.angle), "lift": list(thin.lift), "drag": list(thin.drag)}
    beside = {"airfoils": {"FFA-W3-211": own | {"thickness": thin.thickness}}}
    stated = from_windio(tmp_path / "two.yaml", beside=beside)
    assert not any(text.startswith("airfoils") for text in stated.assumed)


def test_numbers_of_yaml_1_2_are_numbers(document, read, tmp_path):
    table = document["airfoils"][0]["polars"][0]["re_sets"][0]["cd"]
    table["values"] = [1e-05, *table["values"][1:]]
    path = written(document, tmp_path / "numbers.yaml")
    assert "1e-05" in path.read_text()
    assert from_windio(path).airfoils["circular"].drag[0] == 1e-5


def halved(foil, name, thickness):
    """An airfoil of half the lift, with a name and a thickness of its own."""
    other = copy.deepcopy(foil) | {"name": name, "rthick": thickness}
    table = other["polars"][0]["re_sets"][0]["cl"]
    table["values"] = [0.5 * x for x in table["values"]]
    return other


def lift_of_sections(turbine):
    angle = np.radians(np.linspace(-10, 18, 29))
    foils = [turbine.airfoils[name] for name in turbine.blade.airfoil]
    return np.array([np.interp(angle, foil.angle, foil.lift) for foil in foils])


def test_airfoils_that_the_blade_does_not_call_take_no_part_in_it(document, read, tmp_path):
    foils = document["airfoils"]
    thin = next(foil for foil in foils if foil["name"] == "FFA-W3-211")
    document["airfoils"] = [halved(thin, "twin", 0.211), *foils, halved(thin, "between", 0.225)]
    sets = document["airfoils"][-1]["polars"][0]["re_sets"]
    sets.append(copy.deepcopy(sets[0]) | {"re": 4e7})
    found = from_windio(written(document, tmp_path / "database.yaml"))
    np.testing.assert_array_equal(lift_of_sections(found), lift_of_sections(read))
    assert found.airfoils["between"].thickness is None
    assert not any(text.startswith("airfoils") for text in found.assumed)


def test_of_two_airfoils_of_one_thickness_that_nearer_to_the_root_stands(document, read, tmp_path):
    foils, places = document["airfoils"], document["components"]["blade"]["outer_shape"]["airfoils"]
    thin = next(foil for foil in foils if foil["name"] == "FFA-W3-211")
    document["airfoils"] = [halved(thin, "tip", 0.211), *foils]
    places[-1]["name"] = "tip"
    found = from_windio(written(document, tmp_path / "twins.yaml"))
    np.testing.assert_array_equal(lift_of_sections(found), lift_of_sections(read))
    assert "airfoils.tip: FFA-W3-211, of the same thickness, stands for both" in found.assumed


def test_configurations_of_an_airfoil_are_mixed_by_their_weights(document, read, tmp_path):
    shape = document["components"]["blade"]["outer_shape"]
    for foil in document["airfoils"]:
        rough = copy.deepcopy(foil["polars"][0]) | {"configuration": "rough"}
        rough["re_sets"][0]["cl"]["values"] = [0.5 * x for x in rough["re_sets"][0]["cl"]["values"]]
        foil["polars"].insert(0, rough)
    for place in shape["airfoils"]:
        place |= {"configuration": ["default", "rough"], "weight": [0.6, 0.4]}
    found = from_windio(written(document, tmp_path / "mixed.yaml"))
    np.testing.assert_allclose(lift_of_sections(found), 0.8 * lift_of_sections(read), atol=1e-12)
    assert not any(text.startswith("airfoils") for text in found.assumed)
    for change, says in (
        ({"weight": [0.6, 0.5]}, "weight = .* must add up to 1"),
        ({"weight": [1.2, -0.2]}, "none may be negative"),
        ({"configuration": ["default", "smooth"]}, "no configuration 'smooth'"),
        ({"name": "FFA-W3-212"}, "no airfoil 'FFA-W3-212'"),
    ):
        kept = dict(shape["airfoils"][2])
        shape["airfoils"][2] |= change
        with pytest.raises(InputError, match=says):
            from_windio(written(document, tmp_path / "wrong.yaml"))
        shape["airfoils"][2] = kept


def test_mass_between_the_stations_of_the_stiffness_is_not_lost(document, read, tmp_path):
    elastic = document["components"]["blade"]["structure"]["elastic_properties"]
    stiff = elastic["stiffness_matrix"]
    for key, values in stiff.items():
        if key == "grid" or key.startswith("K"):
            stiff[key] = [*values[:-1:8], values[-1]]
    found = from_windio(written(document, tmp_path / "coarse.yaml"))
    assert found.blade.mass == pytest.approx(read.blade.mass, rel=1e-12)


def test_a_largest_torque_of_the_generator_is_that_of_the_rotor_over_the_gear(
    document, read, tmp_path
):
    """Geared files give it on either side; mistaken, power is a 50th of what is rated."""
    beside = {"drivetrain": {"gear_ratio": 50.0, "efficiency": 0.95}}
    document["components"]["drivetrain"]["gearbox"]["gear_ratio"] = 50.0
    largest = 1.2 * 15e6 / read.rated_speed
    for given in (largest, largest / 50):
        document["control"]["max_gen_torque"] = given
        found = from_windio(written(document, tmp_path / "geared.yaml"), beside=beside)
        assert found.control.maximum_torque == pytest.approx(largest / 50)


def test_a_downwind_rotor_is_refused(document, tmp_path):
    document["assembly"]["rotor_orientation"] = "Downwind"
    with pytest.raises(InputError, match="rotor_orientation = 'Downwind' is not allowed"):
        from_windio(written(document, tmp_path / "down.yaml"))


def test_the_lowest_pitch_of_a_windio_file_is_that_of_the_shipped_turbine(read):
    ours, theirs = load_turbine("iea-15mw").control, read.control
    # plateaus and what lies above rated wind are left out
    assert theirs.scheduled_wind[0] == 4.3086
    assert theirs.scheduled_pitch[-2:] == pytest.approx((np.radians(0.1719), 0.0), abs=1e-5)
    wind = np.linspace(3.0, 10.0, 71)
    pitches = [np.interp(wind, c.scheduled_wind, c.scheduled_pitch) for c in (ours, theirs)]
    assert np.abs(pitches[0] - pitches[1]).max() < np.radians(0.05)
    points = [
        steady_state(t, wind_speed=5.0, shear=0.0, rung="tables")["pitch"].item()
        for t in (load_turbine("iea-15mw"), read)
    ]
    assert points[0] == pytest.approx(points[1], abs=np.radians(0.05))


def test_another_turbine_of_windio_follows_its_table_below_rated_wind_and_holds_power_above(
    example,
):
    turbine = from_windio(example.parent / "IEA-22-280-RWT.yaml")
    point = steady_state(turbine, wind_speed=[8.0, 20.0], shear=0.0, rung="tables")
    table = turbine.control.scheduled_wind, turbine.control.scheduled_pitch
    # its fine pitch is −4°; the wind is recognised by the power of rigid blades
    assert float(point["pitch"][0]) == pytest.approx(np.interp(8.0, *table), abs=np.radians(0.05))
    # the rated power of the format is electrical, that of its published rotor 23.12 MW
    assert turbine.rated_power == 22e6
    assert float(point["power"][1]) == pytest.approx(23.12e6, rel=5e-3)
    assert float(point["speed"][1]) == pytest.approx(turbine.control.reference_speed, rel=1e-3)


def test_a_windio_file_without_a_lowest_pitch_has_no_schedule(example, tmp_path):
    text = example.read_text()
    path = tmp_path / "own.yaml"
    path.write_text(text.replace("min_pitch_table:", "some_other_table:"))
    control = from_windio(path).control
    assert control.scheduled_wind == control.scheduled_pitch == ()


@pytest.mark.parametrize("sections", [10, 40])
def test_mass_and_length_do_not_depend_on_the_number_of_sections(example, read, sections):
    other = from_windio(example, sections=sections)
    assert other.blade.radius.size == sections
    assert other.blade.mass == read.blade.mass == pytest.approx(66.9e3, rel=1e-3)


def test_computed_modes_of_the_nrel_5mw_are_the_published_ones():
    blade = load_turbine("nrel-5mw").blade
    found = bending_modes(
        blade.span, blade.mass_density, blade.flap_stiffness, blade.edge_stiffness
    )
    x = np.linspace(0, 1, 101)[:, None] ** np.arange(2, 7)
    for ours, published in zip(found, blade.modes):
        assert ours.name == published.name
        # the published shapes are fits to shapes of a rotating, twisted blade
        assert np.abs(x @ ours.coefficients - x @ published.coefficients).max() < 0.02


def test_modes_of_a_uniform_beam_are_those_of_the_text_book():
    span, one = np.linspace(0, 30.0, 50), np.ones(50)
    flap, _, edge = bending_modes(span, 200 * one, 1e8 * one, 4e8 * one)
    assert flap.coefficients == pytest.approx(edge.coefficients)
    x = np.array([0.25, 0.5, 0.75])
    k, ratio = 1.8751041, 0.7340955
    exact = np.cosh(k * x) - np.cos(k * x) - ratio * (np.sinh(k * x) - np.sin(k * x))
    assert x[:, None] ** np.arange(2, 7) @ flap.coefficients == pytest.approx(exact / 2, abs=1e-3)


def test_a_blend_lies_between_its_neighbours_and_ends_on_them():
    foils = load_turbine("iea-15mw").airfoils
    thin, thick = foils["FFA-W3-241"], foils["FFA-W3-270"]
    assert blended(foils, 0.241).lift == pytest.approx(
        np.interp(blended(foils, 0.241).angle, thin.angle, thin.lift)
    )
    half = blended(foils, 0.5 * (0.241 + 0.27))
    assert half.lift == pytest.approx(0.5 * (thin.lift + thick.lift))
    with pytest.raises(InputError, match=r"thickness = 0\.1 is not allowed"):
        blended(foils, 0.1)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: "{", "not a YAML file"),
        (lambda text: "a: 1", "windIO_version = None"),
        (lambda text: text.replace("windIO_version: '2.0'", "windIO_version: '1.0'"), "'1.0'"),
        (lambda text: "windIO_version: '2.0'\n", r"rated_power: missing key \(in windIO: assembly"),
        (
            lambda text: (
                "windIO_version: '2.0'\ncomponents: {tower: {reference_axis: {z: {values: 3}}}}\n"
            ),
            "not of the form",
        ),
        (lambda text: "- 1\n- 2\n", "no table of keys"),
    ],
)
def test_bad_windio_files_are_named(tmp_path, example, change, message):
    path = tmp_path / "own.yaml"
    head = example.read_text()[:400].replace('"', "'").splitlines()[0] + "\n"
    path.write_text(change(head))
    with pytest.raises(InputError, match=message):
        from_windio(path)


def test_a_windio_file_that_does_not_exist_is_refused():
    with pytest.raises(InputError, match=r"nowhere\.yaml does not exist"):
        from_windio("nowhere.yaml")


def test_all_that_a_file_lacks_is_told_at_once_with_its_places(tmp_path, example):
    text = example.read_text().replace("\n    hub:", "\n    hob:")
    text = text.replace("min_rotor_speed:", "some_speed:").replace(
        "max_gen_torque:", "some_torque:"
    )
    path = tmp_path / "own.yaml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_turbine(path)
    lines = str(caught.value).splitlines()
    told = [line for line in lines if "missing key" in line]
    assert len(told) >= 4
    hub = next(line for line in told if "rotor.hub_mass" in line)
    assert "components.hub.elastic_properties.mass" in hub
    assert any("control.rated_mechanical_power" in line for line in told)
    assert 'a file of TOML that begins with windio = "own.yaml"' in lines[-1]


def test_what_a_windio_file_lacks_is_given_beside_it(tmp_path, example):
    text = example.read_text().replace("max_gen_torque:", "some_torque:")
    (tmp_path / "own.yaml").write_text(text)
    beside = tmp_path / "own.toml"
    beside.write_text(
        'windio = "own.yaml"\nname = "mine"\n[drivetrain]\nefficiency = 0.96\n'
        "[supervision]\noverspeed = 1.3\n[rotor]\ntilt_deg = 5.0\n"
        "[windio_options]\nsections = 12\n"
    )
    turbine = load_turbine(beside)
    assert turbine.name == "mine"
    assert turbine.control.rated_mechanical_power == pytest.approx(15e6 / 0.96)
    assert turbine.supervision.overspeed == 1.3
    assert turbine.rotor.tilt == pytest.approx(np.radians(5.0))
    assert turbine.blade.radius.size == 12
    assert not any("overspeed" in said for said in turbine.assumed)
    assert any("brake_torque" in said for said in turbine.assumed)
    beside.write_text('windio = "own.yaml"\n[windio_options]\nsection = 12\n')
    with pytest.raises(InputError, match="did you mean sections"):
        load_turbine(beside)


def test_anchors_of_one_name_and_the_form_of_wisdem_are_read(tmp_path, example, read):
    path = tmp_path / "old.yaml"
    path.write_text(wisdem(example))
    turbine = load_turbine(path)
    assert turbine.blade.mass == pytest.approx(read.blade.mass, rel=1e-6)
    assert turbine.blade.chord == pytest.approx(read.blade.chord, rel=1e-6)
    assert turbine.blade.twist == pytest.approx(read.blade.twist, rel=1e-6)
    assert turbine.blade.torsion_stiffness == pytest.approx(read.blade.torsion_stiffness)
    assert turbine.rotor.cone == pytest.approx(read.rotor.cone)
    assert turbine.control.pitch_frequency == 0.2
    assert turbine.control.thrust_limit == 0.85
    assert turbine.control.rated_mechanical_power == pytest.approx(15e6 / 0.95)
    foil = next(iter(turbine.airfoils.values()))
    assert foil.angle[-1] == np.pi


def wisdem(example):
    """The turbine of version 2 in the form of WISDEM before it, with an anchor used twice."""
    import yaml

    new = yaml.load(example.read_text(), yaml.CSafeLoader)
    parts, degree = new["components"], np.pi / 180
    blade, hub = parts["blade"], parts["hub"]
    shape, axis = dict(blade["outer_shape"]), blade["reference_axis"]
    twist = shape["twist"]
    shape["twist"] = twist | {"values": [degree * x for x in twist["values"]]}
    elastic = blade["structure"]["elastic_properties"]
    stiff = elastic["stiffness_matrix"]
    order = [f"K{i}{j}" for i in range(1, 7) for j in range(i, 7)]
    inertia = elastic["inertia_matrix"]
    six = {
        "reference_axis": axis,
        "stiff_matrix": {
            "grid": stiff["grid"],
            "values": np.array([stiff[key] for key in order]).T.tolist(),
        },
        "inertia_matrix": {"grid": inertia["grid"], "values": [[x] for x in inertia["mass"]]},
    }
    foils = []
    for foil in new["airfoils"]:
        sets = foil["polars"][0]["re_sets"][0]
        polar = {
            old: {
                "grid": [degree * x for x in sets[name]["grid"]],
                "values": sets[name]["values"],
            }
            for old, name in (("c_l", "cl"), ("c_d", "cd"), ("c_m", "cm"))
        }
        foils.append(
            {"name": foil["name"], "relative_thickness": foil["rthick"], "polars": [polar]}
        )
    control, train = new["control"], parts["drivetrain"]
    per_minute = np.pi / 30
    old = {
        "name": new["name"],
        "assembly": new["assembly"],
        "airfoils": foils,
        "components": {
            "blade": {
                "outer_shape_bem": shape | {"reference_axis": axis},
                "elastic_properties_mb": {"six_x_six": six},
            },
            "hub": {
                "diameter": hub["diameter"],
                "cone_angle": degree * hub["cone_angle"],
                "elastic_properties_mb": {
                    "system_mass": hub["elastic_properties"]["mass"],
                    "system_inertia": hub["elastic_properties"]["inertia"],
                },
            },
            "nacelle": {
                "drivetrain": {
                    "uptilt": degree * train["outer_shape"]["uptilt"],
                    "overhang": train["outer_shape"]["overhang"],
                    "gear_ratio": 1.0,
                    "gearbox_efficiency": 1.0,
                    "generator_rpm_efficiency_user": {"grid": [0.0, 1.0], "values": [0.9, 0.95]},
                },
                "generator": {"elastic_properties_mb": {"system_inertia": [1.8e6]}},
            },
            "tower": {
                "outer_shape_bem": {
                    "reference_axis": parts["tower"]["reference_axis"],
                    "outer_diameter": parts["tower"]["outer_shape"]["outer_diameter"],
                }
            },
        },
        "control": {
            "supervisory": {"Vin": 3.0, "Vout": 25.0},
            "pitch": {
                "PC_zeta": 1.0,
                "PC_omega": 0.2,
                "ps_percent": 0.85,
                "max_pitch_rate": 0.035,
                "min_pitch": 0.0,
            },
            "torque": {"tsr": control["optimal_tsr"], "max_torque_rate": 4.5e6},
        },
    }
    old["control"]["supervisory"]["maxOmega"] = per_minute * control["rated_rotor_speed"]
    old["control"]["supervisory"]["minOmega"] = per_minute * control["min_rotor_speed"]
    text = yaml.safe_dump(old)
    return text + "costs: &twice 1\nbos: &twice 2\n"
