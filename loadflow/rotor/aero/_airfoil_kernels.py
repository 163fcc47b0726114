"""Compiled airfoil in flow that changes: Hansen, Gaunaa and Madsen's model in state space.

"A Beddoes-Leishman type dynamic stall model in state-space and indicial formulations", Risø-R-1354
(2004), as OpenFAST has it (UA_Mod 4). Incompressible; a section that turns about its span meets the
flow at three quarters of its chord.
"""

import numpy as np

from .._compile import inner_section, part, section

SECTION_STATES = 5
"""Numbers that a section carries along: two parts of the angle of attack that the shed wake lets
through, the angle at three quarters of the chord, the lift of potential flow as the pressure
follows it, and how far the flow is attached.
"""

_WAKE = ((0.3, 0.14), (0.7, 0.53))  # share and decay of the shed wake
_PRESSURE, _BOUNDARY_LAYER = 1.7, 3.0  # lags of stall, in half chords travelled
SLOW = 0.1
"""Speed below which a flow counts as of that speed, m/s."""
_ATTACHED, _FADE = np.radians(45.0), np.radians(5.0)  # beyond, the polars hold at once


_EIGHTH = np.tan(np.pi / 8)
# even polynomial of arctan(t) / t at Chebyshev's points of t² in 0 … tan²(π/8): within 3e-13
_ARC = (
    0.9999999999992442, -0.3333333327689704, 0.19999993051701115, -0.14285386500200875,
    0.11103456152474031, -0.08992547323314694, 0.06974176983003243, -0.03765480113107236,
)  # fmt: skip


@inner_section
def angle_of(up, along):
    """Angle of a direction, −π … π: np.arctan2 within 1e-12, without a call."""
    high, wide = abs(up), abs(along)
    low, far = min(high, wide), max(high, wide)
    if far == 0.0:
        return 0.0
    if low > _EIGHTH * far:
        t, start = (low - far) / (low + far), 0.25 * np.pi
    else:
        t, start = low / far, 0.0
    z = t * t
    even = z * z
    series = (_ARC[0] + _ARC[1] * z) + even * (_ARC[2] + _ARC[3] * z)
    series += even * even * ((_ARC[4] + _ARC[5] * z) + even * (_ARC[6] + _ARC[7] * z))
    angle = start + t * series
    if high > wide:
        angle = 0.5 * np.pi - angle
    if along < 0.0:
        angle = np.pi - angle
    return -angle if up < 0.0 else angle


@section
def place_of(table, angle):
    """Where an angle is in a table over −π … π in equal steps: column, and share of the next."""
    count = table.shape[1] - 1
    wrapped = angle + np.pi
    if not 0.0 <= wrapped < 2 * np.pi:
        wrapped %= 2 * np.pi
    position = wrapped * (count / (2 * np.pi))
    j = max(min(int(position), count - 1), 0)  # NaN is no place
    return j, position - j


@section
def polar(table, i, angle):
    """Linear interpolation in row i of a table over −π … π in equal steps."""
    j, share = place_of(table, angle)
    return table[i, j] * (1 - share) + table[i, j + 1] * share


@part
def coefficients(m, i, attack, rear, speed, turn, dt, states):
    """Lift and drag coefficient of section i in a flow of angle `attack` and `speed`, m/s.

    `rear`: angle of the flow at three quarters of the chord; `turn`: how fast the section turns
    about its span, nose up, rad/s. `states` (SECTION_STATES,) are moved on by `dt`; dt = 0 sets
    them to steady. Lift lags behind the angle of attack (shed wake), separation behind lift
    (dynamic stall).
    """
    slope, zero = m.lift_slope[i], m.zero_lift[i]
    held = min(max((_ATTACHED - abs(attack)) / _FADE, 0.0), 1.0)
    if slope == 0.0 or not (m.shed_wake or m.dynamic_stall):
        held = 0.0
    speed = max(speed, SLOW)
    passing = 0.5 * m.chord[i] / speed
    if dt <= 0 or held == 0.0:
        for k, (share, _) in enumerate(_WAKE):
            states[k] = share * rear
        states[3] = slope * (rear - zero)
        states[4] = polar(m.attached, i, rear)
    steady_lift = steady_drag = 0.0
    if held < 1.0:
        j, share = place_of(m.lift, attack)
        steady_lift = m.lift[i, j] * (1 - share) + m.lift[i, j + 1] * share
        steady_drag = m.drag[i, j] * (1 - share) + m.drag[i, j + 1] * share
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
    j, share = place_of(m.drag, effective)
    attached = settled = m.attached[i, j] * (1 - share) + m.attached[i, j + 1] * share
    drag = m.drag[i, j] * (1 - share) + m.drag[i, j + 1] * share
    parted = m.separated[i, j] * (1 - share) + m.separated[i, j + 1] * share
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
    lift = attached * potential + (1 - attached) * parted
    drag += (rear - effective + passing * turn) * lift
    lift += added
    return held * lift + (1 - held) * steady_lift, held * drag + (1 - held) * steady_drag
