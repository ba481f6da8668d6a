"""The one place that speaks HTTP: JSON goes out, a reply or an error of ours comes back.

What the key opens stays closed: it is revealed on one line, straight into the header; whatever a server says is
searched for it before anyone else reads it, and no traceback that leaves here holds the header in a local variable.
httpx is imported when the first request is sent.
"""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any, TypeAlias
from urllib.parse import urlsplit

from scene2hap import checks
from scene2hap.errors import BackendError, BackendUnavailable, ConfigError
from scene2hap.llm import waits
from scene2hap.llm.http_reply import HttpReply as HttpReply
from scene2hap.llm.pace import Pace
from scene2hap.llm.quiet_logs import scrubbed
from scene2hap.secret import Secret as Secret

if TYPE_CHECKING:
    import ssl

    import httpx

    Transport: TypeAlias = httpx.AsyncBaseTransport

_LOG = logging.getLogger(__name__)

CONNECT_TIMEOUT_S = 10.0
"""Assumed: whoever has not accepted a connection by then is not there."""

_HEADERS_READ = ("x-should-retry", "x-request-id", *waits.HEADERS)


@dataclass(frozen=True)
class Endpoint:
    """A server, the key to it, how long one answer may take in all (`timeout_s` [s]), and the pause it asks for."""

    base_url: str
    secret: Secret
    timeout_s: float
    transport: Transport | None = None
    pace: Pace = field(default_factory=Pace, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "base_url", _checked_url(self.base_url))
        checks.number("timeout_s", self.timeout_s, "s", above=0.0, error=ConfigError)

    async def post(self, path: str, body: Mapping[str, Any]) -> HttpReply:
        """Post JSON to a path below the base address, once the server takes requests; every status is a reply.

        Raises: BackendUnavailable: no reply came; BackendError: the body has no JSON.
        """
        content = _encoded(body)
        await self.pace.wait()
        reply = await self._send("POST", path, content, self.timeout_s)
        self.pace.heed(reply)
        return reply

    async def get(self, path: str, timeout_s: float) -> HttpReply:
        """What lies at a path below the base address. Raises: BackendUnavailable: no reply came."""
        return await self._send("GET", path, None, min(timeout_s, self.timeout_s))

    async def _send(self, method: str, path: str, content: bytes | None, timeout_s: float) -> HttpReply:
        import httpx

        url = f"{self.base_url}/{path}"
        headers = {"content-type": "application/json"} if content is not None else {}
        limits = httpx.Timeout(timeout_s, connect=min(CONNECT_TIMEOUT_S, timeout_s))
        client = _client(self.transport, limits)
        try:
            with scrubbed(self.secret):
                async with asyncio.timeout(timeout_s), client:
                    response = await client.request(method, url, content=content, headers=headers, auth=self._authorise)
        except (TimeoutError, httpx.TimeoutException) as cause:
            raise BackendUnavailable(
                f"{url} did not answer within {timeout_s:g} s. Raise timeout_s, or lower the concurrency.",
                retryable=True,
            ) from _without_frames(cause)
        except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as cause:
            ours = isinstance(cause, httpx.UnsupportedProtocol | httpx.LocalProtocolError | httpx.InvalidURL)
            problem = self.secret.scrub(str(cause)) or type(cause).__name__
            raise BackendUnavailable(
                f"{url} cannot be reached: {problem}. Check that the server runs and base_url is right.",
                retryable=not ours,
            ) from _without_frames(cause)
        return self._scrubbed(url, response)

    def _scrubbed(self, url: str, response: httpx.Response) -> HttpReply:
        headers = {
            name: self.secret.scrub(response.headers[name]) for name in _HEADERS_READ if name in response.headers
        }
        _LOG.debug("%s answered %d, request id %s", url, response.status_code, headers.get("x-request-id", "unknown"))
        return HttpReply(url, response.status_code, self.secret.scrub(response.text), headers)

    def _authorise(self, request: httpx.Request) -> httpx.Request:
        if self.secret.reveal():
            request.headers["authorization"] = f"Bearer {self.secret.reveal()}"
        return request


def _client(transport: Transport | None, limits: httpx.Timeout) -> httpx.AsyncClient:
    """One per request: a pool would outlive the event loop of asyncio.run and leak its sockets."""
    import httpx

    try:
        return httpx.AsyncClient(transport=transport, timeout=limits, verify=_ssl_context())
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


def _without_frames(error: BaseException) -> BaseException:
    """The error, its causes and contexts without their tracebacks.

    The frames of the HTTP library have the header among their local variables, which reporters of errors show.
    """
    seen: BaseException | None = error
    while seen is not None:
        seen.__traceback__ = None
        seen = seen.__cause__ or seen.__context__
    return error


def _encoded(body: Mapping[str, Any]) -> bytes:
    try:
        # A lone surrogate (a file name that is not UTF-8) becomes a question mark.
        return json.dumps(body, ensure_ascii=False, allow_nan=False).encode("utf-8", "replace")
    except (TypeError, ValueError) as cause:
        raise BackendError(
            f"no JSON for this request: {cause}. Use texts, finite numbers, lists and objects."
        ) from cause


def _checked_url(base_url: str) -> str:
    parts = urlsplit(base_url)
    if "@" in parts.netloc or parts.query:
        raise ConfigError("base_url carries credentials or a query; give the key as api_key, where it stays hidden.")
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ConfigError(f"base_url is {base_url!r}; it must look like 'https://api.openai.com/v1'.")
    return base_url.rstrip("/")
