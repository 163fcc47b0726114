"""Reading a turbine from its TOML file."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable
from dataclasses import MISSING, fields, replace
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, get_origin, get_type_hints

import numpy as np

from loadflow.errors import InputError

from .airfoils import blended
from .modes import bending_modes, tower_mode
from .schema import (
    Airfoil,
    Blade,
    Control,
    Drivetrain,
    Mode,
    RotorGeometry,
    Supervision,
    Turbine,
)
from .similarity import factor_of_power, scaled
from .tower import Tower, TowerBending

_PARTS = {
    "rotor": RotorGeometry,
    "drivetrain": Drivetrain,
    "control": Control,
}
_SCALARS = ("name", "source", "rated_power", "rated_wind_speed", "cut_in", "cut_out")


def turbine_names() -> list[str]:
    """Names of the turbines that come with the package.

    Examples
    --------
    >>> "nrel-5mw" in turbine_names()
    True
    """
    folder = resources.files(__package__)
    return sorted(f.name[:-5] for f in folder.iterdir() if f.name.endswith(".toml"))


def load_turbine(turbine: str | Path | Turbine) -> Turbine:
    """Read a turbine.

    Parameters
    ----------
    turbine : str, Path or Turbine
        Name of a turbine of the package (see `turbine_names`), path of a TOML file of the same
        shape, or a turbine already read, which is handed back. A name followed by ``@`` and a rated
        power in W, such as ``"nrel-5mw@8e6"``, is that turbine scaled by similarity
        (`loadflow.turbines.scaled`).

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        Unknown name, unreadable file, missing or unknown key, value outside its range.

    Examples
    --------
    >>> round(load_turbine("nrel-5mw").rotor_mass)
    109390
    """
    if isinstance(turbine, Turbine):
        return turbine
    base, power = scaled_name(turbine)
    if power is not None:
        return _scaled(base, power)
    path = Path(turbine)
    if path.suffix != ".toml":
        if str(turbine) not in turbine_names():
            raise InputError(
                f"unknown turbine {str(turbine)!r}; known are {', '.join(turbine_names())}, "
                "or give the path of a .toml file"
            )
        return _shipped(str(turbine))
    return _read(path)


def scaled_name(turbine: str | Path) -> tuple[str, float | None]:
    """Name of a turbine and the power (W) that it is scaled to; None if it is not.

    Raises
    ------
    InputError
        What stands behind ``@`` is no power.

    Examples
    --------
    >>> from loadflow.turbines.files import scaled_name
    >>> scaled_name("nrel-5mw@8e6"), scaled_name("nrel-5mw")
    (('nrel-5mw', 8000000.0), ('nrel-5mw', None))
    """
    name, mark, power = Path(turbine).name.rpartition("@")
    if not mark or Path(turbine).suffix == ".toml":
        return str(turbine), None
    base = str(Path(turbine).with_name(name)) if name else ""
    try:
        number = float(power)
    except ValueError:
        number = math.nan
    if not name or not (math.isfinite(number) and number > 0):
        raise InputError(
            f"turbine {str(turbine)!r}: a rated power in W is needed behind @, such as nrel-5mw@8e6"
        )
    return base, number


@cache
def _scaled(base: str, power: float) -> Turbine:
    """A turbine of another power, made once."""
    known = load_turbine(base)
    return scaled(known, factor_of_power(power, known.rated_power))


@cache
def _shipped(name: str) -> Turbine:
    """A turbine of the package, read once, so that what is derived from it is made once too."""
    return _read(Path(str(resources.files(__package__))) / f"{name}.toml")


def _read(path: Path) -> Turbine:
    if not path.is_file():
        raise InputError(f"turbine file {path} does not exist")
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file: {error}") from error
    try:
        return _turbine(document, path.parent)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _turbine(document: dict[str, Any], folder: Path) -> Turbine:
    frequencies = _table(document.pop("frequencies", {}), "frequencies")
    _check_keys(
        document, {*_SCALARS, *_PARTS, "tower", "blade", "airfoils"}, "file", {"supervision"}
    )
    parts: dict[str, Any] = {
        name: _part(part, document[name], name) for name, part in _PARTS.items()
    }
    parts["supervision"] = _part(Supervision, document.get("supervision", {}), "supervision")
    airfoils = {
        name: _airfoil(name, entry, folder)
        for name, entry in _table(document["airfoils"], "airfoils").items()
    }
    blade = _blade(document["blade"], airfoils)
    rotor: RotorGeometry = parts["rotor"]
    parts["tower"] = _tower(document["tower"], rotor.hub_mass + rotor.blades * blade.mass)
    scalars: dict[str, Any] = {
        key: str(document[key]) if key in ("name", "source") else _number(document[key], key)
        for key in _SCALARS
    }
    return Turbine(
        **scalars,
        **parts,
        blade=blade,
        airfoils=airfoils,
        frequencies={k: _number(v, f"frequencies.{k}") for k, v in frequencies.items()},
    )


def _part(part: Any, entry: Any, name: str) -> Any:
    """One table of numbers and lists of them; a key that ends in ``_deg`` is turned to radians."""
    values: dict[str, Any] = {}
    for key, value in _table(entry, name).items():
        degrees, where = key.endswith("_deg"), f"{name}.{key}"
        kept = key[:-4] if degrees else key
        if isinstance(value, list):
            if not _is_list(part, kept):
                raise InputError(f"{where}: expected a finite number, found {value!r:.200}")
            numbers = _numbers(value, where)
            values[kept] = tuple(np.radians(numbers).tolist()) if degrees else numbers
            continue
        if _is_list(part, kept):
            raise InputError(f"{where}: expected a list of numbers, found {value!r:.200}")
        number = _number(value, where)
        if degrees:
            number = np.radians(number).item()
        values[kept] = int(number) if key == "blades" else number
    needed = {f.name for f in fields(part) if f.default is MISSING}
    _check_keys(values, needed, name, {f.name for f in fields(part)} - needed)
    try:
        return part(**values)
    except InputError as error:
        raise InputError(f"[{name}] {error}") from error


def _is_list(part: Any, key: str) -> bool:
    """Whether a part of a turbine has a list of numbers under this key."""
    return get_origin(get_type_hints(part).get(key)) is tuple


def _tower(entry: Any, rotor_mass: float) -> Tower:
    """The tower, with its bending where the file describes it."""
    table = dict(_table(entry, "tower"))
    bending = table.pop("bending", None)
    tower: Tower = _part(Tower, table, "tower")
    return tower if bending is None else replace(tower, bending=_bending(bending, rotor_mass))


def _bending(entry: Any, rotor_mass: float) -> TowerBending:
    """How the tower bends; mode shapes that are left out follow from mass and stiffness."""
    where = "tower.bending"
    table = _table(entry, where)
    scalars = {"nacelle_mass", "nacelle_downwind", "nacelle_above", "damping"}
    shapes = ("fore_aft", "side_side")
    _check_keys(table, {*scalars, "structure"}, where, shapes)
    rows = _rows(table["structure"], 4, f"{where}.structure")
    columns = np.array([[_number(v, f"{where}.structure") for v in row] for row in rows]).T
    numbers: dict[str, Any] = {key: _number(table[key], f"{where}.{key}") for key in scalars}
    height, mass_density, *stiffness = columns
    top_mass = numbers["nacelle_mass"] + rotor_mass
    modes: dict[str, Any] = {
        key: _numbers(table[key], f"{where}.{key}")
        if key in table
        else tower_mode(height, mass_density, rigidity, top_mass)
        for key, rigidity in zip(shapes, stiffness, strict=True)
    }
    return TowerBending(
        height=height,
        mass_density=mass_density,
        fore_aft_stiffness=stiffness[0],
        side_side_stiffness=stiffness[1],
        **numbers,
        **modes,
    )


def _blade(entry: Any, airfoils: dict[str, Airfoil]) -> Blade:
    """The blade; airfoils that it asks for by their thickness are added to `airfoils`."""
    blade = _table(entry, "blade")
    needed = {"mass", "damping", "sections", "structure"}
    _check_keys(blade, needed, "blade", {"modes", "prebend"})
    sections = _rows(blade["sections"], 4, "blade.sections")
    foils = [_section_airfoil(row[3], airfoils) for row in sections]
    structure = np.array(
        [
            [_number(value, "blade.structure") for value in row]
            for row in _rows(blade["structure"], 5, "blade.structure")
        ]
    )
    numbers = np.array([[_number(v, "blade.sections") for v in row[:3]] for row in sections])
    shape = tuple(structure[:, k] for k in (0, 2, 3, 4))
    modes = _modes(blade["modes"]) if "modes" in blade else bending_modes(*shape)
    return Blade(
        radius=numbers[:, 0],
        twist=np.radians(numbers[:, 1]),
        chord=numbers[:, 2],
        airfoil=tuple(foils),
        mass=_number(blade["mass"], "blade.mass"),
        damping=_number(blade["damping"], "blade.damping"),
        span=structure[:, 0],
        structural_twist=np.radians(structure[:, 1]),
        mass_density=structure[:, 2],
        flap_stiffness=structure[:, 3],
        edge_stiffness=structure[:, 4],
        modes=modes,
        prebend=np.array(_numbers(blade.get("prebend", []), "blade.prebend")),
    )


def _modes(entry: Any) -> tuple[Mode, ...]:
    return tuple(
        Mode(name, _numbers(coefficients, f"blade.modes.{name}"))
        for name, coefficients in _table(entry, "blade.modes").items()
    )


def _section_airfoil(entry: Any, airfoils: dict[str, Airfoil]) -> str:
    """Name of the airfoil of a section, given by name or by its relative thickness."""
    if isinstance(entry, str):
        return entry
    foil = blended(airfoils, _number(entry, "blade.sections"))
    airfoils.setdefault(foil.name, foil)
    return foil.name


def _airfoil(name: str, entry: Any, folder: Path) -> Airfoil:
    """Polars of a file, or a constant drag without lift."""
    where = f"airfoils.{name}"
    table = dict(_table(entry, where))
    thickness = table.pop("thickness", None)
    if thickness is not None:
        thickness = _number(thickness, where)
    if set(table) == {"drag"}:
        drag = _number(table["drag"], where)
        return Airfoil(name, np.array([-np.pi, np.pi]), np.zeros(2), np.full(2, drag), thickness)
    stated = {key: table.pop(key) for key in ("zero_lift_deg", "lift_slope") if key in table}
    _check_keys(table, {"polars", "column"}, where)
    angle, lift, drag_of = _polars(folder, str(table["polars"]), str(table["column"]), where)
    zero, slope = (
        _number(stated[key], f"{where}.{key}") if key in stated else None
        for key in ("zero_lift_deg", "lift_slope")
    )
    zero = None if zero is None else np.radians(zero)
    return Airfoil(name, np.radians(angle), lift, drag_of, thickness, zero, slope)


def _polars(folder: Path, file: str, column: str, where: str) -> list[np.ndarray]:
    shipped = Path(str(resources.files("loadflow.data"))) / "polars" / file
    try:
        path = folder / file if (folder / file).is_file() else shipped
        head, *lines = path.read_text(encoding="utf-8").split()
    except (OSError, ValueError) as error:  # none there, no name of a file, no text, nothing in it
        raise InputError(
            f"{where}: polars {file!r:.200}: no table of text beside the turbine or in loadflow"
        ) from error
    names = head.split(",")
    wanted = ["angle_of_attack_deg", f"{column}_cl", f"{column}_cd"]
    missing = [name for name in wanted if name not in names]
    if missing:
        raise InputError(f"{where}: {path} has no column {missing[0]!r}; it has {', '.join(names)}")
    try:
        values = np.array([line.split(",") for line in lines], dtype=float)
    except ValueError as error:
        raise InputError(f"{where}: {path}: {error}") from error
    return [values[:, names.index(name)] for name in wanted]


def _check_keys(
    found: dict[str, Any], needed: set[str], where: str, optional: Iterable[str] = ()
) -> None:
    missing, unknown = needed - set(found), set(found) - needed - set(optional)
    if missing:
        raise InputError(f"{where}: missing key {', '.join(sorted(missing))}")
    if unknown:
        raise InputError(f"{where}: unknown key {', '.join(sorted(unknown))}")


def _table(value: Any, where: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InputError(f"{where}: expected a table, found {value!r}")
    return value


def _rows(value: Any, width: int, where: str) -> list[list[Any]]:
    good = isinstance(value, list) and len(value) > 1
    if not good or not all(isinstance(row, list) and len(row) == width for row in value):
        raise InputError(f"{where}: expected at least two rows of {width} values")
    return value


def _numbers(value: Any, where: str) -> tuple[float, ...]:
    if not isinstance(value, list):
        raise InputError(f"{where}: expected a list of numbers, found {value!r:.200}")
    return tuple(_number(v, where) for v in value)


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise InputError(f"{where}: expected a finite number, found {value!r:.200}")
    try:
        number = float(value)
    except OverflowError:  # an integer of hundreds of digits, which TOML allows
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{where}: expected a finite number, found {value!r:.200}")
    return number
