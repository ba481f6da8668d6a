"""A game of 30 objects without a scene file: a kitchen of boxes, a phone that is lifted, two hands, one minute.

python examples/game_in_python.py [minute.wav [seconds]]
"""

import math
import sys

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, WavSink, bake

FRAME_HZ = 90
TOP_M = 0.74


def thing(name: str, size_m: tuple[float, float, float], x: float, z: float, on_m: float = 0.0) -> SceneObject:
    """A box whose bottom is at the height `on_m`."""
    return SceneObject(name, pose=Pose((x, on_m + size_m[1] / 2, z)), geometry=Box(size_m))


def kitchen() -> SceneSnapshot:
    """A floor, a table with things on it, chairs, and a counter with appliances."""
    objects = [
        thing("wooden floor", (6.0, 0.1, 5.0), 0.0, 0.0, -0.1),
        thing("wooden table", (1.4, TOP_M, 0.8), 0.0, 0.0),
        thing("steel counter", (2.4, 0.9, 0.6), 0.0, -1.8),
        thing("refrigerator", (0.6, 1.8, 0.6), 1.6, -1.8),
        thing("washing machine", (0.6, 0.85, 0.6), -1.6, -1.8),
        thing("microwave oven", (0.5, 0.3, 0.35), -0.6, -1.8, 0.9),
        thing("electric kettle", (0.16, 0.24, 0.16), 0.4, -1.8, 0.9),
        thing("smartphone", (0.07, 0.008, 0.15), 0.2, 0.1, TOP_M),
    ]
    objects += [thing(f"wooden chair {k}", (0.42, 0.45, 0.42), 0.5 * (-1) ** k, 0.7 - k // 2 * 1.4) for k in range(4)]
    objects += [thing(f"plate {k}", (0.22, 0.02, 0.22), -0.5 + 0.33 * k, -0.25, TOP_M) for k in range(4)]
    objects += [thing(f"glass {k}", (0.06, 0.12, 0.06), -0.6 + 0.3 * k, 0.28, TOP_M) for k in range(5)]
    objects += [thing(f"book {k}", (0.15, 0.03, 0.2), 2.5, 1.5, 0.03 * k) for k in range(9)]
    return SceneSnapshot.build(objects, name="kitchen in Python")


def main(wav: str = "minute.wav", seconds: str = "60") -> None:
    """Play the game and write the vibration of both hands."""
    scene, sink = kitchen(), WavSink(wav)
    bundle = bake(scene)
    x, y, z = scene.object("smartphone").pose.position_m
    with HapticSession(scene, bundle, sink=sink) as session:
        for frame in range(round(float(seconds) * FRAME_HZ)):
            t = frame / FRAME_HZ
            # The phone is picked up and put down; the left hand slides over the table, the right one rests on it.
            moved = {"smartphone": Pose((x, y + 0.1 * max(0.0, math.sin(t)), z))}
            left = Touch("left", "wooden table", (x + 0.1 + 0.05 * math.sin(2 * t), TOP_M, z))
            session.update(moved, [left, Touch("right", "wooden table", (-0.5, TOP_M, 0.0))])
            sink.pull_s(1 / FRAME_HZ)
    print(f"{wav}: {seconds} s of {len(scene.objects)} objects; sources: {', '.join(bundle.loops)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
