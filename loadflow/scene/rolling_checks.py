"""What rolling bearings of a scene must be beside its results, its lubricant and its shaft."""

from __future__ import annotations

from collections.abc import Iterable

from loadflow.errors import InputError
from loadflow.scene.bearings import Rolling
from loadflow.scene.friction import Friction
from loadflow.tribology import lubricant as oil_of


def check_baths(rolling: Rolling, lubricant: str) -> None:
    """Refuse a bath of oil, which a catalogue's drag is of, where the lubricant is a grease."""
    greased = bool(oil_of(lubricant).thickener)
    for name, part in rolling.bearings.items():
        if greased and part.catalogue is not None and part.catalogue.oil_level is not None:
            raise ValueError(
                f"bearings.{name}.catalogue.oil_level: a bath of oil; friction.lubricant "
                f'"{lubricant}" is a grease'
            )


def check_cooling(rolling: Rolling, friction: Friction) -> None:
    """Refuse a cooling by the area of a housing that does not follow from the rolling elements."""
    for name, part in rolling.bearings.items():
        try:
            friction.conductance_of(part)
        except InputError as error:
            raise ValueError(f"cooling of bearing {name}: {error}") from error


def check_swinging(rolling: Rolling, films: Iterable[str]) -> None:
    """Raise unless the bearings beside the shaft swing; `films` are the places of films.

    Raises
    ------
    ValueError
        A yaw or pitch bearing that turns with the rotor or is a film, or another one that follows
        the pitch.
    """
    for place, name in (("Y", "yaw"), ("P", "pitch")):
        part = rolling.bearings.get(place)
        if part is not None and part.oscillation is None:
            raise ValueError(
                f"rolling bearing {place}: the {name} bearing swings; give its oscillation"
            )
        if place in films:
            raise ValueError(
                f"journal.bearings = {place!r}: the {name} bearing is a rolling bearing"
            )
    for place, part in rolling.bearings.items():
        if part.oscillation is not None and part.oscillation.of_pitch and place != "P":
            raise ValueError(
                f'rolling bearing {place}: oscillation.kind = "pitch" is that of the pitch '
                "bearing P; give amplitude and frequency"
            )


def check_capacities(rolling: Rolling) -> None:
    """Raise unless the dynamic capacity of every bearing, and so its life, can be rated.

    Raises
    ------
    ValueError
        Naming the bearing and what is outside the tables of its rating.
    """
    for place, part in rolling.bearings.items():
        try:
            _ = part.geometry.rated_capacity
        except InputError as error:
            raise ValueError(f"rolling bearing {place}: no life: {error}") from error
