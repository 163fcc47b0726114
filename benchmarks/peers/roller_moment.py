"""Moment on one roller as the integrators of others ask for it: at a time, for a spin."""

from __future__ import annotations

from numba import njit

from loadflow.rolling.motion._motion_kernels import _balance, both_contacts


@njit(cache=True, nogil=True, error_model="numpy")
def roller_moment(film, surface, turning, swing, load, outward, tangential, spin):
    """Moment on a roller, N m: its inertia times the rate of the spin."""
    contacts = both_contacts(film, surface, spin, load, outward)
    steady = film.orbit_drag * turning - film.inertia * swing
    slip = surface - film.radius * spin
    return _balance(film, contacts, surface, steady, tangential, slip)[0]
