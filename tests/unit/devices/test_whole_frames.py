"""Rendering by time gives the exact number of samples at any frame rate."""

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import soundfile

from scene2hap import HapticSession, MemorySink, TeeSink, WavSink
from scene2hap.devices.whole_frames import WholeFrames
from scene2hap.errors import SessionError
from scenes import table_with_two_phones

NTSC = Fraction(60000, 1001)  # 59.94 frames per second


@pytest.mark.parametrize("frame_rate_hz", [90, 72, NTSC, 144, Fraction(11988, 100), 1000])
@pytest.mark.parametrize("sample_rate_hz", [48000, 44100])
def test_frame_sizes_of_a_minute_sum_to_all_samples(frame_rate_hz: Fraction, sample_rate_hz: int) -> None:
    whole = WholeFrames(sample_rate_hz)
    n_frames = round(60 * frame_rate_hz)
    blocks = [whole.of(float(1 / frame_rate_hz)) for _ in range(n_frames)]
    assert sum(blocks) == round(n_frames / Fraction(frame_rate_hz) * sample_rate_hz)
    assert max(blocks) - min(blocks) <= 1


def test_rounding_error_never_exceeds_half_a_sample() -> None:
    whole, total = WholeFrames(48000), 0
    for i in range(1, 90 * 60):
        total += whole.of(1 / 90)
        assert abs(total - Fraction(48000 * i, 90)) <= Fraction(1, 2) + Fraction(1, 10**6)


def test_frame_sizes_of_uneven_frames_sum_to_all_samples() -> None:
    whole = WholeFrames(48000)
    times_s = [0.011, 0.0, 0.0123, 1e-6, 0.5, 3.3e-5] * 1000
    assert sum(map(whole.of, times_s)) == round(sum(map(Fraction, times_s)) * 48000)


@pytest.mark.parametrize("seconds", [-1e-9, float("nan"), float("inf"), 48000, "1", None, True])
def test_invalid_duration_is_refused_and_changes_no_state(seconds: Any) -> None:
    whole = WholeFrames(48000)
    with pytest.raises(SessionError, match="seconds is"):
        whole.of(seconds)
    assert [whole.of(1 / 90) for _ in range(3)] == [533, 534, 533]


@pytest.mark.parametrize("rate_hz", [8000, 44100, 48000])
def test_a_time_that_is_too_long_is_refused_as_a_time(rate_hz: int) -> None:
    """Of 1000 s at 48 kHz, meant as milliseconds, the message spoke of frames and advised to give a time."""
    session, longest_s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": rate_hz}), 67_108_864 // rate_hz
    with pytest.raises(SessionError, match=rf"seconds is \d+ s; it must be at most {longest_s} \[s\]\. Give seconds"):
        session.render_s(longest_s + 1)
    assert WholeFrames(rate_hz).of(longest_s) == longest_s * rate_hz


def test_every_pulled_sink_accepts_durations(tmp_path: Path) -> None:
    memory, wav = MemorySink(), WavSink(tmp_path / "touch.wav")
    for sink in (memory, wav, TeeSink([MemorySink(), MemorySink()])):
        with HapticSession(*table_with_two_phones(), {"sample_rate_hz": 8000}, sink=sink) as session:
            for _ in range(90):
                session.update()
                sink.pull_s(1 / 90)
            assert sink.stats.frames in (8000, 16000)
    begun = memory.samples[:8000]
    assert (soundfile.read(wav.path, always_2d=True)[0][:8000] - begun == 0).all()


def test_reopened_sink_starts_with_no_remainder() -> None:
    sink = MemorySink()
    session = HapticSession(*table_with_two_phones(), {"sample_rate_hz": 8000}, sink=sink)
    for _ in range(2):
        with session:
            assert [len(sink.pull_s(1 / 90)) for _ in range(3)] == [89, 89, 89]


def test_a_session_without_a_sink_renders_by_time() -> None:
    session = HapticSession(*table_with_two_phones(), {"sample_rate_hz": 8000})
    assert sum(len(session.render_s(1 / 90)) for _ in range(90)) == 8000
    assert session.position == 8000
