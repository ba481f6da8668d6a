"""Where tasks run: in this process, in processes of ours, or on an executor of somebody else's."""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import pickle
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor
from types import TracebackType
from typing import Any, Protocol, TypeVar

from scene2hap import checks
from scene2hap.errors import ConfigError, MissingExtra

Result = TypeVar("Result")

_TRIES = 4
"""How often a task is begun alone in a worker before a scene that kills its worker is given up."""


class Submits(Protocol):
    """An executor as in `concurrent.futures`, such as those of Dask, MPI and Slurm."""

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Run a function elsewhere."""
        ...


class Pool:
    """Runs tasks for coroutines.

    Parameters: executor : None for this process, one task at a time; "processes" or "processes:N" for worker processes
    of ours, of which a new one replaces one that dies; "dask:ADDRESS" for a Dask scheduler; or an object with `submit`.
    """

    def __init__(self, executor: str | Submits | None) -> None:
        self._own: ProcessPoolExecutor | None = None
        # One worker for tasks that ran when a worker died: the death of one breaks the whole pool.
        self._alone: ProcessPoolExecutor | None = None
        self._alone_turn = asyncio.Lock()
        self._close: list[Callable[[], Any]] = []
        self._turn = asyncio.Semaphore(1)
        self.n_workers = 1
        self._given: Submits | None = None
        if isinstance(executor, str):
            kind, _, rest = executor.partition(":")
            if kind == "processes":
                self.n_workers = _n_workers(rest)
                self._own = self._begun(self.n_workers)
                # Tasks wait here: one that waits in a pool fails with it when another task kills its worker.
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
            if pool is not None:
                pool.shutdown(wait=error is None, cancel_futures=True)
        for close in self._close:
            close()

    async def run(self, task: Callable[..., Result], *args: Any) -> Result:
        """Run a task and return its result. The task gets the number of its threads before its arguments.

        One whose worker died is begun again, in our own processes: then alone, so that it is not blamed for another.

        Raises: what the task raises; ConfigError: a worker dies each time.
        """
        if self._given is not None:
            return await _awaited(self._given.submit(task, 1, *args))
        if self._own is None:
            async with self._turn:
                return await asyncio.to_thread(task, 0, *args)
        n_threads = max(1, (os.cpu_count() or 1) // self.n_workers)
        async with self._turn:
            pool = self._own
            try:
                return await _awaited(pool.submit(task, n_threads, *args))
            except BrokenExecutor:
                if self._own is pool:  # the first of all whose worker is gone
                    pool.shutdown(wait=False, cancel_futures=True)
                    self._own = self._begun(self.n_workers)
        async with self._alone_turn:
            return await self._run_alone(task, n_threads, *args)

    async def _run_alone(self, task: Callable[..., Result], n_threads: int, *args: Any) -> Result:
        for _ in range(_TRIES):
            if self._alone is None:
                self._alone = self._begun(1)
            try:
                return await _awaited(self._alone.submit(task, n_threads, *args))
            except BrokenExecutor:
                self._alone.shutdown(wait=False, cancel_futures=True)
                self._alone = None
        raise ConfigError(
            f"a worker that ran {task.__name__} alone died {_TRIES} times: out of memory, or killed. Use fewer "
            "workers, 'processes:1', or bake this scene alone to see why."
        )

    def _begun(self, n_workers: int) -> ProcessPoolExecutor:
        # Threads and locks of this process do not go along, as they would by fork.
        return ProcessPoolExecutor(n_workers, mp_context=multiprocessing.get_context("spawn"))

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


async def _awaited(future: Future[Result]) -> Result:
    try:
        return await asyncio.wrap_future(future)
    except (pickle.PicklingError, AttributeError, TypeError) as cause:
        if "pickle" not in str(cause):
            raise
        raise ConfigError(f"a setting cannot be sent to a worker: {cause}. Give it by its kind.") from cause


def _n_workers(text: str) -> int:
    if not text:
        return os.cpu_count() or 1
    if not text.isdecimal() or not 1 <= int(text) <= 256:
        raise ConfigError(f"executor asks for {text!r} processes; it must be a whole number from 1 to 256.")
    return int(text)
