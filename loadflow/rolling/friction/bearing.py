"""What the friction of all bearings shares: the result, and the sum over contacts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.shown import Shown, span_in_words
from loadflow.quantities import Quantity, load_cases
from loadflow.rolling.friction.contact_films import ContactFilm, Ring
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.tribology import asperities, traction

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
RINGS: tuple[Ring, ...] = ("inner", "outer")

_SHOWN = {
    "speed": Quantity("ω", "rad/s", "speed of the inner ring over the outer"),
    "power": Quantity("P", "W", "friction loss"),
    "torque": Quantity("M", "N m", "friction torque"),
    "least_film_parameter": Quantity("Λ", "1", "least film parameter of all contacts"),
}
_OF_CONTACTS = {
    "film": (("row", "element", "ring"), "m", "central film thickness"),
    "film_parameter": (("row", "element", "ring"), "1", "film parameter Λ"),
    "asperity_share": (("row", "element", "ring"), "1", "share of the load on asperities"),
    "traction_use": (
        ("row", "element"),
        "1",
        "friction needed for ideal rolling over that there is",
    ),
    "sliding": (("row", "element"), "1", "mean sliding over rolling speed"),
    "slip_power_density": (("row", "element"), "W/m^2", "power of sliding over contact area"),
}


@dataclass(frozen=True, repr=False)
class BearingFriction(Shown):
    """Friction of a bearing; contacts over (..., row, element, ring), ring = inner, outer.

    Of ball bearings the axis of rows is that of their kinds of contact (row and diagonal).

    Attributes
    ----------
    speed : ndarray, shape (...)
        Speed of the inner less that of the outer ring, rad/s.
    losses : dict of str to ndarray, shape (...)
        Power of each component, W: hysteresis, rolling, drag, churning, seal; rib of roller
        bearings; differential slip of balls and of barrels (of these with the turning of the
        rings about the contact's normal); spin of balls.
    film : ndarray
        Central film, m; very large where a turning contact has no load, 0 at standstill.
    film_parameter : ndarray
        Λ.
    asperity_share : ndarray
        Share of the load that asperities carry; 0 without load.
    traction_use : ndarray, shape (..., row, element)
        Friction that ideal rolling needs over what both contacts can give.
    sliding : ndarray, shape (..., row, element), optional
        Of balls and barrels: mean sliding speed in the contact over the rolling speed, from the
        curved contact and from spin; 0 without load.
    slip_power_density : ndarray, shape (..., row, element), optional
        Of these: power of that sliding over the area of the contact, W/m², the larger of both.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.rolling.friction import roller_friction
    >>> from loadflow.tribology import lubricant
    >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.5)
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> found = roller_friction(bearing.equilibrium((1e5, 0.0, 0.0)), 10.0, options)
    >>> sorted(found.losses), found.film_parameter.shape
    (['churning', 'drag', 'hysteresis', 'rib', 'rolling', 'seal'], (1, 24, 2))
    """

    speed: Array
    losses: dict[str, Array]
    film: Array
    film_parameter: Array
    asperity_share: Array
    traction_use: Array
    sliding: Array | None = None
    slip_power_density: Array | None = None

    @property
    def power(self) -> Array:
        """All losses together, W."""
        return np.asarray(sum(self.losses.values()))

    @property
    def torque(self) -> Array:
        """Friction torque, N m."""
        return np.asarray(sum(self.torques.values()))

    @property
    def torques(self) -> dict[str, Array]:
        """Torque of each component, N m; all vanish at standstill (breakaway is not modelled)."""
        turning = np.abs(self.speed)
        safe = np.where(turning > 0, turning, 1.0)
        return {name: np.asarray(p / safe) for name, p in self.losses.items()}

    @property
    def least_film_parameter(self) -> Array:
        """Smallest Λ of all contacts, (...)."""
        return np.asarray(self.film_parameter.min(axis=(-3, -2, -1)))

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of friction."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """The result over ``case``, with units; of one load case without that dimension.

        Returns
        -------
        xarray.Dataset
            Speed, power and torque in all; power and torque over ``component``; film, Λ and shares
            of the contacts over ``row``, ``element`` and ``ring``.

        Examples
        --------
        >>> from loadflow.rolling import FrictionOptions, RollerBearing
        >>> from loadflow.tribology import lubricant
        >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
        ...     pitch_diameter=0.5)
        >>> state = bearing.equilibrium((1e5, 0.0, 0.0))
        >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.0)
        >>> found = state.friction([5.0, 10.0], options)
        >>> data = found.to_dataset()
        >>> data["torques"].dims, data["film"].dims
        (('case', 'component'), ('case', 'row', 'element', 'ring'))
        """
        import xarray as xr

        cases = np.shape(self.power)
        lead = ("case",) if cases else ()

        def flat(values: Array, inner: int) -> Array:
            own = values.shape[values.ndim - inner :]
            whole = np.broadcast_to(values, (*cases, *own))
            return whole.reshape((*(-1,) * len(lead), *own))

        told = {n: (lead, flat(np.asarray(getattr(self, n)), 0), q) for n, q in _SHOWN.items()}
        data = {name: (dims, values, q.attributes) for name, (dims, values, q) in told.items()}
        for name, parts, units, meaning in (
            ("losses", self.losses, "W", "power of each component"),
            ("torques", self.torques, "N m", "torque of each component"),
        ):
            rows = np.stack([flat(np.asarray(one), 0) for one in parts.values()], axis=-1)
            data[name] = (*lead, "component"), rows, {"units": units, "long_name": meaning}
        for name, (dims, units, meaning) in _OF_CONTACTS.items():
            values = getattr(self, name)
            if values is not None:
                about = {"units": units, "long_name": meaning}
                data[name] = (*lead, *dims), flat(values, len(dims)), about
        return xr.Dataset(data, {"component": [*self.losses], "ring": [*RINGS]})

    def plot(self) -> Figure:
        """Draw torque by component and the least film parameter, over speed or load case.

        Returns
        -------
        matplotlib.figure.Figure

        Examples
        --------
        >>> from loadflow.rolling import FrictionOptions, RollerBearing
        >>> from loadflow.tribology import lubricant
        >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
        ...     pitch_diameter=0.5)
        >>> state = bearing.equilibrium((1e5, 0.0, 0.0))
        >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.0)
        >>> found = state.friction([5.0, 10.0], options)
        >>> [axis.get_xlabel() for axis in found.plot().axes]
        ['speed, 1/min', 'speed, 1/min']
        """
        from loadflow import plots

        data = self.to_dataset()
        data = data if "case" in data.dims else data.expand_dims("case")
        several = np.unique(data["speed"]).size == data.sizes["case"]
        data = data.sortby("speed") if several else data
        at, label = np.arange(1.0, data.sizes["case"] + 1), "load case"
        if several:
            at, unit = plots.readable(data["speed"])
            label = f"speed, {unit}"
        drawing, (left, right) = plots.figure(1, 2, height=3.0)
        for name in data["component"].values:
            part = data["torques"].sel(component=name)
            if np.any(part):
                left.plot(at, part, "o-", ms=3, label=str(name))
        left.plot(at, data["torque"], "o-", ms=3, color="0.3", label="all together")
        left.set(xlabel=label, ylabel="friction torque, N m")
        left.legend()
        right.plot(at, data["least_film_parameter"], "o-", ms=3)
        right.set(xlabel=label, ylabel="least film parameter Λ")
        return drawing

    def __repr__(self) -> str:
        lines = [f"<{type(self).__name__} of {load_cases(int(np.size(self.power)))}>"]
        for name, (_, units, meaning) in _SHOWN.items():
            span, unit = span_in_words(np.asarray(getattr(self, name)), units)
            lines.append(f"  {meaning:38s} {span} {unit}".rstrip())
        return "\n".join(lines)


class ContactFriction(NamedTuple):
    """Contacts with one ring: film, rolling forces on each surface (N), what friction can give (N).

    `parameter` is Λ, `share` that of the asperities.
    """

    film: Array
    parameter: Array
    share: Array
    rolling: Array
    hysteresis: Array
    grip: Array


def contact_friction(
    force: Array, film: ContactFilm, rolling: Array, hysteresis: Array, options: FrictionOptions
) -> ContactFriction:
    """Collect the friction of the contacts with one ring.

    Parameters
    ----------
    force : ndarray
        N.
    film : ContactFilm
        Of the contacts.
    rolling, hysteresis : ndarray
        Hydrodynamic rolling force of a flooded cold inlet, and that of hysteresis, N.
    options : FrictionOptions
        Oil and surfaces.
    """
    oil = options.oil
    parameter = np.asarray(asperities.film_parameter(film.film, options.roughness))
    share = np.where(force > 0, asperities.asperity_share(parameter), 0.0)
    limit = traction.limiting_stress(
        film.pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    area = 2 * film.half_width * film.length
    grip = traction.mixed_force(limit, area, force, share, options.boundary_friction)
    return ContactFriction(
        film.film, parameter, share, np.asarray(film.share * rolling), hysteresis, np.asarray(grip)
    )


def case_speeds(speed: ArrayLike, cases: tuple[int, ...]) -> Array:
    """Speeds broadcast with the cases; an `InputError` where they do not fit."""
    omega = np.asarray(speed, float)
    if not np.isfinite(omega).all():
        raise InputError("speed: must be finite")
    try:
        return np.broadcast_to(omega, np.broadcast_shapes(omega.shape, cases))
    except ValueError:
        raise InputError(f"speed {omega.shape} does not fit the cases {cases}") from None


def sum_losses(
    speed: Array,
    mean_speed: Array,
    diameter: float,
    contacts: Sequence[ContactFriction],
    special: dict[str, Array],
    options: FrictionOptions,
) -> BearingFriction:
    """Friction of a bearing from its contacts.

    Parameters
    ----------
    speed : ndarray, shape (...)
        rad/s.
    mean_speed : ndarray
        Mean surface speed of the contacts, m/s, broadcasts with them.
    diameter : float
        Of the rolling elements, m.
    contacts : sequence of ContactFriction
        With the inner and the outer ring, (..., row, element).
    special : dict of str to ndarray
        Further losses of each contact, W.
    options : FrictionOptions
        Drag, churning, seals.
    """
    oil, t = options.oil, options.temperature
    shape = contacts[0].grip.shape
    spin = 2 * mean_speed / diameter
    drag = options.roller_drag * spin
    turning = np.abs(speed)

    def total(power: Array) -> Array:
        return np.asarray(np.broadcast_to(power, shape).sum(axis=(-2, -1)))

    hysteresis, rolling, grip = (
        np.sum([getattr(c, name) for c in contacts], axis=0)
        for name in ("hysteresis", "rolling", "grip")
    )
    churning = options.churning.torque(turning, oil.viscosity(t), oil.density(t))
    losses = {
        "hysteresis": total(2 * mean_speed * hysteresis),
        "rolling": total(2 * mean_speed * rolling),
        "drag": total(drag * spin),
        "churning": churning * turning,
        "seal": options.seal_torque * turning,
        **{name: total(power) for name, power in special.items()},
    }
    needed = np.broadcast_to(rolling + hysteresis + 2 * drag / diameter, shape)
    return BearingFriction(
        speed=speed,
        losses=losses,
        film=np.stack([c.film for c in contacts], axis=-1),
        film_parameter=np.stack([c.parameter for c in contacts], axis=-1),
        asperity_share=np.stack([c.share for c in contacts], axis=-1),
        traction_use=np.divide(needed, grip, out=np.full(shape, np.inf), where=grip > 0),
    )
