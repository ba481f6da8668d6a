"""Bake many scene files, each into its own bundle. A stopped run can be continued.

scene2hap bake-many levels/*.glb -o bundles/
scene2hap bake-many levels/*.glb -o bundles/ --executor processes
scene2hap bake-many levels/*.glb -o bundles/ --executor dask:tcp://10.0.0.1:8786 --llm openai:gpt-4o --max-cost 20
scene2hap bake-many levels/*.glb -o bundles/ --llm openai:gpt-4o --dry-run

Scenes are kept if their file and settings have not changed. A failed scene does not stop the others; the exit status is
then 1. BUNDLES/report.json has the results of every scene.
"""

from __future__ import annotations

import argparse
import glob
import os
import time
from collections import Counter
from pathlib import Path
from typing import Any

from scene2hap.baking.config import BakeConfig
from scene2hap.baking.many import ManyReport, bake_many, plan_many
from scene2hap.cli.bake import add_model_arguments, bake_settings, wants_pictures
from scene2hap.cli.console import Console
from scene2hap.cli.scene_options import add_scene_arguments, scene_options
from scene2hap.common.counted import counted
from scene2hap.common.printable import quoted
from scene2hap.errors import ConfigError, SceneError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap bake-many``."""
    add_many_arguments(parser, "+")
    parser.add_argument(
        "--dry-run", action="store_true", help="show what would be baked, and calls and cost; no model is called"
    )


def add_many_arguments(parser: argparse.ArgumentParser, n_scenes: str) -> None:
    """Add the arguments for scenes, output folder and settings."""
    parser.add_argument("scenes", metavar="SCENE", nargs=n_scenes, help="scene files, or quoted patterns")
    parser.add_argument("-o", "--output", metavar="FOLDER", required=True, help="folder of bundles")
    parser.add_argument(
        "--executor", metavar="WHERE", help="processes, processes:N, or dask:ADDRESS; default: this process"
    )
    parser.add_argument("--share-scenes", action="store_true", help="ask about equal objects of several scenes once")
    add_model_arguments(parser)
    add_scene_arguments(parser)


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Bake, and show the outcome of each scene. Raises: SceneError: some were not baked, or cannot be."""
    config = BakeConfig.parse(many_settings(arguments))
    if arguments.dry_run:
        return _dry_run(arguments, config, console)
    begun = time.monotonic()
    with console.progress() as tell:

        def progress(stage: str, name: str, done: int, total: int) -> None:
            rest_s = (time.monotonic() - begun) / done * (total - done)
            tell("baking", f"{name} ({stage}, {rest_s:.0f} s left)", done, total)

        report = bake_many(
            files(arguments.scenes),
            arguments.output,
            config=config,
            executor=arguments.executor,
            options=scene_options(arguments),
            pictures=wants_pictures(arguments, config),
            user_prompt=arguments.prompt,
            progress=progress,
        )
    _show(console, report)
    outcome = report.to_data()
    if report.failed:
        if arguments.json:
            console.outcome(outcome)
        raise SceneError(f"{len(report.failed)} of {len(report.scenes)} scenes were not baked; run again to go on.")
    return outcome


def _dry_run(arguments: argparse.Namespace, config: BakeConfig, console: Console) -> dict[str, Any]:
    with console.progress() as tell:
        plans = plan_many(
            files(arguments.scenes),
            arguments.output,
            config=config,
            options=scene_options(arguments),
            pictures=wants_pictures(arguments, config),
            user_prompt=arguments.prompt,
            progress=lambda stage, name, done, total: tell("planning", f"{name} ({stage})", done, total),
        )
    rows = []
    for one in plans:
        run = one.questions
        calls = ("-", "-", "-") if run is None else (str(run.n_calls), str(run.kept), _shown(run.cost_usd))
        rows.append((Path(one.bundle).stem, str(one), str(one.n_objects or "-"), *calls))
    console.table("what would be done", ("scene", "plan", ">objects", ">calls", ">from cache", ">about $"), rows)
    for one in plans:
        if one.error:
            console.fail(f"{one.scene}: {one.error}")
    plan = ", ".join(f"{n} to {what}" for what, n in Counter(map(str, plans)).items())
    runs = [one.questions for one in plans if one.questions is not None]
    costs = [run.cost_usd for run in runs]
    cost = None if None in costs else sum(cost for cost in costs if cost is not None)
    n_calls, n_kept = sum(run.n_calls for run in runs), sum(run.kept for run in runs)
    questions = f"; {counted(n_calls, 'call')}, {n_kept} in the cache, about {_shown(cost)} dollars" if runs else ""
    console.say(f"{counted(len(plans), 'scene')}: {plan}{questions}")
    outcome = {"calls": n_calls, "calls_kept": n_kept, "cost_usd": cost, "scenes": [one.to_data() for one in plans]}
    if failing := sum(one.plan == "fail" for one in plans):
        if arguments.json:
            console.outcome(outcome)
        raise SceneError(f"{failing} of {counted(len(plans), 'scene')} cannot be baked.")
    return outcome


def many_settings(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the settings of a bake of many scenes. Raises: ConfigError."""
    settings = bake_settings(arguments)
    return {**settings, "share_scenes": True} if arguments.share_scenes else settings


def files(given: list[str]) -> list[str]:
    """Return the files and the matches of patterns, each once. Raises: ConfigError: a pattern matches none."""
    found: list[str] = []
    for one in given:
        matches = [one] if os.path.exists(one) or not glob.has_magic(one) else sorted(glob.glob(one, recursive=True))
        if not matches:
            raise ConfigError(f"no file matches {quoted(one)}. Check the pattern.")
        found += matches
    return list(dict.fromkeys(found))


def _shown(cost_usd: float | None) -> str:
    return "unknown" if cost_usd is None else f"{cost_usd:.2f}"


def _show(console: Console, report: ManyReport) -> None:
    console.table(
        "scenes",
        ("scene", "outcome", ">objects", ">unknown", ">sources", ">calls", ">from cache", ">s"),
        (
            (
                Path(one.bundle).stem,
                one.outcome,
                str(one.n_objects),
                str(one.n_unknown),
                str(one.n_sources),
                str(one.calls),
                str(one.kept),
                f"{sum(one.seconds.values()):.1f}",
            )
            for one in report.scenes
        ),
    )
    for one in report.scenes:
        for sentence in one.warnings:
            console.warn(f"{one.scene}: {sentence}")
    for one in report.failed:
        console.fail(f"{one.scene}: {one.error}")
    console.say(str(report))
