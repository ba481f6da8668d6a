"""Small rooms as scene files, and a name for all that was made of them."""

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
    """Rooms of a few things each, one of them shared by all."""
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
    """Every file of every bundle, by its content."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.glob("*.bundle/**/*"))
        if path.is_file()
    }
