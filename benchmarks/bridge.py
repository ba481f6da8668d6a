"""Cost of a bridge: latency of the connection, and processor time of the bridge, as a table in Markdown.

    python benchmarks/bridge.py [--seconds 20] [--seed 0]

A bridge in its own process gets frames at a steady rate. The latency is the time from before a client sends a frame
until it has the frame's gains, less the time of the same frame in a game's own process. That time covers the search for
changed poses, as in an `EngineLink`, `update`, and `render` for the clock. The processor time is that of the whole
bridge less the same time. Part of the latency is the time of the client, which is written in Python.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from bridge_client import Client
from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake
from scene2hap.bridge import BridgeServer
from scene2hap.engines.changes import Changes

CASES = ((30, 60.0), (30, 90.0), (500, 90.0))


def scene_of(n: int) -> SceneSnapshot:
    """A board with a phone, and cups in rows that do not touch each other."""
    cups = [Pose((-4.0 + 0.2 * (k % 40), 0.765, -1.2 + 0.2 * (k // 40))) for k in range(n - 2)]
    return SceneSnapshot.build(
        [
            SceneObject("table", "Wooden table", pose=Pose((0.0, 0.7, 0.0)), geometry=Box((9.0, 0.04, 4.0))),
            SceneObject("phone", "Smartphone", pose=Pose((0.1, 0.724, 1.6)), geometry=Box((0.07, 0.008, 0.15))),
            *(
                SceneObject(f"cup_{k}", "Coffee mug", pose=pose, geometry=Box((0.08, 0.09, 0.08)))
                for k, pose in enumerate(cups)
            ),
        ]
    )


async def serve(port_file: Path, costs_file: Path, root: str) -> None:
    """Run a bridge that records the time of each call of its sessions [s]."""
    costs: dict[str, float] = {"begun": 0.0}
    of_frames: list[float] = []

    def noted(method: Any) -> Any:
        def call(self: object, *args: Any, **kwargs: Any) -> Any:
            # Not the thread's processor time: reading it takes a tenth of a millisecond on some machines.
            begun = time.perf_counter()
            try:
                return method(self, *args, **kwargs)
            finally:
                of_frames.append(time.perf_counter() - begun)

        return call

    for owner, name in ((Changes, "of"), (HapticSession, "update"), (HapticSession, "render")):
        setattr(owner, name, noted(getattr(owner, name)))
    server, ended = BridgeServer({"port": 0, "root": root}, owns_process=True), asyncio.Event()
    for number in (signal.SIGTERM, signal.SIGUSR1):
        asyncio.get_running_loop().add_signal_handler(
            number, ended.set if number == signal.SIGTERM else lambda: begin(costs, of_frames)
        )
    async with server.listening():
        port_file.write_text(server.url)
        await ended.wait()
    costs_file.write_text(json.dumps({"cpu_s": time.process_time() - costs["begun"], "of_frames": of_frames}))


def begin(costs: dict[str, float], of_frames: list[float]) -> None:
    """Clear the times of the warm-up."""
    of_frames.clear()
    costs["begun"] = time.process_time()


@contextlib.contextmanager
def bridge(root: str) -> Iterator[tuple[str, subprocess.Popen[bytes], Path]]:
    port_file, costs_file = Path(root) / "url", Path(root) / "costs"
    words = [sys.executable, __file__, "--serve", str(port_file), str(costs_file), root]
    process = subprocess.Popen(words)
    try:
        while not port_file.exists() or not port_file.read_text():
            time.sleep(0.05)
        yield port_file.read_text(), process, costs_file
    finally:
        process.kill()
        process.wait()


def measured(n_objects: int, rate_hz: float, seconds: float, seed: int) -> dict[str, float]:
    """Measure one case, in which all objects move in each frame and both hands touch."""
    rng = np.random.default_rng(seed)
    scene = scene_of(n_objects)
    rest = np.array([[*item.pose.position_m, 0, 0, 0, 1] for item in scene.objects], np.float32)
    way = rng.uniform(-0.02, 0.02, (n_objects, 2)).astype(np.float32)
    with tempfile.TemporaryDirectory() as root:
        bake(scene).save(Path(root) / "b.bundle")
        with bridge(root) as (url, process, costs_file), Client(url) as client:
            client.play(bundle="b.bundle", moving=[item.id for item in scene.objects])
            took, n = [], round(seconds * rate_hz)
            n_warm = round(2 * rate_hz)
            begun = time.perf_counter()
            for i in range(n + n_warm):
                if i == n_warm:
                    process.send_signal(signal.SIGUSR1)
                poses = rest.copy()
                poses[1:, [0, 2]] += way[1:] * np.float32(np.sin(i / 20))
                felt = [Touch("left", "table", (0.2, 0.72, 1.6)), Touch("right", "table", (0.4, 0.72, 1.5))]
                message = client.frame(i + 1, i / rate_hz, poses, felt)
                sent = time.perf_counter()
                client.socket.send(message)
                while client.next_gains().sequence != i + 1:
                    pass
                took.append(time.perf_counter() - sent)
                time.sleep(max(0.0, begun + (i + 1) / rate_hz - time.perf_counter()))
            lasted = time.perf_counter() - begun - 2
            stats = client.ask("stats")
            process.send_signal(signal.SIGTERM)
            process.wait()
            noted = json.loads(costs_file.read_text())
    calls = np.array(noted["of_frames"][: 3 * n]).reshape(-1, 3)
    inside = calls.sum(axis=1)
    wire = np.array(took[n_warm:])[: len(inside)] - inside
    return {
        "p50": float(np.percentile(wire, 50)),
        "p99": float(np.percentile(wire, 99)),
        "worst": float(wire.max()),
        "bridge": (noted["cpu_s"] - sum(noted["of_frames"])) / lasted,
        "changes": float(calls[:, 0].sum()) / lasted,
        "session": float(calls[:, 1:].sum()) / lasted,
        "skipped": stats["frames"]["skipped"],
        "frames": stats["frames"]["received"],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--serve", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.serve:
        port_file, costs_file, root = arguments.serve
        asyncio.run(serve(Path(port_file), Path(costs_file), root))
        return
    print(f"Each case for {arguments.seconds:g} s; load {os.getloadavg()[0]:.1f} when it began.\n")
    columns = "objects", "frames/s", "wire p50 [ms]", "p99 [ms]", "worst [ms]", "bridge [% of a core]"
    print(f"| {' | '.join(columns)} | changed poses [%] | session [%] | skipped |")
    print("|---|---|---|---|---|---|---|---|---|")
    for n_objects, rate_hz in CASES:
        one = measured(n_objects, rate_hz, arguments.seconds, arguments.seed)
        times = " | ".join(f"{1e3 * one[name]:.2f}" for name in ("p50", "p99", "worst"))
        shares = " | ".join(f"{100 * one[name]:.1f}" for name in ("bridge", "changes", "session"))
        skipped = f"{one['skipped']:.0f} of {one['frames']:.0f}"
        print(f"| {n_objects} | {rate_hz:g} | {times} | {shares} | {skipped} |")


if __name__ == "__main__":
    main()
