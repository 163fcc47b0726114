"""Compiled motion of the blades, and of the tower and drivetrain that carry them.

Axes of one blade: x along the shaft (downwind), r outward, t in the sense of rotation; (x, r, t) is
right-handed and turns with the rotor. Blades and frame are solved together: each blade hands its
modes over as they answer to the frame, the frame is solved, the blades follow.
"""

import numpy as np

from .._compile import inner_once, inner_section, section

GRAVITY = 9.80665
TORSION_LAG = 0.05
"""Time in which the torsion of a blade follows its loads, s."""
MOST_TORSION = 0.5
"""Largest elastic turn of a section, rad: beyond, quasi-static torsion has no meaning."""


@inner_section
def blade_axes(sine, cosine, vector):
    """A vector of the shaft frame in the axes (x, r, t) of a blade."""
    y, z = vector[1], vector[2]
    return vector[0], cosine * z - sine * y, -cosine * y - sine * z


@inner_section
def place(radius, bent, swept, cone_s, cone_c):
    """A section at a radius along its blade, and deflected, in the axes (x, r, t) of the blade."""
    return -radius * cone_s + bent * cone_c, radius * cone_c + bent * cone_s, swept


@inner_section
def section_place(radii, i, motion, cone_s, cone_c):
    """The same of section i, at `radii` (n,) and with `motion` (n, 8)."""
    return place(radii[i] - motion[i, 5], motion[i, 0], motion[i, 1], cone_s, cone_c)


@section
def turned_shapes(m, pitch, shape):
    """Mode shapes of a pitched blade, (n, k, 4): normal, tangential, and the slopes of both."""
    c, s = np.cos(pitch), np.sin(pitch)
    for i in range(shape.shape[0]):
        for k in range(shape.shape[1]):
            shape[i, k, 0] = m.shape[i, k, 0] * c - m.shape[i, k, 1] * s
            shape[i, k, 1] = m.shape[i, k, 0] * s + m.shape[i, k, 1] * c
            shape[i, k, 2] = m.slope[i, k, 0] * c - m.slope[i, k, 1] * s
            shape[i, k, 3] = m.slope[i, k, 0] * s + m.slope[i, k, 1] * c


@section
def deflection(m, pitch, shape, q, v, motion):
    """Motion of each section, (n, 8): deflection normal and tangential, their rates, slope of the
    normal deflection, pull towards the root, nose-down turn by bending; the last, that by torsion,
    stays 0. Modes and prebend turn with the pitch.

    A blade that bends both ways turns its sections by the product of the two slopes, see
    `RotorOptions.bend_twist`.
    """
    c, s = np.cos(pitch), np.sin(pitch)
    for i in range(m.radius.size):
        normal, tangential = -m.prebend[i] * c, -m.prebend[i] * s
        normal_rate = tangential_rate = bent = swept = pull = 0.0
        for k in range(q.size):
            normal += shape[i, k, 0] * q[k]
            tangential += shape[i, k, 1] * q[k]
            normal_rate += shape[i, k, 0] * v[k]
            tangential_rate += shape[i, k, 1] * v[k]
            bent += shape[i, k, 2] * q[k]
            swept += shape[i, k, 3] * q[k]
            for j in range(q.size):
                pull += m.shortening[i, k, j] * q[k] * q[j]
        motion[i, 0], motion[i, 1] = normal, tangential
        motion[i, 2], motion[i, 3] = normal_rate, tangential_rate
        motion[i, 4] = bent - m.prebend_slope[i] * c
        motion[i, 5], motion[i, 6] = pull, m.bend_twist * bent * swept
        motion[i, 7] = 0.0


@section
def torsion(m, b, dt, speed, azimuth, drift, gravity, force, motion, turned, room):
    """Move the elastic nose-down turn of the sections, `turned` (n,), on towards that of the loads.

    Quasi-static: the torque about the axis of the bent blade, of aerodynamic loads (`force`,
    (n, 4)), weight and inertia outside of a section, over the torsional stiffness. It follows
    within `TORSION_LAG`, as a blade does that twists at a few hertz; dt = 0 sets it at once.
    `room` is a `Room`.
    """
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    g_x, g_r, g_t = blade_axes(sine, cosine, gravity)
    rate = blade_axes(sine, cosine, drift[3:])
    n, point, torque = m.radius.size, room.point, room.torque
    for i in range(n):
        point[i, 0], point[i, 1], point[i, 2] = section_place(m.radius, i, motion, cone_s, cone_c)
    f_x = f_r = f_t = m_x = m_r = m_t = couple = 0.0
    for i in range(n - 1, -1, -1):
        x, r, t = point[i, 0], point[i, 1], point[i, 2]
        inner, outer = max(i - 1, 0), min(i + 1, n - 1)
        e_x = point[outer, 0] - point[inner, 0]
        e_r = point[outer, 1] - point[inner, 1]
        e_t = point[outer, 2] - point[inner, 2]
        length = np.sqrt(e_x * e_x + e_r * e_r + e_t * e_t)
        about_x = m_x - (r * f_t - t * f_r)
        about_r = m_r - (t * f_x - x * f_t)
        about_t = m_t - (x * f_r - r * f_x)
        own = force[i, 3]
        nose_up = (about_x * e_x + about_r * e_r + about_t * e_t) / length + couple + 0.5 * own
        torque[i] = -nose_up
        couple += own
        a_x, a_r, a_t = free_acceleration(speed, rate, motion, i, cone_s, cone_c, r, t)
        mass = m.mass[i] * m.mass_factor[b]
        s_x = force[i, 0] + mass * (g_x - a_x)
        s_r = force[i, 1] + mass * (g_r - a_r)
        s_t = force[i, 2] + mass * (g_t - a_t)
        f_x, f_r, f_t = f_x + s_x, f_r + s_r, f_t + s_t
        m_x += r * s_t - t * s_r
        m_r += t * s_x - x * s_t
        m_t += x * s_r - r * s_x
    share = 1.0 if dt <= 0 else 1 - np.exp(-dt / TORSION_LAG)
    total, before, at = 0.0, torque[0] * m.torsion_compliance[0], m.hub_radius
    for i in range(n):
        rise = torque[i] * m.torsion_compliance[i]
        total += 0.5 * (before + rise) * (m.radius[i] - at)
        before, at = rise, m.radius[i]
        wanted = min(max(total, -MOST_TORSION), MOST_TORSION)
        turned[i] += share * (wanted - turned[i])


@inner_section
def nacelle_motion(frame, tilt, h, v, drift, gravity):
    """Speed of the apex and rate of rotation of the nacelle, `drift` (6,), and `gravity` (3,), in
    the shaft frame, which tilts with the nacelle; returns its tilt.
    """
    for axis in range(6):
        drift[axis] = 0.0
    turn_x = turn_y = turn_z = 0.0
    for j in range(h.size):
        if frame.carries[j] == 0.0:
            continue
        for axis in range(6):
            drift[axis] += frame.reach[j, axis] * v[j]
        turn_x += frame.reach[j, 3] * h[j]
        turn_y += frame.reach[j, 4] * h[j]
        turn_z += frame.reach[j, 5] * h[j]
    x, z = GRAVITY * np.sin(tilt), -GRAVITY * np.cos(tilt)
    gravity[0] = x - turn_y * z
    gravity[1] = turn_x * z - turn_z * x
    gravity[2] = z + turn_y * x
    return tilt + turn_y


@inner_section
def carried(reach, along, out, turn):
    """Motion of a point that moves with the apex and turns with the axes; `reach` (6,)."""
    return (
        reach[0] + reach[4] * turn - reach[5] * out,
        reach[1] + reach[5] * along - reach[3] * turn,
        reach[2] + reach[3] * out - reach[4] * along,
    )


@inner_section
def free_acceleration(speed, rate, motion, i, cone_s, cone_c, out, turn):
    """Acceleration (x, r, t) of section i while neither modes nor frame accelerate: centripetal,
    Coriolis and gyroscopic; `rate` (3,): that of the rotation of the nacelle.
    """
    v_x = motion[i, 2] * cone_c
    v_r = motion[i, 2] * cone_s - speed * turn
    v_t = motion[i, 3] + speed * out
    return (
        2 * (rate[1] * v_t - rate[2] * v_r),
        -(speed**2) * out - 2 * speed * motion[i, 3] + 2 * (rate[2] * v_x - rate[0] * v_t),
        2 * speed * motion[i, 2] * cone_s - speed**2 * turn + 2 * (rate[0] * v_r - rate[1] * v_x),
    )


@inner_once
def solve_in_place(system, right):
    """Gaussian elimination with row pivots of a few equations, for all columns of `right` (n, k).

    What has no solution becomes infinite or no number. A call of LAPACK takes longer than this.
    """
    n, columns = right.shape
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(system[i, k]) > abs(system[pivot, k]):
                pivot = i
        if pivot != k:
            for j in range(k, n):
                system[k, j], system[pivot, j] = system[pivot, j], system[k, j]
            for j in range(columns):
                right[k, j], right[pivot, j] = right[pivot, j], right[k, j]
        for i in range(k + 1, n):
            share = system[i, k] / system[k, k]
            for j in range(k + 1, n):
                system[i, j] -= share * system[k, j]
            for j in range(columns):
                right[i, j] -= share * right[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(columns):
            total = right[k, j]
            for i in range(k + 1, n):
                total -= system[k, i] * right[i, j]
            right[k, j] = total / system[k, k]


@inner_section
def blade_equations(
    m, b, dt, speed, azimuth, shape, drift, gravity, force, motion, q, v, acc, answer, inertia,
    load, room,
):  # fmt: skip
    """Eliminate the modes of one blade from the equations of the frame.

    `force` (n, 3) holds the aerodynamic force, found at the predicted motion. `answer` (k, 1 + h)
    becomes the acceleration of the modes while the frame does not accelerate, then that per unit
    acceleration of each of its coordinates. `inertia` (h, h) and `load` (h,) of the frame grow by
    what the blade adds to them; `room` is a `Room`.
    """
    modes, count = q.size, load.size
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    g_x, g_r, g_t = blade_axes(sine, cosine, gravity)
    rate = blade_axes(sine, cosine, drift[3:])
    mass = s_x = s_r = s_t = j_xx = j_rr = j_tt = j_xr = j_xt = j_rt = 0.0
    f_x = f_r = f_t = m_x = m_r = m_t = 0.0
    # sums over the blade: what a motion of the frame does to it depends on nothing else
    couple, swing, reach, push = room.couple, room.swing, room.reach, room.push
    for k in range(modes):
        for j in range(1 + count):
            couple[k, j] = 0.0
        for axis in range(6):
            swing[k, axis] = 0.0
    for i in range(m.radius.size):
        x, r, t = section_place(m.radius, i, motion, cone_s, cone_c)
        a_x, a_r, a_t = free_acceleration(speed, rate, motion, i, cone_s, cone_c, r, t)
        own = m.mass[i] * m.mass_factor[b]
        own_x = force[i, 0] + own * (g_x - a_x)
        own_r = force[i, 1] + own * (g_r - a_r)
        own_t = force[i, 2] + own * (g_t - a_t)
        f_x, f_r, f_t = f_x + own_x, f_r + own_r, f_t + own_t
        m_x += r * own_t - t * own_r
        m_r += t * own_x - x * own_t
        m_t += x * own_r - r * own_x
        o_x, o_r, o_t = own * x, own * r, own * t
        mass, s_x, s_r, s_t = mass + own, s_x + o_x, s_r + o_r, s_t + o_t
        j_xx, j_rr, j_tt = j_xx + o_x * x, j_rr + o_r * r, j_tt + o_t * t
        j_xr, j_xt, j_rt = j_xr + o_x * r, j_xt + o_x * t, j_rt + o_r * t
        normal = own_x * cone_c + own_r * cone_s
        for k in range(modes):
            across, along = shape[i, k, 0], shape[i, k, 1]
            couple[k, 0] += across * normal + along * own_t
            p_x, p_r, p_t = own * across * cone_c, own * across * cone_s, own * along
            swing[k, 0] += p_x
            swing[k, 1] += p_r
            swing[k, 2] += p_t
            swing[k, 3] += r * p_t - t * p_r
            swing[k, 4] += t * p_x - x * p_t
            swing[k, 5] += x * p_r - r * p_x
    for j in range(count):
        v_x, v_r, v_t = blade_axes(sine, cosine, m.frame.reach[j, :3])
        w_x, w_r, w_t = blade_axes(sine, cosine, m.frame.reach[j, 3:])
        reach[j, 0], reach[j, 1], reach[j, 2] = v_x, v_r, v_t
        reach[j, 3], reach[j, 4], reach[j, 5] = w_x, w_r, w_t
        load[j] += v_x * f_x + v_r * f_r + v_t * f_t + w_x * m_x + w_r * m_r + w_t * m_t
        # momentum and angular momentum of the blade per unit speed of the coordinate
        push[j, 0] = mass * v_x + w_r * s_t - w_t * s_r
        push[j, 1] = mass * v_r + w_t * s_x - w_x * s_t
        push[j, 2] = mass * v_t + w_x * s_r - w_r * s_x
        push[j, 3] = s_r * v_t - s_t * v_r + (j_rr + j_tt) * w_x - j_xr * w_r - j_xt * w_t
        push[j, 4] = s_t * v_x - s_x * v_t + (j_tt + j_xx) * w_r - j_rt * w_t - j_xr * w_x
        push[j, 5] = s_x * v_r - s_r * v_x + (j_xx + j_rr) * w_t - j_xt * w_x - j_rt * w_r
    for j in range(count):
        for axis in range(6):
            for n in range(count):
                inertia[j, n] += reach[j, axis] * push[n, axis]
            for k in range(modes):
                couple[k, 1 + j] += reach[j, axis] * swing[k, axis]
    if modes == 0:
        return
    outward = g_r * cone_c - g_x * cone_s
    system = room.modal
    for k in range(modes):
        for j in range(1 + count):
            answer[k, j] = couple[k, j]
        # the pull on the blade straightens its prebend
        answer[k, 0] += m.mass_factor[b] * (
            speed**2 * m.prebend_centrifugal[k] + outward * m.prebend_gravity[k]
        )
        for j in range(modes):
            stiffness = m.modal_stiffness[k, j] + m.mass_factor[b] * (
                speed**2 * m.centrifugal[k, j] + outward * m.axial_gravity[k, j]
            )
            system[k, j] = (
                m.mass_factor[b] * m.modal_mass[k, j]
                + 0.5 * dt * m.modal_damping[k, j]
                + 0.25 * dt * dt * stiffness
            )
            q_free = q[j] + dt * v[j] + 0.25 * dt * dt * acc[j]
            v_free = v[j] + 0.5 * dt * acc[j]
            answer[k, 0] -= m.modal_damping[k, j] * v_free + stiffness * q_free
    solve_in_place(system, answer)
    for j in range(count):
        for k in range(modes):
            load[j] -= couple[k, 1 + j] * answer[k, 0]
            for n in range(count):
                inertia[j, n] -= couple[k, 1 + j] * answer[k, 1 + n]
    for k in range(modes):
        for j in range(count):
            answer[k, 1 + j] = -answer[k, 1 + j]


@inner_section
def frame_acceleration(
    f, hub_mass, dt, controlled, held, inertia, load, gravity, h, v, acc, room, found
):
    """Write the acceleration of the coordinates of the frame, `found` (h, 1), with those of the
    blades eliminated; `room` is a `Room`.

    `load` holds the torque of the generator. The shaft brake holds the generator up to the torque
    `held`, as dry friction; a rotor that is not `controlled` keeps its speed.
    """
    count = load.size
    system, fixed, right = room.system, room.fixed, room.right
    for j in range(count):
        right[j, 0] = load[j] + f.load[j]
        for axis in range(3):
            right[j, 0] += hub_mass * f.reach[j, axis] * gravity[axis]
        for n in range(count):
            system[j, n] = (
                inertia[j, n]
                + f.mass[j, n]
                + 0.5 * dt * f.damping[j, n]
                + 0.25 * dt * dt * f.stiffness[j, n]
            )
            fixed[j, n] = system[j, n] if j > 0 else 0.0
        for n in range(1, count):
            h_free = h[n] + dt * v[n] + 0.25 * dt * dt * acc[n]
            v_free = v[n] + 0.5 * dt * acc[n]
            right[j, 0] -= f.damping[j, n] * v_free + f.stiffness[j, n] * h_free
        found[j, 0] = right[j, 0] if j > 0 else 0.0
    if not controlled or (held != 0.0 and v[0] == 0.0):
        fixed[0, 0] = 1.0
        solve_in_place(fixed, found)
        found[0, 0] = 0.0  # exactly
        # torque that the brake would have to take to keep the generator at rest
        needed = right[0, 0]
        for j in range(1, count):
            needed -= system[0, j] * found[j, 0]
        if not controlled or not abs(needed) > held:
            return
        right[0, 0] -= np.sign(needed) * held
    else:
        right[0, 0] -= np.sign(v[0]) * held
    solve_in_place(system, right)
    for j in range(count):
        found[j, 0] = right[j, 0]


@inner_section
def predicted(dt, q, v, acc, ahead, rate_ahead):
    """Write where motion and speed would be in a step with the acceleration of the last one."""
    for k in range(q.size):
        ahead[k] = q[k] + dt * v[k] + 0.5 * dt * dt * acc[k]
        rate_ahead[k] = v[k] + dt * acc[k]


@inner_section
def step_on(dt, new, q, v, acc):
    """Newmark step (constant mean acceleration) to the acceleration `new`, in place."""
    for k in range(q.size):
        q[k] += dt * v[k] + 0.25 * dt * dt * (acc[k] + new[k])
        v[k] += 0.5 * dt * (acc[k] + new[k])
        acc[k] = new[k]


@inner_section
def blade_root(m, b, speed, azimuth, shape, drift, gravity, jerk, force, motion, acc, total, own):
    """Add what one blade applies to the hub at the apex: aerodynamics, weight and inertia.

    `jerk` (6,): acceleration of the apex and of the rotation of the rotor; `total` (6,): force and
    moment in the shaft frame; `own` (6,) becomes those of this blade alone at its root, in the axes
    of its pitch bearing: outward along the axis of pitch, downwind, against the rotation.
    """
    cone_s, cone_c = np.sin(m.cone), np.cos(m.cone)
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    g_x, g_r, g_t = blade_axes(sine, cosine, gravity)
    rate = blade_axes(sine, cosine, drift[3:])
    reach = (*blade_axes(sine, cosine, jerk[:3]), *blade_axes(sine, cosine, jerk[3:]))
    f_x = f_r = f_t = m_x = m_r = m_t = 0.0
    for i in range(m.radius.size):
        x, r, t = section_place(m.radius, i, motion, cone_s, cone_c)
        bend_n = bend_t = 0.0
        for k in range(acc.size):
            bend_n += shape[i, k, 0] * acc[k]
            bend_t += shape[i, k, 1] * acc[k]
        a_x, a_r, a_t = free_acceleration(speed, rate, motion, i, cone_s, cone_c, r, t)
        moved = carried(reach, x, r, t)
        mass = m.mass[i] * m.mass_factor[b]
        own_x = force[i, 0] + mass * (g_x - a_x - moved[0] - bend_n * cone_c)
        own_r = force[i, 1] + mass * (g_r - a_r - moved[1] - bend_n * cone_s)
        own_t = force[i, 2] + mass * (g_t - a_t - moved[2] - bend_t)
        f_x, f_r, f_t = f_x + own_x, f_r + own_r, f_t + own_t
        m_x += r * own_t - t * own_r
        m_r += t * own_x - x * own_t
        m_t += x * own_r - r * own_x
    total[0] += f_x
    total[1] += -sine * f_r - cosine * f_t
    total[2] += cosine * f_r - sine * f_t
    total[3] += m_x
    total[4] += -sine * m_r - cosine * m_t
    total[5] += cosine * m_r - sine * m_t
    own[0] = f_r * cone_c - f_x * cone_s
    own[1] = f_x * cone_c + f_r * cone_s
    own[2] = -f_t
    root_x, root_r = -m.hub_radius * cone_s, m.hub_radius * cone_c
    about_x, about_r = m_x - root_r * f_t, m_r + root_x * f_t
    own[3] = about_r * cone_c - about_x * cone_s
    own[4] = about_x * cone_c + about_r * cone_s
    own[5] = root_x * f_r - root_r * f_x - m_t
