"""Starts and stops: where the film is thinner than the roughness there is contact, and no film."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import InputError
from loadflow.journal import Groove, JournalBearing, Lobes, Supply
from loadflow.journal.critical import Critical
from loadflow.journal.transition import load_capacity
from loadflow.readers.names import SITUATIONS, label_from_name
from loadflow.scene.cases import Case
from loadflow.scene.scene import make_scene
from loadflow.stages import journal as stage
from loadflow.stages.films.summary import extremes, mixed_friction
from loadflow.stages.films.turning import runs_throughout
from loadflow.studies.verdicts.verdicts import verdicts
from loadflow.wind import LOAD_CASES
from loadflow.wind.cases import EVENTS_IN_WORDS, stands_or_starts

LOAD = 1e6
FILM = {"grid": [24, 8], "bearings": ["N"]}


def scene_with(**keys):
    return make_scene({"name": "start", "results": ["journal.film"], "journal": FILM | keys})


def series(speed, step=0.1):
    count = speed.size
    force = np.tile([0.0, 0.0, -LOAD], (count, 1))
    data = {
        "time": ("sample", step * np.arange(count)),
        "speed": ("sample", speed),
        "weight": ("sample", np.ones(count)),
        "force": (("sample", "axis"), force),
        "moment": (("sample", "axis"), 0 * force),
    }
    return xr.DataTree.from_dict({"N": xr.Dataset(data, {"axis": ["x", "y", "z"]})})


def solved(scene, speed):
    one = Case("3.1", 8.0, 1)
    tree = stage.film(scene, one, {"reduction": series(speed)})
    return tree["N"].to_dataset(), stage.summary({one: tree}).squeeze()


@pytest.fixture(scope="module")
def start():
    scene = scene_with()
    speed = np.linspace(0.0, 1.2, 601)
    return scene, speed, *solved(scene, speed)


def test_contact_ends_at_the_speed_whose_film_is_as_thick_as_the_roughness(start):
    scene, speed, samples, _ = start
    touching = samples["in_contact"].values
    assert touching[0]
    assert not touching[-1]
    assert np.all(np.diff(touching.astype(int)) <= 0)
    parts = speed[np.argmin(touching)]
    film = {name: value for name, value in scene.journal.film.items() if name != "rung"}
    geometry, roughness = scene.journal.geometry, scene.journal.contact_film
    around = load_capacity(geometry, roughness, [0.8 * parts, 1.3 * parts], **film)
    assert around[0] < LOAD < around[1]


def test_samples_in_contact_have_no_film_and_are_not_called_unanswered(start):
    _, _, samples, table = start
    touching = samples["in_contact"].values
    assert np.isnan(samples["minimum_film"].values[touching]).all()
    assert np.isfinite(samples["minimum_film"].values[~touching]).all()
    assert table["not_converged"] == 0
    assert table["in_contact"] == touching.sum() > 1


def test_with_asperities_samples_in_contact_are_solved(start):
    _, speed, smooth, without = start
    asperities = {"roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}
    scene = scene_with(contact={"asperities": asperities, "friction": 0.1})
    samples, table = solved(scene, speed[::20])
    share, touching = samples["contact_share"].values, samples["in_contact"].values
    assert samples["converged"].all()
    assert np.isfinite(samples["minimum_film"]).all()
    assert table["not_converged"] == 0
    assert share[0] == pytest.approx(1.0)
    assert share[-1] < 1e-6
    assert touching[0]
    assert not touching[-1]
    # boundary friction of what the asperities carry is less than that of the whole load
    lost = float(table["mixed_friction_energy"])
    assert 0 < lost < 20 * float(without["mixed_friction_energy"])
    apart = ~smooth["in_contact"].values[::20]
    thick = samples["minimum_film"].values > 10e-6
    assert thick[apart].any()
    assert samples["minimum_film"].values[thick] == pytest.approx(
        smooth["minimum_film"].values[::20][thick], rel=1e-6
    )


def test_contact_costs_no_film(start, monkeypatch):
    scene, *_ = start
    asked = []
    solve = stage.equilibria

    def counted(options, force, speed, **line):
        asked.append(len(speed))
        return solve(options, force, speed, **line)

    monkeypatch.setattr(stage, "equilibria", counted)
    slow = np.concatenate([np.geomspace(1e-6, 1e-3, 500), [1.2]]) * 2 * np.pi / 60
    samples, _ = solved(scene, slow)
    assert asked == [1]
    assert samples["in_contact"].values.sum() == 500


def test_transition_and_time_above_the_critical_eccentricity(start):
    _, speed, samples, table = start
    ratio = samples["eccentricity_ratio"].values
    first = int(np.argmax(ratio <= 0.95))
    assert speed[first - 1] < table["transition_speed"] < speed[first]
    assert table["mixed_friction_time"] == pytest.approx(0.1 * (first - 1))  # it stands in one
    turning = samples["in_contact"].values & (speed > 0)
    assert table["contact_time"] == pytest.approx(0.1 * turning.sum())
    turns = 0.1 * speed[:first].sum() / (2 * np.pi)
    assert table["mixed_friction_revolutions"] == pytest.approx(turns)


def test_a_stop_has_its_transition_where_a_start_with_the_same_speeds_has_it(start):
    scene, speed, _, table = start
    stop = solved(scene, speed[::-1])[1]
    assert stop["transition_speed"].item() == pytest.approx(table["transition_speed"].item(), 1e-6)
    assert stop["transition_time"].item() == pytest.approx(
        table["duration"].item() - table["transition_time"].item() - 0.1, abs=0.11
    )


def test_lift_off_touch_down_and_standstill_are_told(start):
    scene, speed, samples, table = start
    parts = int(np.argmin(samples["in_contact"].values))
    assert table["lift_off_speed"] == pytest.approx(speed[parts])
    assert table["lift_off_time"] == pytest.approx(0.1 * parts)
    assert np.isnan(table["touch_down_speed"])
    assert np.isnan(table["standstill_time"])
    stop = solved(scene, speed[::-1])[1]
    assert np.isnan(stop["lift_off_speed"])
    assert stop["touch_down_speed"] == pytest.approx(speed[parts - 1])
    assert stop["standstill_time"] == pytest.approx(0.1 * (speed.size - 1), abs=0.11)
    # at rest a film ends before the shaft does: its transition is earlier
    assert stop["film_after_stop"] < 0


def test_a_film_that_outlasts_the_stop_is_timed():
    samples = xr.Dataset(
        {
            "time": ("sample", np.arange(8.0)),
            "speed": ("sample", [1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            "weight": ("sample", np.ones(8)),
            "load": ("sample", np.full(8, LOAD)),
            "in_contact": ("sample", [0, 0, 0, 0, 0, 0, 1, 1]),
            "friction_power": ("sample", np.ones(8)),
            "eccentricity_ratio": ("sample", [0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.0, 1.0]),
        },
        attrs={"critical_eccentricity_ratio": 0.95, "boundary_friction": 0.1, "radius": 1.5},
    )
    told = mixed_friction(samples)
    assert told["standstill_time"] == 2.0
    assert told["standstill_eccentricity_ratio"] == 0.7
    assert told["film_after_stop"] == pytest.approx(2.5)
    assert told["touch_down_time"] == 6.0
    assert told["mixed_friction_time"] == 0.0


def test_a_start_in_lobes_is_mixed_up_to_the_film_of_the_critical_eccentricity():
    lemon = JournalBearing(1.4, 1.4, 1e-3, shape=Lobes(2, preload=0.3))
    begins = Critical.of(lemon, 0.95)
    film = begins.film * np.array([0.1, 0.5, 0.9, 1.3, 2.0, 3.0])
    data = {
        "time": np.arange(6.0), "speed": np.full(6, 0.3), "weight": np.ones(6),
        "load": np.full(6, LOAD), "in_contact": np.zeros(6, bool), "converged": np.ones(6, bool),
        "residual": np.zeros(6), "friction_power": np.full(6, 10.0),
        "eccentricity_ratio": np.full(6, 1.1), "minimum_film": film,
        "maximum_pressure": 1e6 * np.array([11.0, 9.0, 7.0, 4.0, 3.0, 2.0]),
    }  # fmt: skip
    about = begins.attributes | {"boundary_friction": 0.1, "radius": 0.7}
    samples = xr.Dataset({k: ("sample", v) for k, v in data.items()}, attrs=about)
    told = mixed_friction(samples)
    assert told["mixed_friction_time"] == pytest.approx(3.0)
    assert told["transition_time"] == pytest.approx(2.25)  # 0.9 … 1.3 of the film
    assert extremes(samples, starts=True)["largest_pressure"] == 4e6
    assert extremes(samples)["largest_pressure"] == 11e6  # nothing is left out of production


def test_pressures_are_those_of_a_shaft_that_turns_and_one_that_stands_has_a_load():
    speed = np.array([1.0, 0.5, 0.0, 0.0])
    sample = "sample"
    samples = xr.Dataset(
        {
            "sample": np.arange(4),
            "time": (sample, np.arange(4.0)),
            "speed": (sample, speed),
            "weight": (sample, np.ones(4)),
            "load": (sample, [2e6, 2.5e6, 1.5e6, 1.4e6]),
            "maximum_pressure": (sample, [2e6, 3e6, 60e6, 70e6]),
            "minimum_film": (sample, [8e-5, 5e-5, 1e-6, 1e-9]),
            "converged": (sample, np.ones(4, bool)),
            "residual": (sample, np.zeros(4)),
            "friction_power": (sample, np.ones(4)),
        }
    )
    told = extremes(samples)
    assert told["largest_pressure"] == 3e6
    assert told["largest_pressure_time"] == 1.0
    assert told["standing_load"] == 1.5e6
    assert told["standing_load_time"] == 2.0
    turning = extremes(samples.isel(sample=slice(0, 2)))
    assert np.isnan(turning["standing_load"])
    # a storm that pulls the rotor through its brake does not make it one that runs
    slipping = extremes(samples, parked=True)
    assert np.isnan(slipping["largest_pressure"])
    assert slipping["standing_load"] == 2.5e6
    assert [dlc for dlc, row in LOAD_CASES.items() if row.parked] == ["6.1", "6.2", "6.3", "7.1"]


def test_a_smooth_film_that_starts_has_the_pressure_of_what_floats_and_one_with_asperities_all():
    ratio = np.array([0.997, 0.97, 0.94, 0.9])
    pressure = np.array([10e6, 6e6, 3e6, 2e6])
    data = {
        "time": np.arange(4.0), "speed": np.linspace(0.01, 0.5, 4), "weight": np.ones(4),
        "maximum_pressure": pressure, "eccentricity_ratio": ratio,
        "minimum_film": 1e-3 * (1 - ratio),
        "converged": np.ones(4, bool), "residual": np.zeros(4), "friction_power": np.ones(4),
    }  # fmt: skip
    about = {"critical_eccentricity_ratio": 0.95}
    samples = xr.Dataset({k: ("sample", v) for k, v in data.items()}, attrs=about)
    told = extremes(samples, starts=True)
    assert (told["largest_pressure"], told["largest_pressure_time"]) == (3e6, 2.0)
    assert extremes(samples)["largest_pressure"] == 10e6  # in power production it is judged
    sharing = samples.assign(contact_share=("sample", [0.5, 0.1, 0.0, 0.0]))
    assert extremes(sharing, starts=True)["largest_pressure"] == 10e6


def test_faults_end_in_a_stop_and_are_no_power_production_to_the_limits_of_a_film():
    produce = [dlc for dlc in LOAD_CASES if not stands_or_starts(dlc)]
    assert produce == ["1.1", "1.2", "1.3", "1.4", "1.5"]


def test_a_start_that_the_name_of_a_file_says_in_a_word_is_no_power_production():
    words = [label_from_name(Path(f"own_{word}_v12.outb")).dlc for word in SITUATIONS]
    assert words == [*SITUATIONS]
    assert {word for word in words if stands_or_starts(word)} == {*EVENTS_IN_WORDS}
    table = xr.Dataset(coords={"dlc": ("case", ["1.1", "startup", "steady", "own"])})
    assert runs_throughout(table).tolist() == [True, False, True, True]


def test_a_brake_that_slips_by_some_degrees_in_strong_wind_holds_a_shaft_that_stands():
    time = np.arange(0.0, 60.0, 0.1)
    swinging = 0.01 * np.sin(2 * np.pi * 0.5 * time) + 5e-4  # slips by 0.02 rad in 40 s
    speed = np.where(time < 20.0, 1.0 - 0.05 * time, swinging)
    sample = "sample"
    samples = xr.Dataset(
        {
            "time": (sample, time),
            "speed": (sample, speed),
            "weight": (sample, np.ones(time.size)),
            "load": (sample, np.full(time.size, 2e6)),
            "maximum_pressure": (sample, np.where(time < 22.0, 3e6, 140e6)),
            "minimum_film": (sample, np.full(time.size, 2e-5)),
            "converged": (sample, np.ones(time.size, bool)),
            "residual": (sample, np.zeros(time.size)),
            "friction_power": (sample, np.ones(time.size)),
        }
    )
    told = extremes(samples)
    assert told["largest_pressure"] == 3e6  # until it turns back
    assert told["standing_load"] == 2e6


def test_a_standing_shaft_is_judged_by_its_specific_load(start):
    scene, _, samples, _ = start
    table = stage.summary({Case("3.1", 8.0, 1): xr.DataTree.from_dict({"N": samples})})
    found = {v.quantity: v for v in verdicts(scene, {"journal": table}, None)}
    own = found["specific load F/(B D) at standstill"]
    assert own.value == pytest.approx(LOAD / (3.0 * 2.25))
    assert own.limit == 7e6
    assert own.key == "journal.limits.material"
    assert "stands" in own.note
    pressure = found["largest film pressure"]
    assert own.value < pressure.value < own.limit


def test_a_braked_shaft_that_swings_stands():
    time = 0.025 * np.arange(4000)
    braked = np.maximum(1.0 - 0.05 * time, 0.0)
    swings = np.where(time > 20.0, 1e-2 * np.sin(10.0 * (time - 20.0)), 0.0)
    samples = xr.Dataset(
        {
            "time": ("sample", time),
            "speed": ("sample", braked + swings),
            "weight": ("sample", np.ones(time.size)),
            "load": ("sample", np.full(time.size, LOAD)),
            "in_contact": ("sample", np.zeros(time.size)),
            "friction_power": ("sample", np.ones(time.size)),
            "eccentricity_ratio": ("sample", np.where(time < 40.0, 0.5, 0.97)),
        },
        attrs={"critical_eccentricity_ratio": 0.95, "boundary_friction": 0.1, "radius": 1.5},
    )
    told = mixed_friction(samples)
    assert told["standstill_time"] == pytest.approx(20.0, abs=0.5)
    assert told["mixed_friction_revolutions"] == 0.0
    samples["speed"] = samples["speed"] + np.where(time > 50.0, 9e-3, 0.0)  # turns on slowly
    told = mixed_friction(samples)
    assert told["standstill_time"] > 70.0
    assert told["mixed_friction_revolutions"] > 0.0


def test_rubbing_loses_the_boundary_friction_of_the_load():
    scene = scene_with(boundary_friction=0.1, shaft_roughness=2e-4, shell_roughness=2e-4)
    speed = np.full(11, 0.02)
    _, table = solved(scene, speed)
    assert table["in_contact"] == 11
    power = 0.1 * LOAD * 1.5 * 0.02
    assert table["mixed_friction_energy"] == pytest.approx(power * 1.1)
    assert np.isnan(table["largest_eccentricity_ratio"])


def test_an_unsolved_film_is_counted_and_is_not_contact(start, monkeypatch):
    scene, speed, *_ = start
    solve = stage.equilibria

    def failing(*args, **keys):
        answer = solve(*args, **keys)
        answer.converged[-3:] = False
        answer.eccentricity_ratio[-3:] = np.nan
        answer.minimum_film[-3:] = np.nan
        return answer

    monkeypatch.setattr(stage, "equilibria", failing)
    _, table = solved(scene, speed)
    assert table["not_converged"] == 3


@pytest.mark.parametrize("keys", [{"shape": Lobes(count=2, preload=0.3)}, {}])
def test_the_capacity_of_a_bore_that_differs_around_is_met_by_its_equilibrium(keys):
    from dataclasses import replace

    scene = scene_with()
    bearing = replace(scene.journal.geometry, **keys)
    film = scene.journal.film | ({} if keys else {"supply": Supply((Groove(angle=1.57),))})
    del film["rung"]
    (carried,) = load_capacity(bearing, 50e-6, [1.0], **film)
    films = [
        bearing.equilibrium(
            carried * np.array([np.cos(a), np.sin(a)]), 1.0, strict=False, **film
        ).minimum_film
        for a in np.arange(8) * np.pi / 4
    ]
    # no direction of the load keeps a thicker film
    assert np.nanmax(films) < 1.2 * 50e-6


def test_a_roughness_beyond_the_clearance_is_refused():
    with pytest.raises(InputError, match="shaft_roughness and shell_roughness"):
        scene_with(shaft_roughness=1e-3)
