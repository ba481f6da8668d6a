"""The sinks without a clock: WAV file and memory."""

import contextlib
import os
import struct
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scene2hap import MemorySink, WavSink
from scene2hap.common.warning import SceneWarning
from scene2hap.devices.protocol import SinkFormat
from scene2hap.errors import ConfigError, DeviceError

FORMAT = SinkFormat(8000, ("left", "right"))


class Ramp:
    """A source of known samples."""

    def __init__(self) -> None:
        self.position = 0

    def __call__(self, n: int) -> NDArray[np.float32]:
        x = (np.arange(self.position, self.position + n) % 1000) / 1000
        self.position += n
        return np.stack([x, -x], axis=1).astype(np.float32)


def test_memory_keeps_all_blocks() -> None:
    sink = MemorySink()
    sink.open(FORMAT)
    sink.start(Ramp())
    for n in (1, 10, 100):
        sink.pull(n)
    np.testing.assert_array_equal(sink.samples, Ramp()(111))
    assert sink.stats.frames == 111
    sink.close()
    sink.close()
    assert len(sink.samples) == 111
    sink.open(FORMAT)
    assert sink.samples.shape == (0, 2)
    assert sink.stats.frames == 0


def test_a_wav_file_is_not_written_beyond_the_length_that_its_header_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Readers take the length of the header, modulo 2^32, and lose the end."""
    monkeypatch.setattr("scene2hap.devices.wav.LARGEST_WAV_BYTES", 6 * 100)  # 100 frames of two channels of 24 bits
    sink = WavSink(tmp_path / "long.wav")
    sink.open(FORMAT)
    sink.start(Ramp())
    sink.pull(100)
    with pytest.raises(DeviceError, match=r"after 100 frames: a WAV file holds 4 GiB.*end in \.rf64"):
        sink.pull(1)
    sink.close()
    assert len(soundfile.read(sink.path)[0]) == 100
    longer = WavSink(tmp_path / "long.rf64")
    longer.open(FORMAT)
    longer.start(Ramp())
    longer.pull(101)
    longer.close()
    assert soundfile.info(longer.path).format == "RF64"
    np.testing.assert_allclose(soundfile.read(longer.path)[0], Ramp()(101), atol=2**-23)


def test_wav_file_has_the_pulled_samples_with_24_bits(tmp_path: Path) -> None:
    sink = WavSink(tmp_path / "deep" / "out.wav")
    sink.open(FORMAT)
    sink.start(Ramp())
    for n in (1, 10, 1500):
        sink.pull(n)
    sink.stop()
    assert not sink.path.exists()
    sink.close()
    sink.close()
    samples, rate = soundfile.read(sink.path)
    assert rate == 8000
    assert sink.stats.frames == 1511
    np.testing.assert_allclose(samples, Ramp()(1511), atol=2**-23)
    assert [path.name for path in sink.path.parent.iterdir()] == ["out.wav"]


def test_abort_leaves_no_file(tmp_path: Path) -> None:
    sink = WavSink(tmp_path / "out.wav")
    sink.open(FORMAT)
    sink.start(Ramp())
    sink.pull(100)
    sink.abort()
    assert list(tmp_path.iterdir()) == []


def test_pull_before_start_is_refused(tmp_path: Path) -> None:
    for sink in (WavSink(tmp_path / "out.wav"), MemorySink()):
        with pytest.raises(DeviceError, match="not started"):
            sink.pull(1)
        with pytest.raises(DeviceError, match="not open"):
            sink.start(Ramp())


def test_path_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(DeviceError, match="cannot be written"):
        WavSink(tmp_path / "file" / "out.wav").open(FORMAT)


def test_a_full_disk_is_an_error_of_the_sink_and_leaves_no_file(tmp_path: Path) -> None:
    """A limit on the size of files stands for the full disk."""
    resource = pytest.importorskip("resource", reason="Windows has no limit on the size of files")
    sink = WavSink(tmp_path / "touch.wav")
    sink.open(SinkFormat(48_000, ("left",)))
    sink.start(lambda n: np.zeros((n, 1), np.float32))
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    try:
        with pytest.raises(DeviceError, match=r"touch\.wav cannot be written after \d+ frames: .*disk may be full"):
            for _ in range(10):
                sink.pull(9_600)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    sink.abort()
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(os.name == "nt", reason="Windows keeps its handles apart from the descriptors of Python")
@pytest.mark.parametrize("end", ["close", "abort"])
def test_a_disk_that_is_gone_at_the_end_is_an_error_of_the_sink(tmp_path: Path, end: str) -> None:
    """The closed descriptor of the file stands for the lost disk: nothing more can be written to it."""
    sink = WavSink(tmp_path / "touch.wav")
    sink.open(SinkFormat(48_000, ("left",)))
    sink.start(lambda n: np.zeros((n, 1), np.float32))
    sink.pull(100)
    (path,) = tmp_path.glob(".touch.wav.*.part.wav")
    draft = path.stat()
    for descriptor in range(3, 256):
        with contextlib.suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), draft):
                os.close(descriptor)
    if end == "close":
        with pytest.raises(DeviceError, match=r"touch\.wav cannot be completed: .* disk may be gone"):
            sink.close()
    else:
        sink.abort()
        assert not list(tmp_path.iterdir())
    sink.close()
    sink.open(SinkFormat(48_000, ("left",)))  # the file is not claimed any more
    sink.abort()


def test_two_programs_that_write_one_file_do_not_mix_their_samples(tmp_path: Path) -> None:
    path = tmp_path / "touch.wav"
    other = f"""
import numpy as np
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.wav import WavSink
sink = WavSink({str(path)!r})
sink.open(SinkFormat(48_000, ("left",)))
sink.start(lambda n: np.full((n, 1), 0.25, np.float32))
sink.pull(5000)
sink.close()
"""
    sink = WavSink(path)
    sink.open(SinkFormat(48_000, ("left",)))
    sink.start(lambda n: np.full((n, 1), 0.5, np.float32))
    sink.pull(1000)
    subprocess.run([sys.executable, "-c", other], check=True, timeout=60)
    assert set(soundfile.read(path)[0]) == {0.25}
    sink.pull(1000)
    sink.close()
    np.testing.assert_array_equal(soundfile.read(path)[0], np.full(2000, 0.5))
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(("suffix", "length_at", "length_type"), [("wav", 40, "<I"), ("rf64", 28, "<Q")])
def test_a_program_that_is_killed_leaves_a_whole_file_as_its_draft(
    tmp_path: Path, suffix: str, length_at: int, length_type: str
) -> None:
    dies = f"""
import os
import numpy as np
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.wav import WavSink
sink = WavSink({str(tmp_path / f"take.{suffix}")!r})
sink.open(SinkFormat(48_000, ("left", "right", "tip")))
sink.start(lambda n: np.full((n, 3), (0.5, -0.25, 0.125), np.float32))
sink.pull(3000)
sink.pull(2000)
os._exit(9)  # ends as by kill -9, without closing any file
"""
    assert subprocess.run([sys.executable, "-c", dies], timeout=60).returncode == 9
    (draft,) = tmp_path.iterdir()
    assert draft.name.startswith(f".take.{suffix}.")
    assert draft.name.endswith(f".part.{suffix}")
    by_hand = b"\0\0\x40" + b"\0\0\xe0" + b"\0\0\x10"  # 24 bits, little-endian: 2^22, -2^21, 2^20
    content = draft.read_bytes()
    assert content.endswith(5000 * by_hand)
    # Other readers than libsndfile go by the number of bytes in the chunk `data`, or `ds64` of RF64.
    assert struct.unpack_from(length_type, content, length_at) == (5000 * len(by_hand),)
    samples, rate_hz = soundfile.read(draft)
    assert (samples.shape, rate_hz) == ((5000, 3), 48_000)


def test_a_soundfile_without_the_private_names_writes_takes_as_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both names are tried with the lowest and the newest soundfile by the test above; a later one may lack them."""
    public = {name: getattr(soundfile, name) for name in ("SoundFile", "SoundFileError", "__version__")}
    monkeypatch.setattr("scene2hap.devices.wav.soundfile", SimpleNamespace(**public))
    path = tmp_path / "take.wav"
    sink = WavSink(path)
    with pytest.warns(SceneWarning, match="soundfile .* header .* killed"):
        sink.open(FORMAT)
    sink.start(Ramp())
    block = sink.pull(100)
    sink.close()
    np.testing.assert_allclose(soundfile.read(path)[0], block, atol=2**-23)


@pytest.mark.parametrize(
    ("rate_hz", "channels", "says"),
    [
        (48_000, (), r"channels is \[\]; it must be at least one name"),
        (48_000, "left", r"as \['left'\]"),
        (0, ("left",), "sample_rate_hz is 0 Hz; it must be at least 1"),
        (44_100.5, ("left",), "sample_rate_hz is 44100.5; it must be a whole number"),
    ],
)
def test_a_format_without_channels_or_rate_is_refused(rate_hz: Any, channels: Any, says: str) -> None:
    """Each sink failed on it with another message, such as that the folder of a WAV file cannot be written."""
    with pytest.raises(ConfigError, match=says):
        SinkFormat(rate_hz, channels)
