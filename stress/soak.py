"""Play for an hour on a real sound server with a null sink, and compare every recorded frame with the mix.

    python stress/soak.py [--minutes 60] [--undisturbed] [--freeze]

A game thread updates at 1 kHz and allocates garbage, at the default latency. Each recorded period must equal the safe
mix. If a period differs, missing and surplus frames are counted for both hands together, so that a drift between the
hands is detected too.
Needs: apt-get install --no-install-recommends pulseaudio pulseaudio-utils libportaudio2 libasound2-plugins
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import sys
import time
from contextlib import nullcontext
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap.devices.soundcard import SoundCardSink
from sound_server import DEVICE, RATE, SoundServer, missing
from sound_takes import PERIOD, SETTLING, Game, safe_period, session_on, undisturbed
from stress.process_use import memory_mb, n_files, n_threads, stolen_s

_LOUDEST_ERROR = 1e-3
"""Fraction of full scale by which a recorded period may differ from the mix."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--undisturbed", action="store_true", help="run before other programs (needs the right to)")
    parser.add_argument("--freeze", action="store_true", help="gc.freeze() first, as a game may after loading")
    arguments = parser.parse_args()
    if problem := missing():
        sys.exit(problem)
    if arguments.freeze:
        gc.freeze()
    with undisturbed() if arguments.undisturbed else nullcontext(), SoundServer() as server:
        heard = played(server, 60.0 * arguments.minutes)
    report(heard)


def played(server: SoundServer, seconds: float) -> NDArray[np.float32]:
    """Record while a game plays; print a line per tenth of the time. Returns the recorded frames."""
    sink = SoundCardSink(DEVICE)
    recorder = server.record()
    print(f"Python {platform.python_version()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
    with session_on(sink) as session:
        assert sink.wait_connected(10.0)
        game = Game(session, lambda _: 0.001, allocates=True)
        game.start()
        for tenth in range(1, 11):
            time.sleep(seconds / 10)
            print(
                f"{tenth * seconds / 600:.2g} min: {game.updates} updates, underruns {sink.stats.underruns}, "
                f"{n_threads()} threads, {n_files()} files, "
                f"{memory_mb():.1f} MB, load {os.getloadavg()[0]:.1f}, stolen {stolen_s():.0f} s",
                flush=True,
            )
        end = recorder.n_heard
        game.kill()
    return recorder.stop()[:end]


def report(heard: NDArray[np.float32]) -> None:
    """Compare each period with the mix. If a period differs, find the common shift of both hands.

    One hand would not be enough: its tone matches again after every cycle. Hands that drift apart match at no shift.
    """
    steady = heard[int(np.flatnonzero(np.abs(heard).max(axis=1) > 1e-3)[0]) + SETTLING :]
    safe = safe_period()
    at = shift_of(steady[:PERIOD], safe)
    worst, slips, broken, apart = 0.0, [], 0, 0
    for number in range(len(steady) // PERIOD):
        block = steady[number * PERIOD : (number + 1) * PERIOD].astype(np.float64)
        error = residual(block, safe, at)
        if error <= _LOUDEST_ERROR:
            worst, apart = max(worst, error), 0
            continue
        broken += 1
        # The period in which frames were lost matches at no shift; the next one does.
        now = shift_of(block, safe)
        if residual(block, safe, now) <= _LOUDEST_ERROR:
            slips.append((number * PERIOD / RATE, (now - at) % PERIOD))
            at, apart = now, 0
        else:
            apart += 1
    print(f"{len(steady) / RATE / 60:.1f} min in periods of {PERIOD / RATE} s: {broken} differ from the mix,")
    print(f"all others equal it within {worst:.1e}")
    for at_s, frames in slips:
        print(f"  after {at_s:.1f} s both hands slipped by {frames} frames (modulo {PERIOD})")
    print(f"periods at the end that match at no common shift of both hands: {apart}")


def shift_of(block: NDArray[np.floating], safe: NDArray[np.float64]) -> int:
    """Frames by which the period is shifted in a block (PERIOD, 2)."""
    spectrum = np.fft.fft(block, axis=0) * np.conj(np.fft.fft(safe, axis=0))
    return int(np.argmax(np.fft.ifft(spectrum, axis=0).real.sum(axis=1)))


def residual(block: NDArray[np.float64], safe: NDArray[np.float64], shift: int) -> float:
    """The largest difference of a block from the shifted period."""
    return float(np.abs(block - np.roll(safe, shift, axis=0)).max())


if __name__ == "__main__":
    main()
