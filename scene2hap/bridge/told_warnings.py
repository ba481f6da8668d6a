"""Warnings of a session, sent to those who play and watch it."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

_here = threading.local()


def tell_warnings_of_this_thread(tell: Callable[[dict[str, Any]], None]) -> None:
    """Send what this thread warns of by `tell`, while `warnings_to_clients` is on."""
    _here.tell = tell


@contextmanager
def warnings_to_clients() -> Iterator[None]:
    """Hand warnings to the clients of the session on whose thread they arise. For a whole program, on its main thread:
    Python has one place where warnings go."""
    with warnings.catch_warnings():
        warnings.filterwarnings("always", category=UserWarning)
        shown = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *rest: Any, **more: Any) -> None:
            tell = getattr(_here, "tell", None)
            if tell is None:
                shown(message, category, *rest, **more)
            else:
                tell({"type": "warning", "message": str(message)})

        warnings.showwarning = show
        yield
