"""Render each picture once, at its first access, and cache it."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from threading import RLock

from scene2hap.scene.capture.cache import MEMORY, FolderCache
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.protocol import RendererFactory, made_renderer
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.shot_rendering import ShotRenderer
from scene2hap.scene.capture.surroundings import Copies, holders, supports
from scene2hap.scene.images import Shot
from scene2hap.scene.snapshot import SceneSnapshot

# Part of every key. Increase it when the pictures of equal settings change.
_FORMAT = 2


@dataclass(frozen=True)
class CaptureStats:
    """Counters of a capture: pictures rendered, and pictures found in memory or in `cache_dir` instead."""

    rendered: int = 0
    from_memory: int = 0
    from_folder: int = 0


class LazyPictures:
    """The `ImageSource` of one captured scene.

    It makes the `RenderScene` and the renderer for the first picture that is not cached.
    """

    def __init__(self, scene: SceneSnapshot, config: CaptureConfig, factory: RendererFactory, name: str) -> None:
        self.scene = scene
        self.config = config
        self.factory = factory
        self.name = name
        self.stats: CaptureStats = CaptureStats()
        self._folder = FolderCache(config.cache_dir) if config.cache_dir else None
        self._taken: dict[Shot, bytes] = {}
        self._lock = RLock()

    def __reduce__(self) -> tuple[object, ...]:
        # A copy in another process renders the same pictures again, since these pictures would be large to send.
        return (LazyPictures, (self.scene, self.config, self.factory, self.name))

    def image(self, shot: Shot) -> bytes:
        """Return the picture. Copies share one picture."""
        shot = self.shared(shot)
        with self._lock:
            picture = self.find(shot)
            if picture is None:
                picture = self._shot_renderer.render(shot)
                self.keep(shot, picture)
            return picture

    def shared(self, shot: Shot) -> Shot:
        """Return the shot whose picture this one shares."""
        if shot.subject is None:
            return shot
        with self._lock:
            first = self.copies.isolated if shot.kind == "isolated" else self.copies.context
            return replace(shot, subject=first[shot.subject])

    def find(self, shot: Shot) -> bytes | None:
        """Return the picture of a shared shot if it is cached in memory or on disk."""
        with self._lock:
            if shot in self._taken:
                return self._taken[shot]
            key = self._key(shot)
            picture = MEMORY.get(key)
            if picture is not None:
                self.stats = replace(self.stats, from_memory=self.stats.from_memory + 1)
            elif self._folder is not None:
                picture = self._folder.get(key)
                if picture is not None:
                    self.stats = replace(self.stats, from_folder=self.stats.from_folder + 1)
                    MEMORY.put(key, picture)
            if picture is not None:
                self._taken[shot] = picture
            return picture

    def keep(self, shot: Shot, picture: bytes) -> None:
        """Cache a new picture of a shared shot."""
        key = self._key(shot)
        with self._lock:
            self.stats = replace(self.stats, rendered=self.stats.rendered + 1)
            self._taken[shot] = picture
            MEMORY.put(key, picture)
            if self._folder is not None:
                self._folder.put(key, picture)

    def missing(self, shots: Iterable[Shot]) -> list[Shot]:
        """Return the shots that must be rendered so that all given shots can be read, each once, in order."""
        return [shot for shot in dict.fromkeys(map(self.shared, shots)) if self.find(shot) is None]

    @cached_property
    def render_scene(self) -> RenderScene:
        """The scene prepared for renderers."""
        return RenderScene.of(self.scene)

    @cached_property
    def copies(self) -> Copies:
        """The groups of objects that share pictures."""
        held_by = holders(self.render_scene, self.below, self.config.near_share)
        return Copies(self.scene.objects, self.below, held_by, self.config.share_copies)

    @cached_property
    def below(self) -> tuple[int | None, ...]:
        """The number of the object below each object, None for none."""
        return supports(self.render_scene)

    @cached_property
    def _shot_renderer(self) -> ShotRenderer:
        renderer = made_renderer(self.factory, self.render_scene, self.config.antialias)
        return ShotRenderer(self.render_scene, renderer, self.config, self.below)

    def _key(self, shot: Shot) -> str:
        """Return a digest of all inputs of the picture; for an isolated image, without the rest of the scene."""
        number = -1 if shot.subject is None else self.render_scene.index[shot.subject]
        seen = (
            self.render_scene.objects[number].digest
            if shot.kind == "isolated"
            else f"{self.render_scene.digest} {number}"
        )
        angles = (shot.azimuth_deg, shot.elevation_deg, self.render_scene.up_axis)
        content = repr((_FORMAT, self.name, self.config.look, shot.kind, seen, angles))
        return hashlib.sha256(content.encode()).hexdigest()
