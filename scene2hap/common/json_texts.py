"""JSON texts: reading with errors that say what to do, since people edit files by hand, and safe display."""

from __future__ import annotations

import json
import re
from collections import Counter
from typing import Any

from scene2hap.common.printable import UNSAFE_BUT_LINES, printable, writable

_CONFLICT = re.compile(r"^(<{7}|={7}|>{7})( .*)?$", re.MULTILINE)
"""A line that git writes around two versions of the same lines."""

_MENDS: tuple[tuple[str, str], ...] = (
    (r"//|/\*|#", "JSON has no comments; remove this one"),
    (r"(?<=,)[\]}]", "there is a comma before a closing bracket; remove it"),
    (r",\s*[\]}]", "there is a comma before a closing bracket; remove it"),  # where Python 3.13 finds the same mistake
    (r"['\u2018\u2019\u201c\u201d\u201e]", 'write names and texts in straight double quotes, as "name"'),
    (r"(?:True|False|None)\b", "write true, false and null in small letters, None as null"),
    (r"[+-]?\.\d|\+", "write a number as 0.5 or -0.5"),
    (r"(?<=\d,)\d", "write a number with a decimal point, as 0.5"),
    (r"\Z", "the text ends before the last bracket is closed"),
)
"""What stands at the place where a parser stops, after what (blanks removed), and what to do."""


_MENDS_BY_MESSAGE = {
    "Extra data": "the text goes on after its last bracket; remove the rest",
    "Unterminated string": "this text has no closing quote",
    "Invalid control character": "a text has no closing quote on its line, or holds a tab, which is written as \\t",
    "Invalid \\": 'write each backslash twice, as "C:\\\\sounds"',
    "Expecting ',' delimiter": "there is no comma before this place",
    "Expecting ':' delimiter": "there is no colon before this place",
}
"""What to do, by the begin of the parser's own words."""


_DEEP = "its lists and objects are nested too deeply"
_SPELT_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")
_ESCAPES = re.compile(r"\\(?:u[dD][89abAB]\w\w\\u[dD][c-fC-F]\w\w|(u[dD][89a-fA-F])|.)")
"""The escapes in a JSON text, a pair of surrogates as one. The group matches half of a pair."""


class RepeatedKey(ValueError):
    """An object has a key twice. Most parsers silently take the last one, which need not be the one that counts."""

    def __init__(self, key: str) -> None:
        self.key: str = key
        super().__init__(f"the key {printable(key)[:200]!r} is given twice in one object; remove one")


def parse_json(text: str | bytes) -> Any:
    """Parse a JSON text. Raises: ValueError: it is none, or is nested too deeply; RepeatedKey."""
    try:
        return json.loads(text, object_pairs_hook=_each_key_once)
    except json.JSONDecodeError as cause:
        raise ValueError(_problem(cause)) from cause
    except RecursionError as cause:
        raise ValueError(_DEEP) from cause
    except ValueError as cause:
        if str(cause).startswith("Exceeds the limit"):  # Python's words name a function of Python
            raise ValueError("a number has thousands of digits; write fewer") from cause
        raise


def _each_key_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)  # of two equal keys, this drops the first
    if len(found) < len(pairs):
        raise RepeatedKey(next(key for key, n in Counter(key for key, _ in pairs).items() if n > 1))
    return found


def read_json(text: str) -> Any:
    """Parse a JSON text as `parse_json`, and make its texts `writable`. Raises: ValueError."""
    document = parse_json(text)
    return parse_json(writable(_dumped(document))) if has_surrogates(text) else document


def has_surrogates(text: str) -> bool:
    """Return True if a text in a JSON text, which must be valid, has half of a surrogate pair."""
    try:
        text.encode()  # a tenth of the time of a search
    except UnicodeEncodeError:
        return True
    return bool(_SPELT_SURROGATE.search(text)) and any(found[1] for found in _ESCAPES.finditer(text))


def _dumped(document: Any) -> str:
    try:
        return json.dumps(document, ensure_ascii=False)
    except RecursionError as cause:
        raise ValueError(_DEEP) from cause


def printable_json(text: str) -> str:
    """Escape the same characters in a JSON text by JSON escapes. Its meaning stays the same."""
    return UNSAFE_BUT_LINES.sub(lambda found: f"\\u{ord(found.group()):04x}", text)


def _problem(error: json.JSONDecodeError) -> str:
    """Return the line and the mistake in a text that is no JSON, and what to do."""
    text, at = error.doc, error.pos
    if not text.strip():
        return "it is empty; an empty JSON object is {}"
    if mark := _CONFLICT.search(text):
        line = text.count("\n", 0, mark.start()) + 1
        return f"line {line} is {mark[1]}, where git could not merge two versions; join them, and delete all such marks"
    here = text[:at].rstrip() + (rest := text[at:].lstrip())
    place = len(here) - len(rest)
    mend = next((mend for pattern, mend in _MENDS if re.compile(pattern).match(here, place)), "")
    mend = mend or next((mend for words, mend in _MENDS_BY_MESSAGE.items() if error.msg.startswith(words)), "")
    return f"line {error.lineno}, column {error.colno}: {mend or error.msg}"
