"""Remembering what a function said about the arrays that it was asked last."""

from __future__ import annotations

from collections.abc import Callable
from threading import Lock
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

Answer = TypeVar("Answer")


class Recall(Generic[Answer]):
    """A function of arrays that remembers its last answers.

    A worker may prepare a field while the game's thread asks another, so that both may call.
    """

    def __init__(self, function: Callable[..., Answer], room: int = 16) -> None:
        self._function, self._room = function, room
        self._known: dict[tuple[bytes, ...], Answer] = {}
        self._lock = Lock()

    def __call__(self, *arrays: NDArray[np.float64]) -> Answer:
        """What the function says of these arrays; those of equal bytes are the same, so shapes must not vary."""
        key = tuple([array.tobytes() for array in arrays])
        answer = self._known.get(key)
        if answer is None:
            answer = self._function(*arrays)
            with self._lock:
                if len(self._known) >= self._room:
                    del self._known[next(iter(self._known))]
                self._known[key] = answer
        return answer
