"""Blade and airfoils of windIO as the tables of a turbine file."""

from __future__ import annotations

from typing import Any

import numpy as np

from loadflow.errors import InputError
from loadflow.numerics.fields import none_such

from .checks import Array
from .windio_paths import Source

AIR_VISCOSITY = 1.46e-5  # m²/s, kinematic, at 15 °C and sea level
_DEGREE = np.pi / 180
_ROUNDED = 1e-3  # by how much weights may miss their sum
_UPPER = [(i, j) for i in range(6) for j in range(i, 6)]
"""Places of the 21 numbers of a symmetric matrix in the ontology of WISDEM."""


def reynolds_number(
    source: Source, radius: float | None, rotor_speed: float | None
) -> float | None:
    """Reynolds number of the chord at three quarters of the radius at rated speed, if told."""
    chord = (source.at("blade shape") or {}).get("chord")
    if chord is None or rotor_speed is None or radius is None:
        return None
    length = float(np.interp(0.75, chord["grid"], chord["values"]))
    return 0.75 * radius * rotor_speed * length / AIR_VISCOSITY


def polar_of(sets: list[Any], reynolds: float | None) -> tuple[Any, list[float]]:
    """Polar of those of one configuration nearest to a Reynolds number, and all there are.

    Without one that of the largest. Sets that tell no Reynolds number: the first of them.
    """
    if not all(polar.get("re") for polar in sets):
        return sets[0], []
    known = [float(polar["re"]) for polar in sets]
    near = min(known, key=lambda number: abs(np.log(number / (reynolds or max(known)))))
    return sets[known.index(near)], known


def foil_table(
    source: Source, reynolds: float | None, assumed: list[str]
) -> tuple[dict[str, Any], dict[str, float]]:
    """Polars by name, and the relative thickness of those of the blade; angles in radians.

    Of several Reynolds numbers that nearest to `reynolds`, which is told in `assumed`. A database
    has airfoils that a blade does not call [windIO]: they take no part in blending, and neither do
    those of the thickness of another that is called nearer to the root.
    """
    entries = {str(entry["name"]): entry for entry in source.path("airfoils") or []}
    called = _called(source, assumed)
    if unknown := [name for name in called if name not in entries]:
        raise InputError(none_such("airfoil", unknown, entries))
    foils: dict[str, Any] = {}
    thickness: dict[str, float] = {}
    by_thickness: dict[float, str] = {}
    for name in [*called, *(name for name in entries if name not in called)]:
        entry, counts = entries[name], not called or name in called
        foil = _foil(name, entry, called.get(name, []), reynolds, assumed if counts else [])
        given = entry.get("rthick", entry.get("relative_thickness"))
        if given is None:
            continue
        foils[name] = foil
        if not counts:
            continue
        thickness[name] = float(given)
        if float(given) in by_thickness:
            other = by_thickness[float(given)]
            assumed.append(f"airfoils.{name}: {other}, of the same thickness, stands for both")
            continue
        by_thickness[float(given)] = name
        foil["thickness"] = float(given)
    return foils, thickness


def _called(source: Source, assumed: list[str]) -> dict[str, list[tuple[str, float]]]:
    """Airfoils that the blade calls, from the root on, with configurations and their weights."""
    shape = source.at("blade shape") or {}
    called: dict[str, list[tuple[str, float]]] = {}
    for place in shape.get("airfoils", []):
        tags = place.get("configuration", [])
        weights = place.get("weight") or [1 / len(tags) for _ in tags]
        if len(weights) != len(tags):
            told = f"{len(weights)} weights of {len(tags)} configurations"
            raise InputError(f"airfoils.{place['name']}: weight has {told}; must have one of each")
        if tags and (min(weights) < 0 or abs(sum(weights) - 1) > _ROUNDED):
            told = f"weight = {weights}: none may be negative, and they must add up to 1"
            raise InputError(f"airfoils.{place['name']}: {told}")
        mix, name = list(zip(tags, weights, strict=True)), str(place["name"])
        if called.setdefault(name, mix) != mix:
            assumed.append(f"airfoils.{name}: mixed as at its place nearest to the root")
    labels = shape.get("airfoil_position", {}).get("labels", [])
    return called or {str(name): [] for name in labels}


def _foil(
    name: str,
    entry: dict[str, Any],
    configurations: list[tuple[str, float]],
    reynolds: float | None,
    assumed: list[str],
) -> dict[str, Any]:
    """One airfoil: its configurations by their weights, or the first of them."""
    polars = entry["polars"]
    if "re_sets" in polars[0]:
        by_tag = {polar.get("configuration"): polar["re_sets"] for polar in polars}
        if unknown := [tag for tag, _ in configurations if tag not in by_tag]:
            raise InputError(f"airfoils.{name}: {none_such('configuration', unknown, by_tag)}")
        parts = [(by_tag[tag], weight) for tag, weight in configurations if weight > 0]
        parts = parts or [(polars[0]["re_sets"], 1.0)]
    else:
        parts = [(polars, 1.0)]
    found: list[tuple[Any, float]] = []
    for sets, weight in parts:
        polar, known = polar_of(sets, reynolds)
        found.append((polar, weight))
        if len(set(known)) > 1:
            choices = ", ".join(f"{number:.3g}" for number in sorted(known))
            text = f"airfoils.{name}: polar of Re = {polar['re']:.3g}, of {choices}"
            assumed += [] if text in assumed else [text]
    first = found[0][0]
    unit, names = (1.0, ("c_l", "c_d", "c_m"))
    if "cl" in first:
        unit, names = _DEGREE, ("cl", "cd", "cm")
    grid = np.unique(
        np.concatenate([polar[key]["grid"] for polar, _ in found for key in names[:2]])
    )

    def together(key: str) -> list[float]:
        """A coefficient, 0 where a polar lacks it, as of the moment of a cylinder."""
        known = [(polar[key], weight) for polar, weight in found if polar.get(key)]
        values = [w * np.interp(grid, table["grid"], table["values"]) for table, w in known]
        return list(np.sum(values, axis=0).tolist()) if values else []

    angle = np.clip(grid * unit, -np.pi, np.pi)
    angle[[0, -1]] = -np.pi, np.pi
    foil = {"angle": angle.tolist(), "lift": together(names[0]), "drag": together(names[1])}
    if moment := together(names[2]):
        foil["moment"] = moment
    return foil


def blade_table(
    source: Source,
    rotor: dict[str, Any],
    thickness: dict[str, float],
    sections: int,
    damping: float,
) -> dict[str, Any] | None:
    """Sections, and the structure where the file has mass and stiffness of them."""
    entry, shape = source.path("components.blade") or {}, source.at("blade shape")
    if shape is None or "hub_radius" not in rotor or "radius" not in rotor:
        return None
    axis = entry.get("reference_axis") or shape["reference_axis"]
    length = rotor["radius"] - rotor["hub_radius"]
    station = (np.arange(sections) + 0.5) / sections * length
    grid, height = axis["z"]["grid"], axis["z"]["values"]

    def at(table: dict[str, Any]) -> Array:
        """Values over the shares of the reference axis, at the sections."""
        along = np.interp(table["grid"], grid, height)
        return np.interp(station, along, table["values"])

    unit = 1 / _DEGREE if source.old else 1.0
    if "rthick" in shape:
        thick = at(shape["rthick"])
    else:
        places = shape["airfoil_position"]
        values = [thickness[name] for name in places["labels"]]
        thick = at({"grid": places["grid"], "values": values})
    known = sorted(thickness.values())
    thick = np.clip(np.round(thick, 4), known[0], known[-1])
    columns = zip(
        rotor["hub_radius"] + station, at(shape["twist"]) * unit, at(shape["chord"]), thick
    )
    table: dict[str, Any] = {
        "damping": damping,
        "sections": [[float(x) for x in row] for row in columns],
        "prebend": (-at(axis["x"])).tolist(),
    }
    structure = _structure(entry, axis, unit)
    if structure is None:
        where = "components.blade.structure.elastic_properties"
        where += " or components.blade.elastic_properties_mb.six_x_six"
        source.hints |= {"blade.structure": f"in windIO: {where}", "blade.mass": f"with {where}"}
        return table
    span, twist, density, matrix = structure
    torsion, centre = _twisting(matrix)
    ahead = _quarter_chord_ahead(shape, span / length) + centre
    return table | {
        "mass": float(np.trapezoid(density, span)),
        "structure": np.array([span, twist, density, matrix[:, 4, 4], matrix[:, 3, 3]]).T.tolist(),
        "torsion": np.array([span, torsion, ahead]).T.tolist(),
    }


def _structure(
    entry: dict[str, Any], axis: dict[str, Any], unit: float
) -> tuple[Array, ...] | None:
    """Span m, twist deg, mass kg/m, and the stiffness of the sections, (n, 6, 6)."""
    modern = entry.get("structure", {}).get("elastic_properties")
    former = entry.get("elastic_properties_mb", {}).get("six_x_six")
    if modern is not None:
        stiff, inertia = modern["stiffness_matrix"], modern["inertia_matrix"]
        upper = np.array([stiff[f"K{i + 1}{j + 1}"] for i, j in _UPPER], float)
        mass = inertia["mass"]
        twist = entry["outer_shape"]["twist"]
    elif former is not None:
        stiff, inertia = former["stiff_matrix"], former["inertia_matrix"]
        upper = np.asarray(stiff["values"], float).T
        mass = np.asarray(inertia["values"], float)[:, 0]
        twist = entry["outer_shape_bem"]["twist"]
        axis = former.get("reference_axis", axis)
    else:
        return None
    share = np.union1d(stiff["grid"], inertia["grid"])  # of either, so that no mass is lost
    density = np.interp(share, inertia["grid"], mass)
    span = np.interp(share, axis["z"]["grid"], axis["z"]["values"])
    turned = np.interp(share, twist["grid"], twist["values"]) * unit
    matrix = np.zeros((share.size, 6, 6))
    for (i, j), values in zip(_UPPER, upper, strict=True):
        matrix[:, i, j] = matrix[:, j, i] = np.interp(share, stiff["grid"], values)
    return span - span[0], turned, density, matrix


def _twisting(matrix: Array) -> tuple[Array, Array]:
    """Torsional stiffness of sections free to bend, N m², and their shear centre, m.

    The centre is the distance behind the reference axis at which a force across the chord does not
    twist the section. The third diagonal entry of the moments alone is stiffer: it holds the
    section where the axis is, which need not be the shear centre. Files of beams without shear have
    nothing else.
    """
    stiffness, centre = matrix[:, 5, 5].copy(), np.zeros(len(matrix))
    shears = np.linalg.matrix_rank(matrix) == 6
    compliance = np.linalg.inv(matrix[shears])
    stiffness[shears] = 1 / compliance[:, 5, 5]
    centre[shears] = compliance[:, 5, 0] * stiffness[shears]
    return stiffness, centre


def _quarter_chord_ahead(shape: dict[str, Any], share: Array) -> Array:
    """Distance of the quarter chord ahead of the reference axis, m."""
    chord = np.interp(share, shape["chord"]["grid"], shape["chord"]["values"])
    if "section_offset_y" in shape:
        offset = shape["section_offset_y"]
        return np.interp(share, offset["grid"], offset["values"]) - 0.25 * chord
    place = shape["pitch_axis"]  # share of the chord behind the leading edge
    return (np.interp(share, place["grid"], place["values"]) - 0.25) * chord
