"""Landings in frames of irregular length: late frames, stalls, clocks in blocks, physics at a rate of its own.

The motions are analytic (`cup_over_table`), so that what lands, when and how fast is known.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from cup_over_table import G, Height, Shown, fall, landings_of, put_down, shaken


def every(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    return [(t, t) for t in np.arange(rng.uniform(0, 1 / hz), lasts_s, 1 / hz).tolist()]


def late(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Every fifth frame misses a refresh of the display."""
    lengths = np.where(rng.random(math.ceil(lasts_s * hz)) < 0.2, 2, 1) / hz
    return [(t, t) for t in np.cumsum(lengths).tolist() if t < lasts_s]


def stalls(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Two stalls a second of 50 to 120 ms."""
    n = math.ceil(lasts_s * hz)
    lengths = np.where(rng.random(n) < 2 / hz, rng.uniform(0.05, 0.12, n), 1 / hz)
    return [(t, t) for t in np.cumsum(lengths).tolist() if t < lasts_s]


def half_rate(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """A headset that halves its rate of frames and doubles it again."""
    lengths = np.concatenate([np.full(int(rng.integers(5, 30)), (1 + i % 2) / hz) for i in range(20)])
    return [(t, t) for t in np.cumsum(lengths).tolist() if t < lasts_s]


def blocks(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """The clock of a sound card, in blocks of 512 samples."""
    return [(t, math.floor(t * 48_000 / 512) * 512 / 48_000) for t, _ in every(hz, lasts_s, rng)]


def uneven_calls(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Even frames, which the game reports up to a fifth of a frame early or late."""
    return [(t, t + float(rng.uniform(-0.2, 0.2)) / hz) for t, _ in every(hz, lasts_s, rng)]


def physics(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Physics at 50 Hz, shown without interpolation."""
    begins = rng.random()
    return [(math.floor(t * 50 + begins) / 50, t) for t, _ in every(hz, lasts_s, rng)]


def physics_and_stalls(hz: int, lasts_s: float, rng: np.random.Generator) -> Shown:
    """Physics at 50 Hz in frames with stalls."""
    begins = rng.random()
    return [(math.floor(t * 50 + begins) / 50, t) for t, _ in stalls(hz, lasts_s, rng)]


KINDS = [every, late, stalls, half_rate, blocks, uneven_calls, physics]
Frames = Callable[[int, float, np.random.Generator], Shown]


@pytest.mark.parametrize("motion", [put_down, shaken])
@pytest.mark.parametrize("frames", KINDS)
def test_object_that_a_hand_puts_down_or_shakes_gently_does_not_land(
    motion: Callable[[np.random.Generator], tuple[Height, float]], frames: Frames
) -> None:
    found = []
    for seed in range(32):
        rng = np.random.default_rng(seed)
        height_m, lasts_s = motion(rng)
        if landings_of(height_m, frames((60, 72, 90, 120)[seed % 4], lasts_s, rng)):
            found.append(seed)
    assert found == []


def test_object_that_a_hand_puts_down_gently_seldom_lands_where_physics_is_slower_and_frames_stall() -> None:
    """A step that ends with a stall is as long as the stall; that of the physics is 20 ms."""
    n_landed = 0
    for seed in range(100):
        rng = np.random.default_rng(seed)
        height_m, lasts_s = put_down(rng)
        n_landed += bool(landings_of(height_m, physics_and_stalls((60, 72, 90, 120)[seed % 4], lasts_s, rng)))
    assert n_landed <= 1


@pytest.mark.parametrize("height_m", [0.02, 0.03, 0.1, 1.0])
@pytest.mark.parametrize(
    ("frames", "least", "most"), [(x, 0.95, 1.01) for x in KINDS[:4]] + [(x, 0.8, 1.1) for x in KINDS[4:]]
)
def test_object_that_falls_lands_once(frames: Frames, least: float, most: float, height_m: float) -> None:
    """If three frames saw it, and the 60 ms before a stall or of slower physics; and the mean speed of 40 falls."""
    falls_s, ratios = math.sqrt(2 * height_m / G), []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        held_s = float(rng.uniform(0.1, 0.6))
        shown = frames((60, 72, 90, 120)[seed % 4], held_s + falls_s + 0.5, rng)
        seen = {pose_s for pose_s, _ in shown if held_s < pose_s < held_s + falls_s}
        found = landings_of(fall(height_m, held_s), shown)
        assert len(found) <= 1
        if len(seen) > 2 and (frames not in (stalls, physics) or max(seen) - held_s > 0.06):
            assert len(found) == 1, seed
            assert found[0].point_m[1] == pytest.approx(0.7, abs=2e-3)  # not in mid air
            ratios.append(found[0].speed_m_s / (G * falls_s))
    assert not ratios or least < np.mean(ratios) < most


def test_a_long_step_in_a_stall_is_no_teleport() -> None:
    """The step of a stall is as long as so many frames; the object lands in the frame after it, or in this one."""
    for left_s in (-0.03, -0.003, 0.003, 0.006):
        lands_s = 0.3 + math.sqrt(2 / G)
        times = np.arange(0.0, 1.5, 1 / 120) + lands_s % (1 / 120) - left_s
        times = times[(times < lands_s - left_s - 0.105) | (times > lands_s - left_s - 0.001)]
        (one,) = landings_of(fall(1.0, 0.3), [(t, t) for t in times.tolist()])
        assert one.speed_m_s == pytest.approx(math.sqrt(2 * G), rel=0.1)


def test_a_step_of_slower_physics_says_how_fast_a_landing_is() -> None:
    """The clock does not stand still where only two steps are known: each takes three frames at 120 Hz."""
    shown = [(math.floor(t * 40 + 1e-6) / 40, t) for t in np.arange(0.0, 1.0, 1 / 120).tolist()]
    (one,) = landings_of(lambda t: max(0.0, 1.5 * (0.52 - max(t, 0.3))), shown)
    assert one.speed_m_s == pytest.approx(1.5, rel=0.1)
