"""Choice between compiled kernels and their plain versions.

A kernel is written twice. The plain Python version is the definition and runs anywhere. The Cython version beside it,
with the same name in `_<module>.pyx`, runs if the package was built with a C compiler. `SCENE2HAP_COMPILED=0` in the
environment selects the plain versions. See docs/decisions/0012-compiled-kernels.md.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TypeVar

_Kernel = TypeVar("_Kernel", bound=Callable[..., Any])

KERNELS: dict[str, tuple[Callable[..., Any], Callable[..., Any] | None]] = {}
"""Imported kernels by name: each plain kernel with its compiled version, or None."""

_IS_WANTED = os.environ.get("SCENE2HAP_COMPILED") != "0"


def compiled(plain: _Kernel) -> _Kernel:
    """Decorate a plain function or class: return its compiled version, or itself if there is none."""
    twin = _twin(plain) if _IS_WANTED else None
    KERNELS[f"{plain.__module__}.{plain.__qualname__}"] = (plain, twin)
    return plain if twin is None else twin


def are_in_use() -> bool:
    """Return True if compiled kernels exist and are not switched off."""
    return _IS_WANTED and find_spec("scene2hap.contact._certificate") is not None


def _twin(plain: _Kernel) -> _Kernel | None:
    package, _, module = plain.__module__.rpartition(".")
    try:
        twins = import_module(f"{package}._{module}")
    except ImportError:
        return None
    twin: _Kernel | None = getattr(twins, plain.__name__, None)
    return twin
