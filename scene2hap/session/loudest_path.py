"""The path between a source and a touch with the least loss by the paper's law."""

from __future__ import annotations

import heapq
import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scene2hap.propagation.exponential_plate import REFERENCE_HZ, ExponentialPlate
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body
from scene2hap.scene.objects import Contact

Point = tuple[float, float, float]

_END = ""


@dataclass(frozen=True)
class LoudestPath:
    """Objects from a source to a touch, and the point at which each but the source is entered."""

    objects: tuple[str, ...]
    entries: tuple[Point, ...] = ()

    def on(self, object_id: str, entry: Point) -> LoudestPath:
        """Extend the path by one object."""
        return LoudestPath((*self.objects, object_id), (*self.entries, entry))


def loudest_path(
    source_id: str,
    target_id: str,
    point_m: Point,
    contacts: Sequence[Contact],
    bodies: Mapping[str, Body],
    model: object,
) -> LoudestPath | None:
    """The cheapest way over contacts (Dijkstra), None if there is none; priced as in `propagation.paths`."""
    if source_id == target_id:
        return LoudestPath((source_id,))
    law = model if isinstance(model, ExponentialPlate) else ExponentialPlate()
    loss = law.interface_loss_db * math.log(10) / 20
    beside: dict[str, list[tuple[str, Point, float]]] = defaultdict(list)
    for contact in contacts:
        if contact.weight > 0:
            crossing = (loss - math.log(contact.weight)) / math.sqrt(2 * math.pi * REFERENCE_HZ)
            beside[contact.a].append((contact.b, contact.point_m, crossing))
            beside[contact.b].append((contact.a, contact.point_m, crossing))
    waiting: list[tuple[float, int, LoudestPath]] = [(0.0, 0, LoudestPath((source_id,)))]
    done: set[tuple[str, Point | None, int]] = set()
    n_pushed = 0
    while waiting:
        cost, _, way = heapq.heappop(waiting)
        here, hops = way.objects[-1], len(way.entries)
        if here == _END:
            return LoudestPath(way.objects[:-1], way.entries[:-1])
        entry = way.entries[-1] if way.entries else None
        # The same place after more hops is another state only where hops are counted.
        state = (here, entry, hops if law.max_hops is not None else 0)
        if state in done or (entry is not None and here not in bodies):
            continue
        done.add(state)
        onward = [] if law.max_hops is not None and hops >= law.max_hops else beside[here]
        end = [(_END, point_m, 0.0)] if here == target_id else []
        for other, leave, crossing in (*onward, *end):
            # Inside the source distance is free: it moves as a whole.
            through = 0.0 if entry is None else _price_per_m(bodies[here]) * math.dist(entry, leave)
            n_pushed += 1
            heapq.heappush(waiting, (cost + through + crossing, n_pushed, way.on(other, leave)))
    return None


def _price_per_m(body: Body) -> float:
    return body.wavenumber_per_root_omega if isinstance(body, Plate) else 0.0
