"""Approaches: the points at which a moving object came nearer to another one, each with its normal.

They are the contacts of the object, the far edge of a door or lid, and what encloses a drawer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import NamedTuple

from scene2hap.contact.junction import Junction
from scene2hap.contact.rule import TOUCH_M
from scene2hap.scene.geometry import Vector, cross, difference, dot
from scene2hap.scene.pose import in_own, in_world
from scene2hap.session.impacts.motion_track import LEAST_TRAVEL_M, STILL
from scene2hap.session.impacts.relative_motion import RelativeMotion
from scene2hap.session.impacts.slams import Slam, is_closed, is_filled, may_enclose, slam_of
from scene2hap.session.present_scene.scene_state import SceneState

_PLANE_POINTS, _LEAST_WIDTH_M, _FLAT = 3, 0.003, 0.1
"""Fewest points of a contact that span a plane, their least width, and their largest thickness relative to it."""

NO_JUNCTIONS: Mapping[str, Junction] = MappingProxyType({})


class Approach(NamedTuple):
    """A point at which an object came nearer to another one: travel there [m], and the normal towards the other.

    meets : tells whether the two meet there, which may take a millisecond. is_contact : False for the edge of a door,
    and for a drawer; is_seen : False where nothing at the point shows that the object is there.
    """

    other: str
    point_m: Vector
    came_m: Vector
    normal: Vector
    meets: Callable[[], bool]
    is_contact: bool = True
    is_seen: bool = True


class Approaches:
    """Lists the approaches of an object between two updates."""

    def __init__(self, state: SceneState, motion: RelativeMotion) -> None:
        self._state, self._graph, self._motion = state, state.graph, motion

    def at_contacts(self, object_id: str, met: Mapping[str, Junction], between: tuple[int, int]) -> Iterator[Approach]:
        """Approaches at the present and former contacts of an object, and at its edge if a hinge holds it. Without
        those at contacts that are too short for a landing.

        Present contacts come first, a contact at a hinge last among these, since a contact elsewhere shows where the
        two objects meet. Sorted, since the graph's order depends on the hashes of ids, which differ in each run of
        Python.
        """
        beside, pose = self._graph.beside.get(object_id, NO_JUNCTIONS), self._graph.pose(object_id)
        slam = self._slam(object_id)
        holder = None if slam is None else slam.holder
        for other in sorted(met, key=lambda x: (x not in beside, x == holder, x)):
            if slam is not None and other == holder:
                point = in_world(slam.edge_m, pose)
                came = self._motion.nearing_m(object_id, other, point, *between)
                yield Approach(other, point, came, _direction(came), slam.meets, is_contact=False)
            for side in _sides(met[other]):
                point = _middle(side)
                came = self._motion.nearing_m(object_id, other, point, *between)
                # A pivot does not travel: links of a robot have no other contact with each other.
                if math.hypot(*came) > LEAST_TRAVEL_M:
                    normal = self._normal(object_id, other, point, side, between[0])
                    enters = partial(self._enters, object_id, other, point, came, normal)
                    meets = enters if slam is None or other != holder else slam.misses
                    yield Approach(other, point, came, normal, meets)

    def in_holders(self, object_id: str, between: tuple[int, int]) -> Iterator[Approach]:
        """Approaches of a drawer to what encloses it."""
        beside = self._graph.beside.get(object_id, NO_JUNCTIONS)
        for other in sorted(beside):
            item, holder = self._state.objects[object_id], self._state.objects[other]
            if may_enclose(holder, item, (item.pose, holder.pose)):
                point = _middle(beside[other])
                came = self._motion.nearing_m(object_id, other, point, *between)
                is_shut = partial(self._is_shut, object_id, other)
                yield Approach(other, point, came, _direction(came), is_shut, is_contact=False, is_seen=False)

    def is_reached(self, object_id: str, point_m: Vector, normal: Vector) -> bool:
        """Whether an object reaches a contact along a normal.

        The point of a contact is half way between the two surfaces. The box around the object reaches at least as far
        as its own.
        """
        return 2 * self._gap_m(object_id, point_m, normal) <= TOUCH_M

    def _gap_m(self, object_id: str, point_m: Vector, normal: Vector) -> float:
        """Distance along a normal from the box around an object to a point [m], negative within the box."""
        pose = self._graph.pose(object_id)
        (x, y, z), (u, v, w) = normal, pose.position_m
        own_normal = in_own((u + x, v + y, w + z), pose)
        reach_m = sum(abs(part) * half for part, half in zip(own_normal, self._state.half_m(object_id), strict=True))
        middle_m = in_world(self._motion.tracks[object_id].own_m, pose)
        return dot(difference(point_m, middle_m), normal) - reach_m

    def _enters(self, object_id: str, other: str, point_m: Vector, came_m: Vector, normal: Vector) -> bool:
        """Return False if an object comes out of another one through the surface at a contact, as a drawer out of a
        solid box that stands for its cabinet: it was within, and reaches farther out than it came."""
        item, holder = self._state.objects[object_id], self._state.objects[other]
        middle_m = in_world(self._state.middle_m(other), self._graph.pose(other))
        return (
            dot(difference(point_m, middle_m), normal) <= 0
            or self._gap_m(object_id, point_m, normal) >= -TOUCH_M - dot(came_m, normal)
            or not may_enclose(holder, item, self._motion.poses(object_id, other)[0])
            or not is_filled(holder)
        )

    def _slam(self, object_id: str) -> Slam | None:
        """Return what an object may slam against, see `slam_of`; None also without a hinge."""
        item = self._state.objects[object_id]
        holder = None if item.hinge is None else self._state.objects.get(item.hinge.to)
        if item.hinge is None or holder is None:
            return None
        return slam_of(item, item.hinge, holder, self._motion.poses(object_id, holder.id))

    def _is_shut(self, object_id: str, other: str) -> bool:
        """Whether an object is a drawer that is shut in another one, see `is_closed`."""
        state, now = self._state, (self._graph.pose(object_id), self._graph.pose(other))
        item, holder = state.objects[object_id], state.objects[other]
        return is_closed(item, holder, self._motion.poses(object_id, other), now, state.up_axis)

    def _normal(self, object_id: str, other: str, point_m: Vector, junction: Junction, since: int) -> Vector:
        """Normal from the object to the other: the contact's, else that of its points if they span a plane, else the
        direction from the object's middle to the contact.

        Engines let small objects sink into others. Once the middle of an object is below the surface, the contact seems
        to be on its other side. The side from which the object came, since an update, is then the right one. An object
        that was lifted does not reach the contact across the gap below it.
        """
        motion = self._motion
        middle_m = in_world(motion.tracks[object_id].own_m, self._graph.pose(object_id))
        outward = difference(point_m, middle_m)
        normal = _given_normal(object_id, other, outward, junction)
        came = motion.nearing_m(object_id, other, middle_m, since, motion.n_updates)
        outside = dot(outward, normal)
        if outside > 0 > outside + dot(came, normal) and self.is_reached(object_id, point_m, normal):
            return -normal[0], -normal[1], -normal[2]
        return normal


def _given_normal(object_id: str, other: str, outward: Vector, junction: Junction) -> Vector:
    for normal in junction.normals:
        if normal is not None:
            x, y, z = normal
            return normal if object_id < other else (-x, -y, -z)
    across = _normal_of_plane(junction.points_m)
    if across is not None and (height := dot(across, outward)):
        x, y, z = across
        return across if height > 0 else (-x, -y, -z)
    return _direction(outward)


def _direction(way: Vector) -> Vector:
    """The unit vector along a way, zero for none."""
    length = math.hypot(*way)
    return (way[0] / length, way[1] / length, way[2] / length) if length > 0 else STILL


def _normal_of_plane(points_m: Sequence[Vector]) -> Vector | None:
    """Unit normal, of either sign, of the plane through three of three or more points that are far apart; None if these
    lie on a line, or another one does not lie on the plane."""
    if len(points_m) < _PLANE_POINTS:
        return None
    ways = [difference(point, points_m[0]) for point in points_m]
    longest = max(ways, key=lambda way: dot(way, way))
    across = max((cross(longest, way) for way in ways), key=lambda area: dot(area, area))
    width_m = math.hypot(*across) / (math.hypot(*longest) or 1.0)
    normal = _direction(across)
    heights = [dot(normal, way) for way in ways]
    return normal if width_m > _LEAST_WIDTH_M and max(heights) - min(heights) < _FLAT * width_m else None


def _sides(junction: Junction) -> list[Junction]:
    """Split a contact by its normals, as of an object that slides on a tray and meets its rim."""
    if len(set(junction.normals)) < 2:
        return [junction]
    sides: dict[tuple[float, ...] | None, list[int]] = {}
    for row, normal in enumerate(junction.normals):
        # Engines round the normals of one face differently.
        side = None if normal is None else tuple(round(x, 1) for x in normal)
        sides.setdefault(side, []).append(row)
    points_m, weights, normals = junction.points_m, junction.weights, junction.normals
    return [
        Junction(tuple(points_m[row] for row in rows), tuple(weights[row] for row in rows), (normals[rows[0]],))
        for rows in sides.values()
    ]


def _middle(junction: Junction) -> Vector:
    x, y, z = (sum(axis) / len(junction.points_m) for axis in zip(*junction.points_m, strict=True))
    return x, y, z
