"""Settings of an inference."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from scene2hap.common.settings import Settings


class InferenceConfig(Settings):
    """Settings of an inference: concurrency, and calls that can be saved.

    concurrency : most calls at the same time.
    inference : "eager" requests every material. "lazy" requests only the materials of objects that some source can
        reach over the present contacts. An object carried to a source later has the table's material, or none.
    materials : "model" asks the backend for the constants of a material. "table" looks them up first and asks only for
        materials that the table lacks.
    share_copies : analyse objects of equal mesh, look and support once.
    share_scenes : ask about an object without its neighbours, height and surroundings. Equal objects of different
        scenes then give equal questions, so a cache needs one answer. Objects are equal if mesh, looks, words of the
        name, names of materials and kind of place are equal.
    temperature : of the backend's answers, 0..2; 0.2 as in the paper, section "LLM Workflow".
    prompts : folder with your own templates, by component. Built-in templates replace missing ones.
    """

    of_what = "inference"

    concurrency: int = Field(default=8, ge=1)
    inference: Literal["eager", "lazy"] = "eager"
    materials: Literal["model", "table"] = "model"
    share_copies: bool = True
    share_scenes: bool = False
    temperature: float = Field(default=0.2, ge=0.0, le=2.0)
    prompts: Path | None = None
