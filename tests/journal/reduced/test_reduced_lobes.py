"""The rung "reduced" around fixed lobes and arcs, against the grid and itself."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Arc,
    Contact,
    GasMixture,
    Guembel,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Sommerfeld,
    Turbulence,
)
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film_model import Film
from loadflow.journal.models._reduced_kernels import least_around
from loadflow.journal.models.ring import lobed, ring_of, units_of
from loadflow.tribology import AsperityContact

OIL = Lubricant(viscosity=0.1)
SPEED = 1.2
FORCE = np.array([[1.5e6, 1e5], [4e5, -3e5], [3e6, 0.0]])
LEMON = Lobes(count=2, preload=0.3, groove=0.35)
SHAPES = {
    "lemon": LEMON,
    "three lobes": Lobes(count=3, preload=0.5, groove=0.3, angle=0.3),
    "offset halves": Lobes(count=2, preload=0.4, groove=0.35, offset=0.8),
    "arc": Arc(angle=0.0, span=2.6),
}
LAWS = {
    "gas mixture": GasMixture(5e4),
    "guembel": Guembel(1e5),
    "mass conserving": MassConserving(5e4),
}


def bearing(shape):
    return JournalBearing(diameter=1.4, width=1.3, relative_clearance=0.85e-3, shape=shape)


def at_rest(shape, law, grid=(120, 40), force=FORCE, **film):
    return bearing(shape).equilibrium(
        force, SPEED, OIL, cavitation=law, edge_pressure=1e5, grid=grid, **film
    )


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_it_is_the_grid_of_as_many_cells(shape, law):
    ours, theirs = at_rest(shape, law, rung="reduced"), at_rest(shape, law)
    assert ours.converged.all()
    for name, share in (("minimum_film", 0.01), ("maximum_pressure", 0.02),
                        ("friction_power", 0.005), ("side_flow", 0.012),
                        ("total_fill", 0.01)):  # fmt: skip
        np.testing.assert_allclose(
            getattr(ours, name), getattr(theirs, name), rtol=share, err_msg=name
        )
    away = np.abs(ours.supply_flow - theirs.supply_flow) / theirs.side_flow
    assert away.max() < 0.04
    clearance = bearing(shape).clearance
    assert np.abs(ours.eccentricity - theirs.eccentricity).max() < 0.003 * clearance


def test_cells_converge_with_second_order():
    def film(cells):
        return at_rest(LEMON, Sommerfeld(), (cells, 20), FORCE[:1], rung="reduced").minimum_film[0]

    coarse, middle, fine = (film(cells) for cells in (40, 80, 160))
    assert 3.5 < (middle - coarse) / (fine - middle) < 4.6


def test_stiffness_is_the_slope_of_the_load():
    first = at_rest(LEMON, GasMixture(5e4), rung="reduced")
    for more in ([1e3, 0.0], [0.0, 1e3]):
        ahead, behind = (
            at_rest(LEMON, GasMixture(5e4), force=FORCE + side * np.array(more), rung="reduced")
            for side in (0.5, -0.5)
        )
        change = ahead.eccentricity - behind.eccentricity
        carried = np.einsum("nij,nj->ni", first.stiffness, change)
        np.testing.assert_allclose(carried, np.tile(more, (3, 1)), atol=0.1)


def test_the_film_and_its_narrowest_gap_are_those_of_the_bore():
    found = at_rest(LEMON, GasMixture(5e4), rung="reduced")
    theirs = bearing(LEMON).pressure(
        found.eccentricity, SPEED, OIL, cavitation=GasMixture(5e4), edge_pressure=1e5,
        grid=(120, 40),
    )  # fmt: skip
    np.testing.assert_allclose(found.minimum_film, theirs.minimum_film, rtol=1e-3)
    np.testing.assert_allclose(-theirs.film_force, FORCE, atol=0.02 * 3e6)


def test_an_orbit_is_that_of_the_grid():
    time = np.arange(160) * 0.05
    force = np.stack([1.2e6 + 4e5 * np.sin(3 * time), 3e5 * np.cos(2.3 * time)], axis=1)
    given = {"cavitation": GasMixture(5e4), "edge_pressure": 1e5, "grid": (60, 20)}
    ours, theirs = (
        bearing(LEMON).orbit(time, force, SPEED, OIL, rung=rung, **given)
        for rung in ("reduced", "grid")
    )
    assert float(ours["minimum_film"].min() / theirs["minimum_film"].min()) == pytest.approx(
        1, abs=0.01
    )
    for name, share in (("maximum_pressure", 0.02), ("friction_power", 0.005)):
        np.testing.assert_allclose(ours[name], theirs[name], rtol=share, err_msg=name)
    place = np.abs(ours["eccentricity"] - theirs["eccentricity"]).max()
    assert float(place) < 0.01 * bearing(LEMON).clearance


EFFECTS = {
    "tilt": {"tilt": (2e-5, -3e-5)},
    "moment": {"moment": (2e4, -1e4)},
    "local shell": {"shell": LocalShell(4e-12)},
    "turbulence": {"turbulence": Turbulence()},
}


def differences(ours, theirs, shares):
    """Results that differ by more than their share of the largest."""
    return {
        name: float(np.abs(getattr(ours, name) - getattr(theirs, name)).max())
        for name, share in shares.items()
        if np.abs(getattr(ours, name) - getattr(theirs, name)).max()
        > share * np.abs(getattr(theirs, name)).max()
    }


@pytest.mark.parametrize("effect", EFFECTS)
@pytest.mark.parametrize("shape", ["lemon", "arc"])
def test_effects_around_lobes_and_arcs_are_those_of_the_grid(shape, effect):
    speed, oil = SPEED, OIL
    if effect == "turbulence":  # 9 times the critical Reynolds number, at the same η ω
        speed, oil = 50 * SPEED, Lubricant(viscosity=0.02 * OIL.viscosity)
    ours, theirs = (
        bearing(SHAPES[shape]).equilibrium(
            np.array([[2.5e6, 3e5]]), speed, oil, cavitation=GasMixture(5e4), edge_pressure=1e5,
            grid=(120, 40), rung=rung, **EFFECTS[effect],
        )
        for rung in ("reduced", "grid")
    )  # fmt: skip
    assert ours.converged.all()
    assert ours.minimum_film[0] != theirs.minimum_film[0]  # not solved on the grid instead
    shares = {"minimum_film": 0.01, "maximum_pressure": 0.02, "friction_power": 0.01,
              "eccentricity_ratio": 0.002, "stiffness": 0.05, "damping": 0.05}  # fmt: skip
    assert differences(ours, theirs, shares) == {}


@pytest.mark.parametrize(
    ("shape", "around"),  # a film that 120 cells do not resolve is solved on more of them
    [(Lobes(2, preload=0.4, groove=0.3), 120), (Arc(0.0, 2.8), 480)],
)
def test_asperities_of_lobes_and_arcs_carry_what_they_do_on_the_grid(shape, around):
    small = JournalBearing(0.4, 0.3, 1e-3, shape=shape)
    rough = Contact(
        AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1
    )
    ours, theirs = (
        small.equilibrium(
            (2.5e6, 5e5), 1.0, Lubricant(0.05), cavitation=GasMixture(1e4), edge_pressure=1e5,
            grid=grid, rung=rung, inlet=None, contact=rough,
        )
        for rung, grid in (("reduced", (120, 16)), ("grid", (around, 40)))
    )  # fmt: skip
    assert theirs.contact_share > 0.01  # asperities count
    assert ours.contact_share == pytest.approx(theirs.contact_share, rel=0.03)
    shares = {"minimum_film": 0.01, "maximum_pressure": 0.02, "friction_power": 0.02,
              "eccentricity_ratio": 0.001, "stiffness": 0.02, "damping": 0.03}  # fmt: skip
    assert differences(ours, theirs, shares) == {}


def test_an_orbit_with_effects_around_lobes_is_that_of_the_grid():
    time = np.arange(40) * 0.05
    force = np.stack([1.2e6 + 4e5 * np.sin(3 * time), 3e5 * np.cos(2.3 * time)], axis=1)
    tilt = np.stack([2e-5 * np.sin(2 * time), 0 * time - 3e-5], axis=1)
    given = {"cavitation": GasMixture(5e4), "edge_pressure": 1e5, "shell": LocalShell(4e-12)}
    ours, theirs = (
        bearing(LEMON).orbit(time, force, SPEED, OIL, rung=rung, grid=grid, tilt=tilt, **given)
        for rung, grid in (("reduced", (60, 16)), ("grid", (60, 30)))
    )
    for name, share in (("minimum_film", 0.015), ("maximum_pressure", 0.03),
                        ("friction_power", 0.005), ("eccentricity_ratio", 0.005)):  # fmt: skip
        np.testing.assert_allclose(ours[name], theirs[name], rtol=share, err_msg=name)


@pytest.mark.parametrize(
    ("shape", "given", "name"),
    [
        (Arc(angle=0.0, span=2.6, groove_pressure=3e5), {}, "groove_pressure"),
        (LEMON, {"inlet": "widest gap"}, "inlet"),
    ],
)
def test_what_it_does_not_know_is_refused_by_name(shape, given, name):
    with pytest.raises(InputError, match=f"{name}.*is not allowed|{name} ="):
        at_rest(shape, GasMixture(5e4), rung="reduced", **given)


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_the_narrowest_gap_is_that_of_the_bore_between_the_cells_too(shape):
    """A film whose gap closes between two places of its cells is no answer."""
    own = bearing(shape)
    film = Film(OIL, Guembel(1e5), 1e5, grid=(24, 8), rung="reduced")
    units = units_of(own, film, np.array([SPEED]))
    ring = lobed(ring_of(units, 2.0), own, film)
    places = np.random.default_rng(1).uniform(-0.9, 0.9, (50, 2))
    found = [least_around.py_func(ring, x, y) for x, y in places.tolist()]
    np.testing.assert_allclose(found, Bore.of(own).narrowest(places), atol=1e-12)
