"""Memory that is used again and again: pages that a process gets anew cost more than the products that go into them."""

from __future__ import annotations

import math
import threading

import numpy as np
from numpy.typing import NDArray

ROOM = 2_000_000
"""Complex numbers that a thread keeps at most, 32 MB."""


class Workspace:
    """Arrays one after another in memory that is given out again after `clear`."""

    def __init__(self) -> None:
        self._memory = np.empty(ROOM, dtype=np.complex128)
        self._used = 0

    def clear(self) -> None:
        """All that was given out may be overwritten."""
        self._used = 0

    def array(self, *shape: int) -> NDArray[np.complex128]:
        """An array with anything in it; memory of its own where there is no more room."""
        begin = self._used
        end = begin + math.prod(shape)
        if end > ROOM:
            return np.empty(shape, dtype=np.complex128)
        self._used = end
        return self._memory[begin:end].reshape(shape)


_of_thread = threading.local()


def workspace() -> Workspace:
    """That of this thread, cleared."""
    own: Workspace | None = getattr(_of_thread, "workspace", None)
    if own is None:
        own = _of_thread.workspace = Workspace()
    own.clear()
    return own
