"""Distinct pairs among twenty kinds of machine in one scene, by two measures, as a table in Markdown.

python benchmarks/kinds.py [--set home|flat|workshop|compressors] [--seeds 3] [--first 0] [--takes 4] [--tactile auto]

1. The project's own (`percepts`): just noticeable differences in frequency, rhythm and level.
2. An independent one: the spectral part of ST-SIM (Hassen and Steinbach 2019) as `vibromaf` computes it. It needs
   `pip install vibromaf`; otherwise this part is left out. Two loops are compared in blocks of 64 ms by the components
   felt in both, at the lag of largest similarity, since machines do not start together.
   - *takes*: a pair is distinct if its loops are less similar than 95 % of the pairs of takes of either kind. Takes
     differ in their seed and have the same shift of frequency. So two kinds must differ more than two takes of one.
   - *all*: the same, with one threshold from the takes of all kinds.
   - *halves*: the earlier rule, at 2.8 kHz and without scale or lag. A pair is distinct if it is less similar than the
     two halves of 95 % of all loops of all seeds.

Controls: with `--tactile svf_bandpass` all kinds have the same fixed filter, and no frequency is shifted. The ten
compressors have one voice, so that only their speeds and intensities differ.
"""

from __future__ import annotations

import argparse
import warnings
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from percepts import distinctness, percept_of
from scipy.signal import resample

from scene2hap import (
    AudioClip,
    BakeConfig,
    Box,
    HapticBundle,
    Pose,
    SceneObject,
    SceneSnapshot,
    VibrationDescription,
    bake as bake_scene,
)
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import Plan, felt_loop
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.threshold import threshold_db

SETS = {
    "home": "refrigerator, microwave, washing machine, tumble dryer, dishwasher, cooker hood, blender, coffee grinder, "
    "electric toothbrush, hair dryer, vacuum cleaner, smartphone, fan, printer, computer, drill, chainsaw, clock, "
    "kettle, sewing machine",
    "flat": "air conditioner, dehumidifier, coffeemaker, mixer, bread maker, rice cooker, toaster, shaver, massager, "
    "handheld fan, hard drive, gamepad, alarm clock, doorbell, radio, transformer, aquarium, treadmill, robot, oven",
    "workshop": "drill, jigsaw, grinder, lathe, jackhammer, impact driver, air compressor, welding machine, "
    "3D printer, vacuum cleaner, leafblower, lawnmower, generator, chainsaw, concrete mixer, conveyor belt, forklift, "
    "pump, heat gun, car",
    "compressors": "refrigerator, freezer, minibar, wine cooler, water cooler, dehumidifier, water dispenser, "
    "vending machine, heat pump, ice machine",
}
RATE_HZ, N_SAMPLES = 8000, 40960
"""Sample rate of the table of thresholds in `vibromaf`, and number of samples of 5.12 s."""
OTHER_SEED = 1000
Signal = NDArray[np.float64]


@dataclass(frozen=True)
class Kinds:
    """Tactile loops of the first state of each kind, all from one bake, and further takes of each."""

    loops: dict[str, AudioClip]
    takes: dict[str, list[AudioClip]]

    @cached_property
    def n_distinct(self) -> tuple[int, int]:
        """Number of pairs, and of pairs that are distinct by the project's own measure."""
        percepts = {name: percept_of(clip.samples, clip.sample_rate_hz) for name, clip in self.loops.items()}
        pairs = distinctness(percepts)
        return len(pairs), sum(pair.is_distinct for pair in pairs)


def baked(names: tuple[str, ...], seed: int, n_takes: int, tactile: str) -> Kinds:
    things = [
        SceneObject(x, pose=Pose((1.5 * i, 0.2, 0.0)), geometry=Box((0.3, 0.4, 0.3))) for i, x in enumerate(names)
    ]
    config = BakeConfig(seed=seed, tactile=tactile)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bundle = bake_scene(SceneSnapshot.build(things), config)
    others = [seed + (i + 1) * OTHER_SEED for i in range(n_takes)]
    return Kinds(
        {name: next(iter(states.values())).tactile for name, states in bundle.loops.items()},
        {name: [take(bundle, name, config, other) for other in others] for name in bundle.loops},
    )


def take(bundle: HapticBundle, name: str, config: BakeConfig, seed: int) -> AudioClip:
    """Tactile loop of another take of an object's first state, with the same level and shift of frequency."""
    haptics, loop = bundle.objects[name], next(iter(bundle.loops[name].values()))
    felt, state = loop.felt, haptics.states[0]
    assert felt is not None
    assert loop.source is not None
    clip = Synthesizer().find(
        VibrationDescription(
            haptics.object_category,
            state.name,
            state.sentence,
            state.keywords,
            state.intensity,
            haptics.estimated_size_m,
            haptics.material_category,
            seed,
        )
    )[0]
    level_db = sensation_level_db(state.intensity)
    stays, component = (
        felt_component_of(x.samples, x.sample_rate_hz, level_db, config.actuator) for x in (loop.source, clip)
    )
    assert stays is not None
    assert component is not None
    moved = 1.0  # a fixed filter moves nothing
    if felt.own_hz is not None and felt.target_hz is not None:
        moved = (stays.frequency_hz + felt.target_hz - felt.own_hz) / stays.felt_hz
    context = ConversionContext(
        config.actuator,
        state.intensity,
        own_hz=component.frequency_hz,
        target_hz=component.felt_hz * moved,
        rough_hz=component.rough_hz,
    )
    return felt_loop(clip, config.tactile, Plan(context, felt.asked_level_db)).tactile


class Likeness:
    """Similarity of loops by the spectral part of ST-SIM, 0 to 1.

    Loops are scaled so that a sine of 250 Hz at the project's threshold of touch lies at the threshold of `vibromaf`.
    Its transform is orthonormal, and it takes full scale to lie 77 dB above its threshold. Without the scale,
    components below the project's threshold would count as felt.
    """

    def __init__(self) -> None:
        from vibromaf.signal.transform import PerceptualSpectrumBuilder

        self._builder = PerceptualSpectrumBuilder()
        n = self._builder.block_builder.block_length
        theirs_db = self._builder.perceptual_threshold.calculate(n)[round(250.0 * 2 * n / RATE_HZ)]
        ours_db = float(threshold_db(250.0)) + 10.0 * np.log10(n / 2)
        self._scale = 10 ** ((theirs_db - ours_db) / 20)

    def support(self, clip: AudioClip) -> Signal:
        """Probability that each component of each block is felt (n_blocks, n_components) [-]."""
        return self._support(self._scale * repeated(clip, RATE_HZ, N_SAMPLES))

    def _support(self, samples: Signal) -> Signal:
        from vibromaf.signal.spectrum import compute_spectral_support

        with np.errstate(divide="ignore"):
            found: Signal = compute_spectral_support(self._builder.compute_perceptual_spectrum(samples))
        return found

    @staticmethod
    def of(one: Signal, other: Signal) -> float:
        """Mean over blocks of the smaller similarity of both directions, at the lag of the largest mean."""
        n = len(one)
        powers = np.maximum((one**2).sum(axis=1)[:, None], (other**2).sum(axis=1))
        blocks = (one @ other.T + 1e-9) / (powers + 1e-9)  # silent blocks are equal
        at = np.arange(n)
        return float(max(blocks[at, (at + lag) % n].mean() for lag in range(n)))

    def before(self, scenes: list[Kinds]) -> list[int]:
        """For each scene, the number of pairs that are distinct by the earlier rule."""
        from vibromaf.metrics.stsim import STSIM

        def likeness(one: Signal, other: Signal) -> float:
            return float(min(STSIM.compute_sim(one, other), STSIM.compute_sim(other, one)))

        n = 14336
        sounds = [[repeated(clip, 2800, n) for clip in scene.loops.values()] for scene in scenes]
        to_itself = [likeness(self._support(x[: n // 2]), self._support(x[n // 2 :])) for all_ in sounds for x in all_]
        least = float(np.percentile(to_itself, 5))
        return [sum(likeness(a, b) < least for a, b in combinations(map(self._support, all_), 2)) for all_ in sounds]


def repeated(clip: AudioClip, rate_hz: int, n_samples: int) -> Signal:
    """Loop at another rate, repeated to n samples (n,)."""
    n = round(len(clip.samples) * rate_hz / clip.sample_rate_hz)
    return np.tile(resample(clip.samples.astype(np.float64), n), n_samples // n + 1)[:n_samples]


def by_vibromaf(scenes: list[Kinds]) -> list[tuple[int, int, int]]:
    """For each scene, the number of pairs that are distinct by each of the three rules."""
    measure = Likeness()
    pairs: list[dict[tuple[str, str], float]] = []
    similar: list[dict[str, list[float]]] = []
    for scene in scenes:
        loops = {name: measure.support(clip) for name, clip in scene.loops.items()}
        takes = {name: [loops[name], *map(measure.support, clips)] for name, clips in scene.takes.items()}
        pairs.append({(a, b): measure.of(loops[a], loops[b]) for a, b in combinations(loops, 2)})
        similar.append({name: [measure.of(x, y) for x, y in combinations(clips, 2)] for name, clips in takes.items()})
    least = float(np.percentile([x for kinds in similar for values in kinds.values() for x in values], 5))
    return [
        (
            sum(x < float(np.percentile(kinds[a] + kinds[b], 5)) for (a, b), x in found.items()),
            sum(x < least for x in found.values()),
            before,
        )
        for found, kinds, before in zip(pairs, similar, measure.before(scenes), strict=True)
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", choices=SETS, default="home")
    parser.add_argument("--seeds", type=int, default=3, help="how many")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--takes", type=int, default=4, help="of each kind, besides the one in the scene")
    parser.add_argument("--tactile", default="auto", help="kind of the converter")
    given = parser.parse_args()
    names = tuple(SETS[given.set].split(", "))
    seeds = range(given.first, given.first + given.seeds)
    scenes = [baked(names, seed, given.takes, given.tactile) for seed in seeds]
    is_there = find_spec("vibromaf") is not None
    second = by_vibromaf(scenes) if is_there else [("vibromaf is not installed", "-", "-")] * len(scenes)
    print("| seed | pairs | distinct | by ST-SIM: takes | all | halves |")
    print("|---|---|---|---|---|---|")
    for seed, scene, counts in zip(seeds, scenes, second, strict=True):
        print(f"| {seed} | {' | '.join(str(x) for x in (*scene.n_distinct, *counts))} |")


if __name__ == "__main__":
    main()
