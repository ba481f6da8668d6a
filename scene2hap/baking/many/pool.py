"""Execution of tasks: in this process, in our own worker processes, or on an executor given by the user."""

from __future__ import annotations

import asyncio
import os
import pickle
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from types import TracebackType
from typing import Any, Protocol, TypeVar

from scene2hap.common import checks
from scene2hap.common.worker_processes import begin_workers, end_workers, most_workers
from scene2hap.errors import ConfigError, MissingExtra

Result = TypeVar("Result")

_TRIES = 4
"""Number of attempts alone in a worker before a scene that kills its worker counts as failed."""


class Submits(Protocol):
    """An executor with the interface of `concurrent.futures`; Dask, MPI and Slurm have such executors."""

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Schedule a function. Returns its future."""
        ...


class Pool:
    """Run tasks for coroutines.

    Parameters: executor : None for this process, one task at a time; "processes" or "processes:N" for our own worker
    processes, where a new worker replaces one that dies; "dask:ADDRESS" for a Dask scheduler; or an object with
    `submit`.
    """

    def __init__(self, executor: str | Submits | None) -> None:
        self._own: ProcessPoolExecutor | None = None
        # One worker for tasks that ran when a worker died, since one death breaks the whole pool.
        self._alone: ProcessPoolExecutor | None = None
        self._alone_turn = asyncio.Lock()
        # Not asyncio's own threads, for which its loop waits: a second Ctrl-C ends the program at once.
        self._thread = ThreadPoolExecutor(1, "scene2hap-bake")
        self._close: list[Callable[[], Any]] = [partial(self._thread.shutdown, wait=False, cancel_futures=True)]
        self._turn = asyncio.Semaphore(1)
        self.n_workers: int = 1
        self._given: Submits | None = None
        if isinstance(executor, str):
            kind, _, rest = executor.partition(":")
            if kind == "processes":
                self.n_workers = _n_workers(rest)
                self._own = begin_workers(self.n_workers)
                # A worker runs the program that starts it up to here, unless that is guarded. Python then refuses to
                # start a worker of a worker; later, that worker would wait for the folders that this process locks.
                self._own.submit(os.getpid)
                # Tasks wait here, not in the pool: tasks in a broken pool fail together.
                self._turn = asyncio.Semaphore(self.n_workers)
            elif kind == "dask" and rest:
                self._given = self._of_dask(rest)
            else:
                raise ConfigError(
                    f"executor is {executor!r}; it must be 'processes', 'processes:N', 'dask:ADDRESS', or an object "
                    "with submit(function, *arguments)."
                )
        elif executor is not None:
            if not callable(getattr(executor, "submit", None)):
                raise ConfigError(
                    f"executor is {checks.described(executor)}; it must have submit(function, *arguments), as those of "
                    "concurrent.futures have, or be 'processes' or 'dask:ADDRESS'."
                )
            self._given, self.n_workers = executor, os.cpu_count() or 1

    def __enter__(self) -> Pool:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for pool in (self._own, self._alone):
            if pool is not None:  # running tasks have begun nothing that costs money
                end_workers(pool, at_once=error is not None)
        for close in self._close:
            close()

    async def run(self, task: Callable[..., Result], *args: Any) -> Result:
        """Run a task and return its result. The task gets the number of its threads as first argument.

        A task in this process cannot be stopped: a cancelled caller gets its result, and is cancelled at its next wait.
        If a worker of our own pool dies, all its tasks are repeated one at a time. This finds the task that kills
        workers.

        Raises: errors of the task; ConfigError: a worker dies each time.
        """
        if self._given is not None:
            return await _awaited(self._given.submit(task, 1, *args))
        if self._own is None:
            async with self._turn:
                return await _finished(asyncio.wrap_future(self._thread.submit(task, 0, *args)))
        n_threads = max(1, (os.cpu_count() or 1) // self.n_workers)
        async with self._turn:
            pool = self._own
            try:
                return await _awaited(pool.submit(task, n_threads, *args))
            except BrokenExecutor:
                if self._own is pool:  # only the first of the failed tasks replaces the pool
                    pool.shutdown(wait=False, cancel_futures=True)
                    self._own = begin_workers(self.n_workers)
        async with self._alone_turn:
            return await self._run_alone(task, n_threads, *args)

    async def _run_alone(self, task: Callable[..., Result], n_threads: int, *args: Any) -> Result:
        for _ in range(_TRIES):
            if self._alone is None:
                self._alone = begin_workers(1)
            try:
                return await _awaited(self._alone.submit(task, n_threads, *args))
            except BrokenExecutor:
                self._alone.shutdown(wait=False, cancel_futures=True)
                self._alone = None
        raise ConfigError(
            f"a worker that ran {task.__name__} alone died {_TRIES} times: out of memory, killed, or never started. "
            "Use fewer workers, 'processes:1', or bake this scene alone to see why. Guard a script's entry with "
            '`if __name__ == "__main__":`.'
        )

    def _of_dask(self, address: str) -> Submits:
        try:
            from distributed import Client
        except ImportError as cause:
            raise MissingExtra(
                "'dask' needs distributed, which is not installed. Run: pip install 'scene2hap[dask]'"
            ) from cause
        client = Client(address)
        self._close.append(client.close)
        self.n_workers = max(1, sum(client.nthreads().values()))
        executor: Submits = client.get_executor()
        return executor


async def _finished(made: asyncio.Future[Result]) -> Result:
    """Return the result of a task in a thread, also to a caller that is cancelled meanwhile.

    Otherwise what the task wrote would be unknown to the next run. A second cancellation, as by a second Ctrl-C, ends
    the wait.
    """
    try:
        return await asyncio.shield(made)
    except asyncio.CancelledError:
        if made.cancelled():
            raise
        await asyncio.wait([made])
        if (caller := asyncio.current_task()) is not None:
            caller.cancel()
        return made.result()


async def _awaited(future: Future[Result]) -> Result:
    try:
        return await asyncio.wrap_future(future)
    except (pickle.PicklingError, AttributeError, TypeError) as cause:
        if "pickle" not in str(cause):
            raise
        raise ConfigError(f"a setting cannot be sent to a worker: {cause}. Give it by its kind.") from cause


def _n_workers(text: str) -> int:
    if not text:
        return most_workers(os.cpu_count() or 1)
    if not text.isdecimal() or not 1 <= int(text) <= 256:
        raise ConfigError(f"executor asks for {text!r} processes; it must be a whole number from 1 to 256.")
    return most_workers(int(text))
