"""Choice between compiled kernels and their plain versions.

A kernel is written twice: in plain Python, which says what it means and runs anywhere, and in Cython beside it, by the
same name in `_<module>.pyx`, which runs wherever the package was built with a C compiler. `SCENE2HAP_COMPILED=0` in the
environment takes the plain ones. See docs/decisions/0012-compiled-kernels.md.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any, TypeVar

_Kernel = TypeVar("_Kernel", bound=Callable[..., Any])

KERNELS: dict[str, tuple[Callable[..., Any], Callable[..., Any] | None]] = {}
"""Of those that were imported so far, by name: each plain kernel, and its compiled twin or None."""

_IS_WANTED = os.environ.get("SCENE2HAP_COMPILED") != "0"


def compiled(plain: _Kernel) -> _Kernel:
    """The compiled twin of a plain function or class, or that itself where there is none; a decorator."""
    twin = _twin(plain) if _IS_WANTED else None
    KERNELS[f"{plain.__module__}.{plain.__qualname__}"] = (plain, twin)
    return plain if twin is None else twin


def are_in_use() -> bool:
    """Whether compiled kernels exist and are not switched off."""
    return _IS_WANTED and find_spec("scene2hap.contact._track") is not None


def _twin(plain: _Kernel) -> _Kernel | None:
    package, _, module = plain.__module__.rpartition(".")
    try:
        twins = import_module(f"{package}._{module}")
    except ImportError:
        return None
    twin: _Kernel | None = getattr(twins, plain.__name__, None)
    return twin
