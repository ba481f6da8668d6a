"""Tell of each object of a bundle what was inferred, by whom and why, and which sounds were considered."""

from __future__ import annotations

import argparse
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.errors import BundleError
from scene2hap.haptics import SourceState

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


def _account_of_state(state: SourceState) -> str:
    parts = [f"intensity {state.intensity:g}"]
    if state.needs_contact:
        parts.append(f"on {state.needs_contact}")
    if state.start_up_s or state.wind_down_s:
        spins = ", spinning" if state.spins else ""
        parts.append(f"starts in {state.start_up_s:g} s and stops in {state.wind_down_s:g} s{spins}")
    if state.on_s is not None and state.off_s is not None:
        parts.append(f"runs {state.on_s:g} s and rests {state.off_s:g} s in turns")
    return "; ".join(parts)


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
                f"{state.sentence} ({_account_of_state(state)})",
                by.get(f"states.{state.name}", ""),
            )
            for state in haptics.states
        ),
        *(
            (f"felt {state}", str(loop.felt), "")
            for state, loop in bundle.loops.get(object_id, {}).items()
            if loop.felt is not None
        ),
        ("confidence", f"{haptics.confidence:.2f}", ""),
    ]
    if gain_db := bundle.gain_db(object_id):
        rows.append(("level", f"{gain_db:+g} dB", "user"))
    return {"fields": rows, "reasons": dict(haptics.reasons), "choices": dict(bundle.choices.get(object_id, {}))}
