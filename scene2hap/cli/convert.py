"""Convert sound files into tactile ones, without a scene.

scene2hap convert hum.wav -o hum_felt.wav
scene2hap convert sounds/ more.flac -o felt/ --converter '{"kind": "svf_bandpass", "q": 2}' --actuator lra --picture

Files and folders are converted in parallel and keep their names. Each file is written whole or not at all. If one
fails, the others continue, and the exit status is 1.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import asdict
from typing import Any

from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.conversion import FORMATS, Conversion, Failure, convert_files
from scene2hap.audio.files import READABLE
from scene2hap.audio.sensation import level_of
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.common.counted import counted
from scene2hap.errors import AudioError, ConfigError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap convert``."""
    parser.add_argument(
        "sources",
        metavar="IN",
        nargs="+",
        help=f"sound files ({READABLE}), or folders of them",
    )
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="a file for one file, otherwise a folder")
    parser.add_argument(
        "--converter",
        metavar="KIND",
        default=DEFAULT_CONVERTER,
        help=f"one of {', '.join(CONVERTERS.builtins)}, or JSON with a kind and its settings; "
        f"default {DEFAULT_CONVERTER}, as in a bake",
    )
    parser.add_argument(
        "--actuator",
        metavar="NAME|CSV",
        default="flat",
        help=f"one of {', '.join(ACTUATORS)}, or a CSV file of its response in Hz and dB",
    )
    parser.add_argument(
        "--intensity",
        type=float,
        default=1.0,
        metavar="0..1",
        help="of the source, above 0; default 1, as strong as each sound and the actuator allow",
    )
    parser.add_argument(
        "--format", choices=[suffix[1:] for suffix in FORMATS], default="wav", help="of files in a folder, default wav"
    )
    parser.add_argument("--raw", action="store_true", help="output of the converter, neither equalized nor levelled")
    parser.add_argument(
        "--loop",
        action=argparse.BooleanOptionalAction,
        help="the sounds are loops, and so are the results; without it, those WAVs that mark all of themselves as one",
    )
    parser.add_argument("--mono", action="store_true", help="mix the channels of each file first")
    parser.add_argument("--picture", action="store_true", help="draw spectrograms and envelopes beside each file")
    parser.add_argument("--force", action="store_true", help="overwrite files that exist")
    parser.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="number of processes, default one per processor, fewer for short sounds",
    )


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Convert, and show input and output of each file. Raises: AudioError: a file could not be converted."""
    if arguments.workers is not None and arguments.workers < 1:
        raise ConfigError(f"--workers is {arguments.workers}; it must be at least 1.")
    with console.progress() as tell:
        outcomes = convert_files(
            arguments.sources,
            arguments.output,
            suffix=f".{arguments.format}",
            pictures=arguments.picture,
            workers=arguments.workers,
            progress=lambda name, done, total: tell("converting", name, done, total),
            converter=given_spec("--converter", arguments.converter),
            actuator=arguments.actuator,
            intensity=arguments.intensity,
            mono=arguments.mono,
            raw=arguments.raw,
            loop=arguments.loop,
            overwrite=arguments.force,
        )
    made = [outcome for outcome in outcomes if isinstance(outcome, Conversion)]
    failed = [outcome for outcome in outcomes if isinstance(outcome, Failure)]
    outcome = {
        "converted": [_outcome(one) for one in made],
        "failed": [{"source": str(one.source), "reason": one.reason} for one in failed],
    }
    if made:
        _show(console, made)
    for one in made:
        if one.n_clipped:
            console.warn(f"{one.output}: {one.n_clipped} samples beyond full scale were cut to it.")
        if one.level_doubt:
            console.warn(one.level_doubt)
    for failure in failed:
        console.fail(failure.reason)
    if failed:
        if arguments.json:
            console.outcome(outcome)
        raise AudioError(f"{len(failed)} of {len(outcomes)} files were not converted.")
    return outcome


def _show(console: Console, made: list[Conversion]) -> None:
    total = sum(one.duration_s for one in made)
    console.table(
        f"{counted(len(made), 'file')}, {total:.1f} s of sound",
        (
            *("file", ">duration s", ">peak before dB", ">peak after dB", ">felt dB"),
            *(">strongest before Hz", ">most felt after Hz", ">times real time"),
        ),
        (
            (
                str(one.output),
                f"{one.duration_s:.2f}",
                _decibels(one.peak_in),
                _decibels(one.peak_out),
                _level(one),
                _hertz(one.frequency_in_hz),
                _hertz(one.frequency_out_hz),
                f"{one.duration_s / one.elapsed_s:.0f}",
            )
            for one in made
        ),
    )


def _outcome(one: Conversion) -> dict[str, Any]:
    return {key: value if isinstance(value, int | float | None) else str(value) for key, value in asdict(one).items()}


def _decibels(peak: float) -> str:
    return f"{20 * math.log10(peak):.1f}" if peak > 0.0 else "silent"


def _level(one: Conversion) -> str:
    return "-" if one.level_db is None or one.asked_level_db is None else level_of(one.level_db, one.asked_level_db)


def _hertz(frequency: float | None) -> str:
    return "-" if frequency is None else f"{frequency:.2f}"
