"""Settings of an inference."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from scene2hap.settings import Settings


class InferenceConfig(Settings):
    """Settings of an inference: concurrency, and calls that may be saved.

    concurrency : calls in flight at once.
    inference : "eager" asks for every material; "lazy" only for those of objects that some source can reach over the
        contacts of the scene as it stands. What is then carried next to a source has the table's material, or none.
    materials : "model" asks the backend for the constants of a material; "table" looks them up first and asks for what
        the table does not have.
    share_copies : objects of one mesh and look that stand on the same are analysed once.
    share_scenes : ask about an object without its neighbours, height and surroundings, so that equal objects of
        different scenes make one question, which a cache answers once. Equal are mesh, looks, words of the name, names
        of materials and kind of place.
    temperature : of the backend's answers, 0..2; 0.2 as in the paper, section "LLM Workflow".
    prompts : folder with templates of your own, by component; those it lacks are the built-in ones.
    """

    of_what = "inference"

    concurrency: int = Field(default=8, ge=1)
    inference: Literal["eager", "lazy"] = "eager"
    materials: Literal["model", "table"] = "model"
    share_copies: bool = True
    share_scenes: bool = False
    temperature: float = Field(default=0.2, ge=0.0, le=2.0)
    prompts: Path | None = None
