"""Every key of every class of a scene does something, or the scene says why it does not.

The walk takes each value that a scene holds, down to the last part of a table, puts another legal
one in its place and runs what reads the section. The numbers change, or `unused_keys` names the
key, or the scene is refused with its name. Which classes and keys there are says the scene's own
JSON schema: one that no walk reaches fails here.
"""

import re

import pytest
from walk_readers import FOUND, fingerprints
from walk_scenes import BASES, OPTIONAL, OTHERS, WALKED, WHOLE, files

from loadflow.errors import InputError, LoadflowError
from loadflow.journal.cavitation import LAWS
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.schema import json_schema
from loadflow.scene.section import keys_of, parts_of
from loadflow.scene.unused import unused_keys


def others(name, words, section, path, value, table):
    """Yield other values for a key, likely legal ones first."""
    path = (section, *path)
    key = ".".join(map(str, path))
    yield from OTHERS.get(key, ())
    yield from OTHERS.get(f"….{path[-1]}", ())
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + 1, value - 1, 2 * value)
    elif isinstance(value, float):
        yield from (1.1 * value, 0.9 * value, value + 0.01, value + 1e-5, 1.5 * value, 0.1 * value)
    elif isinstance(value, list) and value and isinstance(value[0], int | float):
        yield [1.1 * x for x in value]
    elif value is None:
        yield from OPTIONAL
    elif isinstance(value, str):
        yield from literals(name, words, section, path[1:], table)


def literals(name, words, section, path, table):
    """Yield what an error message says is allowed."""
    try:
        scene_with(name, words, section, path, "nothing", table)
    except InputError as error:
        said = str(error)
        yield from re.findall(r"'([^']+)'", said.split("must be", 1)[-1])


def leaves(value, path=()):
    """Yield path and value of everything that a table holds."""
    if isinstance(value, dict) and value:
        for name, part in value.items():
            yield from leaves(part, (*path, name))
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for k, part in enumerate(value):
            yield from leaves(part, (*path, k))
    else:
        yield path, value


def changed(data, path, value):
    """Return a copy of nested tables with one value in its place."""
    if not path:
        return value
    first, *rest = path
    if isinstance(first, int):
        return [changed(p, rest, value) if k == first else p for k, p in enumerate(data)]
    inner = data.get(first, {}) if isinstance(data, dict) else {}
    return dict(data or {}) | {first: changed(inner, rest, value)}


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    """Files of the scenes by the words that stand for them."""
    return files(tmp_path_factory.mktemp("walk"))


def filled(part, words):
    if isinstance(part, dict):
        return {name: filled(one, words) for name, one in part.items()}
    if isinstance(part, list):
        return [filled(one, words) for one in part]
    return words.get(part, part) if isinstance(part, str) else part


def scene_of(data, words):
    return make_scene({"name": "walk"} | filled(data, words))


def walked(name, words, parts):
    """What is walked over of a scene: path, value and the scene's section as plain data."""
    scene = scene_of(BASES[name], words)
    for where in parts:
        section, *inside = where.split(".")
        table = scene.model_dump(mode="json", include={section})[section]
        for path, value in leaves(table):
            if [*map(str, path)][: len(inside)] == inside:
                yield section, path, value, table


CONFLICT = (
    "leave", "set ", "takes the place", "follows from", "give ", "missing", "unknown key",
    "and only it, takes", "; only", "keep one", "for a circle", "not given with", "for slewing",
    "and only to it", "left out where", "where a profile is given", "where shell_modulus is",
    "of a scene have one", "None with capacity", "takes no moment has none",
    "has changed since", "must have one row", "for a whole ring", "do not know it", "None with a ",
    "is not allowed: \"grid\" for",
    "is not allowed: \"map\" or \"grid\" for",
)  # fmt: skip
"""Words with which a scene is refused that says two things which do not go together."""


def scene_with(name, words, section, path, value, table):
    """The scene with another value of a key."""
    base = BASES[name]
    first, *rest = path
    part = changed(table[first], rest, filled(value, words))
    if "bearings" in base:  # places, whose sections stand beside each other
        base = scene_of(base, words).model_dump(mode="json", exclude_none=True)
        data = base | {section: table | {first: part}}
    else:
        data = base | {section: base.get(section, {}) | {first: part}}
    return scene_of(data, words)


def outcome(name, words, section, path, value, table):
    """What happens when a key has another value: "refused", "told", "changed", "illegal" or ""."""
    key = ".".join(map(str, (section, *path)))
    try:
        scene = scene_with(name, words, section, path, value, table)
    except InputError as error:
        named = any(str(part) in str(error) for part in (path[0], path[-1]))
        known = section in str(error) and named
        known |= "rung = " in str(error)  # names the rung, and what it does not know
        return "refused" if known and any(w in str(error) for w in CONFLICT) else "illegal"
    if any(key == known or key.startswith(f"{known}.") for known in unused_keys(scene)):
        return "told"
    before = known_of(name, words, section)
    try:
        return "changed" if any(new != old for new, old in pairs(scene, section, before)) else ""
    except LoadflowError:
        return "changed"  # with a message of its own


def pairs(scene, section, before):
    """Fingerprints of a scene, each beside that of the scene it was made of."""
    for k, new in enumerate(fingerprints(scene, section)):
        yield new, before.at(k)


class Trail:
    """Fingerprints of a scene, as far as they were asked for."""

    def __init__(self, scene, section):
        self._more, self._known = fingerprints(scene, section), []

    def at(self, k):
        while len(self._known) <= k:
            self._known.append(next(self._more, None))
        return self._known[k]


_TRAILS = {}


def known_of(name, words, section):
    key = repr((BASES[name], section))
    if key not in _TRAILS:
        _TRAILS[key] = trail = Trail(scene_of(BASES[name], words), section)
        trail.at(0)
    return _TRAILS[key]


LONG = {
    "pair of cones", "worn bores, deep", "housing on a flange", "housing on feet",
    "heat over the film", "thrust steps",
}  # fmt: skip
"""Scenes of which each key costs a film in space, heat over its area, or wear of many years."""

TEXT = {"name", "source", "thickener", "sha256", "title", "form"}
"""Keys that say what something is, for readers and pages, or what a matrix in a file is."""

ALONE = {
    "journal.contact", "journal.shell", "rolling.outer_ring.sectors",
    "rolling.roller_model", "rolling.inertia",
    "rolling.geometry.rows", "rolling.further.0.geometry.rows", "rolling.further.0.inertia",
    "rolling.geometry.contact_angle",
}  # fmt: skip
"""Keys of which no other value goes with the scene: barrels in one row have no contact angle,
toroidal ones have one row,
asperities on a shell that gives way have no model on the rung, a ring in space costs minutes
(`tests/rolling/test_ring_fem.py`), balls have no slices, and rollers no
inertia that counts (`tests/rolling/test_elements_in_scenes.py` shows what these two change)."""


SHOWN_ELSEWHERE = {"design.crown.exponent"}
"""Where no crown is the best one, its form does not count (`tests/journal/test_crowning.py`)."""


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        *(pytest.param(n, WALKED[n], marks=[pytest.mark.slow] * (n in LONG), id=n) for n in BASES),
        *(pytest.param(n, WHOLE[n], marks=pytest.mark.slow, id=f"{n}, whole") for n in WHOLE),
    ],
)
def test_every_key_does_something_or_is_told(name, parts, words):
    silent, stuck = [], []
    for section, path, value, table in walked(name, words, parts):
        if path[-1] in TEXT or ".".join(map(str, (section, *path))) in SHOWN_ELSEWHERE:
            continue
        tried = []
        for other in others(name, words, section, path, value, table):
            if other == value:
                continue
            tried.append(outcome(name, words, section, path, other, table))
            if tried[-1] in ("refused", "told", "changed"):
                break
        else:
            (silent if "" in tried else stuck).append(".".join(map(str, (section, *path))))
    assert silent == []
    # a kind says which other keys a table has; each kind stands in a scene
    assert {key for key in stuck if not key.endswith(".kind")} <= ALONE


def ways(scene, section, path):
    """Classes of a scene, each with that key of it that leads to a leaf."""
    parts = {(section, *keys): part for keys, part in parts_of(getattr(scene, section))}
    for size in range(1, len(path) + 1):
        owner = parts.get((section, *path[: size - 1]))
        if owner is not None:
            yield type(owner).__name__, path[size - 1]


AGAIN = {("Candidate", room) for room in ("journal", "rolling", "thrust")} | {("Turbine", "file")}
"""Sections that are walked by themselves, and a file that stands in place of a name."""


def test_the_walk_reaches_every_key_of_every_class_of_the_schema(words):
    reached = set()
    for name in BASES:
        scene = scene_of(BASES[name], words)
        for section, path, *_ in walked(name, words, WALKED[name]):
            reached.update(ways(scene, section, path))
    classes = json_schema()["$defs"]
    forms = {name for name in classes if name.endswith("Place")} | {"Bearing", "Toleranced"}
    wanted = {
        (name, key)
        for name, part in classes.items()
        if name not in forms
        for key in part["properties"]
    }
    wanted |= {(law.__name__, key) for law in LAWS.values() for key in keys_of(law)}
    assert wanted - reached - AGAIN == set()
    # what stands in [bearings.PLACE] has the keys of the sections
    sections = ("Journal", "FurtherBearing", "ThrustCollar", "ConePair", "Thrust")
    known = {key for name in sections for key in classes[name]["properties"]} | {"kind", "like"}
    for name in forms - {"Toleranced"}:
        assert {*classes[name].get("properties", {})} <= known, name


def test_every_section_is_walked():
    walked = {where.split(".")[0] for walks in WALKED.values() for where in walks}
    assert walked | {"name", "results", "accuracy"} == set(Scene.model_fields)
    assert walked == set(FOUND)


def test_name_results_and_accuracy_change_the_plan(words):
    base = BASES["tables"]
    plan = make_plan(scene_of(base, words))
    fewer = make_plan(scene_of(base | {"results": ["loads.statistics"]}, words))
    finer = make_plan(scene_of(base | {"accuracy": 0.01}, words))
    assert len(fewer.steps) < len(plan.steps)
    assert finer.steps[-1].digest != plan.steps[-1].digest
