"""Laws and models of the film in a scene: whatever their registries know."""

from __future__ import annotations

from dataclasses import MISSING, asdict, fields
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, PlainSerializer, PlainValidator

from loadflow.errors import InputError
from loadflow.journal.cavitation import LAWS, CavitationLaw, GasMixture
from loadflow.journal.heat import FilmHeat, Heat
from loadflow.journal.rungs import check_rung
from loadflow.scene.section import told_apart


def law_of(value: Any) -> CavitationLaw:
    """Return a law of cavitation from a table ``{kind = …, …}``, or from its kind alone.

    A table without a kind is a gas mixture.

    Raises
    ------
    loadflow.errors.InputError
        An unknown kind, an unknown or missing parameter, or a bad value; names what there is.
    """
    if isinstance(value, CavitationLaw):
        return value
    if not isinstance(value, str | dict):
        raise InputError(f"{value!r:.200} is not allowed: a kind, or a table of it")
    table = {"kind": value} if isinstance(value, str) else dict(value)
    kind = table.pop("kind", GasMixture.kind)
    if not isinstance(kind, str) or kind not in LAWS:
        raise InputError(f"kind = {kind!r} is not allowed: {' or '.join(LAWS)}")
    parts = fields(LAWS[kind])
    known = [part.name for part in parts]
    for name in table:
        if name not in known:
            raise InputError(f"{name}: unknown key; known here: {', '.join(['kind', *known])}")
    for part in parts:
        if part.default is MISSING and part.name not in table:
            raise InputError(f"{part.name}: this key is missing")
    for name, number in table.items():
        if isinstance(number, bool) or not isinstance(number, int | float):
            raise InputError(f"{name} = {number!r} is not allowed: a number")
    return LAWS[kind](**table)


def table_of(law: CavitationLaw) -> dict[str, Any]:
    """Return the table that `law_of` reads."""
    return {"kind": law.kind} | asdict(law)


def _known_rung(name: str) -> str:
    check_rung(name)
    return name


Law = Annotated[CavitationLaw, PlainValidator(law_of), PlainSerializer(table_of)]
RungName = Annotated[str, AfterValidator(_known_rung)]

HEATS = {"balance": Heat, "film": FilmHeat}
"""Models of the heat of a film by their ``kind``."""


if TYPE_CHECKING:
    HeatTable = Heat | FilmHeat
else:
    HeatTable = told_apart(HEATS, usual="balance")
"""Heat of a film; ``kind`` says which, the balance if nothing is said."""
