"""Effects of heat on the film of journal bearings: thinner oil, another clearance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from pydantic import ValidationError

from loadflow.data import gains
from loadflow.errors import InputError
from loadflow.journal import FilmHeat, Growth, Heat, Lubricant, RingGrowth
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film_costs import cost_of
from loadflow.stages.effects.film_sizes import largest, worst
from loadflow.stages.effects.situation import Situation
from loadflow.stages.stage import with_settings
from loadflow.tribology import Oil, lubricant

HEAT_CAPACITY = 2000.0  # J/(kg K), mineral oil

SHELL_SHARE = 0.9
"""Rise of a shell above its surroundings over that of its film, where none is stated."""

MODEL_OIL = "mineral-vg-320"
"""Oil by whose law a lubricant thins of which only the viscosity is stated."""


# --- heat ------------------------------------------------------------------------------------


def _heat(at: Situation) -> Sizes:
    """What the warming of the oil takes off its viscosity: T − T_in = P/(2 ρ c_p Q).

    Adiabatic, at the mean load. The film feels load over viscosity, and its friction is nearly
    proportional to viscosity. Nothing warms where the shaft stands.
    """
    journal, found = at.scene.journal, []
    for name in journal.bearings:
        film = at.film(name, share=0.0)
        warmer = film.warming(2.0 * journal.lubricant.density * HEAT_CAPACITY)
        thinner = np.exp(-lubricant(MODEL_OIL).steepness(_inlet(at.scene)) * warmer)
        gain = gains()["journal"]
        eccentricity = thinner ** -gain["eccentricity ratio"] - 1.0
        power = float(np.nanmax(1.0 - thinner))
        found.append(worst(film, eccentricity, 0.3 * eccentricity, power))
    return largest(found)


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
    try:
        heat = Heat(oil=oil_of(journal.lubricant))
        return type(journal).model_validate(stated | {"heat": heat})
    except (InputError, ValidationError):
        return None


def oil_of(cool: Lubricant) -> Oil:
    """An oil that has a stated viscosity as it usually enters, and thins as `MODEL_OIL`.

    Raises
    ------
    loadflow.errors.InputError
        A viscosity that no oil has.
    """
    oil, inlet = lubricant(MODEL_OIL), Heat().inlet_temperature
    entering = replace(
        oil.scaled(cool.viscosity / float(oil.viscosity(inlet))),
        density_15=cool.density * oil.density_15 / float(oil.density(inlet)),
        name=f"{cool.viscosity:g} Pa s at {inlet:g} K",
        source=f"thins as {MODEL_OIL}",
    )
    # Walther's law does not scale: meet the stated viscosity at the inlet
    return entering.scaled(cool.viscosity / float(entering.viscosity(inlet)))


HEAT = Effect(
    "heat of the film",
    model="journal",
    keys=("journal.heat",),
    is_on=lambda scene: scene.journal.heat is not None,
    switched=_warmed,
    indicator=_heat,
    larger=lambda scene: 25.0,  # quick look: 2 % indicated of p_max, 38 % measured
    cost=None,  # four times at rest, next to nothing on a long path
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
        warm = heat.inlet_temperature + film.warming(carried)
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
        sizes = worst(film, eccentricity, 0.3 * eccentricity, float(np.nanmax(share)))
        found.append({**sizes, "minimum film": float(np.nanmax(share))})
    return largest(found)


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
    cost=cost_of("growth"),
)
