"""Picture of a conversion: spectrograms before and after on one scale, both envelopes, and the threshold of touch."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import soundfile
from PIL import Image, ImageDraw, ImageFont

from scene2hap.audio.conversion.meter import Meter
from scene2hap.audio.files import opened_sound
from scene2hap.audio.levels import drive_db
from scene2hap.audio.sensation import Sensation
from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats, Floats32
from scene2hap.haptics import ActuatorProfile

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont

WIDTH, SPECTROGRAM, ENVELOPE, MARGIN, TOP = 900, 240, 110, 80, 44
LOWEST_HZ, HIGHEST_HZ = 10.0, 20_000.0
DEPTH_DB = 80.0
"""Dynamic range of the picture [dB], below the loudest point of both sounds and below full scale."""
WINDOW_S = 0.1
BLOCK_FRAMES = 65_536
_INK, _GRID, _FELT = "#22313f", "#d5dbe1", "#00a0a0"
_STOPS = np.array([[10, 12, 40], [70, 20, 110], [180, 45, 95], [245, 130, 50], [252, 250, 190]], dtype=np.float64)
"""Colours from quiet to loud, in even steps of lightness."""


def draw_conversion(
    title: str,
    source: Path,
    felt: Path,
    meters: tuple[Meter, Meter],
    actuator: ActuatorProfile,
    path: Path,
    sensation: Sensation | None = None,
) -> None:
    """Draw the sound of a file above its vibration, and save the picture as PNG.

    Both spectrograms share one scale. A line marks the most felt frequency of the vibration, and a line in its envelope
    the threshold of touch at that frequency on the actuator. `sensation` is written above the vibration.

    `felt` is the converted file; `meters` have measured both and hold their envelopes (n_columns,). Each of the `WIDTH`
    columns of a spectrogram is one window of the file, so that memory does not grow with its length.
    """
    height = TOP + 2 * (SPECTROGRAM + ENVELOPE + 46) + 30
    image = Image.new("RGB", (MARGIN + WIDTH + 20, height), "white")
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(14)
    draw.text((MARGIN, 12), title, fill=_INK, font=ImageFont.load_default(18))
    top = TOP
    spectrograms = [_spectrogram(sound, meter.n_frames) for sound, meter in zip((source, felt), meters, strict=True)]
    loudest = max(float(powers.max()) for powers, _ in spectrograms)
    felt_hz = meters[1].most_felt_hz(actuator)
    for name, (powers, rate), meter in zip(("before", "after"), spectrograms, meters, strict=True):
        says = f", {sensation}" if sensation is not None and name == "after" else ""
        draw.text((MARGIN, top), f"{name}: {DEPTH_DB:g} dB down from the loudest of both{says}", fill=_INK, font=font)
        image.paste(_coloured(powers, loudest), (MARGIN, top + 18))
        _frequency_axis(draw, top + 18, min(HIGHEST_HZ, 0.5 * rate), font)
        _draw_envelope(draw, meter, top + 18 + SPECTROGRAM + 6, font)
        if name == "after" and felt_hz is not None:
            _draw_felt(draw, felt_hz, actuator, top + 18, min(HIGHEST_HZ, 0.5 * rate), font)
        top += SPECTROGRAM + ENVELOPE + 46
    duration_s = meters[0].n_frames / rate
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        label = f"{share * duration_s:.3g} s"
        draw.text(
            (MARGIN + share * WIDTH - draw.textlength(label, font=font) / 2, top - 8), label, fill=_INK, font=font
        )
    image.save(path, format="PNG")


def _spectrogram(path: Path, n_frames: int) -> tuple[Floats, int]:
    """Return the power of the channels' mean (SPECTROGRAM, WIDTH) and the rate; rows fall logarithmically."""
    with opened_sound(path) as file:
        rate = int(file.samplerate)
        size = max(2, round(WINDOW_S * rate))
        window = hann(size)
        f = np.geomspace(min(HIGHEST_HZ, 0.5 * rate), LOWEST_HZ, SPECTROGRAM)
        bins = np.clip(np.round(f * size / rate).astype(int), 0, size // 2)
        powers = np.zeros((SPECTROGRAM, WIDTH))
        for column, samples in enumerate(_windows(file, n_frames, size)):
            powers[:, column] = np.abs(np.fft.rfft(samples * window))[bins] ** 2
    return powers, rate


def _windows(file: soundfile.SoundFile, n_frames: int, size: int) -> Iterator[Floats32]:
    """Yield `WIDTH` windows (size,), evenly spaced, silent beyond both ends; in order: compressed files seek badly."""
    starts = (np.linspace(0, n_frames - 1, WIDTH).astype(int) - size // 2).tolist()
    kept, origin = np.zeros(size, dtype=np.float32), -size
    blocks = (block.mean(axis=1) for block in file.blocks(BLOCK_FRAMES, dtype="float32", always_2d=True))
    for block in chain(blocks, [np.zeros(size, dtype=np.float32)]):
        kept = np.concatenate([kept, block])
        while starts and starts[0] + size <= origin + len(kept):
            at = starts.pop(0) - origin
            yield kept[at : at + size]
        unused = min(len(kept), (starts[0] if starts else origin) - origin)
        kept, origin = kept[unused:], origin + unused


def _coloured(powers: Floats, loudest: float) -> Image.Image:
    level_db = 10 * np.log10(np.maximum(powers / loudest if loudest > 0 else powers, 10 ** (-DEPTH_DB / 10)))
    place = (level_db / DEPTH_DB + 1.0) * (len(_STOPS) - 1)
    rgb = np.stack([np.interp(place, np.arange(len(_STOPS)), channel) for channel in _STOPS.T], axis=-1)
    return Image.fromarray(rgb.astype(np.uint8))


def _frequency_axis(draw: ImageDraw.ImageDraw, top: int, highest_hz: float, font: Font) -> None:
    for hz in (10, 30, 100, 300, 1000, 3000, 10_000):
        if hz <= highest_hz:
            y = top + _row(hz, highest_hz)
            draw.line([(MARGIN - 6, y), (MARGIN - 1, y)], fill=_INK)
            draw.text((8, y - 9), f"{hz} Hz", fill=_INK, font=font)


def _row(hz: float, highest_hz: float) -> float:
    """Return the row of a frequency in a spectrogram, from its top."""
    return float((SPECTROGRAM - 1) * np.log(highest_hz / hz) / np.log(highest_hz / LOWEST_HZ))


def _depth(level_db: float) -> float:
    """Return the height of a level [dB re full scale] in an envelope, from its top."""
    return float(np.clip(-level_db / DEPTH_DB, 0.0, 1.0) * (ENVELOPE - 8) + 4)


def _draw_envelope(draw: ImageDraw.ImageDraw, meter: Meter, top: int, font: Font) -> None:
    for level_db in (0.0, -20.0, -40.0, -60.0):
        y = top + _depth(level_db)
        draw.line([(MARGIN, y), (MARGIN + WIDTH, y)], fill=_GRID)
        draw.text((8, y - 5), f"{level_db:.0f} dB", fill=_INK, font=font)
    levels_db = 20.0 * np.log10(np.maximum(meter.envelope, 10 ** (-DEPTH_DB / 20)))
    for column, level_db in enumerate(levels_db.tolist()):
        x = MARGIN + column * WIDTH / len(levels_db)
        draw.line([(x, top + _depth(level_db)), (x, top + _depth(-DEPTH_DB))], fill="#1f77b4")


def _draw_felt(
    draw: ImageDraw.ImageDraw, felt_hz: float, actuator: ActuatorProfile, top: int, highest_hz: float, font: Font
) -> None:
    y = top + _row(felt_hz, highest_hz)
    draw.line([(MARGIN, y), (MARGIN + 12, y)], fill=_FELT, width=2)
    draw.line([(MARGIN + WIDTH - 12, y), (MARGIN + WIDTH, y)], fill=_FELT, width=2)
    # An outline keeps the words legible on bright bands of the spectrogram, and on the white ground of the envelope.
    outline: dict[str, Any] = {"fill": "white", "font": font, "stroke_width": 2, "stroke_fill": _INK}
    draw.text((MARGIN + 16, y - 9), f"{felt_hz:.0f} Hz", **outline)
    least_db = float(drive_db(felt_hz, 0.0, actuator))
    y = top + SPECTROGRAM + 6 + _depth(least_db)
    draw.line([(MARGIN, y), (MARGIN + WIDTH, y)], fill=_FELT, width=2)
    draw.text((MARGIN + 4, y - 18), f"felt from here on at {felt_hz:.0f} Hz", **outline)
