"""Compiled blade-element momentum at one section.

Ning, "A simple solution method for the blade element momentum equations with guaranteed
convergence", Wind Energy 17 (2014): one residual in the inflow angle, bracketed. Prandtl's tip and
hub loss, Buhl's correction at high induction.
"""

import numpy as np

from .._compile import kernel, part, section
from ..slots import S_AXIAL
from ._airfoil_kernels import SLOW, angle_of, polar

_SMALL = 1e-6
_HALF_PI = 0.5 * np.pi
_BRACKET = 0.02  # rad, around the inflow angle of the step before
_TOLERANCE = 1e-7  # rad
_MOMENTUM_LIMIT = 2.0 / 3.0


@part
def loss(m, i, sine):
    """Prandtl's tip and hub loss at section i for |sin φ|."""
    radius = m.radius[i]
    half = 0.5 * m.blades / max(sine, 1e-9)
    tip = np.arccos(min(1.0, np.exp(-half * (m.tip_radius - radius) / radius)))
    factor = tip * 2 / np.pi
    if m.hub_radius > 0:
        root = np.exp(-half * (radius - m.hub_radius) / m.hub_radius)
        factor *= np.arccos(min(1.0, root)) * 2 / np.pi
    return max(factor, 1e-4)


@kernel
def induction(m, i, angle, pitch, normal, tangential):
    """Induction factors that the forces at inflow angle φ ask for, and the residual of φ."""
    sine, cosine = np.sin(angle), np.cos(angle)
    attack = angle - m.twist[i] - pitch
    lift = polar(m.lift, i, attack)
    drag = polar(m.drag, i, attack) if m.drag_in_induction else 0.0
    force_normal = lift * cosine + drag * sine
    force_tangential = lift * sine - drag * cosine
    solidity = m.blades * m.chord[i] / (2 * np.pi * m.radius[i])
    prandtl = loss(m, i, abs(sine))
    k = solidity * force_normal / (4 * prandtl * sine * sine)
    k_swirl = solidity * force_tangential / (4 * prandtl * sine * cosine)
    if normal * tangential < 0:
        k_swirl = -k_swirl
    if angle > 0:
        if k <= _MOMENTUM_LIMIT:
            a = k / (1 + k) if k > -0.9 else -9.0
        else:
            g1 = 2 * prandtl * k - (10.0 / 9.0 - prandtl)
            g2 = max(2 * prandtl * k - prandtl * (4.0 / 3.0 - prandtl), 0.0)
            g3 = 2 * prandtl * k - (25.0 / 9.0 - 2 * prandtl)
            a = 1 - 0.5 / np.sqrt(g2) if abs(g3) < _SMALL else (g1 - np.sqrt(g2)) / g3
        swirl = k_swirl / (1 - k_swirl) if abs(1 - k_swirl) > _SMALL else 0.0
        if normal < 0:
            swirl = 0.0
        residual = sine / (1 - a) - normal / tangential * cosine * (1 - k_swirl)
    else:
        a = k / (k - 1) if k > 1 else 0.0
        swirl = k_swirl / (1 - k_swirl) if abs(1 - k_swirl) > _SMALL else 0.0
        residual = sine * (1 - k) - normal / tangential * cosine * (1 - k_swirl)
    return residual, a, swirl


@part
def _root(m, i, low, high, f_low, f_high, pitch, normal, tangential):
    """False position with Anderson and Björck's weights; ends in bisection if it must."""
    for step in range(60):
        middle = high - f_high * (high - low) / (f_high - f_low)
        if step > 25 or not low < middle < high:
            middle = 0.5 * (low + high)
        f_middle = induction(m, i, middle, pitch, normal, tangential)[0]
        if f_middle == 0.0 or high - low < _TOLERANCE:
            return middle
        if f_middle * f_low < 0:
            weight = 1 - f_middle / f_high
            high, f_high = middle, f_middle
            f_low *= weight if weight > 0 else 0.5
        else:
            weight = 1 - f_middle / f_low
            low, f_low = middle, f_middle
            f_high *= weight if weight > 0 else 0.5
        if abs(f_middle) < 1e-9:
            return middle
    return 0.5 * (low + high)


@kernel
def solve(m, i, pitch, normal, tangential, guess):
    """Inflow angle, axial and tangential induction factor of section i.

    `normal`, `tangential`: undisturbed speed of the air across and along the rotor plane, as the
    moving section meets it, m/s. `guess`: inflow angle near by, or 0.
    """
    if abs(normal) < 1e-3 or abs(tangential) < 1e-3:
        return np.arctan2(normal, tangential), 0.0, 0.0
    near = guess > _BRACKET + _SMALL and guess < _HALF_PI - _BRACKET - _SMALL
    for bracket in range(-1 if near else 0, 3):
        if bracket == -1:
            low, high = guess - _BRACKET, guess + _BRACKET
        elif bracket == 0:
            low, high = _SMALL, _HALF_PI - _SMALL
        elif bracket == 1:
            low, high = -0.25 * np.pi, -_SMALL
        else:
            low, high = _HALF_PI + _SMALL, np.pi - _SMALL
        f_low = induction(m, i, low, pitch, normal, tangential)[0]
        f_high = induction(m, i, high, pitch, normal, tangential)[0]
        if f_low * f_high < 0:
            angle = _root(m, i, low, high, f_low, f_high, pitch, normal, tangential)
            _, a, swirl = induction(m, i, angle, pitch, normal, tangential)
            return angle, a, swirl
    return np.arctan2(normal, tangential), 0.0, 0.0


@part
def inflow_lag(m, i, normal, tangential, a, swirl, state, dt, induced):
    """Induction factors that lag behind their quasi-steady values by two time constants.

    Øye's filter, as in Hansen, "Aerodynamics of Wind Turbines" (2008), (9.17) to (9.22). `induced`
    (2, 3) holds the normal and tangential induced speed: quasi-steady of the step before,
    intermediate and lagging; dt = 0 sets them to steady.
    """
    wind = max(state[S_AXIAL], 1.0)
    first = 1.1 / (1 - 1.3 * min(max(a, 0.0), 0.5)) * m.tip_radius / wind
    second = (0.39 - 0.26 * (m.radius[i] / m.tip_radius) ** 2) * first
    fast, slow = (1 - np.exp(-dt / first), 1 - np.exp(-dt / second)) if dt > 0 else (1.0, 1.0)
    for k in range(2):
        steady = a * normal if k == 0 else swirl * tangential
        lag = induced[k]
        if dt > 0:
            drive = steady + 0.6 * first * (steady - lag[0]) / dt
            lag[1] += (drive - lag[1]) * fast
            lag[2] += (lag[1] - lag[2]) * slow
            lag[0] = steady
        else:
            lag[0] = lag[1] = lag[2] = steady
    if abs(normal) > 1e-3:
        a = induced[0, 2] / normal
    if abs(tangential) > 1e-3:
        swirl = induced[1, 2] / tangential
    return a, swirl


@section
def small_turn(angle):
    """Sine and cosine of an angle that is small: within 1e-15 up to half a right angle."""
    z = angle * angle
    sine = 1 - z / 72 * (1 - z / 110 * (1 - z / 156 * (1 - z / 210)))
    sine = angle * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * sine)))
    cosine = 1 - z / 90 * (1 - z / 132 * (1 - z / 182 * (1 - z / 240)))
    return sine, 1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * cosine)))


@section
def flow_at(chord, chord_angle, chord_s, chord_c, turn, w_normal, w_tangential):
    """Flow at a section whose chord lies at an angle (and its sine and cosine): speed, sine and
    cosine of the inflow angle, angle of attack, that at three quarters of the chord.

    `turn`: how fast the section turns about its span, nose up, rad/s.
    """
    speed = np.sqrt(w_normal * w_normal + w_tangential * w_tangential)
    flows = speed > 0.0
    over = 1 / speed if flows else 0.0
    sine, cosine = w_normal * over, w_tangential * over if flows else 1.0
    attack = angle_of(w_normal, w_tangential) - chord_angle
    held = max(speed, SLOW)
    rear = angle_of(
        held * (sine * chord_c - cosine * chord_s) + 0.5 * chord * turn,
        held * (cosine * chord_c + sine * chord_s),
    )
    return speed, sine, cosine, attack, rear


@section
def force_of(density, chord, speed, sine, cosine, lift, drag):
    """Force per length (normal, tangential), N/m, and what a coefficient of 1 gives."""
    pressure = 0.5 * density * chord * (speed * speed)
    across, along = lift * cosine + drag * sine, lift * sine - drag * cosine
    return pressure * across, pressure * along, pressure
