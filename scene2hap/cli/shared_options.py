"""Options that several commands have in common, as settings: model, converter, actuator, file of settings."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.cli.given_spec import given_spec
from scene2hap.common.settings import read_settings
from scene2hap.errors import ConfigError
from scene2hap.session import SessionConfig


def add_backend_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that choose the model of an inference, and the file of settings."""
    parser.add_argument("--prompt", default="", help="instruction to the model, with priority over all others")
    parser.add_argument("--llm", metavar="KIND[:MODEL]", help="lexicon (default), openai:MODEL, local:MODEL, ...")
    parser.add_argument("--base-url", metavar="URL", help="address of the model's server, if not the default one")
    parser.add_argument("--max-cost", type=float, metavar="DOLLARS", help="stop before the answers cost more than this")
    parser.add_argument("--cache", metavar="FOLDER", help="folder of stored answers; default: the user's cache folder")
    parser.add_argument("--settings", metavar="FILE", help="TOML or JSON with a table [bake]")


def backend_settings(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the table [bake] of the file of settings, overridden by the other arguments. Raises: ConfigError."""
    settings = read_settings(arguments.settings, "bake")["bake"]
    if arguments.llm:
        given_llm = given_spec("--llm", arguments.llm)
        if isinstance(given_llm, str):
            kind, _, model = given_llm.partition(":")
            given_llm = {"kind": kind, "model": model} if model else {"kind": kind}
        settings["llm"] = given_llm
    if arguments.base_url:
        if not isinstance(settings.get("llm"), dict):
            raise ConfigError("--base-url needs a model to ask there. Name one with --llm KIND:MODEL.")
        settings["llm"] = {**settings["llm"], "base_url": arguments.base_url}
    return settings | _given(max_cost_usd=arguments.max_cost, cache_dir=arguments.cache)


def add_loop_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that choose how a loop is made of its sound."""
    parser.add_argument("--actuator", metavar="NAME", help="name of an actuator, or a CSV file of Hz and dB")
    parser.add_argument("--tactile", metavar="KIND", help="converter from sound to vibration")


def loop_settings(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the settings in the arguments of `add_loop_arguments`. Raises: ConfigError."""
    tactile = given_spec("--tactile", arguments.tactile) if arguments.tactile else None
    return _given(actuator=arguments.actuator, tactile=tactile)


def _given(**settings: object) -> dict[str, Any]:
    return {name: value for name, value in settings.items() if value is not None}


def add_session_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of a session: the file of settings, and the profile of the person who feels it."""
    parser.add_argument("--settings", metavar="FILE", help="TOML or JSON with a table [session]")
    parser.add_argument("--profile", metavar="FILE", help="levels and limits of a person, see docs/profiles.md")


def reject_unused(arguments: argparse.Namespace, names: Iterable[str], needs: str) -> None:
    """Raise a ConfigError if one of these arguments, whose default is None, was given: it would have no effect."""
    given = [f"--{name.replace('_', '-')}" for name in names if getattr(arguments, name) is not None]
    if given:
        raise ConfigError(f"{', '.join(given)}: no effect here. {needs}")


def session_config(path: str | None, bundle: HapticBundle, **changes: Any) -> SessionConfig:
    """Return the table [session] of a file, overridden by `changes`. The default actuator is the bundle's."""
    settings = read_settings(path, "session")["session"]
    return SessionConfig.parse({"actuator": bundle.actuator or "flat", **settings}, **changes)
