"""On-disk cache of results of services, so that no request is sent or paid for twice.

Every file is written whole or not at all, and validated as untrusted data when it is read: an invalid file counts as
absent.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import soundfile

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.files import read_clip
from scene2hap.common.files import draft_of, path_in_c, read_small
from scene2hap.errors import AudioError, ConfigError, reason_of, unwritable

MAX_CLIP_S = 60.0
"""Longest sound from a service [s] (assumed: a loop needs 10 s)."""
MAX_CHANNELS = 8
SAMPLE_RATES_HZ = (4_000, 192_000)

_MAX_JSON_BYTES = 4_000_000


def digest(document: Any) -> str:
    """Return a digest of the inputs of a result; equal JSON gives equal digests."""
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:40]


def plain_line(text: object, longest: int = 200) -> str:
    """Return untrusted text as one line for a credits file, without line breaks and control characters."""
    kept = "".join(c if c.isprintable() else " " for c in str(text))
    return re.sub(r"\s+", " ", kept).strip()[:longest]


def read_checked(path: Path, credit: Credit) -> AudioClip:
    """Read an untrusted sound file; refuse it by its header if decoding could fill the memory. Raises: AudioError."""
    try:
        info = soundfile.info(path_in_c(path))
    except (soundfile.SoundFileError, TypeError, OSError) as cause:
        raise AudioError(f"{credit.title!r} is not a readable sound ({reason_of(cause)}).") from cause
    low, high = SAMPLE_RATES_HZ
    if not (low <= info.samplerate <= high and info.channels <= MAX_CHANNELS):
        raise AudioError(
            f"{credit.title!r} has {info.channels} channels at {info.samplerate} Hz; it must have at most "
            f"{MAX_CHANNELS}, at {low} to {high} Hz."
        )
    if info.frames > MAX_CLIP_S * info.samplerate:
        raise AudioError(
            f"{credit.title!r} lasts {info.frames / info.samplerate:.0f} s; it must be at most {MAX_CLIP_S:.0f} s."
        )
    return read_clip(path, credit)


class Store:
    """Documents and sounds by name, below one folder, which is created on the first write."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder: Path = Path(folder)

    def document(self, name: str) -> Any | None:
        """Return the JSON document of that name; None if it is missing or cannot be read."""
        try:
            return json.loads(read_small(self.folder / name, _MAX_JSON_BYTES))
        except (OSError, ValueError, RecursionError):
            return None

    def keep_document(self, name: str, document: Any) -> None:
        """Write a JSON document. Raises: ConfigError: the folder cannot be written."""
        with self._draft(name) as draft:
            draft.write_text(json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False), encoding="utf-8")

    def clip(self, name: str, credit: Credit) -> AudioClip | None:
        """Return the sound of that name; None if it is missing or cannot be used."""
        path = self.folder / name
        try:
            return read_checked(path, credit) if path.is_file() else None
        except AudioError:
            return None

    def keep_clip(self, name: str, content: bytes, credit: Credit) -> AudioClip:
        """Write a sound file, and return its sound.

        Raises: AudioError: it is no usable sound file, and is not kept; ConfigError: the folder cannot be written.
        """
        with self._draft(name) as draft:
            draft.write_bytes(content)
            return read_checked(draft, credit)

    @contextmanager
    def _draft(self, name: str) -> Iterator[Path]:
        """Yield a draft of a file, as `common.files.draft_of`. Raises: ConfigError: the folder cannot be written."""
        target = self.folder / name
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            with draft_of(target) as draft:
                yield draft
        except OSError as cause:
            hint = "Set `cache` to a folder of yours."
            raise ConfigError(unwritable(f"the cache {self.folder}", cause, hint)) from cause
