"""A session warns of corrections that change nothing before `rebake`."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    AudioClip,
    Box,
    Credit,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    bake,
    rebake,
)

pytestmark = pytest.mark.usefixtures("short_tones")


@pytest.fixture(scope="module")
def baked() -> HapticBundle:
    floor = SceneObject("wooden floor", pose=Pose((0, -0.05, 0)), geometry=Box((4, 0.1, 4)))
    cup = SceneObject("ceramic cup", pose=Pose((0.5, 0.05, 0)), geometry=Box((0.08, 0.1, 0.08)))
    phone = SceneObject("smartphone", pose=Pose((0, 0.004, 0)), geometry=Box((0.07, 0.008, 0.15)))
    return bake(SceneSnapshot.build([floor, cup, phone]))


PENDING: list[dict[str, Any]] = [{"name": "electric kettle"}, {"vibrates": True}]


@pytest.mark.parametrize("correction", PENDING, ids=str)
def test_a_correction_that_needs_a_rebake_brings_a_warning(baked: HapticBundle, correction: dict[str, Any]) -> None:
    session, corrected = HapticSession(baked), baked.override("ceramic cup", **correction)
    (field,) = correction
    words = f"not baked yet.*{field} of 'ceramic cup'.*rebake"
    with pytest.warns(SceneWarning, match=words):
        HapticSession(corrected)
    with pytest.warns(SceneWarning, match=words):
        session.use_bundle(corrected)


@pytest.mark.parametrize("correction", PENDING, ids=str)
def test_a_baked_correction_brings_none(baked: HapticBundle, correction: dict[str, Any], tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        corrected = rebake(baked.override("ceramic cup", **correction))
        corrected.save(tmp_path / "b")
        HapticSession(corrected)
        HapticSession(HapticBundle.load(tmp_path / "b"))


HUM = AudioClip((0.4 * np.sin(np.arange(48000) * 0.02)).astype(np.float32), 48000, Credit("hum", "me", "CC0"))
OF_LOOPS: list[dict[str, Any]] = [{"intensity": 0.3}, {"pitch_hz": {"ringing": 150.0}}, {"clip": HUM}]


@pytest.mark.parametrize("correction", OF_LOOPS, ids=lambda one: next(iter(one)))
def test_a_sound_intensity_or_pitch_waits_for_a_rebake(
    baked: HapticBundle, correction: dict[str, Any], tmp_path: Path
) -> None:
    corrected = baked.override("smartphone", **correction)
    words = "not baked yet.*sound, intensity or pitch of 'smartphone'.*rebake"
    with pytest.warns(SceneWarning, match=words):
        HapticSession(corrected)
    remade = rebake(corrected)
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        HapticSession(HapticBundle.load(remade.save(tmp_path / "b")))
        HapticSession(rebake(remade.override("smartphone", locked=True)))
    with pytest.warns(SceneWarning, match=words):
        HapticSession(replace(remade, overrides={}))


def test_a_correction_that_takes_effect_at_once_brings_none(baked: HapticBundle) -> None:
    session = HapticSession(baked)
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        session.use_bundle(baked.override("smartphone", gain_db=-6).override("ceramic cup", material="steel"))
        session.use_bundle(baked.override("smartphone", vibrates=False).override("wooden floor", mass_kg=100))


def test_a_name_that_is_taken_back_before_the_rebake_brings_none(baked: HapticBundle) -> None:
    named = baked.override("ceramic cup", name="electric kettle")
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        HapticSession(replace(named, overrides={}))
