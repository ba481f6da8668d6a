"""How long inference waits: calls in flight at once against the paper's order of one call after another.

    python benchmarks/inference_speed.py [--latency 0.25]

A loopback server answers every call after the same time with a valid answer, as `OpenAIBackend` would get it. The scene
has 44 objects, 7 of them vibrating, of 8 materials, with the usual repeats: 4 chairs and 6 handles. The paper's order
asks for each object alone: analysis, material, and description where it vibrates.

lower bound : the larger of the critical path (3 calls) and (1 + ceil((calls - 1) / lanes)) calls' time.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import math
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from scene2hap import (
    Box,
    DominantSurface,
    FunctionBackend,
    LLMRequest,
    OpenAIBackend,
    Pose,
    SceneObject,
    SceneSnapshot,
)
from scene2hap.llm.chain import infer_scene
from scene2hap.scene.snapshot import with_relative_heights

VIBRATING = ("fridge", "microwave", "washing machine", "fan", "phone", "kettle", "extractor hood")
MATERIALS = ("steel", "oak", "glass", "ceramic", "plastic", "concrete", "cotton", "copper")
SINGLES = ("floor", "table", "worktop", "shelf", "sofa", "lamp", "sink", "cabinet", "bin", "rug", "mirror", "plant")
SMALL = (
    "mug",
    "plate",
    "bowl",
    "spoon",
    "book",
    "vase",
    "tray",
    "jar",
    "pan",
    "pot",
    "knife",
    "towel",
    "box",
    "clock",
    "frame",
)


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--latency", type=float, default=0.25, help="time that the server takes per call [s]")
    latency_s = parser.parse_args().latency
    scene = kitchen()
    started = time.perf_counter()
    questions(scene)
    own_s = time.perf_counter() - started
    with answering(latency_s) as url:
        paper_s, paper_calls = one_after_another(scene, url)
        print(f"{len(scene.objects)} objects, {latency_s:g} s per call, {1e3 * own_s:.0f} ms of own work")
        print(f"{'order':<12} {'calls':>5} {'wall s':>8} {'bound s':>8} {'/ bound':>8} {'faster':>7} {'calls':>7}")
        print(f"{'paper':<12} {paper_calls:>5} {paper_s:>8.2f}")
        for lanes in (8, 16):
            wall_s, calls = in_parallel(scene, url, lanes)
            bound_s = latency_s * max(3, 1 + math.ceil((calls - 1) / lanes))
            print(
                f"{f'{lanes} lanes':<12} {calls:>5} {wall_s:>8.2f} {bound_s:>8.2f} {wall_s / bound_s:>8.2f} "
                f"{paper_s / wall_s:>6.1f}x {100 * calls / paper_calls:>6.0f}%"
            )


def kitchen() -> SceneSnapshot:
    """44 things on one floor, in one row."""
    names = [*SINGLES, *VIBRATING, *SMALL, *(f"chair_{i}" for i in range(4)), *(f"handle_{i}" for i in range(6))]
    objects = []
    for place, name in enumerate(names):
        size = (60.0, 0.1, 2.0) if name == "floor" else (0.4, 0.4, 0.4)
        pose = Pose((30.0, -0.05, 0.0)) if name == "floor" else Pose((1.0 * place, 0.2, 0.0))
        top = Pose((-size[0] / 2, 0.0, size[2] / 2), (-(0.5**0.5), 0.0, 0.0, 0.5**0.5))
        item = SceneObject(name, name, pose, Box(size), DominantSurface(top, size[0], size[2], size[1]))
        objects.append(replace(item, instance_key=name.split("_")[0] if "_" in name else ""))
    assert len(objects) == 44
    return SceneSnapshot("kitchen", "y", with_relative_heights(objects, "y"))


def in_parallel(scene: SceneSnapshot, url: str, lanes: int) -> tuple[float, int]:
    """Wall time [s] and number of calls of the chain."""
    started = time.perf_counter()
    found = asyncio.run(infer_scene(scene, OpenAIBackend(base_url=url, api_key="none"), config={"concurrency": lanes}))
    wall_s = time.perf_counter() - started
    assert not found.report.errors, found.report.errors
    return wall_s, sum(found.report.calls.values())


def one_after_another(scene: SceneSnapshot, url: str) -> tuple[float, int]:
    """Wall time [s] and number of calls of the same questions in the paper's order, nothing shared."""
    asked = questions(scene)
    of_scene = [request for request in asked if request.component == "scene_analyzer"]
    material = next(request for request in asked if request.component == "material_estimator")
    of_objects = [
        request
        for item in scene.objects
        for request in (*(one for one in asked if one.subject == item.id), replace(material, subject=item.id))
    ]

    async def run() -> None:
        backend = OpenAIBackend(base_url=url, api_key="none")
        for request in (*of_scene, *of_objects):
            await backend.complete(request)

    started = time.perf_counter()
    asyncio.run(run())
    return time.perf_counter() - started, len(of_scene) + len(of_objects)


def questions(scene: SceneSnapshot) -> list[LLMRequest]:
    """All that the chain asks if it shares nothing."""
    asked = []

    def at_once(request: LLMRequest) -> str:
        asked.append(request)
        return json.dumps(answer(request.component, request.prompt))

    asyncio.run(infer_scene(scene, FunctionBackend(at_once), config={"share_copies": False}))
    return asked


def answer(component: str, prompt: str) -> dict[str, Any]:
    """A valid answer, from what stands in the prompt."""
    if component == "scene_analyzer":
        return {"scene_category": "kitchen"}
    if component == "material_estimator":
        return {"density_kg_m3": 2000.0, "youngs_modulus_gpa": 20.0, "poisson_ratio": 0.3, "damping_ratio": 0.01}
    if component == "vibration_describer":
        return {"sentence": "It hums.", "keywords": "machine humming"}
    name = prompt.split("Authored object name: ")[1].split("\n")[0]
    vibrates = name in VIBRATING
    return {
        "object_category": name,
        "category_reason": "",
        "material_category": MATERIALS[sum(map(ord, name)) % len(MATERIALS)],
        "estimated_length_m": 0.4,
        "estimated_width_m": 0.4,
        "estimated_thickness_m": 0.4,
        "size_reason": "",
        "usage": "",
        "vibrates": vibrates,
        "vibration_reason": "",
        "states": [{"name": "on", "intensity": 0.3, "needs_contact": None}] if vibrates else [],
        "confidence": 1.0,
    }


@contextmanager
def answering(latency_s: float) -> Iterator[str]:
    """A server on this machine; its address."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            arrived = time.perf_counter()
            component = asked["response_format"]["json_schema"]["name"]
            content = asked["messages"][-1]["content"]
            prompt = content if isinstance(content, str) else "".join(part.get("text", "") for part in content)
            said = {"role": "assistant", "content": json.dumps(answer(component, prompt)), "refusal": None}
            body = json.dumps(
                {
                    "id": "x",
                    "object": "chat.completion",
                    "created": 0,
                    "model": asked["model"],
                    "choices": [{"index": 0, "message": said, "finish_reason": "stop", "logprobs": None}],
                    "usage": {"prompt_tokens": 1, "completion_tokens": 1, "total_tokens": 2},
                }
            ).encode()
            time.sleep(max(0.0, latency_s - (time.perf_counter() - arrived)))
            self.send_response(200)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None: ...

    class Server(ThreadingHTTPServer):
        request_queue_size = 64  # connections that may wait at once

    server = Server(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/v1"
    finally:
        server.shutdown()


if __name__ == "__main__":
    main()
