"""A page that shows, plays and corrects a scene's haptics, or the same content as data for other viewers.

The page contains all its data and requests nothing from any network.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.files import require_place, write_whole
from scene2hap.common.printable import quoted
from scene2hap.errors import ConfigError, unwritable
from scene2hap.report.document import report_document
from scene2hap.report.felt_map import MODELS
from scene2hap.report.page import assemble
from scene2hap.report.surface_points import MOST_POINTS
from scene2hap.scene.snapshot import SceneSnapshot

__all__ = ["report_document", "write_report"]

_SUFFIXES = (".html", ".htm", ".json")


@clear_call
def write_report(
    bundle: HapticBundle | str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    models: Sequence[Any] = MODELS,
    pictures: SceneSnapshot | None = None,
    most_points: int = MOST_POINTS,
    account: Mapping[str, Any] | None = None,
) -> Path:
    """Write a bundle as a page (`.html`) or its document (`.json`), whole or not at all. Returns its path.

    Missing folders are made. Parameters and errors: `report_document`. Raises: ConfigError: as `require_target`.
    """
    target = require_target(path)
    found = report_document(bundle, models=models, pictures=pictures, most_points=most_points, account=account)
    is_page = target.suffix.lower() != ".json"
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, assemble(found) if is_page else json.dumps(found, allow_nan=False))
    except OSError as cause:
        raise ConfigError(unwritable(target, cause)) from cause
    return target


def require_target(path: str | os.PathLike[str]) -> Path:
    """Return the path of a report, checked before the report is computed, which takes seconds.

    Raises: ConfigError: another suffix than .html, .htm and .json, or the file cannot be written.
    """
    target = checks.path("path", path, error=ConfigError)
    if target.suffix.lower() not in _SUFFIXES:
        raise ConfigError(f"{quoted(target)} must end in .html, for a page, or in .json, for its data.")
    try:
        require_place(target)
    except OSError as cause:
        raise ConfigError(unwritable(target, cause)) from cause
    return target
