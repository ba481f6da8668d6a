"""Pairs of plain and compiled kernels, and the Hypothesis settings of the tests that compare them."""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings, strategies as st

from scene2hap.compiled import KERNELS

PACKAGE = Path(__file__).parents[2] / "scene2hap"
for source in sorted(PACKAGE.rglob("_*.pyx")):
    module = ".".join(source.relative_to(PACKAGE.parent).with_suffix("").parts)
    import_module(module.replace("._", "."))

seeds = st.integers(0, 2**32 - 1)
steady = settings(max_examples=60)


def both(name: str) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """A plain kernel and its compiled twin; skips the test without a twin, unless SCENE2HAP_COMPILED is 1."""
    plain, twin = KERNELS[f"scene2hap.{name}"]
    if twin is None:
        wish = os.environ.get("SCENE2HAP_COMPILED", "")
        assert wish != "1", f"{name} has no compiled twin, and SCENE2HAP_COMPILED=1 demands one"
        pytest.skip("built or run without compiled kernels; install a C compiler and build again to compare them")
    return plain, twin
