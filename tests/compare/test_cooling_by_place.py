"""Each rolling bearing has its own cooling, in runs, comparisons and designs."""

import tomllib
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from synthetic import cube_file

from loadflow.errors import InputError
from loadflow.planning.accuracy import errors_beside, expected_errors
from loadflow.planning.effects import Estimates, switched
from loadflow.planning.plan import make_plan
from loadflow.scene.candidates import candidates_of, machine_names
from loadflow.scene.cases import list_cases
from loadflow.scene.cooling import Cooling
from loadflow.scene.friction import Friction
from loadflow.scene.places import GEOMETRIES
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages.effects.rolling_heat import ROLLING_HEAT
from loadflow.stages.effects.situation import situation
from loadflow.stages.friction import losses
from loadflow.stages.rolling import warm_bearing
from loadflow.studies.candidate.friction import rolling_losses
from loadflow.studies.candidate.margins import lubrication
from loadflow.studies.compare.bands import _friction
from loadflow.studies.compare.words import _warm

AIR = 288.15
BALLS = {"balls": 60, "rows": 1, "ball_diameter": 0.06, "pitch_diameter": 2.0,
         "groove_radius": 0.0312, "contact_angle": 0.8, "shoulder_angle": 1.2}  # fmt: skip
COOLING = {"N": {"conductance": 12.0}, "N2": {"area": 4.0, "transfer": 20.0}}


@pytest.fixture(scope="module")
def cooled(cooled_run):
    friction = {"cooling": COOLING, "ambient_temperature": AIR}
    return cooled_run(candidates={"two-spherical": {}}, friction=friction)


def test_each_bearing_sheds_its_losses_by_its_own_cooling(cooled):
    folder, scene, table, *_ = cooled
    losses = rolling_losses(scene, folder, table).power.sel(case=table["case"])
    for place, conductance in (("N", 12.0), ("N2", 80.0)):
        shed = conductance * (table["bearing_temperature"].sel(bearing=place) - AIR)
        ratio = (losses.sel(bearing=place) / shed).values
        assert ratio == pytest.approx(1.0, rel=0.05)  # in few samples


def test_the_page_tells_the_cooling_of_each_bearing(cooled):
    *_, table, numbers, told = cooled
    warm = numbers["bearing_temperature"]
    warmest = table["bearing_temperature"].max("case")
    where = str(warmest.idxmax("bearing").item())
    assert warm.place == where
    assert {"N": "12 W/K", "N2": "80 W/K"}[where] in warm.note
    assert "N 12 W/K, N2 80 W/K" in told["Lubricant of rolling bearings"]


def test_the_band_by_the_temperature_of_the_oil_is_around_that_of_each_bearing(cooled):
    _, scene, table, numbers, _ = cooled
    kappa = numbers["viscosity_ratio"]
    warm = float(table["bearing_temperature"].sel(bearing=kappa.place).max())

    oil = lubrication(scene.friction).oil
    thinner = float(oil.kinematic_viscosity(warm + 5.0) / oil.kinematic_viscosity(warm))
    assert kappa.tolerance_low / kappa.value == pytest.approx(thinner, rel=1e-3)


def test_what_a_stated_temperature_would_be_off_is_indicated(cooled):
    """κ and modified life of the run, and with the oil at the temperature that is assumed."""
    _, scene, table, *_ = cooled
    assert ROLLING_HEAT.is_on(scene)
    without = switched(scene, ROLLING_HEAT, False)
    assert without.friction.balances(without.rolling.bearings.values()) == []
    assert ROLLING_HEAT.switched(without, True) is None  # nobody knows its cooling
    sizes = ROLLING_HEAT.indicator(situation(scene, list_cases(scene)))
    oil, assumed = lubrication(scene.friction).oil, scene.friction.temperature
    off = oil.kinematic_viscosity(assumed) / oil.kinematic_viscosity(table["bearing_temperature"])
    off = float(np.abs(off - 1.0).max())
    assert off > 0.1
    assert off / 3.0 < sizes["viscosity ratio"] < ROLLING_HEAT.smaller * off


def test_an_assumed_temperature_is_in_the_error_of_viscosity_ratio_and_modified_life(cooled):
    _, scene, *_ = cooled
    indicated = Estimates({ROLLING_HEAT.name: {"viscosity ratio": 0.4, "modified life": 0.7}})
    without = switched(scene, ROLLING_HEAT, False)
    stated = without.model_copy(
        update={"friction": without.friction.model_copy(update={"temperature": 320.0})}
    )
    kappa, life = (
        [errors_beside(one, indicated)[result][name] for one in (scene, without, stated)]
        for result, name in (
            ("rolling.friction", "viscosity ratio"), ("rolling.life", "modified life")
        )
    )  # fmt: skip
    assert kappa[1] - kappa[0] == pytest.approx(0.4)
    assert life[1] - life[0] == pytest.approx(0.7)
    assert (kappa[2], life[2]) == (kappa[0], life[0])  # somebody knows it


def test_an_assumed_temperature_is_in_the_error_of_friction_and_film_of_runs_and_comparisons():
    """Of a run that asks for friction alone, too, whose plan tells of the effect once."""
    warm = {"friction power": 0.1, "film parameter": 0.5, "modified life": 9.0}
    indicated = Estimates({ROLLING_HEAT.name: warm})
    cooling = {place: {"conductance": 12.0} for place in ("N", "N2")}
    known, assumed = (
        _of_two(found).model_copy(update={"results": ["rolling.friction"]})
        for found in (cooling, {})
    )
    for errors in (expected_errors, errors_beside):
        cold, off = (errors(one, indicated)["rolling.friction"] for one in (known, assumed))
        for name in ("friction power", "film parameter"):
            assert off[name] - cold[name] == pytest.approx(warm[name])
    plan = make_plan(assumed)
    assert [one.name for one in plan.effects].count(ROLLING_HEAT.name) == 1
    assert any(said.startswith("rolling.friction: off in") for said in plan.shortfalls)


def test_friction_that_leaves_at_no_temperature_has_no_size():
    """Not that of the hottest oil tried: κ and modified life are not known then."""

    def sizes(conductance):
        scene = _of_two({"N": {"conductance": conductance}, "N2": {"conductance": 1e4}})
        return ROLLING_HEAT.indicator(situation(scene, list_cases(scene)))

    assert np.isfinite([*sizes(1e4).values()]).all()
    hot = sizes(1e-3)
    assert np.isnan([*hot.values()]).all()
    without = _of_two({})  # nobody knows its cooling
    errors = errors_beside(without, Estimates({ROLLING_HEAT.name: hot}))
    assert errors["rolling.friction"]["viscosity ratio"] is None
    assert errors["rolling.life"]["modified life"] is None


def test_a_measured_temperature_stays_without_heat_balances_and_has_no_error():
    cooling = {"N": {"conductance": 12.0}, "N2": {"temperature": 330.0}}
    scene = _of_two(cooling)
    assert ROLLING_HEAT.is_on(scene)
    without = switched(scene, ROLLING_HEAT, False)
    assert not ROLLING_HEAT.is_on(without)
    assert without.friction.cooling == {"N2": Cooling(temperature=330.0)}
    measured = _of_two({place: {"temperature": 330.0} for place in ("N", "N2")})
    assert not ROLLING_HEAT.concerns(measured)
    assert (
        _warm(measured.friction) == "N 57 °C as stated, N2 57 °C as stated, others 40 °C as stated"
    )
    assert "friction.ambient_temperature" in unused_keys(measured)


def _of_two(cooling):
    friction = {"cooling": cooling, "ambient_temperature": AIR}
    data = {"name": "x", "results": ["rolling.life"], "friction": friction}
    rolling = {"bearing": "N", "geometry": BALLS, "further": [{"bearing": "N2", "geometry": BALLS}]}
    return make_scene(data | {"shaft": {"two_point": {}}, "rolling": rolling})


def test_a_stated_temperature_of_one_bearing_goes_before_that_of_all():
    friction = Friction(conductance=60.0, cooling={"N": Cooling(temperature=330.0)})
    N, N2 = _of_two({}).rolling.bearings.values()
    assert friction.conductance_of(N) is None
    assert friction.temperature_of(N) == friction.of(N).temperature == 330.0
    assert friction.conductance_of(N2) == friction.of(N2).conductance == 60.0
    warmer = friction.warmed(lambda kelvin: kelvin + 5.0)
    assert (warmer.temperature_of(N), warmer.temperature_of(N2)) == (335.0, 318.15)


def test_a_temperature_that_a_bearing_states_itself_moves_with_its_tolerance_and_is_no_balance():
    bearing = {"kind": "ball", "geometry": BALLS, "cooling": {"temperature": 330.0}}
    data = {"name": "x", "results": ["rolling.life"], "shaft": {"moment": {}}}
    scene = make_scene(data | {"bearings": {"M": bearing}})
    (part,) = scene.rolling.bearings.values()
    table = xr.Dataset(
        {"bearing_temperature": (("case", "bearing"), [[330.0]])}, {"bearing": ["M"]}
    )
    held = _friction(SimpleNamespace(scene=scene, tables={"rolling": table}))
    assert held.temperature_of(part) == 330.0
    assert held.warmed(lambda kelvin: kelvin + 5.0).temperature_of(part) == 335.0
    assert _warm(scene.friction, [part]) == "57 °C as stated"


def test_sized_bearings_have_the_cooling_of_their_machine_unless_the_scene_states_another():
    def of(**friction):
        data = {"name": "x", "bearings": ["two-spherical"], "results": ["rolling.friction"]}
        return make_scene(data | {"shaft": {"two_point": {}}, "friction": friction})

    sized, warm = of(), of(temperature=330.0)
    parts = sized.rolling.bearings.values()
    assert ROLLING_HEAT.is_on(sized)
    assert not unused_keys(sized)
    for part in parts:  # 15 W/(m² K) of a round housing of 1.53 m, 0.49 m wide, around 0.77 m
        assert sized.friction.conductance_of(part) == pytest.approx(77.0, rel=0.01)
        assert of(conductance=5.0).friction.conductance_of(part) == 5.0
        assert warm.friction.conductance_of(part) is None
        assert warm.friction.temperature_of(part) == warm.friction.of(part).temperature == 330.0
    assert not ROLLING_HEAT.concerns(warm)
    own = of(cooling={"N": {"temperature": 330.0}}).friction
    assert [own.states(part) for part in parts] == [True, False]
    without = switched(sized, ROLLING_HEAT, False)
    assert without.friction.balances(without.rolling.bearings.values()) == []
    assert make_scene(tomllib.loads(sized.to_toml())) == sized


def test_every_rolling_bearing_that_is_sized_states_a_cooling():
    for turbine in machine_names():
        for name, candidate in candidates_of(turbine).items():
            parts = [part for part in candidate.values() if isinstance(part, dict)]
            for part in parts:
                if part["kind"] in GEOMETRIES:
                    assert part["cooling"]["transfer"] > 0, f"{turbine}: {name}"


def test_a_cooling_of_a_bearing_that_changes_nothing_is_told():
    def unused(**data):
        bearing = {"kind": "ball", "geometry": BALLS, "cooling": {"conductance": 9.0}}
        scene = {"name": "x", "results": ["rolling.life"], "shaft": {"moment": {}}}
        return unused_keys(make_scene(scene | {"bearings": {"M": bearing}} | data))

    assert "rolling.cooling" not in unused()
    assert "goes before" in unused(friction={"conductance": 5.0})["rolling.cooling"]
    assert "neither friction nor life" in unused(results=["rolling.loads"])["rolling.cooling"]


def test_a_housing_of_a_bearing_with_elements_of_several_sizes_is_to_be_stated():
    row = {"rollers": 150, "roller_diameter": 0.05, "roller_length": 0.05, "pitch_diameter": 2.5}
    rows = dict.fromkeys(("support", "retaining", "radial"), row)
    bearing = {"kind": "three-row", "geometry": rows, "cooling": {"transfer": 15.0}}
    with pytest.raises(InputError, match="several sizes"):
        make_scene({"name": "x", "shaft": {"moment": {}}, "bearings": {"M": bearing}})


@pytest.mark.parametrize(
    "one", [{}, {"area": 3.0}, {"conductance": 3.0, "temperature": 300.0}, {"conductance": -1.0}]
)
def test_a_cooling_is_of_one_form(one):
    with pytest.raises(InputError, match=r"friction\.cooling\.N"):
        make_scene({"name": "x", "friction": {"cooling": {"N": one}}})


def test_a_cooling_where_no_rolling_bearing_stands_is_told():
    scene = make_scene(
        {
            "name": "x", "results": ["rolling.life"], "shaft": {"moment": {}},
            "friction": {"cooling": {"N3": {"conductance": 5.0}, "M": {"conductance": 50.0}}},
        }
    )  # fmt: skip
    unused = unused_keys(scene)
    assert "friction.cooling.N3" in unused
    assert "friction.cooling.M" not in unused


def test_a_bearing_that_swings_has_the_temperature_that_is_stated_for_it(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", seeds=(1,), steps=20)
    swings = {"oscillation": {"amplitude": 0.1, "frequency": 0.1}}
    stated = {"N": {"temperature": 330.0}, "N2": {"conductance": 30.0}}
    geometry = {
        "rollers": 20, "roller_diameter": 0.1, "roller_length": 0.1, "pitch_diameter": 1.0,
        "contact_angle": 0.15,
    }  # fmt: skip
    bearing = {"kind": "spherical", "geometry": geometry}
    scene = make_scene(
        {
            "name": "x", "loads": {"files": [str(cube)]}, "results": ["rolling.life"],
            "bearings": {"N": bearing | swings, "N2": bearing | swings},
            "friction": {"cooling": stated, "conductance": 60.0, "temperature": 310.0},
        }
    )  # fmt: skip
    few = xr.Dataset(
        {
            "force": (("sample", "axis"), [[0.0, 0.0, -1e5]]),
            "moment": (("sample", "axis"), [[0.0, 0.0, 0.0]]),
            "speed": ("sample", [1.0]),
            "weight": ("sample", [1.0]),
        }
    )
    assert [warm_bearing(scene, name, few)[1] for name in ("N", "N2")] == [330.0, 310.0]
    time = np.arange(0.0, 1.0, 0.1)
    held = few[["force", "moment"]].isel(sample=0).expand_dims(bearing=["N", "N2"], time=time)
    turning = xr.Dataset({"speed": ("time", np.ones(time.size))}, {"time": time})
    found = losses(scene, list_cases(scene)[0], {"loads": turning, "shaft": held})
    assert found["temperature"].values.tolist() == [330.0, 310.0]
    unused = unused_keys(scene)
    assert "friction.cooling.N2" in unused
    assert "friction.cooling.N" not in unused


def test_a_cooling_of_sized_candidates_alone_is_said_to_count_for_the_comparison():
    shaft = {"two_point": {}, "moment": {}}
    scene = {"name": "a", "shaft": shaft, "bearings": ["journal-cylindrical", "tapered-pair"]}
    scene |= {"friction": {"cooling": COOLING}, "results": ["rolling.friction"]}
    told = unused_keys(make_scene(scene))
    assert told["friction.cooling.N"].endswith("those that `loadflow compare` takes by itself")
    own = make_scene(scene | {"candidates": {"journal-lemon": {}}})
    assert unused_keys(own)["friction.cooling.N"].endswith("nor of its candidates")
