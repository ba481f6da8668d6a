"""Seamless loops: cut a loop from a sound so that its seam is neither heard nor felt.

A loop of length L is cut from a longer sound x at s. Its first C samples are cross-faded with the C samples that follow
its end in x:

    y[i] = w_in(i) x[s + i] + w_out(i) x[s + L + i]   for i < C,        y[i] = x[s + i]   for C <= i < L

so that y[L - 1] is followed by y[0] = x[s + L], its true successor. The fade is inaudible if the two stretches are
similar. `seam_search` finds s and L with the greatest similarity, which for a tonal sound makes L a whole number of
cycles. `seam` fades them at constant power. `pair` cuts the audible and the tactile loop at the same place.
"""

from scene2hap.audio.loops.clip_part import LoopWarning, middle_of, without_silent_ends
from scene2hap.audio.loops.pair import loop_pair
from scene2hap.audio.loops.seam_search import MIN_CLIP_S

__all__ = ["MIN_CLIP_S", "LoopWarning", "loop_pair", "middle_of", "without_silent_ends"]
