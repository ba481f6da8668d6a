"""Loops as a `LoopBank` holds them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.render.loop_bank import CELL, LoopBank


def read_loop(bank: LoopBank, loop: int, begin: int, n: int) -> NDArray[np.float32]:
    """Read n samples of a loop from a position, cell by cell."""
    cells = [np.zeros((bank.n_bands, CELL), dtype=np.float32) for _ in range(-(-n // CELL))]
    for i, cell in enumerate(cells):
        bank.read([loop], begin + i * CELL, cell)
    return np.concatenate(cells, axis=1)[:, :n]
