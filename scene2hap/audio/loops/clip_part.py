"""The part of a clip from which its loop is cut: the loop that a person marked, else the middle without silent ends."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.analysis import dynamic_range_db, sounding_span
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.loops.seam_search import CROSSFADE_S, LEAST_POWER, MAX_LOOP_S
from scene2hap.audio.select import MIN_DURATION_S
from scene2hap.common.warning import warn_of

_RUN_UP_S = 2.0
"""Run-up of converters [s] (assumed: their transients decay to imperceptibility within a tenth of this)."""
_LEVEL_STEP_S = 0.1
"""Resolution with which pauses are found [s]."""
_PAUSES_DB = 10.0
"""Dynamic range above which a sound has pauses [dB] (assumed: recorded hums, fans, engines and water have 1.5 to 7,
bells, ticks and speech 14 and more)."""
_LEAST_JUMP, _MOST_OWN = 0.05, 2.0
"""Steps below this share of the peak, and up to this multiple of the largest step within the loop, do not count [-];
assumed: a knock 26 dB below the peak is masked by the sound, and so is a knock among many."""


class LoopWarning(UserWarning):
    """A loop that a person marked knocks where it repeats."""


def without_silent_ends(clip: AudioClip) -> AudioClip:
    """Return a clip without its silent ends if what is left lasts more than `MIN_DURATION_S` and has no pauses.

    Otherwise the clip is returned: the silence is the pause of a knock, a beep or a rhythm. So is a clip with a loop
    that a person marked.
    """
    rate = clip.sample_rate_hz
    first, end = sounding_span(clip.samples, rate)
    is_whole = end - first == len(clip.samples)
    if is_whole or clip.loop is not None or end - first <= MIN_DURATION_S * rate:
        return clip
    return clip if dynamic_range_db(clip.samples[first:end], rate) > _PAUSES_DB else clip.part(first, end)


def middle_of(clip: AudioClip) -> AudioClip:
    """Return the middle of a clip, long enough for the longest loop and a run-up for converters on either side.

    The seam search uses only this part, so the rest of the clip would never be heard. If the middle is a pause, the
    nearest part with enough sound is taken. Of a clip with a marked loop, this loop is returned.
    Warns: LoopWarning: the marked loop jumps where it repeats.
    """
    if clip.loop is not None:
        return _marked_part(clip, clip.loop)
    rate = clip.sample_rate_hz
    n = round((MAX_LOOP_S + CROSSFADE_S + 2.0 * _RUN_UP_S) * rate)
    if len(clip.samples) <= n:
        return clip
    first = _first_of_middle(clip.samples, n, round(_RUN_UP_S * rate), max(1, round(_LEVEL_STEP_S * rate)))
    return clip.part(first, first + n)


def _first_of_middle(x: Samples, n: int, run_up: int, step: int) -> int:
    """Return the first of n samples around the middle of a sound, or around the nearest place that is no pause.

    Parameters: run_up : number of samples at either end of the n in which no loop lies; step : resolution [samples].
    """
    middle = (len(x) - n) // 2
    rows = x[: len(x) // step * step].reshape(-1, step)
    energies = np.einsum("ij,ij->i", rows, rows, dtype=np.float64) - step * float(x.mean(dtype=np.float64)) ** 2
    sums = np.concatenate([[0.0], np.cumsum(energies)])
    firsts = np.append(np.arange(0, len(x) - n + 1, step), middle)
    inside = (sums[(firsts + n - run_up) // step] - sums[(firsts + run_up) // step]) / (n - 2 * run_up)
    needed = min(LEAST_POWER * float(sums[-1]) / len(x), float(inside.max()))
    places = firsts[inside >= needed]
    return int(places[np.argmin(np.abs(places - middle))])


def _marked_part(clip: AudioClip, marked: tuple[int, int]) -> AudioClip:
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
