"""Campaigns on a real sound server with a null sink, measured by recordings of its monitor.

python stress/sound_card.py [takes] [low] [latency] [watchdog] [silence] [hitches] [unplug] [--takes 10] [--seconds 30]
    [--cycles 200] [--undisturbed] [--freeze]

takes    : ten times 30 s at the default latency, while another thread updates at 1 kHz and allocates memory.
low      : a take, and times as below, at "low" latency with blocks of 64, 128 and 256 frames.
latency  : time from an update to the first frame at the monitor, for several latencies.
watchdog : the game's thread ends; time until the monitor records exact zeros, against watchdog + fade + latency.
silence  : `stop`, `pause` and muting while the game goes on; time until the monitor records less than -80 dB.
hitches  : a game of 30 frames per second with a hitch of 60 ms every tenth frame, 20 s.
unplug   : the sink is unloaded and loaded again; threads, open files and memory before and after.
Needs: apt-get install --no-install-recommends pulseaudio pulseaudio-utils libportaudio2 libasound2-plugins
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap import HapticSession
from scene2hap.devices.protocol import SinkEvent
from scene2hap.devices.soundcard import SoundCardSink
from sound_server import DEVICE, RATE, SoundServer, missing
from sound_takes import TONES_HZ, TOUCHES, Game, Verdict, judge, session_on, take, undisturbed
from stress.process_use import memory_mb, n_files, n_threads, stolen_s


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", nargs="*", metavar="CAMPAIGN", help="default all")
    parser.add_argument("--takes", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--cycles", type=int, default=200)
    parser.add_argument("--undisturbed", action="store_true", help="run before other programs (needs the right to)")
    parser.add_argument("--freeze", action="store_true", help="gc.freeze() first, as a game may after loading")
    arguments = parser.parse_args()
    if problem := missing():
        sys.exit(problem)
    print(f"Python {platform.python_version()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
    if arguments.freeze:
        gc.freeze()
    with undisturbed() if arguments.undisturbed else nullcontext():
        for name in arguments.campaigns or CAMPAIGNS:
            CAMPAIGNS[name](arguments)
            print(f"(load {os.getloadavg()[0]:.1f}, stolen so far {stolen_s():.0f} s)\n", flush=True)


def takes(arguments: argparse.Namespace) -> None:
    broken = 0
    for number in range(arguments.takes):
        with SoundServer() as server:
            verdict = take(server, arguments.seconds)
        broken += verdict.residual > 1e-3
        show(f"take {number + 1}", verdict)
    print(f"{broken} of {arguments.takes} takes with a discontinuity")


def show(name: str, verdict: Verdict) -> None:
    off_hz = max(abs(f - tone) for f, tone in zip(verdict.frequency_hz, TONES_HZ, strict=True))
    print(
        f"{name}: {verdict.seconds:.1f} s, correlation {min(verdict.correlation):.5f}, tones off by {off_hz:.1e} Hz, "
        f"residual {verdict.residual:.1e}, underruns {verdict.underruns}, load {os.getloadavg()[0]:.1f}",
        flush=True,
    )


def low(arguments: argparse.Namespace) -> None:
    for frames in (64, 128, 256):
        with SoundServer() as server:
            show(f"{frames} frames", take(server, arguments.seconds, latency="low", block_frames=frames))
        with SoundServer() as server:
            times = onsets_s(server, "low", 10, block_frames=frames)
        print(f"  update to monitor median {1e3 * np.median(times):.0f}, largest {1e3 * max(times):.0f} ms")


def onsets_s(server: SoundServer, latency: float | str, n: int, **settings: Any) -> list[float]:
    """Times [s] from the first update with a touch to the first frame at the monitor."""
    found = []
    for _ in range(n):
        sink = SoundCardSink(DEVICE, latency=latency, **settings)
        recorder = server.record(is_timed=True)
        with session_on(sink, watchdog_s=1.0) as session:
            assert sink.wait_connected(10.0)
            session.update()
            time.sleep(0.5 + 0.02 * np.random.default_rng().random())
            begin = time.monotonic()
            while not len(onset := np.flatnonzero(np.abs(recorder.samples).max(axis=1) > 1e-6)):
                session.update(touches=TOUCHES)
                time.sleep(0.05)
            found.append((onset[0] - recorder.frame_at(begin)) / RATE)
        recorder.stop()
    return found


def latency(arguments: argparse.Namespace) -> None:
    for setting in (0.1, 0.05, "high", "low"):
        with SoundServer() as server:
            sink = SoundCardSink(DEVICE, latency=setting)
            with session_on(sink):
                assert sink.wait_connected(10.0)
                reported_s = sink.stats.latency_s
            times = onsets_s(server, setting, 10)
        print(
            f"latency {setting}: stats {1e3 * (reported_s or 0):.0f} ms; update to monitor median "
            f"{1e3 * np.median(times):.0f}, largest {1e3 * max(times):.0f} ms"
        )


def watchdog(arguments: argparse.Namespace) -> None:
    for setting, watchdog_s in ((0.1, 0.1), (0.1, 0.02), ("low", 0.1), ("low", 0.02)):
        with SoundServer() as server:
            longest = max(onsets_s(server, setting, 20))
            times = [time_to_silence_s(server, setting, watchdog_s) for _ in range(10)]
        bound = watchdog_s + 0.01 + longest
        print(
            f"latency {setting}, watchdog {watchdog_s} s: zero after {1e3 * min(times):.0f} to "
            f"{1e3 * max(times):.0f} ms; watchdog + fade + largest of 20 latencies: {1e3 * bound:.0f} ms, "
            f"{'kept' if max(times) <= bound else 'BROKEN'}",
            flush=True,
        )


def silence(arguments: argparse.Namespace) -> None:
    ends: dict[str, Callable[[HapticSession], None]] = {
        "stop": HapticSession.stop,
        "pause": HapticSession.pause,
        "mute": lambda session: session.set_user(mute=True),
    }
    for setting in (0.1, "low"):
        with SoundServer() as server:
            for name, end in ends.items():
                times = [time_to_silence_s(server, setting, 0.1, end) for _ in range(10)]
                print(
                    f"latency {setting}, {name}: silent after {1e3 * min(times):.0f} to {1e3 * max(times):.0f} ms",
                    flush=True,
                )


def time_to_silence_s(
    server: SoundServer, setting: float | str, watchdog_s: float, end: Callable[[HapticSession], None] | None = None
) -> float:
    """Time [s] from the last update of a game whose thread ends to the last frame that is not zero.

    With `end`, from its call to the last frame above -80 dB re full scale: a pause leaves the tail of the DC block.
    """
    sink = SoundCardSink(DEVICE, latency=setting)
    recorder = server.record(is_timed=True)
    with session_on(sink, watchdog_s=watchdog_s) as session:
        assert sink.wait_connected(10.0)
        game = Game(session, lambda _: 0.005)
        game.start()
        time.sleep(0.7 + 0.02 * np.random.default_rng().random())
        if end is None:
            ended = game.kill()
        else:
            ended = time.monotonic()
            end(session)
        last, begin = -1, time.monotonic()
        while last < 0 or recorder.n_heard - last < RATE // 4:
            assert time.monotonic() < begin + 5.0, "the sink still plays after 5 s"
            time.sleep(0.1)
            sounding = np.flatnonzero(np.abs(recorder.samples).max(axis=1) > (0.0 if end is None else 1e-4))
            last = int(sounding[-1]) if len(sounding) else -1
        found = (last + 1 - recorder.frame_at(ended)) / RATE
        game.kill()
    recorder.stop()
    return found


def hitches(arguments: argparse.Namespace) -> None:
    with SoundServer() as server:
        sink = SoundCardSink(DEVICE)
        recorder = server.record()
        with session_on(sink) as session:
            assert sink.wait_connected(10.0)
            game = Game(session, lambda n: 1 / 30 + (0.06 if n % 10 == 0 else 0.0))
            game.start()
            time.sleep(20.0)
            end = recorder.n_heard
            trips = session.safety_stats.watchdog_trips
            game.kill()
        verdict = judge(recorder.stop()[:end])
    print(f"{verdict.seconds:.1f} s at 30 frames per second: watchdog trips {trips}, residual {verdict.residual:.1e}")


def unplug(arguments: argparse.Namespace) -> None:
    events: list[SinkEvent] = []
    with SoundServer() as server:
        threads = threading.active_count()
        sink = SoundCardSink(DEVICE, on_event=events.append)
        with session_on(sink) as session:
            game = Game(session, lambda _: 0.01)
            game.start()
            assert sink.wait_connected(10.0)
            marks = []
            for cycle in range(arguments.cycles):
                server.unplug()
                wait_for(lambda: not sink.stats.connected)
                server.plug_in()
                assert sink.wait_connected(20.0), sink.stats
                time.sleep(0.05)
                if cycle % max(1, arguments.cycles // 10) == 0 or cycle == arguments.cycles - 1:
                    marks.append((cycle + 1, n_threads(), n_files(), memory_mb()))
                    print("cycle {}: {} threads, {} files, {:.1f} MB".format(*marks[-1]), flush=True)
            game.kill()
        print(f"events {dict(Counter(event.kind for event in events))}; {sink.stats}")
        print(f"Python threads before and after: {threads}, {threading.active_count()}")


def wait_for(is_so: Callable[[], object], timeout_s: float = 20.0) -> None:
    deadline = time.monotonic() + timeout_s
    while not is_so():
        assert time.monotonic() < deadline, "nothing happened"
        time.sleep(0.005)


CAMPAIGNS = {
    "takes": takes,
    "low": low,
    "latency": latency,
    "watchdog": watchdog,
    "silence": silence,
    "hitches": hitches,
    "unplug": unplug,
}

if __name__ == "__main__":
    main()
