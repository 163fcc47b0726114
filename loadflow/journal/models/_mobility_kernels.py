"""Compiled loops of the mobility map: look-up, path of the shaft in time, static equilibrium.

The axes of a map are ::

    ξ = −ln(1 − ε)
    χ = 2 atan(tan(δ/2) / k),  k = ((1 − ε)/(1 + ε))^¼,  δ the angle from eccentricity to load
    y = ln(1 + s/s1),  s the load: mean pressure F/(B D) over the map's unit of pressure

so that the narrow range of δ in which an eccentric shaft runs is as wide as the rest. Values are
cubic B-splines on equidistant knots. `motion` holds the radial and tangential velocity of the shaft
against the oil: asinh of velocity / s, without the powers `RADIAL_POWER`,
`TANGENTIAL_POWER` of the gap.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics import convergence
from loadflow.numerics.linked import LINKED, njit

is_small = njit(nogil=True, **LINKED)(convergence.is_small)
stalled = njit(nogil=True, **LINKED)(convergence.stalled)
_FINEST = convergence.rounding_level(1.0)

# entries of `axes`: steps of ξ, χ, y; the scale s1; the largest ξ and s
D_XI, D_CHI, D_Y, S1, XI_MAX, S_MAX = range(6)
# entries of `units`: N of s = 1, clearances per second of velocity 1
LOAD, VELOCITY = range(2)

STRETCH = 0.25  # power in k
RADIAL_POWER, TANGENTIAL_POWER = 1.5, 1.0
_BRACKETS = 60
_BALANCED = 1e-9  # of the logarithm of the ratio of two velocities
_CLOSEST = 1e-9  # of the clearance: gap below which the map is asked as if it were this
_GAMMA = 1.0 / (2.0 + math.sqrt(2.0))
_E32 = 6.0 + math.sqrt(2.0)


@njit(cache=True, nogil=True)
def _weights(place, count, out):
    """Weights of the four coefficients around `place` (in knots); returns the first of them."""
    first = min(max(int(place), 0), count - 4)
    t = place - first
    r = 1.0 - t
    out[0] = r * r * r / 6.0
    out[1] = (3.0 * t * t * (t - 2.0) + 4.0) / 6.0
    out[2] = (3.0 * r * r * (r - 2.0) + 4.0) / 6.0
    out[3] = t * t * t / 6.0
    return first


@njit(cache=True, nogil=True)
def direction(gap, fr, ft):
    """χ of the load (fr, ft) in the frame of an eccentricity 1 − `gap`, −π … π."""
    k = (gap / (2.0 - gap)) ** STRETCH
    size = math.hypot(fr, ft)
    if fr >= 0.0:
        return 2.0 * math.atan2(ft, k * (size + fr))
    return math.copysign(2.0 * math.atan2(size - fr, k * abs(ft)), ft)


@njit(cache=True, nogil=True)
def interpolate(coef, axes, gap, chi, size, out):
    """Fill `out` with the splines `coef` (n_ξ, n_χ, n_y, rows) at 1 − ε, |χ| and s."""
    n_xi, n_chi, n_y, rows = coef.shape
    w_xi, w_chi, w_y = np.empty(4), np.empty(4), np.empty(4)
    i0 = _weights(min(-math.log(gap), axes[XI_MAX]) / axes[D_XI], n_xi, w_xi)
    j0 = _weights(abs(chi) / axes[D_CHI], n_chi, w_chi)
    k0, layers = 0, 1
    w_y[0] = 1.0
    if n_y > 1:
        layers = 4
        k0 = _weights(math.log(1.0 + min(size, axes[S_MAX]) / axes[S1]) / axes[D_Y], n_y, w_y)
    for row in range(rows):
        out[row] = 0.0
    for i in range(4):
        for j in range(4):
            for k in range(layers):
                w = w_xi[i] * w_chi[j] * w_y[k]
                for row in range(rows):
                    out[row] += w * coef[i0 + i, j0 + j, k0 + k, row]


@njit(cache=True, nogil=True)
def _added(motion, axes, units, gap, fr, ft, raw):
    """Velocity where the vectors of rotation and squeeze are added, `motion` (n_ξ, 1, 1, 4).

    Only rotation carries the tangential load; what it does not carry of the radial one, squeeze
    does. Rows: cot β, and the logarithms of 6 ε/(So sin β), 12/So_V(ε), 12/So_V(−ε).
    """
    weights = np.empty(4)
    first = _weights(min(-math.log(gap), axes[XI_MAX]) / axes[D_XI], motion.shape[0], weights)
    for row in range(4):
        raw[row] = 0.0
        for i in range(4):
            raw[row] += weights[i] * motion[first + i, 0, 0, row]
    scale = units[VELOCITY] / units[LOAD]
    left = fr - abs(ft) * raw[0]
    return scale * left * math.exp(raw[2 if left > 0.0 else 3]), scale * ft * math.exp(raw[1])


@njit(cache=True, nogil=True)
def _velocity(motion, axes, units, x, y, fx, fy, omega, raw):
    """Velocity of the shaft at (x, y) under the load (fx, fy), clearances per second."""
    ratio = math.hypot(x, y)
    vx, vy = -0.5 * omega * y, 0.5 * omega * x
    size = math.hypot(fx, fy) / units[LOAD]
    if size > 0.0:
        c, s = (x / ratio, y / ratio) if ratio > 0.0 else (1.0, 0.0)
        gap = max(1.0 - ratio, _CLOSEST)
        fr, ft = c * fx + s * fy, c * fy - s * fx
        if motion.shape[1] == 1:
            ur, ut = _added(motion, axes, units, gap, fr, ft, raw)
        else:
            chi = direction(gap, fr, ft)
            interpolate(motion, axes, gap, chi, size, raw)
            scale = size * units[VELOCITY]
            ur = scale * gap**RADIAL_POWER * math.sinh(raw[0])
            ut = math.copysign(scale * gap**TANGENTIAL_POWER, chi) * math.sinh(raw[1])
        vx += c * ur - s * ut
        vy += s * ur + c * ut
    return vx, vy


@njit(cache=True, nogil=True)
def march(motion, axes, units, time, load, speed, start, tolerance, most, path, slip, steps, error):
    """Path (n, 2) of the shaft from `start`, load and speed linear between the times.

    Rosenbrock's linearly implicit formula of second order with an estimate of third order
    [Shampine & Reichelt 1997], L-stable, its Jacobian by differences; the step is cut until its
    error is below `tolerance` of the narrowest gap. Fills `slip` (n, 2), the velocity against the
    oil, and `steps` and the largest `error` of each interval; returns the interval that needs
    more than `most` steps, or −1.
    """
    raw = np.empty(4)
    x, y = start[0], start[1]
    path[0, 0], path[0, 1] = x, y
    vx, vy = _velocity(motion, axes, units, x, y, load[0, 0], load[0, 1], 0.0, raw)
    slip[0, 0], slip[0, 1] = vx, vy
    length = time[1] - time[0] if time.size > 1 else 0.0
    for n in range(1, time.size):
        whole = time[n] - time[n - 1]
        slope_x = (load[n, 0] - load[n - 1, 0]) / whole
        slope_y = (load[n, 1] - load[n - 1, 1]) / whole
        slope_w = (speed[n] - speed[n - 1]) / whole
        done, count, worst = 0.0, 0, 0.0
        f0x, f0y = _velocity(
            motion, axes, units, x, y, load[n - 1, 0], load[n - 1, 1], speed[n - 1], raw
        )
        while done < whole:
            count += 1
            if count > most:
                return n
            h = min(length, whole - done)
            if whole - done - h < 1e-9 * whole:
                h = whole - done
            fx, fy = load[n - 1, 0] + slope_x * done, load[n - 1, 1] + slope_y * done
            w = speed[n - 1] + slope_w * done
            gap = max(1.0 - math.hypot(x, y), _CLOSEST)
            # derivatives by position and by time
            d = 1e-5 * gap
            ax, ay = _velocity(motion, axes, units, x + d, y, fx, fy, w, raw)
            bx, by = _velocity(motion, axes, units, x, y + d, fx, fy, w, raw)
            k = h * _GAMMA / d
            a11, a21 = 1.0 - k * (ax - f0x), -k * (ay - f0y)
            a12, a22 = -k * (bx - f0x), 1.0 - k * (by - f0y)
            det = a11 * a22 - a12 * a21
            dt = 1e-3 * h
            ax, ay = _velocity(
                motion, axes, units, x, y,
                fx + slope_x * dt, fy + slope_y * dt, w + slope_w * dt, raw,
            )  # fmt: skip
            tx, ty = h * _GAMMA * (ax - f0x) / dt, h * _GAMMA * (ay - f0y) / dt
            # three stages
            rx, ry = f0x + tx, f0y + ty
            k1x, k1y = (a22 * rx - a12 * ry) / det, (a11 * ry - a21 * rx) / det
            f1x, f1y = _velocity(
                motion, axes, units, x + 0.5 * h * k1x, y + 0.5 * h * k1y,
                fx + 0.5 * h * slope_x, fy + 0.5 * h * slope_y, w + 0.5 * h * slope_w, raw,
            )  # fmt: skip
            rx, ry = f1x - k1x, f1y - k1y
            k2x = (a22 * rx - a12 * ry) / det + k1x
            k2y = (a11 * ry - a21 * rx) / det + k1y
            nx, ny = x + h * k2x, y + h * k2y
            f2x, f2y = _velocity(
                motion, axes, units, nx, ny,
                fx + h * slope_x, fy + h * slope_y, w + h * slope_w, raw,
            )  # fmt: skip
            rx = f2x - _E32 * (k2x - f1x) - 2.0 * (k1x - f0x) + tx
            ry = f2y - _E32 * (k2y - f1y) - 2.0 * (k1y - f0y) + ty
            k3x, k3y = (a22 * rx - a12 * ry) / det, (a11 * ry - a21 * rx) / det
            wrong = h / 6.0 * math.hypot(k1x - 2.0 * k2x + k3x, k1y - 2.0 * k2y + k3y) / gap
            room = 1.0 - math.hypot(nx, ny)
            # ends nearer than a third of the gap are not trusted, whatever the estimate
            if wrong <= tolerance and det > 0.0 and room > 0.3 * gap:
                x, y, f0x, f0y = nx, ny, f2x, f2y
                done += h
                worst = max(worst, wrong)
                length = h * min(4.0, 0.9 * (tolerance / max(wrong, 1e-12)) ** (1.0 / 3.0))
            else:
                share = 0.9 * (tolerance / max(wrong, 1e-12)) ** (1.0 / 3.0)
                length = h * min(0.5, max(0.1, share))
        path[n, 0], path[n, 1] = x, y
        slip[n, 0], slip[n, 1] = f0x + 0.5 * speed[n] * y, f0y - 0.5 * speed[n] * x
        steps[n], error[n] = count, worst
    return -1


@njit(cache=True, nogil=True)
def _steady_direction(motion, axes, gap, size, raw):
    """χ > 0 at which the radial velocity, which falls from 0 to π, vanishes: Illinois rule."""
    low, high, side = 0.0, math.pi, 0
    interpolate(motion, axes, gap, low, size, raw)
    at_low = raw[0]
    interpolate(motion, axes, gap, high, size, raw)
    at_high = raw[0]
    chi = 0.0
    for _ in range(_BRACKETS):
        chi = high - at_high * (high - low) / (at_high - at_low)
        interpolate(motion, axes, gap, chi, size, raw)
        if abs(raw[0]) < 1e-11 or high - low < 1e-11:
            break
        if raw[0] > 0.0:
            low, at_low = chi, raw[0]
            at_high *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            high, at_high = chi, raw[0]
            at_low *= 0.5 if side < 0 else 1.0
            side = -1
    return chi


@njit(cache=True, nogil=True)
def _surplus(motion, axes, xi, size, wanted, raw):
    """Logarithm of tangential velocity over flow of the oil at the steady direction, and that."""
    gap = math.exp(-xi)
    chi = _steady_direction(motion, axes, gap, size, raw)
    flow = wanted * max(-math.expm1(-xi), 1e-12)
    lead = size * gap**TANGENTIAL_POWER * math.sinh(raw[1])
    return math.log(max(lead, 1e-300) / flow), chi


@njit(cache=True, nogil=True)
def steady(motion, axes, units, size, speed, gap, chi, iterations, residual):
    """Fill `gap` and `chi` (> 0) (n,) of the shaft at rest under loads s > 0 and speeds > 0.

    The tangential velocity of the map then balances the flow of the oil, ω ε / 2; `residual` is
    the logarithm of their ratio. A bracket that has closed to the rounding of its ends is an
    answer as well. `iterations` is 0 where there is none: beyond the map, or out of patience.
    """
    raw, finest = np.empty(2), _FINEST * axes[XI_MAX]
    for n in range(size.size):
        wanted = 0.5 * speed[n] / units[VELOCITY]
        low, high, side = 0.0, axes[XI_MAX], 0
        at_low, _ = _surplus(motion, axes, low, size[n], wanted, raw)
        at_high, turn = _surplus(motion, axes, high, size[n], wanted, raw)
        xi, here = high, at_high
        if at_high < 0.0:
            for iterations[n] in range(1, _BRACKETS + 1):
                xi = high - at_high * (high - low) / (at_high - at_low)
                here, turn = _surplus(motion, axes, xi, size[n], wanted, raw)
                if is_small(abs(here), _BALANCED, 0.0) or stalled(high - low, finest):
                    break
                if here > 0.0:
                    low, at_low = xi, here
                    at_high *= 0.5 if side > 0 else 1.0
                    side = 1
                else:
                    high, at_high = xi, here
                    at_low *= 0.5 if side < 0 else 1.0
                    side = -1
            else:
                iterations[n] = 0
        gap[n], chi[n], residual[n] = math.exp(-xi), turn, abs(here)


@njit(cache=True, nogil=True)
def along(coef, axes, position, load, place, out):
    """Fill `out` (n, rows) with the splines at positions (n, 2) and loads (n, 2) in units of s.

    `place` (n, 3) gets 1 − ε, χ and s.
    """
    for n in range(out.shape[0]):
        x, y = position[n, 0], position[n, 1]
        ratio = math.hypot(x, y)
        c, s = (x / ratio, y / ratio) if ratio > 0.0 else (1.0, 0.0)
        fx, fy = load[n, 0], load[n, 1]
        place[n, 0] = max(1.0 - ratio, _CLOSEST)
        place[n, 1] = direction(place[n, 0], c * fx + s * fy, c * fy - s * fx)
        place[n, 2] = math.hypot(fx, fy)
        interpolate(coef, axes, place[n, 0], place[n, 1], place[n, 2], out[n])
