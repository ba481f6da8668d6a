"""Missing attributes of public classes raise an error of the library; pickling, copying and protocols still work."""

import copy
import dataclasses
import pickle
from typing import Any, Protocol, runtime_checkable

import pytest

import scene2hap
from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot
from scene2hap.bundle.by_name import ByName
from scene2hap.common.calls import clear_attributes
from scene2hap.errors import CallError, ReadOnlyAttribute, Scene2HapError, UnknownAttribute, UnknownObject

CLASSES = [
    one
    for one in (getattr(scene2hap, name) for name in scene2hap.__all__)
    if isinstance(one, type) and not getattr(one, "_is_protocol", False) and not issubclass(one, Exception)
]


def unmade(cls: type) -> Any:
    """An instance made without its constructor."""
    return cls.__new__(cls)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_public_class_reports_unknown_attributes(cls: type) -> None:
    thing = unmade(cls)
    with pytest.raises(UnknownAttribute, match="has no attribute 'no_such_thing'"):
        _ = thing.no_such_thing
    assert not hasattr(thing, "no_such_thing")
    assert not hasattr(thing, "__no_such_protocol__")
    assert getattr(thing, "no_such_thing", 3) == 3


def test_error_names_the_nearest_attribute() -> None:
    scene = SceneSnapshot.build([SceneObject("mug", geometry=Box((0.1, 0.1, 0.1)))])
    with pytest.raises(UnknownAttribute, match=r"SceneSnapshot has no attribute 'objetcs'. Did you mean 'objects'"):
        _ = scene.objetcs
    with pytest.raises(UnknownAttribute, match="HapticSession"):
        _ = scene2hap.HapticSesion
    with pytest.raises(UnknownAttribute, match="There are .*position_m.*rotation_xyzw"):
        _ = Pose().scale


def test_frozen_data_and_sessions_refuse_attribute_assignment() -> None:
    mug = SceneObject("mug", geometry=Box((0.1, 0.1, 0.1)))
    with pytest.raises(ReadOnlyAttribute, match=r"dataclasses.replace\(..., pose=...\)"):
        mug.pose = Pose((1, 2, 3))
    with pytest.raises(dataclasses.FrozenInstanceError):
        mug.pose = Pose((1, 2, 3))
    session = unmade(HapticSession)
    with pytest.raises(UnknownAttribute, match="gain_db"):
        session.gain_db = -6
    with pytest.raises(ReadOnlyAttribute, match="hands of a HapticSession cannot be set"):
        session.hands = ("left",)


def test_indexing_error_lists_the_attributes() -> None:
    with pytest.raises(CallError, match="a Pose has no items.*position_m"):
        Pose()[0]
    with pytest.raises(TypeError):
        list(Pose())


def test_copies_and_pickles_are_equal() -> None:
    scene = SceneSnapshot.build([SceneObject("mug", geometry=Box((0.1, 0.1, 0.1)))])
    for again in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert again == scene
        assert again.object("mug") == scene.object("mug")


def test_the_error_can_be_pickled() -> None:
    with pytest.raises(UnknownAttribute) as caught:
        _ = Pose().positon_m
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


@runtime_checkable
class _Speaks(Protocol):
    def speak(self) -> str: ...


@clear_attributes
class _Broken:
    @property
    def depth(self) -> int:
        return self.nothing  # the mistake is inside


def test_failing_property_raises_its_own_error() -> None:
    with pytest.raises(UnknownAttribute, match="'nothing'"):
        _ = _Broken().depth
    assert not isinstance(_Broken(), _Speaks)


def test_bundle_mapping_error_names_the_nearest_key() -> None:
    objects = ByName({"phone": 1, "mug": 2}, "object")
    with pytest.raises(UnknownObject, match="the bundle has no object 'phon'. Did you mean 'phone'") as caught:
        objects["phon"]
    assert isinstance(caught.value, KeyError)
    assert isinstance(caught.value, Scene2HapError)
    assert objects.get("phon") is None
    assert "phon" not in objects
    for again in (copy.deepcopy(objects), pickle.loads(pickle.dumps(objects)), objects):
        assert again == {"phone": 1, "mug": 2}
        with pytest.raises(UnknownObject, match="object"):
            again[3]


def test_arrays_of_data_that_never_change_are_read_only() -> None:
    item = SceneObject("cup", geometry=Box((0.1, 0.2, 0.3)))
    mesh = item.geometry.mesh
    modes = scene2hap.plate_modes(scene2hap.Plate(1.0, 0.5, 0.02, "oak"), 4)
    arrays = [item.pose.rotation, item.bounds_m, mesh.bounds_m, mesh.vertices_m, mesh.faces, modes.frequencies_hz]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array *= 2
    again = scene2hap.plate_modes(scene2hap.Plate(1.0, 0.5, 0.02, "oak"), 4)
    assert again.frequencies_hz[-1] > 0


@pytest.mark.parametrize("n_objects", [1, 40])
def test_large_data_are_shown_in_a_line(n_objects: int) -> None:
    items = [SceneObject(f"cup {i}", pose=Pose((i, 0, 0)), geometry=Box((0.1, 0.2, 0.3))) for i in range(n_objects)]
    scene = SceneSnapshot.build(items, name="shelf")
    bundle = scene2hap.HapticBundle(scene, "kitchen", {}, {})
    clip = scene2hap.AudioClip([0.0] * 24_000, 48_000)
    table = scene2hap.PoseTable([item.id for item in items], [(0, 0, 0)] * n_objects, [(0, 0, 0, 1)] * n_objects)
    modes = scene2hap.plate_modes(scene2hap.Plate(1.0, 0.5, 0.02, "oak"), n_objects)
    count = "1 object" if n_objects == 1 else "40 objects"
    assert repr(scene) == f"SceneSnapshot('shelf', {count}, y up)"
    assert repr(bundle) == f"HapticBundle('shelf', {count}, 0 sources)"
    assert repr(clip) == "AudioClip('untitled', 0.5 s, 48000 Hz)"
    assert repr(table) == f"PoseTable({count.replace('object', 'pose')})"
    assert repr(modes).startswith(f"PlateModes({count.replace('object', 'mode')}, 0 to ")
    thing = scene2hap.ObjectHaptics("unknown", "unknown", None, (0.3, 0.2, 0.1), "", vibrates=False)
    one_unknown = scene2hap.HapticBundle(scene, "kitchen", {"cup 0": thing}, {})
    assert repr(one_unknown) == f"HapticBundle('shelf', {count}, 0 sources, 1 unknown)"
    assert repr(HapticSession(scene, bundle)) == f"HapticSession({count}, 0 sources, hands left, right)"
