"""Distinctness of the demo kitchen's sources to the touch, in Markdown; docs/figures/conversion.md holds the latest.

python benchmarks/distinctness.py [--seed 0] [--actuator flat] [--scene FILE] [--silence ID ...]

Bakes the scene three times: with the paper's fixed filter, with the adaptive band at each source's own frequency, and
with the default, which moves the frequencies of sources apart. All values are measured on the bundle's tactile loops.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from typing import Any

from percepts import FAR_DB, Difference, Percept, distinctness, percept_of

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.levels import sensation_level_db
from scene2hap.baking import bake
from scene2hap.bundle import HapticBundle, Override
from scene2hap.demo import kitchen_path
from scene2hap.haptics import ActuatorProfile
from scene2hap.scene.load import load_scene

STILL = {"octaves": 0.0, "level_db": 0.0}
WAYS: dict[str, dict[str, Any]] = {
    "fixed filter": {"tactile": "svf_bandpass", "spread": STILL},
    "own band": {"tactile": "adaptive", "spread": STILL},
    "moved apart": {},
}


def percepts(bundle: HapticBundle, actuator: ActuatorProfile) -> dict[str, Percept]:
    """Felt frequency, rhythm and level of each source in its first state."""
    first = {source: next(iter(states.values())).tactile for source, states in bundle.loops.items()}
    return {source: percept_of(clip.samples, clip.sample_rate_hz, actuator) for source, clip in first.items()}


def intensities(bundle: HapticBundle) -> dict[str, float]:
    """The inferred intensity of each source in its first state."""
    return {source: bundle.objects[source].states[0].intensity for source in bundle.loops}


def keeps_order(felt: Mapping[str, Percept], intensity: Mapping[str, float]) -> bool:
    """Whether, in every pair of sources, the one of higher inferred intensity has the higher felt level."""
    return all(
        felt[one].level_db > felt[other].level_db for one in felt for other in felt if intensity[one] > intensity[other]
    )


def described(percept: Percept) -> str:
    rate = f"{percept.envelope_hz:.1f}" if percept.envelope_hz else "-"
    return f"{percept.frequency_hz:.0f} / {rate} / {percept.level_db:.1f}"


def cell(pair: Difference) -> str:
    return (
        f"{pair.by_frequency:.2f} / {pair.by_envelope:.1f} / {pair.by_level:.1f}{'' if pair.is_distinct else ' **x**'}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--actuator", default="flat")
    parser.add_argument("--scene", default=str(kitchen_path()))
    parser.add_argument("--silence", nargs="*", default=[], help="objects that shall not vibrate")
    arguments = parser.parse_args()
    actuator = actuator_profile(arguments.actuator)
    scene = load_scene(arguments.scene)
    common = {"seed": arguments.seed, "actuator": actuator}
    silent = {source: Override(vibrates=False) for source in arguments.silence}
    bundles = {way: bake(scene, {**common, **settings}, overrides=silent) for way, settings in WAYS.items()}
    intensity = intensities(bundles["moved apart"])
    felt = {way: percepts(bundle, actuator) for way, bundle in bundles.items()}

    print("Dominant frequency [Hz] / envelope rate [Hz] / sensation level [dB]\n")
    print("| source | intensity | wanted level [dB] | " + " | ".join(WAYS) + " | moved [octaves] | moved [dB] |")
    print("|---|---|---|" + "---|" * len(WAYS) + "---|---|")
    for source in sorted(intensity, key=lambda name: -intensity[name]):
        own, last = felt["own band"][source], felt["moved apart"][source]
        asked_db = sensation_level_db(intensity[source])
        octaves = math.log2(last.frequency_hz / own.frequency_hz)
        cells = [described(felt[way][source]) for way in WAYS]
        print(
            f"| {source} | {intensity[source]:g} | {asked_db:.1f} | {' | '.join(cells)} "
            f"| {octaves:+.2f} | {last.level_db - asked_db:+.1f} |"
        )

    pairs = {way: {(pair.first, pair.second): pair for pair in distinctness(felt[way])} for way in WAYS}
    print("\nDifferences in JNDs, by frequency / by envelope rate / by level; x: not distinct\n")
    print("| pair | " + " | ".join(WAYS) + " |\n|---|" + "---|" * len(WAYS))
    for key in pairs["fixed filter"]:
        print(f"| {key[0]}, {key[1]} | " + " | ".join(cell(pairs[way][key]) for way in WAYS) + " |")
    print(f"\n| | {' | '.join(WAYS)} |\n|---|" + "---|" * len(WAYS))
    rows: dict[str, Callable[[str], object]] = {
        f"distinct, of {len(pairs['fixed filter'])} pairs": lambda way: sum(p.is_distinct for p in pairs[way].values()),
        f"1 JND without level at -{FAR_DB:g} dB": lambda way: sum(p.far_away >= 1.0 for p in pairs[way].values()),
        "least JNDs without level": lambda way: f"{min(p.without_level for p in pairs[way].values()):.2f}",
        "order of intensities kept": lambda way: "yes" if keeps_order(felt[way], intensity) else "no",
    }
    for name, value in rows.items():
        print(f"| {name} | " + " | ".join(str(value(way)) for way in WAYS) + " |")


if __name__ == "__main__":
    main()
