"""Freed memory that stays with the process once it has converted a sound.

The allocator of Linux (glibc) returns freed memory to the system if it exceeds twice the largest block that was ever
freed. A conversion takes and frees tens of megabytes in blocks of up to 4, and the system clears each page before it
gives it out again, which takes a fifth of the time of a short file. A block of 24 MB, which is freed unused, raises the
bound to 48 MB. The bound holds for each arena, and threads that allocate at once have arenas of their own: four threads
keep up to 192 MB. Other allocators do not change.
Source: mallopt(3), M_MMAP_THRESHOLD and M_TRIM_THRESHOLD; blocks of 32 MB and more have no effect.
"""

from __future__ import annotations

from functools import cache

import numpy as np

_BLOCK_BYTES = 24 << 20


@cache
def keep_freed_memory() -> None:
    """Keep up to 48 MB of freed memory per arena, from now on."""
    np.empty(_BLOCK_BYTES, dtype=np.uint8)
