"""Run a coroutine from code without an event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any, TypeVar

from scene2hap.errors import CallError

Result = TypeVar("Result")


def run_waiting(awaited: Coroutine[Any, Any, Result], instead: str) -> Result:
    """Run a coroutine and return its result. `instead` is the call that the error recommends to await.

    Raises: CallError: an event loop runs in this thread, as in a notebook, and would be blocked.
    """
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return asyncio.run(awaited)
    awaited.close()
    raise CallError(
        f"an event loop is running (asyncio, or a notebook), and this call would stop it. Write `await {instead}`."
    )
