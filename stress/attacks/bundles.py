"""Damaged, wrongly edited and malicious bundles, for every command that reads or replaces bundles."""

from __future__ import annotations

import itertools
import json
import os
import random
import re
import shutil
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from stress.attacks.attack import Attack

_DOCUMENTS = ("bundle.json", "scene.json", "objects.json", "loops.json", "overrides.json")
_HUGE = 10**400
_ODD_VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 2**63, -(2**70), _HUGE, 1e308, -1e-320, float("nan"), float("inf"), "", "x", "\ud800",
    "\0", "../../../etc/passwd", "/dev/zero", "nan", "1", "a" * 100_000, [], {}, [[]], [0] * 1000, {"": {}}, [None] * 3,
    {"file": "sounds"}, "sounds", ".", "..", "bundle.json", "sounds/../bundle.json", "\x1b[2J", "冷蔵庫", "a\nb",
)  # fmt: skip


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Damage an intact bundle once or three times; then inspect, report, render or bake over it. Without end."""
    whole = sound(work)
    scene = work / "scene.json"
    for number in itertools.count():
        rng = random.Random(f"bundles/{seed}/{number}")
        folder = work / str(number) / "room"
        shutil.copytree(whole, folder)
        outside = _new(folder.parent / "outside.json")
        done = [_damaged(folder, rng, damage) for damage in rng.choices(_DAMAGES, k=rng.choice([1, 1, 1, 3]))]
        command = rng.choice(["inspect", "inspect", "report", "render", "bake"])
        argv: tuple[str, ...] = ("scene2hap", command, str(folder))
        if command == "render":
            track = work / str(number) / "touches.json"
            steps = [{"time_s": 0.02, "hand": "left", "touch": name} for name in ("fan", "table")]
            document = {"format": "scene2hap/touches", "version": 1, "duration_s": 0.1, "steps": steps}
            track.write_text(json.dumps(document))
            argv = ("scene2hap", "render", str(folder), "--touches", str(track), "-o", "out.wav")
        elif command == "bake":
            argv = ("scene2hap", "bake", str(scene), "-o", str(folder))
        more = ("--json",) if rng.random() < 0.3 else ()
        if command == "render":
            from stress.attacks.touch_files import judged

            name = f"{number} {command}: {', '.join(done)}"
            call = partial(judged, (*argv[1:], *more))
            yield Attack("bundles", name, (), call=call, untouched=(outside,))
            continue
        yield Attack("bundles", f"{number} {command}: {', '.join(done)}", (*argv, *more), untouched=(outside,))


def sound(work: Path) -> Path:
    """A small bundle with boxes, a mesh, two sources and an override, and the scene that it was baked from."""
    from scene2hap import HapticBundle, bake, load_scene

    rows = []
    boxes = (("table", (1.2, 0.05, 0.8), 0.0), ("phone", (0.15, 0.01, 0.07), 0.03), ("fan", (0.2,) * 3, 0.2))
    for name, size, at in boxes:
        box = {"kind": "box", "size_m": size}
        rows.append({"id": name, "name": name, "pose": {"position_m": [0, at, 0]}, "geometry": box})
    mesh = {"kind": "mesh", "vertices_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, 1, 0]]}
    mesh["faces"] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    rows.append({"id": "wedge", "name": "wedge", "pose": {"position_m": [3, 0, 0]}, "geometry": mesh})
    document = {"format": "scene2hap/scene", "version": 1, "name": "room", "up_axis": "y", "objects": rows}
    (work / "scene.json").write_text(json.dumps(document))
    bundle: HapticBundle = bake(load_scene(work / "scene.json")).override("phone", gain_db=-3.0, material="oak")
    return bundle.save(work / "sound" / "room")


def _damaged(folder: Path, rng: random.Random, damage: Callable[[Path, random.Random], str]) -> str:
    try:
        return damage(folder, rng)
    except (AttributeError, IndexError, RecursionError, TypeError, ValueError):
        return "nothing"  # the bundle is already too damaged for this


def _cut(folder: Path, rng: random.Random) -> str:
    path = _a_file(folder, rng)
    data = path.read_bytes()
    path.write_bytes(data[: rng.randrange(len(data) + 1)])
    return f"cut {path.name}"


def _flip(folder: Path, rng: random.Random) -> str:
    path = _a_file(folder, rng)
    data = bytearray(path.read_bytes())
    for _ in range(rng.choice([1, 1, 8, 200])):
        if data:
            at = rng.randrange(min(len(data), rng.choice([64, len(data)])))
            data[at] = rng.randrange(256)
    path.write_bytes(data)
    return f"flip {path.name}"


def _retype(folder: Path, rng: random.Random) -> str:
    """Replace one value anywhere in a document."""
    path = _document(folder, rng)
    try:
        document = json.loads(path.read_text())
    except (OSError, ValueError, RecursionError):
        return "nothing"
    value = rng.choice(_ODD_VALUES)
    places = list(_places(document))
    if not places:
        return "nothing"
    holder, key = rng.choice(places)
    how = rng.random()
    if how < 0.75:
        holder[key] = value
    elif how < 0.85:
        del holder[key]
    elif isinstance(holder, dict):
        holder[rng.choice(["", "extra", "\ud800", "x" * 5000, "../x", "phone"])] = value
    else:
        holder.append(value)
    path.write_text(json.dumps(document))
    return f"{path.name} {str(key)[:20]!a} = {str(value)[:20]!a}"


def _places(document: Any) -> Iterator[tuple[Any, Any]]:
    items = document.items() if isinstance(document, dict) else enumerate(document)
    for key, value in items:
        yield document, key
        if isinstance(value, dict | list):
            yield from _places(value)


def _whole(folder: Path, rng: random.Random) -> str:
    """Replace a whole document by text that is not a JSON object, or not JSON."""
    path = _document(folder, rng)
    depth = rng.choice([500, 5000, 100_000])
    text = rng.choice(
        ["[" * depth, '{"a":' * depth, "[" * depth + "]" * depth, "null", "[]", "{}", '"x"', "NaN", "1" * 9000, "", " "]
    )
    path.write_text(text)
    return f"{path.name} is {text[:12]!a}"


def _nest(folder: Path, rng: random.Random) -> str:
    """Replace a document by an object with one deeply nested value."""
    path = _document(folder, rng)
    depth = rng.choice([100, 900, 3000])
    keys = rng.choice(['"phone"', '"table"', '"objects"', '"name"'])
    value = rng.choice(["[" * depth + "]" * depth, '{"a": ' * depth + "1" + "}" * depth])
    path.write_text(f"{{{keys}: {value}}}")
    return f"nest {path.name}"


def _encode(folder: Path, rng: random.Random) -> str:
    path = _document(folder, rng)
    encoding = rng.choice(["utf-16", "utf-32", "utf-8-sig", "utf-16-le", "cp037"])
    try:
        path.write_bytes(path.read_text().encode(encoding))
    except (OSError, UnicodeError):
        return "nothing"
    return f"{path.name} in {encoding}"


def _replace(folder: Path, rng: random.Random) -> str:
    """A folder, link or pipe in place of a file."""
    path = _a_file(folder, rng)
    path.unlink()
    kind = rng.choice(["nothing", "folder", "pipe", "circle", "outside", "device", "dangling", "empty", "sparse"])
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "empty":
        path.write_bytes(b"")
    elif kind == "sparse":
        with path.open("wb") as file:
            file.truncate(1 << 36)
    elif kind != "nothing":
        where = {"circle": path.name, "outside": "../outside.json", "device": "/dev/zero", "dangling": "nowhere"}
        path.symlink_to(where[kind])
    return f"{kind} for {path.name}"


def _wave(folder: Path, rng: random.Random) -> str:
    """A WAV file with a wrong header."""
    paths = sorted(path for path in (folder / "sounds").glob("*.wav") if path.is_file() and not path.is_symlink())
    if not paths:
        return "nothing"
    path = rng.choice(paths)
    data = bytearray(path.read_bytes())
    at, size = rng.choice([(4, 4), (16, 4), (20, 2), (22, 2), (24, 4), (28, 4), (32, 2), (34, 2), (40, 4)])
    if len(data) > 44:
        value = rng.choice([0, 1, 3, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, 8, 64]) & (256**size - 1)
        data[at : at + size] = value.to_bytes(size, "little")
    path.write_bytes(data)
    return f"header of {path.name} at {at}"


def _loop(folder: Path, rng: random.Random) -> str:
    """A loop of NaN, of an unusual rate, or of no length."""
    import numpy as np
    import soundfile

    paths = sorted(path for path in (folder / "sounds").glob("*.wav") if path.is_file() and not path.is_symlink())
    if not paths:
        return "nothing"
    path = rng.choice(paths)
    rate = rng.choice([1, 100, 8000, 48_000, 2**31 - 1])
    value = rng.choice([float("nan"), float("inf"), 1e38, -2.0, 0.0, 1e-45])
    samples = np.zeros((rng.choice([1, 2, 100, 100_000]), rng.choice([1, 1, 8])))
    samples[:: rng.choice([1, 7])] = value
    path.unlink()
    soundfile.write(path, samples, rate, subtype=rng.choice(["FLOAT", "DOUBLE", "PCM_16", "PCM_U8"]))
    return f"{path.name[:20]} of {value} at {rate} Hz"


def _spell(folder: Path, rng: random.Random) -> str:
    """Edit a document as text: names in other case, names that are paths, repeated names, numbers of many digits."""
    path = _document(folder, rng)
    try:
        text = path.read_text()
    except (OSError, ValueError):
        return "nothing"
    number = rng.choice(["1e400", "9" * 5000, "-0", "1E-400", "NaN", "-Infinity", "0x1", "1" + "0" * 400])
    name = rng.choice(
        ["PHONE", "../phone", "a/b", "CON", "phone\\ud800", "phone\\u0000", "phone ", "fan", "\u0444\u0430\u043d"]
    )
    key = rng.choice(['"phone"', '"fan"', '"id"', '"gain_db"', '"intensity"', '"file"', '"files"'])
    how = rng.random()
    if how < 0.4:
        path.write_text(re.sub(r": -?\d[\d.e+-]*", lambda found: rng.choice([found[0]] * 3 + [f": {number}"]), text))
    elif how < 0.8:
        path.write_text(text.replace('"phone"', f'"{name}"'))
    else:
        path.write_text(text.replace(f"{key}:", f"{key}: null, {key}: [], {key}:"))
    return f"{path.name} {number[:9] if how < 0.4 else name if how < 0.8 else key + ' twice'!a}"


def _mesh(folder: Path, rng: random.Random) -> str:
    """A PLY file with a wrong header."""
    paths = sorted(path for path in (folder / "meshes").glob("*.ply") if path.is_file() and not path.is_symlink())
    if not paths:
        return "nothing"
    data = paths[0].read_bytes()
    number = rng.choice([b"0", b"-1", b"999999999999", b"9" * 5000, b"4.5", b"nan"])
    swaps = [(b"vertex 4", b"vertex " + number), (b"face 4", b"face " + number)]
    old, new = rng.choice([*swaps, (b"double x", b"char x"), (b"uchar", b"double")])
    paths[0].write_bytes(data.replace(old, new, 1))
    return f"ply {new[:20]!a}"


def _newer(folder: Path, rng: random.Random) -> str:
    path = _fresh(folder / "bundle.json")
    version = rng.choice([2, 99, "2", 1.5, True, -1, _HUGE, None])
    try:
        path.write_text(json.dumps({**json.loads(path.read_text()), "version": version}))
    except (OSError, ValueError, RecursionError):
        return "nothing"
    return f"version {str(version)[:9]}"


def _many(folder: Path, rng: random.Random) -> str:
    """A document of a megabyte of equal rows."""
    path = _document(folder, rng)
    try:
        document = json.loads(path.read_text())
        name, row = rng.choice(list(document.items()))
    except (OSError, ValueError, AttributeError, IndexError, RecursionError):
        return "nothing"
    n = max(1, 1_000_000 // (len(json.dumps(row)) + 20))
    if isinstance(row, list):
        document[name] = (row * n)[:100_000]
    else:
        document |= {f"{name}{i}": row for i in range(min(n, 50_000))}
    path.write_text(json.dumps(document))
    return f"{n} rows in {path.name}"


def _document(folder: Path, rng: random.Random) -> Path:
    return _fresh(folder / rng.choice(_DOCUMENTS))


def _fresh(path: Path) -> Path:
    """A file to damage. Links, pipes and folders of earlier damage are replaced, so that damage does not spread."""
    if path.is_symlink() or (path.exists() and not path.is_file()):
        path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
    return path if path.exists() else _new(path)


def _a_file(folder: Path, rng: random.Random) -> Path:
    found = sorted(path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    found = [path for path in found if path.stat().st_size < 1 << 30]
    return rng.choice(found or [_new(folder / "left.txt")])


def _new(path: Path) -> Path:
    path.write_text("x")
    return path


_DAMAGES: list[Callable[[Path, random.Random], str]] = [
    _cut, _flip, _flip, _retype, _retype, _retype, _retype, _whole, _nest, _encode, _replace, _replace, _wave, _mesh,
    _loop, _loop, _spell, _spell, _newer, _many,
]  # fmt: skip
