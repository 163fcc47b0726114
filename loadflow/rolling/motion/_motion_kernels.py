"""Compiled steps of the rollers' spin under friction of films: implicit, each roller its own."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from loadflow.rolling.friction import rolling_resistance
from loadflow.tribology import asperities, contact_film, traction

_moes_line = njit(cache=True, error_model="numpy")(contact_film.moes_line)
_thermal_factor = njit(cache=True, error_model="numpy")(contact_film.thermal_factor)
_asperity_share = njit(cache=True, error_model="numpy")(asperities.asperity_share)
_limiting_stress = njit(cache=True, error_model="numpy")(traction.limiting_stress)
_inlet_force = njit(cache=True, error_model="numpy")(traction.inlet_force)
_hydrodynamic_force = njit(cache=True, error_model="numpy")(rolling_resistance.hydrodynamic_force)
_elastic_force = njit(cache=True, error_model="numpy")(rolling_resistance.elastic_force)

CREEP = 1e-6  # slip over surface speed below which the shape of traction is not resolved
_BOUNDARY_SPEED = 1e-3  # m/s, over which the friction of asperities turns round
_REST = 1e-3  # of the ideal spin: over it what brakes the roller turns round
_PART = 1.0 - math.sqrt(0.5)  # of the step, of Alexander's L-stable method of order 2
_FLOOR = 1e-4  # shortest step over the interval of the samples


class Film(NamedTuple):
    """Numbers of oil and contact; `regimes` takes films and forces of all regimes (Moes), else
    the power law `factor` G^`material` U^`speed` W^-`load`.
    """

    viscosity: float
    pressure_viscosity: float
    heating: float
    starvation: float
    critical_stress: float
    critical_pressure: float
    limiting_slope: float
    roughness: float
    boundary: float
    hysteresis: float
    modulus: float
    length: float
    radius: float
    gamma: float
    inertia: float
    pocket: float
    spin_drag: float
    orbit_drag: float
    regimes: bool
    factor: float
    material: float
    speed: float
    load: float


class Contact(NamedTuple):
    """Friction of one contact at given load and mean speed."""

    limit: float  # traction of the film at its limiting stress, N
    core: float  # slip speed over which it turns round, m/s
    rubbing: float  # friction of asperities, N
    inlet: float  # traction of the wedge over the slip speed, N s/m
    rolling: float  # rolling force on each surface, N
    film: float  # m
    area: float  # m²


@njit(cache=True, nogil=True, error_model="numpy")
def contact(film, load, radius, mean):
    """Friction of one contact; a roller that is not pressed on has none."""
    if load <= 0.0:
        return Contact(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    u = max(mean, 1e-9)
    area = (
        2.0 * film.length * math.sqrt(8.0 * load * radius / (math.pi * film.length * film.modulus))
    )
    pressure = load / area
    g = film.pressure_viscosity * film.modulus
    us = film.viscosity * u / (film.modulus * radius)
    ws = load / (film.modulus * radius * film.length)
    share = film.starvation * _thermal_factor(film.heating * u * u)
    if film.regimes:
        ratio = _moes_line(g, us, ws)
        rolling = _hydrodynamic_force(
            load, film.length, radius, u, film.viscosity, film.pressure_viscosity, film.modulus
        )
    else:
        ratio = film.factor * g**film.material * us**film.speed * ws**-film.load
        rolling = _elastic_force(
            load, film.length, radius, u, film.viscosity, film.pressure_viscosity, film.modulus
        )
    height = share * ratio * radius
    rough = _asperity_share(height / film.roughness)
    stress = _limiting_stress(
        pressure, film.critical_stress, film.critical_pressure, film.limiting_slope
    )
    thick = film.viscosity * math.exp(min(film.pressure_viscosity * pressure, 40.0))
    gap = max(height, film.roughness)
    inlet = 0.0
    if film.regimes:
        inlet = _inlet_force(1.0, film.viscosity, film.length, radius, gap)
    hysteresis = film.hysteresis * load * area / film.length / (6.0 * math.pi * radius)
    return Contact(
        (1.0 - rough) * stress * area,
        max(stress * height / thick, CREEP * u),
        rough * film.boundary * load,
        inlet,
        share * rolling + hysteresis,
        height,
        area,
    )


@njit(cache=True, nogil=True, error_model="numpy")
def pull(c, slip):
    """Traction of one contact on the roller, N, and its slope over the slip speed."""
    a, b = math.tanh(slip / c.core), math.tanh(slip / _BOUNDARY_SPEED)
    force = c.limit * a + c.rubbing * b + c.inlet * slip
    slope = c.limit * (1.0 - a * a) / c.core + c.rubbing * (1.0 - b * b) / _BOUNDARY_SPEED
    return force, slope + c.inlet


@njit(cache=True, nogil=True, error_model="numpy")
def both_contacts(film, surface, spin, load, outward):
    """Contacts with inner and outer ring of a roller that spins with `spin`."""
    mean = abs(surface + film.radius * spin) / 2.0
    return (
        contact(film, load + max(-outward, 0.0), film.radius * (1.0 - film.gamma), mean),
        contact(film, load + max(outward, 0.0), film.radius * (1.0 + film.gamma), mean),
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _turn(surface, spin, radius):
    """Sense in which a roller turns, ±1, through 0 where it rests in its pocket.

    What brakes a roller cannot turn it back: the lower limit 0 of (5.100).
    """
    return math.tanh(spin * radius / max(_REST * abs(surface), 1e-6))


@njit(cache=True, nogil=True, error_model="numpy")
def cage_push(film, inner, outer, turn, slip, tangential):
    """Force of the cage on the roller, in the sense of turning, N (`friction.energy`)."""
    pull_i, _ = pull(inner, slip)
    pull_o, _ = pull(outer, slip)
    lean_i, lean_o = 2.0 * (1.0 - film.gamma), 2.0 * (1.0 + film.gamma)
    on_roller = pull_i - pull_o
    on_roller += turn * ((lean_i - 1.0) * inner.rolling - (lean_o - 1.0) * outer.rolling)
    return tangential - on_roller


@njit(cache=True, nogil=True, error_model="numpy")
def _balance(film, inner, outer, surface, steady, tangential, slip):
    """Moment on the roller at a slip speed for given contacts, and its slope; N m, N s.

    `steady` is the moment against the spin that no slip changes. The slope is positive: the cage
    pushes with the difference of the tractions, of which the pocket rubs only a small share.
    """
    rho = film.radius
    spin = (surface - slip) / rho
    turn = _turn(surface, spin, rho)
    fade = -(1.0 - turn * turn) / max(_REST * abs(surface), 1e-6)
    pull_i, slope_i = pull(inner, slip)
    pull_o, slope_o = pull(outer, slip)
    leaning = (1.0 - 2.0 * film.gamma) * inner.rolling - (1.0 + 2.0 * film.gamma) * outer.rolling
    push = tangential - (pull_i - pull_o + turn * leaning)
    brake = rho * (film.pocket * abs(push) + inner.rolling + outer.rolling)
    moment = rho * (pull_i + pull_o) - steady - film.spin_drag * spin - brake * turn
    rubbing = rho * film.pocket * math.copysign(1.0, push)
    slope = rho * (slope_i + slope_o) + film.spin_drag / rho - brake * fade
    return moment, slope + rubbing * (slope_i - slope_o + fade * leaning) * turn


@njit(cache=True, nogil=True, error_model="numpy")
def roller_moment(film, surface, turning, swing, load, outward, tangential, spin):
    """Moment on a roller, N m: its inertia times the rate of the spin."""
    inner, outer = both_contacts(film, surface, spin, load, outward)
    steady = film.orbit_drag * turning - film.inertia * swing
    slip = surface - film.radius * spin
    return _balance(film, inner, outer, surface, steady, tangential, slip)[0]


@njit(cache=True, nogil=True, error_model="numpy")
def _slip_of_stage(film, inner, outer, surface, steady, tangential, known, part):
    """Slip speed at which spin = known + part × moment, for given contacts.

    The excess falls everywhere at least as steeply as 1/ρ, so that one value of it bounds the root;
    Newton's method inside the bounds, started within the core of the traction if that can hold.
    """
    rho = film.radius
    moment, _ = _balance(film, inner, outer, surface, steady, tangential, 0.0)
    excess = surface / rho - known - part * moment
    strong = inner.limit + outer.limit
    core = min(inner.core, outer.core)
    wanted = excess / (part * rho)
    if abs(wanted) < strong:
        slip = core * math.atanh(0.999999 * wanted / strong)
    else:
        slip = rho * (excess - part * rho * math.copysign(strong, wanted))
    low, high = min(0.0, rho * excess), max(0.0, rho * excess)
    scale = 1e-11 * max(abs(surface), 1e-9) / rho
    last = math.inf
    for _ in range(120):
        if not low <= slip <= high:
            slip = 0.5 * (low + high)
        moment, slope = _balance(film, inner, outer, surface, steady, tangential, slip)
        excess = (surface - slip) / rho - known - part * moment
        if abs(excess) <= scale or high - low <= 1e-15 * max(abs(surface), 1e-9):
            return slip
        if excess > 0.0:
            low = slip
        else:
            high = slip
        if abs(excess) > 0.5 * last:
            slip = 0.5 * (low + high)
        else:
            slip += excess / (1.0 / rho + part * slope)
        last = abs(excess)
    return slip


@njit(cache=True, nogil=True, error_model="numpy")
def _stage(film, state, known, part, guess, tally):
    """Spin of an implicit stage: contacts at a spin, slip in closed contacts, until both agree.

    `state` is (surface, turning, swing, load, outward, tangential). The films feel the mean speed
    alone, which slip at most halves; still thin films on long steps feel it enough for plain
    iteration to swing, so that secants inside the bounds found so far take over.
    """
    surface, turning, swing, load, outward, tangential = state
    steady = film.orbit_drag * turning - film.inertia * swing
    spin = guess
    scale = max(abs(surface), 1e-9) / film.radius
    low, high = -math.inf, math.inf
    before = last = math.nan
    for _ in range(60):
        inner, outer = both_contacts(film, surface, spin, load, outward)
        slip = _slip_of_stage(film, inner, outer, surface, steady, tangential, known, part)
        found = (surface - slip) / film.radius
        gap = found - spin
        tally[0] += 1
        if abs(gap) <= 1e-7 * scale:
            tally[2] = max(tally[2], abs(gap) / scale)
            return found, inner, outer
        if gap > 0.0:
            low = max(low, spin)
        else:
            high = min(high, spin)
        guess = found
        if last != gap and not math.isnan(last):
            guess = spin - gap * (spin - before) / (gap - last)
        if not low < guess < high:
            guess = 0.5 * (low + high) if high - low < math.inf else found
        before, last, spin = spin, gap, guess
    tally[1] += 1
    tally[2] = max(tally[2], abs(gap) / scale)
    return found, inner, outer


@njit(cache=True, nogil=True, error_model="numpy")
def film_spins(film, time, surface, turning, swing, load, outward, tangential, start, tolerance):
    """Spin of rollers under films, (n, roller), with what slips away in each interval.

    L-stable implicit steps of second order, as short as the error asks for, of each roller on its
    own. Returns spin; energy lost in slip since the last sample, J; largest slip power over the
    contact's area in that time, W/m²; and (rounds, stages without convergence, worst gap between
    the spins of films and balance over the ideal one, steps).
    """
    n, count = load.shape
    spin, energy, density = np.empty((n, count)), np.zeros((n, count)), np.zeros((n, count))
    tally = np.zeros(4)
    for j in range(count):
        w = start[j]
        spin[0, j] = w
        rate = 0.0
        share = 1.0
        for i in range(n - 1):
            span = time[i + 1] - time[i]
            t = 0.0
            while t < 1.0:
                h = min(share, 1.0 - t)
                if t + h > 1.0 - 1e-9:
                    h = 1.0 - t
                part = _PART * h * span / film.inertia
                a = _between(
                    surface, turning, swing, load, outward, tangential, i, j, t + _PART * h
                )
                one, _, _ = _stage(film, a, w, part, w + _PART * h * span * rate, tally)
                first = (one - w) / (_PART * h * span)
                b = _between(surface, turning, swing, load, outward, tangential, i, j, t + h)
                known = w + (1.0 - _PART) * h * span * first
                two, inner, outer = _stage(film, b, known, part, one, tally)
                second = (two - known) / (_PART * h * span)
                scale = tolerance * max(abs(b[0]), 1e-6) / film.radius
                error = _PART * h * span * abs(second - first) / scale
                tally[3] += 1
                if error > 1.0 and h > _FLOOR:
                    share = max(h * max(0.9 / math.sqrt(error), 0.1), _FLOOR)
                    continue
                if error < 1.0:
                    share = min(max(h, share) * min(0.9 / math.sqrt(max(error, 0.05)), 4.0), 1.0)
                w, rate, t = two, second, t + h
                slip = b[0] - film.radius * w
                power_i, power_o = pull(inner, slip)[0] * slip, pull(outer, slip)[0] * slip
                energy[i + 1, j] += (power_i + power_o) * h * span
                worst = max(power_i / inner.area, power_o / outer.area)
                density[i + 1, j] = max(density[i + 1, j], worst)
            spin[i + 1, j] = w
    return spin, energy, density, tally


@njit(cache=True, nogil=True, error_model="numpy")
def _between(surface, turning, swing, load, outward, tangential, i, j, t):
    """What acts on roller j a share t of the way from sample i to the next."""
    s = 1.0 - t
    return (
        s * surface[i] + t * surface[i + 1],
        s * turning[i] + t * turning[i + 1],
        s * swing[i] + t * swing[i + 1],
        s * load[i, j] + t * load[i + 1, j],
        s * outward[i, j] + t * outward[i + 1, j],
        s * tangential[i, j] + t * tangential[i + 1, j],
    )


@njit(cache=True, nogil=True, error_model="numpy")
def forces(film, surface, turning, swing, load, outward, tangential, spin):
    """Forces at given spins, (n, roller, 9).

    Tractions, rolling forces and films at inner and outer ring (N, N, m), moment of the pocket
    against the spin, moment on the roller (N m), force of the cage (N).
    """
    n, count = load.shape
    out = np.empty((n, count, 9))
    for i in range(n):
        for j in range(count):
            w = spin[i, j]
            slip = surface[i] - film.radius * w
            inner, outer = both_contacts(film, surface[i], w, load[i, j], outward[i, j])
            steady = film.orbit_drag * turning[i] - film.inertia * swing[i]
            turn = _turn(surface[i], w, film.radius)
            push = cage_push(film, inner, outer, turn, slip, tangential[i, j])
            out[i, j, 0], out[i, j, 1] = pull(inner, slip)[0], pull(outer, slip)[0]
            out[i, j, 2], out[i, j, 3] = turn * inner.rolling, turn * outer.rolling
            out[i, j, 4], out[i, j, 5] = inner.film, outer.film
            out[i, j, 6] = turn * film.pocket * film.radius * abs(push)
            out[i, j, 7], _ = _balance(
                film, inner, outer, surface[i], steady, tangential[i, j], slip
            )
            out[i, j, 8] = push
    return out
