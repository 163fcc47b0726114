"""The file of a turbine, as pydantic checks it, and the turbine that follows from it.

Tables that are parts of a `Turbine` are checked by the ranges of its dataclasses; the others, such
as the rows of a blade, have a model here. Keys that end in ``_deg`` are in degrees.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Self, TypeVar, get_args

import numpy as np
from annotated_types import Ge, Gt, Len, Lt
from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from loadflow.errors import InputError

from .airfoils import blended
from .blade import Airfoil, Blade, Mode
from .control import Control, Supervision
from .modes import bending_modes, tower_mode
from .schema import Drivetrain, RotorGeometry, Turbine
from .tower import Tower, TowerBending

Made = TypeVar("Made")
Location = tuple[int | str, ...]

_Positive = Annotated[float, Gt(0)]
_NotNegative = Annotated[float, Ge(0)]
_Share = Annotated[float, Ge(0), Lt(1)]
_Coefficients = tuple[float, ...]


class _Table(BaseModel):
    """A table of the file: an unknown key is an error, and a text is no number."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class AirfoilTable(_Table):
    """Polars from a file (`polars`, `column`), as lists over `angle`, or a constant drag."""

    thickness: _Positive | None = None
    polars: str | None = None
    column: str | None = None
    angle: tuple[float, ...] | None = None
    lift: tuple[float, ...] | None = None
    drag: float | tuple[float, ...] | None = None
    moment: tuple[float, ...] | None = None
    zero_lift: float | None = None
    lift_slope: float | None = None

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        stated = {
            name
            for name in ("polars", "column", "angle", "lift", "drag")
            if getattr(self, name) is not None
        }
        constant = stated == {"drag"} and isinstance(self.drag, float | int)
        listed = stated == {"angle", "lift", "drag"} and isinstance(self.drag, tuple)
        if not (stated == {"polars", "column"} or constant or listed):
            raise ValueError(
                "needs polars and column, or the lists angle_deg, lift and drag, or one drag"
            )
        return self


class BladeTable(_Table):
    """The blade; `sections` and `structure` are rows, see docs/turbine-files.md."""

    mass: _Positive
    damping: _Share
    sections: Annotated[
        tuple[tuple[float, float, float, float | str], ...],
        Len(2),
    ]
    structure: Annotated[tuple[tuple[float, float, float, float, float], ...], Len(2)]
    modes: dict[str, _Coefficients] | None = None
    prebend: tuple[float, ...] = ()
    torsion: tuple[tuple[float, float, float], ...] = ()


class BendingTable(_Table):
    """How the tower bends."""

    nacelle_mass: _NotNegative
    nacelle_downwind: float
    nacelle_above: float
    damping: _Share
    structure: Annotated[tuple[tuple[float, float, float, float], ...], Len(2)]
    fore_aft: _Coefficients | None = None
    side_side: _Coefficients | None = None


class TowerTable(_Table):
    """The tower."""

    base_diameter: _Positive
    top_diameter: _Positive
    height: _Positive
    bending: BendingTable | None = None


class TurbineFile(BaseModel):
    """All of a turbine. Not strict: pydantic would then ask for the dataclasses themselves."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    name: str
    source: str
    rated_power: _Positive
    rated_wind_speed: _Positive
    cut_in: _Positive
    cut_out: _Positive
    rotor: RotorGeometry
    tower: TowerTable
    drivetrain: Drivetrain
    control: Control
    blade: BladeTable
    airfoils: dict[str, AirfoilTable]
    supervision: Supervision = Supervision()
    frequencies: dict[str, _Positive] = {}
    assumed: tuple[str, ...] = ()


def turbine_from(
    document: Mapping[str, Any], folder: Path, hints: Mapping[str, str] | None = None
) -> Turbine:
    """Check the description of a turbine and make the turbine.

    Parameters
    ----------
    document : mapping
        As its TOML file has it.
    folder : Path
        Where its polars are looked for first.
    hints : mapping, optional
        What to say of a key that is missing, by key, such as where another format has it.

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        All keys that are missing, unknown or out of range, one on a line.
    """
    written: dict[Location, Location] = {}
    data = _in_radians(document, (), (), written)
    try:
        file = TurbineFile.model_validate(data)
    except ValidationError as error:
        raise InputError("\n".join(_messages(error, written, hints or {}))) from error
    airfoils = _all(
        {name: _maker(_airfoil, name, table, folder) for name, table in file.airfoils.items()}
    )
    blade = _blade(file.blade, airfoils)
    on_top = file.rotor.hub_mass + file.rotor.blades * blade.mass
    shared = {name: getattr(file, name) for name in _AS_THEY_ARE}
    return Turbine(**shared, tower=_tower(file.tower, on_top), blade=blade, airfoils=airfoils)


_AS_THEY_ARE = [
    name for name in TurbineFile.model_fields if name not in ("tower", "blade", "airfoils")
]


def _in_radians(
    value: Any, ours: Location, theirs: Location, written: dict[Location, Location]
) -> Any:
    """The data with angles in radians and lists as tuples; `written` keeps the keys that change."""
    if isinstance(value, Mapping):
        found = {}
        for key, inner in value.items():
            degrees = isinstance(key, str) and key.endswith("_deg")
            name = key[:-4] if degrees else key
            if name in found:
                said = ".".join(map(str, (*theirs, name)))
                raise InputError(f"{said} and {said}_deg: state one of both")
            place, source = (*ours, name), (*theirs, key)
            written[place] = source
            inner = _in_radians(inner, place, source, written)
            found[name] = _radians(inner) if degrees else inner
        return found
    if isinstance(value, list | tuple):
        return tuple(_in_radians(inner, ours, theirs, written) for inner in value)
    if isinstance(value, str | bool) and ours[0] in _OF_NUMBERS:
        return _NoNumber(value)
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > _LARGEST:
        return math.inf  # an integer of hundreds of digits, which TOML allows, is no float
    return value


_LARGEST = 2**63
_OF_NUMBERS = (
    "rated_power", "rated_wind_speed", "cut_in", "cut_out", "rotor", "drivetrain", "control",
    "supervision", "frequencies",
)  # fmt: skip
"""Keys under which there are numbers alone."""


class _NoNumber:
    """A text, or true, where a number belongs: pydantic would take "63" for one."""

    def __init__(self, value: object) -> None:
        self.value = value

    def __repr__(self) -> str:
        return repr(self.value)


def _radians(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_radians, value))
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return math.radians(value) if number else value


def _messages(
    error: ValidationError, written: Mapping[Location, Location], hints: Mapping[str, str]
) -> Iterator[str]:
    """One line for each thing that is wrong: key, value, what is allowed."""
    from loadflow.numerics.fields import shown, unknown_key

    told = set()
    for item in error.errors():
        place = tuple(part for part in item["loc"] if part not in _KINDS_OF_VALUES)
        key = _key(place, written)
        reason = item["msg"].removeprefix("Value error, ").replace("Input should be", "must be")
        if item["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
            line = f"{key}: {unknown_key(str(place[-1]), _known(place[:-1]))}"
        elif item["type"] in ("missing", "missing_argument"):
            hint = hints.get(key) or hints.get(f"{key}_deg")
            line = f"{key}: missing key" + (f" ({hint})" if hint else "")
        elif item["type"] == "value_error":
            line = f"[{key}] {reason}" if key else reason
        elif key.endswith("_deg") and isinstance(item["input"], float):
            bounds = [one for one in item.get("ctx", {}).values() if isinstance(one, float)]
            for bound in bounds:
                reason = reason.replace(str(bound), f"{math.degrees(bound):.4g}")
            line = f"{key} = {math.degrees(item['input']):.6g}: {reason}"
        else:
            line = f"{key} = {shown(item['input'])}: {reason}"
        if line not in told:
            told.add(line)
            yield line


_KINDS_OF_VALUES = ("float", "str", "constrained-str", "tuple[float, ...]", "int")
"""What pydantic puts behind a key whose values may be of several kinds."""


def _key(place: Location, written: Mapping[Location, Location]) -> str:
    for size in range(len(place), 0, -1):
        if place[:size] in written:
            place = (*written[place[:size]], *place[size:])
            break
    return ".".join(map(str, place))


def _known(place: Location) -> list[str]:
    """Keys of the table at a place."""
    table: Any = TurbineFile
    for part in place:
        if isinstance(part, int):
            continue
        own = _fields(table).get(str(part))
        inner = [arg for arg in (own, *get_args(own)) if hasattr(arg, "__annotations__")]
        if inner:
            table = inner[-1]
    return [*_fields(table)]


def _fields(table: Any) -> dict[str, Any]:
    if issubclass(table, BaseModel):
        return {name: info.annotation for name, info in table.model_fields.items()}
    return {field.name: None for field in fields(table)}


def _maker(function: Callable[..., Made], *arguments: Any) -> Callable[[], Made]:
    return lambda: function(*arguments)


def _all(makers: Mapping[str, Callable[[], Made]]) -> dict[str, Made]:
    """What each of them makes; all that cannot be made are told together."""
    found, wrong = {}, []
    for name, make in makers.items():
        try:
            found[name] = make()
        except InputError as error:
            wrong.append(str(error))
    if wrong:
        raise InputError("\n".join(wrong))
    return found


def _tower(table: TowerTable, on_top: float) -> Tower:
    bending = None if table.bending is None else _bending(table.bending, on_top)
    return Tower(table.base_diameter, table.top_diameter, table.height, bending)


def _bending(table: BendingTable, rotor_mass: float) -> TowerBending:
    """How the tower bends; mode shapes that are left out follow from mass and stiffness."""
    height, density, *stiffness = np.array(table.structure, dtype=float).T
    modes = {
        name: getattr(table, name)
        or tower_mode(height, density, rigidity, table.nacelle_mass + rotor_mass)
        for name, rigidity in zip(("fore_aft", "side_side"), stiffness, strict=True)
    }
    return TowerBending(
        nacelle_mass=table.nacelle_mass,
        nacelle_downwind=table.nacelle_downwind,
        nacelle_above=table.nacelle_above,
        damping=table.damping,
        height=height,
        mass_density=density,
        fore_aft_stiffness=stiffness[0],
        side_side_stiffness=stiffness[1],
        **modes,
    )


def _blade(table: BladeTable, airfoils: dict[str, Airfoil]) -> Blade:
    """The blade; airfoils that it asks for by their thickness are added to `airfoils`."""
    foils = [_section_airfoil(row[3], airfoils) for row in table.sections]
    numbers = np.array([row[:3] for row in table.sections], dtype=float)
    structure = np.array(table.structure, dtype=float)
    span, _, density, flap, edge = structure.T
    if table.modes is None:
        modes = bending_modes(span, density, flap, edge)
    else:
        modes = tuple(Mode(name, coefficients) for name, coefficients in table.modes.items())
    torsion = np.array(table.torsion, dtype=float).reshape(-1, 3)
    return Blade(
        radius=numbers[:, 0],
        twist=np.radians(numbers[:, 1]),
        chord=numbers[:, 2],
        airfoil=tuple(foils),
        mass=table.mass,
        damping=table.damping,
        span=span,
        structural_twist=np.radians(structure[:, 1]),
        mass_density=density,
        flap_stiffness=flap,
        edge_stiffness=edge,
        modes=modes,
        prebend=np.array(table.prebend, dtype=float),
        torsion_span=torsion[:, 0],
        torsion_stiffness=torsion[:, 1],
        centre_ahead=torsion[:, 2],
    )


def _section_airfoil(entry: str | float, airfoils: dict[str, Airfoil]) -> str:
    """Name of the airfoil of a section, given by name or by its relative thickness."""
    if isinstance(entry, str):
        return entry
    foil = blended(airfoils, entry)
    airfoils.setdefault(foil.name, foil)
    return foil.name


def _airfoil(name: str, table: AirfoilTable, folder: Path) -> Airfoil:
    """Polars of a file or of lists, or a constant drag without lift."""
    where = f"airfoils.{name}"
    flow = table.thickness, table.zero_lift, table.lift_slope
    if table.polars is not None:
        columns = _polars(folder, table.polars, str(table.column), where)
    elif table.angle is not None:
        columns = [np.array(c, dtype=float) for c in (table.angle, table.lift, table.drag)]
        columns.append(np.array(table.moment or (), dtype=float))
    else:
        constant = np.full(2, table.drag, dtype=float)
        columns = [np.array([-np.pi, np.pi]), np.zeros(2), constant, np.zeros(0)]
    angle, lift, drag, moment = columns
    try:
        return Airfoil(name, angle, lift, drag, *flow, moment)
    except InputError as error:
        raise InputError(f"{where}: {error}") from error


def _polars(folder: Path, file: str, column: str, where: str) -> list[np.ndarray]:
    """Angle (rad), lift, drag and, where there is one, moment of a column of a file of polars."""
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
    angle, lift, drag = (values[:, names.index(name)] for name in wanted)
    own = f"{column}_cm"
    moment = values[:, names.index(own)] if own in names else np.zeros(0)
    return [np.radians(angle), lift, drag, moment]
