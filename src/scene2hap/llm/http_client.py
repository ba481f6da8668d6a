"""The one place that speaks HTTP: JSON is posted, a reply or an error of ours comes back.

What the key opens stays closed: it is revealed on one line, straight into the header, and whatever a server says is
searched for it before anyone else reads it. httpx is imported when the first request is sent.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any, TypeAlias
from urllib.parse import urlsplit

from scene2hap import checks
from scene2hap.errors import BackendError, BackendUnavailable, ConfigError

if TYPE_CHECKING:
    import ssl

    import httpx

    Transport: TypeAlias = httpx.AsyncBaseTransport

_LOG = logging.getLogger(__name__)

MASK = "******"
CONNECT_TIMEOUT_S = 10.0
"""Assumed: whoever has not accepted a connection by then is not there."""

_SHORTEST_SCRUBBED = 16
"""Characters; assumed. Real keys are longer; the dummies that local servers want ("EMPTY", "lm-studio") are words
that an answer may well contain."""

_HEADERS_READ = ("x-should-retry", "retry-after-ms", "retry-after", "x-request-id")


class Secret:
    """A key that shows itself to nobody: given, or read from an environment variable each time it is needed."""

    __slots__ = ("_value", "_variable")

    def __init__(self, value: str | None = None, variable: str = "") -> None:
        if not isinstance(value, str | None):
            raise ConfigError(f"an API key is a {type(value).__name__}; it must be a text.")
        self._value = value
        self._variable = variable

    def __repr__(self) -> str:
        return f"Secret({MASK})"

    def reveal(self) -> str:
        """The key itself, "" where there is none.

        Raises: ConfigError: it holds characters that no header may carry (httpx would quote them in its error).
        """
        value = (self._value or os.environ.get(self._variable, "")).strip()
        if not (value.isascii() and value.isprintable()):
            raise ConfigError("the API key holds line breaks or characters outside ASCII; copy it again.")
        return value

    def scrub(self, text: str) -> str:
        """The text without the key, should somebody have echoed it."""
        value = self.reveal()
        return text.replace(value, MASK) if len(value) >= _SHORTEST_SCRUBBED else text


@dataclass(frozen=True)
class HttpReply:
    """What a server said: status, the few headers that matter (lower case) and the body as text."""

    url: str
    status: int
    text: str
    headers: Mapping[str, str] = field(default_factory=dict)

    @property
    def ok(self) -> bool:
        """Whether the status says success."""
        return 200 <= self.status < 300

    def json(self) -> Any:
        """The body as JSON values, None where it is not JSON."""
        try:
            return json.loads(self.text)
        except (ValueError, RecursionError):
            return None


@dataclass(frozen=True)
class Endpoint:
    """A server, the key to it, and how long one answer may take in all (`timeout_s` [s])."""

    base_url: str
    secret: Secret
    timeout_s: float
    transport: Transport | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "base_url", _checked_url(self.base_url))
        checks.number("timeout_s", self.timeout_s, "s", above=0.0, error=ConfigError)

    async def post(self, path: str, body: Mapping[str, Any]) -> HttpReply:
        """Post JSON to a path below the base address; every status is a reply.

        Raises: BackendUnavailable: no reply came; BackendError: the body has no JSON.
        """
        import httpx

        url = f"{self.base_url}/{path}"
        content = _encoded(body)
        try:
            async with asyncio.timeout(self.timeout_s):
                # One client per request: a pool would outlive the event loop of asyncio.run and leak its sockets.
                async with httpx.AsyncClient(
                    transport=self.transport, timeout=self._timeout(), verify=_ssl_context()
                ) as client:
                    response = await client.post(
                        url, content=content, headers={"content-type": "application/json"}, auth=self._authorise
                    )
        except (TimeoutError, httpx.TimeoutException) as cause:
            raise BackendUnavailable(
                f"{url} did not answer within {self.timeout_s:g} s. Raise timeout_s, or lower the concurrency.",
                retryable=True,
            ) from cause
        except (httpx.HTTPError, httpx.StreamError, httpx.InvalidURL) as cause:
            ours = isinstance(cause, httpx.UnsupportedProtocol | httpx.LocalProtocolError | httpx.InvalidURL)
            problem = self.secret.scrub(str(cause)) or type(cause).__name__
            raise BackendUnavailable(
                f"{url} cannot be reached: {problem}. Check that the server runs and base_url is right.",
                retryable=not ours,
            ) from cause
        headers = {
            name: self.secret.scrub(response.headers[name]) for name in _HEADERS_READ if name in response.headers
        }
        _LOG.debug("%s answered %d, request id %s", url, response.status_code, headers.get("x-request-id", "unknown"))
        return HttpReply(url, response.status_code, self.secret.scrub(response.text), headers)

    def _timeout(self) -> httpx.Timeout:
        import httpx

        return httpx.Timeout(self.timeout_s, connect=min(CONNECT_TIMEOUT_S, self.timeout_s))

    def _authorise(self, request: httpx.Request) -> httpx.Request:
        if self.secret.reveal():
            request.headers["authorization"] = f"Bearer {self.secret.reveal()}"
        return request


@cache
def _ssl_context() -> ssl.SSLContext:
    """Made once: reading the certificates takes some 30 ms, during which no other call goes on."""
    import httpx

    return httpx.create_ssl_context()


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
