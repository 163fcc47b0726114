"""The tower of windIO, with its monopile, as the bending of a turbine file."""

from __future__ import annotations

from typing import Any

import numpy as np

from .checks import Array, require
from .windio_paths import Source


def bending_table(
    source: Source, rotor_mass: float | None, damping: float, seabed: float | None
) -> dict[str, Any] | None:
    """The tower and what stands on it; none if the file gives no mass or stiffness of either."""
    tower = source.path("components.tower") or {}
    nacelle = source.path("components.drivetrain.elastic_properties") or {}
    if rotor_mass is None or "mass" not in nacelle:
        return None
    if "elastic_properties" not in tower.get("structure", {}):
        return None
    mass = float(nacelle["mass"])
    yaw = float(source.path("components.yaw.elastic_properties.mass") or 0.0)
    downwind, _, above = (float(x) * mass / (mass + yaw) for x in nacelle["location"])
    beam = _tower_beam(tower)
    if seabed is not None:
        pile = source.path("components.monopile")
        require(pile is not None, "from_windio", "seabed", seabed, "left out: 'monopile' is absent")
        beam = np.hstack([_pile_beam(pile, tower, beam[:, 0], seabed), beam])
    return {
        "nacelle_mass": mass + yaw,
        "nacelle_downwind": downwind,
        "nacelle_above": above,
        "damping": damping,
        "structure": beam.T.tolist(),
    }


def _tower_beam(entry: dict[str, Any]) -> Array:
    """Height, mass density, fore-aft and side-to-side stiffness, (4, n)."""
    height, *stiffness = _stiffness(entry)
    axis = entry["reference_axis"]["z"]
    inertia = entry["structure"]["elastic_properties"]["inertia_matrix"]
    along = np.interp(inertia["grid"], axis["grid"], axis["values"])
    return np.array([height, np.interp(height, along, inertia["mass"]), *stiffness])


def _pile_beam(entry: dict[str, Any], tower: dict[str, Any], foot: Array, seabed: float) -> Array:
    """The same of the monopile from the seabed to the foot of the tower, whose column is `foot`.

    The mass in the files counts soil in; that of a thin tube of the same steel is proportional to
    its stiffness over the square of its diameter.
    """
    height, *stiffness = _stiffness(entry)
    within = bool(height[0] <= seabed < foot[0])
    allowed = f"from {height[0]} m to below {foot[0]} m"
    require(within, "from_windio", "seabed", seabed, allowed)
    station = np.append(seabed, height[(height > seabed) & (height < foot[0])])
    fore_aft, side_side = (np.interp(station, height, values) for values in stiffness)
    width = _diameter(entry, station) / _diameter(tower, foot[:1])
    return np.array([station, foot[1] * fore_aft / foot[2] / width**2, fore_aft, side_side])


def _stiffness(entry: dict[str, Any]) -> tuple[Array, Array, Array]:
    """Height, fore-aft and side-to-side stiffness of a tower or a monopile."""
    axis = entry["reference_axis"]["z"]
    matrix = entry["structure"]["elastic_properties"]["stiffness_matrix"]
    height = np.interp(matrix["grid"], axis["grid"], axis["values"])
    return height, np.asarray(matrix["K55"], float), np.asarray(matrix["K44"], float)


def _diameter(entry: dict[str, Any], height: Array) -> Array:
    """Outer diameter of a tower or a monopile at the given heights."""
    axis, diameter = entry["reference_axis"]["z"], entry["outer_shape"]["outer_diameter"]
    share = np.interp(height, axis["values"], axis["grid"])
    return np.interp(share, diameter["grid"], diameter["values"])
