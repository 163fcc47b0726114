"""Compiled loops of the rigid-ring equilibrium.

Unknowns q = (ux, uy, uz, θx, θy): motion of the inner ring relative to the outer. Contacts come as
a table, one line for each kind (row and diagonal of balls, or row and slice of rollers), repeated
at each element with azimuth φ. Columns: RADIUS and HEIGHT of the point of the inner ring that the
contact acts on; NORMAL_R and NORMAL_Z; FREE, GAP, STIFFNESS.

Point contact: (NORMAL_R, NORMAL_Z) is the vector from the outer to the inner groove centre, FREE
the distance of both at touch, GAP = |vector|² - FREE² (kept apart so that nothing cancels);
F = K δ^1.5 along the actual vector. Line contact: (NORMAL_R, NORMAL_Z) is the fixed unit normal,
GAP the clearance along it; F = K δ^(10/9). Both energies are convex in q.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

POINT, LINE = 0, 1
RADIUS, HEIGHT, NORMAL_R, NORMAL_Z, FREE, GAP, STIFFNESS = range(7)

_EPS = 2.220446049250313e-16


@njit(cache=True, nogil=True, inline="always")
def _contact(line, law, dr, dt, dz):
    """Approach δ, force, tangent dF/dδ, F/|vector| and unit normal (r, t, z) of one contact."""
    if law == LINE:
        delta = line[NORMAL_R] * dr + line[NORMAL_Z] * dz - line[GAP]
        if delta <= 0.0:
            return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        root = math.exp(math.log(delta) / 9.0)
        force = line[STIFFNESS] * delta * root
        tangent = 10.0 / 9.0 * line[STIFFNESS] * root
        return delta, force, tangent, 0.0, line[NORMAL_R], 0.0, line[NORMAL_Z]
    stretch = (
        2.0 * (line[NORMAL_R] * dr + line[NORMAL_Z] * dz) + dr * dr + dt * dt + dz * dz + line[GAP]
    )
    if stretch <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    x, z = line[NORMAL_R] + dr, line[NORMAL_Z] + dz
    length = math.sqrt(x * x + dt * dt + z * z)
    delta = stretch / (length + line[FREE])
    root = line[STIFFNESS] * math.sqrt(delta)
    force = root * delta
    return delta, force, 1.5 * root, force / length, x / length, dt / length, z / length


@njit(cache=True, nogil=True)
def evaluate(q, cos, sin, table, law, spatial, gradient, hessian):
    """Energy of all contacts at `q`; fills its gradient (5,) and Hessian (5, 5).

    Returns the energy and the sum of all contact forces. Per element the contacts are summed in its
    own frame (radial r, tangential t, axial z; rotation o about t and p about r) and then rotated.
    """
    gradient[:] = 0.0
    hessian[:, :] = 0.0
    energy = 0.0
    total = 0.0
    share = 0.4 if law == POINT else 9.0 / 19.0
    for i in range(cos.shape[0]):
        c, s = cos[i], sin[i]
        ur, ut = q[0] * c + q[1] * s, q[1] * c - q[0] * s
        om, ro = q[4] * c - q[3] * s, q[3] * c + q[4] * s
        gr = gt = gz = go = gp = 0.0
        rr = rt = rz = tt = tz = zz = 0.0
        r_o = r_p = t_o = t_p = z_o = z_p = oo = op = pp = 0.0
        touched = False
        for k in range(table.shape[0]):
            line = table[k]
            big, h = line[RADIUS], line[HEIGHT]
            dt = spatial * (ut - h * ro)
            delta, force, tangent, fl, nr, nt, nz = _contact(
                line, law, ur + h * om, dt, q[2] - big * om
            )
            if delta == 0.0:
                continue
            touched = True
            energy += share * force * delta
            total += force
            fr, ft, fz = force * nr, force * nt, force * nz
            gr += fr
            gt += ft
            gz += fz
            go += h * fr - big * fz
            gp -= h * ft
            if law == LINE:
                d, across = tangent, 0.0
            else:
                d, across = tangent - fl, fl
            hrr, hrz, hzz = d * nr * nr + across, d * nr * nz, d * nz * nz + across
            hrt, htt, htz = d * nr * nt, spatial * (d * nt * nt + across), d * nt * nz
            rr += hrr
            rt += hrt
            rz += hrz
            tt += htt
            tz += htz
            zz += hzz
            r_o += h * hrr - big * hrz
            r_p -= h * hrt
            t_o += h * hrt - big * htz
            t_p -= h * htt
            z_o += h * hrz - big * hzz
            z_p -= h * htz
            oo += h * h * hrr - 2.0 * h * big * hrz + big * big * hzz
            op -= h * (h * hrt - big * htz)
            pp += h * h * htt
        if not touched:
            continue
        cc, cs, ss = c * c, c * s, s * s
        gradient[0] += c * gr - s * gt
        gradient[1] += s * gr + c * gt
        gradient[2] += gz
        gradient[3] += c * gp - s * go
        gradient[4] += s * gp + c * go
        hessian[0, 0] += cc * rr - 2.0 * cs * rt + ss * tt
        hessian[0, 1] += cs * (rr - tt) + (cc - ss) * rt
        hessian[1, 1] += ss * rr + 2.0 * cs * rt + cc * tt
        hessian[0, 2] += c * rz - s * tz
        hessian[1, 2] += s * rz + c * tz
        hessian[2, 2] += zz
        hessian[0, 3] += cc * r_p - cs * (r_o + t_p) + ss * t_o
        hessian[0, 4] += cc * r_o + cs * (r_p - t_o) - ss * t_p
        hessian[1, 3] += cc * t_p + cs * (r_p - t_o) - ss * r_o
        hessian[1, 4] += cc * t_o + cs * (r_o + t_p) + ss * r_p
        hessian[2, 3] += c * z_p - s * z_o
        hessian[2, 4] += c * z_o + s * z_p
        hessian[3, 3] += ss * oo - 2.0 * cs * op + cc * pp
        hessian[3, 4] += cs * (pp - oo) + (cc - ss) * op
        hessian[4, 4] += cc * oo + 2.0 * cs * op + ss * pp
    for a in range(5):
        for b in range(a):
            hessian[a, b] = hessian[b, a]
    return energy, total


@njit(cache=True, nogil=True)
def cholesky_solve(matrix, shift, rhs, factor, out):
    """Solve (matrix + shift·1) out = rhs for a 5 × 5 matrix.

    Returns the smallest pivot over the largest diagonal term; the solution is not formed where it
    is below 1e-13, i.e. where the matrix is singular to rounding.
    """
    largest = 0.0
    for a in range(5):
        largest = max(largest, matrix[a, a] + shift)
    if largest <= 0.0:
        return 0.0
    smallest = 1.0
    for a in range(5):
        for b in range(a + 1):
            value = matrix[a, b]
            if a == b:
                value += shift
            for k in range(b):
                value -= factor[a, k] * factor[b, k]
            if a == b:
                smallest = min(smallest, value / largest)
                if value <= 1e-13 * largest:
                    return smallest
                factor[a, a] = math.sqrt(value)
            else:
                factor[a, b] = value / factor[b, b]
    for a in range(5):
        value = rhs[a]
        for k in range(a):
            value -= factor[a, k] * out[k]
        out[a] = value / factor[a, a]
    for a in range(4, -1, -1):
        value = out[a]
        for k in range(a + 1, 5):
            value -= factor[k, a] * out[k]
        out[a] = value / factor[a, a]
    return smallest


@njit(cache=True, nogil=True)
def _start(load, cos, sin, table, law, compliance, scale, cap, q):
    """Cold start: the displacement along `compliance · load` whose energy balances its work."""
    exponent = 1.5 if law == POINT else 10.0 / 9.0
    work = 0.0
    largest = 0.0
    for a in range(5):
        q[a] = 0.0
        for b in range(5):
            q[a] += compliance[a, b] * load[b]
    for a in range(5):
        work += q[a] * load[a]
        largest = max(largest, abs(q[a] / scale[a]))
    if largest == 0.0:
        return
    resistance = 0.0
    slack = 0.0
    for i in range(cos.shape[0]):
        c, s = cos[i], sin[i]
        ur, om = q[0] * c + q[1] * s, q[4] * c - q[3] * s
        for k in range(table.shape[0]):
            line = table[k]
            dr, dz = ur + line[HEIGHT] * om, q[2] - line[RADIUS] * om
            approach = line[NORMAL_R] * dr + line[NORMAL_Z] * dz
            gap = line[GAP]
            if law == POINT:
                approach /= line[FREE]
                gap = -gap / (2.0 * line[FREE])
            if approach > 0.0:
                resistance += line[STIFFNESS] * approach ** (1.0 + exponent)
                if gap > 0.0 and (slack == 0.0 or gap / approach < slack):
                    slack = gap / approach
    amplitude = slack
    if resistance > 0.0:
        amplitude += (work / resistance) ** (1.0 / exponent)
    amplitude = min(amplitude, cap / largest)
    for a in range(5):
        q[a] *= amplitude


@njit(cache=True, nogil=True)
def _newton(
    q, load, cos, sin, table, law, spatial, scale, cap, tolerance, limit, compliance, cold, hessian
):
    """Minimise energy - load·q from `q`; returns converged, residual, iterations, singular.

    Newton with the exact Hessian, a Levenberg shift where it is singular, a cap on the step, and
    halving until energy or residual falls. `scale` turns rotations into lengths. The residual is
    the largest unbalanced component over the largest load (or 1e-4 of the sum of contact forces,
    below which rounding rules). Tiny loads with clearance are also settled where the unbalanced
    force is that of the last digits of the displacement.
    """
    gradient, trial, step = np.zeros(5), np.zeros(5), np.zeros(5)
    rhs, q_new = np.zeros(5), np.zeros(5)
    scaled, factor, h_new = np.zeros((5, 5)), np.zeros((5, 5)), np.zeros((5, 5))
    external = 0.0
    for a in range(5):
        external = max(external, abs(load[a] * scale[a]))
    if cold:
        _start(load, cos, sin, table, law, compliance, scale, cap, q)
    energy, total = evaluate(q, cos, sin, table, law, spatial, gradient, hessian)
    iterations = 0
    residual = 0.0
    pivot = 0.0
    largest = 0.0
    moved = 0.0
    while True:
        reference = max(external, 1e-4 * total)
        norm = 0.0
        residual = 0.0
        largest = 0.0
        for a in range(5):
            rhs[a] = (load[a] - gradient[a]) * scale[a]
            norm += rhs[a] * rhs[a]
            residual = max(residual, abs(rhs[a]))
            for b in range(5):
                scaled[a, b] = hessian[a, b] * scale[a] * scale[b]
            largest = max(largest, scaled[a, a])
        residual = residual / reference if reference > 0.0 else 0.0
        pivot = cholesky_solve(scaled, 0.0, rhs, factor, step)
        if residual <= tolerance or iterations == limit:
            break
        iterations += 1
        shift = 1e-10 * largest
        regular = pivot
        while regular <= 1e-13 and largest > 0.0:
            regular = cholesky_solve(scaled, shift, rhs, factor, step)
            shift *= 100.0
        if largest == 0.0:  # nothing touches: go along the load
            for a in range(5):
                step[a] = rhs[a] * cap / math.sqrt(norm)
        longest = 0.0
        slope = 0.0
        moved = 0.0
        for a in range(5):
            longest = max(longest, abs(step[a]))
            slope -= rhs[a] * step[a]
            moved = max(moved, abs(q[a] / scale[a]))
        if longest <= 4.0 * _EPS * moved:
            break
        damping = min(1.0, cap / longest)
        potential = energy
        for a in range(5):
            potential -= load[a] * q[a]
        accepted = False
        for _ in range(30):
            trial_potential = 0.0
            for a in range(5):
                q_new[a] = q[a] + damping * step[a] * scale[a]
                trial_potential -= load[a] * q_new[a]
            new_energy, total = evaluate(q_new, cos, sin, table, law, spatial, trial, h_new)
            trial_potential += new_energy
            new_norm = 0.0
            for a in range(5):
                new_norm += ((load[a] - trial[a]) * scale[a]) ** 2
            if new_norm < norm * (1.0 - 1e-4 * damping) or (
                trial_potential < potential + 1e-4 * damping * slope
            ):
                accepted = True
                break
            damping *= 0.5
        if not accepted:
            break
        energy = new_energy
        q[:] = q_new
        gradient[:] = trial
        hessian[:, :] = h_new
    settled = residual <= tolerance or residual * reference <= 16.0 * _EPS * moved * largest
    return settled, residual, iterations, pivot <= 1e-12


@njit(cache=True, nogil=True)
def solve_series(
    loads, cos, sin, table, law, spatial, scale, cap, tolerance, limit, compliance, chunk
):
    """Equilibrium for each load (n, 5); warm start inside chunks of `chunk` cases.

    A case that fails or is singular from a warm start is solved again from a cold one, so that no
    answer depends on the order of the cases beyond the tolerance. What then still fails (tiny
    loads across a clearance) is reached from a larger load in steps.
    """
    n = loads.shape[0]
    displacement, stiffness = np.zeros((n, 5)), np.zeros((n, 5, 5))
    residual, iterations = np.zeros(n), np.zeros(n, np.int64)
    converged, singular = np.zeros(n, np.bool_), np.zeros(n, np.bool_)
    q = np.zeros(5)
    for i in range(n):
        cold = i % chunk == 0 or not converged[i - 1] or singular[i - 1]
        ok, res, count, free = _newton(
            q, loads[i], cos, sin, table, law, spatial, scale, cap, tolerance, limit, compliance,
            cold, stiffness[i],
        )  # fmt: skip
        if not cold and (free or not ok):
            ok, res, again, free = _newton(
                q, loads[i], cos, sin, table, law, spatial, scale, cap, tolerance, limit,
                compliance, True, stiffness[i],
            )  # fmt: skip
            count += again
        if not ok:
            factor = 1e10
            while factor >= 1.0:
                ok, res, again, free = _newton(
                    q, factor * loads[i], cos, sin, table, law, spatial, scale, cap, tolerance,
                    limit, compliance, factor == 1e10, stiffness[i],
                )  # fmt: skip
                count += again
                factor *= 0.1
        displacement[i] = q
        converged[i], residual[i], iterations[i], singular[i] = ok, res, count, free
    return displacement, stiffness, converged, residual, iterations, singular


@njit(cache=True, nogil=True)
def contact_state(displacement, cos, sin, table, law, spatial):
    """Force and signed angle (from the radial plane) of each contact, (n, kind, element)."""
    n, kinds, count = displacement.shape[0], table.shape[0], cos.shape[0]
    force, angle = np.zeros((n, kinds, count)), np.zeros((n, kinds, count))
    for j in range(n):
        q = displacement[j]
        for i in range(count):
            c, s = cos[i], sin[i]
            ur, ut = q[0] * c + q[1] * s, q[1] * c - q[0] * s
            om, ro = q[4] * c - q[3] * s, q[3] * c + q[4] * s
            for k in range(kinds):
                line = table[k]
                dr, dz = ur + line[HEIGHT] * om, q[2] - line[RADIUS] * om
                dt = spatial * (ut - line[HEIGHT] * ro)
                force[j, k, i] = _contact(line, law, dr, dt, dz)[1]
                if law == LINE:
                    dr = dz = 0.0
                angle[j, k, i] = math.atan2(line[NORMAL_Z] + dz, line[NORMAL_R] + dr)
    return force, angle


@njit(cache=True, nogil=True)
def force_sums(displacement, cos, sin, table, law, spatial, exponents):
    """Largest force (n, kind) and sums of powers of the forces (n, kind, exponent)."""
    n, kinds = displacement.shape[0], table.shape[0]
    largest = np.zeros((n, kinds))
    sums = np.zeros((n, kinds, exponents.shape[0]))
    for j in range(n):
        q = displacement[j]
        for i in range(cos.shape[0]):
            c, s = cos[i], sin[i]
            ur, ut = q[0] * c + q[1] * s, q[1] * c - q[0] * s
            om, ro = q[4] * c - q[3] * s, q[3] * c + q[4] * s
            for k in range(kinds):
                line = table[k]
                force = _contact(
                    line,
                    law,
                    ur + line[HEIGHT] * om,
                    spatial * (ut - line[HEIGHT] * ro),
                    q[2] - line[RADIUS] * om,
                )[1]
                if force > 0.0:
                    largest[j, k] = max(largest[j, k], force)
                    log_force = math.log(force)
                    for e in range(exponents.shape[0]):
                        sums[j, k, e] += math.exp(exponents[e] * log_force)
    return largest, sums
