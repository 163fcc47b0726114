"""What scenes may name: each list is a function of its heads and rows."""

from __future__ import annotations

import re
from collections.abc import Callable

from loadflow.errors import InputError
from loadflow.numerics.fields import none_such
from loadflow.quantities import CELSIUS

Row = tuple[str, ...]
Rows = tuple[Row, list[Row]]


def turbines() -> Rows:
    """Turbines, for turbine.name."""
    from loadflow.turbines import load_turbine, turbine_names

    rows: list[Row] = []
    for name in turbine_names():
        machine = load_turbine(name)
        diameter = f"{2 * machine.rotor.radius:.4g} m"
        winds = f"{machine.cut_in:g} … {machine.cut_out:g} m/s"
        rows.append((name, f"{machine.rated_power / 1e6:.3g} MW", diameter, winds, machine.source))
    return ("name", "power", "rotor", "runs", "source"), rows


def oils() -> Rows:
    """Oils and greases, for friction.lubricant."""
    from loadflow.tribology import lubricant, lubricant_names

    rows: list[Row] = []
    for name in lubricant_names():
        oil = lubricant(name)
        at = (oil.viscosity(celsius + CELSIUS) for celsius in (40.0, 70.0))
        told = (f"{1e3 * float(viscosity):.4g} mPa s" for viscosity in at)
        rows.append((name, *told, oil.source))
    return ("name", "at 40 °C", "at 70 °C", "source"), rows


def friction_pairs() -> Rows:
    """Materials of shaft and shell, for journal.contact.friction."""
    from loadflow.tribology import friction_pair, friction_pair_names

    pairs = [friction_pair(name) for name in friction_pair_names()]
    rows: list[Row] = [(one.name, f"{one.boundary_coefficient:g}", one.source) for one in pairs]
    return ("name", "friction coefficient", "source"), rows


def bearings() -> Rows:
    """Kinds of bearing, arrangements for rolling.arrangement, sized candidates of each turbine."""
    from loadflow.journal import ConicalPair, JournalBearing
    from loadflow.rolling.bearings.arrangements import ARRANGEMENTS, main_bearings
    from loadflow.scene.candidates import candidates_of, machine_names
    from loadflow.scene.places import GEOMETRIES, PLACE_KINDS
    from loadflow.scene.thrust import ThrustCollar

    films = (JournalBearing, ThrustCollar, ConicalPair)
    known = dict(zip(PLACE_KINDS, films)) | GEOMETRIES
    rows: list[Row] = [("kind", kind, _first_line(known[kind]), "") for kind in PLACE_KINDS]
    for name in ARRANGEMENTS:
        parts = main_bearings(name).items()
        told = ", ".join(f"{place}: {bearing.kind}" for place, bearing in parts)
        rows.append(("rolling.arrangement", name, told, "assumed, for 5 MW"))
    for turbine in machine_names():
        for name, one in candidates_of(turbine).items():
            rows.append((turbine, name, one.get("title", ""), one.get("source", "")))
    return ("kind or turbine", "name", "what it is", "source"), rows


def rungs() -> Rows:
    """Models of each stage, with their measured time and error."""
    from loadflow.planning.ladder import ladder

    rows: list[Row] = [
        (stage, rung, f"{entry['relative_time']:.2g}", entry["error"])
        for stage, found in ladder().items()
        for rung, entry in found.items()
    ]
    return ("stage", "model", "relative time", "error"), rows


def effects() -> Rows:
    """Effects that a plan includes or leaves out, with what a scene must say for them."""
    from loadflow.stages.effects.registry import EFFECTS

    rows: list[Row] = [
        (one.name, one.model, ", ".join(one.keys), one.known_by_words, one.needs) for one in EFFECTS
    ]
    return ("effect", "model", "keys", "known by rungs", "needs"), rows


def load_cases() -> Rows:
    """Design load cases of IEC 61400-1, for loads.dlc."""
    from loadflow.wind.cases import LOAD_CASES

    rows: list[Row] = [
        (dlc, ", ".join(row.events), "ultimate" if row.kind == "U" else "fatigue")
        for dlc, row in LOAD_CASES.items()
    ]
    return ("load case", "events", "loads"), rows


def results() -> Rows:
    """Results, for results."""
    from loadflow.scene.results import BY_NAME, RESULTS

    rows: list[Row] = [
        (name, told, "where it is named" if name in BY_NAME else "by default")
        for name, told in RESULTS.items()
    ]
    return ("result", "what it is", "computed"), rows


def _first_line(kind: type) -> str:
    return (kind.__doc__ or "").strip().splitlines()[0]


def scenes() -> Rows:
    """Scenes to begin with, for loadflow init."""
    from loadflow.scene.templates import templates

    return ("template", "what it is"), list(templates().items())


LISTS: dict[str, Callable[[], Rows]] = {
    "turbines": turbines,
    "oils": oils,
    "friction-pairs": friction_pairs,
    "bearings": bearings,
    "rungs": rungs,
    "effects": effects,
    "load-cases": load_cases,
    "results": results,
    "scenes": scenes,
}
"""Every list by its name on the command line."""


def rows_of(what: str, only: str | None) -> Rows:
    """Heads and rows of a list, of one turbine, stage or name alone if `only` says so.

    Parameters
    ----------
    what : str
        Name of the list.
    only : str, optional
        What the first column must have.

    Raises
    ------
    loadflow.errors.InputError
        There is no such list, or it has no such rows.
    """
    if what not in LISTS:
        raise InputError(none_such("list", [what], LISTS))
    heads, rows = LISTS[what]()
    if only is None:
        return heads, rows
    found = [row for row in rows if row[0] == only]
    if not found:
        known = dict.fromkeys(row[0] for row in rows)
        raise InputError(f"list {what}: {none_such(heads[0], [only], known)}")
    return heads, found


def with_notes(heads: Row, rows: list[Row]) -> tuple[list[Row], list[str]]:
    """Rows whose last column, where sources of several are the same, has numbers; and what of.

    Examples
    --------
    >>> with_notes(("name", "source"), [("a", "Sized. Here."), ("b", "Sized."), ("c", "")])
    ([('a', '1, 2'), ('b', '1'), ('c', '')], ['1  Sized.', '2  Here.'])
    >>> with_notes(("name", "source"), [("a", "Sized.")])
    ([('a', 'Sized.')], [])
    """
    sentences = [re.split(r"(?<=\.) (?=[A-Z])", row[-1]) if row[-1] else [] for row in rows]
    every = [sentence for told in sentences for sentence in told]
    number = {sentence: str(k) for k, sentence in enumerate(dict.fromkeys(every), start=1)}
    if heads[-1] != "source" or len(number) == len(every):
        return rows, []
    short = [
        (*row[:-1], ", ".join(number[one] for one in told)) for row, told in zip(rows, sentences)
    ]
    return short, [f"{k}  {sentence}" for sentence, k in number.items()]
