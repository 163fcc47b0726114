"""Time in mixed friction of a candidate, and counted anew with films as wrong as they may be."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from loadflow.quantities import HOURS_PER_YEAR
from loadflow.scene.scene import make_scene
from loadflow.stages.films.summary import mixed_friction
from loadflow.studies.candidate.mixed import mixed_time
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.seeds.intervals import Groups

SCENE = make_scene({"name": "s", "bearings": "journal-cylindrical", "shaft": {"two_point": {}}})
CLEARANCE = SCENE.journal.at("N").geometry.clearance / 2
LIMIT = SCENE.journal.at("N").critical.ratio


def series(ratio):
    """A shaft that turns steadily, with ε as given at 101 times."""
    ratio = np.broadcast_to(np.asarray(ratio, float), 101)
    film = CLEARANCE * (1 - ratio)
    touching = film < SCENE.journal.at("N").contact_film
    data = {
        "speed": np.full(101, 1.2), "weight": np.ones(101), "load": np.full(101, 1e6),
        "in_contact": touching, "converged": np.ones(101, bool), "eccentricity_ratio": ratio,
        "minimum_film": film, "friction_power": np.full(101, 1e3), "time": np.arange(101.0),
    }  # fmt: skip
    about = {"critical_eccentricity_ratio": LIMIT, "boundary_friction": 0.1, "radius": 1.0}
    return xr.Dataset({k: ("sample", v) for k, v in data.items()}, attrs=about)


def run(folder: Path, error, *cases, dlcs=None, share=None):
    tables = []
    (folder / "journal").mkdir()
    for k, one in enumerate(cases):
        one.to_netcdf(folder / "journal" / f"c{k}.h5", group="N", engine="h5netcdf")
        tables.append(mixed_friction(one).expand_dims(bearing=["N"]))
    table = xr.concat(tables, "case").assign_coords(
        case=[f"c{k}" for k in range(len(cases))], wind_speed=("case", [8.0] * len(cases)),
        dlc=("case", dlcs or ["1.1"] * len(cases)), seed=("case", [*range(len(cases))]),
    )  # fmt: skip
    manifest = {"expected_errors": {"journal.film": {"minimum film": error}}}
    one = Finished("a", "", "", SCENE, {"journal": table}, manifest, folder)
    share = np.full(len(cases), 1 / len(cases)) if share is None else np.array(share)
    return mixed_time(one, table, share, Groups.of(table))


def test_films_that_would_reach_the_limit_by_their_error_are_the_error_of_the_time(tmp_path):
    # a quarter of the time above E_krit, and as long again within 10 % of the film there
    near, deep, far = 1 - 1.05 * (1 - LIMIT), 1 - 0.8 * (1 - LIMIT), LIMIT / 2
    found = run(tmp_path, 0.1, series([deep] * 25 + [near] * 25 + [far] * 51))
    assert found.value == pytest.approx(HOURS_PER_YEAR * 25 / 101)
    assert found.error == pytest.approx(1.0)


def test_a_time_of_0_that_stays_0_has_no_error(tmp_path):
    found = run(tmp_path, 0.1, series(LIMIT / 2), series(0.5 * LIMIT))
    assert (found.value, found.error) == (0.0, 0.0)


def test_a_time_of_0_that_does_not_stay_0_says_what_it_becomes(tmp_path):
    found = run(tmp_path, 0.1, series(1 - 1.05 * (1 - LIMIT)), series(0.5 * LIMIT))
    assert np.isnan(found.error)
    assert f"{HOURS_PER_YEAR / 2:.3g} h with films thinner by 10 %" in found.note


def test_where_films_have_no_error_the_time_has_none(tmp_path):
    assert np.isnan(run(tmp_path, None, series(LIMIT / 2)).error)


def test_starts_without_a_share_are_told_with_what_gives_them_one(tmp_path):
    runs, starts = series(LIMIT / 2), series([1.0] * 10 + [0.5] * 91)
    found = run(tmp_path, None, runs, starts, dlcs=["1.1", "3.1"], share=[1.0, 0.0])
    assert found.value == 0.0
    said = "without DLC 3.1, up to 10 s each time: lifetime.per_year says how often"
    assert said in found.note


def test_a_year_of_nothing_but_starts_says_that_it_is_one(tmp_path):
    found = run(tmp_path, None, series([1.0] * 10 + [0.5] * 91), dlcs=["3.1"])
    assert "nothing but starts" in found.note
