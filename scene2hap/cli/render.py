"""Play a file of touches on a bundle, and write a WAV file with one channel per hand.

docs/touches.md describes the file. A settings file (TOML or JSON) with a table [session] chooses another propagation
model or other bands.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.cli.shared_options import add_session_arguments, session_config
from scene2hap.devices.wav import WavSink
from scene2hap.session import HapticSession, SessionConfig, UserProfile
from scene2hap.session.touch_track import TouchTrack
from scene2hap.session.track_player import PlayedFrame, play_track


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap render``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that `bake` wrote")
    parser.add_argument("--touches", metavar="FILE", required=True, help="touches and moves over time, JSON or CSV")
    parser.add_argument("-o", "--output", metavar="WAV", required=True, help="file to write")
    parser.add_argument("--propagation", metavar="KIND", help="exponential_plate (default), no_propagation, ...")
    parser.add_argument("--update-rate-hz", metavar="HZ", type=float, default=100.0, help="updates per second (100)")
    add_session_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Render, and show the peak level of each hand."""
    track = TouchTrack.load(arguments.touches)
    bundle = HapticBundle.load(arguments.bundle)
    changes = {"propagation": arguments.propagation} if arguments.propagation else {}
    config = session_config(arguments.settings, bundle, **changes)
    user = UserProfile.parse(arguments.profile)
    frames = render_track(console, bundle, track, arguments.output, config, arguments.update_rate_hz, user)
    highest = np.max([np.abs(frame.samples).max(axis=0) for frame in frames if len(frame.samples)], axis=0)
    peaks = {hand: float(highest[i]) for i, hand in enumerate(("left", "right"))}
    console.table(
        arguments.output,
        ("hand", ">peak, 1 is full scale"),
        ((hand, f"{peak:.3f}") for hand, peak in peaks.items()),
    )
    console.say(f"wrote {arguments.output}")
    return {"wav": arguments.output, "duration_s": track.duration_s, "peaks": peaks}


def render_track(
    console: Console,
    bundle: HapticBundle,
    track: TouchTrack,
    path: str,
    config: SessionConfig,
    update_rate_hz: float,
    user: UserProfile | None = None,
) -> list[PlayedFrame]:
    """Play a track on a bundle into a WAV file, with a progress bar. Returns the frames.

    The session waits for the propagation model, so that the file does not depend on the speed of a worker.
    """
    config = SessionConfig.parse(config, prepare="blocking")
    frames: list[PlayedFrame] = []
    sink = WavSink(path)
    with console.progress() as tell, HapticSession(bundle, config=config, sink=sink, user=user) as session:

        def on_frame(frame: PlayedFrame) -> None:
            frames.append(frame)
            tell("rendering", f"{frame.time_s:.1f} s", round(frame.time_s * 10), round(track.duration_s * 10))

        with sink.whole_or_none():
            play_track(session, track, sink, update_rate_hz=update_rate_hz, on_frame=on_frame)
    return frames
