"""Reading a turbine from windIO, the exchange format of IEA Wind Tasks 37 and 55.

Both forms are read: version 2, and the ontology of WISDEM before it (`windio_paths` says where each
figure stands). What comes out is the description of a turbine as its TOML file would have it, so
that both are checked in one way, and what a file lacks can be given beside it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from loadflow.errors import InputError

from .checks import Array, require
from .description import turbine_from
from .schema import Turbine
from .windio_blade import blade_table, foil_table, reynolds_number
from .windio_paths import SCALARS, Source
from .windio_tower import bending_table

_DEGREE = np.pi / 180
_RPM = np.pi / 30
_SPEED_MARGIN = 0.01  # rated speed below the reference of the pitch control, as in the NREL 5 MW
_SLIP = 0.02
_LOWEST_RANGE = 1.1  # region 1½ up to this share of the lowest speed
_CENTRE = 1e-3  # m, of a shaft without a hub radius
_OVERSPEED = 1.5  # of the reference speed: no turbulence of a design load case reaches it
_BRAKE = 1.15  # of the rated torque
_TORQUE_RESERVE = 1.1  # of the largest torque over the rated one, as controllers of Task 37 have it
_SHORT_OF = 0.9  # of the rated power: so much a torque of the rotor makes at least
_FILTER = 0.25  # Hz, corner of the filter of the speed, that of the NREL 5 MW
_FLOAT = re.compile(r"[-+]?(\.\d+|\d+(\.\d*)?)[eE][-+]?\d+$")
"""Numbers of YAML 1.2 that PyYAML takes for text, such as 1e-05."""
_LOWEST_SPEED = 0.4  # of the reference speed, where a file states none


def from_windio(
    path: str | Path,
    *,
    sections: int = 20,
    damping: float = 0.005,
    tower_damping: float = 0.01,
    seabed: float | None = None,
    beside: Mapping[str, Any] | None = None,
    folder: Path | None = None,
) -> Turbine:
    """Read a turbine from a windIO file.

    The format describes a rotor well and its control roughly. The torque follows the optimal tip
    speed ratio. Pitch gains become ``gain / (1 + pitch / halving pitch)``; files without gains give
    a frequency and a damping ratio from which they follow. The rated power of the format is
    electrical: that of the rotor follows from the efficiencies of the file, or else from its
    largest torque. What the format does not have, such as brake and overspeed, is taken from common
    practice and told in ``Turbine.assumed``.

    Parameters
    ----------
    path : str or Path
        YAML file of windIO, version 2 or the ontology of WISDEM.
    sections : int
        Aerodynamic sections of equal length per blade.
    damping, tower_damping : float
        Structural damping of each mode of a blade and of the tower by itself, share of critical:
        the files leave the one at zero and give the other in terms of one program.
    seabed : float, optional
        Height of the seabed, m (negative), down to which the monopile of the file belongs to the
        tower; otherwise the tower is clamped at its own foot. Soil and water are left out.
    beside : mapping, optional
        Tables as in the TOML file of a turbine; what stands in them replaces what is read.
    folder : Path, optional
        Where polars of these tables are looked for.

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        No windIO file; all values that are missing in it, each with its place there and the key
        that gives it beside the file; a value outside its range; or PyYAML is not installed.

    Examples
    --------
    >>> from loadflow.turbines import from_windio
    >>> turbine = from_windio("IEA-15-240-RWT.yaml")  # doctest: +SKIP
    """
    path = Path(path)
    source = Source(_document(path))
    try:
        described = _described(source, sections, damping, tower_damping, seabed, beside or {})
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except (TypeError, IndexError, ValueError, KeyError, AttributeError) as error:
        raise InputError(f"{path}: not of the form of windIO: {error}") from error
    try:
        return turbine_from(described, folder or path.parent, source.hints)
    except InputError as error:
        lines = str(error).split("\n")
        if any("missing key" in line for line in lines):
            lines.append(
                f'give what is missing in a file of TOML that begins with windio = "{path.name}"'
            )
        raise InputError("\n".join(f"{path}: {line}" for line in lines)) from error


@lru_cache(maxsize=2)
def _parsed(path: Path, time: int, size: int) -> Any:
    """A YAML file, which may use the name of an anchor twice, as some of the format do."""
    try:
        import yaml
    except ImportError as error:
        raise InputError("windIO files need PyYAML: pip install loadflow[windio]") from error

    class Loader(yaml.SafeLoader):
        """Reads data only; a later anchor of one name replaces the earlier one."""

        def compose_node(self, parent: Any, index: Any) -> Any:
            event = self.peek_event()
            anchor = getattr(event, "anchor", None)
            if anchor in self.anchors and not isinstance(event, yaml.AliasEvent):
                del self.anchors[anchor]
            return super().compose_node(parent, index)

    class Fast(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
        """The same, which takes each anchor once."""

    for loader in (Loader, Fast):
        loader.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, list("-+.0123456789"))
    try:
        text = path.read_text(encoding="utf-8")
        try:
            return yaml.load(text, Fast)
        except yaml.composer.ComposerError:
            return yaml.load(text, Loader)
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"{path}: not a YAML file: {error}") from error


def _document(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise InputError(f"windIO file {path} does not exist")
    stamp = path.stat()
    document = _parsed(path, stamp.st_mtime_ns, stamp.st_size)
    if not isinstance(document, dict):
        raise InputError(f"{path}: not of the form of windIO: no table of keys")
    version = document.get("windIO_version")
    known = version is None and "components" in document
    if not known and str(version).split(".")[0] != "2":
        raise InputError(
            f"{path}: windIO_version = {version!r} is not allowed; it must be 2.x, or absent in a "
            "file of WISDEM, which has components"
        )
    return document


def _described(
    source: Source,
    sections: int,
    damping: float,
    tower_damping: float,
    seabed: float | None,
    beside: Mapping[str, Any],
) -> dict[str, Any]:
    """The turbine as its TOML file would have it, without what the source lacks."""
    orientation = str(source.path("assembly.rotor_orientation") or "upwind")
    if orientation.lower() != "upwind":
        raise InputError(
            f"assembly.rotor_orientation = {orientation!r} is not allowed: rotors stand upwind of "
            "the tower here"
        )
    found: dict[str, Any] = {}
    for key in SCALARS:
        _put(found, key, source.number(key))
    _put(found, "name", str(source.at("name") or "windIO turbine"))
    _put(found, "source", "windIO")
    rotor = found.setdefault("rotor", {})
    assumed: list[str] = []
    _geometry(source, found)
    radius = rotor.get("radius")
    reynolds = reynolds_number(source, radius, _rated_rotor_speed(source, radius))
    found["airfoils"], thicknesses = foil_table(source, reynolds, assumed)
    blade = blade_table(source, rotor, thicknesses, sections, damping)
    _put(found, "blade", blade)
    merged = _merged(found, beside)  # what is beside counts in what follows from it
    hub, mass = merged.get("rotor", {}).get("hub_mass"), (blade or {}).get("mass")
    on_top = None if hub is None or mass is None else hub + rotor.get("blades", 3) * mass
    bending = bending_table(source, on_top, tower_damping, seabed)
    _put(found.setdefault("tower", {}), "bending", bending)
    _control(source, found, merged, assumed)
    described = _merged(found, beside)
    # each begins with its key
    told = [text for text in assumed if not _has(beside, text.split(" ")[0].removesuffix(":"))]
    return described | {"assumed": (*described.get("assumed", ()), *told)}


def _put(found: dict[str, Any], key: str, value: Any) -> None:
    """Set a value under a dotted key; nothing where there is none."""
    if value is None:
        return
    *tables, last = key.split(".")
    for table in tables:
        found = found.setdefault(table, {})
    found[last] = value


def _has(table: Mapping[str, Any], key: str) -> bool:
    *tables, last = key.split(".")
    inner: Any = table
    for name in tables:
        inner = inner.get(name, {}) if isinstance(inner, Mapping) else {}
    return isinstance(inner, Mapping) and (last in inner or f"{last}_deg" in inner)


def _merged(found: Mapping[str, Any], beside: Mapping[str, Any]) -> dict[str, Any]:
    """What is read, and in its place what stands beside."""
    out = dict(found)
    for key, value in beside.items():
        out.pop(key.removesuffix("_deg"), None)
        before = found.get(key)
        inner = isinstance(value, Mapping) and isinstance(before, Mapping)
        out[key] = _merged(before, value) if inner else value  # type: ignore[arg-type]
    return out


def _geometry(source: Source, found: dict[str, Any]) -> None:
    """Rotor and tower from lengths that the format has in other terms."""
    rotor, tower = found.setdefault("rotor", {}), found.setdefault("tower", {})
    diameter, length = source.number("hub diameter"), source.last("blade length")
    if diameter is not None:
        rotor["hub_radius"] = 0.5 * diameter or _CENTRE
    if length is not None and "hub_radius" in rotor:
        rotor["radius"] = rotor["hub_radius"] + length
    if "overhang" in rotor and "tilt" in rotor:
        rotor["overhang"] /= np.cos(rotor["tilt"])  # the file gives the horizontal distance
    if "blades" in rotor:
        rotor["blades"] = int(rotor["blades"])
    diameters = source.list("tower diameter")
    if diameters:
        tower["base_diameter"], tower["top_diameter"] = float(diameters[0]), float(diameters[-1])
    _put(tower, "height", source.last("tower height"))
    found.setdefault("drivetrain", {}).setdefault("gear_ratio", 1.0)


def _rated_rotor_speed(source: Source, radius: float | None) -> float | None:
    """Rated speed, no faster than the tip may be, rad/s."""
    speed, tip = source.number("rated rotor speed"), source.number("largest tip speed")
    return min(speed or np.inf, tip / radius) if tip and radius else speed


def _control(
    source: Source, found: dict[str, Any], merged: Mapping[str, Any], assumed: list[str]
) -> None:
    """Control, drivetrain and supervision, generator side."""
    control = found.setdefault("control", {})
    gear = _gear_ratio(merged)
    radius, ratio = merged["rotor"].get("radius"), source.number("tip speed ratio")
    rotor_speed, power = _rated_rotor_speed(source, radius), merged.get("rated_power")
    _at_rated_speed(source, found, merged, rotor_speed, assumed)
    if rotor_speed is not None and radius and ratio:
        found["rated_wind_speed"] = rotor_speed * radius / ratio
    source.hints["control.maximum_torque"] = "follows from control.rated_mechanical_power"
    source.hints["rated_wind_speed"] = "from tip speed ratio, rated speed and radius"
    if "maximum_torque_rate" in control:
        control["maximum_torque_rate"] /= gear
    if "maximum_torque_rate" not in control and power:
        control["maximum_torque_rate"] = 0.2 * power / (rotor_speed or 1.0) / gear
        assumed.append("control.maximum_torque_rate = a fifth of the rated torque each second")
    if "speed_filter" not in control:
        control["speed_filter"] = _FILTER
        assumed.append(f"control.speed_filter = {_FILTER} Hz: not in the file")
    control.setdefault("constant_power", 1.0)
    control["slip"] = _SLIP
    control["maximum_pitch"] = 0.5 * np.pi
    found["supervision"] = {"overspeed": _OVERSPEED}
    assumed.append(f"supervision.overspeed = {_OVERSPEED} of the reference speed")
    if ratio is not None:
        control["optimal_tip_speed_ratio"] = ratio
    _gains(source, control, gear)
    wind, pitch = _schedule(source, found.get("rated_wind_speed"))
    control |= {"scheduled_wind": wind, "scheduled_pitch": pitch}
    if "minimum_pitch" in control:
        control["minimum_pitch"] = min((control["minimum_pitch"], *pitch))
    if _has(merged, "control.region_2_gain"):
        control.pop("optimal_tip_speed_ratio", None)


def _gear_ratio(merged: Mapping[str, Any]) -> float:
    return float(merged.get("drivetrain", {}).get("gear_ratio", 1.0))


def _at_rated_speed(
    source: Source,
    found: dict[str, Any],
    merged: Mapping[str, Any],
    rotor_speed: float | None,
    assumed: list[str],
) -> None:
    """Speeds, power and torques of the generator that follow from the rated speed of the rotor."""
    lowest = source.number("lowest rotor speed") or None
    if rotor_speed is None:
        return
    control, gear = found["control"], _gear_ratio(merged)
    reference = rotor_speed * gear
    rated = (1 - _SPEED_MARGIN) * reference
    if lowest is None:
        lowest = _LOWEST_SPEED * rotor_speed
        assumed.append(f"control.region_15_start = {lowest * gear:.4g} rad/s: not in the file")
    control |= {
        "reference_speed": reference,
        "rated_speed": rated,
        "region_15_start": lowest * gear,
        "region_2_start": _LOWEST_RANGE * lowest * gear,
    }
    torque = _largest_torque(source, merged.get("rated_power"), rotor_speed, gear)
    mechanical = _mechanical(source, merged, rotor_speed, torque, assumed)
    _put(control, "rated_mechanical_power", mechanical)
    mechanical = merged.get("control", {}).get("rated_mechanical_power", mechanical)
    if torque is not None:
        control["maximum_torque"] = torque / gear
    elif mechanical is not None:
        control["maximum_torque"] = _TORQUE_RESERVE * mechanical / rated
    if mechanical is not None:
        found["drivetrain"]["brake_torque"] = _BRAKE * mechanical / rated
        assumed.append(f"drivetrain.brake_torque = {_BRAKE} × the rated torque")


def _mechanical(
    source: Source,
    merged: Mapping[str, Any],
    rotor_speed: float,
    torque: float | None,
    assumed: list[str],
) -> float | None:
    """Power of the rotor at rated, W: that of the format is electrical."""
    power = merged.get("rated_power")
    if power is None:
        return None
    efficiency = merged.get("drivetrain", {}).get("efficiency")
    if efficiency is None and (generator := source.last("generator efficiency")) is not None:
        efficiency = generator * (source.number("gearbox efficiency") or 1.0)
    if efficiency is not None:
        return float(power / efficiency)
    if torque is None:
        source.hints["control.rated_mechanical_power"] = (
            "the file has no efficiency of the generator; drivetrain.efficiency gives it, too"
        )
        return None
    mechanical = torque * rotor_speed / _TORQUE_RESERVE
    if not power <= mechanical <= 1.15 * power:
        source.hints["control.rated_mechanical_power"] = (
            "neither efficiency nor largest torque of the file tell it; drivetrain.efficiency does"
        )
        return None
    assumed.append(
        f"control.rated_mechanical_power = {mechanical:.4g} W: the largest torque of the file is "
        f"taken for {_TORQUE_RESERVE} × the rated one"
    )
    return float(mechanical)


def _largest_torque(
    source: Source, power: float | None, rotor_speed: float, gear: float
) -> float | None:
    """Largest torque at the rotor, N m: one too small for the rated power is the generator's."""
    torque = source.number("largest torque")
    if torque is None or power is None or torque * rotor_speed >= _SHORT_OF * power:
        return torque
    return torque * gear


def _gains(source: Source, control: dict[str, Any], gear: float) -> None:
    """Of the pitch control: a table, or a frequency and a damping ratio."""
    proportional, integral = source.at("pitch_kp"), source.at("pitch_ki")
    if proportional and integral:
        first, second, halving = _gain_schedule(proportional, integral)
        per_speed = _DEGREE / _RPM / gear
        control["proportional_gain"] = first * per_speed
        control["integral_gain"] = second * per_speed
        control["gain_halving_pitch"] = halving
        return
    _put(control, "pitch_frequency", source.number("pitch frequency"))
    _put(control, "pitch_damping", source.number("pitch damping"))
    limit = source.number("thrust limit")
    if limit is not None and limit < 1:
        control["thrust_limit"] = limit


def _schedule(source: Source, rated_wind: float | None) -> tuple[tuple[float, ...], ...]:
    """Lowest pitch below rated wind (m/s; rad), without points inside and at the end of a plateau.

    Above rated wind the tables go on with the pitch of the speed control.
    """
    table = source.at("min_pitch_table") or {"wind_speed": [], "min_pitch": []}
    points = zip(table["wind_speed"], table["min_pitch"], strict=True)
    last = np.inf if rated_wind is None else rated_wind
    below = np.array([point for point in points if point[0] < last]).reshape(-1, 2)
    step = np.diff(below[:, 1], prepend=below[:1, 1], append=below[-1:, 1]) != 0
    wind, pitch = below[step[:-1] | step[1:]].T
    return tuple(wind.tolist()), tuple((pitch * _DEGREE).tolist())


def _gain_schedule(proportional: dict[str, Any], integral: dict[str, Any]) -> tuple[float, ...]:
    """Both gains at zero pitch, deg per 1/min, and the pitch that halves them, rad.

    The line through the inverse of the integral gain at the first and at the middle entry; where
    it does not rise, as with gains that rise again with the pitch, that which fits all entries
    best, level at the most. The proportional gain agrees at its first entry.
    """
    pitch = np.asarray(integral["pitch_angle"], float) * _DEGREE
    gains = -np.asarray(integral["ki"], float)
    if not np.all(gains > 0):
        raise InputError(f"control.pitch_ki.ki = {(-gains).tolist()!r:.200}: must be negative")
    inverse = 1 / gains
    middle = pitch.size // 2
    slope = (inverse[middle] - inverse[0]) / max(pitch[middle] - pitch[0], 1e-9)
    offset = inverse[0] - slope * pitch[0]
    if not (slope > 0 and offset > 0):
        slope, offset = _rising(pitch, inverse)
    halving = offset / slope
    first = proportional["pitch_angle"][0] * _DEGREE
    at_zero = -proportional["kp"][0] * (1 + first / halving)
    return float(at_zero), float(1 / offset), float(halving)


def _rising(pitch: Array, inverse: Array) -> tuple[float, float]:
    """Slope and offset, both positive, of the line that fits best."""
    from scipy.optimize import nnls

    (slope, offset), _ = nnls(np.array([pitch, np.ones(pitch.size)]).T, inverse)
    require(bool(offset > 0), "control", "pitch_ki", inverse.tolist(), "gains at zero pitch")
    return max(float(slope), 1e-3 * float(offset)), float(offset)
