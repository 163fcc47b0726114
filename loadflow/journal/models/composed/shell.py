"""Shells of a reduced film: what gives way locally, and modes of what gives way all over.

A shell is discretised on even cells across and the cells around, as on the grid. Of its influence
coefficients C a local part c is taken off; C − c 1 is kept by the modes that count, and given to
the points across by the width that they stand for.
"""

from __future__ import annotations

from functools import lru_cache, singledispatch
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.discretise import mesh_in_bore
from loadflow.journal.film.gap.mesh import Mesh
from loadflow.journal.film.shell.compliance import (
    Compliance,
    Harmonic,
    Modal,
    Numbers,
    compliance_of,
)
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.composed.modes import NO_MODES, Modes
from loadflow.journal.models.composed.strips import shares_of
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Nodes
from loadflow.journal.shells import LinedShell, LocalShell, Shell
from loadflow.numerics.lanes import aligned, lanes_for

Array = NDArray[np.float64]

_ACROSS = 16  # cells across half of the width; a matrix is of the cells that it was given for
_SMOOTH = 8  # polynomials across that tell a pressure from one that gives way locally
_TRACE = 1e-3  # of the stiffest mode of a housing
_LEFT_OUT = 2e-3  # of the softest mode, under a pressure that falls with the square of its waves


class _Split(NamedTuple):
    """A shell on cells: growth by the pressure of a place, and modes.

    Attributes
    ----------
    local : float
        m/Pa.
    shapes : array (k, nx, nz)
        Growth of the gap of the cells by the amplitude of each, m.
    pressed : array (k, nx, nz)
        Amplitude by the pressure on the cells, 1/Pa.
    """

    local: float
    shapes: Array
    pressed: Array


def shell_of(
    bearing: JournalGeometry, options: Film, ring: Ring, nodes: Nodes, whole: bool
) -> tuple[float, Modes]:
    """Growth of the gap over the pressure of its place, clearances per Pa, and modes beside it."""
    shell = options.shell
    if shell is None:
        return 0.0, NO_MODES
    if shell.local:
        local = cast("LocalShell | LinedShell", shell)
        local.check_local(bearing.width)
        return local.compliance / bearing.clearance, NO_MODES
    start = float(np.arctan2(ring.sin[0], ring.cos[0])) - 0.5 * float(ring.width[0])
    across = _ACROSS if shell.any_grid else options.cells[1] // 2
    half = bearing.width / bearing.diameter
    z_edges = np.linspace(-half if whole else 0.0, half, (2 if whole else 1) * across + 1)
    around = edges = start + np.append(0.0, np.cumsum(ring.width))
    of_grid = bool(bearing.shape.segments) and not shell.any_grid
    if of_grid:
        mesh = mesh_in_bore(bearing, options, not whole)
        edges, z_edges = mesh.edges, mesh.z_edges
    split = _split_on(shell, tuple(edges.tolist()), tuple(z_edges.tolist()), bearing.radius)
    if of_grid:
        split = _between_segments(split, edges, around)
    shares, inner = shares_of(nodes, z_edges), nodes.slopes.shape[1]
    for n, beside in enumerate(nodes.joints):  # of no width, in the gap of its inner point
        shares[inner + n] = shares[beside]
    pressing = shares[:inner] * nodes.weights[:inner, None] / np.diff(z_edges)
    shapes = split.shapes @ shares.T / bearing.clearance
    rubbed = shapes[:0]
    if options.contact is not None:
        areas = np.outer(ring.width, np.diff(z_edges)) * bearing.radius**2
        rubbed = (split.pressed / areas) @ shares.T / (1.0 if whole else 2.0)
    return split.local / bearing.clearance, Modes(
        True,
        *(_rows(part, nodes.z.size) for part in (shapes, split.pressed @ pressing.T, rubbed)),
    )


def _between_segments(split: _Split, edges: Array, around: Array) -> _Split:
    """A shell on cells around of these `edges`, on columns that have theirs at some of them.

    The grid has several cells in a groove between two segments, a ring one.
    """
    width, count = np.diff(edges), around.size - 1
    middle = (0.5 * (edges[1:] + edges[:-1]) - around[0]) % (2.0 * np.pi)
    owner = np.searchsorted(around - around[0], middle) - 1
    shapes, pressed = (np.zeros((len(split.shapes), count, split.shapes.shape[2])) for _ in "12")
    np.add.at(shapes.swapaxes(0, 1), owner, (split.shapes * width[:, None]).swapaxes(0, 1))
    np.add.at(pressed.swapaxes(0, 1), owner, split.pressed.swapaxes(0, 1))
    return _Split(split.local, shapes / np.diff(around)[:, None], pressed)


def _rows(values: Array, points: int) -> Array:
    """Values (k, nx, l) in lanes that hold `points`."""
    given = aligned(np.zeros((*values.shape[:-1], lanes_for(points))))
    given[..., : values.shape[-1]] = values
    return given


@lru_cache(maxsize=8)
def _split_on(
    shell: Shell, around: tuple[float, ...], across: tuple[float, ...], radius: float
) -> _Split:
    """The shell on cells of these edges, rad and shaft radii, the modes that count first."""
    mesh = Mesh(
        edges=np.array(around), z_edges=np.array(across), closed=True, polar=False, strength=0.0,
        nodes=1,
    )  # fmt: skip
    return _split(compliance_of(shell, mesh, radius), mesh)


@singledispatch
def _split(compliance: Compliance, mesh: Mesh) -> _Split:
    raise TypeError(compliance)


@_split.register
def _modal(compliance: Modal, mesh: Mesh) -> _Split:
    """Modes of a housing; those that both halves of the width do not share are none on a half.

    Modes are all that it gives. Films take a shell for elastic where it gives way locally, too: by
    a trace.
    """
    sizes = np.einsum("kxz,kxz->k", compliance.pressed, compliance.shapes)
    kept = np.flatnonzero(sizes > _LEFT_OUT * 1e-3 * sizes.max())
    local = _TRACE * float(sizes[kept].min())
    return _Split(local, compliance.shapes[kept], compliance.pressed[kept])


@_split.register
def _harmonic(compliance: Harmonic, mesh: Mesh) -> _Split:
    """Modes of a body of revolution: waves around by what smooth pressures across make of them."""
    orders = np.arange(mesh.angle.size // 2 + 1)
    norms = np.where(orders == 0, 2.0 * np.pi, np.pi)
    numbers = compliance.numbers[orders] * norms[:, None, None]
    local = float(np.linalg.norm(numbers[-1], 2))
    degrees = np.arange(0, _SMOOTH, 2 if mesh.half else 1)
    waves = np.polynomial.legendre.legvander(mesh.z / mesh.z_edges[-1], _SMOOTH)
    smooth = np.linalg.qr(waves[:, degrees])[0]
    largest, shapes, pressed = np.linalg.norm(numbers[0], 2), [], []
    for n, matrix, norm in zip(orders, numbers, norms):
        over = matrix - local * np.eye(len(matrix))
        left, sizes, right = np.linalg.svd(over @ smooth, full_matrices=False)
        for k in np.flatnonzero(sizes > _LEFT_OUT * largest * (1.0 + n * n)):
            for turn in compliance.turns[n, : 2 if n else 1]:
                shapes.append(np.outer(turn, left[:, k]))
                by = sizes[k] / norm * turn * compliance.weights
                pressed.append(np.outer(by, smooth @ right[k]))
    return _Split(local, np.array(shapes), np.array(pressed))


@_split.register
def _given(compliance: Numbers, mesh: Mesh) -> _Split:
    """Modes of influence coefficients: their singular vectors."""
    numbers = compliance.numbers
    local = float(np.median(np.linalg.svd(numbers, compute_uv=False)))
    left, sizes, right = np.linalg.svd(numbers - local * np.eye(len(numbers)))
    kept = max(int((sizes > _LEFT_OUT * local).sum()), 1)
    shape = -1, *mesh.shape
    return _Split(
        local, left[:, :kept].T.reshape(shape), (sizes[:kept, None] * right[:kept]).reshape(shape)
    )
