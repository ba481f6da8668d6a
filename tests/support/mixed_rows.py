"""Gains of all rows of a mixer's bank, set as a session sets them: loops whose gains are all 0 are left out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.render.mixer import Mixer


def set_gains(mixer: Mixer, gains: NDArray[np.float32], at_frame: int, n_bands: int = 1) -> None:
    """Set gains (n_hands, n_rows) from a frame on; a row is a band of a loop."""
    by_loop = gains.reshape(len(gains), -1, n_bands)
    loops = np.flatnonzero(by_loop.any(axis=(0, 2))).tolist()
    mixer.set_gains(by_loop[:, loops], loops, at_frame)
