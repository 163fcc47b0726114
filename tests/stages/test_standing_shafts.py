"""Films of shafts that stand: what the pilot, the check and the stage ask of them."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import SolverError
from loadflow.planning.pilot import EFFORTS, Questions, measure, pilot
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages import comparisons, paths_again, probes
from loadflow.stages.effects.film import CONTACT, MOTION, SHELL
from loadflow.stages.registry import STAGES

ROUGH = {"asperities": {"roughness": 0.56e-6, "contact_modulus": 46.5e9, "factor": 1e-3}}
STIFF = {"kind": "local", "compliance": 2e-12}
LOAD = 1.5e6  # N


def scene_of(dlc, *, stated=True, **loads):
    journal = {"contact": ROUGH, "shell": STIFF} if stated else {}
    return make_scene(
        {
            "name": "standing",
            "results": ["journal.film"],
            "loads": {"dlc": dlc, "seeds": 1, "rung": "tables", "step": 0.1} | loads,
            "journal": {"bearings": ["N"], "motion": "transient", "rung": "reduced"} | journal,
        }
    )


def given(speed, load=LOAD):
    """Series of a shaft that is pressed down as it turns at these speeds, rad/s."""
    time = 0.1 * np.arange(len(speed))
    force = np.zeros((1, 3, time.size))
    force[:, 2] = -load
    loads = xr.Dataset({"speed": ("time", np.asarray(speed, float))}, {"time": time})
    names = ("bearing", "axis", "time")
    shaft = xr.Dataset(
        {"force": (names, force), "moment": (names, 0.0 * force)},
        {"bearing": ["N"], "time": time},
    )
    return {"loads": loads, "shaft": shaft}


def followed(monkeypatch):
    """Speeds of each stretch that is followed; the answers are made up."""
    stretches = []

    def follow(scene, bearing, loads, shaft):
        stretches.append(loads["speed"].values)
        ones = np.ones(loads.sizes["time"])
        return xr.Dataset(dict.fromkeys(comparisons.FILM, ("time", ones)))

    monkeypatch.setattr(probes, "in_motion", follow)
    return stretches


def asked(scene, effects, series):
    names = tuple(effect.name for effect in effects)
    return measure(Questions(scene, names, 60.0, ()), list_cases(scene)[0], series)


def test_films_of_a_parked_shaft_stand_by_their_indicators(monkeypatch):
    stretches = followed(monkeypatch)
    slipping = 0.02 * np.ones(400)  # pulled through its brake by a storm, all the time
    found = asked(scene_of("6.1"), (CONTACT, SHELL), given(slipping))
    assert not stretches
    assert not found.sizes
    assert not found.refused  # nothing is said against the effects


def test_films_of_an_idling_shaft_are_asked(monkeypatch):
    stretches = followed(monkeypatch)
    found = asked(scene_of("6.4"), (SHELL,), given(0.05 * np.ones(400)))
    assert len(stretches) == 2
    assert found.sizes[SHELL.name] == dict.fromkeys(found.sizes[SHELL.name], 0.0)


def test_a_smooth_film_that_carries_nothing_anywhere_is_not_searched_for(monkeypatch):
    """It took seconds for each load, on the grid, and gave no answer."""
    stretches = followed(monkeypatch)
    creeping = given(0.002 * np.ones(400))
    found = asked(scene_of("6.4"), (CONTACT, SHELL), creeping)
    assert len(stretches) == 2  # with and without the shell; nothing for the smooth film
    assert set(found.sizes) == {SHELL.name}
    smooth = scene_of("1.1", stated=False)
    with pytest.raises(SolverError, match="touch in all samples"):
        probes.PROBES["journal"].answers(smooth, list_cases(smooth)[0], creeping)


def test_a_soft_shell_may_carry_what_a_rigid_bore_does_not(monkeypatch):
    stretches = followed(monkeypatch)
    scene = scene_of("1.1", stated=False)
    lining = {"kind": "local", "compliance": 1e-9}
    soft = scene.model_copy(update={"journal": replaced(scene, shell=lining)})
    probes.PROBES["journal"].answers(soft, list_cases(soft)[0], given(0.002 * np.ones(400)))
    assert len(stretches) == 1


def replaced(scene, **keys):
    section = scene.journal
    return type(section).model_validate(section.model_dump(exclude_unset=True) | keys)


@pytest.mark.parametrize(("dlc", "turned"), [("3.1", 1), ("4.1", -1)])
def test_starts_and_stops_are_asked_as_long_as_a_film_carries(dlc, turned, monkeypatch):
    stretches = followed(monkeypatch)
    up = np.concatenate([np.zeros(300), np.linspace(0.0, 1.2, 200), 1.2 * np.ones(500)])
    asked(scene_of(dlc), (CONTACT, SHELL), given(up[::turned]))
    assert len(stretches) == 3  # all of it, without asperities, without the shell
    for speed in stretches:
        assert np.array_equal(speed, stretches[0])
        assert probes.STEPS >= speed.size >= probes.STEPS // 4
        assert speed.min() > 0.01


def test_a_parked_case_is_asked_only_beside_others_that_turn():
    """With a blade stuck it has the largest load, with feathered blades less than while running."""
    loads = {"wind_speeds": [12.0, 50.0], "yaw_errors": [0.0]}
    for dlc, loaded in (("7.1", ["7.1"]), ("6.1", [])):
        mixed = [
            replace(case, dlc=dlc if case.wind_speed > 25 else "1.1") for case in cases(**loads)
        ]
        steady, *largest = probes.hardest(scene_of("1.1"), tuple(mixed))
        assert steady.dlc == "1.1"
        assert [case.dlc for case in largest] == loaded
        parked = tuple(case for case in mixed if case.dlc == dlc)
        assert probes.hardest(scene_of(dlc), parked) == [*parked]


def cases(**loads):
    return list_cases(scene_of("6.1", **loads))


def test_what_a_scene_states_is_not_measured_in_a_short_run(monkeypatch):
    stretches = followed(monkeypatch)
    monkeypatch.setattr(
        probes, "_at_rest", lambda journal, loads, shaft: probes.in_motion(0, "", loads, 0)
    )
    scene = scene_of("1.1", wind_speeds=[12.0], duration=20.0)
    loose = scene.model_copy(update={"journal": replaced(scene)})
    assert not {CONTACT.name, SHELL.name, MOTION.name} & {*sizes_of(loose, EFFORTS[-1])}
    assert {CONTACT.name, SHELL.name, MOTION.name} <= {*sizes_of(loose, EFFORTS[0])}
    assert stretches


def sizes_of(scene, effort):
    return pilot(scene, effort=effort).sizes


# --- the check --------------------------------------------------------------------------------


def kept(speed):
    """What a run keeps of such a series."""
    count = len(speed)
    samples = {name: ("sample", np.full(count, 0.9)) for name in comparisons.FILM}
    samples |= {
        "time": ("sample", 0.1 * np.arange(count)),
        "speed": ("sample", np.asarray(speed, float)),
        "converged": ("sample", np.ones(count, int)),
        "running": ("sample", np.zeros(count, bool)),
        "temperature": ("sample", np.full(count, 313.0)),
        "side_flow": ("sample", np.full(count, 1e-4)),
        "eccentricity": (("sample", "component"), np.zeros((count, 2))),
    }
    return xr.DataTree.from_dict({"N": xr.Dataset(samples)})


@pytest.mark.parametrize(("dlc", "speed", "is_asked"), [
    ("6.1", 0.02, False), ("6.4", 0.02, True), ("6.4", 0.0, False),
])  # fmt: skip
def test_no_cells_are_refined_for_a_shaft_that_stands(dlc, speed, is_asked, monkeypatch):
    stretches = []

    def follow(scene, bearing, loads, shaft, place):
        stretches.append(loads["speed"].values)
        return xr.Dataset({n: ("time", np.full(loads.sizes["time"], 0.5)) for n in probes.FILM})

    monkeypatch.setattr(paths_again, "in_motion", follow)
    scene = scene_of(dlc)
    series = given(speed * np.ones(400)) | {"journal": kept(speed * np.ones(400))}
    rows = comparisons.COMPARISONS["journal"](scene, list_cases(scene)[0], series)
    of_films = [row for row in rows if row.stage == "journal"]
    assert bool(of_films) == bool(stretches) == is_asked


# --- the film ---------------------------------------------------------------------------------


def test_the_oil_of_a_parked_shaft_is_as_warm_as_it_enters():
    """A heat balance of a shaft that creeps in its brake was sought for minutes."""
    scene = scene_of("6.1")
    scene = scene.model_copy(update={"journal": replaced(scene, heat={"inlet_temperature": 320.0})})
    series = given(0.01 * np.ones(20))
    film = STAGES["journal"].run(scene, list_cases(scene)[0], series)["N"]
    assert film["converged"].values.all()
    assert film["temperature"].values == pytest.approx(320.0)
