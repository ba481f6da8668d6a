"""Small rooms as scene files, and hashes of the bundle files baked from them."""

from __future__ import annotations

import hashlib
from pathlib import Path

from scene2hap import Box, Pose, SceneObject, SceneSnapshot

THINGS = {
    "radio": (0.3, 0.2, 0.15),
    "oak table": (1.2, 0.72, 0.7),
    "refrigerator": (0.7, 1.8, 0.7),
    "fan": (0.4, 0.5, 0.3),
    "kettle": (0.2, 0.25, 0.2),
}


def write_scenes(folder: Path, n: int) -> list[Path]:
    """Write n rooms of two objects each; all rooms have the radio."""
    folder.mkdir(parents=True)
    for i in range(n):
        names = ["radio", [*THINGS][1 + i % (len(THINGS) - 1)]]
        things = [
            SceneObject(name, pose=Pose((1.5 * k, THINGS[name][1] / 2, 0.1 * i)), geometry=Box(THINGS[name]))
            for k, name in enumerate(names)
        ]
        (folder / f"room_{i}.json").write_text(SceneSnapshot.build(things, name=f"room_{i}").to_json())
    return sorted(folder.glob("*.json"))


def digests(folder: Path) -> dict[str, str]:
    """The SHA-256 of every file of every bundle, by its path."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.glob("*.bundle/**/*"))
        if path.is_file()
    }
