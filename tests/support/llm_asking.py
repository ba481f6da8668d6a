"""LLM backends connected to a scripted server, and a function that sends them one request."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from llm_server import KEY, Scripted, Server, request
from openai_schema import openai_serving
from scene2hap import LocalBackend, OpenAIBackend
from scene2hap.errors import BackendUnavailable
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest


def ask(backend: LLMBackend, asked: LLMRequest | None = None) -> LLMReply:
    return asyncio.run(backend.complete(asked or request()))


def openai(server: Server, **settings: Any) -> OpenAIBackend:
    return OpenAIBackend(**{"api_key": KEY, "base_url": f"{server.base_url}/v1", **settings})


def local(server: Server, **settings: Any) -> LocalBackend:
    return LocalBackend(**{"model": "llava", "base_url": f"{server.base_url}/v1", **settings})


def ollama(server: Server, **settings: Any) -> LocalBackend:
    return LocalBackend(**{"model": "qwen2.5vl", "base_url": server.base_url, "dialect": "ollama", **settings})


def failed(*script: Scripted, **settings: Any) -> BackendUnavailable:
    """The error that an OpenAI backend raises for scripted answers."""
    with openai_serving(*script) as server, pytest.raises(BackendUnavailable) as caught:
        ask(openai(server, **settings))
    return caught.value
