"""Damage bytes as a bad wire does."""

from collections.abc import Iterable, Iterator

import numpy as np


def damaged(pieces: Iterable[bytes], rate: float, rng: np.random.Generator) -> Iterator[tuple[bytes, bool]]:
    """Yield each piece with this share of its bytes changed in one bit, dropped or doubled, and whether it changed."""
    for piece in pieces:
        hit = np.flatnonzero(rng.random(len(piece)) < rate)
        if not len(hit):
            yield piece, False
            continue
        out = bytearray()
        start = 0
        for place in hit.tolist():
            out += piece[start:place]
            start = place + 1
            kind = rng.integers(3)
            if kind == 0:
                out.append(piece[place] ^ 1 << int(rng.integers(8)))
            elif kind == 2:
                out += piece[place : place + 1] * 2
        yield bytes(out + piece[start:]), True
