"""Errors for arguments that do not fit a call, and for attributes that do not exist or cannot be set.

Public classes have the decorator `clear_calls`. Classes whose methods run in every frame have `clear_construction`,
since wrapped methods are slower, or only `clear_attributes`. Each message suggests the most similar existing name.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Real
from types import FunctionType
from typing import Any, NamedTuple, NoReturn, ParamSpec, TypeVar

from scene2hap.common import checks
from scene2hap.errors import CallError, ReadOnlyAttribute, Scene2HapError, UnknownAttribute, UnknownImport

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Class = TypeVar("Class", bound=type)


class Missing(NamedTuple):
    """The message for a missing attribute.

    The text is made only when it is read, since `hasattr` and `isinstance` of a protocol look up many missing names.
    """

    owner: str
    wanted: str
    known: frozenset[str]

    def __str__(self) -> str:
        known = sorted(self.known)
        near = checks.did_you_mean(self.wanted, known, f"There are {', '.join(known) or 'none'}.")
        return f"{self.owner} has no attribute {checks.represented(self.wanted)}. {near}"


def unknown_attribute(owner: str, wanted: str, known: Iterable[str]) -> UnknownAttribute:
    """Return the error for an attribute that is not among the known ones."""
    # With obj=None, Python does not keep the instance alive and does not append its own suggestion.
    return UnknownAttribute(Missing(owner, wanted, frozenset(known)), name=wanted, obj=None)


def unknown_import(owner: str, wanted: str, known: Iterable[str]) -> UnknownImport:
    """Return the error for a name that `from owner import wanted` does not find."""
    near = checks.did_you_mean(wanted, known, "`dir(scene2hap)` lists its names.")
    return UnknownImport(f"{owner} has no {checks.represented(wanted)} to import. {near}", name=owner)


def clear_attributes(cls: Class) -> Class:
    """Decorate a class with our errors for missing attributes, indexing, and setting a field of frozen data.

    Copying, pickling, `hasattr` and an existing `__getattr__` of the class work as before.
    """
    earlier = getattr(cls, "__getattr__", None)

    def answer(self: Any, name: str) -> Any:
        if earlier is not None:
            try:
                return earlier(self, name)
            except UnknownAttribute:
                raise
            except AttributeError:
                if name.startswith("_"):
                    raise
                raise unknown_attribute(type(self).__name__, name, _public(self)) from None
        if any(name in vars(base) for base in type(self).__mro__):
            return object.__getattribute__(self, name)  # a property raised an AttributeError: raise that one again
        if name.startswith("_"):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        raise unknown_attribute(type(self).__name__, name, _public(self))

    def refuse_item(self: Any, key: object) -> NoReturn:
        raise CallError(
            f"a {type(self).__name__} has no items, so that [{checks.represented(key)}] gives nothing; "
            f"it has {', '.join(sorted(_public(self)))}."
        )

    _set(cls, "__getattr__", answer)
    if not hasattr(cls, "__getitem__") and not hasattr(cls, "__iter__"):
        _set(cls, "__getitem__", refuse_item)
    parameters = getattr(cls, "__dataclass_params__", None)
    if parameters is not None and parameters.frozen and "__setattr__" in vars(cls):
        _set(cls, "__setattr__", _frozen(vars(cls)["__setattr__"]))
    return cls


def read_only(cls: Class) -> Class:
    """Decorate a class so that public attributes cannot be set, since that would have no effect. `_names` can."""

    def refuse(self: Any, name: str, value: object) -> None:
        if name[:1] != "_":
            raise _cannot_set(self, name, "; call one of its methods")
        object.__setattr__(self, name, value)

    _set(cls, "__setattr__", refuse)
    return cls


def not_pickled(error: type[Scene2HapError], reason: str) -> Callable[[Class], Class]:
    """Decorate a class whose instances belong to one process, so that pickling or copying one raises `error`."""

    def decorate(cls: Class) -> Class:
        def refuse(self: object) -> NoReturn:
            raise error(
                f"a {type(self).__name__} cannot be copied or pickled: {reason}. Make it in the process that uses it; "
                "its settings can be sent there."
            )

        _set(cls, "__reduce__", refuse)
        return cls

    return decorate


def _frozen(earlier: Any) -> Any:
    def refuse(self: Any, name: str, value: object) -> None:
        try:
            earlier(self, name, value)
        except dataclasses.FrozenInstanceError:
            how = f", since it never changes; dataclasses.replace(..., {name}=...) makes another"
            raise _cannot_set(self, name, how) from None

    return refuse


def _cannot_set(self: object, name: str, how: str) -> ReadOnlyAttribute | UnknownAttribute:
    owner, known = type(self).__name__, _public(self)
    if name in known:
        return ReadOnlyAttribute(f"{name} of a {owner} cannot be set{how}.")
    return unknown_attribute(owner, name, known)


def _public(self: object) -> frozenset[str]:
    names = _public_of_class(type(self))  # type: ignore[arg-type]  # mypy takes the hash of an instance for its own
    if hasattr(type(self), "model_fields"):
        return names
    return names.union(name for name in getattr(self, "__dict__", ()) if not name.startswith("_"))


@functools.lru_cache(1024)
def _public_of_class(cls: type) -> frozenset[str]:
    settings = getattr(cls, "model_fields", None)  # pydantic classes have dozens of methods, so only fields count
    if settings is not None:
        return frozenset(settings)
    fields: Iterable[str] = getattr(cls, "__dataclass_fields__", ())
    return frozenset(name for name in {*dir(cls), *fields} if not name.startswith("_"))


def _set(cls: type, name: str, function: Any) -> None:
    function.__name__, function.__qualname__ = name, f"{cls.__name__}.{name}"
    type.__setattr__(cls, name, function)


def clear_call(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Wrap a function so that a misspelled, missing or surplus argument raises a CallError with a suggestion.

    A correct call costs one more frame on the stack. Its arguments are only inspected after a TypeError.
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
    """Decorate a class: `clear_call` for constructor and class methods, `clear_attributes` for attributes."""
    init = getattr(cls, "__init__")  # noqa: B009  # the class's function, not a bound method
    type.__setattr__(cls, "__init__", clear_call(_taking_nothing(cls) if init is object.__init__ else init))
    for name, method in _public_methods(cls, classmethod):
        setattr(cls, name, classmethod(clear_call(method.__func__)))
    return clear_attributes(cls)


def clear_calls(cls: Class) -> Class:
    """Decorate a class: `clear_call` for constructor and public methods, `clear_attributes` for attributes."""
    for name, method in _public_methods(cls, FunctionType):
        setattr(cls, name, clear_call(method))
    return clear_construction(cls)


def _public_methods(cls: type, kind: type) -> list[tuple[str, Any]]:
    return [(name, one) for name, one in vars(cls).items() if isinstance(one, kind) and not name.startswith("_")]


def _taking_nothing(cls: type) -> Callable[..., None]:
    def __init__(self: object) -> None: ...  # messages show this name

    __init__.__qualname__ = f"{cls.__name__}.__init__"
    return __init__


def misfit(function: Callable[..., Any], args: Sequence[object], kwargs: Mapping[str, object]) -> str:
    """Return why a function cannot be called with these arguments, and its signature; empty if it can be called."""
    try:
        signature = inspect.signature(function)
    except ValueError:  # functions in C may have no signature
        return ""
    try:
        signature.bind(*args, **kwargs)
    except TypeError as cause:
        is_method = next(iter(signature.parameters), "") in ("self", "cls")
        taken = [one.replace(annotation=one.empty) for one in list(signature.parameters.values())[is_method:]]
        name = getattr(function, "__qualname__", type(function).__name__).removesuffix(".__init__")
        call = f"{name}{inspect.Signature([_with_short_default(one) for one in taken])}"
        hint = getattr(type(args[0]), "_CALL_HINT", "") if is_method and args and name == type(args[0]).__name__ else ""
        return f"{_problem(taken, args[is_method:], kwargs) or f'{cause}.'} Call {call}. {hint}".rstrip()
    return ""


def settings_misfit(factory: Callable[..., Any], settings: Mapping[str, object]) -> str:
    """Return why a factory does not take settings, in words for a file or a client; empty if it takes them."""
    if not misfit(factory, (), settings):
        return ""
    taken = inspect.signature(factory).parameters
    there = f"There are {', '.join(taken)}."
    unknown = next((name for name in settings if name not in taken), None)
    if unknown is not None:
        near = checks.did_you_mean(unknown, taken, there)
        return f"there is no setting {checks.represented(unknown)}. {near}"
    missing = (one.name for one in taken.values() if one.default is one.empty and one.name not in settings)
    return f"the setting {next(missing, '')} is missing. {there}"


class _Ellipsis:
    """A default value that is too long to be shown."""

    def __repr__(self) -> str:
        return "..."


_LONGEST_DEFAULT, _LONGEST_SURPLUS = 32, 80


def _with_short_default(parameter: inspect.Parameter) -> inspect.Parameter:
    if len(repr(parameter.default)) <= _LONGEST_DEFAULT or parameter.default is parameter.empty:
        return parameter
    return parameter.replace(default=_Ellipsis())


def _problem(taken: list[inspect.Parameter], args: Sequence[object], kwargs: Mapping[str, object]) -> str:
    """Return the sentence for an unknown or surplus argument; empty for other problems."""
    known = [one.name for one in taken]
    for unknown in kwargs:
        if unknown not in known:
            name = checks.represented(unknown)
            setting = f"If it is a setting, write config={{{name}: ...}}." if "config" in known else ""
            near = checks.did_you_mean(unknown, known)
            return " ".join(filter(None, (f"there is no argument {name}.", near, setting)))
    positional = [one for one in taken if one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)]
    if len(args) <= len(positional):
        return ""
    surplus = checks.represented(args[len(positional)])
    if len(surplus) > _LONGEST_SURPLUS:
        surplus = checks.described(args[len(positional)])
    several = _several_as_one(args, len(positional))
    if several:
        return f"{surplus} is one argument too many; {several}."
    by_name = ", ".join(f"{one.name}=" for one in taken if one.kind is one.KEYWORD_ONLY)
    how = f"give it by name: {by_name}" if by_name else "leave it out"
    return f"{surplus} is one argument too many; {how}."


def _several_as_one(args: Sequence[object], n_positional: int) -> str:
    """Advise to give the last arguments as one, if they are of one kind: numbers of a point, or objects of a list."""

    def kind(one: object) -> object:
        return Real if isinstance(one, Real) else type(one)

    start = len(args) - 1
    while start > 0 and kind(args[start - 1]) == kind(args[-1]):
        start -= 1
    n_alike = len(args) - start
    if start >= n_positional or n_alike < 2 or isinstance(args[-1], str | bool):
        return ""
    if kind(args[-1]) is Real:
        return f"give {n_alike} numbers as one argument, ({', '.join(map(checks.represented, args[start:]))})"
    return f"give the {n_alike} objects of type {type(args[-1]).__name__} as one list"
