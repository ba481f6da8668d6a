"""The textures of one scene file: read once, only from allowed places, shared by content. Refusals are recorded.

Touch does not depend on textures, so no refusal is an error.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from scene2hap.errors import SceneError
from scene2hap.scene.files import inside, read_bytes
from scene2hap.scene.looks.textures import EncodedTexture


@dataclass(eq=False)
class TextureFiles:
    """Reader of the images of a scene in `folder`, only from inside `assets_root`. `left_out` has the reasons of
    refusals."""

    folder: Path
    assets_root: Path
    _refused: dict[str, str] = field(default_factory=dict)
    _by_name: dict[str, EncodedTexture] = field(default_factory=dict)
    _paths: dict[str, Path] = field(default_factory=dict)
    _first_names: dict[Path, str] = field(default_factory=dict)
    _by_content: dict[str, EncodedTexture] = field(default_factory=dict)

    @property
    def left_out(self) -> tuple[str, ...]:
        """A sentence for each texture or material file that could not be used, in the order of first use."""
        return tuple(self._refused.values())

    def refuse(self, name: str, reason: str) -> None:
        """Store the reason why a file is not used; the first reason of a name counts."""
        self._refused.setdefault(name, reason)

    def from_file(self, uri: str, place: str, *, keeps_alpha: bool) -> EncodedTexture | None:
        """Return the image at `uri` (percent-encoded, relative to the scene), or None if refused. `place` is for
        messages."""
        if uri in self._refused:
            return None
        if uri not in self._paths:
            try:
                self._paths[uri] = inside(self.assets_root, self.folder, uri, place)
            except SceneError as error:
                self.refuse(uri, str(error))
                return None
        path = self._paths[uri]
        # Several names may lead to one file, so it is read once.
        first = self._first_names.setdefault(path, uri)
        if first in self._refused:
            self.refuse(uri, self._refused[first])
            return None
        return self.named(first, lambda: read_bytes(path), keeps_alpha)

    def named(self, name: str, read: Callable[[], bytes], keeps_alpha: bool) -> EncodedTexture | None:
        """Return the image whose bytes `read` returns, once for each name. None if `read` raises, or it is no image."""
        if name in self._refused:
            return None
        if name not in self._by_name:
            try:
                texture = EncodedTexture.checked(read(), f"texture {name!r}")
                self._by_name[name] = self._by_content.setdefault(texture.digest, texture)
            except SceneError as error:
                self.refuse(name, str(error))
                return None
        texture = self._by_name[name]
        if texture.has_alpha and not keeps_alpha:
            texture = texture.opaque
        return self._by_content.setdefault(texture.digest, texture)
