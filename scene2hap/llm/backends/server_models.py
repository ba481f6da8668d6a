"""The models of a local server, and their ability to read pictures.

Servers report different fields. A missing field counts as unknown, never as absent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from scene2hap.errors import BackendUnavailable, ConfigError
from scene2hap.llm.backends.chat import text_of
from scene2hap.llm.backends.http_client import Endpoint

PROBE_TIMEOUT_S = 5.0
"""Longest wait for a list of models [s] (assumed: a server has the list ready)."""


@dataclass(frozen=True)
class ServerModel:
    """One model of a server. `sees` is None if the server does not report it; `owner` is "library" on Ollama."""

    name: str
    sees: bool | None = None
    owner: str = ""


async def openai_models(endpoint: Endpoint) -> tuple[ServerModel, ...]:
    """Return the models at /v1/models: from llama.cpp with their modalities, from vLLM and LM Studio by name only.

    Raises: BackendUnavailable: the server does not answer.
    """
    reply = await endpoint.get("models", PROBE_TIMEOUT_S)
    listed = _dicts(reply.json() if reply.ok else None, "data")
    return tuple(
        ServerModel(text_of(item["id"]), _sees(item), text_of(item.get("owned_by")))
        for item in listed
        if item.get("id")
    )


async def ollama_models(endpoint: Endpoint) -> tuple[ServerModel, ...]:
    """Return the models of Ollama; newer versions report their capabilities.

    Raises: BackendUnavailable: the server does not answer.
    """
    reply = await endpoint.get("api/tags", PROBE_TIMEOUT_S)
    listed = _dicts(reply.json() if reply.ok else None, "models")
    return tuple(
        ServerModel(text_of(item.get("model")) or text_of(item.get("name")), _has_vision(item)) for item in listed
    )


async def ollama_sees(endpoint: Endpoint, model: str) -> bool | None:
    """Return True if Ollama lists "vision" among a model's capabilities; None if it lists no capabilities.

    Raises: BackendUnavailable: the server does not answer.
    """
    named = [listed for listed in await ollama_models(endpoint) if listed.name in (model, f"{model}:latest")]
    if not named or named[0].sees is not None:
        return named[0].sees if named else None
    reply = await endpoint.post("api/show", {"model": model})
    body = reply.json() if reply.ok else None
    return _has_vision(body) if isinstance(body, dict) else None


def only_one(models: tuple[ServerModel, ...], address: str) -> str:
    """Return the model to use if none was named.

    Raises: BackendUnavailable: the server names none; ConfigError: it serves several.
    """
    names = [model.name for model in models if model.name]
    if not names:
        raise BackendUnavailable(f"{address} names no model. Give `model`, or load one.")
    if len(names) > 1:
        raise ConfigError(f"{address} serves {len(names)} models ({', '.join(names[:8])}); give `model`.")
    return names[0]


def _sees(item: dict[str, Any]) -> bool | None:
    architecture = item.get("architecture")
    modalities = architecture.get("input_modalities") if isinstance(architecture, dict) else None
    return "image" in modalities if isinstance(modalities, list) else None


def _has_vision(item: dict[str, Any]) -> bool | None:
    capabilities = item.get("capabilities")
    return "vision" in capabilities if isinstance(capabilities, list) else None


def _dicts(body: object, name: str) -> list[dict[str, Any]]:
    items = body.get(name) if isinstance(body, dict) else None
    return [item for item in items if isinstance(item, dict)] if isinstance(items, list) else []
