"""Which output and which input is meant, by name, interface and default."""

from types import SimpleNamespace
from typing import Any

import pytest

from scene2hap.devices import portaudio
from scene2hap.errors import DeviceNotFound

WINDOWS = [
    ("MME", ["Sound Mapper", "Speakers (Realtek High Definiti", "Pad"]),
    ("Windows DirectSound", ["Primary Sound Driver", "Speakers (Realtek High Definition Audio)", "Pad"]),
    ("Windows WASAPI", ["Speakers (Realtek High Definition Audio)", "Pad"]),
    ("Windows WDM-KS", ["Pad"]),
]
"""Interfaces and outputs as PortAudio lists them on Windows; MME's names have at most 31 characters."""


def lists(monkeypatch: pytest.MonkeyPatch, interfaces: list[tuple[str, list[str]]], default: int | None = None) -> None:
    """Replace PortAudio's lists. Each interface has its last output as default, the system that of the first one."""
    devices: list[dict[str, Any]] = []
    of_interfaces = []
    for number, (interface, names) in enumerate(interfaces):
        for name in names:
            devices.append({"name": name, "hostapi": number, "max_output_channels": 2, "max_input_channels": 1})
            devices[-1]["default_samplerate"] = 48000.0
        last = len(devices) - 1
        of_interfaces.append({"name": interface, "default_output_device": last, "default_input_device": last})
    of_system = of_interfaces[0]["default_output_device"] if default is None else default
    sounddevice = SimpleNamespace(
        default=SimpleNamespace(device=(of_system, of_system)),
        query_hostapis=lambda: of_interfaces,
        query_devices=lambda: devices,
        _terminate=lambda: None,
        _initialize=lambda: None,
    )
    monkeypatch.setattr(portaudio, "_sounddevice", lambda: sounddevice)


@pytest.mark.parametrize(
    ("wanted", "index"),
    [
        (None, 7),
        ("Pad", 7),
        ("pad, mme", 2),
        ("Pad, Windows DirectSound", 5),
        ("Pad, Windows WDM-KS", 8),
        ("Realtek", 6),
        ("Speakers (Realtek High Definiti", 1),
        ("sound mapper", 0),
        ("wasapi", 6),
        (4, 4),
    ],
)
def test_wasapi_comes_first_on_windows(monkeypatch: pytest.MonkeyPatch, wanted: str | int | None, index: int) -> None:
    lists(monkeypatch, WINDOWS)
    assert portaudio.find_card(wanted).index == index


def test_default_that_a_program_set_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    lists(monkeypatch, WINDOWS, default=4)
    assert portaudio.find_card(None).index == portaudio.default_input() == 4


def test_default_input_is_that_of_wasapi(monkeypatch: pytest.MonkeyPatch) -> None:
    lists(monkeypatch, WINDOWS)
    assert portaudio.default_input() == 7


def test_order_and_default_are_portaudios_elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    lists(monkeypatch, [("ALSA", ["pulse", "hw:0", "pad"]), ("JACK", ["pad"])])
    assert [card.index for card in portaudio.cards()] == [0, 1, 2, 3]
    assert portaudio.find_card(None).index == portaudio.find_card("pad").index == 2
    assert portaudio.find_card("pad, JACK").index == 3


def test_error_lists_names_with_their_interfaces(monkeypatch: pytest.MonkeyPatch) -> None:
    lists(monkeypatch, WINDOWS)
    with pytest.raises(DeviceNotFound, match=r"no output 'Pad, ASIO' among .* 7: 'Pad' \(Windows WASAPI, 2 channels"):
        portaudio.find_card("Pad, ASIO")
