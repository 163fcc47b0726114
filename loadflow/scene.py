"""A scene: one TOML file that says what is wanted, from which loads, for which bearings.

`read_scene` is the only gate: what comes out is frozen and valid. The scene composes the options
that each room owns; it knows no physics.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import BaseModel, Field, ValidationError, field_validator, model_validator

from loadflow.errors import InputError
from loadflow.journal import (
    GasMixture,
    Heat,
    JournalBearing,
    LinedShell,
    LocalShell,
    Lubricant,
    Supply,
    ThickShell,
)
from loadflow.rolling import SphericalRollerBearing
from loadflow.scene_bearings import KINDS, SECTION, Rolling
from loadflow.shaft.beam import BearingSeat
from loadflow.shaft.options import (
    Concept,
    DirectDrive,
    Integrated,
    MomentBearing,
    ThreePoint,
    TwoPoint,
)

Result = Literal[
    "loads.statistics",
    "seeds.equality",
    "reduction.histogram",
    "journal.film",
    "rolling.loads",
    "rolling.life",
    "rolling.friction",
]

Positive = Annotated[float, Field(gt=0)]


class _Section(BaseModel):
    """Part of a scene: frozen, and an unknown key is an error."""

    model_config = SECTION

    @property
    def changed(self) -> set[str]:
        """Keys whose value is not the default, also of a scene written with all its defaults."""
        known = type(self).model_fields
        return {name for name in known if getattr(self, name) != known[name].default}


class Turbine(_Section):
    """The turbine: a name that `loadflow.turbines` knows, or a path to a file of the same form."""

    name: str = "nrel-5mw"


class Loads(_Section):
    """Where the load series come from.

    ``source = "simulate"`` makes them from IEC wind; ``source = "files"`` reads them: the output of
    a simulator, or a load cube (``.h5``). ``weights = "given"`` keeps the shares of the lifetime
    that a cube or a case list states; otherwise they follow from the wind speed (2.2).
    ``mass_imbalance`` (share of its mass) and ``pitch_imbalance`` (rad) are those of blade 1;
    without them the rotor is perfect and the fixed-frame loads have no 1p line.

    ``winds`` are turbulent fields of your own (names or patterns of ``.bts`` and ``.wnd`` files).
    The rotor is simulated in each, from its 60th second on, as in the load case ``dlc``. Their
    names tell wind speed and seed as those of load series do, or by ``pattern``; else the speed is
    the mean of the field.

    ``dlc`` is one design load case of IEC 61400-1 or several; wind speeds, realisations and length
    are those of each load case unless they are given here. ``seeds`` and ``first_seed`` concern
    turbulent winds; a gust has its own variants (sign, time of the event), and may meet the rotor
    at several ``azimuths`` (rad). ``yaw_errors`` are in rad. ``steady`` takes the steady extreme
    wind of 6.1 … 6.3 and 7.1. ``spectrum = "mann"`` needs the extra of that name; ``wind_grid`` are
    the radii, with the hub, and the angles of the polar grid of the wind, and another grid is
    another realisation. A ``rung`` that is not named is "tower" ("flap" where the turbine does not
    say how its tower bends), and "tables" for a parked turbine.
    """

    source: Literal["simulate", "files"] = "simulate"
    files: list[str] = []
    case_list: str | None = None
    pattern: str | None = None
    winds: list[str] = []
    weights: Literal["rayleigh", "given"] = "rayleigh"
    dlc: str | Annotated[list[str], Field(min_length=1)] = "1.1"
    wind_speeds: Annotated[list[Positive], Field(min_length=1)] | None = None
    seeds: Annotated[int, Field(ge=1, le=1000)] | None = None
    first_seed: Annotated[int, Field(ge=0)] = 1
    yaw_errors: Annotated[list[float], Field(min_length=1)] | None = None
    azimuths: Annotated[list[float], Field(min_length=1)] = [0.0]
    steady: bool = False
    duration: Positive | None = None
    step: Annotated[float, Field(gt=0, le=0.5)] = 0.025
    wind_class: Literal["I", "II", "III"] = "I"
    category: Literal["A+", "A", "B", "C"] = "B"
    spectrum: Literal["kaimal", "mann"] = "kaimal"
    wind_grid: tuple[Annotated[int, Field(ge=2, le=41)], Annotated[int, Field(ge=6, le=288)]] = (
        11,
        48,
    )
    rung: Literal["tables", "bem", "flap", "tower"] | None = None
    individual_pitch: bool = False
    mass_imbalance: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    pitch_imbalance: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0

    @property
    def makes_wind(self) -> bool:
        """Whether the wind is made, and neither it nor the loads are given."""
        return self.source == "simulate" and not self.winds

    @property
    def dlcs(self) -> tuple[str, ...]:
        """The design load cases, each once."""
        return tuple(dict.fromkeys([self.dlc] if isinstance(self.dlc, str) else self.dlc))

    @model_validator(mode="before")
    @classmethod
    def _given_before_simulated(cls, data: Any) -> Any:
        """Given series are read, not simulated anew, unless the scene says otherwise."""
        if isinstance(data, dict) and data.get("files") and "source" not in data:
            return data | {"source": "files"}
        return data

    @model_validator(mode="after")
    def _files_for_files(self) -> Self:
        if self.source == "simulate" and self.files:
            raise ValueError('files are given, but source = "simulate"; set source = "files"')
        own = {"wind_speeds", "seeds", "first_seed", "steady"} & self.changed
        if self.winds and (own or self.source == "files" or len(self.dlcs) > 1):
            raise ValueError(
                "winds: each field is a simulated case of one dlc; leave out "
                f"{', '.join(sorted(own)) or 'files, or all load cases but one'}"
            )
        return self


class Shaft(_Section):
    """Suspensions to compute; a table that is left out costs nothing.

    ``two_point``, ``integrated`` and ``direct_drive`` have the bearings N (floating) and N2
    (locating), ``three_point`` the bearing N and the gearbox's torque arms G; one of these at most.
    ``moment`` has the bearing M. With a ``beam`` in its table the shaft bends, and tilts in its
    bearings; an empty one takes the defaults. A seat of the beam with ``stiffness = "journal"`` or
    ``"rolling"`` gives under each load as the bearing of that kind that the scene has there.
    """

    two_point: TwoPoint | None = None
    three_point: ThreePoint | None = None
    integrated: Integrated | None = None
    direct_drive: DirectDrive | None = None
    moment: MomentBearing | None = None

    @property
    def concepts(self) -> tuple[Concept, ...]:
        """The suspensions that the scene has."""
        return tuple(concept for _, concept in self if concept)

    @property
    def bearings(self) -> tuple[str, ...]:
        """Names of the bearings that these suspensions have."""
        return tuple(name for concept in self.concepts for name in concept.bearings)

    @model_validator(mode="after")
    def _each_bearing_once(self) -> Self:
        with_first = [name for name, concept in self if concept and "N" in concept.bearings]
        if len(with_first) > 1:
            raise ValueError(f"{' and '.join(with_first)} all have a bearing N; keep one of them")
        return self

    @property
    def seated(self) -> dict[str, BearingSeat]:
        """Seats, by bearing, whose stiffness comes from a journal or rolling bearing."""
        return {
            name: seat
            for concept in self.concepts
            for name, seat in zip(concept.bearings, concept.beam.seats if concept.beam else ())
            if seat.stiffness != "given"
        }

    def leans(self, bearing: str) -> bool:
        """Whether the shaft is a beam there, so that its tilt in the bearing is known."""
        return any(c.beam is not None and bearing in c.bearings for c in self.concepts)


class Seeds(_Section):
    """Tests of seed equality: level of significance, method, half width of the spectral band."""

    alpha: Annotated[float, Field(gt=0, lt=1)] = 0.05
    methods: list[Literal["as-printed", "calibrated"]] = ["as-printed", "calibrated"]
    band: Annotated[float, Field(gt=0, lt=1)] = 0.025


class Reduction(_Section):
    """Quasi-static histogram reduction: share of the samples kept, and how they are picked."""

    size: Annotated[float, Field(gt=0, le=1)] = 0.1
    pick: Literal["random", "extremes", "envelope"] = "extremes"
    seed: Annotated[int, Field(ge=0)] = 0


class Journal(_Section):
    """Journal bearings: which ones of the shaft, and one set of data for all of them.

    ``motion = "quasi-static"`` solves the equilibrium of every sample of the reduced series;
    ``"transient"`` follows the shaft through the whole series, step by step.
    ``rung = "map"`` tabulates the film once, for long series (docs/journal-map.md).

    With a table ``heat`` the friction of the film warms its oil, which takes the place of
    ``lubricant``: each equilibrium for itself, a film in motion to one temperature for the whole
    series, as its loads change faster than a bearing warms.

    With ``tilt`` the shaft leans in them as the beam of its suspension does, tilted and bent; if it
    has none, it tilts freely under the moment that the shaft stage gives. The film is then solved
    over its full width.

    A ``shell`` makes the bore elastic; its key ``kind`` says how: local, lined or thick.
    """

    bearings: Annotated[list[str], Field(min_length=1)] = ["N", "N2"]
    geometry: JournalBearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    lubricant: Lubricant = Lubricant(viscosity=0.050)
    cavitation: GasMixture = GasMixture(0.05e6)
    edge_pressure: Annotated[float, Field(ge=0)] = 0.5e6
    supply: Supply | None = None
    grid: tuple[Annotated[int, Field(ge=12, le=720)], Annotated[int, Field(ge=4, le=240)]] = (
        60,
        20,
    )
    grading: Literal["auto", "uniform", "graded"] = "auto"
    rung: Literal["map", "reduced", "grid"] = "grid"
    heat: Heat | None = None
    motion: Literal["quasi-static", "transient"] = "quasi-static"
    tilt: bool = False
    shell: LocalShell | LinedShell | ThickShell | None = None

    @model_validator(mode="after")
    def _elastic_on_the_grid(self) -> Self:
        if self.shell is not None and self.rung != "grid":
            raise ValueError(
                f'rung "{self.rung}" has a rigid shell: set "grid", or leave out shell'
            )
        return self

    @property
    def in_motion(self) -> bool:
        """Whether the film follows the whole series; it does not read the reduced one then."""
        return self.motion == "transient"

    @property
    def film(self) -> dict[str, Any]:
        """Keywords of `JournalBearing.equilibrium` and `orbit` that say what the film is."""
        mesh = ("grid", "grading", "rung")
        names = ("lubricant", "cavitation", "edge_pressure", "supply", *mesh, "shell")
        return {name: getattr(self, name) for name in names}

    def at_temperature(self, temperature: float) -> Journal:
        """The bearing with its oil held at `temperature`, K."""
        if self.heat is None:
            return self
        return self.model_copy(update={"lubricant": self.heat.lubricant(temperature), "heat": None})

    @model_validator(mode="after")
    def _one_oil(self) -> Self:
        if self.heat is not None and "lubricant" in self.changed:
            raise ValueError("lubricant: follows from heat.oil and its temperature; leave it out")
        return self


class Friction(_Section):
    """Lubricant and surfaces of the rolling bearings, for their friction and slip.

    ``lubricant`` is a name of `loadflow.tribology.lubricant_names`; ``temperature`` (K),
    ``roughness`` (m), ``starvation``, ``roller_drag`` (N m s) and ``seal_torque`` (N m) are those
    of `loadflow.rolling.FrictionOptions`. Loads are taken every ``step`` (s); rollers have shorter
    steps of their own.
    """

    lubricant: str = "lgep-2"
    temperature: Annotated[float, Field(gt=200, le=500)] = 313.15
    roughness: Positive = 0.6e-6
    starvation: Annotated[float, Field(gt=0, le=1)] = 0.7
    roller_drag: Annotated[float, Field(ge=0)] = 1e-3
    seal_torque: Annotated[float, Field(ge=0)] = 0.0
    step: Positive = 0.1

    @field_validator("lubricant")
    @classmethod
    def _known(cls, name: str) -> str:
        from loadflow.tribology import lubricant_names

        if name not in lubricant_names():
            raise ValueError(f"must be one of {', '.join(lubricant_names())}")
        return name


class Scene(_Section):
    """What is wanted, and from what; see the modules of the sections for units.

    Attributes
    ----------
    name : str
        Name of the run and of its folder.
    results : list of str
        What is wanted; the plan runs only the stages that these need.
    accuracy : float or dict, optional
        Largest relative error allowed, of every result or by result. The plan then takes the
        cheapest models that hold it, wherever the scene names none; without it the defaults.
    """

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_.-]+$")]
    results: Annotated[list[Result], Field(min_length=1)] = list(get_args(Result))
    accuracy: Positive | dict[Result, Positive] | None = None
    turbine: Turbine = Turbine()
    loads: Loads = Loads()
    shaft: Shaft = Shaft(two_point=TwoPoint(), moment=MomentBearing())
    seeds: Seeds = Seeds()
    reduction: Reduction = Reduction()
    journal: Journal = Journal()
    rolling: Rolling = Rolling()
    friction: Friction = Friction()

    @model_validator(mode="after")
    def _bearings_exist(self) -> Self:
        wanted = {
            "journal.bearings": self.journal.bearings if self.wants("journal") else [],
            "rolling.bearing": [*self.rolling.geometries] if self.wants("rolling") else [],
        }
        for key, bearings in wanted.items():
            for bearing in bearings:
                if bearing not in self.shaft.bearings:
                    have = ", ".join(self.shaft.bearings) or "none"
                    raise ValueError(f"{key} = {bearing!r}: the shaft has the bearings {have}")
        return self

    @model_validator(mode="after")
    def _seats_have_bearings(self) -> Self:
        there = {"journal": self.journal.bearings, "rolling": [*self.rolling.geometries]}
        for name, seat in self.shaft.seated.items():
            what = f'shaft: seat of bearing {name} with stiffness = "{seat.stiffness}"'
            have = there[seat.stiffness]
            if name not in have:
                raise ValueError(
                    f"{what}: the scene has {seat.stiffness} bearings at {', '.join(have)} only"
                )
            if seat.takes_moment and seat.stiffness == "journal" and not self.journal.tilt:
                raise ValueError(
                    f"{what} and takes_moment = true: only a tilted film takes a moment; set "
                    "journal.tilt = true, or leave out takes_moment"
                )
            aligning = isinstance(self.rolling.geometries.get(name), SphericalRollerBearing)
            if seat.takes_moment and seat.stiffness == "rolling" and aligning:
                raise ValueError(f"{what}: it aligns itself; leave out takes_moment")
        return self

    @model_validator(mode="after")
    def _leaning_at_rest(self) -> Self:
        journal = self.journal
        leaning = journal.tilt and any(map(self.shaft.leans, journal.bearings))
        if leaning and journal.in_motion:
            raise ValueError(
                'journal.motion = "transient" does not know the tilt of a shaft with a beam; set '
                '"quasi-static", or leave out journal.tilt or the beam'
            )
        return self

    def wants(self, room: str) -> bool:
        """Whether a result of `room` is wanted."""
        return any(result.split(".")[0] == room for result in self.results)

    def allowed_error(self, result: str) -> float | None:
        """Largest relative error allowed of a result; None where nothing is asked."""
        if isinstance(self.accuracy, dict):
            return {str(name): value for name, value in self.accuracy.items()}.get(result)
        return self.accuracy

    def to_toml(self) -> str:
        """Return the scene with all defaults, as TOML."""
        import tomli_w

        return tomli_w.dumps(self.model_dump(mode="json", exclude_none=True))

    def digest(self, *sections: str) -> str:
        """SHA-256 of the resolved scene, or of some of its sections."""
        include = set(sections) if sections else None
        return hashlib.sha256(self.model_dump_json(include=include).encode()).hexdigest()


def read_scene(path: str | Path) -> Scene:
    """Read and check a scene file.

    Parameters
    ----------
    path : str or Path
        TOML file. Load files in it are meant relative to the file.

    Returns
    -------
    Scene
        Frozen and valid.

    Raises
    ------
    InputError
        The file is missing, is not TOML, or holds a bad key or value; the message names file, key,
        value and what is allowed.
    """
    path = Path(path)
    try:
        with path.open("rb") as stream:
            data = tomllib.load(stream)
    except OSError as error:
        raise InputError(f"{path}: cannot read the scene: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file: {error}") from error
    return make_scene(_anchor_files(data, path.parent), str(path))


def make_scene(data: dict[str, Any], source: str = "scene") -> Scene:
    """Build a scene from a dictionary; `source` names it in messages.

    Raises
    ------
    InputError
        As `read_scene`.
    """
    data.setdefault("name", Path(source).stem)
    try:
        return Scene.model_validate(data)
    except ValidationError as error:
        raise InputError(_message(error, source)) from error


def with_loads(scene: Scene, files: list[str]) -> Scene:
    """Return the scene with its load series read from `files` (names or glob patterns)."""
    loads = scene.loads.model_copy(update={"source": "files", "files": files})
    return scene.model_copy(update={"loads": loads})


def _anchor_files(data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Make relative load files relative to the scene file, not to where the user stands."""
    loads = data.get("loads")
    if isinstance(loads, dict) and isinstance(loads.get("files"), list):
        files = [str(folder / file) if isinstance(file, str) else file for file in loads["files"]]
        return data | {"loads": loads | {"files": files}}
    return data


def _message(error: ValidationError, source: str) -> str:
    """One line per bad key: file, key, value, what is allowed."""
    lines = []
    for item in _of_stated_kind(error.errors()):
        key = ".".join(str(part) for part in _place(item["loc"])) or "scene"
        reason = item["msg"].removeprefix("Value error, ").replace("Input should be", "must be")
        if item["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
            lines.append(f"{source}: {key}: unknown key{_neighbours(item['loc'])}")
        elif item["type"] == "missing":
            lines.append(f"{source}: {key}: this key is missing")
        elif item["type"] == "value_error":
            lines.append(f"{source}: {key}: {reason}")
        else:
            lines.append(f"{source}: {key} = {item['input']!r}: {reason}")
    return "\n".join(lines)


def _place(location: tuple[int | str, ...]) -> Iterator[int | str]:
    """Keys down to a value, without the tag that pydantic puts after a geometry."""
    for before, part in zip(("", *location), location):
        if not (before == "geometry" and part in KINDS):
            yield part


def _of_stated_kind(errors: list[Any]) -> list[Any]:
    """Drop what is said of alternatives of another ``kind`` than the scene states."""
    kinds = [e for e in errors if e["type"] == "literal_error" and e["loc"][-1] == "kind"]
    others = {e["loc"][:-1] for e in kinds}

    def other(location: tuple[Any, ...]) -> tuple[Any, ...] | None:
        return next((o for o in others if location[: len(o)] == o), None)

    right = {e["loc"] for e in errors if other(e["loc"]) is None}
    shown = []
    for item in errors:
        owner = other(item["loc"])
        known = owner is not None and any(loc[: len(owner) - 1] == owner[:-1] for loc in right)
        if owner is None or (not known and item in kinds):
            shown.append(item)
    return shown


def _neighbours(location: tuple[int | str, ...]) -> str:
    """Name the keys that are known where an unknown one stands."""
    if len(location) > 2 and location[-3] == "geometry" and location[-2] in KINDS:
        known = ["kind", *(field.name for field in fields(KINDS[str(location[-2])]))]
        return f"; known here: {', '.join(sorted(known))}"
    data: Any = Scene(name="defaults").model_dump()
    for part in [*_place(location)][:-1]:
        data = data.get(part) if isinstance(data, dict) else None
    return f"; known here: {', '.join(sorted(data))}" if isinstance(data, dict) else ""
