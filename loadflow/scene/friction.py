"""The section ``[friction]`` of a scene: lubricant, surfaces and cooling of rolling bearings."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Annotated

from pydantic import BaseModel, Field, field_validator

from loadflow.numerics.fields import not_one_of
from loadflow.rolling.friction import Churning
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cooling import Cooling
from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]


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
    ``cooling``, a table by place, has a `Cooling` for single ones, which goes before both. The
    ``cooling`` of a bearing itself counts where all three leave it open.

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

    def cooling_of(self, part: FurtherBearing) -> Cooling | None:
        """What is stated of one bearing alone: here by its place, or by itself."""
        own = self.cooling.get(part.bearing)
        if own is None and self.conductance is None and "temperature" not in self.changed:
            return part.cooling
        return own

    def conductance_of(self, part: FurtherBearing) -> float | None:
        """Heat that a bearing gives off for each kelvin, W/K; None where none is stated.

        Examples
        --------
        >>> from loadflow.rolling import BallBearing
        >>> ring = BallBearing(balls=20, ball_diameter=0.05, pitch_diameter=0.6,
        ...     groove_radius=0.026)
        >>> N, N2 = (FurtherBearing(bearing=place, geometry=ring) for place in ("N", "N2"))
        >>> cooled = Friction(cooling={"N": Cooling(60.0)})
        >>> cooled.conductance_of(N), cooled.conductance_of(N2)
        (60.0, None)
        """
        own = self.cooling_of(part)
        return self.conductance if own is None else own.conductance_of(part.geometry)

    def states(self, part: FurtherBearing) -> bool:
        """Whether a bearing has a temperature of its own, as measured."""
        own = self.cooling_of(part)
        return own is not None and own.temperature is not None

    def temperature_of(self, part: FurtherBearing) -> float:
        """Temperature that is stated for a bearing, K."""
        own = self.cooling_of(part)
        return self.temperature if own is None or own.temperature is None else own.temperature

    def balances(self, parts: Iterable[FurtherBearing]) -> list[str]:
        """Places of those of the bearings that have the temperature of a heat balance."""
        return [part.bearing for part in parts if self.conductance_of(part) is not None]

    def of(self, part: FurtherBearing) -> Friction:
        """Return the section as it is for one bearing, with its conductance or temperature."""
        kelvin, conductance = self.temperature_of(part), self.conductance_of(part)
        held = {} if conductance is not None else {part.bearing: Cooling(temperature=kelvin)}
        return self.model_copy(
            update={"temperature": kelvin, "conductance": conductance, "cooling": held}
        )

    def without_balance(self) -> Friction:
        """Return the section with the stated temperatures alone."""
        stated = {place: one for place, one in self.cooling.items() if one.temperature is not None}
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
