"""Effects of the film of journal bearings."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

import numpy as np

from loadflow.data import gains
from loadflow.journal import Turbulence
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import any_moves_in_films
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film_costs import cost_of, cost_of_shell
from loadflow.stages.effects.film_sizes import (
    ANSWERS,
    asperity_share,
    largest,
    no_bound_at_standstill,
    worst,
)
from loadflow.stages.effects.film_tilt import left_at_ends, thinnest_by
from loadflow.stages.effects.situation import Situation
from loadflow.stages.films.turning import (
    always_turns,
    carried_throughout,
    comes_from_or_to_standstill,
)
from loadflow.stages.frames import to_film
from loadflow.stages.stage import with_settings

THREE_P = 0.2
"""Share of the largest deviation of a load that the blades make as they pass; NREL 5 MW, 12 m/s."""

STEEL = 2.1e11  # Pa
WALL = 0.1
"""Wall of the housing over the diameter of the bearing, where none is stated."""

ROUGHNESS = 1.1 / 3.8
"""σ of both surfaces together over the sum of their R_z: a ground shaft, a machined bearing."""


class _Keys(TypedDict):
    """What an effect has from the table of a scene that turns it on."""

    keys: tuple[str, ...]
    is_on: Callable[[Scene], bool]
    switched: Callable[[Scene, bool], Scene | None]


def _of_table(name: str, needed: Callable[[Scene], bool] = lambda scene: False) -> _Keys:
    """Of an effect that a table of the journal turns on: it may be left out, but not made up.

    Not left out where it is `needed`.
    """

    def is_on(scene: Scene) -> bool:
        return getattr(scene.journal, name) is not None

    def switched(scene: Scene, on: bool) -> Scene | None:
        if not on:
            return None if needed(scene) else with_settings(scene, "journal", {name: None})
        return scene if is_on(scene) else None

    return {"keys": (f"journal.{name}",), "is_on": is_on, "switched": switched}


# --- motion ----------------------------------------------------------------------------------


def _motion(at: Situation) -> Sizes:
    """What squeeze takes out of the swing of a load.

    A short cylindrical film answers a load that turns at Ω with 1/|1 − 2Ω/ω| of its displacement
    at rest, one that swings with the mean of both senses. `THREE_P` of the swing comes as blades
    pass; the rest is slow. Nothing of a shaft that stands, which rests on its shell. All of a shaft
    that starts or stops: at rest it has no film, where squeeze still holds one.
    """
    if comes_from_or_to_standstill(at.scene):
        return dict.fromkeys(ANSWERS, 1.0)
    ratio = at.turbine.rotor.blades
    left = 0.5 * (1 / abs(1 - 2 * ratio) + 1 / (1 + 2 * ratio))
    found = []
    for name, film in at.films.items():
        load = at.bearings[name]
        change = THREE_P * (1 - left) * load.swing / np.maximum(load.radial + load.swing, 1.0)
        change = np.where(at.turns, change, 0.0)
        gain = gains()["journal"]
        # the mean of the friction moves less than its extremes
        power = MEAN * gain["friction power"] * float(np.max(change))
        eccentricity = gain["eccentricity ratio"] * change
        sizes = dict(worst(film, eccentricity, gain["maximum pressure"] * change, power))
        sizes["minimum film"] = 1.0 - thinnest_by(at, name, 1.0 - sizes["minimum film"])
        found.append(sizes)
    return largest(found)


MEAN = 0.5
"""Change of a mean by motion over that of an extreme; docs/physics.md."""


MOTION = Effect(
    "motion of the film",
    model="journal",
    keys=("journal.motion",),
    is_on=lambda scene: scene.journal.in_motion,
    switched=lambda scene, on: (
        with_settings(scene, "journal", {"motion": "transient" if on else "quasi-static"})
        if carried_throughout(scene) or not on
        else None
    ),
    indicator=_motion,
    larger=no_bound_at_standstill,
    smaller=20.0,  # 13 where the shaft tilts, as indicated films are those of an aligned one
    out='journal.motion = "quasi-static"; the run warns where the orbit differs',
    needs='journal.motion = "transient", of a shaft that never stands or has journal.contact',
)


# --- shell, contact, turbulence, supply ------------------------------------------------


def _shell(at: Situation) -> Sizes:
    """Pressure × compliance / film at the ends: growth of the gap by a wall that is held outside.

    Without a shell, by a wall of steel of `WALL`.

    The shares of it in each answer are those of docs/journal-shell.md.
    """
    shell = at.scene.journal.shell
    modulus = getattr(shell, "modulus", STEEL)
    thickness = getattr(shell, "thickness", WALL * at.scene.journal.geometry.diameter)
    compliance = getattr(shell, "compliance", 0.2 * thickness / modulus)
    found = []
    for name, film in at.films.items():
        above = film.maximum_pressure - at.scene.journal.at(name).edge_pressure
        share = float(np.nanmax(above * compliance / film.minimum_film)) / left_at_ends(at, name)
        # a gap that opens takes the pressure that opens it
        found.append(dict.fromkeys(ANSWERS, 0.25 * share / (1.0 + share)))
    return largest(found)


SHELL = Effect(
    "elastic shell",
    model="journal",
    **_of_table("shell"),
    indicator=_shell,
    out="no journal.shell",
    needs="a table journal.shell",
    cost=cost_of_shell,
    larger=no_bound_at_standstill,
    smaller=15.0,  # what tilt and shell do at the ends lasts for less than the indicated case
    rungs=("grid", "reduced"),
    own_kernels=True,
)


def _contact(at: Situation) -> Sizes:
    """Share of the load that asperities take of surfaces as rough as the scene says.

    All of it where the shaft stands throughout.
    """
    found = []
    for place, film in at.films.items():
        rough = ROUGHNESS * at.scene.journal.at(place).contact_film
        turns = at.turns
        share = float(asperity_share(film.minimum_film[turns], rough).max(initial=0.0))
        share = share if turns.any() else 1.0
        found.append(dict.fromkeys(ANSWERS, share))
    return largest(found)


def _holds_the_shaft(scene: Scene) -> bool:
    """Whether a shaft that stands at times floats in its films: no smooth one carries it then."""
    return any_moves_in_films(scene.shaft, scene.journal) and not always_turns(scene)


CONTACT = Effect(
    "contact of asperities",
    model="journal",
    **_of_table("contact", needed=_holds_the_shaft),
    indicator=_contact,
    out="the film alone carries; asperities would take load below a film parameter of 4",
    needs="a table journal.contact with the asperities of both surfaces",
    cost=cost_of("contact"),
    larger=no_bound_at_standstill,
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
        found.append(worst(film, changes, 0.3 * changes, 1.0 - 1.0 / shear))
    return largest(found)


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
    """Share of the film that a groove cuts where the load comes to lie, and what pockets lift.

    A groove over a share of the width takes as much of the load as the load comes to lie on it, by
    the cosine; with its swing the load turns by atan(swing/mean). A pocket lifts with its pressure
    above that of the bearing ends. Without grooves the ends stand in oil, and nothing is left out.
    Calibrated on two grooves at the sides, 5 MW: docs/physics.md.
    """
    found = []
    for name, load in at.bearings.items():
        if (
            name not in at.scene.journal.bearings
            or (own := at.scene.journal.at(name)).supply is None
        ):
            continue
        size, lies = own.geometry, np.arctan2(*to_film(load.force)[:, ::-1].T)
        turns = np.arctan2(load.swing, load.radial)
        share = np.zeros_like(turns)
        for groove in own.supply.grooves:
            length = min(groove.length or size.width, size.width) / size.width
            circle = groove.shape == "circle"
            arc = length * size.width / size.radius if circle else groove.arc
            pair = 2.0 if groove.axial else 1.0  # either side of mid-plane
            length = min(pair * length, 1.0)
            away = np.abs((groove.angle - lies + np.pi) % (2.0 * np.pi) - np.pi)
            away = np.maximum(away - 0.5 * arc - turns, 0.0)
            cut = length * np.clip(np.cos(away), 0.0, 1.0)
            pump = own.supply.pump
            pressed = max(pump.pressure if pump else (groove.pressure,)) - own.edge_pressure
            area = arc * size.radius * length * size.width  # of a circle 4/π too large
            share = np.maximum(share, cut) + max(pressed, 0.0) * area / np.maximum(load.radial, 1.0)
        sizes = {key: CUT[key] * min(float(share.max()), 1.0) for key in CUT}
        thinner = thinnest_by(at, name, 1.0 / (1.0 + sizes["minimum film"]))
        found.append({**sizes, "minimum film": 1.0 / thinner - 1.0})
    return largest(found) if found else dict.fromkeys(CUT, 0.0)


CUT = {
    "eccentricity ratio": 0.3,
    "minimum film": 1.0,
    "maximum pressure": 0.4,
    "friction power": 0.3,
}
"""Changes of the answers by a groove as long as the bearing under its load."""


SUPPLY = Effect(
    "supply of the film",
    model="journal",
    **_of_table("supply"),
    indicator=_supply,
    out="no journal.supply: the bearing ends stand in oil",
    needs="a table journal.supply",
    concerns=lambda scene: scene.journal.supply is not None,
    cost=cost_of("supply"),
    smaller=15.0,  # 12 at 15 MW, whose seed of 60 s bends the shaft less than is estimated
    rungs=("grid", "reduced"),
    partly=(
        (
            "reduced",
            "rectangular ones, each on one segment, no moving pads",
        ),
    ),
)
