"""Compiled time loop of the rotor: wind at each section, blade loads, modes, speed and control.

Axes of one blade: x along the shaft (downwind), r outward, t in the sense of rotation; (x, r, t) is
right-handed. Shaft frame: e_r = −sin ψ y + cos ψ z, e_t = −cos ψ y − sin ψ z.
"""

import numpy as np
from numba import njit

from ._slots import (
    AZIMUTH,
    COLUMNS,
    FX,
    FY,
    FZ,
    MX,
    MY,
    MZ,
    PITCH,
    S_AXIAL,
    S_AZIMUTH,
    S_RATE,
    S_SPEED,
    S_STATE,
    S_TORQUE,
    S_Y,
    S_Z,
    SPEED,
    STATE,
    TIP,
    TORQUE,
    WIND_X,
    WIND_Y,
    WIND_Z,
)  # fmt: skip
from .aero._kernels import inflow_lag, section_force, solve
from .control._kernels import brake, control

GRAVITY = 9.80665


@njit(cache=True, nogil=True)
def turbulence(inflow, time, y, z):
    """Fluctuation (u, v, w) at a point of the rotor plane: linear in time, radius and angle."""
    count, rings, angles = inflow.u.shape
    position = min(max(time / inflow.box_step, 0.0), count - 1.0)
    k = min(int(position), count - 2)
    late = position - k

    radius = np.sqrt(y * y + z * z)
    i = min(np.searchsorted(inflow.box_radius, radius, side="right") - 1, rings - 2)
    width = inflow.box_radius[i + 1] - inflow.box_radius[i]
    outer = min((radius - inflow.box_radius[i]) / width, 1.0)

    around = (np.arctan2(-y, z) * (angles / (2 * np.pi))) % angles
    j = min(int(around), angles - 1)
    turn = around - j
    j_next = j + 1 if j + 1 < angles else 0

    u = v = w = 0.0
    for plane, ring, angle, share in (
        (k, i, j, (1 - late) * (1 - outer) * (1 - turn)),
        (k, i, j_next, (1 - late) * (1 - outer) * turn),
        (k, i + 1, j, (1 - late) * outer * (1 - turn)),
        (k, i + 1, j_next, (1 - late) * outer * turn),
        (k + 1, i, j, late * (1 - outer) * (1 - turn)),
        (k + 1, i, j_next, late * (1 - outer) * turn),
        (k + 1, i + 1, j, late * outer * (1 - turn)),
        (k + 1, i + 1, j_next, late * outer * turn),
    ):
        u += share * inflow.u[plane, ring, angle]
        if inflow.v.shape[0] > 0:
            v += share * inflow.v[plane, ring, angle]
        if inflow.w.shape[0] > 0:
            w += share * inflow.w[plane, ring, angle]
    return u, v, w


@njit(cache=True, nogil=True)
def wind_at(m, inflow, step, time, x, y, z):
    """Wind (X, Y, Z) in the ground frame, tower dam included, at a point relative to the hub."""
    height = max(m.hub_height + z, 1.0)
    speed = inflow.mean * (height / m.hub_height) ** inflow.shear + inflow.rise[step]
    turn_c, turn_s = np.cos(inflow.direction[step]), np.sin(inflow.direction[step])
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


@njit(cache=True, nogil=True)
def tabulated_induction(m, i, pitch, normal, tangential):
    """Induction factors from the table over inflow angle and pitch; solved outside of it."""
    speed = np.sqrt(normal * normal + tangential * tangential)
    angle = np.arctan2(normal, tangential)
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


@njit(cache=True, nogil=True)
def skewed(m, a, r_y, r_z, state):
    """Induction factor redistributed over the disc under oblique inflow (Pitt and Peters)."""
    across = np.sqrt(state[S_Y] ** 2 + state[S_Z] ** 2)
    if m.skew_factor == 0 or across < 1e-6 or state[S_AXIAL] < 0.1 or a <= 0:
        return a
    skew = (0.6 * a + 1) * np.arctan2(across, state[S_AXIAL])
    downstream = (r_y * state[S_Y] + r_z * state[S_Z]) / (across * m.tip_radius)
    return a * (1 + m.skew_factor * np.tan(0.5 * min(skew, 1.5)) * downstream)


@njit(cache=True, nogil=True)
def momentum_share(m, speed, state):
    """Share of the induction that momentum theory gives: none up to a tip speed ratio of 1, where
    a rotor that stands or idles has no wake of rings, all of it from 2 on.
    """
    wind = np.sqrt(state[S_AXIAL] ** 2 + state[S_Y] ** 2 + state[S_Z] ** 2)
    excess = abs(speed) * m.tip_radius - wind
    if excess >= wind:
        return 1.0
    return 0.5 * (1 - np.cos(np.pi * excess / wind)) if excess > 0 else 0.0


@njit(cache=True, nogil=True)
def blade_aerodynamics(
    m, inflow, step, time, azimuth, pitch, speed, motion, state, guess, wake, induced, dt, force
):
    """Aerodynamic force (x, r, t) on each section of one blade, N.

    `motion` (n, 6): see `deflection`; `guess` (n,): inflow angles of the step before, replaced.
    `wake` (n, SECTION_STATES): see `coefficients`; `induced` (n, 2, 3): see `inflow_lag`. Returns
    the mean wind over the sections (x, y, z).
    """
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    tilt_s, tilt_c = np.sin(m.tilt), np.cos(m.tilt)
    count = m.radius.size
    momentum = momentum_share(m, speed, state)
    mean_x = mean_y = mean_z = 0.0
    for i in range(count):
        along, out, turn = place(m, i, motion, cone_s, cone_c)
        y, z = -sine * out - cosine * turn, cosine * out - sine * turn
        ground_x, ground_z = along * tilt_c + z * tilt_s, z * tilt_c - along * tilt_s
        wind_x, wind_y, wind_z = wind_at(m, inflow, step, time, ground_x, y, ground_z)
        shaft_x = wind_x * tilt_c - wind_z * tilt_s
        shaft_z = wind_x * tilt_s + wind_z * tilt_c
        # a section bent out of the radius has a speed along it
        radial = -sine * wind_y + cosine * shaft_z + speed * turn
        # the section leans with the slope of the bent blade
        lean = m.cone - motion[i, 4]
        lean_s, lean_c = np.sin(lean), np.cos(lean)
        normal = shaft_x * lean_c + radial * lean_s - motion[i, 2]
        tangential = speed * out + motion[i, 3] + cosine * wind_y + sine * shaft_z
        if momentum == 0.0:
            a = swirl = 0.0
        elif m.table.shape[0] > 0:
            a, swirl = tabulated_induction(m, i, pitch, normal, tangential)
        else:
            angle, a, swirl = solve(m, i, pitch, normal, tangential, guess[i])
            guess[i] = angle
        if momentum < 1.0:
            a, swirl = a * momentum, swirl * momentum
        if m.dynamic_inflow:
            a, swirl = inflow_lag(m, i, normal, tangential, a, swirl, state, dt, induced[i])
        a = skewed(m, a, y, z, state)
        f_normal, f_tangential = section_force(
            m, i, pitch, normal, tangential, a, swirl, dt, wake[i]
        )
        force[i, 0] = f_normal * lean_c * m.width[i]
        force[i, 1] = f_normal * lean_s * m.width[i]
        force[i, 2] = f_tangential * m.width[i]
        mean_x += shaft_x / count
        mean_y += wind_y / count
        mean_z += shaft_z / count
    return mean_x, mean_y, mean_z


@njit(cache=True, nogil=True)
def place(m, i, motion, cone_s, cone_c):
    """Section i in the axes (x, r, t) of its blade."""
    radius = m.radius[i] - motion[i, 5]
    along = -radius * cone_s + motion[i, 0] * cone_c
    out = radius * cone_c + motion[i, 0] * cone_s
    return along, out, motion[i, 1]


@njit(cache=True, nogil=True)
def deflection(m, pitch, q, v, motion):
    """Motion of each section, (n, 6): deflection normal and tangential, their rates, slope of the
    normal deflection, pull towards the root. Modes and prebend turn with the pitch.
    """
    c, s = np.cos(pitch), np.sin(pitch)
    motion[:] = 0.0
    for i in range(m.radius.size):
        motion[i, 0] = -m.prebend[i] * c
        motion[i, 1] = -m.prebend[i] * s
        motion[i, 4] = -m.prebend_slope[i] * c
        for k in range(q.size):
            normal = m.shape[i, k, 0] * c - m.shape[i, k, 1] * s
            tangential = m.shape[i, k, 0] * s + m.shape[i, k, 1] * c
            motion[i, 0] += normal * q[k]
            motion[i, 1] += tangential * q[k]
            motion[i, 2] += normal * v[k]
            motion[i, 3] += tangential * v[k]
            motion[i, 4] += (m.slope[i, k, 0] * c - m.slope[i, k, 1] * s) * q[k]
            for j in range(q.size):
                motion[i, 5] += m.shortening[i, k, j] * q[k] * q[j]


@njit(cache=True, nogil=True)
def blade_motion(m, b, dt, speed, azimuth, pitch, force, motion, q, v, acc):
    """Newmark step of the modes of one blade (constant mean acceleration), in place.

    `force` (n, 3) holds the aerodynamic force, found at the predicted motion. The change of rotor
    speed is left out: it matters to the torque only, and would have to be solved with it.
    """
    modes = q.size
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    c, s = np.cos(pitch), np.sin(pitch)
    gravity_x, gravity_z = GRAVITY * np.sin(m.tilt), -GRAVITY * np.cos(m.tilt)
    gravity_r, gravity_t = np.cos(azimuth) * gravity_z, -np.sin(azimuth) * gravity_z
    gravity_n = gravity_x * cone_c + gravity_r * cone_s
    load = np.zeros(modes)
    for i in range(m.radius.size):
        _, out, turn = place(m, i, motion, cone_s, cone_c)
        inertia_r = -(speed**2) * out - 2 * speed * motion[i, 3]
        inertia_t = 2 * speed * motion[i, 2] * cone_s - speed**2 * turn
        mass = m.mass[i] * m.mass_factor[b]
        normal = force[i, 0] * cone_c + force[i, 1] * cone_s
        normal += mass * (gravity_n - inertia_r * cone_s)
        tangential = force[i, 2] + mass * (gravity_t - inertia_t)
        for k in range(modes):
            load[k] += (m.shape[i, k, 0] * c - m.shape[i, k, 1] * s) * normal
            load[k] += (m.shape[i, k, 0] * s + m.shape[i, k, 1] * c) * tangential
    outward = gravity_r * cone_c - gravity_x * cone_s
    stiffness = m.modal_stiffness + m.mass_factor[b] * (
        speed**2 * m.centrifugal + outward * m.axial_gravity
    )
    q_free = q + dt * v + 0.25 * dt * dt * acc
    v_free = v + 0.5 * dt * acc
    system = (
        m.mass_factor[b] * m.modal_mass + 0.5 * dt * m.modal_damping + 0.25 * dt * dt * stiffness
    )
    for k in range(modes):
        # the pull on the blade straightens its prebend
        load[k] += m.mass_factor[b] * (
            speed**2 * m.prebend_centrifugal[k] + outward * m.prebend_gravity[k]
        )
        for j in range(modes):
            load[k] -= m.modal_damping[k, j] * v_free[j] + stiffness[k, j] * q_free[j]
    acc[:] = np.linalg.solve(system, load)
    q[:] = q_free + 0.25 * dt * dt * acc
    v[:] = v_free + 0.5 * dt * acc


@njit(cache=True, nogil=True)
def blade_root(m, b, speed, rate, azimuth, pitch, force, motion, acc, total):
    """Add what one blade applies to the hub at the apex: aerodynamics, weight and inertia.

    `total` (7,): force and moment in the shaft frame, then the moment of inertia about the shaft.
    """
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    c, s = np.cos(pitch), np.sin(pitch)
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    gravity_x, gravity_z = GRAVITY * np.sin(m.tilt), -GRAVITY * np.cos(m.tilt)
    for i in range(m.radius.size):
        along, out, turn = place(m, i, motion, cone_s, cone_c)
        bend_n = bend_t = 0.0
        for k in range(acc.size):
            bend_n += (m.shape[i, k, 0] * c - m.shape[i, k, 1] * s) * acc[k]
            bend_t += (m.shape[i, k, 0] * s + m.shape[i, k, 1] * c) * acc[k]
        mass = m.mass[i] * m.mass_factor[b]
        a_x = bend_n * cone_c
        a_r = bend_n * cone_s - speed**2 * out - 2 * speed * motion[i, 3] - rate * turn
        a_t = bend_t + 2 * speed * motion[i, 2] * cone_s + rate * out - speed**2 * turn
        f_x = force[i, 0] + mass * (gravity_x - a_x)
        f_r = force[i, 1] + mass * (cosine * gravity_z - a_r)
        f_t = force[i, 2] + mass * (-sine * gravity_z - a_t)
        m_r, m_t = turn * f_x - along * f_t, along * f_r - out * f_x
        total[0] += f_x
        total[1] += -sine * f_r - cosine * f_t
        total[2] += cosine * f_r - sine * f_t
        total[3] += out * f_t - turn * f_r
        total[4] += -sine * m_r - cosine * m_t
        total[5] += cosine * m_r - sine * m_t
        total[6] += mass * (out * out + turn * turn)


@njit(cache=True, nogil=True)
def braked_rate(speed, drive, held):
    """Angular acceleration under a drive and a friction `held`, both over the inertia, rad/s²."""
    if speed == 0.0:
        return 0.0 if abs(drive) <= held else drive - np.sign(drive) * held
    return drive - np.sign(speed) * held


@njit(cache=True, nogil=True)
def march(
    m, c, schedule, inflow, dt, steps, start, controlled,
    state, blade_pitch, q, v, acc, guess, wake, induced, out,
):  # fmt: skip
    """March the rotor; `state` (SLOTS,), `blade_pitch` (blades,), `q`, `v`, `acc` (blades, k),
    `guess`, `wake` and `induced` go on.

    Not `controlled`: speed and pitch stay. `out` (steps, COLUMNS + blades) is filled.
    """
    sections = m.radius.size
    motion = np.zeros((sections, 6))
    force = np.zeros((m.blades, sections, 3))
    total = np.zeros(7)
    old_rate = state[S_RATE]
    fresh = 1 if np.all(wake == 0.0) and np.all(induced == 0.0) else 0
    for step in range(steps):
        time = start + step * dt
        speed, rate = state[S_SPEED], state[S_RATE]
        total[:] = 0.0
        mean = np.zeros(3)
        for b in range(m.blades):
            azimuth = state[S_AZIMUTH] + 2 * np.pi * b / m.blades
            pitch = blade_pitch[b] + m.pitch_offset[b]
            ahead = q[b] + dt * v[b] + 0.5 * dt * dt * acc[b]
            deflection(m, pitch, ahead, v[b] + dt * acc[b], motion)
            since = dt if fresh == 0 or step > 0 else 0.0
            wind = blade_aerodynamics(
                m, inflow, step, time, azimuth, pitch, speed, motion, state, guess[b], wake[b],
                induced[b], since, force[b],
            )  # fmt: skip
            for axis in range(3):
                mean[axis] += wind[axis] / m.blades
            if q.shape[1] > 0:
                blade_motion(m, b, dt, speed, azimuth, pitch, force[b], motion, q[b], v[b], acc[b])
                deflection(m, pitch, q[b], v[b], motion)
            if b == 0:
                out[step, TIP] = motion[sections - 1, 0] + m.prebend[sections - 1] * np.cos(pitch)
            blade_root(m, b, speed, rate, azimuth, pitch, force[b], motion, acc[b], total)
            out[step, COLUMNS + b] = blade_pitch[b]
        state[S_AXIAL], state[S_Y], state[S_Z] = mean[0], mean[1], mean[2]

        inertia = total[6] + m.hub_inertia
        whole = inertia + m.generator_inertia
        torque = total[3] + total[6] * rate  # without the inertia of the changing speed
        held = 0.0
        if controlled:
            held = brake(c, state, dt) / whole
            rate = (torque - m.gear_ratio * state[S_TORQUE]) / whole
            if held > 0.0:
                rate = braked_rate(speed, rate, held)
        out[step, SPEED] = speed
        out[step, PITCH] = blade_pitch[0]
        out[step, AZIMUTH] = state[S_AZIMUTH] % (2 * np.pi)
        out[step, FX] = total[0] + m.hub_mass * GRAVITY * np.sin(m.tilt)
        out[step, FY] = total[1]
        out[step, FZ] = total[2] - m.hub_mass * GRAVITY * np.cos(m.tilt)
        out[step, MX] = torque - inertia * rate
        out[step, MY] = total[4]
        out[step, MZ] = total[5]
        hub = wind_at(m, inflow, step, time, 0.0, 0.0, 0.0)
        out[step, WIND_X], out[step, WIND_Y], out[step, WIND_Z] = hub[0], hub[1], hub[2]
        out[step, TORQUE] = state[S_TORQUE]
        out[step, STATE] = state[S_STATE]

        if controlled:
            control(
                c, schedule, state, blade_pitch, m.gear_ratio * speed, total[4], total[5], time, dt
            )
            new = speed + dt * (1.5 * rate - 0.5 * old_rate)
            if held > 0.0 and new * speed <= 0.0 and speed != 0.0:
                new = rate = 0.0  # friction stops the rotor, it does not turn it back
            state[S_SPEED] = new
            state[S_RATE] = old_rate = rate
        state[S_AZIMUTH] += 0.5 * dt * (speed + state[S_SPEED])


@njit(cache=True, nogil=True)
def fill_table(m, angles, pitches, table):
    """Induced over undisturbed speed, normal and tangential, for `tabulated_induction`."""
    for i in range(m.radius.size):
        for p in range(angles.size):
            normal, tangential = np.sin(angles[p]), np.cos(angles[p])
            for q in range(pitches.size):
                _, a, swirl = solve(m, i, pitches[q], 10 * normal, 10 * tangential, 0.0)
                table[i, p, q, 0] = a * normal
                table[i, p, q, 1] = swirl * tangential
