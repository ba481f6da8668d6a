"""Voices made of single events: bubbles, ticks, blows, beeps, notes.

Levels, decays and patterns are tuned. If a frequency follows from physics, the docstring says so.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.sources.synth.signals import (
    DURATION_S,
    N_SAMPLES,
    SAMPLE_RATE_HZ,
    Take,
    noise,
    partials,
    phase,
    ringing,
    times,
    unit_peak,
    unit_rms,
)
from scene2hap.common.arrays import Floats

_BUBBLE_CLASSES = 10
_BUBBLE_CYCLES = 3.0
_BUBBLE_SPREAD = 0.3
"""Standard deviation of the bubbles' pitches, as a share of their range on a logarithmic scale [-]. With all sizes
equally frequent, the frequency at which a kettle was felt was random within two octaves."""


def bubbles(take: Take, *, largest_hz: float, smallest_hz: float, per_second: float = 600.0) -> Floats:
    """Boiling or sizzling: random bubbles of many sizes, each ringing at its own pitch, more of them at a high drive.

    A bubble of radius R rings at 3.26 / R [Hz] (Minnaert, Phil. Mag. 16, 1933): 100 Hz for 33 mm, 400 Hz for 8 mm.
    Middle sizes are the most frequent, as in a log-normal distribution: the ends are 12 dB weaker (assumed).
    """
    pitches = np.geomspace(largest_hz, smallest_hz, _BUBBLE_CLASSES)
    levels = np.exp(-0.5 * (np.linspace(-0.5, 0.5, _BUBBLE_CLASSES) / _BUBBLE_SPREAD) ** 2)
    n = round(per_second * (0.6 + 0.8 * take.drive) * DURATION_S / _BUBBLE_CLASSES)
    y = np.zeros(N_SAMPLES)
    for pitch, level in zip(pitches, levels, strict=True):
        at = take.rng.uniform(0.0, DURATION_S, n)
        strength = take.rng.uniform(0.5, 1.0, n) * take.rng.choice((-1.0, 1.0), n)
        y += level * unit_rms(ringing(at, strength, pitch, _BUBBLE_CYCLES / pitch))
    return unit_rms(y) + 0.1 * noise(take.rng, 60.0, 1500.0, -3.0)


def blows(
    take: Take, *, per_second: float, body_hz: float, decay_s: float, click_hz: float = 1200.0, click: float = 0.2
) -> Floats:
    """Equal blows on a body that rings at its own pitch: the ticks of a clock, the strokes of a jackhammer."""
    n = round(per_second * DURATION_S)
    at = (np.arange(n) + 0.3) / per_second
    strength = 1.0 + 0.05 * take.rng.uniform(-1.0, 1.0, n)
    body = unit_peak(ringing(at, strength, take.shaft_hz(body_hz), decay_s))
    edge = unit_peak(ringing(at, strength, take.about(click_hz), 0.003))
    return body + click * (0.5 + take.drive) * edge


def buzzer(take: Take, *, pitch_hz: float, on_s: float = 0.0, off_s: float = 0.0, on_mains: bool = False) -> Floats:
    """An armature that hits its stop once per cycle, for `on_s` and `off_s` seconds in turn; always on without them.

    One `on_mains` has `pitch_hz` at a mains frequency of 50 Hz.

    The clear beep of a piezo disc lies in the kilohertz, where nothing is felt; this is the buzz of its case.
    """
    phi = phase(take.magnet_hz(pitch_hz) if on_mains else take.about(pitch_hz, 0.01))
    tone = partials(phi, take.roll_off(8, 0.3), take.rng)
    if on_s == 0.0:
        return tone
    gate = (times() % (on_s + off_s) < on_s).astype(np.float64)
    edge = np.hanning(round(0.01 * SAMPLE_RATE_HZ))
    return tone * np.convolve(gate, edge / edge.sum(), mode="same")


def telephone_bell(
    take: Take, *, ringing_hz: float = 25.0, case_hz: float = 230.0, on_s: float = 1.0, off_s: float = 2.0
) -> Floats:
    """An old telephone: a clapper that shakes the case at `ringing_hz`, since one of its two gongs is nearer.

    The gongs ring far above the range of touch, the case at `case_hz`. Exchanges of Japan ring for one second in three
    (from memory). The one in five of most of Europe leaves a single ring in a clip, too short to be chosen for a loop.
    """
    at = (np.arange(round(ringing_hz * DURATION_S)) + 0.5) / ringing_hz
    strength = 1.0 * (at % (on_s + off_s) < on_s)
    case = unit_peak(ringing(at, strength, take.about(case_hz), 0.008))
    gongs = unit_peak(ringing(at, strength, take.about(1500.0), 0.05))
    return case + 0.15 * (0.5 + take.drive) * gongs


def music(take: Take, *, beats_per_minute: float = 120.0) -> Floats:
    """A loudspeaker that plays: a bass line of four notes, one per beat, and a drum under every second beat."""
    beat_s = 60.0 / beats_per_minute
    root_hz = take.about(65.4, 0.05)
    t = times()
    beat = np.floor(t / beat_s).astype(np.int64)
    since_s = t - beat * beat_s
    line = root_hz * 2.0 ** (take.rng.permutation([0, 0, 7, 10])[beat % 4] / 12.0)
    # Phase restarts with each beat, so that every bar is the same and the piece loops.
    note = np.exp(-since_s / 0.6) * (1.0 - np.exp(-since_s / 0.01))
    bass = partials(2.0 * np.pi * line * since_s, [1.0, 0.4, 0.15])
    drum = np.where(beat % 2 == 0, np.sin(2.0 * np.pi * 55.0 * since_s) * np.exp(-since_s / 0.08), 0.0)
    release = np.minimum(1.0, (beat_s - since_s) / 0.02)
    return (bass * note + (0.6 + 0.8 * take.drive) * drum) * release
