"""Lateral vibration of a shaft line on bearings: M ẍ + C ẋ + K x = f.

Modes are the roots of M λ² + C λ + K, with what has no mass condensed or kept at first order; the
response to unbalance is the steady motion at the frequency of the speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.shaft.line import DOF, LineSupport, ShaftLine, System, assembled

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

_STILL = 1e-6  # of a root's size: an imaginary part below this does not swing
_INFINITE = 1e12  # of the scaled roots: those of rows without mass
_TURNS, _SAME = 50, 1e-9  # of a mode at its own frequency, and its relative change in the last


def modes(
    line: ShaftLine,
    supports: Sequence[LineSupport] | Callable[[float], Sequence[LineSupport]],
    speed: float,
    *,
    count: int = 6,
) -> xr.Dataset:
    """Natural frequencies, damping ratios and shapes of a shaft line at a speed.

    Parameters
    ----------
    line : ShaftLine
        Shaft and discs.
    supports : sequence of LineSupport, or callable
        What carries it, with stiffness and damping at that speed; where these depend on the
        frequency of vibration, the supports at one (rad/s): each mode is found at its own.
    speed : float
        Of the shaft, rad/s.
    count : int
        Modes that swing, from the lowest on.

    Returns
    -------
    xarray.Dataset
        Over ``mode``: ``natural_frequency`` |λ|, ``damped_frequency`` Im λ (rad/s),
        ``damping_ratio`` −Re λ/|λ| (< 0: unstable), ``forward`` (1: whirls with the rotation, −1:
        against it, 0: along a line) and ``residual`` of the root; over (mode, part, node, dof)
        ``shape``, real and imaginary. Fewer modes than `count` if the others are overdamped:
        NaN. Attributes: ``largest_growth``, the largest real part of all roots, 1/s, of those that
        do not swing, too; ``converged``, ``iterations`` (1: a direct solution; of modes at their
        own frequencies the most that one takes).

    Raises
    ------
    InputError
        A support off the shaft or misshapen.
    SolverError
        The matrices have no eigenvalues, or a mode is not found at its own frequency.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.shaft import Beam, Disc, LineSupport, ShaftLine, ShaftSection, modes
    >>> line = ShaftLine(Beam((ShaftSection(0.1),)), 2.0, (Disc(1.0, 100.0),), density=0.0)
    >>> film = LineSupport(0.0, 1e7 * np.eye(2), 1e4 * np.eye(2))
    >>> found = modes(line, [film, LineSupport(2.0)], speed=50.0, count=2)
    >>> bool((found.damping_ratio > 0).all()), found.natural_frequency.units
    (True, 'rad/s')
    """
    if count < 1:
        raise InputError(f"count = {count}: must be 1 or more")
    if callable(supports):
        return _each_at_its_own(line, supports, speed, count)
    return _modes(line, supports, speed, count)[0]


def _each_at_its_own(
    line: ShaftLine, supports: Callable[[float], Sequence[LineSupport]], speed: float, count: int
) -> xr.Dataset:
    """Modes on supports that depend on the frequency of vibration, each iterated at its own.

    It is known by its number: damping that falls with the frequency leaves no mode below it out.
    """
    import xarray as xr

    still = [replace(one, damping=None) for one in supports(abs(speed) or 1.0)]
    undamped = _frequencies(line, still, speed, count)
    if np.isnan(undamped).all():
        raise SolverError(f"the shaft line has no mode that swings at {speed:g} rad/s")
    start, roots = _modes(line, supports(float(np.nanmax(undamped))), speed, count)
    # what swings is taken at its own frequency, the others at that of the fastest mode
    standing = roots[np.abs(roots.imag) <= _STILL * np.abs(roots)]
    growth = [float(standing.real.max(initial=-math.inf))]
    rows, most = [], 1
    for row in range(count):
        one, frequency = start.isel(mode=row), float(start["natural_frequency"][row])
        last = math.nan
        for turn in range(1, _TURNS + 1):
            if math.isnan(frequency):
                break
            last, frequency = frequency, _frequencies(line, supports(frequency), speed, count)[row]
            if abs(frequency - last) <= _SAME * last:
                most = max(most, turn)
                break
        else:
            raise SolverError(f"mode {row + 1} is not found: {last:g}, then {frequency:g} rad/s")
        if not math.isnan(last):  # its shape is asked for once, where it is found
            one = _modes(line, supports(last), speed, row + 1)[0].isel(mode=row)
            growth.append(-float(one["damping_ratio"]) * float(one["natural_frequency"]))
        rows.append(one)
    about = start.attrs | {"largest_growth": float(np.nanmax(growth)), "iterations": most}
    return xr.concat(rows, "mode", combine_attrs="override").assign_attrs(about)


@dataclass(frozen=True, eq=False)
class _Pencil:
    """A x = λ B x of a shaft line on its supports, λ in `scale`, 1/s."""

    system: System
    left: NDArray[np.int64]
    follow: Floats
    matrices: tuple[Floats, Floats, Floats]
    a: Floats
    b: Floats
    scale: float
    speed: float

    @classmethod
    def of(cls, line: ShaftLine, supports: Sequence[LineSupport], speed: float) -> Self:
        system = assembled(line, supports)
        m, c, k, left = system.free(speed)
        follow = _following(m, c, k)
        m, c, k = (follow.T @ matrix @ follow for matrix in (m, c, k))
        # states are all motions, and the velocities of those that have mass
        n, heavy = len(m), np.flatnonzero(np.abs(m).sum(axis=0) > 0)
        own, nothing = m[np.ix_(heavy, heavy)], np.zeros((n, heavy.size))
        # times of √(m/k) bring all entries to one size
        scale = math.sqrt(np.abs(k).max() / max(np.abs(m).max(), 1e-300))
        a = np.block([[-k / scale**2, nothing], [nothing.T, own]])
        b = np.block([[c / scale, m[:, heavy]], [m[heavy], np.zeros_like(own)]])
        return cls(system, left, follow, (m, c, k), a, b, scale, speed)

    def roots(self, shapes: bool) -> tuple[NDArray[np.complexfloating], NDArray[Any]]:
        """All roots that are finite, 1/s, and their shapes: twice the work; empty if not asked for.

        Raises
        ------
        SolverError
            There are none.
        """
        from scipy.linalg import LinAlgError, eig

        try:
            found = eig(self.a, self.b, right=shapes)
        except (LinAlgError, ValueError) as error:
            told = f"the shaft line has no eigenvalues at {self.speed:g} rad/s"
            raise SolverError(told) from error
        roots, vectors = found if shapes else (found, np.empty((0, len(found))))
        real = np.isfinite(roots) & (np.abs(roots) < _INFINITE)
        if not real.any():
            raise SolverError(f"the shaft line has no finite eigenvalue at {self.speed:g} rad/s")
        return self.scale * roots[real], vectors[: len(self.matrices[0]), real]


def _swinging(roots: NDArray[np.complexfloating], count: int) -> NDArray[np.intp]:
    """Which roots swing, the lowest first; no more than `count`."""
    swing = np.flatnonzero(roots.imag > _STILL * np.abs(roots))
    return swing[np.argsort(np.abs(roots[swing]), kind="stable")][:count]


def _frequencies(
    line: ShaftLine, supports: Sequence[LineSupport], speed: float, count: int
) -> Floats:
    """Natural frequencies of the first modes, rad/s; NaN where there are fewer."""
    roots = _Pencil.of(line, supports, speed).roots(shapes=False)[0]
    found = np.abs(roots[_swinging(roots, count)])
    return np.append(found, np.full(count - found.size, np.nan))


def _modes(
    line: ShaftLine, supports: Sequence[LineSupport], speed: float, count: int
) -> tuple[xr.Dataset, NDArray[np.complexfloating]]:
    """As `modes`, on supports that are the same at every frequency, and all roots, 1/s."""
    import xarray as xr

    pencil = _Pencil.of(line, supports, speed)
    system, left, follow, (m, c, k) = pencil.system, pencil.left, pencil.follow, pencil.matrices
    roots, vectors = pencil.roots(shapes=True)
    order = _swinging(roots, count)
    shape = np.full((count, 2, len(system.nodes), 4), np.nan)
    values = np.full((5, count), np.nan)
    for row, i in enumerate(order):
        root, vector = roots[i], vectors[:, i]
        vector = vector / vector[np.argmax(np.abs(vector))]
        terms = [root**2 * (m @ vector), root * (c @ vector), k @ vector]
        missing = np.linalg.norm(sum(terms)) / max(np.linalg.norm(t) for t in terms)
        full = np.zeros(len(system.mass), complex)
        full[left] = follow @ vector
        nodal = full[: 4 * len(system.nodes)].reshape(-1, 4)
        shape[row] = nodal.real, nodal.imag
        size = abs(root)
        values[:, row] = size, root.imag, -root.real / size, _whirl(nodal), missing
    names = {
        "natural_frequency": ("rad/s", "natural frequency |λ|"),
        "damped_frequency": ("rad/s", "frequency of the swing, Im λ"),
        "damping_ratio": ("1", "damping ratio; < 0: unstable"),
        "forward": ("1", "1: whirls with the rotation, −1: against it, 0: on a line"),
        "residual": ("1", "what is missing of M λ² + C λ + K = 0, over its largest term"),
    }
    about = {"units": "1", "long_name": "shape of the mode, largest entry 1"}
    found = xr.Dataset(
        {
            name: ("mode", row, {"units": units, "long_name": meaning})
            for (name, (units, meaning)), row in zip(names.items(), values)
        }
        | {"shape": (("mode", "part", "node", "dof"), shape, about)},
        {
            "mode": np.arange(1, count + 1),
            "part": ["real", "imaginary"],
            "dof": list(DOF),
            "position": (
                "node",
                system.nodes,
                {"units": "m", "long_name": "distance from the hub centre"},
            ),
        },
        {
            "speed": speed,
            "largest_growth": float(roots.real.max()),
            "converged": 1,
            "iterations": 1,
        },
    )
    return found, roots


def unbalance_response(
    line: ShaftLine,
    supports: Callable[[float], Sequence[LineSupport]],
    speeds: ArrayLike,
    unbalance: float,
    position: float = 0.0,
    places: Sequence[float] = (),
) -> xr.Dataset:
    """Steady whirl of a shaft line under an unbalance that turns with it.

    Parameters
    ----------
    line : ShaftLine
        Shaft and discs.
    supports : callable
        Speed (rad/s) → supports with stiffness and damping at that speed.
    speeds : array_like, shape (n,)
        rad/s.
    unbalance : float
        Mass times its distance from the axis, kg m.
    position : float
        Where it is, m from the hub centre.
    places : sequence of float
        Where the answer is wanted, m; default at the unbalance and at the supports.

    Returns
    -------
    xarray.Dataset
        Over (place, speed): ``amplitude``, the larger half axis of the orbit (m). Attributes
        ``converged``, ``residual`` (largest, over the load) and ``iterations``.

    Raises
    ------
    InputError
        Speeds that are not finite; a negative unbalance; a place off the shaft.
    SolverError
        A speed at which an undamped line resonates.

    Examples
    --------
    >>> from loadflow.shaft import Beam, Disc, LineSupport, ShaftLine, ShaftSection
    >>> from loadflow.shaft import unbalance_response
    >>> line = ShaftLine(Beam((ShaftSection(0.1),)), 2.0, (Disc(1.0, 100.0),), density=0.0)
    >>> held = lambda speed: [LineSupport(0.0), LineSupport(2.0)]
    >>> out = unbalance_response(line, held, [1e4], unbalance=1e-3, position=1.0, places=[1.0])
    >>> round(1e6 * float(out.amplitude[0, 0]), 1)  # far above: e = U/m = 10 µm
    10.0
    """
    import xarray as xr

    omega = np.atleast_1d(np.asarray(speeds, dtype=float))
    if omega.ndim != 1 or not np.isfinite(omega).all():
        raise InputError("speeds: a list of finite values, rad/s")
    if not 0 <= unbalance < math.inf:
        raise InputError(f"unbalance = {unbalance} kg m: must be >= 0")
    at = list(places) or [position, *(s.position for s in supports(float(omega[0])))]
    for place in (position, *at):
        if not 0 <= place <= line.length:
            raise InputError(f"{place} m: the shaft is 0 … {line.length} m long")
    amplitude, worst = np.empty((len(at), omega.size)), 0.0
    for j, w in enumerate(omega.tolist()):
        system = assembled(line, supports(w), (position, *at))
        m, c, k, left = system.free(w)
        push = np.zeros(len(system.mass), complex)
        push[system.at(position) : system.at(position) + 2] = unbalance * w**2 * np.array([1, -1j])
        matrix = k + 1j * w * c - w**2 * m
        load = push[left]
        try:
            moved = np.linalg.solve(matrix, load)
        except np.linalg.LinAlgError as error:
            raise SolverError(f"the line resonates without damping at {w:g} rad/s") from error
        size = float(np.linalg.norm(load)) or 1.0
        worst = max(worst, float(np.linalg.norm(matrix @ moved - load)) / size)
        full = np.zeros_like(push)
        full[left] = moved
        for i, place in enumerate(at):
            row = system.at(place)
            amplitude[i, j] = _half_axis(full[row], full[row + 1])
    return xr.Dataset(
        {
            "amplitude": (
                ("place", "speed"),
                amplitude,
                {"units": "m", "long_name": "larger half axis of the orbit under unbalance"},
            )
        },
        {
            "place": ("place", at, {"units": "m", "long_name": "distance from the hub centre"}),
            "speed": ("speed", omega, {"units": "rad/s", "long_name": "speed of the shaft"}),
        },
        {"unbalance": unbalance, "converged": 1, "residual": worst, "iterations": 1},
    )


def _following(mass: Floats, damping: Floats, stiffness: Floats) -> Floats:
    """Motion of all rows, (n, kept), by that of the rows with mass or damping: exact, at rest."""
    still = np.flatnonzero((np.abs(mass) + np.abs(damping)).sum(axis=0) == 0)
    kept = np.setdiff1d(np.arange(len(mass)), still)
    follow = np.zeros((len(mass), kept.size))
    follow[kept, np.arange(kept.size)] = 1.0
    if still.size:
        held = stiffness[np.ix_(still, still)]
        follow[still] = -np.linalg.lstsq(held, stiffness[np.ix_(still, kept)], rcond=None)[0]
    return follow


def _whirl(nodal: NDArray[np.complexfloating]) -> float:
    """1 of an orbit with the rotation, −1 of one against it, in between if it is flat."""
    x, y = nodal[:, 0], nodal[:, 1]
    area, size = np.imag(np.conj(y) * x), np.abs(x) ** 2 + np.abs(y) ** 2
    return float(2 * area.sum() / max(size.sum(), 1e-300))


def _half_axis(x: complex, y: complex) -> float:
    """Larger half axis of the ellipse of two amplitudes at one frequency."""
    return float((abs(x + 1j * y) + abs(x - 1j * y)) / 2)
