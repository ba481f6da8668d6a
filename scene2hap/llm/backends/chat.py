"""Chat completions, the format of OpenAI and most local servers: request bodies and parsed replies."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from scene2hap.common.web import WebReply
from scene2hap.errors import AnswerRefused, BackendUnavailable
from scene2hap.llm.answers.refusals import FILTERED_REQUEST
from scene2hap.llm.answers.usable import AFTER_REFUSAL, RawReply, UnusableAnswer
from scene2hap.llm.backends.http_errors import failure, server_error
from scene2hap.llm.prompts.quoting import shown
from scene2hap.llm.protocol import LLMRequest


def user_message(request: LLMRequest, text: str, detail: str) -> dict[str, Any]:
    """Return one message: the text, then the pictures in their order, as data URLs.

    `detail` sets the price of a picture at OpenAI. Most local servers ignore it, but some pass it on to a service.
    """
    parts: list[dict[str, Any]] = [{"type": "text", "text": text}]
    for png in request.images:
        picture = {"url": f"data:image/png;base64,{as_base64(png)}"}
        parts.append({"type": "image_url", "image_url": {**picture, "detail": detail}})
    return {"role": "user", "content": parts}


def as_base64(png: bytes) -> str:
    """Encode a picture as base64 text without line breaks."""
    return base64.b64encode(png).decode("ascii")


def json_schema_format(request: LLMRequest, schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return the `response_format` that forces a schema, in the nested form: llama.cpp reads no other."""
    return {"type": "json_schema", "json_schema": {"name": request.component, "strict": True, "schema": schema}}


def read_chat(reply: WebReply, model: str) -> RawReply:
    """Read a chat completion. `model` is used if the server does not name one.

    Raises: BackendUnavailable: an error status, or an error under status 200. UnusableAnswer: not a chat completion.
    """
    body = json_object(reply)
    choices = body.get("choices")
    choice = choices[0] if isinstance(choices, list) and choices else None
    message = choice.get("message") if isinstance(choice, dict) else None
    if choice is None or not isinstance(message, dict):
        raise UnusableAnswer(
            f"{reply.url} sent no chat completion. Check base_url and the dialect.",
            reply.text,
            model=text_of(body.get("model")) or model,
            usage=_usage(body.get("usage")),
        )
    return RawReply(
        text=_content(message),
        model=text_of(body.get("model")) or model,
        finish_reason=text_of(choice.get("finish_reason")) or "stop",
        usage=_usage(body.get("usage")),
        thoughts=text_of(message.get("reasoning_content")) or text_of(message.get("reasoning")),
        refusal=text_of(message.get("refusal")),
        service_tier=text_of(body.get("service_tier")),
    )


def _content(message: Mapping[str, Any]) -> str:
    """Return the text of a message.

    Some services send it in parts. Some send the answer as the arguments of a tool, although none was offered.
    """
    content, calls = message.get("content"), message.get("tool_calls")
    parts = content if isinstance(content, list) else ()
    text = text_of(content) or "".join(text_of(part.get("text")) for part in parts if isinstance(part, dict))
    if text:
        return text
    call = calls[0] if isinstance(calls, list) and calls else None
    function = call.get("function") if isinstance(call, dict) else message.get("function_call")
    arguments = function.get("arguments") if isinstance(function, dict) else None
    # OpenAI sends arguments as text; gateways of models that send an object pass it on.
    return json.dumps(arguments) if isinstance(arguments, dict) and arguments else text_of(arguments)


def is_withheld(reply: WebReply) -> bool:
    """Return True if a filter kept the question from the model."""
    error = server_error(reply)
    return reply.status == 400 and not FILTERED_REQUEST.isdisjoint({error.code, error.type})


def json_object(reply: WebReply) -> dict[str, Any]:
    """Return the body of a successful reply.

    Raises: BackendUnavailable: an error status, an error under status 200, or no JSON object. Truncated JSON is
    retryable, since it may arrive complete the next time; a page of HTML is not. AnswerRefused: a filter withheld the
    question.
    """
    body = reply.json()
    if not reply.ok:
        if is_withheld(reply):
            said = shown(server_error(reply).message)
            raise AnswerRefused(f"{reply.url} withheld the question from the model: {said}. {AFTER_REFUSAL}")
        raise failure(reply)
    if body is None and reply.text.lstrip().startswith("{"):
        raise BackendUnavailable(
            f"{reply.url} answered {reply.status} with JSON that breaks off after {len(reply.text)} characters.",
            retryable=True,
        )
    if not isinstance(body, dict):
        is_stream = reply.text.lstrip().startswith(("data:", "event:"))
        hint = "It streams, which was not requested: switch that off at the server." if is_stream else "Check base_url."
        raise BackendUnavailable(f"{reply.url} answered {reply.status} without a JSON object. {hint}")
    if body.get("error"):
        error = server_error(reply)
        if error.code in _ERROR_STATUSES:  # of a gateway, which had sent its own status before its provider failed
            return json_object(replace(reply, status=int(error.code)))
        raise BackendUnavailable(f"{reply.url} answered {reply.status} with an error: {error.message}.")
    return body


_ERROR_STATUSES = frozenset(map(str, range(400, 600)))


def text_of(value: object) -> str:
    """Return the value if it is a text, else ""."""
    return value if isinstance(value, str) else ""


def _usage(usage: object) -> dict[str, int]:
    """Return the token counts of a chat completion, including prompt tokens served from the service's prompt cache.

    Some services bill thoughts that only `total_tokens` counts.
    """
    details = usage.get("prompt_tokens_details") if isinstance(usage, dict) else None
    cached = counts(details).get("cached_tokens", 0)
    used = counts(usage)
    if {"prompt_tokens", "completion_tokens", "total_tokens"} <= used.keys():
        used["completion_tokens"] = max(used["completion_tokens"], used["total_tokens"] - used["prompt_tokens"])
    return {**used, **({"cached_tokens": cached} if cached else {})}


_MOST_TOKENS = 2**53
"""Larger counts are no counts, and their cost may exceed any number."""


def counts(usage: object) -> dict[str, int]:
    """Return the valid token counts in a server's usage report. Some servers write whole numbers as 12.0."""
    items = usage.items() if isinstance(usage, dict) else ()
    numbers = {name: n for name, n in items if isinstance(n, int | float) and not isinstance(n, bool)}
    return {name: int(n) for name, n in numbers.items() if 0 <= n < _MOST_TOKENS and n == int(n)}
