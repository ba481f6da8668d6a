"""Six small rooms built in code, whose contacts, sizes, sources and copies are known by construction.

They replace scenes by others where `../shared` is absent: a test that holds for any scene also runs on these rooms.
`ROOMS` holds them by name; `room_file` writes one to disk in a format that users have.

- `cubes`: equal cubes with names of their own, two on each other, as games are prototyped.
- `dining_room`: meshes that rest on each other, turned furniture, copies, textures.
- `shelves`: boards of one mesh full of round things, and things stacked on each other.
- `storage`: no source; a picture that hangs off its wall.
- `workshop`: z up, as scene JSON.
- `merged`: a whole room as one mesh.
"""

from __future__ import annotations

import atexit
from functools import cache
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp

from rooms.composed import cubes, dining_room, merged, shelves, storage, workshop
from rooms.room import Room

ROOMS: dict[str, Room] = {room.name: room for room in (cubes, dining_room, shelves, storage, workshop, merged)}


@cache
def room_file(name: str) -> Path:
    """The file of a room, written at the first call and deleted with the process."""
    return ROOMS[name].write(_folder())


@cache
def _folder() -> Path:
    folder = mkdtemp(prefix="rooms-")
    atexit.register(rmtree, folder, ignore_errors=True)
    return Path(folder)


__all__ = ["ROOMS", "Room", "room_file"]
