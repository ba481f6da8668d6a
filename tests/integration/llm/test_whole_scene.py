"""Inference of a whole scene over HTTP."""

import dataclasses
import json
from typing import Any

import pytest

from llm_asking import local, ollama, openai
from llm_server import Asked, Scripted, ollama_said, said, serving
from scene2hap import (
    FunctionBackend,
    LexiconBackend,
    RepairBackend,
    infer_haptics,
)
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scenes import box, scene


@pytest.mark.parametrize("dialect", ["openai", "ollama", "OpenAI itself"])
def test_scene_inferred_over_http_equals_direct_inference(dialect: str) -> None:
    """The lexicon acts as the model: it answers the same requests directly and through a server."""
    kitchen = scene(box("fridge", (0.7, 1.8, 0.7), (0.4, 0.9, 0.4)), box("phone", (0.1, 0.01, 0.1), (3.0, 0.7, 0.4)))
    spoken: dict[str, Any] = {}

    async def listen(asked: LLMRequest) -> LLMReply:
        reply = await LexiconBackend().complete(asked)
        spoken[asked.prompt] = json.loads(reply.text)
        return reply

    def repeat(asked: Asked) -> Scripted:
        return (ollama_said if dialect == "ollama" else said)(spoken[asked.prompt.split("\n\nAnswer with one JSON")[0]])

    direct = infer_haptics(kitchen, FunctionBackend(listen))
    with serving(by=repeat) as server:
        backend = {"openai": local, "ollama": ollama, "OpenAI itself": openai}[dialect](server)
        remote = infer_haptics(kitchen, RepairBackend(backend))
    assert len(server.asked) == len(spoken)
    assert any(haptics.vibrates for haptics in remote.values())
    for name, haptics in remote.items():
        assert dataclasses.replace(haptics, provenance=direct[name].provenance) == direct[name]
        assert any("gpt-4o-2024-08-06" in said_by or "qwen2.5vl" in said_by for said_by in haptics.provenance.values())
