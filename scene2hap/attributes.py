"""Attributes that a class of the public surface does not have, or that cannot be set, are answered in a sentence."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any, NamedTuple, NoReturn, TypeVar

from scene2hap import checks
from scene2hap.errors import CallError, ReadOnlyAttribute, UnknownAttribute

Class = TypeVar("Class", bound=type)


class Missing(NamedTuple):
    """The sentence for a name that something does not have.

    The text is made when it is read: `hasattr` and `isinstance` of a protocol ask for many names that are not there.
    """

    owner: str
    wanted: str
    known: tuple[str, ...]

    def __str__(self) -> str:
        near = checks.did_you_mean(self.wanted, self.known, f"There are {', '.join(self.known) or 'none'}.")
        return f"{self.owner} has no attribute {checks.represented(self.wanted)}. {near}"


def unknown_attribute(owner: str, wanted: str, known: Iterable[str]) -> UnknownAttribute:
    """The error for a name that is none of those known."""
    # Without an `obj` of its own, Python would keep the instance alive and append a suggestion of its own.
    return UnknownAttribute(Missing(owner, wanted, tuple(sorted(known))), name=wanted, obj=None)


def clear_attributes(cls: Class) -> Class:
    """A class that answers a missing attribute, an index, and setting a field of frozen data by errors of our own.

    Copying, pickling and `hasattr` work as before, and so does a `__getattr__` that the class has already.
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
            return object.__getattribute__(self, name)  # a property raised an AttributeError: report that one
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
    """A class whose instances refuse to set public attributes, which would do nothing; their own names begin with _."""

    def refuse(self: Any, name: str, value: object) -> None:
        if name[:1] != "_":
            raise _cannot_set(self, name, "; call one of its methods")
        object.__setattr__(self, name, value)

    _set(cls, "__setattr__", refuse)
    return cls


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


def _public(self: object) -> set[str]:
    cls = type(self)
    settings = getattr(cls, "model_fields", None)  # of pydantic, whose classes have dozens of methods
    if settings is not None:
        return set(settings)
    fields: Iterable[str] = getattr(cls, "__dataclass_fields__", ())
    return {name for name in {*dir(cls), *fields, *getattr(self, "__dict__", ())} if not name.startswith("_")}


def _set(cls: type, name: str, function: Any) -> None:
    function.__name__, function.__qualname__ = name, f"{cls.__name__}.{name}"
    type.__setattr__(cls, name, function)
