"""Counters of the work that a session leaves out."""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.session.frame import SkipCounts


@dataclass
class Counts:
    """The fields of `SkipCounts` that are counted here, and gains that were capped."""

    unreachable_objects: int = 0
    unreachable_touches: int = 0
    changes_out_of_reach: int = 0
    below_threshold: int = 0
    silent_bands: int = 0
    idle_hands: int = 0
    unchanged_frames: int = 0
    gains_capped: int = 0

    def skipped(self, rows_not_mixed: int) -> SkipCounts:
        """Copy the present counts into a `SkipCounts`."""
        counted = {name: count for name, count in vars(self).items() if name != "gains_capped"}
        return SkipCounts(rows_not_mixed=rows_not_mixed, **counted)
