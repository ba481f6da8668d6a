"""The inference report of a bake, in a file beside the bundle: calls, tokens, cost, and skipped questions.

    kitchen.bundle/                the bundle
        kitchen.bundle.account.json    its inference report

The file is not part of the bundle. Equal inputs make bundles that are equal byte for byte, but the cost of a bake
depends on the content of the cache. The report is from the last `scene2hap bake` to this folder; `rebake` does not
change it.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from scene2hap.common.files import read_small_text, write_whole
from scene2hap.common.json_fields import is_version
from scene2hap.common.json_texts import read_json
from scene2hap.errors import BundleError, reason_of, unwritable

FORMAT, VERSION = "scene2hap/account", 1


def account_path(folder: str | os.PathLike[str]) -> Path:
    """Return the path of the inference report for the bundle in a folder."""
    place = Path(folder).absolute()
    return place.with_name(f"{place.name}.account.json")


def write_account(folder: str | os.PathLike[str], account: Mapping[str, Any]) -> Path:
    """Write the inference report for the bundle in a folder, with the present time. Returns its path.

    Parameters: account : as of `InferenceReport.as_json`, with `cost_usd`. Raises: BundleError: it cannot be written.
    """
    path = account_path(folder)
    ended = datetime.now(UTC).isoformat(timespec="seconds")
    document = {"format": FORMAT, "version": VERSION, "ended": ended, **account}
    try:
        write_whole(path, json.dumps(document, indent=1))
    except OSError as cause:
        raise BundleError(unwritable(path, cause)) from cause
    return path


def read_account(folder: str | os.PathLike[str]) -> dict[str, Any] | None:
    """Read the inference report for a bundle's folder; None if there is none. Raises: BundleError: it is unreadable."""
    path = account_path(folder)
    if not os.path.lexists(path):
        return None
    try:
        document = read_json(read_small_text(path))
    except (OSError, ValueError) as cause:
        raise BundleError(f"{path} cannot be read: {reason_of(cause)}. Remove it, or bake again.") from cause
    if (
        not isinstance(document, dict)
        or document.get("format") != FORMAT
        or not is_version(document.get("version"), VERSION)
    ):
        raise BundleError(f'{path} is no account: it must have "format": "{FORMAT}" and version {VERSION}. Remove it.')
    return document
