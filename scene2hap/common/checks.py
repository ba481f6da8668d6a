"""Checks of values from users, files and language models.

Every message with value, unit, bound and next step is made here, so that all have the same form.
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from contextvars import ContextVar
from itertools import islice
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

from scene2hap.errors import ConfigError, Scene2HapError

if TYPE_CHECKING:
    from pydantic import ValidationError


Kind = TypeVar("Kind")

MASK = "******"
"""Text in place of a key."""
SECRET_NAME = re.compile(r"(key|token|secret|password|credential)s?$", re.IGNORECASE)
"""Names of settings and environment variables whose values may be keys."""
_SECRET_PART = re.compile(r"(://)[^/@\s'\"]+(?=@)|(://[^?\s'\"]*\?)[^\s'\"]+|\bsk-[\w-]{16,}")


def shown(value: object, name: object = "") -> str:
    """Format a value for an error message as `represented`; settings named as in `SECRET_NAME` are masked, too."""
    if isinstance(name, str) and SECRET_NAME.search(name):
        return repr(MASK)
    if isinstance(value, Mapping):
        return _cut("{" + ", ".join(f"{represented(key)}: {shown(item, key)}" for key, item in value.items()) + "}")
    if isinstance(value, list | tuple):
        return _cut("[" + ", ".join(map(shown, value)) + "]")
    return represented(value)


_speaks_json: ContextVar[bool] = ContextVar("speaks_json", default=False)


def speak_json() -> None:
    """Write values in the messages of this task or thread as JSON: a client that sent null knows no None.

    Texts keep the quotes of the sentences around them.
    """
    _speaks_json.set(True)


_LONGEST_SHOWN = 200
_LONGEST_CONTAINER_SHOWN = 1000


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_CONTAINER_SHOWN else f"{text[:_LONGEST_CONTAINER_SHOWN]}..."


def represented(value: object) -> str:
    """Format `repr(value)`, or JSON, for an error message: shortened, or only the type if `repr` fails.

    Credentials and queries of addresses are masked, and keys of OpenAI, since a key may be given in a wrong place.
    """
    try:
        text = _in_json(value) if _speaks_json.get() and not isinstance(value, str) else repr(value)
    except Exception:  # an integer of more than 4300 digits, or any error from a foreign `__repr__`
        return f"a {type(value).__name__}"
    if "\n" in text:  # an array
        text = " ".join(text.split())
    if text.startswith("<") and " at 0x" in text:  # the address is useless, and differs in each run
        return described(value)
    text = text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."
    # Only a short text is searched: the time grows with the square of the addresses in it.
    return _SECRET_PART.sub(lambda found: f"{found[1] or found[2] or ''}{MASK}", text)


def _in_json(value: object) -> str:
    try:
        return json.dumps(value, ensure_ascii=False)
    except TypeError:  # a value of our own
        return repr(value)


def described(value: object) -> str:
    """Describe a value of the wrong type, for the sentence "X is ...". Objects with fields are named by their type."""
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if value is None or isinstance(value, str | bytes | bool | Real | os.PathLike):
        return represented(value)
    name = type(value).__name__
    if isinstance(value, dict) or (isinstance(value, tuple) and not hasattr(value, "_fields")):  # and their subclasses
        name = ("object" if _speaks_json.get() else "dict") if isinstance(value, dict) else "tuple"
    return f"{'an' if name[0] in 'aeiouAEIOU' else 'a'} {name}"


_MOST_COMPARED = 10_000
_LONGEST_COMPARED = 256
"""Most names, and characters of each, that are searched for similar ones; assumed: a hundred times typical sizes."""


def did_you_mean(wanted: object, known: Iterable[str], otherwise: str = "") -> str:
    """Return a sentence with the known names that are most similar to `wanted`, or `otherwise` if there are none.

    Case, blanks, dashes and underscores are ignored, and a common beginning counts as similar, as does a part of a
    name. So "ModalPlate" finds "modal_plate", "gain" finds "gain_db", and "fan" finds "handheld_fan".
    """
    from difflib import get_close_matches

    spelled: dict[str, str] = {}
    for one in islice(known, _MOST_COMPARED):
        spelled.setdefault(_folded(one), one)
    name = _folded(wanted) if isinstance(wanted, str) else ""
    begun = [key for key in spelled if min(len(name), len(key)) >= 3 and (key.startswith(name) or name.startswith(key))]
    parts = [key for key in spelled if len(name) >= 3 and name in key]
    alike = dict.fromkeys([*get_close_matches(name, spelled, n=3), *begun, *parts])
    near = [name] if name in spelled else list(alike)[:3]
    return f"Did you mean {' or '.join(repr(spelled[key]) for key in near)}?" if near else otherwise


class Problem(NamedTuple):
    """The first problem that pydantic found: location, reason, value, and pydantic's name for the problem.

    is_own is True if the reason is an error of this library, which states the value.
    """

    location: tuple[int | str, ...]
    reason: str
    value: Any
    kind: str
    is_own: bool

    @property
    def place(self) -> str:
        """The location with dots between its parts."""
        return ".".join(map(str, self.location))


_REASONS = {
    "missing": "it is missing",
    "extra_forbidden": "there is no such field",
    "string_type": "it must be a text",
    "string_unicode": "it must be a text of Unicode",
    "string_too_short": "it must have more characters, at least {min_length}",
    "string_too_long": "it must have fewer characters, at most {max_length}",
    "path_type": "it must be a path, as a text or a pathlib.Path",
    "bool_type": "it must be true or false",
    "bool_parsing": "it must be true or false",
    "int_type": "it must be a whole number",
    "int_parsing": "it must be a whole number",
    "int_from_float": "it must be a whole number",
    "int_parsing_size": "it is too large",
    "float_type": "it must be a number, as 0.5",
    "float_parsing": "it must be a number, as 0.5",
    "finite_number": "it must be finite",
    "list_type": "it must be a list",
    "tuple_type": "it must be a list",
    "dict_type": "it must be an object of names and values",
    "model_type": "it must be an object of names and values",
    "dataclass_type": "it must be an object of names and values",
    "literal_error": "it must be {expected}",
    "greater_than": "it must be above {gt}",
    "greater_than_equal": "it must be at least {ge}",
    "less_than": "it must be below {lt}",
    "less_than_equal": "it must be at most {le}",
    "too_short": "it must have more items, at least {min_length}",
    "too_long": "it must have at most {max_length} items",
}
"""Reasons for pydantic's kinds of problems. Its own sentences speak of Python's types."""
_MEMBER_OF_UNION = re.compile(r"tuple\[[\w, .]+\]")
"""A part of a location that names a type, as of prices, which have two or three numbers."""


def first_problem(error: ValidationError) -> Problem:
    """Return the first problem of a failed validation, in our own words where there are any."""
    first = error.errors()[0]
    context = first.get("ctx", {})
    if first["type"] in _REASONS:
        reason = _REASONS[first["type"]].format(**context)
    else:
        reason = first["msg"].removeprefix("Value error, ").removesuffix(".")
    is_own = isinstance(context.get("error"), Scene2HapError)
    location = tuple(part for part in first["loc"] if not _MEMBER_OF_UNION.fullmatch(str(part)))
    return Problem(location, reason, first["input"], first["type"], is_own)


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
    # numpy scalars are instances of Real. Bools are too, but a bool is never a measurement.
    if isinstance(value, bool) or not isinstance(value, Real):
        raise error(_sentence(f"{name} is {represented(value)}; it must be a number{_in(unit)}", hint))
    try:
        result = float(value)
    except OverflowError:  # an integer of more than 308 digits
        result = math.inf
    except Exception as cause:  # a foreign `__float__` may raise any error
        raise error(_sentence(f"{name} is a {type(value).__name__} that gives no number{_in(unit)}", hint)) from cause
    if not math.isfinite(result):
        bound = "finite"
    elif above is not None and result <= above:
        bound = f"above {above}"
    elif at_least is not None and result < at_least:
        bound = f"at least {at_least}"
    elif below is not None and result >= below:
        bound = f"below {below}"
    elif at_most is not None and result > at_most:
        bound = f"at most {at_most}"
    else:
        return result
    shown = f"{result:g}{' ' + unit if unit != '-' else ''}"
    raise error(_sentence(f"{name} is {shown}; it must be {bound}{_in(unit)}", hint))


_ONLY_FLOATS = {float}


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
    """Return `value` as `size` finite floats, or raise `error` with the name of the wrong component."""
    is_bounded = above is not None or at_least is not None
    # Fast path: games make hundreds of poses per frame. The slow path checks each number to name the wrong one.
    is_plain = type(value) is tuple and len(value) == size and {*map(type, value)} == _ONLY_FLOATS
    if is_plain and not is_bounded and math.isfinite(sum(cast("tuple[float, ...]", value))):
        return cast("tuple[float, ...]", value)
    items: Sequence[object]
    try:
        items = tuple(islice(value, size + 1))  # type: ignore[call-overload]  # the except clause handles non-iterables
    except Exception:  # a foreign `__iter__` may raise any error
        items = ()
    if len(items) != size or isinstance(value, str):
        raise error(_sentence(f"{name} is {represented(value)}; it must be {size} numbers{_in(unit)}", hint))
    return tuple(
        number(f"{name}[{i}]", item, unit, above=above, at_least=at_least, error=error, hint=hint)
        for i, item in enumerate(items)
    )


def whole(
    name: str, value: object, unit: str, *, at_least: int, at_most: int, error: type[Scene2HapError], hint: str = ""
) -> int:
    """Return `value` as a whole number inside its bounds, or raise `error` naming value, unit and bound."""
    result = number(name, value, unit, at_least=at_least, at_most=at_most, error=error, hint=hint)
    if result != int(result):
        raise error(_sentence(f"{name} is {represented(value)}; it must be a whole number{_in(unit)}", hint))
    return int(result)


def seed(value: object) -> int:
    """Return a seed, a whole number of 64 bits, with or without a sign. Raises: ConfigError."""
    return whole("seed", value, "-", at_least=-(2**63), at_most=2**64 - 1, error=ConfigError)


def flag(name: str, value: object, *, error: type[Scene2HapError]) -> bool:
    """Return `value` if it is True or False, else raise `error`. Python takes any text as true, even "no"."""
    if value is True or value is False:
        return value
    if type(value).__name__ in ("bool", "bool_"):  # NumPy's bool, checked without importing NumPy
        return bool(value)
    raise error(f"{name} is {represented(value)}; it must be {represented(True)} or {represented(False)}.")


def text(name: str, value: object, *, error: type[Scene2HapError]) -> str:
    """Return `value` if it is a text, else raise `error`."""
    if not isinstance(value, str):
        raise error(f"{name} is {represented(value)}; it must be a text.")
    return value


def path(name: str, value: object, *, error: type[Scene2HapError], hint: str = "") -> Path:
    """Return `value` as a path, or raise `error` if it is no text and no path."""
    if not isinstance(value, str | os.PathLike):
        raise error(_sentence(f"{name} is {described(value)}; it must be a path, as a text or a pathlib.Path", hint))
    if value == "":  # Python takes it for the working folder
        raise error(_sentence(f"{name} is ''; it must be the path of a file or folder", hint))
    try:
        return Path(value)
    except TypeError as cause:  # a path of bytes
        raise error(f"{name} is {described(value)}; it must be a path of text.") from cause


def near_files(path: Path) -> str:
    """Return a sentence with similar file names beside a missing path, or an empty text."""
    try:
        names = [name for name in islice(os.listdir(path.parent), _MOST_COMPARED) if not name.startswith(".")]
    except (OSError, ValueError):
        return ""
    return did_you_mean(path.name, names)


def items(name: str, value: object, *, at_most: int = 10_000, error: type[Scene2HapError]) -> tuple[Any, ...]:
    """Return the items of a sequence, or raise `error` if it is no sequence or has more than `at_most` items."""
    try:
        # The except clause handles values that are not iterable.
        found = value if type(value) is tuple else tuple(islice(value, at_most + 1))  # type: ignore[call-overload]
    except Exception as cause:  # a foreign `__iter__` may raise any error
        raise error(f"{name} is {represented(value)}; it must be a sequence.") from cause
    if len(found) > at_most:
        raise error(f"{name} has more than {at_most} items. Give fewer.")
    return found


_MOST_ITEMS = 10_000_000  # only an endless generator has more


def instances(
    name: str, value: object, kind: type[Kind], wanted: str, *, error: type[Scene2HapError]
) -> tuple[Kind, ...]:
    """Return the items of a sequence, all of one type. Raises: `error`: any other value; states what is wanted."""
    verb, wrong = "is", value
    if isinstance(value, Iterable) and not isinstance(value, str | Mapping | kind):
        found = items(name, value, at_most=_MOST_ITEMS, error=error)
        others = [item for item in found if not isinstance(item, kind)]
        if not others:
            return found
        verb, wrong = "has", others[0]
    raise error(f"{name} {verb} {described(wrong)}; it must be {wanted}.")


def texts(name: str, value: object, *, error: type[Scene2HapError]) -> tuple[str, ...]:
    """Return the texts of a sequence. Raises: `error`: any other value, including one text."""
    found = value if isinstance(value, list | tuple) else ()
    wrong = [item for item in found if not isinstance(item, str)]
    if wrong or not isinstance(value, list | tuple):
        given = f"has {represented(wrong[0])}" if wrong else f"is {represented(value)}"
        raise error(f"{name} {given}; it must be a list of texts, as ['oak'].")
    return tuple(found)


def names(name: str, value: object) -> tuple[str, ...]:
    """Return one or more distinct names from a sequence. Raises: ConfigError: any other value, including one string."""
    if isinstance(value, str):
        raise ConfigError(f"{name} is {shown(value)}; it must be a sequence of names, as [{shown(value)}].")
    if isinstance(value, set | frozenset):
        raise ConfigError(
            f"{name} is a set, which has no order; it must be a sequence of names, as {sorted(map(str, value))}."
        )
    found = tuple(value) if isinstance(value, Iterable) else ()
    twice = next((x for i, x in enumerate(found) if isinstance(x, str) and x in found[:i]), None)
    if twice is not None:
        raise ConfigError(
            f"{name} is {shown(found)}, with {shown(twice)} twice; it must be at least one name, each once."
        )
    if not found or not all(isinstance(x, str) and x.strip() for x in found) or len(set(found)) < len(found):
        raise ConfigError(f"{name} is {shown(value)}; it must be at least one name, each once.")
    return found


def _folded(name: str) -> str:
    return re.sub(r"[\W_]+", "", name[:_LONGEST_COMPARED].casefold())


def _in(unit: str) -> str:
    return "" if unit == "-" else f" [{unit}]"


def _sentence(message: str, hint: str) -> str:
    return f"{message}. {hint}" if hint else f"{message}."
