"""Registry of implementations by name, for built-ins and plug-ins of other packages.

A package of scene2hap that can be extended declares one `PluginGroup`. Built-ins are written as ``"module:attribute"``
and imported at first use. Another package adds an entry point in the same group, written in the same way::

    [project.entry-points."scene2hap.propagation"]
    my_model = "my_package.models:MyModel"
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from inspect import isfunction, signature
from typing import Any, Self

from scene2hap.common.calls import misfit, settings_misfit
from scene2hap.common.checks import described, did_you_mean, represented, shown
from scene2hap.errors import ConfigError, MissingExtra, UnknownPlugin

Members = Mapping[str, tuple[str, ...] | None]
"""Required members of an implementation: methods with the names of their arguments, and attributes (None)."""
_ABSENT = object()


@dataclass(frozen=True)
class InstalledPlugin:
    """An implementation from another package. `problem` is the error when it was loaded, empty if there was none."""

    group: str
    kind: str
    value: str
    package: str
    problem: str

    @classmethod
    def of(cls, entry: EntryPoint, problem: str) -> Self:
        """Return the description of an entry point."""
        package = f"{entry.dist.name} {entry.dist.version}" if entry.dist else "an unknown package"
        return cls(entry.group, entry.name, entry.value, package, problem)


@dataclass(frozen=True)
class PluginGroup:
    """The implementations of one protocol.

    `name` is the entry-point group (``"scene2hap.llm"``); `builtins` maps a kind to ``"module:attribute"``; `extras`
    maps a kind to the extra that installs its optional dependency; `members` are the required members of its protocol;
    `wraps_functions` names the class that makes an implementation of a plain function, if there is one; `synonyms`
    maps other names by which people ask for kinds to these kinds, for suggestions alone.
    """

    name: str
    builtins: Mapping[str, str]
    extras: Mapping[str, str]
    members: Members = field(default_factory=dict)
    wraps_functions: str = ""
    synonyms: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def kinds(self) -> tuple[str, ...]:
        """Return every name that `load` accepts, sorted."""
        return tuple(sorted({*self.builtins, *(plugin.name for plugin in self._entries())}))

    def load(self, kind: str) -> Callable[..., object]:
        """Return the class or factory registered under `kind`.

        Raises: UnknownPlugin: no such kind. MissingExtra: its optional dependency is not installed. ConfigError:
        another package's entry point cannot be imported, raises an error, or is neither a class nor a function.
        """
        if kind in self.builtins:
            return self._resolve(EntryPoint(kind, self.builtins[kind], self.name))
        for plugin in self._entries():
            if plugin.name == kind:
                return self._resolve(plugin)
        near = self._near(kind)
        raise UnknownPlugin(
            f"{self.name} has no kind {represented(kind)}. {near}{' ' if near else ''}"
            f"Known: {', '.join(self.kinds())}. A package adds one by an entry point in the group {self.name!r}."
        )

    def _near(self, kind: str) -> str:
        """Return a sentence with the kinds that a wrong name may mean; "" if there are none."""
        meant = self.synonyms.get(kind.casefold().replace(" ", "").replace("-", "").replace("_", ""))
        return did_you_mean(kind, self.kinds()) if meant is None else f"Did you mean {' or '.join(map(repr, meant))}?"

    def installed(self) -> tuple[InstalledPlugin, ...]:
        """Return the plug-ins of other packages. Each is loaded, to find those with errors."""
        found = []
        for entry in self._entries():
            try:
                self._resolve(entry)
                is_ours = entry.name in self.builtins
                problem = "scene2hap's own kind of this name is used; give it another name" if is_ours else ""
            except Exception as cause:  # a foreign module may raise any error
                problem = str(cause) if isinstance(cause, ConfigError) else f"{type(cause).__name__}: {cause}"
            found.append(InstalledPlugin.of(entry, problem))
        return tuple(found)

    def build(self, spec: object) -> object:
        """Build an implementation from configuration: a kind, or a mapping with a `kind` and its settings.

        A ready-made implementation is returned unchanged.
        Raises: ConfigError: no `kind`, settings that the implementation does not take, or plain data, a class or an
        object without the protocol's members in place of an implementation; and as `load`.
        """
        made = self._made(spec)
        if problem := lacking(made, self.members):
            if self.wraps_functions and isfunction(made):
                problem += f" {self.wraps_functions} makes one of a function."
            raise ConfigError(f"{self.name}: {problem}")
        return made

    def _made(self, spec: object) -> object:
        if isinstance(spec, str):
            spec = {"kind": spec}
        if not isinstance(spec, Mapping):
            return self._ready_made(spec)
        settings = dict(spec)
        kind = settings.pop("kind", None)
        if not isinstance(kind, str):
            raise ConfigError(
                f"{self.name}: {shown(spec)} names no kind; write {{'kind': ...}} with its settings. "
                f"Known: {', '.join(self.kinds())}."
            )
        factory = self.load(kind)
        try:
            return factory(**settings)
        except TypeError as cause:
            reason = settings_misfit(factory, settings) or f"{str(cause).removesuffix('.')}."
            given = f"does not take {shown(settings)}" if settings else f"needs settings, {{'kind': {kind!r}, ...}}"
            raise ConfigError(f"{self.name} kind {kind!r} {given}: {reason}") from cause

    def _ready_made(self, given: object) -> object:
        if isinstance(given, type):
            raise ConfigError(f"{self.name}: {represented(given)} is a class; make one of it, {given.__name__}(...).")
        if given is None or isinstance(given, int | float | complex | bytes | list | tuple | set):
            raise ConfigError(
                f"{self.name}: {described(given)} is given; it must be a kind ({', '.join(self.kinds())}), a mapping "
                "with a 'kind' and its settings, or an implementation."
            )
        return given

    def _entries(self) -> tuple[EntryPoint, ...]:
        return tuple(entry_points(group=self.name))

    def _resolve(self, entry: EntryPoint) -> Callable[..., object]:
        try:
            import_module(entry.module)
        except ImportError as cause:
            if entry.name in self.extras:
                extra = self.extras[entry.name]
                raise MissingExtra(
                    f"{entry.name!r} needs the package {cause.name or 'of its extra'}, which is not installed. "
                    f"Run: pip install 'scene2hap[{extra}]'"
                ) from cause
            raise ConfigError(f"{self.name} kind {entry.name!r} ({entry.value}) does not import: {cause}") from cause
        except Exception as cause:  # a foreign module may raise any error
            if entry.name in self.builtins:
                raise
            raise ConfigError(
                f"{self.name} kind {entry.name!r} ({entry.value}) raises when imported: {type(cause).__name__}: {cause}"
            ) from cause
        try:
            found: Callable[..., object] = entry.load()
        except AttributeError as cause:
            raise ConfigError(f"{self.name} kind {entry.name!r}: {entry.value} does not exist.") from cause
        if not callable(found):
            raise ConfigError(f"{self.name} kind {entry.name!r} is {found!r}; it must be a class or a function.")
        return found


def lacking(made: object, members: Members) -> str:
    """Return a sentence about the first member that a foreign object lacks, or whose arguments differ; else "".

    Without this check, such a mistake would raise an AttributeError or a TypeError inside this library.
    """
    if isinstance(made, type):
        return f"{represented(made)} is a class; make one of it, {made.__name__}(...)."
    needed = ", ".join(name if takes is None else f"{name}({', '.join(takes)})" for name, takes in members.items())
    for name, takes in members.items():
        try:
            member: Any = getattr(made, name)
        except Exception as cause:
            if hasattr(type(made), name):  # a property that fails, such as one that needs a field which `open` sets
                problem = f"raises {type(cause).__name__}: {cause}. It is read at any time, also before any call"
                return f"{_class_of(made)}.{name} {problem}. See docs/plugins.md."
            member = _ABSENT
        if member is _ABSENT or (takes is not None and not callable(member)):
            return f"{_class_of(made)} has no {name!r}; it must have {needed}. See docs/plugins.md."
        if takes is not None and misfit(member, takes, {}):
            own = ", ".join(signature(member).parameters)
            return f"{_class_of(made)}.{name}({own}) must take ({', '.join(takes)}). See docs/plugins.md."
    return ""


def _class_of(made: object) -> str:
    return "None" if made is None else type(made).__name__
