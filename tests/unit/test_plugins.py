"""Plugin groups: building built-in parts and plugins from their kind and settings."""

import re
from dataclasses import replace
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from scene2hap import plugins
from scene2hap.devices import SINKS
from scene2hap.errors import ConfigError, MissingExtra, UnknownPlugin
from scene2hap.export import EXPORTS
from scene2hap.llm import BACKENDS
from scene2hap.plugins import PluginGroup

GROUP = PluginGroup(
    "scene2hap.test",
    builtins={"fraction": "fractions:Fraction", "absent": "scene2hap_no_such_module:Thing", "gone": "math:no_such"},
    extras={"absent": "things"},
)


def test_builtin_is_built_from_kind_and_settings() -> None:
    assert str(GROUP.build({"kind": "fraction", "numerator": 3, "denominator": 6})) == "1/2"
    assert str(GROUP.build("fraction")) == "0"


def test_ready_made_passes_through() -> None:
    ready = object()
    assert GROUP.build(ready) is ready


def test_unknown_kind_names_the_known() -> None:
    with pytest.raises(UnknownPlugin, match=r"no kind 'fractoin'.*absent, fraction, gone"):
        GROUP.load("fractoin")


def test_missing_extra_is_named() -> None:
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[things\]'"):
        GROUP.load("absent")


def test_wrong_settings_name_the_kind() -> None:
    with pytest.raises(ConfigError, match=r"'fraction' does not take \{'colour': 1\}"):
        GROUP.build({"kind": "fraction", "colour": 1})


def test_a_kind_that_needs_settings_says_which() -> None:
    with pytest.raises(ConfigError, match=r"'wav' needs settings, \{'kind': 'wav', ...\}: the setting path is missing"):
        SINKS.build("wav")


def test_settings_without_kind_are_refused() -> None:
    with pytest.raises(ConfigError, match="names no kind"):
        GROUP.build({"numerator": 1})


def test_missing_attribute_is_named() -> None:
    with pytest.raises(ConfigError, match="math:no_such does not exist"):
        GROUP.load("gone")


def test_plugins_are_found_by_entry_points(monkeypatch: pytest.MonkeyPatch) -> None:
    plugin = EntryPoint("decimal", "decimal:Decimal", "scene2hap.test")
    monkeypatch.setattr(plugins, "entry_points", lambda group: (plugin,) if group == "scene2hap.test" else ())
    assert "decimal" in GROUP.kinds()
    assert str(GROUP.build({"kind": "decimal", "value": "1.5"})) == "1.5"


def test_broken_plugin_raises_a_plugin_error(monkeypatch: pytest.MonkeyPatch) -> None:
    plugin = EntryPoint("broken", "scene2hap_no_such_module:Thing", "scene2hap.test")
    monkeypatch.setattr(plugins, "entry_points", lambda group: (plugin,))
    with pytest.raises(ConfigError, match="does not import"):
        GROUP.load("broken")


def test_plugins_are_listed_with_their_errors(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "scene2hap_breaks.py").write_text("1 / 0")
    monkeypatch.syspath_prepend(tmp_path)
    found = {
        "decimal": "decimal:Decimal",
        "broken": "scene2hap_no_such:Thing",
        "gone": "math:no",
        "breaks": "scene2hap_breaks:X",
        "number": "math:pi",
        next(iter(GROUP.builtins)): "decimal:Decimal",
    }
    installed = tuple(EntryPoint(name, value, GROUP.name) for name, value in found.items())
    monkeypatch.setattr(plugins, "entry_points", lambda group: installed)
    problems = {plugin.kind: plugin.problem for plugin in GROUP.installed()}
    assert problems.pop("decimal") == ""
    assert "does not import" in problems["broken"]
    assert "math:no does not exist" in problems["gone"]
    assert problems["breaks"] == (
        f"{GROUP.name} kind 'breaks' (scene2hap_breaks:X) raises when imported: ZeroDivisionError: division by zero"
    )
    with pytest.raises(ConfigError, match="raises when imported: ZeroDivisionError"):
        GROUP.load("breaks")
    assert "is 3.14159" in problems["number"]
    assert "it must be a class or a function" in problems["number"]
    assert "scene2hap's own kind of this name is used" in problems[next(iter(GROUP.builtins))]


class Half:
    def start(self) -> None:
        """Lacks the parameter of the protocol."""

    @property
    def sum(self) -> int:
        return self.parts  # type: ignore[attr-defined, no-any-return]  # set by a later call

    @property
    def quotient(self) -> float:
        return 1 / 0


@pytest.mark.parametrize(
    ("members", "words"),
    [
        ({"stop": ()}, "Half has no 'stop'; it must have stop()"),
        ({"stats": None}, "Half has no 'stats'; it must have stats"),
        ({"start": ("fill",)}, "Half.start() must take (fill)"),
        ({"__doc__": ()}, "Half has no '__doc__'"),
        ({"sum": None}, "Half.sum raises AttributeError: 'Half' object has no attribute 'parts'. It is read"),
        ({"quotient": None}, "Half.quotient raises ZeroDivisionError: division by zero. It is read at any time"),
    ],
)
def test_error_for_a_missing_member_names_the_class(members: plugins.Members, words: str) -> None:
    group = replace(GROUP, members=members)
    with pytest.raises(ConfigError, match=re.escape(f"scene2hap.test: {words}")):
        group.build(Half())
    assert not plugins.lacking(Half(), {"start": (), "__module__": None})


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        ("quest", "Did you mean 'haptic'?"),
        ("Meta Quest", "Did you mean 'haptic'?"),
        ("iOS", "Did you mean 'ahap'?"),
        ("openxr", "Did you mean 'openxr_pcm' or 'openxr_envelope' or 'openxr_parametric'?"),
        ("haptics", "Did you mean 'haptic'?"),
    ],
)
def test_a_device_in_place_of_an_export_names_the_kind_that_it_plays(asked: str, meant: str) -> None:
    with pytest.raises(UnknownPlugin, match=re.escape(meant)):
        EXPORTS.load(asked)


@pytest.mark.parametrize(
    ("words", "meant"), [("gpt-4o", "openai:gpt-4o"), ("Ollama", "local"), ("vLLM", "local"), ("chatgpt", "openai")]
)
def test_models_and_servers_suggest_the_kind_of_backend(words: str, meant: str) -> None:
    with pytest.raises(UnknownPlugin, match=f"Did you mean '{meant}'"):
        BACKENDS.build(words)
