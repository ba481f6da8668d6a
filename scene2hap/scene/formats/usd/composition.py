"""Bound on the work of composing a stage, counted before usd-core begins.

A few lines of references to references, two at each step, expand to any number of prims. usd-core composes all of them
before it returns the first. So the sources of opinions are counted here, once per use: a prim counts once for each
layer and arc with an opinion about it. Copies of a native instance count one by one, like other nodes of a scene. The
count is approximate: only the largest variant of a set counts, and arcs to prims that exist only by other arcs do not
count. The child's limits of time and memory bound the rest.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from scene2hap.scene import limits

FREE_SITES, SITES_PER_PRIM = 500_000, 20.0
"""Sites of opinions that a stage may use, and a further number for each prim that its layers describe (assumed:
usd-core composes about 100,000 a second)."""

# Sums are bounded here, since each of thousands of steps may double them.
_MANY = 10**9

Key = tuple[str, Any]
"""A layer's identifier and the path of a prim in it (`Sdf.Path`)."""


@dataclass
class _Prim:
    """A prim in a layer: its children, the largest child of each variant set, and its arcs."""

    children: list[Key] = field(default_factory=list)
    variants: list[list[Key]] = field(default_factory=list)
    arcs: list[Key] = field(default_factory=list)


class Composition:
    """The prims that layers describe, and their arcs."""

    def __init__(self) -> None:
        self._prims: dict[Key, _Prim] = {}
        self._stack: dict[str, tuple[str, ...]] = {}
        self._over: dict[str, str] = {}
        self._default: dict[str, Any] = {}

    @property
    def n_prims(self) -> int:
        """Number of prims that the layers describe."""
        return len(self._prims)

    def add_layer(self, identifier: str, default_prim: Any, sublayers: Iterable[str]) -> None:
        """Record a layer's sublayers, and the path of its default prim (None without one)."""
        self._default[identifier], self._stack[identifier] = default_prim, tuple(sublayers)
        for below in self._stack[identifier]:
            self._over.setdefault(below, identifier)

    def add_prim(self, key: Key, children: Iterable[Any], variants: Iterable[Iterable[Any]]) -> None:
        """Record a prim with the paths of its children and of the variants of each set."""
        layer = key[0]
        self._prims[key] = _Prim(
            [(layer, path) for path in children], [[(layer, path) for path in each] for each in variants]
        )

    def add_arc(self, key: Key, layer: str, path: Any) -> None:
        """Record that a prim refers to another.

        Parameters: layer : identifier of the target's layer, "" for the prim's own stack of layers; path : of the
            target, empty for the default prim.
        """
        root = layer or self._root_of_stack(key[0])
        target = path or self._default.get(root)
        if target is not None:
            self._prims[key].arcs.append((root, target))

    def check(self, root: str) -> None:
        """Check the size of the composition of a root layer. Raises: SceneError: composing it takes too long."""
        sizes: dict[Key, int] = {}
        budget = limits.Budget(
            "the opinions to compose",
            FREE_SITES,
            SITES_PER_PRIM,
            stored=self.n_prims,
            unit="prims",
            advice="Flatten the scene (usdcat --flatten), or use fewer references to references.",
        )
        tops = [key for key in self._prims if key[0] in self._layers(root) and key[1].pathElementCount == 1]
        for top in tops:
            budget.spend(self._size(top, sizes), f"prim {top[1]}")

    def _size(self, top: Key, sizes: dict[Key, int]) -> int:
        """Return the number of opinions of a prim, of its descendants, and of all targets of their arcs."""
        # With a stack instead of recursion, since chains of arcs may exceed Python's recursion limit.
        to_do = [(top, False)]
        while to_do:
            key, is_ready = to_do.pop()
            if key not in self._prims or (key in sizes and not is_ready):
                continue
            prim = self._prims[key]
            arcs = [(layer, path) for root, path in prim.arcs for layer in self._layers(root)]
            if is_ready:
                size = 1 + sum(sizes.get(each, 0) for each in (*prim.children, *arcs))
                size += sum(max((sizes.get(each, 0) for each in one), default=0) for one in prim.variants)
                sizes[key] = min(size, _MANY)
            else:
                # Cyclic arcs do not count: usd-core refuses them.
                sizes[key] = 0
                to_do.append((key, True))
                below = (*prim.children, *(each for one in prim.variants for each in one), *arcs)
                to_do += ((each, False) for each in below)
        return sizes.get(top, 0)

    def _layers(self, root: str) -> tuple[str, ...]:
        """Return a layer and its direct and indirect sublayers."""
        found, to_do = [], [root]
        while to_do:
            layer = to_do.pop()
            if layer not in found:
                found.append(layer)
                to_do += self._stack.get(layer, ())
        return tuple(found)

    def _root_of_stack(self, layer: str) -> str:
        seen = {layer}
        while (above := self._over.get(layer)) is not None and above not in seen:
            layer = above
            seen.add(above)
        return layer
