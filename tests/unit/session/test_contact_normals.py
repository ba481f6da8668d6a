"""Contacts of an engine whose normals point the wrong way cause one warning; others cause none."""

import warnings

import pytest

from scene2hap import Box, Contact, HapticBundle, HapticSession, Pose, SceneObject, SceneSnapshot, SceneWarning, bake
from scene2hap.scene.plausibility.contact_normals import are_reversed

DOWN, UP = (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)
ON_TABLE, UNDER_PHONE = (0.3, 0.72, 0.1), (0.26, 0.72, -0.1)
SCENE = SceneSnapshot.build(
    [
        SceneObject("table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7))),
        SceneObject("mug", pose=Pose((0.3, 0.77, 0.1)), geometry=Box((0.08, 0.1, 0.08))),
        SceneObject("phone", pose=Pose((0.2, 0.724, -0.1)), geometry=Box((0.15, 0.008, 0.07))),
    ]
)
RIGHT = [Contact("mug", "table", ON_TABLE, DOWN), Contact("table", "phone", UNDER_PHONE, UP)]
WRONG = [Contact("table", "mug", ON_TABLE, DOWN), Contact("phone", "table", UNDER_PHONE, UP)]


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SCENE)


def test_reversed_normals_warn_once(bundle: HapticBundle) -> None:
    session = HapticSession(bundle)
    with pytest.warns(SceneWarning, match=r"all normals of 2 contacts.*'table' and 'mug'.*Swap a and b") as caught:
        session.update(contacts=WRONG)
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.update(contacts=WRONG)


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
@pytest.mark.parametrize(
    "contacts",
    [
        RIGHT,
        WRONG[:1],
        [RIGHT[0], WRONG[1]],
        [Contact("table", "mug", ON_TABLE), Contact("phone", "table", UNDER_PHONE)],
        [],
    ],
)
def test_other_contacts_do_not_warn(bundle: HapticBundle, contacts: list[Contact]) -> None:
    HapticSession(bundle).update(contacts=contacts)


def test_the_present_poses_count() -> None:
    objects = {item.id: item for item in SCENE.objects}
    above = {"table": Pose((0.0, 1.5, 0.0)), "mug": Pose((0.3, 1.09, 0.1)), "phone": Pose((0.2, 1.136, -0.1))}
    under = [Contact("table", "mug", (0.3, 1.14, 0.1), DOWN), Contact("phone", "table", (0.26, 1.14, -0.1), UP)]
    assert are_reversed(under, objects, above.__getitem__) is False
    assert are_reversed(WRONG, objects, lambda object_id: objects[object_id].pose) is True
    assert are_reversed(WRONG[:1], objects, lambda object_id: objects[object_id].pose) is None
