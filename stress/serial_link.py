"""Campaigns on the serial link: samples, damaged data, random bytes, unplugging, and time on the caller's thread.

python stress/serial_link.py [exact] [damage] [random] [unplug] [caller] [--seconds 300] [--frames 1000000]
    [--cycles 200] [--buffer 0.02] [--seed 0]

exact : 2 x 16 bit x 4 kHz over a pseudo-terminal to the reference device; every sample is compared.
damage : frames of 32 bytes of samples, 1 % of all bytes flipped, dropped or doubled; no bad frame may be accepted, and
    the frames lost after each damaged one are counted.
random : the same number of random bytes to each decoder.
unplug : the device is unplugged and plugged in again; threads, files and memory before and after.
caller : time of calls on the game's thread while the device plays, grants no credit, or is missing.
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap.devices.framing import cobs
from scene2hap.devices.framing.frames import Frame, FrameParser, from_datagram, pcm, to_wire
from scene2hap.devices.protocol import Block, SinkFormat
from scene2hap.devices.reference_device import ReferenceDevice
from scene2hap.devices.serial_amp import SerialAmplifierSink
from serial_bench import Plug, eventually
from stress.process_use import memory_mb, n_files
from wire_damage import damaged

FORMAT = SinkFormat(4000, ("left", "right"))
CAMPAIGNS = ("exact", "damage", "random", "unplug", "caller")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", nargs="*", metavar="CAMPAIGN", help="; ".join(CAMPAIGNS) + "; default all")
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("--frames", type=int, default=1_000_000)
    parser.add_argument("--cycles", type=int, default=200)
    parser.add_argument("--buffer", type=float, default=0.02, metavar="S", help="what the sink keeps queued")
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    if unknown := set(chosen.campaigns) - set(CAMPAIGNS):
        parser.error(f"no campaign {', '.join(sorted(unknown))}; choose from {', '.join(CAMPAIGNS)}")
    load = "load {:.1f} {:.1f} {:.1f}".format(*os.getloadavg())
    print(
        f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, {load}, seed {chosen.seed}"
    )
    runs = {
        "exact": lambda: exact(chosen.seconds, chosen.buffer),
        "damage": lambda: damage(chosen.frames, chosen.seed),
        "random": lambda: random_bytes(chosen.frames, chosen.seed),
        "unplug": lambda: unplug(chosen.cycles),
        "caller": caller,
    }
    good = True
    for name in chosen.campaigns or CAMPAIGNS:
        began = time.perf_counter()
        passed, result = runs[name]()
        good &= passed
        print(f"{name:<8}{'holds' if passed else 'FAILS':<7}{result} ({time.perf_counter() - began:.0f} s)", flush=True)
    return 0 if good else 1


class Noise:
    """Noise whose samples can be computed from their position."""

    _LENGTH = 1_000_003

    def __init__(self) -> None:
        self._table = np.random.default_rng(7).integers(-32767, 32768, (self._LENGTH, 2)).astype(np.int16)
        self._position = 0

    def at(self, position: int, n_frames: int) -> np.ndarray:
        return self._table[np.arange(position, position + n_frames) % self._LENGTH]

    def __call__(self, n_frames: int) -> Block:
        block = self.at(self._position, n_frames)
        self._position += n_frames
        return (block / np.float32(32767)).astype(np.float32)


def exact(seconds: float, buffer_s: float) -> tuple[bool, str]:
    noise = Noise()
    wrong = compared = skipped = 0

    def check(block: np.ndarray) -> None:
        nonlocal wrong, compared, skipped
        if not compared:
            skipped = sink.stats.dropped_frames  # during the handshake
        begin, compared = compared, compared + len(block)
        wanted = noise.at(skipped + begin, len(block))
        wrong += int((block != wanted)[max(0, 200 - begin) :].sum())  # 200 samples are faded in

    with tempfile.TemporaryDirectory() as folder, Plug(Path(folder), lambda: ReferenceDevice(on_samples=check)) as plug:
        events: list[str] = []
        sink = SerialAmplifierSink(
            str(plug.path), buffer_s=buffer_s, on_event=lambda event: events.append(f"{event.kind}: {event.message}")
        )
        sink.open(FORMAT)
        sink.start(noise)
        began = time.monotonic()
        eventually(lambda: sink.stats.frames >= seconds * 4000, within_s=2 * seconds)
        took = time.monotonic() - began
        stats = sink.stats
        sink.close()
        eventually(lambda: plug.device.muted)
        lost = plug.device.lost + plug.device.refused + plug.device.damaged + stats.dropped_frames - skipped
    result = (
        f"{compared} frames in {took:.0f} s, {wrong} wrong samples, {lost} lost, {stats.underruns} underruns, "
        f"latency {1e3 * (stats.latency_s or 0):.0f} ms at the end{'; '.join(['', *events[1:]])}"
    )
    return wrong == lost == 0 and compared >= seconds * 4000, result


def damage(n_frames: int, seed: int) -> tuple[bool, str]:
    rng = np.random.default_rng(seed)
    parser = FrameParser()
    recent: list[Frame] = []
    bad = accepted = touched_frames = missed = 0
    out_of_step: Counter[int] = Counter()
    waiting = 0
    for begin in range(0, n_frames, 10_000):
        blocks = rng.uniform(-1, 1, (min(10_000, n_frames - begin), 8, 2)).astype(np.float32)
        frames = [pcm(block, sequence=(begin + k) % 2**16) for k, block in enumerate(blocks)]
        for frame, (data, touched) in zip(frames, damaged(map(to_wire, frames), 0.01, rng), strict=True):
            recent = [*recent[-3:], frame]
            found = list(parser.feed(data))
            bad += sum(one not in recent for one in found)
            accepted += len(found)
            touched_frames += touched
            if touched:
                waiting = 0
            elif frame in found:
                out_of_step[waiting] += 1
                waiting = 0
            else:
                waiting += 1
                missed += 1
    result = (
        f"{n_frames} frames of {len(data)} bytes, {touched_frames} damaged, {accepted} accepted, {bad} bad ones; whole "
        f"frames lost after a damaged one: {missed}, longest run {max(out_of_step, default=0)}"
    )
    return bad == 0 and max(out_of_step, default=9) <= 2, result


def random_bytes(n_bytes: int, seed: int) -> tuple[bool, str]:
    rng = np.random.default_rng(seed)
    data = rng.bytes(n_bytes)
    parser, device = FrameParser(), ReferenceDevice()
    found = 0
    for start in range(0, n_bytes, 97):
        piece = data[start : start + 97]
        found += len(list(parser.feed(piece)))
        found += cobs.decode(piece) is not None and from_datagram(cobs.decode(piece) or b"") is not None
        device.receive(piece, start * 1e-5)
        device.advance(start * 1e-5)
        device.to_send()
    return found == 0, f"{n_bytes} bytes to three decoders: no exception, {found} accepted"


def _held() -> tuple[int, int, float]:
    gc.collect()
    return threading.active_count(), n_files(), memory_mb()


def unplug(cycles: int) -> tuple[bool, str]:
    with tempfile.TemporaryDirectory() as folder:
        plug = Plug(Path(folder))
        events: Counter[str] = Counter()
        sink = SerialAmplifierSink(str(plug.path), on_event=lambda event: events.update([event.kind]))
        before = _held()
        sink.open(FORMAT)
        sink.start(Noise())
        back = []
        warm = before
        for cycle in range(cycles):
            plug.put_in()
            began = time.monotonic()
            if not eventually(lambda: plug.device.accepted_frames > 0):
                break
            back.append(time.monotonic() - began)
            plug.pull_out()
            eventually(lambda: not sink.stats.connected)
            if cycle == 9:
                warm = _held()
        during = _held()
        sink.close()
        after = _held()
    passed = len(back) == cycles and after[:2] == before[:2] and during[:2] == warm[:2] and after[2] - warm[2] < 5
    result = (
        f"{cycles} cycles, {sink.stats.reconnects} reconnects, back after {1e3 * float(np.median(back)):.0f} ms "
        f"(median; longest {1e3 * max(back):.0f}); threads {before[0]} to {after[0]}, files {before[1]} to {after[1]}, "
        f"memory {warm[2]:.1f} to {after[2]:.1f} MB from the tenth cycle on; {dict(events)}"
    )
    return passed, result


def caller() -> tuple[bool, str]:
    parts = []
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        plug = Plug(Path(folder))
        sink = SerialAmplifierSink(str(plug.path))
        sink.open(FORMAT)
        opened = _longest(lambda: sink.open(FORMAT))
        sink.start(Noise())
        parts.append(f"open {opened}")
        plug.put_in()
        eventually(lambda: plug.device.accepted_frames > 400)
        changes: dict[str, Callable[[], object]] = {
            "playing": lambda: None,
            "no credit": lambda: setattr(plug.device, "grants_credit", False),
            "unplugged": plug.pull_out,
        }
        for name, change in changes.items():
            change()
            times = _times(lambda: sink.stats)
            idle = _times(lambda: None)
            worst = max(worst, float(np.percentile(times, 99.9)))
            parts.append(
                f"{name}: stats median {1e3 * np.median(times):.3f}, p99.9 {1e3 * np.percentile(times, 99.9):.3f}, "
                f"longest {1e3 * times.max():.2f} ms (nothing at all: longest {1e3 * idle.max():.2f})"
            )
        began = time.perf_counter()
        sink.close()
        parts.append(f"stop {1e3 * (time.perf_counter() - began):.1f} ms")
    return worst < 1e-3, "; ".join(parts)


def _times(call: Callable[[], object], seconds: float = 1.0) -> np.ndarray:
    """Times [s] of calls, one call a millisecond."""
    taken = []
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        began = time.perf_counter()
        call()
        taken.append(time.perf_counter() - began)
        time.sleep(0.001)
    return np.array(taken)


def _longest(call: Callable[[], object], times: int = 20) -> str:
    taken = []
    for _ in range(times):
        began = time.perf_counter()
        call()
        taken.append(time.perf_counter() - began)
    return f"longest {1e3 * max(taken):.3f} ms"


if __name__ == "__main__":
    raise SystemExit(main())
