"""A long session in which moves, touches, added and removed objects, states, levels and pauses are random.

OMP_NUM_THREADS=1 python stress/session.py [--minutes 10] [--kind exponential_plate] [--edges]

The game runs at 1 kHz in simulated time, as fast as possible. At the end the command prints a report, and fails unless

    no exception was raised, and every sample was finite and within full scale;
    memory did not grow after the first fifth by more than the noise of the allocator;
    each loop is within one sample of the clock, by `position_s` and by the phase of a rendered tone.

With --edges every scene of tests/support/edge_scenes.py is run instead, and loops are not checked.
"""

from __future__ import annotations

import argparse
import gc
import random
import sys
import time
import tracemalloc
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from edge_scenes import EDGE_SCENES, Bundled
from scene2hap import HapticSession, Pose, Touch
from scene2hap.propagation.domain import ThinPlateWarning
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop
from stress.process_use import memory_mb

UPDATES_PER_S = 1000
FRAMES_PER_UPDATE = RATE // UPDATES_PER_S
RENDER_EVERY = 8
VISITORS = [f"visitor {i}" for i in range(6)]
MOST_GROWN = 8 * 2**20
"""Largest growth of the process that counts as noise of the allocator [byte]."""
TONE_HZ = {"phone": 100, "alarm": 160}


@dataclass
class Life:
    """A session on the table with two phones, and its random events."""

    session: HapticSession
    random: random.Random
    movers: tuple[str, ...] = ("phone", "alarm")
    there: set[str] = field(default_factory=set)
    touches: list[Touch] = field(default_factory=list)
    is_paused: bool = False
    n_events: int = 0

    def update(self) -> None:
        moved = {}
        if self.random.random() < 0.02:
            self.n_events += 1
            event = self.random.choice((self._visit, self._switch, self._pause, self._hand, self._touch, self._touch))
            event()
        if self.random.random() < 0.02:
            name = self.random.choice([*self.movers, *self.there])
            lift = self.random.choice((0.0, 0.0, 0.5))
            moved[name] = Pose((self.random.uniform(0.1, 1.5), 0.725 + lift, self.random.uniform(0.1, 0.7)))
        self.session.update(moved, self.touches)

    def _touch(self) -> None:
        objects = [item.id for item in self.session.snapshot.objects]
        self.touches = [
            Touch(hand, self.random.choice(objects), (self.random.uniform(0.0, 1.6), 0.72, 0.4))
            for hand in self.session.hands
            if self.random.random() < 0.7
        ]

    def _visit(self) -> None:
        name = self.random.choice(VISITORS)
        if name in self.there:
            self.session.remove(name)
            self.there.remove(name)
            self.touches = [touch for touch in self.touches if touch.object_id != name]
        else:
            at = (self.random.uniform(0.2, 1.4), 0.77, self.random.uniform(0.1, 0.7))
            loops = {"on": tone_loop(self.random.randrange(40, 400, 2))} if self.random.random() < 0.7 else None
            states = ("on",) if loops else ()
            self.session.add(box(name, (0.1, 0.1, 0.1), at), haptics("plastic", (0.1, 0.1, 0.1), *states), loops)
            self.there.add(name)

    def _switch(self) -> None:
        if not self.session.source_ids:
            return
        self.session.set_source(
            self.random.choice(self.session.source_ids),
            on=self.random.random() < 0.8,
            gain_db=self.random.uniform(-20.0, 6.0),
            mute=self.random.random() < 0.1,
        )
        if self.movers == ("phone", "alarm"):
            self.session.set_source("phone", state=self.random.choice(("ringing", "alarm")))

    def _pause(self) -> None:
        if self.is_paused:
            self.session.resume()
        elif self.random.random() < 0.3:
            self.session.pause()
        else:
            return
        self.is_paused = not self.is_paused

    def _hand(self) -> None:
        if "foot" in self.session.hands:
            self.session.remove_hand("foot")
            self.touches = [touch for touch in self.touches if touch.hand != "foot"]
        elif self.random.random() < 0.2:
            self.session.add_hand("foot")


@dataclass(frozen=True)
class Outcome:
    """Result of a run: growth of memory [byte] after its first fifth, loop error [samples], events."""

    grown_bytes: int
    drift_samples: float
    n_events: int
    seconds: float
    worst_level: float


def live(minutes: float, kind: str = "exponential_plate", seed: int = 1, bundled: Bundled | None = None) -> Outcome:
    """Run a session of that simulated length; `bundled` None: the table with two phones. Errors are not caught."""
    begin = time.perf_counter()
    scene, bundle = bundled or table_with_two_phones()
    session = HapticSession(scene, bundle, {"sample_rate_hz": RATE, "propagation": kind})
    life = Life(session, random.Random(seed))
    if bundled is not None:
        life.movers = tuple(item.id for item in scene.objects[-2:])
    n, worst, base = round(60 * minutes * UPDATES_PER_S), 0.0, 0
    for i in range(n):
        life.update()
        if i % RENDER_EVERY == RENDER_EVERY - 1:
            out = session.render(RENDER_EVERY * FRAMES_PER_UPDATE)
            level = float(np.abs(out).max())
            if not level <= 1.0:
                raise AssertionError(f"a sample of {level} after {i} updates")
            worst = max(worst, level)
        if i == n // 5:
            base = held_bytes()
    grown = held_bytes() - base
    return Outcome(
        grown, drift_samples(life) if bundled is None else 0.0, life.n_events, time.perf_counter() - begin, worst
    )


def held_bytes() -> int:
    """Memory of Python and numpy [byte] if tracemalloc is tracing, else of the whole process."""
    gc.collect()
    if tracemalloc.is_tracing():
        return tracemalloc.get_traced_memory()[0]
    return round(memory_mb() * 1e6)


def drift_samples(life: Life) -> float:
    """Distance of the alarm's loop from the clock [samples], by position_s or by rendered phase, the larger one."""
    session = life.session
    session.resume()
    for name in list(life.there):
        session.remove(name)
    session.set_source("phone", on=False)
    session.set_source("alarm", on=True, gain_db=0.0, mute=False)
    session.update({"phone": Pose((9.0, 9.0, 9.0))}, [Touch(session.hands[0], "alarm", (0.0, 0.0, 0.0))])
    session.wait_prepared(60.0)
    session.render(RATE)
    reported = session.position_s("alarm") * RATE - session.position % (RATE // 2)
    begin = session.position
    out = session.render(RATE)[:, 0].astype(np.float64)
    cycles = TONE_HZ["alarm"] * (begin + np.arange(RATE)) / RATE
    # A sine in step with the clock has the phase 0; there is no delay, since both sample rates are equal here.
    phase = np.angle(1j * (out * np.exp(-2j * np.pi * cycles)).sum())
    rendered = phase / (2 * np.pi) * RATE / TONE_HZ["alarm"]
    return float(max(abs(reported), abs(rendered)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0, help="simulated time (10)")
    parser.add_argument("--kind", default="exponential_plate", help="propagation model")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--edges", action="store_true", help="edge scenes, empty or nearly empty")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    lives = [(name, made()) for name, made in EDGE_SCENES.items()] if arguments.edges else [("two phones", None)]
    return max(report(name, bundled, arguments) for name, bundled in lives)


def report(name: str, bundled: Bundled | None, arguments: argparse.Namespace) -> int:
    """Run a session on a scene, and print the result. Returns 0 on success."""
    found = live(arguments.minutes, arguments.kind, arguments.seed, bundled)
    passed = found.grown_bytes < MOST_GROWN and found.drift_samples <= 1.0
    verdict = "passed" if passed else "FAILED"
    print(
        f"{name}, {arguments.kind}, {arguments.minutes:g} minutes at {UPDATES_PER_S} Hz in {found.seconds:.0f} s: "
        f"{found.n_events} events; memory grew by {found.grown_bytes / 1024:.0f} KiB; loops off by "
        f"{found.drift_samples:.3f} samples; loudest sample {found.worst_level:.3f}: {verdict}"
    )
    return 0 if passed else 1


if __name__ == "__main__":
    raise SystemExit(main())
