"""Fonts for names in pictures: Pillow's own, which has little more than ASCII, and installed ones for other letters."""

from __future__ import annotations

from functools import lru_cache

from PIL import ImageFont

from scene2hap.common.printable import printable

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont

# Fonts with many scripts, by the names of their files: Linux, Windows, macOS.
_INSTALLED = (
    *("DejaVuSans.ttf", "NotoSans-Regular.ttf", "NotoSansCJK-Regular.ttc"),
    *("segoeui.ttf", "YuGothM.ttc", "msyh.ttc", "malgun.ttf"),
    *("Arial Unicode.ttf", "Hiragino Sans GB.ttc"),
)
# A code that is no character, so that fonts draw their glyph for missing letters.
_NO_LETTER = "\U0010ffff"


def lettering(text: str, size_px: int) -> tuple[str, Font]:
    """Return a text as it can be drawn, and its font: the first one that has the most of its letters.

    Characters without a glyph, and those that change the direction of text, become an escape ("\\u30b9").
    """
    text = printable(text)
    if text.isascii():
        return text, ImageFont.load_default(size_px)
    lacking, font = min(((_lacking(font, text), font) for font in _fonts(size_px)), key=lambda found: len(found[0]))
    escaped = {one: one.encode("unicode_escape").decode("ascii") for one in lacking}
    return "".join(escaped.get(one, one) for one in text), font


@lru_cache(maxsize=8)
def _fonts(size_px: int) -> tuple[Font, ...]:
    found = [ImageFont.load_default(size_px)]
    for name in _INSTALLED:
        try:
            found.append(ImageFont.truetype(name, size_px))
        except OSError:  # not installed
            continue
    return tuple(found)


def _lacking(font: Font, text: str) -> frozenset[str]:
    """Return the letters of a text for which a font has no glyph."""
    none = bytes(font.getmask(_NO_LETTER))
    return frozenset(one for one in set(text) if not one.isspace() and bytes(font.getmask(one)) == none)
