"""Correct one object of a bundle, or make its loops again; corrections stay when it is baked again.

scene2hap edit kitchen.bundle gain fan -6
scene2hap edit kitchen.bundle material table oak
scene2hap edit kitchen.bundle sound fan my_fan.wav
scene2hap edit kitchen.bundle silence hood
scene2hap edit kitchen.bundle lock fan
scene2hap edit kitchen.bundle rebake --actuator lra
scene2hap edit kitchen.bundle undo
scene2hap edit kitchen.bundle diff other.bundle
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from scene2hap.audio.files import read_clip
from scene2hap.baking import rebake
from scene2hap.baking.scene import OnRemade
from scene2hap.bundle import HapticBundle, differences, require_replaceable
from scene2hap.cli.console import Console
from scene2hap.errors import BundleError

HELP = "correct one object of a bundle"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap edit``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote; it is replaced as a whole")
    verbs = parser.add_subparsers(title="verbs", dest="verb", required=True, metavar="VERB")
    gain = verbs.add_parser("gain", help="set the level of an object at the hand")
    gain.add_argument("id", metavar="ID")
    gain.add_argument("gain_db", metavar="DB", type=float, help="against the inferred level")
    material = verbs.add_parser("material", help="set the material of an object")
    material.add_argument("id", metavar="ID")
    material.add_argument("material", metavar="NAME", help="a name in the table of materials")
    sound = verbs.add_parser("sound", help="make the vibration of an object from your sound, in every state")
    sound.add_argument("id", metavar="ID")
    sound.add_argument("file", metavar="FILE", help="a WAV or FLAC file")
    silence = verbs.add_parser("silence", help="say that an object does not vibrate; its loops are removed")
    silence.add_argument("id", metavar="ID")
    lock = verbs.add_parser("lock", help="keep the loops of an object as they are, whatever is baked again")
    lock.add_argument("id", metavar="ID")
    unlock = verbs.add_parser("unlock", help="let the loops of an object be made again")
    unlock.add_argument("id", metavar="ID")
    verbs.add_parser("undo", help="take back the last edit; once more brings it again")
    diff = verbs.add_parser("diff", help="show in what another bundle differs; nothing is changed")
    diff.add_argument("other", metavar="OTHER", help="folder of a bundle")
    again = verbs.add_parser("rebake", help="make the loops again that depend on what changed")
    again.add_argument("--actuator", metavar="NAME", help="name of an actuator, or a CSV file of Hz and dB")
    again.add_argument("--tactile", metavar="KIND", help="what turns sound into touch")
    for verb in verbs.choices.values():  # taken after the verb as well as before it
        verb.add_argument("-q", "--quiet", action="store_true", default=argparse.SUPPRESS)
        verb.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print the outcome as JSON")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Correct, make the loops that follow, and save; the bundle stays as it was if any of it fails."""
    before = HapticBundle.load(arguments.bundle)
    if arguments.verb == "diff":
        rows = [tuple(row) for row in differences(before, HapticBundle.load(arguments.other))]
        console.table("what differs", ("object", "what", str(arguments.bundle), str(arguments.other)), rows)
        return {"differences": rows}
    require_replaceable(_kept(arguments.bundle))
    remade: dict[str, dict[str, list[str]]] = {}

    def note(what: Any) -> None:
        remade.update({key: {state: list(why) for state, why in states.items()} for key, states in what.items()})

    bundle = _edited(before, arguments, note)
    folder = bundle.save(arguments.bundle)
    before.save(_kept(arguments.bundle))
    if remade:
        rows = [(key, state, ", ".join(why)) for key, states in remade.items() for state, why in states.items()]
        console.table("loops made again", ("object", "state", "what changed"), rows)
    console.say(f"wrote {folder}")
    return {"bundle": str(folder), "remade": remade}


def _edited(bundle: HapticBundle, arguments: argparse.Namespace, note: OnRemade) -> HapticBundle:
    verb = arguments.verb
    if verb == "gain":
        return bundle.override(arguments.id, gain_db=arguments.gain_db)
    if verb == "material":
        return bundle.override(arguments.id, material=arguments.material)
    if verb == "silence":
        return bundle.override(arguments.id, vibrates=False)
    if verb in ("lock", "unlock"):
        return bundle.override(arguments.id, locked=verb == "lock")
    if verb == "sound":
        return rebake(bundle.override(arguments.id, clip=read_clip(arguments.file)), on_remade=note)
    if verb == "undo":
        kept = _kept(arguments.bundle)
        if not kept.exists():
            raise BundleError(f"there is nothing to undo: {str(kept)!r}, which an edit leaves, is not there.")
        return HapticBundle.load(kept)
    given = {"actuator": arguments.actuator, "tactile": arguments.tactile}
    return rebake(bundle, {name: value for name, value in given.items() if value is not None}, on_remade=note)


def _kept(bundle: str) -> Path:
    """Where the bundle as it was before the last edit is kept."""
    folder = Path(bundle).resolve()
    return folder.with_name(f"{folder.name}.before")
