"""Validation of answers: types and bounds, then measured sizes, possible masses and published material constants.

`faults` states in words what a model should correct. `sizes`, `masses` and `materials` replace what stays wrong.
"""

from scene2hap.llm.validation.faults import ANSWERS, Fault, find_fault

__all__ = ["ANSWERS", "Fault", "find_fault"]
