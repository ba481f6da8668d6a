"""Send questions about many scenes in batches, at half the price. Each stage of questions takes up to a day.

scene2hap batch submit levels/*.glb -o bundles/ --llm openai:gpt-5
scene2hap batch status -o bundles/ --llm openai:gpt-5
scene2hap batch collect levels/*.glb -o bundles/ --llm openai:gpt-5

Give the same scenes and settings each time. Questions depend on earlier answers: submit again after each collection,
until no questions are left. Then `scene2hap bake-many` with the same arguments makes the bundles without questions.
Questions and answers are in BUNDLES/.bake-many/batch. No question is sent twice, even if a run is interrupted.
"""

from __future__ import annotations

import argparse
from typing import Any

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.many.batch import BatchReport, batch_status, collect_batch, submit_batch
from scene2hap.cli.bake import wants_pictures
from scene2hap.cli.bake_many import add_many_arguments, files, many_settings
from scene2hap.cli.console import Console
from scene2hap.cli.scene_options import scene_options
from scene2hap.errors import ConfigError, SceneError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap batch``."""
    parser.add_argument(
        "verb",
        choices=("submit", "status", "collect", "cancel"),
        metavar="VERB",
        help="submit: send ready questions; status: show progress; collect: fetch answers; cancel: end running batches",
    )
    add_many_arguments(parser, "*")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Run one step, and show the progress of the batches. Raises: SceneError: scenes cannot be read or inferred."""
    config = BakeConfig.parse(many_settings(arguments))
    if arguments.verb in ("status", "cancel"):
        report = batch_status(arguments.output, config=config, cancel=arguments.verb == "cancel")
    else:
        if not arguments.scenes:
            raise ConfigError(f"batch {arguments.verb} needs the scene files, the same ones each time.")
        step = submit_batch if arguments.verb == "submit" else collect_batch
        with console.progress() as tell:
            report = step(
                files(arguments.scenes),
                arguments.output,
                config=config,
                executor=arguments.executor,
                options=scene_options(arguments),
                pictures=wants_pictures(arguments, config),
                user_prompt=arguments.prompt,
                progress=lambda stage, name, done, total: tell("asking", f"{name} ({stage})", done, total),
            )
    _show(console, report)
    if report.errors:
        if arguments.json:
            console.outcome(report.to_data())
        raise SceneError(f"{len(report.errors)} of {report.n_scenes} scenes cannot be read or inferred.")
    return report.to_data()


def _show(console: Console, report: BatchReport) -> None:
    console.table(
        "batches",
        ("batch", "stage", "status", ">questions", ">answered", ">failed"),
        (
            (row.batch or "-", row.stage, row.status, str(len(row.requests)), str(row.completed), str(row.failed))
            for row in report.batches
        ),
    )
    for row in report.batches:
        for fault in row.faults:
            console.warn(f"{row.batch}: {fault}")
    for scene, error in report.errors.items():
        console.fail(f"{scene}: {error}")
    console.say(str(report))
    if report.n_scenes and report.n_ready == report.n_scenes:
        console.say("all questions are answered: `scene2hap bake-many` with the same arguments makes the bundles")
    elif report.n_to_send:
        console.say("`scene2hap batch submit` with the same arguments sends the remaining questions")
    elif report.n_under_way:
        console.say("`scene2hap batch collect` with the same arguments fetches the answers once batches have ended")
