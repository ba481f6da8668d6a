"""Secret: a key that reaches the header of a request and nothing else."""

from __future__ import annotations

import os
from typing import NoReturn

from scene2hap.echoes import masked
from scene2hap.errors import ConfigError

MASK = "******"

_SHORTEST_SCRUBBED = 16
"""Characters; assumed. Real keys are longer; the dummies that local servers want ("EMPTY", "lm-studio") are words
that an answer may well contain."""


class Secret:
    """A key that never appears in text: given, or read from an environment variable at each use."""

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
        """The text without the key, should somebody have echoed it, in whatever spelling (`scene2hap.echoes`)."""
        value = self.reveal()
        if len(value) < _SHORTEST_SCRUBBED:
            return text
        return masked(text, value, MASK)
