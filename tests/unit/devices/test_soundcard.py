"""Settings of the sound card sink, tested without a sound card."""

import pytest

from scene2hap.devices import SINKS
from scene2hap.devices.clocked_sink import has_clock
from scene2hap.devices.memory import MemorySink
from scene2hap.devices.protocol import ActuatorSink, SinkFormat
from scene2hap.devices.soundcard import SoundCardSink
from scene2hap.errors import ConfigError, MissingExtra

FORMAT = SinkFormat(48000, ("left", "right"))


@pytest.fixture(autouse=True)
def _installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scene2hap.devices.portaudio.find_spec", lambda name: object())


@pytest.mark.parametrize(
    ("channels", "columns"),
    [(None, [0, 1]), ([3, 4], [2, 3]), ({"right": 1, "left": 2}, [1, 0]), ({"left": 4, "right": 3, "toe": 1}, [3, 2])],
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
