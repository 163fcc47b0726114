"""Compiled time loop of the rotor: loads of the blades, modes, speed and control.

Shaft frame: x along the shaft (downwind), z up, y left looking downwind; outward along a blade is
e_r = −sin ψ y + cos ψ z, in the sense of rotation e_t = −cos ψ y − sin ψ z.
"""

import numpy as np

from loadflow.numerics.entries import enter
from loadflow.numerics.references import refer

from ._compile import inner_once, kernel, once
from ._wind_kernels import hub_wind
from .aero._kernels import solve
from .aero._section_kernels import aerodynamics
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
    deflection,
    frame_acceleration,
    nacelle_motion,
    predicted,
    step_on,
    torsion,
    turned_shapes,
)


@inner_once
def respond(
    m, c, schedule, dt, step, time, since, controlled, speed, turned, state, blade_pitch, q, v, acc,
    h, h_rate, h_acc, torsions, room, out,
):  # fmt: skip
    """Second half of a step: what rotor, tower and control do under the forces in `room`.

    `speed`, `turned`: predicted speed and azimuth of the rotor; `since`: time for what lags, 0
    where it is steady; the others as in `march`. By itself, called by its place in memory, so that
    two processes can compile the halves at once, see `loop.compile_response`.
    """
    sections, modes, count, twist = m.radius.size, q.shape[1], h.size, m.frame.twist
    shape, motion, force, answer, found = (
        room.shape, room.motion, room.force, room.answer, room.found
    )  # fmt: skip
    bend, new, inertia, load = room.bend, room.new, room.inertia, room.load
    drift, gravity, jerk, total, own = room.drift, room.gravity, room.jerk, room.total, room.own
    twists = torsions.shape[1] > 0
    for b in range(m.blades):
        azimuth = turned + 2 * np.pi * b / m.blades
        if twists:
            torsion(
                m, b, since, speed, azimuth, drift, gravity, force[b], motion[b], torsions[b],
                room,
            )  # fmt: skip
        blade_equations(
            m, b, dt, speed, azimuth, shape[b], drift, gravity, force[b], motion[b], q[b], v[b],
            acc[b], answer[b], inertia, load, room,
        )  # fmt: skip
    held = 0.0
    if controlled:
        held = brake(c, state, dt)
        load[0] -= m.gear_ratio * state[S_TORQUE]
    h_rate[0] = state[S_SPEED]
    frame_acceleration(
        m.frame, m.hub_mass, dt, controlled, held, inertia, load, gravity, h, h_rate, h_acc,
        room, found,
    )  # fmt: skip
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
        deflection(m, pitch, shape[b], q[b], v[b], motion[b])
        if b == 0:
            last = sections - 1
            out[step, TIP] = motion[b, last, 0] + m.prebend[last] * np.cos(pitch)
        blade_root(
            m, b, speed, azimuth, shape[b], drift, gravity, jerk, force[b], motion[b], acc[b],
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
    out[step, TORQUE] = state[S_TORQUE]
    out[step, STATE] = state[S_STATE]
    out[step, GENERATOR] = m.gear_ratio * state[S_SPEED]
    moves = m.frame.carries[min(1, count - 1)] > 0.0
    out[step, FORE_AFT] = h[1] if moves else 0.0
    out[step, SIDE_SIDE] = h[2] if moves else 0.0

    old = state[S_SPEED]
    if controlled:
        control(c, schedule, state, blade_pitch, m.gear_ratio * old, total[4], total[5], time, dt)
        next_speed = old + dt * (1.5 * rate - 0.5 * state[S_RATE])
        if held > 0.0 and next_speed * old <= 0.0 and old != 0.0:
            next_speed = rate = 0.0  # friction stops the rotor, it does not turn it back
        state[S_SPEED], state[S_RATE] = next_speed, rate
    state[S_AZIMUTH] += 0.5 * dt * (old + state[S_SPEED])


@once
def march(
    response, m, c, schedule, inflow, dt, steps, start, fresh, controlled, state, blade_pitch, q,
    v, acc, h, h_rate, h_acc, guess, wake, induced, torsions, room, out,
):  # fmt: skip
    """March the rotor; `state` (SLOTS,), `blade_pitch` (blades,), `q`, `v`, `acc` (blades, k), `h`,
    `h_rate`, `h_acc` (h,; place 0, the generator, is in `state`), `guess`, `wake`, `induced`,
    `torsions` (blades, n; without sections if no blade twists) go on.

    `response`: the `Entry` of `respond`. `fresh`: wake and induced speed are steady at first. Not
    `controlled`: speed and pitch stay. `room` is a `Room`; `out` (steps, COLUMNS + blades) is
    filled.
    """
    m, c, schedule, inflow, room = refer(m), refer(c), refer(schedule), refer(inflow), refer(room)
    sections, count, twist = m.radius.size, h.size, m.frame.twist
    shape, motion, force = room.shape, room.motion, room.force
    q_ahead, v_ahead, ahead, rate_ahead = room.q_ahead, room.v_ahead, room.ahead, room.rate_ahead
    inertia, load, drift, gravity = room.inertia, room.load, room.drift, room.gravity
    twists = torsions.shape[1] > 0
    for step in range(steps):
        time = start + step * dt
        since = 0.0 if fresh and step == 0 else dt
        predicted(dt, h, h_rate, h_acc, ahead, rate_ahead)
        tilt = nacelle_motion(m.frame, m.tilt, ahead, rate_ahead, drift, gravity)
        speed = state[S_SPEED] + rate_ahead[twist]
        turned = state[S_AZIMUTH] + ahead[twist]
        for j in range(count):
            load[j] = 0.0
            for n in range(count):
                inertia[j, n] = 0.0
        for b in range(m.blades):
            pitch = blade_pitch[b] + m.pitch_offset[b]
            room.pitch[b] = pitch
            turned_shapes(m, pitch, shape[b])
            predicted(dt, q[b], v[b], acc[b], q_ahead, v_ahead)
            deflection(m, pitch, shape[b], q_ahead, v_ahead, motion[b])
            if twists:
                for i in range(sections):
                    motion[b, i, 7] = torsions[b, i]
        mean_x, mean_y, mean_z = aerodynamics(
            m, inflow, step, time, turned, room.pitch, speed, tilt, drift, motion, state, guess,
            wake, induced, since, room, force,
        )  # fmt: skip
        state[S_AXIAL], state[S_Y], state[S_Z] = mean_x, mean_y, mean_z
        hub = hub_wind(m, inflow, step, time)
        out[step, WIND_X], out[step, WIND_Y], out[step, WIND_Z] = hub[0], hub[1], hub[2]
        enter(response, (
            m, c, schedule, dt, step, time, since, controlled, speed, turned, state, blade_pitch, q,
            v, acc, h, h_rate, h_acc, torsions, room, out,
        ))  # fmt: skip


@kernel
def fill_table(m, angles, pitches, table):
    """Induced over undisturbed speed, normal and tangential, for `tabulated_induction`."""
    m = refer(m)
    for i in range(m.radius.size):
        for p in range(angles.size):
            normal, tangential = np.sin(angles[p]), np.cos(angles[p])
            for q in range(pitches.size):
                _, a, swirl = solve(m, i, pitches[q], 10 * normal, 10 * tangential, 0.0)
                table[i, p, q, 0] = a * normal
                table[i, p, q, 1] = swirl * tangential
