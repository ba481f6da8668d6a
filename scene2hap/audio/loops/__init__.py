"""Loops whose seam is neither heard nor felt.

A loop of length L is cut from a longer sound x at s, and its first C samples are faded over from those behind its end:

    y[i] = w_in(i) x[s + i] + w_out(i) x[s + L + i]   for i < C,        y[i] = x[s + i]   for C <= i < L

so that y[L - 1] is followed by y[0] = x[s + L], its true successor. What the fade does to the sound depends on how
alike the two stretches are: `search` looks for s and L where they are most alike, which for a tonal sound makes L a
whole number of cycles; `seam` fades them over at constant power; `pair` cuts what is heard and what is felt together.
"""

from scene2hap.audio.loops.pair import (
    AUDIBLE_PEAK_DBFS,
    AUDIBLE_RANGE_HZ,
    loop_pair,
    make_loop,
    middle_of,
)
from scene2hap.audio.loops.seam import FadeLaw, Seam, apply_seam
from scene2hap.audio.loops.seam_search import CROSSFADE_S, MAX_LOOP_S, MIN_CLIP_S, find_seam

__all__ = [
    "AUDIBLE_PEAK_DBFS",
    "AUDIBLE_RANGE_HZ",
    "CROSSFADE_S",
    "MAX_LOOP_S",
    "MIN_CLIP_S",
    "FadeLaw",
    "Seam",
    "apply_seam",
    "find_seam",
    "loop_pair",
    "make_loop",
    "middle_of",
]
