"""Chat completions, the one shape that OpenAI and most local servers share: bodies out, what was said in."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from scene2hap.errors import BackendUnavailable, BadAnswer
from scene2hap.llm.http_client import HttpReply
from scene2hap.llm.http_errors import failure, server_error
from scene2hap.llm.protocol import LLMRequest


class BackendWarning(UserWarning):
    """A model or its server did something else than it was asked to; the answer may be worse for it."""


class UnusableAnswer(BadAnswer):
    """A bad answer that was paid for: `model` wrote it, `usage` counts its tokens where they are known."""

    def __init__(
        self, message: str, raw_text: str = "", *, model: str = "", usage: Mapping[str, int] | None = None
    ) -> None:
        super().__init__(message, raw_text)
        self.model = model
        self.usage = dict(usage or {})


@dataclass(frozen=True)
class Said:
    """What a model said, before anyone judged it. `thoughts` is where some servers put the answer by mistake."""

    content: str
    model: str
    finish_reason: str = "stop"
    usage: Mapping[str, int] = field(default_factory=dict)
    thoughts: str = ""
    refusal: str = ""


def user_message(request: LLMRequest, text: str, detail: str | None = None) -> dict[str, Any]:
    """One message with the text and then the pictures, in their order, as data URLs.

    `detail` is what OpenAI bills a picture by; local servers have no use for it.
    """
    parts: list[dict[str, Any]] = [{"type": "text", "text": text}]
    for png in request.images:
        picture = {"url": f"data:image/png;base64,{as_base64(png)}"}
        parts.append({"type": "image_url", "image_url": picture if detail is None else {**picture, "detail": detail}})
    return {"role": "user", "content": parts}


def as_base64(png: bytes) -> str:
    """A picture as base64 text, without line breaks."""
    return base64.b64encode(png).decode("ascii")


def json_schema_format(request: LLMRequest, schema: Mapping[str, Any]) -> dict[str, Any]:
    """The `response_format` that holds a model to a schema; the nested form, the only one that llama.cpp reads."""
    return {"type": "json_schema", "json_schema": {"name": request.component, "strict": True, "schema": schema}}


def about(request: LLMRequest) -> str:
    """What a request asks, for messages."""
    return f"{request.component} about {request.subject or 'the scene'!r}"


def read_chat(reply: HttpReply, model: str) -> Said:
    """What a chat completion says; `model` stands in where the server does not name one.

    Raises: BackendUnavailable: no success, or an error sent under status 200; BadAnswer: not a chat completion.
    """
    body = json_object(reply)
    choices = body.get("choices")
    choice = choices[0] if isinstance(choices, list) and choices else None
    message = choice.get("message") if isinstance(choice, dict) else None
    if choice is None or not isinstance(message, dict):
        raise BadAnswer(f"{reply.url} sent no chat completion. Check base_url and the dialect.", reply.text)
    return Said(
        content=text_of(message.get("content")),
        model=text_of(body.get("model")) or model,
        finish_reason=text_of(choice.get("finish_reason")) or "stop",
        usage=counts(body.get("usage")),
        thoughts=text_of(message.get("reasoning_content")) or text_of(message.get("reasoning")),
        refusal=text_of(message.get("refusal")),
    )


def require_whole(said: Said, asked: str) -> None:
    """Reject what must not be parsed, whatever the content looks like.

    Raises: UnusableAnswer: cut short, filtered or refused, with what there is of the answer.
    """
    if said.finish_reason == "length":
        raise unusable(
            said,
            f"{asked}: {said.model} was cut off at its token limit. Raise max_tokens (or num_ctx), or switch off "
            "its reasoning.",
            said.content,
        )
    if said.finish_reason == "content_filter":
        raise unusable(said, f"{asked}: the answer of {said.model} was withheld by a content filter.", said.content)
    if said.refusal:
        raise unusable(said, f"{asked}: {said.model} refused: {said.refusal}", said.refusal)


def unusable(said: Said, message: str, raw_text: str) -> UnusableAnswer:
    """The error for what a model said, with what it cost."""
    return UnusableAnswer(message, raw_text, model=said.model, usage=said.usage)


def json_object(reply: HttpReply) -> dict[str, Any]:
    """The body of a successful reply.

    Raises: BackendUnavailable: no success, an error sent under status 200, or no JSON object. One that breaks off may
    come whole the next time; a page of HTML will not.
    """
    body = reply.json()
    if not reply.ok:
        raise failure(reply)
    if body is None and reply.text.lstrip().startswith("{"):
        raise BackendUnavailable(
            f"{reply.url} answered {reply.status} with JSON that breaks off after {len(reply.text)} characters.",
            retryable=True,
        )
    if not isinstance(body, dict):
        raise BackendUnavailable(f"{reply.url} answered {reply.status} without a JSON object. Check base_url.")
    if body.get("error"):
        raise BackendUnavailable(f"{reply.url} answered {reply.status} with an error: {server_error(reply).message}.")
    return body


def text_of(value: object) -> str:
    """The value where it is a text, else ""."""
    return value if isinstance(value, str) else ""


def counts(usage: object) -> dict[str, int]:
    """The token counts among what a server reports."""
    items = usage.items() if isinstance(usage, dict) else ()
    return {name: n for name, n in items if isinstance(n, int) and not isinstance(n, bool) and n >= 0}
