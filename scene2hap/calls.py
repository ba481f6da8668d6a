"""Calls whose arguments do not fit are answered with what the function takes.

Classes of the public surface are decorated by `clear_calls`, or by `clear_construction` where a wrapper would slow
down methods that are called in every frame; either also answers attributes that do not exist.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import Any, ParamSpec, TypeVar

from scene2hap import checks
from scene2hap.attributes import clear_attributes
from scene2hap.errors import CallError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Class = TypeVar("Class", bound=type)


def clear_call(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Wrap a function so that a misspelled, missing or surplus argument raises a CallError, which names the nearest.

    A call that fits costs one frame more; its arguments are looked at only after a TypeError.
    """

    @functools.wraps(function)
    def call(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        try:
            return function(*args, **kwargs)
        except TypeError:
            message = misfit(function, args, kwargs)
            if message:
                raise CallError(message) from None
            raise

    return call


def clear_construction(cls: Class) -> Class:
    """A class whose constructor and class methods answer as `clear_call` does; its attributes, see `attributes`."""
    init = getattr(cls, "__init__")  # noqa: B009  # the function of the class itself
    type.__setattr__(cls, "__init__", clear_call(_taking_nothing(cls) if init is object.__init__ else init))
    for name, method in _public_methods(cls, classmethod):
        setattr(cls, name, classmethod(clear_call(method.__func__)))
    return clear_attributes(cls)


def clear_calls(cls: Class) -> Class:
    """A class whose constructor and public methods answer as `clear_call` does; its attributes, see `attributes`."""
    for name, method in _public_methods(cls, FunctionType):
        setattr(cls, name, clear_call(method))
    return clear_construction(cls)


def _public_methods(cls: type, kind: type) -> list[tuple[str, Any]]:
    return [(name, one) for name, one in vars(cls).items() if isinstance(one, kind) and not name.startswith("_")]


def _taking_nothing(cls: type) -> Callable[..., None]:
    def __init__(self: object) -> None: ...  # the name that is shown

    __init__.__qualname__ = f"{cls.__name__}.__init__"
    return __init__


def misfit(function: Callable[..., Any], args: Sequence[object], kwargs: Mapping[str, object]) -> str:
    """Why a function cannot be called with such arguments, and what it takes; empty where it can be."""
    try:
        signature = inspect.signature(function)
    except ValueError:  # of C, which tells none
        return ""
    try:
        signature.bind(*args, **kwargs)
    except TypeError as cause:
        is_method = next(iter(signature.parameters), "") in ("self", "cls")
        taken = [one.replace(annotation=one.empty) for one in list(signature.parameters.values())[is_method:]]
        name = getattr(function, "__qualname__", type(function).__name__).removesuffix(".__init__")
        call = f"{name}{inspect.Signature(taken)}"
        return f"{_problem(taken, args[is_method:], kwargs) or f'{cause}.'} Call {call}."
    return ""


def _problem(taken: list[inspect.Parameter], args: Sequence[object], kwargs: Mapping[str, object]) -> str:
    """The sentence for an argument that does not exist, or for one too many; empty if it is neither."""
    known = [one.name for one in taken]
    for unknown in kwargs:
        if unknown not in known:
            setting = f"A setting goes into config={{{unknown!r}: ...}}." if "config" in known else ""
            return f"there is no argument {unknown!r}. {checks.did_you_mean(unknown, known, setting)}".strip()
    positional = [one for one in taken if one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)]
    if len(args) <= len(positional):
        return ""
    surplus = checks.represented(args[len(positional)])
    by_name = ", ".join(f"{one.name}=" for one in taken if one.kind is one.KEYWORD_ONLY)
    how = f"give it by name: {by_name}" if by_name else "leave it out"
    return f"{surplus} is one argument too many; {how}."
