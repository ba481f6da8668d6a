"""A loop that a person marked in a file. It is used as it is, so a mark at a bad place is said."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.common.warning import warn_of

_LEAST_JUMP, _MOST_OWN = 0.05, 2.0
"""Steps below this share of the peak, and up to this multiple of the largest step within the loop, do not count [-];
assumed: a knock 26 dB below the peak is masked by the sound, and so is a knock among many."""


class LoopWarning(UserWarning):
    """A loop that a person marked knocks where it repeats."""


def marked_part(clip: AudioClip, marked: tuple[int, int]) -> AudioClip:
    """Return the samples [first, end) of a clip that a person marked as its loop. Warns: LoopWarning: a jump."""
    loop = clip.part(*marked)
    step, own = abs(float(loop.samples[0]) - float(loop.samples[-1])), np.abs(np.diff(loop.samples)).max(initial=0.0)
    peak = float(np.abs(loop.samples).max())
    if step > max(_LEAST_JUMP * peak, _MOST_OWN * float(own)):
        warn_of(
            f"the loop that {clip.credit.title!r} marks jumps where it repeats, by {step / peak:.0%} of its peak, "
            f"{step / float(own):.0f} times its largest step elsewhere. This is heard and felt as a knock. Unless "
            "it is meant, mark another end in an audio editor, or delete the mark, and a seam is found.",
            LoopWarning,
        )
    return loop
