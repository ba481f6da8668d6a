"""A scripted loopback server of OpenAI's file and batch endpoints, after OpenAI's reference."""

from __future__ import annotations

import json
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from email.parser import BytesParser
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from llm_server import GOOD, Asked, Scripted, said
from scene2hap.llm.protocol import Component
from server_thread import running

FIELDS: dict[str, Component] = {
    "scene_category": "scene_analyzer",
    "vibrates": "object_analyzer",
    "density_kg_m3": "material_estimator",
    "keywords": "vibration_describer",
}


def answered(asked: Asked) -> Scripted:
    """The good answer to a request, chosen by the fields of its response schema."""
    schema = json.dumps(asked.body["response_format"])
    return said(GOOD[next(component for name, component in FIELDS.items() if f'"{name}"' in schema)])


@dataclass
class Batch:
    id: str
    input_file: str
    status: str = "in_progress"
    output_file: str = ""
    error_file: str = ""
    errors: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)

    def shown(self) -> dict[str, Any]:
        return {
            "id": self.id,
            "object": "batch",
            "endpoint": "/v1/chat/completions",
            "input_file_id": self.input_file,
            "status": self.status,
            "output_file_id": self.output_file or None,
            "error_file_id": self.error_file or None,
            "errors": {"object": "list", "data": [{"message": text} for text in self.errors]} if self.errors else None,
            "request_counts": self.counts,
        }


@dataclass
class Plan:
    """How the next batches end: their status, and the outcome of each request by its place in the file.

    The outcome is "answered", "expired", "cancelled", or a `Scripted` error reply.
    """

    status: str = "completed"
    each: Callable[[int, dict[str, Any]], str | Scripted] = lambda place, body: "answered"
    errors: tuple[str, ...] = ()


class BatchServer:
    """A store of files and batches that counts sent and answered requests; each of `faults` spoils one request."""

    def __init__(self, by: Callable[[Asked], Scripted]) -> None:
        self.by = by
        self.files: dict[str, bytes] = {}
        self.batches: dict[str, Batch] = {}
        self.sent: Counter[str] = Counter()
        self.answered: Counter[str] = Counter()
        self.bodies: dict[str, dict[str, Any]] = {}
        self.faults: list[tuple[str, str]] = []
        self.log: list[str] = []
        self.live: list[Asked] = []
        self.base_url = ""

    # -- calls of tests ---------------------------------------------------------------------------------------------

    def end(self, plan: Plan | None = None) -> None:
        """End all batches that are still running."""
        plan = plan or Plan()
        for batch in self.batches.values():
            if batch.status in ("in_progress", "cancelling"):
                self._end(batch, plan)

    def _end(self, batch: Batch, plan: Plan) -> None:
        output, errors = [], []
        for place, row in enumerate(map(json.loads, self.files[batch.input_file].splitlines())):
            key, body = row["custom_id"], row["body"]
            becomes = "failed" if plan.errors else plan.each(place, body)
            if becomes == "answered":
                reply = self.by(Asked("/v1/chat/completions", {}, body))
                self.answered[key] += 1
                response = {"status_code": 200, "request_id": "r", "body": reply.body}
                output.append({"id": f"b{place}", "custom_id": key, "response": response, "error": None})
            elif isinstance(becomes, Scripted):
                response = {"status_code": becomes.status, "request_id": "r", "body": becomes.body}
                errors.append({"id": f"b{place}", "custom_id": key, "response": response, "error": None})
            elif becomes in ("expired", "cancelled"):
                error = {"code": f"batch_{becomes}", "message": "This request was not run in time."}
                errors.append({"id": f"b{place}", "custom_id": key, "response": None, "error": error})
        batch.status, batch.errors = plan.status, list(plan.errors)
        batch.counts = {"total": len(output) + len(errors), "completed": len(output), "failed": len(errors)}
        # In reverse order, since the service promises no order.
        if output:
            batch.output_file = self._store(_jsonl(output[::-1]))
        if errors:
            batch.error_file = self._store(_jsonl(errors[::-1]))

    def _store(self, content: bytes) -> str:
        name = f"file-{len(self.files) + 1}"
        self.files[name] = content
        return name

    # -- replies to requests ------------------------------------------------------------------------------------------

    def posted(self, path: str, content: bytes, headers: dict[str, str]) -> tuple[int, Any]:
        if path == "/v1/files":
            form: Any = BytesParser().parsebytes(f"content-type: {headers['content-type']}\n\n".encode() + content)
            parts = {part.get_param("name", header="content-disposition"): part for part in form.get_payload()}
            assert parts["purpose"].get_payload() == "batch"
            return 200, {"id": self._store(parts["file"].get_payload(decode=True)), "object": "file"}
        body = json.loads(content)
        if path == "/v1/batches":
            assert body["endpoint"] == "/v1/chat/completions"
            assert body["completion_window"] == "24h"
            batch = Batch(f"batch_{len(self.batches) + 1}", body["input_file_id"])
            self.batches[batch.id] = batch
            for row in map(json.loads, self.files[batch.input_file].splitlines()):
                assert (row["method"], row["url"]) == ("POST", "/v1/chat/completions")
                self.sent[row["custom_id"]] += 1
                self.bodies[row["custom_id"]] = row["body"]
            return 200, batch.shown()
        if path.endswith("/cancel"):
            batch = self.batches[path.split("/")[-2]]
            batch.status = "cancelling"
            return 200, batch.shown()
        asked = Asked(path, headers, body)
        self.live.append(asked)
        return 200, self.by(asked).body

    def got(self, path: str) -> tuple[int, Any]:
        path, _, query = path.partition("?")
        if path == "/v1/batches":
            after = dict(part.split("=") for part in query.split("&")).get("after")
            shown = [batch.shown() for batch in reversed(self.batches.values())]
            begin = 1 + [row["id"] for row in shown].index(after) if after else 0
            # One batch a page, so that every test reads several pages.
            return 200, {"object": "list", "data": shown[begin : begin + 1], "has_more": begin + 1 < len(shown)}
        if path.startswith("/v1/batches/"):
            return 200, self.batches[path.rpartition("/")[2]].shown()
        if path.endswith("/content"):
            return 200, self.files[path.split("/")[-2]]
        return 404, {"error": {"message": "no such page"}}


def _jsonl(rows: list[dict[str, Any]]) -> bytes:
    return b"".join(json.dumps(row).encode() + b"\n" for row in rows)


@contextmanager
def serving_batches(by: Callable[[Asked], Scripted] = answered) -> Iterator[BatchServer]:
    server = BatchServer(by)
    turn = threading.Lock()

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            content = self.rfile.read(int(self.headers["content-length"]))
            headers = {name.lower(): value for name, value in self.headers.items()}
            self._answer(lambda: server.posted(self.path, content, headers))

        def do_GET(self) -> None:
            self._answer(lambda: server.got(self.path))

        def _answer(self, make: Callable[[], tuple[int, Any]]) -> None:
            with turn:
                server.log.append(f"{self.command} {self.path.partition('?')[0]}")
                fault = next((fault for fault in server.faults if fault[0] == server.log[-1]), None)
                if fault is not None:
                    server.faults.remove(fault)
                status, body = (500, {"error": "no"}) if fault and fault[1] == "refuses" else make()
            if fault is not None and fault[1] == "loses the answer":
                self.close_connection = True
                return
            raw = body if isinstance(body, bytes) else json.dumps(body).encode()
            self.send_response(status)
            self.send_header("content-length", str(len(raw)))
            self.end_headers()
            self.wfile.write(raw)

        def log_message(self, format: str, *args: Any) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as http, running(http):
        server.base_url = f"http://127.0.0.1:{http.server_address[1]}"
        yield server
