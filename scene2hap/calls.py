"""Calls whose arguments do not fit are answered with what the function takes."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

from scene2hap import checks
from scene2hap.errors import CallError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Class = TypeVar("Class", bound=type)


def clear_call(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """A function that answers a misspelled, missing or surplus argument by a CallError, which names the nearest.

    A call that fits costs one frame more; its arguments are looked at only after a TypeError.
    """

    @functools.wraps(function)
    def call(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        try:
            return function(*args, **kwargs)
        except TypeError:
            told = misfit(function, args, kwargs)
            if told:
                raise CallError(told) from None
            raise

    return call


def clear_construction(cls: Class) -> Class:
    """A class whose own constructor answers as `clear_call` does."""
    type.__setattr__(cls, "__init__", clear_call(vars(cls)["__init__"]))
    return cls


def clear_calls(cls: Class) -> Class:
    """A class whose own constructor and public methods answer as `clear_call` does."""
    for name, method in list(vars(cls).items()):
        if inspect.isfunction(method) and not name.startswith("_"):
            setattr(cls, name, clear_call(method))
    return clear_construction(cls) if "__init__" in vars(cls) else cls


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
