"""The words by which authors call their objects, and the sounds that are found by them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from own_sounds import RATE_HZ
from scene2hap import Box, HapticBundle, Pose, SceneObject, SceneSnapshot, bake, rebake
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.encoding import encoded
from scene2hap.audio.sources.chain import SourceWarning
from scene2hap.audio.sources.library import FolderLibrary
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.own_words import own_word
from scene2hap.errors import AudioError
from scene2hap.haptics import VibrationDescription


@pytest.mark.parametrize(
    ("name", "category", "word"),
    [
        ("windmill", "turbine", "windmill"),
        ("SM_Windmill_02(Clone)", "turbine", "windmill"),
        # A model answers in its own words.
        ("SM_Windmill_02", "wind turbine", "windmill"),
        ("ringing_phone", "mobile phone", "phone"),
        ("mill", "milling machine", "mill"),
        ("Kühlschrank_2", "refrigerator", "Kühlschrank"),
        ("zorgon_07", "alien machine", "zorgon"),
        ("SM_Zorgon_A(Clone)", "alien machine", "Zorgon"),
        ("風車_2", "turbine", "風車"),
        # The model sees another object than the lexicon reads.
        ("fridge_door", "refrigerator", "fridge door"),
        # Words that say no more than the category.
        ("Fridge_01", "refrigerator", ""),
        ("chain saw", "chainsaw", ""),
        ("Machine_3", "vending machine", ""),
        ("Running_Washer", "Washing Machine", ""),
        ("Object_12", "refrigerator", ""),
        ("Cube.003", "fan", ""),
        ("Box_01", "fan", ""),
        ("SM_Box_Wooden_02", "fan", ""),
        # States, colours, materials, places and sides, which many objects have.
        ("Running_01", "fan", ""),
        ("Buzz_02", "fan", ""),
        ("Humming_Left_Metal", "fan", ""),
        ("Red_02", "fan", ""),
        ("Kitchen_03", "fan", ""),
        ("VibratingObject", "fan", ""),
        ("Boom_Box", "radio", "Boom Box"),
        ("Running_Zorgon", "fan", "Running Zorgon"),
        ("123", "fan", ""),
        ("", "fan", ""),
    ],
)
def test_own_word_of_a_name(name: str, category: str, word: str) -> None:
    assert own_word(name, category) == word


def _scene(**names: str) -> SceneSnapshot:
    boxes = [
        SceneObject(key, name, Pose((2.0 * i, 0.5, 0.0)), Box((1.0, 1.0, 1.0)))
        for i, (key, name) in enumerate(names.items())
    ]
    return SceneSnapshot.build(boxes, name="yard")


def _titles(bundle: HapticBundle) -> dict[str, str]:
    return {key: loop.audible.credit.title for key, states in bundle.loops.items() for loop in states.values()}


def test_an_object_has_the_sound_of_its_authors_word(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    for name in ("windmill", "wind turbine", "bonfire"):
        (tmp_path / f"{name}.wav").write_bytes(encoded(0.1 * rng.standard_normal(4 * RATE_HZ), RATE_HZ))
    config = {"audio": [{"kind": "library", "folder": str(tmp_path)}, {"kind": "synth"}]}
    bundle = bake(_scene(a="SM_Windmill_02", b="Turbine_01", c="radio"), config)
    titles = _titles(bundle)
    assert (titles["a"], titles["b"]) == ("windmill", "wind turbine")
    # A name that a person gives counts as well.
    renamed = rebake(bundle.override("c", name="bonfire"), config)
    assert _titles(renamed)["c"] == "bonfire"


def test_an_object_has_the_sound_of_its_whole_name(tmp_path: Path) -> None:
    """Although another sound of its type is steadier."""
    noise = 0.1 * np.random.default_rng(0).standard_normal(4 * RATE_HZ)
    hum = 0.1 * np.sin(2 * np.pi * 100.0 * np.arange(4 * RATE_HZ) / RATE_HZ)
    for name, samples in (("Fan_02", noise), ("fan_03", noise), ("fan", hum)):
        (tmp_path / f"{name}.wav").write_bytes(encoded(samples, RATE_HZ))
    config = {"audio": [{"kind": "library", "folder": str(tmp_path)}]}
    bundle = bake(_scene(a="fan_02", b="fan_04", c="fan_05"), config)
    assert _titles(bundle) == {"a": "Fan_02", "b": "fan", "c": "fan"}


class _Failing(FolderLibrary):
    """A plug-in whose folder is gone, or which has other `names` than a library."""

    names: Any = ("Fan_02",)

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        raise AudioError(f"gone, with {description.name or 'no name'}")


def test_a_source_whose_names_fail_is_skipped_as_if_it_had_none(tmp_path: Path) -> None:
    (tmp_path / "sounds").mkdir()
    library = FolderLibrary(tmp_path / "sounds")
    (tmp_path / "sounds").rmdir()
    config = BakeConfig(audio=(_Failing(tmp_path), library, Synthesizer()))
    with pytest.warns(SourceWarning) as warned:
        bundle = bake(_scene(a="Fan_02"), config)
    assert _titles(bundle) == {"a": "fan (fan), take 1"}
    told = [str(one.message) for one in warned]
    assert len(told) == 2
    assert "gone, with no name" in told[0]
    assert "is not a folder" in told[1]
    # Loops that are kept need no source.
    assert _titles(rebake(bundle, config)) == _titles(bundle)


def test_other_words_for_one_type_share_its_sound() -> None:
    loops = bake(_scene(a="windmill", b="turbine", c="windmill_2")).loops
    assert loops["a"]["on"].tactile is loops["b"]["on"].tactile is loops["c"]["on"].tactile
