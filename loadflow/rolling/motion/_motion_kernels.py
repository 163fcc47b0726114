"""Compiled steps of the rollers' spin under friction of films: implicit, each roller its own."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from loadflow.numerics.linked import LINKED, njit
from loadflow.rolling.friction import rolling_resistance
from loadflow.rolling.friction.rolling_resistance import ELASTIC_POWER
from loadflow.tribology import asperities, contact_film, traction
from loadflow.tribology.asperities import SHARE_POWER
from loadflow.tribology.contact_film import HEAT_POWER

_moes_line = njit(error_model="numpy", **LINKED)(contact_film.moes_line_exponent)
_thermal_factor = njit(error_model="numpy", **LINKED)(contact_film.thermal_factor)
_asperity_share = njit(error_model="numpy", **LINKED)(asperities.asperity_share)
_limiting_stress = njit(error_model="numpy", **LINKED)(traction.limiting_stress)
_inlet_force = njit(error_model="numpy", **LINKED)(traction.inlet_force)
_elastic_force = njit(error_model="numpy", **LINKED)(rolling_resistance.elastic_force)
_rigid_force = njit(error_model="numpy", **LINKED)(rolling_resistance.rigid_force)
_hydrodynamic_force = njit(error_model="numpy", **LINKED)(rolling_resistance.hydrodynamic_force)

CREEP = 1e-6  # slip over surface speed below which the shape of traction is not resolved
_BOUNDARY_SPEED = 1e-3  # m/s, over which the friction of asperities turns round
_REST = 1e-3  # of the ideal spin: over it what brakes the roller turns round
_PART = 1.0 - math.sqrt(0.5)  # of the step, of Alexander's L-stable method of order 2
_NEAR = 0.1  # of the mean speed: as far as contacts follow it in a line
_CLOSE = 3e-4  # of the ideal spin: gap of a stage whose contacts need not be made again
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
    """Friction of one contact at given load and mean speed, or its slopes over the mean speed."""

    limit: float  # traction of the film at its limiting stress, N
    core: float  # slip speed over which it turns round, m/s
    rubbing: float  # friction of asperities, N
    inlet: float  # traction of the wedge over the slip speed, N s/m
    rolling: float  # rolling force on each surface, N
    film: float  # m
    area: float  # m²


class Contacts(NamedTuple):
    """Contacts of a roller with inner and outer ring at a mean speed, and their slopes over it."""

    inner: Contact
    outer: Contact
    inner_slope: Contact
    outer_slope: Contact
    mean: float


@njit(nogil=True, error_model="numpy", **LINKED)
def contact(film, load, radius, u, cooled):
    """Friction of one contact and its slopes; a roller that is not pressed on has none.

    `cooled` is the share of the film that heat of the inlet leaves at the mean speed `u`.
    """
    if load <= 0.0:
        return Contact(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0), Contact(
            0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        )
    area = (
        2.0 * film.length * math.sqrt(8.0 * load * radius / (math.pi * film.length * film.modulus))
    )
    pressure = load / area
    g = film.pressure_viscosity * film.modulus
    us = film.viscosity * u / (film.modulus * radius)
    ws = load / (film.modulus * radius * film.length)
    share, grows_share = film.starvation * cooled, 2.0 * HEAT_POWER * (cooled - 1.0)
    given = film.length, radius, u, film.viscosity, film.pressure_viscosity, film.modulus
    if film.regimes:
        ratio, grows = _moes_line(g, us, ws)
        rolling = _hydrodynamic_force(load, *given)
        # between the powers of the elastic film and of the rigid one, a half
        rigid = (rolling / _rigid_force(load, film.length, u, film.viscosity)) ** 4
        grows_rolling = ELASTIC_POWER - (ELASTIC_POWER - 0.5) * rigid
    else:
        ratio = film.factor * g**film.material * us**film.speed * ws**-film.load
        rolling = _elastic_force(load, *given)
        grows, grows_rolling = film.speed, ELASTIC_POWER
    height = share * ratio * radius
    grows += grows_share
    rough = _asperity_share(height / film.roughness)
    grows_rough = SHARE_POWER * math.log(max(rough, 1e-300)) * grows
    stress = _limiting_stress(
        pressure, film.critical_stress, film.critical_pressure, film.limiting_slope
    )
    thick = film.viscosity * math.exp(min(film.pressure_viscosity * pressure, 40.0))
    core, creep = stress * height / thick, CREEP * u
    inlet, gap = 0.0, max(height, film.roughness)
    if film.regimes:
        inlet = _inlet_force(1.0, film.viscosity, film.length, radius, gap)
    hysteresis = film.hysteresis * load * area / film.length / (6.0 * math.pi * radius)
    rubbing = rough * film.boundary * load
    here = Contact(
        (1.0 - rough) * stress * area,
        max(core, creep),
        rubbing,
        inlet,
        share * rolling + hysteresis,
        height,
        area,
    )
    slopes = Contact(
        -rough * grows_rough * stress * area / u,
        max(core * grows, creep) / u if core > creep else CREEP,
        rubbing * grows_rough / u,
        -0.5 * inlet * grows / u if height > film.roughness else 0.0,
        share * rolling * (grows_rolling + grows_share) / u,
        height * grows / u,
        0.0,
    )
    return here, slopes


@njit(nogil=True, error_model="numpy", **LINKED)
def _tanh(x):
    """Hyperbolic tangent to rounding of 1: one exponential takes a quarter of its time."""
    if abs(x) > 20.0:
        return math.copysign(1.0, x)
    power = math.exp(2.0 * x)
    return (power - 1.0) / (power + 1.0)


@njit(nogil=True, error_model="numpy", **LINKED)
def _pull(c, slopes, slip, rubs):
    """Traction of one contact, N, and its slopes over slip and mean speed.

    `rubs` is the share of the friction of asperities at this slip.
    """
    a = _tanh(slip / c.core)
    turning = c.limit * (1.0 - a * a) / c.core
    over_slip = turning + c.rubbing * (1.0 - rubs * rubs) / _BOUNDARY_SPEED + c.inlet
    over_mean = slopes.limit * a + slopes.rubbing * rubs + slopes.inlet * slip
    force = c.limit * a + c.rubbing * rubs + c.inlet * slip
    return force, over_slip, over_mean - turning * slip / c.core * slopes.core


@njit(nogil=True, error_model="numpy", **LINKED)
def pull(c, slip):
    """Traction of one contact on the roller, N."""
    return (
        c.limit * _tanh(slip / c.core) + c.rubbing * _tanh(slip / _BOUNDARY_SPEED) + c.inlet * slip
    )


@njit(cache=True, nogil=True, error_model="numpy")
def both_contacts(film, surface, spin, load, outward):
    """Contacts with inner and outer ring of a roller that spins with `spin`."""
    rho = film.radius
    mean = max(abs(surface + rho * spin) / 2.0, 1e-9)
    at = mean, _thermal_factor(film.heating * mean * mean)
    inner, inner_slope = contact(film, load + max(-outward, 0.0), rho * (1.0 - film.gamma), *at)
    outer, outer_slope = contact(film, load + max(outward, 0.0), rho * (1.0 + film.gamma), *at)
    return Contacts(inner, outer, inner_slope, outer_slope, mean)


@njit(nogil=True, error_model="numpy", **LINKED)
def _moved(c, slopes, change):
    """A contact after a small change of the mean speed."""
    return Contact(
        c.limit + slopes.limit * change,
        c.core + slopes.core * change,
        c.rubbing + slopes.rubbing * change,
        c.inlet + slopes.inlet * change,
        c.rolling + slopes.rolling * change,
        c.film + slopes.film * change,
        c.area,
    )


@njit(nogil=True, error_model="numpy", **LINKED)
def _turn(surface, spin, radius):
    """Sense in which a roller turns, ±1, through 0 where it rests in its pocket.

    What brakes a roller cannot turn it back: the lower limit 0 of (5.100).
    """
    return _tanh(spin * radius / max(_REST * abs(surface), 1e-6))


@njit(cache=True, nogil=True, error_model="numpy")
def cage_push(film, inner, outer, turn, slip, tangential):
    """Force of the cage on the roller, in the sense of turning, N (`friction.energy`)."""
    lean_i, lean_o = 2.0 * (1.0 - film.gamma), 2.0 * (1.0 + film.gamma)
    on_roller = pull(inner, slip) - pull(outer, slip)
    on_roller += turn * ((lean_i - 1.0) * inner.rolling - (lean_o - 1.0) * outer.rolling)
    return tangential - on_roller


@njit(cache=True, nogil=True, error_model="numpy")
def _balance(film, contacts, surface, steady, tangential, slip):
    """Moment on the roller at a slip speed, N m, its slope, N s, and both tractions together, N.

    Contacts follow their mean speed in a line, up to `_NEAR` of it. `steady` is the moment against
    the spin that no slip changes. The slope is positive: the cage pushes with the difference of the
    tractions, of which the pocket rubs only a small share.
    """
    inner, outer, inner_slope, outer_slope, at = contacts
    rho = film.radius
    mean = surface - 0.5 * slip
    follows = -0.5 if mean > 0.0 else 0.5
    change = abs(mean) - at
    if abs(change) > _NEAR * at:
        change, follows = math.copysign(_NEAR * at, change), 0.0
    spin = (surface - slip) / rho
    turn = _turn(surface, spin, rho)
    fade = -(1.0 - turn * turn) / max(_REST * abs(surface), 1e-6)
    rubs = _tanh(slip / _BOUNDARY_SPEED)
    inner, outer = _moved(inner, inner_slope, change), _moved(outer, outer_slope, change)
    pull_i, slope_i, over_i = _pull(inner, inner_slope, slip, rubs)
    pull_o, slope_o, over_o = _pull(outer, outer_slope, slip, rubs)
    slope_i += follows * over_i
    slope_o += follows * over_o
    lean_i, lean_o = 1.0 - 2.0 * film.gamma, 1.0 + 2.0 * film.gamma
    leaning = lean_i * inner.rolling - lean_o * outer.rolling
    push = tangential - (pull_i - pull_o + turn * leaning)
    brake = rho * (film.pocket * abs(push) + inner.rolling + outer.rolling)
    moment = rho * (pull_i + pull_o) - steady - film.spin_drag * spin - brake * turn
    rubbing = rho * film.pocket * math.copysign(1.0, push)
    slope = rho * (slope_i + slope_o) + film.spin_drag / rho - brake * fade
    slope -= rho * follows * turn * (inner_slope.rolling + outer_slope.rolling)
    leaning_slope = follows * (lean_i * inner_slope.rolling - lean_o * outer_slope.rolling)
    slope += rubbing * (slope_i - slope_o + fade * leaning + turn * leaning_slope) * turn
    return moment, slope, pull_i + pull_o


@njit(nogil=True, error_model="numpy", **LINKED)
def _slip_of_stage(film, contacts, surface, steady, tangential, known, part, slip):
    """Slip speed at which spin = known + part × moment, for given contacts, from a guess.

    The excess falls at least as steeply as 1/ρ, so that one value of it bounds the root; Newton's
    method inside the bounds. Where the guess is outside of the core of the traction in which the
    root is, the first step follows the curve of the traction in place of its tangent.
    """
    rho = film.radius
    strong = contacts.inner.limit + contacts.outer.limit
    core = min(contacts.inner.core, contacts.outer.core)
    low, high = -math.inf, math.inf
    scale = 1e-10 * max(abs(surface), 1e-9) / rho
    last = math.inf
    for _ in range(120):
        moment, slope, pulled = _balance(film, contacts, surface, steady, tangential, slip)
        excess = (surface - slip) / rho - known - part * moment
        if abs(excess) <= scale or high - low <= 1e-15 * max(abs(surface), 1e-9):
            return slip
        if excess > 0.0:
            low, high = max(low, slip), min(high, slip + 2.0 * rho * excess)
        else:
            low, high = max(low, slip + 2.0 * rho * excess), min(high, slip)
        step = excess / (1.0 / rho + part * slope)
        if last == math.inf and abs(step) > 0.5 * core:
            wanted = pulled + excess / (part * rho)
            if abs(wanted) < strong:
                slip = core * math.atanh(0.999999 * wanted / strong)
            else:
                slip += rho * (excess - part * rho * (math.copysign(strong, wanted) - pulled))
        elif abs(excess) > 0.5 * last:
            slip = 0.5 * (low + high)
        else:
            slip += step
        if not low <= slip <= high:
            slip = 0.5 * (low + high)
        last = abs(excess)
    return slip


@njit(cache=True, nogil=True, error_model="numpy")
def _stage(film, state, known, part, guess, tally):
    """Spin of an implicit stage: contacts and slopes at a spin, slip in them, until both agree.

    `state` is (surface, turning, swing, load, outward, tangential). The films feel the mean speed
    alone, which slip at most halves; a spin that leaves the bounds found so far is halved back, and
    one that turns about the answer between them, as of a rotor that swings in its brake, too.
    What a line leaves out is of second order: contacts whose mean speed was right to `_CLOSE` are
    right to its square.
    """
    surface, turning, swing, load, outward, tangential = state
    steady = film.orbit_drag * turning - film.inertia * swing
    spin = guess
    scale = max(abs(surface), 1e-9) / film.radius
    low, high = -math.inf, math.inf
    last = math.inf
    for _ in range(60):
        contacts = both_contacts(film, surface, spin, load, outward)
        start = surface - film.radius * spin
        slip = _slip_of_stage(film, contacts, surface, steady, tangential, known, part, start)
        found = (surface - slip) / film.radius
        gap = found - spin
        tally[0] += 1
        if abs(gap) <= _CLOSE * scale:
            tally[2] = max(tally[2], (gap / scale) ** 2)
            break
        if gap > 0.0:
            low = max(low, spin)
        else:
            high = min(high, spin)
        turns = abs(gap) > 0.5 * last and -math.inf < low and high < math.inf
        if turns or not low < found < high:
            found = 0.5 * (low + high)
        spin, last = found, abs(gap)
    else:
        tally[1] += 1
        tally[2] = max(tally[2], abs(gap) / scale)
    change = abs(surface + film.radius * found) / 2.0 - contacts.mean
    inner = _moved(contacts.inner, contacts.inner_slope, change)
    return found, inner, _moved(contacts.outer, contacts.outer_slope, change)


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
                step = _PART * h * span
                part = step / film.inertia
                a = _between(
                    surface, turning, swing, load, outward, tangential, i, j, t + _PART * h
                )
                one, _, _ = _stage(film, a, w, part, w + step * rate, tally)
                first = (one - w) / step
                b = _between(surface, turning, swing, load, outward, tangential, i, j, t + h)
                known = w + (1.0 - _PART) * h * span * first
                guess = known + step * first
                two, inner, outer = _stage(film, b, known, part, guess, tally)
                second = (two - known) / step
                scale = tolerance * max(abs(b[0]), 1e-6) / film.radius
                error = step * abs(second - first) / scale
                tally[3] += 1
                if error > 1.0 and h > _FLOOR:
                    share = max(h * max(0.9 / math.sqrt(error), 0.1), _FLOOR)
                    continue
                if error < 1.0:
                    share = min(max(h, share) * min(0.9 / math.sqrt(max(error, 0.05)), 4.0), 1.0)
                w, rate, t = two, second, t + h
                slip = b[0] - film.radius * w
                power_i, power_o = pull(inner, slip) * slip, pull(outer, slip) * slip
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
            contacts = both_contacts(film, surface[i], w, load[i, j], outward[i, j])
            inner, outer = contacts.inner, contacts.outer
            steady = film.orbit_drag * turning[i] - film.inertia * swing[i]
            turn = _turn(surface[i], w, film.radius)
            push = cage_push(film, inner, outer, turn, slip, tangential[i, j])
            out[i, j, 0], out[i, j, 1] = pull(inner, slip), pull(outer, slip)
            out[i, j, 2], out[i, j, 3] = turn * inner.rolling, turn * outer.rolling
            out[i, j, 4], out[i, j, 5] = inner.film, outer.film
            out[i, j, 6] = turn * film.pocket * film.radius * abs(push)
            out[i, j, 7] = _balance(film, contacts, surface[i], steady, tangential[i, j], slip)[0]
            out[i, j, 8] = push
    return out
