"""What converting sound files costs: against the clock, against a compiled filter, and in memory.

python benchmarks/convert.py [--runs 7]

Three things, each with the default band-pass:
- time for 60 s of stereo at 48 kHz, and how many times faster than it sounds that is;
- the same job (read WAV, 12 dB per octave of band-pass at 250 Hz, write 24-bit WAV, in the same blocks) by pedalboard's
  compiled filters, in turn with ours; `pip install pedalboard` brings it, and without it this part is left out;
- peak memory of a process of its own for one, three and ten minutes of the same sound.
Times are medians of runs in turn. A first run of each warms caches and is not counted.
"""

from __future__ import annotations

import argparse
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import soundfile

from scene2hap.audio import convert

RATE = 48_000
BLOCK = 65_536
CONVERTER = "svf_bandpass"  # the one that pedalboard's filters do as well
PEAK = (
    "import resource, sys; from scene2hap.audio import convert;"
    f"convert(sys.argv[1], sys.argv[2], converter={CONVERTER!r}, overwrite=True);"
    "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)"
)


def make_sound(path: Path, minutes: int) -> None:
    """Two channels of hum and hiss, written a second at a time."""
    rng = np.random.default_rng(1)
    t = np.arange(RATE) / RATE
    hum = 0.2 * np.sin(2 * np.pi * 97.0 * t)
    with soundfile.SoundFile(path, "w", RATE, 2, subtype="PCM_16") as file:
        for _ in range(60 * minutes):
            file.write(hum[:, None] + 0.05 * rng.standard_normal((RATE, 2)))


def by_pedalboard(source: Path, output: Path) -> Callable[[], None]:
    import pedalboard
    from pedalboard.io import AudioFile

    def job() -> None:
        # Each of them falls by 6 dB per octave: together the band-pass of second order that ours is.
        board = pedalboard.Pedalboard([pedalboard.HighpassFilter(250.0), pedalboard.LowpassFilter(250.0)])
        with (
            AudioFile(str(source)) as before,
            AudioFile(str(output), "w", before.samplerate, before.num_channels, bit_depth=24) as after,
        ):
            while before.tell() < before.frames:
                after.write(board(before.read(BLOCK), before.samplerate, reset=False))

    return job


def timed(job: Callable[[], object]) -> tuple[float, float]:
    """Wall and processor time [s]."""
    wall, processor = time.perf_counter(), time.process_time()
    job()
    return time.perf_counter() - wall, time.process_time() - processor


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=7)
    runs = parser.parse_args().runs
    print(f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, {runs} runs in turn")
    with tempfile.TemporaryDirectory() as folder:
        speed(Path(folder), runs)
        memory(Path(folder))


def speed(folder: Path, runs: int) -> None:
    source = folder / "minute.wav"
    make_sound(source, 1)

    def ours() -> object:
        return convert(source, folder / "ours.wav", converter=CONVERTER, overwrite=True)

    jobs: dict[str, Callable[[], object]] = {"scene2hap": ours}
    if find_spec("pedalboard"):
        jobs[f"pedalboard {version('pedalboard')}"] = by_pedalboard(source, folder / "theirs.wav")
    else:
        print("pedalboard is not installed: no comparison (pip install pedalboard)")
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in jobs}
    for run in range(runs + 1):
        for name, job in jobs.items():
            taken = timed(job)
            if run:
                times[name].append(taken)
    medians = {name: [statistics.median(column) for column in zip(*rows, strict=True)] for name, rows in times.items()}
    for name, (wall, processor) in medians.items():
        print(f"{name:20} wall {1e3 * wall:6.0f} ms, {60 / wall:5.0f} x real time; processor {1e3 * processor:6.0f} ms")
    if len(medians) == 2:
        (ours_wall, ours), (theirs_wall, theirs) = medians.values()
        print(f"ratio: wall {ours_wall / theirs_wall:.2f}, processor {ours / theirs:.2f}")


def memory(folder: Path) -> None:
    for minutes in (1, 3, 10):
        source = folder / "sound.wav"
        make_sound(source, minutes)
        run = [sys.executable, "-c", PEAK, str(source), str(folder / "felt.wav")]
        peak = float(subprocess.run(run, capture_output=True, text=True, check=True).stdout)
        print(f"{minutes:3} minutes: peak memory {peak:6.1f} MB")


if __name__ == "__main__":
    main()
