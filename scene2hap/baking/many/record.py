"""Records of finished scenes: digests of the scene file and of the settings, in the work folder."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

from scene2hap import __version__
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import converter_settings, described
from scene2hap.bundle.manifest import MANIFEST, our_files
from scene2hap.common.files import read_small_text, write_whole
from scene2hap.errors import ConfigError, SceneError, unwritable
from scene2hap.llm.chain.config import InferenceConfig
from scene2hap.llm.wrappers import identity
from scene2hap.scene.files import is_habitat, read_bytes
from scene2hap.scene.formats.habitat.reader import referenced_files

WORK, REPORT = ".bake-many", "report.json"
"""The folder beside the bundles for records and drafts, and the file with the report of the last run."""
_SELF_CONTAINED = frozenset({".glb", ".stl", ".ply", ".json"})
_MOST_BESIDE = 10_000
"""Most files beside a scene that are checked; assumed: more than any scene's textures and buffers."""
_LITTLE_BYTES = 1 << 20

Record = Mapping[str, Any]


def scene_digest(path: Path, options: Mapping[str, Any] | None = None) -> str:
    """Return a digest of a scene file and of the files that it may refer to.

    A Habitat scene lists its files, which depend on the options of `load_scene`. For other formats with external files,
    all files in the folder count, except bundles. A file of more than a megabyte, besides the scene itself, is
    represented by its size and modification time.
    Raises: SceneError: the scene file is missing, a folder, or cannot be read.
    """
    found = hashlib.sha256(read_bytes(path))
    if is_habitat(path):
        others = _of_habitat(path, options or {})
    elif path.suffix.lower() not in _SELF_CONTAINED:
        beside = (one for one in path.parent.rglob("*") if one != path and one.is_file())
        others = sorted(one for one in beside if not _is_result(one.relative_to(path.parent)))[:_MOST_BESIDE]
    else:
        others = []
    for other in others:
        state = other.stat()
        found.update(f"{os.path.relpath(other, path.parent)} {state.st_size}".encode("utf-8", "surrogateescape"))
        if state.st_size <= _LITTLE_BYTES:
            found.update(other.read_bytes())
        else:
            found.update(str(state.st_mtime_ns).encode())
    return found.hexdigest()[:32]


def _is_result(path: Path) -> bool:
    """Return True for files of a bundle, its steps, or `bake_many`, which may be written into a scene's folder."""
    return path.name == REPORT or any(part == WORK or ".bundle." in f"{part}." for part in path.parts)


def _of_habitat(path: Path, options: Mapping[str, Any]) -> list[Path]:
    """Return the files of a Habitat scene and its table of names; none if unreadable, which the bake reports later."""
    root, names = options.get("assets_root"), options.get("names")
    try:
        files = referenced_files(path, None if root is None else Path(root))
    except SceneError:
        return []
    return files if names is None or isinstance(names, Mapping) else [*files, Path(names)]


def settings_digest(config: BakeConfig, user_prompt: str, options: Mapping[str, Any]) -> str:
    """Return a digest of all settings that affect the content of a bundle."""
    backend = dict(identity(config.llm)) or type(config.llm).__qualname__
    document = {
        "version": __version__,
        "llm": backend,
        "inference": {name: getattr(config, name) for name in InferenceConfig.model_fields if name != "concurrency"},
        "audio": [described(source) for source in config.audio],
        "enough": config.enough_candidates,
        "tactile": [converter_settings(config.tactile), described(config.tactile)],
        "actuator": asdict(config.actuator),
        "spread": config.spread.model_dump(),
        "seed": config.seed,
        "prompt": user_prompt,
        "options": dict(options),
    }
    return hashlib.sha256(json.dumps(document, sort_keys=True, default=str).encode()).hexdigest()[:32]


def bundle_digest(folder: Path) -> str:
    """Return a digest of the files of a bundle, "" if there is none. Raises: BundleError, OSError: unreadable."""
    if not (folder / MANIFEST).is_file():
        return ""
    found = hashlib.sha256()
    for name in sorted(our_files(folder)):
        content = (folder / name).read_bytes() if (folder / name).is_file() else b""
        found.update(f"{name} {len(content)} ".encode() + content)
    return found.hexdigest()[:32]


def read_record(path: Path) -> Record:
    """Read a record; empty if it is missing or damaged, so that its scene is baked again."""
    with suppress(OSError, ValueError, RecursionError):
        found = json.loads(read_small_text(path))
        if isinstance(found, dict) and isinstance(found.get("stage"), str):
            return found
    return {}


def write_record(path: Path, record: Record) -> None:
    """Write a record whole. Raises: ConfigError: it cannot be written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, json.dumps(record, indent=1))
    except OSError as cause:
        raise ConfigError(unwritable(path, cause)) from cause
