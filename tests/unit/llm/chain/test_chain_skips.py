"""Requests that the chain does not send, and pictures that it does not render."""

import asyncio
from dataclasses import replace

from scene2hap import SceneObject, SceneSnapshot, infer_haptics, materials
from scene2hap.llm.chain import infer_scene
from scene2hap.scene.images import ImageSet, ObjectImages, Shot
from scenes import box, scene
from scripted_backend import SCENE, Scripted, run


def test_unknown_material_is_not_estimated() -> None:
    backend = Scripted(object_analyzer=lambda request, answer: {**answer, "material_category": "unknown"})
    found = infer_haptics(SCENE, backend)
    assert all(haptics.material is None for haptics in found.values())
    assert not [request for request in backend.asked if request.component == "material_estimator"]


def test_table_materials_replace_the_material_estimator() -> None:
    backend = Scripted()
    found = run(backend, {"materials": "table"})
    assert not [request for request in backend.asked if request.component == "material_estimator"]
    assert found.objects["table"].material == replace(materials.lookup("oak"), name="oak")
    assert found.report.skipped["table_material"] == 2


def test_lazy_inference_covers_only_objects_reached_by_sources() -> None:
    backend = Scripted(
        object_analyzer=lambda request, answer: {**answer, "material_category": f"{request.subject} stuff"}
    )
    found = run(backend, {"inference": "lazy"})
    # The phone rests on the table; the cup stands alone, four metres away.
    asked = {request.subject for request in backend.asked if request.component == "material_estimator"}
    assert asked == {"phone stuff", "table stuff"}
    assert found.objects["cup"].material is None
    assert found.report.skipped["unreached_material"] == 1


def test_lazy_inference_takes_unreached_materials_from_the_table() -> None:
    def word(subject: str) -> str:
        return "oak" if subject == "cup" else f"{subject} stuff"

    backend = Scripted(object_analyzer=lambda request, answer: {**answer, "material_category": word(request.subject)})
    found = infer_haptics(SCENE, backend, config={"inference": "lazy"})
    asked = {request.subject for request in backend.asked if request.component == "material_estimator"}
    assert asked == {"phone stuff", "table stuff"}
    assert found["cup"].material == replace(materials.lookup("oak"), name="oak")


def test_copies_on_the_same_support_are_analysed_once() -> None:
    def copy(name: str, x: float, y: float) -> SceneObject:
        return replace(box(name, (0.1, 0.1, 0.1), (x, y, 0.4)), instance_key="mug")

    room = scene(
        box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
        box("stove", (0.6, 0.9, 0.6), (3.0, 0.45, 0.4)),
        *(copy(f"mug_{i}", 0.2 + 0.3 * i, 0.77) for i in range(4)),
        copy("mug_on_the_stove", 3.0, 0.95),
    )
    backend = Scripted()
    found = asyncio.run(infer_scene(room, backend))
    analysed = [request.subject for request in backend.asked if request.component == "object_analyzer"]
    assert sorted(analysed) == ["mug_0", "mug_on_the_stove", "stove", "table"]
    assert found.report.skipped["copies"] == 3
    assert found.objects["mug_3"] == found.objects["mug_0"]
    assert list(found.objects) == [item.id for item in room.objects]
    apart = Scripted()
    asyncio.run(infer_scene(room, apart, config={"share_copies": False}))
    assert len([request for request in apart.asked if request.component == "object_analyzer"]) == 7


def test_only_selected_objects_are_inferred_with_user_prompts() -> None:
    backend = Scripted()
    found = asyncio.run(
        infer_scene(
            SCENE, backend, only=["phone"], scene_category="office", object_prompts={"phone": "it rings loudly"}
        )
    )
    assert list(found.objects) == ["phone"]
    assert {request.component for request in backend.asked} == {
        "object_analyzer",
        "material_estimator",
        "vibration_describer",
    }
    for request in backend.asked:
        assert ("it rings loudly" in request.prompt) == (request.subject == "phone")


class Camera:
    """A camera that counts its pictures."""

    def __init__(self) -> None:
        self.taken = 0

    def image(self, shot: Shot) -> bytes:
        self.taken += 1
        return f"{shot.kind} of {shot.subject}".encode()


def pictured(camera: Camera) -> SceneSnapshot:
    def shots(kind: str, subject: str | None, n: int) -> ImageSet:
        return ImageSet(camera, [Shot(kind, subject, 45.0 * i, 45.0) for i in range(n)])

    objects = [
        replace(item, images=ObjectImages(shots("isolated", item.id, 8), shots("context", item.id, 8)))
        for item in SCENE.objects
    ]
    return replace(SCENE, objects=tuple(objects), images=shots("scene", None, 4))


def test_no_picture_is_rendered_for_a_text_only_backend() -> None:
    camera = Camera()
    infer_haptics(pictured(camera), Scripted())
    assert camera.taken == 0


def test_vision_backend_gets_scene_then_isolated_then_context_pictures() -> None:
    camera, backend = Camera(), Scripted()
    infer_haptics(pictured(camera), backend)
    seen = {(r.component, r.subject): [png.decode() for png in r.images] for r in backend.asked}
    assert seen["scene_analyzer", ""] == ["scene of None"] * 4
    assert seen["object_analyzer", "phone"] == ["isolated of phone"] * 8 + ["context of phone"] * 8
    assert seen["vibration_describer", "phone"] == []
    assert camera.taken == 4 + 3 * 16
