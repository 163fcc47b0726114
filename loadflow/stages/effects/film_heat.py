"""Effects of heat on the film of journal bearings: thinner oil, another clearance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from pydantic import ValidationError
from scipy.special import lambertw

from loadflow.data import gains
from loadflow.errors import InputError
from loadflow.journal import FilmHeat, Growth, Heat, Lubricant, RingGrowth
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film_costs import cost_of, cost_of_heat
from loadflow.stages.effects.film_sizes import largest, no_bound_at_standstill, worst
from loadflow.stages.effects.film_tilt import thinnest_by
from loadflow.stages.effects.situation import Floats, Situation
from loadflow.stages.stage import with_settings
from loadflow.tribology import Oil, lubricant

SHELL_SHARE = 0.9
"""Rise of a shell above its surroundings over that of its film, where none is stated."""

MODEL_OIL = "mineral-vg-320"
"""Oil by whose law a lubricant thins of which only the viscosity is stated."""


# --- heat ------------------------------------------------------------------------------------


def _heat(at: Situation) -> Sizes:
    """What the warming of the oil changes of the films of the charts, by its loss of viscosity.

    The temperature is that of the mean load; ε, h_min and p_max are those of the largest. Nothing
    warms where the shaft stands.
    """
    found = []
    for name in at.scene.journal.bearings:
        thinner = np.exp(-_steepness(at.scene.journal.at(name)) * _rise(at, name))
        cold, warm = (at.film(name, thinner=by) for by in (1.0, thinner))
        usual, thin = (at.film(name, share=0.0, thinner=by) for by in (1.0, thinner))
        thicker = thinnest_by(at, name, 1.0 + _off(cold.minimum_film, warm.minimum_film))
        found.append(
            {
                "eccentricity ratio": _off(cold.eccentricity_ratio, warm.eccentricity_ratio),
                "minimum film": thicker - 1.0,
                "maximum pressure": _off(cold.maximum_pressure, warm.maximum_pressure),
                "friction power": _off(usual.friction_power, thin.friction_power),
            }
        )
    return largest(found)


def _off(cold: Floats, warm: Floats) -> float:
    """Largest change against the warm film; 1 where that alone is beyond the charts."""
    known = np.isfinite(cold) & (cold > 0.0)
    held = np.where(np.isfinite(warm) & (warm > 0.0), warm, np.inf)
    return float(np.abs(cold[known] / held[known] - 1.0).max(initial=0.0))


def _rise(at: Situation, name: str) -> Floats:
    """Rise of the temperature of a film, K: T − T_in = P/(2 ρ c_p Q), adiabatic, at the mean load.

    The power falls as the oil thins: P(T) = P(T_in) exp(−`FRICTION` β (T − T_in)).
    """
    own = at.scene.journal.at(name)
    falls = FRICTION * _steepness(own)
    cold = at.film(name, share=0.0).warming(2.0 * own.volume_heat)
    return np.asarray(lambertw(falls * cold).real) / falls


FRICTION = 0.54
"""d ln(friction)/d ln(viscosity) of a film under a given load: 1 less its gain with the load."""


def _steepness(journal: Journal) -> float:
    """β = −d ln(viscosity)/dT of the oil as it enters, 1/K."""
    heat = journal.heat or Heat(oil=MODEL_OIL)
    return float(heat.liquid.steepness(heat.inlet_temperature))


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
    """A bearing with a heat balance, whose oil enters with the viscosity stated; or without.

    Without, it is as warm as the oil that enters: with its viscosity, and grown as much.
    """
    if on == (journal.heat is not None):
        return journal
    stated = journal.model_dump(exclude_unset=True, exclude={"own"})
    if journal.heat is not None:
        held = journal.at_temperature(journal.heat.inlet_temperature)
        cool = {"heat": None, "lubricant": held.lubricant, "geometry": held.geometry}
        return type(journal).model_validate(stated | cool)
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
    cost=cost_of_heat,
    larger=no_bound_at_standstill,
    smaller=15.0,  # 11 of h_min in a start, most of which is slow
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
        warm = heat.inlet_temperature + _rise(at, name)
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
        thicker = thinnest_by(at, name, 1.0 + float(np.nanmax(share)))
        found.append({**sizes, "minimum film": thicker - 1.0})
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
