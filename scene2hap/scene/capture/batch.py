"""Render all pictures of a captured scene at once, on several cores."""

from __future__ import annotations

import pickle
import tempfile
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from itertools import chain, groupby
from pathlib import Path

from scene2hap.common.worker_processes import WAIT_S, most_workers, worker_processes
from scene2hap.errors import ConfigError
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.lazy_pictures import CaptureStats, LazyPictures
from scene2hap.scene.capture.protocol import RendererFactory, made_renderer
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.shot_rendering import ShotRenderer
from scene2hap.scene.images import ImageSet, Shot
from scene2hap.scene.snapshot import SceneSnapshot

Progress = Callable[[int, int], None]
"""Callback with the number of finished pictures, and of all pictures."""

# Groups of pictures queued for each worker process, so that no worker is idle while this process renders a picture.
_AHEAD = 2


def render_all(scene: SceneSnapshot, workers: int | None = None, *, progress: Progress | None = None) -> CaptureStats:
    """Render all pictures of a captured scene that are not cached. Reading them is then immediate.

    Parameters: workers : number of processes, this one included; None means the value of the configuration. The other
        processes import the main module, so a script must guard its entry with ``if __name__ == "__main__"``.
    Returns: counters of the capture so far.
    Raises: ConfigError: the scene was not captured, or the workers died.
    """
    pictures = _lazy_pictures(scene)
    workers = pictures.config.workers if workers is None else workers
    sets: list[ImageSet] = [scene.images] if scene.images is not None else []
    for item in scene.objects:
        if item.images is not None:
            sets += (item.images.isolated, item.images.context)
    wanted = pictures.missing(shot for images in sets if images.source is pictures for shot in images.shots)
    by_themselves = [images for images in sets if images.source is not pictures]
    is_alone = workers <= 1 or len(wanted) <= 1
    taken = _alone(pictures, wanted) if is_alone else _shared(pictures, wanted, most_workers(workers - 1))
    total = len(wanted) + sum(map(len, by_themselves))
    # An object shown alone has a small scene of its own, so another process would not save time.
    for n_done, _ in enumerate(chain(taken, chain.from_iterable(by_themselves)), start=1):
        if progress is not None:
            progress(n_done, total)
    return pictures.stats


def _lazy_pictures(scene: SceneSnapshot) -> LazyPictures:
    source = None if scene.images is None else scene.images.source
    if not isinstance(source, LazyPictures):
        raise ConfigError(f"scene {scene.name!r} has no images to take; call capture_images first.")
    return source


def _alone(pictures: LazyPictures, wanted: list[Shot]) -> Iterator[Shot]:
    for shot in wanted:
        pictures.image(shot)
        yield shot


def _shared(pictures: LazyPictures, wanted: list[Shot], others: int) -> Iterator[Shot]:
    """Render pictures in this process, which needs no start-up time, and in others."""
    # All pictures of an object go to one process, so that its search tree is built once.
    portions = deque(list(group) for _, group in groupby(wanted, key=lambda shot: (shot.kind, shot.subject)))
    given: set[Future[list[tuple[Shot, bytes]]]] = set()
    try:
        # The data goes through a file. With a pipe, this process would wait until the others have started and read it.
        with (
            _written((pictures.render_scene, pictures.config, pictures.factory, pictures.below)) as setting,
            worker_processes(others, _set_up, setting) as pool,
        ):
            while portions or given:
                while portions and len(given) < _AHEAD * others:
                    given.add(pool.submit(_take, portions.popleft()))
                if portions:
                    yield from _alone(pictures, portions.pop())
                done, given = wait(given, timeout=0 if portions else WAIT_S, return_when=FIRST_COMPLETED)
                for shot, picture in chain.from_iterable(future.result() for future in done):
                    pictures.keep(shot, picture)
                    yield shot
    except BrokenProcessPool as cause:
        raise ConfigError(
            f"the {others} other processes of render_all died. Guard the script's entry with "
            '`if __name__ == "__main__":`, or pass workers=0.'
        ) from cause


_shot_renderer: ShotRenderer | None = None


@contextmanager
def _written(setting: tuple[RenderScene, CaptureConfig, RendererFactory, tuple[int | None, ...]]) -> Iterator[Path]:
    """Yield a temporary file with the data for the other processes."""
    with tempfile.TemporaryDirectory(prefix="scene2hap-") as folder:
        path = Path(folder) / "render_scene.pickle"
        path.write_bytes(pickle.dumps(setting, pickle.HIGHEST_PROTOCOL))
        yield path


def _set_up(setting: Path) -> None:
    global _shot_renderer
    render_scene, config, factory, below = pickle.loads(setting.read_bytes())
    _shot_renderer = ShotRenderer(render_scene, made_renderer(factory, render_scene, config.antialias), config, below)


def _take(shots: list[Shot]) -> list[tuple[Shot, bytes]]:
    assert _shot_renderer is not None, "the pool sets every worker up before it works"
    return [(shot, _shot_renderer.render(shot)) for shot in shots]
