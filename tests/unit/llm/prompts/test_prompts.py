"""The prompt templates, and their replacement by a user's templates."""

from pathlib import Path
from typing import get_args

import pytest

from scene2hap.errors import ConfigError
from scene2hap.llm.prompts import VERSION, Prompts, placeholders
from scene2hap.llm.prompts.quoting import IS_DATA
from scene2hap.llm.protocol import COMPONENTS, Component
from scene2hap.scene.shapes import SurfaceFlag


def test_every_template_gives_the_user_prompt_priority() -> None:
    prompts = Prompts.load()
    for component in COMPONENTS:
        assert "user_prompt" in placeholders(prompts.templates[component])
    facts = dict.fromkeys(placeholders(prompts.templates["vibration_describer"]) - {"user_prompt"}, "")
    filled = prompts.fill("vibration_describer", facts, "make it {loud}")
    assert filled.endswith("Above all, follow what the scene's author asks: make it {loud}")


def test_prompts_share_a_long_prefix_for_prompt_caching() -> None:
    template = Prompts.load().templates["object_analyzer"]
    instructions, facts = template.split("Kind of place: ")
    assert not placeholders(instructions)
    # Some 700 tokens at four characters each; services add the schema of the answer to this prefix.
    assert len(instructions) > 2400
    assert "{object_name}" in facts


def test_one_template_may_be_replaced(tmp_path: Path) -> None:
    (tmp_path / "material_estimator.txt").write_text('Constants of {material_category} as {{"x": 1}}. {user_prompt}')
    prompts = Prompts.load(tmp_path)
    assert (
        prompts.fill("material_estimator", {"material_category": "oak"})
        == f'{IS_DATA}\n\nConstants of "oak" as {{"x": 1}}.'
    )
    assert prompts.templates["scene_analyzer"] == Prompts.load().templates["scene_analyzer"]
    assert prompts.version.startswith(f"{VERSION}+")
    (tmp_path / "material_estimator.txt").write_text("{material_category}! {user_prompt}")
    assert Prompts.load(tmp_path).version != prompts.version


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("{materal_category} {user_prompt}", "names materal_category; material_estimator knows material_category"),
        ("{material_category} as {", "cannot be used"),
        ("{material_category}", "lacks {user_prompt}"),
    ],
)
def test_invalid_template_is_refused(tmp_path: Path, text: str, sentence: str) -> None:
    (tmp_path / "material_estimator.txt").write_text(text)
    with pytest.raises(ConfigError, match=sentence):
        Prompts.load(tmp_path)


def test_a_folder_without_templates_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"has no template; .*scene_analyzer\.txt"):
        Prompts.load(tmp_path)


def test_thickness_of_hollow_objects_and_bounds_are_stated() -> None:
    """A model that gave the thickness of sheets ended nearly all propagation by the paper's law."""
    templates = {name: " ".join(text.split()) for name, text in Prompts.load().templates.items()}
    assert "keep its measured thickness, never give that of its panels or sheets" in templates["object_analyzer"]
    assert "intensity above 0 and up to 1" in templates["object_analyzer"]
    assert "at most 30" in templates["vibration_describer"]
    assert "below 0.5" in templates["material_estimator"]
    for flag in get_args(SurfaceFlag):
        assert f'"{flag}"' in templates["object_analyzer"]


@pytest.mark.parametrize("component", ["scene_analyzer", "object_analyzer", "vibration_describer"])
def test_prompts_ask_for_english_words_by_which_sounds_are_found(component: Component) -> None:
    assert "English word" in Prompts.load().templates[component]
