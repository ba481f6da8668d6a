"""`rebake`: user corrections are kept, and objects that are not named stay unchanged."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import AudioClip, Credit, FunctionBackend, HapticBundle, LLMRequest, Override, bake, materials, rebake
from scene2hap.errors import UnknownObject
from scripted_backend import SCENE, Scripted

# Some scenes here have objects in the air.
pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning")


def answering() -> FunctionBackend:
    """A backend with scripted answers that keeps its requests."""
    scripted = Scripted()

    def answer(request: LLMRequest) -> str:
        return json.dumps(getattr(scripted, request.component)(request))

    return FunctionBackend(answer)


def subjects(backend: FunctionBackend, component: str = "object_analyzer") -> list[str]:
    return sorted(request.subject for request in backend.requests if request.component == component)


@pytest.fixture
def bundle() -> HapticBundle:
    return bake(SCENE, {"llm": answering()})


def test_rebake_queries_only_the_named_objects(bundle: HapticBundle) -> None:
    backend = answering()
    again = rebake(bundle, {"llm": backend}, objects=["cup"], user_prompt="the cup is of silver")
    assert subjects(backend) == ["cup"]
    assert not subjects(backend, "scene_analyzer")
    assert all("of silver" in request.prompt for request in backend.requests)
    assert again.objects["phone"] == bundle.objects["phone"]
    assert again.loops["phone"] is bundle.loops["phone"]
    assert list(again.objects) == list(bundle.objects)


def test_vibration_can_be_added_by_override(bundle: HapticBundle) -> None:
    wished = bundle.override("cup", vibrates=True)
    assert "cup" not in wished.loops
    backend = answering()
    again = rebake(wished, {"llm": backend})
    assert subjects(backend) == ["cup"]
    assert "vibrates by itself" in backend.requests[0].prompt
    assert list(again.loops["cup"]) == ["on"]
    assert again.objects["cup"].vibrates
    assert again.objects["cup"].provenance["vibrates"] == "user"


def test_user_sound_replaces_the_selected_one(bundle: HapticBundle) -> None:
    rate = 8000
    tone = np.sin(2 * np.pi * 120 * np.arange(3 * rate) / rate).astype(np.float32)
    clip = AudioClip(0.5 * tone, rate, Credit("my tone", "me", "CC0"))
    backend = answering()
    again = rebake(bundle.override("phone", clip=clip), {"llm": backend})
    assert not backend.requests
    for loop in again.loops["phone"].values():
        assert loop.audible.credit.title == "my tone"
        assert loop.frequency_raw_hz == pytest.approx(120, abs=0.5)


def test_corrections_are_kept_by_a_new_bake(tmp_path: Path) -> None:
    def baked(**more: Any) -> HapticBundle:
        return bake(SCENE, {"llm": answering()}, **more)

    first = baked().override("phone", gain_db=-6.0).override("table", material="steel")
    kept = HapticBundle.load(first.save(tmp_path / "b")).overrides
    second = baked(overrides=kept)
    assert second.gain_db("phone") == -6.0
    assert second.objects["table"].material == materials.lookup("steel")
    silent = baked(overrides={"phone": Override(vibrates=False)})
    assert not silent.loops


def test_correction_of_a_missing_object_is_dropped_with_a_warning() -> None:
    with pytest.warns(UserWarning, match="'chair' is dropped"):
        again = bake(SCENE, {"llm": answering()}, overrides={"chair": Override(gain_db=1.0)})
    assert not again.overrides


def test_rebake_refuses_an_unknown_object(bundle: HapticBundle) -> None:
    with pytest.raises(UnknownObject):
        rebake(bundle, {"llm": answering()}, objects=["chair"])


def test_rebake_passes_on_the_inference_report() -> None:
    accounts: list[Any] = []
    bake(SCENE, {"llm": answering()}, on_report=accounts.append)
    (account,) = accounts
    assert account.calls["object_analyzer"] == 3
