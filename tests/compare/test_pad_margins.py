"""How far loads on thrust collars may grow, and their bands: warm, tilted and in motion."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal.thrust import row_table
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.candidate import Candidate
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.thrust import Thrust
from loadflow.stages.bores import against_bore
from loadflow.stages.thrust import solved
from loadflow.studies.candidate import factor as candidate_factor
from loadflow.studies.candidate import margins as candidate_margins
from loadflow.studies.candidate import pads as candidate_pads
from loadflow.studies.candidate.deviations import Built, _tilted, tolerances_of
from loadflow.studies.candidate.factor import (
    WIDEST,
    Margin,
    film_factors,
    grown,
    pressure_factor,
)
from loadflow.studies.candidate.margins import margin_of
from loadflow.studies.candidate.pad_films import PadFilms, pad_films
from loadflow.studies.candidate.pads import pad_margins, value_of
from loadflow.studies.compare.bands import _samples_of_pads, cheap_numbers
from loadflow.studies.compare.comparison import _governed
from loadflow.studies.one_bearing.thrust import thrust_point

LANDS = {"pads": 6, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.9, "taper": 1e-4}


def collar(**more):
    data = {"kind": "thrust", "geometry": LANDS, "grid": (8, 4), "heat": {"oil": "mineral-vg-320"}}
    return Thrust(bearings={"N2": data | more}, rung="curve", motion="transient", tilt=True)


def series(count=40):
    time = np.arange(count) * 0.1
    force = np.zeros((count, 3))
    force[:, 0] = 4e5 + 2e5 * np.sin(2.0 * time)
    tilt = np.zeros((count, 3))
    tilt[:, 1] = 1e-5 * force[:, 0] / 4e5
    axes = ("sample", "axis")
    return xr.Dataset(
        {
            "force": (axes, force), "moment": (axes, 0.0 * force), "tilt": (axes, tilt),
            "time": ("sample", time), "speed": ("sample", np.full(count, 1.2)),
            "weight": ("sample", np.full(count, 1.0 / count)),
            "running": ("sample", np.ones(count, bool)),
        },
        {"axis": ["x", "y", "z"]},
    )  # fmt: skip


@pytest.mark.parametrize("moving", [True, False])
def test_films_at_the_loads_of_a_run_are_those_of_the_run(moving):
    thrust, samples = collar(), series()
    bearing = thrust.bearings["N2"]
    ran = solved(bearing, "N2", samples, thrust.rung, moving)
    found = pad_films(bearing, samples, moving)
    for name in ("minimum_film", "maximum_pressure", "friction_power"):
        assert getattr(found, name) == pytest.approx(ran[name].values, rel=1e-12)


def test_a_collar_with_more_load_is_thinner_than_motion_and_tilt_left_out_would_say():
    """Along the series, tilted: what decides is not the film of an aligned collar at rest."""
    bearing, samples = collar().bearings["N2"], series()
    every = np.ones(samples.sizes["sample"], bool)

    def film(load, some=samples, moving=True):
        return value_of(bearing, some, every, moving, "minimum_film", load, 1.0)

    aligned = samples.drop_vars("tilt")
    assert film(1.5) < film(1.0)
    assert film(1.5) < 0.95 * film(1.5, aligned, moving=False)
    thicker = value_of(bearing, samples, every, True, "minimum_film", 1.5, 1.2)
    assert thicker > film(1.5)


def test_the_tilt_of_a_shaft_grows_with_its_loads():
    both = grown(series(), 2.0)
    assert both["tilt"].values == pytest.approx(2.0 * series()["tilt"].values)
    assert both["force"].values == pytest.approx(2.0 * series()["force"].values)


@pytest.mark.parametrize("moving", [True, False])
def test_bores_do_not_turn_further_under_more_load(moving):
    """A shaft of 60 µrad in a bore of 50 has 10 of them, and 70 under twice the load."""
    bearing, along = collar().bearings["N2"], xr.DataArray([0.0, 1e-6, 0.0], dims="axis")
    plain = series(6).drop_vars("tilt")
    tilted = plain.assign(tilt=xr.zeros_like(plain["force"]) + 60.0 * along)
    every = np.ones(6, bool)

    def film(samples, load):
        return value_of(bearing, samples, every, moving, "minimum_film", load, 1.0)

    found = film(tilted.assign(alignment=50.0 * along), 2.0)
    assert found == pytest.approx(film(tilted.assign(tilt=tilted["tilt"] * 35.0 / 60.0), 2.0))
    assert found < 0.99 * film(tilted.assign(tilt=tilted["tilt"] * 10.0 / 60.0), 2.0)


def test_an_angle_of_a_tolerance_does_not_grow_with_the_load():
    """Of a collar beside journal bearings, whether or not these know how the shaft lies."""
    own = {"diameter": 1.0, "width": 0.8, "relative_clearance": 1e-3}
    oil = {"viscosity": 0.3}
    samples = series(3).assign(curvature=xr.zeros_like(series(3)["force"]))
    bore = xr.DataArray([0.0, 5e-6, 0.0], dims="axis", coords={"axis": ["x", "y", "z"]})
    for lying in (True, False):
        films = Journal(bearings=["N2"], geometry=own, lubricant=oil, tilt=lying)
        tree = xr.DataTree.from_dict({"N2": samples.assign(alignment=bore)})
        candidate = Candidate(journal=films, thrust=collar())
        stated = Built(candidate, Friction(), tree, spans={"N2": None})
        askew = _tilted(stated, (3e-5, 0.0), lying)["N2"].to_dataset()
        pads = _samples_of_pads(candidate.thrust, candidate.thrust.bearings["N2"], askew)
        for load in (1.0, 2.0):
            found = against_bore(grown(pads, load))["tilt"].transpose("sample", "axis").values
            wanted = load * samples["tilt"].values + [0.0, 2.5e-5, 0.0]
            assert found == pytest.approx(wanted)


def test_a_film_that_is_lost_under_more_load_counts_as_none():
    """Samples without an answer, such as those of a collar that tilts into its pads."""
    bearing, samples = collar().bearings["N2"], series()
    every = np.ones(samples.sizes["sample"], bool)
    assert value_of(bearing, samples, every, False, "minimum_film", 14.0, 1.0) == 0.0
    assert math.isinf(value_of(bearing, samples, every, False, "maximum_pressure", 14.0, 1.0))


@pytest.mark.parametrize("power", [0.3, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("reserve", [0.5, 0.95, 1.0, 1.3, 4.0])
def test_factors_to_a_limit_are_those_of_a_power_of_the_load_in_few_steps(power, reserve):
    asked = []

    def film(load, oil):
        asked.append(load)
        return (load / oil) ** -power

    exact = min(max(reserve ** (1 / power), 1 / WIDEST), WIDEST)
    load, oil = film_factors(film, 1 / reserve)
    assert [load, 1 / oil] == pytest.approx([exact, exact], rel=3e-3)
    assert len(asked) <= 12
    assert pressure_factor(lambda f, oil: (f / oil) ** power, reserve) == pytest.approx(
        exact, rel=3e-3
    )


def test_a_factor_ends_where_films_end():
    """Between the last load that has an answer, and the first that has none."""
    found = pressure_factor(lambda f, oil: f if f < 1.7 else math.nan, 7.0)
    assert 1.695 < found < 1.7
    assert film_factors(lambda f, oil: math.nan, 1.0)[0] == pytest.approx(1 / WIDEST)


CURVED = {
    "bends": lambda load: 0.5 + 0.5 * load**3,
    "long flat, then steep": lambda load: load**0.05 * (1.0 + (load / 6.0) ** 10),
    "exponential": lambda load: math.exp(load - 1.0),
    "hardly falls": lambda load: load**1e-4,
    "falls at first": lambda load: load**0.2 * math.exp(-0.1 * math.sin(3.0 * math.log(load))),
    "ends": lambda load: load if load < 3.3 else math.nan,
    "fades": lambda load: 1.0 / (1.0 - (load / 4.0) ** 0.7) if load < 4.0 else math.inf,
}


@pytest.mark.parametrize("pressure", CURVED.values(), ids=CURVED)
@pytest.mark.parametrize("reserve", [0.6, 1.0, 1.00005, 1.3, 5.0])
def test_a_factor_takes_few_solutions_however_its_pressure_bends(pressure, reserve):
    asked = []

    def value(load, oil):
        asked.append(load)
        return pressure(load)

    factor = pressure_factor(value, reserve)
    assert len(asked) <= 16
    assert factor == 1 / WIDEST or pressure(factor) <= reserve
    assert factor == WIDEST or not pressure(1.0021 * factor) < reserve


def test_a_factor_that_is_not_found_is_an_error(monkeypatch):
    monkeypatch.setattr(candidate_factor, "_STEPS", 1)
    with pytest.raises(SolverError, match="no factor"):
        pressure_factor(lambda load, oil: math.exp(load - 1.0), 5.0)


def margins_of_lost_films(monkeypatch, films):
    """Of a run whose smallest films are solved again."""
    scene = SimpleNamespace(thrust=collar())
    columns = {"in_contact": 0.0, "smallest_film": 3e-5, "largest_pressure": 2e6}
    columns |= {"smallest_film_time": 1.0, "largest_pressure_time": 1.0}
    table = xr.Dataset({name: ("case", [x]) for name, x in columns.items()}, {"case": ["gust"]})
    monkeypatch.setattr(candidate_pads, "series_of", lambda *about: series())
    monkeypatch.setattr(candidate_pads, "pad_films", films)
    return [*pad_margins(scene, None, "N2", table)]


def test_films_that_carry_nowhere_when_they_are_solved_again_have_no_margin(monkeypatch):
    none = np.full(40, np.nan)
    lost = PadFilms(none, none, none, none, np.ones(40, bool), none)
    found = margins_of_lost_films(monkeypatch, lambda *about: lost)
    assert [math.isnan(one.factor) for one in found] == [True, True]
    assert all("in N2 (gust): solved again, its film carries" in one.uncounted for one in found)


def test_films_that_cannot_be_solved_again_have_no_margin_and_a_reason(monkeypatch):
    def stops(*about):
        raise SolverError("the path stops")

    found = margins_of_lost_films(monkeypatch, stops)
    assert [one.uncounted.endswith("(gust): the path stops") for one in found] == [True, True]


def test_a_limit_without_an_answer_is_told_beside_the_smallest_of_the_others(monkeypatch):
    known = Margin(1.4, "N", governs="largest film pressure in N")
    missing = Margin(math.nan, "N2", uncounted="smallest film in N2: the path stops")
    cases = {"case": ["gust"], "bearing": ["N2"], "dlc": ("case", ["1.4"])}
    table = xr.Dataset({"in_contact": (("case", "bearing"), [[0]])}, cases)
    tables = {"thrust": table}
    scene = SimpleNamespace(thrust=collar())
    for found, factor in (([missing, known], 1.4), ([missing], math.nan)):
        monkeypatch.setattr(candidate_margins, "pad_margins", lambda *about, one=found: one)
        margin = margin_of(scene, None, tables, [])
        assert margin.factor == pytest.approx(factor, nan_ok=True)
        assert margin.uncounted == missing.uncounted
        assert missing.uncounted in _governed(margin)


def test_all_ends_of_a_warm_collar_share_the_tables_of_the_stated_one():
    """Each table takes seconds: one for both rows, and one for all tolerances."""
    samples = series(6).assign(
        load_factor=("sample", np.ones(6)), ultimate=("sample", np.ones(6, bool))
    )
    tree = xr.DataTree.from_dict({"N2": samples})
    tree.attrs["seconds"] = 3e7
    built = Built(Candidate(thrust=collar(play=4.2e-4)), Friction(), tree)  # tables of its own
    before = row_table._nodes_of.cache_info().misses
    stated = cheap_numbers(built)
    ends = {
        tolerance.name: [cheap_numbers(end)["minimum_film"] for end in tolerance.ends]
        for tolerance in tolerances_of(built, AsBuilt())
    }
    assert row_table._nodes_of.cache_info().misses == before + 1
    thin, thick = ends["oil grade"]
    assert thin < stated["minimum_film"] < thick
    cold, warm = ends["oil temperature"]
    assert warm < stated["minimum_film"] < cold
    assert set(ends) == {"clearance", "oil grade", "oil temperature", "roughness"}


def test_bands_of_a_collar_hold_its_pressure_against_the_material_as_warm_as_its_films():
    """What the material carries where the films are, some 330 K, not what it carries cold."""
    samples = series(6).assign(
        load_factor=("sample", np.ones(6)), ultimate=("sample", np.ones(6, bool))
    )
    tree = xr.DataTree.from_dict({"N2": samples})
    tree.attrs["seconds"] = 3e7

    def factor(*material):
        limits = {"material": material, "minimum_film": 1e-7}
        thrust = collar(limits=limits, play=4.2e-4)
        return cheap_numbers(Built(Candidate(thrust=thrust), Friction(), tree))["load_factor"]

    warm = pad_films(collar(play=4.2e-4).bearings["N2"], samples).temperature
    hot = float(warm.max())
    assert 305.0 < float(warm.min()) <= hot < 400.0
    always, at_last = factor([500.0, 7e6]), factor([300.0, 7e6], [hot, 3.5e6], [500.0, 3.5e6])
    assert at_last < 0.8 * always
    assert at_last == pytest.approx(factor([500.0, 3.5e6]), rel=0.05)


def test_a_point_of_a_collar_has_the_limit_of_the_material_as_warm_as_its_films():
    material = [300.0, 7e6], [400.0, 1e6]
    warm, cold = (
        thrust_point(one, (0.0, 0.0, 5e5), (0.0, 0.0), 1.2)
        for thrust in [collar(limits={"material": material})]
        for one in (thrust.bearings["N2"], thrust.bearings["N2"].cool())
    )
    assert float(cold["pressure_limit"]) == 7e6
    assert 1e6 < float(warm["pressure_limit"]) < 6.9e6
