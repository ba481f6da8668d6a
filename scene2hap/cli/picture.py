"""Picture of both hands' envelopes over time as a PNG, drawn with Pillow, which glTF loading needs too."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from scene2hap.session.track_player import PlayedFrame

WIDTH, ROW, MARGIN, TOP = 1500, 260, 70, 50
_INK, _GRID, _BAND = "#22313f", "#d5dbe1", "#eef2f5"
_COLOURS = ("#1f77b4", "#d1495b", "#2a9d8f", "#8d5a97")


def draw_envelopes(frames: Sequence[PlayedFrame], hands: Sequence[str], sample_rate_hz: int, path: Path) -> None:
    """Draw a row per hand: peak level over time, and above it the name of the touched object."""
    samples = np.concatenate([frame.samples for frame in frames])
    duration_s = len(samples) / sample_rate_hz
    image = Image.new("RGB", (WIDTH, TOP + ROW * len(hands) + 40), "white")
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(15)
    draw.text(
        (MARGIN, 14),
        "What each hand felt: peak of the vibration over time, re full scale",
        fill=_INK,
        font=ImageFont.load_default(19),
    )
    for row, hand in enumerate(hands):
        base = TOP + ROW * (row + 1) - 14
        height = ROW - 64
        _draw_stays(draw, frames, hand, duration_s, base, height, font)
        for level in (0.0, 0.25, 0.5):
            y = base - height * level / 0.5
            draw.line([(MARGIN, y), (WIDTH - 20, y)], fill=_GRID)
            draw.text((MARGIN - 44, y - 9), f"{level:.2f}", fill=_INK, font=font)
        draw.text((10, base - height - 34), hand, fill=_COLOURS[row % len(_COLOURS)], font=ImageFont.load_default(17))
        envelope = _peaks(samples[:, row], WIDTH - 20 - MARGIN)
        tops = base - height * np.minimum(envelope, 0.55) / 0.5
        outline = [(MARGIN + x, float(y)) for x, y in enumerate(tops)]
        draw.polygon([(MARGIN, base), *outline, (MARGIN + len(tops) - 1, base)], fill=_COLOURS[row % len(_COLOURS)])
    for second in range(int(duration_s) + 1):
        x = _x(second, duration_s)
        draw.text((x - 4, image.height - 32), f"{second}", fill=_INK, font=font)
    draw.text((WIDTH - 120, image.height - 18), "time in seconds", fill=_INK, font=ImageFont.load_default(13))
    path.parent.mkdir(parents=True, exist_ok=True)
    image.save(path)


def _draw_stays(
    draw: ImageDraw.ImageDraw,
    frames: Sequence[PlayedFrame],
    hand: str,
    duration_s: float,
    base: float,
    height: float,
    font: ImageFont.FreeTypeFont | ImageFont.ImageFont,
) -> None:
    """Draw a shaded interval with the object's name for each stay of the hand."""
    stays: list[tuple[str, float, float]] = []
    for played in frames:
        on = next((touch.object_id for touch in played.touches if touch.hand == hand), None)
        if on is None:
            continue
        if stays and stays[-1][0] == on and played.time_s - stays[-1][2] < 0.05:
            stays[-1] = (on, stays[-1][1], played.time_s)
        else:
            stays.append((on, played.time_s, played.time_s))
    label_end = [0.0, 0.0]
    for on, begin, end in stays:
        left, right = _x(begin, duration_s), _x(end, duration_s)
        draw.rectangle([left, base - height - 4, right, base], fill=_BAND)
        draw.line([(left, base - height - 4), (left, base)], fill=_GRID, width=2)
        # Two lines for names, so that the names of short stays do not overlap.
        line = 0 if label_end[0] < left else 1
        draw.text((left + 2, base - height - 24 - 17 * line), on, fill=_INK, font=font)
        label_end[line] = left + 8 + draw.textlength(on, font=font)


def _x(time_s: float, duration_s: float) -> float:
    return MARGIN + (WIDTH - 20 - MARGIN) * time_s / duration_s


def _peaks(channel: NDArray[np.float32], n_columns: int) -> NDArray[np.float32]:
    """Return the largest absolute sample in each column of the picture."""
    edges = np.linspace(0, len(channel), n_columns + 1).astype(int)[:-1]
    peaks: NDArray[np.float32] = np.maximum.reduceat(np.abs(channel), edges)
    return peaks
