"""Warnings of baking point at the line of the caller, not at a line of the library."""

import warnings
from collections.abc import Callable
from typing import Any

import pytest

from scene2hap import (
    BackendWarning,
    Box,
    LLMReply,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    bake,
    infer_haptics,
    rebake,
)
from scene2hap.llm.chain.report import InferenceReport
from scripted_backend import SCENE, Scripted


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
    with pytest.warns(BackendWarning, match="1 question to the model got no answer.*'cup'") as caught:
        make()
    assert {one.filename for one in caught if one.category is BackendWarning} == {__file__}
    reports = list[InferenceReport]()
    with warnings.catch_warnings():
        warnings.simplefilter("error", BackendWarning)
        bake(SCENE, BROKEN, on_report=reports.append)
        bake(SCENE, {"llm": Scripted()})
    assert list(reports[0].errors) == ["cup"]
