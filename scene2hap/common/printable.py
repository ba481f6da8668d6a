"""Safe display and writing of texts from files and servers: names are data, never commands to a terminal."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence

# Control characters (including C1 escapes, which can clear a terminal or set its title), line and paragraph separators,
# marks that change the direction of writing, and unpaired surrogates, which no encoding can write.
_UNSAFE = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
UNSAFE_BUT_LINES = re.compile(_UNSAFE.pattern.replace("\x00-\x1f", "\x00-\x08\x0b-\x1f"))
_SURROGATES = re.compile("[\ud800-\udfff]")

_UNDIVIDED = str.maketrans(
    {"ß": "ss", "æ": "ae", "Æ": "AE", "œ": "oe", "Œ": "OE"}
    | {"ł": "l", "Ł": "L", "ø": "o", "Ø": "O", "đ": "d", "Đ": "D"}
)
"""Letters that Unicode does not divide into a Latin letter and an accent."""

_WIDEST = 60
"""Most columns to which a cell is padded, so that one very long name does not widen all rows."""


def printable(text: str, *, lines: bool = False) -> str:
    """Escape the characters of a text that a terminal would interpret ("\\x1b"). `lines` keeps line breaks and tabs."""
    pattern = UNSAFE_BUT_LINES if lines else _UNSAFE
    return pattern.sub(lambda found: found.group().encode("unicode_escape").decode("ascii"), text)


def quoted(path: object) -> str:
    """Return a path in quotes, for a message. `repr` would double each backslash of a path of Windows."""
    text = printable(str(path))
    return f'"{text}"' if "'" in text else f"'{text}'"


def without_accents(text: str) -> str:
    """Return a text with Latin letters in place of accented ones: "Kuhlschrank" for "Kühlschrank"."""
    letters = unicodedata.normalize("NFKD", text.translate(_UNDIVIDED))
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


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


def writable(text: str) -> str:
    """Replace incomplete characters of a text by a replacement character.

    Such characters are bytes of file names that are not UTF-8, and unpaired surrogates, which JSON can hold.
    """
    if not _SURROGATES.search(text):
        return text
    # Two surrogates that form a pair are one character.
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")
