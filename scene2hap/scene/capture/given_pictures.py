"""Pictures of a scene from another renderer, such as a game engine or Blender, instead of `capture_images`.

    pictures = GivenPictures({("phone", "isolated", "front"): png, (None, "scene", "above"): jpeg})
    pictures = GivenPictures.load("kitchen")  # a folder with pictures.json
    bundle = bake(pictures.attach_to(scene), config)

Files are checked when they are given, and decoded at their first use.
"""

from __future__ import annotations

import hashlib
import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.files import read_small, read_small_text
from scene2hap.common.json_texts import parse_json
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError, SceneFormatError, reason_of
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.capture.cache import MEMORY
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB
from scene2hap.scene.capture.png import PNG_END, PNG_SIGNATURE, png
from scene2hap.scene.files import inside
from scene2hap.scene.images import ImageSet, ObjectImages, Shot
from scene2hap.scene.looks.textures import eight_bits, opened, pillow_reason
from scene2hap.scene.snapshot import SceneSnapshot

INDEX = "pictures.json"
"""Name of the index file in a folder of pictures. It says which object and view each picture shows."""

MAX_BYTES = 1 << 24
"""Largest size of one picture [bytes] (assumed: ten times a PNG file of 1024 pixels a side)."""
LEAST_PX, MAX_PX = 16, 4096
"""Least and greatest width and height of one picture, as in `CaptureConfig.size_px`."""
SHOWN_PX = 1024
"""Larger pictures are reduced to this edge, which bounds their cost at a paid model (assumed)."""
MAX_PICTURES = 100_000
"""Most pictures of one scene (assumed: 16 of each of some thousands of objects)."""
_LONGEST_VIEW = 200

_JPEG_SIGNATURE, _JPEG_END = b"\xff\xd8\xff", b"\xff\xd9"
# Part of every key in the memory cache. Increase it when the conversion of a file changes.
_FORM = "given 1"

Kind = Literal["scene", "isolated", "context"]
PictureKey = tuple[str | None, Kind, str]
"""Key of a picture: object id (None for the whole scene), kind, name of the view."""


@dataclass(frozen=True)
class GivenShot(Shot):
    """A picture from a named angle."""

    view: str = ""

    @property
    def label(self) -> str:
        """Name of the view, such as "front"."""
        return self.view


@clear_calls
class GivenPictures:
    """The `ImageSource` of existing pictures, as PNG or JPEG files.

    A model gets pictures in the given order, the isolated ones of an object before the ones in its surroundings. The
    prompts say that the object has a pink outline (255, 0, 190) in pictures of its surroundings.
    Parameters: pictures : files by `PictureKey`; kind "scene" has no object id, "isolated" and "context" have one.
    Raises: SceneError: a key that names nothing, or a picture too large; SceneFormatError: neither PNG nor JPEG.
    """

    def __init__(self, pictures: Mapping[PictureKey, bytes]) -> None:
        if not isinstance(pictures, Mapping):
            given = checks.described(pictures)
            raise SceneError(f"pictures is {given}; it must be a dict of files by (object id, kind, view).")
        self._files: dict[Shot, bytes | Path] = {}
        for key, file in pictures.items():
            self._add(_shot(key), file)

    @classmethod
    def load(cls, folder: str | os.PathLike[str]) -> GivenPictures:
        """Return the pictures of a folder. They are decoded at their first use.

        Its `pictures.json` is a list of JSON objects with `object` (an id; left out for the whole scene), `kind`,
        `view`, and `file`, a relative reference to a file in the folder.
        Raises: as the constructor; SceneError: a file is missing or outside the folder; SceneFormatError: no such list.
        """
        root = checks.path("folder", folder, error=SceneError)
        found = cls({})
        for number, row in enumerate(_rows(root / INDEX)):
            place = f"picture {number} of {quoted(root / INDEX)}"
            if not isinstance(row, dict) or not isinstance(row.get("file"), str):
                raise SceneFormatError(
                    f"{place} is {checks.represented(row)}; it must be an object with object, kind, view and file."
                )
            try:
                shot = _shot((row.get("object"), row.get("kind"), row.get("view")))
            except SceneError as cause:
                raise SceneError(f"{place}: {cause}") from cause
            if shot in found._files:
                raise SceneError(f"{place} is the second {_label(shot)}; give each view of a thing its own name.")
            found._add(shot, inside(root, root, row["file"], place))
        return found

    @property
    def shots(self) -> tuple[Shot, ...]:
        """All pictures, in the given order."""
        return tuple(self._files)

    def image(self, shot: Shot) -> bytes:
        """Return the picture as an opaque PNG file of at most `SHOWN_PX` a side.

        Raises: SceneError: it was not given; its file is missing or cannot be decoded.
        """
        if shot not in self._files:
            raise SceneError(f"there is no {_label(shot)} among the {len(self._files)} pictures that were given.")
        given = self._files[shot]
        file = _content(given, _label(shot))
        key = f"{_FORM} {hashlib.sha256(file).hexdigest()}"
        shown = MEMORY.get(key)
        if shown is None:
            check_picture(file, _place(shot, given))  # a file on the disk may have changed since it was given
            shown = _as_shown(file, _place(shot, given))
            MEMORY.put(key, shown)
        return shown

    def attach_to(self, scene: SceneSnapshot | str | os.PathLike[str]) -> SceneSnapshot:
        """Return the scene with these pictures, for `bake`. An object without a picture here keeps its own pictures.

        An object without any pictures takes the isolated pictures of an object with the same `instance_key`.
        Raises: UnknownObject: a picture shows an object that the scene does not have.
        """
        scene = given_scene(scene)
        of_kind: dict[tuple[str | None, str], list[Shot]] = {}
        for shot in self._files:
            if shot.subject is not None:
                scene.object(shot.subject)
            of_kind.setdefault((shot.subject, shot.kind), []).append(shot)
        of_key: dict[str, list[Shot]] = {}
        for item in scene.objects:
            if item.instance_key and (item.id, "isolated") in of_kind:
                of_key.setdefault(item.instance_key, of_kind[item.id, "isolated"])
        objects = []
        for item in scene.objects:
            isolated, context = of_kind.get((item.id, "isolated"), []), of_kind.get((item.id, "context"), [])
            if not isolated and item.images is None:
                isolated = of_key.get(item.instance_key, [])
            if isolated or context:
                item = replace(item, images=ObjectImages(ImageSet(self, isolated), ImageSet(self, context)))
            objects.append(item)
        whole = of_kind.get((None, "scene"))
        return replace(scene, objects=tuple(objects), images=scene.images if whole is None else ImageSet(self, whole))

    def _add(self, shot: Shot, file: bytes | Path) -> None:
        if len(self._files) >= MAX_PICTURES:
            raise SceneError(f"there are more than {MAX_PICTURES:,} pictures; give fewer views of each object.")
        check_picture(_content(file, _label(shot)), _place(shot, file))
        self._files[shot] = file

    def __len__(self) -> int:
        return len(self._files)

    def __repr__(self) -> str:
        return f"GivenPictures({len(self._files)} of {len({shot.subject for shot in self._files})} subjects)"


def check_picture(file: object, name: str = "the picture") -> tuple[int, int]:
    """Return width and height [px] of a PNG or JPEG file with a complete begin and end. Does not decode its pixels.

    Raises: SceneFormatError: it is something else, or cut short; SceneError: it is too large or too small.
    """
    if not isinstance(file, bytes):
        raise SceneFormatError(f"{name} is {checks.described(file)}; it must be the bytes of a PNG or JPEG file.")
    if len(file) > MAX_BYTES:
        raise SceneError(f"{name} has {len(file):,} bytes; at most {MAX_BYTES:,} are read. Give a smaller one.")
    if not file.startswith((PNG_SIGNATURE, _JPEG_SIGNATURE)):
        raise SceneFormatError(f"{name} is neither PNG nor JPEG; it begins with {checks.represented(file[:8])}.")
    # Some cameras write bytes after the end of a JPEG. A PNG must end with its end mark.
    is_whole = file.endswith(PNG_END) if file.startswith(PNG_SIGNATURE) else _JPEG_END in file[-4096:]
    if not is_whole:
        raise SceneFormatError(f"{name} is cut short after {len(file):,} bytes. Write or send it again.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Pillow warns of sizes that are refused below
            with opened(file) as image:
                width, height = image.size
    except Exception as cause:  # broken bytes may raise any error in Pillow
        reason = pillow_reason(cause)
        raise SceneFormatError(f"{name} is no picture that can be read: {reason}. Write or send it again.") from cause
    if not LEAST_PX <= min(width, height) <= max(width, height) <= MAX_PX:
        raise SceneError(f"{name} has {width:,} x {height:,} pixels; each must be {LEAST_PX} to {MAX_PX:,}. Resize it.")
    return width, height


def _shot(key: Any) -> GivenShot:
    """Return the shot of a key from a caller or a file. Raises: SceneError: the key is not valid."""
    if not isinstance(key, tuple) or len(key) != 3:
        raise SceneError(f"a picture's key is {checks.represented(key)}; it must be (object id, kind, view).")
    subject, kind, view = key
    if kind not in get_args(Kind):
        raise SceneError(
            f"a picture's kind is {checks.represented(kind)}; it must be 'isolated' (an object alone), 'context' (an "
            "object in its surroundings) or 'scene'."
        )
    if kind == "scene" and subject is not None:
        raise SceneError(
            f"a picture of kind 'scene' is of object {checks.represented(subject)}; it must have none. "
            "An object among others is of kind 'context'."
        )
    if kind != "scene" and (not isinstance(subject, str) or not subject):
        raise SceneError(f"a picture of kind {kind!r} is of object {checks.represented(subject)}; give an id.")
    if not isinstance(view, str) or not 0 < len(view) <= _LONGEST_VIEW:
        raise SceneError(
            f"a picture's view is {checks.represented(view)}; it must be a name of 1 to {_LONGEST_VIEW} characters, "
            "such as 'front'."
        )
    return GivenShot(kind, subject, 0.0, 0.0, view)


def _label(shot: Shot) -> str:
    """Describe a picture for a message."""
    whose = "" if shot.subject is None else f" of object {checks.represented(shot.subject)}"
    return f"{shot.kind} picture {checks.represented(shot.label)}{whose}"


def _place(shot: Shot, file: bytes | Path) -> str:
    """Describe a picture for a message, with its file if it has one."""
    return f"{_label(shot)} in {quoted(file)}" if isinstance(file, Path) else _label(shot)


def _rows(index: Path) -> list[Any]:
    try:
        rows = parse_json(read_small_text(index))
    except OSError as cause:
        raise SceneError(f"{quoted(index)} cannot be read: {cause.strerror}. Give the folder that holds it.") from cause
    except ValueError as cause:
        raise SceneFormatError(f"{quoted(index)} is no JSON that can be read: {reason_of(cause)}.") from cause
    if not isinstance(rows, list):
        raise SceneFormatError(f"{quoted(index)} holds {checks.described(rows)}; it must be a list of pictures.")
    return rows


def _content(file: bytes | Path, name: str) -> bytes:
    if not isinstance(file, Path):
        return file
    try:
        return read_small(file, MAX_BYTES)
    except (OSError, ValueError) as cause:
        raise SceneError(f"{name} cannot be read from {quoted(file)}: {reason_of(cause)}.") from cause


def _as_shown(file: bytes, name: str) -> bytes:
    """Return a checked file in the form that is sent to a model. Raises: SceneFormatError: its pixels cannot be
    decoded."""
    from PIL import Image

    try:
        with opened(file) as image:
            image.load()
            if image.format == "PNG" and image.mode == "RGB" and max(image.size) <= SHOWN_PX:
                return file
            image = eight_bits(image)
            if image.has_transparency_data:
                image = image.convert("RGBA")
                image = Image.alpha_composite(Image.new("RGBA", image.size, (*BACKGROUND_RGB, 255)), image)
            image = image.convert("RGB")
            image.thumbnail((SHOWN_PX, SHOWN_PX), Image.Resampling.BOX)
            return png(np.asarray(image))
    except Exception as cause:  # broken bytes may raise any error in Pillow
        raise SceneFormatError(f"{name} cannot be decoded: {pillow_reason(cause)}. Write or send it again.") from cause
