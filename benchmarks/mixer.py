"""Time and allocations of a block of the mix while a game updates; docs/figures/mixing.md holds the latest.

OMP_NUM_THREADS=1 python benchmarks/mixer.py [--seconds 20] [--switch-interval-ms 5]

16 sources of 5 s are mixed in 20 bands for two hands, in blocks of 128 frames at 48 kHz. Each block is rendered when it
is due, as for a sound card. Another thread sets new gains for every source, band and hand at 1 kHz. Each update holds
Python's interpreter lock for the given time (a busy loop, the worst case of a game in Python).

"render" is the time inside `render_into`. "processor" is the thread's processor time inside it. "from due" also
includes the operating system's wake-up and the wait for the interpreter lock, which no mixer can shorten.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import threading
import time
import tracemalloc
from importlib.metadata import version

import numpy as np
from numpy.typing import NDArray

from scene2hap import AudioClip, Bands
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer

SEED = 5
N_SOURCES, LOOP_S, N_HANDS, N_FRAMES, RATE_HZ, TACTILE_HZ = 16, 5.0, 2, 128, 48000, 8000
BLOCK_S = N_FRAMES / RATE_HZ
UPDATE_S = 0.001


def some_clips() -> list[AudioClip]:
    rng = np.random.default_rng(SEED)
    n = round(LOOP_S * 44100)
    # No two loops have the same length, as in practice.
    return [AudioClip(rng.uniform(-0.05, 0.05, n - 37 * i).astype(np.float32), 44100) for i in range(N_SOURCES)]


def new_mixer(bank: LoopBank) -> Mixer:
    return Mixer(bank, N_HANDS, sample_rate_hz=RATE_HZ, ramp_s=0.01)


def some_gains(bank: LoopBank) -> list[NDArray[np.float32]]:
    rng = np.random.default_rng(SEED)
    return [rng.uniform(0.01, 0.1, (N_HANDS, N_SOURCES, bank.n_bands)).astype(np.float32) for _ in range(16)]


class Game(threading.Thread):
    """Thread that sets gains every `period_s` and keeps busy for `update_s` each time."""

    def __init__(self, mixer: Mixer, gains: list[NDArray[np.float32]], period_s: float, update_s: float) -> None:
        super().__init__()
        self._mixer, self._gains, self._period_s, self._update_s = mixer, gains, period_s, update_s
        self.done = False
        self.n_updates = 0

    def run(self) -> None:
        due = time.perf_counter()
        while not self.done:
            begin = time.perf_counter()
            gains = self._gains[self.n_updates % len(self._gains)]
            self._mixer.set_gains(gains, range(N_SOURCES), self._mixer.position)
            while time.perf_counter() - begin < self._update_s:
                pass
            self.n_updates += 1
            due = max(due + self._period_s, time.perf_counter() - self._period_s)
            time.sleep(max(0.0, due - time.perf_counter()))


def times(bank: LoopBank, seconds: float, update_s: float | None) -> tuple[NDArray[np.float64], float]:
    """Render, processor and from-due times (3, n_blocks) [s], and updates per second; None: gains are set once."""
    mixer, gains = new_mixer(bank), some_gains(bank)
    mixer.set_gains(gains[0], range(N_SOURCES), 0)
    out = np.zeros((N_FRAMES, N_HANDS), dtype=np.float32)
    for _ in range(50):
        mixer.render_into(out)
    game = Game(mixer, gains, UPDATE_S, update_s or 0.0)
    if update_s is not None:
        game.start()
    found = np.zeros((3, round(seconds / BLOCK_S)))
    start = time.perf_counter()
    for i in range(found.shape[1]):
        due = start + i * BLOCK_S
        while (left := due - time.perf_counter()) > 0:
            time.sleep(left)
        begin, begin_cpu = time.perf_counter(), time.thread_time()
        mixer.render_into(out)
        cpu, end = time.thread_time() - begin_cpu, time.perf_counter()
        found[:, i] = end - begin, cpu, end - due
        if end - due > 10 * BLOCK_S:
            # The operating system stopped the thread; a sound card would have dropped these blocks too.
            start = end - (i + 1) * BLOCK_S
    game.done = True
    if update_s is not None:
        game.join()
    return found, game.n_updates / (time.perf_counter() - start)


def allocation(bank: LoopBank, n_blocks: int) -> tuple[int, int]:
    """Largest transient allocation of a block rendered into a given buffer, and growth over n_blocks [byte]."""
    mixer, gains = new_mixer(bank), some_gains(bank)
    out = np.zeros((N_FRAMES, N_HANDS), dtype=np.float32)
    worst = held = 0
    tracemalloc.start()
    for i in range(2 * n_blocks):
        for k in range(3):
            mixer.set_gains(gains[(i + k) % len(gains)], range(N_SOURCES), mixer.position + 48 * k)
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        mixer.render_into(out)
        worst = max(worst, tracemalloc.get_traced_memory()[1] - before)
        if i == n_blocks:
            held = tracemalloc.get_traced_memory()[0]
    left = tracemalloc.get_traced_memory()[0] - held
    tracemalloc.stop()
    return worst, left


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--switch-interval-ms", type=float, default=5.0, help="sys.setswitchinterval")
    arguments = parser.parse_args()
    sys.setswitchinterval(arguments.switch_interval_ms / 1000)
    print(f"Python {platform.python_version()}, numpy {version('numpy')}, scipy {version('scipy')}, ", end="")
    print(f"{platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, seed {SEED}")
    new_mixer(LoopBank([], Bands.third_octaves(), TACTILE_HZ))  # imports are not counted
    clips = some_clips()
    tracemalloc.start()
    bank = LoopBank(clips, Bands.third_octaves(), TACTILE_HZ)
    kept = tracemalloc.get_traced_memory()[0]
    mixer = new_mixer(bank)
    both, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    del mixer
    print(f"loops {bank.nbytes / 2**20:.1f} MiB, mixer {(both - kept) / 2**20:.2f} MiB, most while loading ", end="")
    print(f"{peak / 2**20:.1f} MiB; delay {1000 * new_mixer(bank).delay_s:.3f} ms")
    worst, left = allocation(bank, 1000)
    print(f"transient allocation of a block at most {worst} bytes; left after 1000 more blocks {left} bytes")
    print(f"\na tenth of a block: {1e6 * BLOCK_S / 10:.0f} us; {arguments.seconds:g} s each; microseconds\n")
    print(
        "| update | updates/s | render p50, p99, worst | processor p50, p99 | from due p50, p99 |\n" + "|---" * 5 + "|"
    )
    for update_s in (None, 0.0, 300e-6, 600e-6, 900e-6):
        found, rate = times(bank, arguments.seconds, update_s)
        p50, p99 = 1e6 * np.percentile(found, [50, 99], axis=1)
        name = "none" if update_s is None else f"{1e6 * update_s:.0f} us"
        print(f"| {name} | {rate:.0f} | {p50[0]:.0f}, {p99[0]:.0f}, {1e6 * found[0].max():.0f} ", end="")
        print(f"| {p50[1]:.0f}, {p99[1]:.0f} | {p50[2]:.0f}, {p99[2]:.0f} |")


if __name__ == "__main__":
    main()
