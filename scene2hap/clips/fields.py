"""Checked reading of JSON from untrusted sources: every error names the file, the field and the bound."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from scene2hap.clips.haptic_clip import MAX_CLIP_S, MAX_POINTS
from scene2hap.common import checks
from scene2hap.common.files import read_small
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import ClipError

MAX_BYTES = 1 << 27
"""Most bytes of a file; larger ones are refused before parsing (assumed: points up to `MAX_POINTS` take a tenth)."""


class Fields:
    """An object of a JSON document, with its file and its place there for error messages."""

    def __init__(self, document: object, file: str, place: str = "") -> None:
        self.file = file
        self.place = place
        if not isinstance(document, Mapping):
            raise self.error("", f"is {checks.described(document)}; it must be an object")
        self._document: Mapping[str, Any] = document

    def __contains__(self, name: str) -> bool:
        return self._document.get(name) is not None

    def names(self) -> tuple[str, ...]:
        """Return the names of all fields."""
        return tuple(self._document)

    def error(self, name: str, problem: str) -> ClipError:
        """Return the error for a field of this object, or for the object itself."""
        place = ".".join(part for part in (self.place, name) if part) or "the whole file"
        return ClipError(f"{self.file}: {place} {problem}.")

    def within(self, name: str) -> Fields:
        """Return the object in a field. Raises: ClipError: it is missing, or no object."""
        return Fields(self._required(name), self.file, self._at(name))

    def items(self, name: str) -> tuple[Fields, ...]:
        """Return the objects of a list in a field. Raises: ClipError: it is missing, no list of objects, or too
        long."""
        found = self._required(name)
        if not isinstance(found, list):
            raise self.error(name, f"is {checks.described(found)}; it must be a list")
        if len(found) > MAX_POINTS:
            raise self.error(name, f"has {len(found)} items; it must have at most {MAX_POINTS}. Split the clip")
        return tuple(Fields(item, self.file, f"{self._at(name)}[{i}]") for i, item in enumerate(found))

    def number(
        self, name: str, *, at_least: float = 0.0, at_most: float = 1.0, unit: str = "-", default: float | None = None
    ) -> float:
        """Return the number in a field. Raises: ClipError: it is missing without a default, no number, or out of
        bounds."""
        value = self._document.get(name)
        if value is None and default is not None:
            return default
        value = self._required(name)
        place = f"{self.file}: {self._at(name)}"
        return checks.number(place, value, unit, at_least=at_least, at_most=at_most, error=ClipError)

    def text(self, name: str) -> str:
        """Return the text in a field, "" if it is missing. Raises: ClipError: it is something else."""
        value = self._document.get(name)
        if value is None:
            return ""
        if not isinstance(value, str):
            raise self.error(name, f"is {checks.represented(value)}; it must be a text")
        return value

    def texts(self, name: str) -> tuple[str, ...]:
        """Return the texts of a list in a field, none if it is missing. Raises: ClipError: it is something else."""
        value = self._document.get(name) or []
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self.error(name, f"is {checks.represented(value)}; it must be a list of texts")
        return tuple(value)

    def _required(self, name: str) -> Any:
        if self._document.get(name) is None:
            raise self.error(name, "is missing")
        return self._document[name]

    def _at(self, name: str) -> str:
        return f"{self.place}.{name}" if self.place else name


def rising_times(rows: tuple[Fields, ...], name: str, default: float | None = None) -> list[float]:
    """Return the times [s] in a field of each row. Raises: ClipError: a time is out of bounds, or before another."""
    times: list[float] = []
    for row in rows:
        time = row.number(name, at_most=MAX_CLIP_S, unit="s", default=default)
        if times and time < times[-1]:
            raise row.error(name, f"is {time:g} s; it must not be before the point above it at {times[-1]:g} s")
        times.append(time)
    return times


def read_fields(path: Path, *, needed: str, kind: str) -> Fields:
    """Return the JSON object in a file.

    Parameters: needed : a field that every file of this kind has; kind : the name of the kind, for errors.
    Raises: ClipError: it cannot be read, is no JSON, or lacks that field, so that it is a file of another kind.
    """
    try:
        content = read_small(path, MAX_BYTES)
    except (OSError, ValueError) as cause:
        near = "" if os.path.exists(path) else f" {checks.near_files(path)}".rstrip()
        reason = getattr(cause, "strerror", None) or cause
        raise ClipError(f"{path}: cannot be read as {kind}: {reason}.{near}") from cause
    try:
        document = parse_json(content.decode("utf-8-sig"))
    except ValueError as cause:  # also no UTF-8
        raise ClipError(f"{path}: is no {kind} file, which is JSON: {str(cause)[:200]}. Export it again.") from cause
    fields = Fields(document, str(path))
    if needed not in fields:
        has = ", ".join(fields.names()[:8]) or "nothing"
        raise ClipError(f"{path}: is no {kind} file: it lacks {needed!r} and has {has[:200]}. Check its suffix.")
    return fields
