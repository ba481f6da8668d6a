"""One bounded HTTP exchange: so many bytes, so many seconds. Every use of HTTP goes through here.

Bytes are counted as they come and as they unpack, since a megabyte of gzip may hold a gigabyte. The seconds count from
the first to the last byte, name look-up included, so that a server that drips cannot hold a bake. httpx is imported
when the first request is sent.
"""

from __future__ import annotations

import asyncio
import contextlib
import socket
import threading
import zlib
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, TypeAlias
from urllib.parse import urlsplit
from urllib.request import getproxies

from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.quiet_logs import scrubbed

if TYPE_CHECKING:
    import ssl

    import httpx

    Transport: TypeAlias = httpx.AsyncBaseTransport

CONNECT_TIMEOUT_S = 10.0
"""Assumed: whoever has not accepted a connection by then is not there."""
MAX_REDIRECTS = 3

LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})

_ANY_ZLIB_HEADER = 47
"""Window bits by which zlib reads gzip and zlib alike."""


@dataclass(frozen=True)
class WebReply:
    """Reply of a server: status, body, and headers by lower-case name."""

    url: str
    status: int
    content: bytes
    headers: Mapping[str, str] = field(default_factory=dict)

    @property
    def retry_after(self) -> str:
        """When to ask again, as the server wrote it; "" where it says nothing."""
        return self.headers.get("retry-after", "")

    @property
    def text(self) -> str:
        """The body as UTF-8, since JSON always is UTF-8."""
        return self.content.decode("utf-8-sig", "replace")


@dataclass(frozen=True)
class Limits:
    """Limits of one reply: total time [s] and unpacked size [bytes]."""

    timeout_s: float
    max_bytes: int


def is_safe(url: str) -> bool:
    """Whether an address is encrypted, or on this very machine, and carries no credentials."""
    try:
        parts = urlsplit(url)
        host = parts.hostname or ""
    except ValueError:
        return False
    return (
        "@" not in parts.netloc
        and bool(host)
        and (parts.scheme == "https" or (parts.scheme == "http" and host in LOOPBACK))
    )


def checked_base(url: str) -> str:
    """A service's base address without its last slash. Raises: ConfigError: it is not safe to send a token to."""
    if not isinstance(url, str) or not is_safe(url) or urlsplit(url).query:
        raise ConfigError(
            "base_url must be an https address (http on this machine alone) without credentials or query, such as "
            "'https://freesound.org/apiv2'."
        )
    return url.rstrip("/")


def get(
    url: str,
    limits: Limits,
    *,
    params: Mapping[str, str] | None = None,
    authorization: Callable[[], str] | None = None,
    scrub: Callable[[str], str] = str,
    transport: Transport | None = None,
) -> WebReply:
    """Get a safe address; every status is a reply.

    With an `authorization` no redirect is followed: what it says is for this host alone. Without one, up to three.
    Raises: BackendUnavailable: no whole reply came; tells whether trying again can help.
    """

    def ask() -> WebReply:
        return asyncio.run(
            exchange(
                "GET",
                url,
                limits,
                params=params,
                authorization=authorization,
                scrub=scrub,
                follow_redirects=authorization is None,
                safe_only=True,
                transport=transport,
            )
        )

    # A thread of its own: there is a loop in it whether or not the caller runs one.
    with ThreadPoolExecutor(max_workers=1) as pool:
        return pool.submit(ask).result()


async def exchange(
    method: str,
    url: str,
    limits: Limits,
    *,
    body: bytes | None = None,
    content_type: str = "application/json",
    params: Mapping[str, str] | None = None,
    authorization: Callable[[], str] | None = None,
    follow_redirects: bool = False,
    safe_only: bool = False,
    scrub: Callable[[str], str] = str,
    transport: Transport | None = None,
) -> WebReply:
    """Send one request and read its reply within the limits; every status is a reply.

    `authorization` gives the header of that name, "" for none; `safe_only` refuses addresses that are not `is_safe`,
    those of redirects too; `scrub` takes a key out of what the HTTP library logs, and says of an error and its causes.
    Raises: BackendUnavailable: no whole reply came; tells whether trying again can help. ConfigError: the proxy that
    the environment names cannot be used.
    """
    import httpx

    def authorise(request: httpx.Request) -> httpx.Request:
        if authorization is not None and authorization():
            request.headers["authorization"] = authorization()
        return request

    async def check(request: httpx.Request) -> None:
        if safe_only and not is_safe(str(request.url)):
            raise httpx.UnsupportedProtocol(f"it leads to {request.url.scheme}://{request.url.host}, which is not safe")
        if transport is None and not getproxies():  # a proxy looks names up itself
            await _look_up(request.url.host)

    # No compression is requested; a compressed reply is unpacked within the limit.
    headers = {"accept-encoding": "identity"}
    if body is not None:
        headers["content-type"] = content_type
    client = _client(transport, limits.timeout_s, check)
    try:
        with scrubbed(scrub):
            async with (
                asyncio.timeout(limits.timeout_s),
                client,
                client.stream(
                    method,
                    url,
                    content=body,
                    params=params,
                    headers=headers,
                    auth=authorise,
                    follow_redirects=follow_redirects,
                ) as response,
            ):
                content = await _body(response, url, limits.max_bytes)
    except (TimeoutError, httpx.TimeoutException) as cause:
        raise BackendUnavailable(
            f"{url} did not answer within {limits.timeout_s:g} s. Try later, raise timeout_s, or lower the "
            "concurrency.",
            retryable=True,
        ) from _without_frames(cause, scrub)
    except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as cause:
        never = isinstance(
            cause, httpx.UnsupportedProtocol | httpx.LocalProtocolError | httpx.InvalidURL | httpx.TooManyRedirects
        )
        problem = scrub(str(cause)) or type(cause).__name__
        raise BackendUnavailable(
            f"{url} cannot be reached: {problem}. Check the network, the server and the address.", retryable=not never
        ) from _without_frames(cause, scrub)
    return WebReply(url, response.status_code, content, dict(response.headers))


async def _look_up(host: str) -> None:
    """Wait until the resolver knows a name, or that there is none, as the connection tells then.

    In a thread that nobody waits for: a look-up cannot be interrupted, and those of an event loop are waited for when
    it closes, and by Python at its end, whatever time is left.
    """
    loop = asyncio.get_running_loop()
    known = loop.create_future()

    def tell() -> None:
        if not known.done():
            known.set_result(None)

    def ask() -> None:
        with contextlib.suppress(OSError, UnicodeError):
            socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
        with contextlib.suppress(RuntimeError):  # the loop is closed: it did not wait
            loop.call_soon_threadsafe(tell)

    threading.Thread(target=ask, name=f"look up {host[:40]}", daemon=True).start()
    await known


async def _body(response: httpx.Response, url: str, max_bytes: int) -> bytes:
    """The body, unpacked. Raises: BackendUnavailable: it is too large, or packed in a way that is not read."""
    if response.is_stream_consumed:
        # A transport of one's own, without a network, may hand over what it holds already.
        _require_at_most(len(response.content), url, max_bytes)
        return response.content
    packing = response.headers.get("content-encoding", "identity").strip().lower()
    if packing not in ("identity", "", "gzip", "x-gzip", "deflate"):
        raise BackendUnavailable(f"{url} packs its answer as {packing[:40]!r}, which was not requested.")
    unpack = None if packing in ("identity", "") else zlib.decompressobj(_ANY_ZLIB_HEADER)
    content, n_raw = bytearray(), 0
    async for chunk in response.aiter_raw():
        n_raw += len(chunk)
        try:
            content += chunk if unpack is None else unpack.decompress(chunk, max_bytes + 1 - len(content))
        except zlib.error as cause:
            raise BackendUnavailable(
                f"{url} says that its answer is packed as {packing!r}, and it is not.", retryable=True
            ) from cause
        _require_at_most(max(len(content), n_raw), url, max_bytes)
    if unpack is not None and n_raw and not unpack.eof:
        raise BackendUnavailable(f"{url} packs its answer as {packing!r} and sends a part of it.", retryable=True)
    return bytes(content)


def _require_at_most(n_bytes: int, url: str, max_bytes: int) -> None:
    if n_bytes > max_bytes:
        raise BackendUnavailable(
            f"{url} sends more than {max_bytes} bytes, which is no answer to this request.", retryable=False
        )


def _client(transport: Transport | None, timeout_s: float, check: Callable[..., object]) -> httpx.AsyncClient:
    """One per request: a pool would outlive the event loop of asyncio.run and leak its sockets."""
    import httpx

    try:
        return httpx.AsyncClient(
            transport=transport,
            timeout=httpx.Timeout(timeout_s, connect=min(CONNECT_TIMEOUT_S, timeout_s)),
            verify=_ssl_context(),
            max_redirects=MAX_REDIRECTS,
            event_hooks={"request": [check]},
        )
    except (ImportError, ValueError):
        # The address of a proxy may hold a password: neither it nor the cause is shown.
        raise ConfigError(
            "the proxy that the environment names cannot be used. Check ALL_PROXY, HTTPS_PROXY and HTTP_PROXY (SOCKS "
            "needs the package socksio), or unset them."
        ) from None


@cache
def _ssl_context() -> ssl.SSLContext:
    """Made once: reading the certificates takes some 30 ms, during which no other call goes on."""
    import httpx

    return httpx.create_ssl_context()


def _without_frames(error: BaseException, scrub: Callable[[str], str]) -> BaseException:
    """The error, its causes and contexts without their tracebacks, and without the key that a server put into them.

    The frames of the HTTP library have the header among their local variables, which reporters of errors show.
    """
    waiting: list[BaseException | None] = [error]
    seen: set[int] = set()
    while waiting:
        found = waiting.pop()
        if found is None or id(found) in seen:
            continue
        seen.add(id(found))
        found.__traceback__ = None
        found.args = tuple(scrub(part) if isinstance(part, str) else part for part in found.args)
        waiting += [found.__cause__, found.__context__]
    return error
