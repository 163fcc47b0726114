"""Crank drive: derivatives, loads in three frames, inertia of rollers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling.motion.crank import CrankDrive

DRIVE = CrankDrive(
    radius=42.5e-3, rod_length=143.5e-3, piston_mass=0.4, rod_mass=0.6, rod_centre=43e-3,
    web_mass=1.0, web_radius=12e-3, counter_mass=0.8, counter_radius=54e-3, bearing_mass=0.2,
)  # fmt: skip
angles = st.floats(-20, 20)


@given(angles)
def test_speeds_are_derivatives(phi):
    step, omega = 1e-4, 3.0
    before, here, after = (DRIVE.piston(phi + k * step, omega) for k in (-1, 0, 1))
    assert here.speed == pytest.approx(
        (after.travel - before.travel) / (2 * step) * omega, rel=1e-5, abs=1e-8
    )
    assert here.acceleration == pytest.approx(
        (after.speed - before.speed) / (2 * step) * omega, rel=1e-5, abs=1e-7
    )
    before, here, after = (DRIVE.swing(phi + k * step, omega) for k in (-1, 0, 1))
    assert here.speed == pytest.approx((after.angle - before.angle) / (2 * step) * omega, rel=1e-6)
    assert here.acceleration == pytest.approx(
        (after.speed - before.speed) / (2 * step) * omega, rel=1e-5, abs=1e-6
    )


def test_series_is_good_to_the_fourth_power_of_the_ratio():
    phi = np.linspace(0, 2 * np.pi, 73)
    exact, series = DRIVE.piston(phi, 1.0), DRIVE.piston(phi, 1.0, exact=False)
    assert np.abs(exact.travel - series.travel).max() < 0.2 * DRIVE.ratio**3 * DRIVE.radius
    assert np.ptp(exact.travel) == pytest.approx(2 * DRIVE.radius, rel=1e-12)


@given(angles, st.floats(0, 600), st.floats(-5e4, 5e4))
def test_the_load_has_one_magnitude_in_all_frames(phi, omega, gas):
    loads = DRIVE.pin_loads(phi, omega, gas)
    sizes = [float(np.hypot(*frame)) for frame in loads]
    assert sizes[1] == pytest.approx(sizes[0], rel=1e-12, abs=1e-9)
    assert sizes[2] == pytest.approx(sizes[0], rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("place", [0.0, 2 * np.pi / 18, 3.0])
@pytest.mark.parametrize("phi", [0.3, 1.7, 4.0])
def test_inertia_is_the_second_derivative_of_the_path(phi, place):
    omega, mass, own, share = 1000 * np.pi / 30, 6.67e-3, 27.75e-3, 63 / 111

    def path(p):  # (4.66)
        turn = share * DRIVE.swing(p, omega).angle + place
        return 42.5e-3 * np.exp(1j * p) + own * np.exp(1j * (p - turn))

    step = 1e-3
    second = (
        -path(phi + 2 * step) + 16 * path(phi + step) - 30 * path(phi) + 16 * path(phi - step)
        - path(phi - 2 * step)
    ) / (12 * step**2)  # fmt: skip
    turn = share * DRIVE.swing(phi, omega).angle + place
    seen = mass * omega**2 * second * np.exp(-1j * (phi - turn))
    found = DRIVE.roller_inertia(phi, omega, mass, 48e-3, 63e-3, place)
    assert found.radial == pytest.approx(seen.real, rel=1e-7)
    assert found.tangential == pytest.approx(seen.imag, rel=1e-6, abs=1e-8)


def test_counterweight_relieves_the_main_bearings():
    phi = np.linspace(0, 2 * np.pi, 37)
    heavy = CrankDrive(radius=42.5e-3, rod_length=143.5e-3, rod_mass=0.6, rod_centre=43e-3)
    light = CrankDrive(
        radius=42.5e-3, rod_length=143.5e-3, rod_mass=0.6, rod_centre=43e-3,
        counter_mass=0.2, counter_radius=54e-3,
    )  # fmt: skip
    sizes = [np.hypot(*d.main_load(phi, 100.0).T).mean() for d in (heavy, light)]
    assert sizes[1] < sizes[0]


@pytest.mark.parametrize("change", [{"rod_length": 0.04}, {"rod_centre": 0.2}, {"radius": -1.0}])
def test_an_impossible_drive_is_refused(change):
    with pytest.raises(InputError):
        CrankDrive(**({"radius": 42.5e-3, "rod_length": 143.5e-3} | change))
