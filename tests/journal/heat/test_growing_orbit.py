"""Clearances that follow the temperature which a bearing stores, beside the fast path."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import Film, GasMixture, Growth, Heat, JournalBearing, TiltingPads
from loadflow.journal.growing_orbit import CHANGE

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
SPEED, LOAD = 1.27, np.array([1e6, 0.0])
COLD = {"oil": "mineral-vg-320", "transfer": 300.0, "capacity": 1e6, "start_temperature": 293.15}
NARROWS, WIDENS = Growth(shell_share=0.7), Growth(shell_expansion=18e-6)


def film(rung="reduced", **heat):
    return Film(
        heat=Heat(**COLD | heat), cavitation=GasMixture(5e4), edge_pressure=1e5, grid=(48, 8),
        inlet=None, grading="uniform", rung=rung,
    )  # fmt: skip


def run_up(options, hours=3.0, count=541, **words):
    time = np.linspace(0.0, 3600.0 * hours, count)
    return BEARING.orbit(time, np.tile(LOAD, (count, 1)), SPEED, options, **words)


@pytest.mark.parametrize("rung", ["reduced", "grid"])
@pytest.mark.parametrize(("growth", "way"), [(NARROWS, -1), (WIDENS, 1)], ids=["narrows", "widens"])
def test_a_bearing_that_runs_up_from_cold_grows_to_what_it_has_at_rest(growth, way, rung):
    options = film(rung, growth=growth)
    path = run_up(options)
    rest = BEARING.equilibrium(LOAD, SPEED, options)
    width = path["clearance"].values
    # a piece keeps its clearance, and warms a little too far in it
    assert (way * np.diff(width) >= -CHANGE * width[1:]).all()
    assert abs(width[-1] / width[0] - 1) > 0.1
    assert float(path["temperature"][-1]) == pytest.approx(float(rest.temperature), abs=0.05)
    # one piece has one clearance, which then is off by a thousandth at most
    assert width[-1] == pytest.approx(float(rest.clearance), rel=2 * CHANGE)
    end = path.isel(time=-1)
    for name in ("minimum_film", "friction_power", "eccentricity_ratio"):
        expected = float(getattr(rest, name))
        assert float(end[name]) == pytest.approx(expected, rel=10 * CHANGE), name


def test_the_clearance_is_that_of_the_temperature_at_every_time():
    path = run_up(film(growth=NARROWS))
    wider = NARROWS.radial(path["temperature"].values, 293.15, BEARING.radius)
    expected = BEARING.clearance + wider
    # and by the growth in the first step of a piece, before which it is not known
    steps = np.abs(np.diff(expected)).max()
    assert np.abs(path["clearance"].values - expected).max() < CHANGE * BEARING.clearance + steps


def test_parts_that_grow_alike_have_the_path_of_those_that_do_not_grow():
    grows, still = run_up(film(growth=Growth())), run_up(film())
    # pieces begin with a film at rest, which these steps of 20 s hardly feel
    for name in ("eccentricity", "temperature", "minimum_film"):
        np.testing.assert_allclose(grows[name], still[name], rtol=1e-4)
    assert (grows["clearance"] == BEARING.clearance).all()


def test_a_day_of_changing_wind_ends_each_long_span_where_it_rests():
    """Bearings of 1 MJ/K take 20 minutes or so: after five hours they have forgotten the last."""
    spans = [(0.7, 3e5), (1.27, 1.2e6), (0.5, 2e5), (1.1, 8e5)]
    time = np.linspace(0.0, 20 * 3600.0, 1201)
    span = np.minimum((time / (5 * 3600.0)).astype(int), 3)
    speeds, loads = np.array(spans).T
    options = film(growth=NARROWS, ambient_temperature=283.15, start_temperature=283.15)
    force = np.stack([loads[span], 0.0 * time], axis=-1)
    path = BEARING.orbit(time, force, speeds[span], options)
    for number, (speed, load) in enumerate(spans):
        end = path.isel(time=int(np.flatnonzero(span == number)[-1]))
        rest = BEARING.equilibrium((load, 0.0), speed, options)
        assert float(end["temperature"]) == pytest.approx(float(rest.temperature), abs=0.1)
        expected = float(rest.minimum_film)
        assert float(end["minimum_film"]) == pytest.approx(expected, rel=10 * CHANGE)


def test_half_the_steps_have_the_same_temperatures():
    """Of first order, 0.057 K at 5 s of a rise of 30 K: pieces end at other samples."""
    coarse, fine = (run_up(film(growth=NARROWS), 0.5, count) for count in (361, 721))
    np.testing.assert_allclose(coarse["temperature"], fine["temperature"][::2], atol=0.1)
    np.testing.assert_allclose(coarse["minimum_film"], fine["minimum_film"][::2], rtol=3 * CHANGE)


@pytest.mark.parametrize(("hours", "sample"), [(12.0, r"1\d"), (3.0, r"4\d|5\d")])
def test_a_shaft_that_grows_into_its_shell_while_it_warms_is_told(hours, sample):
    """After some 20 minutes, whatever the steps; the sample is that of the whole path."""
    with pytest.raises(SolverError, match=rf"grows into its shell at sample ({sample}), 3\d\d"):
        run_up(film(growth=Growth(shell_share=0.1)), hours=hours)


@pytest.mark.slow
def test_each_bound_is_that_of_the_piece_in_which_its_answer_is_worst():
    """A heavy load while the film is thick and cold; later the shaft is slow and its film thin."""
    time = np.linspace(0.0, 3600.0, 361)
    late = time > 1800.0
    force = np.where(late, 4e5, 2.5e6)[:, None] * np.array([1.0, 0.0])
    speed = np.where(late, 0.02, SPEED)
    options = film("grid", growth=NARROWS)
    path = BEARING.orbit(time, force, speed, options)
    high = int(np.argmax(path["maximum_pressure"].values))
    narrow = int(np.argmin(path["minimum_film"].values))
    assert time[high] < 1800.0 < time[narrow]
    early = BEARING.orbit(time[~late], force[~late], speed[~late], options)
    told = "maximum_pressure_grid_error"
    assert path.attrs[told] == pytest.approx(early.attrs[told], rel=0.3)


def test_a_start_is_told_in_metres_whatever_has_grown():
    place = np.array([2e-4, 1e-4])
    for stored in ({}, {"capacity": None, "start_temperature": None}):
        path = run_up(film(growth=NARROWS, **stored), hours=0.01, count=5, start=place)
        np.testing.assert_allclose(path["eccentricity"][0], place, rtol=1e-9)


def test_what_tilts_freely_is_refused_by_name():
    time, force = np.linspace(0.0, 1.0, 3), np.tile(LOAD, (3, 1))
    with pytest.raises(InputError, match=r"heat.*without growth where pads or a shaft tilt freely"):
        BEARING.orbit(time, force, SPEED, film(growth=NARROWS), moment=(1e4, 0.0))
    pads = JournalBearing(1.4, 1.3, 1e-3, shape=TiltingPads(5, 1.05, preload=0.2, angle=0.628))
    with pytest.raises(InputError, match=r"heat.*without growth where pads or a shaft tilt freely"):
        pads.orbit(time, force, SPEED, film(growth=NARROWS))
