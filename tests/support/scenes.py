"""Small scenes of boxes for tests, with their bundles."""

from __future__ import annotations

import numpy as np

from scene2hap import (
    AudioClip,
    Box,
    DominantSurface,
    HapticBundle,
    HapticLoop,
    ObjectHaptics,
    Pose,
    SceneObject,
    SceneSnapshot,
    SourceState,
    materials,
)
from scene2hap.scene.objects import with_relative_heights

RATE = 8000


def box(name: str, size_m: tuple[float, float, float], at_m: tuple[float, float, float]) -> SceneObject:
    """A cuboid (x, y up, z) whose dominant surface is its top."""
    x, y, z = size_m
    quarter_turn = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)
    surface = DominantSurface(Pose((-x / 2, 0.0, z / 2), quarter_turn), x, z, y)
    return SceneObject(name, name, Pose(at_m), Box(size_m), surface)


def scene(*objects: SceneObject) -> SceneSnapshot:
    """A y-up scene."""
    return SceneSnapshot("test room", "y", with_relative_heights(list(objects), "y"))


def tone_loop(frequency_hz: float, amplitude: float = 0.3, seconds: float = 0.5) -> HapticLoop:
    """A loop of whole cycles, the same for ear and hand."""
    n = round(seconds * RATE)
    samples = amplitude * np.sin(2 * np.pi * frequency_hz * np.arange(n) / RATE)
    clip = AudioClip(samples.astype(np.float32), RATE)
    return HapticLoop(clip, clip, frequency_hz, frequency_hz)


def haptics(
    material: str | None, size_m: tuple[float, float, float], *states: str, needs_contact: str | None = None
) -> ObjectHaptics:
    """Haptics as inference would give them, with the category "thing"."""
    return ObjectHaptics(
        object_category="thing",
        material_category=material or "unknown",
        material=materials.lookup(material) if material else None,
        estimated_size_m=size_m,
        usage="stands there",
        vibrates=bool(states),
        states=tuple(SourceState(state, 0.5, f"thing {state}", "thing humming", needs_contact) for state in states),
    )


def table_with_two_phones() -> tuple[SceneSnapshot, HapticBundle]:
    """Two phones at x = 0.1 m and x = 1.5 m on an oak table 1.6 m long with its top at y = 0.72 m.
    A block stands under the table; a cup touches nothing."""
    snapshot = scene(
        box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
        box("block", (0.4, 0.7, 0.4), (0.8, 0.35, 0.4)),
        box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4)),
        box("alarm", (0.1, 0.01, 0.1), (1.5, 0.725, 0.4)),
        box("cup", (0.1, 0.1, 0.1), (5.0, 0.05, 5.0)),
    )
    objects = {
        "table": haptics("oak", (1.6, 0.8, 0.02)),
        "block": haptics(None, (0.4, 0.4, 0.7)),
        "phone": haptics("glass", (0.1, 0.1, 0.01), "ringing", "alarm"),
        "alarm": haptics("plastic", (0.1, 0.1, 0.01), "ringing"),
        "cup": haptics("ceramic", (0.1, 0.1, 0.1)),
    }
    loops = {
        "phone": {"ringing": tone_loop(100), "alarm": tone_loop(240)},
        "alarm": {"ringing": tone_loop(160)},
    }
    return snapshot, HapticBundle(snapshot, "room", objects, loops)
