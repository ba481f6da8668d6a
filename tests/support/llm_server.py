"""A scripted HTTP server on the loopback interface that acts as an LLM server."""

from __future__ import annotations

import json
import socket
import struct
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from scene2hap.llm.protocol import Component, LLMRequest
from scene2hap.llm.validation import ANSWERS
from server_thread import running

KEY = "sk-test-0123456789abcdefghij"
PNG = b"\x89PNG\r\n\x1a\n0"

GOOD: dict[Component, dict[str, Any]] = {
    "scene_analyzer": {"scene_category": "kitchen"},
    "object_analyzer": {
        "object_category": "fridge",
        "category_reason": "Its name says so.",
        "material_category": "steel",
        "estimated_length_m": 0.7,
        "estimated_width_m": 0.7,
        "estimated_thickness_m": 1.8,
        "size_reason": "As measured.",
        "usage": "keeps food cold",
        "vibrates": True,
        "vibration_reason": "Its compressor runs.",
        "states": [{"name": "cooling", "intensity": 0.4, "needs_contact": None}],
        "confidence": 0.9,
        "estimated_mass_kg": 75.0,
        "feet_material": "hard plastic",
    },
    "material_estimator": {
        "density_kg_m3": 700.0,
        "youngs_modulus_gpa": 11.0,
        "poisson_ratio": 0.3,
        "damping_ratio": 0.005,
    },
    "vibration_describer": {
        "sentence": "A fridge compressor hums evenly.",
        "keywords": "fridge hum",
        "start_up_s": 0.5,
        "wind_down_s": 0.8,
        "spins": True,
        "on_s": None,
        "off_s": None,
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
    """One reply: JSON or raw bytes, at once or spread over `drip_s`. With `hang`, no reply comes; with `drop` or
    `reset`, the connection ends. `claims` names the OpenAI schema that the body follows."""

    body: Any = None
    status: int = 200
    headers: Mapping[str, str] = field(default_factory=dict)
    hang: bool = False
    drop: bool = False
    reset: bool = False
    drip_s: float = 0.0
    claims: str = ""

    @property
    def raw(self) -> bytes:
        return self.body if isinstance(self.body, bytes) else json.dumps(self.body).encode()


@dataclass
class Asked:
    path: str
    headers: dict[str, str]
    body: dict[str, Any]

    @property
    def prompt(self) -> str:
        content = self.body["messages"][0]["content"]
        return str(content if isinstance(content, str) else content[0]["text"])


class Server:
    """Send the replies of `script` in order, then the last one repeatedly; or call `script` with each request.

    `pages` are the replies to GET, by path.
    """

    def __init__(
        self, script: list[Scripted] | Callable[[Asked], Scripted], pages: Mapping[str, Scripted] | None = None
    ) -> None:
        self.script = script
        self.pages: Mapping[str, Scripted] = pages or {}
        self.asked: list[Asked] = []
        self.answered: list[Scripted] = []
        self.got: list[str] = []
        self.over = threading.Event()
        self.base_url = ""

    @property
    def bodies(self) -> list[dict[str, Any]]:
        return [asked.body for asked in self.asked]

    def answer(self, asked: Asked) -> Scripted:
        self.asked.append(asked)
        scripted = self.script
        reply = scripted(asked) if callable(scripted) else scripted[min(len(self.asked), len(scripted)) - 1]
        self.answered.append(reply)
        return reply


@contextmanager
def serving(
    *script: Scripted,
    by: Callable[[Asked], Scripted] | None = None,
    pages: Mapping[str, Scripted] | None = None,
) -> Iterator[Server]:
    server = Server(by or list(script), pages)

    class Handler(_Handler):
        playing = server

    with _HTTPServer(("127.0.0.1", 0), Handler) as http, running(http):
        server.base_url = f"http://127.0.0.1:{http.server_address[1]}"
        try:
            yield server
        finally:
            server.over.set()


class _HTTPServer(ThreadingHTTPServer):
    request_queue_size = 64

    def handle_error(self, request: Any, client_address: Any) -> None:
        pass  # tests let clients hang up


class _Handler(BaseHTTPRequestHandler):
    playing: Server

    def do_POST(self) -> None:
        content = self.rfile.read(int(self.headers["content-length"]))
        headers = {name.lower(): value for name, value in self.headers.items()}
        self._play(self.playing.answer(Asked(self.path, headers, json.loads(content))))

    def do_GET(self) -> None:
        self.playing.got.append(self.path)
        self._play(self.playing.pages.get(self.path, Scripted({"error": "no such page"}, 404)))

    def _play(self, reply: Scripted) -> None:
        if reply.hang:
            self.playing.over.wait(10)
        if reply.reset:  # a socket closed with linger 0 sends RST
            self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            self.connection.close()
        if reply.hang or reply.drop or reply.reset:
            self.close_connection = True
            return
        self.send_response(reply.status)
        for name, value in {"content-length": str(len(reply.raw)), **reply.headers}.items():
            self.send_header(name, value)
        self.end_headers()
        for piece in _pieces(reply):
            self.wfile.write(piece)
            if reply.drip_s and self.playing.over.wait(reply.drip_s / len(reply.raw)):
                return

    def log_message(self, format: str, *args: Any) -> None:
        pass


def _pieces(reply: Scripted) -> list[bytes]:
    return [bytes([byte]) for byte in reply.raw] if reply.drip_s else [reply.raw]


def said(content: Any = GOOD["scene_analyzer"], finish_reason: str | None = "stop", **message: Any) -> Scripted:
    """A chat completion."""
    text = content if content is None or isinstance(content, str) else json.dumps(content)
    choice = {
        "index": 0,
        "finish_reason": finish_reason,
        "logprobs": None,
        "message": {"role": "assistant", "content": text, "refusal": None, **message},
    }
    usage = {
        "prompt_tokens": 1000,
        "completion_tokens": 20,
        "total_tokens": 1020,
        "prompt_tokens_details": {"cached_tokens": 0},
    }
    body = {
        "id": "chatcmpl-1",
        "object": "chat.completion",
        "created": 1_795_000_000,
        "model": "gpt-4o-2024-08-06",
        "choices": [choice],
        "usage": usage,
    }
    return Scripted(body, claims="CreateChatCompletionResponse")


def ollama_said(content: Any = GOOD["scene_analyzer"], **changes: Any) -> Scripted:
    """A reply in the format of Ollama's native chat."""
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
    """An error as OpenAI sends it, or a bare text as others send; underscores in header names stand for hyphens."""
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    if not isinstance(error, dict):
        return Scripted({"error": error}, status, named)
    whole = {"message": "no", "type": "invalid_request_error", "param": None, "code": None, **error}
    return Scripted({"error": whole}, status, named, claims="ErrorResponse")
