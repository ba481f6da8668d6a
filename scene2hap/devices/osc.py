"""Gains as Open Sound Control messages, as the paper's Unity scene sent them to Max/MSP.

    /scene2hap/hello  sample_rate_hz i                when the sink connects
    /scene2hap/play   clip s                          when a clip is felt, and once a second while it is
    /scene2hap/gain   gain f, clip s, hand i          whenever a gain changes, and all of them once a second

The receiver plays and mixes the clips itself. It starts a clip's loop at the first play, and ignores the others.

Source: the paper, section Audio Processing (a message with attenuation ratio, path of the audio file and hand index at
every change; one when a file is first played); OSC 1.0.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.datagrams import Datagrams
from scene2hap.devices.due_frames import FrameClock
from scene2hap.devices.link import CarryOn
from scene2hap.devices.protocol import Block, SinkFormat
from scene2hap.errors import MissingExtra

REPEAT_S = 1.0
"""Interval at which all plays and gains are sent again, since datagrams may be lost [s]."""

_BLOCK_S = 0.02


class GainFrame(Protocol):
    """The part of a HapticFrame that is used: gains (n_hands, n_sources, n_bands)."""

    @property
    def gains(self) -> NDArray[np.float32]: ...  # noqa: D102  # see HapticFrame
    @property
    def hands(self) -> tuple[str, ...]: ...  # noqa: D102  # see HapticFrame
    @property
    def sources(self) -> tuple[str, ...]: ...  # noqa: D102  # see HapticFrame


class OscLine:
    """A `Line` that sends gains as messages. Samples are requested by the wall clock and discarded.

    `latest` is the newest frame of gains; any thread may set it.
    """

    def __init__(self, datagrams: Datagrams, clips: Mapping[str, str]) -> None:
        _require_python_osc()
        self.latest: GainFrame | None = None
        self.latency_s: float | None = None
        self._datagrams = datagrams
        self._clips = clips
        self._sent_gains: dict[tuple[str, int], float] = {}
        self._playing: set[str] = set()
        self._repeated_s = 0.0
        self._pace = FrameClock(1)
        self._block_frames = 1

    @property
    def underruns(self) -> int:
        """Number of datagrams that the system did not queue."""
        return self._datagrams.not_sent

    def connect(self, format: SinkFormat, carry_on: CarryOn) -> int:
        """Send hello, and discard the record of gains sent before."""
        self._sent_gains.clear()
        self._playing.clear()
        self._datagrams.connect(encode("/scene2hap/hello", format.sample_rate_hz), carry_on)
        self._block_frames = max(1, round(_BLOCK_S * format.sample_rate_hz))
        self._pace = FrameClock(format.sample_rate_hz)
        self._pace.restart(time.monotonic())
        return format.sample_rate_hz

    def wanted(self, timeout_s: float) -> int:
        """Send the changed gains, then wait for the clock."""
        self._send_changes()
        return self._pace.wait(self._block_frames, timeout_s)

    def send(self, block: Block) -> None:
        """Discard the samples: the receiver plays its own."""
        self._pace.take(len(block))

    def disconnect(self) -> None:
        """Send gain 0 for all clips that still play."""
        loud = [key for key, gain in self._sent_gains.items() if gain]
        self._datagrams.close(*(encode("/scene2hap/gain", 0.0, clip, hand) for clip, hand in loud))
        self._sent_gains.clear()

    def _send_changes(self) -> None:
        frame, sent = self.latest, self._sent_gains
        if frame is None:
            return
        present = {(clip, hand): gain for clip, hand, gain in gains_of(frame, self._clips)}
        # A source or a hand that was removed is in no later frame, and would vibrate at the receiver for ever.
        gains = {**dict.fromkeys(sent, 0.0), **present}
        now = time.monotonic()
        is_repeat = now - self._repeated_s > REPEAT_S
        if is_repeat:
            self._repeated_s = now
            self._playing.clear()
        for (clip, hand), gain in gains.items():
            if gain > 0 and clip not in self._playing:
                self._playing.add(clip)
                self._datagrams.send(encode("/scene2hap/play", clip))
            before = sent.get((clip, hand))
            if gain != (before or 0.0) or (is_repeat and before is not None):
                self._datagrams.send(encode("/scene2hap/gain", gain, clip, hand))
        # A removed one is forgotten once its 0 has been repeated.
        self._sent_gains = {key: gain for key, gain in gains.items() if key in present or sent[key] or not is_repeat}


def gains_of(frame: GainFrame, clips: Mapping[str, str]) -> Iterator[tuple[str, int, float]]:
    """Yield clip, index of the hand and gain of the loudest band, for every clip and hand.

    The receiver has one gain for a clip. Of sources that share it, such as equal phones, the powers add up.
    """
    loudest = np.asarray(frame.gains).max(axis=2, initial=0.0)
    numbers: dict[str, list[int]] = {}
    for number, source in enumerate(frame.sources):
        numbers.setdefault(clips.get(source, source), []).append(number)
    for hand in range(len(frame.hands)):
        for clip, of_clip in numbers.items():
            yield clip, hand, math.hypot(*loudest[hand, of_clip].tolist())


def encode(address: str, *values: str | float | int) -> bytes:
    """Return one OSC message; integers as i, floats as f, strings as s."""
    from pythonosc.osc_message_builder import OscMessageBuilder

    builder = OscMessageBuilder(address)
    for value in values:
        builder.add_arg(value)
    return bytes(builder.build().dgram)


def _require_python_osc() -> None:
    try:
        import pythonosc.osc_message_builder  # noqa: F401  # imported only to see that it is installed
    except ImportError as cause:
        raise MissingExtra("OSC messages need python-osc. Run: pip install 'scene2hap[osc]'") from cause
