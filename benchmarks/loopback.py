"""A model server on the loopback interface, and a scene for its requests."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from scene2hap import Box, DominantSurface, Pose, SceneObject, SceneSnapshot
from scene2hap.scene.objects import with_relative_heights

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


@dataclass(frozen=True)
class Answered:
    """A request as received, and the time at which its answer was sent [s, monotonic]."""

    question: bytes
    sent: float


@dataclass
class Server:
    """Address of the server, and its answered requests so far."""

    url: str = ""
    answered: list[Answered] = field(default_factory=list)


def kitchen() -> SceneSnapshot:
    """44 objects on one floor, in one row."""
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


def answer(component: str, prompt: str) -> dict[str, Any]:
    """A valid answer to a prompt."""
    if component == "scene_analyzer":
        return {"scene_category": "kitchen"}
    if component == "material_estimator":
        return {"density_kg_m3": 2000.0, "youngs_modulus_gpa": 20.0, "poisson_ratio": 0.3, "damping_ratio": 0.01}
    if component == "vibration_describer":
        category = prompt.split("Object: ")[1].split("\n")[0]
        return {"sentence": f"{category} hums.", "keywords": f"{category} humming"}
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
def answering(latency_s: float) -> Iterator[Server]:
    """Run a server that gives every call a valid answer of OpenAI's chat completions after `latency_s`."""
    state = Server()

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            question = self.rfile.read(int(self.headers["Content-Length"]))
            arrived = time.perf_counter()
            request = json.loads(question)
            component = request["response_format"]["json_schema"]["name"]
            content = request["messages"][-1]["content"]
            prompt = content if isinstance(content, str) else "".join(part.get("text", "") for part in content)
            said = {"role": "assistant", "content": json.dumps(answer(component, prompt)), "refusal": None}
            body = json.dumps(
                {
                    "id": "x",
                    "object": "chat.completion",
                    "created": 0,
                    "model": request["model"],
                    "choices": [{"index": 0, "message": said, "finish_reason": "stop", "logprobs": None}],
                    "usage": {"prompt_tokens": 1, "completion_tokens": 1, "total_tokens": 2},
                }
            ).encode()
            time.sleep(max(0.0, latency_s - (time.perf_counter() - arrived)))
            state.answered.append(Answered(question, time.monotonic()))
            self.send_response(200)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None: ...

    class HTTPServer(ThreadingHTTPServer):
        request_queue_size = 64  # connections that may wait at once

        def handle_error(self, *_: object) -> None:
            pass  # the client has closed the connection

    server = HTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        state.url = f"http://127.0.0.1:{server.server_port}/v1"
        yield state
    finally:
        server.shutdown()
