"""The contract of `TactileConverter`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scene2hap.audio.clip import Samples
from scene2hap.audio.protocol import ConversionContext, TactileConverter, one_channel, opened_stream
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile
from scene2hap.plugins import lacking

_CONTEXTS = (
    ConversionContext(),
    ConversionContext(intensity=0.4, neighbours_hz=(170.0, 210.0)),
    ConversionContext(ActuatorProfile("lra", 100.0, 400.0, 175.0, 8.0), 0.5, (200.0,), 187.0, 230.0),
)
_RATES_HZ = (8000, 16_000, 44_100, 48_000, 192_000)
_SIZES = (0, 1, 2, 3, 17, 128, 1000, 4096)


def check_tactile_converter(converter: TactileConverter) -> None:
    """Check a converter against its protocol.

    The inputs are a machine's hum at all rates and in blocks of all sizes, samples at full scale and beyond, silence,
    and no samples. A value that is not finite, and two streams at once, are checked too.
    Raises: AssertionError: names the broken promise.
    """
    problem = lacking(converter, CONVERTERS.members)
    assert not problem, problem
    name = type(converter).__name__
    for context in _CONTEXTS:
        for rate_hz in _RATES_HZ:
            assert _felt(converter, context, _machine(rate_hz, 0.3), rate_hz).any(), f"{name} makes a hum silent"
        _hold_block_sizes(converter, context)
        loud = 3 * np.sign(np.sin(2 * np.pi * 200 * np.arange(16_000) / 8000)).astype(np.float32)
        _felt(converter, context, loud, 8000)
        silent = _felt(converter, context, np.zeros(12_000, np.float32), 8000)
        assert not silent.any(), f"{name} makes {np.abs(silent).max():.3g} of silence"
        _felt(converter, context, np.zeros(0, np.float32), 8000)
        _hold_refusal(converter, context)
    _hold_two_streams(converter, _CONTEXTS[0])


def _hold_block_sizes(converter: TactileConverter, context: ConversionContext) -> None:
    x = _machine(8000)
    whole = _felt(converter, context, x, 8000)
    for seed in (0, 1):
        cuts = np.cumsum(np.random.default_rng(seed).choice(_SIZES, 400))
        found = _felt(converter, context, x, 8000, [int(cut) for cut in cuts if cut < len(x)])
        assert np.array_equal(found.view(np.uint32), whole.view(np.uint32)), (
            f"{type(converter).__name__}: blocks of other sizes give other samples, by up to "
            f"{np.abs(found - whole).max():.3g}; carry the state from block to block"
        )


def _hold_refusal(converter: TactileConverter, context: ConversionContext) -> None:
    """Check that samples that are not finite are rejected and change no later output."""
    name, x = type(converter).__name__, _machine(8000, 0.2)
    for bad in (np.nan, np.inf, -np.inf):
        wrong, stream = x.copy(), opened_stream(converter, 8000, context)
        wrong[12] = bad
        try:
            stream.process(wrong)
        except AudioError:
            pass
        else:
            raise AssertionError(f"{name} takes a sample that is {bad}; it must raise an AudioError")
        after = np.concatenate([one_channel(converter, stream.process(x)), one_channel(converter, stream.finish())])
        fresh = _felt(converter, context, x, 8000)
        assert np.array_equal(after, fresh), f"{name}: a block that was refused changes what follows"


def _hold_two_streams(converter: TactileConverter, context: ConversionContext) -> None:
    """Check that a stream that is opened and fed between the blocks of another changes nothing in it."""
    name, x = type(converter).__name__, _machine(8000, 0.4)
    alone = _felt(converter, context, x, 8000)
    first, second = opened_stream(converter, 8000, context), opened_stream(converter, 8000, context)
    parts = []
    for block in np.split(x, 8):
        parts.append(one_channel(converter, first.process(block)).copy())
        second.process(block[::-1].copy())
    parts.append(one_channel(converter, first.finish()))
    assert np.array_equal(np.concatenate(parts), alone), f"{name}: two streams at once change each other"


def _machine(rate_hz: int, seconds: float = 1.6) -> Samples:
    """Return a hum whose pitch jumps half-way, with noise; within full scale."""
    t = np.arange(round(rate_hz * seconds)) / rate_hz
    hum = np.where(t < 0.8, np.sin(2 * np.pi * 187 * t), np.sin(2 * np.pi * 120 * t))
    noise = np.random.default_rng(11).uniform(-1, 1, t.size)
    return (0.5 * hum + 0.2 * np.sin(2 * np.pi * 41 * t) + 0.3 * noise).astype(np.float32)


def _felt(
    converter: TactileConverter, context: ConversionContext, x: Samples, rate_hz: int, cuts: Sequence[int] = ()
) -> Samples:
    """Return all samples of a stream, after checking length and range."""
    name, stream = type(converter).__name__, opened_stream(converter, rate_hz, context)
    parts = []
    for block in np.split(x, list(cuts)):
        given = block.copy()
        parts.append(one_channel(converter, stream.process(given)).copy())
        assert np.array_equal(given, block), f"{name} changes the block that it is given"
    felt = np.concatenate([*parts, one_channel(converter, stream.finish())])
    assert len(felt) == len(x), f"{name} makes {len(felt)} samples of {len(x)}, counting finish()"
    most = np.abs(felt).max(initial=0.0)
    assert most <= 1.0, f"{name} makes a sample of {most:.3g}; full scale is 1"
    return felt
