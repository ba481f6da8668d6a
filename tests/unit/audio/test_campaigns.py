"""Short forms of the campaigns in stress/audio.py."""

from __future__ import annotations

import numpy as np
import pytest

from others import RECORDINGS, there
from own_sounds import OWN_HUMS, OWN_SOUNDS, own_sound
from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.conversion import convert_clip
from scene2hap.audio.loops.seam_search import find_seam
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.seam import apply_seam
from scene2hap.audio.select import explain_choice
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from seam_judge import judge
from sound_draws import HUMS, RATES, chopped, coloured_noise, hum_among_decoys, hum_in_noise, loop_clip, recordings

OWN = {name: (own_sound(name).samples.astype(float), own_sound(name).sample_rate_hz) for name in OWN_SOUNDS}
REAL = {"own": (OWN, OWN_HUMS), "recorded": (recordings(), HUMS)}


def by_whom() -> list[str]:
    return ["own", *there(["recorded"], lambda _: RECORDINGS)]


def test_the_pitch_of_a_hum_in_noise_is_right_to_a_fiftieth_of_a_hertz() -> None:
    for seed in range(12):
        truth, x, rate = hum_in_noise(np.random.default_rng([1, seed]))
        assert analysis.dominant_frequency_hz(x, rate) == pytest.approx(truth, abs=0.02), seed


@pytest.mark.parametrize("kind", [*by_whom(), "noise", "tone", "beat"])
def test_loop_wrap_is_no_larger_step_than_other_places_of_the_loop(kind: str) -> None:
    real = REAL[kind][0] if kind in REAL else {}
    stands_out = []
    for seed in range(3):
        rng = np.random.default_rng([2, seed])
        name, x, rate, _ = loop_clip("recording" if real else kind, rng, real)
        x = x[: 2 * rate]
        felt = convert_clip(AudioClip(x, rate), SvfBandpass(), ConversionContext()).samples.astype(float)
        seam = find_seam(x, rate, felt)
        for signal, law in ((x, seam), (felt, seam.fitted(felt))):
            verdict = judge(apply_seam(signal, law), signal, rate, rng)
            if not verdict.passes:
                stands_out.append((seed, name, verdict))
    assert len(stands_out) <= 1, stands_out


def test_seam_judge_detects_randomly_cut_tones_and_rumble() -> None:
    """The judge must be able to fail. By chance, a randomly cut tone of 30 to 500 Hz has no step in 1 to 8 % of cases,
    and rumble in 20 %."""
    noticed = {"tone": 0, "brown": 0}
    for seed in range(8):
        rng = np.random.default_rng([3, seed])
        _, x, rate, _ = loop_clip("tone", rng, {})
        noticed["tone"] += not judge(chopped(x[:rate], rng), x[:rate], rate, rng).passes
        rumble = coloured_noise(rng, RATES[1], 2.0)
        noticed["brown"] += not judge(chopped(rumble, rng), rumble, RATES[1], rng).passes
    assert noticed["tone"] >= 6
    assert noticed["brown"] >= 4


def test_seam_judge_detects_a_level_jump_in_a_varying_sound() -> None:
    """With the largest jump of 200 positions as limit, this jump would pass."""
    rng, rate = np.random.default_rng(6), RATES[1]
    t = np.arange(12 * rate) / rate
    surge = 1.0 + 0.8 * np.sin(2 * np.pi * 0.7 * t)
    x = surge * coloured_noise(rng, len(t), 1.0)
    x[2 * rate :][: rate // 50] *= 8.0  # one bang
    loop = x[round(0.36 * rate) : round(1.07 * rate)]  # from loud to soft
    verdict = judge(loop, x, rate, rng)
    assert verdict.jump_db > 0.5
    assert not verdict.passes


@pytest.mark.parametrize("maker", by_whom())
def test_selection_prefers_a_hum_to_other_search_results(maker: str) -> None:
    lost = []
    for seed in range(1):
        title, candidates = hum_among_decoys(np.random.default_rng([4, seed]), *REAL[maker])
        choice = explain_choice(candidates)
        if choice.winner.credit.title != title:
            lost.append(str(choice))
    assert not lost, "\n\n".join(lost)
