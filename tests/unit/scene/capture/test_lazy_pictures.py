"""Captured scenes with a counting renderer: lazy rendering, sharing, caches, errors."""

from __future__ import annotations

import pickle
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from scene2hap import SceneSnapshot
from scene2hap.errors import ConfigError, MissingExtra, SceneError, UnknownObject, UnknownPlugin
from scene2hap.scene.capture import RENDERERS, CaptureConfig, capture_images, contact_sheet, render_all
from scene2hap.scene.capture.cache import MEMORY, FolderCache, MemoryCache
from scene2hap.scene.capture.protocol import Ids, Pixels, Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera
from scene2hap.scene.images import ImageSet
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scenes import box, scene


class CountingRenderer:
    """A renderer that paints a square of the first shown item, and counts its calls."""

    made = 0
    drawn = 0

    def __init__(self, render_scene: RenderScene, antialias: bool) -> None:
        type(self).made += 1

    def identify(self, camera: Camera, selection: Selection) -> Ids:
        ids = np.full((camera.size_px, camera.size_px), -1, np.int32)
        quarter = max(1, camera.size_px // 4)
        ids[quarter : 3 * quarter, quarter : 3 * quarter] = min(selection.shown)
        return ids

    def draw(self, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
        type(self).drawn += 1
        ids = self.identify(camera, selection)
        return np.repeat((ids[..., None] * 40 + 90).astype(np.uint8), 3, axis=2), ids


@pytest.fixture(autouse=True)
def _fresh() -> Iterator[None]:
    MEMORY.clear()
    CountingRenderer.made = CountingRenderer.drawn = 0
    yield
    MEMORY.clear()


def cups_on_tables() -> SceneSnapshot:
    """Two equal tables on a floor, and three equal cups: two on tables and one on the floor."""
    keys = {"floor": "f", "table": "t", "table#2": "t", "cup": "c", "cup#2": "c", "cup#3": "c"}
    objects = [
        box("floor", (8, 0.1, 8), (0, -0.05, 0)),
        box("table", (1, 0.7, 1), (-1, 0.35, 0)),
        box("table#2", (1, 0.7, 1), (1, 0.35, 0)),
        box("cup", (0.1, 0.1, 0.1), (-1, 0.75, 0)),
        box("cup#2", (0.1, 0.1, 0.1), (1, 0.75, 0)),
        box("cup#3", (0.1, 0.1, 0.1), (3, 0.05, 0)),
    ]
    return scene(*(replace(item, instance_key=keys[item.id]) for item in objects))


def captured(snapshot: SceneSnapshot | None = None, **settings: object) -> SceneSnapshot:
    return capture_images(snapshot or cups_on_tables(), size_px=32, renderer=CountingRenderer, config=settings)


def images_of(snapshot: SceneSnapshot) -> ImageSet:
    assert snapshot.images is not None
    return snapshot.images


def test_pictures_are_rendered_at_first_access() -> None:
    shot = captured()
    cup = shot.object("cup").images
    assert cup is not None
    assert (len(images_of(shot)), len(cup.isolated), len(cup.context)) == (4, 8, 8)
    assert [one.label for one in cup.context.shots][3:6] == ["above 300°", "below 30°", "below 120°"]
    assert "above 30°" in repr(cup.isolated)
    assert (CountingRenderer.made, CountingRenderer.drawn) == (0, 0)
    first = cup.isolated[0]
    assert first.startswith(b"\x89PNG")
    assert cup.isolated[0] is first
    assert cup.isolated[-8] is first
    assert (CountingRenderer.made, CountingRenderer.drawn) == (1, 1)
    assert len(cup.isolated[:3]) == 3
    assert CountingRenderer.drawn == 3


def test_copies_share_images_and_statistics_count_them() -> None:
    shot = captured()
    stats = render_all(shot)
    # Distinct objects: floor, table, cup. Distinct contexts: floor, table on floor, cup on table, cup on floor.
    assert stats.rendered == CountingRenderer.drawn == 4 + 8 * 3 + 8 * 4
    cups = [shot.object(key).images for key in ("cup", "cup#2", "cup#3")]
    assert cups[0].isolated[5] is cups[1].isolated[5] is cups[2].isolated[5]
    assert cups[0].context[5] is cups[1].context[5] is not cups[2].context[5]


def test_sharing_can_be_turned_off() -> None:
    stats = render_all(captured(share_copies=False))
    assert stats.rendered + stats.from_memory == 4 + 8 * 6 + 8 * 6
    # Equal meshes at equal rotations still have equal isolated pictures.
    assert stats.from_memory == 8 * 3


def test_only_requested_objects_get_images() -> None:
    shot = capture_images(cups_on_tables(), ["cup#2"], size_px=32, renderer=CountingRenderer)
    assert [item.id for item in shot.objects if item.images is not None] == ["cup#2"]
    assert render_all(shot).rendered == 4 + 8 + 8
    assert render_all(shot).rendered == 20


def test_progress_is_reported_for_every_picture() -> None:
    told: list[tuple[int, int]] = []
    render_all(
        capture_images(cups_on_tables(), [], size_px=32, renderer=CountingRenderer), progress=lambda *n: told.append(n)
    )
    assert told == [(1, 4), (2, 4), (3, 4), (4, 4)]


def test_second_capture_reads_pictures_from_memory() -> None:
    before = captured()
    render_all(before)
    drawn = CountingRenderer.drawn
    after = captured()
    stats = render_all(after)
    assert stats.rendered == 0
    assert stats.from_memory == drawn == CountingRenderer.drawn
    assert list(images_of(after)) == list(images_of(before))


def test_moved_object_reuses_only_its_isolated_images() -> None:
    render_all(captured())
    drawn = CountingRenderer.drawn
    moved = cups_on_tables()
    far = replace(moved.object("cup#3"), pose=box("x", (1, 1, 1), (3.5, 0.05, 1)).pose)
    again = render_all(captured(replace(moved, objects=(*moved.objects[:-1], far))))
    assert again.from_memory == 8 * 3
    assert CountingRenderer.drawn - drawn == 4 + 8 * 4


@pytest.mark.parametrize("change", [{"elevation_deg": 30.0}, {"outline_rgb": (0, 255, 0)}, {"antialias": True}])
def test_changed_settings_render_new_pictures(change: dict[str, object]) -> None:
    render_all(captured())
    assert render_all(captured(**change)).from_memory == 0


def test_a_folder_keeps_pictures_between_runs(tmp_path: Path) -> None:
    before = captured(cache_dir=tmp_path)
    render_all(before)
    assert not list(tmp_path.rglob(".*"))
    (tmp_path / "plain").touch()
    assert next(tmp_path.rglob("*.png")).stat().st_mode == (tmp_path / "plain").stat().st_mode, "others cannot share it"
    MEMORY.clear()
    after = captured(cache_dir=tmp_path)
    stats = render_all(after)
    assert (stats.rendered, stats.from_folder) == (0, CountingRenderer.drawn)
    assert list(images_of(after)) == list(images_of(before))


def test_truncated_picture_file_is_rendered_again(tmp_path: Path) -> None:
    render_all(captured(cache_dir=tmp_path))
    victim = next(tmp_path.rglob("*.png"))
    whole = victim.read_bytes()
    victim.write_bytes(whole[:-5])
    MEMORY.clear()
    assert render_all(captured(cache_dir=tmp_path)).rendered == 1
    assert victim.read_bytes() == whole


def test_error_names_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    cache = FolderCache(tmp_path / "file")
    assert cache.get("ab") is None
    with pytest.raises(ConfigError, match=r"file' cannot be written.*Name another"):
        cache.put("ab", b"png")


def test_memory_drops_the_least_recently_used_picture() -> None:
    cache = MemoryCache(limit_bytes=10)
    cache.put("a", b"1234")
    cache.put("b", b"1234")
    assert cache.get("a") == b"1234"
    cache.put("c", b"1234")
    assert (cache.get("a"), cache.get("b"), cache.get("c")) == (b"1234", None, b"1234")


def test_threads_can_read_pictures_concurrently() -> None:
    images = images_of(captured())
    found: list[list[bytes]] = []
    threads = [threading.Thread(target=lambda: found.append(list(images))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8
    assert all(pictures == found[0] for pictures in found)
    assert CountingRenderer.drawn == 4


def test_captured_scene_equals_the_original_scene() -> None:
    plain = cups_on_tables()
    shot = captured(plain)
    assert shot == plain
    assert SceneSnapshot.from_json(shot.to_json()) == plain
    assert SceneSnapshot.from_json(shot.to_json()).images is None
    moved = shot.with_poses({})
    assert moved.images is None
    assert moved.object("cup").images is None


def test_a_captured_scene_can_be_sent_to_another_process() -> None:
    shot = captured()
    copy = pickle.loads(pickle.dumps(shot))
    assert list(copy.images) == list(images_of(shot))


def test_invalid_appearance_is_refused_at_rendering() -> None:
    looks = Appearance((FaceMaterial(),), np.zeros(5, np.int32))
    shot = captured(scene(replace(box("cup", (1, 1, 1), (0, 0, 0)), appearance=looks)))
    with pytest.raises(SceneError, match="appearance of 'cup' has 5 faces, its mesh has 12"):
        _ = images_of(shot)[0]


def test_error_names_unknown_objects() -> None:
    with pytest.raises(UnknownObject, match="no object 'cupp'. Did you mean 'cup"):
        capture_images(cups_on_tables(), ["cupp"], renderer=CountingRenderer)
    with pytest.raises(ConfigError, match=r"give a list of ids, \['cup'\]"):
        capture_images(cups_on_tables(), "cup", renderer=CountingRenderer)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"size_px": 0}, "capture setting size_px: it must be at least 16, got 0"),
        ({"config": {"fill": 1.5}}, "capture setting fill: .*got 1.5"),
        ({"config": {"colour": 1}}, "no capture setting 'colour'"),
        ({"config": {"elevation_deg": 90.0}}, "capture setting elevation_deg: it must be below 90"),
        ({"config": {"outline_rgb": (300, 0, 0)}}, "capture setting outline_rgb.*it must be at most 255"),
        ({"renderer": 5}, "renderer is 5; it must be a kind"),
    ],
)
def test_settings_out_of_bounds_are_refused(settings: dict[str, object], sentence: str) -> None:
    with pytest.raises(ConfigError, match=sentence):
        capture_images(cups_on_tables(), **settings)


def test_error_for_an_unknown_renderer_lists_the_known_ones() -> None:
    with pytest.raises(UnknownPlugin, match="no kind 'povray'. Known: embree, panda3d"):
        capture_images(cups_on_tables(), renderer="povray")


def test_missing_extra_is_named_at_capture(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "embreex", None)
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    monkeypatch.delitem(sys.modules, "scene2hap.scene.capture.embree", raising=False)
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[pictures\]'"):
        capture_images(cups_on_tables())
    assert RENDERERS.extras["panda3d"] == "panda3d"


def test_error_for_a_scene_without_images_names_capture_images() -> None:
    with pytest.raises(ConfigError, match="call capture_images first"):
        render_all(cups_on_tables())
    with pytest.raises(ConfigError, match="pass a scene through capture_images first"):
        contact_sheet(cups_on_tables().object("cup"))


def test_settings_are_read_from_a_configuration() -> None:
    config = CaptureConfig(size_px=48, azimuths=2)
    shot = capture_images(cups_on_tables(), renderer=CountingRenderer, config=config)
    assert len(images_of(shot)) == 2
    images = shot.object("cup").images
    assert images is not None
    assert int.from_bytes(images.isolated[0][16:20], "big") == 48
