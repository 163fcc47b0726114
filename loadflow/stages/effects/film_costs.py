"""What effects of the film of journal bearings cost, as measured on each rung."""

from __future__ import annotations

from collections.abc import Callable

from loadflow.scene.scene import Scene

COSTS = {
    "tilt": {"reduced": (2.6, 1.8), "grid": (3.7, 5.0)},
    "shell": {"reduced": (2.1, 1.5), "grid": (3.1, 3.1)},
    "contact": {"reduced": (2.3, 1.6), "grid": (1.8, 1.4)},
    "turbulence": {"reduced": (2.5, 2.7), "grid": (1.1, 1.1)},
    "supply": {"reduced": (3.9, 3.1), "grid": (1.2, 1.2)},
    "growth": {"reduced": (3.1, 1.3), "grid": (1.2, 1.0)},
}
"""Time of a film with an effect over that without, at rest and in motion, by rung: measured by
``python -m benchmarks.references.film_effects`` and with ``--costs``; docs/journal.md. Two of them
together cost more than their product on "grid", less on "reduced"."""


def cost_of(name: str) -> Callable[[Scene], float]:
    """Cost of one of `COSTS` on the rung of a scene; 1 on those that do not know the effect.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> from loadflow.stages.effects.film_costs import cost_of
    >>> cost_of("tilt")(make_scene({"journal": {"rung": "reduced", "motion": "transient"}}))
    1.8
    """

    def cost(scene: Scene) -> float:
        journal = scene.journal
        return COSTS[name].get(journal.rung, (1.0, 1.0))[journal.in_motion]

    return cost
