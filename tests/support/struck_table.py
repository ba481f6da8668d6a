"""A session whose table is struck, and the amplitudes of what its hands get."""

from __future__ import annotations

from typing import Any

import numpy as np

from scene2hap import (
    AutoFidelity,
    HapticSession,
    InfinitePlate,
    MassSpringDamper,
    ModalPlate,
    Touch,
)
from scene2hap.propagation.coupled.hand import PALM
from scene2hap.propagation.impact import burst_of
from scene2hap.render.bursts import wave_of
from scenes import table_with_two_phones

RATE = 48_000


TOP_M = 0.72


NEAR, FAR = (0.5, TOP_M, 0.4), (1.0, TOP_M, 0.4)


STRUCK = (0.4, TOP_M, 0.4)


PHYSICAL = (ModalPlate(), InfinitePlate(), MassSpringDamper(), AutoFidelity(), ModalPlate(hand=PALM))


def session(**settings: Any) -> HapticSession:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, settings)
    made.update()
    made.wait_prepared()
    # These tests are about impacts, so sources are off.
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    return made


def touches(near: tuple[float, float, float] = NEAR, far: tuple[float, float, float] = FAR) -> list[Touch]:
    return [Touch("left", "table", near), Touch("right", "table", far)]


def rendered(made: HapticSession, seconds: float = 0.6) -> np.ndarray:
    return np.concatenate([made.render(480) for _ in range(round(seconds * RATE / 480))])


def amplitudes(samples: np.ndarray, burst: Any) -> np.ndarray:
    """Amplitudes of a burst's decaying sines in some samples, by least squares (n_hands, n)."""
    waves = [wave_of(f, t, RATE) for f, t in zip(burst.frequencies_hz.tolist(), burst.decays_s.tolist(), strict=True)]
    columns = np.zeros((len(samples), len(waves)))
    for k, wave in enumerate(waves):
        columns[: len(wave), k] = wave[: len(samples)]
    return np.asarray(np.linalg.lstsq(columns, samples.astype(float), rcond=None)[0].T)


def burst_at(made: HapticSession, point_m: tuple[float, float, float]) -> Any:
    state = made._state
    return burst_of(
        state.bodies["table"], state.on_plate("table", point_m), state.bodies["cup"], speed_m_s=1.0, is_finger=False
    )
