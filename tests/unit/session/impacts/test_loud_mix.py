"""Impacts during a mix that the limiter turns down."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap import AudioClip, HapticSession, Touch
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.render.limiter import THRESHOLD
from scenes import table_with_two_phones

RATE = 48_000


def knocking() -> HapticLoop:
    """Two cycles at 100 Hz each half second, between which the limiter releases."""
    samples = np.zeros(RATE // 2, dtype=np.float32)
    samples[:960] = 0.4 * np.sin(2 * np.pi * np.arange(960) / 480)
    clip = AudioClip(samples, RATE)
    return HapticLoop(clip, clip, 100.0, 100.0)


def test_an_impact_leaves_the_loud_mix_of_another_hand_as_it_is() -> None:
    """The left hand is on a loud phone; impacts on the table are felt by the right one alone."""
    mixes = []
    for is_struck in (False, True):
        scene, bundle = table_with_two_phones()
        loops = {**bundle.loops, "phone": {state: knocking() for state in bundle.loops["phone"]}}
        made = HapticSession(scene, replace(bundle, loops=loops), {"prepare": "blocking"}, user={"gain_db": 12.0})
        made.set_source("alarm", on=False)
        blocks = []
        for frame in range(200):
            made.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4)), Touch("right", "table", (0.9, 0.72, 0.4))])
            if is_struck and frame % 10 == 5:
                assert set(made.strike("table", (0.9, 0.72, 0.4), speed_m_s=0.05).felt) == {"right"}
            blocks.append(made.render(RATE // 100))
        mixes.append(np.concatenate(blocks)[:, 0])
    without, struck = mixes
    assert (np.abs(without) > THRESHOLD).sum() > 100  # the limiter's curve is in use
    np.testing.assert_array_equal(struck, without)
