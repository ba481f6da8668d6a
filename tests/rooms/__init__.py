"""Six small rooms built in code, of which contacts, sizes, sources and copies are known by construction.

They stand in for scenes by other people where `../shared` is absent: what a test says of any scene, it says of these.
`ROOMS` holds them by name; `write` puts one on disk as a user would have it.

- `cubes`: equal cubes with names of their own, two on each other, as games are prototyped.
- `dining_room`: meshes that rest on each other, turned furniture, copies.
- `shelves`: boards of one mesh full of round things, and things stacked on each other.
- `storage`: no source; a picture that hangs off its wall.
- `workshop`: z up, as scene JSON.
- `merged`: a whole room as one mesh.
"""

from __future__ import annotations

from rooms.composed import cubes, dining_room, merged, shelves, storage, workshop
from rooms.room import Room

ROOMS: dict[str, Room] = {room.name: room for room in (cubes, dining_room, shelves, storage, workshop, merged)}

__all__ = ["ROOMS", "Room"]
