"""Snapshots of running Python engines. Each engine is an optional extra that is imported at its first use.

`scene2hap.scene.engines.mujoco` reads MuJoCo models and MJCF files, `scene2hap.scene.engines.panda3d` reads Panda3D
scene graphs. Engines that are not written in Python send JSON (docs/scene-json.md).
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from scene2hap.errors import ConfigError, MissingExtra


def engine(module: str) -> Any:
    """Return an engine's module, such as "panda3d.core". The package's name is also the name of our extra.

    Raises: MissingExtra: it is not installed. ConfigError: it is installed, but cannot be imported.
    """
    extra = module.partition(".")[0]
    try:
        return import_module(module)
    except ModuleNotFoundError as cause:
        raise MissingExtra(f"{extra} is not installed. Run: pip install 'scene2hap[{extra}]'") from cause
    # Engines load drivers when they are imported, and a driver may raise any error.
    except Exception as cause:
        raise ConfigError(
            f"{extra} is installed but does not import: {cause}. Try: python -c 'import {extra}'"
        ) from cause
