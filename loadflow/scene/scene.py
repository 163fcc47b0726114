"""A scene: one TOML file that says what is wanted, from which loads, for which bearings.

`read_scene` is the only gate: what comes out is frozen and valid. The scene composes the options
that each room owns; it knows no physics.
"""

from __future__ import annotations

import hashlib
import tomllib
from math import inf
from pathlib import Path
from typing import Annotated, Any, BinaryIO, Literal, Self

import numpy as np
from pydantic import BaseModel, Field, ValidationError, field_validator, model_validator

from loadflow.errors import InputError
from loadflow.journal.line import Line
from loadflow.journal.models.model import why_not
from loadflow.journal.questions import Steps
from loadflow.numerics.fields import LARGEST, LARGEST_INTEGER
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.bearings import Rolling
from loadflow.scene.candidate import Candidate as Candidate
from loadflow.scene.candidates import ABOUT, TOLERANCES, machine
from loadflow.scene.design import Design
from loadflow.scene.dynamics import Dynamics, check_dynamics
from loadflow.scene.environment import Environment, surrounded
from loadflow.scene.fitting_shaft import WithFittingBeams, fitted, with_fitting_beams
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.lifetime import Lifetime, check_counts
from loadflow.scene.loads import Loads, check_simulation
from loadflow.scene.messages import NAME, beside_bearings, message
from loadflow.scene.own_shaft import taken
from loadflow.scene.places import places_of
from loadflow.scene.results import BY_NAME as BY_NAME
from loadflow.scene.results import OF_PLACES, USUAL, Result, has_films, that_the_shaft_can_give
from loadflow.scene.rolling_checks import (
    check_baths,
    check_capacities,
    check_cooling,
    check_swinging,
)
from loadflow.scene.section import Section, check_sizes
from loadflow.scene.series import Reduction, Seeds
from loadflow.scene.shaft import Shaft
from loadflow.scene.shaft_place import check_seats, overlapping
from loadflow.scene.thrust import Thrust, check_thrust
from loadflow.scene.tolerances import Toleranced, Tolerances
from loadflow.scene.turbine import Turbine
from loadflow.scene.turbine_alone import WINDIO, scene_of
from loadflow.scene.usual_bearings import usual_bearings
from loadflow.scene.wear import Wear, check_wear
from loadflow.scene.written import SCENE, anchored, in_sections, origins
from loadflow.shaft.options import MomentBearing, TwoPoint
from loadflow.storage import check_name
from loadflow.turbines import load_turbine, turbine_digest
from loadflow.turbines.files import scaled_name
from loadflow.turbines.similarity import factor_of_power

Share = Annotated[float, Field(gt=0)]

_ROW = np.zeros((1, 2))


class Scene(Section, WithFittingBeams, BaseModel):
    """What is wanted, and from what; see the modules of the sections for units.

    Attributes
    ----------
    name : str
        Name of the run and of its folder.
    results : list of str
        What is wanted; the plan runs only the stages that these need. Left out: all but
        `BY_NAME`, and but those of journal or rolling bearings of which the scene says nothing and
        the shaft has none.
    accuracy : float, dict or "given"
        Largest relative error allowed, of every result or by result, as a share above 0 and below
        1; 0.05 if nothing is said. The
        plan takes the cheapest models and effects that hold it, wherever the scene names none.
        ``"given"`` leaves all models as the scene has them, the defaults where it names none.
    tolerances : dict
        By place and key of the bearing there, half of the band around a value, in its unit; of
        ``heat.oil`` a share of its viscosity. ``{ value = …, tolerance = … }`` in place of the
        value says the same.
    as_built : AsBuilt
        Tolerances of what `tolerances` leaves open, as `loadflow compare` takes them.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"name": "look", "accuracy": 0.02, "loads": {"seeds": 2}})
    >>> scene.loads.seeds, scene.allowed("journal.film"), scene.wants("rolling")
    (2, 0.02, True)
    """

    name: Annotated[str, Field(pattern=NAME)]
    results: Annotated[list[Result], Field(min_length=1)] = list(USUAL)
    accuracy: Share | dict[Result, Share] | Literal["given"] = 0.05
    turbine: Turbine = Turbine()
    environment: Environment = Environment()
    loads: Loads = Loads()
    shaft: Shaft = Shaft(two_point=TwoPoint(), moment=MomentBearing())
    seeds: Seeds = Seeds()
    reduction: Reduction = Reduction()
    journal: Journal = Journal()
    dynamics: Dynamics = Dynamics()
    wear: Wear = Wear()
    lifetime: Lifetime = Lifetime()
    rolling: Rolling = Rolling()
    thrust: Thrust = Thrust()
    friction: Friction = Friction()
    tolerances: Tolerances = {}
    candidates: dict[str, Candidate] = {}
    design: Design = Design()
    as_built: AsBuilt = AsBuilt()

    @field_validator("name")
    @classmethod
    def _names_a_folder(cls, name: str) -> str:
        return check_name(name)

    @model_validator(mode="before")
    @classmethod
    def _in_sections(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        stated = {*data} & {"journal", "rolling", "thrust"}
        reduction = data.get("reduction")
        method = reduction.get("method") if isinstance(reduction, dict) else None
        if method in ("stationary", "periodic"):
            data = {"accuracy": "given"} | data
        own_shaft = "shaft" in data
        data = surrounded(in_sections(data, OF_PLACES))
        if "thrust" in stated and "results" not in data:
            data = data | {"results": list(OF_PLACES)}
        if not own_shaft:
            data = _with_scaled_shaft(data)
        if "shaft" in data and has_films(data):
            fitting = with_fitting_beams(data["shaft"], data.get("journal", {}))
            data = data | {"shaft": fitting}
        return that_the_shaft_can_give(data, stated)

    @model_validator(mode="after")
    def _simulates(self) -> Self:
        if self.loads.source == "simulate":
            check_simulation(self.loads, self.turbine.name)
        return self

    @model_validator(mode="after")
    def _bearings_exist(self) -> Self:
        wanted = {
            "journal.bearings": self.journal.bearings if self.wants("journal") else [],
            "rolling.bearing": [*self.rolling.geometries] if self.wants("rolling") else [],
            "thrust.bearings": [*self.thrust.bearings] if self.wants("thrust") else [],
        }
        for key, bearings in wanted.items():
            for bearing in bearings:
                if bearing not in self.shaft.bearings:
                    have = ", ".join(self.shaft.bearings) or "none"
                    room = key.split(".")[0]
                    raise ValueError(
                        f"{key} = {bearing!r} (bearings.{bearing}): the shaft has the bearings "
                        f"{have}; name one of these, or leave what begins with {room} out of "
                        "results"
                    )
        return self

    @model_validator(mode="after")
    def _design_loads_are_given(self) -> Self:
        method, journal = self.reduction.method, self.journal
        if method == "histogram":
            return self
        if self.asks:
            raise ValueError(
                f'reduction.method = "{method}": its loads are chosen by hand; set accuracy = '
                '"given", or leave accuracy out'
            )
        if method == "periodic" and not journal.in_motion and self.wants("journal"):
            for place in journal.bearings:
                one = journal.at(place)
                film = one.film_model.isothermal().closing()
                held, free = Line(tilt=_ROW, bend=_ROW), Line(moment=_ROW)
                lies = held if self.shaft.bends_at(place) else free
                line = lies if one.tilt else Line()
                steps = Steps(None, periodic=True)
                why = why_not("in_motion", film, one.geometry, line, steps)
                if why is not None:
                    raise ValueError(f'reduction.method = "periodic", journal: {why}')
        return self

    @model_validator(mode="after")
    def _series_to_reduce_are_there(self) -> Self:
        self.reduction.check(self.loads.source == "simulate", self.loads.duration)
        return self

    @model_validator(mode="after")
    def _events_are_there(self) -> Self:
        if self.loads.source == "simulate":
            check_counts(self.lifetime, self.wear.counts, self.loads.dlcs, "rayleigh")
        return self

    @model_validator(mode="after")
    def _can_wear(self) -> Self:
        if "journal.wear" in self.results:
            check_wear(self.wear, self.journal, self.shaft)
        return self

    @model_validator(mode="after")
    def _capacities_are_known(self) -> Self:
        if "rolling.life" in self.results:
            check_capacities(self.rolling)
        return self

    @model_validator(mode="after")
    def _beside_the_shaft_bearings_swing(self) -> Self:
        check_swinging(self.rolling, self.journal.bearings if self.wants("journal") else ())
        return self

    @model_validator(mode="after")
    def _rolling_bearings_suit_their_oil_and_cooling(self) -> Self:
        check_baths(self.rolling, self.friction.lubricant)
        check_cooling(self.rolling, self.friction)
        return self

    @model_validator(mode="after")
    def _can_vibrate(self) -> Self:
        check_dynamics(self.dynamics, self.results, self.journal, self.rolling, self.shaft)
        return self

    @model_validator(mode="after")
    def _films_take_the_thrust(self) -> Self:
        if self.wants("thrust"):
            check_thrust(self.thrust, self.reduction.method)
        return self

    @model_validator(mode="after")
    def _bands_are_allowed(self) -> Self:
        self.toleranced.check(self.shaft, self.reduction.method)
        return self

    @model_validator(mode="after")
    def _candidates_have_places(self) -> Self:
        have = ", ".join(self.shaft.bearings) or "none"
        wrong = [
            f"candidates.{name}.{place}: the shaft has only {have}"
            for name, candidate in self.candidates.items()
            for place in candidate.places
            if place not in self.shaft.bearings
        ]
        if wrong:
            raise ValueError("\n".join(wrong))
        return self

    @model_validator(mode="after")
    def _supports_have_bearings(self) -> Self:
        there = {"journal": self.journal.bearings, "rolling": [*self.rolling.geometries]}
        for name, support in self.shaft.coupled.items():
            what = f'shaft: support of bearing {name} with stiffness = "{support.stiffness}"'
            have = there[support.stiffness]
            if name not in have:
                raise ValueError(
                    f"{what}: the scene has {support.stiffness} bearings at {', '.join(have)} only"
                )
            aligning = name not in (*self.journal.tilting, *self.journal.on_seats)
            if support.stiffness == "rolling":
                aligning = not self.rolling.geometries[name].takes_moment
            if support.takes_moment and aligning:
                raise ValueError(f"{what}: it aligns itself; leave out takes_moment")
            if support.takes_moment and support.stiffness == "journal":
                self.journal.check_moment(name, f"{what} and takes_moment = true")
        check_seats(self.shaft, self.journal)
        return self

    @property
    def taken(self) -> list[str]:
        """What neither scene nor turbine state, what is taken instead; bearings that overlap."""
        shaft = self.shaft.model_dump(mode="json", exclude_none=True)
        films = self.journal if self.wants("journal") else None
        rolling = self.rolling if self.wants("rolling") else None
        lines, name = taken(self.turbine.name, shaft), self.turbine.name
        if films is not None:
            lines += fitted(shaft, films, self._open_beams)
            lines += overlapping(self.shaft, films)
        return [*lines, *usual_bearings(name, films, rolling)]

    def wants(self, room: str) -> bool:
        """Whether a result of `room` is wanted."""
        return any(result.split(".")[0] == room for result in self.results)

    @property
    def asks(self) -> bool:
        """Whether an accuracy is asked for, and models are chosen by it."""
        return self.accuracy != "given"

    @property
    def toleranced(self) -> Toleranced:
        """Its bearings with the tolerances of their values."""
        return Toleranced(self.tolerances, self.journal, self.rolling, self.thrust)

    def allowed(self, result: str) -> float:
        """Largest relative error allowed of a result; infinite where nothing is asked."""
        if isinstance(self.accuracy, dict):
            return {str(name): value for name, value in self.accuracy.items()}.get(result, inf)
        return inf if self.accuracy == "given" else self.accuracy

    def to_toml(self) -> str:
        """Return the scene with all defaults, as TOML, in the form of today."""
        import tomli_w

        data = self.model_dump(mode="json", exclude_none=True)
        data["bearings"] = places_of(*(data.pop(room) for room in ("journal", "rolling", "thrust")))
        data["candidates"] = {
            name: {key: candidate[key] for key in (*ABOUT, TOLERANCES) if candidate[key]}
            | places_of(*(candidate.get(room) for room in ("journal", "rolling", "thrust")))
            for name, candidate in data["candidates"].items()
        }
        return tomli_w.dumps({SCENE.key: SCENE.version} | data)

    def digest(self, *sections: str) -> str:
        """SHA-256 of the resolved scene, or of some of its sections, and the turbine's file."""
        include = set(sections) if sections else None
        told = self.model_dump_json(include=include)
        if include is None or "turbine" in include:
            told += turbine_digest(self.turbine.name)
        return hashlib.sha256(told.encode()).hexdigest()


def read_scene(path: str | Path) -> Scene:
    """Read and check a scene file.

    Parameters
    ----------
    path : str or Path
        TOML file. Paths in it are meant relative to the file. Or a windIO file (.yaml): the
        scene is that of its turbine alone.

    Returns
    -------
    Scene
        Frozen and valid.

    Raises
    ------
    InputError
        The file is missing, is not TOML, or holds a bad key or value; the message names file, key,
        value and what is allowed.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.scene import read_scene
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "look.toml"
    ...     _ = file.write_text("loads.seeds = 1")
    ...     scene = read_scene(file)
    >>> scene.name, scene.loads.seeds
    ('look', 1)
    """
    path = Path(path)
    if path.is_dir():
        ran = path / "scene.toml"
        more = f"; that of this run is {ran}" if ran.is_file() else ""
        raise InputError(f"{path}: a folder, not a scene{more}")
    try:
        with path.open("rb") as stream:
            data = _data(path, stream)
    except OSError as error:
        raise InputError(f"{path}: cannot read the scene: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file: {error}") from error
    return make_scene(anchored(data, path.parent.absolute()), str(path))


def make_scene(data: dict[str, Any], source: str = "scene") -> Scene:
    """Build a scene from a dictionary; `source` names it in messages.

    Parameters
    ----------
    data : dict
        What a scene file says, by section and key.
    source : str
        Name of it in messages.

    Returns
    -------
    Scene
        The scene, checked.

    Raises
    ------
    InputError
        As `read_scene`.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"name": "look", "loads": {"wind_speeds": [8.0, 12.0], "seeds": 1}})
    >>> scene.turbine.name
    'nrel-5mw'
    """
    data = {"name": Path(source).stem} | data
    check_sizes(data, int, LARGEST_INTEGER, source)
    try:
        scene = Scene.model_validate(data)
        check_sizes(data, float, LARGEST, source)  # keys with a range of their own have told it
        return scene
    except ValidationError as error:
        told = message(error, source, origins(data), Scene)
        raise InputError(told + beside_bearings(error, data, source, Scene)) from error


def former_sections(path: str | Path) -> list[str]:
    """Sections of a scene file that are written as ``[bearings.PLACE]`` today.

    Raises
    ------
    OSError
        It cannot be read.
    """
    with Path(path).open("rb") as stream:
        data = _data(Path(path), stream)
    return [name for name in ("journal", "rolling") if name in data]


def _data(path: Path, stream: BinaryIO) -> dict[str, Any]:
    """What a scene file says, or the scene of a turbine alone."""
    return scene_of(path) if path.suffix.lower() in WINDIO else tomllib.load(stream)


def _with_scaled_shaft(data: dict[str, Any]) -> dict[str, Any]:
    """Without a shaft of its own: that of the known turbine, as large as its scaled one."""
    turbine = data.get("turbine")
    name = turbine.get("name") if isinstance(turbine, dict) else getattr(turbine, "name", None)
    try:
        base, power = scaled_name(name) if isinstance(name, str) else ("", None)
        known = load_turbine(base) if power is not None else None
    except InputError:  # told by the turbine's own check, with its key
        return data
    if power is None or known is None:
        return data
    stated = machine(base).get("shaft")
    usual = Shaft.model_validate(stated) if stated else Scene.model_fields["shaft"].default
    return data | {"shaft": usual.scaled(factor_of_power(power, known.rated_power))}
