"""The contract of `Exporter`."""

from __future__ import annotations

import numpy as np

from scene2hap.export import EXPORTS, Channel, Exporter, Track
from scene2hap.export.fidelity import fidelity
from scene2hap.plugins import lacking

_RATE_HZ = 8000


def check_exporter(exporter: Exporter) -> None:
    """Check an exporter against its protocol: a hum as a loop, two hands over time, a long track, a click and silence.

    Raises: AssertionError: names the broken promise.
    """
    problem = lacking(exporter, EXPORTS.members)
    assert not problem, problem
    for track in _tracks():
        _hold(exporter, track)


def _tracks() -> tuple[Track, ...]:
    t = np.arange(2 * _RATE_HZ) / _RATE_HZ
    hum = 0.3 * np.sin(2 * np.pi * 120 * t) * (1 + 0.5 * np.sin(2 * np.pi * 2 * t))
    click = np.zeros(_RATE_HZ)
    click[4000:4200] = 0.9 * np.sin(2 * np.pi * 160 * t[:200])
    long = 0.5 * np.sin(2 * np.pi * 150 * np.arange(34 * _RATE_HZ) / _RATE_HZ) * np.repeat([1.0, 0.2] * 17, _RATE_HZ)
    return (
        Track("hum.on", {"": Channel(hum, _RATE_HZ, is_loop=True)}),
        Track("tour", {"left": Channel(hum, _RATE_HZ), "right": Channel(click, _RATE_HZ)}),
        Track("long", {"": Channel(long, _RATE_HZ)}),
        Track("silent", {"": Channel(np.zeros(_RATE_HZ // 2), _RATE_HZ, is_loop=True)}),
        Track("shortest", {"": Channel(np.zeros(1), _RATE_HZ)}),
    )


def _hold(exporter: Exporter, track: Track) -> None:
    name = type(exporter).__name__
    made, again = exporter.export(track), exporter.export(track)
    assert made.files, f"{name} writes no file of {track.name!r}"
    for file, content in made.files.items():
        assert file.startswith(f"{track.name}."), f"{name} names a file {file!r}; it must begin with {track.name!r}."
        assert "/" not in file, f"{name} names a file {file!r}; it must be a name without a folder."
        assert "\\" not in file, f"{name} names a file {file!r}; it must be a name without a folder."
        assert isinstance(content, bytes), f"{name} gives {type(content).__name__} for {file!r}; files are bytes."
    assert dict(made.files) == dict(again.files), f"{name} writes other bytes for the same track"
    for channel, played in made.played.items():
        assert channel in track.channels, f"{name} tells what is played on {channel!r}, which the track has not"
        found = fidelity(track.channels[channel], played)
        error = f"{name} is {found.median_db:.1f} dB off on {track.name!r}, in the median"
        assert found.median_db <= 6.0, f"{error}; what it plays is another signal."
