from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import butter, resample_poly, sosfiltfilt

from others import RECORDINGS, there
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.select import explain_choice, select_clip
from scene2hap.errors import AudioError
from starting_machines import machine

RATE = 48_000
T = np.arange(4 * RATE) / RATE
WHITE = np.random.default_rng(2).standard_normal(len(T))
HUM = sum(np.sin(2 * np.pi * 100 * k * T) / k for k in range(1, 6)) + 0.05 * WHITE


def clip(title: str, x: np.ndarray, rate: int = RATE) -> AudioClip:
    return AudioClip(0.1 * x / np.abs(x).max() if x.any() else x, rate, Credit(title, "test", "CC0-1.0"))


def clicks() -> np.ndarray:
    x = np.zeros(len(T))
    for at in range(0, len(T), RATE // 4):
        x[at : at + 960] = np.sin(2 * np.pi * 200 * T[:960]) * np.exp(-T[:960] / 0.005)
    return x


def test_selection_prefers_a_steady_hum_to_clicks_decays_noise_and_silence() -> None:
    pure = np.sin(2 * np.pi * 100 * T)
    candidates = [
        clip("clicks", clicks()),
        clip("decay", pure * np.exp(-T)),
        clip("noise", WHITE),
        clip("silence", np.zeros(len(T))),
        clip("short", pure[: 2 * RATE]),
        clip("hum", HUM),
    ]
    choice = explain_choice(candidates)
    assert choice.winner.credit.title == "hum"
    assert [row.title for row in choice.rows] == [each.credit.title for each in candidates]
    assert [row.verdict for row in choice.rows] == [
        "not steady: dynamic range above 5 dB",
        "not steady: dynamic range above 5 dB",
        "noisier than the chosen one",
        "silent",
        "too short: not longer than 2.5 s",
        "chosen",
    ]
    silence, short, hum = choice.rows[3:]
    assert (silence.duration_s, silence.dynamic_range_db, silence.flatness) == (0.0, None, None)
    assert (short.duration_s, short.dynamic_range_db, short.flatness) == (2.0, None, None)
    assert hum.duration_s == 4.0
    assert hum.dynamic_range_db is not None
    assert hum.dynamic_range_db < 1.0


def test_coded_noise_is_still_noisier_than_a_hum() -> None:
    """Noise without treble, or at a low sample rate, is still noisier than a hum with audible hiss."""
    hissing = HUM + 0.5 * WHITE
    lowpassed = sosfiltfilt(butter(8, 7500, fs=RATE, output="sos"), WHITE)
    for rival in (clip("codec", lowpassed), clip("codec", resample_poly(WHITE, 1, 6), 8000)):
        assert select_clip([rival, clip("hum", hissing)]).credit.title == "hum"


def test_steadiness_limit_is_raised_until_a_candidate_passes() -> None:
    # Linear falls in dB: 85 % of 14, 22 and 40 dB are dynamic ranges of 11.9, 18.7 and 34 dB.
    falls = [clip(f"{db} dB", np.sin(2 * np.pi * 100 * T) * 10 ** (-db * T / 4 / 20)) for db in (40, 22, 14)]
    choice = explain_choice(falls)
    assert choice.winner.credit.title == "14 dB"
    assert choice.rows[0].verdict == "not steady: dynamic range above 15 dB"


def test_the_winner_is_trimmed_and_peaks_at_exactly_one() -> None:
    x = np.concatenate([np.zeros(RATE), HUM, np.zeros(RATE)])
    winner = select_clip([clip("hum", x)])
    assert float(np.abs(winner.samples).max()) == 1.0
    assert winner.duration_s == pytest.approx(4.0, abs=0.021)


def test_selection_prefers_the_first_of_equal_candidates() -> None:
    assert select_clip([clip("one", HUM), clip("two", HUM), clip("three", HUM)]).credit.title == "one"


def test_clip_of_two_strokes_is_not_steady() -> None:
    """Nearly all frames are silent, so that both percentiles of all frames would lie in the silence."""
    since = np.maximum(0.0, np.minimum(T - 0.05, 4.0))
    pings = np.sin(2 * np.pi * 440 * since) * np.exp(-since / 0.01)
    pings += np.roll(pings, round(3.7 * RATE))
    pings[np.abs(pings) < 1e-4] = 0.0
    choice = explain_choice([clip("pings", pings), clip("hum", HUM + 0.5 * WHITE)])
    assert choice.winner.credit.title == "hum"
    assert choice.rows[0].verdict == "not steady: dynamic range above 5 dB"


def test_selection_refuses_silent_candidates() -> None:
    dither = np.round(np.random.default_rng(8).uniform(-1, 1, len(T))) / 32768
    silent = [AudioClip(np.zeros(len(T)), RATE), AudioClip(dither, RATE), AudioClip(np.full(len(T), 0.3), RATE)]
    with pytest.raises(AudioError, match="none of 3 candidates is long enough"):
        explain_choice(silent)


def test_choice_lists_origin_and_scores_of_each_candidate() -> None:
    found = replace(clip("hum", HUM), credit=Credit("hum", "someone", "CC0-1.0", "https://sounds.test/1"))
    stored = replace(clip("hiss", WHITE), credit=Credit("hiss", "someone", "CC0-1.0", origin="library"))
    short = clip("short", HUM[:RATE])
    choice = explain_choice([found, stored, short])
    assert [row.origin for row in choice.rows] == ["https://sounds.test/1", "library", "test"]
    assert [row.is_chosen for row in choice.rows] == [True, False, False]
    assert choice.rows[0].frequency_raw_hz == pytest.approx(100.0, abs=0.01)
    assert choice.rows[0].frequency_tactile_hz == pytest.approx(100.0, abs=0.01)
    assert choice.rows[2].frequency_raw_hz is None


def test_a_printed_choice_escapes_names_of_files() -> None:
    assert "\x1b" not in str(explain_choice([clip("\x1b[2Jhum", HUM)]))


def test_choice_is_printed_as_a_table() -> None:
    lines = str(explain_choice([clip("hiss", WHITE), clip("hum", HUM), clip("short", HUM[:RATE])])).splitlines()
    assert lines[0].split() == [
        "sound",
        "origin",
        "s",
        "range",
        "dB",
        "flatness",
        "peak",
        "Hz",
        "10-1000",
        "Hz",
        "verdict",
    ]
    assert [line.startswith("->") for line in lines] == [False, False, True, False]
    assert lines[2].endswith("chosen")
    assert lines[1].endswith("noisier than the chosen one")
    assert " ".join(lines[3].split()) == "short test 1.00 - - - - too short: not longer than 2.5 s"
    verdicts = {line.index(text) for line, text in zip(lines[1:], ("noisier", "chosen", "too short"), strict=True)}
    assert len(verdicts) == 1


def test_selection_fades_only_the_ends_that_it_cut() -> None:
    whole = select_clip([clip("whole", HUM)]).samples
    assert whole[0] == pytest.approx(HUM[0] / np.abs(HUM).max(), abs=1e-6)
    cut = select_clip([clip("cut", np.concatenate([np.zeros(RATE), HUM + 1e-3]))]).samples
    assert cut[0] == 0.0
    n = round(0.005 * RATE)
    np.testing.assert_allclose(cut[n:] / cut[n], (HUM + 1e-3)[n:] / (HUM + 1e-3)[n], rtol=1e-3, atol=1e-3)
    assert cut[-1] != 0.0


def test_error_names_the_longest_of_too_short_candidates() -> None:
    padded = np.concatenate([np.zeros(3 * RATE), HUM[: 2 * RATE]])
    with pytest.raises(AudioError, match=r"none of 2 candidates .* longest, 'padded', lasts 2\.00 s .* above 2\.5 s"):
        select_clip([clip("quiet", np.zeros(5 * RATE)), clip("padded", padded)])
    with pytest.raises(AudioError, match="longest, 'just', lasts 2.50 s"):
        select_clip([clip("just", HUM[: 5 * RATE // 2])])
    with pytest.raises(AudioError, match="no candidate to choose from"):
        select_clip([])


SAW_CLOCK_FAN_OVEN = {
    "own": ["own saw", "own clock", "own fan", "own oven"],
    "recorded": ["chainsaw_3-118972-A.ogg", "clock_tick_1-62849-A.ogg", "computer_fan_hum.wav", "oven_hum.wav"],
}


@pytest.mark.parametrize("by_whom", ["own", *there(["recorded"], lambda _: RECORDINGS)])
def test_selection_prefers_a_steady_hum_among_machines(sound: Callable[[str], AudioClip], by_whom: str) -> None:
    candidates = [sound(name) for name in SAW_CLOCK_FAN_OVEN[by_whom]]
    choice = explain_choice(candidates)
    assert choice.winner.credit.title == candidates[-1].credit.title
    assert choice.rows[2].verdict == "noisier than the chosen one"
    assert all(row.verdict.startswith("not steady") for row in choice.rows[:2])


def test_selection_cuts_start_and_stop_before_scoring() -> None:
    take = machine(start_s=2.0, stop_s=3.0)
    choice = explain_choice([AudioClip(take.clip.samples, take.clip.sample_rate_hz, Credit("mixer", "", ""))])
    (row,) = choice.rows
    assert row.dynamic_range_db is not None
    assert row.dynamic_range_db < 2.0
    assert choice.start_up is not None
    assert choice.wind_down is not None
    assert row.verdict == (
        f"chosen; has a start of {choice.start_up.lasts_s:.1f} s and a stop of {choice.wind_down.lasts_s:.1f} s"
    )
    assert choice.winner.duration_s == pytest.approx(5.0, rel=0.1)
