"""Pictures of a client before a bake, on a disk that is full."""

import io
import json
from pathlib import Path

import pytest
from PIL import Image

from bridge_frames import encode_picture
from scene2hap.bridge.pictures import SentPictures
from scene2hap.errors import BridgeError
from scene2hap.scene.capture.given_pictures import INDEX


def picture(name: str) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (16, 16), "red").save(file, "PNG")
    return encode_picture(json.dumps({"object": name, "kind": "isolated", "view": "front"}).encode(), file.getvalue())


def test_a_picture_that_the_disk_cannot_take_is_refused_and_not_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pictures = SentPictures(lambda: tmp_path)
    pictures.take(picture("radio"))

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as during:
        during.setattr("os.fsync", full)
        with pytest.raises(BridgeError, match=r"of the bridge cannot be written: No space.*Make room"):
            pictures.take(picture("fan"))
    folder = pictures.hand_over()
    assert [row["object"] for row in json.loads((folder / INDEX).read_text())] == ["radio"]
    assert len(list(folder.iterdir())) == 2
