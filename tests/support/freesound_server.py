"""A loopback server that acts as freesound.org or as the host of its previews."""

from __future__ import annotations

import io
import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

import numpy as np
import soundfile

from server_thread import running

TOKEN = "fs-test-0123456789abcdefghij"
CC0 = "http://creativecommons.org/publicdomain/zero/1.0/"
BY = "http://creativecommons.org/licenses/by/4.0/"
BY_NC = "http://creativecommons.org/licenses/by-nc/3.0/"


@dataclass
class Page:
    """One reply. `manner` "hang" never replies, "drop" closes the connection, "drip" and "endless" send on and on."""

    body: Any = b""
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    manner: str = ""


@dataclass
class Get:
    path: str
    query: dict[str, str]
    headers: dict[str, str]


class Host:
    """`answer` is a list of pages, sent in order and then the last one repeatedly, or a function of the request."""

    def __init__(self, answer: list[Page] | Callable[[Get], Page]) -> None:
        self.answer = answer
        self.asked: list[Get] = []
        self.over = threading.Event()
        self.port = 0

    def page(self, get: Get) -> Page:
        self.asked.append(get)
        if callable(self.answer):
            return self.answer(get)
        return self.answer[min(len(self.asked), len(self.answer)) - 1]

    @property
    def tokens(self) -> list[str]:
        """The authorization header and token parameter of each request, joined."""
        return [get.headers.get("authorization", "") + get.query.get("token", "") for get in self.asked]


@contextmanager
def host(*pages: Page, by: Callable[[Get], Page] | None = None) -> Iterator[Host]:
    served = Host(by or list(pages))

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            parts = urlsplit(self.path)
            query = {name: values[0] for name, values in parse_qs(parts.query, keep_blank_values=True).items()}
            page = served.page(Get(parts.path, query, {k.lower(): v for k, v in self.headers.items()}))
            if page.manner in ("hang", "drop"):
                if page.manner == "hang":
                    served.over.wait(10)
                self.close_connection = True
                return
            raw = page.body if isinstance(page.body, bytes) else json.dumps(page.body).encode()
            self.send_response(page.status)
            length = {} if page.manner in ("drip", "endless") else {"content-length": str(len(raw))}
            for name, value in {**length, **page.headers}.items():
                self.send_header(name, value)
            self.end_headers()
            try:
                if page.manner == "drip":
                    while not served.over.wait(0.02):
                        self.wfile.write(b" ")
                elif page.manner == "endless":
                    while not served.over.is_set():
                        self.wfile.write(bytes(1 << 20))
                else:
                    self.wfile.write(raw)
            except OSError:
                pass  # the client has closed the connection
            if page.manner:
                self.close_connection = True

        def log_message(self, format: str, *args: Any) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as http, running(http):
        http.daemon_threads = True
        served.port = http.server_address[1]
        try:
            yield served
        finally:
            served.over.set()


def hum(seconds: float = 3.0, *, pitch_hz: float = 100.0, rate: int = 8000, kind: str = "OGG") -> bytes:
    """An encoded sound."""
    y = 0.4 * np.sin(2 * np.pi * pitch_hz * np.arange(round(seconds * rate)) / rate)
    encoded = io.BytesIO()
    soundfile.write(encoded, y, rate, format=kind, subtype={"OGG": "VORBIS", "WAV": "PCM_16"}[kind])
    return encoded.getvalue()


def result(number: int, preview: str, **changes: Any) -> dict[str, Any]:
    """One row of a search result."""
    return {
        "id": number,
        "name": f"hum {number}",
        "username": "ann",
        "license": CC0,
        "url": f"https://freesound.org/people/ann/sounds/{number}/",
        "duration": 3.0,
        "previews": {"preview-hq-ogg": preview, "preview-lq-mp3": f"{preview}.mp3"},
        **changes,
    }


def results(*rows: Any) -> Page:
    return Page({"count": len(rows), "next": None, "previous": None, "results": list(rows)})


def refused(status: int, detail: Any = "no", **headers: str) -> Page:
    return Page({"detail": detail}, status, {name.replace("_", "-"): value for name, value in headers.items()})
