"""Show the features of this machine: extras, plug-ins, sound cards and serial ports; and how to install missing ones.

`--sweep soundcard` (or any other sink) plays a quiet sweep on each hand in turn, through the safety layer. With
`--loop-back` an input records it at the same time, through a cable from the output or as a sound server's monitor. The
command reports the latency from request to that input, for each hand.
"""

from __future__ import annotations

import argparse
import platform
import re
from collections.abc import Callable
from dataclasses import asdict
from importlib import metadata
from typing import Any

from scene2hap import __version__
from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.cli.list import GROUPS
from scene2hap.cli.sweep import sweep
from scene2hap.common import checks
from scene2hap.compiled import are_in_use
from scene2hap.errors import ConfigError, DeviceError, MissingExtra, failure_of
from scene2hap.plugins import InstalledPlugin

_EXTRA = re.compile(r"""^(?P<package>[A-Za-z0-9._-]+)[^;]*;.*extra\s*==\s*['"](?P<extra>[^'"]+)['"]""")
_PLAIN = "; install a C compiler and then scene2hap again, without SCENE2HAP_COMPILED=0, and updates take half the time"
_OF_DEVELOPERS = frozenset({"all", "test", "dev", "docs"})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap doctor``."""
    parser.add_argument(
        "--sweep", metavar="SINK", help='a kind, or JSON: \'{"kind": "serial", "port": "/dev/ttyACM0"}\''
    )
    parser.add_argument(
        "--loop-back",
        metavar="INPUT",
        nargs="?",
        const="",
        help="with --sweep: measure the latency at this input, given by its name, a part of it, or PortAudio's index; "
        "default: an input named loop-back, monitor or stereo mix, or else the default input",
    )
    parser.add_argument("--hands", default="left,right", help="names of the outputs, in their order")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Inspect the machine, show the result, and play a sweep if requested."""
    hands = checks.names("--hands", arguments.hands.split(","))
    sink = given_spec("--sweep", arguments.sweep) if arguments.sweep else None
    if sink is None and arguments.loop_back is not None:
        raise ConfigError("--loop-back listens to a sweep; add --sweep soundcard, or the sink that is to be measured.")
    outcome: dict[str, Any] = {
        "scene2hap": __version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "kernels": "compiled" if are_in_use() else "plain",
        "extras": extras(),
        "plugins": installed(),
        "sound_cards": sound_cards(),
        "serial_ports": serial_ports(),
    }
    console.say(f"scene2hap {__version__}, Python {outcome['python']}, {outcome['system']}")
    console.say(f"Kernels: {outcome['kernels']}{'' if are_in_use() else _PLAIN}")
    console.table(
        "Extras",
        ("extra", "package", "installed", "to install"),
        ((row["extra"], row["package"], row["version"] or "no", row["hint"]) for row in outcome["extras"]),
    )
    console.say("Plug-ins:")
    for row in outcome["plugins"]:
        console.say(
            f"  {row['group']} {row['kind']!r}, {row['value']} of {row['package']}: {row['problem'] or 'loads'}"
        )
    if not outcome["plugins"]:
        console.say("  none")
    for what, found in (("Sound cards", outcome["sound_cards"]), ("Serial ports", outcome["serial_ports"])):
        console.say(f"{what}:")
        for line in found["found"] or [found["problem"] or "none"]:
            console.say(f"  {line}")
    if sink is not None:
        outcome["sweep"] = sweep(sink, hands, console, listen_to=arguments.loop_back)
    return outcome


def extras() -> list[dict[str, str]]:
    """Return each optional package: its extra, its version if installed, and else the command to install it."""
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


def installed() -> list[dict[str, str]]:
    """Return each plug-in of other packages: group, kind, package, and the error if it cannot be loaded."""
    names = [group.name for group in GROUPS.values()]
    found = [plugin for group in GROUPS.values() for plugin in group.installed()]
    for group in sorted(metadata.entry_points().groups):
        if group.startswith("scene2hap.") and group not in names:
            problem = f"there is no such group; the groups are {', '.join(names)}"
            found += [InstalledPlugin.of(entry, problem) for entry in metadata.entry_points(group=group)]
    return [asdict(plugin) for plugin in found]


def sound_cards() -> dict[str, Any]:
    """Return the sound cards, or the reason why they cannot be listed."""

    def found() -> list[str]:
        from scene2hap.devices import portaudio

        portaudio.require_sounddevice()
        return [str(card) for card in portaudio.cards()]

    return _listed(found)


def serial_ports() -> dict[str, Any]:
    """Return the serial ports, or the reason why they cannot be listed."""

    def found() -> list[str]:
        try:
            import serial  # noqa: F401  # the error below is about the package, not about one of its modules
        except ImportError as cause:
            raise MissingExtra('pyserial is not installed: pip install "scene2hap[serial]"') from cause
        from serial.tools import list_ports

        return [f"{port.device}: {port.description}" for port in list_ports.comports()]

    return _listed(found)


def _listed(found: Callable[[], list[str]]) -> dict[str, Any]:
    """Return what a part of the machine has, or the reason why that cannot be listed: drivers raise errors of any type.

    The other parts are shown all the same.
    """
    try:
        return {"found": found(), "problem": ""}
    except (MissingExtra, DeviceError) as problem:
        return {"found": [], "problem": str(problem)}
    except Exception as problem:
        return {"found": [], "problem": f"cannot be listed: {failure_of(problem)}"}
