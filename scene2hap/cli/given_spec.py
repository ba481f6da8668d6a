"""What an option names: a part of the library by its kind, a material by its name, or either by a JSON object."""

from __future__ import annotations

from scene2hap.common.json_texts import parse_json
from scene2hap.errors import ConfigError


def given_spec(option: str, text: str) -> object:
    """Return a name, or the mapping that a JSON object gives. Raises: ConfigError: invalid JSON."""
    if not text.lstrip().startswith("{"):
        return text
    try:
        return parse_json(text)
    except ValueError as cause:
        # The text is not shown, since it may hold a key.
        raise ConfigError(f"{option} is no JSON ({cause}). Give a name, or an object.") from cause
