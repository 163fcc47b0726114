"""Strips across a reduced film, and what its points make and carry as they share it out on them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.shaped_mesh import even_cells
from loadflow.journal.models.width_modes import Nodes

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def strip_edges(half: float, across: int, whole: bool, marks: tuple[float, ...]) -> Array:
    """Edges of about `across` strips over the width, or half of it, also on `marks`.

    Lengths are in shaft radii; marks are ends of grooves, shares of the half width.
    """
    inside = np.array(marks)
    lower = np.append(-1.0, -inside[::-1]) if whole else np.zeros(1)
    breaks = np.concatenate([lower, inside, [1.0]])
    return half * even_cells(breaks, across if whole else 0.5 * across)


def shares_of(nodes: Nodes, edges: Array) -> Array:
    """Share of the width of each point that lies in each strip (l, strips)."""
    order = np.argsort(nodes.z, kind="stable")
    ends = edges[0] + np.append(0.0, np.cumsum(nodes.weights[order]))
    low = np.maximum(ends[:-1, None], edges[:-1])
    within = np.maximum(np.minimum(ends[1:, None], edges[1:]) - low, 0.0)
    narrow = within.sum(axis=1) == 0.0  # the bend between two stretches has no width
    if narrow.any():
        at = np.clip(np.searchsorted(edges, nodes.z[order][narrow]) - 1, 0, edges.size - 2)
        within[np.flatnonzero(narrow), at] = 1.0
    shares = np.empty(within.shape)
    shares[order] = within / within.sum(axis=1, keepdims=True)
    return shares


def made_in_film(heat: Array, shares: Array, wet: Flags) -> Array:
    """Heat of the points (nx, l) in the strips (nx, strips), in a column of a groove beside it."""
    made = heat @ shares
    for i in np.flatnonzero(~wet.all(axis=1) & wet.any(axis=1)):
        own = shares * wet[i]
        total = own.sum(axis=1, keepdims=True)
        made[i] = heat[i] @ np.where(total > 0.0, own / np.maximum(total, 1e-300), 0.0)
    return np.asarray(made)


def passed_on(gained: Array, low: Array, high: Array, wet: Flags) -> Array:
    """Flow toward higher z over the edges of strips, (nx, strips + 1), which balances each.

    Parameters
    ----------
    gained : array (nx, strips)
        What each gains around.
    low, high : array (nx,)
        What comes in over both ends of the strips.
    wet : array of bool (nx, strips)
        Strips that are no groove.
    """
    passed = np.cumsum(np.column_stack([low, np.where(wet, gained, 0.0)]), axis=1)
    for i in np.flatnonzero(~wet.all(axis=1)):
        passed[i] = 0.0
        edges = np.flatnonzero(np.diff(np.concatenate([[False], wet[i], [False]]).astype(int)))
        for first, end in edges.reshape(-1, 2):  # of each run of strips
            inside = np.append(0.0, np.cumsum(gained[i, first:end]))
            if first == 0:
                begins = low[i]
            elif end == wet.shape[1]:
                begins = -high[i] - inside[-1]
            else:  # between two grooves, of a pair
                begins = -0.5 * inside[-1]
            passed[i, first : end + 1] = begins + inside
    return passed
