from __future__ import annotations

import os
import tracemalloc
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
import soundfile
from PIL import Image
from scipy.signal import butter, sosfilt

from scene2hap import audio
from scene2hap.audio import files
from scene2hap.audio.actuators import actuator_profile, response_db
from scene2hap.audio.clip import Samples
from scene2hap.audio.conversion import reading
from scene2hap.audio.levels import felt_level_db, most_felt_hz, sensation_level_db, threshold_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.errors import AudioError, ConfigError

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.audio.conversion.LevelWarning")

RATE = 8000


def sound(seconds: float = 2.0, channels: int = 2, frequency_hz: float = 93.7) -> np.ndarray:
    t = np.arange(round(seconds * RATE)) / RATE
    hiss = np.random.default_rng(1).standard_normal((len(t), channels))
    return 0.4 * np.sin(2 * np.pi * frequency_hz * t)[:, None] + 0.02 * hiss


def write(path: Path, samples: np.ndarray, **options: str) -> Path:
    soundfile.write(path, samples, RATE, **options)
    return path


@dataclass
class Held:
    """A converter that returns its input times `gain`, `held` samples late, and loses `lost` samples."""

    held: int = 0
    lost: int = 0
    gain: float = 1.0
    kept: Samples = field(default_factory=lambda: np.zeros(0, np.float32))

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> Held:
        return Held(self.held, self.lost, self.gain)

    def process(self, block: Samples) -> Samples:
        everything = np.concatenate([self.kept, np.float32(self.gain) * block])
        out = max(0, len(everything) - self.held)
        self.kept = everything[out:]
        return everything[:out]

    def finish(self) -> Samples:
        return self.kept[self.lost :]


def test_stream_converts_each_channel_for_any_block_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = write(tmp_path / "a.wav", sound(), subtype="FLOAT")
    heard, _ = soundfile.read(source, dtype="float32")
    whole = [SvfBandpass().stream(RATE, ConversionContext()).process(heard[:, i].copy()) for i in range(2)]
    for block in (65_536, 999):
        monkeypatch.setattr(reading, "BLOCK_FRAMES", block)
        made = audio.convert(source, tmp_path / f"{block}.wav", converter="svf_bandpass", raw=True)
        felt, rate = soundfile.read(made.output, dtype="float32")
        assert rate == RATE
        # Written in 24-bit steps, so that samples may differ by half a step.
        np.testing.assert_allclose(felt, np.stack(whole, axis=1), rtol=0, atol=0.51 / 2**23)


@pytest.mark.parametrize("suffix", [".wav", ".ogg", ".mp3"])
def test_a_sound_of_seconds_is_decoded_once(tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Offset, peak, middle and blocks were read one after the other; decoding was a sixth of a conversion."""
    source, decoded = tmp_path / f"a{suffix}", []
    soundfile.write(source, sound(3.0), RATE)
    n_frames = soundfile.info(source).frames
    read = soundfile.SoundFile.read

    def counted(file: soundfile.SoundFile, *given: object, **options: object) -> np.ndarray:
        frames = read(file, *given, **options)
        decoded.append(len(frames))
        return frames

    monkeypatch.setattr(soundfile.SoundFile, "read", counted)
    audio.convert(source, tmp_path / "felt.wav", mono=True)
    assert sum(decoded) == n_frames


def test_a_long_sound_is_converted_like_a_short_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A short one is decoded once, a long one several times; floats above full scale need every pass over the file."""
    source = write(tmp_path / "a.wav", 4.0 * sound(3.0) + 0.2, subtype="FLOAT")
    made = {}
    for longest_s in (10.0, 1.0):
        monkeypatch.setattr(reading, "_MIDDLE_S", longest_s)
        made[longest_s] = audio.convert(source, tmp_path / f"{longest_s}.wav", converter="svf_bandpass").output
    assert made[10.0].read_bytes() == made[1.0].read_bytes()


def most_felt_of(path: Path) -> float:
    """What a bake reports of the same signal, as the sum of its channels, which have different frequencies here."""
    samples, rate = soundfile.read(path)
    return most_felt_hz(samples.sum(axis=1), rate)


def test_conversion_reports_peaks_frequencies_and_length(tmp_path: Path) -> None:
    samples = np.where(np.arange(2) == 0, sound(12.0, frequency_hz=93.7), 0.5 * sound(12.0, frequency_hz=310.2))
    samples[777, 1] = -0.9
    made = audio.convert(write(tmp_path / "a.flac", samples, subtype="PCM_24"), tmp_path / "b.wav", raw=True)
    assert (made.sample_rate_hz, made.channels, made.n_clipped) == (RATE, 2, 0)
    assert made.duration_s == 12.0
    assert made.peak_in == pytest.approx(0.9, abs=1e-6)
    assert made.peak_out == pytest.approx(np.abs(soundfile.read(made.output)[0]).max(), abs=1e-6)
    assert made.frequency_in_hz == pytest.approx(93.7, abs=0.02)
    # |H(93.7)| = 0.53 and |H(310.2)| = 0.96: the second is half as loud before, nearly as strong after conversion, and
    # felt more, since the threshold of touch is lower there.
    assert made.frequency_out_hz == pytest.approx(310.2, abs=0.02)
    assert made.frequency_out_hz == pytest.approx(most_felt_of(made.output), abs=0.02)
    narrow = audio.convert(made.source, tmp_path / "c.wav", converter={"kind": "svf_bandpass", "q": 4.0}, raw=True)
    assert narrow.frequency_out_hz == pytest.approx(310.2, abs=0.02)


@pytest.mark.parametrize("seconds", [0.2, 1.0, 2.49, 7.0])
def test_frequency_is_exact_for_short_and_long_sounds(tmp_path: Path, seconds: float) -> None:
    made = audio.convert(write(tmp_path / "a.wav", sound(seconds, 1)), tmp_path / "b.wav")
    assert made.frequency_in_hz == pytest.approx(93.7, abs=0.4 if seconds < 0.5 else 0.03)


def test_silence_has_no_frequency_and_stays_silent(tmp_path: Path) -> None:
    made = audio.convert(write(tmp_path / "a.wav", np.zeros(RATE)), tmp_path / "b.wav")
    assert (made.peak_in, made.peak_out, made.frequency_in_hz, made.frequency_out_hz) == (0.0, 0.0, None, None)


@pytest.mark.parametrize("suffix", ["wav", "flac", "ogg", "mp3"])
def test_every_format_is_read_and_written(tmp_path: Path, suffix: str) -> None:
    source = write(tmp_path / f"a.{suffix}", sound())
    made = audio.convert(source, tmp_path / f"b.{suffix}", converter="svf_bandpass", raw=True)
    felt, rate = soundfile.read(made.output)
    assert rate == RATE
    # |H(93.7 Hz)| of the paper's band-pass: 1 / sqrt(1 + Q^2 (f/250 - 250/f)^2), Q = 0.707.
    expected = 0.4 / np.sqrt(1 + 0.5 * (93.7 / 250 - 250 / 93.7) ** 2)
    assert np.sqrt(2) * felt[4000:12_000, 0].std() == pytest.approx(expected, rel=0.03)


def test_stream_writes_the_samples_that_a_converter_delays(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound(), subtype="PCM_24")
    made = audio.convert(source, tmp_path / "b.wav", converter=Held(held=5000), raw=True)
    np.testing.assert_array_equal(soundfile.read(made.output)[0], soundfile.read(source)[0])


def test_mono_is_the_mean_of_the_channels(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound(), subtype="PCM_24")
    made = audio.convert(source, tmp_path / "b.wav", converter=Held(), mono=True, raw=True)
    assert made.channels == 1
    np.testing.assert_allclose(soundfile.read(made.output)[0], soundfile.read(source)[0].mean(axis=1), atol=2**-22)


def test_conversion_counts_samples_clipped_inside_the_converter(tmp_path: Path) -> None:
    """A tone of amplitude 2 in the pass-band of a low-pass, against scipy's filter."""
    t = np.arange(2 * RATE) / RATE
    loud = (2.0 * np.sin(2 * np.pi * 93.7 * t)).astype(np.float32)
    source = write(tmp_path / "a.wav", loud, subtype="FLOAT")
    made = audio.convert(source, tmp_path / "b.wav", converter="lowpass", raw=True)
    expected = sosfilt(butter(4, 250, fs=RATE, output="sos"), loud.astype(np.float64))
    assert made.n_clipped == np.count_nonzero(np.abs(expected) > 1.0)
    assert made.n_clipped > RATE
    assert made.peak_out == 1.0


@pytest.mark.parametrize("kind", ["auto", "svf_bandpass"])
def test_float_file_beyond_full_scale_converts_as_the_same_file_within_it(tmp_path: Path, kind: str) -> None:
    """In an earlier version the converter clipped it: the third harmonic of a hum rose from -108 to -24 dB."""
    within = write(tmp_path / "within.wav", sound(), subtype="FLOAT")
    beyond = write(tmp_path / "beyond.wav", 8.0 * sound(), subtype="FLOAT")
    audio.convert(within, tmp_path / "a.wav", converter=kind)
    made = audio.convert(beyond, tmp_path / "b.wav", converter=kind)
    assert made.n_clipped == 0
    assert made.peak_in > 3.0
    np.testing.assert_allclose(soundfile.read(tmp_path / "b.wav")[0], soundfile.read(tmp_path / "a.wav")[0], atol=1e-5)


def test_conversion_clips_at_full_scale_and_counts_clipped_samples(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", np.array([0.1, 0.6, -0.7, 0.4]), subtype="PCM_24")
    made = audio.convert(source, tmp_path / "b.wav", converter=Held(gain=2.0), raw=True)
    assert made.n_clipped == 2
    assert made.peak_out == pytest.approx(1.4, abs=1e-6)
    np.testing.assert_allclose(soundfile.read(made.output)[0], [0.2, 1.0, -1.0, 0.8], atol=2**-22)


def broken_sources(folder: Path) -> dict[Path, str]:
    samples = sound()
    samples[5000, 1] = np.nan
    whole = write(folder / "whole.flac", sound(20.0)).read_bytes()
    (folder / "cut.flac").write_bytes(whole[: len(whole) // 2])
    whole = write(folder / "whole.wav", sound()).read_bytes()
    (folder / "cut.wav").write_bytes(whole[: len(whole) // 2])
    (folder / "text.wav").write_text("no sound")
    write(folder / "empty.wav", np.zeros((0, 1)))
    return {
        write(folder / "nan.wav", samples, subtype="FLOAT"): r"nan\.wav: sample 5000 is .*nan",
        folder / "cut.flac": r"cut\.flac",
        folder / "cut.wav": r"cut\.wav is cut short",
        folder / "text.wav": r"text\.wav: not a readable sound",
        folder / "empty.wav": r"empty\.wav has no samples",
        folder / "absent.wav": r"absent\.wav is not a file",
    }


def test_broken_source_keeps_the_existing_output(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "b.wav").write_bytes(b"old")
    for source, reason in broken_sources(tmp_path).items():
        with pytest.raises(AudioError, match=reason):
            audio.convert(source, out / "b.wav", overwrite=True)
    assert [path.name for path in out.iterdir()] == ["b.wav"]
    assert (out / "b.wav").read_bytes() == b"old"


def test_a_converter_that_loses_samples_leaves_no_output(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound())
    with pytest.raises(AudioError, match="Held made 15999 samples of 16000"):
        audio.convert(source, tmp_path / "b.wav", converter=Held(held=10, lost=1))
    assert [path.name for path in tmp_path.iterdir()] == ["a.wav"]


def test_existing_output_is_overwritten_only_on_request(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound())
    (tmp_path / "b.wav").write_bytes(b"old")
    with pytest.raises(AudioError, match="exists. Choose another name, or allow"):
        audio.convert(source, tmp_path / "b.wav")
    audio.convert(source, tmp_path / "b.wav", overwrite=True)
    assert soundfile.info(tmp_path / "b.wav").frames == 16_000
    with pytest.raises(AudioError, match="is the sound itself"):
        audio.convert(source, source, overwrite=True)
    os.link(source, tmp_path / "same.wav")
    with pytest.raises(AudioError, match="is the sound itself"):
        audio.convert(source, tmp_path / "same.wav", overwrite=True)
    with pytest.raises(AudioError, match="is a folder"):
        (tmp_path / "folder.wav").mkdir()
        audio.convert(source, tmp_path / "folder.wav", overwrite=True)


def test_error_names_an_output_path_that_cannot_be_written(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound())
    with pytest.raises(AudioError, match="Choose a folder that exists"):
        audio.convert(source, tmp_path / "absent" / "b.wav")
    with pytest.raises(AudioError, match=r"no suffix of a known format; it must end in one of \.wav"):
        audio.convert(source, tmp_path / "b.aac")


@pytest.mark.skipif(os.name != "posix", reason="a limit on the size of files, as a full disk")
@pytest.mark.parametrize("suffix", [".wav", ".flac", ".ogg", ".mp3"])
def test_error_of_a_full_disk_names_the_output_and_leaves_no_file(tmp_path: Path, suffix: str) -> None:
    import resource

    source = write(tmp_path / "a.wav", sound())
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, limits[1]))
    try:
        with pytest.raises(AudioError, match=rf"b\{suffix} cannot be written"):
            audio.convert(source, tmp_path / f"b{suffix}", raw=True)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert list(tmp_path.iterdir()) == [source]


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        ({"converter": "nope"}, "no kind 'nope'"),
        ({"converter": {"kind": "svf_bandpass", "q": 1000}}, "q is 1000"),
        ({"converter": 3}, "3 is given; it must be a kind"),
        ({"actuator": "nope"}, "actuator is 'nope'"),
        ({"intensity": 1.5}, "intensity is 1.5"),
    ],
)
def test_invalid_settings_are_refused(tmp_path: Path, settings: dict[str, object], reason: str) -> None:
    source = write(tmp_path / "a.wav", sound())
    with pytest.raises(ConfigError, match=reason):
        audio.convert(source, tmp_path / "b.wav", **settings)


def test_memory_does_not_grow_with_length(tmp_path: Path) -> None:
    peaks = []
    for seconds in (20.0, 200.0):
        source = write(tmp_path / f"{seconds}.wav", np.tile(sound(2.0), (round(seconds / 2), 1)))
        audio.convert(source, tmp_path / "b.wav", overwrite=True)  # imports and caches
        tracemalloc.start()
        audio.convert(source, tmp_path / "b.wav", overwrite=True)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.1 * peaks[0]


def test_the_picture_shows_both_sounds(tmp_path: Path) -> None:
    source = write(tmp_path / "a.ogg", sound(1.0))
    made = audio.convert(source, tmp_path / "b.wav", picture=tmp_path / "b.png", raw=True)
    assert made.picture == tmp_path / "b.png"
    with Image.open(made.picture) as image:
        pixels = np.asarray(image.convert("L"), dtype=float)
    # The brightest row of a spectrogram lies at the pitch of the tone: ln(4000 / 93.7) of ln(4000 / 10) from the top.
    before = pixels[62 : 62 + 240, 85:970]
    assert np.argmax(before.mean(axis=1)) / 239 == pytest.approx(np.log(4000 / 93.7) / np.log(400), abs=0.02)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.ogg", "b.png", "b.wav"]


def test_picture_shows_the_threshold_of_touch(tmp_path: Path) -> None:
    """The picture has a line at the threshold for the felt frequency, and one scale for both sounds."""
    source = write(tmp_path / "a.wav", sound(2.0, 1, 150.0), subtype="FLOAT")
    made = audio.convert(source, tmp_path / "b.wav", intensity=0.1, picture=tmp_path / "b.png")
    assert made.picture is not None
    with Image.open(made.picture) as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)
    line = (np.abs(pixels - [0, 160, 160]).sum(axis=2) < 20)[:, 90:900].all(axis=1)
    (row, *_) = np.flatnonzero(line)
    # The second envelope is 110 rows high, of which 102 show 80 dB, and begins below two spectrograms of 240 rows.
    top = 44 + (240 + 110 + 46) + 18 + 240 + 6 + 4
    assert -(row + 0.5 - top) / 102 * 80 == pytest.approx(float(threshold_db(150.0)), abs=1.5)
    # The frequency beside its line has an outline, which makes it legible on the bright band that it names.
    beside = pixels[62 + 396 : 62 + 396 + 240, 96:150]
    assert (np.abs(beside - [34, 63, 79]).sum(axis=2) < 20).sum() > 20
    brightest = [pixels[62 + lane : 62 + lane + 240, 200:960].sum(axis=2).max() for lane in (0, 396)]
    louder = 0 if made.peak_in > made.peak_out else 1
    assert brightest[louder] > brightest[1 - louder]


def test_file_with_hours_of_silence_is_refused_before_conversion(tmp_path: Path) -> None:
    source = tmp_path / "hours.flac"
    with soundfile.SoundFile(source, "w", 1000, 8, "PCM_16", format="FLAC") as file:
        for _ in range(9):
            file.write(np.zeros((1 << 20, 8), np.int16))
    with pytest.raises(AudioError, match=r"75,497,472 samples; a file of its size must have at most 6\d,\d{3},\d{3}\."):
        audio.convert(source, tmp_path / "felt.wav")
    assert not (tmp_path / "felt.wav").exists()


def test_long_recording_is_converted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its length is that of its bytes, unlike that of packed silence."""
    monkeypatch.setattr(files, "MAX_FILE_SAMPLES", 1000)
    source = write(tmp_path / "long.wav", sound(2.0, 1, 150.0), subtype="FLOAT")
    with soundfile.SoundFile(source) as file:
        n_frames, rate = file.frames, file.samplerate
    assert n_frames > 1000
    assert audio.convert(source, tmp_path / "felt.wav").duration_s == pytest.approx(n_frames / rate)
    soundfile.write(tmp_path / "silence.flac", np.zeros(n_frames, np.int16), rate)
    with pytest.raises(AudioError, match="a file of its size"):
        audio.convert(tmp_path / "silence.flac", tmp_path / "silent.wav")


def felt_of(
    tmp_path: Path, samples: np.ndarray, name: str = "felt.wav", **settings: object
) -> tuple[np.ndarray, float]:
    """Convert a file. Returns its samples, and its felt level over the threshold on the actuator [dB]."""
    source = write(tmp_path / "a.wav", samples, subtype="FLOAT")
    made = audio.convert(source, tmp_path / name, overwrite=True, **settings)
    felt, rate = soundfile.read(made.output)
    one = felt if felt.ndim == 1 else felt[:, 0]
    whole_seconds = one[: len(one) // rate * rate]
    return felt, felt_level_db(whole_seconds, rate, actuator_profile(settings.get("actuator", "flat")))


@pytest.mark.parametrize("converter", sorted(CONVERTERS.builtins))
@pytest.mark.parametrize("actuator", ["flat", "voice_coil"])
def test_a_file_is_felt_at_the_level_of_its_source(tmp_path: Path, converter: str, actuator: str) -> None:
    """The felt level equals that of loops: 17 dB less at a tenth of the intensity, unless the peak limit lowers it."""
    source = write(tmp_path / "a.wav", sound(12.0, 1, 150.0), subtype="FLOAT")
    reached = {}
    for intensity in (0.5, 0.05):
        made = audio.convert(
            source, tmp_path / "b.wav", converter=converter, actuator=actuator, intensity=intensity, overwrite=True
        )
        felt, rate = soundfile.read(made.output)
        reached[intensity] = felt_level_db(felt, rate, actuator_profile(actuator))
        if reached[intensity] > 10.0:  # weaker levels differ between loops and pieces of a second
            assert made.level_db == pytest.approx(reached[intensity], abs=1.0)
        is_bounded = made.level_db < sensation_level_db(intensity) - 0.01
        assert made.peak_out == pytest.approx(0.501, abs=1e-3) if is_bounded else made.peak_out < 0.502
        if not is_bounded:
            assert made.level_db == pytest.approx(sensation_level_db(intensity), abs=0.01)
    assert reached[0.05] <= reached[0.5]


@pytest.mark.parametrize("actuator", ["flat", "lra"])
@pytest.mark.parametrize("n_frames", [2 * RATE, 65_536, 65_537, 65_576])
def test_a_sound_that_breaks_off_ends_without_a_click(tmp_path: Path, n_frames: int, actuator: str) -> None:
    """A tone in full swing at the end: above 1.5 kHz there is less than -60 dB of the peak."""
    tone = (0.3 * np.sin(2 * np.pi * 170.3 * np.arange(n_frames) / RATE)).astype(np.float32)
    source = write(tmp_path / "a.wav", tone, subtype="FLOAT")
    felt = soundfile.read(audio.convert(source, tmp_path / "b.wav", converter=Held(), actuator=actuator).output)[0]
    assert len(felt) == n_frames
    end = np.concatenate([felt[-RATE // 4 :], np.zeros(RATE // 4)])
    high = sosfilt(butter(4, 1500.0, "high", fs=RATE, output="sos"), end)[-RATE // 4 - RATE // 100 :]
    assert np.abs(high).max() < 1e-3 * np.abs(felt).max()


def test_a_sound_shorter_than_its_fade_out_keeps_its_length(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", np.full(20, 0.3, dtype=np.float32), subtype="FLOAT")
    assert len(soundfile.read(audio.convert(source, tmp_path / "b.wav", converter=Held()).output)[0]) == 20


def test_conversion_compensates_the_actuator_response(tmp_path: Path) -> None:
    """Two tones, at the resonance and where the response is 10 dB lower, keep their level ratio on the actuator."""
    t = np.arange(10 * RATE) / RATE
    tones = (0.2 * (np.sin(2 * np.pi * 175.0 * t) + np.sin(2 * np.pi * 200.0 * t))).astype(np.float32)
    ratios = {}
    for actuator in ("flat", "lra"):
        made = audio.convert(
            write(tmp_path / "a.wav", tones, subtype="FLOAT"),
            tmp_path / f"{actuator}.wav",
            converter=Held(),
            actuator=actuator,
        )
        spectrum = np.abs(np.fft.rfft(soundfile.read(made.output)[0][2 * RATE : 8 * RATE]))
        ratios[actuator] = 20 * np.log10(spectrum[200 * 6] / spectrum[175 * 6])
    answers = response_db(actuator_profile("lra"), [175.0, 200.0])
    assert 8.0 < answers[0] - answers[1] < 12.0
    assert ratios["lra"] - ratios["flat"] == pytest.approx(answers[0] - answers[1], abs=0.3)


def test_equalized_output_does_not_depend_on_block_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = {}
    for block in (65_536, 777):
        monkeypatch.setattr(reading, "BLOCK_FRAMES", block)
        made[block], _ = felt_of(tmp_path, sound(9.0), f"{block}.wav", actuator="lra", converter=Held(held=500))
    np.testing.assert_allclose(made[777], made[65_536], atol=2**-22)


def test_channels_of_opposite_sign_are_felt_as_one_alone_would_be(tmp_path: Path) -> None:
    """Their mean is silent, so that no frequency was found, and 18 dB were missing on a resonant actuator."""
    hum = 0.3 * np.sin(2 * np.pi * 100 * np.arange(2 * 44_100) / 44_100)
    for name, channels in (("one", hum[:, None]), ("both", np.stack([hum, -hum], axis=1))):
        soundfile.write(tmp_path / f"{name}.wav", channels, 44_100)
    one, both = (
        audio.convert(tmp_path / f"{name}.wav", tmp_path / f"felt_{name}.wav", actuator="lra", intensity=0.3)
        for name in ("one", "both")
    )
    assert one.level_db is not None
    assert both.level_db == pytest.approx(one.level_db, abs=0.1)


def test_constant_offset_causes_no_thump_at_the_start(tmp_path: Path) -> None:
    """A recording with an offset of 0.5 gives the output of the same recording without offset."""
    hum = sound(6.0, 1, 150.0)[:, 0] * 0.3
    levelled = [felt_of(tmp_path, hum + offset, converter="svf_bandpass")[0] for offset in (0.0, 0.5)]
    assert np.abs(levelled[1]).max() == pytest.approx(np.abs(levelled[0]).max(), rel=0.02)
    np.testing.assert_allclose(levelled[1], levelled[0], atol=0.01)


def test_an_offset_that_was_faded_in_causes_no_thump_at_the_start(tmp_path: Path) -> None:
    """A hum that is faded in rises as slowly in the vibration, also if its recording had an offset before the fade."""
    fade_in = np.minimum(np.arange(6 * RATE) / (0.3 * RATE), 1.0)
    faded = (sound(6.0, 1, 150.0)[:, 0] * 0.3 + 0.1) * fade_in
    felt = felt_of(tmp_path, faded, converter="svf_bandpass")[0]
    first, later = felt[: RATE // 50], felt[RATE:]
    assert np.abs(first).max() < 0.1 * np.abs(later).max()


@pytest.mark.parametrize("offset", [0.0, 0.1])
def test_a_boom_that_begins_with_half_a_slow_wave_has_no_thump_at_its_start(tmp_path: Path, offset: float) -> None:
    """The mean of this half wave was taken for an offset, and its step was four times as strong as the boom."""
    t = np.arange(4 * RATE) / RATE
    slow, fast = np.sin(2 * np.pi * 8.0 * t), 0.3 * np.sin(2 * np.pi * 90.0 * t)
    felt = felt_of(tmp_path, offset + 0.6 * np.exp(-t / 0.3) * (slow + fast), converter="svf_bandpass")[0]
    first, later = felt[: RATE // 50], felt[RATE // 25 : RATE // 8]
    assert np.abs(first).max() < 1.3 * np.abs(later).max()


def test_conversion_reports_the_reached_level_and_its_limit(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav", sound(4.0, 1, 150.0))
    made = audio.convert(source, tmp_path / "b.wav", converter="svf_bandpass", intensity=0.3)
    assert made.asked_level_db == pytest.approx(sensation_level_db(0.3))
    assert made.level_db == pytest.approx(made.asked_level_db, abs=0.01)
    clicks = np.zeros(4 * RATE)
    clicks[RATE] = 1.0
    bounded = audio.convert(write(tmp_path / "c.wav", clicks), tmp_path / "d.wav", converter="svf_bandpass")
    assert bounded.level_db is not None
    assert bounded.level_db < bounded.asked_level_db - 3.0
    assert bounded.peak_out == pytest.approx(0.501, abs=0.001)
    assert bounded.n_clipped == 0
    raw = audio.convert(source, tmp_path / "e.wav", converter="svf_bandpass", raw=True)
    assert (raw.level_db, raw.asked_level_db) == (None, None)
    short = audio.convert(write(tmp_path / "f.wav", sound(0.3, 1, 150.0)), tmp_path / "g.wav", intensity=0.3)
    assert short.level_db == pytest.approx(sensation_level_db(0.3), abs=0.01)


@pytest.mark.parametrize(("peak_db", "is_noise"), [(-80.0, True), (-59.0, False)])
def test_noise_floor_of_a_recording_is_not_amplified(tmp_path: Path, peak_db: float, is_noise: bool) -> None:
    x = np.random.default_rng(0).standard_normal((RATE, 1))
    source = write(tmp_path / "a.wav", x / np.abs(x).max() * 10 ** (peak_db / 20), subtype="FLOAT")
    made = audio.convert(source, tmp_path / "b.wav")
    assert (made.level_db is None) == is_noise
    assert (made.peak_out < 1e-3) == is_noise


def test_mono_takes_the_strongest_of_channels_that_cancel_each_other(tmp_path: Path) -> None:
    """In an earlier version the file was silent."""
    one = sound(2.0, 1, 150.0)
    source = write(tmp_path / "a.wav", np.concatenate([one, -0.98 * one], axis=1))
    made = audio.convert(source, tmp_path / "b.wav", mono=True, intensity=0.3)
    alone = audio.convert(write(tmp_path / "c.wav", one), tmp_path / "d.wav", intensity=0.3)
    assert made.channels == 1
    assert made.level_db == pytest.approx(alone.level_db, abs=0.01)
    assert made.peak_in == pytest.approx(alone.peak_in, rel=1e-3)


def test_a_missed_level_warns(tmp_path: Path) -> None:
    clicks = np.zeros((4 * RATE, 1))
    clicks[RATE] = 1.0
    source = write(tmp_path / "a.wav", clicks)
    with pytest.warns(audio.conversion.LevelWarning, match=r"b\.wav is felt \d+ dB weaker than planned"):
        made = audio.convert(source, tmp_path / "b.wav", intensity=0.5)
    assert made.level_doubt
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        faint = audio.convert(write(tmp_path / "c.wav", sound(1.0, 1, 150.0)), tmp_path / "d.wav", intensity=0.3)
        (many,) = audio.convert_files([source], tmp_path / "e.wav", intensity=0.5)
        strongest = audio.convert(source, tmp_path / "f.wav")
    assert faint.level_doubt == ""
    assert isinstance(many, audio.conversion.Conversion)
    assert many.level_doubt
    assert strongest.level_db is not None
    assert strongest.level_db < sensation_level_db(1.0) - 10.0
    assert strongest.level_doubt == ""


def test_component_that_was_chosen_is_felt_however_weak_it_is(tmp_path: Path) -> None:
    """In an earlier version it counted as noise: a file of 64 dB below full scale, without a level."""
    t = np.arange(3 * 32_000) / 32_000
    x = 0.02 * (np.sin(2 * np.pi * 4000.0 * t) + 0.012 * np.sin(2 * np.pi * 200.0 * t))
    soundfile.write(tmp_path / "a.wav", x, 32_000, subtype="FLOAT")
    made = audio.convert(tmp_path / "a.wav", tmp_path / "b.wav", intensity=0.3)
    assert made.level_db == pytest.approx(sensation_level_db(0.3), abs=0.1)
    assert made.frequency_out_hz == pytest.approx(200.0, abs=1.0)


@pytest.mark.parametrize("kind", ["lowpass", "envelope", "auto"])
def test_remainder_of_a_filtered_whine_is_not_amplified(tmp_path: Path, kind: str) -> None:
    """In an earlier version noise at -80 dB re full scale became -21 dB."""
    t, rng = np.arange(2 * 32_000) / 32_000, np.random.default_rng(0)
    source = tmp_path / "a.wav"
    whine = np.minimum(1.0, 10.0 * t) * np.sin(2 * np.pi * 9000 * t)
    soundfile.write(source, 0.5 * whine + 1e-4 * rng.standard_normal(len(t)), 32_000)
    made = audio.convert(source, tmp_path / "b.wav", converter=kind, intensity=0.3)
    if kind == "lowpass":
        assert made.level_db is None
        assert made.peak_out < 1e-3
    else:  # the carrier has the requested level
        assert made.level_db == pytest.approx(sensation_level_db(0.3), abs=0.1)


def test_a_file_that_is_not_felt_is_said(tmp_path: Path) -> None:
    """A smooth hum has no roughness in the model of `perception_level`; its silent output came without a word."""
    t = np.arange(96_000) / 48_000
    hum = np.sin(2 * np.pi * 100 * t)
    for name, peak in (("hum", 0.5), ("faint", 5e-4), ("silence", 0.0)):
        soundfile.write(tmp_path / f"{name}.wav", peak * hum, 48_000, subtype="FLOAT")
    with pytest.warns(audio.conversion.LevelWarning, match=r"felt\.wav is not felt: .*hum\.wav.*such as 'auto'"):
        made = audio.convert(tmp_path / "hum.wav", tmp_path / "felt.wav", converter="perception_level")
    assert made.level_db is None
    with pytest.warns(audio.conversion.LevelWarning, match=r"faint_felt\.wav keeps its level: .*below -60 dB"):
        audio.convert(tmp_path / "faint.wav", tmp_path / "faint_felt.wav")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        audio.convert(tmp_path / "silence.wav", tmp_path / "silence_felt.wav")
        audio.convert(tmp_path / "hum.wav", tmp_path / "raw.wav", converter="perception_level", raw=True)
