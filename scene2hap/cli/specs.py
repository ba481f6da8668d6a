"""Exchangeable parts and settings given on the command line."""

from __future__ import annotations

from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.errors import ConfigError
from scene2hap.printable import parse_json
from scene2hap.session import SessionConfig
from scene2hap.settings import read_settings


def given_spec(option: str, text: str) -> object:
    """Return a kind, or a mapping with a kind and its settings, written as JSON. Raises: ConfigError: invalid JSON."""
    if not text.lstrip().startswith("{"):
        return text
    try:
        return parse_json(text)
    except (ValueError, RecursionError) as cause:
        raise ConfigError(f"{option} is {text!r}, which is no JSON ({cause}). Give a kind, or an object.") from cause


def session_config(path: str | None, bundle: HapticBundle, **changes: Any) -> SessionConfig:
    """Return the table [session] of a file, overridden by `changes`. The default actuator is the bundle's."""
    settings = read_settings(path, "session")
    return SessionConfig.parse({"actuator": bundle.actuator or "flat", **settings}, **changes)
