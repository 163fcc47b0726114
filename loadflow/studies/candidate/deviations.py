"""What a comparison's bearings become at the ends of their tolerances, one at a time."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import xarray as xr
from scipy.optimize import brentq

from loadflow.errors import InputError
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.bearings import FurtherBearing, Rolling
from loadflow.scene.candidate import Candidate
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.thrust import Thrust
from loadflow.scene.tolerances import ALIGNMENT, Toleranced
from loadflow.stages.comparisons import THINNING
from loadflow.stages.rolling_at_work import as_stated, rest
from loadflow.studies.candidate.pad_films import span_of
from loadflow.studies.candidate.wear_bands import Rubbing
from loadflow.tribology import lubricant

_ABOUT = {
    "clearance": {"clearance"},
    "oil grade": {"oil", "viscosity"},
    "oil temperature": {"temperature"},
    "roughness": {"roughness"},
}
"""Words in the keys of values that a tolerance of a scene is about."""

_WIDE = 60.0  # K: within which the temperature is sought at which an oil is as thin


@dataclass(frozen=True)
class Built:
    """Bearings as built, with their oil, under the loads that they are judged by.

    Attributes
    ----------
    candidate : Candidate
        The bearings.
    friction : Friction
        Oil and surfaces of rolling bearings.
    spectrum : xarray.DataTree
        Of `loadflow.studies.lifetime.load_spectrum.load_spectrum`.
    rubbing : Rubbing, optional
        What wears the bores most, where they wear.
    spans : mapping
        Gaps of the tables of thrust collars, m, by place: those of the bearings as stated, which
        they share with all their ends. Left out, those of the collars of the candidate.
    rises : mapping
        Power of the load that the rise of a rolling bearing over the air follows, by place, where
        `friction` states the temperature that its heat balance has.
    """

    candidate: Candidate
    friction: Friction
    spectrum: xr.DataTree
    rubbing: Rubbing | None = None
    spans: Mapping[str, tuple[float, float] | None] | None = None
    rises: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.spans is None:
            pads = self.candidate.thrust.bearings if self.candidate.thrust else {}
            object.__setattr__(self, "spans", {name: span_of(one) for name, one in pads.items()})


@dataclass(frozen=True)
class Tolerance:
    """One tolerance: what it is called, and the bearings at its ends.

    Attributes
    ----------
    name : str
        In words.
    stated : Built
        What its ends are compared with.
    ends : tuple of Built
        The bearings at its ends, some of which cannot be built.
    missing : bool
        Whether an end cannot be built, such as a clearance that is used up.
    """

    name: str
    stated: Built
    ends: tuple[Built, ...]
    missing: bool = False


def tolerances_of(built: Built, given: AsBuilt) -> Iterator[Tolerance]:
    """Yield the tolerances of a scene that its bearings feel.

    Those that its values have come first; of what they say nothing, `given` does.

    Parameters
    ----------
    built : Built
        The bearings as stated.
    given : AsBuilt
        Of the scene.
    """
    own = _stated(built.candidate)
    told = {name for key in own.keys for name, words in _ABOUT.items() if words & _words(key)}
    for key in own.keys:
        if not key.startswith(ALIGNMENT):
            moved = tuple(_at_end(built, own, key, end) for end in (-1, 1))
            yield Tolerance(key, built, moved)
    changes: dict[str, tuple[Callable[[Built, float], Built], float]] = {
        "clearance": (lambda b, sign: _with_clearance(b, given, sign), 1.0),
        "oil grade": (_with_viscosity, given.viscosity),
        "oil temperature": (_with_temperature, given.temperature),
        "roughness": (_with_roughness, given.roughness),
    }
    for name, (change, size) in changes.items():
        if name in told or size == 0 or (name == "clearance" and given.clearance == 0):
            continue
        ends = []
        for sign in (-1.0, 1.0):
            try:
                ends.append(change(built, sign * size))
            except InputError:
                continue
        yield Tolerance(name, built, tuple(ends), missing=len(ends) < 2)
    turned = [size for keys in own.tolerances.values() for key, size in keys.items()
              if key.startswith(ALIGNMENT)]  # fmt: skip
    if (angle := max(turned, default=given.alignment)) > 0:
        yield from _misaligned(built, angle)


def _words(key: str) -> set[str]:
    return {word for part in key.split(".") for word in part.split("_")}


def _stated(candidate: Candidate) -> Toleranced:
    """The bearings with the tolerances that their values have."""
    rooms = candidate.journal or Journal(), candidate.rolling or Rolling()
    return Toleranced(candidate.tolerances, *rooms, candidate.thrust or Thrust())


def _at_end(built: Built, own: Toleranced, key: str, end: int) -> Built:
    """The bearings with a value at an end of its own band."""
    moved = own.at_end(key, end)
    rooms = {room: getattr(moved, room) for room in ("journal", "rolling", "thrust")}
    update = {room: new for room, new in rooms.items() if getattr(built.candidate, room)}
    return replace(built, candidate=built.candidate.model_copy(update=update))


# --- journal bearings, pads and rolling bearings with other data ----------------------------------


def _changed(
    built: Built,
    *,
    journal: Callable[[Journal], dict[str, Any]] | None = None,
    pads: Callable[[Any], Any] | None = None,
    rolling: Callable[[FurtherBearing], dict[str, Any]] | None = None,
    friction: Friction | None = None,
) -> Built:
    """Bearings with what the functions say for each of them."""
    update: dict[str, Any] = {}
    one = built.candidate
    if one.journal is not None and journal is not None:
        own = {place: j.model_copy(update=journal(j)) for place, j in one.journal.own.items()}
        update["journal"] = one.journal.model_copy(update=journal(one.journal) | {"own": own})
    if one.thrust is not None and pads is not None:
        bearings = {place: pads(bearing) for place, bearing in one.thrust.bearings.items()}
        update["thrust"] = one.thrust.model_copy(update={"bearings": bearings})
    if one.rolling is not None and rolling is not None:
        further = [part.model_copy(update=rolling(part)) for part in one.rolling.further]
        first: Rolling = one.rolling
        update["rolling"] = first.model_copy(update=rolling(first) | {"further": further})
    oil = built.friction if friction is None else friction
    return replace(built, candidate=one.model_copy(update=update), friction=oil)


def _with_clearance(built: Built, given: AsBuilt, sign: float) -> Built:
    def journal(one: Journal) -> dict[str, Any]:
        geometry = one.geometry
        change = sign * given.of_journal(geometry.diameter) / geometry.diameter
        other = replace(geometry, relative_clearance=geometry.relative_clearance + change)
        return {"geometry": other}

    def rolling(part: FurtherBearing) -> dict[str, Any]:
        bearing: Any = part.geometry
        change = sign * given.of_rolling(bearing.pitch_diameter)
        names = [name for name in ("clearance", "axial_clearance") if name in vars(bearing)]
        return {"geometry": replace(bearing, **{n: getattr(bearing, n) + change for n in names})}

    def pads(bearing: Any) -> Any:
        return bearing.with_clearance(0.5 * sign * given.of_journal(2.0 * bearing.radius))

    return _changed(built, journal=journal, rolling=rolling, pads=pads)


def _with_viscosity(built: Built, share: float) -> Built:
    """Oil of another viscosity at one temperature, as grades of ISO 3448 allow."""
    factor = 1.0 + share

    def journal(one: Journal) -> dict[str, Any]:
        return oil_of(one, factor)

    def pads(bearing: Any) -> Any:
        return bearing.with_viscosity(factor)

    alike = built.friction.warmed(lambda kelvin: _as_viscous(built.friction, kelvin, factor))
    return _changed(built, journal=journal, pads=pads, friction=alike)


def _with_temperature(built: Built, kelvin: float) -> Built:
    """Oil warmer by some kelvin: where it enters, or where its temperature is stated."""
    factor = math.exp(-THINNING * kelvin)

    def journal(one: Journal) -> dict[str, Any]:
        if one.heat is not None:
            warm = one.heat.inlet_temperature + kelvin
            return {"heat": replace(one.heat, inlet_temperature=warm)}
        return {"lubricant": _thicker(one.lubricant, factor)}

    def pads(bearing: Any) -> Any:
        heat = getattr(bearing, "heat", None)  # pairs of cones know none
        if heat is None:
            return bearing.with_viscosity(factor)
        warm = heat.inlet_temperature + kelvin
        return bearing.model_copy(update={"heat": replace(heat, inlet_temperature=warm)})

    warmer = built.friction.warmed(lambda stated: stated + kelvin)
    return _changed(built, journal=journal, pads=pads, friction=warmer)


def _with_roughness(built: Built, share: float) -> Built:
    def surfaces(one: Any) -> dict[str, Any]:
        names = ("shaft_roughness", "shell_roughness")
        return {name: (1.0 + share) * getattr(one, name) for name in names}

    def rubbing(one: Journal) -> dict[str, Any]:
        contact = one.contact and one.contact.as_rough(1.0 + share)
        return surfaces(one) | {"contact": contact}

    def pads(bearing: Any) -> Any:
        return bearing.model_copy(update=surfaces(bearing))

    rough = (1.0 + share) * built.friction.roughness
    rougher = built.friction.model_copy(update={"roughness": rough})
    return _changed(built, journal=rubbing, pads=pads, friction=rougher)


def oil_of(one: Journal, factor: float) -> dict[str, Any]:
    """Keys of a journal bearing whose oil is so many times as thick, at all temperatures."""
    if one.heat is not None:
        return {"heat": replace(one.heat, oil=one.heat.liquid.scaled(factor))}
    return {"lubricant": _thicker(one.lubricant, factor)}


def _thicker(oil: Any, factor: float) -> Any:
    return replace(oil, viscosity=factor * oil.viscosity)


def _as_viscous(friction: Friction, stated: float, factor: float) -> float:
    """Temperature, K, at which the oil of rolling bearings has `factor` times its viscosity."""
    oil = lubricant(friction.lubricant)
    wanted = factor * float(oil.kinematic_viscosity(stated))

    def missing(kelvin: float) -> float:
        return float(oil.kinematic_viscosity(kelvin)) - wanted

    return float(brentq(missing, stated - _WIDE, stated + _WIDE, xtol=1e-6))


# --- alignment ------------------------------------------------------------------------------------


def _misaligned(built: Built, angle: float) -> Iterator[Tolerance]:
    """A shaft that lies askew by `angle`, rad, up, down and to both sides.

    Journal bearings, and thrust collars beside them, take the angle beside that of the bent shaft;
    those in which the shaft tilts freely, and cones, take none. Rolling bearings between which the
    shaft is held take the moment that would turn them so far; one that takes the tilting moment has
    all of it from the loads.
    """
    one = built.candidate
    if one.journal is not None:
        collars = one.thrust.collars.values() if one.thrust is not None else ()
        if not one.journal.tilting and all(collar.self_aligning for collar in collars):
            return
        bent = all("tilt" in built.spectrum[place] for place in one.journal.bearings)
        if one.journal.tilt and not bent:
            return
        straight = _changed(built, journal=lambda journal: {"tilt": True})
        lying = one.journal.tilt
        same = lying and all(one.journal.at(place).tilt for place in one.journal.bearings)
        stated = built
        if not same:
            stated = replace(straight, spectrum=_tilted(straight, (0.0, 0.0), lying))
        ways = [(0.0, angle), (0.0, -angle), (angle, 0.0), (-angle, 0.0)]
        ends = tuple(_askew(straight, way, lying) for way in ways)
        yield Tolerance("alignment", stated, ends)
    elif one.rolling is not None and len(one.rolling.geometries) > 1:
        if not any(bearing.takes_moment for bearing in one.rolling.geometries.values()):
            return
        ways = [(0.0, angle), (0.0, -angle), (angle, 0.0), (-angle, 0.0)]
        pushed = tuple(replace(built, spectrum=_pushed(built, one.rolling, way)) for way in ways)
        yield Tolerance("alignment", built, pushed)


def _askew(built: Built, way: tuple[float, float], lying: bool) -> Built:
    """Films under a shaft that is turned by an angle (y, z), and what rubs then."""
    rubs = None if built.rubbing is None else built.rubbing.askew(way)
    return replace(built, spectrum=_tilted(built, way, lying), rubbing=rubs)


def _tilted(built: Built, way: tuple[float, float], lying: bool) -> xr.DataTree:
    """The spectrum with a tilt (y, z) added to that of the shaft, or alone.

    `pad_tilt` and `pad_alignment` are those of collars, which may follow the shaft where the bores
    do not. The angle is one of their bore, as it does not grow with the loads.
    """
    assert built.candidate.journal is not None
    groups = {}
    for place in built.candidate.journal.bearings:
        samples = built.spectrum[place].to_dataset()
        none = xr.zeros_like(samples["force"])
        tilt, bend = (samples[name] if lying else none for name in ("tilt", "curvature"))
        extra = xr.DataArray([0.0, *way], dims="axis")
        thrust = built.candidate.thrust
        follows = bool(thrust and thrust.tilt and "tilt" in samples)
        # of a bore that follows the shaft as it lies without the angle
        bore = samples.get("alignment", xr.zeros_like(extra))
        groups[place] = samples.assign(
            tilt=tilt + extra,
            curvature=bend,
            alignment=bore if lying else xr.zeros_like(extra),
            pad_tilt=samples["tilt"] if follows else none,
            pad_alignment=(bore if follows else 0.0) - extra,
        )
    return with_places(built.spectrum, groups)


def _pushed(built: Built, rolling: Rolling, way: tuple[float, float]) -> xr.DataTree:
    """The spectrum with the moments that turn the rolling bearings by an angle (y, z)."""
    groups = {}
    for place, part in rolling.bearings.items():
        if not part.geometry.takes_moment:  # it aligns itself
            continue
        samples = built.spectrum[place].to_dataset()
        force, moment = (
            samples[name].transpose("sample", "axis").values for name in ("force", "moment")
        )
        warm = as_stated(part, built.friction)
        stiffness = rest(warm, force, moment, strict=False).stiffness
        free = np.linalg.pinv(stiffness)[:, 3:, 3:]
        extra = np.zeros_like(moment)
        extra[:, 1:] = np.linalg.pinv(free) @ np.array(way)
        groups[place] = samples.assign(moment=(("sample", "axis"), moment + extra))
    return with_places(built.spectrum, groups)


def with_places(spectrum: xr.DataTree, groups: Mapping[str, xr.Dataset]) -> xr.DataTree:
    """A spectrum with other samples of some places."""
    rest_of = {name: node.to_dataset() for name, node in spectrum.children.items()}
    tree = xr.DataTree.from_dict(rest_of | dict(groups))
    tree.attrs.update(spectrum.attrs)
    return tree
