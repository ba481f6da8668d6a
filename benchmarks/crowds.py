"""Time of a contact update in which many objects move at once, with and without certificates, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/crowds.py [--frames 150] [--passes 5]

Cubes of 0.1 m stand on a floor, in a grid with a given distance between them. Each moves in a circle of 20 mm, 2 mm a
frame, and every other cube turns. The table shows processor times of `ContactGraph.update`, for each frame the least of
several passes. Contacts must be bit-identical with and without certificates.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from unittest import mock

import numpy as np
from busy_room import floor_room, yaw

from scene2hap import Box, Contact, Pose, SceneSnapshot
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.objects import with_relative_heights

Frames = Sequence[dict[str, Pose]]


def cubes_on_floor(n_boxes: int, apart_m: float) -> SceneSnapshot:
    """Cubes on a floor, in a grid with `apart_m` between them."""
    floor, item = floor_room(2, 1).scene.objects
    side, cube = math.ceil(math.sqrt(n_boxes)), replace(item, geometry=Box((0.1, 0.1, 0.1)))
    # The floor begins at 0.
    places = [(0.2 + (0.1 + apart_m) * (k % side), 0.05, 0.2 + (0.1 + apart_m) * (k // side)) for k in range(n_boxes)]
    cubes = [replace(cube, id=f"cube{k}", name=f"cube{k}", pose=Pose(at)) for k, at in enumerate(places)]
    return SceneSnapshot("crowd", "y", with_relative_heights([floor, *cubes], "y"))


def frames_of(scene: SceneSnapshot, n_frames: int) -> Frames:
    """Poses of all cubes in each frame."""
    rng = np.random.default_rng(1)
    cubes = [item for item in scene.objects if item.id != "floor"]
    phases = rng.uniform(0, 2 * math.pi, len(cubes))
    frames = []
    for i in range(n_frames):
        frame = {}
        for k, (item, phase) in enumerate(zip(cubes, phases, strict=True)):
            x, y, z = item.pose.position_m
            at = 0.1 * i + phase
            turn = yaw(0.01 * i * (k % 2)).rotation_xyzw
            frame[item.id] = Pose((x + 0.02 * math.cos(at), y, z + 0.02 * math.sin(at)), turn)
        frames.append(frame)
    return frames


def times_us(
    scene: SceneSnapshot, frames: Frames, n_passes: int, *, with_certificates: bool
) -> tuple[np.ndarray, list[Contact]]:
    """Least time of each frame [us], and the contacts at the end."""
    off = mock.patch("scene2hap.contact.certificate_issuer.CertificateIssuer.may_be_issued", return_value=False)
    found, contacts = [], list[Contact]()
    with nullcontext() if with_certificates else off:
        for _ in range(n_passes):
            graph, took = ContactGraph(scene), []
            for frame in frames:
                start = time.thread_time()
                graph.update(frame)
                took.append(1e6 * (time.thread_time() - start))
            found.append(took)
            contacts = [*graph.contacts]
    return np.array(found).min(axis=0), contacts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=150)
    parser.add_argument("--passes", type=int, default=5)
    wanted = parser.parse_args()
    print("| cubes | apart [mm] | p50, p99 with certificates [us] | without [us] | ratio of medians |")
    print("|---|---|---|---|---|")
    for n_boxes in (30, 100):
        for apart_m in (0.01, 0.03, 0.1):
            scene = cubes_on_floor(n_boxes, apart_m)
            frames = frames_of(scene, wanted.frames)
            (one, found), (other, plain) = (
                times_us(scene, frames, wanted.passes, with_certificates=is_on) for is_on in (True, False)
            )
            assert found == plain
            p50, p99, off50, off99 = (np.percentile(x, q) for x in (one, other) for q in (50, 99))
            print(
                f"| {n_boxes} | {1000 * apart_m:.0f} | {p50:.0f}, {p99:.0f} | {off50:.0f}, {off99:.0f} |"
                f" {p50 / off50:.2f} |"
            )


if __name__ == "__main__":
    main()
