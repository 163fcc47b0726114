"""Commands that process cubes: design loads, statistics, lifetime, export."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from synthetic import case, cube_file

from loadflow.cube import make_cube, open_cube, save_cube
from loadflow.journal import Groove, Supply
from loadflow.reduction import damage_equivalent_load, read_parameter_file, stationary
from loadflow.scene.journal import Journal
from loadflow.seeds import group_seeds_jointly
from loadflow.stages.films.past import past_of_speed
from loadflow.stages.films.response import film_response
from loadflow.stages.frames import to_film
from loadflow.studies.bearing_series import iter_bearings, with_bearings
from loadflow.studies.design_loads.reduction_error import for_long_series, solve_films


@pytest.fixture(scope="module")
def hub_cube(tmp_path_factory):
    folder = tmp_path_factory.mktemp("processing")
    return cube_file(folder / "hub.h5", wind_speeds=(8.0, 12.0), seeds=(1, 2))


@pytest.fixture(scope="module")
def one_speed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("processing")
    return cube_file(folder / "one.h5", wind_speeds=(8.0,), seeds=(1, 2))


@pytest.fixture(scope="module")
def start_up(tmp_path_factory):
    """Standstill, run-up, operation, run-down, standstill; the load peaks while it stands."""
    series = case(12.0, 1, steps=600, dt=0.5)
    t = series["time"].values
    share = np.interp(t, [0, 50, 100, 200, 250, 300], [0, 0, 1, 1, 0, 0])
    speed = (("time",), 1.2 * share, series["speed"].attrs)
    series["speed"] = speed
    series["hub_force"][2, 20] = -3e6
    return save_cube(make_cube([series]), tmp_path_factory.mktemp("start") / "start.h5")


def radial(cube, name, bearing):
    loads = with_bearings(cube.sel(case=name).load())
    return to_film(loads["force"].sel(bearing=bearing).transpose("time", "axis").values)


# -- seeds ------------------------------------------------------------------------------------


def test_seeds_says_which_belong_together_and_draws_probability_papers(
    loadflow, one_speed, tmp_path
):
    page = tmp_path / "seeds.html"
    code, out, _ = loadflow(
        *("seeds", one_speed, "--bearings", "--variable", "speed", "--variable", "force"),
        *("-o", page),
    )
    assert code == 0
    cube = open_cube(one_speed)
    loads = [with_bearings(cube.isel(case=k).load()) for k in range(2)]
    series = {"speed": [x["speed"].values.astype(float) for x in loads]}
    series |= {
        f"force.{b}.{a}": [x["force"].sel(bearing=b, axis=a).values for x in loads]
        for b in ("N", "N2")
        for a in "xyz"
    }
    found = group_seeds_jointly(series, 0.25)
    line = next(text for text in out.splitlines() if text.startswith("DLC 1.1, 8 m/s"))
    assert line.count("{") == len(found.groups)
    assert line.endswith(". ".join(found.reasons))
    text = page.read_text(encoding="utf-8")
    assert text.count("on probability paper") == 2 * 3  # speed, N, N2; caption and text
    assert "seeds for the mean" in text
    assert text.count("<caption>Equality</caption>") == 1


# -- reduce -----------------------------------------------------------------------------------


def test_stationary_loads_are_those_of_the_room(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow(
        *("reduce", hub_cube, "-o", tmp_path, "--method", "stationary", "--bearing", "N", "--json")
    )
    answer = json.loads(out)
    assert code == 0
    table = pd.read_csv(tmp_path / "stationary.csv")
    assert len(table) == len(answer["loads"]) == 4 * 11
    cube = open_cube(hub_cube)
    speed = cube["speed"].sel(case="dlc1.1_v8_s2").values
    expected = stationary(speed, radial(cube, "dlc1.1_v8_s2", "N"))["largest force"]
    row = table[(table["case"] == "dlc1.1_v8_s2") & (table["load"] == "largest force")].iloc[0]
    assert row["force"] == pytest.approx(expected.resultant, rel=1e-12)
    assert row["speed"] == pytest.approx(expected.speed, rel=1e-12)
    assert row["time"] == 0.25 * expected.index


def test_periodic_loads_with_given_bounds(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow(
        *("reduce", hub_cube, "-o", tmp_path, "--method", "periodic", "--bearing", "N2"),
        *("--bounds", 0.1, 0.5, "--additional", 1, "--json"),
    )
    answer = json.loads(out)
    assert code == 0
    assert len(answer["loads"]) == 4
    for load in answer["loads"]:
        assert load["bounds"] == [0.1, 0.5]
        kinds = [[h["kind"] for h in axis] for axis in load["harmonics"]]
        assert kinds == [["base", "additional"]] * 2
        assert load["closing_error"] <= 0.01
        base, additional = load["harmonics"][0]
        assert base["frequency"] < 0.1 <= additional["frequency"] < 0.5
        table = pd.read_csv(tmp_path / f"{load['case']}_N2_periodic.csv")
        assert table["time"].iloc[-1] == pytest.approx(load["closing_period"], rel=1e-6)
        first, last = table.iloc[0], table.iloc[-1]
        scale = abs(table["force_x"]).max()
        assert first["force_x"] == pytest.approx(last["force_x"], abs=1e-5 * scale)
    assert (tmp_path / "periodic.html").read_text(encoding="utf-8").count("<figure") == 8


def test_the_film_is_asked_once_for_each_wind_speed(loadflow, hub_cube, tmp_path, monkeypatch):
    asked = []

    def film(journal, speed):
        asked.append(speed)
        return lambda mean, amplitude, frequency: 0.6 + 0.3 / (1 + (frequency / 0.3) ** 2)

    monkeypatch.setattr("loadflow.studies.design_loads.tables.film_response", film)
    code, out, _ = loadflow(
        *("reduce", hub_cube, "-o", tmp_path, "--method", "periodic", "--bearing", "N")
    )
    assert code == 0
    assert len(asked) == 2
    assert "base" in out
    text = (tmp_path / "periodic.html").read_text(encoding="utf-8")
    assert "by the film" in text


def test_a_start_up_is_reduced_phase_by_phase_to_a_fifth(loadflow, start_up, tmp_path):
    code, out, _ = loadflow(
        *("reduce", start_up, "-o", tmp_path, "--phase", "each", "--bearing", "N"),
        *("--size", 0.2, "--rounding", "total", "--json"),
    )
    parts = json.loads(out)["series"]
    assert code == 0
    names = ["standstill", "run-up", "operation", "run-down", "standstill"]
    assert [part["phase"] for part in parts] == names
    assert sum(part["samples"] for part in parts) == 600
    first = parts[0]
    assert first["peak_time"] == 10.0  # sample 20 at 0.5 s
    assert first["largest_force"]["reduced"] == first["largest_force"]["full"]
    operation = read_parameter_file(parts[2]["file"])
    wanted = np.ceil(0.2 * operation.total)
    assert operation.index.size <= max(wanted, (operation.counts_full > 0).sum())
    assert operation.speed.min() > 0.9 * 1.2 * 0.99
    code, out, _ = loadflow("reduce", start_up, "-o", tmp_path, "--phase", "standstill")
    assert code == 0
    assert "standstill from 0 s" in out


# -- statistics and lifetime ------------------------------------------------------------------


def test_statistics_of_every_case_and_the_loads_beside_each_extreme(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow("statistics", hub_cube, "-o", tmp_path, "--json")
    answer = json.loads(out)
    assert code == 0
    cube = open_cube(hub_cube).load()
    row = next(
        r
        for r in answer["statistics"]
        if (r["case"], r["component"]) == ("dlc1.1_v12_s1", "hub_moment.y")
    )
    x = cube["hub_moment"].sel(case="dlc1.1_v12_s1", axis="y").values
    z = (x - x.mean()) / x.std()
    expected = {"mean": x.mean(), "std": x.std(), "min": x.min(), "max": x.max()}
    expected |= {"skewness": np.mean(z**3), "kurtosis": np.mean(z**4)}
    expected["del"] = damage_equivalent_load(x, 4.0, 0.25 * 399)
    assert {k: row[k] for k in expected} == pytest.approx(expected, rel=1e-9)
    every = cube["hub_moment"].sel(axis="z")
    extreme = next(
        r for r in answer["extremes"] if (r["which"], r["of"]) == ("min", "hub_moment.z")
    )
    assert extreme["hub_moment.z"] == pytest.approx(float(every.min()), rel=1e-12)
    assert extreme["safety_factor"] == 1.35
    beside = cube.sel(case=extreme["case"], time=extreme["time"])
    for axis in "xyz":
        expected_force = float(beside["hub_force"].sel(axis=axis))
        assert extreme[f"hub_force.{axis}"] == pytest.approx(expected_force, rel=1e-12)
    bending = np.hypot(*(float(beside["hub_moment"].sel(axis=a)) for a in "yz"))
    assert extreme["hub_moment.yz"] == pytest.approx(bending, rel=1e-12)
    assert len(pd.read_csv(tmp_path / "extremes.csv")) == len(answer["extremes"]) == 14
    assert len(pd.read_csv(tmp_path / "statistics.csv")) == len(answer["statistics"]) == 4 * 7


def test_lifetime_of_the_bearings(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow(
        *("lifetime", hub_cube, "-o", tmp_path, "--bearing", "N", "--years", 2, "--block", 10),
        *("--exponent", 4, "--class", "II", "--json"),
    )
    (life,) = json.loads(out)["bearings"]
    assert code == 0
    assert sum(life["shares"].values()) == pytest.approx(1.0)
    assert life["shares"]["dlc1.1_v8_s1"] == life["shares"]["dlc1.1_v8_s2"]
    assert life["shares"]["dlc1.1_v8_s1"] > life["shares"]["dlc1.1_v12_s1"]
    cube = open_cube(hub_cube)
    length = 0.25 * 399
    loads = {
        name: damage_equivalent_load(radial(cube, name, "N")[:, 0], 4.0, length)
        for name in life["shares"]
    }
    total = sum(share * loads[name] ** 4 for name, share in life["shares"].items()) ** 0.25
    assert life["damage_equivalent_load"][0][0] == pytest.approx(total, rel=1e-9)
    table = pd.read_csv(tmp_path / "N_revolutions.csv")
    assert table["seconds"].sum() == pytest.approx(2 * 365.25 * 86400)
    assert table["revolutions"].sum() == pytest.approx(life["revolutions"])
    assert life["extreme"]["low"] < life["extreme"]["value"] < life["extreme"]["high"]
    matrix = np.loadtxt(tmp_path / "N_markov.csv", delimiter=",")
    assert np.all(np.diag(matrix) == 0)
    assert (tmp_path / "lifetime.html").exists()


def test_lifetime_counts_events_and_names_the_load_cases_left_out(loadflow, tmp_path):
    cases = [case(8.0, 1).assign_coords(dlc=dlc) for dlc in ("1.2", "3.1", "4.1")]
    length = 0.25 * cases[0].sizes["time"]
    cube = save_cube(make_cube(cases), tmp_path / "loads.h5")
    ask = ("lifetime", cube, "-o", tmp_path / "out", "--json")
    code, out, err = loadflow(*ask, "--per-year", "3.1=1000")
    assert code == 0, err
    answer = json.loads(out)
    shares = answer["bearings"][0]["shares"]
    assert shares["dlc3.1_v8_s1"] == pytest.approx(1000 * length / (365.25 * 86400))
    assert shares["dlc4.1_v8_s1"] == 0.0
    assert sum(shares.values()) == pytest.approx(1.0)
    (warning,) = answer["warnings"]
    assert "DLC 4.1;" in warning
    code, _, err = loadflow(*ask, "--per-year", "often")
    assert code == 2
    assert "DLC=NUMBER" in err


def test_short_records_have_no_extrapolated_extreme(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow("lifetime", hub_cube, "-o", tmp_path, "--block", 60, "--json")
    assert code == 0
    assert all(life["extreme"] is None for life in json.loads(out)["bearings"])


# -- convert ----------------------------------------------------------------------------------


def test_parts_of_a_run_are_joined(loadflow, tmp_path):
    parts = [
        save_cube(make_cube([case(8.0, seed)]), tmp_path / f"part{seed}.h5") for seed in (1, 2)
    ]
    code, out, _ = loadflow("convert", *parts, "-o", tmp_path / "all.h5")
    assert code == 0
    assert "2 load cases" in out
    joined = open_cube(tmp_path / "all.h5")
    assert joined["seed"].values.tolist() == [1, 2]
    first = open_cube(parts[0]).load()
    assert np.array_equal(joined["hub_force"].isel(case=0), first["hub_force"].isel(case=0))


def test_a_file_is_replaced_only_when_asked(loadflow, one_speed, tmp_path):
    target = tmp_path / "loads.csv"
    target.write_text("mine", encoding="utf-8")
    code, _, err = loadflow("convert", one_speed, "-o", target)
    assert code == 2
    assert "exists already" in err
    assert target.read_text(encoding="utf-8") == "mine"
    assert loadflow("convert", one_speed, "-o", target, "--overwrite")[0] == 0
    assert target.read_text(encoding="utf-8") != "mine"


def test_a_cube_is_handed_to_other_programs_at_another_step(loadflow, hub_cube, tmp_path):
    code, out, _ = loadflow("convert", hub_cube, "-o", tmp_path / "loads.csv", "--step", 0.5)
    assert code == 0
    assert "4 load cases" in out
    table = pd.read_csv(tmp_path / "loads.csv", comment="#")
    assert np.diff(table["time"][:10]) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["convert", "CUBE", "-o", "OUT"], "ending ''; allowed: .csv"),
        (["reduce", "CUBE", "-o", "OUT", "--phase", "sleep"], "phase = 'sleep'; allowed: each"),
        (["reduce", "CUBE", "-o", "OUT", "--phase", "standstill"], "no case has a phase"),
        (["reduce", "CUBE", "-o", "OUT", "--classes", 0, 4], "classes = 0"),
        (
            ["reduce", "CUBE", "-o", "OUT", "--method", "periodic", "--bounds", 2, 1],
            "bounds = (2, 1)",
        ),
        (
            [
                *("reduce", "CUBE", "-o", "OUT", "--method", "periodic"),
                *("--bounds", 0.1, 1, "--scene", "gone.toml"),
            ],
            "give either --bounds or --scene",
        ),
        (["lifetime", "CUBE", "-o", "OUT", "--class", "IX"], "IX"),
        (["lifetime", "CUBE", "-o", "OUT", "--years", 0], "years = 0"),
        (["lifetime", "CUBE", "-o", "OUT", "--weibull-shape", -1], "-1"),
        (["statistics", "CUBE", "--variable", "wave"], "no variable 'wave'"),
        (["seeds", "CUBE", "-o", "OUT", "--margin", 0], "margin = 0"),
    ],
)
def test_bad_input_gives_one_message_and_code_2(loadflow, hub_cube, tmp_path, arguments, says):
    places = {"CUBE": hub_cube, "OUT": tmp_path / "out"}
    code, out, err = loadflow(*(places.get(argument, argument) for argument in arguments))
    assert code == 2
    assert says in " ".join(err.replace("│", " ").split())
    assert out == ""
    assert not (tmp_path / "out").exists()


# -- other forms of a cube --------------------------------------------------------------------


def test_chunked_and_loaded_cubes_give_the_same_numbers(hub_cube):
    pytest.importorskip("dask")
    from loadflow.studies.lifetime.lifetimes import lifetimes
    from loadflow.studies.seeds.verdicts import seed_verdicts
    from loadflow.studies.statistics import statistic_records

    forms = [open_cube(hub_cube, chunks={"time": 150}), open_cube(hub_cube).load()]
    chunked, loaded = ([v.as_dict() for v in seed_verdicts(cube)] for cube in forms)
    assert chunked == loaded
    chunked, loaded = (statistic_records(cube) for cube in forms)
    np.testing.assert_equal(chunked, loaded)
    chunked, loaded = ([*lifetimes(iter_bearings(cube))] for cube in forms)
    for a, b in zip(chunked, loaded):
        np.testing.assert_array_equal(a.duration.revolutions, b.duration.revolutions)
        np.testing.assert_array_equal(a.equivalent, b.equivalent)


# -- the film and the bounds ------------------------------------------------------------------


def test_the_response_is_the_largest_ratio_of_the_closed_orbit():
    """A slow load is quasi-static; what the shaft cannot follow leaves it at the mean load."""
    journal = Journal(grid=(36, 8))
    omega, mean, swing = 12.1 * np.pi / 30, np.array([2.0e6, 0.0]), np.array([4e5, 0.0])
    response = film_response(journal, omega)
    forces = [mean, mean + swing]
    still, worst = journal.geometry.equilibrium(
        forces,
        omega,
        journal.lubricant,
        cavitation=journal.cavitation,
        edge_pressure=journal.edge_pressure,
        grid=journal.grid,
    ).eccentricity_ratio
    assert response(mean, swing, 1 / 400) == pytest.approx(worst, abs=2e-3)
    fast = response(mean, swing, 5.0)
    assert still < fast < still + 0.1 * (worst - still)
    # at half the speed of the shaft the load drives its whirl
    assert response(mean, swing, omega / (4 * np.pi)) > worst


def test_a_tenth_of_the_samples_keeps_the_film(loadflow, tmp_path):
    """Aims: |ΔE_max| ≤ 0.5 %, E_mean ≤ 0.3 %, So_mean ≤ 1 %, friction energy ≤ 0.5 %."""
    cube = cube_file(tmp_path / "one.h5", wind_speeds=(10.0,), seeds=(1,), steps=12_000, dt=0.05)
    code, out, _ = loadflow(
        *("reduce", cube, "-o", tmp_path / "out", "--bearing", "N", "--rounding", "total"),
        *("--pick", "envelope", "--film", "--json"),
    )
    (part,) = json.loads(out)["series"]
    assert code == 0
    assert part["kept"] <= 0.1 * part["samples"]
    full, reduced = part["film"]["full"], part["film"]["reduced"]
    aims = {"E_max": 0.005, "E_mean": 0.003, "So_mean": 0.01, "energy": 0.005}
    for name, aim in aims.items():
        assert reduced[name] == pytest.approx(full[name], rel=aim), name
    assert part["film"]["true_error"] == pytest.approx(
        reduced["E_max"] / part["film"]["orbit_E_max"] - 1, rel=1e-12
    )
    page = (tmp_path / "out" / "reduction.html").read_text(encoding="utf-8")
    assert "standard deviation" in page


def test_samples_at_standstill_have_no_film_and_no_orbit(start_up):
    """They count in no mean; all of the others do."""
    series = next(iter_bearings(open_cube(start_up), ["N"]))
    films = solve_films(series, Journal(rung="reduced", grid=(36, 8)))
    stands = series.speed == 0
    assert np.isnan(films.ratio[stands]).all()
    assert np.isfinite(films.ratio[~stands]).all()
    assert films.orbit.size == 0
    measures = films.measures()
    assert measures[0] == films.ratio[~stands].max()
    assert measures[4] == pytest.approx(films.power[~stands].mean())
    assert np.isnan(films.part(slice(0, 50)).measures()).all()  # it stands all the time


def test_the_orbit_of_a_comparison_begins_as_those_of_runs_do(tmp_path):
    """At rest under its first load the film would have carried it for ever."""
    cube = cube_file(tmp_path / "loads.h5", seeds=(1,))
    series = next(iter_bearings(open_cube(cube), ["N"]))
    journal = Journal(rung="reduced", grid=(36, 8))
    orbit = solve_films(series, journal).orbit
    given = {"time": series.time, "speed": series.speed, "force": series.radial}
    past = past_of_speed(series.speed, np.diff(series.time)[0], np.ones(series.time.size, bool))
    path = journal.geometry.orbit(**past.before(given), film=journal.film_model)
    assert past.steps > 0
    np.testing.assert_allclose(orbit, path["eccentricity_ratio"].values[past.steps :], rtol=1e-12)
    still = journal.geometry.orbit(**given, film=journal.film_model)
    assert orbit[0] != pytest.approx(float(still["eccentricity_ratio"][0]), rel=1e-3)


def test_the_film_of_a_comparison_is_that_of_the_scene(start_up):
    """A groove in the loaded zone and a film named by the scene are not left out."""
    (series,) = iter_bearings(open_cube(start_up), ["N"])
    some = replace(series, **{k: getattr(series, k)[200:204] for k in ("time", "force", "speed")})
    plain = Journal(grid=(36, 12))
    loaded = float(np.arctan2(*some.radial.mean(axis=0)[::-1]))
    groove = Groove(loaded, arc=0.3, length=1.0, pressure=0.5e6)
    grooved = plain.model_copy(update={"supply": Supply([groove])})
    assert for_long_series(plain).rung == "reduced"
    assert for_long_series(grooved).rung == "reduced"
    assert for_long_series(Journal(rung="grid")).rung == "grid"
    without, with_groove = (
        solve_films(some, for_long_series(journal), transient=False) for journal in (plain, grooved)
    )
    assert np.all(with_groove.ratio > without.ratio * 1.02)
