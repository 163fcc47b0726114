"""Half-speed whirl of a shaft is known where a film does not rupture, and told."""

import numpy as np
import pytest
import xarray as xr

from loadflow.journal import JournalBearing, Lubricant
from loadflow.planning.accuracy import error_by_change, rungs_up
from loadflow.planning.ladder import measured
from loadflow.scene import make_scene
from loadflow.scene.cases import Case
from loadflow.stages.comparisons import compare
from loadflow.stages.film_summary import warnings
from loadflow.stages.journal import orbit
from loadflow.stages.whirl import whirling

SPEED, STEP = 1.2, 0.05
WIDE = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)


def path_of(edge_pressure, force=1.2e6):
    """A light shaft that begins far out, over eight of its turns."""
    time = STEP * np.arange(int(16 * np.pi / SPEED / STEP))
    options = {"edge_pressure": edge_pressure, "grid": (60, 12), "rung": "reduced", "inlet": None}
    path = WIDE.orbit(
        time,
        np.tile([force, 0.0], (time.size, 1)),
        np.full(time.size, SPEED),
        Lubricant(0.05),
        start=(0.97 * WIDE.clearance, 0.0),
        **options,
    )
    place = path["eccentricity"].values
    data = {"time": ("sample", time), "speed": ("sample", np.full(time.size, SPEED))}
    return xr.Dataset(data | {"eccentricity": (("sample", "component"), place)})


def test_a_light_shaft_whirls_in_a_film_under_pressure_and_not_in_one_that_ruptures():
    pressed, open_ended = (whirling(path_of(p)) for p in (5e5, 1e5))
    assert pressed.mean() > 0.95
    assert not open_ended.any()


@pytest.mark.parametrize(("turns", "found"), [(0.5, True), (0.35, False), (0.0, False)])
def test_whirl_is_that_of_half_the_speed(turns, found):
    time = np.arange(0.0, 60.0, STEP)
    angle = turns * SPEED * time
    place = 1e-4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    data = {"time": ("sample", time), "speed": ("sample", np.full(time.size, SPEED))}
    samples = xr.Dataset(data | {"eccentricity": (("sample", "component"), place)})
    assert (whirling(samples) == found).all()
    assert not whirling(samples.isel(sample=slice(500))).any()  # for less than six turns


def test_cells_are_not_asked_about_a_shaft_that_whirls_throughout():
    """Nothing but they damp it; the film is told as one that is not checked."""
    case = Case("1.1", 12.0, 1)
    time = STEP * np.arange(800)
    loads = xr.Dataset({"time": time, "speed": ("time", np.full(time.size, SPEED))})
    force = np.tile([0.0, 0.0, -2e5], (time.size, 1))[None]
    rows = {name: (("bearing", "time", "axis"), row) for name, row in
            {"force": force, "moment": 0.0 * force}.items()}  # fmt: skip
    shaft = xr.Dataset(rows).assign_coords(bearing=["N"], time=time)
    angle = 0.5 * SPEED * time
    place = 0.97 * WIDE.clearance * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    scene = make_scene(
        {
            "accuracy": "given",
            "journal": {"bearings": ["N"], "rung": "reduced", "motion": "transient"},
            "shaft": {"two_point": {}},
        }
    )
    parts = {"loads": loads, "shaft": shaft}
    film = orbit(scene, case, parts)["N"].to_dataset()
    film["eccentricity"].values[:] = place
    parts["journal"] = xr.DataTree.from_dict({"N": film})
    rows = [row for row in compare(scene, case, parts) if row.stage == "journal"]
    assert [row.quantity for row in rows] == ["minimum film"]
    assert np.isnan(rows[0].value)
    assert "whirls at half its speed" in rows[0].against


def test_a_whirl_is_told_with_its_share_of_the_time():
    table = xr.Dataset(
        {"whirl_share": (("bearing", "case"), [[0.0, 0.02], [0.3, 0.96]])},
        {"bearing": ["N", "N2"], "case": ["calm", "start"]},
    )
    (said,) = warnings(xr.DataTree.from_dict({"journal": table}))
    assert "bearing N2" in said
    assert "2 of 2 load cases, start for 96 %" in said


def test_a_model_jumps_to_the_first_rung_that_the_ladder_lets_expect_to_hold():
    film = {"motion": "transient", "rung": "reduced", "grid": (60, 20)}
    scene = make_scene({"journal": film, "shaft": {"two_point": {}}})
    errors = [
        measured(scene, "journal", f"reduced, {cells}")["errors"]["minimum film"]["max"]
        for cells in (60, 120, 240, 480)
    ]
    # were the next rung to move the film by as much as in the ladder, each rung has its error
    own = error_by_change(scene, "journal", "minimum film", errors[0] - errors[1])
    assert own == pytest.approx(errors[0])
    for up in (1, 2, 3):
        assert rungs_up(scene, "journal", "minimum film", own, 1.01 * errors[up]) == up
    assert rungs_up(scene, "journal", "minimum film", own, 0.1 * errors[3]) == 3
    assert rungs_up(scene, "journal", "not measured", own, 1e-9) == 1
    assert rungs_up(scene, "journal", "minimum film", float("inf"), 0.05) == 1
    assert error_by_change(scene, "journal", "not measured", 0.03) == 0.03
