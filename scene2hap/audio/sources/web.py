"""One bounded GET: so many bytes, so many seconds, from addresses that are allowed.

The seconds count from the first to the last byte, name look-up included, so that a server that drips cannot hold a
bake. httpx is imported when the first request is sent.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, TypeAlias
from urllib.parse import urlsplit

from scene2hap.errors import BackendUnavailable, ConfigError

if TYPE_CHECKING:
    import ssl

    import httpx

    Transport: TypeAlias = httpx.AsyncBaseTransport

CONNECT_TIMEOUT_S = 10.0
"""Assumed: whoever has not accepted a connection by then is not there."""
MAX_REDIRECTS = 3

LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})


@dataclass(frozen=True)
class WebReply:
    """What a server said: status, body, and the two headers that matter."""

    url: str
    status: int
    content: bytes
    location: str = ""
    retry_after: str = ""


@dataclass(frozen=True)
class Limits:
    """How long one reply may take in all [s] and how large it may be [bytes]."""

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
    transport: Transport | None = None,
) -> WebReply:
    """What lies at an address; every status is a reply.

    With an `authorization` no redirect is followed: what it says is for this host alone. Without one, up to three.
    Raises: BackendUnavailable: no whole reply came; tells whether trying again can help.
    """
    # A thread of its own: there is a loop in it whether or not the caller runs one.
    with ThreadPoolExecutor(max_workers=1) as pool:
        return pool.submit(lambda: asyncio.run(_get(url, limits, params, authorization, transport))).result()


async def _get(
    url: str,
    limits: Limits,
    params: Mapping[str, str] | None,
    authorization: Callable[[], str] | None,
    transport: Transport | None,
) -> WebReply:
    import httpx

    def authorise(request: httpx.Request) -> httpx.Request:
        if authorization is not None:
            request.headers["authorization"] = authorization()
        return request

    async def check(request: httpx.Request) -> None:
        if not is_safe(str(request.url)):
            raise httpx.UnsupportedProtocol(f"it leads to {request.url.scheme}://{request.url.host}, which is not safe")

    timeout = httpx.Timeout(limits.timeout_s, connect=min(CONNECT_TIMEOUT_S, limits.timeout_s))
    try:
        async with (
            asyncio.timeout(limits.timeout_s),
            httpx.AsyncClient(
                transport=transport,
                timeout=timeout,
                verify=_ssl_context(),
                max_redirects=MAX_REDIRECTS,
                event_hooks={"request": [check]},
            ) as client,
            client.stream(
                "GET",
                url,
                params=params,
                # Nothing to unpack: a few kilobytes of gzip may hold a gigabyte.
                headers={"accept-encoding": "identity"},
                auth=authorise,
                follow_redirects=authorization is None,
            ) as response,
        ):
            content = await _body(response, url, limits.max_bytes)
    except (TimeoutError, httpx.TimeoutException) as cause:
        raise BackendUnavailable(
            f"{url} did not answer within {limits.timeout_s:g} s. Try later, or raise timeout_s.", retryable=True
        ) from _without_frames(cause)
    except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as cause:
        never = isinstance(
            cause, httpx.UnsupportedProtocol | httpx.LocalProtocolError | httpx.InvalidURL | httpx.TooManyRedirects
        )
        raise BackendUnavailable(
            f"{url} cannot be reached: {str(cause) or type(cause).__name__}. Check the network and the address.",
            retryable=not never,
        ) from _without_frames(cause)
    told = response.headers
    return WebReply(url, response.status_code, content, told.get("location", ""), told.get("retry-after", ""))


async def _body(response: httpx.Response, url: str, max_bytes: int) -> bytes:
    content = bytearray()
    async for chunk in response.aiter_raw():
        content += chunk
        if len(content) > max_bytes:
            raise BackendUnavailable(
                f"{url} sends more than {max_bytes} bytes, which is no answer to what was asked.", retryable=False
            )
    return bytes(content)


@cache
def _ssl_context() -> ssl.SSLContext:
    """Made once: reading the certificates takes some 30 ms."""
    import httpx

    return httpx.create_ssl_context()


def _without_frames(error: BaseException) -> BaseException:
    """The error and its causes without tracebacks, whose frames hold the header among their local variables."""
    seen: BaseException | None = error
    while seen is not None:
        seen.__traceback__ = None
        seen = seen.__cause__ or seen.__context__
    return error
