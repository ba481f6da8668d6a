"""Setting: number of candidates that a source returns."""

from __future__ import annotations

from scene2hap.common import checks
from scene2hap.errors import ConfigError

MAX_CANDIDATES = 5
"""Most candidates of a source: as many as the paper retrieves, or generates."""


def how_many(name: str, value: object) -> int:
    """Return the setting as a whole number within 1..5. Raises: ConfigError: it is not."""
    return checks.whole(name, value, "-", at_least=1, at_most=MAX_CANDIDATES, error=ConfigError)
