"""Pictures rendered elsewhere: given as bytes or in a folder, checked, and sent to a model."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, bake, capture_images
from scene2hap.errors import SceneError, SceneFormatError, UnknownObject
from scene2hap.llm.chain import infer_haptics
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.scene.capture import contact_sheet, given_pictures
from scene2hap.scene.capture.given_pictures import GivenPictures, check_picture

SCENE = SceneSnapshot.build(
    [
        SceneObject("table", pose=Pose((0, 0.36, 0)), geometry=Box((1.2, 0.72, 0.7)), instance_key="t"),
        SceneObject("phone", pose=Pose((0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15)), instance_key="p"),
        SceneObject("phone 2", pose=Pose((-0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15)), instance_key="p"),
    ]
)
RED, GREEN, BLUE = (220, 20, 30), (20, 200, 30), (10, 30, 210)


def file(color: tuple[int, ...] = RED, size: tuple[int, int] = (64, 48), kind: str = "PNG", mode: str = "RGB") -> bytes:
    out = io.BytesIO()
    Image.new(mode, size, color if len(mode) > 1 else color[0]).save(out, kind)
    return out.getvalue()


def pixels(picture: bytes) -> np.ndarray:
    with Image.open(io.BytesIO(picture)) as image:
        assert (image.format, image.mode) == ("PNG", "RGB")
        return np.asarray(image)


def shown(given: bytes) -> np.ndarray:
    """The pixels of the only picture of the phone, as a model gets it."""
    scene = GivenPictures({("phone", "isolated", "front"): given}).attach_to(SCENE)
    images = scene.object("phone").images
    assert images is not None
    (picture,) = images.together
    return pixels(picture)


class Looking:
    """The lexicon as a vision backend that records the colour in the middle of each picture."""

    def __init__(self) -> None:
        self.lexicon = LexiconBackend()
        self.seen: dict[tuple[str, str], list[tuple[int, ...]]] = {}

    async def complete(self, request: LLMRequest) -> LLMReply:
        middles = [pixels(png)[24, 32] for png in request.images]
        self.seen[request.component, request.subject] = [tuple(map(int, rgb)) for rgb in middles]
        return await self.lexicon.complete(request)


def folder_of(path: Path, rows: Any) -> Path:
    path.mkdir(exist_ok=True)
    (path / "pictures.json").write_text(rows if isinstance(rows, str) else json.dumps(rows), encoding="utf-8")
    return path


def test_model_gets_isolated_pictures_before_context_pictures() -> None:
    pictures = GivenPictures(
        {
            ("phone", "context", "front"): file(BLUE),
            ("phone", "isolated", "front"): file(RED),
            ("phone", "isolated", "left"): file(GREEN),
            (None, "scene", "above"): file((1, 2, 3)),
        }
    )
    backend = Looking()
    infer_haptics(pictures.attach_to(SCENE), backend)
    assert backend.seen["scene_analyzer", ""] == [(1, 2, 3)]
    assert backend.seen["object_analyzer", "phone"] == [RED, GREEN, BLUE]
    assert backend.seen["object_analyzer", "table"] == []


def test_scene_with_given_pictures_can_be_baked() -> None:
    scene = GivenPictures({("phone", "isolated", "front"): file()}).attach_to(SCENE)
    assert bake(scene).objects == bake(SCENE).objects


def test_folder_gives_the_same_pictures_as_bytes(tmp_path: Path) -> None:
    (tmp_path / "a b").mkdir()
    (tmp_path / "a b" / "0.png").write_bytes(file(RED))
    (tmp_path / "1").write_bytes(file(BLUE))
    rows = [
        {"object": "phone", "kind": "isolated", "view": "above 30°", "file": "a%20b/0.png"},
        {"kind": "scene", "view": "above", "file": "1", "more": "is ignored"},
    ]
    pictures = GivenPictures.load(folder_of(tmp_path, rows))
    assert [(shot.subject, shot.kind, shot.label) for shot in pictures.shots] == [
        ("phone", "isolated", "above 30°"),
        (None, "scene", "above"),
    ]
    scene = pictures.attach_to(SCENE)
    phone = scene.object("phone").images
    assert phone is not None
    assert scene.images is not None
    assert phone.isolated[0] == file(RED)
    assert scene.images[0] == file(BLUE)
    assert scene.object("table").images is None


def test_copy_without_pictures_uses_isolated_pictures_of_another_copy() -> None:
    pictures = GivenPictures({("phone", "isolated", "a"): file(RED), ("phone", "context", "a"): file(BLUE)})
    scene = pictures.attach_to(SCENE)
    other = scene.object("phone 2").images
    assert other is not None
    assert [tuple(pixels(picture)[0, 0]) for picture in other.together] == [RED]
    assert scene.object("table").images is None


def test_objects_without_given_pictures_keep_captured_ones() -> None:
    pytest.importorskip("embreex", reason="needs the extra `pictures`")
    captured = capture_images(SCENE)
    scene = GivenPictures({("phone", "isolated", "a"): file(RED)}).attach_to(captured)
    assert scene.images is captured.images
    assert scene.object("table").images is captured.object("table").images
    assert scene.object("phone 2").images is captured.object("phone 2").images


def test_png_of_red_green_blue_is_shown_byte_by_byte() -> None:
    given = file()
    images = GivenPictures({("phone", "isolated", "a"): given}).attach_to(SCENE).object("phone").images
    assert images is not None
    assert images.isolated[0] == given


def test_jpeg_becomes_png_of_nearly_the_same_colours() -> None:
    picture = shown(file(kind="JPEG"))
    assert picture.shape == (48, 64, 3)
    assert np.abs(picture.astype(int) - RED).max() <= 4


def test_transparent_pixels_show_the_grey_of_captured_pictures() -> None:
    clear, half = (0, 0, 0, 0), (*RED, 128)
    assert tuple(shown(file(clear, mode="RGBA"))[0, 0]) == (190, 194, 200)
    between = (np.array(RED) * 128 + np.array((190, 194, 200)) * 127) / 255
    assert np.abs(shown(file(half, mode="RGBA"))[0, 0] - between).max() <= 1


def test_grey_of_sixteen_bits_is_scaled() -> None:
    out = io.BytesIO()
    Image.fromarray(np.full((20, 20), 0x80FF, np.uint16)).save(out, "PNG")
    assert (shown(out.getvalue()) == 0x80).all()


def test_a_large_picture_is_reduced_to_1024_pixels() -> None:
    assert shown(file(size=(4096, 1024))).shape == (256, 1024, 3)


def test_check_picture_returns_the_size() -> None:
    assert check_picture(file(size=(17, 40))) == (17, 40)


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        (b"", SceneFormatError, "isolated picture 'front' of object 'phone' is neither PNG nor JPEG"),
        (b"GIF89a" + bytes(100), SceneFormatError, "begins with b'GIF89a"),
        ("a.png", SceneFormatError, "is 'a.png'; it must be the bytes of a PNG or JPEG file"),
        (file()[:-5], SceneFormatError, "is cut short after"),
        (file() + b"more", SceneFormatError, "is cut short after"),
        (file(kind="JPEG")[:-2], SceneFormatError, "is cut short after"),
        (b"\x89PNG\r\n\x1a\n" + b"IEND\xaeB\x60\x82", SceneFormatError, "is no picture that can be read"),
        (file(size=(15, 64)), SceneError, "has 15 x 64 pixels; each must be 16 to 4,096"),
        (file(size=(64, 4097), mode="L"), SceneError, "has 64 x 4,097 pixels"),
        # Pillow would warn of so many pixels. Drawn by the test, since it takes a second.
        (lambda: file(size=(9_500, 9_500), mode="1"), SceneError, "has 9,500 x 9,500 pixels"),
    ],
)
def test_unusable_picture_is_refused_immediately(
    given: Any, error: type[SceneError], message: str, recwarn: pytest.WarningsRecorder
) -> None:
    picture = given() if callable(given) else given
    with pytest.raises(error, match=message) as caught:
        GivenPictures({("phone", "isolated", "front"): picture})
    assert type(caught.value) is error
    assert not recwarn.list


def test_more_bytes_than_are_allowed_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(given_pictures, "MAX_BYTES", 100)
    with pytest.raises(SceneError, match=r"has [\d,]+ bytes; at most 100 are read"):
        GivenPictures({("phone", "isolated", "front"): file(size=(200, 200))})


def test_more_pictures_than_are_allowed_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(given_pictures, "MAX_PICTURES", 2)
    with pytest.raises(SceneError, match="more than 2 pictures"):
        GivenPictures({("phone", "isolated", str(i)): file() for i in range(3)})


def test_broken_pixels_raise_at_first_access() -> None:
    noise = np.random.default_rng(1).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    out = io.BytesIO()
    Image.fromarray(noise).save(out, "PNG")
    broken = bytearray(out.getvalue())
    broken[500:600] = bytes(100)
    pictures = GivenPictures({("phone", "isolated", "front"): bytes(broken)})
    with pytest.raises(SceneFormatError, match="isolated picture 'front' of object 'phone' cannot be decoded"):
        pictures.image(pictures.shots[0])


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("phone", r"must be \(object id, kind, view\)"),
        (("phone", "isolated"), r"must be \(object id, kind, view\)"),
        (("phone", "alone", "front"), "kind is 'alone'; it must be 'isolated'"),
        (("phone", "scene", "front"), "kind 'scene' is of object 'phone'; it must have none"),
        ((None, "context", "front"), "kind 'context' is of object None; give an id"),
        ((7, "context", "front"), "kind 'context' is of object 7; give an id"),
        (("phone", "context", ""), "view is ''; it must be a name"),
        (("phone", "context", None), "view is None; it must be a name"),
        (("phone", "context", "x" * 201), "of 1 to 200 characters"),
        (("phone", ["context"], "front"), "kind is"),
    ],
)
def test_invalid_key_is_refused(key: Any, message: str) -> None:
    class OneItem(dict[Any, bytes]):
        def items(self) -> Any:  # also keys that no dict could have
            return [(key, file())]

    with pytest.raises(SceneError, match=message):
        GivenPictures(OneItem())


def test_a_picture_of_an_unknown_object_names_the_nearest() -> None:
    pictures = GivenPictures({("phon", "isolated", "front"): file()})
    with pytest.raises(UnknownObject, match="Did you mean 'phone'"):
        pictures.attach_to(SCENE)


def test_list_instead_of_mapping_is_refused() -> None:
    with pytest.raises(SceneError, match="it must be a dict of files"):
        GivenPictures([file()])


ROW = {"object": "phone", "kind": "isolated", "view": "front", "file": "0.png"}


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("[", "is no JSON"),
        ({"pictures": []}, "it must be a list of pictures"),
        (["0.png"], "picture 0 of .* is '0.png'; it must be an object"),
        ([{**ROW, "file": 3}], "it must be an object with object, kind, view and file"),
        ([{**ROW, "kind": "alone"}], "kind is 'alone'"),
        ([ROW, ROW], "picture 1 of .* is the second isolated picture 'front' of object 'phone'"),
        ([{**ROW, "file": "gone.png"}], "cannot be read from"),
        ([{**ROW, "file": "../0.png"}], "lies outside"),
        ([{**ROW, "file": "/etc/hostname"}], "lies outside"),
        ([{**ROW, "file": "http://example.org/0.png"}], "Addresses are never fetched"),
        ([{**ROW, "file": "."}], "cannot be read from"),
    ],
)
def test_error_states_why_a_folder_is_unusable(tmp_path: Path, rows: Any, message: str) -> None:
    (tmp_path / "0.png").write_bytes(file())
    with pytest.raises(SceneError, match=message):
        GivenPictures.load(folder_of(tmp_path / "in", rows) if "0.png" not in str(rows) else folder_of(tmp_path, rows))


def test_error_names_the_missing_index_of_a_folder(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"pictures\.json' cannot be read"):
        GivenPictures.load(tmp_path)


def test_a_file_that_changed_since_is_checked_again(tmp_path: Path) -> None:
    (tmp_path / "0.png").write_bytes(file())
    pictures = GivenPictures.load(folder_of(tmp_path, [ROW]))
    (tmp_path / "0.png").write_bytes(b"no picture any more")
    with pytest.raises(SceneFormatError, match="neither PNG nor JPEG"):
        pictures.image(pictures.shots[0])
    (tmp_path / "0.png").unlink()
    with pytest.raises(SceneError, match="cannot be read from"):
        pictures.image(pictures.shots[0])


def test_given_pictures_have_a_contact_sheet() -> None:
    given = {("phone", kind, view): file() for kind in ("isolated", "context") for view in ("front", "back")}
    scene = GivenPictures(given).attach_to(SCENE)
    assert len(pixels(contact_sheet(scene.object("phone")))) > 0
