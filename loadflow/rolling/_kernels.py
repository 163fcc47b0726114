"""Compiled loops of the rigid-ring equilibrium.

Unknowns q = (ux, uy, uz, θx, θy): motion of the inner ring relative to the outer. The table of
contacts is described in `loadflow.rolling.contacts`. The elastic energy is convex in q for both
laws, so that its minimum under a load is the one equilibrium.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics import convergence
from loadflow.numerics.linked import LINKED, njit
from loadflow.rolling._line_law import lever_of, ninth_root
from loadflow.rolling.contacts import (
    FREE,
    GAP,
    HEIGHT,
    NORMAL_R,
    NORMAL_Z,
    POINT,
    RADIUS,
    STIFFNESS,
)

rounding_level = njit(nogil=True, **LINKED)(convergence.rounding_level)
is_small = njit(nogil=True, **LINKED)(convergence.is_small)
stalled = njit(nogil=True, **LINKED)(convergence.stalled)


# Sums may be reordered (so that they use vector units); nothing else of fast mathematics. Loops
# that do so are inlined by force and have no way in from Python: compiled alone and as part of a
# caller they would round differently.
_REORDER = {"reassoc", "contract", "nsz"}


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _add_points(q, cos, sin, line, spatial, gradient, hessian):
    """Add all point contacts of one kind (free of branches); returns energy and sum of forces.

    A contact pushes along g = (n, P × n), n the unit vector between the groove centres and P the
    inner centre: gradient F g, Hessian (F' - F/l) g gᵀ + F/l times the unit tensor over the
    directions that count.
    """
    big, h = line[RADIUS], line[HEIGHT]
    free, stiffness, gap = line[FREE], line[STIFFNESS], line[GAP]
    normal_r, normal_z = line[NORMAL_R], line[NORMAL_Z]
    ux, uy, uz, tx, ty = q[0] + h * q[4], q[1] - h * q[3], q[2], big * q[3], big * q[4]
    energy = total = 0.0
    gx = gy = gz = ga = gb = 0.0
    xx = xy = xz = xa = xb = yy = yz = ya = yb = zz = za = zb = aa = ab = bb = 0.0
    w1 = wc = ws = wcc = wcs = 0.0
    for i in range(cos.shape[0]):
        c, s = cos[i], sin[i]
        dr = ux * c + uy * s
        dt = spatial * (uy * c - ux * s)
        dz = uz + tx * s - ty * c
        stretch = 2.0 * (normal_r * dr + normal_z * dz) + dr * dr + dt * dt + dz * dz + gap
        r, z = normal_r + dr, normal_z + dz
        length = math.sqrt(r * r + dt * dt + z * z)
        delta = max(stretch, 0.0) / (length + free)
        root = stiffness * math.sqrt(delta)
        force = root * delta
        inverse = 1.0 / length
        across = force * inverse
        slope = 1.5 * root - across
        energy += 0.4 * force * delta
        total += force
        nr, nt, nz = r * inverse, dt * inverse, z * inverse
        nx, ny = c * nr - s * nt, s * nr + c * nt
        na, nb = big * s * nz - h * ny, h * nx - big * c * nz
        gx += force * nx
        gy += force * ny
        gz += force * nz
        ga += force * na
        gb += force * nb
        sx, sy, sz, sa = slope * nx, slope * ny, slope * nz, slope * na
        xx += sx * nx
        xy += sx * ny
        xz += sx * nz
        xa += sx * na
        xb += sx * nb
        yy += sy * ny
        yz += sy * nz
        ya += sy * na
        yb += sy * nb
        zz += sz * nz
        za += sz * na
        zb += sz * nb
        aa += sa * na
        ab += sa * nb
        bb += slope * nb * nb
        w1 += across
        wc += across * c
        ws += across * s
        wcc += across * c * c
        wcs += across * c * s
    gradient[0] += gx
    gradient[1] += gy
    gradient[2] += gz
    gradient[3] += ga
    gradient[4] += gb
    hessian[0, 0] += xx
    hessian[0, 1] += xy
    hessian[0, 2] += xz
    hessian[0, 3] += xa
    hessian[0, 4] += xb
    hessian[1, 1] += yy
    hessian[1, 2] += yz
    hessian[1, 3] += ya
    hessian[1, 4] += yb
    hessian[2, 2] += zz
    hessian[2, 3] += za
    hessian[2, 4] += zb
    hessian[3, 3] += aa
    hessian[3, 4] += ab
    hessian[4, 4] += bb
    # the unit tensor: radial and axial, and in space also tangential
    wss = w1 - wcc
    pxx, pxy, pyy = wcc, wcs, wss
    if spatial == 1.0:
        pxx, pxy, pyy = w1, 0.0, w1
    hessian[0, 0] += pxx
    hessian[0, 1] += pxy
    hessian[1, 1] += pyy
    hessian[2, 2] += w1
    hessian[0, 3] -= h * pxy
    hessian[0, 4] += h * pxx
    hessian[1, 3] -= h * pyy
    hessian[1, 4] += h * pxy
    hessian[2, 3] += big * ws
    hessian[2, 4] -= big * wc
    hessian[3, 3] += h * h * pyy + big * big * wss
    hessian[3, 4] -= h * h * pxy + big * big * wcs
    hessian[4, 4] += h * h * pxx + big * big * wcc
    return energy, total


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _add_lines(q, cos, sin, line, gradient, hessian):
    """Add all line contacts of one kind (free of branches); returns energy and sum of forces.

    Their direction (n_r c, n_r s, n_z, -L s, L c), L the lever of the normal, is fixed, so that
    force and slope need only be summed with c and s.
    """
    nr, nz = line[NORMAL_R], line[NORMAL_Z]
    lever = lever_of(line)
    x, y = nr * q[0] + lever * q[4], nr * q[1] - lever * q[3]
    fixed, stiffness = nz * q[2] - line[GAP], line[STIFFNESS]
    energy = f1 = fc = fs = k1 = kc = ks = kcc = kcs = 0.0
    for i in range(cos.shape[0]):
        c, s = cos[i], sin[i]
        delta = max(x * c + y * s + fixed, 0.0)
        slope = stiffness * ninth_root(delta)
        force = slope * delta
        slope *= 10.0 / 9.0
        energy += 9.0 / 19.0 * force * delta
        f1 += force
        fc += force * c
        fs += force * s
        k1 += slope
        kc += slope * c
        ks += slope * s
        kcc += slope * c * c
        kcs += slope * c * s
    kss = k1 - kcc
    gradient[0] += nr * fc
    gradient[1] += nr * fs
    gradient[2] += nz * f1
    gradient[3] -= lever * fs
    gradient[4] += lever * fc
    hessian[0, 0] += nr * nr * kcc
    hessian[0, 1] += nr * nr * kcs
    hessian[0, 2] += nr * nz * kc
    hessian[0, 3] -= nr * lever * kcs
    hessian[0, 4] += nr * lever * kcc
    hessian[1, 1] += nr * nr * kss
    hessian[1, 2] += nr * nz * ks
    hessian[1, 3] -= nr * lever * kss
    hessian[1, 4] += nr * lever * kcs
    hessian[2, 2] += nz * nz * k1
    hessian[2, 3] -= nz * lever * ks
    hessian[2, 4] += nz * lever * kc
    hessian[3, 3] += lever * lever * kss
    hessian[3, 4] -= lever * lever * kcs
    hessian[4, 4] += lever * lever * kcc
    return energy, f1


@njit(cache=True, nogil=True)
def evaluate(q, cos, sin, spans, table, law, spatial, gradient, hessian):
    """Energy of all contacts at `q`; fills its gradient (5,) and Hessian (5, 5).

    Returns the energy and the sum of all contact forces.
    """
    gradient[:] = 0.0
    hessian[:, :] = 0.0
    energy = 0.0
    total = 0.0
    for k in range(table.shape[0]):
        c, s = cos[spans[k, 0] : spans[k, 1]], sin[spans[k, 0] : spans[k, 1]]
        if law == POINT:
            part, forces = _add_points(q, c, s, table[k], spatial, gradient, hessian)
        else:
            part, forces = _add_lines(q, c, s, table[k], gradient, hessian)
        energy += part
        total += forces
    for a in range(5):
        for b in range(a):
            hessian[a, b] = hessian[b, a]
    return energy, total


@njit(nogil=True, error_model="numpy", **LINKED)
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


@njit(nogil=True, error_model="numpy", **LINKED)
def _start(load, cos, sin, spans, table, law, compliance, scale, cap, q):
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
    for k in range(table.shape[0]):
        line = table[k]
        for i in range(spans[k, 0], spans[k, 1]):
            c, s = cos[i], sin[i]
            ur, om = q[0] * c + q[1] * s, q[4] * c - q[3] * s
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


@njit(nogil=True, error_model="numpy", **LINKED)
def _newton(
    q,
    load,
    cos,
    sin,
    spans,
    table,
    law,
    spatial,
    scale,
    cap,
    tolerance,
    limit,
    compliance,
    cold,
    hessian,
):
    """Minimise energy - load·q from `q`.

    Returns converged, residual, iterations, singular, and the rounding level of the residual.

    Newton with the exact Hessian, a Levenberg shift where it is singular, a cap on the step, and
    halving until energy or residual falls. `scale` turns rotations into lengths. The residual is
    the largest unbalanced component over the largest load (or 1e-4 of the sum of contact forces,
    below which rounding rules). Each unbalanced component is small by the rule of `convergence`,
    its rounding that of the last digits of the displacement.
    """
    gradient, trial, step = np.zeros(5), np.zeros(5), np.zeros(5)
    rhs, q_new = np.zeros(5), np.zeros(5)
    scaled, factor, h_new = np.zeros((5, 5)), np.zeros((5, 5)), np.zeros((5, 5))
    external = 0.0
    for a in range(5):
        external = max(external, abs(load[a] * scale[a]))
    if cold:
        _start(load, cos, sin, spans, table, law, compliance, scale, cap, q)
    energy, total = evaluate(q, cos, sin, spans, table, law, spatial, gradient, hessian)
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
        if stalled(longest, rounding_level(moved)):
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
            new_energy, total = evaluate(q_new, cos, sin, spans, table, law, spatial, trial, h_new)
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
        for a in range(5):  # rows at a time take far longer to compile
            q[a], gradient[a] = q_new[a], trial[a]
            for b in range(5):
                hessian[a, b] = h_new[a, b]
    # every contact rounds its own approach: what that leaves in a component need not cancel around
    # the ring, and is bounded by Cauchy–Schwarz; a direction without stiffness feels nothing
    approach = 0.0
    for b in range(5):
        approach += math.sqrt(max(scaled[b, b], 0.0)) * abs(q[b] / scale[b])
    answered, rounding = True, 0.0
    for a in range(5):
        level = rounding_level(math.sqrt(max(scaled[a, a], 0.0)) * approach)
        answered = answered and is_small(abs(rhs[a]), tolerance * reference, level)
        rounding = max(rounding, level / max(reference, 1e-300))
    return answered, residual, iterations, pivot <= 1e-12, rounding


@njit(cache=True, nogil=True, error_model="numpy")
def solve_series(
    loads, cos, sin, spans, table, law, spatial, scale, cap, tolerance, limit, compliance, chunk
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
    rounding = np.zeros(n)
    q, load = np.zeros(5), np.zeros(5)
    for i in range(n):
        warm = i % chunk > 0 and converged[i - 1] and not singular[i - 1]
        ok, res, count, free = False, 0.0, 0, False
        for attempt in range(13):  # warm, cold, then from 1e10 times the load down
            if attempt == 0 and not warm:
                continue
            factor = 1.0 if attempt < 2 else 10.0 ** (12 - attempt)
            for a in range(5):
                load[a] = factor * loads[i, a]
            ok, res, more, free, rounding[i] = _newton(
                q, load, cos, sin, spans, table, law, spatial, scale, cap, tolerance,
                limit, compliance, attempt == 1 or attempt == 2, stiffness[i],
            )  # fmt: skip
            count += more
            if ok and (attempt == 1 or (attempt == 0 and not free)):
                break
        for a in range(5):
            displacement[i, a] = q[a]
        converged[i], residual[i], iterations[i], singular[i] = ok, res, count, free
    return displacement, stiffness, converged, residual, iterations, singular, rounding
