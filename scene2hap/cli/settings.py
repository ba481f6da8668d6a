"""List every setting of a bake, of a session and of a user profile: its name, type, default and meaning.

scene2hap settings
scene2hap settings session

A settings file, given by --settings, is TOML or JSON with tables [bake] and [session]. A profile, given by --profile,
has a table [user].
"""

from __future__ import annotations

import argparse
import inspect
import re
from collections.abc import Iterator
from typing import Any

from scene2hap.baking.config import BakeConfig
from scene2hap.cli.console import Console
from scene2hap.common.settings import Settings
from scene2hap.session import SessionConfig, UserProfile

TABLES: dict[str, type[Settings]] = {"bake": BakeConfig, "session": SessionConfig, "user": UserProfile}

_ENTRY = re.compile(r"^(\w+) : (.+(?:\n    .+)*)", re.MULTILINE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap settings``."""
    parser.add_argument("table", metavar="TABLE", nargs="?", choices=TABLES, help="bake, session, user; default: all")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show the settings as tables."""
    outcome: dict[str, Any] = {}
    for name, settings in TABLES.items():
        if arguments.table in (None, name):
            outcome[name] = rows = [*setting_rows(settings)]
            console.table(f"[{name}]", ("setting", "type", "default", "meaning"), ([*row.values()] for row in rows))
    return outcome


def setting_rows(settings: type[Settings], within: str = "") -> Iterator[dict[str, str]]:
    """Yield name, type, default and meaning of each setting, including nested settings."""
    meanings = _meanings(settings)
    for name, field in settings.model_fields.items():
        kind, default = field.annotation, field.get_default(call_default_factory=True, validated_data={})
        if isinstance(kind, type) and issubclass(kind, Settings):
            yield from setting_rows(kind, f"{within}{name}.")
            continue
        yield {
            "setting": within + name,
            "type": _type_name(kind),
            "default": _default_name(default),
            "meaning": meanings.get(name, ""),
        }


def _meanings(settings: type[Settings]) -> dict[str, str]:
    """Return the meaning of each setting, from ``name : meaning`` in the docstrings of the class and its bases."""
    found: dict[str, str] = {}
    for base in reversed(settings.__mro__):
        if issubclass(base, Settings) and base.__doc__:
            entries = _ENTRY.findall(inspect.cleandoc(base.__doc__))
            found |= {name: " ".join(text.split()).rstrip(".") for name, text in entries}
    return found


def _type_name(kind: Any) -> str:
    text = kind.__name__ if isinstance(kind, type) and not getattr(kind, "__args__", None) else str(kind)
    text = re.sub(r"\b(?:typing|pathlib|collections\.abc)\.|Literal\[(.*)\]", lambda match: match[1] or "", text)
    return {"Any": "a kind, its settings, or an instance"}.get(text, re.sub(r"\bscene2hap\.(?:\w+\.)*", "", text))


def _default_name(default: object) -> str:
    if isinstance(default, float):
        return f"{default:.3g}"
    if default is None or isinstance(default, str | int | tuple | dict):
        return str(default)
    # A kind or a name is a value that a file of settings takes.
    return str(getattr(default, "kind", None) or getattr(default, "name", None) or type(default).__name__)
