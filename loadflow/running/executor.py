"""Where the load cases are worked on: this process, processes of this machine, or a Dask cluster.

No scheduler of our own: cases are independent, so any executor that maps a function will do.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context
from typing import Any, TypeVar

from loadflow.errors import InputError

Item = TypeVar("Item")
Outcome = TypeVar("Outcome")
Submit = Callable[..., Any]


@contextmanager
def executor(workers: int, scheduler: str | None) -> Iterator[Submit | None]:
    """Yield what takes a function and an item and gives a future; None to work in this process."""
    if scheduler is not None:
        try:
            from dask.distributed import Client
        except ImportError as error:
            raise InputError(
                "--scheduler needs the extra dask: pip install loadflow[dask]"
            ) from error
        with Client(scheduler) as client:
            yield partial(client.submit, pure=False)
    elif workers > 1:
        # spawned, not forked: HDF5 and numba hold threads and locks that do not survive a fork
        context = get_context("spawn")
        with ProcessPoolExecutor(workers, context, initializer=_one_thread) as pool:
            yield pool.submit
    else:
        yield None


def processes() -> int:
    """Cores that this process may use."""
    if hasattr(os, "process_cpu_count"):  # from Python 3.13
        return os.process_cpu_count() or 1
    if hasattr(os, "sched_getaffinity"):  # Linux only
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _one_thread() -> None:
    """Keep BLAS to one thread in a worker: the cases are what runs in parallel."""
    from threadpoolctl import threadpool_limits

    threadpool_limits(1)


def finished(
    submit: Submit | None, work: Callable[[Item], Outcome], items: Iterable[Item]
) -> Iterator[Outcome]:
    """Yield the outcomes as they come; what is not begun when one raises is dropped."""
    if submit is None:
        yield from map(work, items)
        return
    futures: list[Future[Outcome]] = [submit(work, item) for item in items]
    completed = as_completed if all(isinstance(f, Future) for f in futures) else _dask_completed
    try:
        for future in completed(futures):
            yield future.result()
    finally:
        for future in futures:
            future.cancel()


def _dask_completed(futures: list[Any]) -> Iterator[Any]:
    from dask.distributed import as_completed as completed

    yield from completed(futures)
