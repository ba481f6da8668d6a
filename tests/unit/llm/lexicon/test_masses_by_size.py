"""Masses of objects that are larger or smaller than usual, against weights of products of that size."""

from __future__ import annotations

import pytest

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.llm.lexicon.masses import FARTHEST, usual_mass_kg
from scene2hap.llm.lexicon.table import table, text_of

ROWS = {row.noun: row for row in table()}


@pytest.mark.parametrize(
    ("name", "box_m", "real_kg"),  # data sheets and listings, from memory, written down before they were compared
    [
        ("television", (0.73, 0.48, 0.15), 4.5),  # 32 inches
        ("television", (1.67, 1.0, 0.3), 33.0),  # 75 inches
        ("table", (2.4, 0.75, 1.0), 60.0),  # for ten, of solid wood
        ("wardrobe", (2.5, 2.36, 0.6), 200.0),
        ("bookcase", (0.4, 1.06, 0.28), 14.0),
        ("mirror", (0.4, 0.4, 0.02), 2.0),
        ("speaker", (0.2, 1.0, 0.3), 18.0),  # stands on the floor
        ("radiator", (2.0, 0.6, 0.1), 66.0),  # two panels
        ("sofa", (3.2, 0.85, 2.0), 120.0),  # round a corner
        ("picture frame", (0.53, 0.73, 0.035), 2.6),  # behind glass
        ("trash can", (0.52, 0.66, 0.33), 5.0),  # of 45 l
    ],
)
def test_masses_follow_sizes(name: str, box_m: tuple[float, float, float], real_kg: float) -> None:
    item = SceneObject(name, pose=Pose((0, box_m[1] / 2, 0)), geometry=Box(box_m))
    floor = SceneObject("floor", pose=Pose((0, -0.05, 0)), geometry=Box((5, 0.1, 5)))
    found = bake(SceneSnapshot.build([item, floor])).objects[name].mass_kg
    assert found is not None
    assert real_kg / 2.01 <= found <= 2.01 * real_kg


def test_mass_is_proportional_to_the_largest_side_within_bounds() -> None:
    row = ROWS["table"]
    assert row.mass_kg is not None
    assert usual_mass_kg(row, (0.8, 0.75, 1.4)) == pytest.approx(row.mass_kg)
    assert usual_mass_kg(row, (1.2, 0.75, 1.4)) == pytest.approx(1.5 * row.mass_kg)
    assert usual_mass_kg(row, (14.0, 8.0, 7.5)) == FARTHEST * row.mass_kg
    assert usual_mass_kg(row, (0.14, 0.08, 0.075)) == row.mass_kg / FARTHEST


@pytest.mark.parametrize("whole_m", [(), (0.0, 0.0, 1.0)])
def test_an_unknown_size_leaves_the_usual_mass(whole_m: tuple[float, ...]) -> None:
    assert usual_mass_kg(ROWS["table"], whole_m) == ROWS["table"].mass_kg
    assert usual_mass_kg(ROWS["washing machine"], (2.0, 2.0, 2.0)) == ROWS["washing machine"].mass_kg


def test_usual_boxes_are_of_nouns_that_have_a_mass() -> None:
    lines = [line.split(",") for line in text_of("usual_boxes.csv").splitlines()]
    assert {len(line) for line in lines} == {4}
    nouns = [line[0] for line in lines[1:]]
    assert len(set(nouns)) == len(nouns)
    for noun, longest, middle, _ in lines[1:]:
        assert ROWS[noun].mass_kg is not None, noun
        assert 0.1 <= float(middle) <= float(longest) <= 3.0
