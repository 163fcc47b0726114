"""The shaft of a turbine where a scene does not state it.

Distances and masses of one turbine mean nothing on another: those of the package have their own;
other files may tell the places of their bearings; what is left is scaled, and said.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields
from typing import Any

from loadflow.errors import InputError
from loadflow.scene.candidates import machine
from loadflow.shaft.options import (
    Concept,
    DirectDrive,
    Integrated,
    MomentBearing,
    ThreePoint,
    TwoPoint,
)
from loadflow.turbines import Turbine, load_turbine
from loadflow.turbines.files import scaled_name

KINDS: Mapping[str, tuple[type[Concept], str]] = {
    "two_point": (TwoPoint, "nrel-5mw"),
    "three_point": (ThreePoint, "nrel-5mw"),
    "integrated": (Integrated, "nrel-5mw"),
    "direct_drive": (DirectDrive, "iea-15mw"),
    "moment": (MomentBearing, "nrel-5mw"),
}
"""Suspensions, and the turbine that their default distances and masses are those of."""

_PLACE_OF = {"hub_to_shaft_centre": "shaft_mass", "hub_to_generator": "generator_mass"}
"""Places that mean nothing without their mass."""

_TOLD_BY_THE_FILE = {
    "hub_to_first": "hub_to_bearing",
    "hub_to_bearing": "hub_to_bearing",
    "span": "bearing_span",
}
"""Keys of a suspension that a turbine's own file may have, under ``drivetrain``."""


def own_shaft(name: str, stated: Any) -> Any:
    """Complete the shaft of a scene by what is known of its turbine.

    Parameters
    ----------
    name : str
        Name or file of the turbine.
    stated : mapping or None
        The section as the scene has it; None: it has none.

    Returns
    -------
    mapping or None
        None, or what was stated, for a turbine that cannot be read, which its own check tells.

    Examples
    --------
    >>> from loadflow.scene.own_shaft import own_shaft
    >>> sorted(own_shaft("nrel-5mw", None))
    ['moment', 'two_point']
    """
    ours: Mapping[str, Any] = machine(name).get("shaft", {})
    try:
        turbine, by_similarity = load_turbine(name), scaled_name(name)[1] is not None
    except InputError:
        return stated
    if stated is None and by_similarity:
        return None  # so is its shaft
    if stated is None:
        usual = "direct_drive" if turbine.drivetrain.gear_ratio == 1.0 else "two_point"
        stated = dict(ours) or {usual: {}, "moment": {}}
    if not isinstance(stated, dict):
        return stated
    return {
        kind: dict(_known(name, turbine, kind, ours, options)) | options
        if kind in KINDS and isinstance(options, dict)
        else options
        for kind, options in stated.items()
    }


def taken(name: str, shaft: Mapping[str, Any]) -> list[str]:
    """Say what of a scene's shaft and turbine was taken from elsewhere, as nothing states it.

    Parameters
    ----------
    name : str
        Name or file of the turbine.
    shaft : mapping
        The resolved shaft of the scene as plain data.
    """
    turbine = load_turbine(name)
    if scaled_name(name)[1] is not None:
        return []  # told as a whole
    lines = [f"turbine {turbine.name}: {said}" for said in turbine.assumed]
    ours: Mapping[str, Any] = machine(name).get("shaft", {})
    for kind, options in shaft.items():
        if not options or kind not in KINDS:
            continue
        scaled = dict(_scaled(name, turbine, kind, options))
        own = {**_of_file(turbine, kind), **ours.get(kind, {})}
        same = [k for k, v in scaled.items() if k not in own and options.get(k) == v]
        if same:
            numbers = ", ".join(f"{key} = {scaled[key]:.4g}" for key in same)
            lines.append(
                f"shaft.{kind}: {numbers}: those of {KINDS[kind][1]} scaled to {turbine.name}; "
                f"state them in [shaft.{kind}], or drivetrain.hub_to_bearing and "
                "drivetrain.bearing_span in the file of the turbine"
            )
    return lines


def _known(
    name: str,
    turbine: Turbine,
    kind: str,
    ours: Mapping[str, Any],
    options: Mapping[str, Any],
) -> Iterator[tuple[str, Any]]:
    """Keys of a suspension: scaled, over these from the file, over these from the package."""
    yield from _scaled(name, turbine, kind, {**ours.get(kind, {}), **options})
    yield from _of_file(turbine, kind).items()
    yield from ours.get(kind, {}).items()


def _of_file(turbine: Turbine, kind: str) -> dict[str, float]:
    suspension = KINDS[kind][0]
    own = {field.name for field in fields(suspension)}
    if len(suspension.main_bearings) == 1:
        own.discard("span")  # to the arms of the gearbox, not to a second bearing
    told = {k: getattr(turbine.drivetrain, v) for k, v in _TOLD_BY_THE_FILE.items() if k in own}
    return {key: value for key, value in told.items() if value is not None}


def _scaled(
    name: str, turbine: Turbine, kind: str, options: Mapping[str, Any]
) -> Iterator[tuple[str, float]]:
    """Defaults of a suspension, lengths by the diameter of the rotor, masses by the rated torque.

    None for the turbine that the defaults are those of.
    """
    cls, reference = KINDS[kind]
    if name == reference:
        return
    known = load_turbine(reference)
    length = turbine.rotor.radius / known.rotor.radius
    torque = _rated_torque(turbine) / _rated_torque(known)
    for field in fields(cls):
        value = field.default
        if value is MISSING or not isinstance(value, float) or value == 0.0:
            continue
        if field.name in _PLACE_OF and not options.get(_PLACE_OF[field.name]):
            continue
        yield field.name, value * (torque if field.name.endswith("_mass") else length)


def _rated_torque(turbine: Turbine) -> float:
    speed = turbine.rated_speed
    return turbine.control.rated_mechanical_power / speed
