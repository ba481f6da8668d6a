"""The server of a report page: it serves one page, accepts corrections from it, and refuses other requests."""

from __future__ import annotations

import json
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest

from scene2hap.errors import ConfigError
from scene2hap.report.serve import MAX_BYTES, ReportServer

GOOD = {"format": "scene2hap/overrides", "version": 1, "overrides": {"fridge": {"gain_db": -3.0}}}


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ReportServer]:
    found = ReportServer("<p>page</p>", tmp_path / "corrections.json")
    thread = threading.Thread(target=found.serve)
    thread.start()
    yield found
    found.close()
    thread.join()


def ask(server: ReportServer, path: str, body: bytes | None = None, **headers: str) -> tuple[int, bytes]:
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    request = urllib.request.Request(server.address.rstrip("/") + path, data=body, headers=headers)
    try:
        with opener.open(request, timeout=10) as reply:
            return reply.status, reply.read()
    except urllib.error.HTTPError as problem:
        with problem:
            return problem.code, problem.read()


def test_server_serves_only_the_page(server: ReportServer) -> None:
    assert ask(server, "/") == (200, b"<p>page</p>")
    assert ask(server, "/etc/passwd")[0] == 404
    assert ask(server, "/../../etc/passwd")[0] == 404


def test_corrections_are_written_whole(server: ReportServer, tmp_path: Path) -> None:
    own = server.address.rstrip("/")
    assert ask(server, "/overrides", json.dumps(GOOD).encode(), origin=own)[0] == 200
    assert json.loads((tmp_path / "corrections.json").read_text()) == GOOD


@pytest.mark.parametrize(
    "body", [b"", b"{", b"[]", b"\xff", b'{"format": "scene2hap/overrides"}', b"[" * 100_000, b"1" * 10_000]
)
def test_invalid_correction_is_refused_and_the_earlier_file_kept(
    body: bytes, server: ReportServer, tmp_path: Path
) -> None:
    (tmp_path / "corrections.json").write_text("earlier")
    assert ask(server, "/overrides", body)[0] == 400
    assert (tmp_path / "corrections.json").read_text() == "earlier"


def test_other_pages_and_names_are_refused(server: ReportServer, tmp_path: Path) -> None:
    good = json.dumps(GOOD).encode()
    assert ask(server, "/overrides", good, origin="https://evil.example")[0] == 404
    assert ask(server, "/overrides", good, host="evil.example")[0] == 404
    assert ask(server, "/", host="evil.example")[0] == 404
    assert ask(server, "/elsewhere", good)[0] == 404
    assert ask(server, "/overrides", b" " * (MAX_BYTES + 1))[0] == 413
    assert not (tmp_path / "corrections.json").exists()


def test_port_in_use_is_reported(server: ReportServer, tmp_path: Path) -> None:
    port = int(server.address.rstrip("/").rpartition(":")[2])
    with pytest.raises(ConfigError, match=f"port {port} cannot be used"):
        ReportServer("", tmp_path / "c.json", port)


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_port_that_no_machine_has_is_refused(tmp_path: Path, port: int) -> None:
    with pytest.raises(ConfigError, match=f"port is {port}"):
        ReportServer("<p>page</p>", tmp_path / "corrections.json", port)
