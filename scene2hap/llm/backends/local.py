"""LocalBackend: answers of a model on your own machine or network.

Local servers implement structured output incompletely. So the prompt also lists the fields of the answer. If a server
rejects a form, a less strict one is requested; a parameter that it rejects is no longer sent.
The answer is extracted from the text of the reply.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, Literal

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.secret import Secret
from scene2hap.common.warning import warn_of
from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.llm.answers.json_text import first_object
from scene2hap.llm.answers.schema import fields_in_words
from scene2hap.llm.answers.usable import RawReply, question_of, require_whole, unusable
from scene2hap.llm.backends import chat, server_models
from scene2hap.llm.backends.dialects import (
    RESPONSE_FORMATS,
    ChatCompletions,
    Decoding,
    Dialect,
    OllamaChat,
    ResponseFormat,
)
from scene2hap.llm.backends.http_client import Endpoint
from scene2hap.llm.backends.image_tokens import LostImages
from scene2hap.llm.backends.optional_parameters import OptionalParameters
from scene2hap.llm.protocol import BackendWarning, LLMReply, LLMRequest

if TYPE_CHECKING:
    from scene2hap.common.web import Transport

_FORM_REJECTED = frozenset({400, 422, 501})
_OURS = frozenset({"model", "messages", "images", "response_format", "format", "stream", "max_tokens", "num_predict"})
"""Fields that `extra` may not set, since the backend sets them itself."""


@clear_construction
class LocalBackend:
    """Answer by a model on a server of your own: Ollama, vLLM, llama.cpp or LM Studio.

    Parameters:
    model : its name on the server; None if the server has only one.
    base_url : with "/v1" for dialect "openai" (vLLM, llama.cpp, LM Studio), without for "ollama"
        (http://127.0.0.1:11434).
    num_ctx : context in tokens, for Ollama, whose default of 4096 loses pictures.
    max_tokens : of one answer (assumed: answers stay below 600, and only endless output is longer).
    top_p : share of the likeliest words, 0..1.
    reasoning_effort : "none" to "high", if the server supports it.
    chat_template_kwargs : such as {"enable_thinking": False}, for llama.cpp and vLLM.
    extra : further fields, sent unchanged.
    detail : of pictures, "auto", "low" or "high", in dialect "openai".
    timeout_s : for one answer, including the server's queue, since most servers answer one request at a time.
    api_key : if the server needs one; never taken from the environment.
    transport : for tests.
    Raises: ConfigError: a setting that cannot work.
    """

    def __init__(
        self,
        model: str | None = None,
        *,
        base_url: str,
        dialect: Literal["openai", "ollama"] = "openai",
        num_ctx: int = 16384,
        max_tokens: int = 2048,
        top_p: float | None = None,
        seed: int = 0,
        reasoning_effort: str | None = None,
        chat_template_kwargs: Mapping[str, Any] | None = None,
        extra: Mapping[str, Any] | None = None,
        detail: Literal["auto", "low", "high"] = "auto",
        timeout_s: float = 600.0,
        api_key: str | None = None,
        transport: Transport | None = None,
    ) -> None:
        if dialect not in ("openai", "ollama"):
            raise ConfigError(f"dialect is {dialect!r}; it must be 'openai' or 'ollama'.")
        if detail not in ("auto", "low", "high"):
            raise ConfigError(f"detail is {detail!r}; it must be 'auto', 'low' or 'high'.")
        num_ctx, max_tokens = (
            checks.whole(name, value, "tokens", at_least=1, at_most=2**31, error=ConfigError)
            for name, value in (("num_ctx", num_ctx), ("max_tokens", max_tokens))
        )
        seed = checks.seed(seed)
        if top_p is not None:
            checks.number("top_p", top_p, "-", above=0.0, at_most=1.0, error=ConfigError)
        taken = sorted(_OURS & set(extra or ()))
        if taken:
            raise ConfigError(f"extra sets {', '.join(taken)}, which the backend sets itself; leave it out.")
        if chat_template_kwargs is not None and dialect == "ollama":
            raise ConfigError("Ollama has no chat_template_kwargs; use reasoning_effort, or dialect='openai'.")
        self.model = model
        self._decoding = Decoding(
            max_tokens, seed, num_ctx, top_p, reasoning_effort, chat_template_kwargs, dict(extra or {}), detail
        )
        self._dialect: Dialect = (OllamaChat if dialect == "ollama" else ChatCompletions)(self._decoding)
        self._endpoint = Endpoint(base_url, Secret(api_key), timeout_s, transport)
        self._optional = OptionalParameters()
        self._form = 0
        self._lost_images = LostImages()
        self._vision_checked = False

    def __repr__(self) -> str:
        dialect = "ollama" if self._is_ollama else "openai"
        return f"LocalBackend({self.model!r}, base_url={self._endpoint.base_url!r}, dialect={dialect!r})"

    @property
    def identity(self) -> dict[str, Any]:
        """The settings on which an answer depends; never a key. The model is None until `ready` has run."""
        return {"model": self.model, "base_url": self._endpoint.base_url, **asdict(self._decoding)}

    @property
    def response_format(self) -> ResponseFormat:
        """The form of the answer that this server accepted last."""
        return RESPONSE_FORMATS[self._form]

    async def ready(self) -> None:
        """Find the name of the served model if none was given.

        Raises: BackendUnavailable: the server does not answer or names no model. ConfigError: it serves several models.
        """
        if self.model is None:
            self.model = server_models.only_one(await self._models(), self._endpoint.base_url)

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the JSON object in the model's answer, or its whole text if there is none.

        Raises: BackendUnavailable: no answer, or pictures for a model without vision; states whether a retry can help.
        BadAnswer: cut short or empty.
        """
        await self.ready()
        if request.images and not self._vision_checked:
            await self._check_vision()
        said = await self._ask(request)
        self._lost_images.look(request, said)
        require_whole(said, question_of(request))
        text = first_object(said.text) or said.text or first_object(said.thoughts)
        if not text:
            message = f"{question_of(request)}: {said.model} answered without content. Switch off its reasoning."
            raise unusable(said, message, said.thoughts)
        return LLMReply(text, said.model, said.finish_reason, said.usage, service_tier=said.service_tier)

    @property
    def _is_ollama(self) -> bool:
        return isinstance(self._dialect, OllamaChat)

    async def _ask(self, request: LLMRequest) -> RawReply:
        for form in range(self._form, len(RESPONSE_FORMATS)):
            reply = await self._post(request, RESPONSE_FORMATS[form])
            if reply.status not in _FORM_REJECTED or chat.is_withheld(reply):
                break
        if reply.ok:
            # Store a form only on success: a request that fails in every form (too long a prompt) proves nothing.
            self._form = max(self._form, form)
        return self._dialect.read(reply, self.model or "")

    async def _post(self, request: LLMRequest, form: ResponseFormat) -> WebReply:
        text = f"{request.prompt}\n\n{fields_in_words(request.answer_schema)}"
        body = self._dialect.body(request, self.model or "", text, form)
        while True:
            sent = self._optional.adapted(body)
            reply = await self._endpoint.post(self._dialect.path, sent)
            if not self._optional.learns(reply, self.model or self._endpoint.base_url, sent):
                return reply

    async def _models(self) -> tuple[server_models.ServerModel, ...]:
        return await (server_models.ollama_models if self._is_ollama else server_models.openai_models)(self._endpoint)

    async def _check_vision(self) -> None:
        """Check once whether the server reports that the model reads pictures. Without a report, assume that it does.

        Raises: BackendUnavailable: the model does not read pictures.
        """
        sees: bool | None = None
        try:
            if self._is_ollama:
                sees = await server_models.ollama_sees(self._endpoint, self.model or "")
            else:
                ours = [model for model in await self._models() if model.name == self.model]
                sees = ours[0].sees if ours else None
                self._warn_of_ollama(bool(ours) and ours[0].owner == "library")
        except BackendUnavailable:
            return  # the request itself will fail too, and will be retried
        if sees is False:
            raise BackendUnavailable(
                f"{self.model} at {self._endpoint.base_url} takes no pictures. Choose a model that sees (llama.cpp "
                "needs its --mmproj), or bake a scene without images."
            )
        self._vision_checked = True

    def _warn_of_ollama(self, is_ollama: bool) -> None:
        if is_ollama and not self._vision_checked:
            warn_of(
                f"{self._endpoint.base_url} is an Ollama, whose /v1 drops pictures that do not fit, without an error. "
                "Use dialect='ollama' and the address without /v1.",
                BackendWarning,
            )
