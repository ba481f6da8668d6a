"""The base of every configuration: frozen, without unknown settings, and with errors of our own."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, ValidationError

from scene2hap import checks
from scene2hap.errors import ConfigError


class Settings(BaseModel):
    """Settings from TOML, JSON or a mapping; a configuration lives beside the part that it configures.

    `of_what` names the part in error messages.
    """

    # Inputs are hidden in pydantic's own text, which stands in tracebacks, since a setting may be a key.
    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True, hide_input_in_errors=True)

    of_what: ClassVar[str]

    @classmethod
    def parse(cls, settings: Self | Mapping[str, Any] | None, **changes: Any) -> Self:
        """A configuration from settings, or the default, with `changes` on top; those that are None are left out.

        Raises: ConfigError: a setting that does not exist or is out of bounds.
        """
        wanted = {name: value for name, value in changes.items() if value is not None}
        if isinstance(settings, cls) and not wanted:
            return settings
        if settings is not None and not isinstance(settings, Settings | Mapping):
            raise ConfigError(
                f"{cls.of_what} settings are {checks.shown(settings)}; they must be a mapping of names to values."
            )
        base: Mapping[str, Any] = (
            {name: getattr(settings, name) for name in cls.model_fields}
            if isinstance(settings, Settings)
            else (settings or {})
        )
        try:
            return cls.model_validate({**base, **wanted})
        except ValidationError as cause:
            problem = checks.first_problem(cause)
            raise ConfigError(
                f"{cls.of_what} setting {problem.place}: {problem.reason}, "
                f"got {checks.shown(problem.value, problem.location[-1] if problem.location else '')}."
            ) from cause


def cache_folder(part: str) -> Path:
    """Default folder of a part's cache, in the user's folder of caches."""
    root = os.environ.get("XDG_CACHE_HOME") or (os.environ.get("LOCALAPPDATA") if os.name == "nt" else "")
    return (Path(root) if root else Path.home() / ".cache") / "scene2hap" / part
