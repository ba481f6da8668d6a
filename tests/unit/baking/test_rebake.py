"""`rebake`: user corrections are kept, and objects that are not named stay unchanged."""

import json
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    AudioClip,
    Box,
    Credit,
    FunctionBackend,
    HapticBundle,
    LLMRequest,
    Override,
    Pose,
    SceneObject,
    SceneSnapshot,
    bake,
    materials,
    rebake,
)
from scene2hap.audio.sensation import LevelWarning
from scene2hap.bundle import BundleWarning
from scene2hap.errors import BundleError, SceneError, UnknownObject
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scripted_backend import SCENE, Scripted

# Some scenes here have objects in the air.
pytestmark = [pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning"), pytest.mark.usefixtures("short_tones")]


def answering() -> FunctionBackend:
    """A backend with scripted answers that keeps its requests."""
    scripted = Scripted()

    def answer(request: LLMRequest) -> str:
        return json.dumps(getattr(scripted, request.component)(request))

    return FunctionBackend(answer)


def subjects(backend: FunctionBackend, component: str = "object_analyzer") -> list[str]:
    return sorted(request.subject for request in backend.requests if request.component == component)


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SCENE, {"llm": answering()})


def test_rebake_queries_only_the_named_objects(bundle: HapticBundle) -> None:
    backend = answering()
    again = rebake(bundle, {"llm": backend}, objects=["cup"], user_prompt="the cup is of silver")
    assert subjects(backend) == ["cup"]
    assert not subjects(backend, "scene_analyzer")
    assert all("of silver" in request.prompt for request in backend.requests)
    assert again.objects["phone"] == bundle.objects["phone"]
    assert again.loops["phone"] is bundle.loops["phone"]
    assert list(again.objects) == list(bundle.objects)


def test_vibration_can_be_added_by_override(bundle: HapticBundle) -> None:
    wished = bundle.override("cup", vibrates=True)
    assert "cup" not in wished.loops
    backend = answering()
    again = rebake(wished, {"llm": backend})
    assert subjects(backend) == ["cup"]
    assert "vibrates by itself" in backend.requests[0].prompt
    assert list(again.loops["cup"]) == ["on"]
    assert again.objects["cup"].vibrates
    assert again.objects["cup"].provenance["vibrates"] == "user"


def test_an_object_is_inferred_by_the_name_that_a_person_gives(tmp_path: Path) -> None:
    scene = SceneSnapshot.build([SceneObject("Cube.012", geometry=Box((0.6, 0.6, 0.85)))])
    unknown = bake(scene)
    assert not unknown.objects["Cube.012"].vibrates
    named = rebake(unknown.override("Cube.012", name="washing machine"))
    expected = bake(SceneSnapshot.build([SceneObject("washing machine", geometry=Box((0.6, 0.6, 0.85)))]))
    found, meant = named.objects["Cube.012"], expected.objects["washing machine"]
    assert (found.object_category, found.material, found.mass_kg, found.states) == (
        meant.object_category,
        meant.material,
        meant.mass_kg,
        meant.states,
    )
    assert named.loops["Cube.012"].keys() == expected.loops["washing machine"].keys()
    # The name is kept by a folder and by the next bake, and nothing is inferred twice.
    kept = HapticBundle.load(named.save(tmp_path / "b"))
    assert bake(scene, overrides=kept.overrides).objects == named.objects
    assert rebake(kept, {"llm": FunctionBackend(lambda request: pytest.fail("asked again"))}).objects == named.objects
    renamed = rebake(kept.override("Cube.012", name="wooden stool"))
    assert not renamed.loops
    assert renamed.objects["Cube.012"].object_category == "stool"


def test_a_name_of_which_nothing_is_known_brings_a_warning(tmp_path: Path) -> None:
    scene = SceneSnapshot.build([SceneObject("Cube.012", geometry=Box((0.6, 0.6, 0.85)))])
    named = bake(scene).override("Cube.012", name="flurbelgurk")
    known = "nothing is known of 'flurbelgurk', the name that a person gave 'Cube.012'.*as 'washing machine'"
    with pytest.warns(BundleWarning, match=known):
        again = rebake(named)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert rebake(again).objects == again.objects  # and only when it is inferred
    with pytest.warns(BundleWarning, match=known):
        bake(scene, overrides=named.overrides)


def test_a_name_of_which_nothing_is_known_does_not_silence_an_object() -> None:
    scene = SceneSnapshot.build([SceneObject("fan", geometry=Box((0.3, 0.3, 0.4)))])
    fan = bake(scene)
    known = "nothing is known of 'flurbelgurk', the name that a person gave 'fan'; the object stays as it was"
    with pytest.warns(BundleWarning, match=known):
        named = rebake(fan.override("fan", name="flurbelgurk"))
    assert (named.objects, named.loops) == (fan.objects, fan.loops)
    phone = bake(SceneSnapshot.build([SceneObject("smartphone", geometry=Box((0.3, 0.3, 0.4)))]))
    assert rebake(named.override("fan", name="smartphone")).loops["fan"] == phone.loops["smartphone"]


def test_corrections_of_states_that_a_new_name_does_not_have_bring_a_warning() -> None:
    scene = SceneSnapshot.build([SceneObject("fan", geometry=Box((0.3, 0.3, 0.4)))])
    fan = rebake(bake(scene).override("fan", intensity={"on": 0.5}))
    with pytest.warns(BundleWarning, match="'fan' has no state 'on', so that intensity has no effect. It has 'ring"):
        phone = rebake(fan.override("fan", name="smartphone"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rebake(phone.override("fan", gain_db=-1.0))


def test_an_object_whose_name_was_removed_from_the_file_is_inferred_as_before(tmp_path: Path) -> None:
    scene = SceneSnapshot.build([SceneObject("fan", geometry=Box((0.3, 0.3, 0.4)))])
    first = bake(scene)
    folder = rebake(first.override("fan", name="wooden stool")).save(tmp_path / "b")
    (folder / "overrides.json").write_text('{"fan": {"gain_db": -3.0}}')
    back = rebake(folder)
    assert back.objects == first.objects
    assert back.loops == first.loops


@pytest.mark.parametrize(
    ("name", "told"), [("", "0 characters"), ("  ", "0 characters"), (3, "name is 3"), ("x" * 201, "201 characters")]
)
def test_a_name_is_a_short_text(bundle: HapticBundle, name: Any, told: str) -> None:
    with pytest.raises(BundleError, match=told):
        bundle.override("cup", name=name)


def test_a_corrected_strength_changes_the_level_of_a_sound_but_not_the_sound() -> None:
    scene = SceneSnapshot.build([SceneObject("radio", geometry=Box((0.3, 0.2, 0.1)))])
    first = bake(scene)
    (state,) = first.loops["radio"]
    edited = first.override("radio", intensity=0.9)
    again = bake(scene, overrides=edited.overrides)
    assert again.loops["radio"][state].source.samples.tolist() == first.loops["radio"][state].source.samples.tolist()
    same = rebake(edited).loops["radio"][state]
    assert again.loops["radio"][state].tactile.samples.tolist() == same.tactile.samples.tolist()


@pytest.mark.parametrize(
    ("pitch_hz", "told"),
    [
        (60.0, r"small speaker, playing, has its pitch at 60 Hz, but is felt .*\d+ dB weaker"),
        (250.0, ""),
    ],
)
def test_a_pitch_that_music_cannot_follow_brings_a_warning(pitch_hz: float, told: str) -> None:
    room = SceneSnapshot.build([SceneObject("small speaker", geometry=Box((0.1, 0.2, 0.1)))], name="room")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rebake(bake(room).override("small speaker", pitch_hz=pitch_hz))
    doubts = [str(one.message) for one in caught if issubclass(one.category, LevelWarning)]
    assert [bool(re.match(told, doubt)) for doubt in doubts] == [True] * bool(told)


def test_user_sound_replaces_the_selected_one(bundle: HapticBundle) -> None:
    rate = 8000
    tone = np.sin(2 * np.pi * 120 * np.arange(3 * rate) / rate).astype(np.float32)
    clip = AudioClip(0.5 * tone, rate, Credit("my tone", "me", "CC0"))
    backend = answering()
    again = rebake(bundle.override("phone", clip=clip), {"llm": backend})
    assert not backend.requests
    for loop in again.loops["phone"].values():
        assert loop.audible.credit.title == "my tone"
        assert loop.frequency_raw_hz == pytest.approx(120, abs=0.5)


def test_corrections_are_kept_by_a_new_bake(tmp_path: Path) -> None:
    def baked(**more: Any) -> HapticBundle:
        return bake(SCENE, {"llm": answering()}, **more)

    first = baked().override("phone", gain_db=-6.0).override("table", material="steel")
    kept = HapticBundle.load(first.save(tmp_path / "b")).overrides
    second = baked(overrides=kept)
    assert second.gain_db("phone") == -6.0
    assert second.objects["table"].material == materials.lookup("steel")
    silent = baked(overrides={"phone": Override(vibrates=False)})
    assert not silent.loops


def test_correction_of_a_missing_object_is_dropped_with_a_warning() -> None:
    with pytest.warns(UserWarning, match="'chair' is dropped"):
        again = bake(SCENE, {"llm": answering()}, overrides={"chair": Override(gain_db=1.0)})
    assert not again.overrides


def test_rebake_refuses_an_unknown_object(bundle: HapticBundle) -> None:
    with pytest.raises(UnknownObject):
        rebake(bundle, {"llm": answering()}, objects=["chair"])


def test_rebake_passes_on_the_inference_report() -> None:
    accounts: list[Any] = []
    bake(SCENE, {"llm": answering()}, on_report=accounts.append)
    (account,) = accounts
    assert account.calls["object_analyzer"] == 3


@pytest.mark.parametrize("is_old", [False, True])
def test_the_names_of_materials_are_kept_for_rebake(tmp_path: Path, is_old: bool) -> None:
    """The name of the box says nothing; its material was read from the name of a texture. Bundles of earlier versions
    lack these names, and load."""
    looks = Appearance((FaceMaterial((0.4, 0.3, 0.1, 1.0), name="walnut"),), np.zeros(12, np.int32))
    thing = SceneObject("Object_7", pose=Pose((0, 0.3, 0)), geometry=Box((0.6, 0.6, 0.6)), appearance=looks)
    fan = SceneObject("fan", pose=Pose((1, 0.3, 0)), geometry=Box((0.4, 0.6, 0.3)))
    folder = bake(SceneSnapshot.build([thing, fan])).save(tmp_path / "room.bundle")
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    assert document["objects"][0]["material_names"] == ["walnut"]
    if is_old:
        del document["objects"][0]["material_names"]
        path.write_text(json.dumps(document))
    again = rebake(folder, objects=["Object_7"])
    assert again.objects["Object_7"].material_category == ("unknown" if is_old else "walnut")


def test_a_state_that_a_person_adds_gets_its_loop(tmp_path: Path) -> None:
    """docs/bundles.md: the lexicon's washing machine only spins. The hum of one that washes is in `test_synth`."""
    machine = SceneObject("washer", name="washing machine", geometry=Box((0.6, 0.85, 0.6)))
    folder = bake(SceneSnapshot.build([machine], name="laundry")).save(tmp_path / "b")
    answers = json.loads((folder / "objects.json").read_text())
    (spins,) = answers["washer"]["states"]
    washes = {"name": "washing", "sentence": "washing machine washing gently", "keywords": "washing machine washing"}
    answers["washer"]["states"].append({**spins, **washes, "intensity": 0.4})
    (folder / "objects.json").write_text(json.dumps(answers))
    loops = rebake(HapticBundle.load(folder)).loops["washer"]
    assert [*loops] == [spins["name"], "washing"]
    asked = [loop.audible.credit.query for loop in loops.values() if loop.audible.credit]
    assert asked == [spins["keywords"], washes["keywords"]]


def test_names_of_materials_are_given_without_looks() -> None:
    named = SceneObject("Object_7", geometry=Box((0.6, 0.6, 0.6)), material_names=["walnut"])
    fan = SceneObject("fan", pose=Pose((1, 0, 0)), geometry=Box((0.4, 0.6, 0.3)))
    assert bake(SceneSnapshot.build([named, fan])).objects["Object_7"].material_category == "walnut"
    for wrong in ("walnut", [3], None):
        with pytest.raises(SceneError, match=r"material_names of object 'Object_7'.*\['oak'\]"):
            SceneObject("Object_7", geometry=Box((1, 1, 1)), material_names=wrong)
