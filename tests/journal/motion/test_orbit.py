"""Orbits: the shaft under loads that change with time."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Supply,
)
from loadflow.tribology.film import squeeze_time

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(0.05)
MIXTURE = {"lubricant": OIL, "cavitation": GasMixture(5e4), "edge_pressure": 5e5, "grid": (36, 8)}
OMEGA = 1.2


def load(time):
    return np.stack([2e6 + 5e5 * np.sin(1.5 * time), 4e5 * np.cos(4 * time)], axis=-1)


@pytest.mark.parametrize(
    ("law", "edge"), [(GasMixture(5e4), 5e5), (MassConserving(), 5e5), (Reynolds(), 0.0)], ids=str
)
def test_constant_load_stays_at_the_static_equilibrium(law, edge):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": (36, 8)}
    orbit = BEARING.orbit(np.arange(6) * 0.1, np.tile([2e6, 1e5], (6, 1)), OMEGA, **film)
    np.testing.assert_allclose(
        orbit.eccentricity, np.broadcast_to(orbit.eccentricity[0], (6, 2)), atol=1e-12
    )
    assert orbit.attitude_angle[0] > 0


def test_slow_load_follows_the_static_equilibrium():
    time = np.linspace(0.0, 4000.0, 41)
    force = load(time / 1000)
    orbit = BEARING.orbit(time, force, OMEGA, **MIXTURE)
    static = BEARING.equilibrium(force, OMEGA, **MIXTURE)
    np.testing.assert_allclose(orbit.eccentricity_ratio, static.eccentricity_ratio, atol=2e-3)


@pytest.mark.parametrize(("law", "edge"), [(GasMixture(5e4), 5e5), (Reynolds(), 0.0)], ids=str)
def test_second_order_in_time(law, edge):
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, "grid": (36, 8)}
    ends = []
    for n in (20, 40, 80):
        time = np.linspace(0.0, 1.0, n + 1)
        # smooth start: the load leaves its first value with zero slope
        force = np.array([2e6, 2e5]) + np.outer(time**3, [6e5, -4e5])
        ends.append(BEARING.orbit(time, force, OMEGA, **film).eccentricity.values[-1])
    coarse, fine = np.linalg.norm(np.diff(ends, axis=0), axis=1)
    assert np.log2(coarse / fine) > 1.6


def test_path_meets_the_force_of_the_film_at_its_velocity():
    time = np.linspace(0.0, 2.0, 401)
    film = {"lubricant": OIL, "grid": (36, 8)}
    orbit = BEARING.orbit(time, load(time), OMEGA, **film)
    path = orbit.eccentricity.values
    velocity = (path[301] - path[299]) / (time[301] - time[299])
    state = BEARING.pressure(path[300], OMEGA, velocity=velocity, **film)
    np.testing.assert_allclose(state.force, load(time[300]), rtol=2e-3)


def test_squeeze_time_of_the_wide_film():
    bearing = JournalBearing(diameter=1.0, width=100.0, relative_clearance=1e-3)
    oil, force = Lubricant(0.09), 5e7
    end = squeeze_time(0.4, 0.8, force, 100.0, 0.5, 1e-3, 0.09)
    time = np.linspace(0.0, end, 81)
    start = np.array([0.4 * bearing.clearance, 0.0])
    # the closed form has p = 0 where the squeeze changes its sign
    lines = Supply([Groove(np.pi / 2), Groove(-np.pi / 2)])
    film = {"cavitation": Guembel(), "supply": lines, "grid": (180, 8)}
    orbit = bearing.orbit(time, np.tile([force, 0.0], (81, 1)), 0.0, oil, start=start, **film)
    assert orbit.eccentricity_ratio[-1] == pytest.approx(0.8, abs=2e-3)


def test_a_coarse_step_through_a_load_jump_is_cut_not_lost():
    time = np.arange(8) * 0.5
    force = np.tile([1e6, 0.0], (8, 1))
    force[4:] = [-2e7, 1.5e7]
    orbit = BEARING.orbit(time, force, OMEGA, **MIXTURE)
    assert float(orbit.residual.max()) < 1e-8
    assert float(orbit.eccentricity_ratio[-1]) < 1.0


def test_run_down_to_standstill_is_carried_by_squeeze():
    time = np.linspace(0.0, 10.0, 101)
    speed = OMEGA * np.clip(1 - time / 8, 0, None)
    orbit = BEARING.orbit(time, np.tile([1.5e6, 0.0], (101, 1)), speed, **MIXTURE)
    assert np.all(np.diff(orbit.eccentricity_ratio[-15:]) > 0)
    assert float(orbit.minimum_film.min()) > 0


def test_dataset_names_units_and_shapes():
    orbit = BEARING.orbit([0.0, 0.1], np.tile([2e6, 0.0], (2, 1)), OMEGA, **MIXTURE)
    names = "eccentricity_ratio eccentricity attitude_angle minimum_film maximum_pressure "
    names += "friction_power side_flow residual iterations"
    for name in names.split():
        assert {"units", "long_name"} <= set(orbit[name].attrs)
    assert orbit.eccentricity.dims == ("time", "axis")


@pytest.mark.parametrize(
    ("time", "speed", "options", "error", "message"),
    [
        ([0.0, 0.0], 1.0, {}, InputError, r"time\[1\] = 0.0 does not increase"),
        ([0.0, 1.0, 2.0], 1.0, {}, InputError, r"time \(3,\)"),
        ([0.0, 1.0], 0.0, {}, SolverError, r"orbit cannot start: F = \(2e\+06, 0\) N at ω = 0"),
        ([0.0, 1.0], 1.0, {"grading": "graded"}, InputError, "grading = 'graded'"),
        ([0.0, 1.0], 1.0, {"start": (1.0, 0.0)}, InputError, "start"),
    ],
)
def test_bad_input_is_named(time, speed, options, error, message):
    with pytest.raises(error, match=message):
        BEARING.orbit(time, np.tile([2e6, 0.0], (2, 1)), speed, **MIXTURE | options)
