"""What leaving out an effect costs in accuracy: by its indicator, or measured by the pilot."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.scene.section import is_valid
from loadflow.stages.effects.effect import UNKNOWN, Effect, Sizes
from loadflow.stages.effects.registry import effects_of
from loadflow.stages.effects.rolling import overloaded
from loadflow.stages.effects.situation import situation
from loadflow.stages.registry import STAGES

WORTH = 0.1
"""Share of the smallest error allowed, below which an indicator needs no measurement."""


@dataclass(frozen=True)
class EffectVerdict:
    """What a pilot found.

    Attributes
    ----------
    sizes : mapping
        By effect and quantity, the share by which an answer changes without it.
    refused : mapping
        Effects that cannot be on in this scene, and why.
    cases : tuple of str
        Load cases that it looked at.
    seconds : float
        Processor time that it took, s.
    """

    sizes: Mapping[str, Sizes] = field(default_factory=dict)
    refused: Mapping[str, str] = field(default_factory=dict)
    cases: tuple[str, ...] = ()
    seconds: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Plain values."""
        return {
            "sizes": {name: dict(sizes) for name, sizes in self.sizes.items()},
            "refused": dict(self.refused),
            "cases": list(self.cases),
            "seconds": self.seconds,
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> EffectVerdict:
        """The inverse of `to_json`."""
        return cls(**dict(data) | {"cases": tuple(data["cases"])})


@dataclass(frozen=True)
class Estimates:
    """What is known of the effects of a scene before it runs.

    Attributes
    ----------
    indicators : mapping
        Closed-form sizes, by effect and quantity.
    verdict : EffectVerdict, optional
        What a pilot measured; it goes before the indicators.
    overloaded : tuple of str
        Rolling bearings that cannot carry the estimated loads, in words.
    """

    indicators: Mapping[str, Sizes] = field(default_factory=dict)
    verdict: EffectVerdict | None = None
    overloaded: tuple[str, ...] = ()

    @classmethod
    def of_manifest(cls, manifest: Mapping[str, Any]) -> Estimates:
        """Those that a run was decided with, as its manifest tells them."""
        effects = manifest.get("effects", [])
        sizes = {one["name"]: one["size"] for one in effects if one["size"] is not None}
        return cls({one["name"]: one["indicator"] for one in effects}, EffectVerdict(sizes))

    def size(self, effect: Effect, quantity: str) -> float:
        """Share by which an answer changes without an effect; 0 of what it does not move."""
        return self.sizes(effect).get(quantity, 0.0)

    def sizes(self, effect: Effect) -> Sizes:
        """Sizes by quantity: measured, or by the indicator."""
        measured = self.verdict.sizes.get(effect.name) if self.verdict else None
        return self.indicators.get(effect.name, {}) if measured is None else measured

    def is_little(self, scene: Scene, effect: Effect) -> bool:
        """Whether an effect is far below all that a scene allows; False where it is not known."""
        least = min(scene.allowed(result) for result in scene.results)
        sizes = self.sizes(effect).values()
        return bool(sizes) and all(size <= WORTH * least for size in sizes)  # NaN is not

    def is_doubtful(self, scene: Scene, effect: Effect) -> bool:
        """Whether nobody measured an effect whose indicator is no bound, and not `is_little`."""
        measured = self.verdict is not None and effect.name in self.verdict.sizes
        told = bool(self.indicators.get(effect.name)) and not self.is_little(scene, effect)
        return told and not measured and effect.larger(scene) >= UNKNOWN

    def refused(self, effect: Effect) -> str:
        """Why an effect cannot be on, by the pilot; empty if nothing is known against it."""
        return self.verdict.refused.get(effect.name, "") if self.verdict else ""


def estimates(
    scene: Scene,
    stages: Iterable[str],
    cases: tuple[Case, ...],
    verdict: EffectVerdict | None = None,
    solving: bool = True,
) -> Estimates:
    """Return the indicators of all effects of the stages, and what a pilot measured.

    Parameters
    ----------
    scene : Scene
        What is wanted.
    stages : iterable of str
        Stages that will run.
    cases : tuple of Case
        Load cases.
    verdict : EffectVerdict, optional
        Of a pilot of this scene.
    solving : bool
        Whether films are solved for indicators that need them; else these are not there.
    """
    effects = concerned(scene, stages)
    if not effects or not cases:
        return Estimates({}, verdict)
    at = situation(scene, cases)
    asked = (effect for effect in effects if solving or not effect.solves)
    told = overloaded(at) if "rolling" in {effect.model for effect in effects} else ()
    sizes = {effect.name: effect.indicator(at) for effect in asked}
    return Estimates(sizes, verdict, tuple(told))


def concerned(scene: Scene, stages: Iterable[str]) -> list[Effect]:
    """Effects of some stages that can be there in a scene, on or off."""
    found = (one for name in stages if name in STAGES for one in effects_of(STAGES[name], scene))
    return [*dict.fromkeys(found)]


def switched(scene: Scene, effect: Effect, on: bool) -> Scene | None:
    """Return the scene with an effect in or out; None where that is no valid scene.

    A rung that the scene does not name makes room for one that knows the effect.
    """
    if effect.is_on(scene) == on:
        return scene
    changed = effect.switched(scene, on)
    if changed is None or effect.is_on(changed) != on:
        return None
    return changed if is_valid(changed) else None
