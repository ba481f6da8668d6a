"""Edge cases of scenes for sessions, built in code; every suite that runs sessions also runs these."""

from __future__ import annotations

from collections.abc import Callable

from scene2hap import HapticBundle, SceneObject, SceneSnapshot
from scene2hap.haptics import ObjectHaptics
from scenes import box, haptics, scene, tone_loop

Bundled = tuple[SceneSnapshot, HapticBundle]

_TABLE = box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4))
_PHONE = box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4))
_CUBE_M = 0.5


def no_source() -> Bundled:
    """A plate that lies on a table, and a bundle without sounds."""
    objects = {"table": haptics("oak", (1.6, 0.8, 0.02)), "phone": haptics("glass", (0.1, 0.1, 0.01))}
    return _bundled(scene(_TABLE, _PHONE), objects, ())


def one_object() -> Bundled:
    """One object, which vibrates."""
    return _bundled(scene(_PHONE), {"phone": haptics("glass", (0.1, 0.1, 0.01), "on")}, ("phone",))


def one_silent_object() -> Bundled:
    """One object, which does not."""
    return _bundled(scene(_TABLE), {"table": haptics("oak", (1.6, 0.8, 0.02))}, ())


def no_contact() -> Bundled:
    """Three separate objects in the air: one vibrates, and one vibrates only in contact with the table."""
    apart = (_TABLE, box("phone", (0.1, 0.01, 0.1), (0.1, 3.0, 0.4)), box("pan", (0.2, 0.01, 0.2), (1.0, 5.0, 0.4)))
    objects = {
        "table": haptics("oak", (1.6, 0.8, 0.02)),
        "phone": haptics("glass", (0.1, 0.1, 0.01), "on"),
        "pan": haptics("steel", (0.2, 0.2, 0.01), "on", needs_contact="table"),
    }
    return _bundled(scene(*apart), objects, ("phone", "pan"))


def all_unknown() -> Bundled:
    """Objects without any result of inference."""
    return _bundled(scene(_TABLE, _PHONE), {}, ())


def unknown_source() -> Bundled:
    """A source of unknown material on a table of unknown material."""
    objects = {"table": haptics(None, (1.6, 0.8, 0.02)), "phone": haptics(None, (0.1, 0.1, 0.01), "on")}
    return _bundled(scene(_TABLE, _PHONE), objects, ("phone",))


def equal_cubes() -> Bundled:
    """Thirty equal cubes with different names, in rows that touch; six of them vibrate."""
    names = [f"cube {n}" for n in range(30)]
    size = (_CUBE_M,) * 3
    cubes = [box(x, size, (_CUBE_M * (n % 10), _CUBE_M * (0.5 + n // 10), 0.0)) for n, x in enumerate(names)]
    sources = tuple(names[::5])
    objects = {x: haptics("pine", size, *(["on"] if x in sources else [])) for x in names}
    return _bundled(scene(*cubes), objects, sources)


EDGE_SCENES: dict[str, Callable[[], Bundled]] = {
    made.__name__: made
    for made in (no_source, one_object, one_silent_object, no_contact, all_unknown, unknown_source, equal_cubes)
}


def on_top_of(item: SceneObject) -> tuple[float, float, float]:
    """A point above the middle of a box [m]."""
    x, y, z = item.pose.position_m
    return (x, y + item.surface.thickness_m / 2, z)


def _bundled(snapshot: SceneSnapshot, objects: dict[str, ObjectHaptics], sources: tuple[str, ...]) -> Bundled:
    loops = {name: {"on": tone_loop(100.0 + 20.0 * (n % 5))} for n, name in enumerate(sources)}
    return snapshot, HapticBundle(snapshot, snapshot.name, objects, loops)
