"""Every name of code in docs/paper.md exists."""

from __future__ import annotations

import re
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

TEXT = (Path(__file__).parents[2] / "docs" / "paper.md").read_text(encoding="utf-8")
NAMES = sorted(set(re.findall(r"`(scene2hap(?:\.\w+)+)`", TEXT)))


def found(dotted: str) -> object:
    """The module of a dotted name, or the attribute of the longest module in it."""
    parts = dotted.split(".")
    for n in range(len(parts), 0, -1):
        try:
            spec = find_spec(".".join(parts[:n]))
        except ModuleNotFoundError:
            continue
        if spec is not None:
            value: object = import_module(".".join(parts[:n]))
            for part in parts[n:]:
                value = getattr(value, part)
            return value
    raise ModuleNotFoundError(dotted)


def test_the_page_names_code() -> None:
    assert len(NAMES) > 40


@pytest.mark.parametrize("name", NAMES)
def test_a_named_part_exists(name: str) -> None:
    assert found(name) is not None
