"""In which objects a corrected bundle differs from the one that a session plays."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle


def changed_objects(before: HapticBundle, after: HapticBundle) -> list[str]:
    """Ids of objects whose haptics or tactile loops differ, in the order of `after`."""
    ids = dict.fromkeys((*after.objects, *before.objects))
    return [
        key
        for key in ids
        if before.objects.get(key) != after.objects.get(key)
        or not _are_equal(before.loops.get(key, {}), after.loops.get(key, {}))
    ]


def _are_equal(one: Mapping[str, HapticLoop], other: Mapping[str, HapticLoop]) -> bool:
    """Whether both have the same states in the same order, and sound alike to the hand."""
    return list(one) == list(other) and all(_is_same(one[state], other[state]) for state in one)


def _is_same(one: HapticLoop, other: HapticLoop) -> bool:
    a, b = one.tactile, other.tactile
    return a is b or (a.sample_rate_hz == b.sample_rate_hz and np.array_equal(a.samples, b.samples))
