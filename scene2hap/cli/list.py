"""List names for settings and edits: materials, actuators, and the kinds of every exchangeable part.

scene2hap list
scene2hap list materials
"""

from __future__ import annotations

import argparse
import inspect
from collections.abc import Callable, Mapping
from typing import Any

from scene2hap import materials
from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.cli.console import Console
from scene2hap.devices import SINKS
from scene2hap.errors import ConfigError, MissingExtra
from scene2hap.export import EXPORTS
from scene2hap.llm import BACKENDS
from scene2hap.plugins import PluginGroup
from scene2hap.propagation import MODELS
from scene2hap.scene.capture import RENDERERS

GROUPS: Mapping[str, PluginGroup] = {
    "llm": BACKENDS,
    "audio": SOURCES,
    "tactile": CONVERTERS,
    "propagation": MODELS,
    "sink": SINKS,
    "renderer": RENDERERS,
    "export": EXPORTS,
}
"""The exchangeable parts, by the setting that chooses each."""

Rows = list[dict[str, str]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap list``."""
    what = ", ".join(TABLES)
    parser.add_argument("what", metavar="WHAT", nargs="?", choices=TABLES, help=f"{what}; default: all")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show the names as tables."""
    outcome: dict[str, Any] = {}
    for name, table in TABLES.items():
        if arguments.what in (None, name):
            rows = table()
            console.table(name, tuple(rows[0]), (tuple(row.values()) for row in rows))
            outcome[name] = [{column.removeprefix(">"): value for column, value in row.items()} for row in rows]
    return outcome


def material_rows() -> Rows:
    """Return the rows of the table of materials."""
    return [
        {
            "material": row.material.name,
            ">density kg/m3": f"{row.material.density_kg_m3:g}",
            ">Young's modulus GPa": f"{row.material.youngs_modulus_pa / 1e9:.3g}",
            ">Poisson's ratio": f"{row.material.poisson_ratio:g}",
            ">loss factor": f"{row.material.loss_factor:g}",
            "also called": ", ".join(row.aliases),
        }
        for row in materials.table()
    ]


def actuator_rows() -> Rows:
    """Return the built-in actuators, by name."""
    return [
        {
            "actuator": profile.name,
            ">from Hz": f"{profile.min_frequency_hz:g}",
            ">to Hz": f"{profile.max_frequency_hz:g}",
            ">resonance Hz": f"{profile.resonance_hz:g}" if profile.resonance_hz is not None else "flat",
            ">Q": f"{profile.q:g}" if profile.q is not None else "",
        }
        for profile in ACTUATORS.values()
    ]


def kind_rows() -> Rows:
    """Return every kind of every exchangeable part, built in or registered by a package."""
    return [
        {"setting": setting, "kind": kind, "description": _description(group, kind)}
        for setting, group in GROUPS.items()
        for kind in group.kinds()
    ]


def _description(group: PluginGroup, kind: str) -> str:
    """Return the first sentence of an implementation's docstring, or the error if it cannot be loaded."""
    try:
        text = inspect.getdoc(group.load(kind)) or ""
    except (MissingExtra, ConfigError) as error:
        return str(error)
    return " ".join(text.partition("\n\n")[0].split()).partition(". ")[0].rstrip(".")


TABLES: Mapping[str, Callable[[], Rows]] = {
    "materials": material_rows,
    "actuators": actuator_rows,
    "kinds": kind_rows,
}
