"""Sound cards, and devices that appear as one: head-phone outputs, game pads, audio amplifiers on USB.

The sink's thread renders samples ahead into a ring, and the sound card's callback only copies from it. The buffered
samples bridge work of the session and pauses of Python:

    session ──► ring (`latency` + 12 ms) ──► PortAudio's buffer (`latency`) ──► actuator

The ring is as long as the buffer. Python may stop all its threads at once, including the callback, as in garbage
collection (60 ms were measured). After such a pause the driver requests all frames of the pause at once. Losing the
device is a state, handled by `scene2hap.devices.link`.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.devices import portaudio
from scene2hap.devices.link import CarryOn, LiveSink
from scene2hap.devices.playback_ring import PlaybackRing
from scene2hap.devices.protocol import Block, EventCallback, SinkFormat, SinkStats
from scene2hap.errors import ConfigError, DeviceError, DeviceLost

DEFAULT_LATENCY_S = 0.1
"""Smallest latency without a gap in all measurements [s]; see docs/actuators.md."""

AHEAD_S = 0.012
"""Time rendered ahead beyond the device's latency [s], for some iterations of the sink's thread."""

CHUNK_S = 0.005
"""Approximate length of rendered blocks [s]. Gains and the watchdog act only between two blocks."""

CATCHING_UP = 1.05
"""Rate at which the ring is refilled after a burst, relative to the playback rate."""

BUFFERED_S = 0.03
"""Time that a sound server buffers beyond the latency that the driver states [s]; 10 ms were measured."""

BLOCK_FRAMES = 256
FADE_S = 0.005

STEREO = 2
_DROPPING = (
    "It is a sound server, which says nothing of the card's channels. Those that the card lacks are silent, or mixed "
    "into others. If a hand on channel 3 or above feels nothing, or another hand's vibration, choose the card itself, "
    "or a profile with more channels: `pactl list sinks` shows them."
)

_LONGEST_FADE_S = 0.5


@dataclass(frozen=True)
class SoundCardStats(SinkStats):
    """Statistics of a sink, plus `load`, the share of its time that the callback needs [-], and the `device`."""

    load: float = 0.0
    device: str = ""


@clear_calls
class SoundCardSink(LiveSink):
    """Play each hand on a channel of a sound card.

    Parameters:
    device : its name or a part of it, if wanted with its interface ("Headphones, MME"), or PortAudio's index; None for
        the system's default. On Windows, WASAPI comes first among the interfaces.
    channels : the channel of each hand, counted from 1: by name {"left": 3, "right": 4} or in the hands' order [3, 4];
        None for 1, 2, ... Channels without a hand stay silent.
    n_channels : number of channels to open; None for the last hand's, at least 2. Give a sound server the number of the
        card: it spreads a stream of fewer channels over all of them.
    latency : of the device's buffer [s], or "low" or "high" for a value of its driver.
    sample_rate_hz : of the device; None for the session's if the device accepts it, else the device's own.
    block_frames : frames that the device requests at a time; fewer allow a shorter "low", and cost more calls.
    on_event : an EventCallback or None.
    Raises: ConfigError: an invalid channel, number, latency, rate or block; MissingExtra: sounddevice is not installed.
    """

    def __init__(
        self,
        device: str | int | None = None,
        *,
        channels: Mapping[str, int] | Sequence[int] | None = None,
        n_channels: int | None = None,
        latency: float | str = DEFAULT_LATENCY_S,
        sample_rate_hz: int | None = None,
        block_frames: int = BLOCK_FRAMES,
        on_event: EventCallback | None = None,
    ) -> None:
        if device is not None and (isinstance(device, bool) or not isinstance(device, str | int) or device == ""):
            raise ConfigError(f"device is {checks.represented(device)}; it must be a name, an index or None.")
        portaudio.require_sounddevice()
        self._card_line = _CardLine(
            device,
            _checked_channels(channels),
            _checked_count(n_channels),
            _checked_latency(latency),
            _checked_rate(sample_rate_hz),
            _checked_block(block_frames),
        )
        name = "the default sound card" if device is None else f"sound card {device!r}"
        super().__init__(self._card_line, name, on_event=on_event)

    @property
    def stats(self) -> SoundCardStats:
        """Counters since `open`."""
        line = self._card_line
        return SoundCardStats(**vars(super().stats), load=line.load, device=line.device)


class _CardLine:
    """Connection to one sound card."""

    def __init__(
        self,
        device: str | int | None,
        channels: Mapping[str, int] | tuple[int, ...] | None,
        n_channels: int | None,
        latency: float | str,
        rate_hz: int | None,
        block_frames: int,
    ) -> None:
        self._wanted_device = device
        self._block_frames = block_frames
        self._channels = channels
        self._n_channels = n_channels
        self._latency = latency
        self._rate_hz = rate_hz
        self._stream: Any = None
        self._ring = PlaybackRing(1, 1, 1)
        self._ahead = self._chunk = 0
        self._pace = self._rendered_at = 0.0
        self._columns: list[int] = []
        self._wide: Block = np.zeros((0, 0), dtype=np.float32)
        self._gaps = self._driver_gaps = 0
        self._is_in_gap = False
        self.latency_s: float | None = None
        self.device = self.remark = ""

    @property
    def underruns(self) -> int:
        """Number of gaps, of our own rendering or reported by the driver."""
        return self._gaps + self._ring.gaps + self._driver_gaps

    @property
    def load(self) -> float:
        """Share of its time that the callback needs [-]."""
        stream = self._stream
        return float(stream.cpu_load) if stream is not None else 0.0

    def check_format(self, format: SinkFormat) -> None:
        """Raises: ConfigError: a hand has no channel, or one beyond the channels that are opened."""
        last = max(self.columns(format)) + 1
        if self._n_channels is not None and last > self._n_channels:
            raise ConfigError(f"n_channels is {self._n_channels}, and a hand is on channel {last}; open more channels.")

    def columns(self, format: SinkFormat) -> list[int]:
        """Return the device's channel for each of the format's, from 0. Raises: ConfigError: a hand has none."""
        hands = format.channels
        if self._channels is None:
            return list(range(len(hands)))
        if isinstance(self._channels, Mapping):
            missing = [hand for hand in hands if hand not in self._channels]
            numbers = [self._channels.get(hand, 0) for hand in hands]
        else:
            missing = list(hands[len(self._channels) :])
            numbers = list(self._channels[: len(hands)])
        if missing:
            raise ConfigError(f"channels has none for the hand {missing[0]!r}; give a channel number for each hand.")
        return [number - 1 for number in numbers]

    def connect(self, format: SinkFormat, carry_on: CarryOn) -> int:
        """Find and open the device. Returns its sample rate."""
        self._columns = self.columns(format)
        try:
            return self._open(portaudio.find_card(self._wanted_device), format)
        except DeviceError:
            # The device may be back under another number, which PortAudio lists only after a restart.
            portaudio.restart_if_idle()
            carry_on()
            return self._open(portaudio.find_card(self._wanted_device), format)

    def _open(self, card: portaudio.Card, format: SinkFormat) -> int:
        n_channels = self._n_channels or max(self._columns) + 1
        if n_channels > card.n_channels:
            wanted = f"a hand is on {n_channels}" if self._n_channels is None else f"n_channels is {n_channels}"
            raise DeviceError(f"sound card {card.name!r} has {card.n_channels} channels; {wanted}.")
        # A sound server plays a stream of one channel on all actuators.
        n_channels = min(max(STEREO, n_channels), card.n_channels)
        rate_hz, n_channels = self._setting(card, n_channels, format.sample_rate_hz)
        # The stream's latency is known only after its callback has started, so the ring must exist before.
        if self._ring.shape != (rate_hz, n_channels):
            self._gaps += self._ring.gaps
            self._ring = PlaybackRing(rate_hz, n_channels, max(1, round(FADE_S * rate_hz)))
        ring = self._ring
        ring.restart()

        def callback(out: NDArray[np.float32], n_frames: int, when: Any, status: Any) -> None:
            # The driver reports a gap with each block that it requests at once after it.
            was_in_gap, self._is_in_gap = self._is_in_gap, bool(status.output_underflow)
            is_after_gap = self._is_in_gap and not was_in_gap
            self._driver_gaps += is_after_gap
            ring.play(out, after_gap=is_after_gap)

        self._stream = portaudio.open_stream(card, n_channels, rate_hz, self._latency, self._block_frames, callback)
        self._ahead = min(rate_hz, round((self._stream.latency + AHEAD_S) * rate_hz))
        self._chunk = round(min(CHUNK_S * rate_hz, self._ahead / 8))
        self._pace = CATCHING_UP * rate_hz
        self._wide = np.zeros((self._ahead, n_channels), dtype=np.float32)
        self.latency_s = float(self._stream.latency) + self._ahead / rate_hz
        self.device = card.name
        self.remark = _DROPPING if card.may_drop_channels and max(self._columns) >= STEREO else ""
        return rate_hz

    def _setting(self, card: portaudio.Card, n_channels: int, session_rate_hz: int) -> tuple[int, int]:
        """Return the first rate and number of channels that the device accepts."""
        rates = [self._rate_hz] if self._rate_hz is not None else [session_rate_hz, card.rate_hz]
        # Some devices can only be opened with all their channels.
        for rate_hz in rates:
            for n in dict.fromkeys((n_channels, card.n_channels)):
                if portaudio.accepts(card, n, rate_hz):
                    return rate_hz, n
        # Opening the device then raises the reason: busy, not permitted, gone.
        return rates[0], n_channels

    def wanted(self, timeout_s: float) -> int:
        """Return the number of frames that the ring takes now. Raises: DeviceLost: the sound card is gone."""
        due = self._due()
        if due == 0:
            time.sleep(min(timeout_s, self._chunk / self._pace / 2))
            due = self._due()
        return due

    def _due(self) -> int:
        """Return the frames to render now. They follow the clock, not the driver's bursts, so that changes are felt
        evenly."""
        if not portaudio.is_active(self._stream):
            raise DeviceLost(f"sound card {self.device!r} has gone.")
        level, now = self._ring.level, time.monotonic()
        free = max(0, self._ahead - level)
        if level >= self._ahead // 2:
            if free < self._chunk:
                # Time with a full ring does not count, or each burst would be rendered as one long block.
                self._rendered_at = now
                return 0
            free = min(free, int((now - self._rendered_at) * self._pace))
            if free < self._chunk:
                return 0
        self._rendered_at = now
        return free

    def send(self, block: Block) -> None:
        """Write frames to the ring, each hand on its channel."""
        wide = self._wide[: len(block)]
        wide[:, self._columns] = block
        self._ring.write(wide)

    def disconnect(self) -> None:
        """Fade out, wait until the fade has been played, and release the device."""
        stream, self._stream = self._stream, None
        if stream is None:
            return
        self._ring.closing = True
        deadline = time.monotonic() + _LONGEST_FADE_S
        while portaudio.is_active(stream) and not self._ring.is_silent and time.monotonic() < deadline:
            time.sleep(FADE_S / 2)
        if portaudio.is_active(stream) and self._ring.is_silent:
            # Silence follows the fade until it has been played: PortAudio drops what ALSA has buffered when it stops.
            time.sleep(stream.latency + BUFFERED_S)
        portaudio.close_stream(stream)
        self.latency_s = None


def _checked_channels(channels: Mapping[str, int] | Sequence[int] | None) -> Mapping[str, int] | tuple[int, ...] | None:
    if channels is None:
        return None
    given = channels.values() if isinstance(channels, Mapping) else channels
    numbers = checks.items("channels", given, error=ConfigError)
    for number in numbers:
        if isinstance(number, bool) or not isinstance(number, int | np.integer) or not 1 <= number <= 256:
            raise ConfigError(
                f"channels has {checks.represented(number)}; a channel is a whole number, 1 for a card's first."
            )
    if len(set(numbers)) < len(numbers):
        raise ConfigError(f"channels is {checks.represented(channels)}; each hand needs a channel of its own.")
    whole = tuple(map(int, numbers))
    return dict(zip(channels, whole, strict=True)) if isinstance(channels, Mapping) else whole


def _checked_count(n_channels: int | None) -> int | None:
    if n_channels is None:
        return None
    hint = "None opens as many as the hands need."
    return checks.whole("n_channels", n_channels, "-", at_least=STEREO, at_most=256, error=ConfigError, hint=hint)


def _checked_latency(latency: float | str) -> float | str:
    if isinstance(latency, str):
        if latency not in ("low", "high"):
            raise ConfigError(f"latency is {checks.represented(latency)}; it must be seconds, 'low' or 'high'.")
        return latency
    return checks.number("latency", latency, "s", above=0.0, at_most=1.0, error=ConfigError)


def _checked_rate(rate_hz: int | None) -> int | None:
    if rate_hz is None:
        return None
    hint = "None takes the session's rate, or the device's own."
    return checks.whole("sample_rate_hz", rate_hz, "Hz", at_least=1000, at_most=768_000, error=ConfigError, hint=hint)


def _checked_block(frames: int) -> int:
    if isinstance(frames, bool) or not isinstance(frames, int) or not 16 <= frames <= 8192:
        raise ConfigError(
            f"block_frames is {checks.represented(frames)}; it must be a whole number of 16 to 8192 frames."
        )
    return frames
