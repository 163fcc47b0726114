"""What a run tells of its progress beside counts: how long the rest will take."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from heapq import heapreplace
from typing import Self


class Task(str):
    """Name of what is being done; knows how long the rest of it is expected to take.

    A text as any other to those who only count, so that jobs of unequal size may be counted too.

    Attributes
    ----------
    left : float
        Expected time of what is left, s, before the run itself has shown how fast it is.

    Examples
    --------
    >>> from loadflow.running.telling import Task
    >>> task = Task("load cases", 120.0)
    >>> str(task), task.left
    ('load cases', 120.0)
    """

    left: float

    def __new__(cls, name: str, left: float) -> Self:
        """Name a task of which `left` seconds are to come."""
        task = super().__new__(cls, name)
        task.left = left
        return task


def times_left(seconds: Sequence[float], workers: int) -> list[float]:
    """Time left before any of the jobs is done, after the first that is, and so on; s.

    Parameters
    ----------
    seconds : sequence of float
        Of each job, in the order in which they are begun.
    workers : int
        Each takes the next job when it is free.

    Examples
    --------
    >>> from loadflow.running.telling import times_left
    >>> times_left([25.0, 40.0, 20.0], workers=2)
    [45.0, 20.0, 5.0, 0.0]
    """
    free = [0.0] * workers
    ends = [heapreplace(free, free[0] + job) + job for job in seconds]
    return [max(ends, default=0.0) - end for end in (0.0, *sorted(ends))]


class TimeLeft:
    """How long a task will still take: as expected at first, then as fast as it has been.

    Parameters
    ----------
    clock : callable
        Seconds of a clock that never goes back.

    Examples
    --------
    >>> from loadflow.running.telling import Task, TimeLeft
    >>> times = iter([0.0, 0.0, 10.0, 30.0, 32.0])
    >>> left = TimeLeft(lambda: next(times))
    >>> left.show(Task("load cases", 100.0), 0, 2)
    >>> left.seconds()  # after 10 s, as expected
    90.0
    >>> left.show(Task("load cases", 40.0), 1, 2)
    >>> left.seconds()  # 60 of 100 s took 30 s
    18.0
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._begun = self._last = clock()
        self._first: float | None = None
        self._rest, self._known = 0.0, False

    def show(self, stage: str, done: int, total: int) -> None:
        """Take note of how far it is."""
        self._last = self._clock()
        self._known = isinstance(stage, Task)
        self._rest = stage.left if isinstance(stage, Task) else float(total - done)
        if self._first is None:
            self._first = self._rest

    def seconds(self) -> float | None:
        """Time left, s; None where nothing tells it, or what was expected has passed."""
        if self._first is None or self._rest <= 0.0:
            return None
        if self._rest < self._first:
            pace = (self._last - self._begun) / (self._first - self._rest)
        elif self._known:
            pace = 1.0
        else:
            return None
        left = pace * self._rest - (self._clock() - self._last)
        return left if left > 0.0 else None
