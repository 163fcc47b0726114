"""How far it is: bars on a terminal, lines where the output goes to a file or a log."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Annotated, Any, get_type_hints

import typer
from rich.markup import escape

from loadflow.cli.base import err
from loadflow.running.telling import TimeLeft

Show = Callable[[str, int, int], None]

Verbose = Annotated[
    bool, typer.Option("--verbose", "-v", help="Show what else a run.log holds, such as each case.")
]

log = logging.getLogger("loadflow.run")

EVERY = 60.0
"""Time between two lines of a stage that goes on, s."""


@contextmanager
def progress(quiet: bool) -> Iterator[Show]:
    """Yield a callback (stage, done, total) that shows how far it is."""
    if quiet:
        yield lambda stage, done, total: None
    elif err.is_terminal:
        with _bars() as show:
            yield show
    else:
        lines = _Lines()
        try:
            yield lines.show
        finally:
            lines.end()


@contextmanager
def _bars() -> Iterator[Show]:
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        ProgressColumn,
        Task,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
    )
    from rich.text import Text

    class Left(ProgressColumn):
        def render(self, task: Task) -> Text:
            return Text(_told(task.fields["left"]), style="progress.remaining")

    columns = [
        TextColumn("{task.description:<12}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        Left(),
    ]
    with Progress(*columns, console=err) as bars:
        tasks: dict[str, tuple[TaskID, TimeLeft]] = {}

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                left = TimeLeft()
                tasks[stage] = bars.add_task(stage, total=total, left=left), left
            task, left = tasks[stage]
            left.show(stage, done, total)
            bars.update(task, completed=done, total=total)

        yield show


class _Lines:
    """A line when a stage begins and ends, and one a minute in between."""

    def __init__(self) -> None:
        self._started = self._told = time.monotonic()
        self._stage, self._done, self._total, self._left = "", 0, 0, TimeLeft()
        self._ended = threading.Event()
        threading.Thread(target=self._tick, daemon=True).start()

    def show(self, stage: str, done: int, total: int) -> None:
        begins = stage != self._stage
        if begins:
            self._stage, self._left = stage, TimeLeft()
        self._left.show(stage, done, total)
        self._done, self._total = done, total
        if begins or done == total:
            self._tell()

    def end(self) -> None:
        self._ended.set()

    def _tick(self) -> None:
        while not self._ended.wait(1.0):
            if self._stage and time.monotonic() - self._told >= EVERY:
                self._tell()

    def _tell(self) -> None:
        now = self._told = time.monotonic()
        left = _told(self._left)
        far = f"{self._done} of {self._total}" if self._total > 1 else ""
        far = far or ("done" if self._done else "…")
        err.print(
            f"{_clock(now - self._started)}  {self._stage}: {far}{left and f', {left}'}",
            soft_wrap=True,
            highlight=False,
        )


def _told(left: TimeLeft) -> str:
    seconds = left.seconds()
    return "" if seconds is None else f"about {_clock(seconds)} left"


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02d}"


@contextmanager
def log_shown(verbose: bool) -> Iterator[None]:
    """Show the warnings of a run as they come; with `verbose` all that its log file holds."""
    handler = _Console(logging.INFO if verbose else logging.WARNING)
    propagates, log.propagate = log.propagate, False
    level = log.level
    log.addHandler(handler)
    log.setLevel(handler.level)
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.setLevel(level)
        log.propagate = propagates


def works_long(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the switch ``-v``, and show what is logged while it works."""
    types = get_type_hints(command, include_extras=True)

    @wraps(command)
    def shown(*, verbose: bool, **given: Any) -> None:
        with log_shown(verbose):
            command(**given)

    own = [
        one.replace(annotation=types[one.name]) for one in signature(command).parameters.values()
    ]
    place = next(k for k, one in enumerate(own) if one.name == "as_json")
    switch = Parameter("verbose", own[place].kind, default=False, annotation=Verbose)
    own.insert(place, switch)
    shown.__signature__ = Signature(own)  # type: ignore[attr-defined]
    shown.__annotations__ = {one.name: one.annotation for one in own}
    del shown.__dict__["__wrapped__"]  # else its signature would be the one of the command
    return shown


class _Console(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        if not getattr(record, "only_logged", False):
            level = "" if record.levelno == logging.INFO else f"{record.levelname.lower()}: "
            err.print(f"{level}{escape(record.getMessage())}", soft_wrap=True, highlight=False)
