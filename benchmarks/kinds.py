"""How many pairs of twenty kinds of machine feel distinct in one scene, by two measures, as a table in Markdown.

python benchmarks/kinds.py [--seeds 3]

1. The project's own (`scene2hap.audio.distinctness`): just noticeable differences in frequency, rhythm and level.
2. An independent one: the spectral part of ST-SIM (Hassen and Steinbach 2019) as `vibromaf` computes it, which
   `pip install vibromaf` brings; without it this part is left out. A pair counts as distinct if its loops are less
   alike than 95 % of all loops of all seeds are to themselves, first half against second.
"""

from __future__ import annotations

import argparse
import warnings
from importlib.util import find_spec
from itertools import combinations

import numpy as np
from scipy.signal import resample

from scene2hap import AudioClip, BakeConfig, Box, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.audio.distinctness import distinctness, feel_of

KINDS = (
    "refrigerator",
    "microwave",
    "washing machine",
    "tumble dryer",
    "dishwasher",
    "cooker hood",
    "blender",
    "coffee grinder",
    "electric toothbrush",
    "hair dryer",
    "vacuum cleaner",
    "smartphone",
    "fan",
    "printer",
    "computer",
    "drill",
    "chainsaw",
    "clock",
    "kettle",
    "sewing machine",
)
RATE_HZ, N_SAMPLES = 2800, 14336  # of ST-SIM


def loops(seed: int) -> dict[str, AudioClip]:
    """The tactile loop of each kind's first state, from one bake."""
    things = [
        SceneObject(x, pose=Pose((1.5 * i, 0.2, 0.0)), geometry=Box((0.3, 0.4, 0.3))) for i, x in enumerate(KINDS)
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bundle = bake(SceneSnapshot.build(things), BakeConfig(seed=seed))
    return {name: next(iter(states.values())).tactile for name, states in bundle.loops.items()}


def by_vibromaf(scenes: list[dict[str, AudioClip]]) -> list[int]:
    """For each scene, the pairs that are less alike than 95 % of all loops are to themselves."""
    from vibromaf.metrics.stsim import STSIM
    from vibromaf.signal.spectrum import compute_spectral_support
    from vibromaf.signal.transform import PerceptualSpectrumBuilder

    builder, half = PerceptualSpectrumBuilder(), N_SAMPLES // 2

    def support(samples: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return compute_spectral_support(builder.compute_perceptual_spectrum(samples))

    def likeness(one: np.ndarray, other: np.ndarray) -> float:
        return min(STSIM.compute_sim(one, other), STSIM.compute_sim(other, one))

    def sound(clip: AudioClip) -> np.ndarray:
        n = round(len(clip.samples) * RATE_HZ / clip.sample_rate_hz)
        return np.tile(resample(clip.samples, n), N_SAMPLES // n + 1)[:N_SAMPLES]

    sounds = [[sound(clip) for clip in clips.values()] for clips in scenes]
    to_itself = [likeness(support(x[:half]), support(x[half:])) for several in sounds for x in several]
    least = np.percentile(to_itself, 5)
    return [sum(likeness(a, b) < least for a, b in combinations(map(support, several), 2)) for several in sounds]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=3)
    given = parser.parse_args()
    scenes = [loops(seed) for seed in range(given.seeds)]
    is_there = find_spec("vibromaf") is not None
    second = by_vibromaf(scenes) if is_there else ["vibromaf is not installed"] * len(scenes)
    print("| seed | pairs | distinct | by ST-SIM |")
    print("|---|---|---|---|")
    for seed, clips in enumerate(scenes):
        pairs = distinctness({name: feel_of(clip.samples, clip.sample_rate_hz) for name, clip in clips.items()})
        print(f"| {seed} | {len(pairs)} | {sum(pair.is_distinct for pair in pairs)} | {second[seed]} |")


if __name__ == "__main__":
    main()
