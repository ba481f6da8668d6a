"""The path cost above which a source cannot be felt, known before its gains are computed."""

import math
from typing import Any

import numpy as np
import pytest

from scene2hap import Bands, ExponentialPlate, HapticFrame, HapticSession, Pose, Touch
from scene2hap.contact.graph import ContactGraph
from scene2hap.devices.protocol import Fill, SinkFormat, SinkStats
from scene2hap.session.config import SkipConfig
from scene2hap.session.gains.audibility import SILENT, Audibility, CutoffCost, sifted, silence, within
from scene2hap.session.mix.prepared_loops import peaks_of
from scene2hap.session.mix.sources import Sources
from scene2hap.session.present_scene.network import body_of, excitations_of
from scene2hap.session.stats import SkipCounts
from scenes import RATE, table_with_two_phones

ALL_BANDS = [Bands.dominant(), Bands.third_octaves(10, 1000)]
LEVELS = np.array([1.0, 0.01])


def ears(bands: Bands, **settings: Any) -> tuple[Any, Audibility, CutoffCost]:
    """A live field of two phones, the audibility of their bands, and their cut-off cost."""
    snapshot, bundle = table_with_two_phones()
    sources = Sources()
    for name, loops in bundle.loops.items():
        sources.add(name, loops, None)
    bodies = {name: body for name, known in bundle.objects.items() if (body := body_of(known)) is not None}
    excitations = excitations_of([(row.source_id, row.loop) for row in sources.active_rows()], bodies, {})
    field = ExponentialPlate(**settings).live(ContactGraph(snapshot), bodies, excitations, bands)
    peaks = np.array([peaks_of(row.loop.tactile, bands) for row in sources.active_rows()], dtype=np.float32)
    audibility = Audibility(peaks, SkipConfig(), SkipCounts())
    return field, audibility, CutoffCost(field, audibility, excitations)


def felt_at(field: Any, audibility: Audibility, costs: list[float], levels: np.ndarray) -> np.ndarray:
    gains = field.at([costs]) * levels[:, None]
    return audibility.felt(gains.astype(np.float32), range(len(costs)))[0] / audibility.least_felt


@pytest.mark.parametrize("bands", ALL_BANDS, ids=["dominant", "octaves"])
@pytest.mark.parametrize("levels", [np.ones(2), LEVELS])
def test_sources_are_felt_within_the_audible_distance_only(bands: Bands, levels: np.ndarray) -> None:
    field, audibility, cutoff = ears(bands)
    edge = cutoff.felt(levels)
    assert (felt_at(field, audibility, edge, levels) < 1).all()
    # The cost table has steps of 6 %.
    assert (felt_at(field, audibility, [0.94 * cost for cost in edge], levels) >= 1).all()


@pytest.mark.parametrize("bands", ALL_BANDS, ids=["dominant", "octaves"])
def test_reported_gains_beyond_the_audible_distance_end_at_zero(bands: Bands) -> None:
    field, _, cutoff = ears(bands)
    edge = cutoff.arrives(LEVELS)
    gains = field.at([edge, [0.94 * cost for cost in edge]]).max(axis=2) * LEVELS
    assert (gains[0] < SILENT).all()
    assert (gains[1] >= SILENT).all()
    assert np.greater(edge, cutoff.felt(LEVELS)).all()


@pytest.mark.parametrize("bands", ALL_BANDS, ids=["dominant", "octaves"])
def test_copies_have_the_cut_off_distance_of_their_original(bands: Bands) -> None:
    """Compare three copies of each phone, in mixed order, with each phone alone."""
    snapshot, bundle = table_with_two_phones()
    sources, originals = Sources(), list(bundle.loops)
    order = [0, 1, 1, 0, 0, 1]
    for n, original in enumerate(order):
        sources.add(f"copy_{n}", bundle.loops[originals[original]], None)
    rows = sources.active_rows()
    excitations = excitations_of([(row.source_id, row.loop) for row in rows], {}, {})
    field = ExponentialPlate().live(ContactGraph(snapshot), {}, excitations, bands)
    peaks = np.array([peaks_of(row.loop.tactile, bands) for row in rows], dtype=np.float32)
    levels = np.linspace(0.05, 1.0, len(order))

    def edges(columns: list[int]) -> list[float]:
        some = [excitations[i] for i in columns]
        field = ExponentialPlate().live(ContactGraph(snapshot), {}, some, bands)
        audibility = Audibility(peaks[columns], SkipConfig(), SkipCounts())
        audibility.least_felt = np.float32(10 ** (-10 / 20) / len(order))
        return CutoffCost(field, audibility, some).felt(levels[columns])

    together = CutoffCost(field, Audibility(peaks, SkipConfig(), SkipCounts()), excitations).felt(levels)
    assert together == [edges([i])[0] for i in range(len(order))]
    assert len(set(together)) > 2


def test_audible_distance_is_zero_when_off_and_infinite_with_a_high_floor() -> None:
    _, _, cutoff = ears(Bands.dominant(), floor_db=-20.0)
    off, loud = cutoff.felt(np.array([0.0, 1.0]))
    assert off < 0
    assert loud == math.inf


def test_frame_reports_all_gains_until_contacts_change_and_felt_gains_later() -> None:
    touch = [Touch("left", "table", (0.15, 0.72, 0.4))]

    def told(*, later: bool) -> np.ndarray:
        s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
        s.set_source("alarm", gain_db=-40.0)
        frame = s.update(touches=touch)
        if later:
            s.update({"phone": Pose((0.3, 0.725, 0.4))}, touch)
            s.remove("alarm")
        return frame.gains[0, :, 0]

    now, later = told(later=False), told(later=True)
    assert (now > 0).all()
    assert later[0] == now[0]
    assert later[1] == 0.0


class Shown:
    """A sink without a device that stores all frames that it gets."""

    def __init__(self) -> None:
        self.frames: list[HapticFrame] = []
        self.stats = SinkStats()

    def open(self, format: SinkFormat) -> None: ...

    def start(self, fill: Fill) -> None: ...

    def stop(self) -> None: ...

    def close(self) -> None: ...

    def show(self, frame: HapticFrame) -> None:
        self.frames.append(frame)


def test_frame_can_be_read_at_any_time() -> None:
    sink = Shown()
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink)
    s.set_source("alarm", gain_db=-40.0)
    with s:
        s.update(touches=[Touch("left", "table", (0.15, 0.72, 0.4))])
        s.update({"phone": Pose((0.3, 0.725, 0.4))})
    assert (sink.frames[0].gains[0] > 0).all()


def test_a_sink_of_gains_gets_zeros_in_a_pause() -> None:
    sink = Shown()
    with HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink) as s:
        s.update(touches=[Touch("left", "table", (0.15, 0.72, 0.4))])
        s.pause()
    assert [frame.gains.any() for frame in sink.frames] == [True, False]


def test_sources_within_their_cut_off_in_any_row_are_selected() -> None:
    rng = np.random.default_rng(3)
    for n in [0, 1, 2, 3] * 20:
        costs = rng.choice([0.0, 1.0, 2.0, math.inf], (n, 5)).tolist()
        cutoff = rng.choice([-1.0, 0.0, 1.5, math.inf], 5).tolist()
        sought = [frozenset(rng.choice(5, int(rng.integers(0, 5)), replace=False).tolist()) for _ in range(n)]
        columns, rows, n_beyond = within(costs, cutoff, sought)
        assert columns == [x for x in range(5) if any(row[x] <= cutoff[x] for row in costs)]
        assert rows == [[row[x] if row[x] <= cutoff[x] else math.inf for x in columns] for row in costs]
        assert n_beyond == sum(row[x] > cutoff[x] for row, among in zip(costs, sought, strict=True) for x in among)


def test_bands_below_the_minimum_of_their_source_are_zeroed_and_counted() -> None:
    least = np.array([[0.1, 0.5], [np.inf, 0.0]], dtype=np.float32)
    gains = np.array([[[0.1, 0.4], [9.0, 0.0]], [[np.nan, 0.5], [0.0, 0.2]]], dtype=np.float32)
    assert silence(gains, least, None) == 3  # 0.4, 9.0 and the NaN
    np.testing.assert_array_equal(gains, np.array([[[0.1, 0], [0, 0]], [[0, 0.5], [0, 0.2]]], dtype=np.float32))
    swapped = np.array([[[0.05, 0.7]]], dtype=np.float32)
    assert silence(swapped, least, [0]) == 1
    np.testing.assert_array_equal(swapped, np.array([[[0, 0.7]]], dtype=np.float32))


@pytest.mark.parametrize("has_peaks", [True, False])
@pytest.mark.parametrize("has_least", [True, False])
def test_sources_too_weak_to_be_felt_and_silent_bands_are_left_out(has_peaks: bool, has_least: bool) -> None:
    rng = np.random.default_rng(5)
    for n, m in [(0, 2), (1, 0), (1, 3), (3, 4)] * 10:
        gains = rng.choice([0.0, 1e-9, 0.1, 0.5], (n, m, 5), p=[0.6, 0.1, 0.2, 0.1]).astype(np.float32)
        peaks = rng.uniform(0, 2, (m, 5)).astype(np.float32) if has_peaks else None
        least = rng.choice([0.0, 0.2, np.inf], (m, 5)).astype(np.float32) if has_least else None
        wanted, n_below, n_silent = gains.copy(), 0, 0
        for i, j in np.ndindex(n, m):
            felt = 0.3 if peaks is None else float(gains[i, j].astype(float) @ peaks[j])
            if felt < 0.3:
                n_below += felt != 0
                wanted[i, j] = 0
            for k in range(5 if least is not None else 0):
                if wanted[i, j, k] < least[j, k]:
                    n_silent += wanted[i, j, k] != 0
                    wanted[i, j, k] = 0
        columns = [j for j in range(m) if least is None or wanted[:, j].any()]
        kept, chosen, *counts = sifted(gains, peaks, 0.3, least)
        assert (chosen, counts) == (columns, [n_below, n_silent])
        np.testing.assert_array_equal(kept, wanted[:, columns])
