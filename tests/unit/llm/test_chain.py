"""The chain against a scripted backend."""

import asyncio
import json
from collections import Counter
from dataclasses import replace
from typing import Any

import pytest

from scene2hap import LLMReply, LLMRequest, SceneSnapshot, infer_haptics
from scene2hap.errors import BackendUnavailable, BadAnswer
from scene2hap.llm.chain import infer_scene
from scene2hap.scene.images import ImageSet, ObjectImages, Shot
from scenes import box, scene

SCENE = scene(
    box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
    box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4)),
    box("cup", (0.1, 0.1, 0.1), (5.0, 0.05, 5.0)),
)


class Scripted:
    """Answers by component; keeps what it was asked."""

    def __init__(self, **changes: Any) -> None:
        self.asked: list[LLMRequest] = []
        self.changes = changes

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.asked.append(request)
        await asyncio.sleep(0)
        answer = getattr(self, request.component)(request)
        change = self.changes.get(request.component)
        if callable(change):
            changed = change(request, answer)
            return changed if isinstance(changed, LLMReply) else LLMReply(json.dumps(changed), "scripted")
        return LLMReply(json.dumps(answer), "scripted")

    def scene_analyzer(self, request: LLMRequest) -> dict[str, Any]:
        return {"scene_category": "living room"}

    def object_analyzer(self, request: LLMRequest) -> dict[str, Any]:
        phone = request.facts["object_name"] == "phone"
        states = [{"name": n, "intensity": 0.5, "needs_contact": None} for n in ("ringing", "alarm")] if phone else []
        return {
            "object_category": request.facts["object_name"],
            "category_reason": "c",
            "material_category": "Glass" if phone else "oak",
            "estimated_length_m": request.facts["length_m"],
            "estimated_width_m": request.facts["width_m"],
            "estimated_thickness_m": 0.025,
            "size_reason": "s",
            "usage": "used",
            "vibrates": phone,
            "vibration_reason": "v",
            "states": states,
            "confidence": 0.9,
        }

    def material_estimator(self, request: LLMRequest) -> dict[str, Any]:
        return {"density_kg_m3": 700.0, "youngs_modulus_gpa": 10.0, "poisson_ratio": 0.3, "loss_factor": 0.01}

    def vibration_describer(self, request: LLMRequest) -> dict[str, Any]:
        return {"sentence": f"phone {request.facts['state']}", "keywords": "phone buzzing"}


def test_the_chain_asks_what_it_must_and_no_more() -> None:
    backend = Scripted()
    found = infer_haptics(SCENE, backend)
    # One scene, three objects, two distinct materials, and a description for each state of what vibrates.
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
    assert found["phone"].provenance["vibration_describer"].startswith("scripted")


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


def test_progress_is_told() -> None:
    told: list[tuple[str, int, int]] = []
    asyncio.run(infer_scene(SCENE, Scripted(), progress=lambda *news: told.append(news)))
    assert [(done, total) for _, done, total in told] == [(1, 3), (2, 3), (3, 3)]
    assert {what for what, _, _ in told} == {"table", "phone", "cup"}


def test_concurrency_is_kept() -> None:
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
    asyncio.run(infer_scene(SCENE, one, concurrency=1))
    asyncio.run(infer_scene(SCENE, two, concurrency=2))
    assert (one.most, two.most) == (1, 2)


def test_an_unknown_material_is_not_asked_for() -> None:
    backend = Scripted(object_analyzer=lambda request, answer: {**answer, "material_category": "unknown"})
    found = infer_haptics(SCENE, backend)
    assert all(haptics.material is None for haptics in found.values())
    assert not [request for request in backend.asked if request.component == "material_estimator"]


def test_a_material_that_nobody_knows_costs_only_itself() -> None:
    found = infer_haptics(
        SCENE, Scripted(material_estimator=lambda request, answer: {**answer, "youngs_modulus_gpa": 70e9})
    )
    assert found["table"].material is None
    assert "youngs_modulus_gpa" in found["table"].provenance["material_estimator"]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda request, answer: {**answer, "confidence": 7}, r"object_analyzer about '\w+': confidence"),
        (lambda request, answer: {**answer, "colour": "red"}, "colour"),
        (lambda request, answer: LLMReply("I think it is a table.", "scripted"), "Invalid JSON"),
        (lambda request, answer: LLMReply(json.dumps(answer)[:40], "scripted", "length"), "ended by 'length'"),
    ],
)
def test_an_answer_that_does_not_fit_is_named(change: object, sentence: str) -> None:
    with pytest.raises(BadAnswer, match=sentence) as caught:
        infer_haptics(SCENE, Scripted(object_analyzer=change))
    assert caught.value.raw_text


def test_a_backend_that_is_away() -> None:
    class Away:
        async def complete(self, request: LLMRequest) -> LLMReply:
            raise BackendUnavailable("the model is away")

    with pytest.raises(ConnectionError, match="away"):
        infer_haptics(SCENE, Away())


class Camera:
    """Counts the pictures that are really taken."""

    def __init__(self) -> None:
        self.taken = 0

    def image(self, shot: Shot) -> bytes:
        self.taken += 1
        return f"{shot.kind} of {shot.subject}".encode()


def pictured(camera: Camera) -> SceneSnapshot:
    def shots(kind: str, subject: str | None, n: int) -> ImageSet:
        return ImageSet(camera, [Shot(kind, subject, 45.0 * i, 45.0) for i in range(n)])  # type: ignore[arg-type]

    objects = [
        replace(item, images=ObjectImages(shots("isolated", item.id, 8), shots("context", item.id, 8)))
        for item in SCENE.objects
    ]
    return replace(SCENE, objects=tuple(objects), images=shots("scene", None, 4))


def test_nothing_is_rendered_for_a_backend_that_does_not_look() -> None:
    camera = Camera()
    infer_haptics(pictured(camera), Scripted())
    assert camera.taken == 0


def test_a_backend_that_looks_sees_the_scene_then_the_object_alone_and_among_others() -> None:
    camera, backend = Camera(), Scripted()
    infer_haptics(pictured(camera), backend)
    seen = {(r.component, r.subject): [png.decode() for png in r.images] for r in backend.asked}
    assert seen["scene_analyzer", ""] == ["scene of None"] * 4
    assert seen["object_analyzer", "phone"] == ["isolated of phone"] * 8 + ["context of phone"] * 8
    assert seen["vibration_describer", "phone"] == []
    assert camera.taken == 4 + 3 * 16
