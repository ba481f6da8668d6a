"""The inference chain with a scripted backend: requests, order, progress and provenance."""

import asyncio
import json
from collections import Counter
from typing import Any

import pytest

from scene2hap import LLMReply, LLMRequest, infer_haptics
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.chain.questions import ConcurrencyLimit
from scene2hap.llm.prompts import VERSION
from scene2hap.llm.wrappers import price_list
from scripted_backend import SCENE, Scripted, run


def test_chain_sends_only_the_needed_requests() -> None:
    backend = Scripted()
    found = infer_haptics(SCENE, backend)
    # One scene, three objects, two distinct materials, and a description for each state of the source.
    assert Counter(request.component for request in backend.asked) == {
        "scene_analyzer": 1,
        "object_analyzer": 3,
        "material_estimator": 2,
        "vibration_describer": 2,
    }
    assert {request.temperature for request in backend.asked} == {0.2}
    assert list(found) == ["table", "phone", "cup"]
    assert [state.name for state in found["phone"].states] == ["ringing", "alarm"]
    assert found["phone"].states[1].sentence == "phone alarm"
    assert not found["cup"].vibrates
    assert found["table"].material is not None
    assert found["table"].material.youngs_modulus_pa == 10e9
    assert found["table"].estimated_size_m == (1.6, 0.8, 0.025)
    assert found["phone"].provenance["states.alarm"].startswith("scripted")


def test_each_component_builds_on_the_one_before() -> None:
    backend = Scripted()
    infer_haptics(SCENE, backend, user_prompt="all phones are switched off")
    for request in backend.asked:
        assert "all phones are switched off" in request.prompt
        for value in request.facts.values():
            if isinstance(value, str):
                assert value in request.prompt
    analysed = {r.subject: r for r in backend.asked if r.component == "object_analyzer"}
    assert analysed["phone"].facts["scene_category"] == "living room"
    assert analysed["phone"].facts["neighbour_names"] == ["table"]
    assert analysed["cup"].facts["neighbour_names"] == []
    assert analysed["cup"].facts["relative_height_m"] == 0.0


def test_chain_reports_progress_per_object() -> None:
    told: list[tuple[str, int, int]] = []
    asyncio.run(infer_scene(SCENE, Scripted(), progress=lambda *news: told.append(news)))
    assert [(done, total) for _, done, total in told] == [(1, 3), (2, 3), (3, 3)]
    assert {what for what, _, _ in told} == {"table", "phone", "cup"}


def test_scenes_that_share_slots_keep_one_concurrency_limit() -> None:
    class Counting(Scripted):
        """A backend with an attribute `limit` of its own, which is no limit of ours."""

        running = most = limit = 0

        async def complete(self, request: LLMRequest) -> LLMReply:
            self.running += 1
            self.most = max(self.most, self.running)
            await asyncio.sleep(0.001)
            self.running -= 1
            return await super().complete(request)

    async def two_scenes(limit: ConcurrencyLimit | None) -> int:
        backend = Counting()
        backend.limit = 3
        config = {"concurrency": 2}
        await asyncio.gather(*(infer_scene(SCENE, backend, config=config, limit=limit) for _ in range(2)))
        return backend.most

    assert asyncio.run(two_scenes(ConcurrencyLimit(1))) == 1
    assert asyncio.run(two_scenes(None)) > 1


def test_chain_respects_the_concurrency_limit() -> None:
    class Counting(Scripted):
        now = most = 0

        async def complete(self, request: LLMRequest) -> LLMReply:
            self.now += request.component == "object_analyzer"
            self.most = max(self.most, self.now)
            reply = await super().complete(request)
            await asyncio.sleep(0.001)
            self.now -= request.component == "object_analyzer"
            return reply

    one, two = Counting(), Counting()
    asyncio.run(infer_scene(SCENE, one, config={"concurrency": 1}))
    asyncio.run(infer_scene(SCENE, two, config={"concurrency": 2}))
    assert (one.most, two.most) == (1, 2)


def test_damping_ratio_becomes_loss_factor() -> None:
    found = run(Scripted(material_estimator=lambda request, answer: {**answer, "damping_ratio": 0.03}))
    material = found.objects["table"].material
    assert material is not None
    assert material.loss_factor == pytest.approx(0.06)


def test_provenance_names_the_origin_of_every_field() -> None:
    phone = run(Scripted()).objects["phone"]
    assert set(phone.provenance) == {
        "object_category",
        "material_category",
        "estimated_size_m",
        "usage",
        "vibrates",
        "material",
        "states.ringing",
        "states.alarm",
    }
    assert set(phone.provenance.values()) == {f"scripted, prompt {VERSION}"}


def test_the_account_counts_calls_and_tokens() -> None:
    def reply(request: LLMRequest, answer: dict[str, Any]) -> LLMReply:
        return LLMReply(json.dumps(answer), "m-1", usage={"prompt_tokens": 100, "completion_tokens": 7})

    report = run(Scripted(object_analyzer=reply)).report
    assert dict(report.calls) == {
        "scene_analyzer": 1,
        "object_analyzer": 3,
        "material_estimator": 2,
        "vibration_describer": 2,
    }
    assert report.tokens == {"m-1": {"prompt_tokens": 300, "completion_tokens": 21}}
    assert (report.unmetered, report.kept) == (5, 0)
    assert report.cost_usd(price_list({"m-1": (1.0, 1.0)})) is None  # five answers came without their usage
    assert report.skipped["silent"] == 2
    assert report.skipped["same_material"] == 1
    assert json.loads(json.dumps(report.as_json()))["calls"]["object_analyzer"] == 3
