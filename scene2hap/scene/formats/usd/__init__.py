"""USD scenes (`.usd`, `.usda`, `.usdc`, `.usdz`) as authored trees, through the package usd-core.

The format's only reader is in C++ and crashes on some broken files. So a child process reads the file and returns the
tree. A crash, or a file that fills the memory, then gives one SceneError. See `scene2hap.scene.formats.usd.process`.

Source: OpenUSD 26.11 documentation (Pixar / AOUSD), schemas UsdGeom, UsdShade, UsdPhysics.
"""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from scene2hap.errors import MissingExtra
from scene2hap.scene.files import check_file
from scene2hap.scene.formats.usd.process import read_in_child
from scene2hap.scene.tree import AuthoredScene


def read_usd(path: Path, assets_root: Path) -> AuthoredScene:
    """Return the composed scene of a USD file with its looks and masses; `up_axis` and `unit_m` come from the stage.

    Layers and textures are read only from inside `assets_root`. Matrices, sizes and vertices are in the stage's unit.
    Raises: MissingExtra: usd-core is not installed. SceneFormatError: the file is not USD, or broken. SceneError: it is
    missing, too large, takes too long, or needs a layer that is missing or outside `assets_root`.
    """
    if find_spec("pxr") is None:
        raise MissingExtra(f"{path.name!r} is USD, and its reader is not installed. Run: pip install 'scene2hap[usd]'")
    check_file(path)
    return read_in_child(path, assets_root)
