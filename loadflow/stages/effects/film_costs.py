"""What effects of the film of journal bearings cost, as measured on each rung."""

from __future__ import annotations

from collections.abc import Callable

from loadflow.scene.cases import simulated_length
from loadflow.scene.scene import Scene
from loadflow.stages.stage import STEPS_PER_CASE

COSTS = {
    "tilt": {"reduced": (2.6, 1.8), "grid": (3.7, 5.0)},
    "shell": {"reduced": (2.1, 1.5), "grid": (3.1, 3.1)},
    "shell all over": {"reduced": (7.4, 8.1), "grid": (15.0, 19.0)},
    "contact": {"reduced": (2.3, 1.6), "grid": (1.8, 1.4)},
    "turbulence": {"reduced": (2.5, 2.7), "grid": (1.1, 1.1)},
    "supply": {"reduced": (3.9, 3.1), "grid": (1.2, 1.2)},
    "growth": {"reduced": (3.1, 1.3), "grid": (1.2, 1.0)},
}
"""Time of a film with an effect over that without, at rest and in motion, by rung: measured by
``python -m benchmarks.references.film_effects`` and with ``--costs``; docs/journal-numerics.md. Two
of them together cost more than their product on "grid", less on "reduced". Of a shell that gives
way all over it is the mean of a thick cylinder and a housing."""


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


def cost_of_shell(scene: Scene) -> float:
    """Time of the films of a scene in its shell over that in a rigid one, as that gives way.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> from loadflow.stages.effects.film_costs import cost_of_shell
    >>> shells = ({"kind": "local", "compliance": 1e-12},
    ...           {"kind": "thick", "outer_diameter": 3.6, "modulus": 2.1e11})
    >>> [cost_of_shell(make_scene({"journal": {"rung": "reduced", "shell": s}})) for s in shells]
    [2.1, 7.4]
    """
    shell = scene.journal.shell
    return cost_of("shell" if shell is None or shell.local else "shell all over")(scene)


HEAT_COSTS = {
    "balance": {"reduced": (4.8, 1.0, 900), "grid": (4.6, 1.0, 280)},
    "film": {"reduced": (460.0, 1.9, 20_000), "grid": (45.0, 1.1, 480)},
}
"""Of a heat balance and of heat over the area, by rung: time at rest over that without, of a step
in motion over one without, and what is solved before the first step, in steps without; measured as
`COSTS`."""


def cost_of_heat(scene: Scene) -> float:
    """Time of the films of a scene with heat over that without; other rungs as "reduced".

    In motion the temperature of a series is found once, which counts the less the longer it is;
    given series are taken to be as long as those of the ladder.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> from loadflow.stages.effects.film_costs import cost_of_heat
    >>> warm = {"rung": "reduced", "heat": {}}
    >>> cost_of_heat(make_scene({"journal": warm}))
    4.8
    >>> moving = {"journal": warm | {"motion": "transient"}}
    >>> [round(cost_of_heat(make_scene(moving | {"loads": {"duration": t}})), 2) for t in (60, 600)]
    [1.38, 1.04]
    >>> round(cost_of_heat(make_scene(moving | {"loads": {"dlc": "3.1"}})), 3)  # of 300 s
    1.075
    """
    journal = scene.journal
    heats = [heat for name in journal.bearings if (heat := journal.at(name).heat) is not None]
    kind = "film" if any(heat.over_area for heat in heats) else "balance"
    at_rest, step, before = HEAT_COSTS[kind].get(journal.rung, HEAT_COSTS[kind]["reduced"])
    if not journal.in_motion:
        return at_rest
    steps, length, loads = float(STEPS_PER_CASE), simulated_length(scene), scene.loads
    if length is not None:
        steps = length / (loads.step * journal.every(loads.step))
    return step + before / steps
