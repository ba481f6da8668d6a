"""Rays against triangles, with crossings computed by hand and by a brute-force caster."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.scene.shapes import Box
from scene2hap.scene.surface.rays import (
    Hits,
    cast_grid,
    cut,
    edges_seen,
    first_solids,
    free_space,
    median_span,
    share_open,
)

Floats = NDArray[np.float64]


def soup(*boxes: tuple[tuple[float, float, float], tuple[float, float, float]]) -> Floats:
    """Triangles (3, 3, m) of cuboids, each (size, centre)."""
    parts = []
    for size, middle in boxes:
        mesh = Box(size).mesh
        parts.append((mesh.vertices_m + middle)[mesh.faces])
    return np.concatenate(parts).transpose(2, 1, 0)


def along_one_ray(*crossings: tuple[float, int]) -> Hits:
    w, side = zip(*crossings, strict=True)
    return Hits(np.zeros(len(w), np.int64), np.array(w), np.array(side))


UNIT = soup(((1.0, 1.0, 1.0), (0.0, 0.0, 0.0)))


def test_rays_through_a_cube_enter_and_leave_once() -> None:
    hits = cast_grid(UNIT, 16)
    assert len(hits.starts) == 256
    np.testing.assert_array_equal(hits.ray, np.repeat(np.arange(256), 2))
    np.testing.assert_allclose(hits.w.reshape(-1, 2), np.tile([0.5, -0.5], (256, 1)), atol=1e-12)
    np.testing.assert_array_equal(hits.side.reshape(-1, 2), np.tile([1, -1], (256, 1)))


def test_edge_on_triangles_have_no_hits() -> None:
    wall = np.array([[[0.0], [1.0], [1.0]], [[0.0], [0.0], [0.0]], [[0.0], [0.0], [1.0]]])
    assert len(cast_grid(wall, 8).ray) == 0
    assert len(cast_grid(wall[[0, 2, 1]], 8).ray) > 0


def test_hits_equal_those_of_a_brute_force_caster() -> None:
    """The brute-force caster tests each ray with each triangle by signed areas."""
    rng = np.random.default_rng(4)
    triangles = rng.uniform(-1, 1, size=(3, 3, 60))
    n = 12
    # The heights of planes with known slopes over the same rectangle give u and v of each ray.
    low, high = triangles[:2].reshape(2, -1).min(axis=1), triangles[:2].reshape(2, -1).max(axis=1)
    stand = [_heights(low, high, slope, n) for slope in ((1.0, 0.0), (0.0, 1.0))]
    expected = set()
    for ray, (u, v) in enumerate(zip(*stand, strict=True)):
        for a, b, c in triangles.transpose(2, 1, 0):
            areas = [_doubled(p, q, (u, v)) for p, q in ((b, c), (c, a), (a, b))]
            if min(areas) >= 0 or max(areas) <= 0:
                w = (areas[0] * a[2] + areas[1] * b[2] + areas[2] * c[2]) / sum(areas)
                expected.add((ray, round(w, 9), int(np.sign(sum(areas)))))
    hits = cast_grid(triangles, n)
    assert set(zip(hits.ray.tolist(), np.round(hits.w, 9).tolist(), hits.side.tolist(), strict=True)) == expected
    assert (np.diff(hits.w)[np.diff(hits.ray) == 0] <= 0).all()


def _heights(low: Floats, high: Floats, slope: tuple[float, float], n: int) -> Floats:
    (u0, v0), (u1, v1) = low, high
    rectangle = [[(u0, v0), (u1, v0), (u1, v1)], [(u0, v0), (u1, v1), (u0, v1)]]
    triangles = np.array([[(u, v, slope[0] * u + slope[1] * v) for u, v in corner] for corner in rectangle])
    hits = cast_grid(triangles.transpose(2, 1, 0), n)
    assert len(hits.ray) == n * n
    return hits.w


def _doubled(p: Floats, q: Floats, at: tuple[float, float]) -> float:
    return float((p[0] - at[0]) * (q[1] - at[1]) - (p[1] - at[1]) * (q[0] - at[0]))


@pytest.mark.parametrize(
    ("crossings", "top", "bottom"),
    [
        ([(1.0, 1), (0.0, -1)], 1.0, 0.0),
        ([(1.0, -1), (0.0, 1)], 1.0, 0.0),
        ([(1.0, 1), (0.9, -1), (0.5, 1), (0.0, -1)], 1.0, 0.9),
        ([(1.0, 1), (0.9, 1), (0.8, -1), (0.0, -1)], 1.0, 0.0),
        ([(1.0, 1), (0.7, -1), (0.7, 1), (0.0, -1)], 1.0, 0.0),
        ([(1.0, 1)], 1.0, None),
        ([(1.0, 1), (0.4, 1)], 1.0, 0.4),
        ([(1.0, 1), (0.4, 1), (0.2, -1)], 1.0, 0.4),
        ([(1.0, 1), (1.0, -1)], 1.0, 1.0),
        ([(1.0, 1), (1.0, -1), (0.5, -1), (0.5, 1)], 1.0, 1.0),
        ([(1.0, 1), (1.0, -1), (0.5, 1), (0.3, -1)], 0.5, 0.3),
        ([(1.0, 1), (0.9995, 1), (0.5, -1)], 0.9995, 0.5),
        ([(1.0, 1), (0.9995, 1), (0.5, -1), (0.3, 1), (0.0, -1)], 0.9995, 0.5),
        ([(1.0, 1), (0.5, -1), (0.4995, -1)], 1.0, 0.5),
        ([(1.0, 1), (0.9995, 1), (0.5, -1), (0.4, -1)], 1.0, 0.4),
        ([(1.0, -1), (0.9995, -1), (0.5, 1)], 0.9995, 0.5),
        ([(1.0, 1), (0.9995, 1)], 0.9995, None),
    ],
    ids=[
        "solid",
        "faces inwards",
        "first of two",
        "overlapping",
        "touching",
        "one face",
        "both face up",
        "never closed",
        "sheet",
        "two sheets",
        "sheet before a solid",
        "label above",
        "label above two solids",
        "label below",
        "no label but overlapping",
        "label of a mesh that faces inwards",
        "label of a sheet",
    ],
)
def test_first_solids_returns_the_first_closed_interval_of_each_ray(
    crossings: list[tuple[float, int]], top: float, bottom: float | None
) -> None:
    solids = first_solids(along_one_ray(*crossings), 1e-6)
    assert solids.top.tolist() == [top]
    if bottom is None:
        assert np.isnan(solids.bottom).tolist() == [True]
    else:
        assert solids.bottom.tolist() == [bottom]


def test_first_solids_separates_consecutive_rays() -> None:
    """Open rays before and after a closed one; each begins at the height where its predecessor ended."""
    hits = Hits(np.array([3, 7, 7, 9]), np.array([0.0, 0.0, -1.0, -1.0]), np.array([1, 1, -1, 1]))
    solids = first_solids(hits, 1e-6)
    np.testing.assert_array_equal(solids.top, [0.0, 0.0, -1.0])
    np.testing.assert_array_equal(solids.bottom, [np.nan, -1.0, np.nan])
    assert share_open(hits) == pytest.approx(2 / 3)


def test_first_solids_of_no_hits_is_empty() -> None:
    none = Hits(np.empty(0, np.int64), np.empty(0), np.empty(0, np.int64))
    assert len(first_solids(none, 1e-6).top) == 0
    assert share_open(none) == 0.0


def test_cut_through_a_cube_is_its_square_outline() -> None:
    segments = cut(UNIT, 0.2)
    lengths = np.hypot(*(segments[:, 0] - segments[:, 1]))
    assert lengths.sum() == pytest.approx(4.0)
    assert np.abs(segments).max(axis=(1, 2)).tolist() == [0.5, 0.5]
    assert cut(UNIT, 0.6).shape == (2, 2, 0)


def test_spans_count_from_the_first_to_the_last_crossing() -> None:
    frame = soup(((0.2, 1.0, 1.0), (-0.9, 0.0, 0.0)), ((0.2, 1.0, 1.0), (0.9, 0.0, 0.0)))
    segments = cut(frame, 0.0)
    assert median_span(segments, 0, 32) == pytest.approx((2.0, 0.0))
    assert median_span(segments, 1, 32) == pytest.approx((1.0, 0.0))


def test_free_space_is_on_the_side_that_sees_farther() -> None:
    """A slab of 2 x 1 x 0.1: outside its two faces rays see twice its length, and 0.1 inside."""
    slab = soup(((2.0, 1.0, 0.1), (0.0, 0.0, 0.0)))
    free_m3 = free_space(slab, 16, lambda n_pairs: None)
    is_level = np.ptp(slab[2], axis=0) == 0
    assert (free_m3[is_level] > 0).all()
    assert (free_m3[~is_level] == 0).all()
    assert free_m3.sum() == pytest.approx(2 * 2.0 * (4.0 - 0.1))
    np.testing.assert_allclose(free_space(slab[:, ::-1], 16, lambda n_pairs: None), -free_m3)
    assert free_space(slab * [[[0.0]], [[1.0]], [[1.0]]], 16, lambda n_pairs: None).tolist() == [0.0] * 12


def test_the_outline_of_a_cube_is_as_wide_as_the_cube() -> None:
    assert median_span(edges_seen(UNIT), 0, 32) == pytest.approx((1.0, 0.0))


def test_median_span_of_zero_width_is_none() -> None:
    assert median_span(np.empty((2, 2, 0)), 0, 32) is None
    assert median_span(np.array([[[0.0], [1.0]], [[2.0], [2.0]]]), 0, 32) is None


def test_median_span_of_crumbs_between_rays_is_none() -> None:
    crumbs = np.array([[[0.0, 0.0], [1.0, 1.0]], [[0.0, 0.999], [0.001, 1.0]]])
    assert median_span(crumbs, 0, 32) is None


def test_large_triangles_are_cast_in_batches() -> None:
    """The hits are right for more pairs of rays and triangles than one batch tests."""
    sheet = soup(*(((1.0, 1.0, 0.01), (0.0, 0.0, 0.05 * i)) for i in range(70)))
    hits = cast_grid(sheet, 64)
    assert len(hits.ray) == 70 * 2 * 64 * 64
    np.testing.assert_allclose(hits.w[:140:2], 0.05 * np.arange(70)[::-1] + 0.005, atol=1e-9)
