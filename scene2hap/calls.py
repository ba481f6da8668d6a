"""Calls whose arguments do not fit are answered with what the function takes."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from scene2hap import checks
from scene2hap.errors import CallError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Class = TypeVar("Class", bound=type)


def clear_call(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """A function that answers a misspelled, missing or surplus argument by a CallError, which names the nearest.

    Of a class, the constructor does. A call that fits costs one frame more; its arguments are looked at only after a
    TypeError.
    """

    if isinstance(function, type):
        setattr(function, "__init__", clear_call(vars(function)["__init__"]))  # noqa: B010  # mypy refuses to assign it
        return function

    @functools.wraps(function)
    def call(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        try:
            return function(*args, **kwargs)
        except TypeError:
            _require_fit(function, args, kwargs)
            raise

    return call


def clear_calls(cls: Class) -> Class:
    """A class whose constructor and public methods answer as `clear_call` does."""
    for name, method in list(vars(cls).items()):
        if inspect.isfunction(method) and (name == "__init__" or not name.startswith("_")):
            setattr(cls, name, clear_call(method))
    return cls


def _require_fit(function: Callable[..., object], args: tuple[object, ...], kwargs: dict[str, object]) -> None:
    """Raise a CallError if a function cannot be called so."""
    try:
        signature = inspect.signature(function)
    except ValueError:  # of C, which tells none
        return
    try:
        signature.bind(*args, **kwargs)
    except TypeError as cause:
        is_method = next(iter(signature.parameters), "") == "self"
        parameters = list(signature.parameters.values())[is_method:]
        name = getattr(function, "__qualname__", type(function).__name__).removesuffix(".__init__")
        takes = signature.replace(
            parameters=[p.replace(annotation=p.empty) for p in parameters], return_annotation=signature.empty
        )
        raise CallError(f"{_problem(parameters, args[is_method:], kwargs, cause)} Call {name}{takes}.") from None


def _problem(
    parameters: list[inspect.Parameter], args: tuple[object, ...], kwargs: dict[str, object], cause: TypeError
) -> str:
    known = [parameter.name for parameter in parameters]
    for unknown in kwargs:
        if unknown not in known:
            return f"there is no argument {unknown!r}. {checks.did_you_mean(unknown, known)}".strip()
    positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    if len(args) > len(positional):
        surplus = checks.represented(args[len(positional)])
        by_name = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
        how = f"give it by name, as {by_name[0]}={surplus}" if by_name else "leave it out"
        return f"{surplus} is one argument too many; {how}."
    return f"{cause}."
