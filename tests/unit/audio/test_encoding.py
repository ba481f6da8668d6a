from __future__ import annotations

import io
import struct
import wave
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scene2hap.audio.encoding import PcmSubtype, encoded
from scene2hap.audio.files import read_clip
from scene2hap.errors import AudioError

RATE = 8000


def tone(n: int = RATE, amplitude: float = 0.5) -> NDArray[np.float32]:
    return (amplitude * np.sin(2 * np.pi * 200 * np.arange(n) / RATE)).astype(np.float32)


def test_equal_samples_give_equal_bytes_and_other_samples_do_not(tmp_path: Path) -> None:
    for name, amplitude in (("a.wav", 0.5), ("b.wav", 0.5), ("c.wav", 0.4)):
        (tmp_path / name).write_bytes(encoded(tone(amplitude=amplitude), RATE))
    a, b, c = ((tmp_path / name).read_bytes() for name in ("a.wav", "b.wav", "c.wav"))
    assert a == b
    assert a != c
    # A RIFF header with chunks "fmt " and "data" and three bytes per sample: no space for a time stamp.
    assert len(a) == 44 + 3 * RATE
    assert b"PEAK" not in a


@pytest.mark.parametrize(("subtype", "bits"), [("PCM_16", 16), ("PCM_24", 24)])
def test_wav_round_trip_is_bit_exact(tmp_path: Path, subtype: PcmSubtype, bits: int) -> None:
    (tmp_path / "first.wav").write_bytes(encoded(tone(), RATE, subtype))
    clip = read_clip(tmp_path / "first.wav")
    np.testing.assert_allclose(clip.samples, tone(), rtol=0, atol=max(0.5 / 2 ** (bits - 1), 2**-25))
    (tmp_path / "second.wav").write_bytes(encoded(clip.samples, RATE, subtype))
    np.testing.assert_array_equal(read_clip(tmp_path / "second.wav").samples, clip.samples)


def test_full_scale_is_written_with_an_error_of_one_step_at_most(tmp_path: Path) -> None:
    (tmp_path / "full.wav").write_bytes(encoded(np.array([1.0, -1.0, 0.0], np.float32), RATE, "PCM_16"))
    assert read_clip(tmp_path / "full.wav").samples.tolist() == [32767 / 32768, -1.0, 0.0]


@pytest.mark.parametrize("bad", [1.0001, -1.5, np.nan, np.inf])
def test_clipping_is_refused(bad: float) -> None:
    samples = tone()
    samples[7] = bad
    with pytest.raises(AudioError, match=r"largest sample is .*; it must be within 1"):
        encoded(samples, RATE)


def test_wrong_shapes_rates_and_subtypes_are_refused() -> None:
    with pytest.raises(AudioError, match=r"shape \(0,\)"):
        encoded([], RATE)
    with pytest.raises(AudioError, match=r"shape \(2, 2, 2\)"):
        encoded(np.zeros((2, 2, 2)), RATE)
    with pytest.raises(AudioError, match="sample_rate_hz is 0 Hz"):
        encoded(tone(), 0)
    with pytest.raises(AudioError, match="subtype is 'FLOAT'"):
        encoded(tone(), RATE, "FLOAT")  # type: ignore[arg-type]  # wrong on purpose


def test_file_keeps_both_channels(tmp_path: Path) -> None:
    both = np.stack([tone(), -tone()], axis=1)
    (tmp_path / "two.wav").write_bytes(encoded(both, RATE))
    read, rate = soundfile.read(tmp_path / "two.wav", dtype="float32")
    assert rate == RATE
    np.testing.assert_allclose(read, both, rtol=0, atol=2**-24)


@pytest.mark.parametrize(("n", "channels"), [(4800, 1), (4801, 1), (4801, 4)])
def test_a_loop_says_so_in_its_header(n: int, channels: int) -> None:
    samples = np.stack([tone(n)] * channels, axis=1)
    content = encoded(samples, RATE, is_loop=True)
    assert content == encoded(samples, RATE, is_loop=True)
    # By libsndfile: SF_INSTRUMENT with its loops, (mode, start, end, count); 801 is forwards.
    with soundfile.SoundFile(io.BytesIO(content)) as file:
        np.testing.assert_allclose(file.read(always_2d=True), samples, atol=2**-23)
        found = soundfile._ffi.new("int[128]")
        assert soundfile._snd.sf_command(file._file, 0x10D0, found, 4 * 68) == 1
    assert struct.unpack("<12xI4I", bytes(soundfile._ffi.buffer(found))[:32]) == (1, 801, 0, n, 0)
    # By the rules of RIFF: every chunk begins at an even byte, and the last ends with the file.
    chunks, at = {}, 12
    while at < len(content):
        size = int.from_bytes(content[at + 4 : at + 8], "little")
        chunks[content[at : at + 4]] = content[at + 8 : at + 8 + size]
        at += 8 + size + size % 2
    assert at == len(content) == 8 + int.from_bytes(content[4:8], "little")
    assert struct.unpack("<15I", chunks[b"smpl"])[-5:] == (0, 0, n - 1, 0, 0)
    with wave.open(io.BytesIO(content)) as reader:
        assert (reader.getnframes(), reader.getnchannels()) == (n, channels)


def test_only_loops_have_the_chunk_of_loops() -> None:
    assert b"smpl" not in encoded(tone(), RATE)
