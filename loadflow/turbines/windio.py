"""Reading a turbine from windIO (version 2), the exchange format of IEA Wind Tasks 37 and 55."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from loadflow.errors import InputError

from .airfoils import blended
from .checks import Array, require
from .modes import bending_modes, tower_mode
from .schema import Airfoil, Blade, Control, Drivetrain, RotorGeometry, Turbine
from .tower import Tower, TowerBending

_DEGREE = np.pi / 180
_RPM = np.pi / 30
_SPEED_MARGIN = 0.01  # rated speed below the reference of the pitch control, as in the NREL 5 MW
_SLIP = 0.02
_LOWEST_RANGE = 1.1  # region 1½ up to this share of the lowest speed
_CENTRE = 1e-3  # m, of a shaft without a hub radius


def from_windio(
    path: str | Path,
    *,
    sections: int = 20,
    damping: float = 0.005,
    tower_damping: float = 0.01,
    seabed: float | None = None,
) -> Turbine:
    """Read a turbine from a windIO file.

    The format describes a rotor well and its control roughly. The pitch gains become
    ``gain / (1 + pitch / halving pitch)``; the torque follows ``region2_k``; the rated power is
    taken for the mechanical one. The torsion of the blade is left out.

    Parameters
    ----------
    path : str or Path
        YAML file of windIO version 2.
    sections : int
        Aerodynamic sections of equal length per blade.
    damping, tower_damping : float
        Structural damping of each mode of a blade and of the tower by itself, share of critical:
        the files leave the one at zero and give the other in terms of one program.
    seabed : float, optional
        Height of the seabed, m (negative), down to which the monopile of the file belongs to the
        tower; otherwise the tower is clamped at its own foot. Soil and water are left out.

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        Not a windIO 2 file, a missing key, a value outside its range, or PyYAML is not installed.

    Examples
    --------
    >>> from loadflow.turbines import from_windio
    >>> turbine = from_windio("IEA-15-240-RWT.yaml")  # doctest: +SKIP
    """
    document = _document(Path(path))
    try:
        turbine = _turbine(document, sections, damping)
        parts = document["components"]
        bending = _bending(parts, turbine.rotor_mass, tower_damping, seabed)
        return replace(turbine, tower=replace(turbine.tower, bending=bending))
    except KeyError as error:
        raise InputError(f"{path}: missing key {error}") from error
    except (TypeError, IndexError) as error:
        raise InputError(f"{path}: not of the form of windIO 2: {error}") from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _document(path: Path) -> dict[str, Any]:
    try:
        import yaml
    except ImportError as error:
        raise InputError("windIO files need PyYAML: pip install loadflow[windio]") from error
    if not path.is_file():
        raise InputError(f"windIO file {path} does not exist")
    try:
        document = yaml.load(path.read_text(encoding="utf-8"), yaml.CSafeLoader)
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a YAML file: {error}") from error
    version = document.get("windIO_version") if isinstance(document, dict) else None
    if str(version).split(".")[0] != "2":
        raise InputError(f"{path}: windIO_version = {version!r} is not allowed; it must be 2.x")
    return document


def _turbine(document: dict[str, Any], sections: int, damping: float) -> Turbine:
    assembly, parts = document["assembly"], document["components"]
    nacelle, hub, blade = parts["drivetrain"], parts["hub"], parts["blade"]
    hub_radius = 0.5 * hub["diameter"] or _CENTRE
    axis = blade["reference_axis"]
    length = float(axis["z"]["values"][-1])
    tilt = nacelle["outer_shape"]["uptilt"] * _DEGREE
    gear_ratio = float(nacelle.get("gearbox", {}).get("gear_ratio", 1.0))
    rotor = RotorGeometry(
        radius=hub_radius + length,
        hub_radius=hub_radius,
        blades=int(assembly["number_of_blades"]),
        hub_height=float(assembly["hub_height"]),
        # the file gives the horizontal distance
        overhang=float(nacelle["outer_shape"]["overhang"] / np.cos(tilt)),
        tilt=tilt,
        cone=hub["cone_angle"] * _DEGREE,
        hub_mass=float(hub["elastic_properties"]["mass"]),
        hub_inertia=float(hub["elastic_properties"]["inertia"][0]),
    )
    tower = parts["tower"]
    diameter = tower["outer_shape"]["outer_diameter"]["values"]
    airfoils = {foil["name"]: _airfoil(foil) for foil in document["airfoils"]}
    control = document["control"]
    rated_wind = control["rated_rotor_speed"] * _RPM * rotor.radius / control["optimal_tsr"]
    body = nacelle.get("elastic_properties", {})
    return Turbine(
        name=str(document["name"]),
        source="windIO",
        rated_power=float(assembly["rated_power"]),
        rated_wind_speed=rated_wind,
        cut_in=float(assembly["cut_in_wind_speed"]),
        cut_out=float(assembly["cut_out_wind_speed"]),
        rotor=rotor,
        tower=Tower(
            float(diameter[0]),
            float(diameter[-1]),
            float(tower["reference_axis"]["z"]["values"][-1]),
        ),
        drivetrain=Drivetrain(
            gear_ratio=gear_ratio,
            generator_inertia=float(nacelle["generator"]["elastic_properties"]["inertia"][0]),
            torsional_stiffness=float(body.get("spring_constant", 0.0)),
            torsional_damping=float(body.get("damping_coefficient", 0.0)),
        ),
        control=_control(control, gear_ratio, rated_wind),
        blade=_blade(blade, rotor, airfoils, sections, damping),
        airfoils=airfoils,
    )


def _bending(
    parts: dict[str, Any], rotor_mass: float, damping: float, seabed: float | None
) -> TowerBending | None:
    """The tower and what stands on it; none if the file gives no mass or stiffness of either."""
    nacelle = parts["drivetrain"].get("elastic_properties", {})
    if "mass" not in nacelle or "elastic_properties" not in parts["tower"]["structure"]:
        return None
    mass = float(nacelle["mass"])
    yaw = float(parts.get("yaw", {}).get("elastic_properties", {}).get("mass", 0.0))
    downwind, _, above = (float(x) * mass / (mass + yaw) for x in nacelle["location"])
    beam = _tower_beam(parts["tower"])
    if seabed is not None:
        beam = np.hstack([_pile_beam(parts["monopile"], parts["tower"], beam[:, 0], seabed), beam])
    height, density, fore_aft, side_side = beam
    top_mass = mass + yaw + rotor_mass
    return TowerBending(
        nacelle_mass=mass + yaw,
        nacelle_downwind=downwind,
        nacelle_above=above,
        damping=damping,
        height=height,
        mass_density=density,
        fore_aft_stiffness=fore_aft,
        side_side_stiffness=side_side,
        fore_aft=tower_mode(height, density, fore_aft, top_mass),
        side_side=tower_mode(height, density, side_side, top_mass),
    )


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


def _blade(
    entry: dict[str, Any],
    rotor: RotorGeometry,
    airfoils: dict[str, Airfoil],
    sections: int,
    damping: float,
) -> Blade:
    """The blade; airfoils of its sections are added to `airfoils`."""
    axis, shape = entry["reference_axis"], entry["outer_shape"]
    length = rotor.radius - rotor.hub_radius
    middle = (np.arange(sections) + 0.5) / sections
    station = middle * length

    def at(table: dict[str, Any]) -> Array:
        """Values over the shares of the reference axis, at the sections."""
        along = np.interp(table["grid"], axis["z"]["grid"], axis["z"]["values"])
        return np.interp(station, along, table["values"])

    foils = []
    for thickness in at(shape["rthick"]):
        foil = blended(airfoils, round(float(thickness), 4))
        airfoils.setdefault(foil.name, foil)
        foils.append(foil.name)
    structure = entry["structure"]["elastic_properties"]
    stiffness, inertia = structure["stiffness_matrix"], structure["inertia_matrix"]
    span = np.interp(stiffness["grid"], axis["z"]["grid"], axis["z"]["values"])
    density = np.interp(stiffness["grid"], inertia["grid"], inertia["mass"])
    flap, edge = np.asarray(stiffness["K55"], float), np.asarray(stiffness["K44"], float)
    twist = shape["twist"]
    return Blade(
        radius=rotor.hub_radius + station,
        twist=at(twist) * _DEGREE,
        chord=at(shape["chord"]),
        airfoil=tuple(foils),
        mass=float(np.trapezoid(density, span)),
        damping=damping,
        span=span,
        structural_twist=np.interp(stiffness["grid"], twist["grid"], twist["values"]) * _DEGREE,
        mass_density=density,
        flap_stiffness=flap,
        edge_stiffness=edge,
        modes=bending_modes(span, density, flap, edge),
        prebend=-at(axis["x"]),
    )


def _airfoil(entry: dict[str, Any]) -> Airfoil:
    """First set of polars of an airfoil, lift and drag on one grid of angles."""
    polars = entry["polars"][0]["re_sets"][0]
    lift, drag = polars["cl"], polars["cd"]
    grid = np.union1d(lift["grid"], drag["grid"])
    angle = np.clip(grid * _DEGREE, -np.pi, np.pi)
    return Airfoil(
        str(entry["name"]),
        angle,
        np.interp(grid, lift["grid"], lift["values"]),
        np.interp(grid, drag["grid"], drag["values"]),
        float(entry["rthick"]),
    )


def _control(entry: dict[str, Any], gear_ratio: float, rated_wind: float) -> Control:
    reference = entry["rated_rotor_speed"] * _RPM * gear_ratio
    lowest = entry["min_rotor_speed"] * _RPM * gear_ratio
    rated = reference * (1 - _SPEED_MARGIN)
    proportional, integral, halving = _gain_schedule(entry["pitch_kp"], entry["pitch_ki"])
    per_speed = _DEGREE / _RPM / gear_ratio
    wind, pitch = _schedule(entry, rated_wind)
    return Control(
        region_2_gain=entry["region2_k"] / _RPM**2 / gear_ratio**3,
        region_15_start=lowest,
        region_2_start=_LOWEST_RANGE * lowest,
        rated_speed=rated,
        slip=_SLIP,
        rated_mechanical_power=float(entry["rated_power"]),
        maximum_torque=entry["max_gen_torque"] / gear_ratio,
        maximum_torque_rate=entry["max_torque_rate"] / gear_ratio,
        speed_filter=entry["lpf_frequency"] / (2 * np.pi),
        proportional_gain=proportional * per_speed,
        integral_gain=integral * per_speed,
        gain_halving_pitch=halving,
        reference_speed=reference,
        pitch_rate=entry["max_pitch_rate"] * _DEGREE,
        minimum_pitch=min((entry["fine_pitch"] * _DEGREE, *pitch)),
        maximum_pitch=0.5 * np.pi,
        constant_power=float(entry.get("constant_power", 1.0)),
        scheduled_wind=wind,
        scheduled_pitch=pitch,
    )


def _schedule(entry: dict[str, Any], rated_wind: float) -> tuple[tuple[float, ...], ...]:
    """Lowest pitch below rated wind (m/s; rad), without points inside and at the end of a plateau.

    Above rated wind the tables go on with the pitch of the speed control.
    """
    table = entry.get("min_pitch_table", {"wind_speed": [], "min_pitch": []})
    points = zip(table["wind_speed"], table["min_pitch"], strict=True)
    below = np.array([point for point in points if point[0] < rated_wind]).reshape(-1, 2)
    step = np.diff(below[:, 1], prepend=below[:1, 1], append=below[-1:, 1]) != 0
    wind, pitch = below[step[:-1] | step[1:]].T
    return tuple(wind.tolist()), tuple((pitch * _DEGREE).tolist())


def _gain_schedule(proportional: dict[str, Any], integral: dict[str, Any]) -> tuple[float, ...]:
    """Both gains at zero pitch, deg per 1/min, and the pitch that halves them, rad.

    The line through the inverse of the integral gain at the first and at the middle entry; the
    proportional gain agrees at its first entry.
    """
    pitch = np.asarray(integral["pitch_angle"], float) * _DEGREE
    inverse = -1 / np.asarray(integral["ki"], float)
    middle = pitch.size // 2
    slope = (inverse[middle] - inverse[0]) / (pitch[middle] - pitch[0])
    offset = inverse[0] - slope * pitch[0]
    if not (slope > 0 and offset > 0):
        raise InputError("control.pitch_ki: the gain must be negative and fall with the pitch")
    halving = offset / slope
    first = proportional["pitch_angle"][0] * _DEGREE
    at_zero = -proportional["kp"][0] * (1 + first / halving)
    return float(at_zero), float(1 / offset), float(halving)
