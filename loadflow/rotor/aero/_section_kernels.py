"""Compiled flow at all sections of the rotor, and the forces it makes.

Loops over the lanes of a pack are free of calls and of tables, so that they become vector
instructions; what looks something up has a loop of its own. See `rotor/lanes.py`.
"""

import numpy as np

from .. import lanes as row
from .._compile import inner_section, part
from .._wind_kernels import box_place, dammed, fluctuation, height_of
from ..lanes import LANES
from ..slots import S_AXIAL, S_Y, S_Z
from ..structure._kernels import carried, place
from ._airfoil_kernels import angle_of, coefficients, polar
from ._kernels import flow_at, force_of, inflow_lag, small_turn, solve


@part
def tabulated_induction(m, i, pitch, normal, tangential, speed, angle):
    """Induction factors from the table over inflow angle and pitch; solved outside of it.

    `speed`, `angle`: size and angle of the flow `normal`, `tangential`.
    """
    if not m.slows[i]:
        return 0.0, 0.0
    p = (angle - m.table_angle[0]) / m.table_angle[1]
    q = (pitch - m.table_pitch[0]) / m.table_pitch[1]
    _, rows, columns, _ = m.table.shape
    if not (0 <= p < rows - 1 and 0 <= q < columns - 1) or speed < 1e-3:
        _, a, swirl = solve(m, i, pitch, normal, tangential, 0.0)
        return a, swirl
    row, column = int(p), int(q)
    p -= row
    q -= column
    t = m.table[i]
    normal_part = (t[row, column, 0] * (1 - q) + t[row, column + 1, 0] * q) * (1 - p) + (
        t[row + 1, column, 0] * (1 - q) + t[row + 1, column + 1, 0] * q
    ) * p
    tangential_part = (t[row, column, 1] * (1 - q) + t[row, column + 1, 1] * q) * (1 - p) + (
        t[row + 1, column, 1] * (1 - q) + t[row + 1, column + 1, 1] * q
    ) * p
    a = normal_part * speed / normal if abs(normal) > 1e-3 else 0.0
    swirl = tangential_part * speed / tangential if abs(tangential) > 1e-3 else 0.0
    return a, swirl


@part
def oblique(skew_factor, tip_radius, state):
    """Angle of the wind to the shaft, and its direction (y, z) across over the tip's radius."""
    across = np.sqrt(state[S_Y] ** 2 + state[S_Z] ** 2)
    if skew_factor == 0 or across < 1e-6 or state[S_AXIAL] < 0.1:
        return 0.0, 0.0, 0.0
    length = across * tip_radius
    return np.arctan2(across, state[S_AXIAL]), state[S_Y] / length, state[S_Z] / length


@inner_section
def skewed(skew_factor, a, r_y, r_z, angle, along_y, along_z):
    """Induction factor redistributed over the disc under oblique inflow (Pitt and Peters)."""
    sine, cosine = small_turn(0.5 * min((0.6 * a + 1) * angle, 1.5))
    lean = skew_factor * (r_y * along_y + r_z * along_z)
    return a * (1 + lean * sine / cosine) if a > 0.0 else a


@part
def momentum_share(tip_radius, speed, state):
    """Share of the induction that momentum theory gives: none up to a tip speed ratio of 1, where
    a rotor at standstill or idling has no helical wake, all of it from 2 on.
    """
    wind = np.sqrt(state[S_AXIAL] ** 2 + state[S_Y] ** 2 + state[S_Z] ** 2)
    excess = abs(speed) * tip_radius - wind
    if excess >= wind:
        return 1.0
    return 0.5 * (1 - np.cos(np.pi * excess / wind)) if excess > 0 else 0.0


@part
def locate(pack, cone_s, cone_c, tilt_s, tilt_c, turn_c, turn_s, time, mean, box_step, spokes):
    """Where the sections are, also in the box of turbulence."""
    for k in range(LANES):
        radius = pack[row.RADIUS + k] - pack[row.PULL + k]
        along, out, turn = place(radius, pack[row.BENT + k], pack[row.SWEPT + k], cone_s, cone_c)
        sine, cosine = pack[row.AZIMUTH_S + k], pack[row.AZIMUTH_C + k]
        y, z = -sine * out - cosine * turn, cosine * out - sine * turn
        ground_x, ground_z = along * tilt_c + z * tilt_s, z * tilt_c - along * tilt_s
        pack[row.ALONG + k], pack[row.OUT + k], pack[row.AROUND + k] = along, out, turn
        pack[row.Y + k], pack[row.Z + k] = y, z
        pack[row.GROUND_X + k], pack[row.GROUND_Z + k] = ground_x, ground_z
        downwind, across = turn_c * ground_x + turn_s * y, turn_c * y - turn_s * ground_x
        when = time - downwind / mean
        pack[row.WHEN + k], pack[row.RING + k], pack[row.SPOKE + k] = box_place(
            box_step, spokes, when, across, ground_z
        )


@part
def look_up_wind(pack, m, inflow):
    """Wind of the profile, and the fluctuation out of the box."""
    gusty = inflow.u.shape[0] > 0
    for k in range(LANES):
        height = height_of(m.hub_height, pack[row.GROUND_Z + k])
        pack[row.PROFILE + k] = inflow.mean * (height / m.hub_height) ** inflow.shear
        if gusty:
            pack[row.GUST_U + k], pack[row.GUST_V + k], pack[row.GUST_W + k] = fluctuation(
                inflow, pack[row.WHEN + k], pack[row.RING + k], pack[row.SPOKE + k]
            )


@part
def meet_wind(pack, m, tilt_s, tilt_c, turn_c, turn_s, rise, vertical, horizontal, drift, speed):
    """Flow across and along the plane as the moving sections meet it; returns its mean (x, y, z).

    `drift` (6 numbers): see `nacelle_motion`.
    """
    mean_x = mean_y = mean_z = 0.0
    for k in range(LANES):
        ground_x, y, ground_z = pack[row.GROUND_X + k], pack[row.Y + k], pack[row.GROUND_Z + k]
        across = turn_c * y - turn_s * ground_x
        blows = pack[row.PROFILE + k] + rise + vertical * ground_z + horizontal * across
        blows += pack[row.GUST_U + k]
        v = pack[row.GUST_V + k]
        wind_x, wind_y = turn_c * blows - turn_s * v, turn_s * blows + turn_c * v
        height = height_of(m.hub_height, ground_z)
        wind_x, wind_y = dammed(m, wind_x, wind_y, ground_x, y, height)
        wind_z = pack[row.GUST_W + k]
        # relative to the moving nacelle
        moved = carried(drift, pack[row.ALONG + k], y, pack[row.Z + k])
        shaft_x = wind_x * tilt_c - wind_z * tilt_s - moved[0]
        shaft_z = wind_x * tilt_s + wind_z * tilt_c - moved[2]
        wind_y -= moved[1]
        sine, cosine = pack[row.AZIMUTH_S + k], pack[row.AZIMUTH_C + k]
        # a section bent out of the radius has a speed along it
        radial = -sine * wind_y + cosine * shaft_z + speed * pack[row.AROUND + k]
        # cone, and slope of the bent blade
        bend_s, bend_c = small_turn(m.cone - pack[row.SLOPE + k])
        normal = shaft_x * bend_c + radial * bend_s - pack[row.BENT_RATE + k]
        tangential = speed * pack[row.OUT + k] + pack[row.SWEPT_RATE + k]
        tangential += cosine * wind_y + sine * shaft_z
        pack[row.BEND_S + k], pack[row.BEND_C + k] = bend_s, bend_c
        pack[row.ACROSS + k], pack[row.ALONG_PLANE + k] = normal, tangential
        pack[row.SIZE + k] = np.sqrt(normal * normal + tangential * tangential)
        pack[row.ANGLE + k] = angle_of(normal, tangential)
        mean_x += pack[row.WEIGHT + k] * shaft_x
        mean_y += pack[row.WEIGHT + k] * wind_y
        mean_z += pack[row.WEIGHT + k] * shaft_z
    return mean_x, mean_y, mean_z


@part
def induce(pack, m, blade, section, momentum, state, guess, induced, dt):
    """Induction factors of momentum theory, lagging where they do."""
    for k in range(LANES):
        b, i = blade[k], section[k]
        normal, tangential = pack[row.ACROSS + k], pack[row.ALONG_PLANE + k]
        # torsion turns the section in the flow; bending both ways only turns the axes in which its
        # airfoil is looked up, which does not enter the momentum balance
        twisted = pack[row.PITCH + k] + pack[row.TWISTED + k]
        if momentum == 0.0:
            a = swirl = 0.0
        elif m.table.shape[0] > 0:
            a, swirl = tabulated_induction(
                m, i, twisted, normal, tangential, pack[row.SIZE + k], pack[row.ANGLE + k]
            )
        else:
            angle, a, swirl = solve(m, i, twisted, normal, tangential, guess[b, i])
            guess[b, i] = angle
        if momentum < 1.0:
            a, swirl = a * momentum, swirl * momentum
        if m.dynamic_inflow and pack[row.WEIGHT + k] > 0.0:
            a, swirl = inflow_lag(m, i, normal, tangential, a, swirl, state, dt, induced[b, i])
        pack[row.INDUCTION + k], pack[row.SWIRL + k] = a, swirl


@part
def meet_section(pack, skew_factor, skew, skew_y, skew_z, speed):
    """Flow at the sections, induction included, in axes of their chords."""
    for k in range(LANES):
        a = pack[row.INDUCTION + k]
        if skew != 0.0:
            a = skewed(skew_factor, a, pack[row.Y + k], pack[row.Z + k], skew, skew_y, skew_z)
        pitch_s, pitch_c = pack[row.PITCH_S + k], pack[row.PITCH_C + k]
        twist_s, twist_c = pack[row.TWIST_S + k], pack[row.TWIST_C + k]
        elastic = pack[row.TWISTED + k] + pack[row.TURNED + k]
        turn_s, turn_c = small_turn(elastic)
        sine = twist_s * pitch_c + twist_c * pitch_s
        cosine = twist_c * pitch_c - twist_s * pitch_s
        # rotation of the rotor turns an inclined section about its span
        spin = -speed * pack[row.BEND_S + k]
        pack[row.SPIN + k] = spin
        (
            pack[row.SPEED + k],
            pack[row.SINE + k],
            pack[row.COSINE + k],
            pack[row.ATTACK + k],
            pack[row.REAR + k],
        ) = flow_at(
            pack[row.CHORD + k],
            pack[row.TWIST + k] + pack[row.PITCH + k] + elastic,
            sine * turn_c + cosine * turn_s,
            cosine * turn_c - sine * turn_s,
            spin,
            pack[row.ACROSS + k] * (1 - a),
            pack[row.ALONG_PLANE + k] * (1 + pack[row.SWIRL + k]),
        )


@part
def look_up_airfoils(pack, m, blade, section, dt, wake):
    """Lift, drag, and moment of blades that twist, out of the polars; `wake` moves on by `dt`."""
    twists = m.torsion_compliance.size > 0
    for k in range(LANES):
        if pack[row.WEIGHT + k] == 0.0:
            continue
        b, i = blade[k], section[k]
        pack[row.LIFT + k], pack[row.DRAG + k] = coefficients(
            m,
            i,
            pack[row.ATTACK + k],
            pack[row.REAR + k],
            pack[row.SPEED + k],
            pack[row.SPIN + k],
            dt,
            wake[b, i],
        )
        if twists:
            pack[row.MOMENT + k] = polar(m.moment, i, pack[row.ATTACK + k])


@part
def load(pack, density):
    """Force on each section in the axes of its blade, N: downwind, outward, in rotation."""
    for k in range(LANES):
        across, along, pressure = force_of(
            density,
            pack[row.CHORD + k],
            pack[row.SPEED + k],
            pack[row.SINE + k],
            pack[row.COSINE + k],
            pack[row.LIFT + k],
            pack[row.DRAG + k],
        )
        width = pack[row.WIDTH + k]
        pack[row.FORCE + k] = across * pack[row.BEND_C + k] * width
        pack[row.FORCE + LANES + k] = across * pack[row.BEND_S + k] * width
        pack[row.FORCE + 2 * LANES + k] = along * width
        pack[row.FORCE + 3 * LANES + k] = pressure * width


@part
def hand_over(pack, m, blade, section, force):
    """Write the forces to their sections, and the couple of blades that twist, nose-up."""
    twists = m.torsion_compliance.size > 0
    for k in range(LANES):
        if pack[row.WEIGHT + k] == 0.0:
            continue
        b, i = blade[k], section[k]
        for axis in range(3):
            force[b, i, axis] = pack[row.FORCE + axis * LANES + k]
        force[b, i, 3] = 0.0
        if twists:
            chord = pack[row.TWIST + k] + pack[row.PITCH + k]
            chord += pack[row.TWISTED + k] + pack[row.TURNED + k]
            sine, cosine = pack[row.SINE + k], pack[row.COSINE + k]
            lift, drag = pack[row.LIFT + k], pack[row.DRAG + k]
            lever = m.centre_ahead[i] * (
                (lift * cosine + drag * sine) * np.cos(chord)
                + (lift * sine - drag * cosine) * np.sin(chord)
            )
            force[b, i, 3] = pack[row.FORCE + 3 * LANES + k] * (
                lever + m.chord[i] * pack[row.MOMENT + k]
            )


@part
def take_over(pack, blade, section, sines, cosines, pitches, pitch_s, pitch_c, motion):
    """Read what the blades do, and the motion of each section."""
    for k in range(LANES):
        b, i = blade[k], section[k]
        pack[row.AZIMUTH_S + k], pack[row.AZIMUTH_C + k] = sines[b], cosines[b]
        pack[row.PITCH_S + k], pack[row.PITCH_C + k] = pitch_s[b], pitch_c[b]
        pack[row.PITCH + k] = pitches[b]
        for column in range(8):
            pack[row.BENT + column * LANES + k] = motion[b, i, column]


@inner_section
def aerodynamics(
    m, inflow, step, time, azimuth, pitch, speed, tilt, drift, motion, state, guess, wake, induced,
    dt, room, force,
):  # fmt: skip
    """Aerodynamic force (x, r, t) on each section of all blades, N, and nose-up couple, N m.

    `azimuth` (of blade 1), `pitch` (blades,); `tilt` and `drift` (6,): see `nacelle_motion`;
    `motion` (blades, n, 8): see `deflection`; `guess` (blades, n): inflow angles of the step
    before, replaced; `wake` (blades, n, SECTION_STATES): see `coefficients`; `induced`
    (blades, n, 2, 3): see `inflow_lag`; `room` is a `Room`. Returns the mean wind over the
    sections (x, y, z).
    """
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    tilt_s, tilt_c = np.sin(tilt), np.cos(tilt)
    for b in range(m.blades):
        around = azimuth + 2 * np.pi * b / m.blades
        room.turned[0, b], room.turned[1, b] = np.sin(around), np.cos(around)
        room.turned[2, b], room.turned[3, b] = np.sin(pitch[b]), np.cos(pitch[b])
    turn_c, turn_s = inflow.heading[step, 0], inflow.heading[step, 1]
    mean = max(inflow.mean, 1.0)
    moved = (drift[0], drift[1], drift[2], drift[3], drift[4], drift[5])
    rise, vertical, horizontal = inflow.rise[step], inflow.vertical[step], inflow.horizontal[step]
    momentum = momentum_share(m.tip_radius, speed, state)
    skew, skew_y, skew_z = oblique(m.skew_factor, m.tip_radius, state)
    spokes = inflow.u.shape[2]
    mean_x = mean_y = mean_z = 0.0
    for c in range(room.packs.shape[0]):
        pack = room.packs[c]
        blade, section = room.blade[c * LANES :], room.section[c * LANES :]
        take_over(
            pack, blade, section, room.turned[0], room.turned[1], pitch, room.turned[2],
            room.turned[3], motion,
        )  # fmt: skip
        locate(
            pack, cone_s, cone_c, tilt_s, tilt_c, turn_c, turn_s, time, mean, inflow.box_step,
            spokes,
        )  # fmt: skip
        look_up_wind(pack, m, inflow)
        wind = meet_wind(
            pack, m, tilt_s, tilt_c, turn_c, turn_s, rise, vertical, horizontal, moved, speed
        )
        induce(pack, m, blade, section, momentum, state, guess, induced, dt)
        meet_section(pack, m.skew_factor, skew, skew_y, skew_z, speed)
        look_up_airfoils(pack, m, blade, section, dt, wake)
        load(pack, m.air_density)
        hand_over(pack, m, blade, section, force)
        mean_x, mean_y, mean_z = mean_x + wind[0], mean_y + wind[1], mean_z + wind[2]
    return mean_x, mean_y, mean_z
