"""The section ``[friction]`` of a scene: lubricant, surfaces and cooling of rolling bearings."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Annotated

from annotated_types import Gt, Le
from pydantic import BaseModel, Field, field_validator

from loadflow.errors import InputError
from loadflow.numerics.fields import not_one_of
from loadflow.rolling.friction import Churning
from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]


@dataclass(frozen=True)
class Cooling:
    """How warm one rolling bearing is: by what carries off its heat, or stated.

    Attributes
    ----------
    conductance : float, optional
        Heat that the bearing gives off for each kelvin above what is around it, W/K.
    area : float, optional
        Surface of its housing that gives off heat, m²; with `transfer` in place of `conductance`.
    transfer : float, optional
        Heat that this gives off for each kelvin, W/(m² K).
    temperature : float, optional
        K, in place of a heat balance: as measured.

    Raises
    ------
    loadflow.errors.InputError
        None of these forms, or several.

    Examples
    --------
    >>> Cooling(area=4.0, transfer=15.0).total
    60.0
    """

    conductance: Annotated[float, Gt(0)] | None = None
    area: Annotated[float, Gt(0)] | None = None
    transfer: Annotated[float, Gt(0)] | None = None
    temperature: Annotated[float, Gt(200), Le(500)] | None = None

    def __post_init__(self) -> None:
        given = {name for name, value in vars(self).items() if value is not None}
        if given not in ({"conductance"}, {"area", "transfer"}, {"temperature"}):
            raise InputError(
                "give conductance (W/K), or area (m²) and transfer (W/(m² K)) of the housing, or "
                "temperature (K)"
            )

    @property
    def total(self) -> float | None:
        """Heat that the bearing gives off for each kelvin, W/K; None of a stated temperature."""
        if self.area is not None and self.transfer is not None:
            return self.area * self.transfer
        return self.conductance


class Friction(Section, BaseModel):
    """Lubricant, surfaces, cooling of the rolling bearings, for friction, slip and modified life.

    ``lubricant`` is a name of `loadflow.tribology.lubricant_names`; ``temperature`` (K),
    ``roughness`` (m), ``starvation``, ``hysteresis``, ``boundary_friction``, ``roller_drag``
    (N m s), ``churning`` and ``seal_torque`` (N m) are those of `loadflow.rolling.FrictionOptions`,
    as are ``rib_angle`` (rad), ``rib_height`` (m), ``rib_radius`` (m) and ``rib_friction``. The
    first three follow from the bearing where they are left out, see
    `loadflow.stages.rolling_at_work`.
    Churning and seals have no values of their own: they count only if they are given.

    With a ``conductance`` (W/K) to ``ambient_temperature`` (K) each bearing has the temperature in
    a load case at which that carries off its mean friction; else it is ``temperature``. Its
    modified life has the oil at that temperature, too. A conductance is that of each bearing;
    ``cooling``, a table by place, has a `Cooling` for single ones, which goes before both.

    ``cleanliness`` is one of `loadflow.rolling.rating.modified_life.CLEANLINESS`; with lubricant
    and temperature it gives the modified life. Loads are taken every ``step`` (s); rollers have
    shorter steps of their own. With ``follow_every = 4`` every fourth roller is followed, and
    stands for its neighbours.
    """

    lubricant: str = "lgep-2"
    temperature: Annotated[float, Field(gt=200, le=500)] = 313.15
    conductance: Positive | None = None
    cooling: dict[str, Cooling] = {}
    ambient_temperature: Annotated[float, Field(gt=200, le=400)] = 293.15
    roughness: Positive = 0.6e-6
    starvation: Annotated[float, Field(gt=0, le=1)] = 0.7
    hysteresis: Annotated[float, Field(ge=0, le=0.1)] = 0.01
    boundary_friction: Annotated[float, Field(ge=0, le=1)] = 0.12
    rib_angle: Annotated[float, Field(ge=0, le=0.5)] | None = None
    rib_height: Annotated[float, Field(ge=0)] | None = None
    rib_radius: Positive | None = None
    rib_friction: Annotated[float, Field(ge=0, le=1)] = 0.05
    roller_drag: Annotated[float, Field(ge=0)] = 1e-3
    churning: Churning = Churning()
    seal_torque: Annotated[float, Field(ge=0)] = 0.0
    step: Positive = 0.1
    follow_every: Annotated[int, Field(ge=1, le=100)] = 1
    cleanliness: str = "grease, normal cleanliness"

    @field_validator("cleanliness")
    @classmethod
    def _clean(cls, name: str) -> str:
        from loadflow.rolling.rating.modified_life import CLEANLINESS

        if name not in CLEANLINESS:
            raise ValueError(not_one_of(name, CLEANLINESS))
        return name

    @field_validator("lubricant")
    @classmethod
    def _known(cls, name: str) -> str:
        from loadflow.tribology import lubricant_names

        known = lubricant_names()
        if name not in known:
            raise ValueError(not_one_of(name, known))
        return name

    def conductance_at(self, place: str) -> float | None:
        """Heat that a bearing gives off for each kelvin, W/K; None where none is stated.

        Examples
        --------
        >>> cooled = Friction(cooling={"N": Cooling(60.0)})
        >>> cooled.conductance_at("N"), cooled.conductance_at("N2")
        (60.0, None)
        """
        own = self.cooling.get(place)
        return self.conductance if own is None else own.total

    def states(self, place: str) -> bool:
        """Whether a bearing has a temperature of its own, as measured."""
        return place in self.cooling and self.cooling[place].temperature is not None

    def temperature_at(self, place: str) -> float:
        """Temperature that is stated for a bearing, K."""
        own = self.cooling.get(place)
        return self.temperature if own is None or own.temperature is None else own.temperature

    def balances(self, places: Iterable[str]) -> list[str]:
        """Those of the bearings that have the temperature of a heat balance."""
        return [place for place in places if self.conductance_at(place) is not None]

    def of(self, place: str) -> Friction:
        """Return the section as it is for one bearing, with its conductance or temperature."""
        own = {"temperature": self.temperature_at(place)}
        return self.model_copy(
            update=own | {"conductance": self.conductance_at(place), "cooling": {}}
        )

    def without_balance(self) -> Friction:
        """Return the section with the stated temperatures alone."""
        stated = {place: one for place, one in self.cooling.items() if self.states(place)}
        return self.model_copy(update={"conductance": None, "cooling": stated})

    def warmed(self, change: Callable[[float], float]) -> Friction:
        """Return the section with all stated temperatures, K, changed."""
        cooling = {
            place: one
            if one.temperature is None
            else replace(one, temperature=change(one.temperature))
            for place, one in self.cooling.items()
        }
        return self.model_copy(update={"temperature": change(self.temperature), "cooling": cooling})
