"""Types of numbers and flags in JSON, where pydantic would also take true for 1, "1" for 1, and "no" for false."""

from __future__ import annotations

from numbers import Real as AnyReal
from typing import Annotated, Literal

from pydantic import BeforeValidator, Strict
from pydantic_core import PydanticCustomError


def _number(value: object) -> object:
    # NumPy's numbers are for callers in Python. The first test alone takes a tenth of the time.
    if type(value) is float or (isinstance(value, AnyReal) and not isinstance(value, bool)):
        return value
    raise PydanticCustomError("float_type", "it is no number")


def _whole(value: object) -> object:
    if isinstance(value, AnyReal) and not isinstance(value, bool):
        return value
    raise PydanticCustomError("int_type", "it is no number")


def _flag(value: object) -> object:
    if isinstance(value, bool):
        return value
    raise PydanticCustomError("bool_type", "it is neither true nor false")


WHOLE = BeforeValidator(_whole)
"""For types with bounds of their own; pydantic's JSON schema has those bounds that stand before it."""
Real = Annotated[float, BeforeValidator(_number)]
"""A number."""
Whole = Annotated[int, WHOLE]
"""A whole number. Some languages write 7 as 7.0."""
Flag = Annotated[bool, Strict()]
"""True or false."""
Yes = Annotated[Literal[True], BeforeValidator(_flag)]
"""True: Literal alone takes 1 for it, since they are equal."""
VersionOne = Annotated[Literal[1], WHOLE]
"""1: Literal alone takes true for it."""


def is_version(value: object, wanted: int) -> bool:
    """Return True if `value` is this number, also as 1.0. In Python, true equals 1."""
    return value == wanted and not isinstance(value, bool)
