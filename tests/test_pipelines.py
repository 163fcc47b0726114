"""Every scene that comes with the project is valid, and runs in a short form."""

import json
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import loadflow as lf
from loadflow.cli import main
from loadflow.cube import iter_cases, open_cube
from loadflow.journal import LocalShell
from loadflow.planning.plan import make_plan
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import Scene, read_scene
from loadflow.wind import LOAD_CASES

PIPELINES = sorted((Path(__file__).parents[1] / "pipelines").glob("*.toml"))
LOAD_CASE_SCENES = [path for path in PIPELINES if path.stem.startswith("dlc_")]


def changed(scene, name, **changes):
    section = getattr(scene, name)
    part = type(section).model_validate(section.model_dump(exclude_unset=True) | changes)
    return scene.model_copy(update={name: part})


@pytest.mark.parametrize("path", PIPELINES, ids=lambda path: path.stem)
def test_every_pipeline_is_a_valid_scene(path):
    scene = read_scene(path)
    assert isinstance(scene, Scene)
    assert scene.name == path.stem


def test_the_scenes_cover_all_groups_of_load_cases():
    groups = {dlc[0] for path in LOAD_CASE_SCENES for dlc in read_scene(path).loads.dlcs}
    assert groups == {dlc[0] for dlc in LOAD_CASES}


@pytest.mark.parametrize("path", LOAD_CASE_SCENES, ids=lambda path: path.stem)
def test_every_load_case_scene_runs_in_a_short_form(path, tmp_path):
    scene = read_scene(path).model_copy(update={"results": ["loads.statistics"]})
    assert make_plan(scene).cases
    speed = 40.0 if scene.loads.dlcs[0] in ("6.1", "7.1") else 12.0
    short = changed(
        scene, "loads", wind_speeds=[speed], seeds=1, azimuths=[0.0], yaw_errors=[0.1],
        duration=6.0, step=0.05, rung="tables",
    )  # fmt: skip
    run = lf.run(short, out=tmp_path, report=False)
    assert run.failures == {}
    table = run.tree["statistics"].to_dataset()
    assert set(table["dlc"].values) == set(scene.loads.dlcs)
    assert table["weight"].groupby("dlc").sum().values == pytest.approx(1.0)
    assert np.isfinite(table["hub_moment"].values).all()
    assert "state" not in table


def test_cases_follow_the_table_of_load_cases():
    scene = read_scene(PIPELINES[0]).model_copy()
    both = changed(scene, "loads", dlc=["2.1", "3.2"], wind_speeds=None, seeds=None, duration=None)
    count = Counter(case.dlc for case in list_cases(both))
    assert count == {"2.1": 11 * 12, "3.2": 5 * 4}
    assert {case.steps for case in list_cases(both) if case.dlc == "3.2"} == {12000}
    few = changed(both, "loads", seeds=2, first_seed=3, wind_speeds=[8.0])
    assert [c.seed for c in list_cases(few) if c.dlc == "2.1"] == [3, 4]
    assert [c.seed for c in list_cases(few) if c.dlc == "3.2"] == [1, 2, 3, 4]


EVENTS = {"dlc_3_1_startup": "3.1", "dlc_4_2_shutdown": "4.1", "dlc_5_1": "5.1"}


def events(name, tmp_path, **loads):
    """Film of a start or stop as its pipeline has it, and its summary."""
    scene = read_scene(next(path for path in PIPELINES if path.stem == name))
    scene = scene.model_copy(update={"results": ["journal.film"], "accuracy": "given"})
    scene = changed(scene, "loads", rung="tables", step=0.1, seeds=1, **loads)
    scene = changed(scene, "journal", rung="reduced", motion="transient", bearings=["N"])
    run = lf.run(scene, out=tmp_path, report=True)
    assert run.failures == {}
    assert run.flagged == {}  # every sample has an answer, those at a stand too
    part = next((run.path / "journal").glob("*.h5"))
    return open_cube(part)["N"].to_dataset().load(), run.tree["journal"].to_dataset().squeeze(), run


@pytest.mark.parametrize("name", EVENTS)
def test_starts_and_stops_rest_on_asperities_in_their_pipelines(name):
    journal = read_scene(next(path for path in PIPELINES if path.stem == name)).journal
    assert journal.contact is not None
    size = journal.geometry
    given = LocalShell.conformal(2e6 / size.width, size.diameter, size.relative_clearance)
    assert journal.shell.compliance == pytest.approx(given.compliance, rel=5e-3)


@pytest.mark.parametrize("name", EVENTS)
def test_films_of_starts_and_stops_alone_are_planned_as_accurate_as_with_all_results(name):
    """An error that a film as it is stated does not know hides none of the rotor's."""
    scene = read_scene(next(path for path in PIPELINES if path.stem == name))
    alone = make_plan(scene.model_copy(update={"results": ["journal.film"]}))
    assert alone.accurate
    assert alone.scene.loads.dynamic_inflow
    assert alone.errors["journal.film"] == make_plan(scene).errors["journal.film"]


def test_a_start_lifts_off_from_its_asperities(tmp_path):
    film, told, run = events("dlc_3_1_startup", tmp_path, wind_speeds=[16.0], duration=80.0)
    speed, share = np.abs(film["speed"].values), film["contact_share"].values
    standing = np.flatnonzero(speed == 0.0)
    assert film["converged"].values.all()
    assert share[standing] == pytest.approx(1.0, abs=1e-6)
    assert share[-1] < 1e-3
    assert np.isfinite(film["minimum_film"].values).all()
    # squeeze keeps the surfaces together beyond the speed that would part them at rest
    assert 0.1 < told["lift_off_speed"] < told["transition_speed"] < 1.0
    assert told["lift_off_time"] < told["transition_time"]
    assert 0.0 < told["contact_time"] < told["mixed_friction_time"] < 30.0
    assert 0.1 < told["mixed_friction_revolutions"] < 2.0
    lost = np.abs(np.diff(film["time"]))[0] * film["friction_power"].values
    mixed = (speed > 1e-3) & (film["eccentricity_ratio"].values > 0.95)
    assert told["mixed_friction_energy"] == pytest.approx(lost[mixed].sum(), rel=0.02)
    assert "transition at E_krit and mixed friction" in run.report.read_text(encoding="utf-8")


def test_the_film_outlasts_an_emergency_stop_and_is_then_squeezed_out(tmp_path):
    film, told, _ = events("dlc_5_1", tmp_path, wind_speeds=[12.0])
    assert film["converged"].values.all()
    assert told["contact_time"] == 0.0
    assert 0.0 < told["standstill_eccentricity_ratio"] < 0.95
    assert told["film_after_stop"] == pytest.approx(15.0, abs=5.0)  # s, of squeeze alone
    assert told["transition_speed"] == pytest.approx(0.0, abs=1e-3)


FULL = {
    "3.1": ("dlc_3_1_startup", [8.0, 20.0]),
    "4.1": ("dlc_4_2_shutdown", [12.0]),
    "4.2": ("dlc_4_2_shutdown", [16.0]),
    "5.1": ("dlc_5_1", [12.0]),
}
"""Pipeline and wind speeds, m/s, of one start or stop of each load case."""


@pytest.mark.slow
@pytest.mark.parametrize("dlc", FULL)
def test_a_start_and_a_stop_at_full_length_and_accuracy(dlc, tmp_path):
    name, speeds = FULL[dlc]
    scene = read_scene(next(path for path in PIPELINES if path.stem == name))
    run = lf.run(changed(scene, "loads", dlc=dlc, wind_speeds=speeds, seeds=1), out=tmp_path)
    assert run.failures == {}
    assert run.flagged == {}
    assert {"statistics", "journal", "thrust", "rolling"} <= {*run.tree.children}
    rollers = run.tree["rolling"].to_dataset()
    assert (rollers["not_converged"] == 0).all()
    assert (rollers["life"] > 0).all()
    table = run.tree["journal"].to_dataset().sel(bearing="N")
    assert (table["not_converged"] == 0).all()
    assert (table["smallest_film"] > 0).all()
    assert table["transition_time"].notnull().all()
    if dlc == "3.1":
        assert (table["lift_off_speed"] > 0).all()
        slowest = table["transition_speed"].sortby(table["wind_speed"]).values
        assert slowest[-1] > slowest[0]  # as Table 5-21 of [Jonuschies 2015]
    else:
        assert (table["film_after_stop"] > 0).all()  # as from 16 m/s on in Table 5-22
        assert (table["mixed_friction_revolutions"] < 0.01).all()


SHORT = {
    "6.1": ("dlc_6_1_parked", 50.0, 40.0),
    "6.2": ("dlc_6_1_parked", 50.0, 40.0),
    "6.3": ("dlc_6_1_parked", 40.0, 40.0),
    "6.4": ("dlc_6_4_idling", 8.0, 40.0),
    "7.1": ("dlc_7_1", 40.0, 40.0),
}
"""Pipeline, wind speed, m/s, and length, s, of load cases that `FULL` does not have."""


@pytest.mark.slow
@pytest.mark.parametrize("dlc", SHORT)
def test_rotors_that_stand_or_idle_run_to_the_end_by_the_defaults(dlc, tmp_path):
    name, speed, duration = SHORT[dlc]
    scene = read_scene(next(path for path in PIPELINES if path.stem == name))
    keys = {"wind_speeds": [speed], "seeds": 1, "duration": duration, "step": 0.05}
    keys |= {"yaw_errors": [0.2]}
    run = lf.run(changed(scene, "loads", dlc=dlc, **keys), out=tmp_path, workers=2)
    assert run.failures == {}
    assert run.flagged == {}
    table = run.tree["journal"].to_dataset()
    assert (table["not_converged"] == 0).all()
    assert (table["smallest_film"] > 0).all()
    turns = table["largest_pressure"].notnull()  # of samples in which the shaft turns
    assert turns.all() if dlc == "6.4" else not turns.any()
    manifest = json.loads((run.path / "manifest.json").read_text(encoding="utf-8"))
    if dlc != "6.4":
        assert "journal" not in manifest["refined"]  # cells help no shaft that stands


def test_the_report_ranks_ultimate_loads_with_their_safety_factors(tmp_path):
    scene = read_scene(next(path for path in PIPELINES if path.stem == "dlc_4_2_shutdown"))
    scene = scene.model_copy(update={"results": ["loads.statistics"]})
    scene = changed(
        scene, "loads", dlc=["4.1", "4.2"], wind_speeds=[12.0], duration=20.0, step=0.05,
        rung="tables",
    )  # fmt: skip
    run = lf.run(scene, out=tmp_path)
    table = run.tree["statistics"].to_dataset().sel(axis="x")["hub_force"]
    design = {
        case: (1.35 if "dlc4.2" in case else 1.0) * float(abs(table.sel(case=case)).max())
        for case in table["case"].values
    }
    page = run.report.read_text(encoding="utf-8")
    assert "Ultimate loads" in page
    row = page.split("Ultimate loads")[1].split("hub Fx")[1].split("</tr>")[0]
    assert max(design, key=design.get) in row
    assert f"{max(design.values()) / 1e3:.4g}" in row


def test_loads_command_takes_any_load_case(tmp_path):
    out = tmp_path / "loads.h5"
    with pytest.raises(SystemExit) as stop:
        main(
            [
                *("loads", "-o", str(out), "--dlc", "3.1", "--dlc", "6.1"),
                *("--wind-speed", "12", "--duration", "5", "--step", "0.05", "--rung", "tables"),
            ]
        )
    assert not stop.value.code
    assert [name for name, _ in iter_cases(open_cube(out))] == ["dlc3.1_v12_s1", "dlc6.1_v12_s1"]
