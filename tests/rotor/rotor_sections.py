"""One section in a flow by itself, as the loop over all of them has it."""

import numpy as np

from loadflow.rotor.aero._airfoil_kernels import coefficients
from loadflow.rotor.aero._kernels import flow_at, force_of


def section_coefficients(m, i, attack, speed, turn, dt, states):
    """Lift and drag coefficient of a section that turns about its span."""
    up = speed * np.sin(attack) + 0.5 * m.chord[i] * turn
    rear = np.arctan2(up, speed * np.cos(attack))
    return coefficients(m, i, attack, rear, speed, turn, dt, states)


def section_force(m, i, pitch, normal, tangential, a, swirl, dt, states):
    """Force per length across and along the rotor plane, of a section that does not turn."""
    angle = m.twist[i] + pitch
    flow = (normal * (1 - a), tangential * (1 + swirl))
    speed, sine, cosine, attack, rear = flow_at(
        m.chord[i], angle, np.sin(angle), np.cos(angle), 0.0, *flow
    )
    found = coefficients(m, i, attack, rear, speed, 0.0, dt, states)
    return force_of(m.air_density, m.chord[i], speed, sine, cosine, *found)[:2]
