"""The scene's own bearings under the shaft: frames, stiffness, and the choice in a scene."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case as synthetic_case

from loadflow.cube import make_cube, open_cube, save_cube
from loadflow.errors import InputError, SolverError
from loadflow.planning.ladder import expected_seconds, measured
from loadflow.planning.plan import make_plan
from loadflow.running.runner import run
from loadflow.scene.scene import make_scene
from loadflow.shaft import TwoPoint
from loadflow.shaft import bearing_loads as suspended
from loadflow.stages.films.support import film_model
from loadflow.stages.reduction import reduced_loads
from loadflow.stages.registry import models
from loadflow.stages.rolling_support import rolling_model
from loadflow.stages.seeds import series_of
from loadflow.stages.shaft import bearing_loads, summary
from loadflow.turbines import load_turbine

SHAFT = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 1.6}]}
SLEWING = {
    "balls": 90,
    "rows": 2,
    "ball_diameter": 0.12,
    "pitch_diameter": 3.6,
    "groove_radius": 0.0624,
    "contact_angle": 0.7854,
    "row_spacing": 0.15,
}
SPHERICAL = {
    "kind": "spherical",
    "rollers": 28,
    "roller_diameter": 0.09,
    "roller_length": 0.2,
    "pitch_diameter": 1.6,
    "contact_angle": 0.2,
}
FORCE = np.array([[0.0, 1e5, -1.1e6], [0.0, -2e5, -6e5]])
MOMENT = np.array([[0.0, 3e4, -2e4], [0.0, -1e4, 5e4]])


class _Case:
    name, file, dlc, wind_speed, seed, weight = "dlc1.1_v12_s1", "", "1.1", 12.0, 1, 1.0
    duration = 600.0


def scene_of(supports, **sections):
    shaft = {"two_point": {"beam": SHAFT | {"supports": supports}}}
    return make_scene({"name": "x", "results": ["loads.statistics"], "shaft": shaft} | sections)


def slopes(model, force, moment, size):
    """Motion, and its derivative by load by central differences, (n, size, size)."""
    steps = (1e2, 1e2, 1e1, 1e1)[:size]
    columns = []
    for k, step in enumerate(steps):
        push = np.zeros((2, 3))
        push[k // 2, 1 + k % 2] = step
        ahead, behind = (model(force + s * push[0], moment + s * push[1])[0] for s in (1, -1))
        columns.append((ahead - behind) / (2 * step))
    return model(force, moment)[0], np.stack(columns, axis=-1)


@pytest.mark.parametrize(("tilting", "rung"), [(True, "grid"), (False, "grid"), (False, "reduced")])
def test_the_stiffness_of_a_film_is_the_slope_of_its_motion(tilting, rung):
    journal = scene_of([], journal={"tilt": True, "grid": [36, 8], "rung": rung}).journal
    model = film_model(journal, np.array([1.2, 1.3]), tilting=tilting)
    size = 4 if tilting else 2
    motion, soft = slopes(model, FORCE, MOMENT, size)
    stiffness = model(FORCE, MOMENT)[1]
    np.testing.assert_allclose(np.linalg.inv(stiffness), soft, rtol=1e-3, atol=1e-3 * soft.max())
    assert (motion[:, 1] < 0).all(), "a shaft pressed down lies low"
    if tilting:  # the ends go where the moment turns them: no negative work
        assert ((motion[:, 2:] * MOMENT[:, 1:]).sum(axis=1) > 0).all()


@pytest.mark.parametrize("tilting", [True, False])
def test_the_stiffness_of_a_rolling_bearing_is_the_slope_of_its_motion(tilting):
    part = scene_of([], rolling={"bearing": "N2", "geometry": SLEWING}).rolling
    model = rolling_model(part, np.array([4e5, 6e5]), tilting=tilting)
    motion, soft = slopes(model, FORCE, MOMENT, 4 if tilting else 2)
    stiffness = model(FORCE, MOMENT)[1]
    # motions across the shaft and tilts differ by the size of the bearing
    size = np.sqrt(np.einsum("nii->ni", soft))
    even = size[:, :, None] * size[:, None, :]
    assert abs(np.linalg.inv(stiffness) / even - soft / even).max() < 1e-4
    assert ((motion[:, :2] * FORCE[:, 1:]).sum(axis=1) > 0).all()


def test_a_bearing_that_aligns_itself_has_a_stiffness_across():
    part = scene_of([], rolling={"bearing": "N2", "geometry": SPHERICAL}).rolling
    model = rolling_model(part, np.array([1e5, 2e5]))
    _, soft = slopes(model, FORCE, MOMENT, 2)
    np.testing.assert_allclose(
        np.linalg.inv(model(FORCE, MOMENT)[1]), soft, rtol=1e-4, atol=1e-4 * soft.max()
    )


def test_a_film_at_one_end_and_rollers_at_the_other():
    """What comes out lies on both bearings' own curves, in the frame of the cube."""
    supports = [
        {"stiffness": "journal"},
        {"stiffness": "rolling", "takes_moment": True, "housing_tilt": 2e10},
    ]
    rolling = {"bearing": "N2", "geometry": SLEWING}
    scene = scene_of(supports, rolling=rolling, journal={"bearings": ["N"], "grid": [36, 8]})
    loads = synthetic_case(12.0, 1, steps=60)
    found = bearing_loads(scene, _Case, {"loads": loads})
    one = found.sel(bearing="N")
    speed = loads["speed"].values.astype(float)
    film, _ = film_model(scene.journal, speed)(one["force"].values.T.astype(float), None)
    np.testing.assert_allclose(one["displacement"].values[1:].T, film, rtol=1e-4, atol=1e-9)
    two = found.sel(bearing="N2")
    force, moment = (two[name].values.T.astype(float) for name in ("force", "moment"))
    motion, _ = rolling_model(scene.rolling, force[:, 0], tilting=True)(force, moment)
    np.testing.assert_allclose(two["displacement"].values[1:].T, motion[:, :2], atol=1e-9)
    # the tilt in the bearing, not that of its housing
    np.testing.assert_allclose(two["tilt"].values[1:].T, motion[:, 2:], atol=1e-9)
    assert abs(motion[:, 2:]).max() > 1e-6
    told = summary({_Case: found})
    assert told["not_converged"].item() == 0
    assert told["solved"].item() == 60
    # rollers are governed by the moment that they take
    reduced = reduced_loads(scene, _Case, {"loads": loads, "shaft": found})
    assert reduced["N2"]["load_edges"].attrs["units"] == "N m"


def test_the_moment_of_a_film_goes_back_to_the_shaft():
    """It takes a little of it; the film that is solved later has that moment and that tilt."""
    supports = [{}, {"stiffness": "journal", "takes_moment": True}]
    scene = scene_of(supports, journal={"tilt": True, "grid": [36, 8]})
    loads = synthetic_case(12.0, 1, steps=40)
    found = bearing_loads(scene, _Case, {"loads": loads})
    force, moment = (found[n].values[1].T.astype(float) for n in ("force", "moment"))
    assert 1e3 < abs(moment[:, 1:]).max() < 0.1 * abs(loads["hub_moment"].values[1:]).max()
    model = film_model(scene.journal, loads["speed"].values.astype(float), tilting=True)
    np.testing.assert_allclose(
        found["tilt"].values[1, 1:].T, model(force, moment)[0][:, 2:], rtol=1e-3, atol=1e-9
    )
    plain = suspended(
        TwoPoint(),
        *(loads[n].values.astype(float) for n in ("hub_force", "hub_moment")),
        tilt=load_turbine("nrel-5mw").rotor.tilt,
    )
    assert float(abs(found["force"] - plain["force"]).max()) > 1e3
    reduced = reduced_loads(scene, _Case, {"loads": loads, "shaft": found})
    assert reduced["N2"]["load_edges"].attrs["units"] == "N", "a film is governed by the force"
    _, tested = series_of(scene, {"loads": loads, "shaft": found})
    assert {"N2 Fy", "N2 Fz"} < set(tested)
    assert "N2 My" not in tested


def test_a_film_at_standstill_is_flagged_and_counted():
    scene = scene_of([{"stiffness": "journal"}, {}], journal={"grid": [36, 8]})
    loads = synthetic_case(12.0, 1, steps=30)
    loads["speed"][:7] = 1e-5
    found = bearing_loads(scene, _Case, {"loads": loads})
    assert not found["converged"].values[:, :7].any()
    assert found["converged"].values[:, 7:].all()
    assert summary({_Case: found})["not_converged"].item() == 7
    assert np.isfinite(found["displacement"]).all()
    loads["speed"][:] = 0.0
    assert not bearing_loads(scene, _Case, {"loads": loads})["converged"].any()


def test_the_plan_names_the_choice_and_feels_the_bearings():
    supports = [{"stiffness": "journal"}, {"stiffness": "rolling", "takes_moment": True}]
    rolling = {"bearing": "N2", "geometry": SLEWING}
    one, other = (
        scene_of(supports, rolling=rolling, journal={"lubricant": {"viscosity": v}})
        for v in (0.05, 0.06)
    )
    assert models()["shaft"].text_of(one) == "two_point, beam, iterated with N journal, N2 rolling"
    digests = [
        next(step.digest for step in make_plan(s).steps if step.name == "shaft")
        for s in (one, other)
    ]
    assert digests[0] != digests[1]
    known = measured(one, "shaft")
    assert "of the largest" in known["error"]
    cases = make_plan(one).cases
    slow, fast = (
        expected_seconds(one.model_copy(update={"journal": journal}), "shaft", cases)
        for journal in (one.journal, one.journal.model_copy(update={"rung": "map"}))
    )
    assert slow > 5 * fast > 0
    odd = one.journal.model_copy(update={"grid": (62, 22)})
    assert expected_seconds(one.model_copy(update={"journal": odd}), "shaft", cases) is None


@pytest.mark.parametrize(
    ("supports", "sections", "message"),
    [
        ([{"stiffness": "rolling"}, {}], {}, "rolling bearings at M only"),
        ([{}, {"stiffness": "journal"}], {"journal": {"bearings": ["N"]}}, "at N only"),
        ([{"stiffness": "journal", "takes_moment": True}, {}], {}, "journal.tilt = true"),
        (
            [{"stiffness": "rolling", "takes_moment": True}, {}],
            {"rolling": {"bearing": "N", "geometry": SPHERICAL}},
            "aligns itself",
        ),
        ([{"stiffness": "film"}, {}], {}, "stiffness"),
    ],
)
def test_a_support_without_such_a_bearing_is_refused(supports, sections, message):
    with pytest.raises(InputError, match=message):
        scene_of(supports, **sections)


def test_a_moment_that_presses_the_shaft_onto_the_rim_has_no_film():
    journal = scene_of([], journal={"tilt": True, "grid": [36, 8]}).journal
    model = film_model(journal, np.array([1.2, 1.2]), tilting=True, strict=False)
    force = np.array([[0.0, 0.0, -2.5e6]] * 2)
    motion, _ = model(force, np.array([[0.0, 3e5, 0.0], [0.0, 3e6, 0.0]]))
    assert np.isfinite(motion).all(axis=1).tolist() == [True, False]
    with pytest.raises(SolverError, match="no film carries"):
        film_model(journal, np.array([1.2]), tilting=True)(force[1:], np.array([[0.0, 3e6, 0.0]]))


def test_a_run_tells_that_shaft_and_bearings_were_iterated(tmp_path):
    still = synthetic_case(12.0, 1, steps=200)
    still["speed"][:5] = 0.0
    cube = save_cube(make_cube([synthetic_case(8.0, 1, steps=200), still]), tmp_path / "loads.h5")
    scene = scene_of(
        [{"stiffness": "journal"}, {"stiffness": "journal"}],
        journal={"grid": [36, 8]},
        loads={"files": [str(cube)]},
    )
    found = run(scene, out=tmp_path)
    told = found.tree["shaft"].to_dataset()
    assert told["not_converged"].values.tolist() == [0, 5]
    assert (told["solved"] == [150, 150]).all()
    assert list(found.flagged.values()) == [5]
    assert any("5 samples have rigid bearings" in line for line in found.warnings)
    page = found.report.read_text(encoding="utf-8")
    assert "iterated with N journal, N2 journal" in page
    # a part that is lost comes back the same
    part = next((found.path / "shaft").glob("*v12*"))
    before = open_cube(part).load()
    part.unlink()
    run(scene, out=tmp_path, report=False)
    xr.testing.assert_identical(before, open_cube(part).load())
