"""Integrals over reduced films with effects: friction and flows of what a law cuts off."""

from __future__ import annotations

import numpy as np
import pytest

from loadflow.journal import Guembel, JournalBearing, Lubricant, MassConserving
from loadflow.journal.film_model import Film


def squeezed(rung, cells, law):
    """A tilted shaft that hardly turns while its load swings: its film ruptures by squeeze."""
    bearing = JournalBearing(1.27, 1.02, 6.67e-4)
    phase = 0.15 * np.pi * np.arange(8)
    load = np.stack([1780.0 + 2350.0 * np.sin(phase), 1056.0 * np.cos(phase)], axis=-1)
    tilt = np.stack([-0.08 * np.cos(phase), -0.534 * np.sin(phase)], axis=-1)
    tilt *= bearing.clearance / bearing.width
    film = Film(Lubricant(0.01023), law, 1e5, grid=cells, rung=rung, inlet=None)
    path = bearing.orbit(0.1253 * phase, load, 1.76 * np.cos(0.7 * phase), film, tilt=tilt)
    return path.isel(time=slice(2, None))


@pytest.mark.parametrize("cut", [1e5, 5e4])
def test_friction_and_flow_of_a_film_that_is_cut_off_are_those_of_the_grid(cut):
    """A polynomial through the cut pressure had 3 % less friction, 8 % less to 13 % more flow."""
    few, fine = squeezed("reduced", (60, 8), Guembel(cut)), squeezed("grid", (60, 32), Guembel(cut))
    for name, share in (("friction_power", 0.01), ("side_flow", 0.005), ("minimum_film", 0.002)):
        np.testing.assert_allclose(few[name], fine[name], rtol=share, err_msg=name)


@pytest.mark.parametrize("tilt", [0.0, 0.4])
@pytest.mark.parametrize(("ratio", "share"), [(0.5, 0.002), (1.0, 0.015), (1.5, 0.025)])
def test_what_leaves_a_column_is_what_its_balance_leaves_for_the_end(tilt, ratio, share):
    """The pressure falls to rupture close by the ends: slopes there were up to 11 % off."""
    bearing = JournalBearing(1.0, ratio, 1e-3)
    force = (0.5 * 0.1 * 1.2 * ratio / 1e-6, 0.0)
    line = {"tilt": np.array([0.5, 1.0]) * tilt * bearing.clearance / ratio} if tilt else {}
    flow = {
        rung: bearing.equilibrium(
            force, 1.2,
            Film(Lubricant(0.1), MassConserving(9e4), 1e5, grid=cells, rung=rung, inlet=None),
            **line,
        ).side_flow
        for rung, cells in (("reduced", (60, 8)), ("grid", (60, 24)))
    }  # fmt: skip
    assert flow["reduced"] == pytest.approx(flow["grid"], rel=share)
