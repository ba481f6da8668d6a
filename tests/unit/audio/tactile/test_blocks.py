"""Every converter with blocks of random sizes; its other contract tests are in `scene2hap.testing`."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.audio.clip import Samples
from scene2hap.audio.protocol import ConversionContext, TactileConverter
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.errors import AudioError

CONTEXT = ConversionContext(intensity=0.4, neighbours_hz=(170.0, 210.0))


def converted(kind: str, blocks: list[Samples]) -> Samples:
    stream = cast("TactileConverter", CONVERTERS.build(kind)).stream(8000, CONTEXT)
    return np.concatenate([*(stream.process(block) for block in blocks), stream.finish()])


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
@settings(max_examples=15)
@given(sizes=st.lists(st.integers(1, 4096), min_size=1, max_size=12), seed=st.integers(0, 2**16))
def test_converters_are_bit_identical_for_random_block_sizes(kind: str, sizes: list[int], seed: int) -> None:
    x = np.random.default_rng(seed).uniform(-1, 1, sum(sizes)).astype(np.float32)
    blocks = np.split(x, np.cumsum(sizes)[:-1])
    np.testing.assert_array_equal(converted(kind, blocks), converted(kind, [x]))


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
def test_two_channels_are_refused(kind: str) -> None:
    with pytest.raises(AudioError, match="one channel"):
        converted(kind, [np.zeros((10, 2), np.float32)])
