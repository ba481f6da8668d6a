"""Kernels of `session`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import numpy as np
from hypothesis import given, strategies as st

from kernels import both, seeds, steady


@steady
@given(seed=seeds, n=st.integers(0, 4), n_theirs=st.integers(0, 5))
def test_kernels_answer_alike_from_the_last_field(seed: int, n: int, n_theirs: int) -> None:
    rng = np.random.default_rng(seed)
    own = [rows.tolist() for rows in np.split(rng.permutation(n), sorted(rng.integers(0, n + 1, 2)))]
    answers = [rng.uniform(0, 2, (len(rows), n_theirs, 3)) for rows in own]
    n_shared = int(rng.integers(0, min(n_theirs, 4) + 1))
    columns = (rng.permutation(4)[:n_shared], rng.permutation(n_theirs)[:n_shared])
    among = [None if rng.random() < 0.3 else frozenset(np.flatnonzero(rng.random(4) < 0.6).tolist()) for _ in range(n)]
    told, compiled = (
        kind(answers, own, columns, among, (4, 3)) for kind in both("session.fields.prepared.put_together")
    )
    assert told.shape == (n, 4, 3)
    np.testing.assert_array_equal(compiled, told)
