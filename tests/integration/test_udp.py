"""PCM and OSC by UDP over the loopback, with independent receivers."""

import contextlib
import re
import shutil
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pythonosc.dispatcher import Dispatcher
from pythonosc.osc_server import OSCUDPServer

from scene2hap import HapticSession, Touch
from scene2hap.devices.framing.frames import FrameType, message, to_datagram
from scene2hap.devices.protocol import SinkEvent, SinkFormat
from scene2hap.devices.udp import UdpSink
from scene2hap.errors import ConfigError
from scenes import RATE, table_with_two_phones
from serial_bench import eventually
from systems import needs_signals

PAGE = Path(__file__).parents[2] / "docs" / "udp.md"


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.bind(("127.0.0.1", 0))
        sock.settimeout(60)
        yield sock


def receiver_of_the_page() -> Any:
    (code,) = [block for block in re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), re.S) if "def " in block]
    names: dict[str, Any] = {}
    exec(code, names)
    return names["receive"]


def counting(n_frames: int, position: list[int]) -> NDArray[np.float32]:
    place = np.arange(position[0], position[0] + n_frames, dtype=np.float32)
    position[0] += n_frames
    return np.stack([place, -place], axis=1) / np.float32(2**20)


def test_the_receiver_of_the_page_gets_every_sample(listener: socket.socket) -> None:
    got: list[tuple[float, ...]] = []
    told: set[tuple[int, int]] = set()

    def play(samples: tuple[float, ...], channels: int, rate: int) -> None:
        got.append(samples)
        told.add((channels, rate))

    thread = threading.Thread(target=receiver_of_the_page(), args=(listener, play))
    thread.start()
    position = [0]
    with UdpSink("127.0.0.1", listener.getsockname()[1]) as sink:
        sink.open(SinkFormat(8000, ("left", "right")))
        sink.start(lambda n: counting(n, position))
        assert eventually(lambda: sink.stats.frames >= 4000)
    thread.join(60)
    assert not thread.is_alive()
    samples = np.array(got).reshape(-1, 2)
    assert told == {(2, 8000)}
    assert len(samples) == sink.stats.frames
    after_fade = samples[400:]
    first = sink.stats.dropped_frames + 400
    np.testing.assert_array_equal(after_fade[:, 0] * 2**20, np.arange(first, first + len(after_fade)))
    np.testing.assert_array_equal(after_fade[:, 1], -after_fade[:, 0])


def stream(port: int, n_frames: int) -> None:
    """Send a stream like a program that is killed: without MUTE, and with sequences from 1."""
    with UdpSink("127.0.0.1", port) as sink:
        sink._line.disconnect = sink._line._datagrams.close  # type: ignore[attr-defined,method-assign]
        sink.open(SinkFormat(8000, ("left", "right")))
        sink.start(lambda n: np.full((n, 2), 0.5, dtype=np.float32))
        assert eventually(lambda: sink.stats.frames >= n_frames)


def test_the_receiver_of_the_page_plays_a_restarted_program(listener: socket.socket) -> None:
    got: list[int] = []
    port = listener.getsockname()[1]
    thread = threading.Thread(target=receiver_of_the_page(), args=(listener, lambda block, *_: got.append(len(block))))
    thread.start()
    try:
        stream(port, 8000)  # 100 datagrams, so that the first 100 of a second stream would be old
        before = len(got)
        time.sleep(0.2)
        stream(port, 2000)
        assert eventually(lambda: len(got) >= before + 20)
    finally:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(to_datagram(message(FrameType.MUTE)), ("127.0.0.1", port))
        thread.join(60)


@pytest.mark.skipif(not (shutil.which("mcs") and shutil.which("mono")), reason="no C#; apt-get install mono-mcs")
def test_the_csharp_receiver_of_the_page_plays_a_restarted_program(tmp_path: Path, listener: socket.socket) -> None:
    (code,) = re.findall(r"```csharp\n(.*?)```", PAGE.read_text("utf-8"), re.S)
    trial = """
    static class Trial {
        static void Main(string[] arguments) {
            using (var pcm = new HapticPcm(int.Parse(arguments[0]), 1)) {
                Console.WriteLine("ready");
                while (Console.ReadLine() != null)
                    Console.WriteLine(pcm.Written + " " + pcm.SampleRate + " " + (int)(1000 * pcm.Ring[1000]));
            }
        }
    }"""
    port = listener.getsockname()[1]
    listener.close()
    (tmp_path / "trial.cs").write_text(code + trial)
    command = ["mcs", "-langversion:6", "-warnaserror", f"-out:{tmp_path / 'trial.exe'}", str(tmp_path / "trial.cs")]
    subprocess.run(command, check=True)
    program = subprocess.Popen(
        ["mono", str(tmp_path / "trial.exe"), str(port)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert program.stdin is not None
    assert program.stdout is not None
    written = []
    try:
        assert program.stdout.readline() == "ready\n"
        for n_frames in (8000, 2000):
            stream(port, n_frames)
            time.sleep(0.2)
            program.stdin.write("\n")
            program.stdin.flush()
            frames, rate, level = map(int, program.stdout.readline().split())
            written.append(frames)
            assert (rate, level) == (8000, 500)
    finally:
        program.communicate(timeout=60)
    assert written[0] >= 7800
    assert written[1] - written[0] >= 1800


SIGNALLED = pytest.param("os.kill(os.getpid(), signal.SIGINT)", marks=needs_signals)


@pytest.mark.parametrize("end", ["", "raise RuntimeError", SIGNALLED])
def test_a_program_that_ends_without_stop_silences_the_receiver(listener: socket.socket, end: str) -> None:
    program = f"""
import os, signal, sys, numpy as np
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.udp import UdpSink
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background process inherits that it is ignored
sink = UdpSink("127.0.0.1", int(sys.argv[1]))
sink.open(SinkFormat(8000, ("left",)))
sink.start(lambda n: np.ones((n, 1), dtype=np.float32))
while sink.stats.frames < 800:
    pass
{end}
"""
    ended = subprocess.run(
        [sys.executable, "-c", program, str(listener.getsockname()[1])], timeout=60, stderr=subprocess.DEVNULL
    )
    assert (ended.returncode == 0) is (end == "")
    kinds = []
    listener.setblocking(False)
    with contextlib.suppress(BlockingIOError):
        while True:
            kinds.append(listener.recv(2048)[1])
    assert 3 in kinds
    assert kinds[-1] == 5, "the last datagram is no MUTE"


def test_udp_stream_is_paced_by_the_clock(listener: socket.socket) -> None:
    with UdpSink("127.0.0.1", listener.getsockname()[1]) as sink:
        sink.open(SinkFormat(8000, ("left",)))
        sink.start(lambda n: np.zeros((n, 1), dtype=np.float32))
        assert sink.wait_connected(60)
        began = time.monotonic()
        assert eventually(lambda: sink.stats.frames >= 2400)
        # Never ahead of the clock; the delay depends on the machine.
        assert time.monotonic() - began > 0.29


def test_a_late_sender_sends_no_backlog_and_counts_it(listener: socket.socket) -> None:
    """After 50 ms a receiver is silent, and it buffers 20 to 30 ms: blocks that are later would only delay it."""
    times_s: list[float] = []

    def fill(n_frames: int) -> NDArray[np.float32]:
        if len(times_s) == 10:
            time.sleep(0.4)
        times_s.append(time.monotonic())
        return np.zeros((n_frames, 1), dtype=np.float32)

    with UdpSink("127.0.0.1", listener.getsockname()[1]) as sink:
        sink.open(SinkFormat(8000, ("left",)))
        sink.start(fill)
        assert eventually(lambda: len(times_s) >= 60)
        assert sink.stats.underruns >= 1
    # Judged by the sender's clock: blocks of 10 ms are sent at most 60 ms after their time, however late they are made.
    since_s = np.array(times_s[10:]) - times_s[10]
    assert (0.01 * np.arange(len(since_s)) < since_s + 0.08).all()


def test_receiver_that_starts_later_gets_the_stream(listener: socket.socket) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as reserved:
        reserved.bind(("127.0.0.1", 0))
        port = reserved.getsockname()[1]
    events: list[SinkEvent] = []
    position = [0]
    with UdpSink("127.0.0.1", port, on_event=events.append) as sink:
        sink.open(SinkFormat(8000, ("left", "right")))
        sink.start(lambda n: counting(n, position))
        assert eventually(lambda: bool(events))
        assert events[0].kind == "unavailable"
        assert "nobody listens" in events[0].message
        assert eventually(lambda: position[0] > 800)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as late:
            late.bind(("127.0.0.1", port))
            assert eventually(lambda: sink.stats.frames > 800)
        assert eventually(lambda: events[-1].kind in ("lost", "unavailable"))
    assert [event.kind for event in events[:3]] == ["unavailable", "connected", "lost"]


class MaxPatch:
    """An OSC server of python-osc that records all messages."""

    def __init__(self) -> None:
        self.heard: list[tuple[str, tuple[Any, ...]]] = []
        dispatcher = Dispatcher()
        dispatcher.set_default_handler(lambda address, *values: self.heard.append((address, values)))
        self._server = OSCUDPServer(("127.0.0.1", 0), dispatcher)
        self.port = self._server.server_address[1]
        self._thread = threading.Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.01})

    def __enter__(self) -> "MaxPatch":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def is_silent(self) -> bool:
        last = {values[1:]: values[0] for values in self.of("/scene2hap/gain")}
        return bool(last) and not any(last.values())

    def of(self, address: str) -> list[tuple[Any, ...]]:
        return [values for heard, values in self.heard if heard == address]


def test_gain_messages_have_the_format_of_the_paper() -> None:
    scene, bundle = table_with_two_phones()
    with MaxPatch() as patch:
        sink = UdpSink("127.0.0.1", patch.port, content="osc", clips={"phone": "loops/phone.wav"})
        session = HapticSession(scene, bundle, {"sample_rate_hz": RATE}, sink=sink)
        with session:
            assert sink.wait_connected(60)
            session.update(touches=[Touch("right", "phone", (0.1, 0.73, 0.4))])
            assert eventually(lambda: ("loops/phone.wav", 1) in [told[1:] for told in patch.of("/scene2hap/gain")])
            assert patch.of("/scene2hap/hello")[0] == (RATE,)
            assert ("loops/phone.wav",) in patch.of("/scene2hap/play")
            assert (1.0, "loops/phone.wav", 1) in patch.of("/scene2hap/gain")
            assert eventually(lambda: session.position > RATE / 10)  # the session's clock runs
            session.update(touches=[])
            assert eventually(lambda: patch.of("/scene2hap/gain")[-1][0] == 0.0)
            session.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
            assert eventually(lambda: (1.0, "loops/phone.wav", 0) in patch.of("/scene2hap/gain"))
        assert eventually(patch.is_silent)


def test_gains_are_0_while_the_game_hangs() -> None:
    """The receiver plays the clips itself, so no fade of samples reaches it."""
    scene, bundle = table_with_two_phones()
    with MaxPatch() as patch:
        sink = UdpSink("127.0.0.1", patch.port, content="osc")
        with HapticSession(scene, bundle, {"sample_rate_hz": RATE}, sink=sink) as session:
            assert sink.wait_connected(60)

            def is_felt() -> bool:
                session.update(touches=[Touch("right", "phone", (0.1, 0.73, 0.4))])
                return bool(patch.of("/scene2hap/gain")) and not patch.is_silent()

            assert eventually(is_felt)
            assert eventually(patch.is_silent)  # no update any more
            assert eventually(is_felt)


@pytest.mark.parametrize("host", ["localhost:9000", "udp://localhost", "192.168.0.5:9000"])
def test_port_within_the_host_is_refused(host: str) -> None:
    with pytest.raises(ConfigError, match=f"host is '{host}'; give name and port apart"):
        UdpSink(host)
    UdpSink("::1").close()
