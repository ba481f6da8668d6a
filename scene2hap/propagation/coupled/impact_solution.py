"""Solution of the joints around touched objects, for impacts on all objects that are connected with them.

H is kept for the pairs of objects with the highest level per byte. The level of a pair is estimated at the joints of
both, with a few of the frequencies. It is the response of the touched object to a force on the struck one, over the
response where the force acts.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.junction import Pair
from scene2hap.propagation.coupled.coupling import ElasticBody, Joint, JointForces, couple, ends_of
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.coupled.impact_scene import IMPACT_BANDS, HeldBody, StruckScene

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

MOST_HELD_BYTES = 128_000_000
"""Memory of all H of a scene: enough for an object of 120 contacts at a loss of 0.01, or for a furnished group."""
AT_ONCE_BYTES = 64_000_000
"""Memory of the frequencies that are solved at a time; all joints of a room at all frequencies take gigabytes."""
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
) -> StruckScene:
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
    return StruckScene({x: held[x] for pair in kept for x in pair}, passed, silent, frequencies_hz, hand)


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
        powers: dict[Pair, Floats] = {}
        pairs = {(x, struck_id) for struck_id in self.object_ids for x in (struck_id, *self._touched_ids)}
        for part, solved, held in self._solved(pairs, frequencies_hz):
            bands = np.searchsorted(IMPACT_BANDS.edges_hz, part)
            for (touched_id, struck_id), one in held.items():
                towards, free = solved.receptances[touched_id], solved.receptances[struck_id]
                moved = towards @ one @ free
                if touched_id == struck_id:
                    moved = (free - moved).diagonal(axis1=1, axis2=2)[:, None]
                power = np.square(np.abs(moved) * part[:, None, None] ** 2)
                none = np.zeros((len(IMPACT_BANDS.edges_hz), *power.shape[1:]))
                np.add.at(powers.setdefault((touched_id, struck_id), none), bands - 1, power)
        found = {}
        for touched_id in self._touched_ids:
            for struck_id in self.object_ids:
                itself, arrives = powers[struck_id, struck_id], powers[touched_id, struck_id]
                gains = np.sqrt(arrives / np.where(itself > 0, itself, np.inf))
                found[touched_id, struck_id] = np.inf if touched_id == struck_id else float(gains.max())
        return found

    def passed(self, pairs: Collection[Pair], frequencies_hz: Floats) -> dict[Pair, Complex]:
        """H of those pairs that are in this group, see `StruckScene`."""
        found: dict[Pair, list[Complex]] = {}
        own = {pair for pair in pairs if pair[0] in self.ends}
        for _, _, held in self._solved(own, frequencies_hz) if own else ():
            for pair, one in held.items():
                found.setdefault(pair, []).append(one)
        return {pair: np.concatenate(several) for pair, several in found.items()}

    def _solved(
        self, pairs: Collection[Pair], frequencies_hz: Floats
    ) -> Iterator[tuple[Floats, JointForces, dict[Pair, Complex]]]:
        """Yield, for a few frequencies at a time, these frequencies, the solved group and H of the pairs."""
        alone = {struck_id for touched_id, struck_id in pairs if touched_id == struck_id}
        others = [(touched_id, struck_id) for touched_id, struck_id in pairs if touched_id != struck_id]
        touched = [self.ends[x].rows for x in self._touched_ids]
        rows = np.unique(np.concatenate(touched))
        of_each = 16 * (len(self._joints) * len(rows) + 2 * sum(len(ends.rows) ** 2 for ends in self.ends.values()))
        for part in np.array_split(frequencies_hz, -(-of_each * len(frequencies_hz) // AT_ONCE_BYTES)):
            solved = couple(self._bodies, self._joints, (), part)
            columns, held = solved.answers(rows, alone)
            found = {(x, x): one for x, one in held.items()}
            for touched_id, struck_id in others:
                at, to = self.ends[touched_id], self.ends[struck_id]
                between = columns[:, to.rows[:, None], np.searchsorted(rows, at.rows)].transpose(0, 2, 1)
                found[touched_id, struck_id] = np.multiply.outer(at.signs, to.signs) * between
            yield part, solved, found
