"""Tilt of the shaft in journal bearings, and what it leaves of the film at their ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import floating, floats_in_films
from loadflow.stages.effects.clearances import (
    CLEARANCES,
    Ends,
    closed_ends,
    ends_afloat,
    switched,
)
from loadflow.stages.effects.effect import Effect, Series, Sizes
from loadflow.stages.effects.film_costs import cost_of
from loadflow.stages.effects.film_sizes import ANSWERS, largest, no_bound_at_standstill
from loadflow.stages.effects.situation import Film, Floats, Situation
from loadflow.stages.films.of_bearing import aligned
from loadflow.stages.stage import with_settings

# --- film at the ends ------------------------------------------------------------------------


def thinnest_by(at: Situation, name: str, by: float) -> float:
    """Thinnest film of a bearing over what it is, where films at mid-plane are `by` × as thick.

    At the ends a shaft that tilts takes more of it (`Ends`). As much as at mid-plane where no plan
    lets the shaft tilt, or its surfaces touch.
    """
    ends, least = _ends(at, name), at.scene.journal.at(name).contact_film
    if not ends.film.size or by <= 0.0:
        return by
    thin = float(ends.left(least, by).min() / ends.left(least).min())
    return max(thin, by) if by > 1.0 else min(thin, by)


def left_at_ends(at: Situation, name: str) -> float:
    """Film at the ends of a bearing over that at mid-plane of an aligned shaft, at its least."""
    ends = _ends(at, name)
    left = ends.left(at.scene.journal.at(name).contact_film) / ends.film
    return float(left.min(initial=1.0))


def _ends(at: Situation, name: str) -> Ends:
    """What a shaft that tilts takes of the films of a bearing at their ends.

    As it lies in the clearances of films that it floats in, or may, and as it is bent.
    """
    scene, film = at.scene, at.films[name]
    bends = name in scene.journal.tilting and scene.shaft.bends_at(name)
    bent = _bent(at, name, film) * (bends and (scene.journal.tilt or _may(scene, TILT)))
    afloat = CLEARANCES.is_on(scene) or (
        _may(scene, CLEARANCES) and switched(scene, True, floating) is not None
    )
    ends = ends_afloat(at).get(name) if afloat else None
    if ends is not None:
        return Ends(ends.share + bent.max(), ends.film)
    there = np.isfinite(film.minimum_film)
    return Ends(bent[there], film.minimum_film[there])


def _may(scene: Scene, effect: Effect) -> bool:
    """Whether it is for the plan to take the effect."""
    return scene.asks and effect.is_open(scene)


def _bent(at: Situation, name: str, film: Film) -> Floats:
    """Share of the film at mid-plane that the bent shaft takes at one end, (n,).

    Slope × width / (2 film), at most all: beyond, a film in motion holds the end by its squeeze.
    """
    own = at.scene.journal.at(name)
    slope = at.bearings[name].slope + turn_of_bore(own)
    share = 0.5 * slope * own.geometry.width / film.minimum_film
    return np.minimum(np.nan_to_num(share), 1.0)


# --- tilt ------------------------------------------------------------------------------------


def turn_of_bore(journal: Journal) -> float:
    """How far a bore is turned, rad; 0 of one that follows the shaft."""
    return 0.0 if journal.alignment == "mean" else float(np.hypot(*journal.alignment))


def _tilt(at: Situation) -> Sizes:
    """Slope of the shaft in its bore × width / (2 film): what tilt takes from the film at one end.

    The slope is that of the beam, bent by forces and moments at the hub. The shares in the answers
    are those of a width of 3/4 of the diameter, tilted in the plane of the load. A shaft that films
    are fed back to also tilts in their clearances (`closed_ends`).
    """
    scene, found = at.scene, []
    floats = closed_ends(at) if floats_in_films(scene.shaft, scene.journal) else {}
    for name, film in at.films.items():
        if name not in scene.journal.tilting:
            continue
        most = min(float(_bent(at, name, film).max()) + floats.get(name, 0.0), 1.0)
        found.append(
            {
                "eccentricity ratio": 0.05 * most,
                "minimum film": most,
                "maximum pressure": 0.15 * most,
                "friction power": 0.04 * most,
            }
        )
    return largest(found) if found else dict.fromkeys(ANSWERS, 0.0)


def _aligned(scene: Scene) -> Callable[[Series], Series] | None:
    """On the rung "reduced" a film around a shaft that may tilt has loops of its own.

    Not where it is followed with the shaft, which tilts as it moves.
    """
    if scene.journal.rung != "reduced" or scene.shaft.coupled:
        return None
    return lambda given: {**given, "shaft": _all_aligned(scene.journal, given["shaft"])}


def _all_aligned(journal: Journal, shaft: xr.Dataset) -> xr.Dataset:
    """Loads of all bearings, with the shaft straight along the bores of those of the scene."""
    parts = []
    for name in shaft["bearing"].values:
        one = shaft.sel(bearing=name)
        parts.append(aligned(journal.at(name), one) if name in journal.bearings else one)
    return xr.concat(parts, "bearing", coords="different", compat="equals")


TILT = Effect(
    "tilt of the shaft",
    model="journal",
    keys=("journal.tilt",),
    is_on=lambda scene: scene.journal.tilt,
    switched=lambda scene, on: (
        with_settings(scene, "journal", {"tilt": on})
        if not on or any(map(scene.shaft.bends_at, scene.journal.tilting))
        else None
    ),
    indicator=_tilt,
    concerns=lambda scene: bool(scene.journal.tilting),
    out="no journal.tilt: half the width of the film is solved",
    needs="journal.tilt = true, with a beam as the shaft",
    cost=cost_of("tilt"),
    larger=no_bound_at_standstill,
    smaller=15.0,  # 10 of a stretch in which the shaft bends less than in all of the case
    rungs=("grid", "reduced"),
    own_kernels=True,
    muted=_aligned,
)
