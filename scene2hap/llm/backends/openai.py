"""OpenAIBackend: answers by OpenAI's chat completions with strict structured output.

Local servers share chat completions, and not the newer responses format.
Source: the OpenAPI description in openai/openai-openapi; OpenAI's guides "Structured outputs" and "Images and vision".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.secret import Secret
from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.llm.answers.schema import strict_schema
from scene2hap.llm.answers.usable import RawReply, question_of, require_whole, unusable
from scene2hap.llm.backends import chat
from scene2hap.llm.backends.http_client import Endpoint
from scene2hap.llm.backends.http_errors import server_error
from scene2hap.llm.backends.image_tokens import ImagesAsText
from scene2hap.llm.backends.optional_parameters import OptionalParameters
from scene2hap.llm.protocol import LLMReply, LLMRequest

if TYPE_CHECKING:
    from scene2hap.common.web import Transport

KEY_VARIABLE = "OPENAI_API_KEY"
BASE_URL = "https://api.openai.com/v1"

TIMEOUT_S, FLEX_TIMEOUT_S = 120.0, 900.0
"""Longest wait for one answer [s]. The value for the flex tier is from OpenAI's guide "Flex processing"."""

_NO_CAPACITY = "resource_unavailable"
"""Error code with status 429 if a cheaper tier has no capacity. Such a call is not billed."""


@clear_construction
class OpenAIBackend:
    """Answer by a model of OpenAI, or of a service with the same interface.

    Parameters:
    model : its name.
    api_key : by default the environment variable OPENAI_API_KEY, read at each call.
    base_url : address of another service with the same interface.
    detail : of pictures, "low" (cheap) or "high"; always sent, since the default differs between models.
    timeout_s : for one answer; None for 120 s, or 900 s in the flex tier.
    max_tokens : of one answer, including reasoning.
    top_p : share of the likeliest words, 0..1.
    seed : OpenAI does not guarantee equal answers for equal seeds.
    reasoning_effort : "none" to "xhigh", as far as the model supports it.
    service_tier : "flex" gives slower answers at half the price; None takes the project's tier. If the model is not
        offered in this tier, or the tier has no capacity, the question is sent again without a tier.
    transport : for tests.

    Raises: ConfigError: a setting that cannot work.
    """

    def __init__(
        self,
        model: str = "gpt-4o",
        *,
        api_key: str | None = None,
        base_url: str = BASE_URL,
        detail: Literal["low", "high"] = "low",
        timeout_s: float | None = None,
        max_tokens: int | None = None,
        top_p: float | None = None,
        seed: int | None = None,
        reasoning_effort: str | None = None,
        service_tier: Literal["auto", "default", "flex", "priority"] | None = None,
        transport: Transport | None = None,
    ) -> None:
        if detail not in ("low", "high"):
            raise ConfigError(f"detail is {detail!r}; it must be 'low' or 'high'.")
        if max_tokens is not None:
            max_tokens = checks.whole("max_tokens", max_tokens, "tokens", at_least=1, at_most=2**31, error=ConfigError)
        if seed is not None:
            seed = checks.seed(seed)
        if top_p is not None:
            checks.number("top_p", top_p, "-", above=0.0, at_most=1.0, error=ConfigError)
        if service_tier not in (None, "auto", "default", "flex", "priority"):
            raise ConfigError(
                f"service_tier is {service_tier!r}; it must be 'auto', 'default', 'flex' (half the price), 'priority', "
                "or None."
            )
        if timeout_s is None:
            timeout_s = FLEX_TIMEOUT_S if service_tier == "flex" else TIMEOUT_S
        self.model = model
        self._detail = detail
        self._tier = service_tier
        self._without_capacity = 0
        self._secret = Secret(api_key, KEY_VARIABLE)
        self._endpoint = Endpoint(base_url, self._secret, timeout_s, transport)
        self._decoding = {
            "max_tokens": max_tokens,
            "top_p": top_p,
            "seed": seed,
            "reasoning_effort": reasoning_effort,
        }
        self._optional = OptionalParameters()
        self._images_as_text = ImagesAsText(detail)

    def __repr__(self) -> str:
        return f"OpenAIBackend({self.model!r}, base_url={self._endpoint.base_url!r})"

    @property
    def endpoint(self) -> Endpoint:
        """The server that requests go to."""
        return self._endpoint

    @property
    def service_tier(self) -> str:
        """The requested tier, "" for the project's default tier."""
        return self._tier or ""

    @property
    def timeout_s(self) -> float:
        """Longest wait for one answer [s]."""
        return self._endpoint.timeout_s

    @property
    def identity(self) -> dict[str, Any]:
        """The settings, besides the request, on which an answer depends; never the key."""
        return {"model": self.model, "base_url": self._endpoint.base_url, "detail": self._detail, **self._decoding}

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the model's answer.

        Raises: BackendUnavailable: no answer; states whether a retry can help. BadAnswer: cut short, filtered,
        refused or empty.
        """
        if not self._secret.reveal():
            raise BackendUnavailable(f"no API key. Set {KEY_VARIABLE} or give api_key.")
        return self.judged(request, await self._ask(self._body(request)))

    def body(self, request: LLMRequest) -> dict[str, Any]:
        """Return the body of a request, without parameters that this model has rejected."""
        return self._optional.adapted(self._body(request))

    def judged(self, request: LLMRequest, said: RawReply) -> LLMReply:
        """Return the reply for a chat completion. Raises: BadAnswer: as `complete`."""
        self._images_as_text.look(request, said)
        require_whole(said, question_of(request))
        if not said.text:
            raise unusable(said, f"{question_of(request)}: {said.model} answered without content.", "")
        return LLMReply(said.text, said.model, said.finish_reason, said.usage, service_tier=said.service_tier)

    def report(self) -> dict[str, int]:
        """Count the requests repeated without the requested tier because it had no capacity."""
        return {"without_capacity": self._without_capacity}

    def _body(self, request: LLMRequest) -> dict[str, Any]:
        return {
            "model": self.model,
            "messages": [chat.user_message(request, request.prompt, self._detail)],
            "response_format": chat.json_schema_format(request, strict_schema(request.answer_schema)),
            "temperature": request.temperature,
            **{name: value for name, value in self._decoding.items() if value is not None},
            **({} if self._tier is None else {"service_tier": self._tier}),
        }

    async def _ask(self, body: dict[str, Any]) -> RawReply:
        """Post the request, and repeat it once without each parameter that the model rejects.

        If the tier has no capacity, only this request is repeated without the tier.
        """
        while True:
            sent = self._optional.adapted(body)
            reply = await self._endpoint.post("chat/completions", sent)
            error = server_error(reply)
            if reply.status == 429 and _NO_CAPACITY in (error.code, error.type) and "service_tier" in sent:
                self._without_capacity += 1
                body = {name: value for name, value in body.items() if name != "service_tier"}
                continue
            if not self.learns(reply, sent):
                break
        return chat.read_chat(reply, self.model)

    def learns(self, reply: WebReply, sent: Mapping[str, Any] | None = None) -> bool:
        """Return True if a reply rejects an optional parameter. From then on this parameter is not sent.

        A parameter that is not in `sent` was dropped before, so the result is False.
        """
        return self._optional.learns(reply, self.model, sent)
