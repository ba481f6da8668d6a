"""Rooms for measurements: any number of objects, five movers that slide, seven sources, touches of two hands.

- `busy_room`: tables. One object in seven is a table; on each are a tray with an object on it and four more objects,
  all turned about the vertical.
- `shelf_room`: stacked shelves. Units of five boards in one mesh, seven objects on each board, 3 to 6 cm apart.
- `furnished_room`: dense groups of 30 meshes: a dining table with four chairs below it, plates, glasses
  on mats and bowls; a sofa with cushions; a sideboard with vases.
- `floor_room`: boxes and round objects on one floor, in a jittered grid.

Movers slide to and fro at their places, and every other mover turns. Every tenth frame the first mover is lifted or put
down.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap import (
    AudioClip,
    DominantSurface,
    HapticBundle,
    HapticLoop,
    ObjectHaptics,
    Pose,
    SceneObject,
    SceneSnapshot,
    SourceState,
    Touch,
    TriMesh,
    materials,
)
from scene2hap.scene.objects import with_relative_heights
from scene2hap.scene.shapes import Box

N_SOURCES, N_MOVERS = 7, 5
_TABLE = (1.2, 0.72, 0.8)
_LIFT_M = 0.25
_RATE = 8000


@dataclass(frozen=True)
class BusyRoom:
    """A scene with its bundle, its movers and the two objects that the hands touch."""

    scene: SceneSnapshot
    bundle: HapticBundle
    movers: tuple[str, ...]
    touched: tuple[str, str]

    def frame(self, i: int) -> dict[str, Pose]:
        """Poses of the movers in frame i. They move some 5 mm a frame."""
        moved = {}
        for k, name in enumerate(self.movers):
            home = self.scene.object(name).pose
            x, y, z = home.position_m
            phase = 0.1 * i + k
            lifted = _LIFT_M if k == 0 and (i // 10) % 2 else 0.0
            spin = yaw(0.02 * i) if k % 2 else Pose()
            turned = spin.compose(Pose((0, 0, 0), home.rotation_xyzw)).rotation_xyzw
            moved[name] = Pose((x + 0.05 * math.sin(phase), y + lifted, z + 0.03 * math.cos(phase)), turned)
        return moved

    def touches(self, i: int) -> list[Touch]:
        """One hand on each touched object, at another point in every frame."""
        hands = zip(("left", "right"), self.touched, strict=True)
        return [Touch(hand, name, self._point(name, i)) for hand, name in hands]

    def _point(self, name: str, i: int) -> tuple[float, float, float]:
        low, high = self.scene.object(name).bounds_m
        x, z = (float(low[a] + (high[a] - low[a]) * (0.5 + 0.4 * math.sin(0.37 * i + a))) for a in (0, 2))
        return (x, float(high[1]), z)


def busy_room(n_objects: int, kind: str = "box", seed: int = 1) -> BusyRoom:
    """Room of `n_objects` objects. kind : "box", twelve triangles each, or "mesh", some 500 each."""
    rng = np.random.default_rng(seed)
    made = {"box": _box, "mesh": _round}[kind]
    n_tables = max(1, (n_objects - 1 + 6) // 7)
    side = math.ceil(math.sqrt(n_tables))
    extent = 2.0 * side + 2.0
    objects = [_thing("floor", _slab(kind, (extent, 0.1, extent)), (extent / 2, -0.05, extent / 2), 0.0)]
    items: list[str] = []
    for t in range(n_tables):
        x, z = 2.0 * (t % side) + 2.0, 2.0 * (t // side) + 2.0
        angle = float(rng.uniform(-0.4, 0.4))
        objects.append(_thing(f"table{t:05d}", _desk(kind), (x, _TABLE[1] / 2, z), angle))
        turn = yaw(angle)
        for k in range(6):
            if len(objects) == n_objects:
                break
            slot = (-0.4 + 0.4 * (k % 3), 0.0, -0.18 + 0.36 * (k // 3))
            size = (0.26, 0.02, 0.26) if k == 4 else tuple(float(edge) for edge in rng.uniform(0.06, 0.14, 3))
            bottom = _TABLE[1]
            if k == 5:  # stands on the tray, which is the object before
                slot, bottom = (0.0, 0.0, 0.18), _TABLE[1] + 0.02
            at = turn.to_world(np.array(slot)) + np.array([x, bottom + size[1] / 2, z])
            name = f"item{t:05d}_{k}"
            geometry = _box(size) if k == 4 else made(size)
            objects.append(_thing(name, geometry, tuple(at.tolist()), float(rng.uniform(-3, 3))))
            if k < 4:
                items.append(name)
    # The hands touch the floor and a table on which movers are; two movers are sources, five sources stand still.
    return _room(objects, items, [name for name in items if name.startswith("item00000")][:3], "table00000")


def shelf_room(n_objects: int, seed: int) -> BusyRoom:
    """Shelf units along the walls, full of small objects."""
    rng = np.random.default_rng(seed)
    n_units = max(1, round((n_objects - 1) / 36))
    extent = 1.2 * n_units + 1.0
    objects = [_thing("floor", _box((extent, 0.1, 4.0)), (extent / 2, -0.05, 0.0), 0.0)]
    boards = [0.1 + 0.4 * k for k in range(5)]
    frame = [(_box((0.9, 0.02, 0.32)), (0.0, h - 1.0, 0.0)) for h in boards]
    frame += [(_box((0.02, 2.0, 0.32)), (x, 0.0, 0.0)) for x in (-0.46, 0.46)]
    unit = _joined([(mesh.vertices_m + move, mesh.faces) for mesh, move in frame])
    items: list[str] = []
    for u in range(n_units):
        at, angle = (1.2 * u + 1.0, float(rng.uniform(-1.5, 1.5))), float(rng.uniform(-0.2, 0.2))
        objects.append(_thing(f"shelf{u:04d}", unit, (at[0], 1.0, at[1]), angle))
        for k in range(35):
            if len(objects) == n_objects:
                break
            size = tuple(float(edge) for edge in rng.uniform(0.05, 0.09, 3))
            slot = np.array([-0.36 + 0.12 * (k % 7), boards[k // 7] + 0.01 + size[1] / 2, rng.uniform(-0.05, 0.05)])
            x, y, z = (yaw(angle).to_world(slot) + np.array([at[0], 0.0, at[1]])).tolist()
            name = f"item{u:04d}_{k:02d}"
            objects.append(_thing(name, (_round if k % 3 == 0 else _box)(size), (x, y, z), float(rng.uniform(-3, 3))))
            items.append(name)
    return _room(objects, items, items[:3], "shelf0000")


def furnished_room(n_objects: int, seed: int) -> BusyRoom:
    """Groups of 30 objects with furniture of some hundred to a thousand triangles."""
    rng = np.random.default_rng(seed)
    n_groups = max(1, (n_objects - 1 + 29) // 30)
    side = math.ceil(math.sqrt(n_groups))
    extent = 4.0 * side + 2.0
    objects = [_thing("floor", _slab("mesh", (extent, 0.1, extent)), (extent / 2, -0.05, extent / 2), 0.0)]
    items: list[str] = []
    for g in range(n_groups):
        middle, turn = np.array([4.0 * (g % side) + 3.0, 0.0, 4.0 * (g // side) + 3.0]), float(rng.uniform(-3, 3))
        for name, mesh, (x, bottom, z), angle, moves in _furniture(rng):
            if len(objects) == n_objects:
                break
            height = float(np.ptp(mesh.bounds_m[:, 1]))
            u, v, w = (yaw(turn).to_world(np.array([x, bottom + height / 2, z])) + middle).tolist()
            objects.append(_thing(f"{name}_{g:03d}", mesh, (u, v, w), turn + angle))
            if moves:
                items.append(f"{name}_{g:03d}")
    return _room(objects, items, items[:3], "dining_table_000")


Placed = tuple[str, TriMesh, tuple[float, float, float], float, bool]


def _furniture(rng: np.random.Generator) -> list[Placed]:
    """One group of furniture: name, mesh, middle of the bottom [m], turn [rad], and whether it may move, of each."""
    found: list[Placed] = [("dining_table", _desk("mesh"), (0.0, 0.0, 0.0), 0.0, False)]
    for k, (x, z, angle) in enumerate(
        ((-0.35, 0.45, 0.0), (0.35, 0.45, 0.0), (-0.35, -0.45, math.pi), (0.35, -0.45, math.pi))
    ):
        found.append((f"chair_{k}", _chair(), (x, 0.0, z), angle, False))
        found.append((f"plate_{k}", _round((0.22, 0.015, 0.22)), (x, 0.72, 0.24 if z > 0 else -0.24), 0.0, True))
        found.append((f"mat_{k}", _box((0.08, 0.004, 0.08)), (x + 0.17, 0.72, 0.26 if z > 0 else -0.26), 0.1, False))
        glass = _round((0.06, float(rng.uniform(0.1, 0.16)), 0.06))
        found.append((f"glass_{k}", glass, (x + 0.17, 0.724, 0.26 if z > 0 else -0.26), 0.0, True))
    found += [(f"bowl_{k}", _round((0.15, 0.06, 0.15)), (-0.18 + 0.18 * k, 0.72, 0.0), 0.0, True) for k in range(3)]
    found.append(("sofa", _sofa(), (0.0, 0.0, 1.6), math.pi, False))
    found += [
        (f"cushion_{k}", _gridded((0.4, 0.12, 0.35), 4), (-0.45 + 0.45 * k, 0.4, 1.6), 0.1 * k, True) for k in range(3)
    ]
    found.append(("sideboard", _gridded((1.4, 0.8, 0.4), 6), (0.0, 0.0, -1.6), 0.0, False))
    for k in range(4):
        size = (0.12, float(rng.uniform(0.15, 0.35)), 0.12)
        found.append((f"vase_{k}", _round(size), (-0.5 + 0.3 * k, 0.8, -1.6), 0.0, True))
    found.append(("rug", _slab("mesh", (0.9, 0.008, 0.6)), (1.45, 0.0, 0.0), 0.0, False))
    return found


def floor_room(n_objects: int, seed: int) -> BusyRoom:
    """Objects of 6 to 30 cm on a floor, some of them nearly touching."""
    rng = np.random.default_rng(seed)
    side = math.ceil(math.sqrt(n_objects - 1))
    extent = 0.4 * side + 2.0
    objects = [_thing("floor", _box((extent, 0.1, extent)), (extent / 2, -0.05, extent / 2), 0.0)]
    for k in range(n_objects - 1):
        size = tuple(float(edge) for edge in rng.uniform(0.06, 0.3, 3))
        x, z = (0.4 * cell + 1.0 + float(rng.uniform(-0.03, 0.03)) for cell in divmod(k, side))
        objects.append(
            _thing(f"item{k:05d}", (_box, _round)[k % 2](size), (x, size[1] / 2, z), float(rng.uniform(-3, 3)))
        )
    items = [item.id for item in objects[1:]]
    return _room(objects, items, items[:3], items[0])


def _room(objects: list[SceneObject], items: list[str], near: list[str], touched: str) -> BusyRoom:
    """Choose five movers, three of them near the touched objects, and seven sources, of which two move."""
    scene = SceneSnapshot("busy room", "y", with_relative_heights(objects, "y"))
    others = [items[round(k * (len(items) - 1) / 8)] for k in range(1, 9)]
    movers = tuple(dict.fromkeys([*near, *others[::4], *others]))[:N_MOVERS]
    still = [name for name in [*items[3:4], *others, *items] if name not in movers]
    sources = [*movers[:2], *dict.fromkeys(still)][:N_SOURCES]
    return BusyRoom(scene, _bundle(scene, sources), movers, ("floor", touched))


def yaw(angle: float) -> Pose:
    """Pose that is a turn about the vertical by `angle` [rad]."""
    return Pose((0, 0, 0), (0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)))


def _thing(name: str, mesh: TriMesh, at_m: tuple[float, ...], angle: float) -> SceneObject:
    x, y, z = (float(edge) for edge in np.ptp(mesh.bounds_m, axis=0))
    surface = DominantSurface(Pose((-x / 2, 0.0, z / 2), (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)), x, z, y)
    return SceneObject(name, name, Pose((at_m[0], at_m[1], at_m[2]), yaw(angle).rotation_xyzw), mesh, surface)


def _box(size: tuple[float, ...]) -> TriMesh:
    return Box((size[0], size[1], size[2])).mesh


def _slab(kind: str, size: tuple[float, float, float]) -> TriMesh:
    return _box(size) if kind == "box" else _gridded(size, 9)


def _desk(kind: str) -> TriMesh:
    if kind == "box":
        return _box(_TABLE)
    x, y, z = _TABLE
    parts = [_gridded((x, 0.04, z), 6)]
    moves = [(0.0, y / 2 - 0.02, 0.0)]
    for sx in (-1, 1):
        for sz in (-1, 1):
            parts.append(_gridded((0.06, y - 0.04, 0.06), 1))
            moves.append((sx * (x / 2 - 0.05), -0.02, sz * (z / 2 - 0.05)))
    return _joined([(part.vertices_m + move, part.faces) for part, move in zip(parts, moves, strict=True)])


def _chair() -> TriMesh:
    parts = [(_gridded((0.42, 0.04, 0.42), 4), (0.0, 0.0, 0.0)), (_gridded((0.42, 0.45, 0.03), 4), (0.0, 0.245, 0.195))]
    parts += [(_gridded((0.04, 0.43, 0.04), 1), (x, -0.235, z)) for x in (-0.18, 0.18) for z in (-0.18, 0.18)]
    return _centred(_joined([(part.vertices_m + move, part.faces) for part, move in parts]))


def _sofa() -> TriMesh:
    parts = [(_gridded((1.8, 0.4, 0.8), 5), (0.0, 0.0, 0.0)), (_gridded((1.8, 0.45, 0.2), 5), (0.0, 0.425, 0.3))]
    parts += [(_gridded((0.18, 0.6, 0.8), 3), (x, 0.1, 0.0)) for x in (-0.99, 0.99)]
    return _centred(_joined([(part.vertices_m + move, part.faces) for part, move in parts]))


def _centred(mesh: TriMesh) -> TriMesh:
    return TriMesh(mesh.vertices_m - mesh.bounds_m.mean(axis=0), mesh.faces)


def _gridded(size: tuple[float, float, float], n: int) -> TriMesh:
    """A cuboid whose faces are n x n squares of two triangles each."""
    line = np.linspace(-0.5, 0.5, n + 1)
    u, v = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    cell = np.arange(n)[:, None] * (n + 1) + np.arange(n)
    a, b, c, d = (np.ravel(cell + step) for step in (0, n + 1, n + 2, 1))
    quads = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    parts = []
    for axis in range(3):
        for end in (-0.5, 0.5):
            points = np.insert(np.stack([u, v], 1), axis, end, axis=1) * size
            flip = (end > 0) == (axis == 1)
            parts.append((points, quads[:, ::-1] if flip else quads))
    return _joined(parts)


def _round(size: tuple[float, ...]) -> TriMesh:
    """An upright prism of 125 sides: 498 triangles."""
    n = 125
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.stack([np.cos(angle) * size[0] / 2, np.zeros(n), np.sin(angle) * size[2] / 2], axis=1)
    up = np.array([0.0, size[1] / 2, 0.0])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    sides = np.concatenate([np.stack([i, i + n, j], 1), np.stack([j, i + n, j + n], 1)])
    k = np.arange(1, n - 1)
    bottom = np.stack([np.zeros_like(k), k, k + 1], 1)
    return TriMesh(np.concatenate([ring - up, ring + up]), np.concatenate([sides, bottom, bottom[:, ::-1] + n]))


def _joined(parts: list[tuple[NDArray[np.float64], NDArray[np.integer]]]) -> TriMesh:
    start = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    faces = [faces + first for (_, faces), first in zip(parts, start[:-1], strict=True)]
    return TriMesh(np.concatenate([vertices for vertices, _ in parts]), np.concatenate(faces))


def _bundle(scene: SceneSnapshot, sources: list[str]) -> HapticBundle:
    t = np.arange(4000) / _RATE
    objects, loops = {}, {}
    for item in scene.objects:
        x, y, z = (float(edge) for edge in np.ptp(item.geometry.mesh.bounds_m, axis=0))
        hums = item.id in sources
        states = (SourceState("humming", 0.5, "thing humming", "hum"),) if hums else ()
        name = "glass" if hums else "oak"
        objects[item.id] = ObjectHaptics(
            "thing", name, materials.lookup(name), (x, z, min(y, 0.03)), "stands there", hums, states
        )
    for k, source in enumerate(sources):
        clip = AudioClip((0.3 * np.sin(2 * np.pi * (80 + 40 * k) * t)).astype(np.float32), _RATE)
        loops[source] = {"humming": HapticLoop(clip, clip, 80.0 + 40 * k, 80.0 + 40 * k)}
    return HapticBundle(scene, "room", objects, loops)
