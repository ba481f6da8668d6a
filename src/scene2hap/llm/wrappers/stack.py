"""What all wrappers share: how an inner backend is given, named and reported on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scene2hap.errors import ConfigError
from scene2hap.llm import BACKENDS
from scene2hap.llm.protocol import LLMBackend

Spec = LLMBackend | Mapping[str, Any] | str
"""A backend, or what `BACKENDS` builds one from."""


class Wrapper:
    """Base of the wrappers: holds `inner`."""

    def __init__(self, inner: Spec) -> None:
        built = BACKENDS.build(inner)
        if not isinstance(built, LLMBackend):
            raise ConfigError(f"{type(self).__name__} wraps {built!r}; it needs a backend with `complete`.")
        self.inner: LLMBackend = built

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.inner!r})"

    @property
    def identity(self) -> dict[str, Any]:
        """What decides the answer besides the request, as the innermost backend tells it.

        Raises: ConfigError: it does not tell.
        """
        identity = getattr(self.inner, "identity", None)
        if not isinstance(identity, Mapping):
            raise ConfigError(
                f"{self.inner!r} has no `identity` (model, address), so that its answers cannot be told from another "
                "model's. Put the cache inside of it, or give the backend that property."
            )
        return dict(identity)
