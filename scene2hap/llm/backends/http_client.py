"""The HTTP client of the backends: send JSON or a file, return a reply or raise one of our errors.

The key is protected. A single line reveals it, directly into the header. Every reply is searched for the key before
other code reads it, and no traceback from here has the header in a local variable. `scene2hap.common.web` does the
exchange, with limits on bytes and seconds.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from scene2hap.common import checks, web
from scene2hap.common.secret import Secret
from scene2hap.errors import BackendError, ConfigError
from scene2hap.llm.backends.pace import Pace

if TYPE_CHECKING:
    from scene2hap.common.web import Transport

_LOG = logging.getLogger(__name__)

MAX_REPLY_BYTES = 4 << 20
"""Size of one unpacked reply (assumed: a hundred times the longest answer with its thoughts, or any list of models)."""

MAX_FILE_BYTES = 512 << 20
"""Size of one file of answers (assumed: ten times the size of our largest batch)."""
FILE_TIMEOUT_S = 900.0
"""Time for a file of two hundred megabytes [s] (assumed: a connection of two megabits per second)."""


@dataclass(frozen=True)
class Endpoint:
    """A server: its address, its key, the longest time for one answer (`timeout_s` [s]), and its requested pause."""

    base_url: str
    secret: Secret
    timeout_s: float
    transport: Transport | None = None
    pace: Pace = field(default_factory=Pace, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "base_url", _checked_url(self.base_url))
        checks.number("timeout_s", self.timeout_s, "s", above=0.0, error=ConfigError)

    async def post(self, path: str, body: Mapping[str, Any]) -> web.WebReply:
        """Post JSON to a path below the base address, after any pause that the server requested. Returns every status.

        Raises: BackendUnavailable: no reply came; BackendError: the body has no JSON form.
        """
        content = _encoded(body)
        await self.pace.wait()
        reply = await self._send("POST", path, content, self.timeout_s)
        self.pace.heed(reply)
        return reply

    async def upload(self, path: str, name: str, content: bytes, fields: Mapping[str, str]) -> web.WebReply:
        """Post a file and fields as a form. Returns every status. Raises: BackendUnavailable: no reply came."""
        import httpx

        form = httpx.Request("POST", self.base_url, data=dict(fields), files={"file": (name, content)})
        return await self._send("POST", path, form.read(), FILE_TIMEOUT_S, form.headers["content-type"])

    async def get(self, path: str, timeout_s: float) -> web.WebReply:
        """Get a path below the base address. Raises: BackendUnavailable: no reply came."""
        return await self._send("GET", path, None, min(timeout_s, self.timeout_s))

    async def download(self, path: str) -> web.WebReply:
        """Return the file at a path below the base address. Raises: BackendUnavailable: no reply, or too large."""
        return await self._send("GET", path, None, FILE_TIMEOUT_S, max_bytes=MAX_FILE_BYTES)

    async def _send(
        self,
        method: str,
        path: str,
        content: bytes | None,
        timeout_s: float,
        content_type: str = "application/json",
        max_bytes: int = MAX_REPLY_BYTES,
    ) -> web.WebReply:
        url = f"{self.base_url}/{path}"
        reply = await web.exchange(
            method,
            url,
            web.Limits(timeout_s, max_bytes),
            body=content,
            content_type=content_type,
            authorization=self._authorization,
            scrub=self.secret.scrub,
            transport=self.transport,
        )
        reply = reply.scrubbed(self.secret.scrub)
        _LOG.debug("%s answered %d, request id %s", url, reply.status, reply.headers.get("x-request-id", "unknown"))
        return reply

    def _authorization(self) -> str:
        return f"Bearer {self.secret.reveal()}" if self.secret.reveal() else ""


def _encoded(body: Mapping[str, Any]) -> bytes:
    try:
        # A lone surrogate (a file name that is not UTF-8) becomes a question mark.
        return json.dumps(body, ensure_ascii=False, allow_nan=False).encode("utf-8", "replace")
    except (TypeError, ValueError) as cause:
        raise BackendError(
            f"no JSON for this request: {cause}. Use texts, finite numbers, lists and objects."
        ) from cause


def _checked_url(base_url: str) -> str:
    if not isinstance(base_url, str):
        raise ConfigError(f"base_url is {checks.represented(base_url)}; it must be a text with the server's address.")
    try:
        parts = urlsplit(base_url)
        _ = parts.port  # raises for a port that is no number up to 65535
    except ValueError as cause:
        raise ConfigError(f"base_url is no address: {cause}. It must look like 'https://api.openai.com/v1'.") from cause
    if "@" in parts.netloc or parts.query:
        raise ConfigError("base_url carries credentials or a query; give the key as api_key, where it stays hidden.")
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ConfigError(f"base_url is {base_url!r}; it must look like 'https://api.openai.com/v1'.")
    return base_url.rstrip("/")
