"""The prompt templates, one text file per component, under one version.

Raise `VERSION` whenever a file changes: it is part of what a recorded answer answers to.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from scene2hap.llm.protocol import Component

VERSION = "1"


@cache
def template(component: Component) -> str:
    """The template of a component, with its facts as {placeholders}."""
    return files(__package__).joinpath(f"{component}.txt").read_text(encoding="utf-8")


def fill(component: Component, facts: Mapping[str, Any], user_prompt: str = "") -> str:
    """The template with its facts; what the user says comes last and outranks the rest."""
    wish = f"\nAbove all, follow what the scene's author asks: {user_prompt}" if user_prompt else ""
    shown = {name: fact if isinstance(fact, str) else json.dumps(fact) for name, fact in facts.items()}
    return template(component).format(**shown, user_prompt=wish).strip()
