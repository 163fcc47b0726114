"""Shells on the cells of a film: growth of every gap over the pressure on every cell.

What the film asks of its shell: ``local`` (nx, nz), the growth of the gap of a cell over its own
pressure, m/Pa; whether it ``spreads``, so that a pressure widens other gaps, too; and the
``growth`` of all gaps under a pressure.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.journal.film.gap.mesh import Mesh
from loadflow.journal.film.shell.bore_modes import BoreModes, modes_of_file
from loadflow.journal.housings import HousedShell, InfluenceShell
from loadflow.journal.shells import LinedShell, LocalShell, MatrixShell, Shell, ThickShell
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_POINTS = 3  # of Gauss in a cell, each way
_HARMONICS = 2  # times the cells around; higher ones of a pressure even over a cell are neglected


@dataclass(frozen=True, eq=False)
class Local:
    """Every cell deforms under its own pressure alone."""

    local: Array
    spreads: bool = False

    def growth(self, pressure: Array) -> Array:
        """Growth of the gaps under `pressure`, (…, nx, nz), m."""
        return self.local * pressure


@dataclass(frozen=True, eq=False)
class Numbers:
    """Influence coefficients (n, n) of the cells, m/Pa."""

    numbers: Array
    local: Array
    spreads: bool = True

    def growth(self, pressure: Array) -> Array:
        """Growth of the gaps under `pressure`, (…, nx, nz), m."""
        flat = pressure.reshape(*pressure.shape[:-2], -1)
        return (flat @ self.numbers.T).reshape(pressure.shape)


@dataclass(frozen=True, eq=False)
class Harmonic:
    """Influence coefficients of a body of revolution, harmonic by harmonic.

    Attributes
    ----------
    turns : array (h, 2, nx)
        Means of cos nθ and sin nθ over the cells around.
    weights : array (nx,)
        Widths of the cells, rad.
    numbers : array (h, nz, nz)
        Growth over pressure of each harmonic, over π (2π for the mean), m/Pa.
    """

    turns: Array
    weights: Array
    numbers: Array
    local: Array
    spreads: bool = True

    def growth(self, pressure: Array) -> Array:
        """Growth of the gaps under `pressure`, (…, nx, nz), m."""
        orders, _, nx = self.turns.shape
        turns, nz = self.turns.reshape(-1, nx), pressure.shape[-1]
        rows = np.moveaxis(pressure.reshape(-1, nx, nz), 1, 0)  # all fields in one product
        waves = (turns * self.weights) @ rows.reshape(nx, -1)
        grown = waves.reshape(orders, -1, nz) @ self.numbers.swapaxes(-1, -2)
        fields = (turns.T @ grown.reshape(waves.shape)).reshape(nx, -1, nz)
        return np.ascontiguousarray(np.moveaxis(fields, 1, 0)).reshape(pressure.shape)


@dataclass(frozen=True, eq=False)
class Modal:
    """Modes of a bore, by their means over the cells.

    Attributes
    ----------
    shapes : array (k, nx, nz)
        Modes at the cells, 1/m; on half of the width their even parts.
    pressed : array (k, nx, nz)
        Compliance of each times its pattern of forces, m²/N · m².
    """

    shapes: Array
    pressed: Array
    local: Array
    spreads: bool = True

    def growth(self, pressure: Array) -> Array:
        """Growth of the gaps under `pressure`, (…, nx, nz), m."""
        modes = len(self.shapes)
        flat = pressure.reshape(*pressure.shape[:-2], -1)
        parts = flat @ self.pressed.reshape(modes, -1).T
        return np.asarray((parts @ self.shapes.reshape(modes, -1)).reshape(pressure.shape))


Compliance = Local | Numbers | Harmonic | Modal


@singledispatch
def compliance_of(shell: Shell, mesh: Mesh, radius: float) -> Compliance:
    """Discretise `shell` on the cells of `mesh` around a shaft of `radius`, m, by its kind.

    Raises
    ------
    loadflow.errors.InputError
        A lining that is not local, a shell inside the bore, a matrix of another grid.
    """
    raise InputError(f"shell = {shell!r} is not allowed: a shell of loadflow.journal, or None")


@compliance_of.register(LocalShell)
@compliance_of.register(LinedShell)
def _local(shell: LocalShell | LinedShell, mesh: Mesh, radius: float) -> Local:
    shell.check_local(2 * radius * float(mesh.z_edges[-1]))
    return Local(np.full(mesh.shape, shell.compliance))


@compliance_of.register
def _given(shell: MatrixShell, mesh: Mesh, radius: float) -> Numbers:
    """The given coefficients; on half of the width each cell stands for its mirror image, too."""
    nx, nz = mesh.shape
    across = 2 * nz if mesh.half else nz
    numbers, size = shell.numbers, nx * across
    if numbers.shape[0] != size:
        raise InputError(
            f"matrix of {numbers.shape[0]} cells is not allowed: {nx} × {across} = {size}, the "
            "cells of this film"
        )
    if mesh.half:
        full = numbers.reshape(nx, across, nx, across)
        numbers = full[:, nz:, :, nz:] + full[:, nz:, :, nz - 1 :: -1]
        numbers = numbers.reshape(nx * nz, nx * nz)
    return Numbers(np.ascontiguousarray(numbers), np.diag(numbers).reshape(nx, nz).copy())


@compliance_of.register
def _thick(shell: ThickShell, mesh: Mesh, radius: float) -> Harmonic:
    from loadflow.journal.film.shell.cylinder import bore_compliance

    outer = 0.5 * shell.outer_diameter
    require(outer > radius, "outer_diameter", shell.outer_diameter, f"must be > {2 * radius:.6g} m")
    nx = mesh.shape[0]
    orders = np.arange(_HARMONICS * nx + 1)
    numbers = bore_compliance(
        orders, radius * mesh.z_edges, radius, outer, shell.modulus, shell.poisson_ratio
    )
    numbers /= np.where(orders == 0, 2 * np.pi, np.pi)[:, None, None]
    n = np.maximum(orders, 1)[:, None]
    cos = np.diff(np.sin(n * mesh.edges)) / (n * mesh.dx)
    sin = -np.diff(np.cos(n * mesh.edges)) / (n * mesh.dx)
    cos[0], sin[0] = 1.0, 0.0
    turns = np.stack([cos, sin], axis=1)
    squares = (turns**2).sum(axis=1) * mesh.dx
    local = np.einsum("hi,hkk->ik", squares, numbers)
    return Harmonic(turns, mesh.dx, numbers, local)


@compliance_of.register
def _housed(shell: HousedShell, mesh: Mesh, radius: float) -> Modal:
    from loadflow.journal.film.shell.housing_elements import housing_modes

    return _modal(housing_modes(shell, radius, _width(mesh, radius)), mesh, radius)


@compliance_of.register
def _influence(shell: InfluenceShell, mesh: Mesh, radius: float) -> Modal:
    return _modal(modes_of_file(shell, radius, _width(mesh, radius)), mesh, radius)


def _width(mesh: Mesh, radius: float) -> float:
    """Width of the bearing, m, to as many digits as its cells leave of it."""
    return float(f"{2 * radius * mesh.z_edges[-1]:.12g}")


def _modal(modes: BoreModes, mesh: Mesh, radius: float) -> Modal:
    """Means of the modes over the cells; on half of the width those that both halves share."""
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    angle = (mesh.angle[:, None] + 0.5 * mesh.dx[:, None] * nodes).ravel()
    axial = (radius * (mesh.z[:, None] + 0.5 * mesh.dz[:, None] * nodes)).ravel()
    shapes = modes.at(angle, axial)
    if mesh.half:
        shapes = 0.5 * (shapes + modes.at(angle, -axial[::-1])[..., ::-1])
    split = shapes.reshape(-1, mesh.angle.size, _POINTS, mesh.z.size, _POINTS)
    means = 0.25 * np.einsum("kxazb,a,b->kxz", split, weights, weights)
    areas = radius**2 * np.outer(mesh.dx, mesh.dz) * (2.0 if mesh.half else 1.0)
    pressed = modes.compliances[:, None, None] * means * areas
    return Modal(means, pressed, np.einsum("kxz,kxz->xz", pressed, means))
