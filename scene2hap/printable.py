"""Text from files and servers, made safe to show and to write: names are data, never commands to a terminal."""

from __future__ import annotations

import json
import re
from typing import Any

# Control characters (escapes that set a terminal's title or clear it, C1 ones included), line and paragraph separators,
# marks that turn the direction of writing, and halves of surrogate pairs, which no encoding can write.
_UNSAFE = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
_UNSAFE_BUT_LINES = re.compile(_UNSAFE.pattern.replace("\x00-\x1f", "\x00-\x08\x0b-\x1f"))
_SURROGATES = re.compile("[\ud800-\udfff]")

_SPELT_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")


def printable(text: str, *, lines: bool = False) -> str:
    """The text with what a terminal would obey written as escapes ("\\x1b"); `lines` keeps line breaks and tabs."""
    pattern = _UNSAFE_BUT_LINES if lines else _UNSAFE
    return pattern.sub(lambda found: found.group().encode("unicode_escape").decode("ascii"), text)


def printable_json(text: str) -> str:
    """JSON text with the same characters as JSON escapes; it means what it did."""
    return _UNSAFE_BUT_LINES.sub(lambda found: f"\\u{ord(found.group()):04x}", text)


def writable(text: str) -> str:
    """The text with a replacement character for what is no whole character.

    Bytes of file names that are no UTF-8, and halves of surrogate pairs that JSON can spell.
    """
    if not _SURROGATES.search(text):
        return text
    # Two halves that stand together are one character.
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")


def read_json(text: str) -> Any:
    """The values in a JSON text, their texts `writable`. Raises: ValueError, RecursionError: as `json.loads`."""
    document = json.loads(text)
    if not _SPELT_SURROGATE.search(text) and not _SURROGATES.search(text):
        return document
    return json.loads(writable(json.dumps(document, ensure_ascii=False)))
