"""Analytic motions of a cup over a table, of which what lands, when and how fast is known, and the landings found."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from contact_scenes import box, scene
from scene2hap.bundle import HapticBundle
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.session.impacts.landings import Landing, Landings
from scene2hap.session.present_scene.scene_state import SceneState

RESTS_M, G = 0.76, 9.81
"""Height of the resting cup's middle [m], and gravity [m/s2]."""

Height = Callable[[float], float]
"""Height of the cup over its rest [m] by time [s]."""
Shown = list[tuple[float, float]]
"""Time of the shown pose and of the clock for each frame [s]."""


def state_of(*objects: SceneObject) -> SceneState:
    """The state of a session with these objects, of which nothing else is known."""
    snapshot = scene(*objects)
    return SceneState(snapshot, HapticBundle(snapshot, "room", {}, {}))


def landings_of(height_m: Height, shown: Shown) -> list[Landing]:
    """The landings of a cup at a height over the table, until half a second after the last frame."""
    table, cup = box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)), box("cup", (0.08, 0.12, 0.08), (0.0, RESTS_M, 0.0))
    state, found = state_of(table, cup), list[Landing]()
    state.graph.update({"cup": Pose((0.0, RESTS_M + height_m(0.0), 0.0))})
    landings = Landings(state, 1 / 90)
    end_s = shown[-1][1]
    for pose_s, time_s in [*shown, *((None, end_s + 0.011 * (i + 1)) for i in range(45))]:
        poses = {} if pose_s is None else {"cup": Pose((0.0, RESTS_M + height_m(pose_s), 0.0))}
        landings.begin(poses, time_s)
        state.graph.update(poses)
        found += landings.look(poses, time_s)
    return found


def put_down(rng: np.random.Generator) -> tuple[Height, float]:
    """A stroke of least jerk (Flash and Hogan 1985), of a peak acceleration of 1 to 6 m/s2, and its end [s]."""
    height_m, most_m_s2 = float(rng.uniform(0.02, 0.3)), float(rng.uniform(1, 6))
    lasts_s = math.sqrt(10 / math.sqrt(3) * height_m / most_m_s2)

    def at(time_s: float) -> float:
        s = min(max(0.0, (time_s - 0.2) / lasts_s), 1.0)
        return height_m * (1 - s**3 * (10 - 15 * s + 6 * s * s))

    return at, lasts_s + 0.5


def shaken(rng: np.random.Generator) -> tuple[Height, float]:
    """A motion up and down by 1 to 6 m/s2, down to 0 to 2 cm over the table."""
    hz, most_m_s2, gap_m = float(rng.uniform(1, 8)), float(rng.uniform(1, 6)), float(rng.uniform(0, 0.02))
    swing_m, end_s = most_m_s2 / (2 * math.pi * hz) ** 2, 0.3 + math.floor(1.5 * hz) / hz

    def at(time_s: float) -> float:
        return gap_m + swing_m * (1 + math.cos(2 * math.pi * hz * (min(max(0.3, time_s), end_s) - 0.3)))

    return at, 2.0


def fall(height_m: float, begins_s: float) -> Height:
    lasts_s = math.sqrt(2 * height_m / G)
    return lambda t: height_m - G / 2 * min(max(0.0, t - begins_s), lasts_s) ** 2
