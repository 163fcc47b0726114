"""Which channels of a file are taken; what is missing is said at once, with what to write."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.readers.aliases import (
    COMPONENTS,
    GAUGE,
    LATERAL,
    OPTIONAL,
    POWER,
    ROOT,
    TIME,
    Aliases,
    Channels,
    Frame,
    read_channels,
)

if TYPE_CHECKING:
    from loadflow.readers.table import Table

FRAMES: Mapping[str, tuple[bool, ...]] = {
    "fixed": (False,),
    "rotating": (True,),
    "auto": (False, True),
}
"""Whether the y and z channels may turn with the rotor, in the order of preference."""


@dataclass(frozen=True)
class Choice:
    """Channels taken from a file.

    Attributes
    ----------
    names : dict of str to str
        By component.
    rotating : bool
        Whether the y and z channels turn with the rotor.
    missing : dict of str to tuple of str
        Components without a channel, and the names looked for.
    spare : tuple of str
        Components that could be left out: optional ones that no user named.
    """

    names: dict[str, str]
    rotating: bool
    missing: dict[str, tuple[str, ...]]
    spare: tuple[str, ...] = ()


def choose(
    table: Table,
    known: Aliases,
    channels: Channels,
    gauge_distance: float | None,
    frame: Frame,
) -> Choice:
    """Choose the channels of a file; parameters as in `loadflow.readers.table.to_series`.

    Raises
    ------
    loadflow.errors.InputError
        Unknown component or frame, a gauge distance that is not a length, or channels that are
        missing, all of them.
    """
    check_one_of("frame", frame, FRAMES)
    if gauge_distance is not None and not abs(gauge_distance) < 100:
        raise InputError(f"gauge_distance = {gauge_distance!r} m: must be between -100 and 100")
    own = read_channels(channels)
    if TIME in own and TIME not in known.fixed:
        raise InputError(f"{table.source}: channels: files of this format say the time themselves")
    allowed = FRAMES[frame]
    if frame == "auto" and any(key in own for key in (*LATERAL, *GAUGE.values())):
        allowed = (False,)  # of channels that a user names, only the user knows the frame
    choices = [_choose(table, known, own, gauge_distance, rotating) for rotating in allowed]
    for choice in choices:
        if not choice.missing:
            return choice
    nearest = min(choices, key=lambda choice: len(choice.missing))
    for names in nearest.missing.values():
        _named(table, names)  # a name that several channels bear is not missing
    raise InputError(_message(table, known, nearest, gauge_distance))


def _choose(
    table: Table,
    known: Aliases,
    own: Mapping[str, tuple[str, ...]],
    gauge_distance: float | None,
    rotating: bool,
) -> Choice:
    looked_for = {**known.fixed, **(known.rotating if rotating else {}), **own}
    keys = (*COMPONENTS, *GAUGE.values(), POWER)
    found = {
        key: _named(table, own[key]) if key in own else _known(table, looked_for.get(key, ()))
        for key in keys
    }
    names = {key: name for key, name in found.items() if name is not None}
    if not set(ROOT) & set(own) and not set(ROOT) <= set(names):
        names = {key: name for key, name in names.items() if key not in ROOT}
    optional = {*OPTIONAL, *GAUGE.values()} - ({"azimuth"} if rotating else set())
    if set(ROOT) & set(own):
        optional -= set(ROOT)
    named = {key for key in own if key not in names}  # what a user names must be there
    needed = [key for key in keys if key not in names and (key not in optional or key in named)]
    if gauge_distance is not None and set(GAUGE.values()) <= set(names):
        needed = [key for key in needed if key not in GAUGE]
        names = {k: name for k, name in names.items() if k not in GAUGE or set(GAUGE) <= set(names)}
    spare = tuple(key for key in names if key in optional and key not in own)
    return Choice(names, rotating, {key: looked_for.get(key, ()) for key in needed}, spare)


def _named(table: Table, names: Sequence[str]) -> str | None:
    """Return the first name of the user's that the file has; several of one name are an error."""
    return next((name for name in names if table.find(name) is not None), None)


def _known(table: Table, names: Sequence[str]) -> str | None:
    """Return the first usual name that one channel of the file has."""
    return next((name for name in names if len(table.columns(name)) == 1), None)


def _message(table: Table, known: Aliases, choice: Choice, gauge_distance: float | None) -> str:
    looked = [
        f"{' or '.join(map(repr, names))} for {key!r}"
        if names
        else f"one for {key!r} (none is named for it)"
        for key, names in choice.missing.items()
    ]
    count = len(looked)
    what = f"channel {looked[0]} is" if count == 1 else f"{count} channels are"
    text = f"{table.source}: {what} missing" + (f": {', '.join(looked)}" if count > 1 else "")
    text += f"; {table.listing()}"
    if set(GAUGE) & set(choice.missing) and gauge_distance is None:
        gauges = [_known(table, known.fixed.get(key, ())) for key in GAUGE.values()]
        turning = [_known(table, known.rotating.get(key, ())) for key in GAUGE.values()]
        names = gauges if all(gauges) else turning
        if all(names):
            text += (
                f". The moments at the apex follow from {names[0]!r} and {names[1]!r} if "
                "gauge_distance is given (m; ShftGagL of ElastoDyn)"
            )
    if known.advice:
        wanted = [names[0] for names in choice.missing.values() if names]
        lines = known.advice.format(lines="\n".join(f'"{name}"' for name in wanted))
        text += f". {lines}" if wanted or "{lines}" not in known.advice else ""
    return text
