"""The base of every configuration: frozen, without unknown settings, and with errors of our own."""

from __future__ import annotations

from collections.abc import Mapping
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
    def parse(cls, settings: Self | Mapping[str, Any] | None) -> Self:
        """A configuration from settings, or the default.

        Raises: ConfigError: a setting that does not exist or is out of bounds.
        """
        if isinstance(settings, cls):
            return settings
        try:
            return cls.model_validate(settings or {})
        except ValidationError as cause:
            problem = checks.first_problem(cause)
            raise ConfigError(
                f"{cls.of_what} setting {problem.place}: {problem.reason}, "
                f"got {checks.shown(problem.value, problem.location[-1] if problem.location else '')}."
            ) from cause
