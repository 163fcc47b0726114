"""No turbine stands on the bearing positions of another without a word."""

import importlib.resources
import tomllib

import pytest

from loadflow.errors import InputError
from loadflow.scene.candidates import candidates_of
from loadflow.scene.scene import make_scene, read_scene
from loadflow.turbines import load_turbine

SHIPPED = (importlib.resources.files("loadflow.turbines") / "nrel-5mw.toml").read_text()


@pytest.fixture
def larger(tmp_path):
    """The 5 MW with twice the radius in its file, which tells nothing of its bearings."""
    path = tmp_path / "own.toml"
    path.write_text(SHIPPED.replace("radius = 63.0", "radius = 89.0"))
    return path


def test_the_turbine_of_the_defaults_keeps_them():
    scene = make_scene({"shaft": {"two_point": {}}})
    assert scene.shaft.two_point.hub_to_first == 1.912
    assert not scene.taken


@pytest.mark.parametrize("shaft", [None, {"two_point": {}}, {"two_point": {"span": 5.0}}])
def test_another_turbine_has_scaled_distances_and_says_so(larger, shaft):
    data = {"turbine": {"file": str(larger)}} | ({} if shaft is None else {"shaft": shaft})
    scene = make_scene(data)
    two_point, ratio = scene.shaft.two_point, 89 / 63
    assert two_point.hub_to_first == pytest.approx(1.912 * ratio)
    assert two_point.span == (5.0 if shaft and shaft["two_point"] else pytest.approx(3.6 * ratio))
    told = "\n".join(scene.taken)
    assert "hub_to_first = 2.701" in told
    assert ("span" in told.split(":")[1]) == (two_point.span != 5.0)
    assert "scaled to NREL 5 MW" in told


def test_another_turbine_is_told_whose_bearings_it_stands_on(larger):
    data = {"turbine": {"file": str(larger)}, "results": ["journal.film", "rolling.life"]}
    told = "\n".join(make_scene(data).taken)
    assert "bearings N, N2: 3 m × 2.25 m, made for nrel-5mw" in told
    assert "bearings M: a slewing bearing of 1.9 m, made for nrel-5mw" in told
    only = make_scene(data | {"results": ["rolling.life"]}).taken
    assert not any("bearings N" in said for said in only)  # nothing wanted is of them
    own = {"diameter": 4.0, "width": 3.0, "relative_clearance": 5e-4}
    stated = make_scene(data | {"journal": {"geometry": own}}).taken
    assert not any("bearings N" in said for said in stated)


def test_distances_in_the_file_of_the_turbine_are_its_own(larger):
    text = larger.read_text()
    line = "[drivetrain]\nhub_to_bearing = 2.5\nbearing_span = 4.0"
    larger.write_text(text.replace("[drivetrain]", line))
    scene = make_scene({"turbine": {"file": str(larger)}})
    assert scene.shaft.two_point.positions == (2.5, 6.5)
    assert scene.shaft.moment.hub_to_bearing == 2.5
    assert not any("hub_to_first" in said or "span =" in said for said in scene.taken)


def test_the_distance_of_two_bearings_is_not_that_to_the_arms_of_the_gearbox(larger):
    text = larger.read_text()
    line = "[drivetrain]\nhub_to_bearing = 2.5\nbearing_span = 4.0"
    larger.write_text(text.replace("[drivetrain]", line))
    scene = make_scene({"turbine": {"file": str(larger)}, "shaft": {"three_point": {}}})
    assert scene.shaft.three_point.hub_to_first == 2.5
    assert scene.shaft.three_point.span == pytest.approx(4.8 * 89 / 63)
    assert any("span = 6.781" in said for said in scene.taken)


def test_the_turbine_of_two_main_bearings_has_them_where_its_source_has_them():
    """NREL/SR-500-32495: hub 3.30, bearings 2.31 and 0.66 m upwind of the yaw axis."""
    scene = make_scene({"turbine": {"name": "windpact-1.5mw"}})
    assert scene.shaft.two_point.positions == pytest.approx((3.30 - 2.31, 3.30 - 0.66))
    assert scene.shaft.moment.positions == pytest.approx((3.30 - 2.31,))
    assert not any("hub_to" in said or "span" in said for said in scene.taken)


def test_a_scene_names_its_turbine_by_file_relative_to_itself(tmp_path, larger):
    path = tmp_path / "scene.toml"
    path.write_text('[turbine]\nfile = "own.toml"\n')
    scene = read_scene(path)
    assert scene.turbine.name == str(larger)
    again = tmp_path / "again.toml"
    again.write_text(scene.to_toml())
    assert read_scene(again).shaft == scene.shaft
    with pytest.raises(InputError, match="name and file: give one of both"):
        make_scene({"turbine": {"file": str(larger), "name": "nrel-5mw"}})


def test_a_windio_file_is_a_turbine_of_a_scene():
    pytest.importorskip("windIO")
    folder = importlib.resources.files("windIO") / "examples" / "turbine"
    scene = make_scene({"turbine": {"file": str(folder / "IEA-15-240-RWT.yaml")}})
    # its own distances, of a direct drive
    assert scene.shaft.direct_drive.positions == pytest.approx((1.0, 2.2))
    assert any("rated_mechanical_power" in said for said in scene.taken)
    assert load_turbine(scene.turbine.name).rated_power == 15e6


def test_a_turbine_file_that_is_not_there_is_told_under_the_key_as_written(tmp_path):
    for key in ("file", "name"):
        with pytest.raises(InputError, match=rf"turbine\.{key}: .*gone\.toml does not exist"):
            make_scene({"turbine": {key: str(tmp_path / "gone.toml")}})


def test_a_turbine_file_that_changes_is_another_input(larger):
    data = {"turbine": {"file": str(larger)}}
    before = make_scene(data).digest("turbine")
    larger.write_text(larger.read_text().replace("cut_out = 25.0", "cut_out = 24.0"))
    assert make_scene(data).digest("turbine") != before


def _beam_of(**keys):
    scene = make_scene({"name": "look"} | keys)
    return scene, scene.shaft.two_point.beam.sections[0]


def test_a_beam_without_sections_is_as_wide_as_the_narrowest_journal_bearing():
    def journal(diameter):
        sizes = {"diameter": diameter, "width": 1.0, "relative_clearance": 1e-3}
        return {"kind": "journal", "geometry": sizes}

    bearings = {"N": journal(1.5), "N2": journal(1.4)}
    scene, section = _beam_of(shaft={"two_point": {"beam": {"shear": False}}}, bearings=bearings)
    assert (section.outer_diameter, section.inner_diameter) == (1.4, 0.7)
    assert not scene.shaft.two_point.beam.shear
    assert any("shaft.two_point.beam: 1.4 m with a bore of 0.7 m" in said for said in scene.taken)
    stated = {"two_point": {"beam": {"sections": [{"outer_diameter": 1.2}]}}}
    scene, section = _beam_of(shaft=stated, bearings=bearings)
    assert section.outer_diameter == 1.2
    assert not any("beam" in said for said in scene.taken)


def test_a_stated_section_that_fits_by_chance_is_not_told_as_one_that_is_taken():
    open_one, _ = _beam_of(shaft={"two_point": {"beam": {}}})
    assert any("shaft.two_point.beam" in said for said in open_one.taken)
    as_resolved = make_scene(tomllib.loads(open_one.to_toml()))
    assert as_resolved.shaft == open_one.shaft
    assert as_resolved.digest() == open_one.digest()
    assert not any("beam" in said for said in as_resolved.taken)
    renamed = open_one.model_copy(update={"name": "other"})
    assert any("shaft.two_point.beam" in said for said in renamed.taken)


def test_a_beam_without_films_keeps_the_section_of_the_library():
    shaft = {"two_point": {"beam": {}}}
    scene, section = _beam_of(shaft=shaft, results=["loads.statistics"])
    assert section.outer_diameter == 1.04
    assert not any("beam" in said for said in scene.taken)


def test_bearings_that_are_wider_than_the_distance_between_them_are_told():
    wide = {"geometry": {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}}
    data = {"name": "near", "results": ["journal.film"], "journal": wide}
    near, far = (make_scene(data | {"shaft": {"two_point": {"span": span}}}) for span in (2.0, 2.3))
    assert any("overlap by 0.25 m" in said for said in near.taken)
    assert not any("overlap" in said for said in far.taken)


@pytest.mark.parametrize("turbine", ["windpact-1.5mw", "nrel-5mw", "iea-15mw"])
def test_sized_journal_bearings_fit_beside_each_other(turbine):
    names = [name for name in candidates_of(turbine) if name.startswith("journal")]
    assert len(names) > 3
    for name in names:
        data = {"name": "fits", "turbine": {"name": turbine}, "bearings": [name]}
        scene = make_scene(data | {"results": ["journal.film"]})
        assert not any("overlap" in said for said in scene.taken)
