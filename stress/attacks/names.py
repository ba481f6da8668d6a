"""Names with control characters, with characters that cannot be encoded, and with a meaning to file systems."""

from __future__ import annotations

import base64
import contextlib
import itertools
import json
import random
import struct
from collections.abc import Iterator
from pathlib import Path

from stress.attacks.attack import Attack

_PARTS = (
    "\x1b]0;owned\x07", "\x1b[2J", "\x9b31m", "\x00", "\r", "\n", "\t", "\u202e", "\u2028", "\ud800", "\udcff",
    "\ufeff",
    "[red]", "[/]", "[link=file:///]", "{0}", "%s%n", "../" * 9, "/etc/passwd", "C:\\", "CON", "a" * 5000, "é", "台所",
    "🍳", "'", '"', "`id`", "$(id)", "<script>", "-rf", "--help", " ", "", "#2", "\u0301" * 100,
)  # fmt: skip
_BUFFER = base64.b64encode(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)).decode()


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Names in glTF, OBJ, JSON and MJCF files, in file names and in arguments, without end."""
    for number in itertools.count():
        rng = random.Random(f"names/{seed}/{number}")
        name = "".join(rng.choice(_PARTS) for _ in range(rng.choice([1, 1, 2, 5])))
        other = "".join(rng.choice(_PARTS) for _ in range(2))
        folder = work / str(number)
        folder.mkdir()
        kind = rng.choice(["gltf", "obj", "json", "xml", "file", "argument"])
        path = folder / f"case.{'gltf' if kind in ('file', 'argument') else kind}"
        if kind == "obj":
            text = f"mtllib {other}\no {name}\nusemtl {other}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
            path.write_bytes(text.encode("utf-8", "surrogatepass"))
        elif kind == "json":
            path.write_text(_json(name, other))
        elif kind == "xml":
            quoted = name.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
            text = f'<mujoco model="a"><worldbody><body name="{quoted}"><geom size="1"/></body></worldbody></mujoco>'
            path.write_bytes(text.encode("utf-8", "surrogatepass"))
        else:
            path.write_text(_gltf(name, other))
        if kind == "file":
            with contextlib.suppress(OSError, ValueError):  # not a name here
                path = path.rename(folder / f"{name[:60].replace('/', '_')}.gltf")
        more = () if rng.random() < 0.5 else ("--json",)
        if kind == "argument":
            more = (*more, rng.choice(["--group", "--unit", "--up", "--no-such", ""]), name.replace("\0", "") or "x")
        yield Attack("names", f"{number} {kind} {name[:40]!a}", ("scene2hap", "inspect", str(path), *more))


def _gltf(name: str, other: str) -> str:
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": f"data:;base64,{_BUFFER}"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3, "bufferView": 0}],
        "meshes": [{"name": other, "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": other, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": other}],
        "nodes": [{"name": name, "mesh": 0}, {"name": name, "mesh": 0}],
    }
    return json.dumps(document)


def _json(name: str, other: str) -> str:
    pose = {"position_m": [0, 0, 0]}
    box = {"kind": "box", "size_m": [1, 1, 1]}
    item = {"id": name, "name": other, "pose": pose, "geometry": box}
    document = {"format": "scene2hap/scene", "version": 1, "name": other, "up_axis": "y", "objects": [item]}
    return json.dumps(document)
