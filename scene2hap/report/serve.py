"""A server for a report page on the loopback interface, which writes the corrections that the page saves."""

from __future__ import annotations

import json
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from scene2hap.bundle.corrections import parsed_corrections
from scene2hap.common import checks
from scene2hap.common.files import write_whole
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import ConfigError, Scene2HapError

MAX_BYTES = 1 << 20
"""Most bytes of one file of corrections; assumed: corrections of some thousand objects."""
_HOST = "127.0.0.1"


class ReportServer:
    """Serve one page, and write its corrections.

    Parameters: page : HTML; corrections : the file to write; port : 0 for a free one; saved : called with the file
    after each save. Raises: ConfigError: the port is taken.
    """

    def __init__(
        self, page: str, corrections: Path, port: int = 0, saved: Callable[[Path], object] = lambda path: None
    ) -> None:
        content, own = page.encode(), self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                if not self._is_own_request() or self.path not in ("/", "/index.html"):
                    self._answer(404, b"There is only one page, at /.")
                    return
                self._answer(200, content, "text/html; charset=utf-8")

            def do_POST(self) -> None:
                length = self.headers.get("content-length", "")
                if not self._is_own_request() or self.path != "/overrides":
                    self._answer(404, b"Corrections are posted to /overrides, by the page itself.")
                elif not length.isdecimal() or int(length) > MAX_BYTES:
                    # Read a bounded part of the body, since a browser reads no answer while it still writes.
                    self.rfile.read(min(int(length), 8 * MAX_BYTES) if length.isdecimal() else 0)
                    self._answer(413, b"A file of corrections has at most a megabyte.")
                else:
                    self._keep(self.rfile.read(int(length)))

            def _keep(self, posted: bytes) -> None:
                try:
                    document = parse_json(posted)
                    parsed_corrections(document, "the page")
                    write_whole(corrections, json.dumps(document, indent=1))
                except (ValueError, RecursionError, OSError, Scene2HapError) as problem:
                    self._answer(400, str(problem).encode("utf-8", "replace"))
                    return
                saved(corrections)
                self._answer(200, json.dumps({"file": corrections.name}).encode(), "application/json")

            def _is_own_request(self) -> bool:
                """Return True if a request names this server and comes from its own page: others can reach it too."""
                here = {f"{name}:{own.port}" for name in (_HOST, "localhost")}
                origin = self.headers.get("origin")
                is_own = origin is None or origin.removeprefix("http://") in here
                return is_own and self.headers.get("host", "") in here

            def _answer(self, status: int, body: bytes, kind: str = "text/plain; charset=utf-8") -> None:
                self.send_response(status)
                self.send_header("content-type", kind)
                self.send_header("content-length", str(len(body)))
                self.send_header("x-content-type-options", "nosniff")
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, format: str, *args: object) -> None:
                pass

        checks.number("port", port, "-", at_least=0, at_most=65535, error=ConfigError)
        try:
            self._http = ThreadingHTTPServer((_HOST, port), Handler)
        except OSError as cause:
            raise ConfigError(
                f"port {port} cannot be used: {cause.strerror}. Name another, or 0 for a free one."
            ) from cause

    @property
    def port(self) -> int:
        """The port of the server."""
        return int(self._http.server_port)

    @property
    def address(self) -> str:
        """The address of the page."""
        return f"http://{_HOST}:{self.port}/"

    def serve(self) -> None:
        """Answer requests until `close`, or an interrupt."""
        self._http.serve_forever(poll_interval=0.1)

    def close(self) -> None:
        """Stop the server."""
        self._http.shutdown()
        self._http.server_close()
