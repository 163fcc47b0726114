"""Commands that know which of their options are stated: none without effect is ignored."""

from __future__ import annotations

from contextvars import ContextVar
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from loadflow.errors import InputError

_CALL: ContextVar[Any] = ContextVar("call")


def _without_types(params: list[Any]) -> list[Any]:
    """Parameters whose help names no type of switches: they take no value."""
    for one in params:
        if getattr(one, "is_flag", False) and one.metavar is None:
            one.metavar = ""
    return params


class Command(TyperCommand):
    """A command that knows which of its options stand on the command line."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Arguments and options, as the help shows them."""
        return _without_types(super().get_params(ctx))

    def invoke(self, ctx: Any) -> Any:
        """Carry the command out."""
        before = _CALL.set(ctx)
        try:
            return super().invoke(ctx)
        finally:
            _CALL.reset(before)


class Commands(TyperGroup):
    """The group of such commands."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Options of the program itself, as the help shows them."""
        return _without_types(super().get_params(ctx))


class App(typer.Typer):
    """An application of such commands."""

    def command(self, *names: Any, **keywords: Any) -> Any:
        """Register a command."""
        return super().command(*names, **{"cls": Command} | keywords)


def stated(*names: str) -> list[str]:
    """Those of some parameters of the command that stand on its command line, as options.

    Parameters
    ----------
    *names : str
        As the function of the command has them.
    """
    call = _CALL.get()
    given = [name for name in names if call.get_parameter_source(name).name == "COMMANDLINE"]
    known = {one.name: one.opts[0] for one in call.command.params}
    return [known[name] for name in given]


def every_but(*names: str) -> list[str]:
    """All parameters of the command but some."""
    return [one.name for one in _CALL.get().command.params if one.name not in names]


def refuse(why: str, *names: str) -> None:
    """Refuse what is stated without effect.

    Parameters
    ----------
    why : str
        What else must be stated, or left out.
    *names : str
        Parameters of the command, as its function has them.

    Raises
    ------
    loadflow.errors.InputError
        Names the options.
    """
    if found := stated(*names):
        raise InputError(f"{', '.join(found)}: no effect here: {why}")
