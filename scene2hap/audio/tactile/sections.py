"""Second-order filter sections in series, whose state is carried from one block to the next.

    y = b0 x + z0        z0 = b1 x + z1 - a1 y        z1 = b2 x - a2 y

Transposed direct form II.
"""

from __future__ import annotations

import numpy as np
import scipy

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled

VANISHED = 1e-200
"""A filter state below this cannot affect a float32 any more, but would slow the processor down as it decays."""


@compiled
def through_sections(sections: Floats, x: Floats, state: Floats) -> Floats:
    """Filter rows (n_rows, n) by sections (n_sections, 6) of b0 b1 b2 1 a1 a2. Returns: (n_rows, n).

    Parameters: state : (n_sections, n_rows, 2), the state of the sections, which is updated.
    """
    y, state[:] = scipy.signal.sosfilt(sections, x, zi=state)
    state[np.abs(state) < VANISHED] = 0.0
    return np.asarray(y)
