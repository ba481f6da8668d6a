"""Play one source of a bundle alone, or write it to a file, as felt by a hand that touches the source itself.

scene2hap audition kitchen.bundle fan
scene2hap audition kitchen.bundle fan --state high -o fan.wav
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.cli.shared_options import add_session_arguments, session_config
from scene2hap.cli.sink_output import UPDATE_S, SinkOutput, silence
from scene2hap.common import checks
from scene2hap.devices import SINKS
from scene2hap.devices.wav import WavSink
from scene2hap.errors import ConfigError, DeviceError
from scene2hap.haptics import ObjectHaptics
from scene2hap.scene.objects import SceneObject
from scene2hap.session import HapticSession, Touch, UserProfile

HAND = "right"
MOST_S = 600.0
_AT_ONCE_S = 60.0
"""Length of the parts that are rendered into a file [s]: some ten megabytes."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap audition``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote")
    parser.add_argument("id", metavar="ID", help="id of a source")
    parser.add_argument("--state", metavar="NAME", help="one of its states; default: the first")
    parser.add_argument("--seconds", type=float, default=5.0, help="duration in seconds (5)")
    parser.add_argument("-o", "--output", metavar="WAV", help="write a file instead of playing")
    parser.add_argument("--sink", default="soundcard", help="where to play: a kind, or JSON with one (soundcard)")
    add_session_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Play the source, or write it to a file."""
    seconds = checks.number("--seconds", arguments.seconds, "s", above=0.0, at_most=MOST_S, error=ConfigError)
    bundle = HapticBundle.load(arguments.bundle)
    config = session_config(arguments.settings, bundle, prepare="blocking")
    wav = WavSink(arguments.output) if arguments.output else None
    user = _for_one_hand(arguments.profile)
    output = SinkOutput(wav or SINKS.build(given_spec("--sink", arguments.sink)))
    with HapticSession(bundle, config=config, hands=(HAND,), sink=output.sink, user=user) as session:
        silence(session, [], [arguments.id])
        session.set_source(arguments.id, state=arguments.state, mute=False)
        touch = Touch(HAND, arguments.id, _middle(session.snapshot.object(arguments.id)))
        frame = session.update(touches=[touch])
        if not frame.gain(HAND, arguments.id):
            console.warn(f"{arguments.id!r} is silent: {_why_silent(bundle.objects[arguments.id], arguments.state)}.")
        if wav is not None:
            with wav.whole_or_none():
                for start in np.arange(0.0, seconds, _AT_ONCE_S):
                    wav.pull_s(min(_AT_ONCE_S, seconds - start))
        else:
            _play(session, touch, output, seconds)
    if not output.has_played:
        raise DeviceError(
            f"nothing was played: {output.why_nothing_played} Connect the actuator, or write a file with -o."
        )
    if output.problem:
        console.warn(output.problem)
    if arguments.output:
        console.say(f"wrote {arguments.output}")
    return {"source": arguments.id, "state": arguments.state, "wav": arguments.output}


def _for_one_hand(path: str | None) -> UserProfile | None:
    """Read a profile without its other hands, which a session of one hand would take for wrong names."""
    if path is None:
        return None
    profile = UserProfile.parse(path)
    return profile.model_copy(update={"hands": {hand: one for hand, one in profile.hands.items() if hand == HAND}})


def _why_silent(haptics: ObjectHaptics, name: str | None) -> str:
    state = next((one for one in haptics.states if one.name == name), haptics.states[0])
    if state.needs_contact is not None:
        return f"state {state.name!r} needs contact with {state.needs_contact!r}, which the scene as it stands lacks"
    return "its level is too low to be felt"


def _play(session: HapticSession, touch: Touch, output: SinkOutput, seconds: float) -> None:
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        session.update(touches=[touch])
        output.take(session.config.sample_rate_hz)
        time.sleep(UPDATE_S)


def _middle(item: SceneObject) -> tuple[float, float, float]:
    """Return the center of the triangle that is nearest to the middle of the dominant surface [m, world]."""
    plate, mesh = item.surface, item.geometry.mesh
    middle = plate.pose.to_world([[plate.length_m / 2, plate.width_m / 2, plate.thickness_m / 2]])
    centroids = mesh.vertices_m[mesh.faces].mean(axis=1)
    nearest = np.linalg.norm(centroids - middle, axis=1).argmin()
    x, y, z = item.pose.to_world(centroids[[nearest]])[0].tolist()
    return x, y, z
