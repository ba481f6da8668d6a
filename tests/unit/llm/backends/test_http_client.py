"""The HTTP client of LLM backends, with replies and errors from an injected transport."""

import asyncio
import gzip
import json
import traceback
from collections.abc import AsyncIterator, Callable
from typing import Any

import httpx
import pytest

from llm_server import GOOD, KEY, request, said, serving
from scene2hap import OpenAIBackend
from scene2hap.common.secret import Secret
from scene2hap.common.web import WebReply
from scene2hap.errors import BackendError, BackendUnavailable, ConfigError
from scene2hap.llm.backends.http_client import MAX_REPLY_BYTES, Endpoint


def post(answer: Callable[[httpx.Request], httpx.Response], body: Any = None, key: str | None = KEY) -> WebReply:
    endpoint = Endpoint("https://model.example/v1/", Secret(key), 5.0, httpx.MockTransport(answer))
    return asyncio.run(endpoint.post("chat", body or {}))


def subclasses(kind: type[Exception]) -> list[type[Exception]]:
    return [kind, *(lower for inner in kind.__subclasses__() for lower in subclasses(inner))]


HTTPX_ERRORS = sorted(
    {*subclasses(httpx.HTTPError), *subclasses(httpx.StreamError), httpx.InvalidURL}, key=lambda kind: kind.__name__
)
OURS = (httpx.UnsupportedProtocol, httpx.LocalProtocolError, httpx.InvalidURL, httpx.TooManyRedirects)


def made(kind: type[Exception]) -> Exception:
    try:
        return kind("bad luck")
    except TypeError:
        return kind("bad luck", request=None, response=None) if kind is httpx.HTTPStatusError else kind()


@pytest.mark.parametrize("kind", HTTPX_ERRORS, ids=lambda kind: kind.__name__)
def test_every_error_of_httpx_is_one_of_ours(kind: type[Exception]) -> None:
    cause = made(kind)

    def fail(_: httpx.Request) -> httpx.Response:
        raise cause

    with pytest.raises(BackendUnavailable, match="https://model.example/v1/chat ") as caught:
        post(fail)
    assert caught.value.__cause__ is cause
    assert caught.value.retryable is not issubclass(kind, OURS)


def test_body_and_headers_of_a_request() -> None:
    seen: list[httpx.Request] = []

    def echo(sent: httpx.Request) -> httpx.Response:
        seen.append(sent)
        return httpx.Response(418, content='{"a":"ü"}', headers={"X-Request-ID": "r", "Set-Cookie": "c"})

    reply = post(echo, {"prompt": "käse"})
    assert reply.text == '{"a":"ü"}'
    assert (reply.url, reply.status, reply.headers["x-request-id"]) == ("https://model.example/v1/chat", 418, "r")
    assert not reply.ok
    assert reply.json() == {"a": "ü"}
    assert json.loads(seen[0].content) == {"prompt": "käse"}
    assert seen[0].headers["authorization"] == f"Bearer {KEY}"


def test_request_without_a_key_has_no_authorization_header() -> None:
    assert post(lambda sent: httpx.Response(200, text=str("authorization" in sent.headers)), key=None).text == "False"


@pytest.mark.parametrize("body", [{"temperature": float("nan")}, {"fact": object()}])
def test_body_that_is_not_json_is_not_sent(body: dict[str, Any]) -> None:
    def fail(_: httpx.Request) -> httpx.Response:
        raise AssertionError("sent")

    with pytest.raises(BackendError, match="no JSON for this request"):
        post(fail, body)


def test_slow_trickle_of_bytes_is_a_timeout() -> None:
    """httpx limits the time of each read; the client limits the time of the whole answer."""

    async def trickle(_: httpx.Request) -> httpx.Response:
        for _ in range(100):
            await asyncio.sleep(0.001)
        return httpx.Response(200, text="{}")

    endpoint = Endpoint("https://model.example", Secret(), 0.02, httpx.MockTransport(trickle))
    with pytest.raises(BackendUnavailable, match=r"did not answer within 0\.02 s") as caught:
        asyncio.run(endpoint.post("chat", {}))
    assert caught.value.retryable


def test_backends_use_the_given_transport() -> None:
    transport = httpx.MockTransport(lambda _: httpx.Response(200, json=said().body))
    reply = asyncio.run(OpenAIBackend(api_key=KEY, transport=transport).complete(request()))
    assert json.loads(reply.text) == GOOD["scene_analyzer"]


def test_no_traceback_holds_the_header_in_a_local_variable() -> None:
    """Error reporters show the local variables of each frame, and some frames of the HTTP library hold the key."""

    def fail(sent: httpx.Request) -> httpx.Response:
        header = sent.headers["authorization"]
        raise httpx.ReadError(f"after {len(header)} characters")

    with pytest.raises(BackendUnavailable) as caught:
        post(fail)
    frames = caught.value.__traceback__.tb_next.tb_next
    shown = traceback.TracebackException(BackendUnavailable, caught.value, frames, capture_locals=True)
    text = "".join(shown.format())
    assert "after 35 characters" in text
    assert "httpx.ReadError" in text
    assert KEY not in text
    cause: BaseException | None = caught.value.__cause__
    while cause is not None:
        assert cause.__traceback__ is None
        cause = cause.__cause__ or cause.__context__


@pytest.mark.parametrize(
    ("content", "packing"),
    [
        (f"not packed: {KEY}".encode(), "gzip"),
        (gzip.compress(f"a part: {KEY}".encode())[:-12], "gzip"),
        (KEY.encode() * (MAX_REPLY_BYTES // len(KEY) + 1), "identity"),
    ],
    ids=["not packed", "cut short", "too large"],
)
def test_no_traceback_holds_a_body_that_is_no_answer(content: bytes, packing: str) -> None:
    """A proxy's page may echo the header of the request."""

    async def parts() -> AsyncIterator[bytes]:
        yield content

    def echo(_: httpx.Request) -> httpx.Response:
        return httpx.Response(200, headers={"content-encoding": packing}, content=parts())

    with pytest.raises(BackendUnavailable) as caught:
        post(echo)
    frames = caught.value.__traceback__.tb_next.tb_next
    shown = traceback.TracebackException(BackendUnavailable, caught.value, frames, capture_locals=True)
    assert KEY[:20] not in "".join(shown.format())


def test_get_sends_the_key_and_has_its_own_timeout() -> None:
    async def slow(sent: httpx.Request) -> httpx.Response:
        assert (sent.method, sent.headers["authorization"]) == ("GET", f"Bearer {KEY}")
        await asyncio.sleep(0 if sent.url.path == "/v1/models" else 5)
        return httpx.Response(200, text="{}")

    endpoint = Endpoint("https://model.example/v1", Secret(KEY), 60.0, httpx.MockTransport(slow))
    assert asyncio.run(endpoint.get("models", 60.0)).json() == {}
    with pytest.raises(BackendUnavailable, match=r"within 0\.02 s"):
        asyncio.run(endpoint.get("slow", 0.02))


@pytest.mark.parametrize("proxy", ["nonsense://me:hunter2@127.0.0.1", "http://me:hunter2@127.0.0.1:99999"])
def test_error_names_an_invalid_proxy_without_its_password(proxy: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ALL_PROXY", proxy)
    with pytest.raises(ConfigError, match="Check ALL_PROXY") as caught:
        asyncio.run(Endpoint("https://model.example", Secret(), 1.0).post("chat", {}))
    assert "hunter2" not in "".join(traceback.format_exception(caught.value))


def test_error_names_the_proxy_that_does_not_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("http_proxy", "http://me:hunter2@127.0.0.1:1")
    monkeypatch.delenv("no_proxy", raising=False)
    monkeypatch.delenv("NO_PROXY", raising=False)
    with pytest.raises(BackendUnavailable, match="through the proxy of HTTP_PROXY") as caught:
        asyncio.run(Endpoint("http://model.example/v1", Secret(), 5.0).post("chat", {}))
    assert "hunter2" not in "".join(traceback.format_exception(caught.value))


@pytest.mark.parametrize("proxy", ["http://127.0.0.1:1", "nonsense://127.0.0.1"])
def test_a_server_on_this_machine_is_reached_without_the_proxy(proxy: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("http_proxy", "all_proxy"):
        monkeypatch.setenv(name, proxy)
    for name in ("no_proxy", "NO_PROXY"):
        monkeypatch.delenv(name, raising=False)
    with serving(said()) as server:
        assert asyncio.run(Endpoint(server.base_url, Secret(), 5.0).post("chat", {})).ok


@pytest.mark.parametrize("port", ["114340", "abc"])
def test_address_with_an_impossible_port_is_refused(port: str) -> None:
    with pytest.raises(ConfigError, match="base_url is no address: [Pp]ort"):
        Endpoint(f"http://127.0.0.1:{port}/v1", Secret(), 1.0)
