"""Bounds on numbers that people, files and language models hand in.

One door for every "value, unit, bound, what to do" message, so that they read alike everywhere.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from numbers import Real
from typing import TYPE_CHECKING, Any, NamedTuple

from scene2hap.errors import ConfigError, Scene2HapError

if TYPE_CHECKING:
    from pydantic import ValidationError


_SECRET_NAME = re.compile(r"(key|token|secret|password)s?$", re.IGNORECASE)


def shown(value: object, name: object = "") -> str:
    """A value as an error may show it: settings whose name speaks of a key, token, secret or password are masked."""
    if isinstance(name, str) and _SECRET_NAME.search(name):
        return "'***'"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key!r}: {shown(item, key)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(shown, value)) + "]"
    return repr(value)


class Problem(NamedTuple):
    """The first thing that pydantic found wrong: where, why, and the value."""

    location: tuple[int | str, ...]
    reason: str
    value: Any

    @property
    def place(self) -> str:
        """The location with dots between its parts."""
        return ".".join(map(str, self.location))


def first_problem(error: ValidationError) -> Problem:
    """What to tell a person of a failed validation: one thing at a time, in our words where we raised it."""
    first = error.errors()[0]
    reason = first["msg"].removeprefix("Value error, ").removesuffix(".")
    return Problem(first["loc"], reason, first["input"])


def number(
    name: str,
    value: object,
    unit: str,
    *,
    above: float | None = None,
    at_least: float | None = None,
    below: float | None = None,
    at_most: float | None = None,
    error: type[Scene2HapError],
    hint: str = "",
) -> float:
    """Return `value` as a finite float inside its bounds, or raise `error` naming value, unit and bound."""
    # numpy scalars register as Real; bool is an int by accident of history and never a measurement.
    if isinstance(value, bool) or not isinstance(value, Real):
        raise error(_sentence(f"{name} is {value!r}; it must be a number{_in(unit)}", hint))
    try:
        result = float(value)
    except OverflowError:  # a whole number of more than 308 digits
        result = math.inf
    bounds = [
        (not math.isfinite(result), "finite"),
        (above is not None and result <= above, f"above {above}"),
        (at_least is not None and result < at_least, f"at least {at_least}"),
        (below is not None and result >= below, f"below {below}"),
        (at_most is not None and result > at_most, f"at most {at_most}"),
    ]
    broken = [bound for is_broken, bound in bounds if is_broken]
    if broken:
        shown = f"{result:g}{' ' + unit if unit != '-' else ''}"
        raise error(_sentence(f"{name} is {shown}; it must be {broken[0]}{_in(unit)}", hint))
    return result


def vector(
    name: str,
    value: object,
    unit: str,
    *,
    size: int,
    above: float | None = None,
    at_least: float | None = None,
    error: type[Scene2HapError],
    hint: str = "",
) -> tuple[float, ...]:
    """Return `value` as `size` finite floats, or raise `error` naming the component that is wrong."""
    items: Sequence[object]
    try:
        items = tuple(value)  # type: ignore[arg-type]  # any iterable will do; the rest is the error below
    except TypeError:
        items = ()
    if len(items) != size or isinstance(value, str):
        raise error(_sentence(f"{name} is {value!r}; it must be {size} numbers{_in(unit)}", hint))
    return tuple(
        number(f"{name}[{i}]", item, unit, above=above, at_least=at_least, error=error, hint=hint)
        for i, item in enumerate(items)
    )


def names(name: str, value: object, *, error: type[Scene2HapError] = ConfigError) -> tuple[str, ...]:
    """Distinct names, at least one, from a sequence of them. Raises: `error`: it is something else, as one string."""
    if isinstance(value, str):
        raise error(f"{name} is {shown(value)}; it must be a sequence of names, as [{shown(value)}].")
    found = tuple(value) if isinstance(value, Iterable) else ()
    if not found or not all(isinstance(x, str) and x.strip() for x in found) or len(set(found)) < len(found):
        raise error(f"{name} is {shown(value)}; it must be at least one name, each once.")
    return found


def _in(unit: str) -> str:
    return "" if unit == "-" else f" [{unit}]"


def _sentence(message: str, hint: str) -> str:
    return f"{message}. {hint}" if hint else f"{message}."
