"""Six small rooms built in code, of which contacts, sizes, sources and copies are known by construction.

They stand in for scenes by other people where `../shared` is absent: what a test says of any scene, it says of these.
`ROOMS` holds them by name; `room_file` puts one on disk as a user would have it.

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
    """The file of a room, written when it is first asked for and gone with the process."""
    return ROOMS[name].write(_folder())


@cache
def _folder() -> Path:
    folder = mkdtemp(prefix="rooms-")
    atexit.register(rmtree, folder, ignore_errors=True)
    return Path(folder)


__all__ = ["ROOMS", "Room", "room_file"]
