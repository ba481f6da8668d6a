"""A private PulseAudio server with a null sink, so that tests play to and record from a sound card on any machine.

    with SoundServer() as server:
        recorder = server.record()
        ...
        samples = recorder.stop()

Environment variables tell PortAudio's ALSA plug-in where the server is; they are restored at the end.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

RATE = 48000
PACKAGES = "pulseaudio pulseaudio-utils libportaudio2 libasound2-plugins"
DEVICE = "pulse"
"""PortAudio's name of the server."""


def missing() -> str:
    """A message on the programs and packages that are missing; "" if none is."""
    absent = [name for name in ("pulseaudio", "pactl", "parec") if shutil.which(name) is None]
    if absent:
        return f"{', '.join(absent)} not found; apt-get install --no-install-recommends {PACKAGES}"
    try:
        import sounddevice  # noqa: F401
    except ImportError:
        return "sounddevice is not installed; pip install 'scene2hap[soundcard]'"
    except OSError as cause:
        return f"{cause}; apt-get install --no-install-recommends {PACKAGES}"
    return ""


class SoundServer:
    """A server with a null sink at 48 kHz in 32-bit floats, which can be recorded."""

    def __init__(self, n_channels: int = 2) -> None:
        self.n_channels = n_channels
        self._folder = Path(tempfile.mkdtemp(prefix="sound-"))
        self._process: subprocess.Popen[bytes] | None = None
        self._module = ""
        self._n_recordings = 0
        self._before: dict[str, str | None] = {}

    def __enter__(self) -> Self:
        variables = {
            "XDG_RUNTIME_DIR": str(self._folder),
            "PULSE_RUNTIME_PATH": str(self._folder),
            "PULSE_SERVER": f"unix:{self._folder}/native",
        }
        self._before = {name: os.environ.get(name) for name in variables}
        os.environ.update(variables)
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.kill()
        for name, value in self._before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        shutil.rmtree(self._folder, ignore_errors=True)

    def start(self) -> None:
        """Start the server and load the sink."""
        command = ["pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes"]
        command += ["--use-pid-file=no", "-L", f"module-native-protocol-unix auth-anonymous=1 socket={self._socket}"]
        with (self._folder / "log").open("ab") as log:
            self._process = subprocess.Popen(
                command, env={**os.environ, "HOME": str(self._folder)}, stdout=log, stderr=log
            )
        deadline = time.monotonic() + 60.0
        while subprocess.run(["pactl", "info"], capture_output=True, check=False).returncode:
            if time.monotonic() > deadline:
                raise RuntimeError(f"pulseaudio does not start:\n{(self._folder / 'log').read_text()}")
            time.sleep(0.05)
        self.plug_in()

    def kill(self) -> None:
        """Kill the server, as a crash would."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None
            self._socket.unlink(missing_ok=True)

    def signal(self, number: int) -> None:
        """Send a signal to the server, such as SIGSTOP."""
        assert self._process is not None
        self._process.send_signal(number)

    def plug_in(self) -> None:
        """Load the null sink."""
        layout = {1: "mono", 2: "stereo", 4: "surround-40", 8: "surround-71"}[self.n_channels]
        # Without norewinds the sink renders two seconds ahead, and no two recordings are equal.
        done = subprocess.run(
            ["pactl", "load-module", "module-null-sink", "sink_name=hap", f"rate={RATE}", "format=float32le",
             f"channels={self.n_channels}", f"channel_map={layout}", "norewinds=1"],
            capture_output=True, check=True, text=True,
        )  # fmt: skip
        self._module = done.stdout.strip()

    def unplug(self) -> None:
        """Unload the null sink."""
        subprocess.run(["pactl", "unload-module", self._module], check=True, capture_output=True)

    def record(self, *, is_timed: bool = False) -> Recorder:
        """Record the sink from now on; `is_timed` enables `Recorder.frame_at`."""
        self._n_recordings += 1
        return Recorder(self.n_channels, self._folder / f"take{self._n_recordings}", is_timed=is_timed)

    @property
    def _socket(self) -> Path:
        return self._folder / "native"


class Recorder:
    """A recording of the sink. A separate process writes it to a file, so that recording does not delay the player.

    With `is_timed`, a thread logs how many frames were recorded at which time, for `frame_at`.
    """

    def __init__(self, n_channels: int, path: Path, *, is_timed: bool) -> None:
        self._n_channels = n_channels
        self._path = path
        self._heard: list[tuple[float, int]] = []
        command = ["parec", "-d", "hap.monitor", "--raw", "--format=float32le", f"--rate={RATE}"]
        command += [f"--channels={n_channels}", "--latency-msec=20"]
        if n_channels > 2:
            command.append({4: "--channel-map=surround-40", 8: "--channel-map=surround-71"}[n_channels])
        with path.open("wb") as file:
            self._process = subprocess.Popen(command, stdout=file, stderr=subprocess.DEVNULL)
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        if is_timed:
            self._thread.start()
        deadline = time.monotonic() + 60.0
        while not self.n_heard and time.monotonic() < deadline:
            time.sleep(0.01)
        assert self.n_heard, "the monitor gives nothing"

    @property
    def n_heard(self) -> int:
        """Frames recorded so far."""
        return self._path.stat().st_size // (4 * self._n_channels)

    @property
    def samples(self) -> NDArray[np.float32]:
        """The samples recorded so far (n_frames, n_channels)."""
        n_samples = self.n_heard * self._n_channels
        return np.fromfile(self._path, dtype="<f4", count=n_samples).reshape(-1, self._n_channels)

    def stop(self) -> NDArray[np.float32]:
        """Stop recording. Returns all samples (n_frames, n_channels)."""
        self._over.set()
        if self._thread.ident is not None:
            self._thread.join()
        self._process.terminate()
        self._process.wait()
        return self.samples

    def frame_at(self, time_s: float) -> int:
        """Estimate the frame that was recorded at a time [s, monotonic]."""
        # Blocks are logged late, never early, so the largest estimate is right. Only nearby, as stalls may lose frames.
        near = [(at, n) for at, n in self._heard if abs(at - time_s) < 0.25]
        return max(n - round((at - time_s) * RATE) for at, n in near)

    def _listen(self) -> None:
        while not self._over.wait(0.003):
            self._heard.append((time.monotonic(), self.n_heard))
