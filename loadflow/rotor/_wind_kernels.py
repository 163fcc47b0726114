"""Compiled wind at points of the rotor: profile, change over time, box of turbulence, tower dam."""

import numpy as np

from ._compile import inner_section, part
from .aero._airfoil_kernels import angle_of


@part
def ring_of(rings, radius):
    """Place of the last but one of the `rings` (n,) that a radius reaches; any n, no search where
    they are equidistant.
    """
    last = rings.size - 2
    i = max(min(int(radius / rings[last + 1] * (last + 1)), last), 0)  # NaN is no place
    while i < last and radius >= rings[i + 1]:
        i += 1
    while i > 0 and radius < rings[i]:
        i -= 1
    return i


@inner_section
def interpolated(box, k, i, j, j_next, late, outer, turn):
    """Value between two planes, rings and angles of a box."""
    rest = 1.0 - turn
    early = (1.0 - outer) * (rest * box[k, i, j] + turn * box[k, i, j_next])
    early += outer * (rest * box[k, i + 1, j] + turn * box[k, i + 1, j_next])
    after = (1.0 - outer) * (rest * box[k + 1, i, j] + turn * box[k + 1, i, j_next])
    after += outer * (rest * box[k + 1, i + 1, j] + turn * box[k + 1, i + 1, j_next])
    return (1.0 - late) * early + late * after


@part
def fluctuation(inflow, position, radius, around):
    """Fluctuation (u, v, w): linear in time, radius and angle.

    `position`, `around`: time and angle in steps of the box; `around` within a turn of 0.
    """
    count, _, angles = inflow.u.shape
    position = min(max(position, 0.0), count - 1.0)
    k = max(min(int(position), count - 2), 0)  # NaN is no place
    late = position - k

    i = ring_of(inflow.box_radius, radius)
    width = inflow.box_radius[i + 1] - inflow.box_radius[i]
    outer = min((radius - inflow.box_radius[i]) / width, 1.0)

    around += angles if around < 0.0 else 0.0
    j = max(min(int(around), angles - 1), 0)
    turn = around - j
    j_next = j + 1 if j + 1 < angles else 0

    u = interpolated(inflow.u, k, i, j, j_next, late, outer, turn)
    v = w = 0.0
    if inflow.v.shape[0] > 0:
        v = interpolated(inflow.v, k, i, j, j_next, late, outer, turn)
    if inflow.w.shape[0] > 0:
        w = interpolated(inflow.w, k, i, j, j_next, late, outer, turn)
    return u, v, w


@inner_section
def box_place(step, spokes, time, y, z):
    """Time in steps of the box, distance from its centre, angle in spokes, within half a turn."""
    return time / step, np.sqrt(y * y + z * z), angle_of(-y, z) * (spokes / (2 * np.pi))


@part
def turbulence(inflow, time, y, z):
    """Fluctuation (u, v, w) at a point of the rotor plane."""
    position, radius, around = box_place(inflow.box_step, inflow.u.shape[2], time, y, z)
    return fluctuation(inflow, position, radius, around)


@inner_section
def height_of(hub_height, z):
    """Height above ground of a point above the hub by z, kept above 1 m."""
    return max(hub_height + z, 1.0)


@inner_section
def dammed(m, wind_x, wind_y, x, y, height):
    """Wind (X, Y) at a point relative to the hub, with the potential flow around the tower."""
    share = height / m.tower_height
    radius = m.tower_base_radius + (m.tower_top_radius - m.tower_base_radius) * share
    along = x - m.tower_distance * np.cos(m.tilt)
    square = along * along + y * y
    inside = radius * radius
    if m.tower_base_radius > 0.0 and height < m.tower_height and square > inside:
        dam = inside / (square * square)
        dam_x, dam_y = dam * (along * along - y * y), dam * 2 * along * y
        wind_x, wind_y = (
            wind_x * (1 - dam_x) - wind_y * dam_y,
            wind_y * (1 + dam_x) - wind_x * dam_y,
        )
    return wind_x, wind_y


@part
def hub_wind(m, inflow, step, time):
    """Wind (X, Y, Z) at the hub in the ground frame, tower dam included."""
    speed = inflow.mean + inflow.rise[step]
    turn_c, turn_s = inflow.heading[step, 0], inflow.heading[step, 1]
    v = w = 0.0
    if inflow.u.shape[0] > 0:
        u, v, w = turbulence(inflow, time, 0.0, 0.0)
        speed += u
    wind_x, wind_y = turn_c * speed - turn_s * v, turn_s * speed + turn_c * v
    wind_x, wind_y = dammed(m, wind_x, wind_y, 0.0, 0.0, height_of(m.hub_height, 0.0))
    return wind_x, wind_y, w
