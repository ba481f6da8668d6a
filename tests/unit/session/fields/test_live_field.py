"""Models with a live field, which follows contacts by itself: the session prepares no fields for them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from scene2hap import Bands, ExponentialPlate, FullPropagation, HapticSession, NoPropagation, Pose, Touch
from scene2hap.errors import ModelDomainError
from scene2hap.session.gains.audibility import SILENT
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop

ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))


class OnlyPrepared:
    """The paper's law without its live field."""

    def __init__(self, **settings: Any) -> None:
        self._law = ExponentialPlate(**settings)

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> Any:
        return self._law.prepare(network, excitations, bands)


@pytest.mark.parametrize("settings", [{}, {"max_hops": 1}, {"max_hops": 2, "interface_loss_db": 3.0, "floor_db": -60}])
@pytest.mark.parametrize("bands", [Bands.dominant(), Bands.third_octaves(10, 1000)], ids=["dominant", "octaves"])
def test_live_field_gives_the_gains_of_a_prepared_field(settings: dict[str, Any], bands: Bands) -> None:
    rng = np.random.default_rng(4)
    models = (ExponentialPlate(**settings), OnlyPrepared(**settings))
    both = [
        HapticSession(
            *table_with_two_phones(),
            {"sample_rate_hz": RATE, "bands": bands, "propagation": model, "prepare": "blocking"},
        )
        for model in models
    ]
    fan = box("fan", (0.1, 0.2, 0.1), (0.8, 0.82, 0.6))
    plate = haptics("steel", (0.1, 0.1, 0.004), "on")
    worst = 0.0
    for step in range(40):
        x, lift = rng.uniform(0.1, 1.2), 0.4 * (step % 7 == 3)
        moved = {"phone": Pose((x, 0.725 + lift, 0.4))}
        if step % 5 == 4:
            moved["cup"] = Pose((0.8, 0.77 if step % 2 else 2.0, 0.2))
        touches = [
            Touch(hand, name, (float(rng.uniform(0, 1.6)), 0.72, float(rng.uniform(0, 0.8))))
            for hand in ("left", "right")
            for name in rng.choice(["table", "phone", "cup", "block"], rng.integers(0, 3), replace=False).tolist()
        ]
        if step == 20:
            for s in both:
                s.add(fan, plate, {"on": tone_loop(60)})
        if step == 30:
            for s in both:
                s.remove("alarm")
        live, prepared = (s.update(moved, touches).gains for s in both)
        np.testing.assert_allclose(live, prepared, rtol=1e-6, atol=SILENT)
        live, prepared = (s.render(RATE // 20) for s in both)
        worst = max(worst, float(np.abs(live - prepared).max()))
    ours, theirs = (s.stats for s in both)
    assert ours.fields_prepared == theirs.fields_prepared
    assert worst < 0.01
    # By cost, sources that cannot be felt are skipped even if their gain would have been 0 anyway.
    assert ours.skipped.below_threshold > 0
    by_cost = ("below_threshold", "silent_bands", "rows_not_mixed")
    others = {name: value for name, value in vars(theirs.skipped).items() if name in by_cost}
    assert replace(ours.skipped, **others) == theirs.skipped


def test_object_added_without_contact_carries_after_its_first_contact() -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    s.update(touches=[ON_TABLE])
    s.add(box("tray", (0.3, 0.02, 0.3), (0.8, 2.0, 0.4)), haptics("steel", (0.3, 0.3, 0.02)))
    on_tray = [Touch("left", "tray", (0.8, 0.74, 0.4))]
    assert not s.update(touches=on_tray).gains.any()
    assert s.update({"tray": Pose((0.8, 0.73, 0.4))}, on_tray).gain("left", "phone") > 0


class InstalledPlugin:
    """A plugin model with a live field that returns a fixed gain."""

    def __init__(self, answer: float) -> None:
        self.answer, self.n_fields = answer, 0
        self.asked: list[Any] = []

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> Any:
        raise AssertionError("a model with a live field is never asked to prepare one")

    def live(self, graph: Any, bodies: Any, excitations: Any, bands: Bands) -> "InstalledPlugin":
        self.n_fields += 1
        self.graph, self.n_bands = graph, bands.n_bands
        self.source_ids = tuple(item.source_id for item in excitations)
        self.most = math.inf
        return self

    def strongest(self, hands: Sequence[Sequence[Any]]) -> np.ndarray:
        self.asked.append([list(hand) for hand in hands])
        return np.full((len(hands), len(self.source_ids), self.n_bands), self.answer)


def test_plugin_can_provide_a_live_field() -> None:
    model = InstalledPlugin(0.25)
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": model})
    frame = s.update({"phone": Pose((0.3, 0.725, 0.4))}, [ON_TABLE, Touch("left", "alarm", (1.5, 0.73, 0.4))])
    assert model.asked == [[[("table", ON_TABLE.point_m), ("alarm", (1.5, 0.73, 0.4))]]]
    assert frame.gain("left", "phone") == 0.25
    assert frame.gain("left", "alarm") == 1.0
    assert frame.gain("right", "phone") == 0.0
    assert ("phone", "table") in model.graph.junctions
    # A change of contacts needs no new field; a change of sources does.
    assert model.n_fields == 1
    s.remove("alarm")
    assert s.update(touches=[ON_TABLE]).sources == ("phone",)
    assert model.n_fields == 2
    assert s.wait_prepared(10.0)
    assert s.stats.field_age_s == 0


def test_a_touch_on_the_source_takes_nothing_from_a_stronger_one() -> None:
    s = HapticSession(*table_with_two_phones(), {"propagation": InstalledPlugin(2.0), "gain_limit_db": None})
    frame = s.update(touches=[ON_TABLE, Touch("left", "alarm", (1.5, 0.73, 0.4))])
    assert frame.gain("left", "alarm") == 2.0


@pytest.mark.parametrize(("answer", "told"), [(3.0, 1.0), (math.nan, 0.0), (-1.0, 0.0)])
def test_invalid_gains_of_a_plugin_are_not_rendered(answer: float, told: float) -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": InstalledPlugin(answer)})
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") == told
    assert s.stats.gains_capped == (2 if answer > 1 else 0)


class WithPathCosts(InstalledPlugin):
    """The same with a cost of 0 for everything; returns too many or too few costs or bands."""

    def __init__(self, costs_more: int, bands_more: int) -> None:
        super().__init__(0.5)
        self.costs_more, self.bands_more = costs_more, bands_more
        self.most = 1.0

    def live(self, graph: Any, bodies: Any, excitations: Any, bands: Bands) -> "WithPathCosts":
        super().live(graph, bodies, excitations, bands)
        self.most = 1.0
        return self

    def path_costs(self, hands: Sequence[Any], limits: Any = None, among: Any = None) -> list[list[float]]:
        return [[0.0] * (len(self.source_ids) + self.costs_more) for _ in hands]

    def at(self, costs: list[list[float]], columns: Any = None) -> np.ndarray:
        n_columns = len(self.source_ids) if columns is None else len(columns)
        return np.full((len(costs), n_columns, self.n_bands + self.bands_more), self.answer)


def test_plugin_results_of_wrong_shape_raise_session_errors() -> None:
    class Wide(InstalledPlugin):
        def strongest(self, hands: Sequence[Sequence[Any]]) -> np.ndarray:
            return super().strongest(hands).repeat(2, axis=1)

    for model, told in (
        (Wide(0.5), r"shape \(1, 4, 1\); it must be \(1, 2, 1\)"),
        (WithPathCosts(-1, 0), r"returned \[1\] path costs for 1 hands"),
        (WithPathCosts(0, 3), r"shape \(241, 2, 4\); it must be \(241, 2, 1\)"),
    ):
        s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": model})
        with pytest.raises(ModelDomainError, match=told):
            s.update(touches=[ON_TABLE])
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": WithPathCosts(0, 0)})
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") == 0.5


class CountsFields(ExponentialPlate):
    """The paper's law; it counts its prepared fields."""

    n_prepared = 0

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> Any:
        type(self).n_prepared += 1
        return super().prepare(network, excitations, bands)

    def live(self, *given: Any) -> Any:
        return super().live(*given)


@pytest.mark.parametrize("bands", [Bands.dominant(), Bands.third_octaves(10, 1000)], ids=["dominant", "octaves"])
def test_many_points_are_felt_as_each_alone_with_one_field_for_a_scene(bands: Bands) -> None:
    rng, CountsFields.n_prepared = np.random.default_rng(2), 0
    session = HapticSession(
        *table_with_two_phones(), {"sample_rate_hz": RATE, "bands": bands, "propagation": CountsFields()}
    )
    points = [
        Touch("left", name, (float(rng.uniform(0, 1.6)), 0.72, float(rng.uniform(0, 0.8))))
        for name in ("table", "phone", "cup", "block", "alarm")
        for _ in range(30)
    ]

    def moved() -> None:
        session.update({"phone": Pose((0.3, 0.725, 0.2))})

    def lifted() -> None:
        session.update({"phone": Pose((0.3, 1.5, 0.2))})

    def added() -> None:
        fan = box("fan", (0.1, 0.2, 0.1), (0.8, 0.82, 0.6))
        session.add(fan, haptics("steel", (0.1, 0.1, 0.004), "on"), {"on": tone_loop(60)})

    changes = (session.update, moved, lifted, added, lambda: session.remove("alarm"))
    for n_changes, change in enumerate(changes, start=1):
        change()
        here = [point for point in points if point.object_id in session.object_ids]
        alone = np.concatenate([session.would_feel([point]) for point in here])
        assert CountsFields.n_prepared == n_changes - 1
        for _ in range(2):
            np.testing.assert_allclose(session.would_feel(here), alone, rtol=1e-9, atol=1e-12)
        assert CountsFields.n_prepared == n_changes


class HalfOfFull(FullPropagation):
    """Overrides `prepare` alone: half of each source arrives on other objects."""

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> Any:
        self_alone, everywhere = NoPropagation(), super()
        fields = [model.prepare(network, excitations, bands) for model in (self_alone, everywhere)]
        return SimpleNamespace(
            source_ids=fields[0].source_ids,
            attenuation=lambda *at: sum(field.attenuation(*at) for field in fields) / 2,
        )


class LiveHalf(HalfOfFull):
    """Overrides both."""

    def live(self, *given: Any) -> Any:
        return super().live(*given)


@pytest.mark.parametrize(
    ("model", "gain"), [(FullPropagation(), 1.0), (HalfOfFull(), 0.5), (LiveHalf(), 1.0)], ids=lambda x: str(x)[:10]
)
def test_a_subclass_that_overrides_prepare_alone_is_prepared(model: Any, gain: float) -> None:
    settings = {"sample_rate_hz": RATE, "prepare": "blocking", "propagation": model}
    session = HapticSession(*table_with_two_phones(), settings)
    assert session.update(touches=[ON_TABLE]).gain("left", "phone") == gain
