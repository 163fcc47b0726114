"""The search for the best design: space, spectrum, judgement, front, page, resumption."""

import csv
import json
import math
import re
import shutil
import subprocess
import tomllib
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from browser import BROWSER
from synthetic import cube_file

from loadflow.cli import main
from loadflow.cube import open_cube
from loadflow.errors import InputError
from loadflow.journal import JournalBearing
from loadflow.report.design_figures import broken_in, front_figure, map_figure
from loadflow.running.comparison import Means, shared_loads
from loadflow.running.designing import _left_out, chosen_candidate, design
from loadflow.scene.candidate import Candidate
from loadflow.scene.cooling import Cooling
from loadflow.scene.design import Design
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.scene import make_scene, read_scene
from loadflow.stages.films.of_bearing import equilibria
from loadflow.stages.frames import to_rolling
from loadflow.stages.rolling_at_work import at_work
from loadflow.studies.candidate.grown_films import fast_journal
from loadflow.studies.design.point import DesignPoint, judge_design
from loadflow.studies.design.result import best_of, front_of, scene_with_bearings
from loadflow.studies.design.space import space_of, start_of
from loadflow.studies.lifetime.load_spectrum import load_spectrum

FILM = {
    "geometry.relative_clearance": [0.0006, 0.002],
    "lubricant.viscosity": {"values": [0.1, 0.15, 0.2, 0.3]},
}
SHORT = {
    "keys": FILM, "sweep": 16, "generations": 8, "population": 8, "levels": 1, "cells": 3,
    "classes": 3,
}  # fmt: skip


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5", seeds=(1,), steps=160)


def scene_of(cube, **search):
    data = {
        "name": "search",
        "accuracy": "given",  # no pilot
        "loads": {"files": [str(cube)]},
        "shaft": {"two_point": {}, "moment": {}},
        "candidates": {"journal-cylindrical": {}, "two-spherical": {}, "double-row-tapered": {}},
        "design": {"candidate": "journal-cylindrical"} | SHORT | search,
    }
    return make_scene(data)


@pytest.fixture(scope="module")
def found(cube, tmp_path_factory):
    return design(scene_of(cube), out=tmp_path_factory.mktemp("runs"))


@pytest.fixture(scope="module")
def series(cube, tmp_path_factory):
    """Loads and shaft of the cases."""
    loads = shared_loads(scene_of(cube), tmp_path_factory.mktemp("runs"), Means())
    return [
        (case.name, *(open_cube(loads.folder / s / f"{case.name}.h5").load()
                      for s in ("loads", "shaft")))
        for case in loads.plan.cases
    ]  # fmt: skip


# --- what varies ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"geometry.diametre": [1, 2]}, r"geometry.diametre: unknown key; did you mean diameter\?"),
        ({"geometry.diameter": [-2, -1]}, "geometry.diameter"),
        ({"G.geometry.diameter": [1, 2]}, "G.geometry.diameter"),
        ({"geometry.shape": {"values": [{"kind": "cylindrical"}, {"kind": "oval"}]}}, "shape"),
        ({"friction.lubricant": {"values": ["lgep-2", "butter"]}}, "friction.lubricant"),
    ],
)
def test_a_key_that_no_bearing_has_is_refused_by_name(cube, keys, said):
    scene = scene_of(cube, keys=keys)
    with pytest.raises(InputError, match=said):
        space_of(scene, scene.candidates["journal-cylindrical"], scene.design)


@pytest.mark.parametrize("bad", [[2, 1], {"low": 1}, {"values": [1]}, [1, 2, 3], "wide"])
def test_values_that_are_no_range_are_refused_by_key(cube, bad):
    with pytest.raises(InputError, match="design"):
        scene_of(cube, keys={"geometry.diameter": bad})


def test_dotted_keys_of_toml_are_the_same_as_quoted_ones():
    nested = tomllib.loads("[keys]\ngeometry.diameter = [1.0, 2.0]\nN.geometry.width = [1, 2]")
    assert set(Design.model_validate(nested).keys) == {"geometry.diameter", "N.geometry.width"}


def test_the_candidate_as_given_is_a_point_of_its_space(cube):
    scene = scene_of(cube, keys={})
    for name, candidate in scene.candidates.items():
        space = space_of(scene, candidate, Design())
        made, _ = space.at(start_of(space))
        for room in ("journal", "rolling"):
            assert getattr(made, room) == getattr(candidate, room), name


def test_a_stated_capacity_follows_the_geometry_as_that_of_the_standard_does(cube):
    scene = scene_of(cube)
    candidate = scene.candidates["two-spherical"]
    space = space_of(scene, candidate, Design(keys={"N.geometry.roller_length": [0.1, 0.2]}))
    longer = space.at([0.2])[0].rolling.geometries["N"]
    before = candidate.rolling.geometries["N"]
    # ISO 281: C of rollers goes with length^(7/9)
    expected = before.dynamic_capacity * (0.2 / before.roller_length) ** (7 / 9)
    assert longer.dynamic_capacity == pytest.approx(expected, rel=1e-3)
    other = space.at([0.2])[0].rolling.geometries["N2"]
    assert other == candidate.rolling.geometries["N2"]


def test_whole_numbers_stay_whole(cube):
    scene = scene_of(cube)
    candidate = scene.candidates["double-row-tapered"]
    space = space_of(scene, candidate, Design(keys={"geometry.rollers": [60, 90]}))
    assert space.at([70.3])[0].rolling.geometry.rollers == 70


# --- loads ----------------------------------------------------------------------------------------


def test_a_spectrum_stands_for_the_series(cube, series):
    """Mean power and equivalent load of the classes are those of every sample."""
    scene = scene_of(cube)
    place, candidate = "N", scene.candidates["journal-cylindrical"]
    spectrum = load_spectrum(scene, series, [place], 5)
    samples = spectrum[place].to_dataset()
    assert float(samples["weight"].sum()) == pytest.approx(1.0, abs=1e-12)
    options = fast_journal(candidate.journal.at(place))

    def power(force, speed):
        return equilibria(options, force, speed).friction_power

    whole = np.concatenate([
        power(shaft["force"].sel(bearing=place).transpose("time", "axis").values,
              loads["speed"].values) for _, loads, shaft in series
    ])  # fmt: skip
    classed = power(samples["force"].values, samples["speed"].values) * samples["weight"].values
    assert classed.sum() == pytest.approx(whole.mean(), rel=0.01)
    load = np.concatenate([
        np.hypot(*shaft["force"].sel(bearing=place, axis=["y", "z"]).values)
        for _, _, shaft in series
    ])  # fmt: skip
    of_classes = np.hypot(*samples["force"].values[:, 1:].T)
    p = 10 / 3
    assert (samples["weight"].values @ of_classes**p) ** (1 / p) == pytest.approx(
        np.mean(load**p) ** (1 / p), rel=0.01
    )
    assert of_classes.max() == pytest.approx(load.max())


# --- judgement ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["journal-cylindrical", "two-spherical", "double-row-tapered"])
def test_with_loads_grown_by_the_margin_the_first_limit_is_reached(cube, series, name):
    scene = scene_of(cube)
    candidate = scene.candidates[name]
    spectrum = load_spectrum(scene, series, candidate.places, 4)
    before = judge_design(candidate, scene.friction, spectrum)
    assert before.why == ""
    grown = spectrum.copy()
    for place in candidate.places:
        for vector in ("force", "moment"):
            grown[place][vector] = before.load_factor * grown[place][vector]
    after = judge_design(candidate, scene.friction, grown)
    # between two of the factors that are asked, straight lines take the place of the film; the
    # load on rollers is taken to grow with all loads, though clearance spreads it on more of them
    above = 0.03 if candidate.rolling is None else 0.1
    assert 0.97 < after.load_factor < 1.0 + above
    assert before.numbers["energy"] > 0


def test_the_largest_pressure_of_a_design_is_that_of_the_hardest_samples(cube, series):
    """They have no share of the lifetime, and still press."""
    scene = scene_of(cube)
    candidate = scene.candidates["two-spherical"]
    spectrum = load_spectrum(scene, series, candidate.places, 4)
    pressures, lasting = [], []
    for place, bearing in candidate.rolling.geometries.items():
        samples = spectrum[place].to_dataset()
        force = samples["force"].transpose("sample", "axis").values
        found = bearing.equilibrium(to_rolling(force)).maximum_pressure
        pressures.append(found.max())
        lasting.append(found[samples["weight"].values > 0].max())
    given = Friction(cooling={place: Cooling(temperature=313.15) for place in candidate.places})
    found = judge_design(candidate, given, spectrum).numbers["contact_pressure"]
    assert found == pytest.approx(max(pressures), rel=1e-9)
    assert max(pressures) > 1.0005 * max(lasting)  # so that it matters which


def test_a_design_is_as_warm_as_its_mean_friction_and_cooling_make_it(cube, series):
    """A stated temperature of the same size gives the same life and losses."""
    scene = scene_of(cube)
    candidate = scene.candidates["two-spherical"]
    spectrum = load_spectrum(scene, series, candidate.places, 4)
    cooled = Friction(cooling={"N": Cooling(12.0), "N2": Cooling(area=4.0, transfer=20.0)})
    found = judge_design(candidate, cooled, spectrum)
    warm = {}
    for place, part in candidate.rolling.bearings.items():
        samples = spectrum[place].to_dataset()
        samples = samples.isel(sample=np.flatnonzero(samples["weight"].values > 0))
        values = (samples[n].transpose("sample", ...).values
                  for n in ("force", "moment", "speed", "weight"))  # fmt: skip
        warm[place] = Cooling(temperature=at_work(part, cooled, *values)[1])
    assert all(one.temperature > 303.0 for one in warm.values())
    stated = judge_design(candidate, Friction(cooling=warm), spectrum)
    for name in ("energy", "modified_life"):
        assert found.numbers[name] == pytest.approx(stated.numbers[name], rel=1e-9)
    usual = judge_design(candidate, Friction(), spectrum)
    assert found.numbers["modified_life"] != pytest.approx(usual.numbers["modified_life"], rel=0.05)
    # heavier loads make its oil warmer
    if stated.load_factor > 1:
        assert found.load_factor <= stated.load_factor


def test_a_cooling_varies_from_what_the_scene_states_and_is_written_with_the_design(cube):
    cooling = {"N": {"conductance": 12.0}, "N2": {"area": 4.0, "transfer": 20.0}}
    keys = {"keys": {"friction.cooling.N.conductance": [10.0, 30.0]}}
    stated = scene_of(cube, candidate="two-spherical", **keys)
    scene = stated.model_copy(update={"friction": Friction(cooling=cooling)})
    space = space_of(scene, scene.candidates["two-spherical"], scene.design)
    assert start_of(space) == [12.0]
    text = scene_with_bearings(scene, "best", *space.data([20.0]), "words")
    written = make_scene(tomllib.loads(text)).friction
    parts = scene.candidates["two-spherical"].rolling.bearings.values()
    assert [written.conductance_of(part) for part in parts] == [20.0, 80.0]


def test_a_design_has_the_collar_of_its_candidate_and_none_of_the_scene():
    """A collar does not vary, and stands in the runs that check and in the scene of the best."""
    names = {"journal-cylindrical": {}, "journal-thrust": {}}
    data = {"name": "quick", "bearings": ["journal-thrust"], "shaft": {"two_point": {}}}
    scene = make_scene(data | {"candidates": names})
    assert scene.thrust.bearings
    for name, candidate in scene.candidates.items():
        space = space_of(scene, candidate, Design(keys={"N2.geometry.width": [0.8, 1.4]}))
        one, _ = space.at([1.0])
        text = scene_with_bearings(scene, "best", *space.data([1.0]), "words")
        best = make_scene(tomllib.loads(text))
        assert one.journal.at("N2").geometry.width == best.journal.at("N2").geometry.width == 1.0
        if name == "journal-thrust":
            assert one.thrust.bearings == best.thrust.bearings == candidate.thrust.bearings
        else:
            assert one.thrust is None
            assert best.thrust.bearings == {}


def test_a_design_keeps_what_all_collars_share_and_one_alone_at_its_place():
    """Rung, grid, motion and tilt are keys of the section, and are written at the collars."""
    rows = {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7, "taper": 1e-4}
    collar = {"kind": "thrust", "rung": "curve", "grid": [24, 12], "tilt": True, "geometry": rows}
    size = {"diameter": 1.4, "width": 1.3, "relative_clearance": 1e-3}
    journal = {"kind": "journal", "geometry": size}
    beams = {"two_point": {}}
    for there in ([journal, collar], collar):
        candidates = {"own": {"N": journal, "N2": there}}
        scene = make_scene({"name": "quick", "shaft": beams, "candidates": candidates})
        own = scene.candidates["own"]
        space = space_of(scene, own, Design(keys={"N.geometry.width": [0.8, 1.4]}))
        one, _ = space.at([1.0])
        text = scene_with_bearings(scene, "best", *space.data([1.0]), "words")
        best = make_scene(tomllib.loads(text))
        assert one.thrust.changed == best.thrust.changed == own.thrust.changed
        assert one.thrust == best.thrust == own.thrust


def test_a_search_over_cones_is_refused_by_name():
    scene = make_scene({"name": "cones", "shaft": {"moment": {}},
                        "candidates": {"conical-pair": {}}})  # fmt: skip
    with pytest.raises(InputError, match=r"design.candidate = 'conical-pair': the search has fast"):
        chosen_candidate(scene)


def test_the_search_finds_what_a_fine_scan_finds(cube, series, found):
    """The least energy at the required margin, over all viscosities and a fine scan of ψ."""
    scene = scene_of(cube)
    candidate, space = scene.candidates["journal-cylindrical"], found.designs.space
    spectrum = load_spectrum(scene, series, candidate.places, SHORT["classes"])
    scanned = []
    for oil in range(4):
        for clearance in np.linspace(0.0006, 0.002, 15):
            one = judge_design(*space.at([clearance, oil]), spectrum)
            if one.load_factor >= 1 and one.condition >= 1:
                scanned.append(one.energy)
    best = best_of(found.designs.points, found.designs.answers, 1.0)
    assert found.designs.answer_at(best).energy <= 1.01 * min(scanned)


def test_no_design_of_the_front_is_worse_than_another():
    rng = np.random.default_rng(1)
    answers = [
        DesignPoint({"energy": e, "load_factor": m, "condition": c})
        for e, m, c in rng.uniform(0.5, 2.0, (300, 3))
    ]
    points = [np.array([float(k)]) for k in range(300)]
    front = {*front_of(points, answers)}
    for k, one in enumerate(answers):
        better = [
            other for other in answers
            if other.condition >= 1 and other.energy <= one.energy
            and other.load_factor >= one.load_factor and other is not one
        ]  # fmt: skip
        assert (k in front) == (one.condition >= 1 and not better)


# --- the search -----------------------------------------------------------------------------------


def test_the_best_design_holds_all_limits_when_it_is_run(found):
    designs = found.designs
    assert designs.best is not None
    run = designs.of_best
    assert run.holds
    assert run.numbers["load_factor"].value >= 1.0
    assert run.numbers["energy"].value < designs.judged["start"].numbers["energy"].value


def test_the_scene_of_the_best_design_is_ready_to_run(found):
    scene = read_scene(found.scene)
    best = dict(zip((axis.key for axis in found.designs.space.axes), found.designs.best))
    for place in ("N", "N2"):
        bearing = scene.journal.at(place)
        assert bearing.geometry.relative_clearance == best["geometry.relative_clearance"]
        viscosity = FILM["lubricant.viscosity"]["values"][int(best["lubricant.viscosity"])]
        assert bearing.lubricant.viscosity == viscosity
    assert "journal.film" in scene.results


def test_the_table_has_every_design(found):
    with found.table.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(found.designs.points)
    assert sum(int(row["best"]) for row in rows) == 1
    best = next(row for row in rows if row["best"] == "1")
    assert float(best["load_factor [1]"]) >= 1


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.drawings = [], 0

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.links += [given["href"]] if tag == "a" else []
        self.drawings += tag == "svg"


def test_the_page_says_the_conclusion_and_draws_front_and_map(found):
    text = found.page.read_text(encoding="utf-8")
    runs = re.findall(r"<tr><td>(as given|best-[0-9a-f]{8})</td>(?:<td>[\d.]+</td>){3}", text)
    assert runs[-1] == "as given"
    assert len(runs) == len(found.designs.judged) > 1
    assert found.designs.conclusion.split(",")[0] in text
    page = Page()
    page.feed(text)
    assert page.drawings == 2
    for link in page.links:
        assert link.startswith("#") or (found.path / link).exists(), link
    data = json.loads((found.path / "design.json").read_text(encoding="utf-8"))
    assert len(data["designs"]) == len(found.designs.points)


def test_a_best_design_at_an_end_of_its_range_says_so(found):
    """Beyond it may be a better one, which no one has looked at."""
    axes = found.designs.space.axes
    middle = np.array([0.5 * (axis.low + axis.high) for axis in axes])
    assert replace(found.designs, best=middle).at_ends == ()
    last = middle.copy()
    last[0] = axes[0].high - 0.01 * (axes[0].high - axes[0].low)
    there = replace(found.designs, best=last)
    assert there.at_ends == (axes[0].key,)
    assert f"At an end of its range: {axes[0].key.replace('geometry.', '')}." in there.conclusion
    assert replace(found.designs, best=None).at_ends == ()


@pytest.mark.slow
def test_the_page_tells_of_a_tilt_in_the_clearances_that_fast_models_leave_out(cube, tmp_path):
    """Not of bearings that align themselves, nor of a rigid shaft."""

    def told(beam, **keys):
        bearings = {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}
        journal = Journal(bearings=["N", "N2"], geometry=JournalBearing(**bearings), **keys)
        shaft = {"shaft": {"two_point": {"beam": {}} if beam else {}}}
        words = {"name": "told", "loads": {"files": [str(cube)]}, "results": ["loads.statistics"]}
        loads = shared_loads(make_scene(words | shaft), tmp_path / f"{beam}", Means())
        return _left_out(loads, "own", Candidate(title="own", journal=journal))

    said = told(beam=True)
    assert "clearances of N and N2" in said
    assert float(re.search(r"1/([\d.]+)", said).group(1)) > 1.05
    assert told(beam=True, self_aligning=True) == told(beam=False) == ""


def test_killed_or_not_and_on_one_or_two_processes_it_finds_the_same(cube, found, tmp_path):
    """Some of its parts gone, as of a search that was killed, and two processes instead of one."""
    shutil.copytree(found.path.parent.parent, tmp_path / "search")
    folder = tmp_path / "search" / "design" / "journal-cylindrical"
    parts = sorted((folder / "parts").glob("*.h5"))
    assert len(parts) > 4
    for part in parts[::4]:
        part.unlink()
    parts[1].write_bytes(parts[1].read_bytes()[:-200])  # cut short
    kept = {part: part.stat().st_mtime_ns for part in parts[3::2]}
    again = design(scene_of(cube), out=tmp_path, workers=2)
    assert again.designs.to_csv() == found.designs.to_csv()
    assert {part: part.stat().st_mtime_ns for part in kept} == kept


def test_margins_that_no_design_has_are_said(cube, found, tmp_path):
    shutil.copytree(found.path.parent.parent, tmp_path / "search")
    scene = scene_of(cube, margin=9.0, levels=1, generations=1, sweep=8)
    done = design(scene, out=tmp_path)
    assert done.designs.best is None
    assert not done.scene.exists()  # that of the smaller margin is gone
    assert "None of" in done.designs.conclusion
    assert math.isfinite(max(a.load_factor for a in done.designs.answers))


def test_the_candidate_is_the_scene_s_own_bearings_or_the_first(cube):
    first = scene_of(cube).model_copy(update={"design": Design()})
    assert chosen_candidate(first)[0] == "journal-cylindrical"
    shaft = {"two_point": {}, "moment": {}}
    for kind in ("journal", "rolling"):
        own = make_scene({"loads": {"files": [str(cube)]}, "shaft": shaft, kind: {}})
        assert chosen_candidate(own)[0] == f"own-{kind}"
    sized = make_scene({
        "loads": {"files": [str(cube)]}, "shaft": shaft,
        "bearings": ["journal-thrust", "two-spherical"],
    })  # fmt: skip
    assert chosen_candidate(sized)[0] == "journal-thrust"  # not the first that the package has
    wrong = first.model_copy(update={"design": Design(candidate="two-sferical")})
    with pytest.raises(InputError, match=r"did you mean two-spherical\?"):
        chosen_candidate(wrong)


def test_the_command_line_searches(cube, found, tmp_path, capsys):
    runs = tmp_path / "runs"
    shutil.copytree(found.path.parent.parent, runs / "search")
    scene = tmp_path / "search.toml"
    scene.write_text(
        f'accuracy = "given"\nloads.files = ["{cube}"]\n'
        "shaft.two_point = {}\nshaft.moment = {}\n"
        "[candidates.two-spherical]\n[design]\nsweep = 8\ngenerations = 1\npopulation = 6\n"
        "levels = 1\ncells = 3\nclasses = 3\nchecks = 1\n",
        encoding="utf-8",
    )
    keys = ["--key", "geometry.roller_length=0.11:0.16", "--key", "geometry.rollers=20:24"]
    with pytest.raises(SystemExit, match="0"):
        main(["design", str(scene), "-o", str(runs), "--workers", "1", "--json", *keys])
    said = capsys.readouterr()
    assert "searches two-spherical (two spherical" in said.err
    told = json.loads(said.out)
    keys_told = [axis["key"] for axis in told["axes"]]
    assert keys_told == ["geometry.roller_length", "geometry.rollers"]
    assert told["conclusion"]
    with pytest.raises(SystemExit, match="2"):
        main(["design", str(scene), "--key", "geometry.rollers"])


def test_a_rolling_bearing_without_other_conditions_breaks_none_in_front_and_maps():
    """Loads alone limit it: as JSON its nearest condition, which is endless, is null."""
    numbers = {"load_factor": 1.6, "energy": 12.0, "condition": None}
    designs = [
        {"numbers": numbers, "why": "", "point": [1.0, 0.1]},
        {"numbers": numbers | {"condition": 0.9}, "why": "", "point": [1.1, 0.1]},
        {"numbers": dict.fromkeys(numbers), "why": "no answer", "point": [1.2, 0.1]},
    ]
    values = {
        "load_factor": [[1.6, 1.6, None, 1.0], [1.6, 1.6, None, 1.0]],
        "condition": [[None, 0.9, None, None], [None, 1.1, None, None]],
        "energy": [[12.0, 12.0, None, 12.0], [11.0, 12.0, None, 11.0]],
    }
    data = {
        "designs": designs, "front": {"index": [0]}, "given": numbers, "best": None, "margin": 1.1,
        "axes": [{"key": key, "unit": "m", "values": None} for key in ("across", "up")],
        "maps": [
            {"keys": ("across", "up"), "values": values, "across": [0, 1, 2, 3], "up": [0, 1]}
        ],
    }  # fmt: skip
    broken, kept, *_ = front_figure(data).axes[0].collections
    at = [*map(tuple, kept.get_offsets())]
    assert at == [(1.6, 12.0)]
    assert (1.6, 12.0) in map(tuple, broken.get_offsets().filled(-1))
    assert broken_in(values, 1.1).tolist() == [
        [False, True, True, True], [False, False, True, True],
    ]  # fmt: skip
    hatched = next(one for one in map_figure(data, 0).axes[0].collections if any(one.hatches))
    [area] = hatched.get_paths()
    assert area.get_extents().x0 == pytest.approx(0.5)  # halfway to the design that breaks one


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no headless Chromium here")
def test_the_page_opens_in_a_browser(found, tmp_path):
    picture = tmp_path / "page.png"
    done = subprocess.run(
        [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
         f"--user-data-dir={tmp_path / 'profile'}", f"--screenshot={picture}",
         "--window-size=1200,1600", found.page.absolute().as_uri()],
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert done.returncode == 0
    assert picture.stat().st_size > 20_000
    assert "CONSOLE" not in done.stderr
