"""The section of a scene that says how the shaft line vibrates on its bearings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated, Literal, Self

from pydantic import BaseModel, Field, model_validator

from loadflow.rolling.stiffness.rotor_coefficients import has_films
from loadflow.scene.bearings import FurtherBearing, Rolling
from loadflow.scene.journal import Journal
from loadflow.scene.section import Section
from loadflow.scene.shaft import Shaft

Positive = Annotated[float, Field(gt=0)]

OF_FILMS, OF_ROLLING = "journal.dynamics", "rolling.dynamics"
"""Results that tabulate journal and rolling bearings for rotor dynamics."""


class Dynamics(Section, BaseModel):
    """Stiffness and damping of the bearings over speed, and vibration on them.

    Read by the results ``journal.dynamics`` and ``rolling.dynamics``, which are computed only where
    they are asked for by name. Each bearing is held at the mean load of a load case; its stiffness
    and damping are tabulated at ``points`` speeds from the first to the last of ``speed_range``, in
    shares of the mean speed.

    A suspension with a ``beam`` is also taken as a shaft line on these bearings: its first
    ``modes`` natural frequencies with their damping at the mean speed, and its whirl over the range
    of speed under an ``unbalance`` (kg m) of the rotor. The shaft has the suspension's
    ``shaft_mass``, or is of steel where that is 0; the rotor is a rigid disc.

    Tilting pads and rolling bearings have other stiffness and damping at another frequency of
    vibration. With ``whirl = "own"`` each mode is found with those of its own frequency, and the
    tables have those of the speed; a number is the frequency over the speed that modes and tables
    take instead. The response to unbalance always has those of the speed.

    Contacts of rolling bearings are those of ``contact_model``: "film", steel in series with the
    oil of ``[friction]``; "dry", steel alone; "proportional", steel that damps with
    ``time_constant`` (s) times its stiffness. In the first two the steel loses the share ``loss``
    of its stiffness, whatever the frequency.
    """

    speed_range: tuple[Positive, Positive] = (0.5, 1.5)
    points: Annotated[int, Field(ge=2, le=100)] = 5
    modes: Annotated[int, Field(ge=1, le=50)] = 6
    unbalance: Annotated[float, Field(ge=0)] = 0.0
    whirl: Positive | Literal["own"] = "own"
    contact_model: Literal["film", "dry", "proportional"] = "film"
    loss: Annotated[float, Field(ge=0, le=1)] = 0.01
    time_constant: Positive = 1e-5

    @property
    def rolling_follows(self) -> bool:
        """Whether rolling bearings have other K or C at another frequency of vibration."""
        return self.contact_model != "proportional"

    @property
    def whirl_of_tables(self) -> float:
        """Frequency of vibration over the speed to which the tables belong."""
        return 1.0 if self.whirl == "own" else self.whirl

    @model_validator(mode="after")
    def _rises(self) -> Self:
        low, high = self.speed_range
        if low >= high:
            raise ValueError(f"speed_range = [{low}, {high}]: the second must be the larger one")
        return self

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields that the others leave without effect, and why."""
        if self.contact_model == "proportional":
            yield "loss", 'contact_model = "proportional" damps by time_constant'
        else:
            yield "time_constant", f'contact_model = "{self.contact_model}" damps by loss'


def turning(rolling: Rolling, shaft: Shaft) -> dict[str, FurtherBearing]:
    """The rolling bearings that turn with the rotor, by place."""
    places = {place for concept in shaft.concepts for place in concept.bearings}
    return {
        place: part
        for place, part in rolling.bearings.items()
        if place in places and part.oscillation is None
    }


def check_dynamics(
    dynamics: Dynamics, results: Iterable[str], journal: Journal, rolling: Rolling, shaft: Shaft
) -> None:
    """Raise unless bearings that are to be tabulated can be, and the shaft line on them.

    Raises
    ------
    ValueError
        None turns with the rotor; one stands where a journal bearing is tabulated; its films have
        no model. A shaft line on a frame given by a matrix.
    """
    wanted = {*results}
    for name, concept in shaft.suspensions.items():
        if wanted & {OF_FILMS, OF_ROLLING} and concept.beam is not None and concept.beam.matrices:
            raise ValueError(
                f"shaft.{name}.beam.{concept.beam.matrices[0]}: rotor dynamics do not know a "
                f"matrix under the bearings; leave it out, or {OF_FILMS} and {OF_ROLLING}"
            )
    if OF_ROLLING not in wanted:
        return
    parts = turning(rolling, shaft)
    if not parts:
        raise ValueError(
            f"results: {OF_ROLLING} is of bearings that turn with the rotor; "
            f"{', '.join(rolling.bearings)} swings"
        )
    both = [place for place in parts if OF_FILMS in wanted and place in journal.bearings]
    if both:
        raise ValueError(
            f"results: {both[0]} has a journal and a rolling bearing; keep one of {OF_FILMS} and "
            f"{OF_ROLLING}"
        )
    for place, part in parts.items():
        if dynamics.contact_model == "film" and not has_films(part.geometry):
            raise ValueError(
                f'dynamics.contact_model = "film": the films of a {part.geometry.kind} bearing '
                f'({place}) have no model; set it to "dry" or "proportional"'
            )
