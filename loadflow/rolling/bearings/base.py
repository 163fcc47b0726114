"""Verbs of every rolling bearing: at rest, over time, friction, life."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError, SolverError
from loadflow.rolling import friction
from loadflow.rolling.contact_forces import ContactForces, RigidRingForces
from loadflow.rolling.contacts import Array
from loadflow.rolling.equilibrium import CHUNK, Control, RingEquilibrium, solve
from loadflow.rolling.friction.bearing import BearingFriction
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.geometry import RollingGeometry
from loadflow.rolling.motion.spinning import Spin, spin_equilibrium
from loadflow.rolling.rating import modified_life
from loadflow.rolling.rating.modified_life import LifeModification, Lubrication
from loadflow.rolling.results import ContactResult
from loadflow.rolling.rings.condensed import Coupling
from loadflow.rolling.rings.equilibrium import solve_flexible
from loadflow.rolling.rings.flexible import FlexibleRings

if TYPE_CHECKING:
    import xarray as xr

    from loadflow.rolling.raceways import BallRaceways

Kind = TypeVar("Kind", bound="RollingBearing", covariant=True)
_Own = TypeVar("_Own", bound="RollingBearing")
TorqueModel = Literal["forces", "loads", "equivalent"]


@dataclass(frozen=True, repr=False)
class RollingEquilibrium(ContactResult[Kind]):
    """Equilibrium of a rolling bearing of any kind, with its friction and its life.

    Attributes
    ----------
    bearing : RollingBearing
        The bearing.

    Examples
    --------
    >>> from loadflow.rolling import BallBearing
    >>> bearing = BallBearing(balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3,
    ...     groove_radius=0.52 * 12.7e-3)
    >>> loaded = bearing.equilibrium(force=(3000, 0, 0))
    >>> bool(loaded.converged), loaded.element_forces.shape
    (True, (1, 9))
    """

    bearing: Kind

    @property
    def spin(self) -> Spin:
        """Balls at speed: forces and angles at both raceways, loads of inertia.

        Raises
        ------
        AttributeError
            If no speed was given.
        """
        if not isinstance(self.elements, Spin):
            raise AttributeError("spin: give `equilibrium` a speed")
        return self.elements

    def friction(self, speed: ArrayLike, options: FrictionOptions) -> BearingFriction:
        """Films and losses of every contact at a speed.

        Parameters
        ----------
        speed : array_like
            Of the inner ring, rad/s; broadcasts with the load cases.
        options : FrictionOptions
            Oil, temperature, roughness, which components count.

        Raises
        ------
        SolverError
            If there is no friction model for the contacts of this kind of bearing.

        Examples
        --------
        >>> from loadflow.rolling import BallBearing, FrictionOptions
        >>> from loadflow.tribology import lubricant
        >>> bearing = BallBearing(balls=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3,
        ...     groove_radius=0.52 * 11.5e-3)
        >>> loaded = bearing.equilibrium(force=(2000, 0, 500))
        >>> oil = FrictionOptions(oil=lubricant("iso-vg-68"), temperature=333.15)
        >>> bool(loaded.friction(100.0, oil).power > 0)
        True
        """
        return self.bearing.losses(self, speed, options)

    def friction_torque(self, model: TorqueModel | None = None, idle: float = 0.0) -> Array:
        """Friction torque of a slewing bearing by a rule of thumb, N m.

        Parameters
        ----------
        model : {"forces", "loads", "equivalent"}, optional
            By ball forces (2.37), loads (2.25) or equivalent load (2.23) of [Ritzer 2018], each
            with its own friction factor; the first one that the kind of bearing has by default.
        idle : float
            Torque without load, N m.

        Raises
        ------
        InputError
            If the kind of bearing has no such rule; `friction` is for the others.
        """
        known = self.bearing.torque_models
        chosen = next(iter(known), None) if model is None else model
        if chosen is None or chosen not in known:
            rules = " or ".join(repr(name) for name in known) or "none; see friction()"
            raise InputError(f"model: must be {rules}, got {model!r}")
        pitch, factor = self.bearing.pitch_diameter, known[chosen]
        if chosen == "forces":
            return friction.friction_torque_forces(
                self.force_sum, pitch, friction=factor, idle=idle
            )
        if chosen == "loads":
            return friction.friction_torque_components(
                self.force, self.moment, pitch, friction=factor, idle=idle
            )
        return friction.friction_torque_equivalent(
            self.equivalent_load, pitch, friction=factor, idle=idle
        )

    def life(self, speed: ArrayLike | None = None, lubrication: Lubrication | None = None) -> Array:
        """Rating life, millions of revolutions; modified by a_ISO of ISO 281 with a lubrication.

        Parameters
        ----------
        speed : array_like, optional
            rad/s; sets the film of a modified life.
        lubrication : Lubrication, optional
            Oil, temperature, contamination.

        Raises
        ------
        InputError
            A lubrication without a speed, or a film too thin for ISO 281 (κ below 0.1).

        Examples
        --------
        >>> from loadflow.rolling import BallBearing
        >>> bearing = BallBearing(balls=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3,
        ...     groove_radius=0.52 * 11.5e-3, dynamic_capacity=23_400)
        >>> round(float(bearing.equilibrium(force=(2340, 0, 0)).life()) / 1000, 1)
        1.0
        """
        if lubrication is None:
            return self.rating_life
        if speed is None:
            raise InputError("speed: needed for the film of the modified life")
        work = self.bearing.life_modification(self.equivalent_load, speed, lubrication)
        return np.asarray(work.factor * self.rating_life)


class RollingBearing(RollingGeometry):
    """A rolling bearing: the verbs that are the same for all kinds.

    Attributes
    ----------
    friction_model : {"balls", "rollers"}, optional
        Model of the friction of its contacts; None where there is none.
    torque_models : mapping
        Friction factor of each rule of thumb for its torque, the preferred one first.
    element_inertia : bool
        Whether the inertia of its elements can be counted (`equilibrium` with a speed).
    flexible_rings : bool
        Whether its rings may be flexible.

    Examples
    --------
    >>> from loadflow.rolling import BallBearing, RollingBearing
    >>> bearing = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208)
    >>> isinstance(bearing, RollingBearing), bearing.kind, bearing.takes_moment
    (True, 'ball', True)
    """

    words: ClassVar[str] = "rolling bearing"
    friction_model: ClassVar[Literal["balls", "rollers"] | None] = None
    torque_models: ClassVar[Mapping[TorqueModel, float]] = MappingProxyType({})
    element_inertia: ClassVar[bool] = False
    flexible_rings: ClassVar[bool] = False

    def equilibrium(
        self: _Own,
        force: ArrayLike,
        moment: ArrayLike = (0.0, 0.0),
        *,
        rings: Literal["rigid"] | FlexibleRings = "rigid",
        speed: ArrayLike | None = None,
        element_angle: float = 0.0,
        tolerance: float = 1e-10,
        max_iterations: int = 100,
        strict: bool = True,
        chunk: int = CHUNK,
        **renamed: float,
    ) -> RollingEquilibrium[_Own]:
        """Forces on all elements, displacement, stiffness, safety and life under given loads.

        Parameters
        ----------
        force : array_like, shape (..., 3)
            (Fx, Fy, Fz) on the inner ring at the bearing centre, N; z is the bearing axis.
        moment : array_like, shape (..., 2)
            (Mx, My) on the inner ring, N m. Broadcasts with `force`.
        rings : "rigid" or FlexibleRings
            How the rings deform. With flexible rings the displacement is that of the inner ring's
            structure relative to the outer ring's, where their supports hold them.
        speed : array_like, optional
            Of the inner ring, rad/s; switches centrifugal and gyroscopic loads of balls on.
        element_angle : float
            Azimuth of the first rolling element of each row, rad.
        tolerance, max_iterations, strict, chunk
            See `loadflow.rolling.equilibrium.solve`.

        Returns
        -------
        RollingEquilibrium
            Over the shape of the load cases. The axial displacement of a deep groove ball bearing
            counts from its centred position.

        Raises
        ------
        InputError
            If loads are not finite or have wrong shapes, a self-aligning bearing gets a moment, or
            this kind of bearing has no such `rings` or no inertia of its elements.
        SolverError
            If `strict` and a case has no equilibrium, e.g. an axial force on cylindrical rollers.
        """
        angle = _first_angle(element_angle, renamed)
        control = Control(tolerance, max_iterations, strict, chunk)
        self._refuse(moment, rings, speed)
        contacts = self.contacts(angle)
        rest: RingEquilibrium
        elements: ContactForces
        if rings != "rigid":
            coupling = self.ring_coupling(angle)
            rest, elements = solve_flexible(coupling, rings, force, moment, control)
        else:
            rest = solve(contacts, force, moment, **vars(control))
            elements = RigidRingForces(contacts, rest.displacement)
        if speed is not None:
            rest, elements = spin_equilibrium(
                self._balls,
                contacts,
                rest,
                speed,
                tolerance=max(tolerance, 1e-9),
                max_iterations=max_iterations,
            )
        found = {field.name: getattr(rest, field.name) for field in fields(rest)}
        return RollingEquilibrium(**found, bearing=self, contacts=contacts, elements=elements)

    def orbit(
        self,
        time: ArrayLike,
        force: ArrayLike,
        moment: ArrayLike = (0.0, 0.0),
        speed: ArrayLike = 0.0,
        *,
        friction: FrictionOptions | None = None,
        **options: Any,
    ) -> xr.Dataset:
        """Path of the inner ring under a load that changes with time; quasi-static, without mass.

        Parameters
        ----------
        time : array_like, shape (n,)
            s, increasing.
        force, moment : array_like, shape (n, 3) and (n, 2)
            Load on the inner ring, N and N m.
        speed : array_like, shape (n,)
            Of the inner ring, rad/s.
        friction : FrictionOptions, optional
            Adds ``friction_power`` and ``friction_torque``.
        **options
            Of `equilibrium`; its `speed`, which counts the inertia of balls, stays out.

        Returns
        -------
        xarray.Dataset
            `ContactResult.to_dataset` over ``time``, with ``speed``.

        Raises
        ------
        InputError
            Times that do not increase or differ in shape from the loads.
        SolverError
            As `equilibrium`.

        Examples
        --------
        >>> from loadflow.rolling import BallBearing
        >>> bearing = BallBearing(balls=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3,
        ...     groove_radius=0.52 * 11.5e-3)
        >>> path = bearing.orbit([0.0, 0.1], [(1000, 0, 0), (2000, 0, 0)], speed=100.0)
        >>> dict(path.maximum_force.sizes)
        {'time': 2}
        """
        times = np.asarray(time, float)
        if times.ndim != 1 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
            raise InputError("time: a list of finite values that increase")
        found = self.equilibrium(force, moment, **options)
        if found.cases != times.shape:
            raise InputError(f"time {times.shape} and loads {found.cases} differ in shape")
        omega = np.broadcast_to(np.asarray(speed, float), times.shape)
        path = found.to_dataset().rename(case="time")
        more = {"speed": (omega, "rad/s", "speed of the inner ring")}
        if friction is not None:
            losses = found.friction(omega, friction)
            more["friction_power"] = losses.power, "W", "friction loss"
            more["friction_torque"] = losses.torque, "N m", "friction torque"
        return path.assign(
            {
                name: ("time", np.asarray(values), {"units": units, "long_name": meaning})
                for name, (values, units, meaning) in more.items()
            }
        ).assign_coords(time=("time", times, {"units": "s", "long_name": "time"}))

    def losses(
        self, result: RollingEquilibrium[RollingBearing], speed: ArrayLike, options: FrictionOptions
    ) -> BearingFriction:
        """Friction of the contacts of a `result`; see `RollingEquilibrium.friction`."""
        raise SolverError(
            f"no model of friction for the contacts of a {type(self).__name__}; "
            "rolling.friction_torque_loads estimates its torque from the loads"
        )

    def ring_coupling(self, element_angle: float = 0.0) -> Coupling:
        """How its contacts feel flexible rings.

        Parameters
        ----------
        element_angle : float
            Azimuth of the first rolling element of each row, rad.

        Raises
        ------
        InputError
            If this kind of bearing has rigid rings only.

        Examples
        --------
        >>> from loadflow.rolling import RollerBearing
        >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
        ...     pitch_diameter=60.5e-3)
        >>> bearing.ring_coupling().elements
        14
        """
        raise InputError(f"rings: a {type(self).__name__} has rigid rings only")

    @property
    def _balls(self) -> BallRaceways:
        """The bearing as one of balls, which inertia is for."""
        return cast("BallRaceways", self)

    @property
    def life_kind(self) -> modified_life.Kind:
        """Kind of bearing in ISO 281: slewing rings are rated axially, the others radially."""
        side = "thrust" if self.rated_axially else "radial"
        return f"{side}-{self.element}"  # type: ignore[return-value]

    def life_modification(
        self,
        load: ArrayLike,
        speed: ArrayLike,
        lubrication: Lubrication,
        limit: float = modified_life.LARGEST_FACTOR,
    ) -> LifeModification:
        """`loadflow.rolling.life_modification` of this bearing, C₀ of ISO 76 from its geometry.

        Parameters
        ----------
        load : array_like
            Dynamic equivalent load, N.
        speed : array_like
            rad/s.
        lubrication : Lubrication
            Oil, temperature, contamination.
        limit : float
            Largest a_ISO.

        Raises
        ------
        InputError
            As `loadflow.rolling.life_modification`.
        """
        return modified_life.life_modification(
            load,
            speed,
            lubrication=lubrication,
            kind=self.life_kind,
            pitch_diameter=self.pitch_diameter,
            static_capacity=self.static_capacity,
            limit=limit,
        )

    def _refuse(self, moment: ArrayLike, rings: object, speed: ArrayLike | None) -> None:
        """Refuse what this kind of bearing does not know."""
        name = type(self).__name__
        if not self.takes_moment and np.any(np.asarray(moment, float) != 0):
            raise InputError("moment: a self-aligning bearing takes none, it must be 0")
        if rings != "rigid" and not isinstance(rings, FlexibleRings):
            raise InputError(f"rings: must be 'rigid' or FlexibleRings, got {rings!r}")
        if speed is not None and not self.element_inertia:
            raise InputError(f"speed: the inertia of the elements of a {name} is not modelled")
        if speed is not None and rings != "rigid":
            raise InputError("speed: the inertia of the elements is modelled with rigid rings only")


def _first_angle(angle: float, renamed: dict[str, float]) -> float:
    """Azimuth of the first element, also by its former names."""
    for name, value in renamed.items():
        if name not in ("ball_angle", "roller_angle"):
            raise TypeError(f"equilibrium() got an unexpected keyword argument {name!r}")
        warnings.warn(f"{name} is now element_angle", DeprecationWarning, stacklevel=3)
        angle = value
    return angle
