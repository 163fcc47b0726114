"""Charts and historical rungs: their stated errors, measured against the grid; what they lack."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import Groove, Guembel, JournalBearing, Lubricant, Supply
from loadflow.tribology import film, film_tables

OIL = Lubricant(0.05)
RATIOS = np.array([0.15, 0.35, 0.55, 0.75, 0.88, 0.94, 0.985])


def bearing(width_ratio):
    return JournalBearing(diameter=1.0, width=width_ratio, relative_clearance=1e-3)


def rotating(width_ratio):
    """So, β (°) and p_max over p_mean of the grid at `RATIOS`."""
    shaft = bearing(width_ratio)
    places = np.stack([RATIOS * shaft.clearance, 0 * RATIOS], axis=-1)
    found = shaft.pressure(places, 1.0, OIL)
    load = np.hypot(*found.force.T)
    so = load * 1e-6 / (0.05 * shaft.width * shaft.diameter)
    beta = np.degrees(np.arctan2(-found.force[:, 1], found.force[:, 0]))
    return so, beta, found.maximum_pressure * shaft.width * shaft.diameter / load


@pytest.mark.parametrize(
    ("width", "so_share", "angle"),
    [
        (1.0, 0.066, 2.4),
        (0.5, 0.066, 2.4),
        (0.25, 0.066, 2.4),
        (0.125, 0.066, 2.4),
        (0.75, 0.1, 2.4),
    ],
)
def test_stated_error_of_the_closed_form(width, so_share, angle):
    so, beta, _ = rotating(width)
    closed, turn = film.butenschoen(RATIOS, width)
    np.testing.assert_allclose(closed, so, rtol=so_share)
    np.testing.assert_allclose(np.degrees(turn), beta, atol=angle)


@pytest.mark.parametrize("width", [0.15, 0.3, 0.75, 0.85])
def test_tables_hold_between_their_widths_and_rows(width):
    so, beta, peak = rotating(width)
    table, turn = film_tables.tabulated(RATIOS, width)
    np.testing.assert_allclose(table, so, rtol=4e-3)
    np.testing.assert_allclose(np.degrees(turn), beta, atol=0.3)
    np.testing.assert_allclose(film_tables.tabulated_peak(RATIOS, width), peak, rtol=0.01)
    shaft = bearing(width)
    places = np.stack([RATIOS * shaft.clearance, 0 * RATIOS], axis=-1)
    for sign in (1.0, -1.0):
        squeeze = {"velocity": (sign * shaft.clearance, 0.0), "inlet": None}
        found = shaft.pressure(places, 0.0, OIL, **squeeze)
        number = np.hypot(*found.force.T) * 1e-6 / (0.05 * shaft.width)
        got = film_tables.tabulated_squeeze(sign * RATIOS, width)
        np.testing.assert_allclose(got, number, rtol=5e-3)


@pytest.mark.parametrize(("rung", "share"), [("chart", 0.07), ("table", 0.015)])
def test_equilibrium_beside_the_grid(rung, share):
    shaft = bearing(0.5)
    force = np.array([[3e4, 0.0], [-1e5, 2e4], [0.0, 6e5], [1e5, 1e5]])
    speed = np.array([2.0, -1.0, 1.0, 0.5])
    grid = shaft.equilibrium(force, speed, OIL)
    quick = shaft.equilibrium(force, speed, OIL, rung=rung)
    assert quick.converged.all()
    for name in ("eccentricity_ratio", "maximum_pressure", "friction_power", "side_flow"):
        np.testing.assert_allclose(getattr(quick, name), getattr(grid, name), rtol=share)
    atol = share * shaft.clearance
    np.testing.assert_allclose(quick.eccentricity, grid.eccentricity, atol=atol)
    np.testing.assert_allclose(quick.sommerfeld_number, grid.sommerfeld_number)
    scalar = shaft.equilibrium(force[0], speed[0], OIL, rung=rung)
    assert scalar.eccentricity_ratio == pytest.approx(quick.eccentricity_ratio[0])


def test_what_a_chart_cannot_say_is_none_and_nothing_else_is_nan():
    state = bearing(0.5).equilibrium([(1e5, 0.0), (0.0, 0.0)], [1.0, 1.0], OIL, rung="chart")
    missing = [name for name, value in vars(state).items() if value is None]
    smooth = [name for name in missing if name.startswith("contact_")]
    others = [name for name in missing if name not in smooth]
    unknown = ["total_fill", "stiffness", "damping", "relative_grid_error", "temperature"]
    assert others == unknown  # isothermal, and without cells
    values = [np.asarray(v, dtype=float) for v in vars(state).values() if v is not None]
    assert all(np.isfinite(v).all() for v in values)
    assert state.eccentricity_ratio[1] == 0.0


@pytest.mark.parametrize("rung", ["chart", "table"])
def test_where_a_chart_ends(rung):
    shaft = bearing(0.5)
    with pytest.raises(InputError, match="a chart has no history"):
        shaft.orbit([0.0, 1.0], np.ones((2, 2)), 1.0, OIL, rung=rung)
    with pytest.raises(SolverError, match=r"load 1: F = \(1e\+09, 0\) N .* the chart ends there"):
        shaft.equilibrium([(1e5, 0.0), (1e9, 0.0)], 1.0, OIL, rung=rung)
    with pytest.raises(SolverError, match="ω = 0 rad/s: without rotation"):
        shaft.equilibrium((1e5, 0.0), 0.0, OIL, rung=rung)
    state = shaft.equilibrium([(1e5, 0.0), (1e9, 0.0)], 1.0, OIL, rung=rung, strict=False)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.minimum_film[1])
    with pytest.raises(InputError, match=r"width/diameter = 1\.5"):
        bearing(1.5).equilibrium((1e5, 0.0), 1.0, OIL, rung=rung)
    with pytest.raises(InputError, match="supply"):
        shaft.equilibrium((1e5, 0.0), 1.0, OIL, supply=Supply([Groove(1.0)]), rung=rung)


def load(time):
    return np.stack([1.2e5 + 4e4 * np.sin(1.3 * time), 5e4 * np.cos(3 * time)], axis=-1)


@pytest.mark.parametrize(
    ("rung", "share"), [("holland", 0.05), ("butenschoen", 0.05), ("hahn", 0.06)]
)
def test_historical_orbits_beside_the_grid(rung, share):
    shaft, time = bearing(0.5), np.linspace(0.0, 10.0, 201)
    grid = shaft.orbit(time, load(time), 1.0, OIL, grid=(60, 12))
    old = shaft.orbit(time, load(time), 1.0, OIL, grid=(60, 12), rung=rung)
    largest = float(grid.eccentricity_ratio.max())
    assert float(old.eccentricity_ratio.max()) == pytest.approx(largest, rel=share)
    power = float(grid.friction_power.mean())
    assert float(old.friction_power.mean()) == pytest.approx(power, rel=0.15)
    assert old.in_range.all()


@pytest.mark.parametrize(("rung", "static"), [("holland", "table"), ("butenschoen", "chart")])
def test_superposed_vectors_at_rest_are_the_chart(rung, static):
    shaft, time = bearing(0.75), np.arange(6) * 0.5
    chart = shaft.equilibrium((2e5, 1e4), -1.0, OIL, rung=static)
    assert shaft.equilibrium((2e5, 1e4), -1.0, OIL, rung=rung).minimum_film == chart.minimum_film
    orbit = shaft.orbit(time, np.tile([2e5, 1e4], (6, 1)), -1.0, OIL, rung=rung)
    here = np.broadcast_to(chart.eccentricity, (6, 2))
    np.testing.assert_allclose(orbit.eccentricity, here, atol=1e-4 * shaft.clearance)
    power = orbit.friction_power
    np.testing.assert_allclose(power, np.full(6, chart.friction_power), rtol=1e-3)
    assert not {"maximum_pressure", "side_flow", "total_fill"} & set(orbit.data_vars)


def test_superposed_squeeze_is_the_table_of_its_sense():
    """A shaft at rest: its velocity is the load over So_V, which differs for rising and falling."""
    shaft, time = bearing(0.25), np.array([0.0, 1e-5])
    for sign in (1.0, -1.0):
        start = (0.6 * shaft.clearance, 0.0)
        force = np.tile([sign * 2e4, 0.0], (2, 1))
        orbit = shaft.orbit(time, force, 0.0, OIL, rung="holland", start=start)
        got = np.diff(orbit.eccentricity[:, 0])[0] / 1e-5 / shaft.clearance
        number = float(film_tables.tabulated_squeeze(sign * 0.6, 0.25))
        expected = sign * 2e4 * 1e-6 / (0.05 * shaft.width * number)
        assert got == pytest.approx(expected, rel=2e-3)


def test_superposed_pressures_are_the_guembel_film_above_ambient():
    shaft, ambient = bearing(0.5), 2e5
    film_of = {"lubricant": OIL, "grid": (60, 12), "edge_pressure": ambient}
    law = Guembel(cavitation_pressure=ambient)
    hahn = shaft.equilibrium((1e5, 0.0), 1.0, rung="hahn", **film_of)
    grid = shaft.equilibrium((1e5, 0.0), 1.0, cavitation=law, inlet=None, **film_of)
    assert hahn.eccentricity_ratio == pytest.approx(float(grid.eccentricity_ratio), rel=5e-3)
    assert hahn.maximum_pressure == pytest.approx(float(grid.maximum_pressure), rel=5e-3)


def test_tables_refuse_what_they_do_not_hold():
    with pytest.raises(InputError, match=r"width/diameter = 2"):
        film_tables.tabulated(0.5, 2.0)
    with pytest.raises(InputError, match=r"0 … 0\.99"):
        film_tables.tabulated_squeeze(-0.995, 0.5)
