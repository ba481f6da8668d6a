"""Correct one object of a bundle, or make its loops again. Corrections are kept when the scene is baked again.

scene2hap edit kitchen.bundle gain fan -6
scene2hap edit kitchen.bundle intensity fan 0.3
scene2hap edit kitchen.bundle pitch fan 120 --state high
scene2hap edit kitchen.bundle start fan 1.5
scene2hap edit kitchen.bundle stop fan 4
scene2hap edit kitchen.bundle material table oak
scene2hap edit kitchen.bundle mass microwave 14
scene2hap edit kitchen.bundle thickness dining_table 0.03
scene2hap edit kitchen.bundle feet microwave rubber
scene2hap edit kitchen.bundle sound fan my_fan.wav
scene2hap edit kitchen.bundle sound fan my_fan.wav --watch
scene2hap edit kitchen.bundle sound fan my_fan.haptic
scene2hap edit kitchen.bundle state fan high
scene2hap edit kitchen.bundle mute fan
scene2hap edit kitchen.bundle name Cube.012 "washing machine"
scene2hap edit kitchen.bundle name Cube.013 "espresso machine" --llm openai:gpt-4o
scene2hap edit kitchen.bundle silence hood
scene2hap edit kitchen.bundle vibrate kettle
scene2hap edit kitchen.bundle lock fan
scene2hap edit kitchen.bundle reset fan
scene2hap edit kitchen.bundle apply corrections.json
scene2hap edit kitchen.bundle rebake --actuator lra
scene2hap edit kitchen.bundle undo
scene2hap edit kitchen.bundle redo
scene2hap edit kitchen.bundle diff other.bundle

A named object, and one that is made to vibrate, is inferred again by the lexicon, or by the model of `--llm`. A bundle
has the names of its objects but no pictures, so the model reads the names alone.

A material of your own is given by its constants, as JSON:
'{"name": "my oak", "density_kg_m3": 690, "youngs_modulus_pa": 1.1e10, "poisson_ratio": 0.35, "loss_factor": 0.01}'.
"""

from __future__ import annotations

import argparse
import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from scene2hap.baking import BakeConfig, rebake
from scene2hap.baking.loops import Remade
from scene2hap.bundle import HapticBundle, Override
from scene2hap.bundle.differences import differ, differences
from scene2hap.bundle.folder_replacement import save_stamp
from scene2hap.bundle.history import MOST_STEPS, Kind, pop, require_steps, step_beside, steps_beside, warned_of_steps
from scene2hap.bundle.writing import write_both, write_edited
from scene2hap.cli.console import Console, Tell
from scene2hap.cli.given_spec import given_spec
from scene2hap.cli.shared_options import add_backend_arguments, add_loop_arguments, backend_settings, loop_settings
from scene2hap.cli.tables import show_report
from scene2hap.common.counted import counted
from scene2hap.common.files import file_stamp
from scene2hap.common.printable import quoted
from scene2hap.errors import BundleChanged, BundleError, Scene2HapError
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.wrappers import is_remote

POLL_S = 0.05
"""Interval between checks of a watched file [s]."""


@dataclass
class Rebake:
    """Bake parts of a bundle again, with the settings in the arguments, and note what was done.

    `remade` has the loops that were made, with the reasons. `report` is the inference by a model on a network, or by
    any other backend with errors; None without one.
    """

    arguments: argparse.Namespace
    config: BakeConfig
    tell: Tell
    remade: dict[str, dict[str, list[str]]] = field(default_factory=dict)
    report: InferenceReport | None = None

    def rebake(self, bundle: HapticBundle) -> HapticBundle:
        """Return the bundle after `scene2hap.rebake`. Raises: as it does."""
        prompt = getattr(self.arguments, "prompt", "")
        return rebake(
            bundle,
            self.config,
            user_prompt=prompt,
            progress=self.tell,
            on_report=self._note,
            on_remade=self._note_loops,
        )

    def _note(self, report: InferenceReport) -> None:
        is_of_model = is_remote(self.config.llm) and report.calls
        self.report = report if is_of_model or report.errors else None

    def _note_loops(self, remade: Remade) -> None:
        self.remade = {key: {state: list(why) for state, why in states.items()} for key, states in remade.items()}


_STEPS: dict[str, tuple[Kind, Kind]] = {"undo": ("before", "after"), "redo": ("after", "before")}
"""Verbs that load a step of the history: from where, and to where the present bundle goes."""

Changed = Callable[[HapticBundle, Rebake], HapticBundle]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap edit``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote; it is replaced as a whole")
    verbs = parser.add_subparsers(title="verbs", dest="verb", required=True, metavar="VERB")

    def verb(name: str, text: str, change: Changed | None, *, of_object: bool = True) -> argparse.ArgumentParser:
        added: argparse.ArgumentParser = verbs.add_parser(name, help=text, description=text)
        added.set_defaults(change=change)
        if of_object:
            added.add_argument("id", metavar="ID", help="id of an object")
        return added

    called = verb("name", "say what an object is; it is inferred again, and its loops are made", _remade)
    called.add_argument("name", metavar="WORDS", help="such as 'washing machine'")
    gain = verb("gain", "set the level of an object at the hand", _overridden)
    gain.add_argument("gain_db", metavar="DB", type=float, help="relative to the inferred level")
    intensity = verb("intensity", "set the strength of an object's vibration, and make its loops again", _remade)
    intensity.add_argument("intensity", metavar="VALUE", type=float, help="above 0, up to 1; a ringing phone has 0.5")
    pitch = verb("pitch", "set the frequency of an object's vibration, and make its loops again", _remade)
    pitch.add_argument("pitch_hz", metavar="HZ", type=float, help="within the band of the actuator")
    start = verb("start", "set the time that a source needs to start after it is switched on", _overridden)
    start.add_argument("start_up_s", metavar="S", type=float, help="0..30 seconds; 0 starts at once")
    stop = verb("stop", "set the time that a source needs to stop after it is switched off", _overridden)
    stop.add_argument("wind_down_s", metavar="S", type=float, help="0..30 seconds; 0 stops at once")
    for added in (intensity, pitch, start, stop):
        added.add_argument("--state", dest="only", metavar="NAME", help="change only this state; default: all states")
    material = verb("material", "set the material of an object", _overridden)
    material.add_argument(
        "material",
        metavar="NAME",
        help="a name in the table, see `scene2hap list materials`, or JSON, see `scene2hap edit --help`",
    )
    mass = verb("mass", "set the mass of a whole object", _overridden)
    mass.add_argument("mass_kg", metavar="KG", type=float, help="in kilograms, with its usual contents")
    thickness = verb("thickness", "set the thickness of an object's main surface", _overridden)
    thickness.add_argument("thickness_m", metavar="M", type=float, help="in metres; 0.001 is a sheet of 1 mm")
    feet = verb("feet", "set the material of an object's feet", _overridden)
    feet.add_argument("feet", metavar="NAME", help="a name in the table, such as rubber or felt, or JSON")
    sound = verb("sound", "make the vibration of an object from your own sound, in every state", _remade)
    sound.add_argument(
        "clip",
        metavar="FILE",
        help="a sound (WAV, FLAC, ...), or a haptic clip (.haptic, .ahap), which is played unchanged",
    )
    sound.add_argument("--watch", action="store_true", help="repeat whenever the file is saved, until Ctrl-C")
    state = verb("state", "set the state that an object has at the start", _overridden)
    state.add_argument("state", metavar="NAME", help="one of its states, see `scene2hap inspect BUNDLE`")
    for name, text, changes in (
        ("mute", "silence a source until a game unmutes it; its loops are kept", {"muted": True}),
        ("unmute", "play a muted source again", {"muted": False}),
        ("silence", "mark an object as not vibrating; its loops are removed", {"vibrates": False}),
        ("lock", "keep the loops of an object unchanged in every later bake", {"locked": True}),
        ("unlock", "allow changes of an object's loops again", {"locked": False}),
    ):
        verb(name, text, _overridden).set_defaults(**changes)
    vibrate = verb("vibrate", "mark an object as vibrating, and make its loops", _remade)
    vibrate.set_defaults(vibrates=True)
    reset = verb("reset", "take back all corrections of an object, and make its loops again", _reset)
    verb("undo", f"take back the last edit or bake, up to {MOST_STEPS} in a row", _undone, of_object=False)
    verb("redo", "restore what the last undo took back", _undone, of_object=False)
    diff = verb("diff", "show the differences to another bundle; changes nothing", None, of_object=False)
    diff.add_argument("other", metavar="OTHER", help="folder of a bundle")
    apply = verb("apply", "apply the corrections that were saved on a report page", _corrected, of_object=False)
    apply.add_argument("file", metavar="FILE", help="the file of corrections")
    again = verb("rebake", "make every loop again whose inputs have changed", _rebaked, of_object=False)
    add_loop_arguments(again)
    for added in (called, vibrate, reset, apply, again):
        add_backend_arguments(added)
    for added in verbs.choices.values():  # accept the options before and after the verb
        added.add_argument("-q", "--quiet", action="store_true", default=argparse.SUPPRESS)
        added.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print the result as JSON")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Edit, make the dependent loops again, and save. If a step fails, the bundle stays unchanged."""
    if arguments.verb == "diff":
        before, other = HapticBundle.load(arguments.bundle), HapticBundle.load(arguments.other)
        rows = [tuple(row) for row in differences(before, other)]
        if rows:
            console.table("differences", ("object", "what", str(arguments.bundle), str(arguments.other)), rows)
        else:
            console.say("no differences")
        return {"differences": rows}
    return _watch(arguments, console) if getattr(arguments, "watch", False) else _edit(arguments, console)


def _edit(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    require_steps(Path(arguments.bundle))
    settings = backend_settings(arguments) if "llm" in arguments else {}
    config = BakeConfig.parse(settings | (loop_settings(arguments) if "actuator" in arguments else {}))
    while True:
        try:
            return _edit_once(arguments, config, console)
        except BundleChanged:
            continue  # Another process has edited the bundle in the meantime. Both edits must be kept.


def _edit_once(arguments: argparse.Namespace, config: BakeConfig, console: Console) -> dict[str, Any]:
    read = save_stamp(Path(arguments.bundle))
    before, problem = _present(arguments)
    with console.progress() as tell:
        remaking = Rebake(arguments, config, tell)
        after = arguments.change(before, remaking)
    remade = remaking.remade
    if remaking.report is not None:
        show_report(console, remaking.report, remaking.config.prices)
    all_changes = () if before is None else differences(before, after)
    moved = _STEPS.get(arguments.verb)
    if before is not None and not remade and not differ(before, after):
        if moved is not None:  # an undo or a redo that was interrupted has left this step behind
            pop(Path(arguments.bundle), moved[0])
            return _edit_once(arguments, config, console)
        # Saving would keep an equal bundle as a step, so that an undo would change nothing.
        console.say(f"nothing changed; {arguments.bundle} stays as it was")
        return {"bundle": str(arguments.bundle), "differences": [], "remade": remade}
    folder = Path(arguments.bundle)
    if moved is None:
        write_edited(after, folder, before, since=read)
    else:
        write_both(after, folder, before, moved[1], since=read)
        with warned_of_steps(folder):
            pop(folder, moved[0])
    # A table of its own shows loops, and "loops made again" the actuator.
    changes = [row for row in all_changes if row.what != "actuator" and not row.what.startswith("loop ")]
    for object_id, what, old, new in changes:
        console.say(f"{object_id}, {what}: {old} -> {new}")
    if arguments.verb == "sound" and (clip := after.overrides[arguments.id].clip) is not None and clip.loop is not None:
        first_s, end_s = (edge / clip.sample_rate_hz for edge in clip.loop)
        console.say(f"the loop that {arguments.clip} marks is used, {first_s:.2f} to {end_s:.2f} s")
    if remade:
        rows = [
            (key, state, ", ".join(_IN_WORDS.get(one, one) for one in why))
            for key, states in remade.items()
            for state, why in states.items()
        ]
        console.table("loops made again", ("object", "state", "what changed"), rows)
    if problem is not None and moved is not None:
        console.say(f"the bundle that could not be read is in {step_beside(folder, moved[1])}: {problem}")
    elif not changes and not remade:
        console.say(_without_values(arguments.verb, sum(row.what.startswith("loop ") for row in all_changes)))
    console.say(f"wrote {folder}")
    if moved is not None:
        n_back, n_forward = (len(steps_beside(folder, kind)) for kind in ("before", "after"))
        console.say(f"{counted(n_back, 'step')} back by undo, {counted(n_forward, 'step')} forward by redo")
    return {"bundle": str(folder), "differences": [tuple(row) for row in all_changes], "remade": remade}


def _present(arguments: argparse.Namespace) -> tuple[HapticBundle | None, BundleError | None]:
    """Return the bundle as it is now. `undo` and `redo` need not read it: then it may be None, with the reason."""
    try:
        return HapticBundle.load(arguments.bundle), None
    except BundleError as problem:
        if arguments.verb not in _STEPS or save_stamp(Path(arguments.bundle)) is None:
            raise
        return None, problem


def _without_values(verb: str, n_loops: int) -> str:
    """Describe an edit that changed no value. Only `undo` and `redo` bring back loops without making them."""
    if verb not in _STEPS:
        return "the values stay; noted as yours, for later bakes"
    return f"{counted(n_loops, 'loop') if n_loops else 'the corrections'} of the bundle {_STEPS[verb][0]}"


_IN_WORDS = {"plan": "its place among the sources"}
"""Longer names for inputs of a loop whose short names mean nothing to a designer."""


def _watch(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Repeat the edit whenever the sound is saved. Reports a broken file, and waits for the next save."""
    path = Path(arguments.clip)
    seen = file_stamp(path)  # before the first edit, so that a save during it is noticed
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
    """Provide an event that Ctrl-C sets, in place of an exception.

    An exception would be lost in a callback from C, for example while a sound file is being written.
    """
    event = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: event.set())
    try:
        yield event
    finally:
        signal.signal(signal.SIGINT, before)


def _overridden(bundle: HapticBundle, remaking: Rebake) -> HapticBundle:
    arguments = remaking.arguments
    changes = {one.name: getattr(arguments, one.name) for one in fields(Override) if one.name in arguments}
    for name in {"material", "feet"} & changes.keys():
        changes[name] = given_spec(name, changes[name])
    if getattr(arguments, "only", None) is not None:
        changes = {name: {arguments.only: value} for name, value in changes.items()}
    return bundle.override(arguments.id, **changes)


def _remade(bundle: HapticBundle, remaking: Rebake) -> HapticBundle:
    return remaking.rebake(_overridden(bundle, remaking))


def _reset(bundle: HapticBundle, remaking: Rebake) -> HapticBundle:
    return remaking.rebake(bundle.reset(remaking.arguments.id))


def _corrected(bundle: HapticBundle, remaking: Rebake) -> HapticBundle:
    return remaking.rebake(bundle.corrected(remaking.arguments.file))


def _rebaked(bundle: HapticBundle, remaking: Rebake) -> HapticBundle:
    return remaking.rebake(bundle)


def _undone(bundle: HapticBundle | None, remaking: Rebake) -> HapticBundle:
    verb, folder = remaking.arguments.verb, Path(remaking.arguments.bundle)
    kind = _STEPS[verb][0]
    steps = steps_beside(folder, kind)
    if not steps:
        reason = f"; up to {MOST_STEPS} steps are kept" if verb == "undo" else "; an edit after an undo removes it"
        raise BundleError(f"there is nothing to {verb}: {quoted(step_beside(folder, kind))} does not exist{reason}.")
    return HapticBundle.load(steps[0])
