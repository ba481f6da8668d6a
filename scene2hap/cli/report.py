"""Tell of each object of a bundle what was inferred, by whom and why, and which sounds were considered."""

from __future__ import annotations

import argparse
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.errors import BundleError

HELP = "bundle -> who said what of each object, and why"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``scene2hap report``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote")
    parser.add_argument("objects", metavar="OBJECT", nargs="*", help="ids to tell of; all that vibrate without any")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show the account."""
    bundle = HapticBundle.load(arguments.bundle)
    ids = [bundle.snapshot.object(key).id for key in arguments.objects] or list(bundle.loops)
    accounts = {key: _account(bundle, key) for key in ids}
    for key, account in accounts.items():
        console.table(key, ("field", "value", "by"), account["fields"])
        for name, reason in account["reasons"].items():
            console.say(f"{name}: {reason}")
        for state, table in account["choices"].items():
            console.say(f"\nsounds considered for {state}:\n{table}")
        console.say("")
    return {"bundle": arguments.bundle, "objects": accounts}


def _account(bundle: HapticBundle, object_id: str) -> dict[str, Any]:
    if object_id not in bundle.objects:
        raise BundleError(f"{object_id!r} stands in the scene, but nothing was inferred of it. Bake again.")
    haptics = bundle.objects[object_id]
    by = haptics.provenance
    rows = [
        ("category", haptics.object_category, by.get("object_category", "")),
        ("material", haptics.material_category, by.get("material", "")),
        (
            "surface",
            " x ".join(f"{1e3 * edge:.3g}" for edge in haptics.estimated_size_m) + " mm",
            by.get("estimated_size_m", ""),
        ),
        ("usage", haptics.usage, by.get("usage", "")),
        ("vibrates", "yes" if haptics.vibrates else "no", by.get("vibrates", "")),
        *(
            (
                f"state {state.name}",
                f"{state.sentence} (intensity {state.intensity:g}"
                + (f", on {state.needs_contact})" if state.needs_contact else ")"),
                by.get(f"states.{state.name}", ""),
            )
            for state in haptics.states
        ),
        ("confidence", f"{haptics.confidence:.2f}", ""),
    ]
    if gain_db := bundle.gain_db(object_id):
        rows.append(("level", f"{gain_db:+g} dB", "user"))
    return {"fields": rows, "reasons": dict(haptics.reasons), "choices": dict(bundle.choices.get(object_id, {}))}
