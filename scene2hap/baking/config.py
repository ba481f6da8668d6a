"""Settings of a bake."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationInfo, field_validator

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.chain import ENOUGH
from scene2hap.audio.spreading import SpreadLimits
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.haptics import ActuatorProfile
from scene2hap.llm.config import InferenceConfig
from scene2hap.llm.wrappers import build_backend
from scene2hap.settings import cache_folder


def _sources(specs: object) -> object:
    return tuple(SOURCES.build(spec) for spec in specs) if isinstance(specs, list | tuple) else (SOURCES.build(specs),)


class BakeConfig(InferenceConfig):
    """Settings of a bake. Every part is chosen by a `kind`, or given ready made.

    llm : the backend of inference, whose course the settings of `InferenceConfig` decide. One that is reached over a
        network gets retries, repairs and a cache around it (`standard_stack`), unless it is given ready made.
    cache_dir : where its answers are kept, None for the user's folder of caches.
    max_cost_usd : what the answers may cost, checked before each call, None for no limit.
    prices : of models, in US dollars per million tokens read and written (and read from the service's prompt cache),
        beside the dated list.
    audio : where sounds come from, tried in order until `enough_candidates` remain.
    enough_candidates : how many sounds to choose from; 1 is the paper's rule.
    tactile : what turns sound into touch.
    actuator : what it is turned for, by name, CSV file or fields.
    spread : how far a source may be moved in frequency and level to be distinct from the others.
    seed : of everything that is synthesized.
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

    @field_validator("llm", mode="before")
    @classmethod
    def _in_its_stack(cls, spec: object, info: ValidationInfo) -> object:
        # Folder, limit and prices stand before the backend in the class, so they are known here.
        folder = info.data.get("cache_dir") or cache_folder("llm")
        limits = {"max_cost": info.data.get("max_cost_usd"), "prices": info.data.get("prices")}
        return build_backend(spec, folder, **limits)
