"""A part of the library that an option names: by its kind, or by a JSON object with the kind and its settings."""

from __future__ import annotations

from scene2hap.common.json_texts import parse_json
from scene2hap.errors import ConfigError


def given_spec(option: str, text: str) -> object:
    """Return a kind, or a mapping with a kind and its settings, written as JSON. Raises: ConfigError: invalid JSON."""
    if not text.lstrip().startswith("{"):
        return text
    try:
        return parse_json(text)
    except (ValueError, RecursionError) as cause:
        raise ConfigError(f"{option} is {text!r}, which is no JSON ({cause}). Give a kind, or an object.") from cause
