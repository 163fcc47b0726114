"""Stiffness and damping of a bearing over load and frequency, for rotor dynamics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.contacts import POINT, STIFFNESS
from loadflow.rolling.friction.contact_films import (
    ContactFilm,
    Ring,
    groove_film,
    line_film,
    raceway_radius,
)
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.geometry import RollingGeometry
from loadflow.rolling.kinematics import entrainment_speed
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.results import ContactResult
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.rolling.stiffness import contact_films as dynamics
from loadflow.tribology.hertz import effective_modulus
from loadflow.tribology.lubricant_laws import bulk_modulus

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Complex = NDArray[np.complexfloating]
Result = ContactResult[BallRaceways] | ContactResult[RollerRaceways]
Model = Literal["film", "dry", "proportional"]
DOF = ("x", "y", "z", "theta_x", "theta_y", "theta_z")
RINGS: tuple[Ring, ...] = ("inner", "outer")
# m of h ~ Q^-m: Moes's elastic film of lines, Hamrock and Dowson's of points
_LINE_EXPONENT, _POINT_EXPONENT = 0.125, 0.067


def rotor_coefficients(
    result: Result,
    frequency: ArrayLike,
    *,
    speed: ArrayLike = 0.0,
    options: FrictionOptions | None = None,
    model: Model = "film",
    loss: float = 0.01,
    time_constant: float = 1e-5,
) -> xr.Dataset:
    """Stiffness and damping matrices of a bearing.

    Each loaded contact (ball, or slice of a roller) is a Hertzian spring with the steel's loss, in
    series with the films at both rings; their sum replaces the dry contacts in the exact tangent of
    the load distribution. A film is its quasi-static stiffness Q/(m h) beside Richter's plate,
    which alone would drain away at low frequency.

    Parameters
    ----------
    result : ContactResult
        Equilibrium under cases (...), with rigid rings.
    frequency : array_like, shape (frequency,)
        Circular frequencies of the vibration (not of the shaft), rad/s, > 0.
    speed : array_like
        Speed of the rings against each other, rad/s; broadcasts with the cases. Gives the films.
    options : FrictionOptions, optional
        Oil, temperature, film law; needed by "film".
    model : {"film", "dry", "proportional"}
        Films in series (Richter's plate); steel alone; steel with C = σ K.
    loss : float
        ψ of the steel, the share of the stiffness that damps: a damping of ψ k/ω.
    time_constant : float
        σ of "proportional", s (`proportional_damping`).

    Returns
    -------
    xarray.Dataset
        ``stiffness`` and ``damping`` over (cases, frequency, dof, along); cases stacked to one
        dimension ``case``. Order of `DOF`, the free rotation zero. Forces held by the bearing on
        the inner ring, as in ``result.stiffness``.

    Raises
    ------
    InputError
        A frequency is not positive, the model unknown or without films of such a bearing, or
        options are missing.

    Examples
    --------
    >>> from loadflow.rolling import RollerBearing
    >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3)
    >>> loaded = bearing.equilibrium(force=[(2000, 0, 0), (9000, 0, 0)])
    >>> out = rotor_coefficients(loaded, [10.0, 1000.0], model="dry")
    >>> dict(out.sizes)
    {'case': 2, 'frequency': 2, 'dof': 6, 'along': 6, 'axis': 3, 'tilt_axis': 2}
    """
    omega = np.atleast_1d(np.asarray(frequency, float))
    if omega.ndim != 1 or not (np.isfinite(omega) & (omega > 0)).all():
        raise InputError("frequency: a list of finite values > 0 rad/s")
    if model not in ("film", "dry", "proportional"):
        raise InputError(f"model: must be film, dry or proportional, got {model!r}")
    if model == "film" and options is None:
        raise InputError("options: the film needs FrictionOptions with oil and temperature")
    if model == "film" and not has_films(result.bearing):
        raise InputError(
            f'model: "dry" or "proportional" of a {type(result.bearing).__name__}, whose films are '
            "not modelled"
        )
    static = result.stiffness.reshape(-1, 5, 5)
    matrix = np.zeros((len(static), len(omega), 6, 6), complex)
    if model == "proportional":
        damped = 1j * omega[:, None, None] * dynamics.proportional_damping(1.0, time_constant)
        matrix[..., :5, :5] = static[:, None] * (1 + damped)
    else:
        forces = result.contact_forces.reshape(len(static), -1)
        v = result.contact_directions.reshape(len(static), -1, 5)
        dry = _tangents(result)
        springs = _film_springs(result, speed, options) if model == "film" and options else ()
        loaded = forces > 0
        solid = np.where(loaded, dry, 1.0) * (1 + 1j * loss)
        for i, w in enumerate(omega):
            wet = 1 / (1 / solid + sum(spring.compliance(float(w)) for spring in springs))
            change = np.where(loaded, wet - dry, 0.0)
            matrix[:, i, :5, :5] = static + np.einsum("cj,cja,cjb->cab", change, v, v)
    return _dataset(result, omega, matrix, model)


def has_films(bearing: RollingGeometry) -> bool:
    """Whether the films of a bearing are modelled: all its elements roll on one pitch circle."""
    return isinstance(bearing, BallRaceways | RollerRaceways)


def _tangents(result: Result) -> Array:
    """Tangent stiffness of each contact over both rings, N/m, (case, contact)."""
    forces = result.contact_forces
    exponent = 1.5 if result.contacts.law == POINT else 10 / 9
    constant = result.contacts.table[:, STIFFNESS, None]
    approach = (forces / constant) ** (1 / exponent)
    safe = np.where(approach > 0, approach, 1.0)
    tangent = dynamics.dietl_contact_stiffness(forces, safe, exponent)
    return tangent.reshape(int(np.prod(result.cases)), -1)


@dataclass(frozen=True)
class _FilmSpring:
    """Films between all contacts and one ring, (case, contact), as springs and dampers."""

    film: ContactFilm
    wedge: Array
    viscosity: Array

    def compliance(self, frequency: float) -> Complex:
        """Complex compliance, m/N; 0 where there is no film: it is rigid, or nothing is loaded."""
        there = (self.film.film > 0) & (self.film.half_width > 0)
        plate = dynamics.richter_plate(
            bulk_modulus(self.film.pressure),
            self.film.length,
            self.film.half_width,
            np.where(there, self.film.film, 1.0),
            self.viscosity,
            frequency,
        )
        return np.asarray(np.where(there, 1 / np.where(there, self.wedge + plate, 1.0), 0.0))


def _film_springs(
    result: Result, speed: ArrayLike, options: FrictionOptions
) -> tuple[_FilmSpring, ...]:
    """Films of every contact at both rings."""
    forces = result.contact_forces.reshape(int(np.prod(result.cases)), -1)
    exponent = _POINT_EXPONENT if result.contacts.law == POINT else _LINE_EXPONENT
    springs = []
    for film in _films(result, forces, speed, options):
        thickness = np.where(film.film > 0, film.film, 1.0)
        springs.append(
            _FilmSpring(
                film=film,
                wedge=dynamics.dietl_film_stiffness(forces, thickness, exponent),
                viscosity=options.oil.viscosity(options.temperature, film.pressure),
            )
        )
    return tuple(springs)


def _films(
    result: Result, forces: Array, speed: ArrayLike, options: FrictionOptions
) -> tuple[ContactFilm, ...]:
    """Films of every contact at both rings, (case, contact)."""
    bearing = result.bearing
    omega = np.broadcast_to(np.asarray(speed, float), result.cases).reshape(-1, 1)
    mean = entrainment_speed(omega, 0.0, bearing.pitch_diameter, bearing.gamma)
    u = np.broadcast_to(np.asarray(mean), forces.shape)
    if bearing.element == "ball":
        balls = cast("BallRaceways", bearing)
        return tuple(groove_film(balls, r, forces, u, options) for r in RINGS)
    rollers = cast("RollerRaceways", bearing)
    modulus = 2 * float(effective_modulus(rollers.elastic_modulus, rollers.poisson_ratio))
    length = rollers.roller_length / rollers.slices
    radii = (raceway_radius(rollers.roller_diameter, rollers.gamma, r) for r in RINGS)
    return tuple(line_film(forces, length, r, modulus, u, options) for r in radii)


def _dataset(result: Result, omega: Array, matrix: Complex, model: str) -> xr.Dataset:
    """Label stiffness Re K* and damping Im K*/ω."""
    import xarray as xr

    dims = ("case", "frequency", "dof", "along")
    units = "N/m, N/rad, N, N m/rad by row and column"
    damping = matrix.imag / omega[:, None, None]
    return xr.Dataset(
        {
            "stiffness": (dims, matrix.real, {"units": units, "long_name": "stiffness"}),
            "damping": (dims, damping, {"units": f"s times ({units})", "long_name": "damping"}),
            "force": (
                ("case", "axis"),
                result.force.reshape(-1, 3),
                {"units": "N", "long_name": "force on the inner ring"},
            ),
            "moment": (
                ("case", "tilt_axis"),
                result.moment.reshape(-1, 2),
                {"units": "N m", "long_name": "moment on the inner ring"},
            ),
        },
        coords={
            "frequency": (
                "frequency",
                omega,
                {"units": "rad/s", "long_name": "circular frequency of the vibration"},
            ),
            "dof": list(DOF),
            "along": list(DOF),
            "axis": list("xyz"),
            "tilt_axis": list("xy"),
        },
        attrs={"model": model},
    )
