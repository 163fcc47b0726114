"""What a stage of a run is, and what the rungs of a model are.

A stage answers for itself: what it gives and needs, what it depends on, how it is run and summed
up, which rungs its models have, what it costs, and how its errors reach the answers that users
read. The plan asks these questions of every stage in `loadflow.stages.registry.STAGES`, and knows
none of them by name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from pydantic import ValidationError

from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene

STEPS_PER_CASE = 24_000
"""Length of a load case in the ladder: 600 s in steps of 0.025 s."""

Settings = Mapping[str, Any]
"""Keys of one section of a scene."""

Entry = Mapping[str, Any]
"""What the ladder holds of a rung."""


class Measured(Protocol):
    """Looks up a rung of a model in the ladder: the scene's, or one by its key.

    None where it was not measured.
    """

    def __call__(self, scene: Scene, model: str, key: str | None = None) -> Entry | None:
        """Return the ladder's entry."""
        ...


@dataclass(frozen=True)
class Link:
    """What a model adds to the error of an answer.

    Attributes
    ----------
    model : str
        Name of its `Rungs`; effects name it, too.
    quantity : str
        The quantity in the ladder's entry.
    of_load : bool
        Whether it is an error of the load, which the bearing answers with its gain.
    gains : str
        Bearings that have that gain; default those of the room of the result.
    """

    model: str
    quantity: str
    of_load: bool = False
    gains: str = ""


@dataclass(frozen=True)
class Rungs:
    """How finely one thing can be modelled: the rungs of one table of the ladder.

    Attributes
    ----------
    name : str
        Of the model; that of its stage if it has but one.
    section : str
        Section of the scene that holds its settings.
    key : callable
        Scene → name of its rung in the ladder. The benchmarks name the rungs by the same function.
    text : callable, optional
        Scene → what the plan prints; default the key.
    table : callable, optional
        Scene → name of the ladder's table; default `name`.
    error_key : callable, optional
        Scene → the rung whose errors count, where another one's are those of an effect left out;
        default the key.
    exact : callable
        Scene → whether nothing is to be chosen, and nothing is lost: what is given, or follows
        from equilibrium.
    better : callable
        Scene → settings of the next more accurate rung, empty at the top.
    possible : callable
        Scene and settings → whether the scene has the data that they need.
    """

    name: str
    section: str
    key: Callable[[Scene], str]
    text: Callable[[Scene], str] | None = None
    table: Callable[[Scene], str] | None = None
    error_key: Callable[[Scene], str] | None = None
    exact: Callable[[Scene], bool] = lambda scene: False
    better: Callable[[Scene], dict[str, Any]] = lambda scene: {}
    possible: Callable[[Scene, Settings], bool] = lambda scene, settings: True

    def table_of(self, scene: Scene) -> str:
        """Name of the ladder's table that holds the rungs."""
        return self.table(scene) if self.table else self.name

    def text_of(self, scene: Scene) -> str:
        """The scene's rung, as a plan prints it."""
        return self.text(scene) if self.text else self.key(scene)

    def with_settings(self, scene: Scene, settings: Settings) -> Scene | None:
        """Return the scene with other settings, None where it lacks the data that they need."""
        if not self.possible(scene, settings):
            return None
        return with_settings(scene, self.section, settings)

    def finer(self, scene: Scene) -> Scene | None:
        """Return the scene with the next more accurate rung; None at the top."""
        settings = self.better(scene)
        return self.with_settings(scene, settings) if settings else None


def with_settings(scene: Scene, section: str, settings: Settings) -> Scene | None:
    """Return the scene with other settings in a section, None where they do not fit it."""
    before = getattr(scene, section)
    try:
        stated = before.model_dump(exclude_unset=True) | dict(settings)
        changed = type(before).model_validate(stated)
    except ValidationError:
        return None
    return scene.model_copy(update={section: changed})


def always(*names: str) -> Callable[[Scene], tuple[str, ...]]:
    """Answer of every scene."""
    return lambda scene: names


def load_links(quantity: str, of_load: bool = True, gains: str = "") -> tuple[Link, ...]:
    """What a load brings: the errors of wind, rotor and shaft."""
    return tuple(Link(model, quantity, of_load, gains) for model in ("wind", "loads", "shaft"))


Links = Mapping[str, tuple[Link, ...]]
"""By quantity, what reaches it."""


@dataclass(frozen=True, eq=False)
class Stage:
    """One step of the flow.

    Attributes
    ----------
    name : str
        Name, also of its folder or file in a run.
    run : callable
        ``run(scene, case, inputs)``, or ``run(scene, cases, inputs)`` if its scope is the run;
        `inputs` holds what the stages that it needs gave.
    results : mapping
        For each result that it gives, what users read of it and, by scene, the models whose errors
        reach that. A verdict is no number, and has none.
    needs : callable
        Scene → stages whose results it reads.
    scope : {"case", "run"}
        Whether it runs once for each load case, or once over all of them.
    sections : callable
        Scene → sections of the scene that it depends on.
    models : tuple of Rungs
        What it models on rungs; the last one is its own.
    pieces : callable
        ``pieces(scene, cases)`` → groups of cases that a stage over all of them works on one by
        one; default all together.
    joined : callable
        ``joined(scene, found)`` → what it gives, of what it found in each piece, in their order.
    summarise : callable, optional
        Joins what it gave, by case; None where there is nothing to tell.
    exports : callable, optional
        ``exports(case, data)`` → text files that a run writes of what it gave, by name.
    warnings : callable
        Results of a run → sentences on what is doubtful.
    work : callable
        ``work(scene, cases, measured)`` → units of what the ladder gives seconds for: load cases of
        `STEPS_PER_CASE` steps, or samples; None where not known.
    more_seconds : callable
        Seconds of what runs inside the stage besides, for one load case; None where not measured.
    once : callable
        ``once(scene, measured)`` → seconds of what is made once for all cases, as a table.
    left_out : callable
        Scene → what it does not model and why, beyond the effects that say so themselves.
    sample : int, optional
        Number of cases that it looks at, spread over all of them; default all.
    asked : callable
        Scene → whether its data ask for the stage, though no result names it.
    """

    name: str
    run: Callable[[Scene, Any, Any], Any]
    results: Mapping[str, Callable[[Scene], Links]] = field(default_factory=dict)
    needs: Callable[[Scene], tuple[str, ...]] = lambda scene: ()
    scope: Literal["case", "run"] = "case"
    sections: Callable[[Scene], tuple[str, ...]] = lambda scene: ()
    models: tuple[Rungs, ...] = ()
    pieces: Callable[[Scene, list[Case]], list[list[Case]]] = lambda scene, cases: [cases]
    joined: Callable[[Scene, list[Any]], Any] = lambda scene, found: found[0]
    summarise: Callable[[Mapping[Case, Any]], Any] | None = None
    exports: Callable[[Case, Any], Mapping[str, str]] | None = None
    warnings: Callable[[Any], list[str]] = lambda tree: []
    work: Callable[[Scene, tuple[Case, ...], Measured], float | None] = (
        lambda scene, cases, measured: steps_of(cases) / STEPS_PER_CASE
    )
    more_seconds: Callable[[Scene, Measured], float | None] = lambda scene, measured: 0.0
    once: Callable[[Scene, Measured], float] = lambda scene, measured: 0.0
    left_out: Callable[[Scene], dict[str, str]] = lambda scene: {}
    sample: int | None = None
    asked: Callable[[Scene], bool] = lambda scene: False


def steps_of(cases: Iterable[Case]) -> int:
    """Samples of all series together."""
    return sum(case.steps for case in cases)


def kept_share(scene: Scene, measured: Measured) -> float:
    """Share of a series that the reduction leaves, for what the stages after it expect to solve.

    Classes that keep one sample at least make it larger than the one asked for.
    """
    known = measured(scene, "reduction") or {}
    return min(1.0, scene.reduction.size * known.get("samples_over_wanted", 1.0))
