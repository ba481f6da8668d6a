"""Settings of a bake."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, field_validator

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.protocol import AudioSource, TactileConverter
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.chain import ENOUGH
from scene2hap.audio.spreading import SpreadLimits
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.common.settings import cache_folder
from scene2hap.haptics import ActuatorProfile
from scene2hap.llm.chain.config import InferenceConfig
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.wrappers import build_backend

_Sounds = AudioSource | Mapping[str, Any] | str


def _sources(specs: object) -> object:
    return tuple(SOURCES.build(spec) for spec in specs) if isinstance(specs, list | tuple) else (SOURCES.build(specs),)


class BakeConfig(InferenceConfig):
    """Settings of a bake, from Python or a TOML or JSON file. A `kind` chooses each exchangeable part.

    llm : the backend of inference; `InferenceConfig` has the settings of inference itself. A backend with a network
        address gets retries, repairs and a cache (`standard_stack`), unless it is given ready made.
    cache_dir : folder of stored answers, None for the user's cache folder.
    max_cost_usd : limit on the cost of the answers, checked before each call; None for no limit.
    prices : of models, in US dollars per million tokens read and written (and read from the service's prompt cache),
        in addition to the dated list.
    audio : sound sources, tried in order until `enough_candidates` remain.
    enough_candidates : number of sounds to choose from, 1..5; 1 is the paper's rule.
    tactile : the converter of sound into vibration.
    actuator : the actuator that plays the vibration, by name, CSV file or fields.
    spread : how far a source may be moved in frequency and level to be distinct from the others.
    seed : for all synthesized sounds.
    """

    of_what = "bake"

    cache_dir: Path | None = None
    max_cost_usd: float | None = Field(default=None, ge=0.0)
    prices: dict[str, tuple[float, float] | tuple[float, float, float]] = Field(default_factory=dict)
    llm: Any = Field(default="lexicon", validate_default=True)
    audio: Annotated[Any, BeforeValidator(_sources)] = Field(default="synth", validate_default=True)
    enough_candidates: int = Field(default=ENOUGH, ge=1, le=5)
    tactile: Annotated[Any, BeforeValidator(CONVERTERS.build)] = Field(default=DEFAULT_CONVERTER, validate_default=True)
    actuator: Annotated[ActuatorProfile, BeforeValidator(actuator_profile)] = Field(default_factory=ActuatorProfile)
    spread: SpreadLimits = Field(default_factory=SpreadLimits)
    seed: int = 0

    if TYPE_CHECKING:
        # Type checkers do not know which other forms the validators accept.
        def __init__(
            self,
            *,
            concurrency: int = 8,
            inference: Literal["eager", "lazy"] = "eager",
            materials: Literal["model", "table"] = "model",
            share_copies: bool = True,
            share_scenes: bool = False,
            temperature: float = 0.2,
            prompts: str | os.PathLike[str] | None = None,
            cache_dir: str | os.PathLike[str] | None = None,
            max_cost_usd: float | None = None,
            prices: Mapping[str, tuple[float, float] | tuple[float, float, float]] = ...,
            llm: LLMBackend | Mapping[str, Any] | str = "lexicon",
            audio: _Sounds | Sequence[_Sounds] = "synth",
            enough_candidates: int = ENOUGH,
            tactile: TactileConverter | Mapping[str, Any] | str = DEFAULT_CONVERTER,
            actuator: ActuatorProfile | str | Path | Mapping[str, Any] = ...,
            spread: SpreadLimits | Mapping[str, float] = ...,
            seed: int = 0,
        ) -> None: ...

    @field_validator("llm", mode="before")
    @classmethod
    def _in_its_stack(cls, spec: object, info: ValidationInfo) -> object:
        # The class defines folder, limit and prices before the backend, so they are validated by now.
        folder = info.data.get("cache_dir") or cache_folder("llm")
        limits = {"max_cost": info.data.get("max_cost_usd"), "prices": info.data.get("prices")}
        return build_backend(spec, folder, **limits)
