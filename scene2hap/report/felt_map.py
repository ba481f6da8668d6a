"""Levels of every source at surface points, for several models."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.threshold import threshold_db
from scene2hap.bundle import HapticBundle
from scene2hap.propagation import MODELS as KNOWN
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.report.felt_paths import ScenePaths, SearchedPlate, SourcePaths
from scene2hap.report.surface_points import MOST_POINTS, Patch, patches_of
from scene2hap.session import HapticSession, Touch

MODELS: tuple[str, ...] = ("exponential_plate",)
"""The default model of a session. Models that resonate take milliseconds a point, so they are drawn on request."""
BAND_EDGES_HZ = (10.0, 40.0, 125.0, 400.0, 1000.0)
"""Parts of the tactile band that a page offers, besides the whole: pressure, flutter, low and high vibration."""
_BANDS_HZ = tuple(pairwise(BAND_EDGES_HZ))
_BAND_NAMES = tuple(f"{low:g}-{high:g} Hz" for low, high in _BANDS_HZ)
ALL_BANDS = "all"
ALL_SOURCES = ""
"""Key of the sum of all sources. It is free, since no object has an empty id."""


@dataclass(frozen=True, eq=False)
class FeltMap:
    """Levels over the threshold of touch [dB] at the points of all patches in order; -inf if no vibration arrives.

    `levels_db` has (n_points,) float32 by model, source and band, including `ALL_SOURCES` and `ALL_BANDS`. `paths` has
    the path of each source to each point, by model and source, for models with paths.
    """

    patches: Sequence[Patch]
    models: tuple[str, ...]
    sources: tuple[str, ...]
    bands: tuple[str, ...]
    levels_db: dict[str, dict[str, dict[str, NDArray[np.float32]]]]
    paths: dict[str, dict[str, SourcePaths]]


def felt_map(
    bundle: HapticBundle,
    models: Sequence[Any] = MODELS,
    *,
    scene_paths: ScenePaths | None = None,
    shells: frozenset[str] = frozenset(),
    most_points: int = MOST_POINTS,
) -> FeltMap:
    """Compute the levels that a hand would feel on each surface of a bundle's scene.

    Parameters: models : kinds or settings of propagation models; scene_paths : of the bundle, to search them once for
    several uses; shells : objects without points on the map; most_points : most surface points in total.
    Raises: ConfigError: no such model. ModelDomainError: a model does not hold in this scene.
    """
    inside = [item for item in bundle.snapshot.objects if item.id not in shells]
    patches = patches_of(inside, most_points, bundle.snapshot.up_axis)
    touches = [
        Touch("hand", patch.object_id, (float(x), float(y), float(z)))
        for patch in patches
        for x, y, z in patch.points_m
    ]
    sources, shares = tuple(bundle.loops), _shares(bundle)
    scene_paths = ScenePaths(bundle) if scene_paths is None else scene_paths
    levels: dict[str, dict[str, dict[str, NDArray[np.float32]]]] = {}
    paths: dict[str, dict[str, SourcePaths]] = {}
    for model in models:
        name = model if isinstance(model, str) else str(model.get("kind", "model"))
        built = KNOWN.build(model)
        whole = prepared_session(bundle, built, scene_paths).would_feel(touches)
        parts = prepared_session(bundle, built, scene_paths, bands=list(BAND_EDGES_HZ)).would_feel(touches)
        ways = scene_paths.of(built, patches)
        if ways is not None:
            paths[name] = ways
        levels[name] = {
            source: {
                ALL_BANDS: _level_db(whole[:, column].max(axis=1, initial=0.0), _felt_db(bundle, source)),
                **{
                    band: _level_db(parts[:, column, k] * share, _felt_db(bundle, source))
                    for k, (band, share) in enumerate(zip(_BAND_NAMES, shares[source], strict=True))
                },
            }
            for column, source in enumerate(sources)
        }
        levels[name][ALL_SOURCES] = {
            band: _sum_db([levels[name][source][band] for source in sources], len(touches))
            for band in (ALL_BANDS, *_BAND_NAMES)
        }
    return FeltMap(patches, tuple(levels), (ALL_SOURCES, *sources), (ALL_BANDS, *_BAND_NAMES), levels, paths)


def prepared_session(bundle: HapticBundle, model: object, scene_paths: ScenePaths, **config: Any) -> HapticSession:
    """Return a session that plays the bundle with a model, after its field is prepared."""
    # Of a subclass nothing is known: its fields may be others.
    propagation = SearchedPlate(model, scene_paths) if type(model) is ExponentialPlate else model
    config |= {"propagation": propagation, "prepare": "blocking", "actuator": bundle.actuator or "flat"}
    session = HapticSession(bundle, config=config, hands=("hand",))
    session.update()
    session.wait_prepared()
    return session


def _felt_db(bundle: HapticBundle, source: str) -> float:
    """Return the level of a source's first state at the source itself, over the threshold of touch [dB]."""
    loop = next(iter(bundle.loops[source].values()))
    return 0.0 if loop.felt is None else loop.felt.level_db


def _shares(bundle: HapticBundle) -> dict[str, NDArray[np.float64]]:
    """Return the share of each source's felt amplitude in each band (n_bands,) [-], by loop and threshold of touch."""
    clips = {source: next(iter(loops.values())).tactile for source, loops in bundle.loops.items()}
    # Copies of an object share a loop.
    of_samples = {id(clip.samples): clip for clip in clips.values()}
    shares = {key: _shares_of(clip) for key, clip in of_samples.items()}
    return {source: shares[id(clip.samples)] for source, clip in clips.items()}


def _shares_of(clip: AudioClip) -> NDArray[np.float64]:
    power = np.abs(np.fft.rfft(clip.samples)) ** 2
    hz = np.fft.rfftfreq(len(clip.samples), 1.0 / clip.sample_rate_hz)
    felt = np.where(hz > 0.0, power * 10.0 ** (-threshold_db(np.maximum(hz, 1.0)) / 10.0), 0.0)
    in_band = np.array([felt[(hz >= low) & (hz < high)].sum() for low, high in _BANDS_HZ])
    total = in_band.sum()
    return np.sqrt(in_band / total) if total > 0.0 else in_band


def _level_db(gains: NDArray[np.float64], at_source_db: float) -> NDArray[np.float32]:
    with np.errstate(divide="ignore"):
        levels: NDArray[np.float32] = (20.0 * np.log10(gains) + at_source_db).astype(np.float32)
    return levels


def _sum_db(levels: Sequence[NDArray[np.float32]], n_points: int) -> NDArray[np.float32]:
    """Sum the levels of independent vibrations, which add by power."""
    if not levels:
        return np.full(n_points, -np.inf, np.float32)
    with np.errstate(divide="ignore"):
        summed: NDArray[np.float32] = (
            10.0 * np.log10(np.sum([10.0 ** (level.astype(np.float64) / 10.0) for level in levels], axis=0))
        ).astype(np.float32)
    return summed
