"""OSC messages of gain, clip and hand, against bytes computed by hand from OSC 1.0."""

import builtins
import sys
import time
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.devices.datagrams import Datagrams
from scene2hap.devices.osc import OscLine, encode, gains_of
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.serial_amp import SerialAmplifierSink
from scene2hap.devices.udp import UdpSink
from scene2hap.errors import ConfigError, MissingExtra


@dataclass
class Frame:
    gains: NDArray[np.float32]
    hands: tuple[str, ...] = ("left", "right")
    sources: tuple[str, ...] = ("radio", "kettle")


def test_a_gain_message_by_hand() -> None:
    by_hand = b"/scene2hap/gain\0" + b",fsi\0\0\0\0" + b"\x3f\0\0\0" + b"a.wav\0\0\0" + b"\0\0\0\1"
    assert encode("/scene2hap/gain", 0.5, "a.wav", 1) == by_hand


def test_gain_messages_are_sent_per_hand_and_clip() -> None:
    gains = np.array([[[0.1, 0.5], [0, 0]], [[0.25, 0.2], [1, 0]]], dtype=np.float32)
    assert list(gains_of(Frame(gains), {"radio": "loops/radio.wav"})) == [
        ("loops/radio.wav", 0, 0.5),
        ("kettle", 0, 0.0),
        ("loops/radio.wav", 1, 0.25),
        ("kettle", 1, 1.0),
    ]


def test_sources_that_share_a_clip_have_one_gain_of_their_power() -> None:
    """Two phones of one sound: the receiver has one gain for it, and it must not be that of the phone left alone."""
    gains = np.array([[[0.5], [0.0]], [[0.6], [0.8]]], dtype=np.float32)
    for clips in ({"radio": "ring.wav", "kettle": "ring.wav"}, {"radio": "kettle"}):
        found = list(gains_of(Frame(gains), clips))
        assert [(clip, hand) for clip, hand, _ in found] == [(clips.get("kettle", "kettle"), hand) for hand in (0, 1)]
        assert [gain for *_, gain in found] == pytest.approx([0.5, 1.0])


class Wire(Datagrams):
    """Datagrams that are kept instead of sent."""

    def __init__(self) -> None:
        super().__init__("nowhere", 1)
        self.sent: list[bytes] = []

    def send(self, data: bytes) -> None:
        self.sent.append(data)


def test_plays_and_gains_are_sent_when_they_change_and_all_again_each_second(monkeypatch: pytest.MonkeyPatch) -> None:
    """A lost message is mended within a second."""
    now_s = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])
    wire = Wire()
    line = OscLine(wire, {})
    line.latest = Frame(np.array([[[0.5], [0.0]], [[0.0], [0.25]]], dtype=np.float32))
    gains = [encode("/scene2hap/gain", 0.5, "radio", 0), encode("/scene2hap/gain", 0.25, "kettle", 1)]
    zeros = [encode("/scene2hap/gain", 0.0, "kettle", 0), encode("/scene2hap/gain", 0.0, "radio", 1)]

    def sent_at(time_s: float) -> set[bytes]:
        now_s[0], wire.sent[:] = time_s, []
        line.wanted(0.0)
        return set(wire.sent)

    plays = [encode("/scene2hap/play", "radio"), encode("/scene2hap/play", "kettle")]
    assert sent_at(100.0) == {*plays, *gains}
    assert sent_at(100.9) == set()
    assert sent_at(101.1) == {*plays, *gains, *zeros}
    assert sent_at(101.9) == set()
    line.latest = Frame(np.array([[[0.0], [0.0]], [[0.0], [0.25]]], dtype=np.float32))
    assert sent_at(102.2) == {plays[1], gains[1], encode("/scene2hap/gain", 0.0, "radio", 0), *zeros}


def test_a_removed_source_or_hand_falls_silent_at_the_receiver(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its 0 is sent at once and once more, in case the first is lost; then it costs no more messages."""
    now_s = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])
    wire = Wire()
    line = OscLine(wire, {})
    line.latest = Frame(np.full((2, 2, 1), 0.5, dtype=np.float32))
    line.wanted(0.0)
    line.latest = Frame(np.full((1, 1, 1), 0.5, dtype=np.float32), ("left",), ("radio",))
    silenced = {encode("/scene2hap/gain", 0.0, *one) for one in (("kettle", 0), ("kettle", 1), ("radio", 1))}
    kept = {encode("/scene2hap/play", "radio"), encode("/scene2hap/gain", 0.5, "radio", 0)}
    for time_s, expected in ((100.1, silenced), (100.2, set()), (101.1, silenced | kept), (102.2, kept)):
        now_s[0], wire.sent[:] = time_s, []
        line.wanted(0.0)
        assert set(wire.sent) == expected


def test_samples_are_taken_at_the_session_s_rate(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are discarded, but the session's clock, and so each ramp and impact, advances with them."""
    now_s, wire = [100.0], Wire()
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])
    monkeypatch.setattr(time, "sleep", lambda s: now_s.__setitem__(0, now_s[0] + s + 1e-4))
    monkeypatch.setattr(wire, "connect", lambda hello, carry_on: None)
    line, taken = OscLine(wire, {}), 0
    line.connect(SinkFormat(48_000, ("left",)), lambda: True)
    for _ in range(300):
        n = line.wanted(0.005)
        line.send(np.zeros((n, 1), dtype=np.float32))
        taken += n
    assert taken / 48_000 == pytest.approx(now_s[0] - 100.0, abs=0.02)
    assert taken > 10_000


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"port": 0}, "at least 1"),
        ({"port": 70000}, "at most 65535"),
        ({"content": "mp3"}, '"pcm" or "osc"'),
        ({"samples": "int24"}, '"int16"'),
        ({"sample_rate_hz": 0}, "at least 500"),
        ({"block_frames": 0}, "at least 1"),
        ({"block_frames": 1.5}, "whole number"),
        ({"port": 9000.5}, "whole number"),
        ({"sample_rate_hz": 8000.5}, "whole number"),
        ({"on_event": "print"}, "on_event is 'print'; it must be a function"),
        ({"content": "osc", "clips": ["radio"]}, "must map each source"),
        ({"content": "osc", "clips": {"radio": 1}}, "must map each source"),
    ],
)
def test_settings_out_of_bounds_are_refused(settings: dict[str, object], words: str) -> None:
    with pytest.raises(ConfigError, match=words):
        UdpSink(**settings)


@pytest.mark.parametrize(
    "settings",
    [
        {"baud_rate": 300},
        {"baud_rate": 115200.5},
        {"sample_rate_hz": 1},
        {"sample_rate_hz": 4000.5},
        {"buffer_s": 0},
        {"block_frames": 1000},
        {"block_frames": 2.5},
    ],
)
def test_serial_settings_out_of_bounds_are_refused(settings: dict[str, object]) -> None:
    with pytest.raises(ConfigError, match=next(iter(settings))):
        SerialAmplifierSink("/dev/none", **settings)


def test_a_missing_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *args: object) -> object:
        if name.split(".")[0] in ("serial", "pythonosc"):
            raise ImportError(name)
        return real(name, *args)

    for name in [name for name in sys.modules if name.split(".")[0] in ("serial", "pythonosc")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(MissingExtra, match=r"scene2hap\[serial\]"):
        SerialAmplifierSink("/dev/none")
    with pytest.raises(MissingExtra, match=r"scene2hap\[osc\]"):
        UdpSink(content="osc")
    UdpSink()
