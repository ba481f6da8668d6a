"""HTTP replies are limited in bytes and seconds, compressed or not, for every use of HTTP."""

import asyncio
import gzip
import logging
import socket
import threading
import traceback
import tracemalloc
import zlib
from collections.abc import AsyncIterator

import httpx
import pytest

from llm_server import KEY, Scripted, serving
from scene2hap.common import web
from scene2hap.common.secret import Secret
from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable
from scene2hap.llm.backends import http_client
from scene2hap.llm.backends.http_client import Endpoint

LIMITS = web.Limits(5.0, 1 << 20)


class Endless(httpx.AsyncByteStream):
    def __init__(self, chunk: bytes, pause_s: float = 0.0) -> None:
        self.chunk, self.pause_s, self.n_sent = chunk, pause_s, 0

    async def __aiter__(self) -> AsyncIterator[bytes]:
        while True:
            self.n_sent += len(self.chunk)
            yield self.chunk
            await asyncio.sleep(self.pause_s)


def answering(response: httpx.Response) -> httpx.MockTransport:
    return httpx.MockTransport(lambda _: response)


def asked(response: httpx.Response, limits: web.Limits = LIMITS) -> web.WebReply:
    return web.get("https://a.example/", limits, transport=answering(response))


def posted(response: httpx.Response, timeout_s: float = 5.0) -> WebReply:
    endpoint = Endpoint("https://model.example/v1", Secret(KEY), timeout_s, answering(response))
    return asyncio.run(endpoint.post("chat", {}))


def bomb() -> bytes:
    """Zeros, 1 GiB unpacked. Without the check sum at the end, which no reader may reach."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    first, other = (packer.compress(bytes(1 << 20)) + packer.flush(zlib.Z_FULL_FLUSH) for _ in range(2))
    return first + 1023 * other  # after a full flush equal data is packed into equal bytes


def test_only_encrypted_and_local_addresses_are_safe() -> None:
    safe = ["https://a.example/v1", "http://localhost:8080", "http://127.0.0.1/", "http://[::1]:7862/"]
    unsafe = ["http://a.example", "http://localhost.a.example", "http://127.0.0.1.a.example", "https://me@a.example"]
    assert [url for url in (*safe, *unsafe, "ftp://a.example", "https://", "http://[") if web.is_safe(url)] == safe


def test_only_a_status_of_success_is_ok() -> None:
    assert [status for status in (199, 200, 204, 299, 300) if WebReply("", status, b"").ok] == [200, 204, 299]


def redirecting(target: str) -> httpx.MockTransport:
    def answer(request: httpx.Request) -> httpx.Response:
        is_there = request.url == httpx.URL(target)
        return httpx.Response(200, content=b"there") if is_there else httpx.Response(302, headers={"location": target})

    return httpx.MockTransport(answer)


def test_redirects_are_followed_to_safe_addresses_and_never_with_a_key() -> None:
    safe, unsafe = "https://b.example/x", "http://b.example/x"
    assert web.get("https://a.example/", LIMITS, transport=redirecting(safe)).content == b"there"
    with pytest.raises(BackendUnavailable, match="http://b.example, which is not safe"):
        web.get("https://a.example/", LIMITS, transport=redirecting(unsafe))
    kept = web.get("https://a.example/", LIMITS, authorization=lambda: KEY, transport=redirecting(safe))
    assert kept.status == 302


def test_a_gzip_bomb_is_refused_before_it_unpacks() -> None:
    body = bomb()
    tracemalloc.start()
    try:
        for ask in (asked, posted):
            with pytest.raises(BackendUnavailable, match=r"more than \d+ bytes") as caught:
                ask(httpx.Response(200, headers={"content-encoding": "gzip"}, stream=httpx.ByteStream(body)))
            assert not caught.value.retryable
        assert tracemalloc.get_traced_memory()[1] < 200 << 20
    finally:
        tracemalloc.stop()


def test_an_endless_body_is_ended() -> None:
    stream = Endless(bytes(65536))
    with pytest.raises(BackendUnavailable, match="more than"):
        asked(httpx.Response(200, stream=stream))
    assert stream.n_sent <= LIMITS.max_bytes + 65536
    stream = Endless(bytes(65536))
    with pytest.raises(BackendUnavailable, match="more than"):
        posted(httpx.Response(200, stream=stream))
    assert stream.n_sent <= http_client.MAX_REPLY_BYTES + 65536


def test_a_body_of_the_most_bytes_is_taken() -> None:
    body = bytes(LIMITS.max_bytes)
    assert asked(httpx.Response(200, stream=httpx.ByteStream(body))).content == body
    with pytest.raises(BackendUnavailable, match=f"more than {len(body)} bytes"):
        asked(httpx.Response(200, stream=httpx.ByteStream(body + b"0")))


def test_an_endless_body_that_unpacks_to_little_is_ended() -> None:
    """What follows a packed document is not unpacked."""
    stream = Endless(gzip.compress(b"{}") + bytes(65536))
    with pytest.raises(BackendUnavailable, match="more than"):
        asked(httpx.Response(200, headers={"content-encoding": "gzip"}, stream=stream))
    assert stream.n_sent <= LIMITS.max_bytes + len(stream.chunk)


def test_a_body_that_drips_for_ever_is_ended() -> None:
    with pytest.raises(BackendUnavailable, match="did not answer within") as caught:
        posted(httpx.Response(200, stream=Endless(b" ", 0.01)), timeout_s=0.2)
    assert caught.value.retryable


def test_unrequested_compression_is_decoded_or_refused() -> None:
    packed = httpx.Response(200, headers={"content-encoding": "gzip"}, stream=httpx.ByteStream(gzip.compress(b"{}")))
    assert posted(packed).json() == {}


@pytest.mark.parametrize("packing", ["br", "zstd", "gzip, gzip", "rot13"])
def test_an_unknown_packing_is_refused(packing: str) -> None:
    with pytest.raises(BackendUnavailable, match="packs its answer as"):
        posted(httpx.Response(200, headers={"content-encoding": packing}, stream=httpx.ByteStream(b"{}")))


def test_wrong_compression_header_is_refused() -> None:
    with pytest.raises(BackendUnavailable, match="and it is not"):
        posted(httpx.Response(200, headers={"content-encoding": "gzip"}, stream=httpx.ByteStream(b"{}")))


@pytest.mark.parametrize("charset", ["rot13", "idna", "zlib", "hex", "utf-7", "undefined", "utf-16", "no such"])
def test_json_is_read_as_utf_8_for_any_declared_charset(charset: str) -> None:
    body = httpx.ByteStream('{"a": "\u00fc"}'.encode())
    headers = {"content-type": f"application/json; charset={charset}"}
    assert posted(httpx.Response(200, headers=headers, stream=body)).json() == {"a": "\u00fc"}


def test_truncated_compressed_body_is_refused() -> None:
    packed = gzip.compress(b'{"a": 1}' * 100)[:-12]
    response = httpx.Response(200, stream=httpx.ByteStream(packed), headers={"content-encoding": "gzip"})
    with pytest.raises(BackendUnavailable, match="sends a part of it") as caught:
        asked(response)
    assert caught.value.retryable


def test_endless_name_lookup_runs_into_the_timeout(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ALL_PROXY", "HTTP_PROXY", "HTTPS_PROXY", "all_proxy", "http_proxy", "https_proxy"):
        monkeypatch.delenv(name, raising=False)
    over = threading.Event()
    ended: list[bool] = []

    def look_up(*_: object, **__: object) -> list[object]:
        ended.append(over.wait(20.0))
        return []

    monkeypatch.setattr(socket, "getaddrinfo", look_up)
    try:
        with pytest.raises(BackendUnavailable, match=r"did not answer within 0\.2 s"):
            web.get("http://localhost:9/", web.Limits(0.2, 1000))
        assert not ended  # the look-up is still running
    finally:
        over.set()


@pytest.mark.parametrize(
    "line",
    ["HTTP/1.1 {} OK\r\n\r\n", "HTTP/1.1 200 OK\r\nbad {}\r\n\r\n", "HTTP/1.1 302 x\r\nlocation: x{}://a\r\n\r\n"],
)
def test_key_in_a_broken_reply_is_in_no_cause_and_no_log(line: str, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    with socket.create_server(("127.0.0.1", 0)) as server:

        def answer() -> None:
            connection, _ = server.accept()
            with connection:
                connection.recv(65536)
                connection.sendall(line.format(KEY).encode())

        threading.Thread(target=answer, daemon=True).start()
        url = f"http://127.0.0.1:{server.getsockname()[1]}/"
        with pytest.raises(BackendUnavailable) as caught:
            web.get(url, LIMITS, scrub=Secret(KEY).scrub)
    assert KEY not in "".join(traceback.format_exception(caught.value))
    assert KEY not in caplog.text


def test_a_certificate_that_is_refused_is_not_asked_again() -> None:
    def refused(request: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("[SSL: CERTIFICATE_VERIFY_FAILED] certificate verify failed: certificate has expired")

    with pytest.raises(BackendUnavailable, match="certificate has expired") as caught:
        web.get("https://a.example/", LIMITS, transport=httpx.MockTransport(refused))
    assert not caught.value.retryable


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_a_server_of_this_machine_that_does_not_listen_is_not_asked_again(
    host: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(web, "_HEARD_HERE", set())  # the port may have been that of another test's server
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(BackendUnavailable, match="Start the server on this machine") as caught:
        web.get(f"http://{host}:{port}/", LIMITS)
    assert not caught.value.retryable


def test_a_server_of_this_machine_that_has_answered_may_restart() -> None:
    with serving(pages={"/": Scripted({})}) as server:
        assert web.get(f"{server.base_url}/", LIMITS).ok
    with pytest.raises(BackendUnavailable, match="Start the server on this machine") as caught:
        web.get(f"{server.base_url}/", LIMITS)
    assert caught.value.retryable


def test_a_server_elsewhere_that_does_not_listen_is_asked_again() -> None:
    def refused(request: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("All connection attempts failed")

    with pytest.raises(BackendUnavailable, match="Check the network") as caught:
        web.get("https://a.example/", LIMITS, transport=httpx.MockTransport(refused))
    assert caught.value.retryable
