"""How accurate a wanted result is, end to end, with given models.

The error of a result is the sum of what each model on the way to it adds: that of its rung, at its
largest in the ladder, and of every effect that is left out, as the pilot measured it or, without a
pilot, as its indicator estimates it. An error of the load reaches a bearing's answer through the
gain d ln(answer)/d ln(load) of that answer, which is measured too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import isfinite, isnan

from loadflow.planning.effects import Estimates
from loadflow.planning.ladder import gains, ladder, measured
from loadflow.rolling.rating.modified_life import SLOW_POWER
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.registry import giving, models
from loadflow.stages.stage import Link, Rungs, load_links

Errors = dict[str, dict[str, float | None]]
"""By result and quantity; None where not measured."""


@dataclass(frozen=True)
class Part:
    """What one rung or one effect left out adds to the error of an answer; None: not known."""

    model: str
    effect: Effect | None
    share: float | None


def expected_errors(scene: Scene, known: Estimates | None = None) -> Errors:
    """Return the error to expect of each wanted result, by quantity; None where not measured.

    Parameters
    ----------
    scene : Scene
        With its models.
    known : Estimates, optional
        Sizes of effects; without it only those of the rungs are counted.
    """
    return {
        result: {
            name: total(contributions(scene, result, name, links, known or Estimates()))
            for name, links in giving(result).results[result](scene).items()
        }
        for result in scene.results
    }


def surely_small(scene: Scene, effect: Effect, known: Estimates, *, alone: bool = False) -> bool:
    """Return whether an effect is out for certain: its indicator leaves no doubt.

    Without it all that it moves holds the accuracy asked for, with all else that reaches these
    answers, even if it is `larger` than its indicator by as much as it may be. Then nothing need be
    measured, the kernels of the effect among it.

    Parameters
    ----------
    scene : Scene
        With its models.
    effect : Effect
        Which; one that is in, or has no indicator, is in doubt.
    known : Estimates
        Of the effects of the scene.
    alone : bool
        Whether other effects that are out are not counted: a check looks at one at a time.
    """
    if not scene.asks or effect.is_on(scene):
        return False
    indicator = known.indicators.get(effect.name, {})
    by = effect.larger(scene)
    larger = {name: by * size for name, size in indicator.items()}
    others = {} if alone else known.indicators
    doubtful = replace(known, indicators={**others, effect.name: larger})
    moved = [
        (result, error)
        for result, found in expected_errors(scene, doubtful).items()
        for name, error in found.items()
        if _reaches(scene, result, name, effect)
    ]
    return bool(indicator) and all(
        error is not None and error <= scene.allowed(result) for result, error in moved
    )


def _reaches(scene: Scene, result: str, quantity: str, effect: Effect) -> bool:
    links = giving(result).results[result](scene)[quantity]
    return any(effect.model == link.model for link in links)


_FEW = {
    "friction power": "friction power",
    "friction torque": "friction power",
    "catalogue torque": "friction power",
    "film parameter": "film parameter",
    "smallest load": "equivalent load",
}
"""What a comparison takes from few samples in ideal rolling, and whose gain it has with the load;
the torques of catalogues have that of the power."""


_SPEED = tuple(Link(model, "slowest speed", of_load=False) for model in ("wind", "loads"))
"""What makes the speed of the rotor; the shaft turns as fast."""


def errors_beside(scene: Scene, known: Estimates) -> Errors:
    """Return the error of what a comparison makes of a run beside its results, by quantity.

    No accuracy is asked of these. Of rolling bearings the ladder holds what few samples in
    ideal rolling are off; shares of a load, and the tilt of the shaft, follow the load as it
    is, and κ the slowest speed; κ, friction, Λ and the modified life follow the oil, by the
    temperature that a scene without cooling assumes. Effects that are left out count where they
    move the load, or friction, film, κ and modified life of rolling bearings.

    Parameters
    ----------
    scene : Scene
        With its models.
    known : Estimates
        Sizes of effects.
    """

    def of(result: str, quantity: str, *links: Link) -> float | None:
        return total(contributions(scene, result, quantity, links, known))

    found: Errors = {}
    whole = of("shaft.tilt", "tilt", *load_links("bearing load max", of_load=False))
    found["shaft.tilt"] = {"tilt": whole}
    if scene.wants("journal") and scene.journal.in_motion:
        links = *load_links("radial force max"), Link("journal", "side flow")
        found["journal.film"] = {"side flow": of("journal.film", "side flow", *links)}
    pads = scene.thrust
    if scene.wants("thrust"):  # its few samples in place of the reduction
        few = _few_samples("cones" if len(pads.collars) < len(pads.bearings) else "collar")
        films = {
            name: [link for link in links if link.model != "reduction"]
            for name, links in giving("thrust.film").results["thrust.film"](scene).items()
        }
        found["thrust.film"] = {
            name: _plus(of("thrust.film", name, *links), few.get(name))
            for name, links in films.items()
        }
    if scene.wants("rolling"):
        kinds = {one.friction_model for one in scene.rolling.geometries.values()}
        few = _few_samples("balls" if kinds == {"balls"} else "rollers")

        def left_out(quantity: str) -> float | None:
            return total(
                Part("rolling", effect, None if isnan(size) else size)
                for effect in effects_left_out(scene, "rolling")
                for size in [known.size(effect, quantity)]
            )

        reached = {
            name: _plus(
                of("rolling.friction", gain, *load_links("bearing load max")), left_out(gain)
            )
            for name, gain in _FEW.items()
        } | {"row share": whole}
        speed = of("rolling.friction", "slowest speed", *_SPEED)
        reached["viscosity ratio"] = None if speed is None else SLOW_POWER * speed
        reached["viscosity ratio"] = _plus(reached["viscosity ratio"], left_out("viscosity ratio"))
        life = giving("rolling.life").results["rolling.life"](scene)["life"]
        aged = _plus(of("rolling.life", "life", *life), left_out("modified life"))
        found["rolling.life"] = {"modified life": aged}
        found["rolling.friction"] = {
            name: _plus(share, few.get(name)) for name, share in reached.items()
        }
    return found


def _few_samples(kind: str) -> dict[str, float]:
    """What the few samples of a comparison are off, at most, by quantity; empty: not measured."""
    errors = ladder().get("comparison", {}).get(kind, {}).get("errors", {})
    return {name: float(error["max"]) for name, error in errors.items()}


def _plus(share: float | None, more: float | None) -> float | None:
    return None if share is None or more is None else share + more


def total(parts: Iterable[Part]) -> float | None:
    """Sum of the parts; None if one of them is not measured."""
    shares = [part.share for part in parts]
    return None if None in shares else float(sum(share for share in shares if share is not None))


def contributions(
    scene: Scene, result: str, quantity: str, links: tuple[Link, ...], known: Estimates
) -> Iterator[Part]:
    """What each rung, and each effect that is left out, adds to the error of an answer."""
    for link in links:
        yield from of_link(scene, result, quantity, link, known)


def of_link(
    scene: Scene,
    result: str,
    quantity: str,
    link: Link,
    known: Estimates,
    left_out: Iterable[Effect] | None = None,
) -> Iterator[Part]:
    """What the model at one link, and its effects that are left out, add to that error.

    The effects that the model leaves out may be given by who asks for many of its links.
    """
    bearings = link.gains or result.split(".")[0]
    gain = gains().get(bearings, {}).get(quantity) if link.of_load else 1.0
    share = _rung_error(scene, models()[link.model], link.quantity)
    if share != 0.0:
        yield Part(link.model, None, None if share is None or gain is None else share * gain)
    for effect in effects_left_out(scene, link.model) if left_out is None else left_out:
        size = known.size(effect, link.quantity)
        if size:
            error = None if gain is None or isnan(size) else size * gain
            yield Part(link.model, effect, error)


def _rung_error(scene: Scene, rungs: Rungs, quantity: str) -> float | None:
    if rungs.exact(scene):
        return 0.0
    entry = measured(scene, rungs.name, rungs.error_key(scene) if rungs.error_key else None)
    if entry is None or entry["errors"] is None:
        return None
    if not entry["errors"]:
        return 0.0  # the top rung
    return entry["errors"][quantity]["max"] if quantity in entry["errors"] else None


def effects_left_out(scene: Scene, model: str) -> Iterator[Effect]:
    """Effects of a model that concern a scene and are off in it."""
    for effect in EFFECTS:
        if effect.model == model and effect.concerns(scene) and not effect.is_on(scene):
            yield effect


# --- what a comparison with a finer rung says ----------------------------------------------------


def error_by_change(scene: Scene, model: str, quantity: str, change: float) -> float:
    """By how much a model is off, if the next finer rung changes an answer by so much.

    Errors e of the ladder fall by the order of the cells or steps: the change is e_0 - e_1 of e_0
    in all [Roache 1994]. The change itself where the ladder does not tell, as at its finest
    rung.
    """
    known = _errors_up(scene, model, quantity)
    if len(known) < 2:
        return change
    return change * known[0] / (known[0] - known[1])


def rungs_up(scene: Scene, model: str, quantity: str, error: float, allowed: float) -> int:
    """How many rungs finer a model has to be, for a quantity to be within what is allowed.

    It is off by `error`, and k rungs finer by that times e_k/e_0 of the errors e of the ladder. The
    finest of those that were measured, if none is good enough; 1 where the ladder does not tell.
    """
    known = _errors_up(scene, model, quantity)
    if len(known) < 2 or not isfinite(error):
        return 1
    steps = range(1, len(known))
    return next((k for k in steps if error * known[k] / known[0] <= allowed), steps[-1])


def _errors_up(scene: Scene, model: str, quantity: str) -> list[float]:
    """Errors of the rung of a model and of the finer ones, as far as they are known and fall."""
    rungs, found = models().get(model), list[float]()
    one: Scene | None = scene
    while rungs is not None and one is not None:
        error = _rung_error(one, rungs, quantity)
        if error is None or (found and error >= found[-1]):
            break
        found.append(error)
        one = rungs.finer(one)
    return found
