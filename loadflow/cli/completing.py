"""Names that a shell completes: of turbines, oils, candidates, scenes, lists, tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable

Complete = Callable[[str], list[str]]


def _starting(known: Callable[[], Iterable[str]]) -> Complete:
    """What a shell asks for: the known names that begin as what is typed."""

    def complete(incomplete: str) -> list[str]:
        return [name for name in known() if name.startswith(incomplete)]

    return complete


def _turbines() -> Iterable[str]:
    from loadflow.turbines import turbine_names

    return turbine_names()


def _oils() -> Iterable[str]:
    from loadflow.tribology import lubricant_names

    return lubricant_names()


def _candidates() -> Iterable[str]:
    """Those that are sized for any turbine, as a scene may be of any."""
    from loadflow.scene.candidates import candidates_of, machine_names

    return dict.fromkeys(name for one in machine_names() for name in candidates_of(one))


def _templates() -> Iterable[str]:
    from loadflow.scene.templates import templates

    return templates()


def _lists() -> Iterable[str]:
    from loadflow.cli.lists import LISTS

    return LISTS


def _tables() -> Iterable[str]:
    from loadflow import validation

    return validation.names()


turbines = _starting(_turbines)
oils = _starting(_oils)
candidates = _starting(_candidates)
templates = _starting(_templates)
lists = _starting(_lists)
tables = _starting(_tables)
