"""`HapticBundle.reset`: an object is again as it was inferred, without a question to a model."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    AudioClip,
    Box,
    Credit,
    FunctionBackend,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    bake,
    rebake,
)
from scene2hap.errors import BundleError, UnknownObject
from scene2hap.haptics import ActuatorProfile
from starting_machines import machine

pytestmark = pytest.mark.usefixtures("short_tones")

RATE = 48000


def clip() -> AudioClip:
    hum = 0.4 * np.sin(2 * np.pi * 150 * np.arange(2 * RATE) / RATE)
    return AudioClip(hum.astype(np.float32), RATE, Credit("hum", "me", "CC0", origin="user"))


@pytest.fixture(scope="module")
def baked() -> HapticBundle:
    floor = SceneObject("wooden floor", pose=Pose((0, -0.05, 0)), geometry=Box((4, 0.1, 4)))
    cup = SceneObject("ceramic cup", pose=Pose((0.5, 0.05, 0)), geometry=Box((0.08, 0.1, 0.08)))
    phone = SceneObject("smartphone", pose=Pose((0, 0.004, 0)), geometry=Box((0.07, 0.008, 0.15)))
    fan = SceneObject("desk fan", pose=Pose((-0.5, 0.15, 0)), geometry=Box((0.3, 0.3, 0.2)))
    return bake(SceneSnapshot.build([floor, cup, phone, fan]), {"actuator": ActuatorProfile()})


def unasked() -> FunctionBackend:
    return FunctionBackend(lambda request: pytest.fail(f"asked about {request.subject}"))


CORRECTIONS: list[tuple[str, dict[str, Any]]] = [
    ("desk fan", {"material": "steel"}),
    ("desk fan", {"mass_kg": 3.0, "feet": "rubber"}),
    ("desk fan", {"intensity": 0.9}),
    ("desk fan", {"pitch_hz": 150.0}),
    ("desk fan", {"start_up_s": 0.1, "wind_down_s": 0.2}),
    ("desk fan", {"vibrates": False}),
    ("desk fan", {"gain_db": -6.0, "muted": True}),
    ("desk fan", {"clip": clip()}),
    ("desk fan", {"name": "washing machine"}),
    ("ceramic cup", {"vibrates": True}),
]


@pytest.mark.parametrize(("key", "correction"), CORRECTIONS, ids=str)
def test_a_corrected_object_is_again_as_inferred(
    baked: HapticBundle, key: str, correction: dict[str, Any], tmp_path: Path
) -> None:
    corrected = rebake(baked.override(key, **correction))
    assert (corrected.objects, corrected.loops, corrected.overrides) != (baked.objects, baked.loops, {})
    kept = HapticBundle.load(corrected.save(tmp_path / "b"))
    assert rebake(kept.reset(key), {"llm": unasked()}) == baked


def test_the_first_answer_counts_and_other_objects_stay_corrected(baked: HapticBundle) -> None:
    twice = rebake(baked.override("desk fan", material="steel").override("ceramic cup", gain_db=-3.0))
    twice = twice.override("desk fan", material="oak", intensity=0.9).reset("desk fan")
    assert twice.objects == baked.objects
    assert list(twice.overrides) == ["ceramic cup"]


def test_a_first_state_is_again_the_inferred_one() -> None:
    phone = bake(SceneSnapshot.build([SceneObject("smartphone", geometry=Box((0.07, 0.008, 0.15)))]))
    fan = bake(SceneSnapshot.build([SceneObject("hair dryer", geometry=Box((0.2, 0.1, 0.2)))]))
    for bundle in (phone, fan):
        ((key, states),) = bundle.loops.items()
        assert rebake(rebake(bundle.override(key, state=list(states)[-1])).reset(key)) == bundle


def test_a_row_that_is_removed_by_hand_is_taken_back_as_well(baked: HapticBundle, tmp_path: Path) -> None:
    folder = rebake(baked.override("desk fan", material="steel", intensity=0.9)).save(tmp_path / "b")
    (folder / "overrides.json").write_text("{}")
    assert rebake(folder, {"llm": unasked()}) == baked


def test_a_row_that_is_written_by_hand_can_be_reset(baked: HapticBundle, tmp_path: Path) -> None:
    folder = baked.save(tmp_path / "b")
    (folder / "overrides.json").write_text('{"desk fan": {"material": "steel", "intensity": {"*": 0.9}}}')
    corrected = rebake(folder)
    assert corrected.objects["desk fan"].states[0].intensity == 0.9
    assert rebake(corrected.reset("desk fan")) == baked


def test_corrections_of_a_bake_can_be_reset(baked: HapticBundle) -> None:
    wished = baked.override("desk fan", material="steel", intensity=0.9).override("ceramic cup", name="hair dryer")
    again = bake(baked.snapshot, {"actuator": ActuatorProfile()}, overrides=wished.overrides)
    assert rebake(again.reset("desk fan").reset("ceramic cup")) == baked


def test_the_start_of_an_own_recording_ends_with_it() -> None:
    scene = SceneSnapshot.build([SceneObject("desk fan", geometry=Box((0.3, 0.3, 0.2)))])
    own = bake(scene)
    recorded = machine(start_s=1.5, stop_s=2.0).clip
    assert rebake(rebake(own.override("desk fan", clip=recorded)).reset("desk fan")) == own


def test_a_locked_object_is_not_reset(baked: HapticBundle) -> None:
    with pytest.raises(BundleError, match="'desk fan' is locked, so that reset cannot .* Unlock it first"):
        baked.override("desk fan", gain_db=-3.0, locked=True).reset("desk fan")
    with pytest.raises(UnknownObject, match="desk fan"):
        baked.reset("fan")


def test_an_object_without_corrections_stays_as_it_is(baked: HapticBundle) -> None:
    assert baked.reset("desk fan") == baked


def test_a_session_says_that_a_sound_waits_for_a_rebake(baked: HapticBundle) -> None:
    silenced = rebake(baked.override("desk fan", vibrates=False))
    with pytest.warns(SceneWarning, match="not baked yet.*vibrates of 'desk fan'"):
        HapticSession(silenced.reset("desk fan"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HapticSession(rebake(silenced.reset("desk fan")))
