"""What an effect is: physics that is in or out, on whatever rung the rest stands."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from loadflow.scene.scene import Scene
from loadflow.stages.effects.situation import Situation

Series = Mapping[str, Any]
"""By stage, what it gave of a case."""

Sizes = Mapping[str, float]
"""By quantity, the share by which an answer changes if the effect is left out; NaN: not known."""

UNSURE = 3.0
"""An effect over its indicator, where its pilots found no more; docs/physics.md."""

UNKNOWN = 1e4
"""The same where no indicator is a bound: then an effect is never out for certain."""


@dataclass(frozen=True)
class Effect:
    """Physics that a run can include or leave out.

    Attributes
    ----------
    name : str
        As the plan calls it.
    model : str
        Name of the model (`loadflow.stages.stage.Rungs`) whose error it adds to when it is out; a
        result is moved by it if one of its links names this model.
    keys : tuple of str
        ``"section.key"`` of all settings that a user decides it by: it is open to the plan where
        the scene names none of them. Empty where no scene can have it, or where it follows from
        keys of other effects.
    is_on : callable
        Scene → whether it is included.
    switched : callable
        Scene, on → the scene with the effect in or out; None where the scene lacks the data.
    indicator : callable
        Situation → its `Sizes` by closed forms, calibrated as its docstring says.
    larger : callable
        Scene → the effect over its indicator, at most: 1 where that is a bound. Of the answer that
        moves most, with a margin over what ``python -m benchmarks.ladder.indicators`` finds.
    smaller : float
        The indicator over the effect, at most; the same.
    either_way : tuple of str
        Quantities that it raises in one bearing and lowers in another, and so may leave as they
        are: of these the indicator is a bound from above alone.
    out : str
        What is left out, and why, for the plan.
    needs : str
        What the scene must say for the effect to be on.
    concerns : callable
        Scene → whether the effect can be there at all, on or off.
    cost : callable
        Scene with the effect on → time of its stage over that without, beyond what the ladder's
        rung tells.
    rungs : tuple of str
        Rungs that know it, by the setting ``rung`` of the section; empty: all.
    partly : tuple of (str, str)
        Those of `rungs` that know a part of it alone, and which; scenes refuse the rest by name.
    own_kernels : bool
        Whether its model has compiled loops for it, and others for when it is out.
    solves : bool
        Whether its indicator solves films, which asks for their compiled loops: a pilot, which
        measures the effect, does without it.
    probe : str
        Model whose probe measures it; empty: `model`.
    untold : str
        What it means that an indicator gives NaN.
    stated : callable, optional
        Scene → whether it decides the effect, where `keys` say more than that.
    muted : callable
        Scene with the effect on → what makes series that its probe reads into such in which it has
        no size: so a pilot asks what leaving it out changes on loops that are compiled anyway. None
        where the scene without it is asked.
    """

    name: str
    model: str
    keys: tuple[str, ...]
    is_on: Callable[[Scene], bool]
    switched: Callable[[Scene, bool], Scene | None]
    indicator: Callable[[Situation], Sizes]
    out: str
    needs: str = ""
    concerns: Callable[[Scene], bool] = lambda scene: True
    cost: Callable[[Scene], float] = lambda scene: 1.0
    rungs: tuple[str, ...] = ()
    partly: tuple[tuple[str, str], ...] = ()
    own_kernels: bool = False
    solves: bool = False
    larger: Callable[[Scene], float] = lambda scene: UNSURE
    smaller: float = 4.0
    either_way: tuple[str, ...] = ()
    muted: Callable[[Scene], Callable[[Series], Series] | None] = lambda scene: None
    probe: str = ""
    untold: str = ""
    stated: Callable[[Scene], bool] | None = None

    @property
    def probed(self) -> str:
        """Model whose probe measures it."""
        return self.probe or self.model

    @property
    def section(self) -> str:
        """Section of the scene that holds it."""
        return self.keys[0].split(".")[0] if self.keys else self.model

    @property
    def known_by_words(self) -> str:
        """Which rungs know it, and what of it where that is not all."""
        parts = {name: f"{name} ({part})" for name, part in self.partly}
        return ", ".join(parts.get(name, name) for name in self.rungs) or "all"

    def is_open(self, scene: Scene) -> bool:
        """Whether the scene leaves it to the plan."""
        if self.stated is not None:
            return not self.stated(scene)
        places = (key.split(".") for key in self.keys)
        return all(key not in getattr(scene, name).model_fields_set for name, key in places)

    def known_by(self, scene: Scene) -> bool:
        """Whether the scene's rung knows the effect."""
        return not self.rungs or getattr(scene, self.section).rung in self.rungs
