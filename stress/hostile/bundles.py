"""Bundles with the files beside them, and haptic clips."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from stress.hostile.reader import add, writes


def _bundle(folder: Path) -> Path:
    from scene2hap import HapticBundle
    from scene2hap.bundle.account import write_account
    from stress.attacks.bundles import sound

    sound(folder)
    bundle = HapticBundle.load(folder / "sound" / "room")
    bundle = bundle.override("fan", clip=bundle.loops["fan"][next(iter(bundle.loops["fan"]))].audible)
    path = bundle.save(folder / "room")
    shutil.rmtree(folder / "sound")
    (folder / "scene.json").unlink()
    tokens = {"gpt-4o": {"prompt_tokens": 5, "completion_tokens": 3, "cached_tokens": 1}}
    said = {"calls": {"scene_analyzer": 1}, "kept": 2, "skipped": {"copies": 1}, "tokens": tokens, "unmetered": 0}
    said |= {"service_tiers": [], "errors": {"fan": "no answer"}, "flags": {"oak": ["x"]}, "doubts": {"phone": ["y"]}}
    write_account(path, {**said, "cost_usd": 0.5})
    return path


def _played(path: Path) -> object:
    from scene2hap import HapticBundle, HapticSession, Touch

    bundle = HapticBundle.load(path)
    found: list[object] = [bundle.objects, bundle.loops, bundle.overrides, bundle.snapshot.objects, bundle.made_with]
    with HapticSession(bundle.snapshot, bundle, {"prepare": "blocking"}) as session:
        touches = [
            Touch(hand, item.id, item.pose.position_m)
            for hand, item in zip(("left", "right"), bundle.snapshot.objects, strict=False)
        ]
        frame = session.update({}, touches)
        found += [frame.gains, session.render(2000)]
        found += [session.explain(one.hand) for one in touches]
    return found


def _reported(path: Path) -> object:
    from scene2hap import HapticBundle
    from scene2hap.bundle.account import read_account
    from scene2hap.report import write_report

    account = read_account(path)
    bundle = HapticBundle.load(path)
    write_report(bundle, path.parent / "page.html", account=account)
    return None


def _corrections(folder: Path) -> Path:
    path = folder / "corrections.json"
    rows = {"phone": {"gain_db": -3.0, "material": "oak", "vibrates": True, "muted": True}}
    path.write_text(json.dumps({"format": "scene2hap/overrides", "version": 1, "overrides": rows}))
    return path


def _corrected(path: Path) -> object:
    from scene2hap.bundle.corrections import read_corrections
    from scenes import table_with_two_phones

    bundle = table_with_two_phones()[1]
    for object_id, row in read_corrections(path).items():
        bundle = bundle.override(object_id, **row)
    return bundle.overrides


add("bundle", _bundle, _played, "room/*.json", "room/*.json", "room/meshes/*", "room/sounds/*")
add("account", _bundle, _reported, "*.account.json", names_file=False)
add("corrections", _corrections, _corrected, names_file=False)

_HAPTIC = {
    "version": {"major": 1, "minor": 0, "patch": 0},
    "metadata": {"editor": "x", "author": "y", "source": "z", "project": "", "tags": ["a"], "description": ""},
    "signals": {
        "continuous": {
            "envelopes": {
                "amplitude": [
                    {"time": 0.0, "amplitude": 0.2, "emphasis": {"amplitude": 0.5, "frequency": 0.5}},
                    {"time": 0.5, "amplitude": 1.0},
                    {"time": 1.0, "amplitude": 0.0},
                ],
                "frequency": [{"time": 0.0, "frequency": 0.3}, {"time": 1.0, "frequency": 0.9}],
            }
        }
    },
}
_AHAP = {
    "Version": 1.0,
    "Metadata": {"Project": "x", "Created": "2020", "Description": "y"},
    "Pattern": [
        {
            "Event": {
                "Time": 0.0,
                "EventType": "HapticContinuous",
                "EventDuration": 1.0,
                "EventParameters": [
                    {"ParameterID": "HapticIntensity", "ParameterValue": 0.8},
                    {"ParameterID": "HapticSharpness", "ParameterValue": 0.4},
                    {"ParameterID": "AttackTime", "ParameterValue": 0.1},
                ],
            }
        },
        {"Event": {"Time": 0.5, "EventType": "HapticTransient", "EventParameters": []}},
        {"Parameter": {"ParameterID": "HapticIntensityControl", "ParameterValue": 0.5, "Time": 0.2}},
        {
            "ParameterCurve": {
                "ParameterID": "HapticIntensityControl",
                "Time": 0.0,
                "ParameterCurveControlPoints": [{"Time": 0, "ParameterValue": 1}, {"Time": 1, "ParameterValue": 0.1}],
            }
        },
    ],
}


def _felt(path: Path) -> object:
    from scene2hap.clips.reading import as_vibration, read_haptic_clip

    clip = read_haptic_clip(path)
    return clip, as_vibration(clip).samples


add(".haptic", writes("tap.haptic", lambda: json.dumps(_HAPTIC).encode()), _felt)
add("AHAP", writes("tap.ahap", lambda: json.dumps(_AHAP).encode()), _felt)
