"""The section ``[friction]`` of a scene: lubricant, surfaces and cooling of rolling bearings."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, Field, field_validator

from loadflow.numerics.fields import not_one_of
from loadflow.rolling.friction import Churning
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
    modified life has the oil at that temperature, too.

    ``cleanliness`` is one of `loadflow.rolling.rating.modified_life.CLEANLINESS`; with lubricant
    and temperature it gives the modified life. Loads are taken every ``step`` (s); rollers have
    shorter steps of their own. With ``follow_every = 4`` every fourth roller is followed, and
    stands for its neighbours.
    """

    lubricant: str = "lgep-2"
    temperature: Annotated[float, Field(gt=200, le=500)] = 313.15
    conductance: Positive | None = None
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
