"""docs/scene-json.md: the example loads and can be felt, and the table of axes is correct."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from scene2hap import ContactGraph, HapticSession, SceneSnapshot, Touch, bake
from scene2hap.scene.pose import Pose

DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "scene-json.md").read_text(encoding="utf-8")


def example() -> str:
    found = re.search(r"<!-- ci: example -->\n```json\n(.*?)```", TEXT, re.DOTALL)
    assert found
    return found[1]


def test_the_example_is_a_phone_on_a_table_that_can_be_felt() -> None:
    scene = SceneSnapshot.from_json(example())
    assert ContactGraph(scene).neighbours("phone") == ("table",)
    assert scene.object("table").size_m == pytest.approx((1.2, 0.7, 0.04))
    assert scene.object("phone").relative_height_m == pytest.approx(0.04)
    session = HapticSession(scene, bake(scene))
    frame = session.update(
        touches=[Touch("left", "table", (0.2, 0.74, 0.1)), Touch("right", "table", (-0.6, 0.74, -0.3))]
    )
    assert frame.gain("left", "phone") > frame.gain("right", "phone") > 0


def test_the_example_is_valid_by_the_published_schema() -> None:
    jsonschema = pytest.importorskip("jsonschema", reason="needs jsonschema, of the extra test")
    schema = json.loads((DOCS / "scene.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(json.loads(example()))


def test_every_field_of_the_schema_is_explained() -> None:
    schema = json.loads((DOCS / "scene.schema.json").read_text(encoding="utf-8"))
    for name in ("SceneObject", "Contact", "Box", "TriMesh"):
        for field in schema["$defs"][name]["properties"]:
            assert re.search(rf'[`"]{field}["`]', TEXT), f"docs/scene-json.md does not say {field}"


def test_the_row_of_unity_turns_a_left_hand_into_a_right_one() -> None:
    """The table's row for Unity, read from the page, against the mirror image of a rotated tetrahedron."""
    row = re.search(r"\| Unity \|[^|]*\| \((.*?)\) \| \((.*?)\) \|", TEXT)
    assert row
    position, quaternion = ([(-1 if "-" in part else 1) for part in group.split(",")] for group in row.groups())
    rng = np.random.default_rng(3)
    vertices, at, turn = rng.normal(size=(4, 3)), rng.normal(size=3), rng.normal(size=4)
    # A quaternion rotates by the same formula in left- and right-handed frames; only the mirror differs.
    left = Pose(tuple(at), tuple(turn))
    right = Pose(tuple(at * position), tuple(np.array(left.rotation_xyzw) * quaternion))
    mirror = np.diag(position)
    np.testing.assert_allclose(right.to_world(vertices @ mirror), left.to_world(vertices) @ mirror, atol=1e-12)
    assert np.linalg.det(mirror) == -1
