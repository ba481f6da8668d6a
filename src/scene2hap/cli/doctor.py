"""Tell what this machine has for scene2hap: extras, sound cards and serial ports; and what to install for the rest.

`--sweep soundcard` (or any other sink) plays a quiet sweep on each hand in turn, through the safety layer.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import re
import time
from importlib import metadata
from typing import Any

import numpy as np

from scene2hap import __version__
from scene2hap.cli.console import Console
from scene2hap.devices import SINKS
from scene2hap.devices.clock import has_clock
from scene2hap.devices.protocol import ActuatorSink, Block, Fill, SinkFormat
from scene2hap.errors import ConfigError, DeviceError, MissingExtra
from scene2hap.haptics import ActuatorProfile
from scene2hap.render.safety import SafetyLayer

HELP = "what this machine has, what is missing, and a test sweep"

RATE_HZ = 48000
SWEEP_HZ = (40.0, 400.0)
SWEEP_S, PAUSE_S = 2.0, 0.5
LEVEL_DB = -20.0
"""Quiet: a tenth of full scale."""

_EXTRA = re.compile(r"""^(?P<package>[A-Za-z0-9._-]+)[^;]*;.*extra\s*==\s*['"](?P<extra>[^'"]+)['"]""")
_OF_DEVELOPERS = frozenset({"all", "test", "dev"})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap doctor``."""
    parser.add_argument(
        "--sweep", metavar="SINK", help='a kind, or JSON: \'{"kind": "serial", "port": "/dev/ttyACM0"}\''
    )
    parser.add_argument("--hands", default="left,right", help="names of the outputs, in their order")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Look around, show, and play if asked."""
    outcome: dict[str, Any] = {
        "scene2hap": __version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "extras": extras(),
        "sound_cards": sound_cards(),
        "serial_ports": serial_ports(),
    }
    console.say(f"scene2hap {__version__}, Python {outcome['python']}, {outcome['system']}")
    console.table(
        "Extras",
        ("extra", "package", "installed", "to install"),
        ((row["extra"], row["package"], row["version"] or "no", row["hint"]) for row in outcome["extras"]),
    )
    for what, found in (("Sound cards", outcome["sound_cards"]), ("Serial ports", outcome["serial_ports"])):
        console.say(f"{what}:")
        for line in found["found"] or [found["problem"] or "none"]:
            console.say(f"  {line}")
    if arguments.sweep:
        outcome["sweep"] = sweep(_spec(arguments.sweep), tuple(arguments.hands.split(",")), console)
    return outcome


def extras() -> list[dict[str, str]]:
    """Each optional package: the extra that brings it, its version if installed, and the command if not."""
    rows = []
    for requirement in metadata.requires("scene2hap") or ():
        match = _EXTRA.match(requirement)
        if match is None or match["extra"] in _OF_DEVELOPERS:
            continue
        try:
            version, hint = metadata.version(match["package"]), ""
        except metadata.PackageNotFoundError:
            version, hint = "", f'pip install "scene2hap[{match["extra"]}]"'
        rows.append({"extra": match["extra"], "package": match["package"], "version": version, "hint": hint})
    return rows


def sound_cards() -> dict[str, Any]:
    """The cards that could play, or why none can be looked for."""
    from scene2hap.devices import portaudio

    try:
        portaudio.require_sounddevice()
        return {"found": [str(card) for card in portaudio.cards()], "problem": ""}
    except (MissingExtra, DeviceError) as problem:
        return {"found": [], "problem": str(problem)}


def serial_ports() -> dict[str, Any]:
    """The ports that an amplifier may be at, or why none can be looked for."""
    try:
        from serial.tools import list_ports
    except ImportError:
        return {"found": [], "problem": 'pyserial is not installed: pip install "scene2hap[serial]"'}
    return {"found": [f"{port.device}: {port.description}" for port in list_ports.comports()], "problem": ""}


def sweep(spec: object, hands: tuple[str, ...], console: Console) -> dict[str, Any]:
    """Play the sweep on each hand in turn; what the sink counted. Raises: ConfigError, DeviceError."""
    sink = SINKS.build(spec)
    if not isinstance(sink, ActuatorSink):
        raise ConfigError(f"--sweep {spec!r} is no sink; kinds are {', '.join(SINKS.kinds())}.")
    seconds = len(hands) * (SWEEP_S + PAUSE_S)
    safety = SafetyLayer(ActuatorProfile(), RATE_HZ, len(hands), watchdog_s=0.5 if has_clock(sink) else None)
    sink.open(SinkFormat(RATE_HZ, hands))
    try:
        sink.start(safety.guard(_sweeps(len(hands))))
        if has_clock(sink):
            _keep_fed(safety, hands, console)
        else:
            sink.pull(round(seconds * RATE_HZ))  # type: ignore[attr-defined]  # no clock
    finally:
        safety.release()
        sink.stop()
        sink.close()
    stats = sink.stats
    latency_s = getattr(stats, "latency_s", None)
    latency = "" if latency_s is None else f", latency {1e3 * latency_s:.0f} ms"
    console.say(f"swept {', '.join(hands)}: {stats.frames} frames, {stats.underruns} underruns{latency}")
    return {"frames": stats.frames, "underruns": stats.underruns, "latency_s": latency_s}


def _keep_fed(safety: SafetyLayer, hands: tuple[str, ...], console: Console) -> None:
    for hand in hands:
        console.say(f"  {hand}: {SWEEP_HZ[0]:g} to {SWEEP_HZ[1]:g} Hz at {LEVEL_DB:g} dB")
        until = time.monotonic() + SWEEP_S + PAUSE_S
        while time.monotonic() < until:
            safety.feed()
            time.sleep(0.02)


def _sweeps(n_hands: int) -> Fill:
    """A logarithmic sweep on each channel in turn."""
    position = 0
    n_sweep, n_turn = round(SWEEP_S * RATE_HZ), round((SWEEP_S + PAUSE_S) * RATE_HZ)
    low, high = SWEEP_HZ
    rate = math.log(high / low)

    def fill(n_frames: int) -> Block:
        nonlocal position
        frames = np.arange(position, position + n_frames)
        position += n_frames
        block = np.zeros((n_frames, n_hands), dtype=np.float32)
        for hand in range(n_hands):
            t = (frames - hand * n_turn) / RATE_HZ
            inside = (t >= 0) & (t < n_sweep / RATE_HZ)
            phase = 2 * math.pi * low * SWEEP_S / rate * np.expm1(rate * t[inside] / SWEEP_S)
            edge = np.clip(np.minimum(t[inside], SWEEP_S - t[inside]) / 0.05, 0.0, 1.0)
            block[inside, hand] = 10 ** (LEVEL_DB / 20) * np.sin(phase) * edge
        return block

    return fill


def _spec(text: str) -> object:
    if not text.lstrip().startswith("{"):
        return text
    try:
        return json.loads(text)
    except ValueError as cause:
        raise ConfigError(f"--sweep {text!r} is no JSON: {cause}.") from cause
