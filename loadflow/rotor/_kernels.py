"""Compiled time loop of the rotor: wind at each section, blade loads, modes, speed and control.

Shaft frame: x along the shaft (downwind), z up, y left looking downwind; outward along a blade is
e_r = −sin ψ y + cos ψ z, in the sense of rotation e_t = −cos ψ y − sin ψ z.
"""

import numpy as np

from ._compile import inner_once, inner_section, kernel, part
from .aero._airfoil_kernels import angle_of
from .aero._kernels import inflow_lag, section_force, solve
from .control._kernels import brake, control
from .slots import (
    AZIMUTH,
    COLUMNS,
    FORE_AFT,
    FX,
    GENERATOR,
    MX,
    PITCH,
    ROOT,
    S_AXIAL,
    S_AZIMUTH,
    S_RATE,
    S_SPEED,
    S_STATE,
    S_TORQUE,
    S_Y,
    S_Z,
    SIDE_SIDE,
    SPEED,
    STATE,
    TIP,
    TORQUE,
    WIND_X,
    WIND_Y,
    WIND_Z,
)  # fmt: skip
from .structure._kernels import (
    blade_equations,
    blade_root,
    carried,
    deflection,
    frame_acceleration,
    nacelle_motion,
    place,
    predicted,
    step_on,
    torsion,
    turned_shapes,
)


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
def turbulence(inflow, time, y, z):
    """Fluctuation (u, v, w) at a point of the rotor plane: linear in time, radius and angle."""
    count, _, angles = inflow.u.shape
    position = min(max(time / inflow.box_step, 0.0), count - 1.0)
    k = max(min(int(position), count - 2), 0)  # NaN is no place
    late = position - k

    radius = np.sqrt(y * y + z * z)
    i = ring_of(inflow.box_radius, radius)
    width = inflow.box_radius[i + 1] - inflow.box_radius[i]
    outer = min((radius - inflow.box_radius[i]) / width, 1.0)

    around = angle_of(-y, z) * (angles / (2 * np.pi))
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
def wind_at(m, inflow, step, time, x, y, z):
    """Wind (X, Y, Z) in the ground frame, tower dam included, at a point relative to the hub."""
    height = max(m.hub_height + z, 1.0)
    speed = inflow.mean * (height / m.hub_height) ** inflow.shear + inflow.rise[step]
    turn_c, turn_s = inflow.heading[step, 0], inflow.heading[step, 1]
    along, across = turn_c * x + turn_s * y, turn_c * y - turn_s * x
    speed += inflow.vertical[step] * z + inflow.horizontal[step] * across
    v = wind_z = 0.0
    if inflow.u.shape[0] > 0:
        u, v, wind_z = turbulence(inflow, time - along / max(inflow.mean, 1.0), across, z)
        speed += u
    wind_x, wind_y = turn_c * speed - turn_s * v, turn_s * speed + turn_c * v
    if m.tower_base_radius > 0 and height < m.tower_height:
        share = height / m.tower_height
        radius = m.tower_base_radius + (m.tower_top_radius - m.tower_base_radius) * share
        along = x - m.tower_distance * np.cos(m.tilt)
        square = along * along + y * y
        if square > radius * radius:
            dam = radius * radius / (square * square)
            dam_x, dam_y = dam * (along * along - y * y), dam * 2 * along * y
            wind_x, wind_y = (
                wind_x * (1 - dam_x) - wind_y * dam_y,
                wind_y * (1 + dam_x) - wind_x * dam_y,
            )
    return wind_x, wind_y, wind_z


@part
def tabulated_induction(m, i, pitch, normal, tangential):
    """Induction factors from the table over inflow angle and pitch; solved outside of it."""
    if not m.slows[i]:
        return 0.0, 0.0
    speed = np.sqrt(normal * normal + tangential * tangential)
    angle = angle_of(normal, tangential)
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


@part
def skewed(skew_factor, a, r_y, r_z, angle, along_y, along_z):
    """Induction factor redistributed over the disc under oblique inflow (Pitt and Peters)."""
    if angle == 0.0 or a <= 0:
        return a
    turn = np.tan(0.5 * min((0.6 * a + 1) * angle, 1.5))
    return a * (1 + skew_factor * turn * (r_y * along_y + r_z * along_z))


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


@inner_once
def blade_aerodynamics(
    m, inflow, step, time, azimuth, pitch, speed, tilt, drift, motion, state, guess, wake, induced,
    dt, force,
):  # fmt: skip
    """Aerodynamic force (x, r, t) on each section of one blade, N, and nose-up couple, N m.

    `tilt` and `drift` (6,): see `nacelle_motion`; `motion` (n, 8): see `deflection`; `guess` (n,):
    inflow angles of the step before, replaced; `wake` (n, SECTION_STATES): see `coefficients`;
    `induced` (n, 2, 3): see `inflow_lag`. Returns the mean wind over the sections (x, y, z).
    """
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    tilt_s, tilt_c = np.sin(tilt), np.cos(tilt)
    count = m.radius.size
    momentum = momentum_share(m.tip_radius, speed, state)
    skew, skew_y, skew_z = oblique(m.skew_factor, m.tip_radius, state)
    mean_x = mean_y = mean_z = 0.0
    for i in range(count):
        along, out, turn = place(m.radius, i, motion, cone_s, cone_c)
        y, z = -sine * out - cosine * turn, cosine * out - sine * turn
        ground_x, ground_z = along * tilt_c + z * tilt_s, z * tilt_c - along * tilt_s
        wind_x, wind_y, wind_z = wind_at(m, inflow, step, time, ground_x, y, ground_z)
        shaft_x = wind_x * tilt_c - wind_z * tilt_s
        shaft_z = wind_x * tilt_s + wind_z * tilt_c
        # relative to the moving nacelle
        moved = carried(drift, along, y, z)
        shaft_x -= moved[0]
        wind_y -= moved[1]
        shaft_z -= moved[2]
        # a section bent out of the radius has a speed along it
        radial = -sine * wind_y + cosine * shaft_z + speed * turn
        # cone, and slope of the bent blade
        bend = m.cone - motion[i, 4]
        bend_s, bend_c = np.sin(bend), np.cos(bend)
        normal = shaft_x * bend_c + radial * bend_s - motion[i, 2]
        tangential = speed * out + motion[i, 3] + cosine * wind_y + sine * shaft_z
        # torsion turns the section in the flow; bending both ways only turns the axes in which its
        # airfoil is looked up, which does not enter the momentum balance
        twisted = pitch + motion[i, 7]
        if momentum == 0.0:
            a = swirl = 0.0
        elif m.table.shape[0] > 0:
            a, swirl = tabulated_induction(m, i, twisted, normal, tangential)
        else:
            angle, a, swirl = solve(m, i, twisted, normal, tangential, guess[i])
            guess[i] = angle
        if momentum < 1.0:
            a, swirl = a * momentum, swirl * momentum
        if m.dynamic_inflow:
            a, swirl = inflow_lag(m, i, normal, tangential, a, swirl, state, dt, induced[i])
        a = skewed(m.skew_factor, a, y, z, skew, skew_y, skew_z)
        # rotation of the rotor turns an inclined section about its span
        f_normal, f_tangential, couple = section_force(
            m, i, twisted + motion[i, 6], -speed * bend_s, normal, tangential, a, swirl, dt, wake[i]
        )
        force[i, 0] = f_normal * bend_c * m.width[i]
        force[i, 1] = f_normal * bend_s * m.width[i]
        force[i, 2] = f_tangential * m.width[i]
        force[i, 3] = couple * m.width[i]
        mean_x += shaft_x / count
        mean_y += wind_y / count
        mean_z += shaft_z / count
    return mean_x, mean_y, mean_z


@kernel
def march(
    m, c, schedule, inflow, dt, steps, start, fresh, controlled, state, blade_pitch, q, v, acc,
    h, h_rate, h_acc, guess, wake, induced, torsions, out,
):  # fmt: skip
    """March the rotor; `state` (SLOTS,), `blade_pitch` (blades,), `q`, `v`, `acc` (blades, k), `h`,
    `h_rate`, `h_acc` (h,; place 0, the generator, is in `state`), `guess`, `wake`, `induced`,
    `torsions` (blades, n; without sections if no blade twists) go on.

    `fresh`: wake and induced speed are steady at first. Not `controlled`: speed and pitch stay.
    `out` (steps, COLUMNS + blades) is filled.
    """
    sections, modes, count, twist = m.radius.size, q.shape[1], h.size, m.frame.twist
    shape = np.zeros((m.blades, sections, modes, 4))
    motion = np.zeros((sections, 8))
    force = np.zeros((m.blades, sections, 4))
    twists = torsions.shape[1] > 0
    answer = np.zeros((m.blades, modes, 1 + count))
    q_ahead, v_ahead, bend = np.empty(modes), np.empty(modes), np.empty(modes)
    ahead, rate_ahead, new = np.empty(count), np.empty(count), np.empty(count)
    inertia, load = np.zeros((count, count)), np.zeros(count)
    drift, gravity, jerk = np.zeros(6), np.zeros(3), np.zeros(6)
    total, own = np.zeros(6), np.zeros(6)
    for step in range(steps):
        time = start + step * dt
        since = 0.0 if fresh and step == 0 else dt
        predicted(dt, h, h_rate, h_acc, ahead, rate_ahead)
        tilt = nacelle_motion(m.frame, m.tilt, ahead, rate_ahead, drift, gravity)
        speed = state[S_SPEED] + rate_ahead[twist]
        turned = state[S_AZIMUTH] + ahead[twist]
        mean_x = mean_y = mean_z = 0.0
        for j in range(count):
            load[j] = 0.0
            for n in range(count):
                inertia[j, n] = 0.0
        for b in range(m.blades):
            azimuth = turned + 2 * np.pi * b / m.blades
            pitch = blade_pitch[b] + m.pitch_offset[b]
            turned_shapes(m, pitch, shape[b])
            predicted(dt, q[b], v[b], acc[b], q_ahead, v_ahead)
            deflection(m, pitch, shape[b], q_ahead, v_ahead, motion)
            if twists:
                for i in range(sections):
                    motion[i, 7] = torsions[b, i]
            wind = blade_aerodynamics(
                m, inflow, step, time, azimuth, pitch, speed, tilt, drift, motion, state, guess[b],
                wake[b], induced[b], since, force[b],
            )  # fmt: skip
            mean_x += wind[0] / m.blades
            mean_y += wind[1] / m.blades
            mean_z += wind[2] / m.blades
            if twists:
                torsion(
                    m, b, since, speed, azimuth, drift, gravity, force[b], motion, torsions[b]
                )  # fmt: skip
            blade_equations(
                m, b, dt, speed, azimuth, shape[b], drift, gravity, force[b], motion, q[b], v[b],
                acc[b], answer[b], inertia, load,
            )  # fmt: skip
        state[S_AXIAL], state[S_Y], state[S_Z] = mean_x, mean_y, mean_z

        held = 0.0
        if controlled:
            held = brake(c, state, dt)
            load[0] -= m.gear_ratio * state[S_TORQUE]
        h_rate[0] = state[S_SPEED]
        found = frame_acceleration(
            m.frame, m.hub_mass, dt, controlled, held, inertia, load, gravity, h, h_rate, h_acc
        )
        rate = found[0, 0]
        for axis in range(6):
            jerk[axis] = total[axis] = 0.0
        for j in range(count):
            new[j] = found[j, 0] if j > 0 else 0.0
            for axis in range(6):
                jerk[axis] += m.frame.reach[j, axis] * found[j, 0]
        h_rate[0] = 0.0
        step_on(dt, new, h, h_rate, h_acc)

        for b in range(m.blades):
            azimuth = turned + 2 * np.pi * b / m.blades
            pitch = blade_pitch[b] + m.pitch_offset[b]
            for k in range(modes):
                bend[k] = answer[b, k, 0]
                for j in range(count):
                    bend[k] += answer[b, k, 1 + j] * found[j, 0]
            step_on(dt, bend, q[b], v[b], acc[b])
            deflection(m, pitch, shape[b], q[b], v[b], motion)
            if b == 0:
                out[step, TIP] = motion[sections - 1, 0] + m.prebend[sections - 1] * np.cos(pitch)
            blade_root(
                m, b, speed, azimuth, shape[b], drift, gravity, jerk, force[b], motion, acc[b],
                total, own,
            )  # fmt: skip
            if b == 0:
                for axis in range(6):
                    out[step, ROOT + axis] = own[axis]
            out[step, COLUMNS + b] = blade_pitch[b]

        out[step, SPEED] = state[S_SPEED] + h_rate[twist]
        out[step, PITCH] = blade_pitch[0]
        out[step, AZIMUTH] = (state[S_AZIMUTH] + h[twist]) % (2 * np.pi)
        for axis in range(3):
            out[step, FX + axis] = total[axis] + m.hub_mass * (gravity[axis] - jerk[axis])
            out[step, MX + axis] = total[3 + axis]
        out[step, MX] -= m.hub_inertia * jerk[3]
        hub = wind_at(m, inflow, step, time, 0.0, 0.0, 0.0)
        out[step, WIND_X], out[step, WIND_Y], out[step, WIND_Z] = hub[0], hub[1], hub[2]
        out[step, TORQUE] = state[S_TORQUE]
        out[step, STATE] = state[S_STATE]
        out[step, GENERATOR] = m.gear_ratio * state[S_SPEED]
        moves = m.frame.carries[min(1, count - 1)] > 0.0
        out[step, FORE_AFT] = h[1] if moves else 0.0
        out[step, SIDE_SIDE] = h[2] if moves else 0.0

        old = state[S_SPEED]
        if controlled:
            control(
                c, schedule, state, blade_pitch, m.gear_ratio * old, total[4], total[5], time, dt
            )
            next_speed = old + dt * (1.5 * rate - 0.5 * state[S_RATE])
            if held > 0.0 and next_speed * old <= 0.0 and old != 0.0:
                next_speed = rate = 0.0  # friction stops the rotor, it does not turn it back
            state[S_SPEED], state[S_RATE] = next_speed, rate
        state[S_AZIMUTH] += 0.5 * dt * (old + state[S_SPEED])


@kernel
def fill_table(m, angles, pitches, table):
    """Induced over undisturbed speed, normal and tangential, for `tabulated_induction`."""
    for i in range(m.radius.size):
        for p in range(angles.size):
            normal, tangential = np.sin(angles[p]), np.cos(angles[p])
            for q in range(pitches.size):
                _, a, swirl = solve(m, i, pitches[q], 10 * normal, 10 * tangential, 0.0)
                table[i, p, q, 0] = a * normal
                table[i, p, q, 1] = swirl * tangential
