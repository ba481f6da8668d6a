"""The prompt templates, one text file per component, under one version.

A template names facts as {placeholders}, which are filled in as JSON (`quoting`); doubled braces give braces.
Users can replace any of the files by one of the same name in their own folder. Raise `VERSION` whenever a built-in file
changes, since the version is part of the provenance of answers.

Instructions come first, then facts about the place, then facts about the object. Services bill a repeated beginning of
a prompt at a lower price.
"""

from __future__ import annotations

import hashlib
import json
import os
import string
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from scene2hap.common.files import read_small_text
from scene2hap.errors import ConfigError, reason_of
from scene2hap.llm.prompts.quoting import IS_DATA, as_data
from scene2hap.llm.protocol import COMPONENTS, Component

VERSION = "7"

_CHAIN = "It is one of these objects, which hinges join, directly or by others, by authored name"


@dataclass(frozen=True)
class Prompts:
    """The templates of all components, and their version, which is part of the provenance of answers."""

    templates: Mapping[Component, str]
    version: str

    @classmethod
    def load(cls, folder: str | os.PathLike[str] | None = None) -> Prompts:
        """Return the built-in templates. Files in `folder` (`object_analyzer.txt`, ...) replace them.

        Raises: ConfigError: the folder does not exist, has no template, or has one with an unknown placeholder.
        """
        if folder is None:
            return _built_in()
        own = {name: path for name in COMPONENTS if os.path.isfile(path := Path(folder) / f"{name}.txt")}
        if not own:
            names = ", ".join(f"{name}.txt" for name in COMPONENTS)
            raise ConfigError(f"prompts folder {folder} has no template; it must hold at least one of {names}.")
        replaced = {name: _read(path, name) for name, path in own.items()}
        mark = hashlib.sha256(json.dumps(replaced, sort_keys=True).encode()).hexdigest()[:8]
        return cls({**_built_in().templates, **replaced}, f"{VERSION}+{mark}")

    def fill(self, component: Component, facts: Mapping[str, Any], user_prompt: str = "") -> str:
        """Fill a template with facts, quoted as data, and add the user's prompt, which has priority.

        The objects of a chain are named before it, so that prompts of objects without hinges have no line for them.
        """
        data = {name: as_data(fact) for name, fact in facts.items()}
        chain = f"\n{_CHAIN}: {data['chain_names']}" if "chain_names" in data else ""
        wish = f"\nAbove all, follow what the scene's author asks: {user_prompt}" if user_prompt else ""
        return f"{IS_DATA}\n\n{self.templates[component].format(**data, user_prompt=chain + wish).strip()}"


@cache
def _built_in() -> Prompts:
    texts = {name: files(__package__).joinpath(f"{name}.txt").read_text(encoding="utf-8") for name in COMPONENTS}
    return Prompts(texts, VERSION)


def _read(path: Path, component: Component) -> str:
    try:
        text = read_small_text(path)
        named = placeholders(text)
    except (OSError, ValueError) as cause:
        raise ConfigError(
            f"prompt {path} cannot be used: {reason_of(cause)}. Write a brace as {{{{ or }}}}."
        ) from cause
    known = placeholders(_built_in().templates[component])
    if named - known:
        raise ConfigError(
            f"prompt {path} names {', '.join(sorted(named - known))}; {component} knows {', '.join(sorted(known))}. "
            "Write a brace that is meant as such twice: {{ or }}."
        )
    if "user_prompt" not in named:
        raise ConfigError(f"prompt {path} lacks {{user_prompt}}, so that a user's wish would be lost; add it.")
    return text


def placeholders(template: str) -> frozenset[str]:
    """Return the facts that a template names. Raises: ValueError: its braces do not match."""
    return frozenset(name for _, name, _, _ in string.Formatter().parse(template) if name is not None)
