"""The shape of each component's answer. Units stand in the field names, bounds are checked here.

Flat, without defaults and with every field required, since strict structured output allows no more.
"""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field


class Answer(BaseModel):
    """Base of all answers: nothing missing, nothing extra."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class SceneAnswer(Answer):
    """Scene Analyzer: what kind of place this is, in one or two words, or "undefined"."""

    scene_category: str = Field(min_length=1, max_length=60)


class StateAnswer(Answer):
    """One way in which an object vibrates by itself."""

    name: str = Field(min_length=1, max_length=40)
    intensity: float = Field(gt=0.0, le=1.0)
    needs_contact: str | None


class ObjectAnswer(Answer):
    """Object Analyzer: what the object is, of what, for what, and whether it vibrates."""

    object_category: str = Field(min_length=1, max_length=60)
    category_reason: str
    material_category: str = Field(min_length=1, max_length=60)
    estimated_length_m: float = Field(ge=0.0)
    estimated_width_m: float = Field(ge=0.0)
    estimated_thickness_m: float = Field(ge=0.0)
    size_reason: str
    usage: str
    vibrates: bool
    vibration_reason: str
    states: list[StateAnswer]
    confidence: float = Field(ge=0.0, le=1.0)


class MaterialAnswer(Answer):
    """Material Property Estimator: constants of one material."""

    density_kg_m3: float = Field(ge=1.0, le=25000.0)
    youngs_modulus_gpa: float = Field(ge=1e-5, le=1300.0)
    poisson_ratio: float = Field(gt=-1.0, lt=0.5)
    loss_factor: float = Field(ge=0.0, le=2.0)


class VibrationAnswer(Answer):
    """Vibration Describer: one state in words, for making and for finding a sound."""

    sentence: str = Field(min_length=1, max_length=200)
    keywords: str = Field(min_length=1, max_length=60)
