"""One HTTP exchange with limits on bytes and seconds. All HTTP traffic goes through here.

Bytes are counted both packed and unpacked, since a megabyte of gzip may hold a gigabyte. The seconds count from the
name look-up to the last byte, so that a slow server cannot block a bake. httpx is imported when the first request is
sent.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import threading
import zlib
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Any, TypeAlias
from urllib.parse import urlsplit
from urllib.request import getproxies

from scene2hap.common.quiet_logs import scrubbed
from scene2hap.errors import BackendUnavailable, ConfigError

if TYPE_CHECKING:
    import ssl

    import httpx

    Transport: TypeAlias = httpx.AsyncBaseTransport

CONNECT_TIMEOUT_S = 10.0
"""Assumed: a server that has not accepted a connection by then is unreachable."""
MAX_REDIRECTS = 3

LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})

_HEARD_HERE: set[str] = set()
"""Hosts and ports of this machine from which a whole reply has come: what listened once may restart."""

_ANY_ZLIB_HEADER = 47
"""Window bits with which zlib reads both gzip and zlib."""


@dataclass(frozen=True)
class WebReply:
    """Reply of a server: status, body, and headers by lower-case name."""

    url: str
    status: int
    content: bytes
    headers: Mapping[str, str] = field(default_factory=dict)

    @property
    def ok(self) -> bool:
        """True if the status is a success."""
        return 200 <= self.status < 300

    @property
    def text(self) -> str:
        """The body as UTF-8, since JSON always is UTF-8."""
        return self.content.decode("utf-8-sig", "replace")

    def json(self) -> Any:
        """Return the body as JSON; None if it is not JSON."""
        try:
            return json.loads(self.text)
        except (ValueError, RecursionError):
            return None

    def scrubbed(self, scrub: Callable[[str], str]) -> WebReply:
        """Return the reply without a key that the server echoed; `scrub` removes the key from a text."""
        headers = {name: scrub(value) for name, value in self.headers.items()}
        return replace(self, content=scrub(self.text).encode(), headers=headers)


@dataclass(frozen=True)
class Limits:
    """Limits of one reply: total time [s] and unpacked size [bytes]."""

    timeout_s: float
    max_bytes: int


def is_safe(url: str) -> bool:
    """Return True if an address is encrypted or on this machine, and has no credentials."""
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
    """Return a service's base address without its last slash. Raises: ConfigError: it is unsafe for a token."""
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
    """Get a safe address. Returns every status.

    With an `authorization`, redirects are not followed, since it is for this host only. Without one, up to three are.
    Raises: BackendUnavailable: no whole reply came; states whether a retry can help.
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

    # In a separate thread, so that this works whether or not the caller runs an event loop.
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
    """Send one request, and read its reply within the limits. Returns every status.

    `authorization` returns the header of that name, "" for none. `safe_only` rejects addresses that are not `is_safe`,
    including redirects. `scrub` removes a key from logs of the HTTP library, from errors and from their causes.
    Raises: BackendUnavailable: no whole reply came; states whether a retry can help. ConfigError: the proxy in the
    environment cannot be used.
    """
    import httpx

    def authorise(request: httpx.Request) -> httpx.Request:
        if authorization is not None and (value := authorization()):
            request.headers["authorization"] = value
        return request

    async def check(request: httpx.Request) -> None:
        if safe_only and not is_safe(str(request.url)):
            raise httpx.UnsupportedProtocol(f"it leads to {request.url.scheme}://{request.url.host}, which is not safe")
        if transport is None and (not getproxies() or request.url.host in LOOPBACK):  # a proxy resolves names itself
            await _look_up(request.url.host)

    # No compression is requested. If a reply is compressed anyway, it is unpacked within the limit.
    headers = {"accept-encoding": "identity"}
    if body is not None:
        headers["content-type"] = content_type
    place = urlsplit(url).netloc if is_safe(url) else ""
    is_here = bool(place) and urlsplit(url).hostname in LOOPBACK
    client = _client(transport, limits.timeout_s, check, is_here)
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
    except BackendUnavailable as cause:
        raise _without_frames(cause, scrub)  # noqa: B904  # they hold a part of the body, which may echo the key
    except (TimeoutError, httpx.TimeoutException) as cause:
        raise BackendUnavailable(
            f"{url} did not answer within {limits.timeout_s:g} s. Try later, raise timeout_s, or lower the "
            "concurrency.",
            retryable=True,
        ) from _without_frames(cause, scrub)
    except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as cause:
        # No network lies between: nothing listens there. A server that loads its model may listen, and answers 503.
        is_absent = is_here and isinstance(cause, httpx.ConnectError)
        remedy = "Check the network, the server and the address."
        if is_absent:
            remedy = "Start the server on this machine, and wait until it listens; or check the port."
        if transport is None and not is_here and getproxies().keys() & {"http", "https", "all"}:
            remedy += (
                " It goes through the proxy of HTTP_PROXY, HTTPS_PROXY or ALL_PROXY, unless NO_PROXY names the host."
            )
        problem = (scrub(str(cause)) or type(cause).__name__).rstrip(".")
        is_lasting = _is_lasting(cause) or (is_absent and place not in _HEARD_HERE)
        raise BackendUnavailable(
            f"{url} cannot be reached: {problem}. {remedy}", retryable=not is_lasting
        ) from _without_frames(cause, scrub)
    if is_here:
        _HEARD_HERE.add(place)
    return WebReply(url, response.status_code, content, dict(response.headers))


def _is_lasting(cause: Exception) -> bool:
    """Return True for an error of a request that the same request would meet again."""
    import httpx

    is_refused = isinstance(
        cause, httpx.UnsupportedProtocol | httpx.LocalProtocolError | httpx.InvalidURL | httpx.TooManyRedirects
    )
    return is_refused or "CERTIFICATE_VERIFY_FAILED" in str(cause)  # of ssl, whose error httpx replaces by its own


async def _look_up(host: str) -> None:
    """Wait until a name is resolved or the look-up has failed; in that case the connection reports the error.

    The look-up runs in a daemon thread, since it cannot be interrupted. An event loop that closes, and Python when it
    exits, would wait for a thread of the loop's executor without regard to the time limit.
    """
    loop = asyncio.get_running_loop()
    known = loop.create_future()

    def tell() -> None:
        if not known.done():
            known.set_result(None)

    def ask() -> None:
        with contextlib.suppress(OSError, UnicodeError):
            socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
        with contextlib.suppress(RuntimeError):  # the loop was closed in the meantime
            loop.call_soon_threadsafe(tell)

    threading.Thread(target=ask, name=f"look up {host[:40]}", daemon=True).start()
    await known


async def _body(response: httpx.Response, url: str, max_bytes: int) -> bytes:
    """Return the unpacked body. Raises: BackendUnavailable: too large, or in an unsupported packing."""
    if response.is_stream_consumed:
        # A custom transport without a network may return a response that is already read.
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


def _client(
    transport: Transport | None, timeout_s: float, check: Callable[..., object], is_here: bool
) -> httpx.AsyncClient:
    """Make a client for one request, which goes to this machine if `is_here`.

    A shared pool would outlive the event loop of asyncio.run and leak its sockets.
    """
    import httpx

    try:
        for proxy in () if is_here else getproxies().values():
            _ = urlsplit(proxy).port  # raises for a port that is no number up to 65535
        return httpx.AsyncClient(
            transport=transport,
            # A proxy on another machine cannot reach this one's own servers, and should not see what they are asked.
            trust_env=not is_here,
            timeout=httpx.Timeout(timeout_s, connect=min(CONNECT_TIMEOUT_S, timeout_s)),
            verify=_ssl_context(),
            max_redirects=MAX_REDIRECTS,
            event_hooks={"request": [check]},
        )
    except (ImportError, ValueError):
        # The address of a proxy may hold a password, so the address and the cause are not shown.
        raise ConfigError(
            "the proxy that the environment names cannot be used. Check ALL_PROXY, HTTPS_PROXY and HTTP_PROXY (SOCKS "
            "needs the package socksio), or unset them."
        ) from None


@cache
def _ssl_context() -> ssl.SSLContext:
    """Return the context, which is made only once: reading certificates blocks all other calls for some 30 ms."""
    import httpx

    return httpx.create_ssl_context()


def _without_frames(error: BaseException, scrub: Callable[[str], str]) -> BaseException:
    """Remove the tracebacks, and a key that a server echoed, from an error with its causes and contexts.

    The frames of the HTTP library have the header among their local variables, which error reporters show.
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
