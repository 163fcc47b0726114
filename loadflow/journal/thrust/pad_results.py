"""What thrust bearings and conical bearings answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.grid_bounds import UNRESOLVED, PadError
from loadflow.numerics.shown import Shown
from loadflow.quantities import FILM, GRID_ERROR, Quantity

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Table = dict[str, tuple[tuple[str, ...], str, str]]

PADS: Table = {
    "normal_force": (("pad",), "N", "pressure above that at the edges, over each pad"),
    "load_share": (("pad",), "1", "share of each pad in the sum of the normal forces"),
    "pad_tilt": (("pad", "pad_axis"), "rad", "tilt of each pad about generator and motion"),
    "pad_displacement": (("pad",), "m", "way of each pad's support along the normal"),
    "minimum_film": ((), "m", "minimum film thickness"),
    "maximum_pressure": ((), "Pa", "largest film pressure, absolute"),
    "friction_torque": ((), "N m", "friction torque of the film on the shaft"),
    "friction_power": ((), "W", "friction power of the film"),
    "flow": ((), "m^3/s", "oil that enters at the leading edges of the pads"),
    "side_flow": (("end",), "m^3/s", "oil that leaves at the inner and the outer end"),
    "mass_balance": ((), "1", "oil that leaves the cells less what enters, over what is dragged"),
    "stiffness_matrix": (
        ("load", "motion"),
        "N/m, N, N m",
        "load per motion",
    ),
    "damping_matrix": (
        ("load", "motion"),
        "N s/m, N s, N m s",
        "load per velocity",
    ),
    "pressure": (("pad", "along", "across"), "Pa", "film pressure on the nodes, absolute"),
    "angle": (("pad", "along"), "rad", "angle of the nodes from the first axis"),
    "place": (("across",), "m", "distance of the nodes from the apex or the axis"),
    "speed": ((), "rad/s", "speed of the shaft"),
    "converged": ((), "1", "whether the residual fell below the tolerance"),
    "residual": ((), "1", "largest imbalance of cells, pads and shaft, scaled"),
    "iterations": ((), "1", "Newton steps"),
    "resolved": ((), "1", "whether the cells resolve the films"),
}


class Shows(Shown):
    """Shown by the table of the class."""

    _table: ClassVar[Table]

    @classmethod
    def told(cls) -> Table:
        """Dimensions, units and meaning of what it tells, by name."""
        return cls._table

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of pads."""
        known = {name: FILM[name].symbol for name in self._table if name in FILM}
        return {
            name: Quantity(known.get(name, ""), units, text)
            for name, (_, units, text) in self._table.items()
        }


@dataclass(frozen=True, repr=False)
class PadResult(Shows):
    """What all bearings of pads answer.

    Attributes
    ----------
    normal_force : array (pads,)
        ∫ (p − p_edge) dA of each pad, N.
    load_share : array (pads,)
        Share of each pad in their sum.
    pad_tilt : array (pads, 2)
        Tilt of each pad about the generator (the radius) and about the direction of motion through
        its pivot, rad; the first is > 0 where the film narrows with the motion.
    pad_displacement : array (pads,)
        Way of each pad's support along the normal, out of the shaft, m.
    minimum_film, maximum_pressure : float
        m; Pa, absolute.
    friction_torque, friction_power : float
        Of pure liquid in the whole gap, N m and W.
    flow : float
        Oil that enters at the leading edges of the pads, m³/s; 0 for a whole ring.
    side_flow : array (2,)
        Oil that leaves at the inner and at the outer end, m³/s.
    mass_balance : float
        Oil that leaves the cells of a pad less what enters, over what is dragged through.
    stiffness_matrix, damping_matrix : array (m, m)
        Derivatives of the load by position and velocity of the shaft, pads following; N, m, rad.
    pressure : array (pads, n, m)
        Of the nodes, those on the edges included, Pa, absolute.
    angle : array (pads, n)
        Of the nodes, from the first axis, rad.
    place : array (m,)
        Distance of the nodes from the apex (cone) or the axis (ring), m.
    speed : float
        rad/s.
    converged : bool
        Whether `residual` fell below the tolerance.
    residual : float
        Largest imbalance of cells, pads and shaft, over their scales.
    iterations : int
        Newton steps.
    relative_grid_error : array (4,)
        Bounds of what the cells do to the force, the smallest film, the largest pressure and the
        friction power, over their values.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, Lubricant, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4, wedge=0.75)
    >>> found = bearing.pressure(gap=1e-4, speed=10.0, film=Film(Lubricant(0.05), Guembel(),
    ...     grid=(20, 10)))
    >>> found.load_share.round(3).tolist(), found.pressure.shape
    ([0.167, 0.167, 0.167, 0.167, 0.167, 0.167], (6, 21, 11))
    """

    normal_force: Array
    load_share: Array
    pad_tilt: Array
    pad_displacement: Array
    minimum_film: float
    maximum_pressure: float
    friction_torque: float
    friction_power: float
    flow: float
    side_flow: Array
    mass_balance: float
    stiffness_matrix: Array
    damping_matrix: Array
    pressure: Array
    angle: Array
    place: Array
    speed: float
    converged: bool
    residual: float
    iterations: int
    relative_grid_error: Array

    _table: ClassVar[Table] = PADS

    @property
    def grid_error(self) -> PadError:
        """Bounds of what the cells do to the results, told from the solved films alone."""
        force = np.linalg.norm(np.atleast_1d(getattr(self, "force", 0.0)))
        sizes = force, self.minimum_film, self.maximum_pressure, self.friction_power
        return PadError(*(float(x) for x in np.array(sizes) * self.relative_grid_error))

    @property
    def resolved(self) -> bool:
        """Whether the cells resolve the films: force and smallest film to 25 %."""
        return bool(self.converged and self.relative_grid_error[:2].max() < UNRESOLVED)

    def to_dataset(self) -> xr.Dataset:
        """The result as a Dataset; every variable has `units` and `long_name`."""
        import xarray as xr

        data = {
            name: (dims, getattr(self, name), {"units": units, "long_name": text})
            for name, (dims, units, text) in self._table.items()
        }
        bounds = vars(self.grid_error).items()
        data |= {n + GRID_ERROR: ((), x, FILM[n + GRID_ERROR].attributes) for n, x in bounds}
        return xr.Dataset(data)

    def plot(self) -> Figure:
        """Draw the pressure over each pad, seen along the axis.

        Examples
        --------
        >>> from loadflow.journal import Lubricant, ThrustBearing
        >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
        >>> len(bearing.pressure(1e-4, 10.0, Lubricant(0.05), grid=(20, 10)).plot().axes)
        2
        """
        return drawn(pads=self)

    def __repr__(self) -> str:
        """The state in short."""
        name = type(self).__name__
        if not self.converged:
            return f"<{name}: not converged, residual {self.residual:.2g}>"
        said = (
            f"h_min = {self.minimum_film * 1e6:.4g} µm, p_max = {self.maximum_pressure / 1e6:.4g} "
            f"MPa, P_f = {self.friction_power:.4g} W"
        )
        missed = "" if self.resolved else ", not resolved"
        return f"<{name}: {said}{missed}, {self.iterations} iterations>"


@dataclass(frozen=True, repr=False)
class ThrustResult(PadResult):
    """Film of a thrust bearing at a given gap, or in equilibrium.

    Attributes
    ----------
    force : float
        Axial force of all pads, N; > 0 presses the runner on the pads.
    moment : array (2,)
        What the runner applies to the pads about the first and the second axis, N m.
    gap : float
        Film over the lands on the axis of an aligned runner (its least film), m; over the pivots
        of pads that tilt. Of pads on elastic supports it is told as they stand without load, and is
        negative where they give way by more than their film.
    tilt : array (2,)
        Rotation of the runner about both axes, rad.
    pad_force : float or array (pads,)
        Axial force of one pad, N; an array where the runner is tilted.
    centre : tuple of float or array (pads, 2)
        Centre of pressure of a pad: radius, m, and share of the pad's angle from the inlet.
    stiffness, damping : float
        Axial, N/m and N s/m; the matrices hold (z, rotations about both axes).

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, Lubricant, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4, wedge=0.75)
    >>> found = bearing.pressure(gap=1e-4, speed=10.0, film=Film(Lubricant(0.05), Guembel(),
    ...     grid=(20, 10)))
    >>> round(found.force / found.pad_force, 6), found.stiffness > 0
    (6.0, True)
    """

    force: float
    moment: Array
    gap: float
    tilt: Array
    pad_force: float | Array
    centre: tuple[float, float] | Array
    stiffness: float
    damping: float

    _table: ClassVar[Table] = PADS | {
        "force": ((), "N", "axial force of all pads"),
        "moment": (("axis",), "N m", "moment of the runner on the pads about both axes"),
        "gap": ((), "m", "film over the lands on the axis"),
        "tilt": (("axis",), "rad", "rotation of the runner about both axes"),
        "stiffness": ((), "N/m", "axial stiffness"),
        "damping": ((), "N s/m", "axial damping"),
    }


@dataclass(frozen=True, repr=False)
class ConicalResult(PadResult):
    """Film of a conical bearing at a given position, or in equilibrium.

    Attributes
    ----------
    force, moment : array (3,), (2,)
        What the shaft applies to the bearing, N and N m about the middle of its length.
    eccentricity, tilt : array (3,), (2,)
        Shaft relative to the bearing, m, and rotation about the first two axes, rad.
    pad_forces : array (pads, 3)
        What the shaft applies to each pad, N.
    centre : array (pads, 2)
        Centre of the pressure of each pad: distance from the apex, m, and angle, rad.
    stiffness, damping : array (5, 5)
        Derivatives of force and moment by position and velocity (x, y, z, about x, about y).

    Examples
    --------
    >>> from loadflow.journal import ConicalBearing, Film, Guembel, Lubricant
    >>> bearing = ConicalBearing(half_angle=0.52, slant=(1.0, 1.5), clearance=1e-4)
    >>> film = Film(Lubricant(0.05), Guembel(), inlet=None, grid=(40, 10))
    >>> found = bearing.pressure(eccentricity=(5e-5, 0.0, 0.0), speed=10.0, film=film)
    >>> found.force.shape, found.stiffness.shape, bool(found.converged)
    ((3,), (5, 5), True)
    """

    force: Array
    moment: Array
    eccentricity: Array
    tilt: Array
    pad_forces: Array
    centre: Array

    _table: ClassVar[Table] = PADS | {
        "force": (("space",), "N", "force of the shaft on the bearing"),
        "moment": (("axis",), "N m", "moment of the shaft on the bearing about both axes"),
        "eccentricity": (("space",), "m", "shaft relative to the bearing"),
        "tilt": (("axis",), "rad", "rotation of the shaft about both axes"),
        "pad_forces": (("pad", "space"), "N", "force of the shaft on each pad"),
        "centre": (("pad", "polar"), "m, rad", "centre of pressure: distance from apex, angle"),
    }

    @property
    def stiffness(self) -> Array:
        """As `stiffness_matrix`."""
        return self.stiffness_matrix

    @property
    def damping(self) -> Array:
        """As `damping_matrix`."""
        return self.damping_matrix


@dataclass(frozen=True, repr=False)
class PairResult(Shows):
    """Films of two cones against each other.

    Attributes
    ----------
    left, right : ConicalResult
        Each in the frame of its cone.
    force, moment : array (3,), (2,)
        What the shaft applies to both, N and N m about the origin of the pair.
    eccentricity, tilt : array (3,), (2,)
        Of the shaft at the origin, m and rad.
    load_share : array (2,)
        Shares of left and right in the sum of the normal forces.
    minimum_film, maximum_pressure, friction_torque, friction_power : float
        Of both.
    stiffness, damping : array (5, 5)
        Derivatives of force and moment by position and velocity (x, y, z, about x, about y).
    speed, converged, residual, iterations
        As in `PadResult`.

    Examples
    --------
    >>> from loadflow.journal import ConicalBearing, ConicalPair, Film, Guembel, Lubricant
    >>> cone = ConicalBearing(half_angle=0.5, slant=(1.0, 1.3), clearance=2e-4)
    >>> pair = ConicalPair(cone, cone, distance=1.0, clearance=2e-4)
    >>> film = Film(Lubricant(0.1), Guembel(), inlet=None, grid=(40, 10))
    >>> state = pair.equilibrium((1e5, 0.0, 5e4), moment=(0.0, 0.0), speed=1.0, film=film)
    >>> round(float(state.load_share.sum()), 6), state.stiffness.shape
    (1.0, (5, 5))
    """

    left: ConicalResult
    right: ConicalResult
    force: Array
    moment: Array
    eccentricity: Array
    tilt: Array
    load_share: Array
    minimum_film: float
    maximum_pressure: float
    friction_torque: float
    friction_power: float
    stiffness: Array
    damping: Array
    speed: float
    converged: bool
    residual: float
    iterations: int

    _table: ClassVar[Table] = {
        "force": (("space",), "N", "force of the shaft on the bearing"),
        "moment": (("axis",), "N m", "moment of the shaft on the bearing about both axes"),
        "eccentricity": (("space",), "m", "shaft relative to the bearing"),
        "tilt": (("axis",), "rad", "rotation of the shaft about both axes"),
        "load_share": (("cone",), "1", "share of each cone in the sum of the normal forces"),
        "stiffness": (("load", "motion"), "N/m, N, N m", "load per motion"),
        "damping": (("load", "motion"), "N s/m, N s, N m s", "load per velocity"),
    } | {
        name: PADS[name]
        for name in (
            "minimum_film", "maximum_pressure", "friction_torque", "friction_power", "speed",
            "converged", "residual", "iterations", "resolved",
        )
    }  # fmt: skip

    @property
    def side_flow(self) -> float:
        """Oil that leaves at both ends of both cones, m³/s."""
        return float(np.sum(self.left.side_flow) + np.sum(self.right.side_flow))

    @property
    def grid_error(self) -> PadError:
        """Bounds of what the cells do to the results, of both cones together."""
        return of_both(self.left, self.right)

    @property
    def resolved(self) -> bool:
        """Whether the cells resolve both films."""
        return self.left.resolved and self.right.resolved

    def plot(self) -> Figure:
        """Draw the pressure over both cones."""
        return drawn(left=self.left, right=self.right)

    to_dataset = PadResult.to_dataset
    __repr__ = PadResult.__repr__


def drawn(**results: PadResult) -> Figure:
    """Pressures of films of pads beside each other, each under its name."""
    from loadflow import plots

    return plots.pads({k: (one.angle, one.place, one.pressure) for k, one in results.items()})


def of_both(one: PadResult, other: PadResult) -> PadError:
    """Bounds of two bearings together: forces and friction add up, the worse film counts."""
    a, b = one.grid_error, other.grid_error
    return PadError(
        a.force + b.force,
        max(a.minimum_film, b.minimum_film),
        max(a.maximum_pressure, b.maximum_pressure),
        a.friction_power + b.friction_power,
    )


def common(described: dict[str, Any]) -> dict[str, Any]:
    """Those of the `described` results of pads that `PadResult` has by the same name."""
    names = {part.name for part in fields(PadResult)}
    return {name: value for name, value in described.items() if name in names}


_ORBIT: Table = {
    "minimum_film": (("time",), "m", "minimum film thickness"),
    "maximum_pressure": (("time",), "Pa", "largest film pressure, absolute"),
    "friction_power": (("time",), "W", "friction power of the film"),
    "load_share": (("time", "pad"), "1", "share of each pad in the sum of the normal forces"),
    "residual": (("time",), "1", "largest imbalance of cells, pads and shaft, scaled"),
    "iterations": (("time",), "1", "Newton steps"),
}


def orbit_dataset(time: Array, positions: Array, rows: list[dict[str, Any]]) -> xr.Dataset:
    """A path as a Dataset: positions (n, 5) and what the films say at every time."""
    import xarray as xr

    data = {
        name: (dims, np.array([row[name] for row in rows]), {"units": units, "long_name": text})
        for name, (dims, units, text) in _ORBIT.items()
    }
    place = {"units": "m", "long_name": "shaft relative to the bearing"}
    tilt = {"units": "rad", "long_name": "rotation of the shaft about both axes"}
    return xr.Dataset(
        {
            "eccentricity": (("time", "space"), positions[:, :3], place),
            "tilt": (("time", "axis"), positions[:, 3:], tilt),
            **data,
        },
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )
