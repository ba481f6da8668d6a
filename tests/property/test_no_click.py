"""No gain change makes a click: energy above 1 kHz around a jump, relative to the energy of the tone."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import firwin, oaconvolve

from edge_scenes import EDGE_SCENES, on_top_of
from mixed_rows import set_gains
from scene2hap import AudioClip, Bands, HapticSession, Pose, Touch
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer
from scenes import table_with_two_phones

RATE = 48000
TACTILE = 8000
# Passes everything above 1 kHz, and attenuates tones below 880 Hz by 100 dB.
ABOVE_1_KHZ = firwin(2801, 940, pass_zero="highpass", window=("kaiser", 10.06), fs=RATE)


def high_db(x: NDArray[np.float32], around: int, tone_power: float) -> float:
    """Energy above 1 kHz in the 250 ms around a frame, re the tone's energy over the same time [dB].

    The filter runs over the whole signal, so that the ends of the window add no energy.
    """
    high = oaconvolve(x.astype(np.float64), ABOVE_1_KHZ, mode="same")
    return 10 * math.log10(np.mean(high[around - RATE // 8 : around + RATE // 8] ** 2) / tone_power + 1e-30)


def mixer_of(frequency_hz: float, ramp_s: float) -> Mixer:
    samples = 0.5 * np.sin(2 * np.pi * frequency_hz * np.arange(TACTILE) / TACTILE)
    bank = LoopBank([AudioClip(samples.astype(np.float32), TACTILE)], Bands.dominant(), TACTILE)
    return Mixer(bank, 1, sample_rate_hz=RATE, ramp_s=ramp_s)


@pytest.mark.parametrize("update_hz", [50, 1000])
@pytest.mark.parametrize("frequency_hz", [40, 80, 125, 250, 400, 640, 800])
def test_switching_a_tone_causes_no_click(frequency_hz: float, update_hz: int) -> None:
    for shift in (0, 7, 31):
        mixer = mixer_of(frequency_hz, max(1 / update_hz, 0.010))
        on, off = RATE // 2 + shift, RATE + 5 * shift
        # The game sets its gain in every update, not only when it changes.
        for frame in range(shift, 3 * RATE // 2, RATE // update_hz):
            set_gains(mixer, np.full((1, 1), float(on <= frame < off), dtype=np.float32), frame)
        x = mixer.render(3 * RATE // 2 + RATE // 4)[:, 0]
        for jump in (on, off):
            assert high_db(x, jump, 0.5**2 / 2) <= -60


@pytest.mark.parametrize("update_hz", [50, 1000])
def test_stepwise_gain_changes_cause_no_whine(update_hz: int) -> None:
    """A gain that follows a curve, set at the game's rate: a staircase would whine at that rate and above."""
    mixer = mixer_of(250, max(1 / update_hz, 0.010))
    for frame in range(0, RATE, RATE // update_hz):
        gain = math.exp(-3 * frame / RATE) * (1.1 + math.sin(2 * np.pi * 3 * frame / RATE)) / 2.1
        set_gains(mixer, np.full((1, 1), gain, dtype=np.float32), frame)
    x = mixer.render(RATE)[:, 0]
    power = float(np.mean(x[RATE // 4 :] ** 2))
    assert high_db(x, RATE // 2, power) <= -60


@pytest.mark.parametrize("name", EDGE_SCENES)
def test_edge_scenes_have_no_click_as_hands_come_and_go(name: str) -> None:
    """Objects are touched, released and lifted: scenes with sources have no click, scenes without are silent."""
    scene, bundle = EDGE_SCENES[name]()
    session = HapticSession(scene, bundle)
    items = [scene.object(x) for x in session.source_ids[:2]] or [scene.objects[0]]
    parts, rng = [], np.random.default_rng(3)
    for turn in range(12):
        item = items[turn % len(items)]
        x, y, z = item.pose.position_m
        pose = Pose((x, y + 0.3 * (turn % 3 == 2), z))
        session.update({item.id: pose}, [Touch("left", item.id, on_top_of(item))] if turn % 2 == 0 else [])
        parts.append(session.render(int(rng.integers(4000, 9000)))[:, 0])
    out = np.concatenate(parts)
    if not session.source_ids:
        assert not out.any()
        return
    high = oaconvolve(out.astype(np.float64), ABOVE_1_KHZ, mode="same")
    assert 10 * math.log10(np.mean(high**2) / np.mean(out**2)) <= -60


def test_lifting_a_phone_a_thousand_times_causes_no_click() -> None:
    scene, bundle = table_with_two_phones()
    session = HapticSession(scene, bundle)
    home = scene.object("phone").pose
    x0, y0, z0 = home.position_m
    touch = [Touch("left", "table", (0.3, 0.72, 0.4)), Touch("right", "phone", home.position_m)]
    poses = (Pose((x0, y0 + 0.3, z0), home.rotation_xyzw), home)
    frames = [session.update({"phone": pose}, touch).gains for pose in poses]
    assert frames[0][0, 0, 0] == 0.0 < frames[1][0, 0, 0]
    loops = [next(iter(bundle.loops[source].values())).tactile for source in session.source_ids]
    mixer = Mixer(LoopBank(loops, Bands.dominant(), TACTILE), 2, sample_rate_hz=RATE, ramp_s=0.02)
    rng = np.random.default_rng(2)
    parts = []
    for _ in range(1000):
        for gains in frames:
            set_gains(mixer, gains.reshape(2, -1), mixer.position)
            parts.append(mixer.render(int(rng.integers(480, 1500)))[:, 0])
    x = np.concatenate(parts).astype(np.float64)
    high = oaconvolve(x, ABOVE_1_KHZ, mode="same")
    power = float(np.mean(x**2))
    windows = len(x) // (RATE // 4)
    worst = np.mean(high[: windows * RATE // 4].reshape(windows, -1) ** 2, axis=1).max()
    assert power > 1e-5
    assert 10 * math.log10(worst / power) <= -60
