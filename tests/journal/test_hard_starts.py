"""Loads that Newton's method misses from its first position: found another way, or shown absent.

Draws of `benchmarks.robustness.families`, each named by what it needs.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from benchmarks.robustness import families
from loadflow.errors import SolverError
from loadflow.journal import (
    Arc,
    Contact,
    Cylindrical,
    Film,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Pump,
    Supply,
)
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.shell.elastic_film import ElasticFilm
from loadflow.journal.line import Line
from loadflow.journal.models import grid, reduced
from loadflow.journal.models.finer_orbit import on_enough_cells
from loadflow.journal.questions import AtRest
from loadflow.journal.shells import LocalShell, ThickShell
from loadflow.journal.solvers import estimate, load_stepping, messages, statics
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.motion.start import orbit_film, orbit_start
from loadflow.journal.solvers.motion.transient import OrbitStopped
from loadflow.journal.solvers.newton import no_film, solve_film
from loadflow.journal.solvers.search import searches
from loadflow.journal.solvers.sinking import solve_by_sinking
from loadflow.journal.solvers.static_rows import equilibrium_rows
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.warm_orbit import FEW
from loadflow.numerics.convergence import Limits
from loadflow.tribology import AsperityContact


def drawn(family: str, number: int) -> Any:
    """A draw of a family, to be solved by calling it."""
    rng = np.random.default_rng([families.SEEDS[family], number])
    point = families.draw_point(rng)
    return point, families.FAMILIES[family](point)


@pytest.mark.parametrize("number", [79, 102, 106, 221, 323, 424])
def test_tilted_rough_shafts_start_where_no_asperities_hold_them(number):
    carries_its_load(number)


@pytest.mark.parametrize("number", [20030, 20112])
def test_where_steps_of_the_load_end_its_path_goes_on(number):
    carries_its_load(number)


@pytest.mark.slow
@pytest.mark.parametrize("number", [60046, 60068, 61280])
def test_a_shaft_that_is_let_go_sinks_to_where_no_steps_lead(number, monkeypatch):
    """Rough soft shells, in which steps of load, shell and speed end short of an equilibrium."""
    point, solve = drawn("composed", number)
    found, around = solve(), point.film["grid"][0]
    assert found.converged
    finer = point.film | {"grid": (2 * around, 20)}
    told = point.bearing.equilibrium(point.force, point.speed, point.oil, **finer)
    # the same film on twice the cells, which comes another way or sinks again
    assert found.minimum_film == pytest.approx(told.minimum_film, rel=3e-3)
    assert found.eccentricity == pytest.approx(told.eccentricity, abs=0.02 * point.gap)
    monkeypatch.setattr(statics, "solve_by_sinking", lambda *given: None)
    with pytest.raises(SolverError, match="no equilibrium found"):
        solve()


@pytest.mark.slow
def test_a_shaft_that_sinks_to_the_end_of_its_contact_is_told_to_touch():
    """Before, the load was sought to the end, and only said not to be found."""
    with pytest.raises(SolverError, match="touches the bore beyond the law of contact"):
        drawn("composed", 60101)[1]()


@pytest.mark.parametrize(("number", "share"), [(70505, 0.0), (70645, 0.0126), (70675, 0.0)])
def test_rough_shafts_in_soft_thick_shells_start_from_smooth_ones(number, share):
    """Sought beside asperities alone the shaft met the shell, or the steps were lost."""
    point, solve = drawn("composed", number)
    found = solve()
    assert found.converged
    assert found.contact_share == pytest.approx(share, abs=1e-4)
    # the film of the same load between smooth surfaces, which asperities only lift
    smooth = {name: of for name, of in point.film.items() if name != "contact"}
    alone = point.bearing.equilibrium(point.force, point.speed, point.oil, **smooth)
    assert found.minimum_film == pytest.approx(alone.minimum_film, rel=0.1 if share else 1e-6)


def test_asperities_are_sought_in_the_whole_shell_where_smooth_surfaces_have_no_film(monkeypatch):
    """Their search may end in one that is still too stiff."""
    softness: list[float] = []
    solve, newton = Statics.solve, Statics._by_newton

    def fails(one: Statics, *given: Any, **words: Any) -> Any:
        if one.film.contact is None:
            one.film.relax(0.3)
            return no_film(one.film)
        return solve(one, *given, **words)

    def by_newton(one: Statics, *given: Any) -> Any:
        softness.append(one.film.softness)
        return newton(one, *given)

    monkeypatch.setattr(Statics, "solve", fails)
    monkeypatch.setattr(Statics, "_by_newton", by_newton)
    with suppress(SolverError):
        drawn("composed", 70505)[1]()
    assert softness[0] == 1.0


ROUGH_BORE = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
ROUGH_FILM = Film(
    Lubricant(0.03),
    Guembel(),
    grid=(48, 8),
    contact=Contact(AsperityContact(roughness=1e-6, contact_modulus=115e9, factor=1e-3)),
)


@pytest.mark.parametrize("shell", [None, LocalShell(1e-12)], ids=["rigid", "soft"])
def test_a_shaft_sinks_to_its_equilibrium(shell):
    load, speed, effort = np.array([3e4, 1e4]), 2.0, Effort(1e9)
    film = replace(ROUGH_FILM, shell=shell, inlet=None)
    fixed = Statics(ROUGH_BORE, film, Line(), speed, crowd=())
    fixed.raise_scale(load[None])
    known = fixed.solve(0, load, speed, None, Limits(1e-10, 60))
    assert known.converged
    first = np.zeros(2) + 0.9 * load / np.hypot(*load)
    sunk = solve_by_sinking(fixed.film, load, first, 1e-10, 60, effort)
    assert sunk.converged
    assert sunk.position == pytest.approx(known.position, abs=1e-8)
    assert 0 < sunk.iterations == effort.spent


def test_a_shaft_that_nothing_carries_sinks_to_its_bore():
    load, speed, effort = np.array([3e8, 1e8]), 2.0, Effort(1e9)
    fixed = Statics(ROUGH_BORE, replace(ROUGH_FILM, inlet=None), Line(), speed, crowd=())
    fixed.raise_scale(load[None])
    first = 0.9 * load / np.hypot(*load)
    sunk = solve_by_sinking(fixed.film, load, first, 1e-10, 60, effort)
    assert not sunk.converged
    assert load_stepping.has_touched(fixed.film, sunk)
    assert 0.5 < sunk.residual < 1.0


def test_a_shaft_sinks_no_longer_than_its_effort():
    load, effort = np.array([3e4, 1e4]), Effort(1.0)
    fixed = Statics(ROUGH_BORE, replace(ROUGH_FILM, inlet=None), Line(), 2.0, crowd=())
    fixed.raise_scale(load[None])
    fixed.film.set_speed(2.0)
    assert solve_by_sinking(fixed.film, load, np.array([0.5, 0.0]), 1e-10, 60, effort) is None
    assert 0.0 <= effort.left <= 1.0


def carries_its_load(number, family="contact"):
    """A draw of rough surfaces is solved, and the film where it is solved carries its load."""
    point, solve = drawn(family, number)
    answer = solve()
    assert answer.converged
    again = point.bearing.pressure(
        answer.eccentricity, point.speed, Lubricant(point.viscosity), **point.film
    )
    # the film at the position found carries the load: the same balance, asked the other way
    assert again.force == pytest.approx(point.force, rel=1e-6, abs=1e-6 * point.load)


def test_a_shaft_on_asperities_comes_up_to_its_speed_from_standing(monkeypatch):
    """A full film under a moment, on asperities: no steps of the load lead to it."""
    _, solve = drawn("composed", 186)
    answer = solve()
    assert answer.converged
    assert answer.minimum_film > 0.0
    monkeypatch.setattr(statics, "stands", lambda film: False)
    with pytest.raises(SolverError, match="no equilibrium found"):
        solve()


def test_a_rubbing_shell_softens_from_the_rigid_bore_where_a_film_is_found_in_it():
    """Number 1103: from standing, all that a search may take went without an answer."""
    carries_its_load(1103, "composed")


def test_a_shell_that_is_held_rigid_waits_for_its_rupture_as_a_rigid_bore_does(monkeypatch):
    """Number 833: a shaft that did not wait was not found in 50 steps."""
    _, solve = drawn("composed", 833)
    rigid = statics.in_rigid_bore

    class Held(Exception):
        pass

    def held(*given: Any) -> None:
        raise Held(rigid(*given))

    monkeypatch.setattr(statics, "in_rigid_bore", held)
    with pytest.raises(Held) as told:
        solve()
    assert told.value.args[0].converged


def test_steps_that_leave_the_rest_of_their_effort_to_the_way_from_standing_say_so(monkeypatch):
    """More of it might have led somewhere, so that the refusal tells what allows more."""
    _, solve = drawn("composed", 186)
    monkeypatch.setattr(statics, "_STANDING", 1.0)
    monkeypatch.setattr(Statics, "_from_standing", lambda *given: None)
    monkeypatch.setattr(statics, "solve_by_sinking", lambda *given: None)
    with pytest.raises(SolverError, match="all that a search may take"):
        solve()


def test_pads_that_no_film_holds_are_named_and_carry_where_they_are_not_worn():
    """Four pads worn in waves, each so that its film turns it flat at every tilt."""
    point, solve = drawn("composed", 177)
    with pytest.raises(SolverError, match="a film holds no pad that faces the load"):
        solve()
    del point.shape["relief"]
    assert point.solve().converged


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
@pytest.mark.parametrize("number", [44, 140, 2077, 2124, 2193])
def test_a_tilted_shaft_that_meets_an_end_of_a_pad_carries_up_to_what_is_told(number):
    """In 44 other cells are given up: what these have told stands.

    In 2077 whatever is sought after the shaft has touched on its pads would be given up.
    """
    point, solve = drawn("pads", number)
    assert "tilt" in point.film
    with pytest.raises(SolverError, match=r"touches the bore.* before the film carries") as told:
        solve()
    left = re.search(r"the last (\S+) % of the load", str(told.value))
    assert left
    point.load *= 0.9 * (1.0 - 0.01 * float(left[1]))
    assert point.solve().converged


@pytest.mark.parametrize(
    ("family", "number"), [("contact", 47), ("contact", 104), ("line", 205), ("line", 465)]
)
def test_a_load_is_refused_only_where_no_position_carries_it(monkeypatch, family, number):
    _, solve = drawn(family, number)
    with pytest.raises(SolverError, match=r"the shaft touches the bore.*before") as told:
        solve()
    assert ("beyond the law of contact" in str(told.value)) == (family == "contact")
    assert _winding(monkeypatch, solve) == 0


def test_the_winding_number_tells_a_load_that_is_carried(monkeypatch):
    """What the test above rests on can fail: of a load with an answer it is one."""
    assert _winding(monkeypatch, drawn("contact", 106)[1]) == 1


def _winding(monkeypatch: Any, solve: Any) -> int:
    """Turns of what is missing of the load as the shaft goes round next to contact."""
    given: dict[str, Any] = {}

    class Given(Exception):
        pass

    def keep(asked: Any) -> Any:
        given.update(bearing=asked.bearing, options=asked.film, line=asked.line)
        given.update(loads=asked.force, speeds=asked.speed)
        raise Given

    with monkeypatch.context() as patch:
        patch.setattr(grid, "equilibrium_rows", keep)
        with pytest.raises(Given):
            solve()
    omega, load = float(given["speeds"][0]), given["loads"][0]
    at_rest = Statics(given["bearing"], given["options"], given["line"], abs(omega))
    at_rest.raise_scale(given["loads"])
    film, gap = at_rest.film, at_rest.gap
    film.set_speed(omega)
    held = at_rest._held(0)
    deepest = gap.rough.deepest if film.contact is not None else 0.0

    def missing(angle: float) -> np.ndarray:
        way, place = np.array([math.cos(angle), math.sin(angle)]), held.copy()
        low, high = 0.0, 4.0
        while high - low > 1e-9:
            middle = 0.5 * (low + high)
            place[:2] = middle * way
            low, high = (middle, high) if gap.gaps(place).min() > 1e-6 - deepest else (low, middle)
        place[:2] = low * way
        found = solve_film(film, film.start(), place, 0.0 * place, 1e-10, film.newton_steps(300))
        assert found.converged
        return found.linear.load[:2] - load

    def turned(a: float, at_a: np.ndarray, b: float, at_b: np.ndarray) -> float:
        turn = math.atan2(at_a[0] * at_b[1] - at_a[1] * at_b[0], float(at_a @ at_b))
        if abs(turn) < 1.2 or b - a < 1e-4:
            return turn
        middle = 0.5 * (a + b)
        at = missing(middle)
        return turned(a, at_a, middle, at) + turned(middle, at, b, at_b)

    angles = np.linspace(0.0, 2.0 * math.pi, 73)
    found = [missing(angle) for angle in angles]
    turns = zip(angles, found, angles[1:], found[1:])
    return round(sum(turned(*pair) for pair in turns) / (2.0 * math.pi))


@pytest.mark.parametrize("number", [49, 96, 271, 392, 408, 468])
def test_orbits_on_few_unknowns_start_where_the_grid_does(number):
    _, orbit = drawn("orbit", number)
    path = orbit()
    assert path["residual"].max() < 1e-6
    assert (path["minimum_film"] > 0.0).all()


@pytest.mark.parametrize(("number", "around"), [(117, 120), (234, 120), (342, 96), (483, 120)])
def test_orbits_that_stop_between_cells_go_on_more_of_them(number, around):
    _, orbit = drawn("orbit", number)
    path = orbit()
    assert path.attrs["cells_around"] == around
    assert (path["minimum_film"] > 0.0).all()


def test_a_film_that_is_lost_as_it_warms_is_told_at_once():
    with pytest.raises(SolverError, match=r"no heat balance: at .* still warms by .* no more"):
        drawn("heat", 245)[1]()


@pytest.mark.parametrize("number", [107, 326])
def test_a_warm_film_that_its_cells_lose_is_found_on_more(number):
    point, solve = drawn("heat", number)
    answer = solve()
    assert answer.converged
    assert abs(answer.heat_imbalance) < 1e-6
    around, across = point.film["grid"]
    cells = np.shape(answer.film_temperature)
    assert cells[1] == across
    assert cells[0] >= around  # grooves between lobes have cells of their own
    assert cells[0] < 2 * around


@pytest.mark.parametrize("number", [20058, 20061])
def test_pads_of_a_collar_tilt_where_flat_ones_carry_rounding(number):
    """Flat pads balance, too, and what they carry is no number to go by."""
    _, solve = drawn("thrust", number)
    answer = solve()
    assert answer.converged
    assert np.hypot(*answer.pad_tilt.reshape(-1, 2)[0]) > 0.0
    assert answer.minimum_film > 1e-9


@pytest.mark.parametrize("number", [20228, 20347])
@pytest.mark.filterwarnings("ignore::loadflow.errors.ValidityWarning")
def test_temperatures_settle_where_oil_nearly_stands(number):
    """A cell that gets oil from one side or the other, and warms or cools by which."""
    _, solve = drawn("heat", number)
    answer = solve()
    assert answer.heat_residual < 1e-6
    assert answer.heat_imbalance < 1e-8


def asked_of_the_grid(monkeypatch) -> list[Any]:
    """A list that grows by one with each question for films at rest on the grid."""
    asked, rows = [], grid.equilibrium_rows

    def counted(*arguments: Any) -> Any:
        asked.append(arguments)
        return rows(*arguments)

    monkeypatch.setattr(grid, "equilibrium_rows", counted)
    return asked


@pytest.mark.parametrize("number", [20164, 20282])
def test_a_film_too_hot_for_any_balance_says_so_after_few_temperatures(monkeypatch, number):
    _, solve = drawn("heat", number)
    asked = asked_of_the_grid(monkeypatch)
    with pytest.raises(SolverError, match=r"no heat balance below 423\.15 K"):
        solve()
    assert len(asked) <= 8


def test_a_shell_that_a_free_groove_presses_open_carries_beyond_a_fold():
    """Number 141 of any parts together: steps of the load alone end where its shell is met."""
    point, solve = drawn("composed", 141)
    found = solve()
    around, across = point.film["grid"]
    point.film["grid"] = (2 * around, 2 * across)
    assert float(found.minimum_film) == pytest.approx(float(solve().minimum_film), rel=0.01)


def test_a_load_without_a_film_in_the_coldest_oil_says_why_after_few_temperatures(monkeypatch):
    _, solve = drawn("composed", 131)
    asked = asked_of_the_grid(monkeypatch)
    with pytest.raises(SolverError, match=r"no film at any temperature.*touches the elastic shell"):
        solve()
    assert len(asked) <= 8


def test_a_series_too_hot_for_any_balance_says_so_after_few_loads(monkeypatch):
    """Number 194: asperities in a thick shell, whose films take long; of 25 loads."""
    asked = asked_of_the_grid(monkeypatch)
    with pytest.raises(SolverError, match=r"no heat balance below 423\.15 K; the mean friction"):
        drawn("composed", 194)[1]()
    assert sum(arguments[0].speed.size for arguments in asked) <= 3 * FEW


def test_a_series_without_a_film_says_why_its_mildest_load_has_none():
    with pytest.raises(SolverError, match=r"its mildest loads.*touches the elastic shell"):
        drawn("composed", 215)[1]()


def test_a_film_whose_asperities_rub_more_the_warmer_it_is_has_a_balance():
    """Number 14: what it warms by falls by a third of what it is warmed, not by all of it."""
    answer = drawn("composed", 14)[1]()
    assert answer.heat_residual < 1e-6
    assert answer.heat_iterations < 20


def test_asperities_that_carry_nothing_are_not_asked_where_they_would(monkeypatch):
    asked: list[Any] = []
    search = estimate._until_pressed
    monkeypatch.setattr(estimate, "_until_pressed", lambda *a: asked.append(a) or search(*a))
    bearing = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
    rough = Contact(AsperityContact(roughness=2e-7, contact_modulus=115e9, factor=1e-3))
    oil, words = Lubricant(0.03), {"cavitation": Guembel(), "grid": (48, 8), "contact": rough}
    mild = bearing.equilibrium((2e3, 0.0), 20.0, oil, **words)
    assert mild.contact_share == 0.0
    assert not asked
    slow = bearing.equilibrium((2e4, 0.0), 1e-3, oil, **words)
    assert slow.contact_share > 0.5
    assert asked


def test_an_orbit_that_ends_where_a_tilted_shaft_meets_the_bore_says_so():
    """It does on 120 × 24 cells, too, at the same time."""
    with pytest.raises(SolverError, match=r"orbit stops at t = 0\.336.*; the shaft touches the b"):
        drawn("composed", 181)[1]()


@pytest.mark.parametrize("number", [61220, 70139])
def test_an_orbit_whose_shaft_meets_an_edge_of_a_partial_arc_says_so(number):
    """The load of both turns away from the arc; on "grid" they end there, too."""
    with pytest.raises(SolverError, match=r"orbit stops.*; the shaft touches .* m at an edge of"):
        drawn("composed", number)[1]()


def test_a_shaft_meets_an_edge_of_an_arc_only_beside_it():
    def place(ratio, way):  # from the middle of the arc on
        return ratio * np.array([math.cos(0.5 + way), math.sin(0.5 + way)])

    arc = JournalBearing(0.2, 0.1, 1e-3, shape=Arc(angle=0.5, span=2.0))
    met = "narrowest gap 5e-07 m at an edge of the arc (radial clearance 0.0001 m)"
    for side in (1, -1):
        assert messages.at_edge(arc, place(0.995 / math.cos(0.7), side * 1.7)).endswith(met)
    assert not messages.at_edge(arc, place(0.9 / math.cos(0.7), 1.7))
    assert not messages.at_edge(arc, place(2.0, 3.0))
    assert not messages.at_edge(arc, place(1.0, 0.9))
    assert not messages.at_edge(replace(arc, shape=Cylindrical()), place(2.0, 1.7))


def test_a_warm_film_that_the_fast_rung_does_not_find_has_the_word_of_the_grid():
    with pytest.raises(SolverError, match=r"load 0: the film gets hotter than 423\.15 K"):
        drawn("composed", 125)[1]()


def test_a_shell_that_meets_the_shaft_as_it_softens_says_so_on_the_cells_asked_for(monkeypatch):
    """Number 43: its ends meet the shaft at a hundredth of its compliance, on any cells."""
    meshes: list[Any] = []
    stepped = statics.solve_elastic_in_steps
    monkeypatch.setattr(
        statics,
        "solve_elastic_in_steps",
        lambda film, *given: meshes.append(film.mesh.shape) or stepped(film, *given),
    )
    with pytest.raises(SolverError, match="touches the elastic shell"):
        drawn("composed", 43)[1]()
    assert len(set(meshes)) == 1


def test_a_load_that_its_supply_does_not_carry_is_not_sought_where_it_floats(monkeypatch):
    """A heavy load lies far out, where the closed form has it: Newton begins there."""
    starts: list[float] = []
    newton = statics.solve_equilibrium

    def asked(film: Any, force: Any, u: Any, position: Any, *more: Any, **given: Any) -> Any:
        starts.append(math.hypot(*position[:2]))
        return newton(film, force, u, position, *more, **given)

    monkeypatch.setattr(statics, "solve_equilibrium", asked)
    bearing = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
    pump = Pump((0.0, 1e-4), (1e6, 5e5))
    supply = Supply((Groove(np.pi, arc=0.4, length=0.15),), pump)
    words = {"cavitation": MassConserving(), "grid": (48, 8), "supply": supply}
    answer = bearing.equilibrium((1e5, 0.0), 20.0, Lubricant(0.03), **words)
    assert answer.converged
    assert min(starts) > 0.8


def test_a_growing_load_that_has_closed_the_ends_of_a_shell_grows_no_further(monkeypatch):
    """Number 2366 keeps its ends, which the shaft meets long before its load is on it."""
    steps: list[int] = []
    newton = load_stepping.solve_equilibrium

    def counted(*given: Any, **words: Any) -> Any:
        steps.append((found := newton(*given, **words)).iterations)
        return found

    monkeypatch.setattr(load_stepping, "solve_equilibrium", counted)
    with pytest.raises(SolverError, match="touches the elastic shell"):
        drawn("shell", 2366)[1]()
    assert sum(steps) < 600  # 1574 where it grows to where none is found


@pytest.mark.parametrize("number", [59, 255])
def test_a_shell_is_met_where_the_path_of_the_load_ends_and_not_in_a_step_that_was_lost(number):
    """Such a step leaves the shaft a tenth of the clearance within the shell, at another place."""
    point, solve = drawn("shell", number)
    with pytest.raises(SolverError, match="touches the elastic shell") as told:
        solve()
    gap = re.search(r"narrowest gap (\S+) m", str(told.value))
    assert gap
    assert abs(float(gap[1])) < 1e-5 * point.bearing.clearance


def test_steps_in_a_shell_leave_the_gap_that_they_were_tried_for(monkeypatch):
    """Cells that fill are limited in what is tried as in what is taken, and open it no farther."""
    left: list[bool] = []
    tried = ElasticFilm.step_share

    def step_share(film: Any, u: Any, columns: Any, weights: Any, way: Any, fills: bool) -> float:
        least, taken = film.gap.least_after(way[0]), u.copy()
        share = tried(film, u, columns, weights, way, fills)
        film.correct(taken, columns, share * weights, fills)
        there = way[0] + share * (way[1] - way[0])
        film.narrowest(taken, there)
        left.append(film.gap.least(there) >= least)
        return share

    monkeypatch.setattr(ElasticFilm, "step_share", step_share)
    with pytest.raises(SolverError, match="touches the elastic shell"):
        drawn("shell", 177)[1]()
    assert len(left) > 50
    assert all(left)


@pytest.mark.parametrize("number", [238, 923])
def test_a_search_that_leads_nowhere_ends_after_a_count_of_steps_that_it_tells(number, monkeypatch):
    """Its steps and cells are counted, so that it ends at the same place on every machine."""
    cells: list[float] = []
    linearise = DiscreteFilm.linearise

    def counted(film: DiscreteFilm, *given: Any, **words: Any) -> Any:
        cells.append(film.mesh.order.size)
        return linearise(film, *given, **words)

    monkeypatch.setattr(DiscreteFilm, "linearise", counted)
    monkeypatch.setattr(statics, "solve_by_sinking", lambda *given: None)  # it finds number 238
    told = r"residual \S+ after (\d+) steps, .*all that a search may take"
    with pytest.raises(SolverError, match=told):
        drawn("composed", number)[1]()
    assert sum(cells) < 6e5  # 1.9e6 of number 238 where every search came to its own end


@pytest.mark.parametrize("number", [3023, 3086])
def test_the_effort_of_a_search_leaves_films_in_shells_that_take_many_steps(number):
    """They take more than half of it; a quarter of it lost them."""
    assert drawn("shell", number)[1]().converged


def test_films_at_all_temperatures_have_one_effort_and_begin_at_the_one_before(monkeypatch):
    """Each was sought from a light load on: number 246, a soft thick shell, took 15 s and more."""
    made: list[Effort] = []
    of, resolve, steps = Effort.of, Statics.resolve, list[int]()
    monkeypatch.setattr(Effort, "of", lambda *given: made.append(of(*given)) or made[-1])

    def counted(self: Statics, *given: Any, **more: Any) -> Any:
        used, solution = resolve(self, *given, **more)
        if not given[5:]:  # asked for from outside, on whichever cells it is found
            steps.append(solution.iterations)
        return used, solution

    monkeypatch.setattr(Statics, "resolve", counted)
    assert drawn("composed", 246)[1]().converged
    assert len(made) == 1
    assert len(steps) > 4
    assert made[0].spent == sum(steps)
    assert sorted(steps)[len(steps) // 2] < 0.1 * steps[0]


def first_effort(monkeypatch: pytest.MonkeyPatch, **words: Any) -> tuple[Statics, Effort]:
    """Film of a bearing, and what its search may take, as it begins."""

    class Seen(Exception):
        pass

    def solve(statics: Statics, *given: Any) -> Any:
        raise Seen(statics, given[-1])

    monkeypatch.setattr(Statics, "solve", solve)
    bearing = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
    with pytest.raises(Seen) as seen:
        bearing.equilibrium((1e5, 0.0), 20.0, Lubricant(0.03), **words)
    return seen.value.args


@pytest.mark.parametrize(("around", "shell", "share"), [
    (48, LocalShell(1e-12), 0.4),
    (240, LocalShell(1e-12), 1.0),
    (120, ThickShell(outer_diameter=0.3, modulus=2e10), 1.0),
])  # fmt: skip
def test_a_film_that_has_no_other_cells_is_sought_on_its_own_with_all_effort(
    around: int, shell: Any, share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a search keeps for more cells is lost where a shell may have no more."""
    _, effort = first_effort(monkeypatch, shell=shell, grid=(around, 8))
    assert 1.0 - effort.kept / effort.left == pytest.approx(share)


@pytest.mark.parametrize("grid", [(48, 8), (480, 120)])
def test_on_any_cells_a_search_may_take_the_steps_of_three_solutions(grid, monkeypatch):
    """On few of them it may take many more."""
    seen, effort = first_effort(monkeypatch, grid=grid, inlet=None, max_iterations=50)
    assert effort.steps(seen.film) >= 3 * seen.film.newton_steps(50)


def test_a_first_film_that_is_not_found_tells_the_work_that_its_shell_took(monkeypatch):
    """Number 71403 was sought on ever more cells: a step there takes many of a rigid bore."""
    point, _ = drawn("composed", 71403)
    own, film = Effort(left=1e5), Film(point.oil, **point.film)
    first, _ = orbit_film(point.bearing, film, point.force[None], np.array([point.speed]), Line())
    monkeypatch.setattr(Effort, "of", lambda *film: own)
    with pytest.raises(OrbitStopped) as error:
        orbit_start(first, point.force, point.speed, None, Limits(1e-8, 60, True))
    assert error.value.work == pytest.approx(1e5 - own.left)
    assert error.value.work > 1e5 > 3.0 * own.spent * first.film.mesh.order.size


def test_an_orbit_that_stops_late_is_not_tried_on_ever_more_cells(monkeypatch):
    """Number 527 stops on any cells, and took 28 s to be tried on up to 480 around."""
    asked: list[tuple[int, int]] = []
    path = reduced._path
    monkeypatch.setattr(
        reduced, "_path", lambda *given: asked.append(given[0].film.cells) or path(*given)
    )
    with pytest.raises(SolverError, match=r"orbit cannot start: .* residual"):
        drawn("composed", 527)[1]()
    assert [around for around, _ in asked] == [60]


@pytest.mark.parametrize(
    ("work", "tried"), [(1e4, [60, 120, 240]), (2e6, [60]), (None, [60, 120, 240])]
)
def test_an_orbit_that_was_not_tried_on_more_cells_says_which_to_ask_for(work, tried):
    asked: list[int] = []

    def path(films: Sequence[Film]) -> Any:
        asked.append(films[0].cells[0])
        raise OrbitStopped("orbit stops", 2.5, work)

    with pytest.raises(OrbitStopped, match="orbit stops") as told:
        on_enough_cells([Film(Lubricant(0.05), grid=(60, 20))], path, [240])
    assert asked == tried
    assert told.value.time == 2.5
    assert ("grid = [120, 20]" in str(told.value)) == (tried == [60])


def test_a_shaft_in_two_films_has_more_cells_in_that_which_may_ask_for_them():
    """What these fail by is not told: the orbit stops on the cells that were asked for."""
    asked: list[list[int]] = []

    def path(films: Sequence[Film]) -> Any:
        asked.append([film.cells[0] for film in films])
        raise OrbitStopped("orbit stops", 2.5) if len(asked) == 1 else SolverError("no pad holds")

    films = [Film(Lubricant(0.05), grid=(cells, 20)) for cells in (60, 48)]
    with pytest.raises(OrbitStopped, match="orbit stops"):
        on_enough_cells(films, path, [240, 0])
    assert asked == [[60, 48], [120, 48], [240, 48]]


@pytest.mark.parametrize(
    ("together", "found", "asked"), [(True, 0, 4), (True, 1, 8), (False, 0, 8)]
)
def test_of_loads_with_one_effort_few_are_sought_where_none_is_found(
    monkeypatch, together, found, asked
):
    """Nothing is left of the effort: each is tried once, but after four in vain no other is."""
    tried = []

    def resolve(self: Statics, index: int, *given: Any, **words: Any) -> Any:
        tried.append(index)
        return self, no_film(self.film)

    monkeypatch.setattr(Statics, "resolve", resolve)
    every = searches(8, together)
    for one in every:
        one.efforts[:] = [Effort(left=0.0, found=found)]
    bearing, film = JournalBearing(0.2, 0.1, 1e-3), Film(Lubricant(0.03), grid=(24, 8))
    loads, line = np.tile([1e4, 0.0], (8, 1)), Line(searches=every)
    control = Limits(1e-10, 60, strict=False)
    rows = equilibrium_rows(AtRest(bearing, film, loads, np.full(8, 30.0), line, control))
    assert len(tried) == asked
    assert len(rows) == 8
    assert not any(row["converged"] for row in rows)
