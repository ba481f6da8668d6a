"""A service's token: it goes into one header of one host, and shows itself to nobody else."""

from __future__ import annotations

import os
from typing import NoReturn

from scene2hap.errors import ConfigError

MASK = "******"

_SHORTEST_SCRUBBED = 16
"""Characters; assumed. Real tokens are longer, and a shorter word may well stand in an honest answer."""


class Token:
    """Given, or read from an environment variable each time it is needed. Raises: ConfigError: it is no text."""

    __slots__ = ("_value", "variable")

    def __init__(self, value: str | None, variable: str) -> None:
        if not isinstance(value, str | None):
            raise ConfigError(f"a token is a {type(value).__name__}; it must be a text.")
        if not isinstance(variable, str) or not variable:
            raise ConfigError("token_env is not a text; it must be the name of an environment variable.")
        self._value = value
        self.variable = variable

    def __repr__(self) -> str:
        return f"Token({MASK})"

    def __reduce__(self) -> NoReturn:
        raise TypeError("a source with a token is not pickled, lest the token reach a file; build it again instead.")

    def reveal(self) -> str:
        """The token itself, "" where there is none. Raises: ConfigError: no header may carry it."""
        value = (self._value or os.environ.get(self.variable, "")).strip()
        if not (value.isascii() and value.isprintable()):
            raise ConfigError("the token holds line breaks or characters outside ASCII; copy it again.")
        return value

    def scrub(self, text: str) -> str:
        """The text without the token, should somebody have echoed it."""
        value = self.reveal()
        return text.replace(value, MASK) if len(value) >= _SHORTEST_SCRUBBED else text
