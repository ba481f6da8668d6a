"""Loops ready to be mixed: split into bands, with the peaks that `audibility` compares.

Preparing a loop takes some 100 ms. So a process prepares each content once, for all objects, sessions and copies of
the samples. A worker prepares loops that are added while a session plays. A prepared loop is cached as long as its clip
lives. The newest are cached longer, for objects that are removed and added again.
"""

from __future__ import annotations

import hashlib
import math
from concurrent.futures import Future
from dataclasses import dataclass
from functools import lru_cache, partial
from weakref import finalize

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.bands import split_bands
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.threshold import threshold_db
from scene2hap.common.caches import CacheWhileUsed
from scene2hap.common.forks import lock_of_process, renew_in_child
from scene2hap.common.worker_threads import WorkerPool
from scene2hap.haptics import Bands
from scene2hap.render.loop_bank import LoopBank

MOST_BYTES = 32 * 2**20
"""Size of the cache of the newest loops, whose clips may be gone."""
PEAKS_RATE_HZ = 8000
"""Rate at which peaks are searched: eight samples per wave at 1 kHz miss a peak by a factor of cos(pi/8) at most."""


@dataclass(frozen=True, eq=False)
class PreparedLoop:
    """A bank of one loop, and its peaks (2, n_bands), see `peaks_of`."""

    bank: LoopBank
    peaks: NDArray[np.float64]

    @property
    def nbytes(self) -> int:
        """Memory of the bank [byte]."""
        return self.bank.nbytes


_Kind = tuple[Bands, int]
_LOCK = lock_of_process()
# By id(clip): comparing samples would take too long for `find`, and an equal clip may die before this one.
_OF_CLIP: dict[int, dict[_Kind, PreparedLoop]] = {}
_BY_CONTENT: CacheWhileUsed[PreparedLoop] = CacheWhileUsed(MOST_BYTES)


def find(clip: AudioClip, bands: Bands, tactile_rate_hz: int) -> PreparedLoop | None:
    """The prepared loop of this clip, None if it is not ready; does no work."""
    with _LOCK:
        return _OF_CLIP.get(id(clip), {}).get((bands, tactile_rate_hz))


def prepare(clip: AudioClip, bands: Bands, tactile_rate_hz: int) -> PreparedLoop:
    """Return a clip's loop, from the cache or computed in this thread."""
    found = find(clip, bands, tactile_rate_hz)
    if found is not None:
        return found
    kind = (bands, tactile_rate_hz)
    content = hashlib.blake2b(clip.samples.tobytes(), key=str(clip.sample_rate_hz).encode()).digest()
    found = _BY_CONTENT.get((content, kind), partial(_made, clip, bands, tactile_rate_hz))
    with _LOCK:
        if id(clip) not in _OF_CLIP:
            finalize(clip, _OF_CLIP.pop, id(clip), None).atexit = False
        _OF_CLIP.setdefault(id(clip), {})[kind] = found
    return found


def order(clip: AudioClip, bands: Bands, tactile_rate_hz: int) -> Future[PreparedLoop]:
    """Let a worker prepare a clip's loop."""
    return _worker().submit(partial(prepare, clip, bands, tactile_rate_hz))


@lru_cache(maxsize=1)
def _worker() -> WorkerPool:
    return WorkerPool(1, "loops")


renew_in_child(_worker.cache_clear)


def _made(clip: AudioClip, bands: Bands, tactile_rate_hz: int) -> PreparedLoop:
    return PreparedLoop(LoopBank([clip], bands, tactile_rate_hz), peaks_of(clip, bands))


def peaks_of(clip: AudioClip, bands: Bands) -> NDArray[np.float64]:
    """Peaks of a loop in each band (2, n_bands): relative to the threshold of touch, then re full scale."""
    spectrum = np.fft.rfft(clip.samples.astype(np.float64))
    frequencies = np.fft.rfftfreq(len(clip.samples), 1 / clip.sample_rate_hz)
    n = max(1, round(len(clip.samples) * PEAKS_RATE_HZ / clip.sample_rate_hz))
    weights = (10 ** (-threshold_db(frequencies) / 20), np.ones(len(frequencies)))
    weighted = [np.fft.irfft(spectrum * weight, n) * (n / len(clip.samples)) for weight in weights]
    peaks: NDArray[np.float64] = np.array(
        [np.abs(split_bands(samples, PEAKS_RATE_HZ, bands)).max(axis=1) for samples in weighted]
    )
    return peaks / math.cos(math.pi / 8)
