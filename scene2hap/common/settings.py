"""The base class of every configuration: frozen, with our own errors, and without unknown settings."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from types import NoneType
from typing import Any, ClassVar, Self, get_args

from pydantic import BaseModel, ConfigDict, ValidationError, ValidationInfo, field_validator, model_validator

from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes
from scene2hap.common.files import read_small_text
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import ConfigError, reason_of


@clear_attributes
class Settings(BaseModel):
    """Settings from TOML, JSON or a mapping. Each configuration is defined beside the part that it configures.

    `of_what` names the part in error messages, and its table in a file of settings.
    Raises: ConfigError: an unknown setting, with a suggestion in the message, or one out of bounds.
    """

    # Inputs are hidden in pydantic's messages, which appear in tracebacks, since a setting may be a key.
    model_config: ClassVar[ConfigDict] = ConfigDict(
        frozen=True, extra="forbid", arbitrary_types_allowed=True, hide_input_in_errors=True
    )

    of_what: ClassVar[str]

    def __init__(self, *unnamed: Any, **settings: Any) -> None:
        if unnamed:
            raise ConfigError(
                f"{self.of_what} settings are {checks.described(unnamed[0])} without a name; write "
                f"{type(self).__name__}(name=value), of {', '.join(type(self).model_fields)}."
            )
        try:
            super().__init__(**settings)
        except ValidationError as cause:
            raise ConfigError(self._refusal(cause)) from cause

    def __setattr__(self, name: str, value: Any) -> None:
        try:
            super().__setattr__(name, value)
        except ValidationError as cause:
            cls = type(self).__name__
            raise ConfigError(
                f"{name} of a {cls} cannot be set, since settings never change; {cls}.parse(settings, {name}=...) "
                "makes others."
            ) from cause

    @model_validator(mode="wrap")
    @classmethod
    def _has_names(cls, value: Any, handler: Callable[[Any], Self]) -> Self:
        """Refuse settings inside of others that Python cannot pass by name."""
        unnamed = [name for name in value if not isinstance(name, str)] if isinstance(value, Mapping) else []
        if unnamed:
            raise ConfigError(f"{cls.of_what} setting {checks.represented(unnamed[0])}: a name must be a text.")
        return handler(value)

    @field_validator("*", mode="before")
    @classmethod
    def _flags_and_numbers_differ(cls, value: Any, info: ValidationInfo) -> Any:
        """Refuse a flag for a number, and anything else for a flag: pydantic takes true for 1, 1 and "yes" for true."""
        annotation = cls.model_fields[str(info.field_name)].annotation
        if _holds_only((float, int), annotation) and _has_flag(value):
            raise ValueError("it must be a number, neither true nor false")
        if value is not None and _holds_only((bool,), annotation) and not _has_flag(value):
            raise ValueError("it must be true or false")
        return value

    @classmethod
    def parse(cls, settings: Self | Mapping[str, Any] | str | os.PathLike[str] | None, **changes: Any) -> Self:
        """Return a configuration from settings or defaults, overridden by `changes`; changes of None are ignored.

        A path names a TOML or JSON file; its table `of_what` is read.
        Raises: ConfigError: an unknown setting, one out of bounds, or a file that cannot be read or lacks this table.
        """
        wanted = {name: value for name, value in changes.items() if value is not None}
        if isinstance(settings, cls) and not wanted:
            return settings
        if isinstance(settings, os.PathLike) or (isinstance(settings, str) and Path(settings).suffix in _SUFFIXES):
            settings = read_settings(str(settings), cls.of_what)[cls.of_what]
        if isinstance(settings, Settings) and issubclass(cls, type(settings)):
            settings = {name: getattr(settings, name) for name in settings.model_fields_set}
        if settings is not None and not isinstance(settings, Mapping):
            raise ConfigError(
                f"{cls.of_what} settings are {checks.described(settings)}; they must be a mapping of names to values, "
                f"a {cls.__name__}, or the path of a TOML or JSON file. The names are {', '.join(cls.model_fields)}."
            )
        unnamed = [name for name in settings or () if not isinstance(name, str)]
        if unnamed:
            raise ConfigError(f"{cls.of_what} setting {checks.represented(unnamed[0])}: a name must be a text.")
        return cls(**{**(settings or {}), **wanted})

    @classmethod
    def _refusal(cls, error: ValidationError) -> str:
        problem = checks.first_problem(error)
        if problem.is_own and (nested := _NESTED.match(problem.reason)):
            return f"{cls.of_what} setting {problem.place}.{problem.reason[nested.end() :]}."
        if problem.kind == "extra_forbidden" and len(problem.location) == 1:
            known = ", ".join(cls.model_fields)
            near = checks.did_you_mean(problem.location[0], cls.model_fields, f"There are {known}.")
            return f"there is no {cls.of_what} setting {problem.location[0]!r}. {near}"
        if not problem.location:  # the settings do not fit each other; none of them is the wrong one
            return f"{cls.of_what} settings: {problem.reason}."
        got = "" if problem.is_own else f", got {checks.shown(problem.value, problem.location[-1])}"
        said = f"{cls.of_what} setting {problem.place}: {problem.reason}{got}"
        return said if said.endswith("?") else f"{said}."


def _holds_only(kinds: tuple[type, ...], annotation: object) -> bool:
    """Return True if all values of a type are of these kinds, or None: float, int | None, tuple[tuple[float, ...]]."""
    parts = [part for part in get_args(annotation) if part not in (Ellipsis, NoneType)]
    return all(_holds_only(kinds, part) for part in parts) if parts else annotation in kinds


def _has_flag(value: object) -> bool:
    """Return True if a value is a bool, also of NumPy, or a list that holds one."""
    return any(map(_has_flag, value)) if isinstance(value, list | tuple) else type(value).__name__ in ("bool", "bool_")


_NESTED = re.compile(r"\w+ setting (?=\w[\w.]*: )")
"""The beginning of an error about a setting, which is replaced if the settings are part of others."""
_SUFFIXES = (".json", ".toml")
_LONG_KEY = re.compile(r"""(?<![\w"'-])(?:[\w"'-]++[ \t]*+\.[ \t]*+){32}""")
"""tomllib's time grows with the square of the parts of a dotted key: one of 40 kB takes 16 s."""

SECTIONS = ("bake", "bridge", "session", "user")
"""The tables that a file of settings may have."""


def read_settings(path: str | None, *sections: str) -> dict[str, dict[str, Any]]:
    """Read some of `SECTIONS` from a settings file. Absent tables are empty, and all are without a file.

    Raises: ConfigError: the file cannot be read, has other content, or has none of the tables.
    """
    if path is None:
        return {section: {} for section in sections}
    try:
        text = read_small_text(path)
        if not path.lower().endswith(".json") and _LONG_KEY.search(text):
            raise ValueError("a key has more than 32 parts, joined by dots")
        document = parse_json(text) if path.lower().endswith(".json") else tomllib.loads(text)
    except (OSError, ValueError, RecursionError) as cause:
        near = checks.near_files(Path(path)) if isinstance(cause, FileNotFoundError) else ""
        raise ConfigError(
            f"settings {path} cannot be read: {reason_of(cause)}. {near or 'They are TOML, or JSON in a .json file.'}"
        ) from cause
    if not isinstance(document, dict):
        raise ConfigError(f"settings {path}: it must hold tables of settings, {', '.join(SECTIONS)}.")
    stray = [name for name in document if name not in SECTIONS]
    if stray:
        raise ConfigError(
            f"settings {path}: {stray[0]!r} is outside of the tables {', '.join(SECTIONS)}; write it into one of "
            f"them, as [{sections[0]}] in TOML."
        )
    if document.keys().isdisjoint(sections):  # otherwise, say, the limits in a person's profile would be ignored
        read = " or ".join(map(repr, sections))
        raise ConfigError(f"settings {path}: there is no table {read}; write [{sections[0]}] in TOML.")
    tables = {section: document.get(section, {}) for section in sections}
    for section, table in tables.items():
        if not isinstance(table, dict):
            raise ConfigError(f"settings {path}: {section!r} must be a table of settings.")
    return tables


def cache_folder(part: str) -> Path:
    """Return the default folder of a part's cache, in the user's cache folder. Raises: ConfigError: there is none."""
    root = os.environ.get("XDG_CACHE_HOME") or (os.environ.get("LOCALAPPDATA") if os.name == "nt" else "")
    try:
        return (Path(root) if root else Path.home() / ".cache") / "scene2hap" / part
    except RuntimeError as cause:  # a user without an entry, as in a container or a service
        raise ConfigError(
            "there is no home folder for the cache; set cache_dir, or the environment variable XDG_CACHE_HOME."
        ) from cause
