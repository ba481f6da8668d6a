"""Safe display and writing of texts from files and servers: names are data, never commands to a terminal."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from scene2hap.common.json_problem import json_problem

# Control characters (including C1 escapes, which can clear a terminal or set its title), line and paragraph separators,
# marks that change the direction of writing, and unpaired surrogates, which no encoding can write.
_UNSAFE = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
_UNSAFE_BUT_LINES = re.compile(_UNSAFE.pattern.replace("\x00-\x1f", "\x00-\x08\x0b-\x1f"))
_SURROGATES = re.compile("[\ud800-\udfff]")

_WIDEST = 60
"""Most columns to which a cell is padded, so that one very long name does not widen all rows."""

_SPELT_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")


def printable(text: str, *, lines: bool = False) -> str:
    """Escape the characters of a text that a terminal would interpret ("\\x1b"). `lines` keeps line breaks and tabs."""
    pattern = _UNSAFE_BUT_LINES if lines else _UNSAFE
    return pattern.sub(lambda found: found.group().encode("unicode_escape").decode("ascii"), text)


def quoted(path: object) -> str:
    """Return a path in quotes, for a message. `repr` would double each backslash of a path of Windows."""
    text = printable(str(path))
    return f'"{text}"' if "'" in text else f"'{text}'"


def aligned(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a table without a frame. Each column is as wide as its widest cell, up to `_WIDEST`.

    A heading that begins with ">" sets its column to the right.
    """
    from rich.cells import cell_len  # here, since a game that prints no table need not load rich

    table = [tuple(column.removeprefix(">") for column in columns), *(tuple(map(printable, row)) for row in rows)]
    widths = [min(max(map(cell_len, cells)), _WIDEST) for cells in zip(*table, strict=True)]
    to_right = [column.startswith(">") for column in columns]
    for row in table:
        cells = zip(row, widths, to_right, strict=True)
        padded = []
        for cell, width, right in cells:
            room = " " * (width - cell_len(cell))
            padded.append(room + cell if right else cell + room)
        yield "  ".join(padded).rstrip()


def printable_json(text: str) -> str:
    """Escape the same characters in a JSON text by JSON escapes. Its meaning stays the same."""
    return _UNSAFE_BUT_LINES.sub(lambda found: f"\\u{ord(found.group()):04x}", text)


def writable(text: str) -> str:
    """Replace incomplete characters of a text by a replacement character.

    Such characters are bytes of file names that are not UTF-8, and unpaired surrogates, which JSON can hold.
    """
    if not _SURROGATES.search(text):
        return text
    # Two surrogates that form a pair are one character.
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")


def parse_json(text: str | bytes) -> Any:
    """Parse a JSON text. Raises: ValueError: it is none, or an object has a key twice; RecursionError."""
    try:
        return json.loads(text, object_pairs_hook=_each_key_once)
    except json.JSONDecodeError as cause:
        raise ValueError(json_problem(cause)) from cause


def _each_key_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)  # of two equal keys, this drops the first
    if len(found) < len(pairs):
        twice = next(key for key, n in Counter(key for key, _ in pairs).items() if n > 1)
        raise ValueError(f"the key {printable(twice)[:200]!r} is given twice in one object; remove one")
    return found


def read_json(text: str) -> Any:
    """Parse a JSON text as `parse_json`, and make its texts `writable`. Raises: ValueError, RecursionError."""
    document = parse_json(text)
    if not _SPELT_SURROGATE.search(text) and not _SURROGATES.search(text):
        return document
    return parse_json(writable(json.dumps(document, ensure_ascii=False)))
