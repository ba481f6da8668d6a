"""Backends in a stack: the common part of all wrappers, with an inner backend, its identity and its reports."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

from scene2hap.errors import ConfigError
from scene2hap.llm import BACKENDS
from scene2hap.llm.protocol import LLMBackend

Spec = LLMBackend | Mapping[str, Any] | str
"""A backend, or a specification from which `BACKENDS` builds one."""


def identity(backend: object) -> Mapping[str, Any]:
    """Return the properties on which a backend's answers depend: model, address, ...; empty if it names none."""
    try:
        named = getattr(backend, "identity", None)
    except ConfigError:  # a wrapper whose inner backend has no identity
        named = None
    return named if isinstance(named, Mapping) else {}


def is_remote(backend: object) -> bool:
    """Return True if a backend has a network address, so that pictures are worth rendering for it."""
    return "base_url" in identity(backend)


def reports(backend: object) -> dict[str, Mapping[str, Any]]:
    """Return the report of each layer of a stack, by its class, outermost first."""
    found: dict[str, Mapping[str, Any]] = {}
    while backend is not None:
        report = getattr(backend, "report", None)
        if callable(report):
            found[type(backend).__name__] = report()
        backend = getattr(backend, "inner", None)
    return found


def innermost(backend: object) -> object:
    """Return the innermost backend of a stack of wrappers."""
    while (inner := getattr(backend, "inner", None)) is not None:
        backend = inner
    return backend


class Wrapper:
    """Base of the wrappers: holds `inner`."""

    def __init__(self, inner: Spec) -> None:
        self.inner: LLMBackend = cast("LLMBackend", BACKENDS.build(inner))  # `build` checks it

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.inner!r})"

    async def ready(self) -> None:
        """Let the innermost backend complete its `identity`. Raises: errors of the innermost backend."""
        ready = getattr(self.inner, "ready", None)
        if ready is not None:
            await ready()

    @property
    def identity(self) -> dict[str, Any]:
        """The settings, besides the request, that affect the answer, as stated by the innermost backend.

        Raises: ConfigError: it states none.
        """
        identity = getattr(self.inner, "identity", None)
        if not isinstance(identity, Mapping):
            raise ConfigError(
                f"{self.inner!r} has no `identity` (model, address), so that its answers cannot be distinguished from "
                "another model's. Put the cache inside of it, or give the backend that property."
            )
        return dict(identity)
