"""The parts of a bake that run in workers: each gets paths and settings, and returns counters.

Without a network model, a worker bakes a scene from its file to its bundle. Otherwise inference runs in the main
process: before it, a worker renders the pictures into a folder; after it, a worker gets a draft on disk, which is a
bundle without loops. So an executor transfers no large data, and a later run can continue from the draft.
"""

from __future__ import annotations

import asyncio
import shutil
import time
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from scene2hap.baking.bundle_before import bundle_before, readable_bundle
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.corrections import overrides_of_scene
from scene2hap.baking.loops import N_THREADS
from scene2hap.baking.many.record import WORK, bundle_digest
from scene2hap.baking.scene import bake, bake_inferred
from scene2hap.bundle import BundleWarning, HapticBundle
from scene2hap.bundle.history import step_beside
from scene2hap.bundle.overrides_file import read_overrides
from scene2hap.bundle.writing import write_edited
from scene2hap.common.warning import warn_of
from scene2hap.haptics import is_unknown
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.scene.capture import capture_images, render_all
from scene2hap.scene.load import load_scene


@dataclass(frozen=True)
class Counters:
    """Counters of a task: time [s], objects, sources, unknown objects, questions, warnings; digest of the bundle."""

    seconds: float
    n_objects: int
    n_sources: int
    n_unknown: int
    calls: int
    warnings: tuple[str, ...]
    digest: str


def bake_scene(
    n_threads: int,
    scene: str,
    options: Mapping[str, Any],
    target: str,
    config: BakeConfig,
    user_prompt: str,
    digest: str,
) -> Counters:
    """Bake a scene file. `digest` is that of the bundle that the last bake wrote. Raises: as `bake`."""
    with _watched(n_threads) as watch:
        snapshot = load_scene(scene, **options)
        accounts: list[InferenceReport] = []
        overrides = read_overrides(Path(target))
        bundle = bake(
            snapshot,
            config,
            user_prompt=user_prompt,
            overrides=overrides,
            earlier=bundle_before(Path(target), overrides),
            on_report=accounts.append,
        )
        _save(bundle, Path(target), digest)
    return _counted(bundle, Path(target), watch, calls=sum(accounts[0].calls.values()))


def take_pictures(n_threads: int, scene: str, options: Mapping[str, Any], folder: str, alone: bool) -> None:
    """Render all pictures of a scene file into a folder. Raises: as `load_scene` and `capture_images`."""
    with _watched(n_threads):
        render_all(capture_images(load_scene(scene, **options), config={"cache_dir": folder}, alone=alone))


def make_sounds(n_threads: int, draft: str, target: str, config: BakeConfig, digest: str) -> Counters:
    """Make the loops of a draft, and write the bundle; `digest` as above. Raises: AudioError, BundleError."""
    with _watched(n_threads) as watch:
        inferred = HapticBundle.load(draft)
        overrides = overrides_of_scene(read_overrides(Path(target)), inferred.snapshot)
        baking = bake_inferred(
            inferred.snapshot,
            inferred.scene_category,
            inferred.objects,
            overrides,
            config,
            earlier=bundle_before(Path(target), overrides),
        )
        bundle = asyncio.run(baking)
        _save(bundle, Path(target), digest)
    return _counted(bundle, Path(target), watch)


def _save(bundle: HapticBundle, target: Path, digest: str) -> None:
    """Write a bundle. One that was changed since the last bake is kept. Warns: BundleWarning: where it is.

    A run that was killed before it wrote the record has left a bundle of another digest, which is equal to the new one.
    """
    found = bundle_digest(target)
    if found in ("", digest):
        bundle.save(target)
        return
    new = target.parent / WORK / f"{target.name}.new"
    bundle.save(new)
    is_equal = bundle_digest(new) == found
    shutil.rmtree(new, ignore_errors=True)
    if is_equal:
        return
    before, _ = readable_bundle(target)
    write_edited(bundle, target, before)
    warn_of(
        f"{target} was changed since it was baked; as it was, it is in {step_beside(target, 'before').name} beside it "
        f"(`scene2hap edit {target} undo`).",
        BundleWarning,
    )


def _counted(bundle: HapticBundle, target: Path, watch: _Watch, calls: int = 0) -> Counters:
    n_unknown = sum(is_unknown(haptics.object_category) for haptics in bundle.objects.values())
    return Counters(
        watch.seconds,
        len(bundle.objects),
        len(bundle.loops),
        n_unknown,
        calls,
        tuple(watch.warnings),
        bundle_digest(target),
    )


@dataclass
class _Watch:
    seconds: float = 0.0
    warnings: list[str] = field(default_factory=list)


@contextmanager
def _watched(n_threads: int) -> Iterator[_Watch]:
    """Measure the duration of a block with a number of threads, and collect its warnings."""
    before = N_THREADS.set(n_threads)
    watch, begun = _Watch(), time.perf_counter()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            yield watch
        finally:
            watch.seconds = time.perf_counter() - begun
            N_THREADS.reset(before)
            watch.warnings = list(dict.fromkeys(str(one.message) for one in caught))
