"""A page that shows, plays and corrects a scene's haptics, or the same content as data for other viewers.

The page contains all its data and requests nothing from any network.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from scene2hap import checks
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.account import read_account
from scene2hap.bundle.arguments import given_bundle
from scene2hap.calls import clear_call
from scene2hap.errors import ConfigError, unwritable
from scene2hap.report.document import document
from scene2hap.report.felt_map import MODELS
from scene2hap.report.page import assemble
from scene2hap.report.surface_points import MOST_POINTS
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.text_files import write_whole

__all__ = ["report_document", "write_report"]

_SUFFIXES = (".html", ".htm", ".json")


@clear_call
def report_document(
    bundle: HapticBundle | str | os.PathLike[str],
    *,
    models: Sequence[Any] = MODELS,
    pictures: SceneSnapshot | None = None,
    most_points: int = MOST_POINTS,
    account: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return all visible and audible content of a bundle as JSON values; docs/report.md has the fields.

    Parameters:
    bundle : a HapticBundle, or the path of its folder.
    models : kinds or settings of the propagation models of the felt map. Models that resonate take milliseconds for
        each point.
    pictures : the baked scene with `capture_images`, for pictures and colours, which a bundle does not store.
    most_points : most surface points of the felt map.
    account : calls, tokens, cost and skipped questions of the bake, as `InferenceReport.as_json` returns them. The
        default is the file that `scene2hap bake` wrote beside the bundle, if `bundle` is the path of its folder.
    Raises: ConfigError: no such model, or a malformed account; ModelDomainError: a model does not hold in this scene.
    BundleError: the bundle or its account cannot be read.
    """
    most_points = checks.whole("most_points", most_points, "-", at_least=1, at_most=200_000, error=ConfigError)
    if account is None and isinstance(bundle, str | os.PathLike):
        account = read_account(bundle)
    return document(given_bundle(bundle), models=models, pictures=pictures, most_points=most_points, account=account)


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

    Parameters and errors: `report_document`. Raises: ConfigError: another suffix, or the file cannot be written.
    """
    target = checks.path("path", path, error=ConfigError)
    if target.suffix.lower() not in _SUFFIXES:
        raise ConfigError(f"{target.name!r} must end in .html, for a page, or in .json, for its data.")
    found = report_document(bundle, models=models, pictures=pictures, most_points=most_points, account=account)
    is_page = target.suffix.lower() != ".json"
    try:
        write_whole(target, assemble(found) if is_page else json.dumps(found, allow_nan=False))
    except OSError as cause:
        raise ConfigError(unwritable(target, cause)) from cause
    return target
