"""Cost of converting sound files: relative to real time, relative to a compiled filter, and in memory.

python benchmarks/convert.py [--runs 7]

- Time of `auto`, the default, for 60 s at 48 kHz of sounds that use its parts, in mono and stereo.
- Time of `auto` for files of 2, 5 and 10 s of the same sounds, in stereo, on a flat and on a resonant actuator: the
  later files of a process, and a whole process of the command line with one file or a folder of six.
- Time of a live stream of `auto` for 10 s of the same sounds, in blocks of three sizes.
- Time of the paper's band-pass for 60 s of stereo, and the ratio of real time to it.
- The same job (read WAV, band-pass at 250 Hz with 12 dB per octave, write 24-bit WAV, in the same blocks) by
  pedalboard's compiled filters, in turn with ours. It needs `pip install pedalboard`; otherwise this part is left out.
- Peak memory of a separate process that converts one, three and ten minutes of the same sound by `auto`.
Times are medians of runs in turn. A first run of each warms caches and is not counted.
"""

from __future__ import annotations

import argparse
import os
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import soundfile
from numpy.typing import NDArray

from scene2hap.audio import convert
from scene2hap.audio.conversion import LevelWarning
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.tactile.auto import Auto

RATE = 48_000
BLOCK = 65_536
SHORT_S = (2, 5, 10)
ACTUATORS = ("flat", "lra")
CONVERTER = "svf_bandpass"  # pedalboard's filters can do the same
PEAK = (
    "import resource, sys; from scene2hap.audio import convert;"
    "convert(sys.argv[1], sys.argv[2], overwrite=True);"
    "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)"
)


def make_sound(path: Path, minutes: int) -> None:
    """Write two channels of hum and hiss, one second at a time."""
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
        # Each filter falls by 6 dB per octave; together they are a band-pass of second order, as ours.
        board = pedalboard.Pedalboard([pedalboard.HighpassFilter(250.0), pedalboard.LowpassFilter(250.0)])
        with (
            AudioFile(str(source)) as before,
            AudioFile(str(output), "w", before.samplerate, before.num_channels, bit_depth=24) as after,
        ):
            while before.tell() < before.frames:
                after.write(board(before.read(BLOCK), before.samplerate, reset=False))

    return job


def timed(job: Callable[[], object]) -> tuple[float, float]:
    """Run a job. Returns wall and processor time [s]."""
    wall, processor = time.perf_counter(), time.process_time()
    job()
    return time.perf_counter() - wall, time.process_time() - processor


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=7)
    runs = parser.parse_args().runs
    warnings.simplefilter("ignore", LevelWarning)  # the sounds are made for their cost
    print(f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, {runs} runs in turn")
    with tempfile.TemporaryDirectory() as folder:
        memory(Path(folder))  # first: a new process inherits the peak memory of its parent
        default_speed(Path(folder), runs)
        later_files(Path(folder), runs)
        first_files(Path(folder), runs)
        live_speed(runs)
        speed(Path(folder), runs)


def kinds_of_sound() -> dict[str, NDArray[np.float64]]:
    """One minute (n, 2) of each kind of sound that `auto` treats differently."""
    rng = np.random.default_rng(2)
    t = np.arange(60 * RATE) / RATE
    hiss = rng.standard_normal((len(t), 2))
    tone = {hz: np.sin(2 * np.pi * hz * t)[:, None] for hz in (30.0, 49.0, 97.0, 2000.0)}
    ticks = np.exp(-(t % 0.2) / 1e-3)[:, None]  # five a second
    notes = np.zeros((len(t), 1))
    for begin in range(0, len(t) - RATE, RATE // 4):
        phase = 2 * np.pi * 220.0 * 2 ** (rng.integers(24) / 12) * t[:RATE]
        notes[begin : begin + RATE, 0] += 0.2 * np.exp(-4 * t[:RATE]) * (np.sin(phase) + 0.4 * np.sin(2 * phase))
    return {
        "hum and hiss": 0.2 * tone[97.0] + 0.1 * tone[49.0] + 0.05 * hiss,
        "compressor, 30 Hz": 0.4 * tone[30.0] * (1 + 0.3 * np.sin(2 * np.pi * 1.3 * t))[:, None] + 0.005 * hiss,
        "noise": 0.2 * hiss,
        "ticks": 0.5 * ticks * hiss.clip(-2, 2),
        "melody": notes + 0.001 * hiss,
        "beeps, 2 kHz": 0.3 * tone[2000.0] * (t % 1.0 < 0.5)[:, None] + 0.001 * hiss,
    }


def default_speed(folder: Path, runs: int) -> None:
    print(f"auto, {RATE // 1000} kHz: times real time by the processor, of the median run")
    for name, sound in kinds_of_sound().items():
        found = []
        for channels in (1, 2):
            source = folder / f"{channels}.wav"
            soundfile.write(source, sound[:, :channels], RATE, subtype="PCM_16")
            job = partial(convert, source, folder / "felt.wav", overwrite=True)
            found.append(60.0 / statistics.median([timed(job)[1] for _ in range(runs + 1)][1:]))
        print(f"  {name:20} mono {found[0]:5.0f} x   stereo {found[1]:5.0f} x")


def later_files(folder: Path, runs: int) -> None:
    print("auto, stereo files of seconds, the first of each kind not counted: times real time by the processor")
    print(f"  {'':20}" + "".join(f"  {actuator:>5} {seconds:2} s" for actuator in ACTUATORS for seconds in SHORT_S))
    for name, sound in kinds_of_sound().items():
        found = []
        for actuator in ACTUATORS:
            for seconds in SHORT_S:
                source = folder / "short.wav"
                soundfile.write(source, sound[: seconds * RATE], RATE, subtype="PCM_16")
                job = partial(convert, source, folder / "felt.wav", actuator=actuator, overwrite=True)
                found.append(seconds / statistics.median([timed(job)[1] for _ in range(runs + 1)][1:]))
        print(f"  {name:20}" + "".join(f"  {times:8.0f} x" for times in found))


def first_files(folder: Path, runs: int) -> None:
    sounds = folder / "sounds"
    sounds.mkdir()
    for number, sound in enumerate(kinds_of_sound().values()):
        for seconds in SHORT_S:
            part = sounds if seconds == SHORT_S[1] else folder
            soundfile.write(part / f"{number}_{seconds}.wav", sound[: seconds * RATE], RATE, subtype="PCM_16")
    print("scene2hap convert, a new process, its start included: processor time of the median run")
    jobs = [(f"one file of {n} s", (sounds if n == SHORT_S[1] else folder) / f"0_{n}.wav", n) for n in SHORT_S]
    n_files = len(list(sounds.iterdir()))
    jobs.append((f"{n_files} files of {SHORT_S[1]} s", sounds, n_files * SHORT_S[1]))
    for actuator in ACTUATORS:
        for name, source, seconds in jobs:
            output = folder / ("felt.wav" if source.is_file() else "felt")
            taken = statistics.median([of_command(source, output, actuator) for _ in range(runs)])
            print(f"  {actuator:5} {name:17} {1e3 * taken:5.0f} ms, {seconds / taken:4.0f} x real time")


def of_command(source: Path, output: Path, actuator: str) -> float:
    """Run the command line on a file or a folder. Returns its processor time [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "scene2hap", "convert", str(source), "-o", str(output), "--force", "--quiet"]
    subprocess.run([*command, "--actuator", actuator, "--workers", "1"], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def live_speed(runs: int) -> None:
    sizes = (64, 480, 4096)
    print(f"auto, live, {RATE // 1000} kHz: times real time by the processor, of the median run")
    for name, sound in kinds_of_sound().items():
        heard = np.ascontiguousarray(sound[: 10 * RATE, 0], dtype=np.float32)
        found = [10.0 / statistics.median([timed(partial(streamed, heard, n))[1] for _ in range(runs)]) for n in sizes]
        print(f"  {name:20}" + "".join(f"  blocks of {n} {x:4.0f} x" for n, x in zip(sizes, found, strict=True)))


def streamed(heard: NDArray[np.float32], size: int) -> None:
    stream = Auto().stream(RATE, ConversionContext())
    for at in range(0, len(heard), size):
        stream.process(heard[at : at + size])


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
