"""What is short of the accuracy that is asked for, in words: by how much, why, what would help."""

from __future__ import annotations

import numpy as np
import xarray as xr

from loadflow.planning.accuracy import Part, contributions
from loadflow.planning.choice import Choice
from loadflow.planning.effects import switched
from loadflow.planning.ladder import choices
from loadflow.quantities import percent
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect
from loadflow.stages.effects.registry import effect_named
from loadflow.stages.registry import giving, models
from loadflow.stages.stage import Rungs


def shortfalls(wanted: Scene, choice: Choice) -> list[str]:
    """Say of each answer that is not expected to hold the accuracy how far off it is, and why.

    Parameters
    ----------
    wanted : Scene
        As the user wrote it.
    choice : Choice
        What was chosen.

    Returns
    -------
    list of str
        A sentence for each result: its worst quantity, what adds most, what would help.
    """
    said = []
    for result, errors in choice.errors.items():
        allowed = wanted.allowed(result)
        links = giving(result).results[result](choice.scene)
        parts = {
            quantity: [*contributions(choice.scene, result, quantity, of, choice.estimates)]
            for quantity, of in links.items()
        }
        missing = [quantity for quantity, error in errors.items() if error is None]
        known = {name: sum(part.share or 0.0 for part in of) for name, of in parts.items()}
        over = {name: share for name, share in known.items() if share > allowed}
        if missing:
            unknown = next(part for part in parts[missing[0]] if part.share is None)
            said.append(
                f"{result}: {', '.join(missing)} not known to hold: "
                f"{_unknown_in_words(wanted, choice, unknown)}"
            )
        if over:
            worst = max(over, key=over.__getitem__)
            most = max(parts[worst], key=lambda part: part.share or 0.0)
            sizes = ", ".join(f"{name} by up to {percent(e)}" for name, e in over.items())
            off = "off, by what is known," if {*over} & {*missing} else "off"
            said.append(
                f"{result}: {off} in {sizes}, {_asked(wanted, allowed)}; most of it "
                f"({percent(most.share or 0.0)}): {_in_words(wanted, choice, most)}"
            )
    return said


def found_shortfalls(wanted: Scene, ran: Scene, check: xr.Dataset) -> list[str]:
    """Say of each result that a finished run found farther off than asked for how far, and why.

    Parameters
    ----------
    wanted : Scene
        As the user wrote it.
    ran : Scene
        With the models that the run had.
    check : xarray.Dataset
        What the check at the end of the run found, see `loadflow.planning.verification`.

    Returns
    -------
    list of str
        A sentence for each result: its quantities that are off, beside which better model and in
        which load case the worst of them, what would help, that first which helps most. Empty where
        no accuracy is asked for.
    """
    beyond = check.isel(check=(check["difference"] > check["allowed"]).values)
    beyond = beyond.isel(check=np.argsort(-beyond["difference"].values, kind="stable"))
    said = []
    for result in dict.fromkeys(beyond["result"].values.tolist()):
        rows = beyond.isel(check=(beyond["result"] == result).values)
        worst = rows.isel(check=0)
        sizes: dict[str, float] = {}
        for quantity, error in zip(rows["quantity"].values.tolist(), rows["difference"].values):
            sizes.setdefault(quantity, float(error))
        off = ", ".join(f"{name} by {_size(error)}" for name, error in sizes.items())
        helps = [_help(wanted, ran, name) for name in rows["stage"].values.tolist()]
        said.append(
            f"{result}: the check found it off in {off}, {_asked(wanted, wanted.allowed(result))}; "
            f"most beside {worst['against'].item()} ({worst['case'].item()}); "
            f"what would help: {'; '.join(dict.fromkeys(helps))}"
        )
    return said


def _size(error: float) -> str:
    return percent(error) if np.isfinite(error) else "all of it, as one film alone was found"


def _help(wanted: Scene, ran: Scene, name: str) -> str:
    """What would help against a model, or an effect left out, of that name."""
    effect = effect_named(name)
    if effect is not None:
        return _on_in_words(wanted, ran, effect)
    # a finer one is not taken where what cannot be helped is larger
    finer = models()[name].finer(ran) if len(choices(wanted, models()[name])) > 1 else None
    return _finer_in_words(wanted, models()[name]) if finer is None else _rung_in_words(finer, name)


def _unknown_in_words(wanted: Scene, choice: Choice, part: Part) -> str:
    if part.effect is None:
        return f"{_rung_in_words(choice.scene, part.model)} was not measured"
    why = part.effect.untold or "how large it is was not measured"
    return f"{_in_words(wanted, choice, part)}; {why}"


def _asked(wanted: Scene, allowed: float) -> str:
    return f"asked for {percent(allowed)}" if allowed < float("inf") else "nothing asked"


def _in_words(wanted: Scene, choice: Choice, part: Part) -> str:
    effect = part.effect
    if effect is None:
        help_ = _finer_in_words(wanted, models()[part.model])
        return f"{_rung_in_words(choice.scene, part.model)}; what would help: {help_}"
    if refused := choice.estimates.refused(effect):
        return f"{effect.name} left out, as it failed on cases of this scene: {refused}"
    help_ = _on_in_words(wanted, choice.scene, effect)
    return f"{effect.name} left out; what would help: {help_}"


def _on_in_words(wanted: Scene, ran: Scene, effect: Effect) -> str:
    """What an effect needs to be on: no more than the plan's leave, where its key alone bars it."""
    named = [key for key in effect.keys if not _leaves(wanted, key)]
    # where keys say more than that (a beam, beside what it rests on) they are not to be left out
    if not named or effect.stated is not None or switched(ran, effect, True) is None:
        return effect.needs
    return f"leave {' and '.join(named)} to the plan"


def _leaves(scene: Scene, key: str) -> bool:
    """Whether a scene says nothing of ``section.key``."""
    section, name = key.split(".")
    return name not in getattr(scene, section).model_fields_set


def _finer_in_words(wanted: Scene, rungs: Rungs) -> str:
    """What would help against the error of a rung."""
    held = len(choices(wanted, rungs)) == 1
    return f"leave {rungs.section} to the plan" if held else "nothing, no finer model was measured"


def _rung_in_words(scene: Scene, model: str) -> str:
    return f"{model} as {models()[model].text_of(scene)}"
