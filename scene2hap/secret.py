"""Secret: a key that reaches the header of a request and nothing else."""

from __future__ import annotations

import base64
import os
import re
from functools import lru_cache
from typing import NoReturn

from scene2hap.errors import ConfigError

MASK = "******"

_SHORTEST_SCRUBBED = 16
"""Characters; assumed. Real keys are longer; the dummies that local servers want ("EMPTY", "lm-studio") are words
that an answer may well contain."""


class Secret:
    """A key that shows itself to nobody: given, or read from an environment variable each time it is needed."""

    __slots__ = ("_value", "variable")

    def __init__(self, value: str | None = None, variable: str = "") -> None:
        if not isinstance(value, str | None):
            raise ConfigError(f"an API key or token is a {type(value).__name__}; it must be a text.")
        if not isinstance(variable, str):
            raise ConfigError("the name of an environment variable with a key must be a text.")
        self._value = value
        self.variable = variable

    def __repr__(self) -> str:
        return f"Secret({MASK})"

    def __deepcopy__(self, memo: object) -> Secret:
        return self

    def __reduce__(self) -> NoReturn:
        raise TypeError("a service with a key is not pickled, lest the key reach a file; build it again instead.")

    def reveal(self) -> str:
        """The key itself, "" where there is none.

        Raises: ConfigError: it holds characters that no header may carry (httpx would quote them in its error).
        """
        value = (self._value or os.environ.get(self.variable, "")).strip()
        if not (value.isascii() and value.isprintable()):
            del value  # reporters of errors show local variables
            raise ConfigError("the API key holds line breaks or characters outside ASCII; copy it again.")
        return value

    def scrub(self, text: str) -> str:
        """The text without the key, should somebody have echoed it: as it is, escaped, or as base64 or hex digits."""
        value = self.reveal()
        if len(value) < _SHORTEST_SCRUBBED:
            return text
        for spelling in _spellings(value):
            text = spelling.sub(MASK, text)
        return text


@lru_cache(maxsize=4)
def _spellings(value: str) -> tuple[re.Pattern[str], ...]:
    """What a key looks like in an answer: plain, in hex digits, and in base64 at each of the three places of a byte.

    Each is recognised under the escapes of JSON, addresses and HTML as well, mixed or not, and folded over lines.
    """
    raw = value.encode("ascii")
    digits = r"(?:\s|\\[rn]|:|%20|,|0x|\\x)*".join(re.escape(digit) for digit in raw.hex())
    told = ["".join(map(_escaped, value)), digits]
    for before in range(3):
        # The characters that hold bits of the neighbours are left out, and taken along by what stands around.
        first = (before * 8 + 5) // 6
        last = (before + len(raw)) * 8 // 6
        core = base64.b64encode(bytes(before) + raw).decode("ascii")[first:last]
        around = r"[\w+/-]"
        told.append(f"{around}{{0,2}}{_FOLD.join(map(_escaped_base64, core))}{around}{{0,2}}={{0,2}}")
    return tuple(re.compile(pattern, re.IGNORECASE) for pattern in told)


_FOLD = r"(?:\s|\\[rn])*"


def _escaped(character: str) -> str:
    """A pattern for one character and its escapes."""
    code = ord(character)
    names = {"&": "|&amp;", "<": "|&lt;", ">": "|&gt;", '"': "|&quot;", "'": "|&apos;"}.get(character, "")
    # Bounded, or a text of backslashes or zeros would take time by the square of its length.
    slashes, zeros = r"\\{1,4}", "0{0,6}"
    return (
        rf"(?:(?:{slashes})?{re.escape(character)}|%(?:25){{0,4}}{code:02x}|{slashes}u\{{?{zeros}{code:x}\}}?"
        rf"|{slashes}x{code:02x}|&#{zeros}{code};|&#x{zeros}{code:x};{names})"
    )


def _escaped_base64(character: str) -> str:
    """The same for a character of base64, in the alphabet of RFC 4648 or that for addresses."""
    other = {"+": "-", "/": "_"}.get(character)
    return _escaped(character) if other is None else rf"(?:{_escaped(character)}|{_escaped(other)})"
