"""Effects of the film of journal bearings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypedDict

import numpy as np
from pydantic import ValidationError

from loadflow.data import gains
from loadflow.errors import InputError
from loadflow.journal import FilmHeat, Growth, Heat, RingGrowth, Turbulence
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.shaft.beam import ShaftSection
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film_costs import cost_of
from loadflow.stages.effects.situation import HOLLOW, Film, Floats, Situation
from loadflow.stages.stage import with_settings
from loadflow.tribology import lubricant
from loadflow.wind.cases import load_case

THREE_P = 0.2
"""Share of the largest deviation of a load that the blades make as they pass; NREL 5 MW, 12 m/s."""

STEEL = 2.1e11  # Pa
HEAT_CAPACITY = 2000.0  # J/(kg K), mineral oil
WALL = 0.1
"""Wall of the housing over the diameter of the bearing, where none is stated."""

ROUGHNESS = 1.1e-6
"""Of both surfaces of a journal bearing together, m: ground shaft, machined bearing."""

SHELL_SHARE = 0.9
"""Rise of a shell above its surroundings over that of its film, where none is stated."""

MODEL_OIL = "mineral-vg-320"
"""Oil by whose law a lubricant thins of which only the viscosity is stated."""


def _worst(film: Film, eccentricity: Floats, pressure: Floats, power: float = 0.0) -> Sizes:
    """Largest relative changes that follow from one of the eccentricity ratio."""
    ratio = np.minimum(film.eccentricity_ratio, 0.95)
    gap = np.minimum(eccentricity * ratio / (1 - ratio), 1.0)
    return {
        "eccentricity ratio": float(np.nanmax(eccentricity)),
        "minimum film": float(np.nanmax(gap)),
        "maximum pressure": float(np.nanmax(pressure)),
        "friction power": power,
    }


def _largest(found: Sequence[Sizes]) -> Sizes:
    """Of all bearings, by quantity."""
    return {name: max(sizes[name] for sizes in found) for name in found[0]}


class _Keys(TypedDict):
    """What an effect has from the table of a scene that turns it on."""

    keys: tuple[str, ...]
    is_on: Callable[[Scene], bool]
    switched: Callable[[Scene, bool], Scene | None]


def _of_table(name: str) -> _Keys:
    """Of an effect that a table of the journal turns on: it may be left out, but not made up."""

    def is_on(scene: Scene) -> bool:
        return getattr(scene.journal, name) is not None

    def switched(scene: Scene, on: bool) -> Scene | None:
        if not on:
            return with_settings(scene, "journal", {name: None})
        return scene if is_on(scene) else None

    return {"keys": (f"journal.{name}",), "is_on": is_on, "switched": switched}


# --- motion ----------------------------------------------------------------------------------


def _motion(at: Situation) -> Sizes:
    """What squeeze takes out of the swing of a load.

    A short cylindrical film answers a load that turns at Ω with 1/|1 − 2Ω/ω| of its displacement
    at rest, one that swings with the mean of both senses. `THREE_P` of the swing comes as blades
    pass; the rest is slow.
    """
    ratio = at.turbine.rotor.blades
    left = 0.5 * (1 / abs(1 - 2 * ratio) + 1 / (1 + 2 * ratio))
    found = []
    for name, film in at.films.items():
        load = at.bearings[name]
        change = THREE_P * (1 - left) * load.swing / np.maximum(load.radial + load.swing, 1.0)
        gain = gains()["journal"]
        found.append(
            _worst(film, gain["eccentricity ratio"] * change, gain["maximum pressure"] * change)
        )
    return _largest(found)


def _always_turns(scene: Scene) -> bool:
    """Whether the rotor turns through all load cases; of given series that is not known."""
    if scene.loads.source == "files":
        return True
    rows = [load_case(dlc) for dlc in scene.loads.dlcs]
    return all(row.operating and row.events == ("none",) for row in rows)


def _may_move(scene: Scene) -> bool:
    """Whether a film may follow the shaft through all load cases: asperities carry it at rest."""
    parts = map(scene.journal.at, scene.journal.bearings)
    return _always_turns(scene) or all(part.contact is not None for part in parts)


MOTION = Effect(
    "motion of the film",
    model="journal",
    keys=("journal.motion",),
    is_on=lambda scene: scene.journal.in_motion,
    switched=lambda scene, on: (
        with_settings(scene, "journal", {"motion": "transient" if on else "quasi-static"})
        if _may_move(scene) or not on
        else None
    ),
    indicator=_motion,
    out='journal.motion = "quasi-static"; the run warns where the orbit differs',
    needs='journal.motion = "transient", of a shaft that never stands or has journal.contact',
)


# --- heat ------------------------------------------------------------------------------------


def _heat(at: Situation) -> Sizes:
    """What the warming of the oil takes off its viscosity: T − T_in = P/(2 ρ c_p Q).

    Adiabatic, at the mean load. The film feels load over viscosity, and its friction is nearly
    proportional to viscosity.
    """
    journal, found = at.scene.journal, []
    for name in journal.bearings:
        film = at.film(name, share=0.0)
        carried = 2.0 * journal.lubricant.density * HEAT_CAPACITY * film.side_flow
        oil = lubricant(MODEL_OIL)
        thinner = np.exp(-oil.steepness(_inlet(at.scene)) * film.friction_power / carried)
        gain = gains()["journal"]
        eccentricity = thinner ** -gain["eccentricity ratio"] - 1.0
        power = float(np.nanmax(1.0 - thinner))
        found.append(_worst(film, eccentricity, 0.3 * eccentricity, power))
    return _largest(found)


def _inlet(scene: Scene) -> float:
    return (scene.journal.heat or Heat()).inlet_temperature


def _warmed(scene: Scene, on: bool) -> Scene | None:
    """The scene with a heat balance of each bearing, or without any."""
    if on == (scene.journal.heat is not None):
        return scene
    journal = _with_heat(scene.journal, on)
    own = {place: _with_heat(part, on) for place, part in scene.journal.own.items()}
    if journal is None or None in own.values():
        return None
    return scene.model_copy(update={"journal": journal.model_copy(update={"own": own})})


def _with_heat(journal: Journal, on: bool) -> Journal | None:
    """A bearing with a heat balance; a stated viscosity is then that of the oil that enters."""
    if on == (journal.heat is not None):
        return journal
    stated = journal.model_dump(exclude_unset=True, exclude={"own"})
    if not on:
        return type(journal).model_validate(stated | {"heat": None})
    stated.pop("lubricant", None)
    oil, cool = lubricant(MODEL_OIL), journal.lubricant
    inlet = Heat().inlet_temperature
    share = cool.viscosity / float(oil.viscosity(inlet))
    thick, thin = (nu * share for nu in oil.viscosities)
    try:
        entering = replace(
            oil,
            viscosities=(thick, thin),
            density_15=cool.density * oil.density_15 / float(oil.density(inlet)),
            name=f"{cool.viscosity:g} Pa s at {inlet:g} K",
            source=f"thins as {MODEL_OIL}",
        )
        # Walther's law does not scale: meet the stated viscosity at the inlet
        exact = cool.viscosity / float(entering.viscosity(inlet))
        entering = replace(entering, viscosities=(thick * exact, thin * exact))
        return type(journal).model_validate(stated | {"heat": Heat(oil=entering)})
    except (InputError, ValidationError):
        return None


HEAT = Effect(
    "heat of the film",
    model="journal",
    keys=("journal.heat",),
    is_on=lambda scene: scene.journal.heat is not None,
    switched=_warmed,
    indicator=_heat,
    out="no journal.heat; the run warns where it would matter",
    needs="a table journal.heat with the oil and the temperature at which it enters",
)


# --- growth of the clearance -----------------------------------------------------------------


def _growth(at: Situation) -> Sizes:
    """Growth of the clearance by shaft and shell as warm as their film: R α ΔT of each, over it.

    The film of the heat balance, adiabatic, at the mean load. Without a growth that is stated,
    shaft and shell are of steel, and the rise of the shell is `SHELL_SHARE` of that of the film.
    """
    found = []
    for name in at.scene.journal.bearings:
        own, film = at.scene.journal.at(name), at.film(name, share=0.0)
        heat = own.heat or Heat()
        carried = 2.0 * heat.lubricant(heat.inlet_temperature).density * HEAT_CAPACITY
        warm = heat.inlet_temperature + film.friction_power / (carried * film.side_flow)
        radius, ambient = own.geometry.radius, _surroundings(heat)
        growth = heat.growth
        if isinstance(growth, RingGrowth):
            shell = np.full_like(warm, ambient) if growth.held else 0.5 * (warm + ambient)
            cold = growth.reference_temperature
            wider = growth.shell_expansion * (shell - cold) - growth.shaft_expansion * (warm - cold)
            wider = radius * wider
        else:
            wider = (growth or Growth(shell_share=SHELL_SHARE)).radial(warm, ambient, radius)
        share = np.minimum(np.abs(wider) / own.geometry.clearance, 1.0)
        narrower = 1.0 - 0.5 * share  # So falls with the square of the clearance
        eccentricity = narrower ** (-2.0 * gains()["journal"]["eccentricity ratio"]) - 1.0
        sizes = _worst(film, eccentricity, 0.3 * eccentricity, float(np.nanmax(share)))
        found.append({**sizes, "minimum film": float(np.nanmax(share))})
    return _largest(found)


def _surroundings(heat: Heat | FilmHeat) -> float:
    """Temperature outside of shaft and shell, K."""
    return heat.shell_temperature if isinstance(heat, FilmHeat) else heat.ambient_temperature


def _grown(scene: Scene, on: bool) -> Scene | None:
    """The scene with a clearance that stays; growth is there where it is stated."""
    heat = scene.journal.heat
    if heat is None or heat.growth is None:
        return None if on else scene
    return scene if on else with_settings(scene, "journal", {"heat": replace(heat, growth=None)})


GROWTH = Effect(
    "growth of the clearance",
    model="journal",
    keys=("journal.heat",),
    is_on=lambda scene: scene.journal.heat is not None and scene.journal.heat.growth is not None,
    switched=_grown,
    indicator=_growth,
    out="no journal.heat.growth: the clearance is the same at all temperatures",
    needs="a table journal.heat.growth with the expansion of shaft and shell",
    concerns=lambda scene: scene.journal.heat is not None,
)


# --- tilt, shell, contact, turbulence, supply ------------------------------------------------


def _tilt(at: Situation) -> Sizes:
    """Slope of the shaft in its bore × width / (2 film): what tilt takes from the film at one end.

    A cantilever of the span between the bearings under the moment at the hub, as wide as the beam
    of the suspension, or as the bearing with a bore of `HOLLOW` where there is none. The shares in
    the answers are those of a width of 3/4 of the diameter, tilted in the plane of the load.
    """
    scene, found = at.scene, []
    geometry = scene.journal.geometry
    for name, film in at.films.items():
        concept = next(c for c in scene.shaft.concepts if name in c.bearings)
        span = max(np.ptp(concept.positions), concept.positions[0])
        beam = concept.beam
        section = (
            beam.sections[0]
            if beam
            else ShaftSection(geometry.diameter, HOLLOW * geometry.diameter)
        )
        load = at.bearings[name]
        moment = load.radial * concept.positions[0] + load.turn
        bent = moment * span / (3.0 * STEEL * section.inertia)
        slope = bent + np.hypot(*scene.journal.at(name).alignment)
        share = np.minimum(0.5 * slope * geometry.width / film.minimum_film, 1.0)
        worst = float(np.nanmax(share))
        found.append(
            {
                "eccentricity ratio": 0.05 * worst,
                "minimum film": worst,
                "maximum pressure": 0.15 * worst,
                "friction power": 0.04 * worst,
            }
        )
    return _largest(found)


TILT = Effect(
    "tilt of the shaft",
    model="journal",
    keys=("journal.tilt",),
    is_on=lambda scene: scene.journal.tilt,
    switched=lambda scene, on: (
        with_settings(scene, "journal", {"tilt": on})
        if not on or any(map(scene.shaft.bends_at, scene.journal.bearings))
        else None
    ),
    indicator=_tilt,
    out="no journal.tilt: half the width of the film is solved",
    needs="journal.tilt = true, with a beam as the shaft",
    cost=cost_of("tilt"),
    rungs=("grid", "reduced"),
    own_kernels=True,
)


def _shell(at: Situation) -> Sizes:
    """Pressure × compliance / film: growth of the gap by a wall that is held outside.

    Without a shell, by a wall of steel of `WALL`.

    The shares of it in each answer are those of docs/journal.md, "Elastic shell".
    """
    shell = at.scene.journal.shell
    modulus = getattr(shell, "modulus", STEEL)
    thickness = getattr(shell, "thickness", WALL * at.scene.journal.geometry.diameter)
    compliance = getattr(shell, "compliance", 0.2 * thickness / modulus)
    found = []
    for film in at.films.values():
        above = film.maximum_pressure - at.scene.journal.edge_pressure
        share = float(np.nanmax(above * compliance / film.minimum_film))
        names = ("eccentricity ratio", "minimum film", "maximum pressure", "friction power")
        found.append({name: min(0.25 * share, 1.0) for name in names})
    return _largest(found)


SHELL = Effect(
    "elastic shell",
    model="journal",
    **_of_table("shell"),
    indicator=_shell,
    out="no journal.shell",
    needs="a table journal.shell",
    cost=cost_of("shell"),
    rungs=("grid", "reduced"),
    partly=(("reduced", "a local shell"),),
    own_kernels=True,
)


def _contact(at: Situation) -> Sizes:
    """Share of the load that asperities take, by film / roughness: none above Λ = 4.

    [Greenwood and Tripp 1970], in the fit (4 − Λ)^6.804 of the pressure, against all of it at 0.
    """
    found = []
    for film in at.films.values():
        parameter = np.nan_to_num(film.minimum_film / ROUGHNESS, nan=0.0)
        share = float(np.max((np.clip(4.0 - parameter, 0.0, 4.0) / 4.0) ** 6.804))
        names = ("eccentricity ratio", "minimum film", "maximum pressure", "friction power")
        found.append(dict.fromkeys(names, share))
    return _largest(found)


CONTACT = Effect(
    "contact of asperities",
    model="journal",
    **_of_table("contact"),
    indicator=_contact,
    out="the film alone carries; asperities would take load below a film parameter of 4",
    needs="a table journal.contact with the asperities of both surfaces",
    cost=cost_of("contact"),
    rungs=("grid", "reduced"),
    own_kernels=True,
)


def _turbulence(at: Situation) -> Sizes:
    """What turbulent flow adds at the largest speed: k_x/12 and C_f of [Ng and Pan 1965].

    Nothing up to Re_cr. In gaps of the clearance; the film feels load over k_x, and its friction
    grows with C_f.
    """
    fastest, found = float(np.abs(at.speed).max()), []
    for name, film in at.films.items():
        journal = at.scene.journal.at(name)
        held = journal.at_temperature(journal.heat.inlet_temperature) if journal.heat else journal
        factors = Turbulence().factors(held.geometry, fastest, held.lubricant, 1.0)
        thicker, _, shear = (float(factor) for factor in factors)
        eccentricity = thicker ** gains()["journal"]["eccentricity ratio"] - 1.0
        changes = np.full_like(film.eccentricity_ratio, eccentricity)
        found.append(_worst(film, changes, 0.3 * changes, 1.0 - 1.0 / shear))
    return _largest(found)


TURBULENCE = Effect(
    "turbulent flow",
    model="journal",
    keys=("journal.turbulence",),
    is_on=lambda scene: scene.journal.turbulence is not None,
    switched=lambda scene, on: with_settings(
        scene,
        "journal",
        {"turbulence": (scene.journal.turbulence or Turbulence()) if on else None},
    ),
    indicator=_turbulence,
    out="no journal.turbulence: the flow is laminar; the run warns where Re reaches Re_cr",
    needs="a table journal.turbulence, which may be empty",
    cost=cost_of("turbulence"),
    rungs=("grid", "reduced"),
    own_kernels=True,
)


def _supply(at: Situation) -> Sizes:
    """Flow that grooves must bring over that which the bearing ends take in: nothing is known.

    What grooves change is found by the pilot. Without any, the bearing ends stand in oil, and
    nothing is left out.
    """
    names = ("eccentricity ratio", "minimum film", "maximum pressure", "friction power")
    return dict.fromkeys(names, 0.0)


SUPPLY = Effect(
    "supply of the film",
    model="journal",
    **_of_table("supply"),
    indicator=_supply,
    out="no journal.supply: the bearing ends stand in oil",
    needs="a table journal.supply",
    concerns=lambda scene: scene.journal.supply is not None,
    rungs=("grid", "reduced"),
    partly=(("reduced", "rectangular grooves and pockets of given pressure, in a whole bore"),),
)
