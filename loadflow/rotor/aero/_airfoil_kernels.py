"""Compiled airfoil in attached flow that changes: Beddoes and Leishman's model.

Leishman, Beddoes, "A semi-empirical model for dynamic stall", Journal of the American Helicopter
Society 34 (1989), in the form of Damiani and Hayman, "The unsteady aerodynamics module for FAST 8",
NREL/TP-5000-66347 (2019); equation numbers are of the latter. Separation lags as a switch.
"""

import numpy as np

from .._compile import kernel, section

SECTION_STATES = 4
"""Numbers that a section carries along: two deficiencies of the angle of attack, the angle, and how
far the flow is attached.
"""

_SHED = ((0.3, 0.14), (0.7, 0.53))  # share and decay of the shed wake
_SOUND = 340.0  # m/s
_ATTACHED, _FADE = np.radians(45.0), np.radians(5.0)  # beyond, the flow is that of the polar


@section
def polar(table, i, angle):
    """Linear interpolation in row i of a table over −π … π in equal steps."""
    count = table.shape[1] - 1
    wrapped = (angle + np.pi) % (2 * np.pi)
    position = wrapped * (count / (2 * np.pi))
    j = max(min(int(position), count - 1), 0)  # NaN is no place
    share = position - j
    return table[i, j] * (1 - share) + table[i, j + 1] * share


@kernel
def late_separation(m, i, attack, speed, dt, states):
    """Lift coefficient that comes on top because separation lags behind the angle of attack.

    Øye's filter with the time 4 chords take to pass, as in Hansen, "Aerodynamics of Wind Turbines"
    (2008), (9.23) to (9.26). `states[3]` holds how far the flow is attached; dt = 0 sets it to
    steady, where nothing comes on top.
    """
    steady = polar(m.attached, i, attack)
    keep = np.exp(-dt * speed / (4 * m.chord[i])) if dt > 0 else 0.0
    states[3] = steady + (states[3] - steady) * keep
    return (states[3] - steady) * polar(m.separation_gain, i, attack)


@section
def coefficients(m, i, attack, speed, dt, states):
    """Lift and drag coefficient of section i in a flow of angle `attack` and `speed`, m/s.

    `states` (SECTION_STATES,) are moved on by `dt`; dt = 0 sets them to steady. The lift lags
    behind the angle of attack (shed wake, (1.13) to (1.15)) and leads by the inertia of the air
    ((1.18), of which the decay within some 10 ms is left out). In attached flow the force along the
    chord is at most the suction of potential flow (1.21), so the drag falls hardly below that at
    zero lift.
    """
    if not m.shed_wake:
        lift = polar(m.lift, i, attack)
        if m.dynamic_stall:
            lift += late_separation(m, i, attack, speed, dt, states)
        return lift, polar(m.drag, i, attack)
    mach = min(speed / _SOUND, 0.9)
    square = 1 - mach * mach
    chord, slope = m.chord[i], m.lift_slope[i]
    late = inertia = 0.0
    if dt > 0:
        change = (attack - states[2] + np.pi) % (2 * np.pi) - np.pi
        fading = 0.0
        for k, (share, decay) in enumerate(_SHED):
            keep = np.exp(-2 * decay * square * speed * dt / chord)
            states[k] = states[k] * keep + share * change * np.sqrt(keep)
            late += states[k]
            fading += share * decay
        stiffening = 1 - mach + 0.5 * slope * mach * mach * np.sqrt(square) * fading
        inertia = 3 * chord * change / (dt * max(speed, 0.1) * stiffening)
    else:
        states[0] = states[1] = 0.0
    states[2] = attack
    delayed = attack - late
    lift, drag = polar(m.lift, i, delayed), polar(m.drag, i, delayed)
    if m.dynamic_stall:
        lift += late_separation(m, i, delayed, speed, dt, states)
    if slope == 0.0:
        return lift, drag
    attached = min(max((_ATTACHED - abs(attack)) / _FADE, 0.0), 1.0)
    sine, cosine = np.sin(delayed), np.cos(delayed)
    pressure_drag = drag - m.friction[i]
    normal = lift * cosine + pressure_drag * sine + attached * inertia
    along = lift * sine - pressure_drag * cosine
    suction = slope / np.sqrt(square) * (delayed - m.zero_lift[i]) * sine / cosine
    along -= attached * max(along - suction, 0.0)
    sine, cosine = np.sin(attack), np.cos(attack)
    return normal * cosine + along * sine, m.friction[i] + normal * sine - along * cosine
