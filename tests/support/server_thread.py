"""Servers of tests, each in a thread of its own."""

from __future__ import annotations

import socketserver
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def running(server: Any) -> Iterator[None]:
    """Run `serve_forever` of a server until the block ends, which takes 10 ms."""
    quick = {"poll_interval": 0.01} if isinstance(server, socketserver.BaseServer) else {}
    thread = threading.Thread(target=server.serve_forever, kwargs=quick)
    thread.start()
    try:
        yield
    finally:
        server.shutdown()
        thread.join()
