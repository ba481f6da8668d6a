"""Conversion of files that are loops: the result repeats without a gap, and says that it is a loop."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap.audio import convert
from scene2hap.audio.encoding import encoded
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.errors import AudioError, ConfigError

RATE = 16_000


def a_machine(seconds: float = 2.0, channels: int = 1) -> np.ndarray:
    """A loop (n, channels) that has no seam: whole cycles of a hum, its harmonics and its beat, and an offset."""
    t = np.arange(round(seconds * RATE)) / RATE
    hum = sum(a * np.sin(2 * np.pi * f * t) for f, a in ((58.0, 0.1), (116.0, 0.15), (174.0, 0.1), (1430.0, 0.05)))
    one = 0.1 + (1 + 0.4 * np.sin(2 * np.pi * 4.0 * t)) * hum
    return np.stack([one * 0.8**k for k in range(channels)], axis=1)


def write_loop(path: Path, samples: np.ndarray) -> Path:
    soundfile.write(path, samples, RATE, subtype="PCM_24")
    content = encoded(samples[:, 0], RATE, "PCM_24", is_loop=True)  # a mark as other tools write it
    body = path.read_bytes()[8:] + content[content.index(b"smpl") :]
    path.write_bytes(b"RIFF" + len(body).to_bytes(4, "little") + body)
    return path


def marked(path: Path) -> tuple[int, int] | None:
    """First and last sample of the loop in a WAV, by the published layout of its chunk."""
    content = path.read_bytes()
    at = content.find(b"smpl")
    if at < 0:
        return None
    n_loops, _, _, kind, first, last = struct.unpack("<6I", content[at + 36 : at + 60])
    assert (n_loops, kind) == (1, 0)
    return first, last


def steepest(samples: np.ndarray) -> tuple[float, float]:
    """Largest third difference within a loop, and at its wrap: a jump, a corner or a bend shows in it."""
    twice = np.concatenate([samples, samples])
    bends = np.abs(np.diff(twice, 3, axis=0)).max(axis=1)
    n = len(samples)
    return float(bends[: n - 3].max()), float(bends[n - 3 : n].max())


@pytest.mark.filterwarnings("ignore::scene2hap.audio.sensation.LevelWarning")
@pytest.mark.parametrize("kind", CONVERTERS.builtins)
@pytest.mark.parametrize("actuator", ["flat", "lra"])
def test_a_converted_loop_repeats_without_a_gap(tmp_path: Path, kind: str, actuator: str) -> None:
    source = write_loop(tmp_path / "hum.wav", a_machine())
    made = convert(source, tmp_path / "felt.wav", converter=kind, actuator=actuator, intensity=0.4)
    felt, rate = soundfile.read(made.output, always_2d=True)
    assert made.is_loop
    assert (len(felt), rate) == (2 * RATE, RATE)
    assert marked(made.output) == (0, len(felt) - 1)
    inside, at_wrap = steepest(felt)
    assert at_wrap <= 1.5 * inside
    n = round(0.02 * RATE)
    levels = np.sqrt((felt[: len(felt) // n * n].reshape(-1, n) ** 2).mean(axis=1))
    assert levels[[0, -1]].min() >= 0.4 * levels[2:-2].min()


def test_of_a_tone_the_loop_is_the_tone(tmp_path: Path) -> None:
    """A linear filter in its steady state turns a tone into a tone: nothing of the beginning or the end is left."""
    t = np.arange(RATE) / RATE
    source = write_loop(tmp_path / "tone.wav", 0.3 * np.sin(2 * np.pi * 150.0 * t)[:, None])
    felt, _ = soundfile.read(convert(source, tmp_path / "felt.wav", converter="svf_bandpass").output)
    spectrum = np.abs(np.fft.rfft(felt))
    assert spectrum.argmax() == 150
    assert np.delete(spectrum, 150).max() < 1e-3 * spectrum[150]


def test_channels_have_the_loop_of_their_own_sound(tmp_path: Path) -> None:
    source = write_loop(tmp_path / "stereo.wav", a_machine(channels=2))
    felt, _ = soundfile.read(convert(source, tmp_path / "felt.wav", converter="lowpass", intensity=0.2).output)
    np.testing.assert_allclose(felt[:, 1], 0.8 * felt[:, 0], atol=3e-4)


def test_a_loop_shorter_than_its_run_up(tmp_path: Path) -> None:
    source = write_loop(tmp_path / "short.wav", a_machine(0.25)[: RATE // 4])
    made = convert(source, tmp_path / "felt.wav")
    felt, _ = soundfile.read(made.output, always_2d=True)
    assert len(felt) == RATE // 4
    assert made.is_loop


def test_a_silent_loop_stays_silent(tmp_path: Path) -> None:
    made = convert(write_loop(tmp_path / "silence.wav", np.zeros((RATE, 1))), tmp_path / "felt.wav")
    assert (made.is_loop, made.peak_out) == (True, 0.0)


def test_only_the_caller_knows_that_an_unmarked_file_is_a_loop(tmp_path: Path) -> None:
    source = tmp_path / "hum.flac"
    soundfile.write(source, a_machine(), RATE)
    assert not convert(source, tmp_path / "ends.wav").is_loop
    assert convert(source, tmp_path / "loop.wav", loop=True).is_loop
    assert marked(tmp_path / "ends.wav") is None
    assert marked(tmp_path / "loop.wav") == (0, 2 * RATE - 1)
    assert convert(source, tmp_path / "loop.flac", loop=True).is_loop


def test_a_marked_file_may_be_converted_as_a_sound_that_ends(tmp_path: Path) -> None:
    source = write_loop(tmp_path / "hum.wav", a_machine())
    made = convert(source, tmp_path / "ends.wav", loop=False)
    felt, _ = soundfile.read(made.output)
    assert not made.is_loop
    assert marked(made.output) is None
    assert np.abs(felt[-3:]).max() < 1e-3


def test_a_file_that_marks_a_part_of_itself_ends(tmp_path: Path) -> None:
    samples = a_machine()
    source = tmp_path / "part.wav"
    source.write_bytes(encoded(samples[:, 0], RATE, "PCM_24", loop=(RATE // 2, RATE)))
    assert not convert(source, tmp_path / "felt.wav").is_loop


def test_a_loop_of_seconds_at_most(tmp_path: Path) -> None:
    source = tmp_path / "rain.wav"
    soundfile.write(source, np.zeros(8000 * 61), 8000)
    with pytest.raises(AudioError, match=r"lasts 61 s; a loop lasts 0\.1 to 60 s.*--no-loop"):
        convert(source, tmp_path / "felt.wav", loop=True)


def test_the_converter_alone_closes_no_loop(tmp_path: Path) -> None:
    source = write_loop(tmp_path / "hum.wav", a_machine())
    assert not convert(source, tmp_path / "felt.wav", raw=True).is_loop
    with pytest.raises(ConfigError, match="raw or loop"):
        convert(source, tmp_path / "felt.wav", raw=True, loop=True)
