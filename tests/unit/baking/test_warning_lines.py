"""Warnings of baking point at the line of the caller, not at a line of the library."""

import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from scene2hap import (
    BackendWarning,
    Box,
    LLMReply,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    bake,
    infer_haptics,
    rebake,
)
from scene2hap.errors import BadAnswer
from scene2hap.llm.chain.report import InferenceReport
from scripted_backend import SCENE, Scripted

pytestmark = pytest.mark.usefixtures("short_tones")


def test_warning_of_bake_points_at_the_calling_line() -> None:
    scene = SceneSnapshot.build([SceneObject(name, geometry=Box((1, 1, 1))) for name in ("table", "chair")])
    with pytest.warns(SceneWarning, match="none of 2 objects") as caught:
        bake(scene)
    assert {one.filename for one in caught} == {__file__}


def without_cup(request: Any, answer: dict[str, Any]) -> Any:
    return LLMReply('{"object_cate', "scripted") if request.subject == "cup" else answer


BROKEN = {"llm": Scripted(object_analyzer=without_cup)}


def baked() -> None:
    bake(SCENE, BROKEN)


def baked_again() -> None:
    rebake(bake(SCENE, {"llm": Scripted()}), BROKEN, objects=["cup", "table"])


def inferred() -> None:
    infer_haptics(SCENE, BROKEN["llm"])


@pytest.mark.parametrize("make", [baked, baked_again, inferred])
def test_a_lost_answer_is_a_warning_unless_the_report_is_taken(make: Callable[[], None]) -> None:
    with pytest.warns(BackendWarning, match="no answer about 'cup'. The first error: ") as caught:
        make()
    assert {one.filename for one in caught if one.category is BackendWarning} == {__file__}
    reports = list[InferenceReport]()
    with warnings.catch_warnings():
        warnings.simplefilter("error", BackendWarning)
        bake(SCENE, BROKEN, on_report=reports.append)
        bake(SCENE, {"llm": Scripted()})
    assert list(reports[0].errors) == ["cup"]


def test_a_warning_of_lost_answers_names_copies_as_objects_and_shortens_a_long_error() -> None:
    """Four copies of the cup share one question."""
    cup = SCENE.object("cup")
    cups = [replace(cup, id=f"cup{k}", name="cup", pose=Pose((2.0 + k, 1.0, 1.0))) for k in range(4)]

    def fails(request: Any, answer: dict[str, Any]) -> Any:
        if request.subject == "cup":
            raise BadAnswer("not\n" + 5000 * "x")
        return answer

    with pytest.warns(BackendWarning) as caught:
        bake(SceneSnapshot.build([*SCENE.objects, *cups]), {"llm": Scripted(object_analyzer=fails)})
    (said,) = (str(one.message) for one in caught if one.category is BackendWarning)
    assert said.startswith("the model gave no answer about 'cup', 'cup0', 'cup1' and 2 more. The first error: not xxx")
    assert "xxx... What is not known is left out. " in said
    assert len(said) < 1500
