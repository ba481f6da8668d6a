"""Reference serial amplifier in Python: a class without wires, and a program on a port.

    python -m scene2hap.devices.reference_device          makes a pseudo-terminal and prints its name (not on Windows)
    python -m scene2hap.devices.reference_device PORT     plays the device on one end of a cable
    ... --wav heard.wav                                   stores the played samples when Ctrl-C ends it

With it you can try `SerialAmplifierSink` without hardware. The same behaviour for boards is in firmware/.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import select
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np

from scene2hap.devices.framing.frames import Frame, FrameParser, FrameType, SampleFormat, to_wire
from scene2hap.devices.framing.link_messages import GREETED, HEARD, MUTED, Credit, DeviceFormat, Hello, is_newer
from scene2hap.errors import DeviceError

WATCHDOG_S = 0.05
CREDIT_EVERY_S = 0.005
RAMP_S = 0.005

Samples = np.ndarray[tuple[int, int], np.dtype[np.int16]]
"""Samples (n_frames, n_channels) in their received form."""


class ReferenceDevice:
    """A simulated serial amplifier: bytes in, bytes out, and a clock that the caller advances.

    Parameters: sample_rate_hz, channels : its format; queue_frames : length of its queue; on_samples : called with
    accepted samples; on_output : called with played samples, silence included. Both get (n_frames, n_channels) int16.
    """

    def __init__(
        self,
        sample_rate_hz: int = 4000,
        channels: int = 2,
        queue_frames: int = 400,
        *,
        on_samples: Callable[[Samples], None] | None = None,
        on_output: Callable[[Samples], None] | None = None,
    ) -> None:
        self.format: DeviceFormat = DeviceFormat(sample_rate_hz, channels, queue_frames, 128)
        self.accepted_frames: int = 0
        self.underruns: int = 0
        self.lost: int = 0
        self.refused: int = 0
        self.muted: bool = True
        self.grants_credit: bool = True
        self._on_samples = on_samples
        self._on_output = on_output
        self._parser = FrameParser()
        self._queue: deque[tuple[Samples, bool]] = deque()  # True after a gap
        self._queued = 0
        self._outgoing = bytearray()
        self._greeted = False
        self._sequence: int | None = None
        self._echo_us = 0
        self._fed_s = self._credit_s = self._clock_s = -np.inf
        self._held = self._last = np.zeros(channels)
        self._ramp = 0
        self._n_ramp = round(RAMP_S * sample_rate_hz)
        self._plays = self._is_gap = False

    @property
    def damaged(self) -> int:
        """Number of runs of bytes that were no frame."""
        return self._parser.damaged

    def receive(self, data: bytes, now_s: float) -> None:
        """Process bytes from the host."""
        for frame in self._parser.feed(data):
            if Hello.from_frame(frame):
                self._greet()
            elif frame.type is FrameType.MUTE:
                self._mute()
            elif frame.type is FrameType.PCM and self._greeted:
                self._accept(frame, now_s)

    def advance(self, now_s: float) -> None:
        """Play up to the present. Mutes if the host is silent. Queues the present state for the host."""
        if now_s - self._fed_s > WATCHDOG_S:
            self._mute()
        if self._clock_s == -np.inf:
            self._clock_s = now_s
        n_due = int((now_s - self._clock_s) * self.format.sample_rate_hz)
        self._clock_s += n_due / self.format.sample_rate_hz
        self._play(n_due)
        if now_s - self._credit_s >= CREDIT_EVERY_S:
            self._credit(now_s)

    def to_send(self) -> bytes:
        """Return and clear the bytes for the host."""
        data = bytes(self._outgoing)
        self._outgoing.clear()
        return data

    def _greet(self) -> None:
        self._greeted = True
        self._sequence = None
        self._mute()
        self.accepted_frames = self.underruns = self._parser.damaged = 0
        self._outgoing += to_wire(self.format.to_frame())

    def _accept(self, frame: Frame, now_s: float) -> None:
        if self._sequence is not None and not is_newer(frame.sequence, self._sequence):
            return
        if frame.count and (frame.format is not SampleFormat.INT16 or frame.channels > self.format.channels):
            return
        if self._sequence is not None:
            n_lost = (frame.sequence - self._sequence - 1) % 2**16
            self.lost += n_lost
            self._is_gap |= n_lost > 0
        self._sequence = frame.sequence
        self._echo_us = frame.time_us
        if self._queued + frame.count > self.format.queue_frames:
            self.refused += 1
            self._is_gap = True
        elif frame.count:
            self._store(np.frombuffer(frame.payload, dtype="<i2").reshape(frame.count, frame.channels), now_s)
        self._credit(now_s)

    def _store(self, samples: Samples, now_s: float) -> None:
        self._fed_s = now_s
        self.muted = False
        self._queue.append((samples, self._is_gap))
        self._is_gap = False
        self._queued += len(samples)
        self.accepted_frames += len(samples)
        if self._on_samples is not None:
            self._on_samples(samples)

    def _credit(self, now_s: float) -> None:
        if not self.grants_credit:
            return
        self._credit_s = now_s
        flags = GREETED * self._greeted | HEARD * (self._sequence is not None) | MUTED * self.muted
        free = self.format.queue_frames - self._queued
        credit = Credit(
            self._sequence or 0, flags, free, self._queued, self.accepted_frames, self.damaged, self.underruns
        )
        self._outgoing += to_wire(credit.to_frame(self._echo_us))

    def _mute(self) -> None:
        """Mute, and drop queued samples: late samples are worse than none."""
        self.muted = True
        self._queue.clear()
        self._queued = 0

    def _play(self, n_frames: int) -> None:
        out = np.zeros((n_frames, self.format.channels), dtype=np.int16)
        done = 0
        while done < n_frames:
            plays = bool(self._queue)
            begin, done, is_gap = done, n_frames, False
            if plays:
                block, is_gap = self._queue.popleft()
                done = min(n_frames, begin + len(block))
                taken = done - begin
                out[begin:done, : block.shape[1]] = block[:taken]
                if taken < len(block):
                    self._queue.appendleft((block[taken:], False))
                self._queued -= taken
            if plays != self._plays or is_gap:
                self.underruns += not (plays or self.muted)
                self._held, self._ramp, self._plays = self._last, self._n_ramp, plays
            self._fade(out[begin:done])
        if self._on_output is not None and n_frames:
            self._on_output(out)

    def _fade(self, out: Samples) -> None:
        """Fade from the sample before a gap to samples after it, in place. A step would be felt as a knock."""
        left = np.clip(self._ramp - 1 - np.arange(len(out)), 0, None)[:, None] / self._n_ramp
        out[:] = np.rint(out + left * (self._held - out))
        self._ramp = max(0, self._ramp - len(out))
        self._last = out[-1].astype(float)


class Wire(Protocol):
    """Interface of a connection to a host. Both methods raise OSError when the host is gone."""

    def read(self, timeout_s: float) -> bytes:
        """Return the bytes that have arrived; wait at most `timeout_s` for a first byte."""
        ...

    def write(self, data: bytes) -> None:
        """Send bytes. Bytes that cannot be sent now are dropped."""
        ...


class PseudoTerminal:
    """The device's end of a pseudo-terminal; the host opens `name`. Raises: DeviceError: Windows has none."""

    _master: int
    _slave: int
    name: str

    def __init__(self) -> None:
        if sys.platform == "win32":
            raise DeviceError("Windows has no pseudo-terminals; give one port of a com0com pair.")
        import pty
        import tty

        self._master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self.name = os.ttyname(self._slave)

    def read(self, timeout_s: float) -> bytes:
        """Return the bytes that have arrived; wait at most `timeout_s` for a first byte."""
        ready, _, _ = select.select([self._master], [], [], timeout_s)
        return os.read(self._master, 4096) if ready else b""

    def write(self, data: bytes) -> None:
        """Send bytes. Bytes that cannot be sent now are dropped."""
        with contextlib.suppress(BlockingIOError):
            os.write(self._master, data)

    def close(self) -> None:
        """Disconnect; may be called twice."""
        for end in (self._master, self._slave):
            with contextlib.suppress(OSError):
                os.close(end)
        self._master = self._slave = -1


def serve(device: ReferenceDevice, wire: Wire, stop: threading.Event) -> None:
    """Run a device on a wire until it is stopped. Raises: OSError: the wire is gone."""
    while not stop.is_set():
        data = wire.read(0.001)
        now = time.monotonic()
        if data:
            device.receive(data, now)
        device.advance(now)
        if answer := device.to_send():
            wire.write(answer)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the device until Ctrl-C."""
    parser = argparse.ArgumentParser(
        prog="python -m scene2hap.devices.reference_device", description="A serial amplifier in Python."
    )
    parser.add_argument(
        "port", nargs="?", help="serial port; without it a pseudo-terminal is made and its name printed"
    )
    parser.add_argument("--baud", type=int, default=921600)
    parser.add_argument("--rate", type=int, default=4000, metavar="HZ", help="sample rate that it plays")
    parser.add_argument("--channels", type=int, default=2)
    parser.add_argument("--wav", type=Path, help="keep what was played")
    chosen = parser.parse_args(arguments)
    heard: list[Samples] = []
    keep = heard.append if chosen.wav else None
    device = ReferenceDevice(chosen.rate, chosen.channels, on_output=keep)
    stop = threading.Event()
    # Set explicitly, since a program in the background of a shell ignores Ctrl-C.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    try:
        serve(device, _wire(chosen.port, chosen.baud), stop)
    except OSError as cause:
        print(f"error: {cause}")
        return 1
    print(f"\n{device.accepted_frames} frames, {device.damaged} damaged runs, {device.underruns} underruns")
    if chosen.wav:
        import soundfile

        soundfile.write(chosen.wav, np.concatenate([np.zeros((0, chosen.channels), np.int16), *heard]), chosen.rate)
    return 0


def _wire(port: str | None, baud_rate: int) -> Wire:
    if port is None:
        terminal = PseudoTerminal()
        print(terminal.name, flush=True)
        return terminal
    from scene2hap.devices.serial_port import SerialPort, require_pyserial

    require_pyserial()
    return SerialPort(port, baud_rate)


if __name__ == "__main__":
    raise SystemExit(main())
