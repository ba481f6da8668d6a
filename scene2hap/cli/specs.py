"""Exchangeable parts and settings as they are chosen on the command line."""

from __future__ import annotations

import json
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.errors import ConfigError
from scene2hap.session import SessionConfig
from scene2hap.settings import read_settings


def given_spec(option: str, text: str) -> object:
    """A kind, or a mapping of a kind and its settings that is written as JSON. Raises: ConfigError: no JSON."""
    if not text.lstrip().startswith("{"):
        return text
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as cause:
        raise ConfigError(f"{option} is {text!r}, which is no JSON ({cause}). Give a kind, or an object.") from cause


def session_config(path: str | None, bundle: HapticBundle, **changes: Any) -> SessionConfig:
    """The table [session] of a settings file, with `changes` on top; the actuator is the bundle's if none is named."""
    settings = read_settings(path, "session")
    return SessionConfig.parse({"actuator": bundle.actuator or "flat", **settings}, **changes)
