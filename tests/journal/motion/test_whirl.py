"""Half-speed whirl of a shaft is known where a film does not rupture, and told."""

from itertools import cycle
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from loadflow.journal import JournalBearing, Lubricant
from loadflow.scene import make_scene
from loadflow.scene.cases import Case
from loadflow.stages import paths_again
from loadflow.stages.comparisons import compare
from loadflow.stages.films.summary import extremes, warnings
from loadflow.stages.films.whirl import whirling
from loadflow.stages.journal import orbit
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.candidate.quantities import QUANTITIES
from loadflow.studies.compare.comparison import whirl
from loadflow.studies.seeds.intervals import Groups

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


CASE = Case("1.1", 12.0, 1)
COUNT = 1000
SMALL = {
    "accuracy": "given",
    "journal": {"bearings": ["N"], "rung": "reduced", "motion": "transient"},
    "shaft": {"two_point": {}},
}


@pytest.fixture(scope="module")
def solved():
    """Loads, shaft and film of a bearing over 9.5 turns of its shaft."""
    time = STEP * np.arange(COUNT)
    loads = xr.Dataset({"time": time, "speed": ("time", np.full(time.size, SPEED))})
    force = np.tile([0.0, 0.0, -2e5], (time.size, 1))[None]
    rows = {name: (("bearing", "time", "axis"), row) for name, row in
            {"force": force, "moment": 0.0 * force}.items()}  # fmt: skip
    shaft = xr.Dataset(rows).assign_coords(bearing=["N"], time=time)
    parts = {"loads": loads, "shaft": shaft}
    return parts | {"journal": orbit(make_scene(SMALL), CASE, parts)}


def parts_with(solved, turns, **columns):
    """The same with a shaft that goes round by `turns` of its own, and with other columns."""
    film = solved["journal"]["N"].to_dataset().copy(deep=True)
    angle = np.cumsum(turns * np.ones(film.sizes["sample"])) * SPEED * STEP
    place = 0.97 * WIDE.clearance * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    film["eccentricity"].values[:] = place
    film = film.assign({name: ("sample", values) for name, values in columns.items()})
    return solved | {"journal": xr.DataTree.from_dict({"N": film})}


def compared(parts):
    found = compare(make_scene(SMALL), CASE, parts)
    return {row.quantity: row for row in found if row.stage == "journal"}


def test_cells_are_not_asked_about_a_shaft_that_whirls_throughout(solved):
    """Nothing but they damp it; the film is told as one that is not checked."""
    rows = compared(parts_with(solved, 0.5))
    assert [*rows] == ["minimum film"]
    assert np.isnan(rows["minimum film"].value)
    assert "whirls at half its speed" in rows["minimum film"].against


def stretches(monkeypatch, *answers):
    """Where stretches are asked for, which find one of the answers after another, ours and theirs.

    As often as models are compared: warmer oil and other cells.
    """
    asked, turn = [], cycle(answers)

    def stretch(scene, other, bearing, parts, runs, around):
        asked.append((np.isfinite(runs), int(around)))
        found = [dict.fromkeys(paths_again.FILM, answer) for answer in next(turn)]
        return slice(int(around), int(around) + 1), *found

    monkeypatch.setattr(paths_again, "_stretch", stretch)
    return asked


def test_cells_are_asked_about_the_part_of_a_path_that_does_not_whirl(solved, monkeypatch):
    sample = np.arange(COUNT)
    # nearest to the shell while it whirls
    ratio = np.where(sample < 700, 0.97, 0.9) + 1e-6 * sample
    parts = parts_with(solved, np.where(sample < 850, 0.5, 0.0), eccentricity_ratio=ratio)
    asked = stretches(monkeypatch, (1.0, 1.0))
    compared(parts)
    counts, around = asked[-1]
    assert not counts[:700].any()
    assert counts[900:].all()
    assert around == COUNT - 1


def test_where_surfaces_rub_the_pressure_is_that_of_films_that_carry_alone(solved, monkeypatch):
    rubs = np.arange(COUNT) < 50
    columns = {
        "in_contact": rubs.astype(int),
        "eccentricity_ratio": np.where(rubs, 0.99, 0.8),
        "maximum_pressure": np.where(np.arange(COUNT) == 400, 8e6, 1e6),
    }
    asked = stretches(monkeypatch, (1e6, 1e6), (8e6, 1e7))
    found = compared(parts_with(solved, 0.0, **columns))
    assert [around for _, around in asked[-2:]] == [0, 400]
    assert not asked[-1][0][rubs].any()
    assert found["maximum pressure"].value == pytest.approx(0.2)
    assert found["minimum film"].value == 0.0


@pytest.mark.parametrize(("turns", "share"), [(0.5, 1.0), (0.0, 0.0)])
def test_a_film_has_the_share_of_the_time_that_it_whirls(solved, turns, share):
    film = parts_with(solved, turns)["journal"]["N"].to_dataset()
    assert float(extremes(film)["whirl_share"]) == pytest.approx(share)


def test_a_whirl_is_told_with_its_share_of_the_time():
    table = xr.Dataset(
        {"whirl_share": (("bearing", "case"), [[0.0, 0.02], [0.3, 0.96]])},
        {"bearing": ["N", "N2"], "case": ["calm", "start"]},
    )
    (said,) = warnings(xr.DataTree.from_dict({"journal": table}))
    assert "bearing N2" in said
    assert "2 of 2 load cases, start for 96 %" in said


def test_a_pressure_that_neither_oil_nor_shell_bears_is_told_with_its_load_case():
    table = xr.Dataset(
        {"largest_pressure": (("bearing", "case"), [[4.9e8, np.nan], [2e7, 28.6e9]])},
        {"bearing": ["N", "N2"], "case": ["calm", "start"]},
    )
    (said,) = warnings(xr.DataTree.from_dict({"journal": table}))
    assert "bearing N2" in said
    assert "500 MPa, in 1 of 2 load cases, 28,600 MPa in start" in said


def whirl_row(shares):
    """The row of a comparison of films that whirl for a share of each load case; None at rest."""
    count = len(shares)
    cases = [f"c{k}" for k in range(count)]
    table = xr.Dataset(coords={
        "case": cases, "bearing": ["N"], "wind_speed": ("case", np.full(count, 8.0)),
        "dlc": ("case", ["1.1"] * count), "seed": ("case", np.arange(count)),
    })  # fmt: skip
    if None not in shares:
        table = table.assign(whirl_share=(("case", "bearing"), np.reshape(shares, (count, 1))))
    one = Finished("a", "", "", make_scene(SMALL), {"journal": table}, {}, Path())
    return whirl(one, table, Groups.of(table))


def test_a_comparison_tells_the_load_case_that_whirls_longest():
    row = whirl_row([0.0, 0.3, 0.1])
    assert (row.value, row.case, row.place, row.holds) == (pytest.approx(30.0), "c1", "N", False)
    assert whirl_row([0.0, 0.04]).holds
    assert (whirl_row([0.0, 0.0]).case, whirl_row([0.0, 0.0]).value) == ("", 0.0)
    assert QUANTITIES["whirl"].rule  # so that it is a reservation, and no limit
    assert whirl_row([None]).note.startswith("n/a: films at rest")
