"""Films in motion begin with a past: what they do at first is no artefact of their start."""

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.solvers.motion.transient import OrbitStopped
from loadflow.numerics.prediction import foretell_past
from loadflow.scene import make_scene
from loadflow.scene.cases import Case
from loadflow.stages import journal as stage
from loadflow.stages.films import of_bearing as film_of_bearing
from loadflow.stages.films.of_bearing import follow
from loadflow.stages.films.past import AT_REST, Past, past_of

STEP, SPEED = 0.05, 1.2
CASE = Case(dlc="1.1", wind_speed=12.0, seed=1)
SIZE = {"diameter": 2.0, "width": 1.4, "relative_clearance": 1.1e-3}
SCENE = make_scene(
    {
        "accuracy": "given",
        "journal": {
            "bearings": ["N"],
            "motion": "transient",
            "rung": "reduced",
            "grid": (24, 8),
            "step": STEP,
            "geometry": SIZE,
        },
        "shaft": {"two_point": {}},
    }
)


def swinging(seed, seconds=60.0):
    """Loads and shaft of a rotor in turbulence: blades pass, and the wind drifts."""
    rng, time = np.random.default_rng(seed), np.arange(0.0, seconds, STEP)
    drift = np.zeros((2, time.size))
    for k in range(1, time.size):  # forgets in 5 s
        drift[:, k] = (1.0 - STEP / 5.0) * drift[:, k - 1] + 0.02 * rng.normal(size=2)
    for times, size in ((1.0, 0.1), (3.0, 0.35), (6.0, 0.1)):
        drift += size * np.sin(times * SPEED * time + rng.uniform(0.0, 6.28, (2, 1)))
    force = np.stack([0 * time, 4e5 * drift[0], -8e5 * (1.0 + 0.5 * drift[1])], axis=-1)
    return loads_of(time, np.full(time.size, SPEED)), xr.Dataset({"force": _rows(force)})


def _rows(values):
    return ("time", "axis"), values


def loads_of(time, speed):
    return xr.Dataset({"speed": ("time", speed)}, coords={"time": time})


def test_sines_go_on_before_a_series_and_its_mean_before_noise():
    step = np.arange(-60, 400)
    waves = np.stack([np.sin(0.31 * step), 2.0 + np.cos(0.11 * step)], axis=-1)
    past = foretell_past(waves[60:], 40, 60)
    assert np.abs(past - waves[:60]).max() < 0.1
    noise = 5.0 + np.random.default_rng(0).normal(size=(400, 1))
    assert np.abs(foretell_past(noise, 40, 200)[:100] - noise.mean()).max() < 0.5
    still = np.full((30, 2), 7.0)
    np.testing.assert_array_equal(foretell_past(still, 10, 5), still[:5])


def test_what_columns_are_to_each_other_they_are_before_a_series_too():
    one = swinging(3)[1]["force"].values[:, 1]
    past = foretell_past(np.stack([one, 3.0 - 2.0 * one], axis=-1), 100, 50)
    np.testing.assert_allclose(past[:, 1], 3.0 - 2.0 * past[:, 0], rtol=1e-9)


def test_a_path_begun_later_has_the_extremes_of_the_longer_one():
    journal, begun = SCENE.journal, {"past": [], "rest": []}
    for seed in range(4):
        loads, shaft = swinging(seed)
        whole = follow(journal, loads, shaft, past=past_of(SCENE, loads))
        for begin in (300, 467, 612):
            left = slice(begin, None)
            later, there = loads.isel(time=left), shaft.isel(time=left)
            kept = whole.isel(time=left)
            for name, past in (("past", past_of(SCENE, later)), ("rest", AT_REST)):
                path = follow(journal, later, there, past=past)
                np.testing.assert_array_equal(path["time"], later["time"])
                first = slice(0, 100)  # 5 s, in which the start shows
                begun[name].append(
                    [
                        np.abs(path.minimum_film / kept.minimum_film - 1.0)[first].mean(),
                        abs(path.minimum_film.min() / kept.minimum_film.min() - 1.0),
                        abs(path.maximum_pressure.max() / kept.maximum_pressure.max() - 1.0),
                    ]
                )
    past, rest = (np.array(begun[name], dtype=float) for name in ("past", "rest"))
    assert past[:, 0].mean() < 0.65 * rest[:, 0].mean()
    ours, theirs = (np.sqrt((found[:, 1:] ** 2).mean(axis=0)) for found in (past, rest))
    # what wind there was before, nobody knows
    assert np.all(ours < 0.6 * theirs)
    assert np.all(ours < [0.02, 0.01])


def test_a_past_is_two_turns_of_a_rotor_that_runs_and_none_of_one_that_stands():
    time = np.arange(0.0, 100.0, STEP)
    turn = 2.0 * np.pi / SPEED / STEP
    running = past_of(SCENE, loads_of(time, np.full(time.size, SPEED)))
    assert running == Past(round(2 * turn), round(turn), round(10 * turn))
    stop = past_of(SCENE, loads_of(time, np.where(time < 20.0, SPEED, 0.0)))
    assert stop == Past(round(2 * turn), round(turn), 400)
    short = past_of(SCENE, loads_of(time[:9], np.full(9, SPEED)))
    assert short == Past(round(2 * turn), 3, 9)
    start = np.where(time < 20.0, 0.0, SPEED)
    for speed in (start, np.maximum(start, 0.05), 0 * time):
        assert past_of(SCENE, loads_of(time, speed)) == AT_REST
    assert past_of(SCENE, loads_of(time[:3], np.full(3, SPEED))) == AT_REST


def _in_stage(loads, shaft):
    there = shaft.expand_dims(bearing=["N"])
    return stage.orbit(SCENE, CASE, {"loads": loads, "shaft": there})["N"].to_dataset()


def test_a_start_from_standstill_begins_at_rest():
    loads, shaft = swinging(1, 10.0)
    turning = loads.assign(speed=loads["speed"] * np.linspace(0.09, 1.0, 200))
    shaft = 0.05 * shaft  # the film carries it all the time
    found = _in_stage(turning, shaft)
    path = follow(SCENE.journal, turning, shaft)
    np.testing.assert_array_equal(found["minimum_film"], path["minimum_film"])


@pytest.mark.parametrize("samples", [5, 40, 200])
def test_series_of_any_length_keep_their_samples(samples):
    loads, shaft = (part.isel(time=slice(samples)) for part in swinging(2, 10.0))
    found = _in_stage(loads, shaft)
    np.testing.assert_array_equal(found["time"], loads["time"])
    assert found["converged"].values.all()
    rest = follow(SCENE.journal, loads, shaft)
    assert found["minimum_film"].values[0] != rest["minimum_film"].values[0]


def test_where_no_film_carries_a_past_the_path_begins_at_rest(monkeypatch):
    loads, shaft = swinging(2, 10.0)
    heavy = Past.before

    def overloaded(self, series):
        found = heavy(self, series)
        found["force"][: self.steps] *= 1e4
        return found

    monkeypatch.setattr(film_of_bearing.Past, "before", overloaded)
    with pytest.warns(ValidityWarning, match="foretold before t = 0 s .* begins at rest"):
        path = follow(SCENE.journal, loads, shaft, past=past_of(SCENE, loads))
    rest = follow(SCENE.journal, loads, shaft)
    np.testing.assert_array_equal(path["minimum_film"], rest["minimum_film"])
    with pytest.raises(SolverError):
        follow(SCENE.journal, loads, shaft * 1e4)


def test_a_path_that_stops_later_is_not_followed_twice(monkeypatch):
    loads, shaft = swinging(2, 80.0)
    shaft["force"][1300:] *= 1e4  # after what the past is foretold from
    begun, before = [], Past.before

    def counted(self, series):
        begun.append(self.steps)
        return before(self, series)

    monkeypatch.setattr(film_of_bearing.Past, "before", counted)
    past = past_of(SCENE, loads)
    with pytest.raises(OrbitStopped) as stop:
        follow(SCENE.journal, loads, shaft, past=past)
    assert begun == [past.steps]
    assert stop.value.time == pytest.approx(1300 * STEP, abs=STEP)
