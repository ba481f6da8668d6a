"""The layers of a USD scene, opened without usd-core's own search for files.

usd-core opens any file that a layer names: absolute paths, addresses (if the host has such a resolver), and files in
search paths of the environment. So each layer is opened separately here, as an anonymous layer. Every name of another
layer in it is replaced by that layer's anonymous identifier. Composition then finds all layers in memory and opens no
file. A layer that must not be read, or is missing, gets an identifier that finds nothing. This is an error only if the
composed stage needs the layer, since unselected variants may name files that were never delivered.

Animation by value clips is removed, since clips name further files.
"""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf

from scene2hap.common.files import is_there
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.files import check_file, inside, usable_name
from scene2hap.scene.formats.usd.archive import Archive
from scene2hap.scene.formats.usd.composition import Composition
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.looks.textures import EncodedTexture

MAX_LAYER_BYTES = 1 << 32
"""Largest size of all layers of one scene [bytes] (assumed)."""

_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
# Files that hold only materials: touch does not depend on them.
_LOOKS = (".mtlx", ".mdl")
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_REFUSED = "scene2hap-refused-{}.usda"
_CLIPS = ("clips", "clipSets")


@dataclass(frozen=True)
class _BaseFolder:
    """The base of relative names in a layer: a folder, or a folder within an archive."""

    folder: Path | str
    archive: Archive | None = None


class Layers:
    """The layers of a scene from inside `assets_root`, and its textures.

    Parameters: path : the root layer or archive; textures : reads textures beside the root layer; allow : called with
        the numbers of bytes and prims of each layer, so that a watched process gets more time for larger files.
    """

    def __init__(
        self,
        path: Path,
        assets_root: Path,
        textures: TextureFiles,
        allow: Callable[[int, int], None],
    ) -> None:
        self.textures = textures
        self._path, self._assets_root, self._allow = path, assets_root, allow
        self.n_bytes: int = 0
        # usd-core frees an anonymous layer with its last reference.
        self._kept: list[Any] = []
        self._folders: dict[str, _BaseFolder] = {}
        self._names: dict[str, str] = {}
        self._known: dict[object, str] = {}
        self._refused: dict[str, SceneError | None] = {}
        self._to_visit: list[Any] = []
        self._composition = Composition()

    def root(self) -> Any:
        """Return the root layer (`Sdf.Layer`), with all layers that it needs in memory.

        Raises: SceneFormatError: a layer is broken. SceneError: a sublayer is missing or outside `assets_root`, or the
        layers have too many prims.
        """
        self._file(self._path)
        while self._to_visit:
            self._rewrite(self._to_visit.pop())
        self._composition.check(self._kept[0].identifier)
        return self._kept[0]

    def check(self, stage: Any) -> None:
        """Check the composed stage. Raises: SceneError: an active prim needs a layer that was refused."""
        for error in stage.GetCompositionErrors():
            found = re.search(_REFUSED.format(r"\d+"), str(error))
            refusal = self._refused.get(found[0]) if found else None
            prim = stage.GetPrimAtPath(error.rootSite.path)
            if refusal is not None and (not prim or prim.IsActive()):
                raise refusal

    def texture(self, spec: Any, place: str, *, keeps_alpha: bool) -> EncodedTexture | None:
        """Return the image that an attribute spec names by its default. If it is refused: None, and the reason is
        recorded."""
        base, asset = self._folders.get(spec.layer.identifier), spec.default
        name = asset.path.strip().replace("\\", "/").replace("<UDIM>", "1001") if asset else ""
        if base is None or not name:
            return None
        if base.archive is not None:
            archive, entry = base.archive, posixpath.normpath(posixpath.join(str(base.folder), name))
            return self.textures.named(f"{archive.path.name}/{entry}", lambda: archive.read(entry), keeps_alpha)
        if not _SCHEME.match(name):
            name = _relative(os.path.join(base.folder, name), self.textures.folder).replace("%", "%25")
        return self.textures.from_file(name, place, keeps_alpha=keeps_alpha)

    # -- opening -----------------------------------------------------------------------------------------------------

    def _file(self, path: Path) -> str:
        """Return the anonymous identifier of the layer in an allowed file."""
        if path not in self._known:
            check_file(path)
            base = _BaseFolder(path.parent)
            if path.suffix.lower() == ".usdz":
                archive = Archive(path)
                base = _BaseFolder(posixpath.dirname(archive.first), archive)
                self._known[(archive, archive.first)] = self._known[path] = self._open(
                    f"{path}[{archive.first}]", f"{path.name}/{archive.first}", base, path.stat().st_size
                )
            else:
                self._known[path] = self._open(str(path), path.name, base, path.stat().st_size)
        return self._known[path]

    def _open(self, where: str, name: str, base: _BaseFolder, n_bytes: int) -> str:
        self.n_bytes += n_bytes
        if self.n_bytes > MAX_LAYER_BYTES:
            raise SceneError(
                f"layer {name!r} brings the size of all layers to {self.n_bytes:,} bytes; at most {MAX_LAYER_BYTES:,} "
                "are read (scene2hap.scene.formats.usd.layers.MAX_LAYER_BYTES). Split the scene."
            )
        self._allow(n_bytes, 0)
        try:
            layer = Sdf.Layer.OpenAsAnonymous(where)
        except Tf.ErrorException as cause:
            reason = reason_of(cause).replace(where, name)
            raise SceneFormatError(f"{name!r} cannot be read as USD: {reason}.") from cause
        if layer is None:
            raise SceneFormatError(f"{name!r} cannot be read as USD: it is not what its name says.")
        self._kept.append(layer)
        self._folders[layer.identifier], self._names[layer.identifier] = base, name
        self._to_visit.append(layer)
        return str(layer.identifier)

    # -- names of other layers ---------------------------------------------------------------------------------------

    def _rewrite(self, layer: Any) -> None:
        """Replace every name of another layer by an identifier in memory."""
        base = self._folders[layer.identifier]
        if layer.subLayerPaths:
            names = [self._identifier(str(name), base, "a list of sublayers") for name in layer.subLayerPaths]
            for name in names:
                if (refusal := self._refused.get(name)) is not None:
                    raise refusal
            layer.subLayerPaths = names
        default = layer.defaultPrim
        default_path = Sdf.Path(default if default.startswith("/") else f"/{default}") if default else None
        self._composition.add_layer(layer.identifier, default_path, layer.subLayerPaths)
        to_visit = list(layer.rootPrims)
        n_prims = 0
        while to_visit:
            n_prims += 1
            prim = to_visit.pop()
            if prim is None:
                name = self._names[layer.identifier]
                raise SceneFormatError(f"{name!r} lists a prim that it does not hold: it is damaged. Export it again.")
            children = list(prim.nameChildren)
            variants = [[each.primSpec for each in group.variants.values()] for group in prim.variantSets]
            own = (layer.identifier, prim.path)
            self._composition.add_prim(
                own, (each.path for each in children), ([each.path for each in group] for group in variants)
            )
            keys = prim.ListInfoKeys()
            for key in ("references", "payload"):
                if key in keys:
                    self._rewrite_arcs(prim, key, base)
            for key in ("inheritPaths", "specializes"):
                for path in prim.GetInfo(key).GetAppliedItems() if key in keys else ():
                    self._composition.add_arc(own, "", path)
            for key in _CLIPS:
                if key in keys:
                    prim.ClearInfo(key)
            to_visit += children
            to_visit += (each for group in variants for each in group)
        self._allow(0, n_prims)

    def _rewrite_arcs(self, prim: Any, key: str, base: _BaseFolder) -> None:
        place = f"prim {prim.path}"
        own = (prim.layer.identifier, prim.path)

        def moved(item: Any) -> Any:
            found = self._identifier(item.assetPath, base, place) if item.assetPath else ""
            if key == "references":
                return Sdf.Reference(found, item.primPath, item.layerOffset, item.customData)
            return Sdf.Payload(found, item.primPath, item.layerOffset)

        edits = prim.GetInfo(key)
        if edits.isExplicit:
            edits.explicitItems = [moved(item) for item in edits.explicitItems]
        else:
            for kind in ("addedItems", "prependedItems", "appendedItems", "deletedItems", "orderedItems"):
                if items := getattr(edits, kind):
                    setattr(edits, kind, [moved(item) for item in items])
        for item in edits.GetAppliedItems():
            self._composition.add_arc(own, item.assetPath, item.primPath)
        prim.SetInfo(key, edits)

    def _identifier(self, asset: str, base: _BaseFolder, place: str) -> str:
        """Return the anonymous identifier of the layer that `place` names `asset`. If refused: one that finds
        nothing."""
        if (base, asset) not in self._known:
            refusal: SceneError | None
            try:
                identifier, refusal = self._found(asset, base, place), None
            except SceneFormatError:
                raise
            except SceneError as error:
                identifier, refusal = "", error
            if not identifier:
                identifier = _REFUSED.format(len(self._refused))
                self._refused[identifier] = refusal
            self._known[(base, asset)] = identifier
        return self._known[(base, asset)]

    def _found(self, asset: str, base: _BaseFolder, place: str) -> str:
        name = asset.strip().replace("\\", "/")
        suffix = os.path.splitext(name)[1].lower()
        if suffix in _LOOKS:
            self.textures.refuse(name, f"{place} names {name!r}, a file of materials of a kind that is not read.")
            return ""
        if name.startswith("`"):
            raise SceneError(f"{place} names a layer by the expression {name!r}. Flatten the scene (usdcat --flatten).")
        if base.archive is not None:
            return self._entry(name, base.archive, str(base.folder), place)
        if suffix not in _SUFFIXES and not _SCHEME.match(name):
            raise SceneError(f"{place} names {name!r}; layers that are read end in {', '.join(_SUFFIXES)}.")
        path = self._inside(name, Path(base.folder), place)
        with usable_name(name, place):
            exists = is_there(path)
            if not exists and not name.startswith(("./", "../", "/")):
                # A name without a leading dot may also start from the folder of the root layer (Ar, search paths).
                beside_root = self._inside(name, self._path.parent, place)
                exists = is_there(beside_root)
                path = beside_root if exists else path
        if not exists:
            raise SceneError(f"{place} needs the layer {name!r}, and there is no file {quoted(path)}. Copy it there.")
        return self._file(path)

    def _inside(self, name: str, folder: Path, place: str) -> Path:
        # Names in USD are not percent-encoded.
        return inside(self._assets_root, folder, name if _SCHEME.match(name) else name.replace("%", "%25"), place)

    def _entry(self, name: str, archive: Archive, folder: str, place: str) -> str:
        candidates = (posixpath.normpath(posixpath.join(folder, name)), posixpath.normpath(name))
        entry = next((candidate for candidate in candidates if candidate in archive), None)
        if entry is None or os.path.splitext(entry)[1].lower() not in _SUFFIXES[:3]:
            raise SceneError(
                f"{place} in {archive.path.name!r} needs the layer {name!r}, which the archive does not hold as a file "
                f"that ends in {', '.join(_SUFFIXES[:3])}. Make the archive again by usdzip."
            )
        if (archive, entry) not in self._known:
            base = _BaseFolder(posixpath.dirname(entry), archive)
            # The archive's bytes were counted with its root layer.
            self._known[(archive, entry)] = self._open(
                f"{archive.path}[{entry}]", f"{archive.path.name}/{entry}", base, 0
            )
        return self._known[(archive, entry)]


def _relative(path: str, folder: Path) -> str:
    """Return the path relative to a folder; the path itself if it is on another drive."""
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:
        return path


def reason_of(cause: Exception) -> str:
    """Return usd-core's message about a file, in one line, without positions in its own source code."""
    said = " ".join(str(cause).split())
    quoted = re.search(r" : '(.*?)'(?: Error in|$)", said)
    return (quoted[1] if quoted else said)[:300].rstrip(". ")
