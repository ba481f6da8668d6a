"""A sink for serial amplifiers with our protocol (docs/serial-protocol.md)."""

from __future__ import annotations

import time
from collections import deque

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import counted
from scene2hap.devices.exclusive_use import port_key
from scene2hap.devices.framing.frames import (
    MAX_PAYLOAD,
    MOST_CHANNELS,
    FrameParser,
    FrameType,
    SampleFormat,
    clock_us,
    message,
    pcm,
    to_wire,
)
from scene2hap.devices.framing.link_messages import GREETED, HEARD, Credit, DeviceFormat, Hello, is_newer
from scene2hap.devices.link import CarryOn, LiveSink
from scene2hap.devices.protocol import Block, EventCallback, SinkFormat
from scene2hap.devices.serial_port import SerialPort, require_pyserial
from scene2hap.errors import ConfigError, DeviceError, DeviceLost, DeviceTimeout

HELLO_EVERY_S = 0.1
ANSWER_S = 2.5
"""Longest wait for an answer to HELLO [s]. Boards of the Arduino family restart when their port is opened, and need
about 2 s."""

PROBE_S = 0.05
"""Time without free space and without CREDIT after which an empty PCM frame is sent [s]. Its CREDIT reveals lost
frames."""

WATCHDOG_S = 0.05
"""Time without samples after which a device mutes [s] (docs/serial-protocol.md)."""

SLOWEST_HZ, FASTEST_HZ = 500, 48_000
"""Bounds of a device's sample rate (docs/serial-protocol.md)."""

_BITS_PER_BYTE = 10
_FRAME_OVERHEAD = 19


@clear_calls
class SerialAmplifierSink(LiveSink):
    """Play on a serial amplifier; needs the extra `serial`. Failures are events, see `scene2hap.devices.link`.

    Parameters: port : its name, such as "/dev/ttyACM0" or "COM5"; baud_rate : for real UARTs (USB boards ignore it);
        sample_rate_hz : the device's, None takes the device's own; buffer_s : samples kept in the device's queue [s],
        which is the latency that it adds; block_frames : frames of the device per PCM frame, or as many as it takes.
    Raises: MissingExtra; ConfigError: a number out of bounds, or a baud rate that is too low for the samples.
    """

    def __init__(
        self,
        port: str,
        *,
        baud_rate: int = 921600,
        sample_rate_hz: int | None = None,
        buffer_s: float = 0.02,
        block_frames: int = 16,
        on_event: EventCallback | None = None,
    ) -> None:
        require_pyserial()
        line = SerialLine(port, baud_rate, sample_rate_hz, buffer_s, block_frames)
        super().__init__(line, f"serial amplifier {port}", on_event=on_event, key=port_key(port))


class SerialLine:
    """Connection to a serial amplifier; see `scene2hap.devices.link.Line`."""

    def __init__(
        self, port: str, baud_rate: int, sample_rate_hz: int | None, buffer_s: float, block_frames: int
    ) -> None:
        self._name = port
        self._baud_rate = checks.whole("baud_rate", baud_rate, "baud", at_least=9600, at_most=10**9, error=ConfigError)
        self._wish_hz = 0
        if sample_rate_hz is not None:
            self._wish_hz = checks.whole(
                "sample_rate_hz", sample_rate_hz, "Hz", at_least=SLOWEST_HZ, at_most=FASTEST_HZ, error=ConfigError
            )
        self._buffer_s = checks.number("buffer_s", buffer_s, "s", at_least=0.002, at_most=1.0, error=ConfigError)
        self._block = checks.whole("block_frames", block_frames, "-", at_least=1, at_most=256, error=ConfigError)
        self.underruns: int = 0
        self._earlier_underruns = 0
        self.latency_s: float | None = None
        self.silent_after_s: float = WATCHDOG_S
        self._port: SerialPort | None = None
        self._parser = FrameParser()
        self._in_flight: deque[tuple[int, int]] = deque()
        self._news_s = 0.0
        self._sequence = 0
        self._room = 0
        self._block_frames = self._block
        self._target_frames = 0
        self._rate_hz = self._channels = 0

    def check_format(self, format: SinkFormat) -> None:
        """Raises: DeviceError: HELLO, which has a byte for the number of channels, cannot tell it."""
        if len(format.channels) > MOST_CHANNELS:
            raise DeviceError(
                f"{self._name} takes at most {MOST_CHANNELS} channels; the session has {len(format.channels)} hands."
            )

    def connect(self, format: SinkFormat, carry_on: CarryOn) -> int:
        """Open the port and send HELLO until the device answers."""
        self._port = SerialPort(self._name, self._baud_rate)
        self._parser = FrameParser()
        self._in_flight.clear()
        self._room = 0
        self._earlier_underruns = self.underruns  # the device counts from HELLO on
        device = self._greet(self._port, len(format.channels), carry_on)
        if device is None:
            return 1
        self._check(device, len(format.channels))
        self._rate_hz = device.sample_rate_hz
        self._channels = len(format.channels)
        self._block_frames = self._largest_block(device, self._channels)
        wished = max(round(self._buffer_s * device.sample_rate_hz), 2 * self._block_frames)
        self._target_frames = min(wished, device.queue_frames)
        self.silent_after_s = min(WATCHDOG_S, self._target_frames / device.sample_rate_hz)
        self._news_s = time.monotonic()
        return device.sample_rate_hz

    def wanted(self, timeout_s: float) -> int:
        """Return the frames of one block if the device has space for it within the configured buffer."""
        if self._room < self._block_frames:
            self._listen(timeout_s)
            if self._in_flight and time.monotonic() - self._news_s > PROBE_S:
                self._news_s = time.monotonic()
                self.send(np.zeros((0, self._channels), dtype=np.float32))
        return self._block_frames if self._room >= self._block_frames else 0

    def send(self, block: Block) -> None:
        """Send one PCM frame."""
        self._sequence = (self._sequence + 1) % 2**16
        self._in_flight.append((self._sequence, len(block)))
        self._room -= len(block)
        self._write(to_wire(pcm(block, sequence=self._sequence, time_us=clock_us(time.monotonic()))))

    def disconnect(self) -> None:
        """Mute the device and close the port."""
        port, self._port = self._port, None
        self.latency_s = None
        if port is None:
            return
        try:
            farewell = to_wire(message(FrameType.MUTE))
            port.write(farewell)
            # Closing discards unsent bytes, so wait until the frame is on the wire.
            time.sleep(0.001 + len(farewell) * _BITS_PER_BYTE / self._baud_rate)
        except DeviceError:
            pass  # a disconnected device mutes itself by its watchdog
        port.close()

    def _greet(self, port: SerialPort, n_channels: int, carry_on: CarryOn) -> DeviceFormat | None:
        hello = to_wire(Hello(self._wish_hz, n_channels).to_frame())
        began = sent = time.monotonic()
        port.write(hello)
        while carry_on():
            for frame in self._parser.feed(port.read(0.005)):
                if answer := DeviceFormat.from_frame(frame):
                    return answer
            now = time.monotonic()
            if now - began > ANSWER_S:
                raise DeviceTimeout(
                    f"{self._name} does not answer at {self._baud_rate} baud. Is it the right port, does its program "
                    "speak scene2hap's protocol (firmware/), and does the baud rate match?"
                )
            if now - sent > HELLO_EVERY_S:
                sent = now
                port.write(hello)
        return None

    def _largest_block(self, device: DeviceFormat, n_channels: int) -> int:
        """Return the frames of a PCM frame: as set, if the device and the payload of a frame take as many."""
        most = MAX_PAYLOAD // (n_channels * SampleFormat.INT16.dtype.itemsize)
        return min(self._block, device.block_frames, device.queue_frames // 2, most)

    def _check(self, device: DeviceFormat, n_channels: int) -> None:
        if self._wish_hz and device.sample_rate_hz != self._wish_hz:
            raise DeviceError(
                f"{self._name} plays at {device.sample_rate_hz} Hz and cannot do {self._wish_hz} Hz. "
                "Leave sample_rate_hz out to take what it offers."
            )
        if device.channels < n_channels:
            raise DeviceError(
                f"{self._name} has {counted(device.channels, 'channel')}; the session has "
                f"{counted(n_channels, 'hand')}. Play fewer hands, or connect another device."
            )
        if not SLOWEST_HZ <= device.sample_rate_hz <= FASTEST_HZ:
            raise DeviceError(
                f"{self._name} offers {device.sample_rate_hz} Hz; it must be {SLOWEST_HZ} to {FASTEST_HZ} Hz. Change "
                "the rate in the device's FORMAT."
            )
        for does, frames, least in (("queues", device.queue_frames, 2), ("takes", device.block_frames, 1)):
            if frames < least:
                raise DeviceError(
                    f"{self._name} {does} {counted(frames, 'frame')}; it must be at least {least}. Change the number "
                    "in the device's FORMAT."
                )
        block = self._largest_block(device, n_channels)
        needed = (_FRAME_OVERHEAD + 2 * n_channels * block) / block * device.sample_rate_hz * _BITS_PER_BYTE
        if needed > self._baud_rate:
            raise DeviceError(
                f"{self._name}: {device.sample_rate_hz} Hz need {needed:.0f} baud, and it is open at "
                f"{self._baud_rate}. Raise baud_rate, or block_frames."
            )

    def _listen(self, timeout_s: float) -> None:
        """Read credits; only the newest counts."""
        if self._port is None:
            raise DeviceLost(f"{self._name} is not open.")
        newest: tuple[Credit, int] | None = None
        for frame in self._parser.feed(self._port.read(timeout_s)):
            if credit := Credit.from_frame(frame):
                newest = credit, frame.time_us
        if newest is not None:
            self._take(*newest)

    def _take(self, credit: Credit, sent_us: int) -> None:
        if not credit.flags & GREETED:
            raise DeviceLost(f"{self._name} has restarted.")
        now = time.monotonic()
        heard = credit.flags & HEARD
        while heard and self._in_flight and not is_newer(self._in_flight[0][0], credit.last_sequence):
            self._in_flight.popleft()
            self._news_s = now
        flying = sum(n_frames for _, n_frames in self._in_flight)
        room = min(credit.free_frames, self._target_frames - credit.queued_frames)
        self._room = room - flying
        self.underruns = self._earlier_underruns + credit.underruns
        if heard:
            transfer_s = (clock_us(now) - sent_us) % 2**32 / 1e6
            self.latency_s = transfer_s + credit.queued_frames / self._rate_hz

    def _write(self, data: bytes) -> None:
        if self._port is None:
            raise DeviceLost(f"{self._name} is not open.")
        self._port.write(data)
