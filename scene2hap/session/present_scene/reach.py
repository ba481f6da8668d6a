"""Connected components of the contact graph: the objects that each source can reach.

The groups are updated incrementally. A new contact joins two groups. When contacts vanish, searches start from both
ends of each and take turns, so that only the smaller part is searched: lifting a mug off a table in a furnished house
searches the mug, not the house. Objects with many contacts, such as a floor, are searched last.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Mapping, Sequence
from heapq import heapify, heappop, heappush
from itertools import chain

from scene2hap.contact.graph import ContactChange
from scene2hap.contact.junction import Pair

Beside = Mapping[str, Collection[str]]
_NONE: frozenset[int] = frozenset()


class _Group:
    """A connected component of the contact graph, of at least two objects, and the columns of its sources."""

    __slots__ = ("members", "sources")

    def __init__(self, members: set[str], sources: frozenset[int]) -> None:
        self.members, self.sources = members, sources

    @property
    def n_reached(self) -> int:
        """Number of these objects that a source reaches."""
        return len(self.members) if self.sources and len(self.members) > 1 else 0


class _Search:
    """A graph search from one end of a contact that vanished.

    `waiting` is a heap of degrees and ids; `cost` is the number of contacts visited.
    """

    __slots__ = ("cost", "seen", "waiting")

    def __init__(self, start: str, degree: int) -> None:
        self.seen, self.waiting, self.cost = {start}, [(degree, start)], 0

    @property
    def next_cost(self) -> int:
        """Number of contacts visited after one more step."""
        return self.cost + self.waiting[0][0]


class Reach:
    """Connected components of the contact graph, and the sources in each, kept up to date incrementally.

    Parameters: beside : the neighbours of each object, at any weight, since weights change; `follow` reads it again;
    carriers : ids of all objects that may pass on vibration, sources included.
    """

    def __init__(self, beside: Beside, carriers: Container[str], source_ids: Sequence[str]) -> None:
        self._beside, self._carriers = beside, carriers
        self._column = {source_id: column for column, source_id in enumerate(source_ids)}
        self._group: dict[str, _Group] = {}
        self._n_reached = 0
        for x in beside:
            if x in carriers and x not in self._group:
                self._found(x)

    def follow(self, change: ContactChange) -> None:
        """Apply a change of contacts; `beside` must already have the new contacts."""
        for a, b in change.appeared:
            self._join(a, b)
        ends: dict[_Group, set[str]] = {}
        for x in chain.from_iterable(change.vanished):
            group = self._group.get(x)
            if group is None:
                continue
            if self._beside.get(x):
                ends.setdefault(group, set()).add(x)
            else:
                self._leave(group, x)
        for group, starts in ends.items():
            if len(starts) > 1:
                self._part(group, starts)

    def has(self, object_id: str) -> bool:
        """Whether a source reaches an object over contacts."""
        group = self._group.get(object_id)
        return group is not None and bool(group.sources)

    def sources(self, object_id: str) -> frozenset[int]:
        """The columns of the sources that are connected with an object."""
        group = self._group.get(object_id)
        return _NONE if group is None else group.sources

    def concerns(self, change: ContactChange) -> bool:
        """Whether a source reaches an object of the changed contacts."""
        for pairs in (change.shifted, change.appeared, change.vanished):
            for a, b in pairs:
                if self.has(a) or self.has(b):
                    return True
        return False

    @property
    def objects(self) -> set[str]:
        """All objects that a source reaches over contacts, sources in contact included."""
        groups = {self._group[x] for x in self._column if x in self._group}
        return set().union(*(group.members for group in groups))

    def objects_near(self, object_ids: Iterable[str]) -> set[str]:
        """Objects connected with any of these and with a source."""
        near = {self._group[x] for x in object_ids if x in self._group}
        return set().union(*(group.members for group in near if group.sources))

    def n_without(self, others: Iterable[str]) -> int:
        """Number of objects that a source reaches over contacts, without the objects `others`."""
        return self._n_reached - sum([x in self._group for x in others])

    def _found(self, x: str) -> None:
        """Make the group of all objects that are connected with an object."""
        beside, carriers = self._beside, self._carriers
        members, waiting = {x}, [x]
        while waiting:
            more = [y for y in beside.get(waiting.pop(), ()) if y not in members and y in carriers]
            members.update(more)
            waiting += more
        if len(members) > 1:
            group = _Group(members, self._sources_in(members))
            self._group.update(dict.fromkeys(members, group))
            self._n_reached += group.n_reached

    def _join(self, a: str, b: str) -> None:
        if a not in self._carriers or b not in self._carriers:
            return
        one, two = self._group.get(a), self._group.get(b)
        if one is None:
            a, b, one, two = b, a, two, one
        if one is None:
            one = self._group[a] = _Group({a}, self._sources_in((a,)))
        if one is two:
            return
        self._n_reached -= one.n_reached
        if two is None:
            one.members.add(b)
            if b in self._column:
                one.sources |= {self._column[b]}
            self._group[b] = one
        else:
            self._n_reached -= two.n_reached
            if len(one.members) < len(two.members):
                one, two = two, one
            one.members |= two.members
            one.sources |= two.sources
            self._group.update(dict.fromkeys(two.members, one))
        self._n_reached += one.n_reached

    def _part(self, group: _Group, starts: Iterable[str]) -> None:
        """Split a group after contacts vanished: search from all starts, the cheapest search first.

        Searches that meet are joined. The objects that a finished search has seen are a group. Each part of the former
        group has a start, so that the last search need not finish: the remaining objects are its group.
        """
        self._n_reached -= group.n_reached
        owner = {start: _Search(start, self._degree(start)) for start in starts}
        searches = [*owner.values()]
        while len(searches) > 1:
            search = min(searches, key=lambda one: one.next_cost)
            search.cost = search.next_cost
            _, x = heappop(search.waiting)
            for y in self._beside.get(x, ()):
                if y not in self._carriers or y in search.seen:
                    continue
                other = owner.get(y)
                if other is None:
                    owner[y] = search
                    search.seen.add(y)
                    heappush(search.waiting, (self._degree(y), y))
                else:
                    search.seen |= other.seen
                    search.waiting += other.waiting
                    heapify(search.waiting)
                    owner.update(dict.fromkeys(other.seen, search))
                    searches.remove(other)
            if not search.waiting and len(searches) > 1:
                searches.remove(search)
                group.members -= search.seen
                part = _Group(search.seen, self._sources_in(search.seen))
                group.sources -= part.sources
                self._group.update(dict.fromkeys(part.members, part))
                self._n_reached += part.n_reached
                self._forget_if_alone(part.members)
        self._n_reached += group.n_reached
        self._forget_if_alone(group.members)

    def _leave(self, group: _Group, x: str) -> None:
        """Remove an object that touches nothing any more from its group."""
        del self._group[x]
        self._n_reached -= group.n_reached
        group.members.discard(x)
        if x in self._column:
            group.sources -= {self._column[x]}
        self._n_reached += group.n_reached
        self._forget_if_alone(group.members)

    def _sources_in(self, members: Collection[str]) -> frozenset[int]:
        column = self._column
        fewer, more = (members, column) if len(members) < len(column) else (column, members)
        return frozenset([column[x] for x in fewer if x in more])

    def _forget_if_alone(self, members: set[str]) -> None:
        if len(members) == 1:
            del self._group[next(iter(members))]

    def _degree(self, object_id: str) -> int:
        return len(self._beside.get(object_id, ()))


def reach_over(pairs: Iterable[Pair], carriers: Container[str], source_ids: Sequence[str]) -> Reach:
    """Groups of objects connected by these pairs."""
    beside: dict[str, list[str]] = {}
    for a, b in pairs:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    return Reach(beside, carriers, source_ids)
