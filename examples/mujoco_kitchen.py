"""A MuJoCo model that is felt: hands on a vibrating object and on what carries it, while the simulation runs.

    python examples/mujoco_kitchen.py kitchen/kitchen1.xml --assets-root . --unit-m 0.56 -o kitchen.wav

The left hand holds the first vibrating object, the right hand the largest thing that it touches, and meanwhile the
longest drawer or sliding door of the model is drawn out by `mj_step`. Needs: pip install 'scene2hap[mujoco]'
"""

import argparse
import math

import mujoco
import numpy as np

from scene2hap import ContactGraph, HapticSession, SceneObject, Touch, WavSink, bake
from scene2hap.engines import MuJoCoLink
from scene2hap.scene.engines.mujoco import open_mjcf, snapshot

FRAMES_PER_SECOND = 50


def main() -> None:
    """Read, bake, play."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", metavar="MODEL.xml")
    parser.add_argument("-o", "--output", metavar="OUT.wav", required=True)
    parser.add_argument("--assets-root", help="folder that holds all files of the model (default: its own)")
    parser.add_argument("--unit-m", type=float, default=1.0, help="metres per unit of the model (1)")
    parser.add_argument("--seconds", type=float, default=3.0)
    arguments = parser.parse_args()

    model, data = open_mjcf(arguments.model, assets_root=arguments.assets_root)
    scene = snapshot(model, data, unit_m=arguments.unit_m)
    bundle = bake(scene)
    sources = [item.id for item in scene.objects if item.id in bundle.loops]
    if not sources:
        raise SystemExit(f"nothing in {scene.name!r} vibrates; touch it as you like, nothing will be felt.")
    source = sources[0]
    beside = ContactGraph(scene).neighbours(source) or (source,)
    hands = {"left": source, "right": max(beside, key=lambda key: math.prod(scene.object(key).size_m[:2]))}
    drawer = longest_slide(model)

    sink = WavSink(arguments.output)
    steps_per_frame = max(1, round(1 / (FRAMES_PER_SECOND * model.opt.timestep)))
    n_frames = round(arguments.seconds * FRAMES_PER_SECOND)
    with HapticSession(scene, bundle, sink=sink) as session:
        link = MuJoCoLink(model, data, session, unit_m=arguments.unit_m)
        for _ in range(n_frames):
            for _ in range(steps_per_frame):
                if drawer is not None:
                    data.qvel[model.jnt_dofadr[drawer]] = np.ptp(model.jnt_range[drawer]) / arguments.seconds
                mujoco.mj_step(model, data)
            now = session.snapshot
            # A hand stays in the middle of the object's plate, wherever it goes.
            touches = [Touch(hand, held, middle(now.object(held))) for hand, held in hands.items()]
            frame = link.update(touches)
            sink.pull_s(1 / FRAMES_PER_SECOND)
        now = session.snapshot

    gone = {item.id: math.dist(now.object(item.id).pose.position_m, item.pose.position_m) for item in scene.objects}
    print(f"{len(scene.objects)} objects; sources: {', '.join(sources)}")
    print("moved:", ", ".join(f"{key} by {way:.2f} m" for key, way in gone.items() if way > 0.01) or "nothing")
    for hand, held in hands.items():
        print(f"{hand} on {held}: {frame.gain(hand, source):.3f} of {source}")
    print(f"wrote {arguments.output}")


def longest_slide(model: mujoco.MjModel) -> int | None:
    """The sliding joint with the widest range, None if nothing slides."""
    slides = np.flatnonzero((model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE) & (model.jnt_limited == 1))
    return int(slides[np.ptp(model.jnt_range[slides], axis=1).argmax()]) if len(slides) else None


def middle(item: SceneObject) -> list[float]:
    """The middle of an object's plate, in the world."""
    plate = item.surface
    return item.pose.compose(plate.pose).to_world([plate.length_m / 2, plate.width_m / 2, 0.0]).tolist()


if __name__ == "__main__":
    main()
