"""Contract with a generator: a request file in, a reply file and sound files out.

request.json   {"contract", "version", "prompt", "count", "duration_s", "seed"}
reply.json     {"contract", "version", "model", "licence", "address", "files": ["0.wav", ...]}   or   {..., "error"}

Both are described in docs/sound-sources.md. The reply lies in the folder of the sounds and is written last.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from scene2hap.common import checks
from scene2hap.common.json_fields import Whole
from scene2hap.errors import BackendUnavailable, BadAnswer, reason_of

CONTRACT = "scene2hap/text-to-audio"
VERSION = 1
REPLY_NAME = "reply.json"

_MAX_REPLY_BYTES = 1_000_000
_MAX_FILE_BYTES = 100_000_000


@dataclass(frozen=True)
class Request:
    """A request for `count` takes of `duration_s` [s] each, described by `prompt`; `seed` makes them repeatable."""

    prompt: str
    count: int
    duration_s: float
    seed: int

    def to_document(self) -> dict[str, object]:
        """Return the request as plain data, for the file."""
        return {"contract": CONTRACT, "version": VERSION, **asdict(self)}


class Reply(BaseModel):
    """The model that made the sounds, its licence, and the file names of the sounds in the reply's folder."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="ignore", frozen=True)

    contract: str
    version: Whole
    error: str = ""
    model: str = ""
    licence: str = "unknown"
    address: str = ""
    files: tuple[Annotated[str, Field(min_length=1, max_length=200)], ...] = ()


def read_reply(folder: Path, scrub: Callable[[str], str] = str) -> Reply:
    """Read the generator's reply; `scrub` removes secrets from its text.

    Raises: BackendUnavailable: the reply states a failure; BadAnswer: there is no reply, or it breaks the contract.
    """
    try:
        raw = _content(folder / REPLY_NAME, _MAX_REPLY_BYTES)
    except OSError as cause:
        raise BadAnswer(
            f"the generator left no {REPLY_NAME} ({reason_of(cause)}). See docs/sound-sources.md.", ""
        ) from cause
    text = scrub(raw.decode("utf-8", "replace"))
    try:
        reply = Reply.model_validate(json.loads(text))
    except (ValueError, RecursionError) as cause:
        problem = checks.first_problem(cause) if isinstance(cause, ValidationError) else None
        reason = f"{problem.place}: {problem.reason}" if problem else str(cause)
        raise BadAnswer(f"{REPLY_NAME} of the generator: {reason}. See docs/sound-sources.md.", text[:2000]) from cause
    if (reply.contract, reply.version) != (CONTRACT, VERSION):
        raise BadAnswer(
            f"the generator speaks {reply.contract!r} version {reply.version}; it must be {CONTRACT!r} version "
            f"{VERSION}.",
            text[:2000],
        )
    if reply.error:
        raise BackendUnavailable(f"the generator says: {' '.join(reply.error.split())[:400]}", retryable=False)
    if not reply.files:
        raise BadAnswer("the generator names no files. See docs/sound-sources.md.", text[:2000])
    return reply


def read_file(folder: Path, name: str) -> bytes:
    """Return the content of a file that a reply names.

    Raises: BadAnswer: the name leads out of the folder, or there is no plain file of at most 100 MB.
    """
    if Path(name).name != name or name in (".", "..") or "\\" in name:
        raise BadAnswer(f"the generator names the file {name!r}; it must be a plain name in the reply's folder.", name)
    try:
        return _content(folder / name, _MAX_FILE_BYTES)
    except OSError as cause:
        raise BadAnswer(f"the generator's file {name!r} cannot be read: {reason_of(cause)}.", name) from cause


def _content(path: Path, max_bytes: int) -> bytes:
    """Return the content of a plain file. A link may lead anywhere, a pipe would block. Raises: OSError: either."""
    status = path.lstat()
    if not stat.S_ISREG(status.st_mode):
        raise OSError(f"{path.name} is not a plain file")
    if status.st_size > max_bytes:
        raise OSError(f"{path.name} has {status.st_size} bytes; at most {max_bytes} are read")
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as file:
        return file.read(max_bytes)
