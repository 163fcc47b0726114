"""Compiled: Newton for the film in a rigid cylinder and its shaft, one loop for rest and motion.

What `solve_film` and `solve_equilibrium` do with any film, here without a way back to Python: the
linear algebra of a step takes as long as the calls of its parts would.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import LOAD
from loadflow.journal.film._cylinder_kernels import (
    axes,
    evaluate,
    imbalance,
    level_of,
    linearise,
    no_longer,
    part,
    rounding,
    small_enough,
    store,
)
from loadflow.journal.film._kernels import correct
from loadflow.journal.film.gap._gap_kernels import along_the_gap
from loadflow.journal.film.gap.gap import KEPT
from loadflow.numerics.convergence import COARSEST
from loadflow.numerics.linked import bare
from loadflow.numerics.references import refer

QUADRATIC = 1e-7  # a step this small leaves an error near its square: the last factors are exact
STEP_LIMIT = 0.5  # change of the film, over its pressure, beyond which a step is shortened
NEARLY = 1e-3  # a step this small is followed by the last ones, whose damping is kept
LATE = 8  # Newton steps after which longer steps are asked whether rounding makes them
WAITS = 10.0  # flows that a cell lacks, above which the shaft waits for a rupture with a kink
PRESSED = 1e-13  # narrowest gap, in clearances, that is none
NONE, ANSWERED, ENDED = range(3)  # no film at all, an answer, the last step of an iteration


@bare(cache=True)
def solve(given, u, place, force, free, load_scale, motion, old, tolerance, most):
    """Newton for the unknowns `u` (nx, nz) and, where it is `free`, the position `place` (2,).

    Both are changed in place. `motion` are a rate and an offset, of which the velocity is ``rate ·
    place − offset``, and whether this is a step in time; `old` the rate of the storage and that of
    earlier times.

    Returns how it ended, the number of steps, the residual and what rounding allows of it, which of
    the two `columns` of the film are the last, and how many.
    """
    film = refer(given)
    rate, offset, moving = motion
    volume_rate, volume = old
    moves = film.coefs.shape[0]
    residual, allowed, change, finest = np.inf, 0.0, np.inf, 0.0
    iteration, last, count = 0, 0, 0
    damped, short, ended, answered = False, False, False, False
    kink = -np.inf if moving else film.filling[0]  # in motion the film before is near
    for j in range(film.weights.size):
        film.weights[j] = 1.0 if j == 0 else 0.0
    while True:
        for j in range(2):
            film.moving[j] = rate * place[j] - offset[j]
        evaluate(film, u, place, volume_rate, volume)
        if short or ended:
            before = residual
            residual = imbalance(film, place, force, free, load_scale)
            answered = not ended and residual <= tolerance and change < QUADRATIC
            if not answered:  # whatever rounding allows
                allowed = rounding(film, place, rate, free, load_scale)
                store(film, place, volume_rate)
                level = min(allowed, COARSEST)
                small = not ended and small_enough(residual, tolerance, level)
                short_enough = no_longer(change, max(QUADRATIC, finest))
                answered = small and (short_enough or small_enough(before, 0.0, level))
            if answered and damped:
                return ANSWERED, iteration, residual, allowed, last, count
            if not answered and (ended or iteration == most):
                return ENDED, iteration, residual, allowed, last, count
        if not answered:
            iteration += 1
        damped = answered or moving or not free or change < NEARLY
        number = moves + 2 if damped else moves
        columns = film.columns[iteration % 2, :number]
        ended = not linearise(film, place, damped, columns)
        if ended and iteration == 1:
            return NONE, 0, residual, allowed, last, count
        if not ended:
            last, count = iteration % 2, number
            for row in range(5):
                for j in range(2):
                    film.found[0, row, j] = film.found[1, row, j]
        if answered:
            return ANSWERED, iteration, residual, allowed, last, count
        way, waits = 0.0, False
        if free and not ended and kink > -np.inf:
            waits = imbalance(film, place, force, False, load_scale) > WAITS
        if free and not ended:
            x, y = place[0], place[1]
            if not waits:
                x, y = target(film, columns, place, force, rate)
            way = np.hypot(x - place[0], y - place[1])
            ended = not np.isfinite(way)
            if not ended:
                weigh(film, place, x, y, rate, offset)
                way /= max(1.0 - np.hypot(place[0], place[1]), PRESSED)
                place[0], place[1] = x, y
        if not ended:
            weights, most_filled = film.weights[:number], film.filling[1]
            change = correct(u, columns, weights, film.order, kink, most_filled) / film.scale
            change = way if way > change else change
            gap = 1.0 - np.hypot(place[0], place[1])
            short = change < (QUADRATIC if iteration <= LATE else COARSEST**0.5)
            finest = finest_step(film, u, columns, moves, gap) if change >= QUADRATIC else 0.0
            ended = (free and not gap > PRESSED) or (iteration == most and not short)


@part
def target(film, columns, place, force, rate):
    """Where the step of the shaft leads; NaN where there is none."""
    pressure, largest, found = film.scale, 0.0, film.found[0]
    for i in range(film.state.shape[1]):
        for k in range(film.state.shape[2]):
            pressure = max(pressure, film.state[LOAD, i, k])
    for row in range(columns.shape[1]):
        largest = max(largest, abs(columns[0, row]))
    excess = max(largest / pressure / STEP_LIMIT, 1.0)
    a, b = found[1, 0] + rate * found[3, 0], found[1, 1] + rate * found[3, 1]
    c, d = found[2, 0] + rate * found[4, 0], found[2, 1] + rate * found[4, 1]
    first, second = force[0] - found[0, 0], force[1] - found[0, 1]
    det, dx, dy = a * d - b * c, 0.0, 0.0
    if det != 0.0:
        dx, dy = (d * first - b * second) / det / excess, (a * second - c * first) / det / excess
    limit = 1.0 - KEPT * (1.0 - np.hypot(place[0], place[1]))
    x, y = along_the_gap(place[0], place[1], dx, dy, limit)
    finite = np.isfinite(a + b + c + d + first + second)
    return x if finite else np.nan, y


@part
def weigh(film, place, x, y, rate, offset):
    """Weights of the columns in a step to (x, y), as `DiscreteFilm.weights`."""
    was_vx, was_vy = film.moving[0], film.moving[1]
    vx, vy = rate * x - offset[0], rate * y - offset[1]
    if film.polar:
        cos, sin = axes(film, place[0], place[1])
        to_cos, to_sin = axes(film, x, y)
        film.weights[1] = np.hypot(x, y) - np.hypot(place[0], place[1])
        film.weights[2] = to_cos * vx + to_sin * vy - cos * was_vx - sin * was_vy
        film.weights[3] = to_cos * vy - to_sin * vx - cos * was_vy + sin * was_vx
    else:
        film.weights[1], film.weights[2] = x - place[0], y - place[1]
        film.weights[3], film.weights[4] = vx - was_vx, vy - was_vy


@part
def finest_step(film, u, columns, moves, gap):
    """Step of film and shaft that the last digits of unknowns and gap make."""
    terms, largest = 0.0, 0.0
    for row in range(columns.shape[1]):
        total = 0.0
        for c in range(1, moves):
            total += abs(columns[c, row])
        terms = max(terms, total)
    for i in range(u.shape[0]):
        for k in range(u.shape[1]):
            largest = max(largest, abs(u[i, k]))
    return level_of((terms + largest) / film.scale + 1.0 / max(gap, PRESSED))
