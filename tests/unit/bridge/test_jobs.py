"""Bundles of ended bakes: the newest are kept, and older ones are deleted unless a client saved them."""

from __future__ import annotations

import asyncio
import io
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

from scene2hap.bridge import jobs
from scene2hap.bridge.jobs import Jobs
from scene2hap.errors import BridgeError


class EndedProcess:
    """A process that has baked a scene without objects."""

    returncode = 0

    def __init__(self) -> None:
        self.stdin, self.stdout = io.BytesIO(), self._answers()

    async def _answers(self) -> AsyncIterator[bytes]:
        yield b'{"objects": []}'

    async def wait(self) -> int:
        return self.returncode


def test_only_the_newest_bundles_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async def process(*command: str, **settings: Any) -> EndedProcess:
        return EndedProcess()

    monkeypatch.setattr(jobs, "N_KEPT", 2)
    monkeypatch.setattr(asyncio, "create_subprocess_exec", process)

    async def bake(server: Jobs, target: Path | None) -> int:
        ended = asyncio.Event()
        wanted = {"scene": str(tmp_path / "scene.json"), "pictures": None}
        job = server.start(wanted, target, lambda document: ended.set())
        (target or server.folder / f"job-{job}.bundle").mkdir()
        await ended.wait()
        return job

    async def scenario() -> None:
        server, saved = Jobs(), tmp_path / "saved.bundle"
        try:
            first = await bake(server, saved)
            second = await bake(server, None)
            forgotten = server.bundle(second)
            kept = [await bake(server, None), await bake(server, None)]
            assert all(server.bundle(job).is_dir() for job in kept)
            for job in (first, second):
                with pytest.raises(BridgeError, match=f"no job {job} with a bundle; bake again"):
                    server.bundle(job)
            assert not forgotten.exists()
            assert saved.is_dir()
        finally:
            await server.close()

    asyncio.run(scenario())
