"""Interpret an HTTP error status: whether a retry can help, and when.

The rules follow OpenAI's own Python client: retry 408, 409, 429 and 500 upwards, unless `x-should-retry`
decides otherwise. An empty account also answers 429, but waiting does not help there.
"""

from __future__ import annotations

import re
import time
from dataclasses import dataclass
from typing import Any

from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable, RequestRejected
from scene2hap.llm.backends.retry_after import LONGEST_WAIT_S, reset_wait_s, stated_wait_s

_RETRYABLE = frozenset({408, 409, 429})
_ABOUT_THE_REQUEST = frozenset({400, 413, 422})
"""Statuses of a rejected request. Another request may pass, since it has other pictures or words."""
_OUT_OF_MONEY = frozenset(
    {
        "insufficient_quota",
        "credit_balance_exhausted",
        "organization_spend_limit_exceeded",
        "project_spend_limit_exceeded",
        "organization_usage_limit_exceeded",
    }
)
_NO_VISION = "image input is not supported"
"""Message of llama.cpp, with status 500, if it was started without a vision projector."""

_ABOUT_PICTURES = re.compile(r"(?<![\w/-])(images?|image_url|pictures?|vision|multi-?modal)(?![\w-])", re.IGNORECASE)
"""Words of a refusal of pictures, but not those in the name of a model, such as llama-3.2-11b-vision-preview."""

_HINTS = {
    **dict.fromkeys((301, 302, 303, 307, 308), "It redirects, and a key is sent to base_url alone: correct base_url."),
    401: "Check the API key.",
    403: "Check the API key and what it is allowed to do.",
    404: "Check base_url and the name of the model.",
    413: "Send fewer or smaller pictures.",
}
_LONGEST_SHOWN = 500


@dataclass(frozen=True)
class ServerError:
    """The body of an error reply, in any of the usual forms. Missing fields are ""."""

    message: str = ""
    type: str = ""
    param: str = ""
    code: str = ""


def server_error(reply: WebReply) -> ServerError:
    """Return the error that a server describes.

    OpenAI, llama.cpp and Ollama's /v1 send {"error": {...}}. Native Ollama and LM Studio send {"error": "text"}. Older
    vLLM sends the fields themselves.
    """
    body = reply.json()
    error: Any = body.get("error", body) if isinstance(body, dict) else body
    if isinstance(error, dict):
        return ServerError(*(_text(error.get(name)) for name in ("message", "type", "param", "code")))
    return ServerError(_text(error) or reply.text)


def failure(reply: WebReply, *, now_s: float | None = None) -> BackendUnavailable:
    """Return the error to raise for a failed reply. Dates in headers are relative to `now_s` [s since 1970]."""
    error = server_error(reply)
    wait_s = stated_wait_s(reply.headers, time.time() if now_s is None else now_s)
    if wait_s is None and reply.status == 429:
        wait_s = reset_wait_s(reply.headers)
    kind = error.code or error.type
    said = " ".join(error.message.split())[:_LONGEST_SHOWN]
    parts = [f"{reply.url} answered {reply.status}{f' ({kind})' if kind else ''}: {said or 'nothing more'}."]
    if "x-request-id" in reply.headers:
        parts.append(f"Request id {reply.headers['x-request-id']}.")
    retryable = _retryable(reply)
    if {error.code, error.type} & _OUT_OF_MONEY:
        retryable = False
        parts.append("The account is used up: raise its limit or choose another backend.")
    elif _NO_VISION in error.message:
        retryable = False
        parts.append("Start the server with the model's vision projector (--mmproj) or choose a model that sees.")
    elif wait_s is not None and wait_s > LONGEST_WAIT_S:
        retryable = False
        parts.append(f"It asks to wait {wait_s:.0f} s; try again then.")
    elif "response_format" in f"{error.param} {error.message}":
        parts.append("For a service without strict output, use kind 'local' with its base_url, model and api_key.")
    elif reply.status in (400, 404, 422) and _ABOUT_PICTURES.search(error.message):
        parts.append(
            "If the model reads no pictures, choose one that does, or bake without them (`--no-pictures`, or a scene "
            "without capture_images)."
        )
    elif reply.status in _HINTS:
        parts.append(_HINTS[reply.status])
    is_about_request = not retryable and reply.status in _ABOUT_THE_REQUEST
    shape = RequestRejected if is_about_request else BackendUnavailable
    return shape(" ".join(parts), retryable=retryable, retry_after_s=wait_s)


def _retryable(reply: WebReply) -> bool:
    should_retry = reply.headers.get("x-should-retry", "").lower()
    if should_retry in ("true", "false"):
        return should_retry == "true"
    return reply.status in _RETRYABLE or reply.status >= 500


def _text(value: object) -> str:
    return str(value) if isinstance(value, str | int) else ""
