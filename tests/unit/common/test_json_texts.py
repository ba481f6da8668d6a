"""Mistakes in JSON files that people edit by hand, and in those that git has merged."""

import itertools
import json
from pathlib import Path

import pytest

from scene2hap import HapticBundle, SceneObject, SceneSnapshot, TriMesh, UserProfile
from scene2hap.common.json_texts import has_surrogates, parse_json
from scene2hap.errors import BundleError, ConfigError
from scenes import table_with_two_phones

MERGED = '{\n<<<<<<< HEAD\n "gain_db": -3\n=======\n "gain_db": -6\n>>>>>>> theirs\n}'
MISTAKES = {
    "a comment": ('{"a": 1 // mine\n}', "line 1, column 9: JSON has no comments; remove this one"),
    "a comment over lines": ('{\n/* mine */\n"a": 1}', "line 2, column 1: JSON has no comments"),
    "a comment as in Python": ('{"a": [1,\n  # mine\n 2]}', "line 2, column 3: JSON has no comments"),
    "a comma after the last field": ('{"a": 1,\n}', "there is a comma before a closing bracket; remove it"),
    "a comma after the last entry": ('{"a": [1, 2, ]}', "there is a comma before a closing bracket; remove it"),
    "a missing comma": ('{"a": 1\n "b": 2}', "line 2, column 2: there is no comma before this place"),
    "a missing colon": ('{"a" 1}', "line 1, column 6: there is no colon before this place"),
    "single quotes": ("{'a': 1}", 'write names and texts in straight double quotes, as "name"'),
    "quotes of a word processor": ("{\u201ca\u201d: 1}", "straight double quotes"),
    "a decimal comma": ('{"a": 0,5}', "write a number with a decimal point, as 0.5"),
    "a number without its zero": ('{"a": .5}', "write a number as 0.5"),
    "a word of Python": ('{"a": True}', "write true, false and null in small letters"),
    "a file that was cut": ('{"a": [1, 2', "the text ends before the last bracket is closed"),
    "two files in one": ('{"a": 1}\n{"b": 2}', "line 2, column 1: the text goes on after its last bracket"),
    "a text without an end": ('{"a": "oak', "line 1, column 7: this text has no closing quote"),
    "a text without an end on its line": ('{"a": "oak,\n "b": 1}', "line 1, column 12: a text has no closing quote"),
    "a path of Windows": ('{"a": "C:\\sounds"}', 'write each backslash twice, as "C:\\\\sounds"'),
    "nothing": (" \n", "it is empty; an empty JSON object is {}"),
    "marks of git": (MERGED, "line 2 is <<<<<<<, where git could not merge two versions; join them"),
    "the last mark of git": ('{"a": 1,\n>>>>>>> 3f2a\n"b": 2}', "line 2 is >>>>>>>"),
    "anything else": ('{"a": wrong}', "line 1, column 7: Expecting value"),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_named_with_its_line_and_what_to_do(case: str) -> None:
    text, told = MISTAKES[case]
    with pytest.raises(ValueError) as caught:
        parse_json(text)
    assert told in str(caught.value)


def test_a_text_that_looks_like_a_mark_is_none() -> None:
    assert parse_json('{"a": "<<<<<<< HEAD", "b": "x, }"}') == {"a": "<<<<<<< HEAD", "b": "x, }"}
    with pytest.raises(ValueError, match="comma before a closing bracket"):
        parse_json('{"a": "=======",}')


@pytest.mark.parametrize("name", ["bundle.json", "scene.json", "objects.json", "loops.json", "overrides.json"])
def test_a_bundle_names_the_line_at_which_git_merged(name: str, tmp_path: Path) -> None:
    folder = table_with_two_phones()[1].override("phone", gain_db=-3.0).save(tmp_path / "room")
    lines = (folder / name).read_text(encoding="utf-8").splitlines()
    merged = [lines[0], "<<<<<<< HEAD", *lines[1:2], "=======", *lines[1:2], ">>>>>>> theirs", *lines[2:]]
    (folder / name).write_text("\n".join(merged), encoding="utf-8")
    with pytest.raises(BundleError, match=rf"{name} cannot be read: line 2 is <<<<<<<.*git could not merge"):
        HapticBundle.load(folder)


def test_a_profile_with_a_comment_says_so(tmp_path: Path) -> None:
    (tmp_path / "ada.json").write_text('{"user": {"gain_db": -3}} // Ada')
    with pytest.raises(ConfigError, match="line 1, column 27: JSON has no comments"):
        UserProfile.parse(tmp_path / "ada.json")


def test_a_bundle_with_line_ends_of_windows_is_read(tmp_path: Path) -> None:
    bundle = table_with_two_phones()[1].override("phone", gain_db=-3.0)
    folder = bundle.save(tmp_path / "room")
    for file in [*folder.glob("*.json"), folder / "credits.txt"]:
        file.write_bytes(file.read_bytes().replace(b"\n", b"\r\n"))
    assert HapticBundle.load(folder).overrides == bundle.overrides


@pytest.mark.parametrize("kind", ["sounds", "meshes"])
def test_a_clone_without_git_lfs_says_what_to_run(kind: str, tmp_path: Path) -> None:
    bundle = table_with_two_phones()[1]
    if kind == "meshes":
        tent = SceneObject(
            "tent", geometry=TriMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 1, 3]])
        )
        bundle = HapticBundle(SceneSnapshot.build([tent]), "field", {}, {})
    folder = bundle.save(tmp_path / "room")
    path = min((folder / kind).iterdir())
    path.write_bytes(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n")
    with pytest.raises(BundleError, match=f"{path.name} is a pointer of Git LFS.*run `git lfs pull`"):
        HapticBundle.load(folder)


PIECES = ("\\ud83d", "\\uDE00", "\\\\", "\\n", "\\u00e9", "ud83d", "\ud83d", "\U0001f600", "a")
"""Escapes of both halves of a pair, of others, what looks like an escape after a backslash, and characters."""


def test_half_of_a_surrogate_pair_is_found_in_any_order_of_escapes() -> None:
    """The parser joins the two escapes of a pair, and nothing else."""
    for n in range(5):
        for pieces in itertools.product(PIECES, repeat=n):
            text = f'"{"".join(pieces)}"'
            is_half = any("\ud800" <= character <= "\udfff" for character in json.loads(text))
            assert has_surrogates(text) == is_half, text
