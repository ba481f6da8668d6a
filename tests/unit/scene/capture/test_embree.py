"""Ray-cast pictures: ids, colours, cut-outs, antialiased edges, and equal bytes in every process."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from scene2hap import Pose, SceneSnapshot
from scene2hap.scene.capture import capture_images, contact_sheet, plan_view, render_all
from scene2hap.scene.capture.cache import MEMORY
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB
from scene2hap.scene.capture.fonts import lettering
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import frame
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scenes import box, scene

embree = pytest.importorskip(
    "scene2hap.scene.capture.embree", reason="needs the extra `pictures`", exc_type=ImportError
)


def painted(color: tuple[float, float, float, float], texture: np.ndarray | None = None) -> Appearance:
    """The appearance of a box of twelve faces in one material; each triangle shows half of the texture."""
    uv = np.tile(np.array([(0, 0), (0, 1), (1, 1)], np.float32), (12, 1, 1))
    return Appearance((FaceMaterial(color, texture),), np.zeros(12, np.int32), uv)


def table_and_cup() -> SceneSnapshot:
    return scene(
        replace(box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)), appearance=painted((0.5, 0.3, 0.1, 1.0))),
        replace(box("cup", (0.1, 0.1, 0.1), (0, 0.75, 0)), appearance=painted((0.0, 0.0, 1.0, 1.0))),
    )


def pixels(png: bytes) -> np.ndarray:
    return np.asarray(Image.open(BytesIO(png)))


def draw(snapshot: SceneSnapshot, shown: set[int] | None = None, **options: Any) -> tuple[np.ndarray, np.ndarray]:
    render_scene = RenderScene.of(snapshot)
    points = np.concatenate([item.points_m for item in render_scene.objects])
    camera = frame(points, 30.0, 45.0, "y", 0.8, 160)
    selection = Selection(frozenset(shown) if shown is not None else render_scene.everyone)
    found: tuple[np.ndarray, np.ndarray] = embree.EmbreeRenderer(render_scene, **options).draw(camera, selection)
    return found


def test_rendered_colours_are_material_colours_under_light() -> None:
    picture, ids = draw(table_and_cup(), antialias=False)
    assert (picture[ids == -1] == BACKGROUND_RGB).all()
    cup, table = picture[ids == 1], picture[ids == 0]
    assert (cup[:, :2] == 0).all()
    assert 60 < cup[:, 2].min() < cup[:, 2].max() <= 255
    np.testing.assert_allclose(table[:, 1] / table[:, 0], 0.6, atol=0.03)


def test_textures_lie_where_uv_says() -> None:
    halves = np.zeros((2, 2, 3), np.uint8)
    halves[:, 0], halves[:, 1] = (255, 0, 0), (0, 255, 0)
    cube = replace(box("cube", (1, 1, 1), (0, 0, 0)), appearance=painted((1, 1, 1, 1), halves))
    picture, ids = draw(scene(cube), antialias=False)
    red, green = picture[ids == 0][:, 0] > 0, picture[ids == 0][:, 1] > 0
    assert (red != green).all()
    # On the triangle (0,0), (0,1), (1,1), 3/4 of the area have u < 1/2; perspective changes this a little.
    assert red.mean() == pytest.approx(0.75, abs=0.04)


def test_transparent_texels_show_objects_behind() -> None:
    holed = np.zeros((2, 2, 4), np.uint8)
    holed[:, 0] = (0, 200, 0, 255)
    crate = replace(box("crate", (1, 1, 1), (0, 0, 0)), appearance=painted((1, 1, 1, 1), holed))
    core = replace(box("core", (0.5, 0.5, 0.5), (0, 0, 0)), appearance=painted((1.0, 0.0, 0.0, 1.0)))
    _, ids = draw(scene(crate, core), antialias=False)
    assert (ids == 1).sum() > 50
    _, closed = draw(scene(replace(crate, appearance=None), core), antialias=False)
    assert (closed == 1).sum() == 0


def test_hidden_object_leaves_no_hole_in_touching_objects() -> None:
    with_cup, _ = draw(table_and_cup(), {0}, antialias=False)
    snapshot = table_and_cup()
    lonely = scene(*snapshot.objects[:1], replace(snapshot.objects[1], pose=box("x", (1, 1, 1), (0, 0.75, 0)).pose))
    ids = draw(lonely, {0}, antialias=False)[1]
    other = draw(snapshot, {0, 1}, antialias=False)[1]
    # Under the hidden cup, rays meet the table's top and not objects below it.
    assert set(np.unique(ids)) == {-1, 0}
    assert ((ids >= 0) >= (other == 0)).all()
    top = with_cup[ids == 0]
    assert len(np.unique(top, axis=0)) == 3


def test_a_culled_object_in_the_whole_tree_leaves_no_trace() -> None:
    bare = table_and_cup()
    crowd = scene(
        *bare.objects, box("pen", (0.02, 0.02, 0.2), (0.4, 0.71, 0)), box("book", (0.2, 0.05, 0.3), (-0.4, 0.725, 0))
    )
    without_cup, ids = draw(crowd, {0, 2, 3}, antialias=False)
    assert 1 not in ids
    colours = np.unique(without_cup[ids == 0], axis=0)
    assert len(colours) == 3, "the table shows its three sides, nothing of what is inside it"


def test_a_tree_that_is_used_again_and_again_is_built_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A picture of the whole scene, then one with a wall opened, eight walls in turn."""
    built: list[int] = []
    walls = [box(f"wall {k}", (0.1, 1, 1), (k, 0.5, 0)) for k in range(8)]
    render_scene = RenderScene.of(scene(box("floor", (10, 0.1, 4), (4, -0.05, 0)), *walls))
    points = np.concatenate([item.points_m for item in render_scene.objects])
    camera = frame(points, 30.0, 45.0, "y", 0.8, 32)
    renderer = embree.EmbreeRenderer(render_scene, False)
    build = renderer._built
    monkeypatch.setattr(renderer, "_built", lambda numbers: built.append(len(numbers)) or build(numbers))
    for k in range(8):
        renderer.identify(camera, Selection(render_scene.everyone))
        renderer.identify(camera, Selection(render_scene.everyone, frozenset({1 + k}), (0.0, 0.0, 0.0)))
    assert built.count(9 * 12) == 1


def test_antialiasing_changes_only_edges() -> None:
    rough, ids = draw(table_and_cup(), antialias=False)
    smooth, same_ids = draw(table_and_cup(), antialias=True)
    np.testing.assert_array_equal(ids, same_ids)
    changed = (rough != smooth).any(axis=2)
    assert 0 < changed.mean() < 0.2
    between = smooth[changed].astype(int)
    assert len(np.unique(between, axis=0)) > 5


def test_outline_has_one_colour_and_target_keeps_its_colours() -> None:
    shot = capture_images(table_and_cup(), size_px=200)
    images = shot.object("cup").images
    assert images is not None
    for png in images.context:
        picture = pixels(png)
        assert (picture == (255, 0, 190)).all(axis=2).sum() > 40
    assert not (pixels(images.isolated[0]) == (255, 0, 190)).all(axis=2).any()


SCRIPT = """
import sys
sys.path[:0] = {path!r}
from test_embree import digest_of_pictures
if __name__ == "__main__":
    print(digest_of_pictures(workers=2))
"""


def digest_of_pictures(workers: int) -> str:
    shot = capture_images(table_and_cup(), size_px=64)
    render_all(shot, workers=workers)
    sets = [shot.images, *(one for item in shot.objects for one in (item.images.isolated, item.images.context))]
    return hashlib.sha256(b"".join(png for images in sets for png in images)).hexdigest()


def test_pictures_are_identical_across_processes_and_workers(tmp_path: Any) -> None:
    here = Path(__file__).parent
    path = [str(here), str(here.parents[2] / "support")]
    script = tmp_path / "take.py"
    script.write_text(SCRIPT.format(path=path))
    run = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == digest_of_pictures(workers=0)


def test_a_contact_sheet_shows_every_view() -> None:
    shot = capture_images(table_and_cup(), size_px=64)
    sheet = pixels(contact_sheet(shot.object("cup"), thumb_px=64))
    stats = render_all(capture_images(table_and_cup(), ["cup"], size_px=64))
    assert stats.rendered == 4
    assert sheet.shape[0] > 4 * 64
    assert sheet.shape[1] > 4 * 64
    for row in range(4):
        for column in range(4):
            top, left = 34 + 20 + row * 84, 8 + column * 72
            assert sheet[top : top + 64, left : left + 64].std() > 5


def test_a_plan_needs_no_renderer_and_names_everything_but_the_floor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scene2hap.scene.capture.embree", None)
    room = scene(
        *table_and_cup().objects, box("floor", (4, 0.1, 2), (0, -0.05, 0)), box("ceiling", (4, 0.1, 2), (0, 2.5, 0))
    )
    plan = pixels(plan_view(room, width_px=1616))
    assert plan.shape == (34 + 816, 1616, 3)
    blue = (plan[..., 2] > 200) & (plan[..., 0] < 20)
    assert 40 * 40 > blue.sum() > 600
    middle = np.argwhere(blue).mean(axis=0)
    np.testing.assert_allclose(middle, (34 + 408, 808), atol=8)


MAST = box("mast", (0.1, 4, 0.1), (1.9, 2, 0.9))
"""Higher than everything else, so that a plan cuts nothing else off."""


def test_a_plan_shows_what_is_on_top_at_each_place() -> None:
    """A tray above the low end of a ramp, whose high end is higher than the tray."""
    ramp = replace(box("ramp", (4, 0.1, 2), (0, 0, 0)), pose=Pose.from_euler((0, 0, 0), (0, 0, np.pi / 6)))
    tray = replace(box("tray", (0.8, 0.1, 0.8), (-1.2, 0, 0)), appearance=painted((0.0, 0.0, 1.0, 1.0)))
    plan = pixels(plan_view(scene(ramp, tray, MAST), width_px=816))
    is_blue = (plan[..., 2] > 200) & (plan[..., 0] < 20)
    # The ramp is 4 cos 30 degrees + 0.1 sin 30 degrees wide; the name covers some of the tray.
    whole = (0.8 * 800 / (4 * np.cos(np.pi / 6) + 0.05)) ** 2
    assert 0.85 * whole < is_blue.sum() < whole


@pytest.mark.parametrize(("width_m", "bar_m"), [(4.0, 0.5), (5.1, 1.0), (0.3, 0.05), (260.0, 50.0)])
def test_a_plan_has_a_bar_of_a_round_length(width_m: float, bar_m: float) -> None:
    """The bar ends at the margin on the right; 800 pixels show the whole width."""
    plan = pixels(plan_view(scene(box("floor", (width_m, 0.1 * width_m, 0.5 * width_m), (0, 0, 0))), width_px=816))
    row = (plan[17 + 5] == (0x22, 0x31, 0x3F)).all(axis=1)
    bar = np.flatnonzero(row[400:]) + 400  # the title is on the left
    assert bar[-1] == plan.shape[1] - 8 - 1
    assert len(bar) == bar[-1] - bar[0] + 1 == pytest.approx(bar_m / width_m * 800, abs=1)


def test_a_plan_outlines_white_on_white() -> None:
    white = painted((1.0, 1.0, 1.0, 1.0))
    floor = replace(box("floor", (4, 0.1, 2), (0, 0, 0)), appearance=white)
    tray = replace(box("tray", (0.8, 0.1, 0.8), (-1.2, 0.1, 0)), appearance=white)
    plan = pixels(plan_view(scene(floor, tray, MAST), width_px=816)).astype(int)
    row = plan[34 + 8 + 200 - 60, 20:700].sum(axis=1)
    np.testing.assert_allclose(np.flatnonzero(row < 0.6 * row.max()) + 20, [8 + 80, 8 + 240], atol=2)


@pytest.fixture(autouse=True)
def _no_memory() -> None:
    MEMORY.clear()


def crop_of_plan(*names: str) -> np.ndarray:
    """The plan's pixels around the name in the middle, for a floor with boxes above each other there."""
    floor = box("floor", (4, 0.1, 2), (0, -0.05, 0))
    room = scene(floor, *(box(name, (0.2, 0.2, 0.2), (0, 0.1 + 0.2 * k, 0)) for k, name in enumerate(names)))
    plan = pixels(plan_view(room, width_px=816))
    middle = 34 + 8 + 200
    return plan[middle - 6 : middle + 6, 408 - 20 : 408 + 20]


def test_no_line_of_a_plan_crosses_a_name() -> None:
    np.testing.assert_array_equal(crop_of_plan("cupboard", "radio"), crop_of_plan("cupboard"))


@pytest.mark.parametrize("name", ["Lüfter", "Motor №1", "Куб", "電話_1", "\u202egnp"])
def test_names_are_drawn_without_missing_glyphs(name: str) -> None:
    """Every letter differs from the glyph of a code that is no character."""
    shown, font = lettering(name, 12)
    none = bytes(font.getmask("\U0010ffff"))
    assert all(bytes(font.getmask(letter)) != none for letter in shown)
    assert shown == name or "\\u" in shown or "\\x" in shown
