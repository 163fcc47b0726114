"""A shaft that tilts fast: the peak of what it squeezes out, and the pressure that it comes to."""

import numpy as np
import pytest

from loadflow.journal import Film, GasMixture, JournalBearing, Lubricant

BEARING = JournalBearing(diameter=3.0, width=1.5, relative_clearance=1e-3)
FILM = Film(
    Lubricant(0.06), GasMixture(0.05e6), edge_pressure=1.5e5, grid=(120, 20), rung="reduced"
)
FORCE, SPEED, TILT = np.array([1.2e6, 0.2e6]), 1.2, np.array([4.2e-4, 0.0])


def path(film, until=3.0, step=0.025):
    """Path under a steady load while the shaft tilts from straight, in 0.3 s; and its pressure."""
    time = np.arange(0.0, until + 0.5 * step, step)
    turned = 0.5 * (1.0 - np.cos(np.pi * np.clip((time - 1.0) / 0.3, 0.0, 1.0)))
    force, speed = np.tile(FORCE, (time.size, 1)), np.full(time.size, SPEED)
    orbit = BEARING.orbit(time, force, speed, film, tilt=np.outer(turned, TILT))
    return orbit["maximum_pressure"].values


def on_grid(across):
    return Film(
        FILM.lubricant, FILM.cavitation, edge_pressure=FILM.edge_pressure, grid=(120, across)
    )


@pytest.mark.slow
def test_the_peak_on_the_grid_comes_to_that_of_the_reduced_film_as_cells_across_are_halved():
    """On 24 cells across, the end of the bearing that is squeezed is not resolved."""
    reduced = path(FILM).max()
    coarse, fine = (path(on_grid(across)).max() for across in (24, 48))
    assert reduced > 2.5 * path(FILM)[0]
    assert abs(fine - reduced) < 0.7 * abs(coarse - reduced)
    assert fine == pytest.approx(reduced, rel=0.005)


def test_the_peak_does_not_depend_on_the_steps():
    assert path(FILM, step=0.025).max() == pytest.approx(path(FILM, step=0.00625).max(), rel=0.005)


def test_a_shaft_that_has_tilted_comes_to_the_pressure_at_rest_by_squeeze_alone():
    """No other state is left behind: what differs after a second is on its way."""
    rest = BEARING.equilibrium(FORCE, SPEED, FILM, tilt=TILT).maximum_pressure
    pressure = path(FILM, until=20.0)
    assert pressure[120] < 0.98 * rest  # 1.7 s after it
    assert np.ptp(pressure[400:]) < 1e-4 * rest
    # a path keeps 14 points across here, the film at rest takes 28; with 20 the two agree to 1e-4
    assert pressure[-1] == pytest.approx(rest, rel=0.008)
