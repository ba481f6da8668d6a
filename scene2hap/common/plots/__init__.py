"""Shared parts of all figures: a new figure, names as plain text, legends, colours. Needs the extra `plots`.

Names of objects are data: they are drawn literally, never parsed as formulas or commands. Figures are made without
pyplot, so drawing opens no windows and does not change a notebook's own figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from scene2hap.common.printable import printable
from scene2hap.errors import MissingExtra

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SOUND, TOUCH, THRESHOLD = "#0072B2", "#D55E00", "#009E73"
"""Colours that are distinct in all common kinds of colour blindness (Okabe and Ito 2008)."""
MOST_LETTERS = 40
"""Most letters of a name in a figure; a longer one would push the axes off the page."""


def new_figure(width_in: float, height_in: float) -> Figure:
    """Return an empty figure of a size [inch], which a notebook shows as a picture.

    Raises: MissingExtra: matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure  # noqa: F401  # imported here, so that the error names it
    except ImportError as cause:
        raise MissingExtra("figures need matplotlib. Run: pip install 'scene2hap[plots]'") from cause
    from scene2hap.common.plots.shown_figure import ShownFigure

    return ShownFigure(figsize=(width_in, height_in), dpi=110, layout="constrained")


def plain(name: str, most: int = MOST_LETTERS) -> str:
    """Return a name for a figure, shortened to `most` letters.

    Characters that change the direction of text or have no glyph become an escape ("\\u202e"). The glyphs depend on the
    fonts of `matplotlib.rcParams["font.family"]`.
    """
    escaped = printable(name)
    shown = "".join(one if _has_glyph(ord(one)) else one.encode("unicode_escape").decode("ascii") for one in escaped)
    return shown if len(shown) <= most else f"{shown[: most - 1]}…"


def set_plain(text: Any, words: str) -> None:
    """Set the text of a matplotlib Text literally: "$" and backslash have no special meaning."""
    text.set_usetex(False)
    text.set_parse_math(False)
    text.set_text(words)


def set_title(axes: Axes, words: str) -> None:
    """Set the title of axes to plain text."""
    set_plain(axes.set_title(""), words)


def set_note(axes: Axes, words: str) -> None:
    """Write plain text into the middle of axes."""
    set_plain(axes.text(0.5, 0.5, "", transform=axes.transAxes, ha="center", va="center", fontsize=9), words)


def add_legend(axes: Axes, handles: Sequence[object], labels: Sequence[str], **options: Any) -> None:
    """Add a legend of artists with plain labels."""
    # matplotlib ignores labels that begin with "_", so the labels are set afterwards.
    legend = axes.legend(handles=list(handles), labels=["-"] * len(handles), fontsize=8, **options)
    for text, label in zip(legend.get_texts(), labels, strict=True):
        set_plain(text, label)


def _has_glyph(code: int) -> bool:
    from matplotlib import rcParams

    fonts = _fonts(tuple(rcParams["font.family"]), tuple(rcParams["font.sans-serif"]))
    return any(font.get_char_index(code) for font in fonts)


@lru_cache(maxsize=8)
def _fonts(families: tuple[str, ...], generic: tuple[str, ...]) -> tuple[Any, ...]:
    """Return the fonts in use. `generic` is part of the key, since "sans-serif" stands for its first installed font."""
    from matplotlib.font_manager import FontProperties, findfont, get_font

    found = []
    for family in families:
        try:
            path = findfont(FontProperties(family=[family]), fallback_to_default=len(families) == 1)
        except ValueError:  # not installed: matplotlib uses the next one
            continue
        found.append(get_font(path))
    return tuple(found)
