"""Solution of the joints around touched objects, for impacts on all objects that are connected with them.

H is kept for the pairs of objects with the highest level per byte. The level of a pair is estimated at the joints of
both, with a few of the frequencies. It is the response of the touched object to a force on the struck one, over the
response where the force acts.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence, Set

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.contact.junction import Pair
from scene2hap.propagation.coupled.coupling import Joint, JointSystem, ends_of, systems
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.coupled.impact_scene import IMPACT_BANDS, HeldBody, ImpactScene
from scene2hap.propagation.elastic_body import ElasticBody

MOST_HELD_BYTES = 128_000_000
"""Memory of all H of a scene: enough for an object of 120 contacts at a loss of 0.01, or for a furnished group."""
AT_ONCE_BYTES = 64_000_000
"""Memory of the frequencies that are solved at once; all joints of a room at all frequencies take gigabytes."""
FEW = 8
"""One of this many frequencies is used to estimate levels."""
SILENT = 10 ** (-78 / 20)
"""Level at joints below which nothing is felt. A gain of -54 dB counts as none (`session.impacts`), and gains elsewhere
on both objects were at most 24 dB above this level, at 36 points of each of 2,800 pairs in two furnished kitchens."""


def solve_struck(
    bodies: Mapping[str, ElasticBody],
    groups: Sequence[Sequence[Joint]],
    object_ids: Collection[str],
    touched_ids: Collection[str],
    frequencies_hz: Floats,
    hand: Hand | None = None,
) -> ImpactScene:
    """Solve connected groups of bodies for impacts on any of their objects and hands on the touched ones.

    Pairs that do not fit into `MOST_HELD_BYTES` are left out.
    """
    connected = [_Group(bodies, joints, object_ids, touched_ids) for joints in groups if joints]
    levels = {pair: level for group in connected for pair, level in group.levels(frequencies_hz[::FEW]).items()}
    kept, left_bytes = set[Pair](), MOST_HELD_BYTES
    n_joints = {key: len(ends.rows) for group in connected for key, ends in group.ends.items()}

    def costs(pair: Pair) -> tuple[bool, float, Pair]:
        # Impacts on the touched objects themselves come first. Levels above 1, full strength, count as 1.
        return pair[0] != pair[1], n_joints[pair[0]] * n_joints[pair[1]] / min(max(levels[pair], SILENT), 1.0), pair

    for touched_id, struck_id in sorted(levels, key=costs):
        new = {(touched_id, struck_id), (struck_id, struck_id)} - kept
        takes = sum(16 * len(frequencies_hz) * n_joints[a] * n_joints[b] for a, b in new)
        if levels[touched_id, struck_id] > SILENT and takes <= left_bytes:
            kept |= new
            left_bytes -= takes
    passed = {pair: held for group in connected for pair, held in group.passed(kept, frequencies_hz).items()}
    held = {key: HeldBody(bodies[key], group.ends[key].points_m) for group in connected for key in group.object_ids}
    silent = frozenset(pair for pair, level in levels.items() if level <= SILENT)
    return ImpactScene({x: held[x] for pair in kept for x in pair}, passed, silent, frequencies_hz, hand)


class _Group:
    """Connected bodies."""

    def __init__(
        self,
        bodies: Mapping[str, ElasticBody],
        joints: Sequence[Joint],
        object_ids: Collection[str],
        touched_ids: Collection[str],
    ) -> None:
        self._bodies, self._joints = bodies, joints
        self.ends = ends_of(joints)
        self.object_ids = [key for key in self.ends if key in object_ids]
        self._touched_ids = [key for key in self.object_ids if key in touched_ids]

    def levels(self, frequencies_hz: Floats) -> dict[Pair, float]:
        """Largest gain in any band from any joint of an object to any of a touched one, infinite within one object."""
        n_bands, n_joints = len(IMPACT_BANDS.edges_hz) - 1, {x: len(self.ends[x].rows) for x in self.object_ids}
        others = {x: [struck_id for struck_id in self.object_ids if struck_id != x] for x in self._touched_ids}
        itself = {x: np.zeros((n_bands, n_joints[x])) for x in self.object_ids}
        # From the joints of all other objects, side by side.
        arrives = {
            x: np.zeros((n_bands, n_joints[x], sum(n_joints[y] for y in several))) for x, several in others.items()
        }
        pairs = {(x, struck_id) for struck_id in self.object_ids for x in (struck_id, *self._touched_ids)}
        for part, system, held in self._solved(pairs, frequencies_hz):
            bands = (np.searchsorted(IMPACT_BANDS.edges_hz, part) - 1).tolist()
            for x, powers in itself.items():
                free = system.receptances[x]
                moved = free.diagonal(axis1=1, axis2=2) - ((free @ held[x, x]) * free).sum(axis=2)
                _add(powers, bands, moved * part[:, None] ** 2)
            for x, several in others.items():
                pulled = [held[x, y] @ system.receptances[y] for y in several]
                if pulled:
                    moved = system.receptances[x] @ np.concatenate(pulled, axis=2)
                    _add(arrives[x], bands, moved * part[:, None, None] ** 2)
        found = {(x, x): np.inf for x in self._touched_ids}
        for x, several in others.items():
            begin = 0
            for y in several:
                own = itself[y][:, None]
                arriving = arrives[x][:, :, begin : begin + n_joints[y]]
                found[x, y] = float(np.sqrt(arriving / np.where(own > 0, own, np.inf)).max())
                begin += n_joints[y]
        return found

    def passed(self, pairs: Collection[Pair], frequencies_hz: Floats) -> dict[Pair, Complex]:
        """H of those pairs that are in this group, see `ImpactScene`."""
        found: dict[Pair, list[Complex]] = {}
        own = {pair for pair in pairs if pair[0] in self.ends}
        for _, _, held in self._solved(own, frequencies_hz) if own else ():
            for pair, one in held.items():
                found.setdefault(pair, []).append(one)
        return {pair: np.concatenate(several) for pair, several in found.items()}

    def _solved(
        self, pairs: Set[Pair], frequencies_hz: Floats
    ) -> Iterator[tuple[Floats, JointSystem, dict[Pair, Complex]]]:
        """Yield, for a few frequencies at a time, these frequencies, their system and H of the pairs."""
        rows, inverts = self._columns(pairs)
        alone = {struck_id for touched_id, struck_id in pairs if touched_id == struck_id} if inverts else set[str]()
        of_each = 16 * (len(self._joints) * len(rows) + 2 * sum(len(ends.rows) ** 2 for ends in self.ends.values()))
        parts = systems(self._bodies, self.ends, self._joints, frequencies_hz, AT_ONCE_BYTES // of_each)
        for part, system in parts:
            columns, held = system.answers(rows, alone)
            found = {(x, x): one for x, one in held.items()}
            for touched_id, struck_id in pairs - found.keys():
                at, to = self.ends[touched_id], self.ends[struck_id]
                if inverts:
                    between = columns[:, to.rows[:, None], np.searchsorted(rows, at.rows)].transpose(0, 2, 1)
                else:
                    between = columns[:, at.rows[:, None], np.searchsorted(rows, to.rows)]
                found[touched_id, struck_id] = np.multiply.outer(at.signs, to.signs) * between
            yield frequencies_hz[part], system, found

    def _columns(self, pairs: Collection[Pair]) -> tuple[NDArray[np.intp], bool]:
        """Columns of the inverse to solve for, and whether each struck object needs its part of the inverse as well.

        The inverse is symmetric: columns of the touched objects' joints or of the struck ones', whichever are fewer,
        hold H of all pairs of two objects. Those of the struck ones hold H of each struck object with itself, too.
        """
        none = np.empty(0, dtype=np.intp)
        touched = np.unique(np.concatenate([none, *(self.ends[a].rows for a, b in pairs if a != b)]))
        struck = np.unique(np.concatenate([none, *(self.ends[b].rows for _, b in pairs)]))
        return (touched, True) if len(touched) < len(struck) else (struck, False)


def _add(powers: Floats, bands: Sequence[int], accelerations: Complex) -> None:
    """Add the power at each frequency to that of its band."""
    for band, one in zip(bands, accelerations, strict=True):
        powers[band] += one.real**2 + one.imag**2
