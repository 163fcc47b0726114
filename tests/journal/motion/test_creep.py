"""The rung "reduced" at standstill and at creeping speeds, in a shell that gives way."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import Contact, Film, GasMixture, JournalBearing, LocalShell, Lubricant
from loadflow.journal.line import Line
from loadflow.journal.models import grid
from loadflow.journal.models.composed import creep as composed_creep
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed import rest_on_level as composed_rest
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.model import build
from loadflow.journal.models.slow_heat import COLD, standing_states
from loadflow.numerics.convergence import Limits
from loadflow.tribology import AsperityContact

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
ROUGH = Contact(AsperityContact(roughness=0.56e-6, contact_modulus=46.5e9, factor=1e-3))
GRID = Film(
    Lubricant(0.05), GasMixture(5e4), edge_pressure=5e5, grid=(60, 20), contact=ROUGH,
    shell=LocalShell(2.06e-12),
)  # fmt: skip
FILM = replace(GRID, rung="reduced")
TILTED = {"tilt": (1e-5, -2e-5)}


@pytest.mark.parametrize("line", [{}, TILTED], ids=["aligned", "tilted"])
@pytest.mark.parametrize("load", [1e6, pytest.param(3e6, marks=pytest.mark.slow)])
def test_every_speed_down_to_standstill_is_answered_without_the_grid(load, line, alone):
    for speed in (0.0, 1e-5, 3e-4, 1e-3, 3e-3, 0.03, 0.3):  # each for itself
        state = BEARING.equilibrium((load, 0.2 * load), speed, FILM, strict=False, **line)
        assert state.converged, speed
        assert state.residual < 1e-8, speed  # 1e-10, or rounding of a gap of a thousandth
        carried = np.asarray(state.contact_share)
        assert -1e-9 < carried < 1.0 + 1e-9
        assert carried == pytest.approx(1.0) if speed == 0.0 else carried < 1.0


def test_a_stop_is_answered_sample_by_sample(alone):
    speed = np.array([0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 0.0, 0.0, 1e-4, 1e-2, -1e-3])
    force = np.stack([np.linspace(1.8e6, 2.2e6, speed.size), np.full(speed.size, 4e5)], axis=-1)
    states = BEARING.equilibrium(force, speed, FILM, strict=False)
    assert states.converged.all()
    assert (np.diff(states.minimum_film[:9]) < 0.0).all()


def test_a_creeping_load_has_its_own_moment_among_several(alone):
    speed = np.array([3e-3, 1e-4, 0.0])
    force = np.tile((2e6, 4e5), (speed.size, 1))
    moment = np.array([(2e3, -1e3), (4e3, 2e3), (-3e3, 1e3)])
    states = BEARING.equilibrium(force, speed, FILM, strict=False, moment=moment)
    assert states.converged.all()
    one = BEARING.equilibrium(force[1], speed[1], FILM, moment=moment[1])
    np.testing.assert_allclose(states.tilt[1], one.tilt, rtol=1e-6)


@pytest.mark.parametrize("line", [{}, TILTED], ids=["aligned", "tilted"])
@pytest.mark.parametrize("first", [1e-3, 0.0])
def test_a_series_begins_at_standstill_and_creeping_without_the_grid(first, line, monkeypatch):
    monkeypatch.setattr(grid, "equilibrium", lambda *given: pytest.fail("asked"))
    time = np.linspace(0.0, 4.0, 81)
    force = np.stack([3e6 + 2e5 * np.sin(time), np.full(time.size, 6e5)], axis=-1)
    tilt = {name: np.tile(value, (time.size, 1)) for name, value in line.items()}
    path = BEARING.orbit(time, force, first + 1e-3 * time, FILM, **tilt)
    state = BEARING.equilibrium(force[0], first, replace(FILM, grading="uniform"), **line)
    assert path.eccentricity_ratio[0] == pytest.approx(float(state.eccentricity_ratio), rel=1e-3)


@pytest.mark.parametrize("line", [{}, TILTED], ids=["aligned", "tilted"])
def test_a_series_that_stops_turns_back_and_rests_is_followed(line, monkeypatch):
    monkeypatch.setattr(grid, "equilibrium", lambda *given: pytest.fail("asked"))
    time = np.linspace(0.0, 40.0, 801)
    force = np.stack([3e6 + 5e5 * np.sin(time), 6e5 * np.cos(1.1 * time)], axis=-1)
    speed = np.interp(time, [0.0, 15.0, 20.0, 25.0], [0.3, 0.0, -0.05, 0.0])
    tilt = {name: np.tile(value, (time.size, 1)) for name, value in line.items()}
    path = BEARING.orbit(time, force, speed, FILM, **tilt)
    assert np.isfinite(path.minimum_film).all()
    assert path.minimum_film[-1] < 0.2 * path.minimum_film[0]


@pytest.mark.parametrize("speed", [0.01, 3e-3])
def test_a_creeping_film_is_that_of_the_grid_on_fine_cells(speed):
    """On 60 cells both are off, the largest pressure by up to a third."""
    load = (2e6, 4e5)
    few = BEARING.equilibrium(load, speed, FILM)
    fine = BEARING.equilibrium(load, speed, replace(GRID, grid=(480, 20)))
    for name, bound in (("eccentricity_ratio", 2e-4), ("minimum_film", 0.01),
                        ("maximum_pressure", 0.03)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(fine, name), rel=bound), name


@pytest.mark.parametrize(
    ("load", "speed"), [((605000.0, 267000.0), -8.1e-3), ((470825.0, 77164.0), -8.1e-3)]
)
def test_asperities_in_a_rigid_bore_at_a_creeping_speed_are_those_of_fine_cells(load, speed, alone):
    """On graded cells the grid has 28 % less pressure in the first, 9 % more in the second."""
    wide = replace(BEARING, relative_clearance=0.75e-3)
    given = {"tilt": (-2.7e-6, 1.3e-6)}
    few = wide.equilibrium(load, speed, replace(FILM, shell=None), **given)
    fine = wide.equilibrium(
        load, speed, replace(GRID, shell=None, grid=(480, 20), grading="uniform"), **given
    )
    for name, bound in (("eccentricity_ratio", 1e-4), ("minimum_film", 0.03),
                        ("maximum_pressure", 0.03)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(fine, name), rel=bound), name


@pytest.mark.parametrize("compliance", [1e-12, 1e-11])
def test_a_standing_shaft_in_a_soft_shell_has_the_contact_of_the_grid(compliance):
    """Beside fine surfaces a soft shell gives way by many times their roughness."""
    even = replace(ROUGH, asperities=replace(ROUGH.asperities, roughness=2e-7, factor=3e-3))
    film = replace(FILM, contact=even, shell=LocalShell(compliance))
    few = BEARING.equilibrium((1.5e6, 7e5), 0.0, film)
    fine = BEARING.equilibrium((1.5e6, 7e5), 0.0, replace(film, rung="grid", grid=(480, 10)))
    for name, bound in (("eccentricity_ratio", 2e-4), ("contact_pressure", 5e-3),
                        ("minimum_film", 5e-3)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(fine, name), rel=bound), name


def test_all_ways_to_a_creeping_film_share_one_count_of_work(monkeypatch):
    speed, force = np.array([1e-3]), np.array([(3e6, 6e5)])
    model = build(BEARING, FILM, speed, Line(), 0, at_rest=True)

    def sought():
        given = model.loads(force), model.lines(1), Limits(1e-10, 60), COLD, standing_states(1)
        creep = composed_creep.Creep(model, *given)
        return len(list(creep.places(1e-3))), creep.spent

    found, spent = sought()
    assert found > 0
    monkeypatch.setattr(composed_creep, "_WORK", 0.5 * model.work.u.size)
    assert sought() == (0, 30)
    assert spent > 30


def test_steps_of_every_way_count(alone, monkeypatch):
    spent = []

    def counted(*given):
        solved = solve(*given)
        spent.append(int(given[12][0, at.ITERATIONS]))
        return solved

    for module in (composed_rest, composed_creep):
        monkeypatch.setattr(module, "solve", counted)
    for load, speed in ((1e6, 1e-3), (3e6, 1e-4), (2e6, 0.0)):
        spent.clear()
        state = BEARING.equilibrium((load, 0.2 * load), speed, FILM)
        assert state.iterations == sum(spent)


def test_what_is_no_number_is_no_film():
    """The largest of residuals that are no numbers would be 0."""
    force, speed = np.array([[2e6, 4e5]]), np.array([3e-3])
    model = build(BEARING, FILM, speed, Line())
    row = np.zeros((1, model.columns))
    for size in (0, 2):
        model.work.u[:] = np.nan
        solve(
            model.film, model.work, np.array([0.9, 0.1, 0.0, 0.0]), size, 0, np.zeros(1),
            model.loads(force), model.lines(1), speed, 1e-10, 60, np.inf, row,
            np.zeros((2, 0, 0)), COLD, standing_states(1),
        )  # fmt: skip
        assert not row[0, at.CONVERGED]
        assert row[0, at.RESIDUAL] == np.inf
