"""The section of a scene that says how the shaft line vibrates on its bearings."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, Field, model_validator

from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]


class Dynamics(Section, BaseModel):
    """Stiffness and damping of the journal bearings over speed, and vibration on them.

    Read by the result ``journal.dynamics``, which is computed only where it is asked for by name.
    Each bearing is held at the mean load of a load case; its stiffness and damping are tabulated at
    ``points`` speeds from the first to the last of ``speed_range``, in shares of the mean speed.

    A suspension with a ``beam`` is also taken as a shaft line on these films: its first ``modes``
    natural frequencies with their damping at the mean speed, and its whirl over the range of speed
    under an ``unbalance`` (kg m) of the rotor. The shaft has the suspension's ``shaft_mass``, or is
    of steel where that is 0; the rotor is a rigid disc.
    """

    speed_range: tuple[Positive, Positive] = (0.5, 1.5)
    points: Annotated[int, Field(ge=2, le=100)] = 5
    modes: Annotated[int, Field(ge=1, le=50)] = 6
    unbalance: Annotated[float, Field(ge=0)] = 0.0

    @model_validator(mode="after")
    def _rises(self) -> Self:
        low, high = self.speed_range
        if low >= high:
            raise ValueError(f"speed_range = [{low}, {high}]: the second must be the larger one")
        return self
