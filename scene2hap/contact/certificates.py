"""The certificates of all bodies: issued by proof, cut where others come near, ended where they do not hold."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping

from scene2hap.contact.body import Body
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.certificate import Certificate, Extent, Resting, resting_on, separated, standing_planes
from scene2hap.contact.free_space import free_planes, has_nothing_near
from scene2hap.contact.planes import Plane
from scene2hap.contact.relative import roles
from scene2hap.contact.rule import TOUCH_M, fall_reach_m, hang_reach_m
from scene2hap.contact.vectors import Triple

_MOST_REFUSALS = 5
"""A body that was refused a certificate n times waits for 2^(n-1) - 1 moves; n grows to this."""


class Certificates:
    """Certificates, `of` each body that has one, by its id.

    Parameters: bodies, unsupported : all bodies, and those that nothing wholly supports, as their owner keeps them;
    of : where certificates are kept.
    """

    def __init__(
        self,
        bodies: Mapping[str, Body],
        unsupported: Collection[str],
        broad_phase: BroadPhase,
        of: dict[str, Certificate],
    ) -> None:
        self._bodies, self._unsupported, self._broad_phase, self.of = bodies, unsupported, broad_phase, of
        # By the ids of those that must stay where they are: whose certificates end when they move.
        self._pinned: dict[str, set[str]] = {}
        # By id: refusals less certificates issued since, and moves for which the body is still to wait.
        self._refusals: dict[str, tuple[int, int]] = {}

    def issue(self, body: Body, resting: Resting | None, normal: Triple | None) -> bool:
        """Give a certificate to a body that stands so, or touches nothing, if planes divide it from all others, whose
        own then keep behind them too. Returns whether that is so."""
        x, on, top_m, pins = body.id, "", -math.inf, set[str]()
        planes: dict[str, tuple[Plane, ...]] = {}
        if resting is not None:
            on, top_m = resting.support.id, resting.rest.top_m
            known = self._planes_on(body, resting)
            if known is None:
                return self._refuse(x)
            planes[on] = known
            pins.add(on)
        own, theirs = Extent(body, self._broad_phase.room(x), top_m, False), []
        for z in self._broad_phase.neighbours[x]:
            if z == on:
                continue
            its_own, other = self.of.get(z), self._bodies[z]
            # What moves without a certificate is left half of what is free as well.
            extent = Extent.of(other, is_fixed=z not in self._refusals) if its_own is None else its_own.extent
            apart = separated(own, extent, self._reach_m(body, other, resting is None))
            if apart is not None:
                planes[z] = apart.one
                if its_own is not None:
                    theirs.append((its_own, apart.other))
                continue
            free = None if its_own is not None else _free_around(body, other)
            if free is None:
                return self._refuse(x)
            planes[z] = free
            pins.add(z)
        certificate = Certificate(own, planes, pins, resting, normal)
        if not certificate.holds:
            return self._refuse(x)
        for its_own, its_planes in theirs:
            its_own.keep_behind({x: its_planes})
        for pin in pins:
            self._pinned.setdefault(pin, set()).add(x)
        self.of[x] = certificate
        if x in self._refusals:
            self._refusals[x] = (max(self._refusals[x][0] - 1, 0), 0)
        return True

    def may_be_issued(self, x: str) -> bool:
        """Whether a body that moves has waited long enough."""
        n, left = self._refusals.get(x, (0, 0))
        if left:
            self._refusals[x] = (n, left - 1)
        return not left

    def resting(self, body: Body, held: Collection[str]) -> Resting | None:
        """How a body stands on one of its neighbours, if it does; on what held it before rather than on another."""
        up, flat = body.up_axis, body.v_axis
        (u0, u1), (v0, v1) = (body.low[0], body.high[0]), (body.low[flat], body.high[flat])
        lowest = body.low[up] - fall_reach_m(body.size_m)
        below = []
        for y in self._broad_phase.neighbours[body.id]:
            other = self._bodies[y]
            low, high = other.low, other.high
            if low[0] < u1 and high[0] > u0 and low[flat] < v1 and high[flat] > v0 and high[up] > lowest:
                below.append(other)
        below.sort(key=lambda other: (other.id not in held, other.size_m))
        for other in below:
            resting = resting_on(body, other)
            if resting is not None:
                return resting
        return None

    def crowd_out(self, body: Body) -> list[Body]:
        """Divide a body that is elsewhere, or hangs now, from those around it that have certificates.

        Returns the bodies whose certificates end by that.
        """
        x, out = body.id, []
        extent, hangs = Extent.of(body, is_fixed=x not in self._refusals), x in self._unsupported
        for z in self.of.keys() & self._broad_phase.neighbours[x]:
            certificate = self.of[z]
            other = certificate.body
            reach_m = self._reach_m(other, body, z in self._unsupported)
            if certificate.divides(body, reach_m):
                continue
            if x in certificate.pins:
                if not (hangs and body.size_m < other.size_m):
                    continue
                apart = None
            else:
                apart = separated(certificate.extent, extent, reach_m)
            if apart is None:
                self.end(z)
                out.append(other)
            else:
                certificate.keep_behind({x: apart.one})
        return out

    def end(self, x: str) -> bool:
        """End the certificate of a body. Returns whether it had one."""
        certificate = self.of.pop(x, None)
        if certificate is not None and not certificate.has_held:
            self._refuse(x)
        return certificate is not None

    def end_pinned(self, moved: Iterable[str]) -> list[str]:
        """End those that rely on where these are. Returns the ids of the bodies that had them."""
        ended = []
        for x in moved if self._pinned else ():
            for y in self._pinned.pop(x, ()):
                certificate = self.of.get(y)
                if certificate is not None and x in certificate.pins and self.end(y):
                    ended.append(y)
        return ended

    def forget(self, x: str) -> None:
        """Forget a body that is gone."""
        self.of.pop(x, None)
        self._refusals.pop(x, None)

    def _refuse(self, x: str) -> bool:
        """Refuse a certificate, or count one for refused that did not hold for a step."""
        n = min(self._refusals.get(x, (0, 0))[0] + 1, _MOST_REFUSALS)
        self._refusals[x] = (n, 2 ** (n - 1) - 1)
        return False

    def _planes_on(self, body: Body, resting: Resting) -> tuple[Plane, ...] | None:
        support = resting.support
        # What bears has no certificate, and what is in the air may hang from what it bears.
        if support.id in self.of or (support.id in self._unsupported and support.size_m < body.size_m):
            return None
        return standing_planes(body, resting)

    def _reach_m(self, x: Body, y: Body, is_in_air: bool) -> float:
        """Distance within which two bodies interact: the smaller hangs from the larger if nothing supports it."""
        small, hangs = (x, is_in_air) if x.size_m < y.size_m else (y, y.id in self._unsupported)
        return max(TOUCH_M, hang_reach_m(small.size_m)) if hangs else TOUCH_M


def _free_around(body: Body, host: Body) -> tuple[Plane, ...] | None:
    """Between which planes a body is clear of a concave host; None where that is not known."""
    if roles(body, host)[0] is not body or not has_nothing_near(body, host):
        return None
    return free_planes(body, host, stands=False)
