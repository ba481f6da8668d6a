"""docs/backends.md describes every option of the backends."""

import inspect
from pathlib import Path
from typing import Any

import pytest

from scene2hap import LocalBackend, OpenAIBackend
from scene2hap.llm.wrappers import standard_stack

TEXT = (Path(__file__).parents[3] / "docs" / "backends.md").read_text(encoding="utf-8")
FOR_TESTS = {"self", "inner", "transport", "sleep"}


@pytest.mark.parametrize("made_by", [OpenAIBackend, LocalBackend, standard_stack], ids=lambda made_by: made_by.__name__)
def test_every_option_is_described(made_by: Any) -> None:
    missing = [name for name in inspect.signature(made_by).parameters if f"`{name}`" not in TEXT]
    assert set(missing) <= FOR_TESTS
