"""Answers of models: the shape of each component's answer, its JSON schema, and how it is found in a model's text."""

from scene2hap.llm.answers.shapes import (
    LONGEST_NAME,
    LONGEST_REASON,
    Answer,
    AnswerType,
    MaterialAnswer,
    ObjectAnswer,
    SceneAnswer,
    StateAnswer,
    VibrationAnswer,
    read_answer,
)

__all__ = [
    "LONGEST_NAME",
    "LONGEST_REASON",
    "Answer",
    "AnswerType",
    "MaterialAnswer",
    "ObjectAnswer",
    "SceneAnswer",
    "StateAnswer",
    "VibrationAnswer",
    "read_answer",
]
