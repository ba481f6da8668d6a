"""CacheBackend: answers on disk by the key of their request, so that no question is billed twice.

Each answer is one file, written whole or not at all. Parallel runs on one folder lock each question separately.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from filelock import AsyncFileLock, Timeout
from pydantic import BaseModel, ConfigDict

from scene2hap.common.calls import clear_construction
from scene2hap.common.files import read_small, write_whole
from scene2hap.common.warning import warn_of
from scene2hap.errors import ConfigError, reason_of, unwritable
from scene2hap.llm.answers.finish_reasons import is_whole
from scene2hap.llm.protocol import BackendWarning, Component, LLMReply, LLMRequest
from scene2hap.llm.request_key import request_key
from scene2hap.llm.stack import Spec, Wrapper
from scene2hap.llm.validation import find_fault

PATIENCE_S = 10.0
"""Wait for the lock of another process before a warning [s]; assumed: most answers take less."""


class _Entry(BaseModel):
    """One file of the cache. Nothing else is ever written: no header, no API key, no picture."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    key: str
    identity: dict[str, Any]
    component: Component
    subject: str
    prompt_version: str
    text: str
    model: str
    finish_reason: str
    usage: dict[str, int]


@clear_construction
class CacheBackend(Wrapper):
    """Answer from a folder of stored answers if possible. Otherwise call `inner`, and store the answer if it is valid.

    The key is the key of a recording plus the inner backend's `identity`: model, base address, and other settings that
    affect the answer. A hit reports no usage, since it costs nothing. Equal questions at the same time cause one call,
    in this process and between processes. A file that cannot be read, or whose answer is no longer valid, counts as
    missing and is written again. The system releases the locks of a process that died; their empty files stay in
    `locks/`.
    Raises: ConfigError: the folder cannot be written, or `inner` has no identity.
    """

    def __init__(self, inner: Spec, folder: str | os.PathLike[str]) -> None:
        super().__init__(inner)
        _ = self.identity  # report a missing identity now, not after the scene has been rendered
        self._folder = Path(folder)
        self._turns: dict[tuple[int, str], tuple[asyncio.Lock, int]] = {}
        self._calls = self._hits = self._stored = self._rejected = 0
        self._unreadable: set[str] = set()
        self._has_waited = False
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as cause:
            raise _cannot_write(self._folder, cause) from cause

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the stored answer, or the inner backend's. Raises: ConfigError: cannot write; inner errors."""
        self._calls += 1
        await self.ready()
        key = _key(request, self.identity)
        path = self._path(key)
        async with self._turn(key):
            reply = self._load(path, key)
            if reply is not None:
                return reply
            async with self._lock(key):
                return self._load(path, key) or await self._ask(request)

    def stored(self, request: LLMRequest) -> LLMReply | None:
        """Return the stored answer, None if there is none."""
        key = _key(request, self.identity)
        return self._load(self._path(key), key)

    def report(self) -> dict[str, int]:
        """Return counts: calls, hits, stored answers, invalid answers (not stored), unusable files."""
        return {
            "calls": self._calls,
            "hits": self._hits,
            "stored": self._stored,
            "rejected": self._rejected,
            "unreadable": len(self._unreadable),
        }

    @asynccontextmanager
    async def _turn(self, key: str) -> AsyncIterator[None]:
        """Allow one call at a time per key and event loop. The file lock covers other loops and processes."""
        name = (id(asyncio.get_running_loop()), key)
        lock, users = self._turns.get(name, (asyncio.Lock(), 0))
        self._turns[name] = (lock, users + 1)
        try:
            async with lock:
                yield
        finally:
            lock, users = self._turns.pop(name)
            if users > 1:
                self._turns[name] = (lock, users - 1)

    @asynccontextmanager
    async def _lock(self, key: str) -> AsyncIterator[None]:
        """Allow one call at a time per key among the processes that share the folder."""
        path = self._folder / "locks" / f"{key}.lock"
        lock = AsyncFileLock(path)
        try:
            (self._folder / "locks").mkdir(parents=True, exist_ok=True)
            try:
                await lock.acquire(timeout=PATIENCE_S)
            except Timeout:
                self._warn_of_lock(path)
                await lock.acquire()
        except (OSError, NotImplementedError) as cause:  # NotImplementedError: a file system without locks
            raise ConfigError(
                f"cannot lock an answer in {self._folder}: {reason_of(cause)}. Give a folder that can be written."
            ) from cause
        try:
            yield
        finally:
            await lock.release()

    def _warn_of_lock(self, path: Path) -> None:
        """Warn once that an answer is awaited. Warns: BackendWarning."""
        if not self._has_waited:
            self._has_waited = True
            pid = _holder(path)
            warn_of(
                f"waiting for an answer that another process{f', {pid},' if pid else ''} is getting: it has locked "
                f"{path}. If that process is suspended, continue or end it.",
                BackendWarning,
            )

    def _path(self, key: str) -> Path:
        return self._folder / f"{key}.json"

    async def _ask(self, request: LLMRequest) -> LLMReply:
        reply = await self.inner.complete(request)
        if not is_whole(reply.finish_reason) or find_fault(request.component, reply.text) is not None:
            self._rejected += 1
            return reply
        # Read the identity again: inside a wrapper without `ready`, a backend finds its model only while it answers.
        identity = self.identity
        key = _key(request, identity)
        entry = _Entry(
            key=key,
            identity=identity,
            component=request.component,
            subject=request.subject,
            prompt_version=request.prompt_version,
            text=reply.text,
            model=reply.model,
            finish_reason=reply.finish_reason,
            usage=dict(reply.usage),
        )
        try:
            await asyncio.to_thread(write_whole, self._path(key), entry.model_dump_json(indent=1))
        except OSError as cause:
            raise _cannot_write(self._folder, cause) from cause
        self._stored += 1
        return replace(reply, key=key)

    def _load(self, path: Path, key: str) -> LLMReply | None:
        try:
            entry = _Entry.model_validate_json(read_small(path))
        except FileNotFoundError:
            return None
        except (OSError, ValueError):  # ValueError: a pydantic.ValidationError, or no small regular file
            entry = None
        if entry is None or entry.key != key or find_fault(entry.component, entry.text) is not None:
            self._unreadable.add(key)
            return None
        self._hits += 1
        return LLMReply(entry.text, entry.model, entry.finish_reason, key=key, is_kept=True)


def _holder(path: Path) -> int | None:
    """Return the id of the process that has locked a file, by the list of Linux; None if it is unknown."""
    try:
        inode, rows = path.stat().st_ino, Path("/proc/locks").read_text(encoding="ascii").splitlines()
    except (OSError, ValueError):
        return None
    # 1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF; a row of a waiting process has "->" after its number
    held = [row.split() for row in rows if "->" not in row]
    return next((int(row[4]) for row in held if len(row) > 5 and row[5].endswith(f":{inode}") and row[4] != "-1"), None)


def _key(request: LLMRequest, identity: dict[str, Any]) -> str:
    whole = json.dumps([request_key(request), identity], sort_keys=True)
    return hashlib.sha256(whole.encode()).hexdigest()


def _cannot_write(folder: Path, cause: OSError) -> ConfigError:
    return ConfigError(unwritable(f"the cache {folder}", cause, "Give another folder."))
