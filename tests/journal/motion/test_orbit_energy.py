"""Power of orbits: what shaft and load give is what friction takes, by a film of our own.

A full film on a grid of its own, with second-order flows, for the path that was found: its
pressure, what is lost in it by shear and by pressure flow, and the moment on the shaft.
"""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import spsolve

from loadflow.journal import JournalBearing, Lubricant, Sommerfeld

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
VISCOSITY = 0.05
FILM = {"lubricant": Lubricant(VISCOSITY), "cavitation": Sommerfeld(), "edge_pressure": 3e6}
AROUND, ACROSS = 144, 16  # of half of the width


def powers(place, velocity, speed):
    """Loss in the film, power of the shaft, W, and force of the film, N; at one time."""
    radius, clearance, width = BEARING.radius, BEARING.clearance, BEARING.width
    step, dz = 2 * np.pi / AROUND, 0.5 * width / ACROSS
    dx, slides = radius * step, speed * radius

    def gap(angle):
        return clearance - place[0] * np.cos(angle) - place[1] * np.sin(angle)

    cells = step * (np.arange(AROUND) + 0.5)
    turn, h, face = np.stack([np.cos(cells), np.sin(cells)]), gap(cells), gap(cells + 0.5 * step)
    squeeze = -velocity @ turn
    along, across = face**3 / (12 * VISCOSITY), h**3 / (12 * VISCOSITY)
    # means of the pressure over half of the width in cosines that vanish at its ends, each exact
    around = sp.diags([along + np.roll(along, 1)], [0]) / dx**2
    around -= sp.diags([along[:-1], along[:-1]], [1, -1]) / dx**2
    around = around.tolil()
    around[0, -1] = around[-1, 0] = -along[-1] / dx**2
    source = -(0.5 * slides * (face - np.roll(face, 1)) / dx + squeeze)
    z = dz * (np.arange(ACROSS) + 0.5)
    pressure = np.zeros((AROUND, ACROSS))
    fall = np.zeros_like(pressure)
    for order in range(1, 2 * ACROSS, 2):
        wave = order * np.pi / width
        part = 4 * (-1) ** (order // 2) / (order * np.pi) * np.cos(wave * z)
        shape = spsolve((around + sp.diags(wave**2 * across)).tocsc(), source)
        pressure += np.outer(shape, part)
        fall -= np.outer(
            shape, 4 * (-1) ** (order // 2) / (order * np.pi) * wave * np.sin(wave * z)
        )
    area = 2 * dx * dz
    slope = (np.roll(pressure, -1, 0) - pressure) / dx
    couette = width * dx * np.sum(VISCOSITY * slides**2 / h)
    flows = area * (np.sum(along[:, None] * slope**2) + np.sum(across[:, None] * fall**2))
    pushed = area * slides * np.sum(0.5 * face[:, None] * slope)
    return couette + flows, couette + pushed, area * (turn @ pressure).sum(axis=1)


def along_path(time, places, velocities, speeds):
    """Loss, power of the shaft and of the load, W, at each time; the latter by the film's force."""
    found = [powers(*one) for one in zip(places, velocities, speeds, strict=True)]
    loss, shaft = (np.array([one[k] for one in found]) for k in (0, 1))
    force = np.array([one[2] for one in found])
    return loss, shaft, np.sum(force * velocities, axis=1), force


@pytest.mark.parametrize("rung", [pytest.param("grid", marks=pytest.mark.slow), "reduced"])
def test_a_closed_orbit_loses_what_shaft_and_load_give_it(rung):
    time = np.linspace(0.0, 2 * np.pi / 11.0, 97)
    load = np.stack([6e3 + 4e3 * np.cos(11 * time), 3e3 * np.sin(11 * time)], axis=1)
    path = BEARING.orbit(time, load, 30.0, periodic="direct", grid=(72, 16), rung=rung, **FILM)
    places = path["eccentricity"].values
    velocities = CubicSpline(time, np.vstack([places[:-1], places[:1]]), bc_type="periodic")(
        time, 1
    )
    every = slice(0, -1, 6)
    loss, shaft, work, force = along_path(time, places[every], velocities[every], np.full(16, 30.0))
    np.testing.assert_allclose(force, load[every], atol=0.01 * np.abs(load).max())
    np.testing.assert_allclose(path["friction_power"].values[every], loss, rtol=1e-3)
    given = shaft.mean() + work.mean()
    assert given == pytest.approx(loss.mean(), rel=1e-3)
    assert abs(work.mean()) > 3e-3 * given  # the load's share is told from nothing


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_a_start_and_a_stop_in_steps_of_their_own_lose_what_shaft_and_load_give_them(rung):
    time = np.linspace(0.0, 3.0, 121)
    speed = np.interp(time, [0.0, 1.0, 2.0, 3.0], [3.0, 40.0, 40.0, 3.0])
    load = np.stack([4e3 + 2e3 * np.sin(9 * time), 1e3 * np.cos(6 * time)], axis=1)
    path = BEARING.orbit(time, load, speed, step="adaptive", grid=(72, 16), rung=rung, **FILM)
    places = path["eccentricity"].values
    every = slice(4, -4, 4)
    velocities = CubicSpline(time, places)(time, 1)
    loss, shaft, work, _ = along_path(time, places[every], velocities[every], speed[every])
    np.testing.assert_allclose(path["friction_power"].values[every], loss, rtol=0.01)
    lost = np.trapezoid(path["friction_power"].values[every], time[every])
    given = np.trapezoid(shaft + work, time[every])
    assert lost == pytest.approx(given, rel=2e-3)
