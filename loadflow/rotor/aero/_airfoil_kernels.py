"""Compiled airfoil in flow that changes: Hansen, Gaunaa and Madsen's model in state space.

"A Beddoes-Leishman type dynamic stall model in state-space and indicial formulations", Risø-R-1354
(2004), as OpenFAST has it (UA_Mod 4). Incompressible; a section that turns about its span meets the
flow at three quarters of its chord.
"""

import numpy as np

from .._compile import section

SECTION_STATES = 5
"""Numbers that a section carries along: two parts of the angle of attack that the shed wake lets
through, the angle at three quarters of the chord, the lift of potential flow as the pressure
follows it, and how far the flow is attached.
"""

_WAKE = ((0.3, 0.14), (0.7, 0.53))  # share and decay of the shed wake
_PRESSURE, _BOUNDARY_LAYER = 1.7, 3.0  # lags of stall, in half chords travelled
_SLOW = 0.1  # m/s
_ATTACHED, _FADE = np.radians(45.0), np.radians(5.0)  # beyond, the polars hold at once


@section
def polar(table, i, angle):
    """Linear interpolation in row i of a table over −π … π in equal steps."""
    count = table.shape[1] - 1
    wrapped = (angle + np.pi) % (2 * np.pi)
    position = wrapped * (count / (2 * np.pi))
    j = max(min(int(position), count - 1), 0)  # NaN is no place
    share = position - j
    return table[i, j] * (1 - share) + table[i, j + 1] * share


@section
def coefficients(m, i, attack, speed, turn, dt, states):
    """Lift and drag coefficient of section i in a flow of angle `attack` and `speed`, m/s.

    `turn`: how fast the section turns about its span, nose up, rad/s. `states` (SECTION_STATES,)
    are moved on by `dt`; dt = 0 sets them to steady. Lift lags behind the angle of attack (shed
    wake), separation behind lift (dynamic stall).
    """
    slope, zero = m.lift_slope[i], m.zero_lift[i]
    held = min(max((_ATTACHED - abs(attack)) / _FADE, 0.0), 1.0)
    if slope == 0.0 or not (m.shed_wake or m.dynamic_stall):
        held = 0.0
    speed = max(speed, _SLOW)
    passing = 0.5 * m.chord[i] / speed
    rear = np.arctan2(speed * np.sin(attack) + 0.5 * m.chord[i] * turn, speed * np.cos(attack))
    if dt <= 0 or held == 0.0:
        for k, (share, _) in enumerate(_WAKE):
            states[k] = share * rear
        states[3] = slope * (rear - zero)
        states[4] = polar(m.attached, i, rear)
    steady_lift, steady_drag = polar(m.lift, i, attack), polar(m.drag, i, attack)
    if held == 0.0:
        states[2] = rear
        return steady_lift, steady_drag
    effective = rear
    if m.shed_wake:
        effective = 0.0
        for k, (share, decay) in enumerate(_WAKE):
            if dt > 0:
                keep = np.exp(-decay * dt / passing)
                states[k] = states[k] * keep + share * 0.5 * (rear + states[2]) * (1 - keep)
            effective += states[k]
    states[2] = rear
    potential, added = slope * (effective - zero), np.pi * passing * turn
    attached = settled = polar(m.attached, i, effective)
    drag = polar(m.drag, i, effective)
    if m.dynamic_stall:
        if dt > 0:
            keep = np.exp(-dt / (_PRESSURE * passing))
            states[3] = states[3] * keep + (potential + added) * (1 - keep)
            keep = np.exp(-dt / (_BOUNDARY_LAYER * passing))
            follows = polar(m.attached, i, states[3] / slope + zero)
            states[4] = states[4] * keep + follows * (1 - keep)
        attached = states[4]
        late = 0.5 * (np.sqrt(settled) - np.sqrt(attached)) - 0.25 * (settled - attached)
        drag += (drag - m.friction[i]) * late
    lift = attached * potential + (1 - attached) * polar(m.separated, i, effective)
    drag += (rear - effective + passing * turn) * lift
    lift += added
    return held * lift + (1 - held) * steady_lift, held * drag + (1 - held) * steady_drag
