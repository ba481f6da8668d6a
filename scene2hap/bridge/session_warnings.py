"""Forwarding of a session's warnings to its player and watchers."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

Tell = Callable[[dict[str, Any]], None]
Result = TypeVar("Result")

_tell: ContextVar[Tell | None] = ContextVar("tell", default=None)


def forwarding_warnings(tell: Tell, work: Callable[[], Result]) -> Result:
    """Run `work`, and forward its warnings through `tell` while `warnings_to_clients` is active."""
    before = _tell.set(tell)
    try:
        return work()
    finally:
        _tell.reset(before)


@contextmanager
def warnings_to_clients() -> Iterator[None]:
    """Send warnings to the clients of the session that raised them.

    This affects the whole program, since Python has only one function that shows warnings.
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("always", category=UserWarning)
        shown = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *rest: Any, **more: Any) -> None:
            tell = _tell.get()
            if tell is None:
                shown(message, category, *rest, **more)
            else:
                tell({"type": "warning", "message": str(message)})

        warnings.showwarning = show
        yield
