"""The two request formats of local servers: OpenAI's chat completions, and Ollama's own chat.

Ollama's /v1 turns each picture into a message, and drops the first messages if they exceed the context. It also has no
option for the size of the context. So Ollama's own format is used.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from scene2hap.common.web import WebReply
from scene2hap.errors import BadAnswer
from scene2hap.llm.answers.schema import local_schema
from scene2hap.llm.answers.usable import RawReply
from scene2hap.llm.backends import chat
from scene2hap.llm.protocol import LLMRequest

ResponseFormat = Literal["json_schema", "json_object", "prompt"]
RESPONSE_FORMATS: tuple[ResponseFormat, ...] = ("json_schema", "json_object", "prompt")
"""Ways to prescribe the form of the answer in a request, strictest first. The last is the prompt alone."""


@dataclass(frozen=True)
class Decoding:
    """Settings of a local server that affect its answers, besides the request. A setting of None is not sent.

    `detail` is sent with each picture if the dialect allows it; "auto" is the servers' default. `extra` is sent
    unchanged: fields of the body, or of `options` for Ollama.
    """

    max_tokens: int
    seed: int
    num_ctx: int
    top_p: float | None = None
    reasoning_effort: str | None = None
    chat_template_kwargs: Mapping[str, Any] | None = None
    extra: Mapping[str, Any] = field(default_factory=dict)
    detail: Literal["auto", "low", "high"] = "auto"


class Dialect(Protocol):
    """Format of the requests and replies of a server."""

    path: str

    def body(self, request: LLMRequest, model: str, text: str, form: ResponseFormat) -> dict[str, Any]:
        """Return the body of a request. `text` is the prompt with the list of answer fields."""
        ...

    def read(self, reply: WebReply, model: str) -> RawReply:
        """Read a reply. Raises: BackendUnavailable, BadAnswer."""
        ...


@dataclass(frozen=True)
class ChatCompletions:
    """Dialect of vLLM, llama.cpp and LM Studio: all of them read the nested `json_schema`, and no other form."""

    decoding: Decoding
    path = "chat/completions"

    def body(self, request: LLMRequest, model: str, text: str, form: ResponseFormat) -> dict[str, Any]:
        """Return the body of a chat completion."""
        optional = {
            "top_p": self.decoding.top_p,
            "reasoning_effort": self.decoding.reasoning_effort,
            "chat_template_kwargs": self.decoding.chat_template_kwargs,
        }
        body: dict[str, Any] = {
            "model": model,
            "messages": [chat.user_message(request, text, self.decoding.detail)],
            "temperature": request.temperature,
            "seed": self.decoding.seed,
            "max_tokens": self.decoding.max_tokens,
            **{name: value for name, value in optional.items() if value is not None},
            **self.decoding.extra,
        }
        if form == "json_schema":
            body["response_format"] = chat.json_schema_format(request, local_schema(request.answer_schema))
        elif form == "json_object":
            body["response_format"] = {"type": "json_object"}
        return body

    def read(self, reply: WebReply, model: str) -> RawReply:
        """Read a reply with `chat.read_chat`."""
        return chat.read_chat(reply, model)


@dataclass(frozen=True)
class OllamaChat:
    """Dialect of Ollama: pictures beside the text of one message, no silent truncation, no reasoning by default."""

    decoding: Decoding
    path = "api/chat"

    def body(self, request: LLMRequest, model: str, text: str, form: ResponseFormat) -> dict[str, Any]:
        """Return the body of Ollama's own chat request."""
        options = {
            "num_ctx": self.decoding.num_ctx,
            "num_predict": self.decoding.max_tokens,
            "temperature": request.temperature,
            "seed": self.decoding.seed,
            **({} if self.decoding.top_p is None else {"top_p": self.decoding.top_p}),
            **self.decoding.extra,
        }
        effort = self.decoding.reasoning_effort
        body: dict[str, Any] = {
            "model": model,
            "messages": [{"role": "user", "content": text, "images": [chat.as_base64(png) for png in request.images]}],
            "stream": False,
            "think": False if effort in (None, "none") else effort,
            "truncate": False,
            "options": options,
        }
        if form == "json_schema":
            body["format"] = local_schema(request.answer_schema)
        elif form == "json_object":
            body["format"] = "json"
        return body

    def read(self, reply: WebReply, model: str) -> RawReply:
        """Translate a reply of Ollama into a chat completion."""
        body = chat.json_object(reply)
        message = body.get("message")
        if not isinstance(message, dict):
            raise BadAnswer(f"{reply.url} sent no chat message. Check base_url and the dialect.", reply.text)
        renamed = {"prompt_tokens": body.get("prompt_eval_count"), "completion_tokens": body.get("eval_count")}
        return RawReply(
            text=chat.text_of(message.get("content")),
            model=chat.text_of(body.get("model")) or model,
            finish_reason=chat.text_of(body.get("done_reason")) or "stop",
            usage=chat.counts(renamed),
            thoughts=chat.text_of(message.get("thinking")),
        )
