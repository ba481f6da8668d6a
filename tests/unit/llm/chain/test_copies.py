"""Inference in rooms of equal cubes, as in game prototypes: true copies, and objects that only look equal."""

import asyncio
from collections import Counter
from dataclasses import replace

from scene2hap import LexiconBackend, SceneSnapshot
from scene2hap.llm.chain import infer_scene
from scene2hap.scene.capture.surroundings import Copies
from scenes import box, scene
from scripted_backend import Scripted

SOURCES = (
    "microwave_oven",
    "washing_machine",
    "refrigerator",
    "dishwasher",
    "blender",
    "vacuum_cleaner",
    "hair_dryer",
    "alarm_clock",
    "tumble_dryer",
    "coffee_machine",
)
SILENT = (
    "wooden_table",
    "steel_table",
    "glass_table",
    "marble_table",
    "wooden_chair",
    "plastic_chair",
    "sofa",
    "bed",
    "bookshelf",
    "wardrobe",
    "mirror",
    "carpet",
    "pillow",
    "cardboard_box",
    "brick_wall",
    "concrete_wall",
    "bathtub",
    "vase",
    "book",
    "plate",
)
N_COPIES = 2


def cubes() -> SceneSnapshot:
    """Sixty equal cubes with one instance key: thirty names, each twice with a running number."""
    names = [f"{name}_{i}" for i in range(1, N_COPIES + 1) for name in (*SOURCES, *SILENT)]
    return scene(
        *(
            replace(box(name, (0.5, 0.5, 0.5), (2.0 * (i % 10), 0.25, 2.0 * (i // 10))), instance_key="cube")
            for i, name in enumerate(names)
        )
    )


def word(name: str) -> str:
    return name.rsplit("_", 1)[0]


def test_every_source_and_material_is_found_among_sixty_equal_cubes() -> None:
    room = cubes()
    assert len(room.objects) == 60
    found = asyncio.run(infer_scene(room, LexiconBackend()))
    vibrating = {name for name, haptics in found.objects.items() if haptics.vibrates}
    assert {name for name in found.objects if word(name) in SOURCES} == vibrating
    assert all(haptics.material is not None for haptics in found.objects.values())
    families = {name: haptics.material_category for name, haptics in found.objects.items()}
    assert len({families[f"{kind}_table_1"] for kind in ("wooden", "steel", "glass", "marble")}) == 4
    for haptics, name in ((haptics, name) for name, haptics in found.objects.items()):
        assert word(name).split("_")[-1] in haptics.reasons["category"], "the reason names another object"


def test_only_exact_copies_share_calls() -> None:
    backend = Scripted(
        object_analyzer=lambda request, answer: {**answer, "material_category": f"stuff of {request.subject}"}
    )
    done: list[int] = []
    found = asyncio.run(infer_scene(cubes(), backend, progress=lambda what, n_done, total: done.append(n_done)))
    assert done == list(range(N_COPIES, 60 + 1, N_COPIES))
    analysed = [request.subject for request in backend.asked if request.component == "object_analyzer"]
    assert Counter(map(word, analysed)) == Counter((*SOURCES, *SILENT))
    assert found.report.skipped["copies"] == 30
    assert all(haptics.object_category == f"{word(name)}_1" for name, haptics in found.objects.items())


def test_user_prompt_for_one_copy_is_not_shared() -> None:
    room = scene(
        *(replace(box(f"chair_{i}", (0.5, 0.5, 0.5), (2.0 * i, 0.25, 0.0)), instance_key="cube") for i in range(1, 5))
    )
    backend = Scripted()
    asyncio.run(infer_scene(room, backend, object_prompts={"chair_3": "it is of steel"}))
    analysed = {r.subject: r.prompt for r in backend.asked if r.component == "object_analyzer"}
    assert set(analysed) == {"chair_1", "chair_3"}
    assert "it is of steel" in analysed["chair_3"]
    backend = Scripted()
    asyncio.run(infer_scene(room, backend, object_prompts={"chair_3": "it is of steel", "chair_4": "it is of oak"}))
    prompts = {r.subject: r.prompt for r in backend.asked if r.component == "object_analyzer"}
    assert set(prompts) == {"chair_1", "chair_3", "chair_4"}
    assert "it is of oak" in prompts["chair_4"]


def test_copies_share_isolated_pictures_but_not_context_pictures() -> None:
    objects = cubes().objects
    copies = Copies(objects, [None] * len(objects), [frozenset()] * len(objects), share=True)
    assert set(copies.isolated.values()) == {"microwave_oven_1"}
    assert len(set(copies.context.values())) == 30
