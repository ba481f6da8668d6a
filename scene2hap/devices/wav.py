"""A sink that writes a WAV file, one channel per hand."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Hashable, Iterator
from pathlib import Path

import soundfile

from scene2hap.audio.files import LARGEST_WAV_BYTES
from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.files import draft_path, path_in_c, put_in_place
from scene2hap.common.printable import quoted
from scene2hap.common.warning import warn_of
from scene2hap.devices.exclusive_use import claim, give_back
from scene2hap.devices.protocol import Block, Fill, SinkFormat, SinkStats
from scene2hap.devices.whole_frames import PulledSink, WholeFrames
from scene2hap.errors import ConfigError, DeviceError, reason_of


@clear_calls
class WavSink(PulledSink):
    """Write the mix to a WAV file of 24 bits, one channel per hand.

    It has no clock of its own: `pull` requests the next frames, `pull_s` the next seconds.

    The file appears under its name when the sink is closed, at the latest when the program ends. Ctrl-C and
    `sys.exit` close it too; a session whose `with` block fails by an error leaves none. Samples are integers: the
    header of a float file contains a time stamp, so equal runs would give different files. A WAV file holds 4 GiB: 50
    minutes of ten channels at 48 kHz. For longer takes let the path end in .rf64, which is WAV with longer lengths.
    Raises: ConfigError: no path, or one with the suffix of another kind of file.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path: Path = checks.path("path", path, error=ConfigError)
        if not self.path.name or os.path.isdir(self.path):
            raise ConfigError(
                f"path {quoted(path)} is a folder; give that of a file, as {quoted(self.path / 'touch.wav')}."
            )
        if os.path.exists(self.path) and not os.path.isfile(self.path):
            raise ConfigError(f"path {quoted(path)} is a device or a pipe; give that of a file.")
        if self.path.suffix.lower() not in ("", ".wav", ".wave", ".rf64"):
            raise ConfigError(
                f"path is {quoted(path)}; WavSink writes WAV, so that it must end in .wav, or for takes of more than "
                "4 GiB in .rf64."
            )
        self._container = "RF64" if self.path.suffix.lower() == ".rf64" else "WAV"
        self._draft = self.path
        self._file: soundfile.SoundFile | None = None
        self._fill: Fill | None = None
        self._key: Hashable = None
        self._frames = 0

    def __repr__(self) -> str:
        return f"WavSink({str(self.path)!r})"

    def open(self, format: SinkFormat) -> None:
        """Begin the file. Raises: DeviceError: it cannot be written, or another sink of this program writes it."""
        self.close()
        self._whole = WholeFrames(format.sample_rate_hz)
        self._frames = 0
        self._key = ("file", os.path.realpath(self.path))
        claim(
            self._key,
            self,
            f"another WavSink writes {self.path} already, and one of both takes would be lost. Close it first, or give "
            "each a file of its own.",
        )
        # Another program may write a file of the same name; each writes a draft of its own, and the last one stays.
        self._draft = draft_path(self.path)
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._draft.touch()  # unlike libsndfile, it names the reason of a failure
            self._file = soundfile.SoundFile(
                path_in_c(self._draft),
                "w",
                format.sample_rate_hz,
                len(format.channels),
                subtype="PCM_24",
                format=self._container,
            )
            _keep_header_current(self._file)
        except (OSError, soundfile.SoundFileError) as cause:
            give_back(self._key, self)
            with contextlib.suppress(OSError):
                self._draft.unlink()  # on a full disk it exists, and is empty
            raise DeviceError(
                f"{self.path} cannot be written: {reason_of(cause).rstrip('.')}. Choose a folder that is yours and has "
                "room."
            ) from cause

    def start(self, fill: Fill) -> None:
        """Set `fill` as the source of blocks."""
        if self._file is None:
            raise DeviceError(f"WavSink {self.path} is not open; call open(SinkFormat(...)) before start.")
        self._fill = fill

    def pull(self, n_frames: int) -> Block:
        """Request, write and return the next frames.

        Raises: DeviceError: they cannot be written, as on a full disk, or beyond 4 GiB.
        """
        if self._fill is None or self._file is None:
            raise DeviceError(f"WavSink {self.path} is not started; start the session that it belongs to first.")
        block = self._fill(n_frames)
        n_bytes = 3 * self._file.channels * (self._frames + len(block))
        if self._container == "WAV" and n_bytes > LARGEST_WAV_BYTES:
            raise DeviceError(
                f"{self.path} cannot be written after {self._frames} frames: a WAV file holds 4 GiB. Let the path of a "
                "longer take end in .rf64, or lower the session's sample_rate_hz."
            )
        try:
            self._file.write(block)
        except (OSError, soundfile.SoundFileError) as cause:
            reason = reason_of(cause).rstrip(".")
            raise DeviceError(
                f"{self.path} cannot be written after {self._frames} frames: {reason}. The disk may be full; make "
                "room, or choose another folder."
            ) from cause
        self._frames += len(block)
        return block

    def stop(self) -> None:
        """Request no more blocks."""
        self._fill = None

    def close(self) -> None:
        """Complete the file and give it its name.

        Raises: DeviceError: the disk is gone or full, or another program has removed the draft.
        """
        self.stop()
        file, self._file = self._file, None
        if file is None:
            return
        give_back(self._key, self)
        try:
            file.close()
            put_in_place(self._draft, self.path)
        except (OSError, soundfile.SoundFileError) as cause:
            raise DeviceError(
                f"{self.path} cannot be completed: {reason_of(cause).rstrip('.')}. The disk may be gone or full, or "
                f"another program removed the draft {self._draft.name}; write to a folder of your own."
            ) from cause

    def abort(self) -> None:
        """Stop and leave no file, for a run that failed."""
        self.stop()
        file, self._file = self._file, None
        if file is not None:
            give_back(self._key, self)
            with contextlib.suppress(OSError, soundfile.SoundFileError):  # the first error says what is wrong
                file.close()
            with contextlib.suppress(OSError):
                self._draft.unlink()

    @contextlib.contextmanager
    def whole_or_none(self) -> Iterator[None]:
        """Leave no file if this context fails or is interrupted."""
        try:
            yield
        except BaseException:
            self.abort()
            raise

    @property
    def stats(self) -> SinkStats:
        """Number of frames written so far."""
        return SinkStats(frames=self._frames)


def _keep_header_current(file: soundfile.SoundFile) -> None:
    """Write the length into the header at each write: else the draft of a killed program seems to have 0 frames."""
    set_update_header_auto = 0x1061  # of sndfile.h; soundfile has no method for it, so that private names are used
    try:
        soundfile._snd.sf_command(file._file, set_update_header_auto, soundfile._ffi.NULL, 1)
    except AttributeError:
        warn_of(
            f"soundfile {soundfile.__version__} lacks what keeps the header of an unfinished WAV file current: the "
            "file of a program that is killed will seem empty. Install soundfile 0.14 to have it whole."
        )
