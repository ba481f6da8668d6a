"""Errors of `.haptic` exports relative to their loops, and the time of exports, as tables in Markdown.

python benchmarks/export.py [SCENE ...]

Each exported file is played by the format's published rule. Its level in windows of 50 ms, 25 ms apart, is compared
with that of the loop. This measure is independent of the exporter's own. Windows more than 40 dB below the loudest one
are left out. A source is steady if the level of its loop varies by less than 6 dB (5th to 95th percentile).
Scenes are the demo kitchen and, if it is beside the project, a kitchen by another author.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import SCENES
from scene2hap import HapticBundle, bake, export_bundle, load_scene
from scene2hap.clips.haptic_format import read_haptic
from scene2hap.clips.synthesis import synthesize
from scene2hap.demo import kitchen_path, tour_path
from scene2hap.export import EXPORTS

Signal = NDArray[np.float64]

WINDOW_S, STEP_S, STEADY_DB, FLOOR_DB = 0.05, 0.025, 6.0, -40.0


def levels_db(samples: Signal, rate: float, n_windows: int) -> Signal:
    """Level in each window [dB]."""
    starts = (np.arange(n_windows) * STEP_S * rate).astype(int)
    width = round(WINDOW_S * rate)
    power = np.array([np.mean(samples[start : start + width] ** 2) for start in starts])
    return 10 * np.log10(power + 1e-14)


def row(name: str, bundle: HapticBundle, source: str, state: str, folder: Path) -> str:
    """One line of the table."""
    loop = bundle.loops[source][state].tactile
    path = folder / "haptic" / f"{name}.haptic"
    clip = read_haptic(path)
    n = int((min(loop.duration_s, clip.duration_s) - WINDOW_S) / STEP_S)
    own = levels_db(loop.samples.astype(np.float64), loop.sample_rate_hz, n)
    played = levels_db(synthesize(clip), 8000, n)
    is_felt = own > own.max() + FLOOR_DB
    missed = np.abs(np.maximum(played, own.max() + FLOOR_DB) - own)[is_felt]
    is_steady = np.subtract(*np.percentile(own, (95, 5))) < STEADY_DB
    n_frequency = len(clip.frequency) if clip.frequency is not None else 0
    loop_hz = bundle.loops[source][state].frequency_tactile_hz
    given = float(np.median(clip.frequency_hz(np.linspace(0, clip.duration_s, 200))))
    return (
        f"| {source} | {state} | {'steady' if is_steady else 'varies'} | {np.median(missed):.2f} | "
        f"{np.percentile(missed, 95):.2f} | {len(clip.amplitude) / clip.duration_s:.1f} | "
        f"{n_frequency / clip.duration_s:.1f} | {len(clip.transients)} | {loop_hz:.0f} | {given:.0f} |"
    )


def tour(bundle: HapticBundle, folder: Path) -> None:
    """Export the demo's tour for both hands in every format; print the errors that the exporter itself reports."""
    begun = time.perf_counter()
    report = export_bundle(bundle, folder, touches=tour_path())
    print(f"with a tour of both hands, playing it included: {time.perf_counter() - begun:.2f} s\n")
    print("| format | hand | level error [dB], median | 95 % | error [JND], median |\n|---|---|---|---|---|")
    for one in report.rows:
        found = one.fidelity
        if one.track == "tour" and found is not None:
            jnd = f"{found.median_jnd:.2f}" if found.median_jnd is not None else "-"
            print(f"| {one.kind} | {one.channel} | {found.median_db:.2f} | {found.p95_db:.2f} | {jnd} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", metavar="SCENE", nargs="*", type=Path)
    kaykit = SCENES / "composed_kitchen_kaykit" / "composed_kitchen_kaykit.glb"
    scenes = parser.parse_args().scenes or [kitchen_path(), *([kaykit] if kaykit.exists() else [])]
    for path in scenes:
        bundle = bake(load_scene(path))
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            export_bundle(bundle, folder, "haptic")
            print(f"{path.stem}: `.haptic`, played by the published rule, against the loop\n")
            print(
                "| source | state | kind | level error [dB], median | 95 % | amplitude points/s | frequency points/s | "
                "transients | loop [Hz] | file [Hz] |"
            )
            print("|---|---|---|---|---|---|---|---|---|---|")
            manifest = json.loads((folder / "manifest.json").read_text())
            for source in manifest["sources"]:
                for state in source["states"]:
                    name = Path(state["files"][0]["files"][0]).stem
                    print(row(name, bundle, source["object_id"], state["name"], folder))
            print()
            times = []
            for _ in range(3):
                begun = time.perf_counter()
                export_bundle(bundle, folder / "all")
                times.append(time.perf_counter() - begun)
            n_states = sum(map(len, bundle.loops.values()))
            print(f"{n_states} loops to all {len(EXPORTS.builtins)} kinds: {min(times):.2f} s (least of three)")
            if path == kitchen_path():
                tour(bundle, folder / "tour")
            print()


if __name__ == "__main__":
    main()
