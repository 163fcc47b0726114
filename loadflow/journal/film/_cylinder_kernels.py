"""Compiled: the film in a rigid cylinder, linearised, and how far it is from balance.

The same as `DiscreteFilm.linearise` and `imbalance` do part by part for any film, for those that
`rigid_cylinder` names. `film` is what it hands over. Nothing here may allocate, and most functions
are parts of the one loop that calls them: so they are compiled in less time.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DLOAD, LOAD, SLACK
from loadflow.journal.film._band_kernels import factorise, substitute
from loadflow.journal.film._kernels import (
    HM,
    apply_law,
    balance,
    carried_by,
    jacobian,
    largest_terms,
    load_of,
    right_hand_sides,
)
from loadflow.journal.film.film import AXIS
from loadflow.journal.film.gap._gap_kernels import cylinder_slopes, gap_coefficients
from loadflow.numerics.convergence import EPS, is_small, rounding_level, stalled
from loadflow.numerics.linked import LINKED, bare

part = bare(inline="always")
"""Of a function that is called at one place, of which it becomes a part."""

inner = bare(**LINKED)
"""Of a function that is called at several."""

level_of, small_enough, no_longer = part(rounding_level), part(is_small), part(stalled)


@inner
def axes(film, x, y):
    """Cosine and sine of the frame of the mesh, whose first axis points to the narrowest gap."""
    ratio = np.hypot(x, y)
    turns = film.polar and ratio > 0.0
    return x / ratio if turns else 1.0, y / ratio if turns else 0.0


@inner
def store(film, place, rate):
    """Growth of the gap volume of each cell and its derivatives by the position, Pa."""
    cos, sin = axes(film, place[0], place[1])
    along = cos * film.moving[0] + sin * film.moving[1]
    beside = cos * film.moving[1] - sin * film.moving[0]
    for at in range(film.growth.shape[0]):
        for i in range(film.growth.shape[1]):
            moving = film.modes[at, 0, i] * along + film.modes[at, 1, i] * beside
            film.growth[at, i, 0] = film.slope * (rate * film.coefs[at, HM, i, 0] - moving)


@part
def evaluate(film, u, place, rate, old):
    """Evaluate law and gap, and fill the fields: the balance, and its derivatives by the position.

    `old` counts where `rate` is not 0.
    """
    x, y, coefs, fields = place[0], place[1], film.coefs, film.fields
    apply_law(film.address, film.numbers, film.scale, u, film.state)
    film.places[0, 0] = np.hypot(x, y) if film.polar else x
    film.places[0, 1] = 0.0 if film.polar else y
    gap_coefficients(film.face, film.cell, film.strength, film.places[:1], None, coefs[:1], None)
    cylinder_slopes(
        film.face, film.cell, film.strength, film.polar, 0.0, x, y, None, film.places, film.beside,
        coefs, None, film.modes,
    )  # fmt: skip
    store(film, place, rate)
    for at in range(coefs.shape[0]):
        for i in range(fields.shape[1]):
            for k in range(fields.shape[2]):
                fields[at, i, k] = -old[i, k] if at == 0 and rate != 0.0 else 0.0
    balance(
        film.state, coefs, film.cells, film.closed, film.wedge, film.edges, film.growth, film.fixed,
        fields,
    )  # fmt: skip


@part
def linearise(film, place, damped, columns):
    """As `DiscreteFilm.linearise`, into `columns` and the second of what is `found`.

    Returns whether the film that was evaluated last has an answer there.
    """
    x, y, out, moves = place[0], place[1], film.found[1], film.coefs.shape[0]
    jacobian(
        film.state, film.coefs[0], film.cells, film.closed, film.wedge, film.growth[0], film.order,
        film.fixed, film.bandwidth, film.band,
    )  # fmt: skip
    right_hand_sides(
        film.state, film.fields[: columns.shape[0]], moves, film.modes[0], film.across, film.slope,
        film.cells[1], None, film.order, film.fixed, columns,
    )  # fmt: skip
    singular = factorise(film.band, film.bandwidth, film.pivots)
    substitute(film.band, film.bandwidth, film.pivots, columns)
    loads, dz, unit, carried = film.loads, film.cells[0], film.unit, film.carried
    carried_by(
        film.state[DLOAD], film.modes[0], film.across, dz, film.order, columns,
        carried[: columns.shape[0]],
    )  # fmt: skip
    load_of(film.state[LOAD], film.modes, film.across, dz, loads)
    along, beside = unit * (loads[0, 0] - carried[0, 0]), unit * (loads[0, 1] - carried[0, 1])
    for j in range(2):
        out[1 + j, 0] = unit * (loads[1, j] - carried[1, j])
        for i in range(2):
            out[3 + j, i] = -unit * carried[moves + i, j] if damped else 0.0
    ratio, (cos, sin) = np.hypot(x, y), axes(film, x, y)
    if not film.polar:
        for j in range(2):
            out[1 + j, 1] = unit * (loads[moves - 1, j] - carried[moves - 1, j])
    elif ratio < AXIS:
        out[1, 1], out[2, 1] = -out[2, 0], out[1, 0]
    else:
        ahead = cos * film.moving[0] + sin * film.moving[1]
        aside = cos * film.moving[1] - sin * film.moving[0]
        out[1, 1] = (-beside - out[3, 1] * ahead + out[3, 0] * aside) / ratio
        out[2, 1] = (along - out[4, 1] * ahead + out[4, 0] * aside) / ratio
    out[0, 0], out[0, 1] = cos * along - sin * beside, sin * along + cos * beside
    for row in (1, 3):  # from the frame of the mesh to that of the shell
        a = out[row, 0] * cos - out[row, 1] * sin
        b = out[row, 0] * sin + out[row, 1] * cos
        c = out[row + 1, 0] * cos - out[row + 1, 1] * sin
        d = out[row + 1, 0] * sin + out[row + 1, 1] * cos
        out[row, 0], out[row, 1] = cos * a - sin * c, cos * b - sin * d
        out[row + 1, 0], out[row + 1, 1] = sin * a + cos * c, sin * b + cos * d
    return singular == 0 and np.isfinite(along + beside)


@part
def imbalance(film, place, force, free, load_scale):
    """As `imbalance` of the module of that name, of the film that was evaluated last.

    Of the load only where the shaft is `free`.
    """
    worst = 0.0
    for i in range(film.fixed.shape[0]):
        for k in range(film.fixed.shape[1]):
            lack = abs(film.fields[0, i, k] + film.state[SLACK, i, k])
            if not film.fixed[i, k] and (lack > worst or lack != lack):
                worst = lack
    worst /= film.flux
    if free:
        load_of(film.state[LOAD], film.modes, film.across, film.cells[0], film.loads)
        along, beside = film.unit * film.loads[0, 0], film.unit * film.loads[0, 1]
        cos, sin = axes(film, place[0], place[1])
        first = force[0] - cos * along + sin * beside
        second = force[1] - sin * along - cos * beside
        lack = np.hypot(first, second) / load_scale
        if lack > worst or lack != lack:
            worst = lack
    return worst


@part
def rounding(film, place, rate, free, load_scale):
    """As `rounding` of the module `imbalance`, of the film that was evaluated last.

    The growth of the gap is then that of one without storage.
    """
    x, y, slope = place[0], place[1], film.found[0]
    store(film, place, 0.0)
    terms = largest_terms(
        film.state, film.coefs[0], film.cells, film.closed, film.wedge, film.edges, film.growth[0],
        film.fixed,
    )  # fmt: skip
    worst = terms * (1.0 + 3.0 / min(max(1.0 - np.hypot(x, y), EPS), 1.0)) / film.flux
    if free:
        pressed = 0.0
        for i in range(film.state.shape[1]):
            for k in range(film.state.shape[2]):
                pressed = max(pressed, abs(film.state[LOAD, i, k]))
        carried = film.unit * pressed * 2.0 * np.pi * film.width
        far = max(1.0, max(abs(x), abs(y)))
        for j in range(2):
            by_x = slope[1 + j, 0] + rate * slope[3 + j, 0]
            by_y = slope[1 + j, 1] + rate * slope[3 + j, 1]
            worst = max(worst, (carried + far * (abs(by_x) + abs(by_y))) / load_scale)
    return level_of(worst)
