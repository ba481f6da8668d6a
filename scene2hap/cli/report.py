"""Show the inferred values of each object of a bundle, their sources and reasons, and the candidate sounds.

scene2hap report kitchen.bundle
scene2hap report kitchen.bundle -o report.html
scene2hap report kitchen.bundle -o report.html --scene kitchen.glb --model exponential_plate --model modal_plate
scene2hap report kitchen.bundle --serve

-o writes a page instead: the scene in three dimensions, the felt level on every surface, all sounds, and fields for
corrections. `--serve` shows the page on this machine and writes corrections to BUNDLE.corrections.json;
`scene2hap edit BUNDLE apply` applies this file. The page shows calls, tokens and cost of the bake if
BUNDLE.account.json exists, which `scene2hap bake` writes.
"""

from __future__ import annotations

import argparse
import contextlib
from pathlib import Path
from typing import Any

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.cli.scene_options import SCENE_ARGUMENTS, add_scene_arguments, read_scene
from scene2hap.cli.shared_options import reject_unused
from scene2hap.errors import BundleError, ConfigError
from scene2hap.haptics import SourceState

_PICTURE_PX = 256


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap report``."""
    parser.add_argument("bundle", metavar="BUNDLE", help="folder that bake wrote")
    parser.add_argument("objects", metavar="OBJECT", nargs="*", help="ids of objects; default: all that vibrate")
    parser.add_argument("-o", "--output", metavar="FILE", help="write a page of the scene (.html), or its data (.json)")
    parser.add_argument("--serve", action="store_true", help="show the page on this machine until Ctrl-C")
    parser.add_argument("--port", type=int, help="port for --serve; default: a free one")
    parser.add_argument("--scene", metavar="SCENE", help="scene file, for pictures and colours on the page")
    parser.add_argument(
        "--model", action="append", metavar="KIND", help="propagation model of the felt map; may be repeated"
    )
    add_scene_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Show the inferred values, or write and serve the page."""
    if not (arguments.output or arguments.serve):
        reject_unused(arguments, ("scene", "model"), "Add -o PAGE.html or --serve for a page.")
    elif arguments.objects:
        raise ConfigError(f"{', '.join(arguments.objects)}: no effect here. A page shows all objects; leave them out.")
    if not arguments.serve:
        reject_unused(arguments, ("port",), "Add --serve.")
    if not arguments.scene:
        reject_unused(arguments, SCENE_ARGUMENTS, "Name the scene file by --scene SCENE.")
    bundle = HapticBundle.load(arguments.bundle)
    if arguments.output or arguments.serve:
        return _page(arguments, bundle, console)
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


def _page(arguments: argparse.Namespace, bundle: HapticBundle, console: Console) -> dict[str, Any]:
    """Write the page, and serve it if requested."""
    # Imported here, since no other command draws pages.
    from scene2hap.bundle.account import read_account
    from scene2hap.report import report_document, require_target, write_report
    from scene2hap.report.felt_map import MODELS
    from scene2hap.report.page import assemble
    from scene2hap.report.serve import ReportServer
    from scene2hap.scene.capture import capture_images

    pictures = None
    if arguments.output:
        require_target(arguments.output)  # before pictures are rendered
    if arguments.scene:
        pictures = capture_images(read_scene(arguments), config={"size_px": _PICTURE_PX})
    models, account = tuple(arguments.model or MODELS), read_account(arguments.bundle)
    outcome: dict[str, Any] = {"bundle": arguments.bundle}
    if arguments.output:
        written = write_report(bundle, arguments.output, models=models, pictures=pictures, account=account)
        outcome["page"] = str(written)
        console.say(f"wrote {arguments.output}, {Path(arguments.output).stat().st_size / 1e6:.1f} MB")
    if arguments.serve:
        page = assemble(report_document(bundle, models=models, pictures=pictures, account=account))
        folder = Path(arguments.bundle).absolute()  # the relative path "." has no name
        corrections = folder.with_name(f"{folder.name}.corrections.json")
        server = ReportServer(page, corrections, arguments.port or 0, lambda path: console.say(f"wrote {path}"))
        console.say(f"{server.address} (Ctrl-C ends)")
        with contextlib.suppress(KeyboardInterrupt):
            server.serve()
        outcome["corrections"] = str(corrections)
    return outcome


def _account_of_state(state: SourceState, loop: HapticLoop | None) -> str:
    parts = [f"intensity {state.intensity:g}"]
    if state.needs_contact:
        parts.append(f"on {state.needs_contact}")
    if state.start_up_s or state.wind_down_s:
        spins = ", spinning" if state.spins else ""
        parts.append(f"starts in {state.start_up_s:g} s and stops in {state.wind_down_s:g} s{spins}")
    for name, curve in () if loop is None else (("start", loop.start_up), ("stop", loop.wind_down)):
        if curve is not None:
            parts.append(f"its recording shows a {name} of {curve.lasts_s:g} s ({curve.inferred_s:g} s was inferred)")
    if state.on_s is not None and state.off_s is not None:
        parts.append(f"runs {state.on_s:g} s and rests {state.off_s:g} s in turns")
    return "; ".join(parts)


def _account(bundle: HapticBundle, object_id: str) -> dict[str, Any]:
    if object_id not in bundle.objects:
        raise BundleError(f"{object_id!r} is in the scene, but no properties were inferred for it. Bake again.")
    haptics = bundle.objects[object_id]
    by, loops = haptics.provenance, bundle.loops.get(object_id, {})
    rows = [
        ("category", haptics.object_category, by.get("object_category", "")),
        ("material", haptics.material_category, by.get("material", "")),
        (
            "surface",
            " x ".join(f"{1e3 * edge:{'.0f' if edge >= 0.1 else '.3g'}}" for edge in haptics.estimated_size_m) + " mm",
            by.get("estimated_size_m", ""),
        ),
        ("usage", haptics.usage, by.get("usage", "")),
        ("vibrates", "yes" if haptics.vibrates else "no", by.get("vibrates", "")),
        *(
            (
                f"state {state.name}",
                f"{state.sentence} ({_account_of_state(state, loops.get(state.name))})",
                by.get(f"states.{state.name}", ""),
            )
            for state in haptics.states
        ),
        *((f"felt {state}", str(loop.felt), "") for state, loop in loops.items() if loop.felt is not None),
        ("confidence", f"{haptics.confidence:.2f}", ""),
    ]
    if gain_db := bundle.gain_db(object_id):
        rows.append(("level", f"{gain_db:+g} dB", "user"))
    return {"fields": rows, "reasons": dict(haptics.reasons), "choices": dict(bundle.choices.get(object_id, {}))}
