"""What a status that is not success means: whether trying again can help, and when.

Retries as OpenAI's own Python client: 408, 409, 429 and 500 upwards, unless `x-should-retry` says otherwise. An empty
account answers 429 as well, but no waiting fills it.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from email.utils import parsedate_to_datetime
from typing import Any

from scene2hap.errors import BackendUnavailable
from scene2hap.llm.http_client import HttpReply

LONGEST_WAIT_S = 120.0
"""A server that asks for more is given up, as by OpenAI's client."""

_RETRYABLE = frozenset({408, 409, 429})
_OUT_OF_MONEY = frozenset(
    {
        "insufficient_quota",
        "credit_balance_exhausted",
        "organization_spend_limit_exceeded",
        "project_spend_limit_exceeded",
        "organization_usage_limit_exceeded",
    }
)
_NO_EYES = "image input is not supported"
"""What llama.cpp says, with status 500, where it was started without a vision projector."""

_HINTS = {
    401: "Check the API key.",
    403: "Check the API key and what it is allowed to do.",
    404: "Check base_url and the name of the model.",
    413: "Send fewer or smaller pictures.",
}
_LONGEST_SHOWN = 500


@dataclass(frozen=True)
class ServerError:
    """The body of an error, in whichever of the usual forms: fields that are not there are ""."""

    message: str = ""
    type: str = ""
    param: str = ""
    code: str = ""


def server_error(reply: HttpReply) -> ServerError:
    """The error that a server describes.

    OpenAI, llama.cpp and Ollama's /v1 send {"error": {...}}, native Ollama and LM Studio {"error": "text"}, older
    vLLM the fields themselves.
    """
    body = reply.json()
    error: Any = body.get("error", body) if isinstance(body, dict) else body
    if isinstance(error, dict):
        return ServerError(*(_text(error.get(name)) for name in ("message", "type", "param", "code")))
    return ServerError(_text(error) or reply.text)


def failure(reply: HttpReply, *, now_s: float | None = None) -> BackendUnavailable:
    """The error to raise for a reply without success; `now_s` [s since 1970] is what a date is counted from."""
    error = server_error(reply)
    wait_s = _wait_s(reply, time.time() if now_s is None else now_s)
    kind = error.code or error.type
    said = " ".join(error.message.split())[:_LONGEST_SHOWN]
    parts = [f"{reply.url} answered {reply.status}{f' ({kind})' if kind else ''}: {said or 'nothing more'}."]
    if "x-request-id" in reply.headers:
        parts.append(f"Request id {reply.headers['x-request-id']}.")
    retryable = _retryable(reply)
    if {error.code, error.type} & _OUT_OF_MONEY:
        retryable = False
        parts.append("The account is used up: raise its limit or choose another backend.")
    elif _NO_EYES in error.message:
        retryable = False
        parts.append("Start the server with the model's vision projector (--mmproj) or choose a model that sees.")
    elif wait_s is not None and wait_s > LONGEST_WAIT_S:
        retryable = False
        parts.append(f"It asks to wait {wait_s:.0f} s; try again then.")
    elif reply.status in _HINTS:
        parts.append(_HINTS[reply.status])
    return BackendUnavailable(" ".join(parts), retryable=retryable, retry_after_s=wait_s)


def _retryable(reply: HttpReply) -> bool:
    told = reply.headers.get("x-should-retry", "").lower()
    if told in ("true", "false"):
        return told == "true"
    return reply.status in _RETRYABLE or reply.status >= 500


def _wait_s(reply: HttpReply, now_s: float) -> float | None:
    """How long the server asks to wait [s], None where it does not say so in a form that makes sense."""
    milliseconds = _number(reply.headers.get("retry-after-ms"))
    if milliseconds is not None:
        return milliseconds / 1000.0
    told = reply.headers.get("retry-after")
    seconds = _number(told)
    if seconds is not None or told is None:
        return seconds
    try:
        return max(parsedate_to_datetime(told).timestamp() - now_s, 0.0)
    except (ValueError, OverflowError):
        return None


def _number(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if math.isfinite(value) and value >= 0.0 else None


def _text(value: object) -> str:
    return str(value) if isinstance(value, str | int) else ""
