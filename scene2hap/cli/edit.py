"""Correct one object of a bundle, or make its loops again; corrections stay when it is baked again.

scene2hap edit kitchen.bundle gain fan -6
scene2hap edit kitchen.bundle intensity fan 0.3
scene2hap edit kitchen.bundle pitch fan 120 --state high
scene2hap edit kitchen.bundle start fan 1.5
scene2hap edit kitchen.bundle stop fan 4
scene2hap edit kitchen.bundle material table oak
scene2hap edit kitchen.bundle mass microwave 14
scene2hap edit kitchen.bundle feet microwave rubber
scene2hap edit kitchen.bundle sound fan my_fan.wav
scene2hap edit kitchen.bundle sound fan my_fan.wav --watch
scene2hap edit kitchen.bundle sound fan my_fan.haptic
scene2hap edit kitchen.bundle state fan high
scene2hap edit kitchen.bundle mute fan
scene2hap edit kitchen.bundle silence hood
scene2hap edit kitchen.bundle lock fan
scene2hap edit kitchen.bundle apply corrections.json
scene2hap edit kitchen.bundle rebake --actuator lra
scene2hap edit kitchen.bundle undo
scene2hap edit kitchen.bundle diff other.bundle
"""

from __future__ import annotations

import argparse
import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from scene2hap.baking import rebake
from scene2hap.baking.scene import OnRemade
from scene2hap.bundle import HapticBundle, differences, require_replaceable
from scene2hap.cli.console import Console
from scene2hap.errors import BundleError, Scene2HapError
from scene2hap.file_stamp import file_stamp

HELP = "correct one object of a bundle"

POLL_S = 0.05
"""How often a watched file is looked at."""

Changed = Callable[[HapticBundle, argparse.Namespace, OnRemade], HapticBundle]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap edit``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote; it is replaced as a whole")
    verbs = parser.add_subparsers(title="verbs", dest="verb", required=True, metavar="VERB")

    def verb(name: str, text: str, change: Changed | None, *, of_object: bool = True) -> argparse.ArgumentParser:
        added: argparse.ArgumentParser = verbs.add_parser(name, help=text, description=text)
        added.set_defaults(change=change)
        if of_object:
            added.add_argument("id", metavar="ID", help="id of an object")
        return added

    gain = verb("gain", "set the level of an object at the hand", _overridden)
    gain.add_argument("gain_db", metavar="DB", type=float, help="against the inferred level")
    intensity = verb("intensity", "set how strongly an object vibrates, and make its loops again", _remade)
    intensity.add_argument("intensity", metavar="VALUE", type=float, help="0..1; a ringing phone has 0.5")
    pitch = verb("pitch", "set the frequency at which an object is felt, and make its loops again", _remade)
    pitch.add_argument("pitch_hz", metavar="HZ", type=float, help="within the band of the actuator")
    start = verb("start", "set how long a source takes to come up when it is switched on", _overridden)
    start.add_argument("start_up_s", metavar="S", type=float, help="0..30; 0 is at once")
    stop = verb("stop", "set how long a source takes to die away when it is switched off", _overridden)
    stop.add_argument("wind_down_s", metavar="S", type=float, help="0..30; 0 is at once")
    for added in (intensity, pitch, start, stop):
        added.add_argument("--state", dest="only", metavar="NAME", help="of this state alone, instead of all")
    material = verb("material", "set the material of an object", _overridden)
    material.add_argument("material", metavar="NAME", help="a name in the table, see `scene2hap list materials`")
    mass = verb("mass", "set what a whole object weighs", _overridden)
    mass.add_argument("mass_kg", metavar="KG", type=float)
    feet = verb("feet", "set the material on which an object stands on others", _overridden)
    feet.add_argument("feet", metavar="NAME", help="a name in the table, such as rubber or felt")
    sound = verb("sound", "make the vibration of an object from your sound, in every state", _with_sound)
    sound.add_argument(
        "file",
        metavar="FILE",
        help="a sound (WAV, FLAC, ...), or a haptic clip (.haptic, .ahap), which is felt as it is",
    )
    sound.add_argument("--watch", action="store_true", help="repeat whenever the file is saved, until Ctrl-C")
    state = verb("state", "set the state that an object plays at first", _overridden)
    state.add_argument("state", metavar="NAME")
    for name, text, changes in (
        ("mute", "silence a source until a game unmutes it; its loops are kept", {"muted": True}),
        ("unmute", "play a muted source again", {"muted": False}),
        ("silence", "say that an object does not vibrate; its loops are removed", {"vibrates": False}),
        ("lock", "keep the loops of an object as they are, whatever is baked again", {"locked": True}),
        ("unlock", "let the loops of an object be made again", {"locked": False}),
    ):
        verb(name, text, _overridden).set_defaults(**changes)
    verb("undo", "take back the last edit; once more brings it again", _undone, of_object=False)
    diff = verb("diff", "show how another bundle differs; nothing is changed", None, of_object=False)
    diff.add_argument("other", metavar="OTHER", help="folder of a bundle")
    apply = verb("apply", "take over the corrections that a viewer of a report saved", _corrected, of_object=False)
    apply.add_argument("file", metavar="FILE", help="the file that a viewer saved")
    again = verb("rebake", "make the loops again that depend on what changed", _rebaked, of_object=False)
    again.add_argument("--actuator", metavar="NAME", help="name of an actuator, or a CSV file of Hz and dB")
    again.add_argument("--tactile", metavar="KIND", help="converter from sound to touch")
    for added in verbs.choices.values():  # taken after the verb as well as before it
        added.add_argument("-q", "--quiet", action="store_true", default=argparse.SUPPRESS)
        added.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print the outcome as JSON")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Correct, make the loops that follow, and save; the bundle stays as it was if any of it fails."""
    if arguments.verb == "diff":
        before, other = HapticBundle.load(arguments.bundle), HapticBundle.load(arguments.other)
        rows = [tuple(row) for row in differences(before, other)]
        console.table("differences", ("object", "what", str(arguments.bundle), str(arguments.other)), rows)
        return {"differences": rows}
    return _watch(arguments, console) if getattr(arguments, "watch", False) else _edit(arguments, console)


def _edit(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    require_replaceable(_kept(arguments.bundle))
    before = HapticBundle.load(arguments.bundle)
    remade: dict[str, dict[str, list[str]]] = {}

    def note(what: Any) -> None:
        remade.update({key: {state: list(why) for state, why in states.items()} for key, states in what.items()})

    folder = arguments.change(before, arguments, note).save(arguments.bundle)
    before.save(_kept(arguments.bundle))
    if remade:
        rows = [(key, state, ", ".join(why)) for key, states in remade.items() for state, why in states.items()]
        console.table("loops made again", ("object", "state", "what changed"), rows)
    console.say(f"wrote {folder}")
    return {"bundle": str(folder), "remade": remade}


def _watch(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Edit, and again whenever the sound is saved. Reports a broken file, and waits for the next save."""
    path = Path(arguments.file)
    seen = file_stamp(path)  # before the first edit: what is saved during it is read again
    outcome = _edit(arguments, console)
    with interrupted() as is_interrupted:
        console.say(f"watching {path}; Ctrl-C ends")
        while not is_interrupted.wait(POLL_S):
            stamp = file_stamp(path)
            if stamp is None or stamp == seen:
                continue
            seen = stamp
            try:
                outcome = _edit(arguments, console)
            except Scene2HapError as error:
                console.warn(str(error))
    return outcome


@contextlib.contextmanager
def interrupted() -> Iterator[threading.Event]:
    """An event that Ctrl-C sets, instead of an exception wherever the program is.

    One that is raised in a callback from C, as of a sound file that is being written, would be lost.
    """
    event = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: event.set())
    try:
        yield event
    finally:
        signal.signal(signal.SIGINT, before)


_FIELDS = (
    *("gain_db", "intensity", "pitch_hz", "start_up_s", "wind_down_s", "material", "mass_kg", "feet", "state"),
    *("muted", "vibrates", "locked"),
)


def _overridden(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    changes = {name: getattr(arguments, name) for name in _FIELDS if hasattr(arguments, name)}
    if getattr(arguments, "only", None) is not None:
        changes = {name: {arguments.only: value} for name, value in changes.items()}
    return bundle.override(arguments.id, **changes)


def _remade(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    return rebake(_overridden(bundle, arguments, note), on_remade=note)


def _with_sound(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    return rebake(bundle.override(arguments.id, clip=arguments.file), on_remade=note)


def _corrected(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    return rebake(bundle, corrections=arguments.file, on_remade=note)


def _rebaked(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    given = {"actuator": arguments.actuator, "tactile": arguments.tactile}
    return rebake(bundle, {name: value for name, value in given.items() if value is not None}, on_remade=note)


def _undone(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    kept = _kept(arguments.bundle)
    if not kept.exists():
        raise BundleError(f"there is nothing to undo: {str(kept)!r}, which an edit leaves, is not there.")
    return HapticBundle.load(kept)


def _kept(bundle: str) -> Path:
    """Where the bundle as it was before the last edit is kept."""
    folder = Path(bundle).resolve()
    return folder.with_name(f"{folder.name}.before")
