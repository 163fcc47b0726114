"""The rung "reduced" with effects against the rung "grid" with the same ones."""

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest

from loadflow.errors import InputError, ValidityWarning
from loadflow.journal import (
    Contact,
    Film,
    GasMixture,
    Guembel,
    Heat,
    JournalBearing,
    LinedShell,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
)
from loadflow.journal.models import reduced
from loadflow.journal.models.composed import model as composed_model
from loadflow.journal.models.composed import path as composed_path
from loadflow.journal.models.width_modes import half_width_nodes, lobatto, whole_width
from loadflow.tribology import AsperityContact

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FILM = Film(Lubricant(0.05), GasMixture(0.05e6), edge_pressure=0.5e6, grid=(60, 20))
REDUCED = replace(FILM, rung="reduced")
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
SOFT = LocalShell(3e-11)
SPEED, FORCE = 1.267, np.array([2e6, 4e5])
UNIT = BEARING.clearance / BEARING.radius  # tilt by a clearance at one radius from the middle
TIME = np.linspace(0.0, 1.5, 31)
LOAD = np.stack([2e6 + 5e5 * np.sin(1.5 * TIME), 4e5 * np.cos(4 * TIME)], axis=-1)
TILT = UNIT * np.stack([0.2 * np.sin(1.2 * TIME), 0.1 * np.cos(2 * TIME)], axis=-1)
OIL = {"oil": "mineral-vg-320", "inlet_temperature": 313.15}

# what is on: fields of the film, and how the shaft lies
EFFECTS = {
    "tilt": ({}, {"tilt": TILT}),
    "tilt and bend": ({}, {"tilt": TILT, "bend": TILT / 3}),
    "moment": ({}, {"moment": np.stack([5e4 * np.sin(TIME), 3e4 * np.cos(TIME)], axis=-1)}),
    "shell": ({"shell": SOFT}, {}),
    "shell, tilt": ({"shell": SOFT}, {"tilt": TILT}),
    "contact": ({"contact": ROUGH}, {}),
    "contact, tilt": ({"contact": ROUGH}, {"tilt": TILT}),
    "pattern, tilt": ({"contact": replace(ROUGH, pattern=3.0)}, {"tilt": TILT}),
}
ANSWERS = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power", "side_flow")
OFF = (0.0008, 0.0019, 0.0018, 0.0006, 0.0013)
"""How far both models are apart at most, each on 60 cells around; the grid with 40 across."""

OFF_IF = {
    "moment": {"minimum_film": 0.004},  # free to tilt, the film at the ends follows the moment
    "shell, tilt": {"side_flow": 0.004},  # of which the reduced film's own 6 points make 0.0037
}
CELLS = (60, 40)


def off(effect):
    return dict(zip(ANSWERS, OFF)) | OFF_IF.get(effect, {})


def apart(one, other, name):
    values = np.asarray(getattr(other, name))
    return float(np.abs(np.asarray(getattr(one, name)) / values - 1.0).max())


@pytest.mark.parametrize("inner", [4, 5, 6])
def test_slopes_are_exact_for_their_polynomials(inner):
    nodes = whole_width(0.7, inner)
    value = np.polynomial.Polynomial([0.49, 0, -1]) * np.polynomial.Polynomial([1.0, 0.4, -0.3])
    np.testing.assert_allclose(nodes.slopes @ value(nodes.z[:inner]), value.deriv()(nodes.z))
    assert nodes.weights @ value(nodes.z) == pytest.approx(value.integ()(0.7) - value.integ()(-0.7))


def test_the_half_width_is_that_of_the_aligned_film():
    nodes, axial = half_width_nodes(0.7, 3), lobatto(0.7, 3)
    np.testing.assert_allclose(nodes.z[:3], axial.points)
    stiffness = nodes.slopes.T @ (nodes.weights[:, None] * nodes.slopes)
    np.testing.assert_allclose(stiffness, axial.stiffness, atol=1e-12 * axial.stiffness.max())
    flow = nodes.slopes.T @ (nodes.weights[:, None] * nodes.end_slopes)
    np.testing.assert_allclose(-flow[:, 0], axial.stiffness.sum(axis=0), rtol=1e-10)


@pytest.mark.parametrize("effect", EFFECTS)
def test_orbits_agree_with_the_grid(effect):
    film, line = EFFECTS[effect]
    some = slice(None, None, 2)  # both take the same steps
    line = {name: values[some] for name, values in line.items()}
    grid, few = (
        BEARING.orbit(TIME[some], LOAD[some], SPEED, replace(one, grid=CELLS, **film), **line)
        for one in (FILM, REDUCED)
    )
    for name, bound in off(effect).items():
        assert apart(few, grid, name) < bound, name
    if line:
        size = np.abs(grid.moment).max()
        np.testing.assert_allclose(few.moment, grid.moment, atol=0.006 * float(size))
        np.testing.assert_allclose(few.tilt, grid.tilt, atol=0.002 * UNIT)
    if "shell" in film:
        assert apart(few, grid, "shell_deformation") < 0.0025
    assert float(few.residual.max()) < 1e-8


def at_rest(effect, film, cells):
    """Equilibria of an effect on cells."""
    more, line = EFFECTS[effect]
    some = {name: values[::10] for name, values in line.items()}
    return BEARING.equilibrium(LOAD[::10], SPEED, replace(film, grid=cells, **more), **some)


@pytest.mark.parametrize("effect", EFFECTS)
def test_equilibria_agree_with_the_grid(effect):
    few, grid = at_rest(effect, REDUCED, CELLS), at_rest(effect, FILM, CELLS)
    for name, bound in off(effect).items():
        assert apart(few, grid, name) < bound, name
    for name in ("stiffness", "damping"):
        one, other = getattr(few, name), getattr(grid, name)
        assert one.shape == other.shape
        np.testing.assert_allclose(one, other, atol=0.0025 * np.abs(other).max(axis=(1, 2)).max())


@pytest.mark.parametrize("effect", ["tilt and bend", "moment", "contact"])
def test_what_is_apart_is_the_second_order_of_the_grid_across(effect):
    few = at_rest(effect, REDUCED, CELLS)
    coarse, fine = (at_rest(effect, FILM, (60, across)) for across in (20, 40))
    for name in ANSWERS:
        assert 3.2 < apart(few, coarse, name) / apart(few, fine, name) < 5.5, name


@pytest.mark.parametrize("effect", ["tilt and bend", "shell, tilt", "contact, tilt"])
def test_off_is_the_film_without_the_effect(effect):
    """No tilt, no compliance, no roughness to speak of: what is left is the aligned film."""
    film, line = EFFECTS[effect]
    film = dict(film)
    if "shell" in film:
        film["shell"] = LocalShell(1e-22)
    if "contact" in film:
        film["contact"] = replace(ROUGH, asperities=replace(ROUGH.asperities, roughness=1e-9))
    still = {name: 0.0 * values for name, values in line.items()}
    plain = BEARING.orbit(TIME, LOAD, SPEED, REDUCED)
    with_it = BEARING.orbit(TIME, LOAD, SPEED, replace(REDUCED, **film), **still)
    for name in ANSWERS:  # 6 points over the width beside 3 over the half: the same polynomials
        between_points = name == "minimum_film" and "shell" in film  # where an elastic gap is asked
        assert apart(with_it, plain, name) < (1e-3 if between_points else 1e-6), name


def test_stiffness_and_damping_are_the_slopes_of_the_load():
    film, tilt = replace(REDUCED, shell=SOFT), TILT[3]
    tight = {"tolerance": 1e-12}
    state = BEARING.equilibrium(FORCE, SPEED, film, tilt=tilt, **tight)
    step = 20.0 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    moved = BEARING.equilibrium(FORCE + step, SPEED, film, tilt=tilt, **tight).eccentricity
    compliance = np.stack([moved[0] - moved[1], moved[2] - moved[3]], axis=-1) / 40.0
    np.testing.assert_allclose(state.stiffness[:2, :2] @ compliance, np.eye(2), atol=1e-6)
    moments = state.moment + np.array([[10.0, 0.0], [-10.0, 0.0]])
    turned = BEARING.equilibrium(np.tile(FORCE, (2, 1)), SPEED, film, moment=moments, **tight)
    place = np.concatenate([turned.eccentricity, turned.tilt], axis=-1)
    answer = state.stiffness @ (place[0] - place[1])
    np.testing.assert_allclose(answer, [0.0, 0.0, 20.0, 0.0], atol=2e-3)


def test_a_held_tilt_and_its_moment_are_each_others_inverse():
    held = BEARING.equilibrium(FORCE, SPEED, REDUCED, tilt=TILT[5])
    free = BEARING.equilibrium(FORCE, SPEED, REDUCED, moment=held.moment)
    np.testing.assert_allclose(free.tilt, held.tilt, rtol=1e-6)
    np.testing.assert_allclose(free.eccentricity, held.eccentricity, rtol=1e-7)


@pytest.mark.slow
def test_order_across_is_that_of_polynomials(monkeypatch):
    """Each odd and even pair more takes the error of a tilted film down severalfold."""
    found = []
    for points in (3, 5, 7, 11):
        monkeypatch.setattr(composed_model, "POINTS", (points,) * 5)
        found.append(BEARING.equilibrium(FORCE, SPEED, REDUCED, tilt=UNIT * np.array([0.2, 0.1])))
    errors = [np.linalg.norm(one.moment / found[-1].moment - 1.0) for one in found[:-1]]
    assert errors[0] > 4 * errors[1] > 16 * errors[2]
    assert errors[2] < 1e-3


def test_order_around_is_that_of_the_grid():
    """The fill of the mixture goes with the flow, by first order, in both models."""
    ends = {}
    for rung in ("grid", "reduced"):
        ratios = [
            float(
                BEARING.equilibrium(
                    FORCE, SPEED, replace(FILM, rung=rung, grid=(cells, 20)), tilt=TILT[5]
                ).eccentricity_ratio
            )
            for cells in (60, 120, 240)
        ]
        coarse, fine = np.diff(ratios)
        ends[rung] = np.log2(coarse / fine)
    assert ends["reduced"] > 0.8
    assert ends["reduced"] == pytest.approx(ends["grid"], abs=0.4)


@pytest.mark.parametrize("effect", ["tilt and bend", "shell", "contact"])
def test_second_order_in_time(effect):
    film, line = EFFECTS[effect]
    ends = []
    for n in (20, 40, 80):
        time = np.linspace(0.0, 1.0, n + 1)
        force = FORCE + np.outer(time**3, [6e5, -4e5])  # leaves with zero slope
        more = {name: np.outer(time**3, [0.1, 0.2]) * UNIT for name in line}
        orbit = BEARING.orbit(time, force, SPEED, replace(REDUCED, **film), tolerance=1e-11, **more)
        ends.append(orbit.eccentricity.values[-1])
    coarse, fine = np.linalg.norm(np.diff(ends, axis=0), axis=1)
    assert np.log2(coarse / fine) > 1.6


def test_a_stop_ends_on_the_asperities():
    """Through the speed 0 the load goes over from the film to the asperities, as on the grid."""
    small = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    rough = Contact(
        AsperityContact(roughness=5e-7, contact_modulus=115e9, factor=1e-3), friction=0.1
    )
    film = Film(Lubricant(0.03), GasMixture(5e4), edge_pressure=1.5e5, contact=rough)
    time = np.linspace(0.0, 4.0, 81)
    speed = 40.0 * np.clip(1.0 - time / 2.0, 0.0, None)
    force = np.tile([40e3, 0.0], (time.size, 1))
    few = small.orbit(time, force, speed, replace(film, rung="reduced", grid=(240, 12)))
    grid = small.orbit(time, force, speed, replace(film, grid=(240, 48)))
    assert float(few.contact_share[0]) < 0.01
    assert float(few.contact_share[-1]) > 0.4  # squeeze carries the rest for a while
    assert np.all(np.diff(few.contact_share.values[41:]) > 0)
    # of the second order of the grid across: 24 cells leave 0.0057 and 0.0053
    np.testing.assert_allclose(few.minimum_film, grid.minimum_film, rtol=0.0015)
    np.testing.assert_allclose(few.maximum_pressure, grid.maximum_pressure, rtol=0.004)
    np.testing.assert_allclose(few.contact_share, grid.contact_share, atol=0.0014)
    np.testing.assert_allclose(few.contact_power, grid.contact_power, atol=0.001 * 40e3 * 0.1)
    still = small.equilibrium((40e3, 0.0), 0.0, replace(film, rung="reduced", grid=(240, 12)))
    assert float(still.contact_share) == pytest.approx(1.0, abs=1e-3)
    assert float(still.minimum_film) < float(few.minimum_film[-1])


@pytest.mark.filterwarnings("error::loadflow.errors.ValidityWarning")
def test_a_rough_end_that_touches_takes_more_points_across():
    """Six polynomials alone had the largest pressure 83 % and the friction 150 % off."""
    rough = replace(ROUGH, asperities=replace(ROUGH.asperities, roughness=1e-5))
    film, lies = {"contact": rough, "grid": (60, 60)}, {"tilt": 0.5 * TILT[::3]}
    time, load = TIME[::3], LOAD[::3]
    few = BEARING.orbit(time, load, 0.1, replace(REDUCED, **film), **lies)
    grid = BEARING.orbit(time, load, 0.1, replace(FILM, **film), **lies)
    assert float(grid.contact_share.max()) > 0.02
    # what is left is that of the grid: on 20, 40, 80 cells across 0.02, 0.005, 0.0016 of the film
    for name, bound in zip(ANSWERS, (0.0003, 0.003, 0.01, 0.01, 0.002)):
        assert apart(few, grid, name) < bound, name
    np.testing.assert_allclose(few.contact_share, grid.contact_share, atol=0.001)


def test_an_orbit_may_begin_at_standstill():
    time = np.linspace(0.0, 2.0, 41)
    force, speed = np.tile(FORCE, (41, 1)), SPEED * np.clip(time - 0.2, 0.0, None)
    rough, line = {"contact": ROUGH}, {"tilt": TILT[:1] * 0.2}
    grid = BEARING.orbit(time, force, speed, replace(FILM, **rough), **line)
    few = BEARING.orbit(time, force, speed, replace(REDUCED, **rough), **line)
    np.testing.assert_allclose(few.minimum_film, grid.minimum_film, rtol=0.03, atol=2e-6)
    assert float(few.contact_share[0]) > 0.99 > 0.01 > float(few.contact_share[-1])


def test_ends_that_are_not_resolved_are_told_where_no_asperities_carry():
    time = np.linspace(0.0, 2.0, 41)
    force, speed = np.tile(FORCE, (41, 1)), SPEED * np.clip(time - 0.2, 0.0, None)
    rough, line = replace(REDUCED, contact=ROUGH), {"tilt": TILT[:1] * 0.2}
    with (
        patch.object(composed_path, "rubs", lambda rows, force: np.zeros(len(rows), dtype=bool)),
        pytest.warns(ValidityWarning, match="bearing end is not resolved at .* first at t = 0.4"),
    ):
        BEARING.orbit(time, force, speed, rough, **line)


@pytest.mark.parametrize("line", [{}, {"tilt": TILT}], ids=["aligned", "tilt"])
@pytest.mark.parametrize("stored", [{}, {"capacity": 3e3, "start_temperature": 313.15}], ids=str)
def test_temperature_of_a_film_in_motion(line, stored):
    """The grid takes path and temperature in turns, the reduced film takes both in one loop."""
    heat = Heat(**OIL, **stored)
    found = [
        BEARING.orbit(TIME, LOAD, SPEED, replace(film, lubricant=None, heat=heat), **line)
        for film in (FILM, REDUCED)
    ]
    grid, few = found
    np.testing.assert_allclose(few.temperature, grid.temperature, atol=0.05)
    np.testing.assert_allclose(few.friction_power, grid.friction_power, rtol=4e-3)
    np.testing.assert_allclose(few.minimum_film, grid.minimum_film, rtol=8e-3)
    assert few.temperature.units == "K"
    assert bool(np.ptp(few.temperature.values) > 1.0) == bool(stored)


def test_stored_heat_ends_at_the_heat_balance():
    """Under a load that stays, the slow state comes to rest where the equilibrium is."""
    heat = Heat(**OIL, capacity=2e3, start_temperature=313.15, transfer=50.0)
    time = np.linspace(0.0, 20.0, 201)
    film = replace(REDUCED, lubricant=None, heat=heat)
    path = BEARING.orbit(time, np.tile(4 * FORCE, (201, 1)), SPEED, film)
    rest = BEARING.equilibrium(4 * FORCE, SPEED, film)
    assert float(path.temperature[-1]) == pytest.approx(float(rest.temperature), abs=2e-3)
    for name in ANSWERS:
        assert float(path[name][-1]) == pytest.approx(float(getattr(rest, name)), rel=1e-4)


def test_heat_is_of_second_order_in_time():
    heat, ends = Heat(**OIL, capacity=8e3, start_temperature=308.15), []
    for n in (10, 20, 40):
        time = np.linspace(0.0, 1.0, n + 1)
        film = replace(REDUCED, lubricant=None, heat=heat)
        path = BEARING.orbit(time, np.tile(FORCE, (n + 1, 1)), SPEED, film, tolerance=1e-11)
        ends.append(float(path.temperature[-1]))
    coarse, fine = np.diff(ends)
    assert np.log2(abs(coarse / fine)) > 1.5


@pytest.mark.parametrize("law", [MassConserving(), Guembel(), Reynolds()], ids=lambda x: x.kind)
def test_every_law_tilts(law):
    film = Film(
        Lubricant(0.05), law, edge_pressure=1e5, inlet=None, grading="uniform", grid=(60, 20)
    )
    some = slice(None, 16)
    grid, few = (
        BEARING.orbit(TIME[some], LOAD[some], SPEED, replace(film, rung=rung), tilt=TILT[some])
        for rung in ("grid", "reduced")
    )
    np.testing.assert_allclose(few.eccentricity_ratio, grid.eccentricity_ratio, rtol=8e-3)
    np.testing.assert_allclose(few.friction_power, grid.friction_power, rtol=5e-3)


SMALL = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
RUBBING = Film(
    Lubricant(0.03), GasMixture(5e4), edge_pressure=1.5e5, inlet=None, grading="uniform",
    grid=(120, 40), shell=LocalShell(2e-12), contact=replace(
        ROUGH, asperities=replace(ROUGH.asperities, roughness=1e-6)
    ),
)  # fmt: skip
PRESSED = np.array([4e4, 5e3])
TILTED = {"tilt": (0.0, 2e-5)}


@pytest.mark.parametrize(
    ("speed", "line", "more"),
    [
        (0.1, {}, {}),
        (0.1, {}, {"contact": replace(RUBBING.contact, pattern=3.0)}),
        (0.0, {}, {}),
    ],
    ids=["aligned", "pattern", "standing"],
)
def test_asperities_on_a_yielding_shell_are_those_of_the_grid(speed, line, more):
    """Both on 240 cells around: what a soft shell drags over a face differs, and so on fewer."""
    film = replace(RUBBING, grid=(240, 80), **more)
    grid = SMALL.equilibrium(PRESSED, speed, film, **line)
    few = SMALL.equilibrium(PRESSED, speed, replace(film, rung="reduced", grid=(240, 40)), **line)
    assert grid.contact_share > 0.25
    for name, bound in (("eccentricity_ratio", 2e-4), ("minimum_film", 1e-3),
                        ("maximum_pressure", 8e-3), ("contact_share", 4e-3),
                        ("contact_pressure", 6e-3), ("shell_deformation", 2e-3)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(grid, name), rel=bound), name
    assert few.friction_power == pytest.approx(grid.friction_power, rel=4e-3)
    size = few.stiffness.shape[0]
    one, other = few.stiffness, grid.stiffness[:size, :size]
    np.testing.assert_allclose(one, other, atol=2e-3 * np.abs(other).max())


def test_stiffness_on_a_yielding_shell_is_the_slope_of_the_load():
    """Where asperities rub, a load a little larger moves the shaft as the stiffness says."""
    film = replace(RUBBING, rung="reduced", grid=(60, 20))
    tight = {"tolerance": 1e-12}
    state = SMALL.equilibrium(PRESSED, 0.1, film, **tight)
    for way in np.eye(2) * 4.0:
        beside = [SMALL.equilibrium(PRESSED + sign * way, 0.1, film, **tight) for sign in (1, -1)]
        moved = 0.5 * (beside[0].eccentricity - beside[1].eccentricity)
        np.testing.assert_allclose(state.stiffness @ moved, way, atol=2e-4 * 4.0)


def test_what_it_does_not_know_is_named():
    with pytest.raises(InputError, match="thickness, poisson_ratio"):
        BEARING.equilibrium(FORCE, SPEED, replace(REDUCED, shell=LinedShell(0.5, 1e9, 0.45)))


def test_moments_of_little_load_on_a_path_ask_for_no_more_points(monkeypatch):
    """A load that swings through next to nothing around a tilted shaft, as gusts make it."""
    levels = []

    def spy(*given, **more):
        levels.append(given[-1])
        return composed_model.build(*given, **more)

    monkeypatch.setattr(composed_path, "build", spy)
    time = np.linspace(0.0, 6.0, 241)
    load = np.stack([8e5 + 1e6 * np.sin(4.0 * time), 1e5 * np.cos(3.0 * time)], axis=-1)
    line = {"tilt": np.tile(0.4 * UNIT, (241, 2))}
    few = BEARING.orbit(time, load, SPEED, REDUCED, **line)
    assert levels == [0]
    monkeypatch.setattr(composed_path, "LEVELS", composed_model.LEVELS[1:])
    fine = BEARING.orbit(time, load, SPEED, REDUCED, **line)
    assert levels == [0, 1]
    assert float(few.minimum_film.min()) == pytest.approx(float(fine.minimum_film.min()), rel=5e-4)
    assert float(few.maximum_pressure.max()) == pytest.approx(
        float(fine.maximum_pressure.max()), rel=5e-4
    )


def gust(samples):
    """Half a minute, in the middle of which the shaft tilts until an end is close to the bore."""
    time = np.linspace(0.0, 30.0, samples)
    near = np.exp(-(((time - 12.0) / 0.7) ** 2))
    load = np.stack([2e6 + 3e5 * np.sin(0.8 * time), 2e5 * np.cos(0.7 * time)], axis=-1)
    return time, load, UNIT * np.stack([0.1 + 0.05 * np.sin(time), -0.7 * near], axis=-1)


@pytest.mark.filterwarnings("error::loadflow.errors.ValidityWarning")
def test_more_points_across_go_on_from_the_film_so_far(monkeypatch):
    """Of a path that asks for them in its middle alone; gas and oil stay where they are."""
    time, load, tilt = gust(601)
    samples = {}
    goes_on, levels = composed_path.March.goes_on, composed_model.LEVELS

    def counted(march, state, level, begin, end):
        samples.setdefault(level, set()).update(range(begin, end))
        return goes_on(march, state, level, begin, end)

    monkeypatch.setattr(composed_path.March, "goes_on", counted)
    few = BEARING.orbit(time, load, SPEED, REDUCED, tilt=tilt)
    assert samples[0] == set(range(1, 601))
    assert 0 < len(samples[1]) < 150
    assert all(9.0 < time[n] < 15.0 for n in samples[1])
    monkeypatch.setattr(composed_path, "LEVELS", levels[1:])
    fine = BEARING.orbit(time, load, SPEED, REDUCED, tilt=tilt)
    monkeypatch.setattr(composed_path, "LEVELS", levels[:1])
    with pytest.warns(ValidityWarning, match="not resolved at .* first at t = 11"):
        coarse = BEARING.orbit(time, load, SPEED, REDUCED, tilt=tilt)
    for name in ANSWERS:
        assert apart(few, fine, name) < 5e-4, name
    assert apart(coarse, fine, "minimum_film") > 5e-3
    assert apart(coarse, fine, "maximum_pressure") > 1e-2


@pytest.mark.parametrize("effect", ["tilt and bend", "moment", "shell", "contact"])
def test_a_path_in_stretches_is_the_path_in_one(effect, monkeypatch):
    """What a step knows of the two before it goes with the film, where steps are cut, too."""
    film, line = EFFECTS[effect]
    load = LOAD.copy()
    load[15:] *= 3.0  # at a blow
    heat = Heat(**OIL, capacity=3e3, start_temperature=313.15)
    film = replace(REDUCED, lubricant=None, heat=heat, **film)
    whole = BEARING.orbit(TIME, load, SPEED, film, tolerance=1e-11, **line)
    monkeypatch.setattr(composed_path, "STRETCH", 4)
    monkeypatch.setattr(composed_path, "LONG", 7)
    parts = BEARING.orbit(TIME, load, SPEED, film, tolerance=1e-11, **line)
    for name in (*ANSWERS, "temperature"):
        np.testing.assert_array_equal(parts[name], whole[name], name)


def test_a_path_that_rubs_stays_with_more_points_as_long_as_it_asks_for_them(monkeypatch):
    """To try few points first in each stretch took as long as the path itself."""
    samples = [0, 0]
    goes_on, levels = composed_path.March.goes_on, composed_model.LEVELS

    def counted(march, state, level, begin, end):
        samples[level] += end - begin
        return goes_on(march, state, level, begin, end)

    monkeypatch.setattr(composed_path.March, "goes_on", counted)
    rough = Contact(AsperityContact(roughness=1e-5, contact_modulus=115e9, factor=1e-3))
    film = replace(REDUCED, contact=rough, shell=LocalShell(3e-12))
    time = np.linspace(0.0, 6.0, 241)
    load = np.stack([6e6 + 1.5e6 * np.sin(1.5 * time), 1.2e6 * np.cos(4.0 * time)], axis=-1)
    rubs = BEARING.orbit(time, load, 0.1 * SPEED, film)
    assert samples[0] < 0.3 * time.size
    assert 0.9 * time.size < samples[1] < 1.1 * time.size
    monkeypatch.setattr(composed_path, "LEVELS", levels[1:])
    fine = BEARING.orbit(time, load, 0.1 * SPEED, film)
    for name in ANSWERS:
        assert apart(rubs, fine, name) < 1e-2, name


@pytest.mark.slow
def test_a_tilted_end_on_a_yielding_shell_is_within_the_error_of_the_cells():
    grid = SMALL.equilibrium(PRESSED, 0.3, RUBBING, **TILTED)
    few = SMALL.equilibrium(PRESSED, 0.3, replace(RUBBING, rung="reduced"), **TILTED)
    assert grid.contact_share > 0.2
    for name in ("eccentricity_ratio", "minimum_film", "maximum_pressure"):
        away = abs(getattr(few, name) - getattr(grid, name))
        # of so thin an end the cells bound h_min by a quarter alone, and few are far nearer
        assert away < getattr(grid.grid_error, name) < 0.3 * getattr(grid, name), name


@pytest.mark.slow
def test_a_tilted_end_on_a_yielding_shell_is_that_of_finer_cells():
    """The share of the load on asperities moves by 9 % from 120 to 240 cells around."""
    grid = SMALL.equilibrium(PRESSED, 0.3, replace(RUBBING, grid=(240, 80)), **TILTED)
    film = replace(RUBBING, rung="reduced", grid=(240, 40))
    few = SMALL.equilibrium(PRESSED, 0.3, film, **TILTED)
    for name, bound in (("eccentricity_ratio", 2e-4), ("minimum_film", 1e-3),
                        ("maximum_pressure", 8e-3), ("contact_share", 0.03),
                        ("contact_pressure", 8e-3), ("friction_power", 0.03)):  # fmt: skip
        assert getattr(few, name) == pytest.approx(getattr(grid, name), rel=bound), name


MAIN_BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=5e-4)
"""A main bearing, at speeds of a start."""
DIPPED = Film(Lubricant(0.05), GasMixture(5e4), edge_pressure=5e5, grid=(60, 20), rung="reduced")


@pytest.mark.parametrize("end", [0.0, 1.1e-3])
def test_light_loads_of_slow_shafts_are_answered_without_the_grid(end, monkeypatch):
    monkeypatch.setattr(reduced, "solve_on_grid", lambda *rows: None)
    angle, speed = np.linspace(0.0, 6.0, 13), np.linspace(5e-3, 15e-3, 13)
    tilt = end * MAIN_BEARING.relative_clearance * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    line = {"tilt": tilt} if end else {}
    force = np.tile([7.6e4, 0.0], (angle.size, 1))
    found = MAIN_BEARING.equilibrium(force, speed, DIPPED, strict=False, **line)
    assert found.converged.all()
    monkeypatch.undo()
    some = {name: rows[::6] for name, rows in line.items()}
    grid = MAIN_BEARING.equilibrium(force[::6], speed[::6], replace(DIPPED, rung="grid"), **some)
    assert found.minimum_film[::6] == pytest.approx(grid.minimum_film, rel=0.01)


def test_an_end_that_touches_has_no_film_and_the_grid_is_not_asked(monkeypatch):
    tilt = (0.0, -0.0416 * MAIN_BEARING.relative_clearance)
    given = ((1.57e6, 0.0), 0.0065)
    exact = MAIN_BEARING.equilibrium(*given, replace(DIPPED, rung="grid"), tilt=tilt, strict=False)
    assert not exact.converged
    monkeypatch.setattr(reduced, "solve_on_grid", lambda *rows: pytest.fail("asked"))
    found = MAIN_BEARING.equilibrium(*given, DIPPED, tilt=tilt, strict=False)
    assert not found.converged
    assert found.residual > 0.6
    assert np.isnan([found.minimum_film, found.eccentricity_ratio, found.friction_power]).all()


def test_a_path_begins_where_asperities_hold_the_shaft_in_a_shell_beyond_its_bore():
    """No film of a rigid bore is near that; it is found by way of lesser eccentricities."""
    contact = Contact(AsperityContact(roughness=5.6e-7, contact_modulus=46.5e9, factor=1e-3))
    film = replace(REDUCED, grid=(120, 20), shell=LocalShell(2.06e-12), contact=contact)
    place, load = np.array([1.0044 * BEARING.clearance, 0.0]), np.tile([1.57e6, 0.0], (5, 1))
    path = BEARING.orbit(0.05 * np.arange(5), load, 0.0763, film, start=place)
    assert path["eccentricity_ratio"][0] == pytest.approx(1.0044)
    assert 1e-7 < path["minimum_film"][0] < 2e-6  # on asperities of 0.56 µm
    assert path["contact_force"][0].max() > 0.0
