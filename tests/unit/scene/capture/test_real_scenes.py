"""Pictures of the tests' rooms and of other real scenes: framing, outlines against a separate id pass, visibility."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.ndimage import binary_dilation

from others import SCENES, there
from rooms import room_file
from scene2hap import SceneSnapshot, load_scene
from scene2hap.scene.capture import capture_images
from scene2hap.scene.capture.lazy_pictures import LazyPictures
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.views import Camera
from scene2hap.scene.images import Shot

pytest.importorskip("embreex", reason="needs the extra `pictures`")

FILES: dict[str, tuple[str, float | None]] = {
    "aws_house_living": ("aws_house_living.glb", None),
    "sketchfab_kitchen": ("scene.gltf", 0.01),
}
SIZE_PX = 192
PINK = (255, 0, 190)
_loaded: dict[str, SceneSnapshot] = {}


OWN = ("dining_room", "workshop")


def file_of(name: str) -> Path:
    return room_file(name) if name in OWN else SCENES / name / FILES[name][0]


def names() -> list[str]:
    return [*OWN, *there(FILES, file_of)]


def studio_of(name: str) -> LazyPictures:
    """The scene captured without appearances, whose textures may have holes that an id pass does not know."""
    if name not in _loaded:
        snapshot = load_scene(file_of(name), unit_m=FILES[name][1] if name in FILES else None)
        bare = tuple(replace(item, appearance=None) for item in snapshot.objects)
        _loaded[name] = replace(snapshot, objects=bare)
    images = capture_images(_loaded[name], size_px=SIZE_PX).images
    assert images is not None
    assert isinstance(images.source, LazyPictures)
    return images.source


def some_ids(pictures: LazyPictures, every: int) -> list[str]:
    return [item.id for item in pictures.scene.objects][::every]


def picture(png: bytes) -> np.ndarray:
    return np.asarray(Image.open(BytesIO(png)))


def rays_at(camera: Camera, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    x = camera.centre[0] + ((columns + 0.5) / camera.size_px - 0.5) * 2 * camera.half
    y = camera.centre[1] - ((rows + 0.5) / camera.size_px - 0.5) * 2 * camera.half
    return x[:, None] * camera.axes[0] + y[:, None] * camera.axes[1] + camera.axes[2]


def first_objects(pictures: LazyPictures, camera: Camera, selection: Selection, directions: np.ndarray) -> np.ndarray:
    """The first object on each ray, by Moeller and Trumbore's test of every ray with every triangle."""
    origin = np.asarray(pictures.render_scene.origin_m)
    best, owner = np.full(len(directions), np.inf), np.full(len(directions), -1)
    focus = np.asarray(selection.focus_m)
    for number in sorted(selection.shown):
        item = pictures.scene.objects[number]
        mesh = item.geometry.mesh
        triangles = (item.pose.to_world(mesh.vertices_m) - origin)[mesh.faces]
        a, edge1, edge2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        keep = np.ones(len(a), bool)
        if number in selection.opened:
            normal = np.cross(edge1, edge2)
            side = [np.sign(((point - a) * normal).sum(axis=1)) for point in (camera.eye_m, focus)]
            keep = side[0] * side[1] >= 0
        # Triangles wholly on one side of all rays are left out; those around the eye are kept.
        placed = (triangles - camera.eye_m) @ camera.axes.T
        ahead = (placed[:, :, 2] > 1e-9).all(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            plane = placed[:, :, :2] / placed[:, :, 2:]
        seen = (directions @ camera.axes.T)[:, :2]
        is_aside = (plane.max(axis=1) < seen.min(axis=0)).any(axis=1) | (plane.min(axis=1) > seen.max(axis=0)).any(
            axis=1
        )
        keep &= ~(ahead & is_aside) & (placed[:, :, 2] > 0).any(axis=1)
        for corner, one, two in zip(a[keep], edge1[keep], edge2[keep], strict=True):
            across = np.cross(directions, two)
            det = across @ one
            with np.errstate(divide="ignore", invalid="ignore"):
                u = across @ (camera.eye_m - corner) / det
                turned = np.cross(camera.eye_m - corner, one)
                v = directions @ turned / det
                t = two @ turned / det
                is_hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (t < best)
            best[is_hit], owner[is_hit] = t[is_hit], number
    return owner


@pytest.mark.parametrize(
    ("name", "every"),
    [(name, {"aws_house_living": 24}.get(name, 3 if name in OWN else 15)) for name in names()],
)
def test_outline_encloses_exactly_the_visible_target(name: str, every: int) -> None:
    pictures = studio_of(name)
    width = pictures.config.outline_px
    reach = np.hypot(*np.mgrid[-width : width + 1, -width : width + 1]) <= width + 0.5
    common = total = 0
    for turn, subject in enumerate(sorted(set(pictures.copies.context.values()))[::every]):
        shot = pictures.config.object_shots("context", subject)[turn % 8]
        camera, selection = pictures._shot_renderer.aim(shot)
        is_outline = (picture(pictures.image(shot)) == PINK).all(axis=2)
        rows, columns = np.nonzero(is_outline)
        assert len(rows), f"{subject} has no outline {shot.label}"
        window = np.zeros_like(is_outline)
        margin = 2 * width
        window[
            max(rows.min() - margin, 0) : rows.max() + margin, max(columns.min() - margin, 0) : columns.max() + margin
        ] = True
        at = np.nonzero(window)
        owner = np.full(is_outline.shape, -1)
        owner[at] = first_objects(pictures, camera, selection, rays_at(camera, *at))
        is_target = owner == pictures.render_scene.index[subject]
        expected = binary_dilation(is_target, reach) & ~is_target
        common += (expected & is_outline).sum()
        total += (expected | is_outline).sum()
    print(f"{name}: IoU {common / total:.4f}")
    assert common / total >= 0.98


@pytest.mark.parametrize("name", names())
def test_every_isolated_image_is_framed_and_not_blank(name: str) -> None:
    pictures = studio_of(name)
    shots = pictures._shot_renderer
    for subject in some_ids(pictures, 5):
        item = pictures.scene.object(subject)
        points = item.pose.to_world(item.geometry.mesh.vertices_m[np.unique(item.geometry.mesh.faces)])
        for shot in pictures.config.object_shots("isolated", subject)[::3]:
            camera, _ = shots.aim(shot)
            pixels, _ = camera.project(points - pictures.render_scene.origin_m)
            assert 0.6 <= np.ptp(pixels, axis=0).max() / SIZE_PX <= 0.9
            assert picture(pictures.image(shot)).std() > 2


@pytest.mark.parametrize("name", names())
def test_targets_are_visible_in_context_pictures(name: str) -> None:
    pictures = studio_of(name)
    shots = pictures._shot_renderer
    good = []
    subjects = sorted(set(pictures.copies.context.values()))[1::5]
    for subject in subjects:
        number = pictures.render_scene.index[subject]
        shares = []
        for shot in pictures.config.object_shots("context", subject):
            camera, selection = shots.aim(shot)
            small = camera.resized(96)
            alone = shots.renderer.identify(small, Selection(frozenset({number}))) == number
            seen = shots.renderer.identify(small, selection) == number
            shares.append((alone & seen).sum() / max(alone.sum(), 1))
        good.append(sum(share >= 0.6 for share in shares) >= 4)
    assert np.mean(good) >= 0.95


@pytest.mark.parametrize("name", names())
def test_scene_pictures_show_most_objects(name: str) -> None:
    pictures = studio_of(name)
    seen: set[int] = set()
    for shot in pictures.config.scene_shots():
        camera, selection = pictures._shot_renderer.aim(shot)
        seen |= set(np.unique(pictures._shot_renderer.renderer.identify(camera, selection)).tolist())
        assert picture(pictures.image(shot)).std() > 10
    assert len(seen - {-1}) >= 0.7 * len(pictures.scene.objects)


def test_shots_have_readable_names() -> None:
    assert Shot("context", "cup", 390.0, -45.0).label == "below 30°"
