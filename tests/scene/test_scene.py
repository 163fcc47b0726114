"""A scene is valid or is refused with file, key, value and what is allowed."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.scene.scene import make_scene, read_scene


def refused(text, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as info:
        read_scene(path)
    assert "bad.toml" in str(info.value)
    return str(info.value)


def test_an_unknown_key_is_named_with_the_known_ones(tmp_path):
    message = refused("[loads]\nwindspeeds = [4]\n", tmp_path)
    assert "loads.windspeeds: unknown key" in message
    assert "wind_speeds" in message


def test_an_unknown_key_of_a_room_is_named_too(tmp_path):
    message = refused(
        "[journal.geometry]\ndiameter=3\nwidth=2\nrelative_clearance=1e-3\nx=1\n", tmp_path
    )
    assert "journal.geometry.x: unknown key" in message
    assert "relative_clearance" in message


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("[shaft.two_point.beam]\nsectio = 1\n", "did you mean sections?"),
        ("[journal]\ndiametre = 2.0\n", "did you mean geometry.diameter?"),
        ('results = ["jornal.film"]\n', "did you mean journal.film?"),
        ('turbine = "nrel-5"\n', "a table, [turbine], with keys of name, file"),
    ],
)
def test_what_may_be_meant_is_told_of_tables_left_out_of_keys_below_and_of_words(
    text, meant, tmp_path
):
    assert meant in refused(text, tmp_path)


def test_a_negative_viscosity_is_named_with_its_range(tmp_path):
    message = refused("[journal.lubricant]\nviscosity = -0.05\n", tmp_path)
    assert "journal.lubricant.viscosity = -0.05" in message
    assert "greater than 0" in message


def test_a_name_that_no_folder_has_is_told_what_may_stand_in_it():
    with pytest.raises(InputError, match=r"name = .own 4\.2 MW.: letters from a to z, digits"):
        make_scene({"name": "own 4.2 MW"})


def test_a_value_of_the_wrong_kind_is_named(tmp_path):
    message = refused('[loads]\nduration = "ten minutes"\n', tmp_path)
    assert "loads.duration = 'ten minutes'" in message


def test_an_unknown_result_lists_the_known_ones(tmp_path):
    message = refused('results = ["journal.magic"]\n', tmp_path)
    assert "journal.magic" in message
    assert "journal.film" in message


def test_a_bearing_that_the_shaft_does_not_have_is_named(tmp_path):
    message = refused("[shaft.two_point]\n[journal]\nbearings = ['N3']\n", tmp_path)
    assert "N3" in message
    assert "N, N2" in message


def test_a_bearing_that_no_result_needs_may_be_absent():
    scene = make_scene({"results": ["journal.film"], "shaft": {"two_point": {}}})
    assert scene.shaft.bearings == ("N", "N2")


def test_a_file_that_is_no_toml_is_said_to_be_none(tmp_path):
    assert "not a TOML file" in refused("[loads\n", tmp_path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"absent\.toml"):
        read_scene(tmp_path / "absent.toml")


def test_the_resolved_scene_reads_back_as_itself(tmp_path):
    scene = make_scene({"name": "a", "loads": {"wind_speeds": [5, 7.5]}})
    path = tmp_path / "scene.toml"
    path.write_text(scene.to_toml(), encoding="utf-8")
    assert read_scene(path) == scene
    assert read_scene(path).digest() == scene.digest()


def test_files_are_meant_relative_to_the_scene(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text('[loads]\nsource = "files"\nfiles = ["a.outb"]\n', encoding="utf-8")
    assert read_scene(path).loads.files == [str(tmp_path / "a.outb")]


def test_a_scene_cannot_be_changed():
    with pytest.raises(ValueError, match="frozen"):
        make_scene({}).name = "other"


def test_a_bearing_without_a_rating_is_refused_before_its_loads_are_simulated():
    """45° are 0.785 rad; 40° are outside the table of f_cm, so that only loads can be had."""

    def scene(angle, result, **more):
        geometry = {
            "balls": 129, "rows": 2, "ball_diameter": 0.04, "pitch_diameter": 1.9,
            "groove_radius": 0.0205, "contact_angle": angle,
        }  # fmt: skip
        bearing = {"kind": "slewing", "geometry": geometry | more}
        return make_scene(
            {"results": [result], "shaft": {"moment": {}}, "bearings": {"M": bearing}}
        )

    with pytest.raises(InputError, match=r"bearing M: no life: .*got 40.11°; state dynamic_cap"):
        scene(0.7, "rolling.life")
    scene(0.7, "rolling.loads")
    assert scene(0.7, "rolling.life", dynamic_capacity=1e6).rolling.geometry.rated_capacity == 1e6
    rounded, whole = (
        scene(angle, "rolling.life").rolling.geometry.rated_capacity for angle in (0.785, np.pi / 4)
    )
    assert rounded == pytest.approx(whole, rel=1e-3)


@pytest.mark.parametrize(
    ("accuracy", "told"),
    [
        (0, "accuracy = 0: must be greater than 0"),
        (True, "accuracy = True: must be a valid number"),
        ("high", "accuracy = 'high': must be a valid number or a table or 'given'"),
        ({"journal.film": -1}, "accuracy.journal.film = -1: must be greater than 0"),
    ],
)
def test_a_key_that_may_have_several_types_is_told_by_the_one_that_stands_there(accuracy, told):
    with pytest.raises(InputError) as refused:
        make_scene({"name": "own", "accuracy": accuracy})
    assert str(refused.value).endswith(told)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("stated", "told"),
    [
        ({"loads": {"dlc": 1.1}}, "loads.dlc = 1.1: must be a text in quotes or a valid list"),
        ({"journal": {"shell": "thick"}}, "journal.shell = 'thick': must be a table"),
    ],
)
def test_a_key_of_several_types_is_told_in_one_line_without_their_names(stated, told):
    with pytest.raises(InputError) as refused:
        make_scene({"name": "own"} | stated)
    assert told in str(refused.value)
    assert str(refused.value).count("\n") == 0


def test_a_key_that_is_missing_in_a_table_with_kinds_is_told_without_the_name_of_its_class():
    with pytest.raises(InputError, match=r"journal\.shell\.modulus: this key is missing"):
        make_scene({"name": "own", "journal": {"shell": {"kind": "thick", "outer_diameter": 3.6}}})


JOURNAL = {"kind": "journal"}, {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}
ROLLER = (
    {"kind": "roller"},
    {"rollers": 64, "roller_diameter": 0.1, "roller_length": 0.1, "pitch_diameter": 2.2},
)
COLLAR = (
    {"kind": "thrust"},
    {"pads": 18, "inner_radius": 1.6, "outer_radius": 1.9, "pad_angle": 0.3, "taper": 8e-5},
)


def placed(place, bearing, more=(), **geometry):
    about, measures = bearing
    return {"bearings": {place: about | {"geometry": measures | geometry} | dict(more)}}


@pytest.mark.parametrize("wrong", [True, "1"])
@pytest.mark.parametrize(
    ("key", "stated"),
    [
        ("loads.duration", lambda x: {"loads": {"duration": x}}),
        ("loads.seeds", lambda x: {"loads": {"seeds": x}}),
        ("loads.wind_speeds.1", lambda x: {"loads": {"wind_speeds": [8.0, x]}}),
        ("accuracy.journal.film", lambda x: {"accuracy": {"journal.film": x}}),
        ("shaft.two_point.span", lambda x: {"shaft": {"two_point": {"span": x}}}),
        ("wear.counts.3.1", lambda x: {"wear": {"counts": {"3.1": x}}}),
        ("bearings.N.geometry.diameter", lambda x: placed("N", JOURNAL, diameter=x)),
        ("bearings.M.geometry.rollers", lambda x: placed("M", ROLLER, rollers=x)),
        (
            "bearings.M.cooling.transfer",
            lambda x: placed("M", ROLLER, {"cooling": {"transfer": x}}),
        ),
        ("bearings.N2.geometry.pads", lambda x: placed("N2", COLLAR, pads=x)),
    ],
)
def test_neither_true_nor_a_text_is_a_number_in_any_part_of_a_scene(key, stated, wrong):
    with pytest.raises(InputError) as refused:
        make_scene({"name": "own"} | stated(wrong))
    assert any(
        line.startswith(f"scene: {key} = {wrong!r}: must be a valid ")
        for line in str(refused.value).splitlines()
    ), refused.value
