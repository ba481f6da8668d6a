"""Find the JSON object in a model's text, among reasoning, code fences and prose."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

_THOUGHT = re.compile(r"<(/?)think>", re.IGNORECASE)
_OPENING = re.compile(r'\{\s*["}]')
_KEY = re.compile(r'\{\s*"(?:[^"\\]|\\.)*"\s*:\s*', re.DOTALL)
_MARK = re.compile(r'[\\"{}]')


def first_object(text: str) -> str | None:
    """Return the first JSON object in a text, exactly as written; None if none is complete.

    Braces within strings do not count, and text after the object is ignored. Valid JSON is preferred to an earlier
    candidate that only has balanced braces. Reasoning is searched last, since it may hold a draft of the answer.
    """
    if fields_of(text) is not None:
        return text.strip()
    for searched in (_without_thoughts(text), text):
        candidates = list(_balanced(searched))
        found = next((candidate for candidate in candidates if fields_of(candidate) is not None), None)
        if found or candidates:
            return found or candidates[0]
    return None


def answer_object(text: str) -> str | None:
    """Return the first JSON object in a text, or the object in it that it only wraps: {"answer": {...}}."""
    found = first_object(text)
    fields = fields_of(found) if found is not None else None
    if found is None or fields is None or [isinstance(field, dict) for field in fields.values()] != [True]:
        return found
    key = _KEY.match(found)
    return found[key.end() :].rstrip().removesuffix("}").rstrip() if key is not None else found


def _without_thoughts(text: str) -> str:
    """Return the text outside reasoning. Some chat templates write the opening tag, so a closing tag may be alone."""
    said, begin, thinks = list[str](), 0, False
    for mark in _THOUGHT.finditer(text):
        is_end = bool(mark[1])
        if is_end and not thinks:
            said, begin = [], mark.end()
        elif is_end:
            begin, thinks = mark.end(), False
        elif not thinks:
            said.append(text[begin : mark.start()])
            begin, thinks = mark.start(), True
    # An unclosed opening tag does not count as reasoning.
    return "".join((*said, text[begin:]))


def _balanced(text: str) -> Iterator[str]:
    """Yield each part of a text with balanced braces that can begin an object."""
    position = 0
    while opening := _OPENING.search(text, position):
        end = _closing(text, opening.start())
        if end is None:
            return
        yield text[opening.start() : end]
        position = end


def _closing(text: str, start: int) -> int | None:
    depth, in_string, escaped = 0, False, -1
    for found in _MARK.finditer(text, start):
        mark, at = found.group(), found.start()
        if in_string:
            if at == escaped:
                continue
            if mark == "\\":
                escaped = at + 1
            in_string = mark != '"'
        elif mark == '"':
            in_string = True
        else:
            depth += {"{": 1, "}": -1}.get(mark, 0)
            if depth == 0 and mark == "}":
                return found.end()
    return None


def fields_of(text: str) -> dict[str, Any] | None:
    """Return the fields of a text that is one JSON object; None for any other text."""
    try:
        found = json.loads(text, parse_int=float)  # an integer of 400 digits would have no float later
    except (ValueError, RecursionError):  # ValueError: also a number with thousands of digits
        return None
    return found if isinstance(found, dict) else None
