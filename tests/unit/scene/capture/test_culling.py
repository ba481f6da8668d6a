"""Culling of objects that hide the target, on small scenes with obvious answers."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap import SceneObject, SceneSnapshot
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.shot_rendering import ShotRenderer
from scene2hap.scene.capture.surroundings import supports
from scene2hap.scene.images import Shot
from scenes import box, scene

embree = pytest.importorskip(
    "scene2hap.scene.capture.embree", reason="needs the extra `pictures`", exc_type=ImportError
)

# Azimuth 0 looks from +z; the room is closed on all four sides.
ROOM = (
    box("floor", (6, 0.1, 6), (0, -0.05, 0)),
    box("ceiling", (6, 0.1, 6), (0, 2.55, 0)),
    box("north", (6, 2.5, 0.1), (0, 1.25, -2.95)),
    box("south", (6, 2.5, 0.1), (0, 1.25, 2.95)),
    box("east", (0.1, 2.5, 6), (2.95, 1.25, 0)),
    box("west", (0.1, 2.5, 6), (-2.95, 1.25, 0)),
)
TABLE = box("table", (1.2, 0.7, 0.8), (0, 0.35, 0))
CUP = box("cup", (0.1, 0.1, 0.1), (0, 0.75, 0))


def shot_renderer(*objects: SceneObject, **settings: object) -> ShotRenderer:
    snapshot: SceneSnapshot = scene(*objects)
    render_scene = RenderScene.of(snapshot)
    config = CaptureConfig.parse({"size_px": 128, "antialias": False, **settings})
    return ShotRenderer(render_scene, embree.EmbreeRenderer(render_scene, False), config, supports(render_scene))


def shown(shots: ShotRenderer, selection: Selection) -> set[str]:
    return {shots.scene.objects[k].id for k in selection.shown}


def visible_share(shots: ShotRenderer, shot: Shot) -> float:
    camera, selection = shots.aim(shot)
    target = shots.scene.index[str(shot.subject)]
    alone = shots.renderer.identify(camera, Selection(frozenset({target}))) == target
    seen = shots.renderer.identify(camera, selection) == target
    assert alone.any()
    return float((alone & seen).sum() / alone.sum())


def test_culling_removes_far_blockers_and_keeps_support_and_neighbour() -> None:
    blocker = box("pillar", (0.4, 1.0, 0.03), (0, 1.3, 0.15))
    spoon = box("spoon", (0.01, 0.01, 0.1), (0.065, 0.705, 0))
    bystander = box("chair", (0.4, 0.9, 0.4), (1.5, 0.45, 0))
    shots = shot_renderer(*ROOM[:1], TABLE, CUP, blocker, spoon, bystander)
    shot = Shot("context", "cup", 0.0, 45.0)
    _, selection = shots.aim(shot)
    assert shown(shots, selection) == {"floor", "table", "cup", "spoon", "chair"}
    assert visible_share(shots, shot) > 0.95


def test_culling_keeps_objects_behind_the_target() -> None:
    shots = shot_renderer(*ROOM[:1], TABLE, CUP, box("pillar", (0.4, 1.0, 0.03), (0, 1.3, -0.15)))
    _, selection = shots.aim(Shot("context", "cup", 0.0, 45.0))
    assert "pillar" in shown(shots, selection)


def test_culling_removes_a_neighbour_that_hides_more_than_the_allowed_share() -> None:
    objects = (*ROOM[:1], TABLE, CUP, box("book", (0.2, 0.1, 0.05), (0, 0.75, 0.08)))
    shot = Shot("context", "cup", 0.0, 45.0)
    strict, lenient = shot_renderer(*objects, hidden_share=0.2), shot_renderer(*objects, hidden_share=0.95)
    assert "book" not in shown(strict, strict.aim(shot)[1])
    assert "book" in shown(lenient, lenient.aim(shot)[1])
    assert visible_share(strict, shot) > 0.95
    assert visible_share(lenient, shot) < 0.8


def test_neighbours_hide_no_more_than_their_share_together() -> None:
    slats = [box(f"slat{k}", (0.015, 0.3, 0.01), (-0.04 + 0.02 * k, 0.85, 0.06)) for k in range(5)]
    shots = shot_renderer(*ROOM[:1], TABLE, CUP, *slats, hidden_share=0.35)
    shot = Shot("context", "cup", 0.0, 30.0)
    kept = [name for name in shown(shots, shots.aim(shot)[1]) if name.startswith("slat")]
    assert 1 <= len(kept) <= 3
    assert visible_share(shots, shot) >= 0.62


@pytest.mark.parametrize("azimuth", [0.0, 30.0, 90.0, 210.0])
def test_floor_and_table_do_not_hide_the_cup_from_below(azimuth: float) -> None:
    shots = shot_renderer(*ROOM, TABLE, CUP)
    shot = Shot("context", "cup", azimuth, -45.0)
    assert visible_share(shots, shot) > 0.95


@pytest.mark.parametrize("azimuth", [0.0, 45.0, 90.0])
def test_a_closed_room_is_opened_towards_the_camera_alone(azimuth: float) -> None:
    shots = shot_renderer(*ROOM, TABLE, CUP)
    camera, selection = shots.aim(Shot("scene", None, azimuth, 45.0))
    ids = shots.renderer.identify(camera, selection)
    seen = {shots.scene.objects[k].id for k in np.unique(ids[ids >= 0])}
    assert {"floor", "table", "north", "west"} <= seen
    # At most the far rim of the ceiling is visible.
    assert (ids == shots.scene.index["ceiling"]).mean() < 0.02
    assert (ids == shots.scene.index["floor"]).mean() > 0.1


def test_a_room_in_one_mesh_is_opened_like_one_of_walls() -> None:
    room = box("room", (6, 2.6, 6), (0, 1.25, 0))
    shots = shot_renderer(room, TABLE, CUP)
    for shot in (Shot("context", "table", 20.0, 45.0), Shot("scene", None, 20.0, 45.0)):
        camera, selection = shots.aim(shot)
        ids = shots.renderer.identify(camera, selection)
        assert shown(shots, selection) == {"room", "table", "cup"}
        assert (ids == 0).mean() > 0.2
        assert (ids == 1).any()


def test_culling_opens_a_cabinet_to_show_its_content() -> None:
    cabinet = box("cabinet", (0.8, 0.8, 0.5), (0, 0.4, 0))
    plate = box("plate", (0.3, 0.05, 0.3), (0, 0.4, 0))
    shots = shot_renderer(*ROOM[:1], cabinet, plate, box("chair", (0.4, 0.9, 0.4), (2, 0.45, 0)))
    for elevation in (45.0, -45.0):
        shot = Shot("context", "plate", 30.0, elevation)
        assert "cabinet" in shown(shots, shots.aim(shot)[1])
        assert visible_share(shots, shot) > 0.95


def test_scene_pictures_remove_blockers_of_the_central_object_only() -> None:
    sign = box("sign", (0.5, 0.5, 0.05), (0, 2.3, 1.2))
    middle = box("pillar", (0.5, 2.4, 0.5), (0, 1.2, 0))
    shots = shot_renderer(*ROOM[:1], middle, sign, TABLE)
    _, selection = shots.aim(Shot("scene", None, 0.0, 45.0))
    assert shown(shots, selection) == {"floor", "pillar", "table"}


def test_isolated_images_show_the_target_alone() -> None:
    shots = shot_renderer(*ROOM, TABLE, CUP)
    _, selection = shots.aim(Shot("isolated", "cup", 0.0, 45.0))
    assert shown(shots, selection) == {"cup"}


def test_context_frames_are_wider_but_not_beyond_the_scene() -> None:
    shots = shot_renderer(*ROOM, TABLE, CUP)
    factors = {}
    for name in ("cup", "floor"):
        close, wide = (shots.aim(Shot(kind, name, 0.0, 45.0))[0] for kind in ("isolated", "context"))
        np.testing.assert_array_equal(close.eye_m, wide.eye_m)
        factors[name] = wide.half / close.half
    assert factors["cup"] == pytest.approx(2.5)
    assert 1.25 <= factors["floor"] < 1.6
