"""JSON in which an object has a key twice: every reader of a person's files refuses it with the same sentence."""

from collections.abc import Callable
from pathlib import Path

import pytest

from scene2hap import BakeConfig, load_scene
from scene2hap.bundle.account import read_account
from scene2hap.bundle.corrections import read_corrections
from scene2hap.bundle.files import read_json as read_bundle_json
from scene2hap.cli.given_spec import given_spec
from scene2hap.clips.reading import read_haptic_clip
from scene2hap.errors import Scene2HapError
from scene2hap.scene.capture.given_pictures import GivenPictures
from scene2hap.session.touch_track import TouchTrack

Reader = Callable[[Path], object]


def _account(path: Path) -> object:
    return read_account(path.with_name(path.name.removesuffix(".account.json")))


@pytest.mark.parametrize(
    ("name", "text", "read"),
    [
        ("settings.json", '{"bake": {"seed": 1}, "bake": {}}', BakeConfig.parse),
        ("touches.json", '{"duration_s": 1.0, "steps": [], "steps": []}', TouchTrack.load),
        ("corrections.json", '{"overrides": {"fan": {}, "fan": {}}}', read_corrections),
        ("kitchen.bundle.account.json", '{"calls": {}, "calls": {}}', _account),
        ("objects.json", '{"fan": {}, "fan": {}}', lambda path: read_bundle_json(path.parent, path.name)),
        ("scene.json", '{"objects": [], "objects": []}', load_scene),
        ("scene.gltf", '{"asset": {"version": "2.0"}, "nodes": [], "nodes": []}', load_scene),
        ("pictures.json", '[{"file": "a.png", "file": "b.png"}]', lambda path: GivenPictures.load(path.parent)),
        ("clip.haptic", '{"version": {}, "signals": {}, "signals": {}}', read_haptic_clip),
        ("spec", '{"kind": "openai", "kind": "local"}', lambda path: given_spec("--llm", path.read_text())),
    ],
)
def test_a_key_that_stands_twice_is_refused(name: str, text: str, read: Reader, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(Scene2HapError, match=r"the key '\w+' is given twice in one object; remove one"):
        read(path)
