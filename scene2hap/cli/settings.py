"""Settings from a TOML or JSON file."""

from __future__ import annotations

import json
import tomllib
from typing import Any

from scene2hap.errors import ConfigError
from scene2hap.text_files import read_small_text


def read_settings(path: str | None, section: str) -> dict[str, Any]:
    """The table `section` ("bake" or "session") of a settings file; empty without a file.

    Raises: ConfigError: the file cannot be read, or holds something else.
    """
    if path is None:
        return {}
    try:
        text = read_small_text(path)
        document = json.loads(text) if path.lower().endswith(".json") else tomllib.loads(text)
    except (OSError, ValueError, RecursionError) as cause:
        raise ConfigError(
            f"settings {path} cannot be read: {cause}. They are TOML, or JSON in a .json file."
        ) from cause
    found = document.get(section, {}) if isinstance(document, dict) else None
    if not isinstance(found, dict):
        raise ConfigError(f"settings {path}: {section!r} must be a table of settings.")
    return found
