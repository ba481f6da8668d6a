"""All pictures of a captured scene at once, on several cores."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from itertools import groupby

from scene2hap.errors import ConfigError
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.photographer import Photographer
from scene2hap.scene.capture.protocol import RendererFactory
from scene2hap.scene.capture.stage import Stage
from scene2hap.scene.capture.studio import CaptureStats, Studio
from scene2hap.scene.images import ImageSet, Shot
from scene2hap.scene.snapshot import SceneSnapshot

Progress = Callable[[int, int], None]
"""Told how many pictures are there, of how many."""


def render_all(scene: SceneSnapshot, workers: int | None = None, *, progress: Progress | None = None) -> CaptureStats:
    """Take every picture of a captured scene that was not taken yet; reading them afterwards costs nothing.

    Parameters: workers : processes; 0 takes the pictures in this one, None means what the configuration says. Worker
        processes import the main module, so that a script guards its entry with ``if __name__ == "__main__"``.
    Returns: what the capture did so far.
    Raises: ConfigError: the scene was not captured, or the workers died.
    """
    studio = _studio(scene)
    workers = studio.config.workers if workers is None else workers
    sets: list[ImageSet] = [scene.images] if scene.images is not None else []
    for item in scene.objects:
        if item.images is not None:
            sets += (item.images.isolated, item.images.context)
    wanted = studio.missing(shot for images in sets for shot in images.shots)
    taken = (
        _by_workers(studio, wanted, workers) if workers and wanted else ((shot, studio.image(shot)) for shot in wanted)
    )
    for n_done, (shot, picture) in enumerate(taken, start=1):
        if workers:
            studio.keep(shot, picture)
        if progress is not None:
            progress(n_done, len(wanted))
    return studio.stats


def capture_stats(scene: SceneSnapshot) -> CaptureStats:
    """What the capture of a scene did so far.

    Raises: ConfigError: the scene was not captured.
    """
    return _studio(scene).stats


def _studio(scene: SceneSnapshot) -> Studio:
    source = None if scene.images is None else scene.images.source
    if not isinstance(source, Studio):
        raise ConfigError(f"scene {scene.name!r} has no images to take; call capture_images first.")
    return source


def _by_workers(studio: Studio, wanted: list[Shot], workers: int) -> Iterator[tuple[Shot, bytes]]:
    # Spawned processes are the same on every system, and inherit no thread that holds a lock.
    context = multiprocessing.get_context("spawn")
    setting = (studio.stage, studio.config, studio.factory, studio.below)
    # An object's pictures go together: its search tree is built in one process.
    portions = [list(group) for _, group in groupby(wanted, key=lambda shot: (shot.kind, shot.subject))]
    try:
        with ProcessPoolExecutor(workers, mp_context=context, initializer=_set_up, initargs=setting) as pool:
            for done in as_completed([pool.submit(_take, portion) for portion in portions]):
                yield from done.result()
    except BrokenProcessPool as cause:
        raise ConfigError(
            f"the {workers} worker processes of render_all died. Guard the script's entry with "
            '`if __name__ == "__main__":`, or pass workers=0.'
        ) from cause


_photographer: Photographer | None = None


def _set_up(stage: Stage, config: CaptureConfig, factory: RendererFactory, below: tuple[int | None, ...]) -> None:
    global _photographer
    _photographer = Photographer(stage, factory(stage, config.antialias), config, below)


def _take(shots: list[Shot]) -> list[tuple[Shot, bytes]]:
    assert _photographer is not None, "the pool sets every worker up before it works"
    return [(shot, _photographer.take(shot)) for shot in shots]
