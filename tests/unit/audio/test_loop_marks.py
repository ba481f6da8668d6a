"""A loop that a WAV marks is the loop: files written by libsndfile, by hand, and as other programs leave them."""

import struct
import warnings
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import AudioClip
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.audio.loops import LoopWarning, loop_pair, middle_of
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.recorded_runs import recorded_runs
from scene2hap.audio.select import explain_choice
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile

RATE = 8000
FORWARDS, ALTERNATING = 0, 1


def tone(duration_s: float, rate: int = RATE, hertz: float = 120.0) -> np.ndarray:
    return 0.5 * np.sin(2 * np.pi * hertz * np.arange(round(duration_s * rate)) / rate)


def marked(path: Path, samples: np.ndarray, *loops: tuple[int, int, int], rate: int = RATE) -> Path:
    """Write a WAV of 16 bits whose chunk "smpl" comes before the samples, after a chunk of an odd length."""
    data = (samples * 32767).astype("<i2").tobytes()
    rows = b"".join(struct.pack("<6I", i, kind, first, last, 0, 0) for i, (kind, first, last) in enumerate(loops))
    chunks = [
        (b"fmt ", struct.pack("<HHIIHH", 1, 1, rate, 2 * rate, 2, 16)),
        (b"note", b"odd"),
        (b"smpl", struct.pack("<9I", 0, 0, 10**9 // rate, 60, 0, 0, 0, len(loops), 0) + rows),
        (b"data", data),
    ]
    body = b"WAVE" + b"".join(name + struct.pack("<I", len(c)) + c + bytes(len(c) % 2) for name, c in chunks)
    path.write_bytes(b"RIFF" + struct.pack("<I", len(body)) + body)
    return path


@pytest.mark.parametrize("rate", [8000, 22_050, 44_100, 48_000, 96_000])
def test_a_loop_that_libsndfile_writes_is_read_as_it_is(tmp_path: Path, rate: int) -> None:
    path = tmp_path / "fan.wav"
    with soundfile.SoundFile(path, "w", rate, 1, "PCM_16") as file:
        # SF_INSTRUMENT: gain, base note, detune, velocities, keys; number of loops; mode (801: forwards), start, end.
        about = struct.pack("<i6bxxi4I", 1, 60, 0, 0, 127, 0, 127, 1, 801, rate // 4, rate, 0).ljust(272, b"\0")
        assert soundfile._snd.sf_command(file._file, 0x10D1, soundfile._ffi.from_buffer(about), 272) == 1
        file.write(tone(2.0, rate))
    assert read_clip(path).loop == (rate // 4, rate)


def test_of_several_loops_the_first_that_runs_forwards_counts(tmp_path: Path) -> None:
    loops = (ALTERNATING, 0, 3999), (FORWARDS, 1000, 8999), (FORWARDS, 0, 1999)
    assert read_clip(marked(tmp_path / "a.wav", tone(2.0), *loops)).loop == (1000, 9000)


@pytest.mark.parametrize(
    "loop",
    [(ALTERNATING, 0, 7999), (FORWARDS, 0, 16_000), (FORWARDS, 9000, 8000), (FORWARDS, 100, 200)],
    ids=["alternating", "behind the end", "backwards", "some cycles of an instrument"],
)
def test_a_mark_that_is_no_loop_of_the_file_is_left_out(tmp_path: Path, loop: tuple[int, int, int]) -> None:
    assert read_clip(marked(tmp_path / "a.wav", tone(2.0), loop)).loop is None


def test_files_without_a_mark_or_with_half_a_chunk_are_read(tmp_path: Path) -> None:
    for name in ("a.wav", "a.flac", "a.ogg"):
        soundfile.write(tmp_path / name, tone(1.0), RATE)
        assert read_clip(tmp_path / name).loop is None
    path = marked(tmp_path / "cut.wav", tone(1.0), (FORWARDS, 0, 7999))
    path.write_bytes(path.read_bytes().replace(b"smpl" + struct.pack("<I", 60), b"smpl" + struct.pack("<I", 40)))
    assert marked(tmp_path / "none.wav", tone(1.0)).stat().st_size < path.stat().st_size
    assert read_clip(tmp_path / "none.wav").loop is None


def test_a_marked_clip_is_written_with_its_mark(tmp_path: Path) -> None:
    clip = read_clip(marked(tmp_path / "a.wav", tone(2.0), (FORWARDS, 1000, 8999)))
    (tmp_path / "b.wav").write_bytes(encoded(clip.samples, RATE, loop=clip.loop))
    assert read_clip(tmp_path / "b.wav").loop == (1000, 9000)


@pytest.mark.parametrize("loop", [(0, 8001), (5, 5), (-1, 5), (0.5, 5), (True, 5), (1, 2, 3), "ab", 3])
def test_a_loop_outside_of_its_samples_is_refused(loop: object) -> None:
    with pytest.raises(AudioError, match="loop"):
        AudioClip(tone(1.0), RATE, loop=loop)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["auto", "adaptive", "svf_bandpass", "envelope"])
@pytest.mark.parametrize("n", [RATE // 5, RATE + 100])
def test_the_marked_part_is_the_loop_and_its_vibration_repeats(kind: str, n: int) -> None:
    # 120 Hz is a whole number of cycles in neither: the mark is the loop even if a better seam exists.
    x = tone(3.0)
    x[:4000] *= np.linspace(0.0, 1.0, 4000)
    clip = AudioClip(x, RATE, loop=(5000, 5000 + n))
    context = ConversionContext(ActuatorProfile(), 0.5)
    loop = loop_pair(clip, CONVERTERS.build(kind), context)
    part = x[5000 : 5000 + n]
    np.testing.assert_allclose(
        loop.audible.samples, part * np.abs(loop.audible.samples).max() / np.abs(part).max(), atol=1e-6
    )
    assert len(loop.tactile.samples) == n
    assert loop.audible.loop is None
    steps = np.abs(np.diff(loop.tactile.samples))
    assert abs(loop.tactile.samples[0] - loop.tactile.samples[-1]) <= 1.1 * steps.max()


def test_a_loop_whose_end_opposes_its_beginning_is_interrupted_for_milliseconds_only() -> None:
    """A shift by 250.5 Hz turns by half a cycle in each second, so that a loop of one second ends in opposition.

    A fade between opposed waves takes 20 ms. Of any 30 ms of the loop, 10 ms keep their level, so that these 30 ms keep
    a third of their energy: -4.8 dB. With a fade of 0.2 s, 30 ms in its middle had -17 dB.
    """
    rate = 16_000
    clip = AudioClip(tone(1.0, rate, 500.0), rate, loop=(0, rate))
    converter = CONVERTERS.build({"kind": "frequency_shift", "shift_hz": -250.5})
    felt = loop_pair(clip, converter, ConversionContext()).tactile.samples.astype(float)
    energies = np.convolve(np.concatenate([felt, felt]) ** 2, np.ones(480), "valid")
    assert energies.min() >= energies.max() / 3.0 * 0.9


def test_a_choice_and_the_middle_of_a_clip_keep_the_marked_part() -> None:
    x = tone(30.0)
    clip = AudioClip(x, RATE, loop=(1000, 21_000))
    assert middle_of(clip) == AudioClip(x[1000:21_000], RATE, clip.credit, loop=(0, 20_000))
    winner = explain_choice([clip]).winner
    np.testing.assert_allclose(winner.samples, x[1000:21_000] / np.abs(x).max(), atol=1e-6)
    assert winner.loop == (0, 20_000)


def test_a_start_counts_only_outside_of_the_marked_part() -> None:
    n, rng = 3 * RATE, np.random.default_rng(0)
    x = tone(5.0) * np.concatenate([np.zeros(RATE), np.linspace(0, 1, RATE), np.ones(n)]) + 1e-4 * rng.normal(
        size=5 * RATE
    )
    found = recorded_runs(x, RATE)
    assert found.start_up is not None
    after = recorded_runs(x, RATE, (3 * RATE, 4 * RATE))
    assert (after.start_up, after.first, after.end) == (found.start_up, 3 * RATE, 4 * RATE)
    assert recorded_runs(x, RATE, (RATE, 4 * RATE)).start_up is None


def test_a_mark_at_a_bad_place_is_said(tmp_path: Path) -> None:
    """In an earlier version a loop that jumps knocked at each repetition, without a word to the user."""
    sound = tone(2.0)
    # 1050 samples are 15.75 cycles of 120 Hz: the loop ends at the trough of the tone, and begins at zero.
    path = marked(tmp_path / "knocking fan.wav", sound, (FORWARDS, 0, 1049))
    said = r"'knocking fan' marks jumps .* by (99|100)% of its peak, 11 times its largest"
    with pytest.warns(LoopWarning, match=said):
        middle_of(read_clip(path))
    noise = np.random.default_rng(0).uniform(-0.3, 0.3, 2 * RATE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        middle_of(read_clip(marked(tmp_path / "whole cycles.wav", sound, (FORWARDS, 0, 7999))))
        middle_of(read_clip(marked(tmp_path / "noise.wav", noise, (FORWARDS, 0, 7999))))
