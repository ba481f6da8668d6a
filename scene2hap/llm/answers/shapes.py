"""The schema of each component's answer. Field names carry units, and bounds are checked here.

Strict structured output needs flat schemas in which every field is required. Fields of later versions have defaults, so
that older answers stay valid. Types are strict: "2700 kg/m^3" is no number and `true` is not 1.
Class docstrings are sent to models as part of the schema, so a change of one changes the keys of cached answers.
"""

from __future__ import annotations

import json
import re
from typing import Annotated, ClassVar, Self, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from scene2hap.common.json_texts import RepeatedKey, parse_json
from scene2hap.haptics import LONGEST_TURN_S

MOST_WORDS_IN_SENTENCE = 15
"""Bounds of the paper, section "Vibration Describer"."""
_WORDS_OVER = 5
"""Words beyond this bound that are accepted, since models count badly and a longer sentence does no harm."""
LONGEST_NAME, LONGEST_REASON = 60, 600
"""Most characters of a category or of keywords, and of a reason."""

_VIBRATE = re.compile(r"vibrat", re.IGNORECASE)


def _at_most(n_words: int) -> AfterValidator:
    def check(text: str) -> str:
        if len(text.split()) > n_words:
            raise ValueError(f"{len(text.split())} words; at most {n_words} are allowed")
        return text

    return AfterValidator(check)


def _without_vibrate(text: str) -> str:
    if _VIBRATE.search(text):
        raise ValueError('the word "vibrate" finds recordings of toys and alarms; name the movement or the sound')
    return text


class Answer(BaseModel):
    """Base of all answers: nothing missing, nothing extra. `read_answer` leaves out what is extra."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, strict=True)


class SceneAnswer(Answer):
    """Scene Analyzer: what kind of place this is, in one or two words, or "undefined"."""

    # Accept one word more than the prompt allows, here and for objects: a repeated question costs more than it gains.
    scene_category: Annotated[str, _at_most(3)] = Field(min_length=1, max_length=LONGEST_NAME)


class StateAnswer(Answer):
    """One way in which an object vibrates by itself."""

    name: str = Field(min_length=1, max_length=40)
    intensity: float = Field(ge=0.0, le=1.0)
    needs_contact: str | None


class ObjectAnswer(Answer):
    """Object Analyzer: what the object is, of what, for what, and whether it vibrates."""

    object_category: Annotated[str, _at_most(4)] = Field(min_length=1, max_length=LONGEST_NAME)
    category_reason: str = Field(max_length=LONGEST_REASON)
    material_category: str = Field(min_length=1, max_length=LONGEST_NAME)
    estimated_length_m: float = Field(ge=0.0, le=1e5)
    estimated_width_m: float = Field(ge=0.0, le=1e5)
    estimated_thickness_m: float = Field(ge=0.0, le=1e5)
    size_reason: str = Field(max_length=LONGEST_REASON)
    usage: str = Field(max_length=LONGEST_REASON)
    vibrates: bool
    vibration_reason: str = Field(max_length=LONGEST_REASON)
    states: list[StateAnswer]
    confidence: float = Field(ge=0.0, le=1.0)
    estimated_mass_kg: float | None = Field(default=None, gt=0.0, le=1e7)
    feet_material: str | None = Field(default=None, max_length=LONGEST_NAME)

    @field_validator("states")
    @classmethod
    def _without_still(cls, states: list[StateAnswer]) -> list[StateAnswer]:
        # Many models list "off" as a state, with intensity 0.
        return [state for state in states if state.intensity > 0.0]

    @model_validator(mode="after")
    def _states_fit(self) -> Self:
        if self.vibrates and not self.states:
            raise ValueError("vibrates is true but no state has an intensity above 0; name one, or say false")
        names = [state.name.strip().lower() for state in self.states]
        if len(set(names)) < len(names):
            raise ValueError(f"states {names} repeat a name; each state needs its own")
        return self


class MaterialAnswer(Answer):
    """Material Property Estimator: constants of one material."""

    density_kg_m3: float = Field(ge=1.0, le=25000.0)
    youngs_modulus_gpa: float = Field(ge=1e-5, le=1300.0)
    poisson_ratio: float = Field(gt=-1.0, lt=0.5)
    damping_ratio: float = Field(ge=0.0, le=1.0)

    @property
    def loss_factor(self) -> float:
        """eta = 2 zeta [-]."""
        return 2.0 * self.damping_ratio


class VibrationAnswer(Answer):
    """Vibration Describer: one state in words, for making and for finding a sound, and how it starts and stops."""

    sentence: Annotated[str, _at_most(MOST_WORDS_IN_SENTENCE + _WORDS_OVER)] = Field(min_length=1, max_length=200)
    keywords: Annotated[str, _at_most(6), AfterValidator(_without_vibrate)] = Field(
        min_length=1, max_length=LONGEST_NAME
    )
    # A kettle takes minutes to boil. Times above LONGEST_PASSAGE_S are limited to it (`chain`).
    start_up_s: float | None = Field(default=None, ge=0.0, le=LONGEST_TURN_S)
    wind_down_s: float | None = Field(default=None, ge=0.0, le=LONGEST_TURN_S)
    spins: bool | None = None
    on_s: float | None = Field(default=None, ge=0.1, le=LONGEST_TURN_S)
    off_s: float | None = Field(default=None, ge=0.1, le=LONGEST_TURN_S)

    @model_validator(mode="after")
    def _both_turns(self) -> Self:
        if (self.on_s is None) != (self.off_s is None):
            raise ValueError("on_s and off_s belong together; give both, or null for both")
        return self


AnswerType = TypeVar("AnswerType", bound=Answer)


def read_answer(shape: type[AnswerType], text: str) -> AnswerType:
    """Read an answer from its JSON. Fields that it should not have are left out, since they do no harm.

    Models add comments and sources where no server enforces the schema, and would add them again after a repair.
    Raises: pydantic.ValidationError: a field is missing, wrong, or given twice.
    """
    _require_each_key_once(shape, text)
    try:
        return shape.model_validate_json(text)
    except ValidationError as error:
        extra = [problem["loc"] for problem in error.errors(include_url=False) if problem["type"] == "extra_forbidden"]
        if not extra:
            raise
    fields = json.loads(text)
    for *path, name in extra:
        owner = fields
        for step in path:
            owner = owner[step]
        del owner[name]
    return shape.model_validate_json(json.dumps(fields))


def _require_each_key_once(shape: type[Answer], text: str) -> None:
    """Raise a ValidationError if an object has a key twice. The repair then sends the question again."""
    try:
        parse_json(text)
    except RepeatedKey as found:
        problem = PydanticCustomError("given_twice", "the field is given twice; give it once")
        details = InitErrorDetails(type=problem, loc=(found.key,), input=None)
        raise ValidationError.from_exception_data(shape.__name__, [details]) from None
    except ValueError:
        pass  # pydantic names the mistake
