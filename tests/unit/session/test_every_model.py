"""Every propagation model works in the same session; one line of configuration selects it."""

import math
import warnings
from typing import Any

import numpy as np
import pytest

from scene2hap import Bands, FullPropagation, HapticSession, Pose, SceneWarning, Touch
from scene2hap.errors import ConfigError
from scene2hap.propagation import MODELS
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.session.config import SessionConfig
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop

SETTINGS: dict[str, dict[str, Any]] = {"mass_spring_damper": {"resolution": 8}}
ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))
HOME = Pose((0.1, 0.725, 0.4))


@pytest.fixture(
    params=[(kind, bands) for kind in MODELS.kinds() for bands in ("dominant", "around", (40.0, 80.0, 160.0))], ids=str
)
def config(request: pytest.FixtureRequest) -> dict[str, Any]:
    kind, bands = request.param
    told = bands if isinstance(bands, str) else {"edges_hz": bands}
    return {"sample_rate_hz": RATE, "propagation": {"kind": kind, **SETTINGS.get(kind, {})}, "bands": told}


@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_session_works_with_every_model(config: dict[str, Any]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ThinPlateWarning)
        s = HapticSession(*table_with_two_phones(), config)

        def felt(moved: Any = None) -> np.ndarray:
            s.update(moved, [ON_TABLE])
            assert s.wait_prepared(60.0)
            gains = s.update(touches=[ON_TABLE]).gains
            assert np.isfinite(gains).all()
            assert ((gains >= 0) & (gains <= 1)).all()
            return gains

        before = felt()
        assert s.update(touches=[Touch("right", "phone", HOME.position_m)]).gain("right", "phone") == 1.0
        assert not s.update(touches=[Touch("right", "cup", (5.0, 0.1, 5.0))]).gains.any()
        assert felt({"phone": Pose((0.1, 1.2, 0.4))})[0, 0].max() == 0.0
        np.testing.assert_allclose(felt({"phone": HOME}), before, rtol=1e-9)

        s.add(
            box("fan", (0.1, 0.2, 0.1), (0.8, 0.82, 0.6)),
            haptics("plastic", (0.2, 0.1, 0.1), "on"),
            {"on": tone_loop(60)},
        )
        assert felt().shape == (2, 3, before.shape[2])
        assert (felt()[0, 2].max() > 0) == (before[0, 0].max() > 0)
        s.remove("fan")
        np.testing.assert_allclose(felt(), before, rtol=1e-9)

        for item in s.explain("left").felt:
            if item.carriers:
                assert sum(carrier.share for carrier in item.carriers) == pytest.approx(1.0)
            else:
                assert sum(step.change_db for step in item.steps) == pytest.approx(item.gain_db, abs=1e-6)
        out = s.render(RATE)
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0
        assert (np.abs(out[:, 0]).max() > 0) == (before.max() > 0)
        assert s.stats.fields_failed == 0


def test_resonant_models_use_a_band_around_each_source() -> None:
    around = Bands.dominant(octaves=0.5)
    assert SessionConfig().bands == Bands.dominant()
    given = SessionConfig(propagation="modal_plate")
    assert given.bands == around
    # Bands that were not given follow the model, also when settings are parsed from other settings.
    assert SessionConfig.parse(given, propagation="exponential_plate").bands == Bands.dominant()
    assert SessionConfig.parse(given, sample_rate_hz=8000).bands == around
    said = SessionConfig(propagation="modal_plate", bands="dominant")
    assert said.bands == Bands.dominant()
    assert SessionConfig.parse(said, sample_rate_hz=8000).bands == Bands.dominant()
    assert SessionConfig(propagation=FullPropagation(), bands="around").bands == around


@pytest.mark.parametrize("octaves", [-0.1, 2.1, math.nan, "wide", None])
def test_band_width_outside_0_to_2_octaves_is_refused(octaves: Any) -> None:
    with pytest.raises(ConfigError, match="octaves"):
        Bands.dominant(octaves)


def test_band_width_is_refused_with_fixed_edges() -> None:
    with pytest.raises(ConfigError, match=r"only Bands\.dominant"):
        Bands((40.0, 80.0), octaves=0.5)


@pytest.mark.parametrize("wrong", [math.nan, -12.0])
def test_gains_that_are_no_factors_are_played_as_zero_with_one_warning(wrong: float) -> None:
    class Decibels:
        """A field whose gains are wrong: in dB, or NaN."""

        source_ids = ("phone", "alarm")

        def prepare(self, network: object, excitations: object, bands: Bands) -> "Decibels":
            self.n_bands = bands.n_bands
            return self

        def attenuation(self, object_id: str, points_m: np.ndarray) -> np.ndarray:
            return np.full((len(points_m), 2, self.n_bands), wrong)

    s = HapticSession(
        *table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Decibels(), "prepare": "blocking"}
    )
    points = [(x, 0.72, 0.4) for x in (0.7, 0.8, 0.9)]
    with pytest.warns(SceneWarning, match=f"gave a gain of {wrong:g}, .* not in dB") as caught:
        frames = [s.update(touches=[Touch("left", "table", point)]) for point in points]
    assert len(caught) == 1
    assert not any(frame.gains.any() for frame in frames)


class AsPromised:
    """A model that uses its points as the float64 array (n_points, 3) that `PropagationField` promises."""

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> "AsPromised":
        made = AsPromised()
        made.source_ids, made.n_bands = tuple(one.source_id for one in excitations), bands.n_bands
        return made

    def attenuation(self, object_id: str, points_m: np.ndarray) -> np.ndarray:
        assert points_m.dtype == np.float64
        assert points_m.shape[1:] == (3,)
        far = np.exp(-np.linalg.norm(points_m[:, :2], axis=1))
        is_source = np.array([one == object_id for one in self.source_ids])
        return np.where(is_source[None, :], 1.0, far[:, None])[:, :, None].repeat(self.n_bands, axis=2)


@pytest.mark.parametrize("prepare", ["blocking", "background"])
def test_own_model_gets_its_points_as_an_array(prepare: str) -> None:
    config = {"sample_rate_hz": RATE, "propagation": AsPromised(), "prepare": prepare, "gain_limit_db": None}
    s = HapticSession(*table_with_two_phones(), config)
    on_both = [ON_TABLE, Touch("left", "table", (0.3, 0.72, 0.4))]
    s.update(touches=on_both)
    assert s.wait_prepared(60.0)
    expected = math.exp(-math.hypot(0.3, 0.72))
    assert s.update(touches=on_both).gain("left", "phone") == pytest.approx(expected, rel=1e-6)
    s.update({"table": Pose((0.01, 0.0, 0.0))}, on_both)
    assert s.would_feel(on_both).shape[0] == 2
    s.strike("table", (0.3, 0.72, 0.4))
    assert s.wait_prepared(60.0)
    assert s.impacts
