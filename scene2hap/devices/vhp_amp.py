"""VHP boards of google/audio-to-tactile as a sink: twelve channels at 2 kHz over a serial port.

The boards request each block of 4 ms, and send nothing else. docs/serial-protocol.md lists their limits. The code was
tested with simulated boards only.
"""

from __future__ import annotations

import time
from typing import Literal

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.devices.exclusive_use import port_key
from scene2hap.devices.framing import vhp
from scene2hap.devices.link import CarryOn, LiveSink
from scene2hap.devices.protocol import Block, EventCallback, SinkFormat
from scene2hap.devices.serial_port import SerialPort, require_pyserial
from scene2hap.errors import ConfigError, DeviceError, DeviceLost, DeviceTimeout

BAUD_RATE = 1_000_000
KICK_S = 0.1
"""Time without a request after which a block is sent anyway [s]. A board whose request was lost then repeats it."""

ANSWER_S = 1.0

ECHO_S = 0.002
"""Half the duration of a block [s]: a byte that arrives sooner after a block is no request."""


@clear_calls
class VhpSink(LiveSink):
    """Play on a VHP board; needs the extra `serial`. Hands are the first channels; the others rest.

    Parameters: port : its name; board : "slim" (over USB) or "sleeve" (over UART).
    Raises: MissingExtra; ConfigError: another board.
    """

    def __init__(
        self, port: str, *, board: Literal["slim", "sleeve"] = "slim", on_event: EventCallback | None = None
    ) -> None:
        if not isinstance(board, str) or board not in ("slim", "sleeve"):
            raise ConfigError(f'board is {checks.represented(board)}; it must be "slim" or "sleeve".')
        require_pyserial()
        super().__init__(
            VhpLine(port, slim=board == "slim"), f"VHP {board} at {port}", on_event=on_event, key=port_key(port)
        )


class VhpLine:
    """Connection to a VHP board; see `scene2hap.devices.link.Line`."""

    def __init__(self, port: str, *, slim: bool) -> None:
        self._name = port
        self._slim = slim
        self.underruns: int = 0
        # The slim board collects eight blocks before it plays them; the sleeve plays the last one that it received.
        self.latency_s: float | None = vhp.FRAMES * (vhp.SLIM_QUEUE_FRAMES if slim else 1) / vhp.SAMPLE_RATE_HZ
        self._port: SerialPort | None = None
        self._heard = b""
        self._requested_s = self._kicked_s = 0.0

    def check_format(self, format: SinkFormat) -> None:
        """Raises: DeviceError: more hands than a block has channels."""
        if len(format.channels) > vhp.CHANNELS:
            raise DeviceError(
                f"{self._name} has {vhp.CHANNELS} channels; the session has {len(format.channels)} hands."
            )

    def connect(self, format: SinkFormat, carry_on: CarryOn) -> int:
        """Open the port, switch amplifiers on, and wait for a request of the board."""
        self._port = SerialPort(self._name, BAUD_RATE)
        self._heard = b""
        if not self._slim:
            self._port.write(vhp.packet(vhp.Message(vhp.MessageType.ENABLE_AMPLIFIERS)))
        began = time.monotonic()
        self._write(_REST)
        while carry_on() and not self._has_request(0.005):
            now = time.monotonic()
            if now - began > ANSWER_S:
                raise DeviceTimeout(f"{self._name} asks for no samples. Is it a VHP board with a streaming program?")
            if now - self._kicked_s > KICK_S:
                self._write(_REST)
        self._write(_REST)
        self._requested_s = time.monotonic()
        return vhp.SAMPLE_RATE_HZ

    def wanted(self, timeout_s: float) -> int:
        """Return the frames of one block for each request of the board."""
        now = time.monotonic()
        if self._has_request(timeout_s):
            self._requested_s = now
            return vhp.FRAMES
        if now - self._requested_s > ANSWER_S:
            raise DeviceLost(f"{self._name} has stopped asking for samples.")
        if now - max(self._requested_s, self._kicked_s) > KICK_S:
            self.underruns += 1
            return vhp.FRAMES
        return 0

    def send(self, block: Block) -> None:
        """Send one block."""
        self._write(block)

    def disconnect(self) -> None:
        """Leave the board at rest; otherwise it would repeat its last block for ever."""
        port = self._port
        if port is None:
            return
        try:
            for _ in range(vhp.SLIM_QUEUE_FRAMES if self._slim else 1):
                # Block by block, since the board's counter must end at a full buffer.
                self._has_request(KICK_S / 2)
                self._write(_REST)
            if not self._slim:
                port.write(vhp.packet(vhp.Message(vhp.MessageType.DISABLE_AMPLIFIERS)))
            # Closing discards unsent bytes: 132 bytes take 1.3 ms at 1 Mbaud.
            time.sleep(0.004)
        except DeviceError:
            pass  # the port is gone
        port.close()
        self._port = None

    def _has_request(self, timeout_s: float) -> bool:
        if self._port is None:
            raise DeviceLost(f"{self._name} is not open.")
        end = time.monotonic() + timeout_s
        while True:
            self._heard = (self._heard + self._port.read(max(0.0, end - time.monotonic())))[-1024:]
            sign = vhp.SLIM_CREDIT if self._slim else bytes([vhp.MORE])
            if sign in self._heard:
                self._heard = b""
                # Ignore two requests at once, or one sooner than a block can be played: USB has split a frame.
                if time.monotonic() - self._kicked_s > ECHO_S:
                    return True
            if time.monotonic() >= end:
                return False

    def _write(self, block: Block) -> None:
        if self._port is None:
            raise DeviceLost(f"{self._name} is not open.")
        self._kicked_s = time.monotonic()
        self._port.write(vhp.slim_frame(block) if self._slim else vhp.sleeve_packet(block))


_REST = np.zeros((vhp.FRAMES, 1), dtype=np.float32)
