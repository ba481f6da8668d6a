"""Waiting time of inference: concurrent calls compared with sequential calls in the paper's order.

    python benchmarks/inference_speed.py [--latency 0.25]

A loopback server gives every call of `OpenAIBackend` a valid answer after the same time. The scene has 44 objects, 7 of
them vibrating, of 8 materials, with the usual copies: 4 chairs and 6 handles. In the paper's order each object has its
own calls: analysis, material, and description if it vibrates.

lower bound : the larger of the critical path (3 calls) and the time of (1 + ceil((calls - 1) / concurrency)) calls.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import math
import time
from dataclasses import replace

from loopback import answer, answering, kitchen

from scene2hap import (
    FunctionBackend,
    LLMRequest,
    OpenAIBackend,
    SceneSnapshot,
)
from scene2hap.llm.chain import infer_scene


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--latency", type=float, default=0.25, help="time that the server takes per call [s]")
    latency_s = parser.parse_args().latency
    scene = kitchen()
    started = time.perf_counter()
    all_requests(scene)
    own_s = time.perf_counter() - started
    with answering(latency_s) as server:
        paper_s, paper_calls = one_after_another(scene, server.url)
        print(f"{len(scene.objects)} objects, {latency_s:g} s per call, {1e3 * own_s:.0f} ms of own work")
        print(f"{'order':<12} {'calls':>5} {'wall s':>8} {'bound s':>8} {'/ bound':>8} {'faster':>7} {'calls':>7}")
        print(f"{'paper':<12} {paper_calls:>5} {paper_s:>8.2f}")
        for concurrency in (8, 16):
            wall_s, calls = in_parallel(scene, server.url, concurrency)
            bound_s = latency_s * max(3, 1 + math.ceil((calls - 1) / concurrency))
            print(
                f"{f'{concurrency} at once':<12} {calls:>5} {wall_s:>8.2f} {bound_s:>8.2f} {wall_s / bound_s:>8.2f} "
                f"{paper_s / wall_s:>6.1f}x {100 * calls / paper_calls:>6.0f}%"
            )


def in_parallel(scene: SceneSnapshot, url: str, concurrency: int) -> tuple[float, int]:
    """Run the chain. Returns wall time [s] and number of calls."""
    started = time.perf_counter()
    found = asyncio.run(
        infer_scene(scene, OpenAIBackend(base_url=url, api_key="none"), config={"concurrency": concurrency})
    )
    wall_s = time.perf_counter() - started
    assert not found.report.errors, found.report.errors
    return wall_s, sum(found.report.calls.values())


def one_after_another(scene: SceneSnapshot, url: str) -> tuple[float, int]:
    """Send the calls in the paper's order, without sharing. Returns wall time [s] and number of calls."""
    requests = all_requests(scene)
    of_scene = [request for request in requests if request.component == "scene_analyzer"]
    material = next(request for request in requests if request.component == "material_estimator")
    of_objects = [
        request
        for item in scene.objects
        for request in (*(one for one in requests if one.subject == item.id), replace(material, subject=item.id))
    ]

    async def run() -> None:
        backend = OpenAIBackend(base_url=url, api_key="none")
        for request in (*of_scene, *of_objects):
            await backend.complete(request)

    started = time.perf_counter()
    asyncio.run(run())
    return time.perf_counter() - started, len(of_scene) + len(of_objects)


def all_requests(scene: SceneSnapshot) -> list[LLMRequest]:
    """All calls of the chain without sharing."""
    requests = []

    def at_once(request: LLMRequest) -> str:
        requests.append(request)
        return json.dumps(answer(request.component, request.prompt))

    asyncio.run(infer_scene(scene, FunctionBackend(at_once), config={"share_copies": False}))
    return requests


if __name__ == "__main__":
    main()
