"""Seats of bearings that align themselves, as scenes state them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from loadflow.journal.seat import SEATS, Seat, SphericalSeat
from loadflow.scene.section import told_apart

if TYPE_CHECKING:
    SeatTable = Seat
else:
    SeatTable = told_apart(SEATS)
"""A seat; ``kind`` says which."""


class Aligning(Protocol):
    """A bearing that may align itself."""

    @property
    def self_aligning(self) -> bool:
        """Whether it does."""

    @property
    def seat(self) -> Seat | None:
        """What it stands on, if that is stated."""


def check_seat(bearing: Aligning, within: float = 0.0) -> None:
    """Refuse a seat of a bearing that does not align itself, or a sphere that is `within` it, m.

    Raises
    ------
    ValueError
        Naming the key, and what helps.
    """
    seat = bearing.seat
    if seat is not None and not bearing.self_aligning:
        raise ValueError("seat: only a bearing with self_aligning = true has one; set it")
    if isinstance(seat, SphericalSeat) and seat.radius <= within:
        raise ValueError(
            f"seat.radius = {seat.radius:g}: must be > {within:g} m; the sphere is around the bore"
        )


def without_seat(room: str, bearings: Mapping[str, Aligning]) -> dict[str, str]:
    """What a plan tells of bearings that align themselves if nothing is stated of their seats."""
    places = [name for name, one in bearings.items() if one.self_aligning and one.seat is None]
    if not places:
        return {}
    told = f"{room}: seats of {', '.join(places)}"
    return {told: "none is stated; what friction or stiffness leaves of the slope is not known"}
