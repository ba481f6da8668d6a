from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import audio
from scene2hap.audio.clip import Credit
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import READABLE, SUFFIXES, read_clip
from scene2hap.errors import AudioError

RATE = 8000


def tone(n: int = RATE, amplitude: float = 0.5) -> np.ndarray:
    return (amplitude * np.sin(2 * np.pi * 200 * np.arange(n) / RATE)).astype(np.float32)


@pytest.mark.parametrize("suffix", ["flac", "ogg", "mp3", "wav"])
def test_read_clip_reads_common_formats_and_averages_channels(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"two.{suffix}"
    soundfile.write(path, np.stack([tone(amplitude=0.6), tone(amplitude=0.2)], axis=1), RATE)
    clip = read_clip(path)
    assert clip.sample_rate_hz == RATE
    assert clip.credit == Credit("two", "unknown", "unknown")
    middle = clip.samples[2000:6000].astype(float)
    # Lossy codecs delay and distort a little; the mean of 0.6 and 0.2 stays 0.4.
    assert np.sqrt(2 * np.mean(middle**2)) == pytest.approx(0.4, rel=0.03)


def test_channels_that_cancel_each_other_are_not_mixed(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    hum, room = tone(amplitude=0.5), 0.005 * rng.standard_normal(len(tone())).astype(np.float32)
    (tmp_path / "wired.wav").write_bytes(encoded(0.1 + np.stack([0.8 * hum, room - hum], axis=1), RATE))
    heard = read_clip(tmp_path / "wired.wav").samples
    np.testing.assert_allclose(heard, 0.1 + room - hum, atol=1e-6)


@pytest.mark.parametrize("n_channels", [2, 6, 64])
def test_channels_without_anything_in_common_are_mixed(tmp_path: Path, n_channels: int) -> None:
    noises = 0.1 * np.random.default_rng(2).standard_normal((4000, n_channels)).clip(-5, 5)
    noises[:, 1] = 0.0
    (tmp_path / "noises.wav").write_bytes(encoded(noises, RATE))
    np.testing.assert_allclose(read_clip(tmp_path / "noises.wav").samples, noises.mean(axis=1), atol=1e-6)


def test_read_clip_keeps_the_given_credit(tmp_path: Path) -> None:
    (tmp_path / "a.wav").write_bytes(encoded(tone(), RATE))
    credit = Credit("hum", "someone", "CC0-1.0")
    assert read_clip(str(tmp_path / "a.wav"), credit).credit is credit


@pytest.mark.parametrize("suffix", sorted(SUFFIXES))
def test_every_format_is_read_and_converted(tmp_path: Path, suffix: str) -> None:
    formats = {".aif": "AIFF", ".oga": "OGG", ".opus": "OGG"}
    path = tmp_path / f"hum{suffix}"
    subtype = "OPUS" if suffix == ".opus" else None
    soundfile.write(path, tone(), RATE, subtype=subtype, format=formats.get(suffix, suffix[1:].upper()))
    assert read_clip(path).duration_s == pytest.approx(1.0, abs=0.1)
    assert audio.convert(path, tmp_path / "felt.wav").duration_s == pytest.approx(1.0, abs=0.1)


def test_the_docstring_of_convert_names_every_format() -> None:
    assert READABLE in (audio.convert.__doc__ or "")


def test_read_clip_refuses_files_that_are_not_sounds(tmp_path: Path) -> None:
    (tmp_path / "text.wav").write_text("not audio")
    (tmp_path / "nothing.wav").write_bytes(b"")
    (tmp_path / "headerless.raw").write_bytes(bytes(1000))
    for name in ("text.wav", "nothing.wav", "headerless.raw"):
        with pytest.raises(AudioError, match=rf"{name}: not a readable sound .* WAV, FLAC"):
            read_clip(tmp_path / name)
    for absent in (tmp_path / "absent.wav", tmp_path):
        with pytest.raises(AudioError, match="is not a file"):
            read_clip(absent)


def test_a_sound_without_samples_is_refused(tmp_path: Path) -> None:
    soundfile.write(tmp_path / "empty.wav", np.zeros((0, 1), np.float32), RATE)
    with pytest.raises(AudioError, match=r"empty\.wav has no samples"):
        read_clip(tmp_path / "empty.wav")


def test_read_clip_refuses_nan_and_states_its_index(tmp_path: Path) -> None:
    samples = tone()
    samples[123] = np.nan
    soundfile.write(tmp_path / "broken.wav", samples, RATE, subtype="FLOAT")
    with pytest.raises(AudioError, match=r"broken\.wav: sample 123 is .*nan"):
        read_clip(tmp_path / "broken.wav")


def test_read_clip_refuses_a_long_file_before_decoding(tmp_path: Path) -> None:
    soundfile.write(tmp_path / "long.wav", np.zeros(15 * 60 * 100, np.int16), 100)
    with pytest.raises(AudioError, match=r"lasts 900 s; it must be at most 600 s"):
        read_clip(tmp_path / "long.wav")


@pytest.mark.parametrize("stated", [None, 1_500_000_000, 3_000_000_000])
def test_a_file_cut_short_is_refused(stated: int | None, tmp_path: Path) -> None:
    whole = encoded(tone(), RATE)
    size = whole[4:8] if stated is None else struct.pack("<I", stated)
    (tmp_path / "a.wav").write_bytes(whole[:4] + size + whole[8 : len(whole) // 2])
    with pytest.raises(AudioError, match="is cut short"):
        read_clip(tmp_path / "a.wav")


@pytest.mark.parametrize("before", [b"", b"LIST\x04\0\0\0INFO"])
@pytest.mark.parametrize(
    ("of_file", "of_samples"),
    [
        (0xFFFF_FFFF, 0xFFFF_FFFF),  # ffmpeg
        (0, 0),  # earlier versions of ffmpeg
        (36, 0),  # GStreamer: the length of the header, without the chunks that others add to it
        (0, 0xFFFF_FFFF),
        (0x7FFF_F024, 0x7FFF_F000),  # sox, espeak
        (0x7FFF_EFFE + 36, 0x7FFF_EFFE),  # sox, three channels of two bytes: a whole number of frames
        (0x7FFF_FFFF, 0x7FFF_FFDB),
        (0x8000_0024, 0x8000_0000),  # arecord
    ],
)
@pytest.mark.parametrize("is_silent_at_first", [False, True])
def test_a_wav_that_was_written_into_a_pipe_is_read_to_its_end(
    of_file: int, of_samples: int, before: bytes, is_silent_at_first: bool, tmp_path: Path
) -> None:
    samples = np.concatenate([np.zeros(is_silent_at_first * RATE, dtype=np.float32), tone()])
    whole = encoded(samples, RATE)
    at = whole.index(b"data")
    head = b"RIFF" + struct.pack("<I", of_file) + whole[8:at] + before + b"data" + struct.pack("<I", of_samples)
    path = tmp_path / "a.wav"
    path.write_bytes(head + whole[at + 8 :])
    np.testing.assert_allclose(read_clip(path).samples, samples, rtol=0, atol=2**-23)


def test_a_wav_of_known_size_without_samples_is_refused(tmp_path: Path) -> None:
    whole = encoded(tone(), RATE)
    at = whole.index(b"data")
    (tmp_path / "a.wav").write_bytes(whole[: at + 4] + bytes(4) + whole[at + 8 :])
    with pytest.raises(AudioError, match="has no samples"):
        read_clip(tmp_path / "a.wav")


def test_a_wav_whose_header_states_the_size_of_the_whole_file_is_read(tmp_path: Path) -> None:
    """RIFF counts what follows its first eight bytes; some programs write the size of the file."""
    path = tmp_path / "a.wav"
    whole = encoded(tone(), RATE)
    path.write_bytes(whole[:4] + len(whole).to_bytes(4, "little") + whole[8:])
    assert len(read_clip(path).samples) == RATE


def test_a_rate_beyond_any_recorder_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "fan.wav"
    soundfile.write(path, np.zeros(2000), 2**31 - 1, subtype="PCM_16")
    with pytest.raises(AudioError, match=r"sample_rate_hz is 2\.14748e\+09 Hz; it must be at most 1000000"):
        read_clip(path)


def without_beginning(vorbis: bytes, n: int) -> bytes:
    """The file as an editor leaves it that cuts off n samples without encoding again: its pages count from there on."""
    table = []
    for byte in range(256):
        register = byte << 24
        for _ in range(8):
            register = (register << 1 ^ (0x04C11DB7 if register & 1 << 31 else 0)) & 0xFFFFFFFF
        table.append(register)
    pages, at = [], 0
    while at < len(vorbis):
        n_segments = vorbis[at + 26]
        page = bytearray(vorbis[at : at + 27 + n_segments + sum(vorbis[at + 27 : at + 27 + n_segments])])
        at += len(page)
        (n_before,) = struct.unpack_from("<q", page, 6)
        if n_before:
            struct.pack_into("<qIII", page, 6, n_before - n, *struct.unpack_from("<II", page, 14), 0)
            checksum = 0
            for byte in page:
                checksum = (checksum << 8 & 0xFFFFFFFF) ^ table[checksum >> 24 ^ byte]
            struct.pack_into("<I", page, 22, checksum)
        pages.append(bytes(page))
    return b"".join(pages)


@pytest.mark.parametrize("is_cancelled", [False, True])
def test_a_vorbis_file_whose_beginning_was_cut_off_is_read_and_converted(tmp_path: Path, is_cancelled: bool) -> None:
    """libsndfile 1.2.2 reads such a file, but cannot return to its beginning."""
    noise = 0.3 * np.random.default_rng(0).standard_normal(40_000)
    right = -noise if is_cancelled else noise
    soundfile.write(tmp_path / "whole.ogg", np.stack([noise, right], axis=1), 44_100)
    path = tmp_path / "cut.ogg"
    path.write_bytes(without_beginning((tmp_path / "whole.ogg").read_bytes(), 500))
    assert len(read_clip(path).samples) == 39_500
    audio.convert(path, tmp_path / "felt.wav", mono=True)
    assert soundfile.info(tmp_path / "felt.wav").frames == 39_500
