"""Level follower: keep the level of the bed (the continuous part of a vibration) in step with that of the whole sound.

The envelope of a narrow band of steady noise, or of a few beating partials, varies: the band of a fan whose level stays
within 1 dB would vary by 6 dB. L are the levels of sound and bed in 60 ms. M is the level of the whole bed relative to
the whole sound; if it is unknown, M is the mean of their difference over two seconds, weighted by energy:

    difference d = L_bed - L_sound        gain -(d - M) + sign(d - M) `FREE_DB`   where |d - M| > `FREE_DB`, else 0 dB

A bed within `FREE_DB` is unchanged, bit for bit. The stage has a latency of 35 ms. A live stream has no time for
it: its levels are those of the last 60 ms, weighted towards the present.

A window of 60 ms would smooth the sudden beginning of a syllable. Where the sound changes by `CHANGED` from one half of
the window to the other, the gain follows from the half on its own side of the change. Shorter windows everywhere would
flatten beats of 20 Hz and more, which distinguish machines.

If the motion of a resonant actuator for its drive is known (`rendered`), L_bed is the level of this motion. A band
beside the resonance is amplified as far as `HEADROOM_DB` allows, and the sine at the resonance supplies the rest.

The gain is bounded. A bed that needs more is next to nothing: the pitch has left its band, or another part of the sound
plays alone. If M and the frequency at which the sound is felt are known, a sine at that frequency supplies the energy
that is missing, so that the rise and fall of the whole sound is felt:

    a = sqrt(2 E_bed (10^(lift / 10) - 10^(`MOST_LIFTED_DB` / 10)))      lift: the gain that is needed [dB]

It follows from the whole window. The filters of a bed delay it by 10 to 30 ms, so that a half window would begin each
sound with the sine. The equalizer of a resonant actuator amplifies its sharp front, which would use up the head-room.
"""

from __future__ import annotations

import math

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from scene2hap.audio.spectra.windows import hann
from scene2hap.audio.tactile.onsets import STEP_S as LIVE_STEP_S
from scene2hap.audio.tactile.oscillator import Oscillator
from scene2hap.audio.tactile.stages import Stage
from scene2hap.audio.tactile.step_energies import StepEnergies
from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled

STEP_S = 0.005
CHANGED = 2.5
"""Ratio of the energies in both halves of a window at which the sound changes suddenly [-] (4 dB; assumed). Beats and
noise of most machines stay below it."""
FREE_DB = 0.5
"""Deviation that stays uncorrected [dB]; twice this is below the 2.5 dB that touch notices."""
MOST_LIFTED_DB, MOST_LOWERED_DB = 15.0, 20.0
"""Largest gain and attenuation [dB]; a weaker bed is mostly noise (assumed)."""
_STEPS, _AHEAD = 12, 6
"""Steps of a window, and those of them that lie ahead of the gain."""
_LIVE_STEPS = 24
"""Steps of a live window. They are as long as those of the stage of onsets, which gives whole steps, so that the
follower need not wait."""
FORGET = float(np.exp(-STEP_S / 2.0))
"""Share of the mean over two seconds that is kept from one step to the next [-]."""
HEADROOM_DB = 6.0
"""Most by which the drive of a rendered bed may exceed the level of its sound [dB]; the sine supplies the rest."""
NOTHING = 1e-12
"""Energy below which there is neither sound nor bed (-120 dB re full scale)."""


class LevelFollower(Stage):
    """Keeps the level of a bed at a constant difference from that of its sound.

    If `felt_hz` is given, a sine of this frequency replaces a bed that is too weak. If the stream is live, each gain
    follows from the samples before it, and blocks of whole live steps come back at once. `rendered` is the motion of
    the actuator for its drive; without it both are equal.
    """

    def __init__(
        self,
        bed: Stage,
        sample_rate_hz: float,
        bed_db: float | None = None,
        felt_hz: float | None = None,
        *,
        is_live: bool = False,
        rendered: Stage | None = None,
    ) -> None:
        self._bed, self._bed_db, self._rendered = bed, bed_db, rendered
        self._sine = None if felt_hz is None or bed_db is None else Oscillator(felt_hz, sample_rate_hz)
        self._n_made = 0
        step_s, self._n_ahead = (LIVE_STEP_S, 0) if is_live else (STEP_S, _AHEAD)
        self._step = max(1, round(step_s * sample_rate_hz))
        self._sound = np.empty(0)  # whose bed is held back
        self._waiting = np.empty(0)
        self._heard = [StepEnergies(self._step) for _ in range(2 if rendered is None else 3)]
        window = hann(2 * _LIVE_STEPS)[:_LIVE_STEPS] if is_live else hann(_STEPS)
        self._window = window / window.sum()
        # Of sound, bed and rendered bed, by steps, from before the start.
        self._energies = np.zeros((len(self._heard), len(window) - self._n_ahead))
        self._means = np.zeros(2)
        self._rising = rising_over(self._step)
        self._gains = np.empty((2, 0))  # of bed and sine, at the beginning of the next step

    def run(self, x: Floats) -> Floats:
        """Return the samples whose level is known."""
        return self._followed(x, self._bed.run(x))

    def rest(self) -> Floats:
        """Return the last samples, as if silence followed."""
        left = self._bed.rest()
        parts = [self._followed(np.empty(0), left)] if left.size else []
        n_waiting, n_after = len(self._waiting), (self._n_ahead + 2) * self._step
        silence = np.zeros(n_after)
        parts.append(self._followed(silence, silence)[:n_waiting])
        return np.concatenate(parts)

    def _followed(self, x: Floats, y: Floats) -> Floats:
        self._waiting = np.concatenate([self._waiting, y]) if self._waiting.size else y
        sound = np.concatenate([self._sound, x]) if self._sound.size else x
        x, self._sound = sound[: len(y)], sound[len(y) :]
        parts = (x, y) if self._rendered is None else (x, y, self._rendered.run(y))
        energies = [of.next(part) for of, part in zip(self._heard, parts, strict=True)]
        self._energies = np.concatenate([self._energies, energies], axis=1)
        n = self._energies.shape[1] - len(self._window) + 1
        if n < 1:
            return np.empty(0)
        usual_db = np.nan if self._bed_db is None else self._bed_db
        found = gains_of(self._energies, self._window, self._n_ahead, usual_db, self._means)
        gains = np.concatenate([self._gains, found], axis=1)
        if self._gains.size == 0:
            gains[1, 0] = 0.0  # a sine that begins at once clicks
        self._energies = self._energies[:, n:]
        self._gains = gains[:, -1:]
        return self._released(*gains)

    def _released(self, gains: Floats, amplitudes: Floats) -> Floats:
        """Return the n - 1 steps between gains of the bed (n,), each faded from one gain to the next, plus the sine."""
        n = (len(gains) - 1) * self._step
        y, self._waiting = self._waiting[:n], self._waiting[n:]
        start, self._n_made = self._n_made, self._n_made + n
        felt = faded(y, gains, self._rising)
        if self._sine is not None and np.count_nonzero(amplitudes):
            felt += self._sine.times(faded(np.ones(n), amplitudes, self._rising), start)[1]
        return felt


@compiled
def gains_of(energies: Floats, window: Floats, n_ahead: int, usual_db: float, means: Floats) -> Floats:
    """Return the gains of bed and sine at the beginnings of n steps (2, n), each from its window.

    Parameters: energies : of sound, bed and rendered bed, if it differs, by steps (2 or 3, n + len(window) - 1);
    n_ahead : steps of the window after the gain, half of them, or 0 for a live stream; usual_db : M, nan if unknown;
    means : the filtered energies of sound and bed (2,), updated by this function.
    """
    # Sums of windows one by one, since the rounding of a convolution depends on the block size.
    steps = sliding_window_view(energies, len(window), axis=1)
    weighted, middle = steps * window, len(window) - n_ahead
    before, after = weighted[..., :middle].sum(axis=2), weighted[..., middle:].sum(axis=2)
    levels = before + after
    sound, bed = levels[0], levels[-1]
    usual: Floats | float = usual_db
    if math.isnan(usual_db):
        slow, left = scipy.signal.lfilter([1.0 - FORGET], [1.0, -FORGET], [sound, bed], axis=1, zi=means[:, None])
        usual, means[:] = _ratio_db(*slow), left[:, 0]
    lifts, most = _lifts(levels, usual)
    lacking = 10.0 ** (np.maximum(lifts, most) / 10.0) - 10.0 ** (most / 10.0)
    if n_ahead:
        early, late = before[0] + NOTHING, after[0] + NOTHING
        changes = np.maximum(early, late) > CHANGED * np.minimum(early, late)
        # The side of the change on which the gain lies; a half has half of the window's weight.
        now = 0.25 * (steps[0, :, middle - 1] + steps[0, :, middle]) + NOTHING
        is_late = (now**2 > early * late) == (late > early)
        own_lifts, own_most = _lifts(np.where(is_late, after, before), usual)
        # Half a window may end before the drive begins, so that it seems weak: the head-room is that of the whole one.
        lifts, most = np.where(changes, (own_lifts, np.minimum(own_most, most)), (lifts, most))
    gains = 10.0 ** (np.clip(lifts, -MOST_LOWERED_DB, most) / 20.0)
    return np.stack([gains, np.sqrt(2.0 * (bed + NOTHING) * lacking)])


def _lifts(levels: Floats, usual: Floats | float) -> tuple[Floats, Floats]:
    """Return the gains that beds need, and the largest they may have [dB]; levels : energies as in `gains_of`."""
    sound, drive, bed = levels[0], levels[1], levels[-1]
    beyond = _ratio_db(sound, bed) - usual
    most = np.full(len(bed), MOST_LIFTED_DB)
    if len(levels) > 2:
        most = np.clip(HEADROOM_DB - _ratio_db(sound, drive), -MOST_LOWERED_DB, MOST_LIFTED_DB)
    return np.clip(beyond, -FREE_DB, FREE_DB) - beyond, most


def _ratio_db(sound: Floats, bed: Floats) -> Floats:
    """Return the level of the bed relative to its sound [dB], from their energies (n,)."""
    return np.asarray(10.0 * np.log10((bed + NOTHING) / (sound + NOTHING)))


def rising_over(step: int) -> Floats:
    """Return the share of the later gain in each sample of a step (step,), a raised cosine [-].

    A straight ramp has corners, which click where actuators are heard and not felt: a tone that rises from -20 to
    -6 dB in 5 ms has a peak of -50 dB above 1.2 kHz, and one of -75 dB by this ramp.
    """
    return np.asarray(0.5 - 0.5 * np.cos(np.pi / step * np.arange(step)))


@compiled
def faded(y: Floats, gains: Floats, rising: Floats) -> Floats:
    """Apply a gain that changes from one of gains (n + 1,) to the next in each of n steps of y.

    Parameters: rising : the share of the later gain in each sample of a step.
    """
    ramp = (gains[1:] - gains[:-1])[:, None] * rising
    ramp += gains[:-1, None]
    felt = ramp.reshape(-1)
    felt *= y
    return felt
