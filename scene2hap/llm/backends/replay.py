"""Recorded answers: a model's replies as JSON lines, to repeat an inference without the model.

Each line is one answer with the facts of its question. Only the fields of `_Entry` are written: no header, no API key,
no address. Pictures appear only as a digest within the request key.
"""

from __future__ import annotations

import asyncio
import io
import os
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction, not_pickled
from scene2hap.common.files import read_small
from scene2hap.errors import BadAnswer, ConfigError, ReplayMiss, reason_of, unwritable
from scene2hap.llm.answers.usable import UnusableAnswer
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.request_key import canonical, part_names, plain, request_key
from scene2hap.llm.stack import Spec, Wrapper, identity

MAX_RECORDING_BYTES = 1 << 28
"""Size of a file of answers (assumed: answers for some 50,000 objects)."""


class _Entry(BaseModel):
    """One line of a recording.

    `model` may be a dated name of the requested `asked_model`; `parts` are digests of parts that are not stored.
    """

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
    asked_model: str = ""
    parts: dict[str, str] = {}


@clear_construction
class ReplayBackend:
    """Answer from a recording only. If a request has several answers, the last one is used.

    model : use only answers of this model; None for all.
    Raises: ConfigError: the file cannot be read. BadAnswer: a line is broken; names file and line.
    """

    def __init__(self, path: str | os.PathLike[str], model: str | None = None) -> None:
        self._path = Path(path)
        self._model = model
        self._all = _read(self._path)
        self._entries = {entry.key: entry for entry in self._all if model in (None, entry.asked_model or entry.model)}

    def __repr__(self) -> str:
        return f"ReplayBackend({str(self._path)!r}{'' if self._model is None else f', model={self._model!r}'})"

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the recorded answer. Raises: ReplayMiss: there is none; names the nearest one and the differences."""
        key = request_key(request)
        entry = self._entries.get(key)
        if entry is None:
            raise ReplayMiss(self._miss(request, key), key)
        return LLMReply(entry.text, entry.model, entry.finish_reason, entry.usage, key, is_kept=True)

    def _miss(self, request: LLMRequest, key: str) -> str:
        question = f"{request.component} about {request.subject or 'the scene'!r}"
        missing = f"{self._path} has no answer for {question} (key {key})."
        differences = [
            (_differing(entry, request, self._model), entry)
            for entry in self._all
            if entry.component == request.component
        ]
        if not differences:
            return f"{missing} It has none for this component at all. Record it with RecordingBackend."
        fields, nearest = min(differences, key=lambda pair: (len(pair[0]), pair[1].subject != request.subject))
        return (
            f"{missing} Nearest is the answer about "
            f"{checks.represented(nearest.subject or 'the scene')} (key {nearest.key[:200]}), where "
            f"{', '.join(fields)[:500] or 'something that it does not keep'} differ. Record it again with "
            "RecordingBackend."
        )


@not_pickled(ConfigError, "two processes would write to its file at once")
@clear_construction
class RecordingBackend(Wrapper):
    """Pass requests on to `inner`, and write each answer to a file before returning it.

    Raises: ConfigError: the file cannot be written. BadAnswer: the file exists and has a broken line.
    """

    def __init__(self, inner: Spec, path: str | os.PathLike[str]) -> None:
        super().__init__(inner)
        self._path = checks.path("path", path, error=ConfigError)
        self._turn = threading.Lock()
        try:
            self._path.open("ab").close()
        except OSError as cause:
            raise _cannot_write(self._path, cause) from cause
        _read(self._path)

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the inner backend's answer, after recording it.

        An answer that stayed unusable is recorded too, before its error is raised: a replay without it would miss it
        and end the run, where the recorded run lost one object.
        """
        key = request_key(request)  # before the call, so that a request that cannot be recorded is not billed
        try:
            reply = await self.inner.complete(request)
        except UnusableAnswer as bad:
            said = LLMReply(bad.raw_text, bad.model, bad.finish_reason, bad.usage)
            await self._record(request, key, said)
            raise
        await self._record(request, key, reply)
        return replace(reply, key=key)

    async def _record(self, request: LLMRequest, key: str, reply: LLMReply) -> None:
        entry = _Entry(
            key=key,
            component=request.component,
            subject=request.subject,
            prompt_version=request.prompt_version,
            facts=plain(request.facts),
            text=reply.text,
            model=reply.model,
            finish_reason=reply.finish_reason,
            usage=dict(reply.usage),
            asked_model=str(identity(self.inner).get("model") or reply.model),
            parts=part_names(request),
        )
        await asyncio.to_thread(self._append, canonical(entry.model_dump()).encode() + b"\n")

    def _append(self, line: bytes) -> None:
        try:
            with self._turn, self._path.open("ab+", buffering=0) as file:
                end = file.seek(0, os.SEEK_END)
                if end and not _ends_in_newline(file):
                    line = b"\n" + line  # an editor removed the last line break
                try:
                    # A full disk takes a part of the line, and fails at the next write.
                    while line:
                        line = line[file.write(line) :]
                    os.fsync(file.fileno())
                except OSError:
                    file.truncate(end)  # the part of a line would make all other answers unreadable
                    raise
        except OSError as cause:
            raise _cannot_write(self._path, cause) from cause


def _read(path: Path) -> list[_Entry]:
    try:
        content = read_small(path, MAX_RECORDING_BYTES)
    except (OSError, ValueError) as cause:
        raise ConfigError(
            f"cannot read the recording {path}: {reason_of(cause)}. Make one with RecordingBackend."
        ) from cause
    return list(_entries(path, content))


def _entries(path: Path, content: bytes) -> Iterator[_Entry]:
    for number, line in enumerate(content.splitlines(), start=1):
        if not line.strip():
            continue
        try:
            yield _Entry.model_validate_json(line)
        except ValidationError as cause:
            problem = checks.first_problem(cause)
            raise BadAnswer(
                f"{path}, line {number}: {problem.place or '(whole line)'}: {problem.reason}. Remove the line and "
                "record it again.",
                line.decode("utf-8", "replace"),
            ) from cause


def _differing(entry: _Entry, request: LLMRequest, model: str | None) -> list[str]:
    """Return the names of the parts in which a recorded request differs from `request`."""
    facts, recorded = plain(request.facts), entry.facts
    fields = [f"facts.{name}" for name in sorted({*facts, *recorded}) if facts.get(name) != recorded.get(name)]
    recorded_model = entry.asked_model or entry.model
    if model not in (None, recorded_model):
        fields.append(f"model ({recorded_model!r} recorded, {model!r} requested)")
    if entry.prompt_version != request.prompt_version:
        fields.append(f"prompt_version ({entry.prompt_version!r} recorded, {request.prompt_version!r} requested)")
    return fields + [name for name, part in part_names(request).items() if entry.parts.get(name, part) != part]


def _ends_in_newline(file: io.FileIO) -> bool:
    file.seek(-1, os.SEEK_END)
    return file.read(1) == b"\n"


def _cannot_write(path: Path, cause: OSError) -> ConfigError:
    return ConfigError(unwritable(f"the recording {path}", cause, "Give a file in a folder that exists."))
