"""Play a bundle in the terminal: arrow keys move a hand over a plan of the scene, and meters show the gain of sources.

The folder is watched: edits, here or by `scene2hap edit`, are felt within a second.

Keys: arrows move the hand, space lifts and lowers it, + and - change the level, q ends.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import time
from typing import Any

from rich.live import Live
from rich.text import Text

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.cli.keys import DOWN, LEFT, RIGHT, UP, keys
from scene2hap.cli.plan import Plan
from scene2hap.cli.shared_options import add_session_arguments, session_config
from scene2hap.cli.sink_output import UPDATE_S, SinkOutput, silence
from scene2hap.devices import SINKS
from scene2hap.errors import ConfigError
from scene2hap.session import HapticFrame, HapticSession, Touch
from scene2hap.session.bundle_watch import BundleWatch

HAND = "right"
_STEP_DB = 3.0
_METER = 30
_LEAST = 8
_MOVES = {UP: (-1, 0), DOWN: (1, 0), RIGHT: (0, 1), LEFT: (0, -1)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap play``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote")
    parser.add_argument("--sink", default="soundcard", help="where to play: a kind, or JSON with one (soundcard)")
    parser.add_argument("--mute", action="append", default=[], metavar="ID", help="silence a source; may be repeated")
    parser.add_argument(
        "--solo", action="append", default=[], metavar="ID", help="play this source and no others; may be repeated"
    )
    add_session_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Play until the key q."""
    if not sys.stdin.isatty():
        raise ConfigError("scene2hap play needs a terminal for its keys. Use `scene2hap render` for a file of touches.")
    bundle = HapticBundle.load(arguments.bundle)
    config = session_config(arguments.settings, bundle)
    sink = SINKS.build(given_spec("--sink", arguments.sink))
    output = SinkOutput(sink)
    width, height = shutil.get_terminal_size()
    # Besides the plan, the screen has a line for each source, one for the hand, one for the actuator, and a free one.
    player = Player(bundle, n_columns=max(_LEAST, width - 1), n_rows=max(_LEAST, height - len(bundle.loops) - 3))
    with (
        HapticSession(bundle, config=config, hands=(HAND,), sink=output.sink, user=arguments.profile) as session,
        BundleWatch(session, arguments.bundle) as watch,
        keys() as pressed,
        Live(refresh_per_second=20, screen=True) as screen,
    ):
        silence(session, arguments.mute, arguments.solo)
        while player.press(pressed()):
            watch.update()
            session.set_user(gain_db=player.gain_db)
            frame = session.update(touches=player.touches())
            output.take(config.sample_rate_hz)
            screen.update(player.view(frame, output.problem, watch.problem))
            time.sleep(UPDATE_S)
    if not output.has_played:
        console.warn(f"nothing was played: {output.why_nothing_played} Connect the actuator, or give another --sink.")
    return {"bundle": arguments.bundle, "ended_on": player.on, "played": output.has_played}


class Player:
    """Position of the hand, and the text on the screen."""

    def __init__(self, bundle: HapticBundle, n_columns: int = 64, n_rows: int = 22) -> None:
        self.plan: Plan = Plan.of(bundle.snapshot, n_columns, n_rows)
        self._sources = frozenset(bundle.loops)
        self._hand = self._on_a_source()
        self._is_down = True
        self.gain_db: float = 0.0

    def _on_a_source(self) -> tuple[int, int]:
        items = self.plan.scene.objects
        for row, column in zip(*(self.plan.top >= 0).nonzero(), strict=True):
            if items[self.plan.top[row, column]].id in self._sources:
                return int(row), int(column)
        return 0, 0

    @property
    def on(self) -> str:
        """The id of the object under the hand, "" for none."""
        found = self.plan.touched(*self._hand)
        return found[0] if found else ""

    def press(self, key: str) -> bool:
        """Process a key. Returns False if it ends the command."""
        if key in _MOVES:
            n_rows, n_columns = self.plan.top.shape
            down, right = _MOVES[key]
            row, column = self._hand
            self._hand = (min(max(row + down, 0), n_rows - 1), min(max(column + right, 0), n_columns - 1))
        elif key == " ":
            self._is_down = not self._is_down
        elif key in ("+", "-"):
            self.gain_db += _STEP_DB if key == "+" else -_STEP_DB
        return key != "q"

    def touches(self) -> list[Touch]:
        """Return the present touch of the hand, if any."""
        found = self.plan.touched(*self._hand) if self._is_down else None
        return [Touch(HAND, *found)] if found else []

    def view(self, frame: HapticFrame, problem: str = "", watch_problem: str = "") -> Text:
        """Return plan, touched object, a meter per source, and problems of the actuator or of an edit."""
        state = self.on or "nothing" if self._is_down else "lifted"
        lines = [f"hand on: {state}    level {self.gain_db:+g} dB    arrows, space, + -, q"]
        warning = f"NOT PLAYED: {problem}" if problem else ""
        lines.append(warning or (f"edit not loaded: {watch_problem}" if watch_problem else ""))
        for source_id in frame.sources:
            gain = min(frame.gain(HAND, source_id), 1.0)
            lines.append(f"{source_id:<28.28} {'#' * round(_METER * gain):<{_METER}} {gain:5.3f}")
        return Text("\n".join(lines + self.plan.lines(self._sources, self._hand)), no_wrap=True)
