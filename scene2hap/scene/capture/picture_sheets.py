"""Pictures for people: all views of an object on one sheet, and a plan of the scene with names. Drawn with Pillow."""

from __future__ import annotations

from io import BytesIO

import numpy as np
from PIL import Image, ImageDraw

from scene2hap.common.arrays import Bools, Bytes, Floats
from scene2hap.errors import ConfigError
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB
from scene2hap.scene.capture.fonts import lettering
from scene2hap.scene.capture.png import png
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.surroundings import shells
from scene2hap.scene.capture.views import axes_of
from scene2hap.scene.from_above import NOTHING, HighestSurface
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot

_INK, _PAPER = "#22313f", "#ffffff"
_MARGIN, _TITLE, _LABEL = 8, 34, 20
_THUMB_PX = 256
_PLAN_PX = 1400
# A cut through the room at this share of its height leaves out higher objects, such as a ceiling (assumed).
_CUT = 0.8


def contact_sheet(item: SceneObject, *, thumb_px: int = _THUMB_PX) -> bytes:
    """Return all images of a captured object in a labelled grid, as a PNG file.

    Rows: alone from above, alone from below, in its surroundings from above, from below.
    Raises: ConfigError: the object has no images.
    """
    if item.images is None:
        raise ConfigError(f"object {item.id!r} has no images; pass a scene through capture_images first.")
    columns = max(1, len(item.images.isolated) // 2)
    sheet = Image.new("RGB", (columns * (thumb_px + _MARGIN) + _MARGIN, 4 * (thumb_px + _LABEL) + _TITLE), _PAPER)
    draw = ImageDraw.Draw(sheet)
    size = " x ".join(f"{edge:.3g}" for edge in np.ptp(item.bounds_m, axis=0))
    _write(draw, (_MARGIN, 8), f"{item.id}   ({item.name}; {size} m)", 17)
    rows = (("isolated", item.images.isolated), ("context", item.images.context))
    cells = [(kind, images, k) for kind, images in rows for k in range(len(images))]
    for cell, (kind, images, k) in enumerate(cells):
        left = _MARGIN + cell % columns * (thumb_px + _MARGIN)
        top = _TITLE + cell // columns * (thumb_px + _LABEL)
        picture = Image.open(BytesIO(images[k])).resize((thumb_px, thumb_px), Image.Resampling.BOX)
        sheet.paste(picture, (left, top + _LABEL))
        _write(draw, (left, top + 2), f"{kind}, {images.shots[k].label}", 13)
    return png(np.asarray(sheet))


def plan_view(scene: SceneSnapshot, *, width_px: int = _PLAN_PX) -> bytes:
    """Return the scene straight from above with every object's id, as a PNG file. Needs no renderer.

    Faces that reach above four fifths of the scene's height are left out. The front is at the bottom (`axes_of`).
    """
    render_scene = RenderScene.of(scene)
    right, up, front = axes_of(render_scene.up_axis)
    low, high = render_scene.box_m
    to_plan = np.stack((right, front))
    corners = np.stack((low, high)) @ to_plan.T
    origin, extent = corners.min(axis=0), np.maximum(np.ptp(corners, axis=0), 1e-9)
    scale = (width_px - 2 * _MARGIN) / extent.max()
    edges = np.ceil(extent * scale).astype(int) + 2 * _MARGIN
    cut = (low @ up) + _CUT * float((high - low) @ up)
    triangles = np.concatenate([item.triangles_m for item in render_scene.objects]).astype(np.float64)
    heights = (triangles @ up).max(axis=1)
    shown = np.flatnonzero(heights <= cut) if (heights <= cut).any() else np.arange(len(heights))
    flat = (triangles[shown] @ to_plan.T - origin) * scale + _MARGIN
    highest = HighestSurface(int(edges[0]), int(edges[1]))
    highest.add(np.concatenate((flat, (triangles[shown] @ up)[..., None]), axis=2), shown)
    pixels = np.full((int(edges[1]) + _TITLE, int(edges[0]), 3), BACKGROUND_RGB, np.uint8)
    seen = highest.top != NOTHING
    pixels[_TITLE:][seen] = _colors(render_scene, triangles, up)[highest.top[seen]]
    pixels[_TITLE:][_outlines(render_scene, highest)] //= 2
    plan = Image.fromarray(pixels)
    draw = ImageDraw.Draw(plan)
    _write(draw, (_MARGIN, 8), f"{scene.name}, seen from above", 17)
    _draw_scale(draw, scale, plan.width)
    _write_names(draw, render_scene, to_plan, origin, scale, plan.size)
    return png(np.asarray(plan))


def _draw_scale(draw: ImageDraw.ImageDraw, px_per_m: float, width_px: int) -> None:
    """Draw a bar of a round length [m] beside the title, the longest of at most a fifth of the width."""
    longest_m = width_px / 5 / px_per_m
    power = 10.0 ** np.floor(np.log10(longest_m))
    length_m = power * max(digit for digit in (1, 2, 5) if digit * power <= longest_m * (1 + 1e-9))
    right, middle = width_px - _MARGIN, _TITLE // 2
    left = right - round(length_m * px_per_m)
    draw.rectangle((left, middle + 4, right - 1, middle + 7), fill=_INK)
    _write(draw, (left, middle - 13), f"{length_m:g} m", 13)


def _outlines(render_scene: RenderScene, highest: HighestSurface) -> Bools:
    """Return the pixels whose right or lower neighbour shows another object. White things on white would be unseen."""
    counts = [len(item.triangles_m) for item in render_scene.objects]
    owner = np.append(np.repeat(np.arange(len(counts)), counts), NOTHING)[highest.top]
    is_edge = np.zeros(owner.shape, bool)
    is_edge[:, :-1] |= owner[:, :-1] != owner[:, 1:]
    is_edge[:-1] |= owner[:-1] != owner[1:]
    return is_edge


def _write(draw: ImageDraw.ImageDraw, corner: tuple[float, float], text: str, size_px: int) -> None:
    shown, font = lettering(text, size_px)
    draw.text(corner, shown, fill=_INK, font=font)


def _colors(render_scene: RenderScene, triangles: Floats, up: Floats) -> Bytes:
    """Return one colour (n, 3) per triangle of a scene: its paint in the middle, darker the steeper the triangle is."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.maximum(np.linalg.norm(normals, axis=1), 1e-30)
    light = 0.6 + 0.4 * np.abs(normals @ up) / lengths
    palette = render_scene.palette
    paint = [
        palette.rgb[one.material] * palette.pattern(one.material, one.uv.mean(axis=1)) for one in render_scene.objects
    ]
    colors: Bytes = (np.concatenate(paint) * (255 * light[:, None])).astype(np.uint8)
    return colors


def _write_names(
    draw: ImageDraw.ImageDraw,
    render_scene: RenderScene,
    to_plan: Floats,
    origin: Floats,
    scale: float,
    size_px: tuple[int, int],
) -> None:
    """Write each object's id over it, shifted down until no ids overlap. Walls and floors get no id."""
    written: list[tuple[float, float, float, float]] = []
    names = []
    for number, item in enumerate(render_scene.objects):
        if number in shells(render_scene):
            continue
        x, y = (item.box_m.mean(axis=0) @ to_plan.T - origin) * scale + (_MARGIN, _MARGIN + _TITLE)
        shown, font = lettering(item.id, 12)
        width = draw.textlength(shown, font=font)
        left, top = min(max(x - width / 2, 2), max(size_px[0] - width - 2, 2)), y - 7
        while any(left < x1 and x0 < left + width and top < y1 and y0 < top + 14 for x0, y0, x1, y1 in written):
            top += 14
        written.append((left, top, left + width, top + 14))
        names.append((shown, font))
        if top > y:
            draw.line([(x, y), (left + width / 2, top + 7)], fill=_INK)
    # After all lines, so that no line crosses a name.
    for (left, top, right, bottom), (shown, font) in zip(written, names, strict=True):
        draw.rectangle([left - 1, top, right + 1, bottom], fill=_PAPER)
        draw.text((left, top), shown, fill=_INK, font=font)
