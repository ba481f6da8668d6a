"""Worker pool: the death of a worker fails only its task, and an interrupted run leaves nothing behind."""

from __future__ import annotations

import asyncio
import contextlib
import multiprocessing
import os
import threading
import time
from typing import Any

from scene2hap.baking.many.pool import Pool
from scene2hap.errors import ConfigError

TASKS = {"deadly": os._exit, "harmless": abs, "slow": time.sleep}


def test_only_tasks_that_kill_their_worker_fail() -> None:
    """Workers die in several tasks while other tasks run or wait."""

    async def everything() -> list[tuple[str, Any]]:
        with Pool("processes:2") as pool:
            # The first argument of each task is its number of threads.
            kinds = [
                "deadly",
                "harmless",
                "slow",
                "harmless",
                "deadly",
                "harmless",
                "harmless",
                "deadly",
                "slow",
                "harmless",
            ]
            tasks = [pool.run(TASKS[kind]) for kind in kinds]
            return list(zip(kinds, await asyncio.gather(*tasks, return_exceptions=True), strict=True))

    for kind, found in asyncio.run(everything()):
        if kind == "deadly":
            assert isinstance(found, ConfigError)
            assert "died" in str(found)
        else:
            assert found is None or found >= 1, (kind, found)


def test_an_interrupted_run_leaves_no_thread_or_process() -> None:
    """A thread of the pool that ends while Python exits may print a traceback."""

    async def interrupted() -> None:
        with Pool("processes:2") as pool:
            tasks = [asyncio.ensure_future(pool.run(time.sleep)) for _ in range(8)]
            await pool.run(abs)
            for task in tasks:
                task.cancel()
            raise KeyboardInterrupt

    before, begun = set(threading.enumerate()), time.monotonic()
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(interrupted())
    assert not [thread.name for thread in threading.enumerate() if thread not in before]
    assert not multiprocessing.active_children()
    assert time.monotonic() - begun < 30.0
