"""Silent ends of a person's own sound: cut off a steady sound, kept as the pause of a rhythm."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap import AudioClip, bake, rebake
from scripted_backend import SCENE

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning")  # objects in the air


def share_of_sound(sounding: np.ndarray, before_s: float, after_s: float) -> float:
    """Share of the loop of an own sound between silences in which it sounds [-]."""
    rate = 16_000
    silent = [np.zeros(round(seconds * rate)) for seconds in (before_s, after_s)]
    clip = AudioClip(np.concatenate([silent[0], sounding, silent[1]]), rate)
    loops = rebake(bake(SCENE, {"llm": {"kind": "lexicon"}}).override("phone", clip=clip)).loops["phone"]
    audible = next(iter(loops.values())).audible.samples
    levels = np.sqrt([np.square(part).mean() for part in np.array_split(audible, len(audible) // 800)])
    return float((levels > 0.1 * levels.max()).mean())


@pytest.mark.parametrize(("before_s", "after_s"), [(1.0, 1.0), (0.3, 0.5), (0.5, 0.3)])
def test_the_silent_ends_of_an_own_hum_are_not_looped(before_s: float, after_s: float) -> None:
    """In an earlier version such a fan stopped once in each loop, since a sound between silences repeats as a whole."""
    t = np.arange(5 * 16_000) / 16_000
    hum = 0.3 * np.sin(2 * np.pi * 120.0 * t) + 0.03 * np.random.default_rng(0).standard_normal(len(t))
    assert share_of_sound(hum, before_s, after_s) == 1.0


def test_the_pauses_of_an_own_beep_are_looped() -> None:
    t = np.arange(4 * 16_000) / 16_000
    beep = 0.3 * np.sin(2 * np.pi * 120.0 * t)
    assert share_of_sound(beep[:16_000], 0.0, 1.0) == pytest.approx(0.5, abs=0.05)
    assert share_of_sound(beep * (t % 2.0 < 1.0), 0.0, 1.0) < 0.6
