"""Places on the shaft as scenes write them: `[bearings.PLACE]`, lists of them, candidates."""

import importlib.resources
import json
import tomllib
import warnings

import pytest

from loadflow.cli import main
from loadflow.errors import FormerVersionWarning, InputError
from loadflow.rolling import SlewingBearing, SphericalRollerBearing, ToroidalRollerBearing
from loadflow.scene.candidates import candidates_of, machine_names
from loadflow.scene.changed import with_loads
from loadflow.scene.places import PLACE_KINDS, places_of, sections_of
from loadflow.scene.scene import make_scene, read_scene
from loadflow.scene.schema import json_schema
from loadflow.scene.written import SCENE

SPHERICAL = {
    "kind": "spherical",
    "geometry": {
        "rollers": 24, "roller_diameter": 0.112, "roller_length": 0.145, "pitch_diameter": 0.995,
        "contact_angle": 0.185,
    },
}  # fmt: skip
FOUR_POINT = {
    "kind": "four-point",
    "geometry": {
        "balls": 90, "rows": 2, "ball_diameter": 0.12, "pitch_diameter": 3.6,
        "groove_radius": 0.0624, "contact_angle": 0.785, "row_spacing": 0.15,
    },
}  # fmt: skip
TWO = {"shaft": {"two_point": {}, "moment": {}}}


def journal(diameter, **more):
    size = {"diameter": diameter, "width": 1.0, "relative_clearance": 1e-3}
    return {"kind": "journal", "geometry": size} | more


def scene_with(**places):
    return make_scene({"bearings": places} | TWO)


def test_a_place_has_the_bearing_that_is_written_there():
    scene = scene_with(N=journal(1.2), N2=SPHERICAL, M=FOUR_POINT)
    assert scene.journal.bearings == ["N"]
    assert scene.journal.geometry.diameter == 1.2
    assert {name: type(b) for name, b in scene.rolling.geometries.items()} == {
        "N2": SphericalRollerBearing, "M": SlewingBearing,
    }  # fmt: skip


def test_like_takes_the_data_of_another_place_and_its_own_beside_them():
    scene = scene_with(N=journal(1.2), N2={"like": "N", "edge_pressure": 2e5})
    assert scene.journal.at("N2").geometry == scene.journal.at("N").geometry
    assert scene.journal.at("N").edge_pressure == 0.5e6
    assert scene.journal.at("N2").edge_pressure == 2e5


def test_journal_bearings_may_differ_but_for_how_they_are_modelled():
    scene = scene_with(N=journal(1.2), N2=journal(0.8))
    assert [scene.journal.at(p).geometry.diameter for p in ("N", "N2")] == [1.2, 0.8]
    with pytest.raises(InputError, match="motion"):
        scene_with(N=journal(1.2), N2=journal(0.8, motion="transient"))
    moving = scene_with(N=journal(1.2, motion="transient", rung="reduced"), N2=journal(0.8))
    assert moving.journal.at("N2").in_motion
    written = tomllib.loads(moving.to_toml())
    assert "motion" not in written["bearings"]["N2"]
    assert make_scene(written) == moving
    supply = {"grooves": [{"angle": 3.1, "length": 0.1, "pressure": 2e5, "shape": "circle"}]}
    with pytest.raises(InputError, match="reduced"):
        scene_with(N=journal(1.2, rung="reduced"), N2=journal(0.8, supply=supply))


def test_the_two_forms_give_the_same_scene():
    old = make_scene({
        **TWO,
        "journal": {"bearings": ["N", "N2"], "edge_pressure": 1e5},
        "rolling": {"bearing": "M", "geometry": {"kind": "slewing"} | FOUR_POINT["geometry"]},
    })  # fmt: skip
    film = {"kind": "journal", "edge_pressure": 1e5}
    new = scene_with(N=film, N2={"like": "N"}, M=FOUR_POINT)
    assert new.journal == old.journal
    assert new.rolling == old.rolling
    assert new.digest() == old.digest()


@pytest.mark.parametrize("kind", ["four-point", "slewing", None])
def test_the_former_section_knows_a_four_point_bearing_by_both_its_words(kind):
    told = {} if kind is None else {"kind": kind}
    geometry = FOUR_POINT["geometry"] | told
    former = make_scene(TWO | {"rolling": {"bearing": "M", "geometry": geometry}})
    assert former.rolling == scene_with(M=FOUR_POINT).rolling
    further = [{"bearing": "N2", "geometry": SPHERICAL["geometry"] | {"kind": "spherical"}},
               {"bearing": "M", "geometry": geometry}]  # fmt: skip
    assert make_scene(TWO | {"rolling": further}).rolling.geometries["M"].kind == "slewing"


@pytest.mark.parametrize(
    ("geometry", "told"),
    [
        ({"kind": "four-points"}, "rolling.geometry.*kind must be one of four-point, slewing"),
        ({"kind": "four-point", "bals": 3}, r"rolling\.geometry\.bals: .*did you mean balls"),
        ({"kind": "four-point", "rows": 0}, r"rolling\.geometry\.rows = 0"),
    ],
)
def test_what_is_no_four_point_bearing_is_refused_where_it_is_written(geometry, told):
    with pytest.raises(InputError, match=told):
        make_scene(TWO | {"rolling": {"geometry": FOUR_POINT["geometry"] | geometry}})


@pytest.mark.parametrize(
    ("word", "bearing", "told"),
    [
        ("preload", SPHERICAL, "a preload is a negative clearance"),
        ("osculation", FOUR_POINT, "groove_radius is the osculation times ball_diameter"),
        ("static_capacity", SPHERICAL, "C₀ follows from the geometry"),  # not: dynamic_capacity?
        ("osculation", SPHERICAL, "unknown key; known here"),
    ],
)
def test_words_of_catalogues_are_told_what_stands_for_them(word, bearing, told):
    geometry = bearing["geometry"] | {word: 0.5}
    with pytest.raises(InputError, match=rf"bearings\.N\.geometry\.{word}: .*{told}"):
        scene_with(N=bearing | {"geometry": geometry})


def test_results_left_out_are_those_of_the_bearings_that_there_are():
    rooms = {r.split(".")[0] for r in scene_with(M=FOUR_POINT).results}
    assert "rolling" in rooms
    assert "journal" not in rooms


def test_the_resolved_form_has_places_and_reads_back_as_itself(tmp_path):
    scene = make_scene({
        **TWO, "name": "s",
        "bearings": {"N": [journal(1.2), SPHERICAL], "N2": journal(0.8), "M": FOUR_POINT},
        "candidates": {"mine": {"title": "mine", "N": SPHERICAL, "N2": {"like": "N"}}},
    })  # fmt: skip
    path = tmp_path / "s.toml"
    path.write_text(scene.to_toml(), encoding="utf-8")
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    assert data["schema"] == SCENE.version
    assert not {"journal", "rolling"} & set(data)
    assert [part["kind"] for part in data["bearings"]["N"]] == ["journal", "spherical"]
    assert data["bearings"]["M"]["kind"] == "four-point"
    assert read_scene(path) == scene
    assert read_scene(path).digest() == scene.digest()


def test_a_version_that_is_not_known_yet_is_refused():
    with pytest.raises(InputError, match=f"must be 1 … {SCENE.version}; a newer loadflow wrote"):
        make_scene({"schema": SCENE.version + 1})


@pytest.mark.parametrize("version", [0, -1, 1.5, "two", True, None, [2]])
def test_a_version_that_is_none_is_refused(version):
    with pytest.raises(InputError, match=f"must be 1 … {SCENE.version}$"):
        make_scene({"schema": version})


def test_an_older_scene_is_read_and_its_owner_told_how_to_write_it(tmp_path):
    path = tmp_path / "old.toml"
    path.write_text(
        'schema = 1\nname = "old"\n[journal]\nbearings = ["N"]\nboundary_friction = 0.1\n',
        encoding="utf-8",
    )
    with pytest.warns(FormerVersionWarning, match=r"\[journal\] is \[bearings\.PLACE\] today"):
        old = read_scene(path)
    path.write_text(old.to_toml(), encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error", FormerVersionWarning)
        assert read_scene(path) == old
    assert old.journal.boundary_friction == 0.1


@pytest.mark.parametrize("version", [{}, {"schema": 2}])
def test_supports_were_seats_and_are_still_read_as_such(version):
    beam = {"supports": [{"radial": 1e9}, {}]}
    today = make_scene({"shaft": {"two_point": {"beam": beam}}})
    former = {"shaft": {"two_point": {"beam": {"seats": beam["supports"]}}}}
    with pytest.warns(
        FormerVersionWarning, match=r"shaft\.two_point\.beam\.seats is supports today"
    ):
        assert make_scene(version | former) == today
    with pytest.raises(InputError, match="seats"):
        make_scene({"schema": SCENE.version} | former)


@pytest.mark.parametrize(
    ("places", "told"),
    [
        ({"N": {"geometry": {}}}, "bearings.N.kind"),
        ({"N": {"kind": "magic"}}, "four-point"),
        ({"N": {"like": "N2"}}, "bearings.N.like"),
        ({"N": {"kind": "spherical"}}, "bearings.N.geometry"),
        ({"N": [journal(1.0), journal(1.1)]}, "candidates.NAME"),
        ({"N": 3}, "bearings.N = 3"),
        ({}, "needs a table for each place"),
    ],
)
def test_what_is_no_bearing_is_refused_by_its_place(places, told):
    with pytest.raises(InputError, match="bearings") as info:
        make_scene({"bearings": places} | TWO)
    assert told in str(info.value)


def test_all_bad_bearings_are_told_at_once_and_what_is_wrong_beside_them():
    places = {"N": {"kind": "jornal"}, "N2": {"kind": "journal"}, "M": {"kind": "roller"}}
    with pytest.raises(InputError) as caught:
        make_scene({"loads": {"seed": 2}, "bearings": places}, "own.toml")
    lines = str(caught.value).splitlines()
    told = (
        "bearings.N.kind: must be one of",
        "bearings.M.geometry: must be",
        "loads.seed: unknown",
    )
    assert len(lines) == len(told)
    for line, part in zip(lines, told):
        assert line.startswith("own.toml: ")
        assert part in line


def told_of(data):
    with pytest.raises(InputError) as caught:
        make_scene(data, "own.toml")
    return str(caught.value).splitlines()


def test_bad_bearings_of_all_candidates_are_told_at_once_beside_those_of_the_scene():
    bad = {"a": {"N": {"kind": "jornal"}, "N2": {"kind": "roller"}}, "b": {}, "c": {"N": 3}}
    lines = told_of({"bearings": {"N": {"kind": "x"}}, "candidates": bad, "loads": {"seed": 2}})
    told = (
        "bearings.N.kind: must be one of",
        "candidates.a.N.kind: must be one of",
        "candidates.a.N2.geometry: must be",
        "candidates.b: says nothing, and is none of those sized",
        "candidates.c.N = 3: must be a table",
        "loads.seed: unknown",
    )
    assert len(lines) == len(told)
    for line, part in zip(lines, told):
        assert line.startswith("own.toml: ")
        assert part in line


def test_places_that_the_shaft_lacks_are_told_of_all_candidates():
    film = {"kind": "journal"}
    lines = told_of({"candidates": {"a": {"X": film, "Y": film}, "b": {"N": film, "Z": film}}})
    assert lines == [
        f"own.toml: candidates.{where}: the shaft has only N, N2, M"
        for where in ("a.X", "a.Y", "b.Z")
    ]


def test_what_is_wrong_for_want_of_the_bearings_is_not_told():
    with pytest.raises(InputError) as caught:
        make_scene({"results": ["thrust.film"], "bearings": {"N": {"kind": "jornal"}}})
    assert len(str(caught.value).splitlines()) == 1


def test_a_bad_value_is_named_where_it_was_written():
    bad = {"kind": "journal", "lubricant": {"viscosity": -1.0}}
    with pytest.raises(InputError, match=r"bearings\.N2\.lubricant\.viscosity = -1\.0"):
        make_scene({"bearings": {"N": journal(1.0), "N2": bad}} | TWO)
    worse = {"kind": "spherical", "geometry": SPHERICAL["geometry"] | {"rollers": 1.5}}
    with pytest.raises(InputError, match=r"candidates\.mine\.N\.geometry\.rollers"):
        make_scene({"candidates": {"mine": {"N": worse}}} | TWO)


@pytest.mark.parametrize(
    ("data", "meant"),
    [
        ({"loads": {"wind_speed": [8]}}, "did you mean wind_speeds?"),
        ({"lods": {}}, "did you mean loads?"),
        ({"bearing": "two-spherical"}, "did you mean bearings?"),
        ({"journal": {"geometry": {"diametre": 3}}}, "did you mean diameter?"),
    ],
)
def test_an_unknown_key_is_told_what_may_be_meant(data, meant):
    with pytest.raises(InputError, match="unknown key") as info:
        make_scene(data)
    assert meant in str(info.value)


def test_bearings_beside_the_former_section_are_refused():
    with pytest.raises(InputError, match="write all as"):
        make_scene({"bearings": {"N": journal(1.0)}, "journal": {}} | TWO)


def test_a_candidate_needs_its_places_on_the_shaft():
    with pytest.raises(InputError, match=r"candidates\.a\.M"):
        make_scene({"shaft": {"two_point": {}}, "candidates": {"a": {"M": FOUR_POINT}},
                    "results": ["loads.statistics"]})  # fmt: skip


def test_an_empty_candidate_is_the_sized_one_of_the_turbine():
    scene = make_scene({"candidates": {"two-spherical": {}}} | TWO)
    found = scene.candidates["two-spherical"]
    assert found.places == ("N", "N2")
    assert "231/750" in found.title
    with pytest.raises(InputError, match="two-spherical"):
        make_scene({"candidates": {"magic": {}}} | TWO)


def test_bearings_by_name_are_those_sized_for_the_turbine():
    named = make_scene({"name": "s", "bearings": ["journal-thrust", "tapered-pair"]})
    stated = candidates_of("nrel-5mw")
    written = {place: part for name in ("journal-thrust", "tapered-pair")
               for place, part in stated[name].items() if place in ("N", "N2", "M")}  # fmt: skip
    assert named == make_scene({"name": "s", "bearings": written})
    assert make_scene(tomllib.loads(named.to_toml())) == named
    assert make_scene({"name": "s", "bearings": "two-spherical"}).rolling.bearing == "N"
    both = make_scene({"name": "s", "bearings": ["journal-thrust", "two-spherical"]})
    assert both.journal.bearings == ["N", "N2"] == [*both.rolling.geometries]
    with pytest.raises(InputError, match="did you mean journal-thrust"):
        make_scene({"bearings": "journal-trust"})
    with pytest.raises(InputError, match=r"sized for windpact-1\.5mw"):
        make_scene({"bearings": "conical-pair", "turbine": {"name": "windpact-1.5mw"}})
    with pytest.raises(InputError, match="second journal bearing"):
        make_scene({"bearings": ["journal-thrust", "journal-lemon"]})


def test_names_of_sized_bearings_do_not_hide_what_is_wrong_with_the_turbine(tmp_path):
    for name, told in (("nrel-5mv", "did you mean nrel-5mw"), ("none.toml", "does not exist")):
        with pytest.raises(InputError, match=told):
            make_scene({"turbine": {"name": name}, "bearings": "journal-thrust"})
    own = tmp_path / "own.toml"
    shipped = importlib.resources.files("loadflow.turbines") / "nrel-5mw.toml"
    own.write_text(shipped.read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(
        InputError, match=r"not for .*own.toml; state its own as \[bearings.PLACE\]"
    ):
        make_scene({"turbine": {"name": str(own)}, "bearings": "journal-thrust"})


@pytest.mark.parametrize("turbine", machine_names())
def test_every_turbine_has_journal_bearings_with_a_collar(turbine):
    scene = make_scene({"turbine": {"name": turbine}, "bearings": "journal-thrust"})
    assert scene.journal.bearings == ["N", "N2"]
    assert [*scene.thrust.bearings] == ["N2"]
    shaft = max(scene.journal.at(place).geometry.diameter for place in ("N", "N2")) / 2
    assert scene.thrust.bearings["N2"].geometry.inner_radius > shaft


@pytest.mark.parametrize("turbine", machine_names())
def test_sized_candidates_are_valid_and_have_sources(turbine):
    names = candidates_of(turbine)
    scene = make_scene({
        "turbine": {"name": turbine}, "candidates": {name: {} for name in names},
    })  # fmt: skip
    for candidate in scene.candidates.values():
        assert candidate.title
        assert candidate.source
        assert set(candidate.places) <= set(scene.shaft.bearings)


@pytest.mark.parametrize("place", ["N", "N2"])
def test_the_published_capacity_is_near_that_of_the_geometry(place):
    stated = candidates_of("nrel-5mw")["toroidal-spherical"][place]["geometry"]
    free = {name: value for name, value in stated.items() if name != "dynamic_capacity"}
    kind = {"N": ToroidalRollerBearing, "N2": SphericalRollerBearing}[place]
    ours = kind(**free).rated_capacity
    assert 0.7 < ours / stated["dynamic_capacity"] < 1.0  # makers' capacities exceed ISO 281


def test_sections_and_places_are_each_others_inverse():
    places = {"N": journal(1.0), "M": FOUR_POINT}
    sections = sections_of(places)
    rolling = sections.rolling[0] | {"further": []}
    assert places_of(sections.journal, rolling) == places


def test_paths_are_relative_to_the_scene(tmp_path, monkeypatch):
    path = tmp_path / "s.toml"
    path.write_text(
        '[loads]\nsource = "files"\nfiles = ["a.outb"]\ncase_list = "cases.csv"\n', encoding="utf-8"
    )
    monkeypatch.chdir(tmp_path.parent)
    scene = read_scene(f"{tmp_path.name}/s.toml")
    assert scene.loads.files == [str(tmp_path / "a.outb")]
    assert scene.loads.cases == str(tmp_path / "cases.csv")
    assert with_loads(scene, ["b.outb"]).loads.files == [str(tmp_path.parent / "b.outb")]
    path.write_text('[turbine]\nname = "own.toml"\n', encoding="utf-8")
    with pytest.raises(InputError, match=str(tmp_path / "own.toml")):
        read_scene(path)


def test_the_schema_knows_the_keys_of_every_resolved_scene():
    schema = json_schema()
    data = tomllib.loads(make_scene({"name": "s", "candidates": {"two-spherical": {}}}).to_toml())
    assert set(data) <= set(schema["properties"])
    kinds = {
        part["properties"]["kind"]["const"]
        for name, part in schema["$defs"].items()
        if name.endswith("Place") and "properties" in part
    }
    assert set(PLACE_KINDS) <= kinds
    film = schema["$defs"]["JournalPlace"]["properties"]
    assert set(data["bearings"]["N"]) <= set(film)
    assert "bearings" not in film


def test_the_schema_is_printed(capsys):
    main_ok("scene", "--schema")
    assert json.loads(capsys.readouterr().out)["title"] == "loadflow scene"


def test_the_former_form_is_noted(tmp_path, capsys):
    path = tmp_path / "s.toml"
    path.write_text("[journal]\nbearings = ['N']\n[shaft.two_point]\n", encoding="utf-8")
    main_ok("scene", str(path))
    assert "[journal]: still read" in capsys.readouterr().out


def main_ok(*arguments):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert not stop.value.code
