"""How a gain trembles with the pose of its source, as a table in Markdown (docs/figures/contacts.md).

python benchmarks/trembling.py [--scenes 60] [--frames 60]

A vibrating box stands on a table, level or tilted about one of its bottom edges. A hand touches the table 2 cm beyond
the opposite edge. From frame to frame the pose moves and turns by up to 0.01 or 0.1 mm. Sizes, materials and frequency
are drawn for each scene. The limit is the highest lift at which the opposite edge still touches (bisection). A
step is the largest change of the gain between two frames; gains below -60 dB count as -60 dB.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from scene2hap import AudioClip, Box, HapticBundle, HapticLoop, HapticSession, Pose, SceneObject, SceneSnapshot, Touch
from scene2hap.contact.graph import ContactGraph
from scene2hap.haptics import ObjectHaptics, SourceState
from scene2hap.materials import lookup

MATERIALS = ("oak", "steel", "glass", "plastic", "rubber", "ceramic")
MOST_LIFTED_M, LEAST_DB, RATE_HZ = 0.02, -60.0, 8000


class Draw:
    """A box of random size on a table, both of random materials. The edge at x = 0 stays on the table at height 0."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.size_m = (float(rng.uniform(0.08, 0.5)), float(rng.uniform(0.02, 0.3)), float(rng.uniform(0.08, 0.5)))
        self._table = SceneObject("table", pose=Pose((0.2, -0.015, 0.0)), geometry=Box((1.6, 0.03, 0.8)))
        sizes = {"table": (1.6, 0.8, 0.03), "box": self.size_m}
        self._haptics = {
            name: ObjectHaptics("thing", material, lookup(material), size, "stands there", False)
            for (name, size), material in zip(sizes.items(), rng.choice(MATERIALS, 2).tolist(), strict=True)
        }
        state = SourceState("hum", 0.5, "hum", "hum")
        self._haptics["box"] = replace(self._haptics["box"], vibrates=True, states=(state,))
        self._hz = float(np.round(rng.uniform(40, 250)))

    def posed(self, lift_m: float) -> Pose:
        """The pose of the box with its opposite edge lifted."""
        turn = Rotation.from_rotvec([0.0, 0.0, math.asin(lift_m / self.size_m[0])])
        x, y, z = turn.apply([self.size_m[0] / 2, self.size_m[1] / 2, 0.0]).tolist()
        a, b, c, d = turn.as_quat().tolist()
        return Pose((x, y, z), (a, b, c, d))

    def scene(self, pose: Pose) -> SceneSnapshot:
        box = SceneObject("box", pose=pose, geometry=Box(self.size_m))
        return SceneSnapshot.build([self._table, box])

    def limit_m(self) -> float:
        """Highest lift at which the opposite edge touches the table."""
        low, high = 0.0, MOST_LIFTED_M
        for _ in range(40):
            middle = (low + high) / 2
            points = [one.point_m[0] for one in ContactGraph(self.scene(self.posed(middle))).contacts]
            low, high = (middle, high) if max(points, default=0.0) > self.size_m[0] / 2 else (low, middle)
        return low

    def step_db(self, lift_m: float, tremor_m: float, n_frames: int, rng: np.random.Generator) -> float:
        scene = self.scene(self.posed(lift_m))
        hum = np.sin(2 * np.pi * self._hz * np.arange(RATE_HZ) / RATE_HZ).astype(np.float32)
        clip = AudioClip(hum * np.float32(0.3), RATE_HZ)
        loops = {"box": {"hum": HapticLoop(clip, clip, self._hz, self._hz)}}
        session = HapticSession(scene, HapticBundle(scene, "room", self._haptics, loops))
        touch = Touch("left", "table", (self.size_m[0] + 0.02, 0.0, 0.0))
        still, gains = scene.object("box").pose, []
        for _ in range(n_frames):
            at = np.add(still.position_m, rng.uniform(-tremor_m, tremor_m, 3)).tolist()
            turn = Rotation.from_rotvec(rng.uniform(-tremor_m, tremor_m, 3) / max(self.size_m))
            quaternion = (turn * Rotation.from_quat(still.rotation_xyzw)).as_quat().tolist()
            frame = session.update({"box": Pose(tuple(at), tuple(quaternion))}, [touch])
            gains.append(max(frame.gain("left", "box"), 10 ** (LEAST_DB / 20)))
        return float(np.abs(np.diff(20 * np.log10(gains))).max())


LIFTS: dict[str, Callable[[Draw, np.random.Generator], float]] = {
    "level": lambda draw, rng: 0.0,
    "tilted, edge lifted by 0 to 5 mm": lambda draw, rng: float(rng.uniform(0, 0.005)),
    "tilted to the limit": lambda draw, rng: draw.limit_m(),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--frames", type=int, default=60)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print("| box | pose moves by up to [mm] | step [dB]: median, p90, largest | scenes with a step above 1 dB |")
    print("|---|---|---|---|")
    for name, lift in LIFTS.items():
        for tremor_m in (1e-5, 1e-4):
            steps = []
            for seed in range(given.scenes):
                rng = np.random.default_rng(seed)
                draw = Draw(rng)
                steps.append(draw.step_db(lift(draw, rng), tremor_m, given.frames, rng))
            shown = f"{np.median(steps):.2f}, {np.quantile(steps, 0.9):.2f}, {max(steps):.2f}"
            n_above = sum(step > 1 for step in steps)
            print(f"| {name} | {1e3 * tremor_m:.2f} | {shown} | {n_above} of {given.scenes} |")


if __name__ == "__main__":
    main()
