"""Numbers with their nouns, and the messages that use them for a single thing."""

from pathlib import Path

from scene2hap import bake_many
from scene2hap.common.counted import counted, first_of

SQUARE = "v 0 0 0\nv 0.1 0 0\nv 0.1 0.3 0\nv 0 0.3 0\no fan\nf 1 2 3 4\n"


def test_only_one_thing_has_no_plural() -> None:
    assert [counted(n, "file") for n in (0, 1, 2, 1200)] == ["0 files", "1 file", "2 files", "1,200 files"]


def test_the_first_names_are_followed_by_the_number_of_the_others() -> None:
    assert [first_of("abcd"[:n], 2) for n in range(5)] == ["", "a", "a, b", "a, b and 1 more", "a, b and 2 more"]


def test_one_baked_scene_is_one_scene(tmp_path: Path) -> None:
    (tmp_path / "fan.obj").write_text(SQUARE)
    report = bake_many([tmp_path / "fan.obj"], tmp_path / "bundles")
    assert str(report).startswith("1 scene baked, 0 kept, 0 failed")
