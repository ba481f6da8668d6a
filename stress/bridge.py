"""Send random and mutated messages to a bridge, and check that it keeps running, answers, and uses no more memory.

    python stress/bridge.py [--messages 100000] [--seed 0]

Half of the messages are JSON texts with changed characters; the others are frames with changed bytes, truncated frames
and noise. A second client plays at the same time and must get its gains. The bridge runs in its own process; its memory
is read before and after.
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from websockets.exceptions import ConnectionClosed

from bridge_client import Client
from mutated_messages import ON_TABLE, mutated
from scene2hap import Box, Pose, SceneObject, SceneSnapshot, bake
from stress.process_use import memory_mb

NO_POSES = np.empty((0, 7), np.float32)


def joined(url: str) -> Client:
    client = Client(url)
    client.play(bundle="desk.bundle", moving=["phone"])
    return client


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--messages", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    boxes = {
        "table": ("Wooden table", (0.0, 0.7, 0.0), (1.2, 0.04, 0.7)),
        "phone": ("Smartphone", (0.2, 0.724, 0.0), (0.07, 0.008, 0.15)),
        "mug": ("Coffee mug", (-0.3, 0.765, 0.0), (0.08, 0.09, 0.08)),
    }
    scene = SceneSnapshot.build(
        [SceneObject(key, name, pose=Pose(at), geometry=Box(size)) for key, (name, at, size) in boxes.items()]
    )
    with tempfile.TemporaryDirectory() as root:
        bake(scene).save(Path(root) / "desk.bundle")
        words = [sys.executable, "-u", "-m", "scene2hap", "bridge", "--port", "0", "--root", root]
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert process.stdout is not None
        url = process.stdout.readline().split()[0]
        heard: Counter[str] = Counter()
        with Client(url) as honest:
            honest.play(bundle="desk.bundle", moving=[])
            client, reconnected, late_ms = joined(url), 0, []
            before_mb = 0.0
            for turn in range(arguments.messages):
                if turn == arguments.messages // 10:
                    before_mb = memory_mb(process.pid)  # buffers and caches are warm
                try:
                    client.socket.send(mutated(client, rng))
                    if turn % 20 == 0:  # the server drops a client that does not read
                        client.ask("stats")
                        heard.update(one["type"] for one in client.heard)
                        client.heard.clear()
                        client.gains.clear()
                except ConnectionClosed:
                    client, reconnected = joined(url), reconnected + 1
                if turn % 50 == 0:
                    sent = time.perf_counter()
                    honest.socket.send(honest.frame(turn + 1, float(turn), NO_POSES, [ON_TABLE]))
                    assert honest.next_gains().gains.max() > 0.0
                    late_ms.append(1e3 * (time.perf_counter() - sent))
            after_mb = memory_mb(process.pid)
            assert process.poll() is None
        process.terminate()
        _, errors = process.communicate(timeout=30)
    assert process.returncode == 0, errors
    assert "Traceback" not in errors, errors
    print(
        f"{arguments.messages:,} messages, seed {arguments.seed}: {heard['error']:,} error replies, "
        f"{reconnected} connections closed by the bridge, no exception. Memory {before_mb:.0f} MB after a tenth, "
        f"{after_mb:.0f} MB at the end. The other client had its gains within {np.median(late_ms):.1f} ms in the "
        f"median, {max(late_ms):.0f} ms at most."
    )


if __name__ == "__main__":
    main()
