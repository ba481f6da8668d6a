"""Issues the certificates of all bodies, shrinks them where other bodies come near, and ends invalid ones."""

from __future__ import annotations

import math
from collections.abc import Collection, Container, Iterable

from scene2hap.contact.body import Body, roles
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.certificate import Certificate, Extent, Resting, resting_on, separated, standing_planes
from scene2hap.contact.free_space import FreeSpace
from scene2hap.contact.geometry.level_plane import Plane
from scene2hap.contact.hinge import are_hinged
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.pair import BodyPairs
from scene2hap.contact.rule import TOUCH_M, hang_reach_m, is_over

_MOST_REFUSALS = 5
"""After n refusals a body waits for 2^(n-1) - 1 moves before the next attempt; n grows to this."""


class CertificateIssuer:
    """Issues certificates and ends them; those in force are in `of`, by body id.

    Parameters: pairs, unsupported : all bodies and their pairs, and the ids of those without full support; read here,
    changed by the caller. of : the mapping in which certificates are stored.
    """

    def __init__(
        self,
        pairs: BodyPairs,
        unsupported: Collection[str],
        broad_phase: BroadPhase,
        of: dict[str, Certificate],
    ) -> None:
        self._bodies, self._unsupported, self._broad_phase = pairs.bodies, unsupported, broad_phase
        self._hinged = pairs.hinged
        self.of = of
        # From the id of a pinning body to the ids of the bodies whose certificates end when it moves.
        self._pinned: dict[str, set[str]] = {}
        # By id: refusals minus certificates issued since, and moves that are left until the next attempt.
        self._refusals: dict[str, tuple[int, int]] = {}

    def issue(self, body: Body, resting: Resting | None, moving: Container[str]) -> dict[Pair, Junction | None] | None:
        """Issue a certificate to a body that rests as given, or touches nothing, if planes separate it from all others.

        The certificates of its neighbours get the same planes. A certificate that a body of `moving` pins would end
        with the next move of that body, as on a tray or in a vehicle. If the proof fails, or for such a certificate,
        count a refusal and return None. Otherwise return the body's junction with its support, if it has one.
        """
        junctions = self._issue(body, resting, moving)
        if junctions is None:
            self._refuse(body.id)
        elif body.id in self._refusals:
            self._refusals[body.id] = (max(self._refusals[body.id][0] - 1, 0), 0)
        return junctions

    def _issue(self, body: Body, resting: Resting | None, moving: Container[str]) -> dict[Pair, Junction | None] | None:
        x, on, top_m, pins = body.id, "", -math.inf, set[str]()
        planes: dict[str, tuple[Plane, ...]] = {}
        if resting is not None:
            on, top_m = resting.support.id, resting.rest.top_m
            # A body whose rest is not certain is in contact all the same, so no planes separate it from that neighbour.
            known = self._planes_on(body, resting) if resting.is_certain and on not in moving else None
            if known is None:
                return None
            planes[on] = known
            pins.add(on)
        own, theirs = Extent(body, self._broad_phase.inner_box(x), top_m, False), []
        for z in self._broad_phase.neighbours[x]:
            if z == on:
                continue
            its_own, other = self.of.get(z), self._bodies[z]
            # A body with refusals moves: half of the free space is its own, or its next move may end this certificate.
            extent = Extent.of(other, is_fixed=z not in self._refusals) if its_own is None else its_own.extent
            apart = separated(own, extent, self._reach_m(body, other, resting is None))
            if apart is not None:
                planes[z] = apart.one
                if its_own is not None:
                    theirs.append((its_own, apart.other))
                continue
            free = None if its_own is not None or z in moving else _free_around(body, other)
            if free is None:
                return None
            planes[z] = free
            pins.add(z)
        certificate, junctions = Certificate(own, planes, pins, resting), dict[Pair, Junction | None]()
        if not certificate.step(body.pose, junctions):
            return None
        for its_own, its_planes in theirs:
            its_own.keep_behind({x: its_planes})
        for pin in pins:
            self._pinned.setdefault(pin, set()).add(x)
        self.of[x] = certificate
        return junctions

    def may_be_issued(self, x: str) -> bool:
        """Return True if a moving body has waited long enough since its last refusal. Counts the wait down."""
        n, left = self._refusals.get(x, (0, 0))
        if left:
            self._refusals[x] = (n, left - 1)
        return not left

    def resting(self, body: Body, held: Collection[str]) -> Resting | None:
        """Return how a body rests on a neighbour, a certain rest before others; None if on none. `held` come first."""
        others = map(self._bodies.__getitem__, self._broad_phase.neighbours[body.id])
        below = [x for x in others if is_over(body, x) and not self._hinged.are_chained(body.id, x.id)]
        below.sort(key=lambda other: (other.id not in held, other.size_m))
        resting = None
        for other in below:
            resting = resting_on(body, other) or resting
            if resting is not None and resting.is_certain:
                break
        return resting

    def separate_from_neighbours(self, body: Body) -> list[Body]:
        """Separate a body that moved, or lost its support, from the certified bodies around it.

        Returns the bodies whose certificates end because no plane separates them from it.
        """
        x, out = body.id, []
        extent, hangs = Extent.of(body, is_fixed=x not in self._refusals), x in self._unsupported
        for z in self.of.keys() & self._broad_phase.neighbours[x]:
            certificate = self.of[z]
            other = certificate.body
            reach_m = self._reach_m(other, body, z in self._unsupported)
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
        """End the certificate of a body. Returns True if it had one."""
        certificate = self.of.pop(x, None)
        if certificate is not None and certificate.n_steps < 2:  # `issue` took the first step
            self._refuse(x)
        return certificate is not None

    def end_pinned(self, moved: Iterable[str]) -> list[str]:
        """End the certificates that depend on the poses of moved bodies. Returns the ids of their bodies."""
        ended = []
        for x in moved if self._pinned else ():
            for y in self._pinned.pop(x, ()):
                certificate = self.of.get(y)
                if certificate is not None and x in certificate.pins and self.end(y):
                    ended.append(y)
        return ended

    def forget(self, x: str) -> None:
        """Forget a removed body."""
        self.of.pop(x, None)
        self._refusals.pop(x, None)

    def _refuse(self, x: str) -> None:
        """Count a refusal, also for a certificate that ended before its first move."""
        n = min(self._refusals.get(x, (0, 0))[0] + 1, _MOST_REFUSALS)
        self._refusals[x] = (n, 2 ** (n - 1) - 1)

    def _planes_on(self, body: Body, resting: Resting) -> tuple[Plane, ...] | None:
        support = resting.support
        # A certified body bears nothing, by its own certificate. An unsupported one may hang from a larger body on it.
        if support.id in self.of or (support.id in self._unsupported and support.size_m < body.size_m):
            return None
        return standing_planes(body, resting)

    def _reach_m(self, x: Body, y: Body, is_in_air: bool) -> float:
        """Return the distance [m] within which two bodies interact; larger if the smaller may hang from the other, and
        infinite with a hinge, whose contact no plane excludes."""
        if are_hinged(x, y):
            return math.inf
        small, hangs = (x, is_in_air) if x.size_m < y.size_m else (y, y.id in self._unsupported)
        return max(TOUCH_M, hang_reach_m(small.size_m)) if hangs else TOUCH_M


def _free_around(body: Body, host: Body) -> tuple[Plane, ...] | None:
    """Return planes that keep a body clear of a concave host; None where they are not known."""
    if are_hinged(body, host) or roles(body, host)[0] is not body:
        return None
    return FreeSpace(body, host).planes(stands=False)
