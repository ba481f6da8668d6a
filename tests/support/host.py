"""Features of the operating system that some tests need, and the reason to skip a test without them."""

import os
from functools import cache


@cache
def terminal_problem() -> str:
    """Why there are no pseudo-terminals here; empty if there are."""
    if os.name == "nt":
        return "pseudo-terminals are POSIX"
    try:
        ends = os.openpty()
    except OSError as problem:
        return f"needs pseudo-terminals ({problem}); mount devpts at /dev/pts"
    for end in ends:
        os.close(end)
    return ""


@cache
def rasteriser_problem() -> str:
    """Why Panda3D cannot draw here; empty if it can."""
    try:
        from panda3d import core
    except ImportError as problem:
        return f"needs the extra `panda3d` ({problem})"
    pipe = core.GraphicsPipeSelection.get_global_ptr().make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
    return "" if pipe else "Panda3D's software rasteriser needs the system package libx11-6"
