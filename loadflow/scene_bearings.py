"""Rolling bearings in scenes: a geometry of any kind, told apart by its key ``kind``."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, Tag, WrapSerializer

from loadflow.rolling import (
    BallBearing,
    CrossedRollerBearing,
    RollerBearing,
    SlewingBearing,
    SphericalRollerBearing,
    ThreeRowRollerBearing,
)

KINDS = {
    "slewing": SlewingBearing,
    "ball": BallBearing,
    "roller": RollerBearing,
    "spherical": SphericalRollerBearing,
    "crossed": CrossedRollerBearing,
    "three-row": ThreeRowRollerBearing,
}


def _kind(value: Any) -> str | None:
    """Kind of a geometry: as stated, or of an object; a slewing bearing where nothing is said."""
    if isinstance(value, dict):
        return value.get("kind", "slewing")
    return next((kind for kind, cls in KINDS.items() if type(value) is cls), None)


def _without_kind(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: part for name, part in value.items() if name != "kind"}
    return value


def _with_kind(value: Any, handler: Any) -> Any:
    return {"kind": _kind(value)} | handler(value)


_PLAIN, _TOLD = BeforeValidator(_without_kind), WrapSerializer(_with_kind)

Geometry = Annotated[
    Annotated[SlewingBearing, _PLAIN, _TOLD, Tag("slewing")]
    | Annotated[BallBearing, _PLAIN, _TOLD, Tag("ball")]
    | Annotated[RollerBearing, _PLAIN, _TOLD, Tag("roller")]
    | Annotated[SphericalRollerBearing, _PLAIN, _TOLD, Tag("spherical")]
    | Annotated[CrossedRollerBearing, _PLAIN, _TOLD, Tag("crossed")]
    | Annotated[ThreeRowRollerBearing, _PLAIN, _TOLD, Tag("three-row")],
    Discriminator(
        _kind,
        custom_error_type="kind",
        custom_error_message="kind must be one of " + ", ".join(KINDS),
    ),
]
"""Geometry of a rolling bearing; ``kind`` says which, slewing if nothing is said."""
