"""The audible and the tactile loop of a clip, cut by one seam."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.conversion.clips import convert_clip, convert_loop
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.levels import FAINTEST_PEAK_DB, TACTILE_HEADROOM_DB, is_noise, most_felt_hz
from scene2hap.audio.loops.level_period import level_period
from scene2hap.audio.loops.seam_search import MAX_LOOP_S, MIN_CLIP_S, find_seam
from scene2hap.audio.loops.whole import is_between_silences, meets_itself, whole_loop
from scene2hap.audio.protocol import ConversionContext, TactileConverter, follows_component
from scene2hap.audio.seam import apply_seam
from scene2hap.common import checks
from scene2hap.errors import AudioError

AUDIBLE_PEAK_DBFS = -1.0
"""Peak of every audible loop [dB re 1]; the usual margin for players that resample."""

AUDIBLE_RANGE_HZ = (20.0, 20_000.0)


def loop_pair(
    clip: AudioClip,
    converter: TactileConverter,
    context: ConversionContext,
    finish: Callable[[Samples], Samples] | None = None,
) -> HapticLoop:
    """Make the audible and the tactile loop of a clip, cut at the same place.

    The whole clip is converted before it is cut, so that a converter's transient lies outside the loop. The offset of a
    recording is removed. The seam is chosen for both signals; each has its own fade law. The audible loop peaks at
    `AUDIBLE_PEAK_DBFS`, the tactile one at `context.intensity` times full scale less `TACTILE_HEADROOM_DB`. If the
    converter leaves only the recording's noise (`levels.is_noise`), this noise is not amplified. A clip that is a
    vibration already is looped whole. It is converted only if its frequency is to be moved. A sound between silences
    without a beat is looped whole, too. A loop that a person marked is the audible loop as it is; its repetition is
    converted.

    Parameters: finish : last step for the tactile loop, such as equalizing it for an actuator.
    Raises: AudioError: the clip is shorter than `MIN_CLIP_S`, or the clip or its conversion is silent.
    """
    intensity = checks.number("intensity", context.intensity, "-", above=0.0, at_most=1.0, error=AudioError)
    rate = clip.sample_rate_hz
    if clip.duration_s < MIN_CLIP_S:
        raise AudioError(
            f"{clip.credit.title!r} lasts {clip.duration_s:.3g} s; it must last at least {MIN_CLIP_S:g} s. Use a "
            "longer sound."
        )
    peak = float(np.abs(clip.samples - clip.samples.mean(dtype=np.float64)).max())
    if 0.0 < peak < 10 ** (FAINTEST_PEAK_DB / 20):
        raise AudioError(
            f"{clip.credit.title!r} peaks at {20 * np.log10(peak):.0f} dB re full scale; below {FAINTEST_PEAK_DB:g} dB "
            "is the noise of a recording, which nobody wants to feel. Choose another sound, or raise its level."
        )
    audible, tactile = _looped(clip, converter, context)
    for name, loop in (("sound", audible), ("tactile signal", tactile)):
        if not loop.any():
            raise AudioError(f"{clip.credit.title!r}: the {name} is silent. Choose another sound or converter.")
    felt = tactile
    if not is_noise(peak, float(np.abs(tactile).max()), is_chosen=follows_component(converter, context)):
        felt = _with_peak(tactile, intensity * 10 ** (-TACTILE_HEADROOM_DB / 20))
        felt = felt if finish is None else finish(felt)
    # `is_vibration` decides how a clip is looped; a bundle does not store it for loops.
    cut = replace(clip, is_vibration=False, loop=None)
    return HapticLoop(
        replace(cut, samples=_with_peak(audible, 10 ** (AUDIBLE_PEAK_DBFS / 20))),
        replace(cut, samples=felt),
        analysis.dominant_frequency_hz(audible, rate, range_hz=AUDIBLE_RANGE_HZ),
        most_felt_hz(felt, rate, context.actuator),
    )


def _looped(clip: AudioClip, converter: TactileConverter, context: ConversionContext) -> tuple[Samples, Samples]:
    if clip.is_vibration:
        vibration = clip if context.own_hz == context.target_hz else convert_clip(clip, converter, context)
        loop = whole_loop(vibration.samples, clip.sample_rate_hz)
        return loop, loop
    if clip.loop is not None:
        marked = clip.part(*clip.loop)
        return marked.samples, convert_loop(marked, converter, context)
    from_zero = _without(clip, float(clip.samples[0]))
    if _repeats_whole(from_zero):
        converted = convert_clip(from_zero, converter, context, from_rest=True)
        if meets_itself(converted.samples):
            return from_zero.samples, converted.samples
    clip = _without(clip, float(clip.samples.mean(dtype=np.float64)))
    converted = convert_clip(clip, converter, context)
    seam = find_seam(clip.samples, clip.sample_rate_hz, converted.samples)
    return apply_seam(clip.samples, seam), apply_seam(converted.samples, seam.fitted(converted.samples))


def _without(clip: AudioClip, offset: float) -> AudioClip:
    return replace(clip, samples=clip.samples - np.float32(offset))


def _repeats_whole(clip: AudioClip) -> bool:
    """Return True if a clip is short, lies between silences, and has no beat that its length would break."""
    x, rate = clip.samples, clip.sample_rate_hz
    if clip.duration_s > MAX_LOOP_S or clip.duration_s < MIN_CLIP_S or not is_between_silences(x, rate):
        return False
    return level_period(x.astype(np.float64), rate) is None


def _with_peak(samples: Samples, peak: float) -> Samples:
    return np.asarray(samples * (peak / np.abs(samples).max().astype(np.float64)), dtype=np.float32)
