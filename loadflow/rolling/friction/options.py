"""What friction and films of a roller bearing depend on besides load and speed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from annotated_types import Ge, Gt, Le

from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.friction.churning import Churning
from loadflow.tribology.contact_film import POWER_LAWS
from loadflow.tribology.lubricants import Oil


@dataclass(frozen=True, kw_only=True)
class FrictionOptions:
    """What the friction of a roller bearing depends on besides load and speed.

    Attributes
    ----------
    oil : Oil
        Oil, or base oil of the grease.
    temperature : float
        Of the oil at the inlets of the contacts, K.
    roughness : float
        Combined roughness σ of roller and raceway, m.
    hysteresis : float
        Loss factor α of the steel.
    film : str
        Film law of lines, see `loadflow.tribology.film_ratio`; ``"moes"`` holds in all regimes.
    starvation : float
        Share of the flooded film and rolling force that is left; grease 0.5 … 0.7, oil 1.
    boundary_friction : float
        Friction coefficient where asperities touch.
    rib_angle : float
        Angle between the contact normals of both raceways, rad; a rib carries its sine of the load
        (tapered rollers 0.02 … 0.06, cylindrical 0).
    rib_height : float
        Height of the rib contact over the raceway, m.
    rib_friction : float
        Friction coefficient of the rib's film.
    rib_radius : float, optional
        Reduced radius of roller end and rib, m (sphere on cone: about the apex distance over one
        less their ratio). If given, the film there decides how much of the rib's load rubs with
        `boundary_friction`; if not, all of it with `rib_friction`.
    roller_drag : float
        C₁ of the viscous drag on each roller (`drag_constants`), N m s.
    churning : Churning
        Torque of churning.
    seal_torque : float
        Torque of the seals, N m.

    Raises
    ------
    InputError
        If a field is out of its range or the film law is not one of lines.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.tribology import lubricant
    >>> FrictionOptions(oil=lubricant("iso-vg-68"), temperature=333.15).film
    'moes'
    """

    oil: Oil
    temperature: Annotated[float, Gt(200), Le(500)]
    roughness: Annotated[float, Gt(0)] = 0.5e-6
    hysteresis: Annotated[float, Ge(0), Le(0.1)] = 0.01
    film: str = "moes"
    starvation: Annotated[float, Gt(0), Le(1)] = 1.0
    boundary_friction: Annotated[float, Ge(0), Le(1)] = 0.12
    rib_angle: Annotated[float, Ge(0), Le(0.5)] = 0.0
    rib_height: Annotated[float, Ge(0)] = 0.0
    rib_friction: Annotated[float, Ge(0), Le(1)] = 0.05
    rib_radius: Annotated[float, Gt(0)] | None = None
    roller_drag: Annotated[float, Ge(0)] = 0.0
    churning: Churning = field(default_factory=Churning)
    seal_torque: Annotated[float, Ge(0)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        lines = [name for name, law in POWER_LAWS.items() if law.contact == "line"]
        check_choice(self, "film", ("moes", *lines))
