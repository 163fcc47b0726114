"""Every key of every section of a scene does something, or the scene says why it does not.

The walk takes each value that a scene holds, down to the last part of a table, puts another legal
one in its place and runs what reads the section. The numbers change, or `unused_keys` names the
key, or the scene is refused with its name.
"""

import hashlib
import re

import numpy as np
import pytest
import xarray as xr
from synthetic import case, cube_file

from loadflow.errors import InputError, LoadflowError
from loadflow.planning.plan import make_plan
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages import (
    dynamics,
    friction,
    journal,
    loads,
    reduction,
    rolling,
    seeds,
    shaft,
    thrust,
    wear,
)
from loadflow.studies.run_lifetime import run_lifetime
from loadflow.studies.verdicts import verdicts

WIND = {"wind_speeds": [12.0, 14.0], "duration": 3.0, "step": 0.1}
BALLS = {"balls": 60, "rows": 1, "ball_diameter": 0.06, "pitch_diameter": 2.0,
         "groove_radius": 0.0312, "contact_angle": 0.8, "shoulder_angle": 1.2}  # fmt: skip
FILM = {"grid": [24, 8], "bearings": ["N"]}
FEW = {"size": 0.03, "classes": 2}  # samples; some touch, some have a film

BASES = {
    "turbulence": {"loads": WIND | {"seeds": 1, "rung": "flap"}},
    "gust": {"loads": WIND | {"dlc": "1.5", "rung": "flap"}},
    "tables": {"loads": WIND | {"seeds": 1, "rung": "tables"}},
    "stop": {"loads": WIND | {"dlc": "4.1", "rung": "tables"}},
    "parked": {"loads": {"dlc": "6.1", "seeds": 1, "duration": 3.0, "step": 0.1}},
    "class S": {
        "loads": WIND | {"seeds": 1, "rung": "tables", "wind_class": "S", "v_ref": 45.0,
                         "v_ave": 9.0, "category": "S", "reference_intensity": 0.15},
    },
    "files": {"loads": {"source": "files", "files": ["CUBE"]}},
    "bearings": {
        "shaft": {"two_point": {}, "moment": {}},
        "journal": FILM | {"supply": {"grooves": [{"angle": 1.57, "arc": 0.2, "length": 1.5,
                                                   "pressure": 6e5}]}},
        "rolling": {"bearing": "M", "geometry": BALLS}, "reduction": FEW,
    },
    "warm film": {"journal": FILM | {"heat": {"transfer": 100.0}}, "reduction": FEW},
    "cold": {
        "loads": WIND | {"seeds": 1, "rung": "tables"}, "environment": {"temperature": 263.15},
        "journal": FILM | {"heat": {"transfer": 100.0}}, "reduction": FEW,
        "results": ["journal.film", "rolling.friction"],
    },
    "rough film": {
        "journal": FILM | {"contact": {"pattern": 3.0, "asperities": {
            "roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}}},
        "reduction": FEW,
    },
    "elastic film": {
        "journal": FILM | {"shell": {"kind": "local", "compliance": 1e-12}}, "reduction": FEW,
    },
    "turbulent film": {
        "journal": FILM | {"turbulence": {"begin": 0.002, "end": 0.1}}, "reduction": FEW,
    },
    "film in motion": {
        "journal": FILM | {"motion": "transient", "rung": "reduced"},
        "results": ["journal.film"],
    },
    "periodic loads": {
        "journal": FILM, "reduction": {"method": "periodic", "bounds": [0.05, 0.3]},
    },
    "stationary loads": {"journal": FILM, "reduction": {"method": "stationary"}},
    "tilted film": {
        "journal": FILM | {"tilt": True}, "shaft": {"two_point": {"beam": {}}}, "reduction": FEW,
    },
    "rotor dynamics": {"journal": FILM, "shaft": {"two_point": {"beam": {}}},
                       "dynamics": {"unbalance": 50.0}, "results": ["journal.dynamics"]},
    "rotor dynamics, rigid": {"journal": FILM, "shaft": {"two_point": {}},
                              "results": ["journal.dynamics"]},
    "rigid and tilted": {
        "journal": FILM | {"tilt": True}, "shaft": {"two_point": {}}, "reduction": FEW,
    },
    "worn bores": {
        "journal": FILM | {"contact": {"asperities": {
            "roughness": 2e-6, "contact_modulus": 1e11, "factor": 1e-3}}},
        "reduction": {"size": 0.5}, "results": ["journal.film", "journal.wear"],
        "wear": {"law": {"coefficient": 1e-13}, "samples": 12, "around": 90, "running_in": {
            "initial_roughness": 2e-6, "final_roughness": 1.8e-6, "depth": 1e-6}},
    },
    "tapered rollers": {
        "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 44, "roller_diameter": 0.07, "roller_length": 0.12,
            "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25, "contact_angle": 0.35,
            "clearance": -5e-5}, "rings": "flexible", "outer_ring": {
            "section": {"width": 0.1, "height": 0.3}, "radius": 0.7}},
        "friction": {"conductance": 50.0},
    },
    "mounted rollers": {
        "environment": {"temperature": 263.15}, "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 44, "roller_diameter": 0.07, "roller_length": 0.12,
            "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25, "contact_angle": 0.35,
            "clearance": 1e-4}, "mounting": {
            "inner_share": 1.1, "bore": 1.0, "outside": 1.4, "inner_interference": 2e-4,
            "outer_interference": 1e-4, "shaft_bore": 0.5, "housing_outside": 2.0}},
        "reduction": FEW, "friction": {"conductance": 50.0}, "results": ["rolling.life"],
    },
    "mounted rollers, loose": {
        "loads": WIND | {"seeds": 1, "rung": "tables"},
        "environment": {"temperature": 263.15}, "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 44, "roller_diameter": 0.07, "roller_length": 0.12,
            "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25, "contact_angle": 0.35,
            "clearance": 1e-4}, "mounting": {"inner_temperature": 300.0, "outer_share": 1.1}},
        "reduction": FEW, "results": ["rolling.life"],
    },
    "thrust collar": {
        "shaft": {"two_point": {}}, "results": ["thrust.film"],
        "reduction": {"size": 0.02, "classes": 2},
        "thrust": {"bearings": {"N2": {"kind": "thrust", "grid": [12, 6], "geometry": {
            "pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7,
            "taper": 1e-4}}}},
    },
    "pair of cones": {
        "shaft": {"moment": {}}, "results": ["thrust.film"],
        "reduction": {"size": 0.02, "classes": 2},
        "thrust": {"bearings": {"M": {"kind": "conical-pair", "grid": [8, 4],
            "lubricant": {"viscosity": 0.2}, "geometry": {"distance": 3.2, "left": {
                "half_angle": 0.5, "slant": [1.59, 2.59], "clearance": 2e-4, "pads": 3,
                "pad_angle": 1.9, "profile": {"kind": "taper", "taper": 8e-5}}}}}},
    },
    "three points": {"shaft": {"three_point": {}}, "journal": FILM},
    "integrated": {"shaft": {"integrated": {}}, "journal": FILM},
    "yaw": {
        "shaft": {"two_point": {}, "yaw": {}}, "results": ["rolling.life"],
        "rolling": {"bearing": "Y", "geometry": BALLS, "oscillation": {
            "amplitude": 0.5, "frequency": 0.01, "idle_torque": 10.0}},
    },
    "pitch": {
        "shaft": {"two_point": {}, "pitch": {}}, "results": ["rolling.life"],
        "rolling": {"bearing": "P", "geometry": BALLS, "oscillation": {
            "kind": "pitch", "idle_torque": 10.0}},
    },
    "direct drive": {"shaft": {"direct_drive": {}}, "journal": FILM},
}  # fmt: skip

BASES["worn bores, events counted"] = BASES["worn bores"] | {
    "loads": {"dlc": ["1.2", "3.1"]}, "lifetime": {"per_year": {"3.1": 1e3}},
}  # fmt: skip

READERS = {
    "turbulence": ("loads", "turbine"),
    "gust": ("loads",),
    "tables": ("loads",),
    "stop": ("loads",),
    "parked": ("loads",),
    "class S": ("loads",),
    "files": ("loads", "seeds", "reduction"),
    "bearings": ("shaft", "journal", "rolling", "friction"),
    "warm film": ("journal",),
    "cold": ("environment",),
    "rough film": ("journal",),
    "elastic film": ("journal",),
    "turbulent film": ("journal",),
    "film in motion": ("journal", "reduction"),
    "periodic loads": ("reduction",),
    "stationary loads": ("reduction",),
    "tilted film": ("shaft", "journal"),
    "rotor dynamics": ("dynamics",),
    "rotor dynamics, rigid": ("dynamics",),
    "rigid and tilted": ("journal",),
    "worn bores": ("wear",),
    "worn bores, events counted": ("lifetime",),
    "tapered rollers": ("rolling", "friction"),
    "mounted rollers": ("rolling",),
    "mounted rollers, loose": ("rolling", "environment"),
    "thrust collar": ("thrust",),
    "pair of cones": ("thrust",),
    "three points": ("shaft",),
    "integrated": ("shaft",),
    "yaw": ("shaft", "rolling"),
    "pitch": ("shaft", "rolling"),
    "direct drive": ("shaft",),
}
"""Sections that are walked over in each scene; the first five have the loads in every guise."""

OTHERS = {
    "turbine.name": ["iea-15mw"],
    "loads.files": [["OTHER"]],
    "seeds.alpha": [0.99],
    "seeds.methods": [["calibrated"]],
    "loads.rung": ["bem", "flap"],
    "loads.wind_class": ["II"],
    "friction.step": [0.5],
    "loads.winds": [["none.bts"]],
    "loads.cases": ["none.csv"],
    "loads.channels": [{"speed": ["RotSpeed"]}],
    "loads.gauge_distance": [1.5],
    "loads.frame": ["fixed", "rotating"],
    "journal.cavitation.kind": ["mass-conserving", "reynolds"],
    "journal.rung": ["reduced", "map"],
    "loads.pattern": [r"v(?P<wind_speed>\d+)"],
    "loads.dlc": ["1.3", "6.4"],
    "loads.wind_speeds": [[14.0], [60.0]],
    "loads.azimuths": [[1.0], [1.0, 2.0]],
    "loads.yaw_errors": [[0.2]],
    "loads.wind_grid": [[9, 36]],
    "friction.lubricant": ["lgwm-2"],
    "friction.cleanliness": ["grease, severe contamination"],
    "journal.bearings": [["N2"], ["N", "N2"]],
    "journal.alignment": [[2e-5, 0.0]],
    "journal.grid": [[36, 12]],
    "journal.supply": [{"grooves": [{"angle": 1.0, "arc": 0.2, "pressure": 6e5}]}],
    "journal.heat": [{"oil": "mineral-vg-320"}],
    "journal.heat.growth": [{"shell_expansion": 12e-6}],
    "journal.heat.oil": ["mineral-vg-460", "iso-vg-68"],
    "journal.contact": [
        {"asperities": {"roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}}
    ],
    "journal.contact.friction": [0.3, "bronze"],
    "journal.turbulence": [{"begin": 0.0, "end": 0.0}],
    "journal.shell": [{"kind": "local", "compliance": 1e-12}],
    "journal.limits.sommerfeld_range": [[0.5, 5.0]],
    "journal.limits.material": [[[400.0, 5e6]]],
    "shaft.two_point": [{"span": 3.0}],
    "shaft.three_point": [{}],
    "shaft.integrated": [{}],
    "shaft.direct_drive": [{}],
    "shaft.moment": [{}],
    "shaft.yaw": [{}],
    "shaft.pitch": [{}],
    "rolling.oscillation": [{"amplitude": 0.1, "frequency": 0.1}],
    "rolling.oscillation.mounting": ["pitch", "yaw, four-leg tower"],
    "shaft.two_point.beam": [{}],
    "shaft.two_point.beam.supports": [[{"radial": 1e9}, {}]],
    "shaft.three_point.beam": [{}],
    "shaft.integrated.beam": [{}],
    "shaft.direct_drive.beam": [{}],
    "shaft.moment.beam": [{}],
    "journal.geometry.relief": [[{"kind": "crown", "height": 2e-5}]],
    "journal.supply.grooves.0.shape": ["circle"],
    "journal.supply.grooves.0.restrictor": [{"diameter": 0.004, "length": 0.05}],
    "journal.supply.pump": [{"flow": [0.0, 0.01], "pressure": [8e5, 2e5]}],
    "dynamics.speed_range": [[0.8, 1.6]],
    "wear.running_in.initial_roughness": [1.0000001e-6],
    "thrust.rung": ["curve"],
    "thrust.bearings.N2.geometry.profile": [{"kind": "step", "height": 1e-4}],
    "thrust.bearings.N2.geometry.pivot": [{"share": 0.6}],
    "thrust.bearings.N2.geometry.first_pad": [0.1],
    "thrust.bearings.N2.back": [
        {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.3, "pad_angle": 0.7, "taper": 1e-4}
    ],
    "thrust.bearings.N2.grid": [[16, 8]],
    "thrust.bearings.M.grid": [[12, 6]],
    "thrust.bearings.N2.cavitation.kind": ["gas-mixture"],
    "thrust.bearings.M.cavitation.kind": ["gas-mixture"],
    "thrust.bearings.N2.cavitation.cavitation_pressure": [2e5],
    "thrust.bearings.M.cavitation.cavitation_pressure": [9.9e4],
    "thrust.bearings.N2.limits.material": [[[400.0, 5e6]]],
    "thrust.bearings.M.limits.material": [[[400.0, 5e6]]],
    "thrust.bearings.M.geometry.arrangement": ["X"],
    "thrust.bearings.M.geometry.clearance": [2.5e-4],
    "reduction.method": ["stationary", "histogram"],
    "reduction.bounds": [[0.02, 0.2]],
    "reduction.orders": [[1.0]],
    "rolling.geometry.profile": ["straight"],
    "rolling.geometry.crown_radius": [18.0],
    "rolling.geometry.law": ["palmgren"],
    "rolling.geometry.arrangement": ["face-to-face"],
    "rolling.geometry.kind": ["ball", "roller"],
    "rolling.further": [[{"bearing": "N", "geometry": BALLS}]],
    "rolling.bearing": ["N2", "N"],
    "rolling.inner_ring": [
        {"section": {"width": 0.1, "height": 0.15}, "radius": 0.9},
        {"section": {"width": 0.1, "height": 0.3}, "radius": 0.5},
        {"section": {"width": 0.07, "height": 0.3}, "radius": 0.535},
    ],
    "rolling.mounting": [{"inner_share": 1.2}],
    "rolling.mounting.row_distance": ["seats"],
    "rolling.mounting.inner_temperature": [290.0],
    "rolling.mounting.outer_temperature": [310.0],
    "rolling.mounting.shaft_temperature": [310.0],
    "rolling.mounting.housing_temperature": [310.0],
    "rolling.mounting.inner_interference": [1e-4],
    "rolling.mounting.outer_interference": [5e-5],
    "rolling.mounting.bore": [0.95],
    "rolling.mounting.outside": [1.5],
    "rolling.mounting.shaft_bore": [0.1],
    "rolling.mounting.housing_outside": [2.5],
    "rolling.outer_ring.supports": [
        [{"radius": 0.7, "height": -0.15, "thickness": 0.05, "length": 0.3}],
    ],
    "rolling.outer_ring": [
        {"section": {"width": 0.1, "height": 0.15}, "radius": 1.1},
        {"section": {"width": 0.07, "height": 0.3}, "radius": 0.665},
    ],
}
"""Values that no rule finds: names, files, tables."""

OPTIONAL = (0.3, 2e-5, 3.0, 380.0, 1e6, 2, "graded", True)
"""Tried for a key that has no value yet."""


def others(path, value):
    """Yield other values for a key, likely legal ones first."""
    yield from OTHERS.get(".".join(map(str, path)), ())
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + 1, value - 1, 2 * value)
    elif isinstance(value, float):
        yield from (1.1 * value, 0.9 * value, value + 0.01, value + 1e-5, 1.5 * value)
    elif isinstance(value, list) and value and isinstance(value[0], int | float):
        yield [1.1 * x for x in value]
    elif value is None:
        yield from OPTIONAL
    elif isinstance(value, str):
        yield from literals(path)


def literals(path):
    """Yield what an error message says is allowed."""
    try:
        make_scene(changed({"name": "x"}, path, "nothing"))
    except InputError as error:
        said = str(error)
        yield from re.findall(r"'([^']+)'", said.split("must be", 1)[-1])


def leaves(value, path=()):
    """Yield path and value of everything that a table holds."""
    if isinstance(value, dict):
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
def place(tmp_path_factory):
    tmp = tmp_path_factory.mktemp("walk")
    cube_file(tmp / "loads.h5", wind_speeds=(8.0, 9.0), seeds=(1, 2), steps=200)
    cube_file(tmp / "other.h5", wind_speeds=(10.0, 11.0), seeds=(1, 2), steps=200)
    return tmp


def scene_of(data, place):
    text = {"CUBE": str(place / "loads.h5"), "OTHER": str(place / "other.h5")}

    def filled(part):
        if isinstance(part, dict):
            return {name: filled(one) for name, one in part.items()}
        if isinstance(part, list):
            return [filled(one) for one in part]
        return text.get(part, part) if isinstance(part, str) else part

    return make_scene({"name": "walk"} | filled(data))


def with_blade(hub):
    """A series with the loads of blade 1 at its root, which is pitched."""
    turn = np.linspace(0.0, 12.0, hub.sizes["time"])
    still = np.zeros_like(turn)
    force = np.stack([6e5 - 1.7e5 * np.cos(turn), 1.5e5 + still, -1.7e5 * np.sin(turn)])
    moment = np.stack([still, 1.2e6 + 3.5e6 * np.sin(turn), 5e6 + 4e5 * np.cos(turn)])
    vectors = {"root_force": force, "root_moment": moment}
    found = {name: (("axis", "time"), values) for name, values in vectors.items()}
    return hub.assign(found | {"pitch": ("time", 0.0009 * np.sin(2 * turn) + 0.02 * np.sin(turn))})


HUB = case(8.0, 1, steps=120)
HUB["speed"][:20] = np.linspace(0.0, 0.012, 20)  # the surfaces touch at first
HUB = with_blade(HUB)


def numbers(scene, section):
    """Everything that the stages which read a section give for it, as one fingerprint."""
    print_ = hashlib.sha256()

    def add(data):
        nodes = data.subtree if isinstance(data, xr.DataTree) else [data]
        for node in nodes:
            for name in sorted(map(str, node.data_vars)):
                print_.update(name.encode() + np.ascontiguousarray(node[name].values).tobytes())
            print_.update(repr(sorted(node.attrs.items())).encode())

    print_.update(repr([(c.name, c.weight) for c in FOUND[section](scene, add) or ()]).encode())
    return print_.hexdigest()


def _loads(scene, add):
    cases = list_cases(scene)
    add(loads.hub_loads(scene, cases[0], {}))
    return cases


def _shaft(scene, add):
    found = shaft.bearing_loads(scene, None, {"loads": HUB})
    add(found)
    return found


def _inputs(scene):
    found = shaft.bearing_loads(scene, None, {"loads": HUB})
    series = {"loads": HUB, "shaft": found}
    return series | {"reduction": reduction.reduced_loads(scene, ONE, series)}


class _One:
    dlc, wind_speed, seed, weight, name = "1.1", 8.0, 1, 1.0, "dlc1.1_v8_s1"
    duration = 600.0


ONE = _One()


def _judge(scene, add, stage, tree):
    table = stage.summary({ONE: tree})
    add(table)
    name = stage.__name__.rpartition(".")[2]
    lifetime = run_lifetime(scene, {name: table})
    for verdict in verdicts(scene, {name: table}, lifetime):
        add(xr.Dataset({"said": ((), verdict.sentence)}))


def _journal(scene, add):
    solve = journal.orbit if scene.journal.in_motion else journal.film
    tree = solve(scene, ONE, _inputs(scene))
    add(tree)
    _judge(scene, add, journal, tree)


def _rolling(scene, add):
    from loadflow.planning.choice import finer

    inputs = _inputs(scene)
    # with the effect of the rings on, too, as the run's own check has it
    for one in filter(None, (scene, finer(scene, "elastic rings"))):
        found = rolling.load_distribution(one, ONE, inputs)
        add(found)
        _judge(scene, add, rolling, found)


def _thrust(scene, add):
    tree = thrust.films(scene, ONE, _inputs(scene))
    add(tree)
    _judge(scene, add, thrust, tree)


def _friction(scene, add):
    inputs = _inputs(scene)
    add(friction.losses(scene, ONE, inputs))
    add(rolling.load_distribution(scene, ONE, inputs))


def _dynamics(scene, add):
    tree = dynamics.dynamics(scene, ONE, _inputs(scene))
    add(tree)
    add(dynamics.summary({ONE: tree}))


class _Start(_One):
    dlc, weight, name = "3.1", 1.0, "dlc3.1_v8_s1"


_FILMS = {}


def _wear(scene, add):
    if (key := repr(scene.journal)) not in _FILMS:  # keys of wear do not change the films
        inputs = _inputs(scene)
        _FILMS[key] = inputs | {"journal": journal.film(scene, ONE, inputs)}
    add(wear.wear(scene, [_Start()], {_Start.name: _FILMS[key]}))


def _environment(scene, add):
    _loads(scene, add)
    if scene.wants("journal"):
        _journal(scene, add)
    if "rolling.life" in scene.results:
        _rolling(scene, add)


def _reduction(scene, add):
    if scene.journal.in_motion:
        _journal(scene, add)
    else:
        add(_inputs(scene)["reduction"])


def _seeds(scene, add):
    cases = list_cases(scene)
    inputs = {}
    for one in cases:
        hub = loads.hub_loads(scene, one, {})
        inputs[one.name] = {
            "loads": hub, "shaft": shaft.bearing_loads(scene, one, {"loads": hub}),
        }  # fmt: skip
    found = [seeds.groups_in(scene, piece, inputs) for piece in seeds.pieces(scene, cases)]
    add(seeds.joined(scene, found))


FOUND = {
    "loads": _loads, "turbine": _loads, "shaft": lambda s, add: _shaft(s, add) and None,
    "seeds": _seeds, "reduction": _reduction, "journal": _journal, "rolling": _rolling,
    "friction": _friction, "dynamics": _dynamics, "wear": _wear, "lifetime": _wear,
    "thrust": _thrust,
    "environment": _environment,
}  # fmt: skip


CONFLICT = (
    "leave", "set ", "takes the place", "follows from", "give ", "missing", "unknown key",
    "and only it, takes", "; only", "keep one", "for a circle", "not given with", "for slewing",
    "and only to it",
    "is not allowed: \"grid\" for",
    "is not allowed: \"map\" or \"grid\" for",
)  # fmt: skip
"""Words with which a scene is refused that says two things which do not go together."""


def outcome(base, place, section, path, value):
    """What happens when a key has another value: "refused", "told", "changed", "illegal" or ""."""
    first, *rest = path
    table = getattr(scene_of(base, place), section).model_dump(mode="json")
    part = changed(table[first], rest, value)
    data = base | {section: base.get(section, {}) | {first: part}}
    key = ".".join(map(str, (section, *path)))
    try:
        scene = scene_of(data, place)
    except InputError as error:
        known = section in str(error) and any(str(part) in str(error) for part in (first, path[-1]))
        known |= "rung = " in str(error)  # names the rung, and what it does not know
        return "refused" if known and any(w in str(error) for w in CONFLICT) else "illegal"
    if any(key == known or key.startswith(f"{known}.") for known in unused_keys(scene)):
        return "told"
    try:
        return "changed" if numbers(scene, section) != before(place, base, section) else ""
    except LoadflowError:
        return "changed"  # with a message of its own


_BEFORE = {}


def before(place, base, section):
    key = repr((base, section))
    if key not in _BEFORE:
        _BEFORE[key] = numbers(scene_of(base, place), section)
    return _BEFORE[key]


ALONE = {"heat.kind", "oscillation.kind", "contact", "shell", "roller_model", "inertia"} | {
    f"bearings.{key}"
    for key in (
        "N2.kind",
        "N2.geometry.profile",
        "M.kind",
        *(
            f"M.geometry.{side}.{key}"
            for side in ("left", "right")
            for key in ("profile.kind", "pivot")
        ),
    )
}
"""Keys of which no other value goes with the scene: a kind says which other keys a table has,
asperities on a shell that gives way have no model on the rung, pads with lands neither tilt nor
have a second profile, balls have no slices, and rollers no inertia that counts
(`tests/rolling/test_elements_in_scenes.py` shows what these two change)."""

WALKS = [(name, section) for name, sections in READERS.items() for section in sections]


@pytest.mark.parametrize(("name", "section"), WALKS)
def test_every_key_of_a_section_does_something_or_is_told(name, section, place):
    base = BASES[name]
    table = getattr(scene_of(base, place), section).model_dump(mode="json")
    silent, stuck = [], []
    for path, value in leaves(table):
        tried = []
        for other in others((section, *path), value):
            tried.append(outcome(base, place, section, path, other))
            if tried[-1] in ("refused", "told", "changed"):
                break
        else:
            (silent if "" in tried else stuck).append(".".join(map(str, path)))
    assert silent == []
    assert set(stuck) <= ALONE


def test_the_walk_goes_through_every_section():
    walked = {section for _, section in WALKS}
    # candidates are bearings again, and the design a search among them, for other commands
    others = {"name", "results", "accuracy", "candidates", "design", "as_built"}
    others.add("tolerances")  # by place and key; they have tests of their own
    assert walked | others == set(Scene.model_fields)


def test_name_results_and_accuracy_change_the_plan(place):
    base = BASES["tables"]
    plan = make_plan(scene_of(base, place))
    fewer = make_plan(scene_of(base | {"results": ["loads.statistics"]}, place))
    finer = make_plan(scene_of(base | {"accuracy": 0.01}, place))
    assert len(fewer.steps) < len(plan.steps)
    assert finer.steps[-1].digest != plan.steps[-1].digest
