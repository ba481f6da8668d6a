"""The files and batches of an OpenAI-compatible server."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Any

from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable, BadAnswer
from scene2hap.llm.backends import chat
from scene2hap.llm.backends.http_client import Endpoint

COMPLETIONS = "/v1/chat/completions"
"""The endpoint of every request of a batch."""
MOST_REQUESTS = 50_000
MOST_BYTES = 200 * 10**6
"""Limits of one batch, set by the service."""

_ENDED = frozenset({"completed", "failed", "expired", "cancelled"})
_WAITS_S = (1.0, 4.0, 16.0)
_PAGE = 100
_MOST_PAGES = 1000
"""Assumed: more batches than an account keeps. A broken server may list one page without end."""


@dataclass(frozen=True)
class BatchStatus:
    """State of a batch, from the server. `faults` are errors of the batch as a whole."""

    id: str
    status: str
    output_file: str = ""
    error_file: str = ""
    completed: int = 0
    failed: int = 0
    faults: tuple[str, ...] = ()

    @property
    def has_ended(self) -> bool:
        """True if nothing more will come."""
        return self.status in _ENDED


class BatchService:
    """Client of a server's batches. Retries after transient errors, if a second request does no harm.

    Every method raises BackendUnavailable: no answer, or a refusal; BadAnswer: an unexpected reply.
    """

    def __init__(self, endpoint: Endpoint, *, sleep: Callable[[float], Awaitable[object]] = asyncio.sleep) -> None:
        self._endpoint, self._sleep = endpoint, sleep

    async def upload(self, name: str, content: bytes) -> str:
        """Upload a file of requests. Returns its id."""
        fields = {"purpose": "batch"}
        reply = await self._patiently(lambda: self._endpoint.upload("files", name, content, fields))
        return _file_id(reply)

    async def create(self, input_file: str) -> BatchStatus:
        """Begin a batch. It is never retried automatically, since a second batch would cost money."""
        body = {"input_file_id": input_file, "endpoint": COMPLETIONS, "completion_window": "24h"}
        return _status(chat.json_object(await self._endpoint.post("batches", body)))

    async def status(self, batch: str) -> BatchStatus:
        """Return the state of a batch."""
        return _status(chat.json_object(await self._get(f"batches/{batch}")))

    async def begun_with(self, input_file: str) -> BatchStatus | None:
        """Return the batch that uses a file of requests, in case the server's reply was lost; None if there is none."""
        after = ""
        for _ in range(_MOST_PAGES):
            page = chat.json_object(await self._get(f"batches?limit={_PAGE}{after}"))
            listed = page.get("data")
            rows = [row for row in listed if isinstance(row, dict)] if isinstance(listed, list) else []
            for row in rows:
                if row.get("input_file_id") == input_file:
                    return _status(row)
            if not rows or not page.get("has_more"):
                return None
            after = f"&after={chat.text_of(rows[-1].get('id'))}"
        raise BadAnswer(f"the server lists more than {_MOST_PAGES * _PAGE:,} batches. Does it repeat a page?")

    async def cancel(self, batch: str) -> BatchStatus:
        """End a batch early. Answers received until then are kept and billed."""
        return _status(chat.json_object(await self._endpoint.post(f"batches/{batch}/cancel", {})))

    async def content(self, file: str) -> str:
        """Return the text of a file."""
        reply = await self._patiently(lambda: self._endpoint.download(f"files/{file}/content"))
        return reply.text

    async def _get(self, path: str) -> WebReply:
        return await self._patiently(lambda: self._endpoint.get(path, self._endpoint.timeout_s))

    async def _patiently(self, ask: Callable[[], Awaitable[WebReply]]) -> WebReply:
        for wait_s in _WAITS_S:
            try:
                return _successful(await ask())
            except BackendUnavailable as problem:
                if not problem.retryable:
                    raise
                await self._sleep(problem.retry_after_s or wait_s)
        return _successful(await ask())


def _successful(reply: WebReply) -> WebReply:
    if not reply.ok:
        chat.json_object(reply)  # raises the error for the status
    return reply


def _file_id(reply: WebReply) -> str:
    found = chat.text_of(chat.json_object(reply).get("id"))
    if not found:
        raise BadAnswer(f"{reply.url} answered without the id of a file. Does this server have batches?", reply.text)
    return found


def _status(body: Mapping[str, Any]) -> BatchStatus:
    batch, status = chat.text_of(body.get("id")), chat.text_of(body.get("status"))
    if not batch or not status:
        raise BadAnswer("the server answered without the id or status of a batch. Does it have batches?", repr(body))
    counts = chat.counts(body.get("request_counts"))
    errors = body.get("errors")
    faults = errors.get("data") if isinstance(errors, dict) else None
    listed = faults if isinstance(faults, list) else []
    messages = [chat.text_of(fault.get("message")) for fault in listed if isinstance(fault, dict)]
    return BatchStatus(
        batch,
        status,
        chat.text_of(body.get("output_file_id")),
        chat.text_of(body.get("error_file_id")),
        counts.get("completed", 0),
        counts.get("failed", 0),
        tuple(message for message in messages if message),
    )
