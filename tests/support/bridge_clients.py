"""Shared by the tests of bridge clients in other languages."""

from __future__ import annotations

import re
import socket
import subprocess
import sys
import time
from pathlib import Path

ORDER = {
    "session": "s",
    "key": "00112233445566ff",
    "layout": 1,
    "objects": ["phone", "table"],
    "n_moving": 1,
    "hands": ["left", "right"],
    "sources": [{"id": "phone", "state": "on", "states": ["on"], "is_on": True, "frequency_hz": 100.0}],
    "n_bands": 1,
    "sequence": 0,
    "watchdog_s": 0.5,
}
"""The order of a scripted server."""

_PAGE = Path(__file__).parents[2] / "docs" / "bridge-protocol.md"


def hex_of_page(before: str) -> str:
    """The hexadecimal block that follows a sentence on the protocol page."""
    found = re.search(re.escape(before) + r".*?```\n(.*?)```", _PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert found
    return re.sub(r"\s", "", found[1])


def start_server(port: int) -> subprocess.Popen[bytes]:
    """Start a bridge process and wait until it listens."""
    process = subprocess.Popen(
        [sys.executable, "-m", "scene2hap", "bridge", "--port", str(port)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    for _ in range(2400):
        with socket.socket() as trial:
            if not trial.connect_ex(("127.0.0.1", port)):
                return process
        time.sleep(0.05)
    process.kill()
    raise AssertionError("the bridge does not listen")
