"""The amplifier of docs/actuators.md: its line drives a simulated device on a pseudo-terminal, which decodes itself."""

import re
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from host import terminal_problem
from scene2hap.devices.link import LiveSink
from scene2hap.devices.protocol import SinkEvent, SinkFormat
from scene2hap.devices.reference_device import PseudoTerminal
from scene2hap.testing import check_actuator_sink
from serial_bench import eventually

pytestmark = pytest.mark.skipif(bool(terminal_problem()), reason=terminal_problem())

PAGE = (Path(__file__).parents[2] / "docs" / "actuators.md").read_text(encoding="utf-8")
(CODE,) = [code for code in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL) if "class AmplifierLine" in code]
SIZE = 1 + 64 + 1


class Amplifier:
    """A device that plays a packet of 8 frames in 4 ms and then answers it; `state` makes it fail."""

    def __init__(self) -> None:
        self.terminal = PseudoTerminal()
        self.state = "well"
        self.packets: list[NDArray[np.uint8]] = []
        self.damaged = 0
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._live)

    def _live(self) -> None:
        heard = bytearray()
        while not self._stop.is_set():
            heard += self.terminal.read(0.002)
            if self.state == "garbage":
                self.terminal.write(bytes(range(32, 64)))
                heard.clear()
            while self.state == "well" and len(heard) >= SIZE:
                packet, heard = heard[:SIZE], heard[SIZE:]
                if packet[0] != 0xA5 or sum(packet[:-1]) % 256 != packet[-1]:
                    self.damaged += 1
                    continue
                self.packets.append(np.frombuffer(bytes(packet[1:-1]), np.uint8).reshape(8, 8))
                time.sleep(0.004)
                self.terminal.write(b"\x06")

    def __enter__(self) -> "Amplifier":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()
        self.terminal.close()


@pytest.fixture
def amplifier() -> Iterator[Amplifier]:
    with Amplifier() as made:
        yield made


@pytest.fixture
def line() -> Any:
    names: dict[str, Any] = {}
    exec(CODE, names)
    return names["AmplifierLine"]


def test_the_line_keeps_the_contract(amplifier: Amplifier, line: Any) -> None:
    check_actuator_sink(lambda: LiveSink(line(amplifier.terminal.name), "amplifier"))
    assert amplifier.damaged == 0
    assert eventually(lambda: (amplifier.packets[-1] == 128).all())


def test_a_device_that_needs_time_to_start_keeps_the_contract(amplifier: Amplifier, line: Any) -> None:
    class Booting(line):
        def connect(self, format: SinkFormat, carry_on: Callable[[], bool]) -> int:
            began = time.monotonic()
            while carry_on() and time.monotonic() - began < 0.5:
                time.sleep(0.005)
            return super().connect(format, carry_on)

    check_actuator_sink(lambda: LiveSink(Booting(amplifier.terminal.name), "amplifier"))


def test_a_missing_device_is_named_by_the_contract(line: Any, tmp_path: Path) -> None:
    with pytest.raises(
        AssertionError, match=r"0 frames after \d+ were taken; its last event: .*ttyACM0 cannot be opened"
    ):
        check_actuator_sink(lambda: LiveSink(line(str(tmp_path / "ttyACM0")), "amplifier"), within_s=0.3)


def test_every_sample_arrives_once_and_failures_are_events(amplifier: Amplifier, line: Any) -> None:
    """The mix counts from -100 to 99, a step each frame; half a second without an answer loses nothing."""
    events: list[SinkEvent] = []
    position = 0

    def ramp(n_frames: int) -> NDArray[np.float32]:
        nonlocal position
        place = np.arange(position, position + n_frames) % 200 - 100
        position += n_frames
        return np.tile((place / 127).astype(np.float32)[:, None], 8)

    with LiveSink(line(amplifier.terminal.name), "amplifier", on_event=events.append) as sink:
        sink.open(SinkFormat(2000, tuple("abcdefgh")))
        sink.start(ramp)
        assert eventually(lambda: len(amplifier.packets) > 100)
        amplifier.state = "stalls"
        time.sleep(0.2)
        amplifier.state = "well"
        assert eventually(lambda: len(amplifier.packets) > 200)
        assert [event.kind for event in events] == ["connected"]
        amplifier.state = "garbage"
        assert eventually(lambda: "lost" in [event.kind for event in events])
        amplifier.state = "well"
        assert eventually(lambda: events[-1].kind in ("connected", "resumed"))
    levels = np.concatenate(amplifier.packets[13:200]).astype(int) - 128  # after the fade of 50 ms
    assert (levels == levels[:, :1]).all()
    assert set(np.diff(levels[:, 0]) % 200) == {1}
    assert eventually(lambda: (amplifier.packets[-1] == 128).all())
