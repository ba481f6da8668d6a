"""A model whose gains depend on poses: a session follows every move, also of objects without contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import (
    Bands,
    Box,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    HapticSession,
    Pose,
    SceneObject,
    SceneWarning,
    Touch,
    TriMesh,
)
from scene2hap.propagation.reference import FeltNear
from scenes import RATE, table_with_two_phones

HAND = (0.8, 0.72, 0.4)
ON_TABLE = Touch("left", "table", HAND)
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
KEPT: dict[str, Any] = {"sample_rate_hz": RATE, "reference": "source"}


class Air:
    """Gains fall with the distance to the middle of the source."""

    follows_poses = True

    def __init__(self) -> None:
        self.n_prepared = 0
        self.seen: list[set[str]] = []

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> Any:
        self.n_prepared += 1
        self.seen.append(set(network.bodies))
        return AirField({x.source_id: network.middles_m[x.source_id] for x in excitations}, bands.n_bands)


class AirField:
    def __init__(self, places_m: dict[str, tuple[float, float, float]], n_bands: int) -> None:
        self.source_ids, self._places_m, self._n_bands = tuple(places_m), places_m, n_bands

    def attenuation(self, object_id: str, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        found = np.ones((len(points_m), len(self.source_ids), self._n_bands))
        for column, (source_id, place_m) in enumerate(self._places_m.items()):
            if source_id != object_id:
                found[:, column] = gain(np.linalg.norm(points_m - place_m, axis=1))[:, None]
        return found


class LiveAir(Air):
    """The same, as a live field."""

    def live(self, graph: Any, bodies: Any, excitations: Sequence[Excitation], bands: Bands) -> Any:
        return LiveAirField(graph, tuple(x.source_id for x in excitations), bands.n_bands)


class LiveAirField:
    most = 1.0

    def __init__(self, graph: Any, source_ids: tuple[str, ...], n_bands: int) -> None:
        self._graph, self.source_ids, self._n_bands = graph, source_ids, n_bands

    def strongest(self, hands: Any) -> NDArray[np.float64]:
        places_m = {x: self._graph.pose(x).position_m for x in self.source_ids}
        field = AirField(places_m, self._n_bands)
        found = [[field.attenuation(x, np.array([point_m]))[0] for x, point_m in hand] for hand in hands]
        return np.array([np.max(each, axis=0) for each in found])


def gain(distance_m: Any) -> Any:
    return 1 / (1 + 4 * distance_m)


def flown(k: int) -> Pose:
    return Pose((2.0 * np.cos(k / 10), 1.5, 0.3))


def expected(pose: Pose) -> float:
    return float(gain(np.linalg.norm(np.array(pose.position_m) - HAND)))


@pytest.mark.parametrize("skip", [True, False])
@pytest.mark.parametrize("model", [Air, LiveAir])
def test_a_source_that_flies_is_felt_where_it_is(model: type[Air], skip: bool) -> None:
    made = HapticSession(
        *table_with_two_phones(), {**KEPT, "propagation": model(), "prepare": "blocking", "skip": skip}
    )
    for k in range(20):
        frame = made.update({"phone": flown(k)}, [ON_TABLE])
        assert frame.gain("left", "phone") == pytest.approx(expected(flown(k)), rel=1e-6)


def test_a_worker_prepares_after_each_move_and_the_last_field_sounds_meanwhile() -> None:
    made = HapticSession(*table_with_two_phones(), {**KEPT, "propagation": Air()})
    made.update({"phone": flown(0)}, [ON_TABLE])
    assert made.wait_prepared(30)
    for k in range(1, 6):
        # The worker cannot be done yet or is: the gain is of this pose or of an earlier one, never 0.
        assert made.update({"phone": flown(k)}, [ON_TABLE]).gain("left", "phone") > 0.1
        assert made.wait_prepared(30)
        assert made.update(touches=[ON_TABLE]).gain("left", "phone") == pytest.approx(expected(flown(k)), rel=1e-6)


def test_only_moves_prepare_and_updates_at_rest_are_skipped() -> None:
    model = Air()
    made = HapticSession(*table_with_two_phones(), {**KEPT, "propagation": model, "prepare": "blocking"})
    made.update({"phone": flown(1)}, [ON_TABLE])
    n_prepared, skipped = model.n_prepared, made.stats.skipped.unchanged_frames
    for _ in range(3):
        made.update({"phone": flown(1)}, [ON_TABLE])
    assert model.n_prepared == n_prepared
    assert made.stats.skipped.unchanged_frames == skipped + 3
    made.add(SceneObject("screen", pose=Pose((3.0, 2.0, 3.0)), geometry=Box((1.0, 1.0, 0.1))))
    made.update(touches=[ON_TABLE])
    assert model.n_prepared == n_prepared + 1
    made.remove("screen")
    made.update(touches=[ON_TABLE])
    assert model.n_prepared == n_prepared + 2


def test_the_model_gets_all_objects_and_touches_out_of_reach_feel_the_source() -> None:
    model = Air()
    made = HapticSession(*table_with_two_phones(), {**KEPT, "propagation": model, "prepare": "blocking"})
    frame = made.update({"phone": flown(3)}, [Touch("right", "cup", (5.0, 0.1, 5.0))])
    assert frame.gain("right", "phone") > 0.01
    assert all("cup" in seen and "phone" in seen for seen in model.seen)
    assert made.stats.skipped.unreachable_touches == made.stats.skipped.unreachable_objects == 0


def test_a_model_that_does_not_declare_it_is_prepared_for_contacts_alone() -> None:
    class Undeclared(Air):
        follows_poses = False

    model = Undeclared()
    made = HapticSession(*table_with_two_phones(), {**KEPT, "propagation": model, "prepare": "blocking"})
    made.update({"cup": Pose((6.0, 1.0, 5.0))}, [ON_TABLE])
    n_prepared = model.n_prepared
    made.update({"cup": Pose((6.0, 1.1, 5.0))}, [ON_TABLE])
    assert model.n_prepared == n_prepared


def test_a_strike_is_felt_by_its_distance() -> None:
    settings = {**KEPT, "propagation": Air(), "prepare": "blocking"}
    felt = []
    for x in (5.5, 8.0):
        made = HapticSession(*table_with_two_phones(), settings)
        made.update(touches=[Touch("left", "cup", (5.0, 0.1, 5.0))])
        made.update({"phone": Pose((x, 0.1, 5.0))}, [Touch("left", "cup", (5.0, 0.1, 5.0))])
        felt.append(made.strike("phone", (x, 0.1, 5.0), speed_m_s=1.0).felt.get("left", 0.0))
        assert made.stats.impacts_left_out == 0
    assert felt[0] > 2 * felt[1] > 0


def test_a_scaled_model_keeps_its_declaration() -> None:
    assert FeltNear(Air()).follows_poses
    assert not FeltNear(ExponentialPlate()).follows_poses


def test_middles_are_of_the_box_wherever_the_origin_is_and_also_without_a_body() -> None:
    class BoxCentres(Air):
        def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> Any:
            assert "ghost" not in network.bodies
            self.middle_m = network.middles_m["ghost"]
            assert len(network.middles_m) == len(scene.objects) + 1
            return super().prepare(network, excitations, bands)

    scene, bundle = table_with_two_phones()
    above = np.array([(0, 0, 0), (0.2, 0, 0), (0, 0.4, 0), (0, 0, 0.6)], dtype=float)
    ghost = SceneObject("ghost", pose=Pose.from_yaw((1.0, 2.0, 3.0), np.pi), geometry=TriMesh(above, FACES))
    model = BoxCentres()
    with pytest.warns(SceneWarning, match="ghost"):
        HapticSession(
            replace(scene, objects=(*scene.objects, ghost)), bundle, {"propagation": model, "prepare": "blocking"}
        )
    assert model.middle_m == pytest.approx((0.9, 2.2, 2.7))
