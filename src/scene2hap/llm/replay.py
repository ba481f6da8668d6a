"""Recorded answers: a model's replies kept as JSON lines, so that an inference can be run again without it.

Each line is one answer with the facts that it answers to. Only what is listed in `_Entry` is ever written: no header,
no key, no address, and of pictures only their digest within the key.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import os
import threading
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from pydantic import BaseModel, ConfigDict, ValidationError

from scene2hap.errors import BackendError, BadAnswer, ConfigError, ReplayMiss
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest

_HASHED_ONLY = "prompt, answer_schema, temperature or images (of these only the key tells)"


class _Entry(BaseModel):
    """One line of a recording."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    key: str
    component: str
    subject: str
    prompt_version: str
    facts: dict[str, Any]
    text: str
    model: str
    finish_reason: str
    usage: dict[str, int]


class ReplayBackend:
    """Answers from a recording and nothing else. Of several answers to one request the last one counts.

    Raises: ConfigError: the file cannot be read. BadAnswer: a line is broken; names file and line.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path)
        self._entries = {entry.key: entry for entry in _read(self._path)}
        self._played: set[str] = set()

    @property
    def unused(self) -> tuple[str, ...]:
        """Keys of recorded answers that nobody has asked for yet."""
        return tuple(key for key in self._entries if key not in self._played)

    async def complete(self, request: LLMRequest) -> LLMReply:
        """The recorded answer. Raises: ReplayMiss: there is none; names the nearest and what differs."""
        key = request_key(request)
        entry = self._entries.get(key)
        if entry is None:
            raise ReplayMiss(self._miss(request, key), key)
        self._played.add(key)
        return LLMReply(entry.text, entry.model, entry.finish_reason, entry.usage, key, is_kept=True)

    def _miss(self, request: LLMRequest, key: str) -> str:
        asked = f"{request.component} about {request.subject or 'the scene'!r}"
        missing = f"{self._path} has no answer for {asked} (key {key})."
        differences = [
            (_differing(entry, request), entry)
            for entry in self._entries.values()
            if entry.component == request.component
        ]
        if not differences:
            return f"{missing} It has none for this component at all. Record it with RecordingBackend."
        fields, nearest = min(differences, key=lambda pair: (len(pair[0]), pair[1].subject != request.subject))
        return (
            f"{missing} Nearest is the answer about {nearest.subject or 'the scene'!r} (key {nearest.key}), where "
            f"{', '.join(fields) or _HASHED_ONLY} differ. Record it again with RecordingBackend."
        )


class RecordingBackend:
    """Passes requests on to `inner` and appends each answer to a file, on disk before it is handed back.

    Raises: ConfigError: the file cannot be written. BadAnswer: it exists and has a broken line.
    """

    def __init__(self, inner: LLMBackend, path: str | os.PathLike[str]) -> None:
        self.inner = inner
        self._path = Path(path)
        self._turn = threading.Lock()
        try:
            self._path.open("ab").close()
        except OSError as cause:
            raise _cannot_write(self._path, cause) from cause
        _read(self._path)

    @property
    def identity(self) -> Mapping[str, Any]:
        """What decides the answer besides the request: the inner backend's. Raises: ConfigError: it does not tell."""
        identity = getattr(self.inner, "identity", None)
        if not isinstance(identity, Mapping):
            raise ConfigError(f"{self.inner!r} has no `identity` (model, address); no cache can tell it apart.")
        return identity

    async def ready(self) -> None:
        """Let the inner backend find out what it needs before its `identity` is whole. Raises: as that does."""
        ready = getattr(self.inner, "ready", None)
        if ready is not None:
            await ready()

    async def complete(self, request: LLMRequest) -> LLMReply:
        """The inner backend's answer, recorded."""
        key = request_key(request)  # before the call: what cannot be recorded should not be paid for
        reply = await self.inner.complete(request)
        entry = _Entry(
            key=key,
            component=request.component,
            subject=request.subject,
            prompt_version=request.prompt_version,
            facts=_plain(request.facts),
            text=reply.text,
            model=reply.model,
            finish_reason=reply.finish_reason,
            usage=dict(reply.usage),
        )
        await asyncio.to_thread(self._append, _canonical(entry.model_dump()).encode() + b"\n")
        return replace(reply, key=key)

    def _append(self, line: bytes) -> None:
        try:
            with self._turn, self._path.open("ab+") as file:
                if file.seek(0, os.SEEK_END) and not _ends_in_newline(file):
                    line = b"\n" + line  # somebody edited the file
                file.write(line)
                file.flush()
                os.fsync(file.fileno())
        except OSError as cause:
            raise _cannot_write(self._path, cause) from cause


def request_key(request: LLMRequest) -> str:
    """A name for everything in a request that decides its answer: "v1:" and a SHA-256.

    Subject and prompt version are left out: the same question about another object has the same answer, and a new
    version that asks the same words does too.
    Raises: BackendError: a fact has no JSON (an infinity, an object of Python).
    """
    content = {
        "component": request.component,
        "prompt": request.prompt,
        "facts": request.facts,
        "answer_schema": request.answer_schema,
        "temperature": request.temperature,
        "images": [{"sha256": hashlib.sha256(png).hexdigest(), "type": "image/png"} for png in request.images],
    }
    return f"v1:{hashlib.sha256(_canonical(content).encode()).hexdigest()}"


def _canonical(value: Any) -> str:
    """The one JSON text of a value: sorted keys, no spaces, whole floats as integers (1.0 and 1 are one number)."""
    try:
        text = json.dumps(_plain(value), sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        text.encode()
    except (TypeError, ValueError) as cause:
        raise BackendError(
            f"no JSON for this request: {cause}. Use texts, finite numbers, lists and objects."
        ) from cause
    return text


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return value


def _read(path: Path) -> list[_Entry]:
    try:
        content = path.read_bytes()
    except OSError as cause:
        raise ConfigError(f"cannot read the recording {path}: {cause}. Make one with RecordingBackend.") from cause
    return list(_entries(path, content))


def _entries(path: Path, content: bytes) -> Iterator[_Entry]:
    for number, line in enumerate(content.split(b"\n"), start=1):
        if not line.strip():
            continue
        try:
            yield _Entry.model_validate_json(line)
        except ValidationError as cause:
            problem = cause.errors()[0]
            place = ".".join(str(part) for part in problem["loc"]) or "(whole line)"
            raise BadAnswer(
                f"{path}, line {number}: {place}: {problem['msg']}. Remove the line and record it again.",
                line.decode("utf-8", "replace"),
            ) from cause


def _differing(entry: _Entry, request: LLMRequest) -> list[str]:
    """The fields in which a recorded request differs from `request`, as far as they are recorded."""
    asked, recorded = _plain(request.facts), entry.facts
    fields = [f"facts.{name}" for name in sorted({*asked, *recorded}) if asked.get(name) != recorded.get(name)]
    if entry.prompt_version != request.prompt_version:
        fields.append(f"prompt_version ({entry.prompt_version!r} recorded, {request.prompt_version!r} asked)")
    return fields


def _ends_in_newline(file: BinaryIO) -> bool:
    file.seek(-1, os.SEEK_END)
    return file.read(1) == b"\n"


def _cannot_write(path: Path, cause: OSError) -> ConfigError:
    return ConfigError(f"cannot write the recording {path}: {cause}. Give a file in a folder that exists.")
