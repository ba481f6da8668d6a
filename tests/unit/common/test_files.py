"""Reading small user files, limited in size and without waiting for pipes; writing files whole or not at all."""

import os
import re
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import HapticSession, WavSink, load_scene
from scene2hap.audio.conversion import Failure, convert, convert_files
from scene2hap.audio.sources.library import FolderLibrary
from scene2hap.bridge.config import BridgeConfig
from scene2hap.bundle.folder_replacement import require_replaceable
from scene2hap.cli.inspect import require_pictures
from scene2hap.clips.ahap import read_ahap
from scene2hap.common.files import draft_of, drafts_of, read_small, read_small_text, require_place, write_whole
from scene2hap.common.settings import read_settings
from scene2hap.devices.protocol import SinkFormat
from scene2hap.errors import AudioError, ConfigError, Scene2HapError
from scene2hap.export import export_clip
from scene2hap.llm.prompts import Prompts
from systems import needs_long_names


def test_the_memory_of_a_read_is_that_of_the_file_and_not_of_the_limit(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"small")
    tracemalloc.start()
    try:
        assert read_small(tmp_path / "a", 1 << 28) == b"small"
        assert tracemalloc.get_traced_memory()[1] < 1 << 20
    finally:
        tracemalloc.stop()


def test_file_size_limit_is_exact(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_bytes(b"a" * 10)
    assert read_small(path, 10) == b"a" * 10
    path.write_bytes(b"a" * 11)
    with pytest.raises(ValueError, match="it has 11 bytes; it must have at most 10"):
        read_small(path, 10)


@pytest.mark.skipif(not Path("/proc/version").exists(), reason="no files without a size here")
def test_a_file_whose_size_the_system_does_not_know_is_read_whole() -> None:
    assert read_small("/proc/version") == Path("/proc/version").read_bytes()
    with pytest.raises(ValueError, match="it has 5 bytes; it must have at most 4"):
        read_small("/proc/version", 4)


def test_a_byte_order_mark_is_left_out(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes("\ufeffHz".encode())
    assert read_small_text(tmp_path / "a.csv") == "Hz"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_pipe_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.json")
    with pytest.raises(ValueError, match="a pipe or a device"):
        read_small(tmp_path / "pipe.json")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no devices here")
def test_a_device_without_end_is_refused() -> None:
    with pytest.raises(ValueError, match="a pipe or a device"):
        read_small("/dev/zero")


def test_a_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises((OSError, ValueError)):
        read_small(tmp_path)


def test_a_failed_write_leaves_the_earlier_file_and_no_draft(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    write_whole(path, "before")
    with pytest.raises(KeyError), draft_of(path) as draft:
        draft.write_text("half")
        raise KeyError
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_disk_that_is_full_at_the_flush_keeps_the_earlier_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    path = tmp_path / "a.json"
    write_whole(path, "before")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_whole(path, "after")
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_draft_has_the_suffix_of_its_file(tmp_path: Path) -> None:
    """Some libraries choose the format by the suffix."""
    with draft_of(tmp_path / "a.png") as draft:
        draft.write_bytes(b"x")
        assert draft.suffix == ".png"
    assert (tmp_path / "a.png").read_bytes() == b"x"


@pytest.mark.parametrize("name", ["n" * 251 + ".wav", "\u00fc" * 125 + ".json", "n" * 255])
def test_the_longest_names_that_a_file_may_have_are_written(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    with draft_of(path) as draft:
        draft.write_text("half")
        assert drafts_of(path) == [draft]
        assert draft.suffix == (path.suffix or ".part")
    assert path.read_text() == "half"
    assert list(tmp_path.iterdir()) == [path]


def test_drafts_of_a_name_with_brackets_are_found(tmp_path: Path) -> None:
    with draft_of(tmp_path / "[a].wav") as draft, draft_of(tmp_path / "b.wav") as other:
        draft.write_text("half")
        other.write_text("half")
        assert drafts_of(tmp_path / "[a].wav") == [draft]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes, as POSIX has them")
def test_a_device_or_a_pipe_is_not_replaced_by_a_file(tmp_path: Path) -> None:
    """As the administrator, an output "/dev/null" would replace the device of the whole machine."""
    os.mkfifo(tmp_path / "pipe.wav")
    with pytest.raises(OSError, match="a device or a pipe"):
        write_whole(tmp_path / "pipe.wav", "x")
    with pytest.raises(ConfigError, match="a device or a pipe"):
        WavSink(tmp_path / "pipe.wav")
    assert (tmp_path / "pipe.wav").is_fifo()


@pytest.mark.parametrize("place", ["file", "file/folder"])
@pytest.mark.parametrize(
    "use",
    [
        lambda folder: WavSink(folder / "made.wav").open(SinkFormat(48_000, ("left",))),
        require_pictures,
        lambda folder: export_clip("none.haptic", folder),
        lambda folder: read_settings(str(folder / "own.toml"), "bake"),
    ],
)
def test_a_file_where_a_folder_must_be_is_named(use: Callable[[Path], object], place: str, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(Scene2HapError, match=re.escape(f"{tmp_path / 'file'} is not a folder.")):
        use(tmp_path / place)


def test_a_file_that_has_the_name_of_a_folder_to_be_is_named(tmp_path: Path) -> None:
    source, output = tmp_path / "tone.wav", tmp_path / "made"
    soundfile.write(source, np.zeros(4800), 48_000)
    output.write_text("mine")
    with pytest.raises(AudioError, match=r"made is a file, and ends in none of \.wav, .*\. Give a folder"):
        convert_files([source], output)


TOO_LONG = "x" * 5000


@needs_long_names
@pytest.mark.parametrize(
    ("use", "error"),
    [
        (HapticSession, r"cannot be read: .* too long"),
        (lambda name: load_scene(f"{name}.glb"), r"cannot be read: .* too long"),
        (lambda name: load_scene(f"{name}.xyz"), r"cannot be read: .* too long"),
        (lambda name: read_ahap(Path(f"{name}.ahap")), r"cannot be read as .* too long"),
        (lambda name: convert(f"{name}.wav", "made.wav"), r"cannot be read .* too long"),
        (FolderLibrary, "is not a folder"),
        (Prompts.load, "has no template"),
        (lambda name: BridgeConfig(root=Path(name)), "must be a folder"),
        (lambda name: require_replaceable(Path(name, "made.bundle")), r"cannot be written: .* too long"),
    ],
)
def test_a_name_that_no_file_can_have_is_an_error_of_ours(use: Callable[[str], object], error: str) -> None:
    """A file in a locked folder raises the same errors of the system: from `exists` up to Python 3.13, later not."""
    with pytest.raises(Scene2HapError, match=f"(?s){error}"):
        use(TOO_LONG)


@needs_long_names
def test_a_sound_is_not_converted_to_a_name_that_no_file_can_have(tmp_path: Path) -> None:
    sound = tmp_path / "a.wav"
    soundfile.write(sound, np.full(800, 0.1), 8000)
    with pytest.raises(AudioError, match=r"(?s)cannot be written: .* too long"):
        convert(sound, tmp_path / f"{TOO_LONG}.wav")
    (failure,) = convert_files([sound], tmp_path / TOO_LONG)
    assert isinstance(failure, Failure)
    assert "too long" in failure.reason


def test_a_drive_that_does_not_exist_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "exists", lambda path: False)
    with pytest.raises(FileNotFoundError, match="there is no drive or share"):
        require_place(tmp_path / "sub" / "a.wav")


def test_a_folder_is_called_one_where_it_cannot_be_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Windows says "Permission denied" of a folder that is opened as a file."""

    def deny(path: Path, flags: int) -> int:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(os, "open", deny)
    with pytest.raises(IsADirectoryError):
        read_small(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(PermissionError):
        read_small(tmp_path / "file")
