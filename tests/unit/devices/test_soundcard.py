"""The sound card sink, tested without a sound card: its settings, and its pace with a driver that is replaced."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from scene2hap.devices import SINKS, portaudio
from scene2hap.devices.memory import MemorySink
from scene2hap.devices.protocol import ActuatorSink, SinkFormat, has_clock
from scene2hap.devices.soundcard import SoundCardSink
from scene2hap.errors import ConfigError, DeviceError, MissingExtra

RATE = 48000
FORMAT = SinkFormat(RATE, ("left", "right"))


@pytest.fixture(autouse=True)
def _installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scene2hap.devices.portaudio.find_spec", lambda name: object())


@pytest.mark.parametrize(
    ("channels", "columns"),
    [
        (None, [0, 1]),
        ([3, 4], [2, 3]),
        (np.arange(3, 5), [2, 3]),
        ({"right": 1, "left": 2}, [1, 0]),
        ({"left": 4, "right": 3, "toe": 1}, [3, 2]),
    ],
)
def test_channel_maps_route_hands_to_channels(channels: object, columns: list[int]) -> None:
    sink = SoundCardSink(channels=channels)
    assert sink._card_line.columns(FORMAT) == columns


@pytest.mark.parametrize("channels", [[0, 1], [1, 1], [1.5, 2], {"left": True}, ["1"], [1, 300], 5])
def test_invalid_channels_are_refused(channels: object) -> None:
    with pytest.raises(ConfigError, match="channel"):
        SoundCardSink(channels=channels)


def test_every_hand_needs_a_channel() -> None:
    for channels in ({"left": 1}, [1]):
        with pytest.raises(ConfigError, match="none for the hand 'right'"):
            SoundCardSink(channels=channels).open(FORMAT)


@pytest.mark.parametrize("n_channels", [0, 1, 2.5, "8", True, 300])
def test_invalid_numbers_of_channels_are_refused(n_channels: object) -> None:
    with pytest.raises(ConfigError, match="n_channels"):
        SoundCardSink(n_channels=n_channels)


def test_a_hand_beyond_the_opened_channels_is_refused() -> None:
    with pytest.raises(ConfigError, match="n_channels is 4, and a hand is on channel 5"):
        SoundCardSink(channels=[1, 5], n_channels=4).open(FORMAT)


@pytest.mark.parametrize("latency", ["medium", 0.0, -1.0, 2.0, float("nan"), None])
def test_invalid_latencies_are_refused(latency: object) -> None:
    with pytest.raises(ConfigError, match="latency"):
        SoundCardSink(latency=latency)


@pytest.mark.parametrize("rate", [0, -1, "48k", "48000", 44100.5, 1e9, True, float("nan")])
def test_invalid_rates_are_refused(rate: object) -> None:
    with pytest.raises(ConfigError, match="sample_rate_hz"):
        SoundCardSink(sample_rate_hz=rate)


@pytest.mark.parametrize("device", ["", 1.5, True])
def test_invalid_devices_are_refused(device: object) -> None:
    with pytest.raises(ConfigError, match="a name, an index or None"):
        SoundCardSink(device)


@pytest.mark.parametrize("frames", [0, 8, 10_000, 64.0, True, None])
def test_invalid_block_sizes_are_refused(frames: object) -> None:
    with pytest.raises(ConfigError, match="block_frames is .* 16 to 8192 frames"):
        SoundCardSink(block_frames=frames)


def test_error_names_the_extra_when_sounddevice_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scene2hap.devices.portaudio.find_spec", lambda name: None)
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[soundcard\]'"):
        SINKS.build("soundcard")


def test_sound_card_is_a_sink_with_a_clock() -> None:
    sink = SINKS.build({"kind": "soundcard", "device": "DualSense", "channels": [3, 4], "latency": "low"})
    assert isinstance(sink, SoundCardSink)
    assert isinstance(sink, ActuatorSink)
    assert has_clock(sink)
    assert not has_clock(MemorySink())
    assert not sink.stats.connected
    assert sink.stats.underruns == 0


def test_tee_has_a_clock_if_one_of_its_sinks_has() -> None:
    def tee(*sinks: object) -> object:
        return SINKS.build({"kind": "tee", "sinks": sinks})

    assert has_clock(tee(MemorySink(), SoundCardSink()))
    assert not has_clock(tee(MemorySink(), MemorySink()))


@dataclass
class Driver:
    """One card, and its stream while it is open; PortAudio lists the card under `listed` until it is restarted."""

    n_channels: int = 2
    latency: float = 0.1
    index: int = 0
    listed: int = 0
    active: bool = True
    play: Callable[..., None] = field(default=lambda *_: None)

    def find_card(self, wanted: object) -> portaudio.Card:
        return portaudio.Card(self.listed, "pad", "ALSA", self.n_channels, RATE)

    def open_stream(self, card: portaudio.Card, n: int, rate: int, latency: float, frames: int, play: Any) -> "Driver":
        if card.index != self.index:
            raise DeviceError("the device has another number now")
        self.play = play
        return self

    def restart_if_idle(self) -> None:
        self.listed = self.index

    def take(self, n_frames: int) -> None:
        out = np.empty((n_frames, self.n_channels), dtype=np.float32)
        self.play(out, n_frames, None, SimpleNamespace(output_underflow=False))

    def use(self, monkeypatch: pytest.MonkeyPatch) -> None:
        for name in ("find_card", "open_stream", "restart_if_idle"):
            monkeypatch.setattr(portaudio, name, getattr(self, name))
        monkeypatch.setattr(portaudio, "accepts", lambda *_: True)


@pytest.mark.parametrize(("latency_s", "burst_s", "block_s"), [(0.1, 0.02, 0.005), (0.004, 0.005, 0.002)])
def test_blocks_are_short_although_the_driver_takes_bursts(
    latency_s: float, burst_s: float, block_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Gains and the watchdog act between two blocks. A block is due at 105 % of the rate, looked for each millisecond.

    With 4 ms of latency and 12 ms ahead, a block is an eighth of 16 ms.
    """
    driver, now_s = Driver(latency=latency_s), [100.0]
    driver.use(monkeypatch)
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])
    line = SoundCardSink(latency=latency_s)._card_line
    line.connect(FORMAT, lambda: True)
    blocks, taken_s = [], 100.0
    for _ in range(500):
        n_frames = line.wanted(0.0)
        line.send(np.zeros((n_frames, 2), dtype=np.float32))
        blocks.append(n_frames)
        now_s[0] += 0.001
        if now_s[0] - taken_s > burst_s:
            taken_s = now_s[0]
            driver.take(round(burst_s * RATE))
    assert blocks[0] == round((latency_s + 0.012) * RATE)
    later = blocks[1:]
    assert max(later) <= (block_s + 1.05 * 0.001) * RATE + 1
    assert min(n for n in later if n) >= 0.9 * block_s * RATE
    assert line.underruns == 0


def test_a_card_that_came_back_under_another_number_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    driver = Driver(index=3, listed=1)
    driver.use(monkeypatch)
    assert SoundCardSink()._card_line.connect(FORMAT, lambda: True) == RATE
    driver.take(64)


def test_a_hand_beyond_the_cards_channels_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    driver = Driver(n_channels=2)
    driver.use(monkeypatch)
    with pytest.raises(DeviceError, match="has 2 channels; a hand is on 4"):
        SoundCardSink(channels={"left": 1, "right": 4})._card_line.connect(FORMAT, lambda: True)
    with pytest.raises(DeviceError, match="has 2 channels; n_channels is 8"):
        SoundCardSink(n_channels=8)._card_line.connect(FORMAT, lambda: True)
