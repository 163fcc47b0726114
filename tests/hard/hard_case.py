"""What a hard case is, and how it is run: the same for the tests and for docs/hard-cases.md."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from loadflow.errors import InputError, SolverError


@dataclass(frozen=True)
class Outcome:
    """What came of a case.

    Attributes
    ----------
    result : str
        The answer in a few words, with numbers; or the error that names what is wrong.
    residual, iterations : float, int or None
        The worst of the case; None where nothing iterates.
    """

    result: str
    residual: float | None = None
    iterations: int | None = None


@dataclass(frozen=True)
class HardCase:
    """A case that solvers usually fail on.

    Attributes
    ----------
    room, name : str
        Whose it is, and what it is.
    why, what : str
        Why it is hard, and what we do about it.
    solve : callable
        Solves it, asserts what must hold of the answer, and gives the outcome.
    tolerance : float
        Largest residual allowed.
    """

    room: str
    name: str
    why: str
    what: str
    solve: Callable[[], Outcome] = field(repr=False)
    tolerance: float = 1e-8

    def __str__(self) -> str:
        return f"{self.room}: {self.name}"


CASES: list[HardCase] = []


def hard(room: str, name: str, **about: Any) -> Callable[[Callable[[], Outcome]], None]:
    """Enter the decorated function into `CASES`."""

    def enter(solve: Callable[[], Outcome]) -> None:
        CASES.append(HardCase(room, name, solve=solve, **about))

    return enter


def solved(answer: Any, text: str) -> Outcome:
    """Outcome of an array of solutions that must all have converged."""
    import numpy as np

    assert np.all(answer.converged)
    residual, iterations = np.max(answer.residual), np.max(answer.iterations)
    return Outcome(text, float(residual), int(iterations))


def refused(work: Callable[[], Any], *words: str) -> Outcome:
    """Outcome of a case that has no answer: an error that names each of `words`."""
    try:
        work()
    except (InputError, SolverError) as error:
        text = str(error)
        assert all(word in text for word in words), text
        return Outcome(f"{type(error).__name__}: {text}")
    raise AssertionError("an answer where there is none")
