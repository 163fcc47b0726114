"""Tolerances of a scene's values: how they are stated, what they move, and what governs."""

import tomllib

import numpy as np
import pytest
import xarray as xr
from synthetic import case

from loadflow.errors import InputError
from loadflow.planning.budget import Answer
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene
from loadflow.scene.schema import json_schema
from loadflow.stages import shaft, tolerances
from loadflow.stages.films.of_bearing import shaft_line
from loadflow.studies.tolerances import Band, band_of
from loadflow.tribology import lubricant

FILM = {
    "kind": "journal", "grid": [24, 8], "lubricant": {"viscosity": 0.05},
    "geometry": {"diameter": 3.0, "width": 2.25, "relative_clearance": 5e-4},
}  # fmt: skip
CLEARANCE = "geometry.relative_clearance"


def _scene(**parts):
    usual = {"name": "look", "accuracy": "given", "results": ["journal.film"]}
    shaft = {"two_point": {"beam": {}}}
    return make_scene(usual | {"shaft": shaft, "bearings": {"N": FILM, "N2": FILM}} | parts)


def _with(clearance, **more):
    return FILM | {"geometry": FILM["geometry"] | {"relative_clearance": clearance}} | more


def test_a_value_with_its_tolerance_is_that_value_and_a_section_says_the_same():
    stated = {"value": 5e-4, "tolerance": 1e-4}
    beside = _scene(bearings={"N": _with(stated), "N2": FILM})
    assert beside == _scene(tolerances={"N": {CLEARANCE: 1e-4}})
    assert beside.journal.at("N").geometry.relative_clearance == 5e-4
    assert make_scene(tomllib.loads(beside.to_toml())) == beside


def test_editors_know_values_with_a_tolerance():
    parts = json_schema()["$defs"]
    also = {"$ref": "#/$defs/Toleranced"}
    for part, key in (("JournalBearing", "relative_clearance"), ("JournalPlace", "shell_roughness"),
                      ("Heat", "oil"), ("RollerBearing", "clearance")):  # fmt: skip
        assert also in parts[part]["properties"][key]["anyOf"]
    _, turned = parts["JournalPlace"]["properties"]["alignment"]["anyOf"]
    assert also in turned["prefixItems"][0]["anyOf"]


def test_like_another_place_has_its_tolerances_except_of_what_it_states():
    other = {"like": "N", "lubricant": {"viscosity": 0.06}}
    model = _with({"value": 5e-4, "tolerance": 1e-4}) | {
        "lubricant": {"viscosity": {"value": 0.05, "tolerance": 0.004}}
    }
    scene = _scene(bearings={"N": model, "N2": other})
    assert scene.tolerances["N2"] == {CLEARANCE: 1e-4}
    assert {*scene.tolerances["N"]} == {CLEARANCE, "lubricant.viscosity"}


def test_ends_of_a_band_are_those_of_the_bearings_that_have_it_alone():
    scene = _scene(tolerances={"N": {CLEARANCE: 1e-4}})
    for end in (-1, 1):
        moved = scene.toleranced.at_end(CLEARANCE, end).journal
        assert moved.at("N").geometry.relative_clearance == pytest.approx(5e-4 + end * 1e-4)
        assert moved.at("N2").geometry == scene.journal.at("N2").geometry


def test_the_band_of_a_named_oil_is_a_share_of_its_viscosity():
    scene = _scene(
        bearings={"N": {k: v for k, v in FILM.items() if k != "lubricant"}
                  | {"heat": {"oil": {"value": "mineral-vg-320", "tolerance": 0.1}}}}
    )  # fmt: skip
    named = lubricant("mineral-vg-320")
    thin = scene.toleranced.at_end("heat.oil", -1).journal.at("N").heat.liquid
    for temperature in (313.15, 373.15):
        ratio = thin.kinematic_viscosity(temperature) / named.kinematic_viscosity(temperature)
        assert ratio == pytest.approx(0.9, rel=1e-3)


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ({"tolerances": {"N": {CLEARANCE: 6e-4}}}, "an end of its band"),
        ({"tolerances": {"N": {"geometry.clearence": 1e-4}}}, "no bearing there has such a number"),
        ({"tolerances": {"Q": {CLEARANCE: 1e-4}}}, "tolerances.Q"),
        ({"tolerances": {"N": {CLEARANCE: -1e-4}}}, "must be > 0"),
        ({"tolerances": {"N": {"kind": 1.0}}}, "no bearing there has such a number"),
        ({"tolerances": {"N": {"alignment.0": 1e-4}}, "shaft": {"two_point": {}}}, "alignment"),
        (
            {
                "tolerances": {"N": {"alignment.0": 1e-4}},
                "bearings": {"N": FILM | {"tilt": True, "alignment": "mean"}},
            },
            'alignment = "mean"; a tolerance is about a turn in rad',
        ),
    ],
)
def test_what_cannot_be_is_refused_by_its_key(parts, said):
    with pytest.raises(InputError, match=said):
        _scene(**parts)


def test_without_tolerances_nothing_runs_and_with_them_a_stage():
    assert "tolerances" not in [step.name for step in make_plan(_scene()).steps]
    scene = _scene(tolerances={"N": {CLEARANCE: 1e-4}})
    assert "tolerances" in [step.name for step in make_plan(scene).steps]
    wanted = scene.model_copy(update={"results": ["loads.statistics"]})
    assert "tolerances" not in [step.name for step in make_plan(wanted).steps]


def test_a_bore_out_of_line_turns_the_shaft_in_it_the_other_way():
    hub = case(8.0, 1, steps=12)
    scene = _scene(bearings={"N": FILM | {"tilt": True}, "N2": FILM | {"tilt": True}})
    turned = _scene(bearings={"N": FILM | {"tilt": True, "alignment": [2e-5, -1e-5]}})
    lies = [
        shaft_line(one.journal.at("N"), shaft.bearing_loads(one, None, {"loads": hub}).sel(
            bearing="N"))["tilt"]
        for one in (scene, turned)
    ]  # fmt: skip
    # about down is against z, about left is y
    assert np.allclose(lies[1] - lies[0], [0.0, 1e-5, 2e-5], atol=1e-12)


class _Case:
    name, dlc, wind_speed, seed = "a", "1.1", 8.0, 1


def test_both_ends_of_a_band_are_solved_and_the_largest_governs():
    hub = case(8.0, 1, steps=100)
    scene = _scene(tolerances={"N": {CLEARANCE: 1e-4, "shaft_roughness": 3e-7}})
    parts = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    table = tolerances.changes(scene, [_Case()], {"a": parts})
    assert {*table["bearing"].values} == {"N"}
    rows = {
        (str(row["key"].item()), str(row["quantity"].item())): (row["low"].item(),
                                                                row["high"].item())
        for row in (table.isel(change=k) for k in range(table.sizes["change"]))
    }  # fmt: skip
    low, high = rows[CLEARANCE, "eccentricity ratio"]
    assert low < -0.02 < 0.02 < high  # a wider bore lets the shaft further out
    assert rows["shaft_roughness", "minimum film"] == (0.0, 0.0)
    film = scene.journal.least_film
    expected = [film / (film + end * 3e-7) - 1.0 for end in (-1, 1)]
    assert rows["shaft_roughness", tolerances.MARGIN] == pytest.approx(expected)
    band = band_of({"tolerances": table}, "journal", "N", "eccentricity ratio")
    assert band.governed_by == CLEARANCE
    assert (band.low, band.high) == pytest.approx((low, high))


def _table(rows):
    text = dict(zip(("room", "bearing", "key", "quantity", "case"), zip(*(r[:5] for r in rows))))
    ends = {name: ("change", [r[k] for r in rows]) for name, k in (("low", 5), ("high", 6))}
    return {"tolerances": xr.Dataset(ends, {n: ("change", list(v)) for n, v in text.items()})}


def test_bands_add_up_by_squares_and_the_hardest_case_counts():
    rows = [
        ("journal", "N", "a", "film", "one", 0.03, -0.03),
        ("journal", "N", "b", "film", "one", -0.04, 0.04),
        ("journal", "N", "a", "film", "two", 0.01, -0.01),
        ("thrust", "N", "a", "film", "one", 9.0, 9.0),
    ]
    band = band_of(_table(rows), "journal", "N", "film")
    assert (band.low, band.high) == pytest.approx((-0.05, 0.05))
    assert band.shares == {"a": 0.03, "b": 0.04}
    assert band_of(_table(rows), "journal", "N2", "film") is None
    lost = band_of(_table([*rows[:1], (*rows[1][:5], np.nan, 0.1)]), "journal", "N", "film")
    assert np.isnan(lost.low)


def test_the_largest_of_seeds_models_and_tolerances_governs():
    kept = {"result": "r", "bearing": "N", "quantity": "q", "unit": "1", "value": 1.0}
    by_seeds = Answer(low=0.9, high=1.1, error=0.05, band=Band(-0.08, 0.02, {"a": 0.08}), **kept)
    by_band = Answer(low=0.9, high=1.1, error=0.05, band=Band(-0.12, 0.02, {"a": 0.12}), **kept)
    assert by_seeds.governed_by == "seeds"
    assert by_band.governed_by == "tolerance of a"
