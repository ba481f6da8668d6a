"""A scripted HTTP server on the loopback interface that plays a model's server."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from scene2hap.llm.protocol import Component, LLMRequest
from scene2hap.llm.validation import ANSWERS

KEY = "sk-test-0123456789abcdefghij"
PNG = b"\x89PNG\r\n\x1a\n0"

GOOD: dict[str, dict[str, Any]] = {
    "scene_analyzer": {"scene_category": "kitchen"},
    "material_estimator": {
        "density_kg_m3": 700.0,
        "youngs_modulus_gpa": 11.0,
        "poisson_ratio": 0.3,
        "loss_factor": 0.01,
    },
}


def request(component: Component = "scene_analyzer", **changes: Any) -> LLMRequest:
    fields = {
        "subject": "",
        "prompt": "What kind of place is this?",
        "facts": {"scene_name": "a"},
        "answer_schema": ANSWERS[component].model_json_schema(),
        "prompt_version": "1",
    }
    return LLMRequest(component=component, **{**fields, **changes})


@dataclass
class Scripted:
    """One reply: JSON or raw bytes; or silence until the test is over; or a connection that is dropped."""

    body: Any = None
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    hang: bool = False
    drop: bool = False


@dataclass
class Asked:
    path: str
    headers: dict[str, str]
    body: dict[str, Any]


class Server:
    """Plays `script` in order, then its last line again; or asks it, where it is a function of what was asked."""

    def __init__(self, script: list[Scripted] | Callable[[Asked], Scripted]) -> None:
        self.script = script
        self.asked: list[Asked] = []
        self.over = threading.Event()
        self.base_url = ""

    @property
    def bodies(self) -> list[dict[str, Any]]:
        return [asked.body for asked in self.asked]

    def answer(self, asked: Asked) -> Scripted:
        self.asked.append(asked)
        if callable(self.script):
            return self.script(asked)
        return self.script[min(len(self.asked), len(self.script)) - 1]


@contextmanager
def serving(*script: Scripted, by: Callable[[Asked], Scripted] | None = None) -> Iterator[Server]:
    server = Server(by or list(script))

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            content = self.rfile.read(int(self.headers["content-length"]))
            headers = {name.lower(): value for name, value in self.headers.items()}
            reply = server.answer(Asked(self.path, headers, json.loads(content)))
            if reply.hang:
                server.over.wait(10)
            if reply.hang or reply.drop:
                self.close_connection = True
                return
            raw = reply.body if isinstance(reply.body, bytes) else json.dumps(reply.body).encode()
            self.send_response(reply.status)
            for name, value in {"content-length": str(len(raw)), **reply.headers}.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(raw)

        def log_message(self, format: str, *args: Any) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as http:
        thread = threading.Thread(target=http.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        server.base_url = f"http://127.0.0.1:{http.server_address[1]}"
        try:
            yield server
        finally:
            server.over.set()
            http.shutdown()
            thread.join()


def said(content: Any = GOOD["scene_analyzer"], finish_reason: str | None = "stop", **message: Any) -> Scripted:
    """A chat completion."""
    text = content if content is None or isinstance(content, str) else json.dumps(content)
    return Scripted(
        {
            "id": "chatcmpl-1",
            "object": "chat.completion",
            "model": "gpt-4o-2024-08-06",
            "choices": [
                {
                    "index": 0,
                    "finish_reason": finish_reason,
                    "message": {"role": "assistant", "content": text, **message},
                }
            ],
            "usage": {
                "prompt_tokens": 1000,
                "completion_tokens": 20,
                "total_tokens": 1020,
                "prompt_tokens_details": {"cached_tokens": 0},
            },
        }
    )


def ollama_said(content: Any = GOOD["scene_analyzer"], **changes: Any) -> Scripted:
    """A reply of Ollama's native chat."""
    text = content if isinstance(content, str) else json.dumps(content)
    body = {
        "model": "qwen2.5vl",
        "message": {"role": "assistant", "content": text},
        "done": True,
        "done_reason": "stop",
        "prompt_eval_count": 5000,
        "eval_count": 20,
    }
    return Scripted({**body, **changes})


def refused(status: int, error: Any = "no", **headers: str) -> Scripted:
    """An error as servers send them; underscores in header names stand for hyphens."""
    return Scripted({"error": error}, status, {name.replace("_", "-"): value for name, value in headers.items()})
