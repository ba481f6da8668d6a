"""Write a bundle, one haptic clip or one sound file in the formats of other platforms and programs.

scene2hap export kitchen.bundle --to haptic -o quest/
scene2hap export kitchen.bundle --to ahap --to android --touches tour.json -o phones/
scene2hap export kitchen.bundle --to '{"kind": "openxr_pcm", "sample_rate_hz": 8000}' -o xr/
scene2hap export kettle.haptic --to ahap -o kettle/

A bundle gives every state of every source, and with --touches every hand over time. The folder also has manifest.json,
which lists the files for an engine, and report.txt with the error of each file.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

from scene2hap.bundle import HapticBundle
from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.cli.shared_options import session_config
from scene2hap.common.counted import counted
from scene2hap.errors import ConfigError
from scene2hap.export import EXPORTS, ExportReport, export_bundle, export_clip
from scene2hap.export.exporting import ALL


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap export``."""
    parser.add_argument("source", metavar="BUNDLE", help="folder that bake wrote, or a .haptic, .ahap or sound file")
    kinds = ", ".join(EXPORTS.builtins)
    parser.add_argument(
        "--to",
        metavar="KIND",
        action="append",
        help=f"one of {kinds}, or JSON with a kind and its settings; can be repeated; default {ALL}",
    )
    parser.add_argument("-o", "--output", metavar="FOLDER", required=True, help="folder to write to")
    parser.add_argument("--touches", metavar="FILE", help="also export each hand over time, see docs/touches.md")
    parser.add_argument("--update-rate-hz", metavar="HZ", type=float, default=100.0, help="updates per second (100)")
    parser.add_argument("--settings", metavar="FILE", help="TOML or JSON with a table [session]")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Export, and show the error of each file."""
    source = Path(arguments.source)
    specs: list[Any] = [given_spec("--to", one) for one in arguments.to or [ALL]]
    with console.progress() as tell:
        if os.path.isfile(source) and source.name != "bundle.json":
            if arguments.touches or arguments.settings:
                raise ConfigError("--touches and --settings need a bundle; one clip has no scene to touch.")
            report = export_clip(source, arguments.output, specs, progress=tell)
        else:
            bundle = HapticBundle.load(source)
            config = session_config(arguments.settings, bundle)
            report = export_bundle(
                bundle,
                arguments.output,
                specs,
                touches=arguments.touches,
                config=config,
                update_rate_hz=arguments.update_rate_hz,
                progress=tell,
            )
    _show(console, report)
    console.say(
        f"wrote {counted(len(report.files), 'file')} below {arguments.output}; report.txt has the error of each"
    )
    if report.removed:
        console.say(f"removed {counted(len(report.removed), 'file')} of sources that no longer exist")
    return report.to_data()


def _show(console: Console, report: ExportReport) -> None:
    rows = []
    for row in report.rows:
        found = row.fidelity
        amplitude, frequency = row.points_per_s
        rows.append(
            (
                row.kind,
                f"{row.track}.{row.channel}" if row.channel else row.track,
                f"{row.duration_s:.1f}",
                f"{found.median_db:.2f}" if found else "-",
                f"{found.p95_db:.2f}" if found else "-",
                f"{found.median_jnd:.2f}" if found and found.median_jnd is not None else "-",
                f"{amplitude:.0f} + {frequency:.0f}" if found and found.amplitude_points else "-",
            )
        )
    console.table(
        report.folder,
        (
            *("format", "track", ">duration s", ">amplitude error dB", ">95 % dB", ">frequency error JND"),
            ">points per s, amplitude + frequency",
        ),
        rows,
    )
