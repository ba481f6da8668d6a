"""Bake the built-in kitchen and play a recorded tour of it with both hands.

Writes three results below the current folder (scene2hap-demo/, or -o): the bundle, tour.wav (left, right) and tour.png,
a picture of the vibration at each hand over time.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from scene2hap.baking import bake
from scene2hap.bundle.folder_replacement import require_replaceable
from scene2hap.cli.console import Console
from scene2hap.cli.picture import draw_envelopes
from scene2hap.cli.render import render_track
from scene2hap.cli.tables import bundle_outcome, show_bundle
from scene2hap.demo import kitchen_path, tour_path
from scene2hap.scene.load import load_scene
from scene2hap.session import SessionConfig
from scene2hap.session.touch_track import TouchTrack
from scene2hap.session.track_player import PlayedFrame

_FELT_FLOOR_DB = -60.0
_STAY_S = 0.15


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap demo``."""
    parser.add_argument("-o", "--output", metavar="FOLDER", default="scene2hap-demo", help="default: scene2hap-demo")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Bake, play, draw, and show the vibration at each hand."""
    folder = Path(arguments.output)
    require_replaceable(folder / "bundle")
    with console.progress() as tell:
        bundle = bake(load_scene(kitchen_path()), progress=tell)
    bundle.save(folder / "bundle")
    track = TouchTrack.load(tour_path())
    wav, picture = folder / "tour.wav", folder / "tour.png"
    frames = render_track(console, bundle, track, str(wav), SessionConfig(), update_rate_hz=100.0)
    draw_envelopes(frames, ("left", "right"), SessionConfig().sample_rate_hz, picture)
    felt = what_was_felt(frames)
    show_bundle(console, bundle)
    console.table(
        "What each hand felt, dB re touching the source itself",
        (">from s", ">to s", "hand", "on", "felt"),
        (
            (f"{row['from_s']:.1f}", f"{row['to_s']:.1f}", row["hand"], row["on"], _in_words(row["felt_db"]))
            for row in felt
        ),
    )
    for path in (folder / "bundle", wav, picture):
        console.say(f"wrote {path}")
    return {
        "bundle": str(folder / "bundle"),
        "wav": str(wav),
        "picture": str(picture),
        **bundle_outcome(bundle),
        "felt": felt,
    }


def what_was_felt(frames: list[PlayedFrame]) -> list[dict[str, Any]]:
    """Return each stay of a hand as a row: time, touched object, and the sources felt there above -60 dB [dB].

    A stay is a period of at least `_STAY_S` with constant gains. While a hand moves, its gains change in each frame.
    """
    rows: list[dict[str, Any]] = []
    for hand in frames[0].frame.hands:
        stays: list[dict[str, Any]] = []
        for played in frames:
            on = next((touch.object_id for touch in played.touches if touch.hand == hand), None)
            felt = {"on": on, "felt_db": _felt_db(played, hand)}
            if stays and stays[-1].items() >= felt.items():
                stays[-1]["to_s"] = played.time_s
            else:
                stays.append({"from_s": played.time_s, "to_s": played.time_s, "hand": hand, **felt})
        rows += [stay for stay in stays if stay["on"] is not None and stay["to_s"] - stay["from_s"] >= _STAY_S]
    return sorted(rows, key=lambda row: (row["from_s"], row["hand"]))


def _felt_db(played: PlayedFrame, hand: str) -> dict[str, float]:
    gains = {source: played.frame.gain(hand, source) for source in played.frame.sources}
    levels = {source: 20 * math.log10(gain) for source, gain in gains.items() if gain > 0}
    loud = {source: round(level, 1) for source, level in levels.items() if level > _FELT_FLOOR_DB}
    return dict(sorted(loud.items(), key=lambda item: -item[1]))


def _in_words(felt_db: dict[str, float]) -> str:
    return ", ".join(f"{source} {level:+.0f}" for source, level in felt_db.items()) or "nothing"
