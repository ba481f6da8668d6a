"""Rows of scenes and bundles, for tables and for JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.sensation import Sensation, level_of
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.edited_loops import is_edited
from scene2hap.bundle.override import NONE, Override
from scene2hap.cli.console import Console
from scene2hap.common.counted import counted
from scene2hap.haptics import ObjectHaptics, SourceState, is_unknown
from scene2hap.llm.chain.report import InferenceReport
from scene2hap.llm.wrappers.prices import Given, price_list
from scene2hap.scene.snapshot import SceneSnapshot

MOST_WARNINGS = 5
"""Most warnings of one kind that are shown after a bake."""


def scene_outcome(scene: SceneSnapshot) -> dict[str, Any]:
    """Return a scene as JSON values, without its meshes."""
    return {
        "scene": scene.name,
        "up_axis": scene.up_axis,
        "objects": [
            {
                "id": item.id,
                "name": item.name,
                "position_m": list(item.pose.position_m),
                "size_m": list(item.size_m),
                "relative_height_m": item.relative_height_m,
                "surface_flags": list(item.surface.flags),
                "triangles": len(item.geometry.mesh.faces),
            }
            for item in scene.objects
        ],
    }


def show_scene(console: Console, scene: SceneSnapshot, overrides: Mapping[str, Override] | None = None) -> None:
    """Show the objects of a scene as a table, with the thicknesses that a person has corrected."""
    corrected = {key: wish.thickness_m for key, wish in (overrides or {}).items() if wish.thickness_m is not None}
    console.table(
        f"{scene.name}: {counted(len(scene.objects), 'object')}, {scene.up_axis} up",
        ("object", ">length m", ">width m", ">thick m", ">height m", ">triangles", "measured"),
        (
            (
                item.id,
                *(
                    f"{edge:.3f}" if edge >= 0.01 else f"{edge:.3g}"
                    for edge in (*item.size_m[:2], corrected.get(item.id, item.size_m[2]))
                ),
                f"{item.relative_height_m:.2f}",
                str(len(item.geometry.mesh.faces)),
                ", ".join((*item.surface.flags, *["thickness corrected"] * (item.id in corrected))) or "well",
            )
            for item in scene.objects
        ),
    )


def bundle_outcome(bundle: HapticBundle) -> dict[str, Any]:
    """Return the contents of a bundle as JSON values."""
    return {
        "scene": bundle.snapshot.name,
        "scene_category": bundle.scene_category,
        "counts": bundle_counts(bundle),
        "objects": {
            object_id: {
                "category": haptics.object_category,
                "material": haptics.material.name if haptics.material else None,
                "size_m": list(haptics.estimated_size_m),
                "mass_kg": haptics.mass_kg,
                "confidence": haptics.confidence,
                "vibrates": haptics.vibrates,
                "corrected": [*bundle.overrides.get(object_id, NONE).corrections()],
                "states": {
                    state: {
                        "raw_hz": loop.frequency_raw_hz,
                        "tactile_hz": loop.frequency_tactile_hz,
                        "felt": None if loop.felt is None else asdict(loop.felt),
                        "is_edited": is_edited(loop),
                        **_times_outcome(haptics, state, loop),
                    }
                    for state, loop in bundle.loops.get(object_id, {}).items()
                },
            }
            for object_id, haptics in bundle.objects.items()
        },
    }


def _times_outcome(haptics: ObjectHaptics, name: str, loop: HapticLoop) -> dict[str, Any]:
    """Return the start and stop times of a state [s], inferred and recorded."""
    inferred = {state.name: state for state in haptics.states}.get(name)
    return {
        "start_up_s": None if inferred is None else inferred.start_up_s,
        "wind_down_s": None if inferred is None else inferred.wind_down_s,
        "recorded_start_up_s": None if loop.start_up is None else loop.start_up.lasts_s,
        "recorded_wind_down_s": None if loop.wind_down is None else loop.wind_down.lasts_s,
    }


def bundle_counts(bundle: HapticBundle) -> dict[str, int]:
    """Return the numbers of objects, sources, and unrecognised objects."""
    unknown = sum(is_unknown(haptics.object_category) for haptics in bundle.objects.values())
    return {"objects": len(bundle.objects), "sources": len(bundle.loops), "unknown": unknown}


def show_bundle(console: Console, bundle: HapticBundle) -> None:
    """Show the inferred values of each object as a table, sources first."""
    counts = bundle_counts(bundle)
    console.table(
        f"{bundle.snapshot.name}: {bundle.scene_category}, "
        + ", ".join(_with_noun(number, what) for what, number in counts.items()),
        (
            *("object", "type", "material", ">mass kg", ">confidence", "vibrates", ">sound Hz", ">vibration Hz"),
            *(">felt dB", "starts, stops s"),
        ),
        (
            _bundle_row(bundle, object_id)
            for object_id in sorted(bundle.objects, key=lambda key: key not in bundle.loops)
        ),
    )
    if bundle.loops:
        console.say("`scene2hap inspect --help` explains the columns.")


def _with_noun(number: int, what: str) -> str:
    """Return a number with its noun, or with an adjective such as "unknown"."""
    return counted(number, what[:-1]) if what.endswith("s") else f"{number} {what}"


def _bundle_row(bundle: HapticBundle, object_id: str) -> tuple[str, ...]:
    haptics = bundle.objects[object_id]
    loops = bundle.loops.get(object_id, {})
    return (
        object_id,
        haptics.object_category,
        haptics.material_category,
        "" if haptics.mass_kg is None else f"{haptics.mass_kg:.3g}",
        f"{haptics.confidence:.2f}",
        ", ".join(f"{state.name} ({state.keywords})" for state in haptics.states),
        ", ".join(f"{loop.frequency_raw_hz:.0f}" for loop in loops.values()),
        ", ".join(place_of(loop) for loop in loops.values()),
        ", ".join(_level(loop.felt) for loop in loops.values()),
        ", ".join(times_of(state, loops.get(state.name)) for state in haptics.states),
    )


def place_of(loop: HapticLoop) -> str:
    """Format the most felt frequency of a loop, its origin if moved by more than a hertz, and its roughness [Hz]; as it
    was made, if a person has edited it since."""
    felt, place = loop.felt, f"{loop.frequency_tactile_hz:.0f}"
    if felt is not None and felt.is_moved:
        place += f" from {felt.own_hz:.0f}"
    if felt is not None and felt.rough_hz is not None:
        place += f" rough {felt.rough_hz:.0f}"
    return f"{place}, edited" if is_edited(loop) else place


def times_of(state: SourceState, loop: HapticLoop | None) -> str:
    """Format the start and stop times of a state [s], and mark those that come from its recording."""
    curves = (None, None) if loop is None else (loop.start_up, loop.wind_down)
    return " ".join(
        f"{time_s:.2g}" + ("" if curve is None else " recorded" if curve.lasts_s == time_s else " recorded, stretched")
        for time_s, curve in zip((state.start_up_s, state.wind_down_s), curves, strict=True)
    )


def _level(felt: Sensation | None) -> str:
    return "?" if felt is None else level_of(felt.level_db, felt.asked_level_db)


def show_report(console: Console, report: InferenceReport, prices: Mapping[str, Given] | None = None) -> None:
    """Show an inference's calls, tokens, cost, skipped questions, and errors."""
    n_calls = sum(report.calls.values())
    tokens = sum(used.get("total_tokens", 0) for used in report.tokens.values())
    said = [f"{counted(n_calls, 'call')}, {report.kept} of them answered from a cache or recording"]
    said += [f"{number} skipped: {reason.replace('_', ' ')}" for reason, number in report.skipped.items() if number]
    if report.tokens:
        cost = report.cost_usd(price_list(prices))
        said.append(f"{tokens:,} tokens, {'cost unknown' if cost is None else f'{cost:.3f} US dollars'}")
    console.say("inference: " + "; ".join(said))
    _warn_of_some(console, [f"{what or 'the scene'}: {problem}" for what, problem in report.errors.items()])
    _warn_of_some(console, [f"material {word!r}: {'; '.join(flags)}" for word, flags in report.flags.items()])
    _warn_of_some(console, [f"{object_id}: {'; '.join(doubts)}" for object_id, doubts in report.doubts.items()])


def _warn_of_some(console: Console, sentences: Sequence[str]) -> None:
    """Show the first warnings of one kind, and count the rest, since one wrong unit makes every mass doubtful."""
    for sentence in sentences[:MOST_WARNINGS]:
        console.warn(sentence)
    if len(sentences) > MOST_WARNINGS:
        console.warn(f"{len(sentences) - MOST_WARNINGS} more like this; `scene2hap report -o FILE` lists all.")
