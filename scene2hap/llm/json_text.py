"""The JSON object in what a model wrote around it: thoughts, code fences, prose before and after."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

_THOUGHT = re.compile(r"<think>.*?</think>", re.DOTALL | re.IGNORECASE)
_END_OF_THOUGHT = re.compile(r"</think>", re.IGNORECASE)
_OPENING = re.compile(r'\{\s*["}]')
_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}]', re.DOTALL)


def first_object(text: str) -> str | None:
    """The first JSON object in a text, exactly as written; None where there is none that ends.

    Braces within strings do not count, and what follows the object does not matter. Of several candidates the first
    that is JSON wins over an earlier one that only has its braces in balance. Thoughts are searched last: a model may
    draft there what it answers otherwise afterwards.
    """
    if _is_object(text):
        return text.strip()
    for searched in (_without_thoughts(text), text):
        candidates = list(_balanced(searched))
        found = next((candidate for candidate in candidates if _is_object(candidate)), None)
        if found or candidates:
            return found or candidates[0]
    return None


def _without_thoughts(text: str) -> str:
    rest = _THOUGHT.sub("", text)
    # Some chat templates open the thought themselves, so that only its end is in the reply.
    return _END_OF_THOUGHT.split(rest)[-1]


def _balanced(text: str) -> Iterator[str]:
    """Stretches from a brace that can begin an object to the one that closes it."""
    position = 0
    while opening := _OPENING.search(text, position):
        end = _closing(text, opening.start())
        if end is None:
            return
        yield text[opening.start() : end]
        position = end


def _closing(text: str, start: int) -> int | None:
    depth = 0
    for token in _TOKEN.finditer(text, start):
        depth += {"{": 1, "}": -1}.get(token.group(), 0)
        if depth == 0 and token.group() == "}":
            return token.end()
    return None


def _is_object(text: str) -> bool:
    try:
        return isinstance(json.loads(text), dict)
    except (ValueError, RecursionError):
        return False
