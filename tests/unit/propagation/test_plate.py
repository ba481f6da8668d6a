"""Errors of a plate's constants and frequencies."""

from __future__ import annotations

import math

import pytest

from scene2hap import ModalPlate, Plate, RigidBody, materials
from scene2hap.errors import ModelDomainError

TABLE = Plate(1.2, 0.8, 0.02, materials.lookup("oak"))


@pytest.mark.parametrize("bad_hz", [-1.0, 2e9, math.inf, math.nan])
def test_a_frequency_out_of_bounds_is_named(bad_hz: float) -> None:
    sentence = rf"holds {bad_hz:g}".replace("+", r"\+") + r" Hz; it must be 0 to 1e\+09 \[Hz\]"
    for given in (bad_hz, [100.0, bad_hz]):
        with pytest.raises(ModelDomainError, match=sentence):
            TABLE.wavenumber_rad_m(given)
        with pytest.raises(ModelDomainError, match=sentence):
            ModalPlate().plate_transfer(TABLE, (0.1, 0.1), [(0.5, 0.4)], given)


@pytest.mark.parametrize("size_m", [(0.1, 1e-31, 0.1), (0.1, 0.1, 1e7)])
def test_a_rigid_body_whose_inertia_would_under_or_overflow_is_refused(size_m: tuple[float, float, float]) -> None:
    with pytest.raises(ModelDomainError, match=r"size_m\[[12]\] is 1e.* m; it must be at (least|most)"):
        RigidBody(1.0, size_m)
