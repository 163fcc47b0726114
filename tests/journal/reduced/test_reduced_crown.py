"""The rung "reduced" in a bore that widens toward its ends, against the grid and the exact gap."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Contact,
    Crown,
    Film,
    GasMixture,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Recess,
    TiltingPads,
)
from loadflow.journal.models.composed import model as composed_model
from loadflow.tribology import AsperityContact

SIZE = {"diameter": 3.0, "width": 2.25, "relative_clearance": 0.5e-3}
FILM = Film(Lubricant(0.05), MassConserving(), edge_pressure=0.5e6, grid=(60, 40))
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
SPEED, CROWN = 1.267, Crown(height=1e-4, length=0.5)
TIME = np.linspace(0.0, 1.5, 11)
LOAD = np.stack([2e6 + 5e5 * np.sin(1.5 * TIME), 4e5 * np.cos(4 * TIME)], axis=-1)
TILT = 1e-4 * np.stack([1.2 + np.sin(1.2 * TIME), np.cos(2 * TIME)], axis=-1)

CASES = {
    "aligned": ({}, {}, {}),
    "tilt": ({}, {}, {"tilt": TILT}),
    "contact, tilt": ({}, {"contact": ROUGH}, {"tilt": 1.2 * TILT}),
    "shell, contact, tilt": (
        {}, {"shell": LocalShell(3e-11), "contact": ROUGH}, {"tilt": 1.2 * TILT},
    ),
    "lobes, tilt": ({"shape": Lobes(2, preload=0.2)}, {}, {"tilt": 0.5 * TILT}),
    "pads": ({"shape": TiltingPads(4, arc=1.2, preload=0.3, angle=0.8)}, {}, {}),
}  # fmt: skip
"""Shape of the bore, parts of the film, and how the shaft lies."""

BOUNDS = {
    "eccentricity_ratio": 0.002, "minimum_film": 0.006, "maximum_pressure": 0.006,
    "friction_power": 0.002, "side_flow": 0.02,
}  # fmt: skip


def apart(one, other, name):
    one, other = (np.asarray(getattr(result, name)) for result in (one, other))
    return float(np.abs(one / other - 1.0).max())


LONG = "shell, contact, tilt"  # on the grid


@pytest.mark.parametrize(
    "case", [pytest.param(one, marks=[pytest.mark.slow] * (one == LONG)) for one in CASES]
)
def test_at_rest_a_crowned_bore_is_that_of_the_grid(case):
    shape, film, line = CASES[case]
    bearing = JournalBearing(**SIZE, relief=(CROWN,), **shape)
    some = {name: values[::5] for name, values in line.items()}
    grid, few = (
        bearing.equilibrium(LOAD[::5], SPEED, replace(FILM, rung=rung, **film), **some)
        for rung in ("grid", "reduced")
    )
    for name, bound in BOUNDS.items():
        assert apart(few, grid, name) < bound, name


@pytest.mark.parametrize("case", CASES)
def test_in_motion_a_crowned_bore_is_that_of_the_grid(case):
    shape, film, line = CASES[case]
    bearing = JournalBearing(**SIZE, relief=(CROWN,), **shape)
    grid, few = (
        bearing.orbit(TIME, LOAD, SPEED, replace(FILM, rung=rung, **film), **line)
        for rung in ("grid", "reduced")
    )
    for name, bound in BOUNDS.items():
        assert apart(few, grid, name) < bound, name


@pytest.mark.parametrize("crown", [CROWN, Crown(3e-4, 0.3), Crown(1e-4, 0.5, 1.0), Crown(-3e-5)])
def test_the_narrowest_film_is_that_of_the_gap_wherever_it_lies(crown):
    bearing = JournalBearing(**SIZE, relief=(crown,))
    film = replace(FILM, rung="reduced")
    state = bearing.equilibrium(LOAD[0], SPEED, film, tilt=(1e-4, 2e-4))
    z = np.linspace(-0.5, 0.5, 20001) * bearing.width
    x, y = state.eccentricity[0] + 2e-4 * z, state.eccentricity[1] - 1e-4 * z
    gap = bearing.clearance + crown.added(np.zeros(1), z, bearing.width)[0] - np.hypot(x, y)
    assert state.minimum_film == pytest.approx(gap.min(), rel=2e-3)


def test_a_crown_of_no_height_is_none():
    film = replace(FILM, rung="reduced")
    flat = JournalBearing(**SIZE, relief=(Crown(0.0),))
    plain = JournalBearing(**SIZE)
    one, other = (b.orbit(TIME, LOAD, SPEED, film, tilt=TILT) for b in (flat, plain))
    for name in BOUNDS:
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-9)


def test_a_short_crown_takes_more_points_across():
    film = replace(FILM, rung="reduced")
    wide, short = (
        composed_model.build(
            JournalBearing(**SIZE, relief=(Crown(1e-4, length),)), film,
            np.full(1, SPEED), composed_model.Line(),
        ).film.nodes.z.size
        for length in (1.1, 0.2)
    )  # fmt: skip
    assert short > wide


def test_a_pocket_is_refused_by_name():
    bearing = JournalBearing(**SIZE, relief=(CROWN, Recess(0.0, 0.2, 1e-4)))
    with pytest.raises(InputError, match=r"'reduced' is not allowed: \"grid\" for .*Recess"):
        bearing.equilibrium(LOAD[0], SPEED, replace(FILM, rung="reduced"))


STEEP = {
    "in a corner": (
        JournalBearing(2.536, 1.3717, 1.47e-3, relief=(Crown(6.36e-4, 0.49305, 3.0),)),
        (5.6e5, 1.74e5), 1.347, (5.566e-4, 4.164e-5),
    ),
    "beside a cone": (
        JournalBearing(2.578, 1.3983, 0.9592e-3, relief=(Crown(4.144e-4, 0.1858, 1.0),)),
        (3.714e6, -3.236e6), 2.375, (6.745e-5, 2.277e-5),
    ),
    "at an end": (
        JournalBearing(1.13, 1.2068, 0.7083e-3, relief=(Crown(2.85e-5, 0.23983, 2.0),)),
        (7.73e5, -2.15e5), 1.729, (-1.13e-5, -2.736e-4),
    ),
}  # fmt: skip
"""Bearing, load, speed and tilt of films whose highest polynomials are small by chance."""


@pytest.mark.parametrize("case", STEEP)
def test_steep_films_take_the_points_that_they_need(case, monkeypatch):
    """By the two highest alone the largest pressure was 6 to 27 % off without a warning."""
    bearing, load, speed, tilt = STEEP[case]
    film = replace(FILM, rung="reduced", cavitation=GasMixture(5e4), grid=(120, 40))
    few = bearing.equilibrium(load, speed, film, tilt=tilt)
    monkeypatch.setattr(composed_model, "POINTS", (48,) * 5)
    many = bearing.equilibrium(load, speed, film, tilt=tilt)
    for name in ("maximum_pressure", "minimum_film"):
        assert apart(few, many, name) < 0.02, name
