"""VHP boards as sinks, with boards simulated by the test from docs/serial-protocol.md."""

import threading
import time
from collections.abc import Iterator

import numpy as np
import pytest

from host import terminal_problem
from scene2hap.devices.protocol import SinkEvent, SinkFormat
from scene2hap.devices.reference_device import PseudoTerminal
from scene2hap.devices.vhp_amp import VhpSink
from scene2hap.errors import ConfigError
from serial_bench import eventually

pytestmark = pytest.mark.skipif(bool(terminal_problem()), reason=terminal_problem())


class Board:
    """A simulated board that requests data every 4 ms and stores it."""

    def __init__(self, question: bytes, size: int) -> None:
        self.terminal = PseudoTerminal()
        self.heard = bytearray()
        self.asks = True
        self._question = question
        self._size = size
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._live)

    def _live(self) -> None:
        due = 0
        while not self._stop.is_set():
            self.heard += self.terminal.read(0.004)
            # One request for each received frame, as the board's interrupt sends one per played frame.
            if self.asks and len(self.heard) >= due + self._size:
                due += self._size
                time.sleep(0.004)
                self.terminal.write(self._question)

    def __enter__(self) -> "Board":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()
        self.terminal.close()


@pytest.fixture
def events() -> Iterator[list[SinkEvent]]:
    before = set(threading.enumerate())
    yield []
    assert set(threading.enumerate()) <= before


def test_a_slim_board_gets_whole_frames_and_ends_at_rest(events: list[SinkEvent]) -> None:
    with Board(b"100\r\nbuffer_copied\r\n", 100) as board:
        with VhpSink(board.terminal.name, on_event=events.append) as sink:
            sink.open(SinkFormat(2000, ("left", "right")))
            sink.start(lambda n: np.tile(np.float32([0.5, -1.0]), (n, 1)))
            # Counted in whole frames, since on a busy machine the sink may fade in once more.
            playing_frame = 8 * bytes([192, 1, *[128] * 10])
            assert eventually(lambda: board.heard.count(playing_frame) > 25)
        assert eventually(lambda: len(board.heard) % 100 == 0)
        heard = bytes(board.heard)
    frames = [heard[start : start + 100] for start in range(0, len(heard), 100)]
    assert {frame[:4].hex() for frame in frames} == {"c8c91180"}
    samples = np.frombuffer(b"".join(frame[4:] for frame in frames), np.uint8).reshape(-1, 12)
    playing = samples[2 * 8 + 100 : -8 * 8]  # after two frames of rest and the fade of 50 ms
    assert (playing[:, 2:] == 128).all()
    assert playing[:, 0].min() >= 128
    assert playing[:, 1].max() <= 128
    assert (samples[-8 * 8 :] == 128).all()
    assert events[0].kind == "connected"


def test_a_sleeve_is_switched_on_fed_and_switched_off(events: list[SinkEvent]) -> None:
    with Board(b"\x17", 132) as board:
        with VhpSink(board.terminal.name, board="sleeve", on_event=events.append) as sink:
            sink.open(SinkFormat(2000, ("left",)))
            sink.start(lambda n: np.ones((n, 1), dtype=np.float32))
            assert eventually(lambda: sink.stats.frames > 400)
        # Whole packets, the last of which switches the board off; on a busy machine it arrives late.
        off = bytes([200, 3, 14, 0])
        assert eventually(lambda: len(board.heard) % 132 == 0 and bytes(board.heard)[-132:][:4] == off)
        heard = bytes(board.heard)
    packets = [heard[start : start + 132] for start in range(0, len(heard), 132)]
    assert packets[0][:4] == bytes([200, 3, 15, 0])
    assert packets[-1][:4] == off
    assert {packet[:4] for packet in packets[1:-1]} == {bytes([200, 3, 17, 96])}
    assert packets[-2][4:100] == bytes([128] * 96)
    assert packets[-3][4:100:12] == bytes([255] * 8)


def test_board_that_stops_requesting_is_lost(events: list[SinkEvent]) -> None:
    with (
        Board(b"buffer_copied\r\n", 100) as board,
        VhpSink(board.terminal.name, on_event=events.append) as sink,
    ):
        sink.open(SinkFormat(2000, ("left",)))
        sink.start(lambda n: np.zeros((n, 1), dtype=np.float32))
        assert eventually(lambda: sink.stats.frames > 80)
        board.asks = False
        assert eventually(lambda: events[-1].kind == "lost")
        assert sink.stats.underruns > 0
        board.asks = True
        assert eventually(lambda: events[-1].kind == "connected")


def test_board_that_never_requests_is_reported(events: list[SinkEvent]) -> None:
    terminal = PseudoTerminal()
    with VhpSink(terminal.name, on_event=events.append) as sink:
        sink.open(SinkFormat(2000, ("left",)))
        sink.start(lambda n: np.zeros((n, 1), dtype=np.float32))
        assert eventually(lambda: bool(events))
    terminal.close()
    assert events[0].kind == "unavailable"
    assert "asks for no samples" in events[0].message


def test_unknown_board_is_refused() -> None:
    with pytest.raises(ConfigError, match="sleeve"):
        VhpSink("/dev/none", board="fat")
