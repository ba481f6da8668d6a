"""The holders of each body, and the junction of each pair: by a hinge, by support, hanging, touch or enclosure.

Results are for one body or one pair, and depend on pairs alone.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Container, Iterable, Mapping
from typing import NamedTuple

from scene2hap.contact.body import Body, apart_by, box_distance_m
from scene2hap.contact.free_space import FreeSpace
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.mesh_distance import Gap
from scene2hap.contact.pair import NEEDS_TRIANGLES, BodyPair, BodyPairs, rest_points, support_normal
from scene2hap.contact.rule import (
    CLEAR_M,
    TOUCH_M,
    Support,
    fall_reach_m,
    hang_later_m,
    hang_reach_m,
    hangs,
    slack_m,
    supports,
    supports_of_faces,
    weight,
)


class Attachment(NamedTuple):
    """One reason why two bodies are in contact.

    weight : 0..1; way_m : displacement that brings the pair's `a` to its `b` [m]; normal : from a to b; lies : True if
    the pair's faller rests on the other with a level base face.
    """

    weight: float
    way_m: Triple
    normal: Triple | None
    lies: bool = False


NO_WAY: Triple = (0.0, 0.0, 0.0)
NO_ATTACHMENT = Attachment(0.0, NO_WAY, None)


def priority(attachment: Attachment) -> tuple[float, bool]:
    """Sort key: the larger weight wins; on a tie, the attachment that has a normal."""
    return (attachment.weight, attachment.normal is not None)


def direction(gap: Gap) -> Triple | None:
    """Return the unit vector from one surface to the other, None if they are too near for a direction."""
    if gap.distance_m < CLEAR_M:
        return None
    x, y, z = gap.way_m
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)


class Holders:
    """The holders of all bodies: `held` has the attachments of each body that is held, by its id and by the holder's.

    Parameters: pairs : all bodies and their pairs; a pair is added where a body hangs. near : the neighbours of each
    body; certified : the bodies with a certificate, which neither hang from others nor hold hanging ones.
    """

    def __init__(self, pairs: BodyPairs, near: Mapping[str, Collection[str]], certified: Container[str]) -> None:
        self._pairs, self._bodies, self._near, self._certified = pairs, pairs.bodies, near, certified
        self.held: dict[str, dict[str, Attachment]] = {}
        # Bodies without full support: larger bodies near them may hold them by hanging.
        self.unsupported: set[str] = set()
        # Bodies with a support that hid parts of another in the last search: they need the falls of all triangles.
        self._on_several: set[str] = set()

    def update(self, x: str) -> Collection[str]:
        """Find the holders of a body: by its hinge, else by support and, where that is below 1, by hanging.

        Returns the holders whose attachment changed.
        """
        body = self._bodies[x]
        pivot_on = self._pairs.hinged.on.get(x)
        if pivot_on is not None:
            return self._hold(x, {pivot_on: Attachment(1.0, NO_WAY, None)}, is_supported=True)
        below, lies_on = self._below(body) if self._pairs.of[x] else ({}, ())
        attachments = {y: self._support(body, y, support, lies=y in lies_on) for y, support in below.items()}
        supported = max((attachment.weight for attachment in attachments.values()), default=0.0)
        if supported < 1:
            for y, attachment in self._hanging(body, supported).items():
                attachments[y] = max(attachments.get(y, NO_ATTACHMENT), attachment, key=priority)
        return self._hold(x, attachments, is_supported=supported >= 1)

    def rest_alone(self, body: Body, on: str | None, fall_m: float) -> Collection[str]:
        """Let a body lie on one support and touch nothing else, or touch nothing. Returns the holders whose attachment
        changed."""
        attachments = {} if on is None else {on: self._support(body, on, Support(1.0, fall_m), lies=True)}
        return self._hold(body.id, attachments, is_supported=on is not None)

    def forget(self, x: str) -> Collection[str]:
        """Forget a removed body. Returns the holders it had."""
        self._on_several.discard(x)
        return self._hold(x, {}, is_supported=True)

    def _hold(self, x: str, attachments: dict[str, Attachment], *, is_supported: bool) -> Collection[str]:
        before = self.held.pop(x, {})
        if attachments:
            self.held[x] = attachments
        if is_supported:
            self.unsupported.discard(x)
        else:
            self.unsupported.add(x)
        return [y for y in before.keys() | attachments.keys() if before.get(y) != attachments.get(y)]

    def _support(self, body: Body, y: str, support: Support, *, lies: bool) -> Attachment:
        """Return the attachment by which y supports a body."""
        u, v, w = normal = support_normal(body, self._bodies[y])
        fall_m = support.fall_m
        return Attachment(support.weight, (u * fall_m, v * fall_m, w * fall_m), normal, lies)

    def _below(self, body: Body) -> tuple[Mapping[str, Support], Collection[str]]:
        """Return the supports of a body, and the ids of those on which it rests with a level base face."""
        body_pairs, reach_m = self._pairs.of[body.id], fall_reach_m(body.size_m)
        found = [(y, body_pair.rest) for y, body_pair in body_pairs.items() if body_pair.faller == body.id]
        unclear = [y for y, rest in found if rest is NEEDS_TRIANGLES]
        rests = {y: rest for y, rest in found if rest is not None and rest is not NEEDS_TRIANGLES}
        falls_m = self._first_falls(body, unclear, min((rest.fall_m for rest in rests.values()), default=math.inf))
        if not falls_m:
            whole = [y for y, rest in rests.items() if rest.wholly]
            below = supports_of_faces({y: rest.fall_m for y, rest in rests.items()}, reach_m, whole)
            if below is not None:
                return below, rests
        falls_m |= self._first_falls(body, rests, min(falls_m.values(), default=math.inf))
        falls_m = dict(sorted(falls_m.items()))
        below = supports_of_faces(falls_m, reach_m)
        self._on_several.discard(body.id)
        if below is None:
            self._on_several.add(body.id)
            each_m = {y: self._pairs.of[body.id][y].falls for y in falls_m}
            below = supports({y: falls for y, falls in each_m.items() if falls is not None}, reach_m)
        return below, ()

    def _first_falls(self, body: Body, onto: Iterable[str], least_m: float) -> dict[str, float]:
        """Return the fall distances of a body by triangles [m], by the id of each candidate support.

        Candidates are skipped if they are more than `TOUCH_M` deeper than the nearest one or than `least_m`.
        """
        bodies, body_pairs, up = self._bodies, self._pairs.of[body.id], body.up_axis
        found: dict[str, float] = {}
        for y in sorted(onto, key=lambda y: (-bodies[y].high[up], y)):
            if body.low[up] - bodies[y].high[up] > least_m + TOUCH_M:
                break
            fall_m = found[y] = body_pairs[y].first_fall_m(by_each=body.id in self._on_several)
            least_m = min(least_m, fall_m)
        return {y: fall_m for y, fall_m in found.items() if fall_m < math.inf and fall_m <= least_m + TOUCH_M}

    def _hanging(self, body: Body, supported: float) -> dict[str, Attachment]:
        """Return the attachments by which larger bodies hold a hanging body, scaled by 1 - `supported`."""
        x, reach_m = body.id, hang_reach_m(body.size_m)
        gaps: dict[str, Gap] = {}
        bodies, size_m = self._bodies, body.size_m
        larger = [
            y
            for y in self._near[x]
            if (other := bodies[y]).size_m > size_m
            and y not in self._certified
            and not apart_by(body, other, reach_m)
            and not self._pairs.hinged.are_chained(x, y)
            and not self._is_clear(body, other)
        ]
        if not larger:
            return {}
        within_m, later_m = reach_m, hang_later_m(reach_m)
        # The nearest first: a farther body holds only within `later_m` of the nearest, which shortens its search.
        for y in sorted(larger, key=lambda y: (box_distance_m(body, bodies[y]), y)):
            gap = self._body_pair(x, y).gap(within_m)
            if gap is not None:
                gaps[y] = gap
                within_m = min(within_m, gap.distance_m + later_m)
        shares = hangs({y: gaps[y].distance_m for y in sorted(gaps)}, reach_m)
        return {
            y: Attachment((1 - supported) * share, gaps[y].way_m, direction(gaps[y])) for y, share in shares.items()
        }

    def _is_clear(self, guest: Body, host: Body) -> bool:
        """Return True if a larger body surely has nothing near a smaller one."""
        body_pair = self._pairs.of[guest.id].get(host.id)
        if body_pair is None:
            return FreeSpace(guest, host).empty_region is not None
        # Where one may rest on the other, something of the host is in the path of the fall.
        return body_pair.faller is None and body_pair.space.empty_region is not None

    def _body_pair(self, x: str, y: str) -> BodyPair:
        body_pair = self._pairs.of[x].get(y)
        return self._pairs.add(self._pairs.made(self._bodies[x], self._bodies[y])) if body_pair is None else body_pair

    def junction(self, pair: Pair) -> Junction | None:
        """Return the junction of a pair, None where it does not touch.

        The strongest attachment decides: a held by b, b held by a, touch, or one enclosed by the other.
        """
        a, b = pair
        body_pair = self._pairs.of.get(a, {}).get(b)
        if body_pair is None:
            return None
        held = (self.held.get(a, {}).get(b, NO_ATTACHMENT), self.held.get(b, {}).get(a, NO_ATTACHMENT))
        attachment = max(held, key=priority)
        within_m = slack = slack_m(min(body_pair.a.size_m, body_pair.b.size_m))
        if attachment.weight < 1 and not apart_by(body_pair.a, body_pair.b, TOUCH_M):
            gap = body_pair.gap(TOUCH_M)
            if gap is not None:
                share = weight(gap.distance_m, TOUCH_M)
                if share > attachment.weight:
                    attachment, within_m = Attachment(share, NO_WAY, direction(gap)), slack + gap.distance_m
        if attachment.weight < 1:
            share, play_m = body_pair.enclosed
            if share > attachment.weight:
                attachment, within_m = Attachment(share, NO_WAY, None), slack + play_m
        if attachment.weight <= 0:
            return None
        rest = body_pair.rest if attachment.lies else None
        if rest is None:
            points = body_pair.points(attachment.way_m, within_m)
        else:
            points = rest_points(*body_pair.falling, rest, within_m)
        n = len(points)
        return Junction(points, (attachment.weight,) * n, (attachment.normal,) * n) if points else None
