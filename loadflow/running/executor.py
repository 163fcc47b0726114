"""Where the load cases are worked on: this process, processes of this machine, or a Dask cluster.

No scheduler of our own: cases are independent, so any executor that maps a function will do. A
worker that is lost costs its own cases only.
"""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    CancelledError,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    as_completed,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any, Protocol, TypeVar

from loadflow.errors import InputError, LoadflowError, in_a_line
from loadflow.numerics.collections import few_collections

Item = TypeVar("Item")
Outcome = TypeVar("Outcome")

log = logging.getLogger("loadflow.run")

HOPELESS = 3
"""Workers lost one after another, with nothing finished between them, after which a run ends."""


@dataclass(frozen=True)
class Lost:
    """In place of an outcome: the worker was killed while it was at this item alone."""

    reason: str


class Executor(Protocol):
    """What maps a function over independent items."""

    workers: int
    shares_disk: bool
    """Whether its processes find what one of them compiled."""

    def outcomes(
        self, work: Callable[[Item], Outcome], items: Iterable[Item]
    ) -> Iterator[tuple[Item, Outcome | Lost]]:
        """Yield items and outcomes as they come; what is not begun when one raises is dropped."""
        ...


def usable_cores() -> int:
    """Number of cores that this process may use, on any system."""
    if hasattr(os, "process_cpu_count"):  # from Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):  # Linux only
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _most_processes() -> int:
    """Processes that a pool may have: Windows waits for 63 things at once, of which two are its."""
    return 61 if sys.platform == "win32" else sys.maxsize


@contextmanager
def executor(workers: int, scheduler: str | None) -> Iterator[Executor]:
    """Yield where to work; no process of it is left when the block ends, however it ends.

    Raises
    ------
    loadflow.errors.InputError
        No Dask here, or no scheduler that answers.
    """
    if scheduler is not None:
        with _client(scheduler) as client:
            yield _Cluster(client, scheduler)
    elif workers > 1:
        processes = _Processes(min(workers, _most_processes()))
        try:
            yield processes
        finally:
            processes.kill()
    else:
        yield HERE


class _Here:
    """One item after another in this process."""

    workers = 1
    shares_disk = True

    def outcomes(
        self, work: Callable[[Item], Outcome], items: Iterable[Item]
    ) -> Iterator[tuple[Item, Outcome | Lost]]:
        from loadflow.planning.pilot import in_turn  # with all that a plan needs: late

        return in_turn(work, items)


HERE: Executor = _Here()
"""In this process."""


class _Processes:
    """Processes of this machine; fewer of them after one was killed."""

    shares_disk = True

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._pool: ProcessPoolExecutor | None = None
        # starts the processes: a signal interrupts the main thread only, and a process whose start
        # is cut in two is known to nobody and dies with a traceback
        self._starter = ThreadPoolExecutor(1)
        # at once: each reads its modules for seconds, while a run is being planned
        self._starter.submit(self._submitted, _read_modules, [*range(workers)])

    def outcomes(
        self, work: Callable[[Item], Outcome], items: Iterable[Item]
    ) -> Iterator[tuple[Item, Outcome | Lost]]:
        left = dict(enumerate(items))
        in_a_row = 0
        while left:
            # a single worker gets one item at a time, so that one that kills it is known
            batch = [*left] if self.workers > 1 else [next(iter(left))]
            try:
                for k, outcome in self._finished(work, [left[key] for key in batch]):
                    in_a_row = 0
                    yield left.pop(batch[k]), outcome
            except BrokenProcessPool:
                self.kill()
                in_a_row += 1
                if self.workers > 1:
                    self.workers = max(1, self.workers // 2)
                    log.warning(
                        "a worker process was killed, as systems do that run out of memory; "
                        "%d load cases go on with %d processes",
                        len(left),
                        self.workers,
                    )
                elif in_a_row > HOPELESS:
                    raise LoadflowError(
                        f"{in_a_row} worker processes were killed one after another; is there "
                        "enough memory? Started again, the run goes on where it was"
                    ) from None
                else:
                    yield (
                        left.pop(batch[0]),
                        Lost("its worker process was killed; is memory short?"),
                    )

    def _finished(
        self, work: Callable[[Item], Outcome], items: list[Item]
    ) -> Iterator[tuple[int, Outcome]]:
        numbers = self._starter.submit(self._submitted, work, items).result()
        for future in as_completed(numbers):
            yield numbers[future], future.result()

    def _submitted(
        self, work: Callable[[Item], Outcome], items: list[Item]
    ) -> dict[Future[Outcome], int]:
        if self._pool is None:
            # spawned, not forked: HDF5 and numba hold threads and locks that do not survive a fork
            spawned = get_context("spawn")
            self._pool = ProcessPoolExecutor(
                self.workers,
                spawned,
                initializer=_start_worker,
                initargs=(spawned.Semaphore(max(1, usable_cores() - 1)),),
            )
        if hasattr(signal, "pthread_sigmask"):  # inherited: the keyboard is the parent's from birth
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        return {self._pool.submit(work, item): k for k, item in enumerate(items)}

    def kill(self) -> None:
        """End the processes at once: what they write is whole or not there."""
        self._starter.shutdown(wait=True)
        self._starter = ThreadPoolExecutor(1)
        pool, self._pool = self._pool, None
        if pool is not None:
            _ignore_errors_of(getattr(pool, "_executor_manager_thread", None))
            # public only from Python 3.14 on (kill_workers)
            processes = [*(getattr(pool, "_processes", None) or {}).values()]
            for process in processes:
                process.kill()
            pool.shutdown(wait=False, cancel_futures=True)


def _read_modules(_: int) -> None:
    """What a load case needs; a process that has it reads nothing again."""
    # the process that plans the run keeps a core: all others wait for it
    with _reading, few_collections():
        import loadflow.running.cases  # noqa: F401


def _ignore_errors_of(thread: Thread | None) -> None:
    """Let the thread that looks after a pool trip over processes that are killed, in silence."""
    known = threading.excepthook

    def told(found: threading.ExceptHookArgs) -> None:
        if found.thread is None or found.thread is not thread:
            known(found)

    if thread is not None:
        threading.excepthook = told


_reading: AbstractContextManager[Any] = nullcontext()
"""Held by a process that reads its modules, see `_start_worker`."""


def _start_worker(reading: AbstractContextManager[Any]) -> None:
    """One BLAS thread, as the cases run in parallel; the parent alone answers to the keyboard.

    Its warnings stand between lines of progress, as words. `reading` lets as many processes read
    their modules at a time as there are cores beside that of the parent.
    """
    from threadpoolctl import threadpool_limits

    global _reading
    _reading = reading

    warnings.formatwarning = in_a_line
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threadpool_limits(1)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class _Cluster:
    """A Dask cluster, which has the cases of a lost worker done by another one."""

    shares_disk = False

    def __init__(self, client: Any, address: str) -> None:
        self._client, self._address = client, address
        self.workers = len(client.scheduler_info(n_workers=-1)["workers"])

    def outcomes(
        self, work: Callable[[Item], Outcome], items: Iterable[Item]
    ) -> Iterator[tuple[Item, Outcome | Lost]]:
        from dask.distributed import as_completed as completed
        from distributed import KilledWorker
        from distributed.comm import CommClosedError

        futures = {self._client.submit(work, item, pure=False): item for item in items}
        try:
            for future in completed(futures, loop=self._client.loop):
                try:
                    yield futures[future], future.result()
                except KilledWorker:
                    yield futures[future], Lost("its Dask workers were killed; is memory short?")
        except (CommClosedError, CancelledError, asyncio.CancelledError) as error:
            raise LoadflowError(
                f"lost the Dask scheduler {self._address}; "
                "started again, the run goes on where it was"
            ) from error
        finally:
            with suppress(Exception):  # the scheduler may be gone; nothing of it is waited for
                self._client.cancel(list(futures))


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    try:
        from dask.distributed import Client
    except ImportError as error:
        raise InputError("--scheduler needs the extra dask: pip install loadflow[dask]") from error
    try:
        # not the default: after the run, arrays that others read in pieces are none of its business
        client = Client(scheduler, timeout="10s", set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise InputError(
            f"scheduler = {scheduler!r}: no Dask scheduler answers there; it must be the address "
            "of a running one, tcp://host:port"
        ) from error
    try:
        yield client
    finally:
        with suppress(Exception):
            client.close(timeout=1)
