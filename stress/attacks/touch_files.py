"""Touch files with excessive durations, rates and numbers of steps; the written output is checked."""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

import itertools
import json
import random
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from stress.attacks import bundles
from stress.attacks.attack import Attack, in_turn
from stress.attacks.judging import wav_is_harmless

_ODD: tuple[Any, ...] = (
    1e9, 1e308, 1e12, 3e6, 86_400.0, 1e-308, 5e-324, 0, -0.0, -1, float("nan"), float("inf"), -float("inf"), True, None, "1e9", "",
    "nan", 10**400, -(10**400), [1], {}, 2**63, 1e-3, 1e200, -1e308,
)  # fmt: skip
_RATES = (
    "0",
    "-1",
    "nan",
    "inf",
    "1e308",
    "1e9",
    "1e6",
    "1e-300",
    "1e-9",
    "5e-324",
    "0.001",
    "48001",
    "",
    "x",
    "1_0",
    "٣",
)
_CONFIGS: tuple[dict[str, Any], ...] = (
    {"bands": {"kind": "edges", "edges_hz": [10.0, 1e308]}}, {"bands": [1e-300, 1.0]}, {"control_period_s": 1e308},
    {"control_period_s": 1e-308}, {"contact_tolerance_m": 1e308}, {"contact_tolerance_m": -1}, {"gain_db": 1e308},
    {"user_gain_db": 1e308}, {"sample_rate_hz": 10**9}, {"sample_rate_hz": 0}, {"sample_rate_hz": 1}, {"propagation": {"kind": "mass_spring_damper", "resolution": 10**9}},
    {"propagation": {"kind": "modal_plate", "loss_floor": 1e-308}}, {"propagation": "auto"}, {"propagation": {"kind": "exponential_plate", "interface_loss_db": -1e308}},
    {"propagation": {"kind": "exponential_plate", "max_hops": 10**400}}, {"actuator": {"max_rms": 1e308, "max_amplitude": 1e308}},
    {"actuator": {"rms_window_s": 1e308}}, {"actuator": {"rms_window_s": 1e-308}}, {"actuator": {"max_frequency_hz": 1e308}}, {"skip": [1]},
    {"actuator": {"resonance_hz": 1e-300, "q": 1e300}}, {"crossfade_s": 1e9}, {"ramp_s": 1e9}, {"ramp_s": 0}, {"prepare": "never"},
)  # fmt: skip


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by each kind of file in turn, with values drawn from the seed. Without end."""
    room = bundles.sound(work)
    for number, kind, folder, rng in in_turn("touch_files", _KINDS, seed, work):
        label, path, more = kind(folder, rng)
        argv = ("render", str(room), "--touches", str(path), "-o", "out.wav", *more)
        name = f"{number} {kind.__name__.strip('_')} {label}"
        yield Attack("touch_files", name, argv, call=partial(judged, argv), untouched=(room,))


def judged(argv: tuple[str, ...]) -> int:
    """Run a command of this package, and check its output against the limits of an actuator."""
    from scene2hap.cli import main

    try:
        status = main(argv)
    except SystemExit as ended:
        status = ended.code if isinstance(ended.code, int) else 1
    if not wav_is_harmless(Path("out.wav")):
        raise AssertionError("written samples are not finite, or outside of [-1, 1]")
    return status


Made = tuple[str, Path, tuple[str, ...]]


def _document(folder: Path, duration: Any, steps: Any) -> Path:
    path = folder / "touches.json"
    path.write_text(json.dumps({"format": "scene2hap/touches", "version": 1, "duration_s": duration, "steps": steps}))
    return path


def _duration(folder: Path, rng: random.Random) -> Made:
    value = rng.choice(_ODD)
    return f"duration_s = {str(value)[:9]}", _document(folder, value, []), ()


def _time(folder: Path, rng: random.Random) -> Made:
    value = rng.choice(_ODD)
    steps = [
        {"time_s": value, "hand": "left", "touch": "fan"},
        {"time_s": rng.choice(_ODD), "hand": "left", "lift": True},
    ]
    return f"time_s = {str(value)[:9]}", _document(folder, 0.2, steps), ()


def _glide(folder: Path, rng: random.Random) -> Made:
    value = rng.choice(_ODD)
    steps: list[dict[str, Any]] = [
        {"time_s": 0.0, "hand": "left", "touch": "table"},
        {"time_s": 0.05, "hand": "left", "touch": "table", "point_m": [0.1, 0.02, 0.1], "glide_s": value},
        {"time_s": 0.06, "move": "fan", "by_m": [0.1, 0, 0], "glide_s": value},
    ]
    return f"glide_s = {str(value)[:9]}", _document(folder, 0.2, steps), ()


def _place(folder: Path, rng: random.Random) -> Made:
    value, where = rng.choice(_ODD), rng.choice(["point_m", "to_m", "by_m", "rotation_xyzw", "whole"])
    step: dict[str, Any] = {"time_s": 0.01, "hand": "left", "touch": "fan", "point_m": [value, 0, 0]}
    if where != "point_m":
        step = {"time_s": 0.01, "move": "fan", "by_m": [0, 0, 0], "glide_s": rng.choice([0.0, 0.05])}
        if where == "to_m":
            del step["by_m"]
        step[where if where != "whole" else "by_m"] = {"rotation_xyzw": [0, 0, value, 0], "whole": value}.get(
            where, [value] * 3
        )
    steps = [
        {"time_s": 0.0, "hand": "left", "touch": "table"},
        step,
        dict(step, time_s=0.02),
        {"time_s": 0.03, "hand": "left", "touch": "fan"},
    ]
    return f"{where} = {str(value)[:9]}", _document(folder, 0.1, steps), ()


def _source(folder: Path, rng: random.Random) -> Made:
    name, value = rng.choice(["on", "state", "gain_db", "source"]), rng.choice(_ODD)
    steps = [
        {"time_s": 0.0, "hand": "left", "touch": "fan"},
        {"time_s": 0.01, "source": "fan", "gain_db": 60.0, name: value},
    ]
    return f"{name} = {str(value)[:9]}", _document(folder, 0.2, steps), ()


def _many(folder: Path, rng: random.Random) -> Made:
    """As many steps as fit into some megabytes."""
    n = rng.choice([20_000, 200_000, 1_000_000])
    steps: list[Any] = rng.choice(
        [[{"time_s": 0.01, "hand": "left", "touch": "fan"}], [{"time_s": 0.01, "move": "fan", "by_m": [0.001, 0, 0], "glide_s": 9.0}],
         [{"time_s": 0.0, "hand": f"h{i}", "touch": "fan"} for i in range(3000)], [{}], [0], [{"time_s": 0.01, "source": "fan", "on": True}]]
    )  # fmt: skip
    path = folder / "touches.json"
    rows = itertools.islice(itertools.cycle(map(json.dumps, steps)), n)
    path.write_text(
        '{"format": "scene2hap/touches", "version": 1, "duration_s": 0.05, "steps": [' + ",".join(rows) + "]}"
    )
    return f"{n} of {len(steps)} steps {str(steps[0])[:40]}", path, ()


def _hands(folder: Path, rng: random.Random) -> Made:
    hands: list[Any] = rng.choice(
        [
            ["\ud800"],
            [""],
            ["a" * 10**6],
            [f"h{i}" for i in range(2000)],
            ["left", "LEFT"],
            ["../x"],
            ["\x1b[2J"],
            [1],
            [None],
        ]
    )
    steps = [{"time_s": 0.0, "hand": hand, "touch": "fan"} for hand in hands]
    return f"{len(hands)} hands {hands[0]!a:.20}", _document(folder, 0.1, steps), ()


def _rate(folder: Path, rng: random.Random) -> Made:
    value = rng.choice(_RATES)
    steps = [{"time_s": 0.0, "hand": "left", "touch": "fan"}]
    return f"rate {value}", _document(folder, rng.choice([0.05, 3.0, 600.0]), steps), ("--update-rate-hz", value)


def _config(folder: Path, rng: random.Random) -> Made:
    config = rng.choice(_CONFIGS)
    path = folder / "settings.json"
    path.write_text(json.dumps({"session": config}))
    steps = [{"time_s": 0.0, "hand": "left", "touch": "fan"}, {"time_s": 0.0, "hand": "right", "touch": "table"}]
    return str(config)[:60], _document(folder, 0.1, steps), ("--settings", str(path))


def _text(folder: Path, rng: random.Random) -> Made:
    text = rng.choice(
        ["[" * 100_000, '{"a":' * 5000 + "1" + "}" * 5000, "", "null", '"x"', "1" * 9000, "[]", "{}", '{"duration_s": 1, "duration_s": 1e9}', "\ufeff{}",
         '{"format": "scene2hap/touches", "version": 1, "duration_s": 1e9, "steps": [], "duration_s": 0.1}', '{"steps": ' + "[" * 900 + "]" * 900 + "}"]
    )  # fmt: skip
    path = folder / "touches.json"
    path.write_bytes(text.encode(rng.choice(["utf-8", "utf-16", "utf-8-sig"])))
    return f"text {text[:20]!a}", path, ()


def _csv(folder: Path, rng: random.Random) -> Made:
    head = "time_s,hand,touch,x_m,y_m,z_m,glide_s,lift\n"
    text = rng.choice(
        [head + "1e9\n", head + "nan\n", head + "0,left,fan,nan,0,0,,\n1\n", head + "0,left,fan\n" * 200_000 + "0.1\n", head + "1e308,,,,,,,\n", "time_s\n1e12\n",
         "time_s,time_s\n1,1e9\n", head + '"' + "a" * 10**6, head.replace("hand", "h\0nd"), "\n" * 10**6, "," * 10**6, head + "0," + "x" * 10**6 + ",fan\n1\n",
         "time_s\r0.1\r", head + "0,left,fan,1e400,0,0,,\n0.1\n", head + "0.1,left,fan," + "," * 10**5 + "\n0.2\n", head + "-0.0\n", head + "٣\n", head + "0x10\n", head]
    )  # fmt: skip
    path = folder / "touches.csv"
    path.write_text(text)
    return f"csv {text[len(head) :][:20]!a}", path, ()


def _no_file(folder: Path, rng: random.Random) -> Made:
    name = rng.choice(
        [
            "/dev/zero",
            "/dev/null",
            "/dev/stdin",
            str(folder),
            "",
            ".",
            "nowhere.json",
            "a" * 5000,
            "\udcff.json",
            "pipe.json",
            "big.json",
            "loop.json",
        ]
    )
    if name in ("pipe.json", "big.json", "loop.json"):
        path = folder / name
        if name == "pipe.json":
            import os

            os.mkfifo(path)
        elif name == "loop.json":
            path.symlink_to(path)
        else:
            with path.open("wb") as file:
                file.truncate(1 << 36)
        name = str(path)
    return f"file {name[-12:]!a}", Path(name) if name else Path(), ()


_KINDS: tuple[Callable[[Path, random.Random], Made], ...] = (
    _duration, _time, _glide, _place, _source, _many, _hands, _rate, _config, _text, _csv, _no_file,
)  # fmt: skip
