"""A cancelled inference, as by Ctrl-C: running calls end first, and none begins."""

import asyncio
from pathlib import Path
from typing import ClassVar

import pytest

from scene2hap import CacheBackend, LLMReply, LLMRequest
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.protocol import BackendWarning
from scripted_backend import SCENE, Scripted


class Held(Scripted):
    """Answers only once `released` is set. `begun` counts its calls."""

    identity: ClassVar = {"model": "held"}

    def __init__(self) -> None:
        super().__init__()
        self.released = asyncio.Event()
        self.begun = 0

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.begun += 1
        await self.released.wait()
        return await super().complete(request)


async def cancelled_while_held(inner: Held, folder: Path, *, again: bool = False) -> None:
    """Cancel an inference while calls run. Release the calls, or cancel once more."""
    backend = CacheBackend(inner, folder)
    running = asyncio.ensure_future(infer_scene(SCENE, backend, scene_category="study", config={"concurrency": 2}))
    while inner.begun < 2:
        await asyncio.sleep(0.001)
    running.cancel()
    await asyncio.sleep(0.01)
    assert not running.done()
    if again:
        running.cancel()
    else:
        inner.released.set()
    with pytest.raises(asyncio.CancelledError):
        await asyncio.wait_for(asyncio.shield(running), 60.0)


def test_a_cancelled_inference_keeps_the_answers_that_are_paid_for_and_asks_no_more(tmp_path: Path) -> None:
    inner = Held()
    with pytest.warns(BackendWarning, match="stopping: 2 questions"):
        asyncio.run(cancelled_while_held(inner, tmp_path))
    assert inner.begun == 2
    assert len(list(tmp_path.glob("*.json"))) == 2


def test_a_second_cancellation_ends_running_calls(tmp_path: Path) -> None:
    inner = Held()
    with pytest.warns(BackendWarning, match="Interrupt again"):
        asyncio.run(cancelled_while_held(inner, tmp_path, again=True))
    assert list(tmp_path.glob("*.json")) == []
