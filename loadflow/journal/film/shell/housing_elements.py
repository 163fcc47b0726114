"""Finite elements of a housing with its shell, by scikit-fem.

Quadratic bricks on a grid around the axis, through the wall and along it. The walls of a base run
straight from where they touch the round part to the edges of the base, which is held; a flange is
held where it is bolted. The bore is loaded by pressures cos nθ, sin nθ times Legendre polynomials
along the axis; the displacements under them, projected onto the same, are its influence matrix.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.shell.bore_modes import BoreModes, leading
from loadflow.journal.housings import Feet, Flange, HousedShell

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_CLOSE = 1e-9  # of the bore's radius, within which a place lies on a surface


@lru_cache(maxsize=8)
def housing_modes(shell: HousedShell, radius: float, width: float) -> BoreModes:
    """Modes of the bore of `radius` over the `width` of a bearing, m, in its housing.

    Raises
    ------
    loadflow.errors.InputError
        A housing that does not enclose the bearing.
    """
    shell.check_bore(2 * radius, width)
    return _Housing(shell, radius, width).modes()


def housing_influence(shell: HousedShell, diameter: float, width: float) -> xr.Dataset:
    """Influence matrix of the bore of a housing, as a file of `InfluenceShell` holds it.

    Parameters
    ----------
    shell : HousedShell
        The housing.
    diameter, width : float
        Of the bearing, m.

    Returns
    -------
    xarray.Dataset
        ``influence`` (angle, axial, other_angle, other_axial), m/N, at ``angle``, rad, and
        ``axial``, m.

    Raises
    ------
    loadflow.errors.InputError
        A housing that does not enclose the bearing.

    Examples
    --------
    >>> from loadflow.journal import Flange, HousedShell, housing_influence
    >>> held = Flange(bolt_circle=0.4, thickness=0.02)
    >>> shell = HousedShell(outer_diameter=0.26, support=held, elements=(16, 1, 2))
    >>> table = housing_influence(shell, diameter=0.2, width=0.1)
    >>> table.influence.dims, table.influence.units
    (('angle', 'axial', 'other_angle', 'other_axial'), 'm/N')
    """
    import xarray as xr

    modes = housing_modes(shell, 0.5 * diameter, width)
    size = modes.angle.size, modes.axial.size
    places = {
        "angle": ("around the bore", modes.angle, "rad"),
        "axial": ("from the middle of the bearing", modes.axial, "m"),
    }
    coords = {
        prefix + name: (prefix + name, values, {"units": unit, "long_name": f"place {text}"})
        for prefix in ("", "other_")
        for name, (text, values, unit) in places.items()
    }
    text = "outward displacement of the bore over the outward force at another place"
    matrix = modes.influence.reshape(*size, *size)
    dims = ("angle", "axial", "other_angle", "other_axial")
    attrs = {"units": "m/N", "long_name": text}
    return xr.Dataset({"influence": (dims, matrix, attrs)}, coords)


@dataclass(frozen=True)
class _Housing:
    """The elements of a `shell` around a bore of `radius` over the `width` of a bearing, m."""

    shell: HousedShell
    radius: float
    width: float

    # --- grid ------------------------------------------------------------------------------------
    @cached_property
    def _angles(self) -> Array:
        """Edges of the elements around, rad; a base has some at its edges and where walls begin."""
        around, support = self.shell.elements[0], self.shell.support
        even = np.linspace(0.0, 2 * math.pi, around + 1)
        if not isinstance(support, Feet):
            return even
        corner, touch = self._walls(support)
        marks = np.array([-touch, -corner, corner, touch, 2 * math.pi - touch])
        counts = [max(2, round(around * arc / (2 * math.pi))) for arc in np.diff(marks)]
        counts[0] = counts[2]
        parts = [
            np.linspace(first, last, count, endpoint=False)
            for (first, last), count in zip(pairwise(marks), counts)
        ]
        return np.append(np.concatenate(parts), marks[-1]) + support.angle

    def _walls(self, feet: Feet) -> tuple[float, float]:
        """Angles from the base's direction to its edge, and to where its wall meets the circle."""
        reach = math.hypot(feet.height, 0.5 * feet.width)
        corner = math.atan2(0.5 * feet.width, feet.height)
        return corner, corner + math.acos(min(1.0, 0.5 * self.shell.outer_diameter / reach))

    def _outline(self, angle: Array) -> Array:
        """Radius of the outside at each `angle`, rad, without a flange, m."""
        feet, outer = self.shell.support, 0.5 * self.shell.outer_diameter
        if not isinstance(feet, Feet):
            return np.full(angle.shape, outer)
        corner, touch = self._walls(feet)
        turn = np.abs(np.remainder(angle - feet.angle + math.pi, 2 * math.pi) - math.pi)
        base = feet.height / np.cos(np.minimum(turn, corner))
        wall = outer / np.cos(np.clip(touch - turn, 0.0, 0.5 * math.pi - 1e-6))
        return np.where(turn <= corner, base, np.where(turn < touch, wall, outer))

    @cached_property
    def _depths(self) -> Array:
        """Shares of the wall at the edges of the elements, the first layer that of the shell."""
        through = self.shell.elements[1]
        return np.linspace(0.0, 1.0, through + 1)

    @cached_property
    def _heights(self) -> Array:
        """Edges of the elements along the axis, m, some at the ends of bearing and support."""
        shell, along = self.shell, self.shell.elements[2]
        length = shell.length_around(self.width)
        marks = {0.5 * length, 0.5 * self.width, -0.5 * length, -0.5 * self.width}
        marks |= set(self._held_along())
        ends = np.array(sorted(marks))
        ends = ends[np.append(True, np.diff(ends) > _CLOSE * self.radius)]
        step = self.width / along * (1 + 1e-9)
        parts = [
            np.linspace(first, last, max(1, math.ceil((last - first) / step)), endpoint=False)
            for first, last in pairwise(ends)
        ]
        return np.append(np.concatenate(parts), ends[-1])

    def _held_along(self) -> tuple[float, float]:
        """Ends of the support along the axis, m."""
        support, length = self.shell.support, self.shell.length_around(self.width)
        if isinstance(support, Flange):
            half = 0.5 * support.thickness
            return support.axial - half, support.axial + half
        half = 0.5 * (length if support.length is None else support.length)
        return -half, half

    @cached_property
    def _mesh(self) -> tuple[Any, Array]:
        """Bricks, and the modulus of each, Pa."""
        from skfem import MeshHex

        shell, support = self.shell, self.shell.support
        angles, heights = self._angles, self._heights
        liner = [self.radius + shell.shell_thickness] if shell.shell_thickness else []
        layers = 1 if liner else 0
        inner = self.radius + shell.shell_thickness
        nodes = [np.full(angles.size, self.radius)] if liner else []
        outline = self._outline(angles)
        nodes += [inner + share * (outline - inner) for share in self._depths]
        if isinstance(support, Flange):
            rim, outer = 0.5 * support.bolt_circle, 0.5 * shell.outer_diameter
            count = max(1, round((rim - outer) / max(outer - inner, 1e-3 * rim)))
            count = min(count, 2 * shell.elements[1])
            more = np.linspace(outer, rim, count + 1)[1:]
            nodes += [np.full(angles.size, radius) for radius in more]
        radii = np.array(nodes)
        wall = layers + shell.elements[1]
        size = (angles.size - 1, len(radii) - 1, heights.size - 1)
        # nodes of the last angle are those of the first
        number = np.arange(size[0] * len(radii) * heights.size).reshape(size[0], len(radii), -1)
        number = np.concatenate([number, number[:1]])
        x = radii.T[:-1] * np.cos(angles[:-1])[:, None]
        y = radii.T[:-1] * np.sin(angles[:-1])[:, None]
        points = np.stack(np.broadcast_arrays(x[..., None], y[..., None], heights)).reshape(3, -1)
        i, j, k = (part.ravel() for part in np.indices(size))
        middle = 0.5 * (heights[k] + heights[k + 1])
        low, high = self._held_along()
        keep = (j < wall) | ((middle > low) & (middle < high))
        i, j, k = i[keep], j[keep], k[keep]
        corners = [(0, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 0)]
        bricks = np.array([number[i + a, j + b, k + c] for a, b, c in [*corners, (1, 1, 1)]])
        used, bricks = np.unique(bricks, return_inverse=True)
        modulus = np.full(i.size, shell.modulus)
        if shell.shell_modulus is not None:
            modulus[j < layers] = shell.shell_modulus
        return MeshHex(np.ascontiguousarray(points[:, used]), bricks.reshape(8, -1)), modulus

    def _facets(self, mesh: Any) -> tuple[Array, Array]:
        """Facets of the bore within the bearing, and those that are held."""
        x, y, z = mesh.p
        far, close = np.hypot(x, y), _CLOSE * self.radius
        bore = (far < self.radius + close) & (np.abs(z) < 0.5 * self.width + close)
        support = self.shell.support
        if isinstance(support, Flange):
            held = far > 0.5 * support.bolt_circle - close
        else:
            depth = x * math.cos(support.angle) + y * math.sin(support.angle)
            low, high = self._held_along()
            held = (depth > support.height - close) & (z > low - close) & (z < high + close)
        outside = mesh.boundary_facets()
        corners = mesh.facets[:, outside]
        return outside[bore[corners].all(axis=0)], outside[held[corners].all(axis=0)]

    # --- solution --------------------------------------------------------------------------------
    def modes(self) -> BoreModes:
        """Modes of the bore."""
        from scipy.special import eval_legendre

        angle = np.linspace(0.0, 2 * math.pi, 4 * self._harmonics, endpoint=False)
        half = 0.5 * self.width
        axial = half * np.sin(np.linspace(-0.5 * math.pi, 0.5 * math.pi, 3 * self._degrees + 1))
        along = np.array([eval_legendre(n, axial / half) for n in range(self._degrees + 1)])
        around = np.array([turn(n * angle) for n, turn in self._turns])
        # sizes of the patterns over the bore
        turns = np.array([2.0 if n == 0 else 1.0 for n, _ in self._turns])
        squares = 2.0 / (2 * np.arange(self._degrees + 1) + 1)
        sizes = np.sqrt(np.outer(math.pi * self.radius * turns, half * squares)).ravel()
        compliance = self._compliance() / np.outer(sizes, sizes)
        aside = np.zeros((sizes.size, 2))
        first = 1 + self._degrees  # cos θ and sin θ, even along the axis
        aside[first, 0] = aside[2 * first, 1] = 1.0
        values, vectors = leading(0.5 * (compliance + compliance.T), aside, self.shell.accuracy)
        patterns = np.einsum("an,bm->abnm", around, along).reshape(sizes.size, -1)
        shapes = (vectors / sizes[:, None]).T @ patterns
        return BoreModes(angle, axial, shapes.reshape(-1, angle.size, axial.size), values)

    @property
    def _harmonics(self) -> int:
        """Highest harmonic around: four nodes of the elements in a wave."""
        return self.shell.elements[0] // 2

    @property
    def _degrees(self) -> int:
        """Highest polynomial along the axis."""
        return self.shell.elements[2] + 2

    @property
    def _turns(self) -> list[tuple[int, Callable[[Any], Any]]]:
        """Harmonics around, by order and function."""
        orders = range(1, self._harmonics + 1)
        return [(0, np.cos), *((n, turn) for n in orders for turn in (np.cos, np.sin))]

    def _compliance(self) -> Array:
        """Work of each pattern of pressure on the displacement under each, m^3/N (n, n)."""
        from scipy.sparse.linalg import splu
        from scipy.special import eval_legendre
        from skfem import Basis, BilinearForm, ElementHex2, ElementVector, FacetBasis, LinearForm
        from skfem.helpers import ddot, eye, sym_grad, trace

        mesh, modulus = self._mesh
        element = ElementVector(ElementHex2())
        basis = Basis(mesh, element, intorder=4)
        nu = self.shell.poisson_ratio
        lam, mu = nu / ((1 + nu) * (1 - 2 * nu)), 0.5 / (1 + nu)

        @BilinearForm
        def elastic(u: Any, v: Any, _: Any) -> Any:
            strain = sym_grad(u)
            stress = lam * eye(trace(strain), 3) + 2 * mu * strain
            return ddot(stress, sym_grad(v))

        @LinearForm(dtype=complex)
        def pressed(v: Any, w: Any) -> Any:
            x, y, z = w.x
            far, angle = np.hypot(x, y), np.arctan2(y, x)
            flat = np.abs(x * w.n[0] + y * w.n[1])  # facets are chords of the bore
            wave = np.exp(1j * w.order * angle) * eval_legendre(w.degree, 2 * z / self.width)
            return self.radius * flat / far**3 * wave * (v[0] * x + v[1] * y)

        stiffness = sum(
            value * elastic.assemble(basis.with_elements(np.flatnonzero(modulus == value)))
            for value in np.unique(modulus)
        )
        bore, held = self._facets(mesh)
        free = np.setdiff1d(np.arange(basis.N), basis.get_dofs(held).flatten())
        face = FacetBasis(mesh, element, facets=bore, intorder=6)
        degrees = range(self._degrees + 1)
        loads = []
        for order in range(self._harmonics + 1):
            waves = [pressed.assemble(face, order=order, degree=n)[free] for n in degrees]
            loads += [wave.real for wave in waves]
            loads += [wave.imag for wave in waves if order]
        columns = np.array(loads)
        factors = splu(
            stiffness[free][:, free].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        return np.asarray(columns @ factors.solve(np.ascontiguousarray(columns.T)))
