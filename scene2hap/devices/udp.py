"""The mix over a network: PCM in datagrams, or the gains as OSC messages. docs/udp.md describes the receiving side."""

from __future__ import annotations

import struct
import time
from collections.abc import Mapping
from typing import Literal

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.devices.datagrams import Datagrams
from scene2hap.devices.due_frames import FrameClock
from scene2hap.devices.framing.frames import (
    MAX_PAYLOAD,
    MOST_CHANNELS,
    FrameType,
    SampleFormat,
    clock_us,
    message,
    pcm,
    to_datagram,
)
from scene2hap.devices.link import CarryOn, LiveSink
from scene2hap.devices.osc import GainFrame, OscLine
from scene2hap.devices.protocol import Block, EventCallback, SinkFormat
from scene2hap.errors import ConfigError, DeviceError

ANNOUNCE_S = 1.0
"""Interval of announcements [s]. From them a receiver that starts late learns rate and channels."""

LATEST_S = 0.05
"""Time after which a receiver has gone silent [s]. What is later is left out: a backlog would overflow the receiver's
buffer, or delay it from then on."""

_RATE = struct.Struct("<I")
_SAMPLES = {"int16": SampleFormat.INT16, "float32": SampleFormat.FLOAT32}


@clear_calls
class UdpSink(LiveSink):
    """Send the mix, or its gains, to a program that renders; see docs/udp.md. Failures are events.

    Parameters: host, port : address of the receiver; content : "pcm" for blocks of samples, "osc" for messages of gain,
        clip and hand as the paper sent them to Max/MSP (needs the extra `osc`); sample_rate_hz, block_frames, samples
        ("int16" or "float32") : of PCM; clips : source id -> path of its sound at the OSC receiver, else the id.
    Raises: MissingExtra; ConfigError: a setting out of bounds.
    """

    def __init__(
        self,
        host: str = "127.0.0.1",
        port: int = 9000,
        *,
        content: Literal["pcm", "osc"] = "pcm",
        sample_rate_hz: int = 8000,
        block_frames: int = 80,
        samples: Literal["int16", "float32"] = "float32",
        clips: Mapping[str, str] | None = None,
        on_event: EventCallback | None = None,
    ) -> None:
        if content not in ("pcm", "osc") or samples not in _SAMPLES:
            raise ConfigError(
                f'UdpSink content is {content!r} and samples {samples!r}; they must be "pcm" or "osc", and "int16" or '
                '"float32".'
            )
        checks.text("host", host, error=ConfigError)
        if "/" in host or host.count(":") == 1:  # an address of IPv6 has several
            raise ConfigError(
                f"host is {checks.represented(host)}; give name and port apart: UdpSink('localhost', 9000)."
            )
        datagrams = Datagrams(host, checks.whole("port", port, "-", at_least=1, at_most=65535, error=ConfigError))
        self._osc = OscLine(datagrams, _checked_clips(clips)) if content == "osc" else None
        line: OscLine | PcmLine = self._osc or PcmLine(datagrams, sample_rate_hz, block_frames, _SAMPLES[samples])
        # A receiver would mix two streams of samples to noise. OSC messages name their clip and hand.
        key = None if content == "osc" else ("udp", host, port)
        super().__init__(line, f"UDP receiver {host}:{port}", on_event=on_event, key=key)

    def show(self, frame: GainFrame) -> None:
        """Store the gains of one update; never blocks the game's thread. No effect for PCM."""
        if self._osc is not None:
            self._osc.latest = frame


class PcmLine:
    """A line that sends blocks of samples by the wall clock; see `scene2hap.devices.link.Line`."""

    def __init__(self, datagrams: Datagrams, sample_rate_hz: int, block_frames: int, format: SampleFormat) -> None:
        self._rate_hz = checks.whole(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=500, at_most=192000, error=ConfigError
        )
        self._wish = checks.whole("block_frames", block_frames, "-", at_least=1, at_most=512, error=ConfigError)
        self._block_frames = self._wish
        self._datagrams = datagrams
        self._samples = format
        self.silent_after_s: float = LATEST_S + self._wish / self._rate_hz
        self._pace = FrameClock(self._rate_hz, self.silent_after_s)
        self._sequence = 0
        self._announcement = b""
        self._announced_s = 0.0
        self.latency_s: float | None = None

    @property
    def underruns(self) -> int:
        """Number of datagrams that the system did not queue, and of times that one came too late for the receiver."""
        return self._datagrams.not_sent + self._pace.n_pauses

    def check_format(self, format: SinkFormat) -> None:
        """Raises: DeviceError: more hands, or longer names, than a datagram holds."""
        names, most = self._names(format), MAX_PAYLOAD - _RATE.size
        if len(format.channels) > MOST_CHANNELS or len(names) > most:
            raise DeviceError(
                f"a datagram holds at most {MOST_CHANNELS} hands, and {most} bytes of their names; the session has "
                f'{len(format.channels)} hands, with {len(names)} bytes. Use fewer, or content="osc".'
            )

    def connect(self, format: SinkFormat, carry_on: CarryOn) -> int:
        """Announce the stream."""
        stream = _RATE.pack(self._rate_hz) + self._names(format)
        self._announcement = to_datagram(message(FrameType.STREAM, stream))
        self._block_frames = min(self._wish, MAX_PAYLOAD // (len(format.channels) * self._samples.dtype.itemsize))
        self._datagrams.connect(self._announcement, carry_on)
        self._announced_s = time.monotonic()
        self.latency_s = self._block_frames / self._rate_hz
        self._pace.restart(time.monotonic())
        return self._rate_hz

    @staticmethod
    def _names(format: SinkFormat) -> bytes:
        return "\n".join(format.channels).encode()

    def wanted(self, timeout_s: float) -> int:
        """Return the frames of one block whenever one is due."""
        return self._pace.wait(self._block_frames, timeout_s)

    def send(self, block: Block) -> None:
        """Send one PCM datagram, and the announcement at its interval."""
        now = time.monotonic()
        self._pace.take(len(block))
        self._sequence = (self._sequence + 1) % 2**16
        frame = pcm(block, sequence=self._sequence, time_us=clock_us(now), format=self._samples)
        self._datagrams.send(to_datagram(frame))
        if now - self._announced_s > ANNOUNCE_S:
            self._announced_s = now
            self._datagrams.send(self._announcement)

    def disconnect(self) -> None:
        """Send MUTE to the receiver, and close."""
        self._datagrams.close(to_datagram(message(FrameType.MUTE)))


def _checked_clips(clips: object) -> Mapping[str, str]:
    given = {} if clips is None else clips
    if not isinstance(given, Mapping) or not all(isinstance(name, str) for pair in given.items() for name in pair):
        raise ConfigError(
            f"clips is {checks.shown(given)}; it must map each source to the receiver's path of its sound, as "
            "{'radio': 'loops/radio/on.wav'}."
        )
    return given
