"""Secret: a key that is written only into the header of a request."""

from __future__ import annotations

import os

from scene2hap.common.checks import MASK
from scene2hap.common.key_search import masked
from scene2hap.errors import CallError, ConfigError

_SHORTEST_SCRUBBED = 16
"""Least number of characters that are scrubbed; assumed. Real keys are longer. Local servers use dummies ("EMPTY",
"lm-studio"), words that an answer may contain."""


class Secret:
    """A key that never appears in text. It is given, or read from an environment variable at each use.

    A pickle has the name of the variable. Raises: CallError: a key that was given is to be pickled.
    """

    __slots__ = ("_value", "variable")

    def __init__(self, value: str | None = None, variable: str = "") -> None:
        if not isinstance(value, str | None):
            raise ConfigError("an API key or token must be a text.")
        if not isinstance(variable, str):
            raise ConfigError("the name of an environment variable with a key must be a text.")
        self._value = value
        self.variable: str = variable

    def __repr__(self) -> str:
        return f"Secret({MASK})"

    def __deepcopy__(self, memo: object) -> Secret:
        return self

    def __reduce__(self) -> tuple[type[Secret], tuple[None, str]]:
        if self._value is None:
            return Secret, (None, self.variable)
        put = f"into the environment variable {self.variable}" if self.variable else "into an environment variable"
        raise CallError(
            "a service with a key cannot be pickled, since the key would reach a file or another process. Put the key "
            f"{put}, where each process reads it, and give none; or make the service in each process."
        )

    def reveal(self) -> str:
        """Return the key itself, "" if there is none.

        Raises: ConfigError: it holds characters that a header cannot hold (httpx would show them in its error).
        """
        value = (self._value or os.environ.get(self.variable, "")).strip()
        if not (value.isascii() and value.isprintable()):
            del value  # error reporters show local variables
            raise ConfigError("the API key holds line breaks or characters outside ASCII; copy it again.")
        return value

    def scrub(self, text: str) -> str:
        """Remove the key from a text, in any spelling, in case a server echoed it (`scene2hap.common.key_search`)."""
        value = self.reveal()
        if len(value) < _SHORTEST_SCRUBBED:
            return text
        return masked(text, value)
